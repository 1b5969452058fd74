/* A problem as an address: #so3 for a ready-made one, #p=… for a text, compressed, nothing for the top: it moves;
 * #so3/linear.kernel for a step of its walk; ?lang=fr for the language. Behind it what is seen:
 * &tab=find, or &t=1.5&until=40&second=zeta_1:0.001&eye=0.5,0.3,1&within&set=m:2,g:0, or &projected, a step on the whole screen,
 * and &projected=answer, the last of the screens. */
const LARGEST = 400_000;

async function through(stream, bytes) {
  const piped = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  const parts = [];
  let size = 0;
  for (;;) {
    const { done, value } = await piped.read();
    if (done) break;
    size += value.length;
    if (size > LARGEST) throw new RangeError("too large");
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

export async function packed(text) {
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(text));
  return btoa(Array.from(bytes, (x) => String.fromCharCode(x)).join(""))
    .replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

export async function unpacked(word) {
  const plain = atob(word.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(plain, (c) => c.charCodeAt(0));
  const text = await through(new DecompressionStream("deflate-raw"), bytes);
  return new TextDecoder("utf-8", { fatal: true }).decode(text);
}

/* what an address asks for: { name } or { text }, the { step } to go to, what is { seen }; { damaged } where it cannot be
 * read, and { missing } the name of no ready-made problem */
export async function asked(hash, names) {
  const [place, ...more] = hash.replace(/^#/, "").split("&");
  return { ...await problem(place, names), seen: read(more) };
}

async function problem(place, names) {
  const [word, ...rest] = place.split("/"), step = plain(rest.join("/"));
  if (!word) return { name: "top", step };
  const name = names.find((x) => x === word) ?? names.find((x) => x.toLowerCase() === word.toLowerCase());
  if (name) return { name, step };
  if (!word.startsWith("p=")) return { name: "so3", step: "", missing: plain(word) };
  try {
    return { text: await unpacked(word.slice(2)), step };
  } catch {
    return { name: "so3", step: "", damaged: true };
  }
}

function plain(word) {
  try {
    return decodeURIComponent(word);
  } catch {
    return word;
  }
}

/* the language that an address asks for, if any */
export const spoken = (search) => new URLSearchParams(search).get("lang");

/* and the option of a command for it */
export const option = (lang) => (lang === "en" ? "" : ` --lang ${lang}`);

/* the address of a problem, which is a name or a packed text, and of a step of it, in a language, and of what is seen of it */
export const placed = (lang, word, step = "", seen = {}) => `?lang=${lang}#${word}${step && `/${encodeURIComponent(step)}`}${written(seen, tabbed(step))}`;

/* the tab that an address shows which names none: the motion, or the step that it names */
export const tabbed = (step) => (step ? "walk" : "see");

export const TABS = ["walk", "see", "find", "lecture", "take"];
const short = (v) => String(Number(v.toPrecision(7)));

/* what is seen: { tab, projected: "" or "answer", t, until, second: [name, ε], eye: [azimuth, elevation, zoom], within: true
 * of the body, set: { name: number } }, what is there of it */
function written({ tab, projected, t, until, second, eye, within, set = {} }, home) {
  const numbers = Object.entries(set).map(([name, v]) => `${name}:${v}`);
  return [
    tab && tab !== home && `&tab=${tab}`, projected !== undefined && `&projected${projected && `=${projected}`}`,
    t !== undefined && `&t=${short(t)}`, until && `&until=${short(until)}`, second && `&second=${second[0]}:${short(second[1])}`,
    eye && `&eye=${eye.map(short)}`, within && "&within", numbers.length && `&set=${numbers}`,
  ].filter(Boolean).join("");
}

/* what it says of that, and nothing of what it says wrongly */
function read(words) {
  const told = Object.fromEntries(words.map((x) => x.split("="))), seen = {};
  const eye = told.eye?.split(",").map(Number), number = (v) => v && Number.isFinite(Number(v));
  const pairs = (word = "") => word.split(",").map((x) => x.split(":")).filter(([name, v]) => /^\w+$/.test(name) && number(v));
  const numbers = pairs(told.set), [second] = pairs(told.second);
  if (TABS.includes(told.tab)) seen.tab = told.tab;
  if ("within" in told) seen.within = true;
  if ("projected" in told) seen.projected = told.projected === "answer" ? "answer" : "";
  for (const name of ["t", "until"]) if (number(told[name])) seen[name] = Number(told[name]);
  if (second) seen.second = [second[0], Number(second[1])];
  if (eye?.length === 3 && eye.every(Number.isFinite)) seen.eye = eye;
  if (numbers.length) seen.set = Object.fromEntries(numbers);
  return seen;
}
