/* The motion as a picture and as a film: its canvas, on the colour of the page. */
import { make, save } from "./dom.js";

const RATE = 30, LONGEST = 60_000, LAST = 500, FINER = 2, LINE = 18;
const short = (x) => Number(x.toFixed(2));

/* what stands on a canvas that lets the page through, on one that does not */
function painted(canvas, on) {
  if (on.width !== canvas.width) on.width = canvas.width;
  if (on.height !== canvas.height) on.height = canvas.height;
  const pen = on.getContext("2d");
  pen.fillStyle = getComputedStyle(document.body).backgroundColor;
  pen.fillRect(0, 0, on.width, on.height);
  pen.drawImage(canvas, 0, 0);
  return on;
}

/* what its arrows mean, in their colours */
const meant = ({ page: { arrows = [], meanings = [] }, colours }) => meanings.map((meaning, i) =>
  [colours.read(`arrow-${i + 1}`), `${arrows.find((x) => x.number === i + 1)?.label.replaceAll("_", "")}  ${meaning}`]);

/* the picture as SVG: what the pen does while it is drawn once more, and below it what its arrows mean */
function vectors(canvas, scene) {
  const pen = canvas.getContext("2d"), made = [], told = meant(scene);
  const width = canvas.clientWidth, high = canvas.clientHeight, height = high + (told.length + 0.5) * LINE;
  const text = (what, x, y, more) => made.push(`<text x="${short(x)}" y="${short(y)}" ${more}>${what.replace(/[<&]/g, (c) => `&#${c.charCodeAt(0)};`)}</text>`);
  const shape = (more) => made.push(`<path d="${path}" ${more} opacity="${pen.globalAlpha}"/>`);
  const anchor = { center: "middle", right: "end" };
  let path = "";
  const own = {
    clearRect: () => { made.length = 0; },
    beginPath: () => { path = ""; },
    moveTo: (x, y) => { path += `M${short(x)} ${short(y)}`; },
    lineTo: (x, y) => { path += `L${short(x)} ${short(y)}`; },
    closePath: () => { path += "Z"; },
    arc: (x, y, r) => { path += `M${short(x - r)} ${short(y)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`; },
    drawImage: (image, x, y, wide, high) => made.push(`<image x="${short(x)}" y="${short(y)}" width="${wide}" height="${high}" href="${image.toDataURL()}"/>`),
    fill: () => shape(`fill="${pen.fillStyle}"`),
    stroke: () => shape(`fill="none" stroke="${pen.strokeStyle}" stroke-width="${pen.lineWidth}" stroke-linecap="${pen.lineCap}"${pen.getLineDash().length ? ` stroke-dasharray="${pen.getLineDash()}"` : ""}`),
    strokeText: () => {},
    fillText: (what, x, y) => text(what, x, y, `fill="${pen.fillStyle}" stroke="${pen.strokeStyle}" stroke-width="3" paint-order="stroke" style="font: ${pen.font}" dy=".35em" text-anchor="${anchor[pen.textAlign] ?? "start"}"`),
  };
  Object.assign(pen, own);
  scene.redraw();
  for (const x of Object.keys(own)) delete pen[x];
  const drawn = made.splice(0).join("\n");
  told.forEach(([colour, what], i) => text(what, LINE, high + (i + 0.8) * LINE, `fill="${colour}" style="font: 13px Georgia, serif"`));
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">
<rect width="100%" height="100%" fill="${getComputedStyle(document.body).backgroundColor}"/>
<svg width="${width}" height="${high}" stroke-linejoin="round">\n${drawn}\n</svg>\n${made.join("\n")}\n</svg>\n`;
}

/* the same as a canvas, finer than on the screen */
async function pictured(canvas, scene) {
  const image = new Image(), on = document.createElement("canvas");
  image.src = `data:image/svg+xml,${encodeURIComponent(vectors(canvas, scene))}`;
  await image.decode();
  on.width = FINER * canvas.width;
  on.height = on.width * image.height / image.width;
  on.getContext("2d").drawImage(image, 0, 0, on.width, on.height);
  return on;
}

/* a film of what is seen from now on, { stop }, until the motion ends; told(seconds) meanwhile, done(its bytes) at the end */
function filmed(canvas, motion, told, done) {
  const on = painted(canvas, document.createElement("canvas")), parts = [];
  const film = new MediaRecorder(on.captureStream(RATE), { mimeType: "video/webm" });
  const draw = () => {
    if (film.state !== "recording") return;
    painted(canvas, on);
    told(Math.floor((performance.now() - begin) / 1000));
    if (!motion.playing) return setTimeout(stop, LAST);
    requestAnimationFrame(draw);
  };
  film.addEventListener("dataavailable", ({ data }) => parts.push(data));
  film.addEventListener("stop", () => done(new Blob(parts, { type: "video/webm" })));
  const begin = performance.now(), stop = () => film.state === "recording" && film.stop();
  film.start();
  draw();
  setTimeout(stop, LONGEST);
  return { stop };
}

/* the buttons on the stage that save them under a name; words: { picture, film, stop, none }; a line where the browser records nothing */
export function saving(home, name, words) {
  const canvas = home.querySelector(".stage canvas");
  const button = (text, click) => make("button", { type: "button", click }, text);
  const pictures = [
    button(words.picture, async () => (await pictured(canvas, home.motion.scene)).toBlob((blob) => save(`${name}.png`, blob, "image/png"))),
    button("SVG", () => save(`${name}.svg`, vectors(canvas, home.motion.scene), "image/svg+xml")),
  ];
  if (!globalThis.MediaRecorder?.isTypeSupported("video/webm")) return make("div", { class: "saves" }, ...pictures, make("small", {}, words.none));
  let running = null;
  const film = button(words.film, () => {
    if (running) return running.stop();
    const { motion } = home;
    motion.scene.once = true;
    motion.play();
    running = filmed(canvas, motion, (s) => { film.textContent = `● ${s} s, ${words.stop}`; }, (blob) => {
      running = null;
      motion.scene.once = false;
      film.textContent = words.film;
      save(`${name}.webm`, blob, "video/webm");
    });
  });
  return make("div", { class: "saves" }, ...pictures, film);
}
