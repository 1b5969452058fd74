/* What may stand at a place of a problem file, from the tables of the package. */

/* the table that a line stands in: { name, kind } from the header and the key kind or solid */
function table(doc, number) {
  let name = "", kind = "", n = number;
  for (; n >= 1; --n) {
    const header = doc.line(n).text.match(/^\s*\[+\s*([\w.]+)/);
    if (header) {
      name = header[1].split(".").at(-1);
      break;
    }
  }
  for (let k = n + 1; k <= doc.lines; ++k) {
    const { text } = doc.line(k);
    if (/^\s*\[/.test(text)) break;
    kind ||= text.match(/^\s*(?:kind|solid)\s*=\s*"(\w+)"/)?.[1] ?? "";
  }
  return { name, kind };
}

function keys(schema, { name, kind }) {
  if (!name) return schema.top;
  if (name === "potential") return ["kind", ...(schema.potential[kind] ?? [])];
  if (name === "solid") return ["kind", ...(schema.solid[kind] ?? [])];
  if (name === "body") return ["moments", "given", "solid", ...(schema.solid[kind] ?? [])];
  return schema.tables[name] ?? [];
}

function groups(schema) {
  return Object.entries(schema.groups).flatMap(([name, [least, most, detail]]) =>
    [2, 3, 4].filter((n) => n >= least && n <= most).map((n) => ({ label: `${name}(${n})`, detail, type: "class" })));
}

export const completions = (schema) => (context) => {
  const { doc } = context.state, line = doc.lineAt(context.pos), before = line.text.slice(0, context.pos - line.from);
  const plain = (labels, type) => labels.map((label) => ({ label, type }));
  const value = before.match(/^\s*(\w+)\s*=\s*"([^"]*)$/);
  if (value) {
    const here = table(doc, line.number), from = context.pos - value[2].length;
    if (value[1] === "group") return { from, options: groups(schema) };
    if (value[1] === "kind") return { from, options: plain(Object.keys(here.name === "solid" ? schema.solid : schema.potential), "enum") };
    if (value[1] === "solid") return { from, options: plain(Object.keys(schema.solid), "enum") };
    return null;
  }
  const header = before.match(/^\s*\[+(\w*)$/);
  if (header) return { from: context.pos - header[1].length, options: plain(schema.top, "namespace") };
  const word = before.match(/^\s*(\w*)$/);
  if (!word || (!word[1] && !context.explicit)) return null;
  const options = keys(schema, table(doc, line.number)).map((label) => ({ label, type: "property", apply: `${label} = ` }));
  return { from: context.pos - word[1].length, options };
};
