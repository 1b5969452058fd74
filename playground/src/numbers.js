/* Numbers into the text of a problem: written(text, { initial, parameters, exp }) → { text, left }: the defaults
 * of [parameters] and what [initial] says; left: the names of those for which the text has no plain place. */
const table = (lines, name) => {
  const from = lines.findIndex((x) => new RegExp(`^\\s*\\[${name}\\]\\s*(#.*)?$`).test(x));
  if (from < 0) return null;
  const next = lines.findIndex((x, i) => i > from && /^\s*\[/.test(x));
  return [from + 1, next < 0 ? lines.length : next];
};
const plain = "(-?[\\d.]+(?:[eE][-+]?\\d+)?)";
const number = (v) => String(Number(v.toPrecision(12)));

/* a number after the mark in a line of a table */
function replaced(lines, at, mark, v) {
  for (let i = at[0]; i < at[1]; ++i) {
    const found = new RegExp(`^(\\s*${mark})${plain}(?=\\s*([,}#]|$))`).exec(lines[i]);
    if (!found) continue;
    lines[i] = found[1] + number(v) + lines[i].slice(found[0].length);
    return true;
  }
  return false;
}

export function written(text, { initial, parameters, exp }) {
  const lines = text.replace(/\n+$/, "").split("\n"), left = [];
  for (const [name, v] of Object.entries(parameters)) {
    const at = table(lines, "parameters");
    const set = at && (replaced(lines, at, `${name}\\s*=\\s*`, v) || replaced(lines, at, `${name}\\s*=\\s*\\{.*?\\bdefault\\s*=\\s*`, v));
    if (!set) left.push(name);
  }
  const start = Object.entries(initial).map(([name, v]) => [name, number(v)]);
  if (exp.length || start.length) {
    if (!table(lines, "initial")) lines.push("", "[initial]");
    const says = (name) => {
      const [from, to] = table(lines, "initial");
      return lines.findIndex((x, i) => i >= from && i < to && new RegExp(`^\\s*${name}\\s*=`).test(x));
    };
    const [from, to] = table(lines, "initial"), placed = lines.slice(from, to).some((x) => /^\s*(exp|[AT](_?\d+)+)\s*=/.test(x));
    if (exp.length && placed) left.push("θ");
    else if (exp.length) lines.splice(from, 0, `exp = [${exp.map(number).join(", ")}]`);
    for (const [name, v] of start) {
      const i = says(name), [begin] = table(lines, "initial");
      if (i >= 0) {
        const [, comment = ""] = /(\s*#.*)$/.exec(lines[i]) ?? [];
        lines[i] = `${name} = ${v}${comment}`;
      } else if (v !== "0") lines.splice(begin, 0, `${name} = ${v}`);
    }
  }
  return { text: `${lines.join("\n")}\n`, left };
}
