/* The motion as a picture and as a film: its canvas, on the colour of the page. */
import { make, save } from "./dom.js";

const RATE = 30, LONGEST = 60_000, FINER = 2;

/* what stands on a canvas that lets the page through, on one that does not, and is so much higher */
function painted(canvas, on, more = 0) {
  if (on.width !== canvas.width) on.width = canvas.width;
  if (on.height !== canvas.height + more) on.height = canvas.height + more;
  const pen = on.getContext("2d");
  pen.fillStyle = getComputedStyle(document.body).backgroundColor;
  pen.fillRect(0, 0, on.width, on.height);
  pen.drawImage(canvas, 0, 0);
  return on;
}

/* what stands there, finer than on the screen, and below it what its arrows mean */
function pictured(canvas, { page: { arrows = [], meanings = [] }, colours }) {
  canvas.finer(FINER);
  const sharp = canvas.width / canvas.clientWidth, line = 18 * sharp;
  const on = painted(canvas, document.createElement("canvas"), (meanings.length + 0.5) * line), pen = on.getContext("2d");
  pen.font = `${13 * sharp}px Georgia, serif`;
  meanings.forEach((meaning, i) => {
    pen.fillStyle = colours.read(`arrow-${i + 1}`);
    pen.fillText(`${arrows.find((x) => x.number === i + 1)?.label.replaceAll("_", "")}  ${meaning}`, line, canvas.height + (i + 0.8) * line);
  });
  canvas.finer(1);
  return on;
}

/* a film of what is seen from now on, { stop }; done(its bytes) when it is stopped, or long enough */
function filmed(canvas, done) {
  const on = painted(canvas, document.createElement("canvas")), parts = [];
  const film = new MediaRecorder(on.captureStream(RATE), { mimeType: "video/webm" });
  const draw = () => {
    if (film.state !== "recording") return;
    painted(canvas, on);
    requestAnimationFrame(draw);
  };
  film.addEventListener("dataavailable", ({ data }) => parts.push(data));
  film.addEventListener("stop", () => done(new Blob(parts, { type: "video/webm" })));
  film.start();
  draw();
  const stop = () => film.state === "recording" && film.stop();
  setTimeout(stop, LONGEST);
  return { stop };
}

/* the buttons on the stage that save them under a name; words: { picture, film, stop, none }; a line where the browser records nothing */
export function saving(home, name, words) {
  const canvas = home.querySelector(".stage canvas");
  const picture = make("button", { type: "button", click: () => {
    pictured(canvas, home.motion.scene).toBlob((blob) => save(`${name}.png`, blob, "image/png"));
  } }, words.picture);
  if (!globalThis.MediaRecorder?.isTypeSupported("video/webm")) return make("div", { class: "saves" }, picture, make("small", {}, words.none));
  let running = null;
  const film = make("button", { type: "button", click: () => {
    if (running) return running.stop();
    film.textContent = words.stop;
    running = filmed(canvas, (blob) => {
      running = null;
      film.textContent = words.film;
      save(`${name}.webm`, blob, "video/webm");
    });
    home.motion.play();
  } }, words.film);
  return make("div", { class: "saves" }, picture, film);
}
