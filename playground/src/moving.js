/* In a frame whose policy lets nothing be fetched: the emitted module, as a blob, and what moves the body by it. */
const chosen = (pieces) => Object.fromEntries(Object.entries(pieces).map(([x, name]) => [x, globalThis.drawing[name]]));

addEventListener("message", async ({ data, source, origin }) => {
  if (source !== parent || origin !== location.origin || !data.source) return;
  document.documentElement.lang = data.lang;
  document.title = document.querySelector("h1").textContent = data.title;
  const url = URL.createObjectURL(new Blob([data.source], { type: "text/javascript" }));
  try {
    const module = await import(url);
    const home = document.getElementById("motion");
    if (data.kept) {
      home.motion.keep(module, data.kept);
      parent.postMessage({ kept: "" }, location.origin);
      return;
    }
    home.replaceChildren();
    home.motion = globalThis.drawing.mount(home, { ...data.page, module }, chosen(data.pieces));
    parent.postMessage({ moved: "" }, location.origin);
  } catch (e) {
    parent.postMessage({ fault: String(e) }, location.origin);
  } finally {
    URL.revokeObjectURL(url);
  }
});
parent.postMessage({ listens: true }, location.origin);
