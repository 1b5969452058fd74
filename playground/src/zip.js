/* The files of a zip whose entries are deflated, as play.py writes it: name → bytes. */
export async function unzipped(zip) {
  const view = new DataView(zip), found = new Map();
  for (let at = 0; at + 30 < zip.byteLength && view.getUint32(at, true) === 0x04034b50;) {
    const size = view.getUint32(at + 18, true), name = view.getUint16(at + 26, true), start = at + 30 + name + view.getUint16(at + 28, true);
    const stream = new Blob([new Uint8Array(zip, start, size)]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    found.set(new TextDecoder().decode(new Uint8Array(zip, at + 30, name)), await new Response(stream).blob());
    at = start + size;
  }
  return found;
}
