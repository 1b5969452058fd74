/* What a field shows of a value as TOML has it, and what it writes; the names in expressions. */
import { ending } from "./source.js";

const NUMBER = /^[-+]?(?:0|[1-9]\d*)(?:\.\d+)?(?:[eE][-+]?\d+)?$/;
const WITH_COMMA = /^[-+]?\d+,\d+(?:[eE][-+]?\d+)?$/;
const ATOM = /"(?:[^"\\\n]|\\.)*"|'[^'\n]*'|[-+.\w]+/y;
const WORDS = new Set("sin cos tan exp log sqrt abs sinh cosh tanh atan t pi det_A".split(" "));

const plain = (x) => {
  if (x[0] === "'") return x.slice(1, -1);
  if (x[0] !== '"') return x;
  try {
    return JSON.parse(x);
  } catch {
    return null;
  }
};

/* the entries of a list of numbers and texts; null for any other value */
export function listed(value) {
  if (!/^\[[^[\]{}#]*\]$/s.test(value ?? "")) return null;
  const inside = value.slice(1, -1), found = [];
  for (let at = 0; at < inside.length;) {
    if (/[\s,]/.test(inside[at])) {
      ++at;
      continue;
    }
    ATOM.lastIndex = at;
    const next = ATOM.exec(inside);
    const x = next && plain(next[0]);
    if (x === null) return null;
    found.push(x);
    at = ATOM.lastIndex;
  }
  return found;
}

/* a value in a field */
export function shown(value) {
  if (value === undefined) return "";
  const all = listed(value);
  if (all) return all.join(all.some((x) => x.includes(",")) ? "; " : ", ");
  return /^[[{]/.test(value) || /^("""|''')/.test(value) ? value : plain(value) ?? value;
}

/* a number as TOML writes it, of what is typed with a comma or a point; null where it is none */
export function numeral(typed) {
  const x = typed.trim().replace("−", "-").replace(/^([-+]?\d*),(\d+)/, "$1.$2").replace(/^([-+]?)\./, "$10.").replace(/\.(?=$|e)/i, "").replace(/^([-+]?)0+(?=\d)/, "$1");
  return NUMBER.test(x) ? x : null;
}

const atom = (x) => numeral(x) ?? JSON.stringify(x.replace("−", "-"));

/* what is typed as TOML: a list, rows as they are, a number, else a text; nothing for nothing */
export function toml(typed, list) {
  const x = typed.trim();
  if (!x) return undefined;
  if (/^[[{]/.test(x)) return ending(x, 0) === x.length && /[\]}]$/.test(x) ? x : JSON.stringify(x);
  if (list || (/[,;]/.test(x) && !WITH_COMMA.test(x) && !x.includes("("))) {
    return `[${x.split(x.includes(";") ? ";" : /,(?![^(]*\))/).map((y) => y.trim()).filter(Boolean).map(atom).join(", ")}]`;
  }
  return x === "true" || x === "false" ? x : atom(x);
}

/* the names of an expression that may be parameters */
export const names = (value) => (String(value).replace(/\b\d+(\.\d*)?[eE][-+]?\d+/g, " ").match(/(?<![\w.])[A-Za-z]\w*(?!\w*\s*=)/g) ?? []).filter((x) => !WORDS.has(x) && !/^r\d+_\w+$/.test(x));
