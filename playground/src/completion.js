/* What may stand at a place of a problem file, from the tables of the package. */

const KIND = /^\s*(?:kind|solid)\s*=\s*"(\w+)"/m, NEXT = /^\s*\[/m;

/* the table that a place stands in: its name and kind */
function table(text, at) {
  const before = text.slice(0, at).split(NEXT), own = before.at(-1) + text.slice(at).split(NEXT)[0];
  return { name: before.length > 1 ? own.match(/^\[?\s*(\w*)/)[1] : "", kind: own.match(KIND)?.[1] ?? "" };
}

function keys(schema, { name, kind }, whole) {
  if (!name) return schema.top.filter((x) => !schema.many.includes(x) && (!schema.single.includes(x) || x === "group"));
  if (name === "initial") return [...velocity(schema, whole), "exp"];
  if (name === "body") return ["moments", "given", "solid", ...(schema.solid[kind] ?? [])];
  if (schema[name] && !schema.tables[name]) return ["kind", ...(schema[name][kind] ?? [])];
  if (name === "parameters") return [];
  return schema.tables[name] ?? [];
}

const groups = (schema) => schema.named.map((label, k) => ({ label, detail: schema.groups[label].meaning, type: "class", sortText: order(k) }));
const order = (k) => String(k).padStart(3, "0");
const plain = (labels, type) => labels.map((label) => ({ label, type }));

/* the values of a key, where it has few */
function values(schema, key, name) {
  if ((key === "group" && !name) || (key === "of" && name === "algebra")) return groups(schema);
  if (key === "kind") return plain(Object.keys(schema[name === "solid" || name === "input" ? name : "potential"]), "enum");
  if (key === "solid" && name === "body") return plain(Object.keys(schema.solid), "enum");
  if (key === "density" && name !== "fluid") return [];
  return plain(schema.values[key] ?? [], "enum");
}

/* a header, with its own brackets and no others */
function headers(schema, line, before, pos) {
  const [, open, word] = before.match(/^\s*(\[+)(\w*)$/), after = line.text.slice(before.length).match(/^\w*\]*/)[0];
  const labels = open === "[" ? schema.single : schema.many, close = "]".repeat(open.length);
  const options = plain(labels, "namespace").map((x) => ({ ...x, apply: (view, _, from) => {
    const insert = `${x.label}${close}`;
    view.dispatch({ changes: { from, to: line.from + before.length + after.length, insert }, selection: { anchor: from + insert.length }, userEvent: "input.complete" });
  } }));
  return { from: pos - word.length, options };
}

export const completions = (schema) => (context) => {
  const { doc } = context.state, line = doc.lineAt(context.pos), before = line.text.slice(0, context.pos - line.from);
  const here = () => table(doc.toString(), context.pos);
  if (/^\s*\[{1,2}\w*$/.test(before)) return headers(schema, line, before, context.pos);
  const value = before.match(/^\s*(\w+)\s*=\s*("?)([^"]*)$/);
  if (value) {
    const [, key, quote, word] = value, options = values(schema, key, here().name);
    if (!options.length || (!quote && word)) return null;
    const closed = line.text.slice(before.length).startsWith('"');
    return { from: context.pos - word.length, options: quote ? options.map((x) => (closed ? x : { ...x, apply: `${x.label}"` })) : options.map((x) => ({ ...x, apply: `"${x.label}"` })) };
  }
  const inline = before.match(/[{,]\s*(\w*)$/);
  if (inline && here().name === "parameters" && /^\s*\w+\s*=\s*\{/.test(before)) {
    return { from: context.pos - inline[1].length, options: schema.tables.parameters.map((label) => ({ label, type: "property", apply: `${label} = ` })) };
  }
  const word = before.match(/^\s*(\w*)$/);
  if (!word || (!word[1] && !context.explicit)) return null;
  const again = (view, x, from, to) => {
    view.dispatch({ changes: { from, to, insert: `${x.label} = ` }, selection: { anchor: from + x.label.length + 3 }, userEvent: "input.complete" });
    if (values(schema, x.label, here().name).length) schema.start?.(view);
  };
  const options = keys(schema, here(), doc.toString()).map((label, k) => ({ label, type: "property", apply: again, sortText: order(k) }));
  return { from: context.pos - word[1].length, options };
};

/* how the numbers of a velocity are called, by the group of a text; where its Lagrangian is stated, one letter for all */
export function velocity(schema, text) {
  const name = text.match(/^\s*group\s*=\s*"([^"]*)"/m)?.[1] ?? text.match(/^\s*of\s*=\s*"([^"]*)"/m)?.[1] ?? "";
  const factors = name.split(/\s*[x×]\s*(?=[A-Z])/).map((x) => schema.groups[x.replaceAll(" ", "")]);
  if (factors.some((x) => !x)) return [];
  const stated = /^\s*\[\s*(lagrangian|inertia)\s*\]/m.test(text), d = factors.reduce((sum, x) => sum + x.d, 0);
  const shift = factors.length === 1 && !stated ? factors[0].w : 0;
  const counted = (letter, count) => Array.from({ length: count }, (_, k) => `${letter}_${k + 1}`);
  return [...counted("zeta", d - shift), ...counted("w", shift)];
}
