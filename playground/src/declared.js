/* The parameters of a problem file: declared where an edit begins to use a name, dropped where it no longer does. */
import { entry, put, raw, tables, without, withTable } from "./source.js";
import { names } from "./values.js";

const NO_EXPRESSION = new Set("kind solid moments name title group of direction trivialisation frame unit meaning representation file action terminal".split(" "));

/* those of a body whose moments are letters */
const SPAN = [...Array(8).keys()].map((k) => k + 1);
const SYMBOLIC = ["m", ...SPAN.map((i) => `c_${i}`), ...SPAN.flatMap((i) => SPAN.filter((j) => j >= i).map((j) => `J_${i}${j}`))];

/* the names that a text uses in its expressions */
export function used(text) {
  const found = new Set();
  for (const table of tables(text)) {
    if (table.name === "parameters" || table.name.startsWith("parameters.")) continue;
    for (const x of table.entries) {
      if (table.name === "body" && x.key === "moments") SYMBOLIC.forEach((y) => found.add(y));
      if (!NO_EXPRESSION.has(x.key) && table.name) names(text.slice(x.begin, x.end)).forEach((y) => found.add(y));
    }
  }
  return found;
}

const place = (text, name = "parameters") => tables(text).findIndex((x) => x.name === name);
export const parameters = (text) => tables(text)[place(text)]?.entries ?? [];

export function withoutParameter(text, name) {
  const made = put(text, place(text), name);
  return tables(made)[place(made)].entries.length ? made : without(made, place(made));
}

/* a text after an edit, with the parameters that it needs; `kept` remembers what was said of those that go */
export function declared(before, after, kept) {
  const was = used(before), now = used(after);
  let text = after;
  for (const { key } of parameters(text)) {
    if (!was.has(key) || now.has(key)) continue;
    kept.set(key, raw(text, tables(text)[place(text)], key));
    text = withoutParameter(text, key);
  }
  for (const name of now) {
    const found = tables(text).some((x) => x.name === `parameters.${name}`);
    if (name === "s" || was.has(name) || found || entry(tables(text)[place(text)], name)) continue;
    if (place(text) < 0) text = withTable(text, `[parameters]\n${name} = ${kept.get(name) ?? "{}"}`, "");
    else text = put(text, place(text), name, kept.get(name) ?? "{}");
  }
  return text;
}

const DEFAULT = /([{,]\s*default\s*=\s*)([^,}\s]+)/;

/* its default, unit and meaning */
export function about(value) {
  if (!value.startsWith("{")) return { default: value };
  const text = (key) => value.match(new RegExp(`[{,]\\s*${key}\\s*=\\s*"([^"]*)"`))?.[1];
  return { default: value.match(DEFAULT)?.[2] ?? "", unit: text("unit"), meaning: text("meaning") };
}

/* what is said of it with another default; without one where it is empty */
export function withDefault(value, number) {
  if (!value.startsWith("{")) return number || "{}";
  const rest = value.slice(1, -1).trim();
  if (!DEFAULT.test(value)) return number ? `{ default = ${number}${rest && ", "}${rest} }` : value;
  if (number) return value.replace(DEFAULT, (_, key) => key + number);
  return value.replace(/default\s*=\s*[^,}\s]+\s*,?\s*/, "").replace(/,\s*\}$/, " }").replace(/^\{\s*\}$/, "{}");
}

const number = (v) => String(Number(v.toPrecision(12)));

/* numbers into a text: the defaults of [parameters] and what [initial] says; { text, left }: left are the names of those for which
 * it has no place */
export function written(text, { initial, parameters, exp }) {
  const left = [], start = Object.entries(initial);
  for (const [name, v] of Object.entries(parameters)) {
    const k = place(text), said = raw(text, tables(text)[k], name);
    if (said === undefined) left.push(name);
    else text = put(text, k, name, withDefault(said, number(v)));
  }
  if (!exp.length && !start.length) return { text, left };
  if (place(text, "initial") < 0) text = withTable(text, "[initial]");
  const k = place(text, "initial"), own = () => tables(text)[k];
  if (exp.length && own().entries.some(({ key }) => /^(exp|[AT](_?\d+)+)$/.test(key))) left.push("θ");
  else if (exp.length) text = put(text, k, "exp", `[${exp.map(number).join(", ")}]`);
  for (const [name, v] of start) {
    if (v || entry(own(), name)) text = put(text, k, name, number(v));
  }
  return { text, left };
}
