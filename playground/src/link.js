/* A problem as the fragment of an address: #so3 for a ready-made one, #p=… for a text, compressed. */
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

/* what an address asks for: { name } or { text }, and { damaged } where it cannot be read */
export async function asked(hash, names) {
  const word = hash.replace(/^#/, "");
  if (!word) return { name: "so3" };
  if (names.includes(word)) return { name: word };
  if (!word.startsWith("p=")) return { name: "so3", damaged: true };
  try {
    return { text: await unpacked(word.slice(2)) };
  } catch {
    return { name: "so3", damaged: true };
  }
}
