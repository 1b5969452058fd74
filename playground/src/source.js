/* The text of a problem file as its tables, and edits of one of them that leave all others, and comments, as they are. */

const HEADER = /^[ \t]*(\[\[?)[ \t]*([^\]\n]+?)[ \t]*\]\]?[^\n]*/;
const KEY = /^[ \t]*((?:[\w-]+|"[^"\n]*"|'[^'\n]*')(?:[ \t]*\.[ \t]*(?:[\w-]+|"[^"\n]*"|'[^'\n]*'))*)[ \t]*=[ \t]*/;

/* where a text in quotes ends that begins at a place */
function quoted(text, at) {
  const mark = text[at], fence = mark.repeat(3), long = text.startsWith(fence, at);
  for (let k = at + (long ? 3 : 1); k < text.length; ++k) {
    if (mark === '"' && text[k] === "\\") ++k;
    else if (long ? text.startsWith(fence, k) : text[k] === mark) return k + (long ? 3 : 1);
  }
  return text.length;
}

/* where a value ends that begins at a place */
export function ending(text, from) {
  let depth = 0, end = from;
  for (let k = from; k < text.length; ++k) {
    const x = text[k];
    if (x === '"' || x === "'") end = (k = quoted(text, k) - 1) + 1;
    else if (x === "#" && depth) k = text.indexOf("\n", k) < 0 ? text.length : text.indexOf("\n", k);
    else if (!depth && (x === "\n" || x === "#")) break;
    else {
      if ("[{".includes(x)) ++depth;
      if ("]}".includes(x)) --depth;
      if (x.trim()) end = k + 1;
    }
  }
  return end;
}

/* its tables, the first one without a name: { name, many, from, to, entries }; an entry is { key, from, to, begin, end },
 * its lines, and in them its value; `to` is where the last of them ends */
export function tables(text) {
  const found = [{ name: "", many: false, from: 0, to: 0, entries: [] }];
  for (let at = 0; at < text.length;) {
    const rest = text.slice(at), line = rest.indexOf("\n") < 0 ? text.length : at + rest.indexOf("\n") + 1;
    const header = rest.match(HEADER), key = header ? null : rest.match(KEY);
    let next = line;
    if (header) found.push({ name: header[2], many: header[1] === "[[", from: at, to: line, entries: [] });
    else if (key) {
      const begin = at + key[0].length, end = ending(text, begin), stop = text.indexOf("\n", end);
      next = stop < 0 ? text.length : stop + 1;
      found.at(-1).entries.push({ key: key[1], from: at, to: next, begin, end });
      found.at(-1).to = next;
    }
    at = next;
  }
  return found;
}

export const entry = (table, key) => table?.entries.find((x) => x.key === key);
export const raw = (text, table, key) => {
  const found = entry(table, key);
  return found && text.slice(found.begin, found.end);
};

const ended = (text) => (text && !text.endsWith("\n") ? `${text}\n` : text);

/* the text with a key of its k-th table set to a value as TOML has it; without the key where there is none */
export function put(text, k, key, value) {
  const own = tables(text)[k], old = entry(own, key);
  if (old && value !== undefined) return text.slice(0, old.begin) + value + text.slice(old.end);
  if (old) return text.slice(0, old.from) + text.slice(old.to);
  if (value === undefined) return text;
  return `${ended(text.slice(0, own.to))}${key} = ${value}\n${text.slice(own.to)}`;
}

const lines = (text, comments) => text.split(/(?<=\n)/).filter((x) => /^\s*#/.test(x) === comments).join("");

/* a text without its lines of comments */
export const uncommented = (text) => lines(text, false);

/* without its k-th table; lines of comments in it stay */
export function without(text, k) {
  const own = tables(text)[k];
  const kept = lines(text.slice(own.from, own.to), true);
  return text.slice(0, own.from) + kept + text.slice(own.to).replace(/^\n+/, kept ? "\n" : "");
}

/* with a table more, behind the last of some names, or at the end; or behind the head of the file */
export function withTable(text, table, after = []) {
  const all = tables(text), last = after === "" ? all[0] : all.findLast((x) => after.includes(x.name)), made = `${table.trim()}\n`;
  if (!last) return `${text.trimEnd()}\n\n${made}`;
  const before = text.slice(0, last.to).trimEnd(), rest = text.slice(last.to).replace(/^\n+/, "");
  return `${before}${before ? "\n\n" : ""}${made}${rest ? `\n${rest}` : ""}`;
}

/* the number of the line, from 1, at a place */
export const lineAt = (text, at) => text.slice(0, at).split("\n").length;
