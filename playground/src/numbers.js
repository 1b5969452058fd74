/* Numbers into the text of a problem: written(text, { initial, parameters, exp }) → { text, left }: the defaults
 * of [parameters] and what [initial] says; left: the names of those for which the text has no place. */
import { withDefault } from "./declared.js";
import { entry, put, raw, tables, withTable } from "./source.js";

const number = (v) => String(Number(v.toPrecision(12)));
const place = (text, name) => tables(text).findIndex((x) => x.name === name);

export function written(text, { initial, parameters, exp }) {
  const left = [], start = Object.entries(initial);
  for (const [name, v] of Object.entries(parameters)) {
    const k = place(text, "parameters"), said = raw(text, tables(text)[k], name);
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
