/* A problem as an address: #so3 for a ready-made one, #p=… for a text, compressed; #so3/linear.kernel for a step of it,
 * ?lang=fr for the language; nothing for the top, which moves. */
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

/* what an address asks for: { name } or { text }, the { step } to go to; { damaged } where it cannot be read, and
 * { missing } the name of no ready-made problem */
export async function asked(hash, names) {
  const [word, ...rest] = hash.replace(/^#/, "").split("/"), step = plain(rest.join("/"));
  if (!word) return { name: "top", step, first: true };
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

/* the address of a problem, which is a name or a packed text, and of a step of it, in a language */
export const placed = (lang, word, step = "") => `?lang=${lang}#${word}${step && `/${encodeURIComponent(step)}`}`;
