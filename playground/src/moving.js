/* In a frame whose policy lets nothing be fetched: the emitted module, as a blob, and what moves the body by it.
 * The page about it is told how high it is, and the numbers that the reader has set. */
import { dark } from "./dom.js";
import { saving } from "./pictures.js";

const chosen = (pieces) => Object.fromEntries(Object.entries(pieces).map(([x, name]) => [x, globalThis.drawing[name]]));
const tell = (news) => parent.postMessage(news, location.origin);

/* the numbers that are not those of the file: all of the velocity where one of it is; the inputs stand in [initial], too */
function numbers({ given }, page, { PARAMETERS, INPUTS }) {
  const told = (list, all) => Object.fromEntries(list.filter(([, now, was]) => all || now !== was).map(([name, now]) => [name, now]));
  const start = page.adjusted.map((s) => [page.names[s], given.x[s], page.x[s]]);
  return {
    initial: {
      ...told(start, page.pushed || start.some(([, now, was]) => now !== was)),
      ...told(INPUTS.map((name, i) => [name, given.u[i], page.u[i]]), false),
    },
    parameters: told(PARAMETERS.map((name, i) => [name, given.p[i], page.p[i]]), false),
    exp: given.theta.some((a) => a !== 0) ? [...given.theta] : [],
  };
}

/* the rows of the numbers, what each says, and said first */
const rows = () => [...document.querySelectorAll(".values .adjuster")];
const said = (row) => row.querySelector("[role=slider]").getAttribute("aria-valuenow");
let first = new Map();

/* what is seen: the time, until when it goes, the second motion, the camera where there is one, the numbers that have been set */
function seen({ time, until, second, scene: { eye, within, page } }) {
  const set = rows().map((x) => [x.dataset.name, said(x)]).filter(([name, v]) => v !== first.get(name));
  return { t: time, ...(until > page.t && { until }), ...(second?.told && { second: second.told }), ...(eye && { eye: [eye.azimuth, eye.elevation, eye.zoom] }), ...(within && { within }), set: Object.fromEntries(set) };
}

/* and is seen again, at rest: numbers are put in as the reader types them */
function restore({ t, until, second, eye, within, set = {} }, motion) {
  for (const row of rows().filter((x) => Object.hasOwn(set, x.dataset.name))) {
    const box = row.querySelector("input");
    box.value = set[row.dataset.name];
    box.dispatchEvent(new Event("change"));
  }
  if (eye && motion.scene.eye) {
    const [azimuth, elevation, zoom] = eye;
    Object.assign(motion.scene.eye, { azimuth, elevation: Math.max(-1.55, Math.min(Math.PI / 2, elevation)), zoom: Math.max(0.1, Math.min(20, zoom)) });
  }
  if (within) document.querySelector(".controls > .within input")?.click();
  if (second && motion.second) motion.second.told = second;
  if (Math.max(until ?? 0, t ?? 0) > motion.until) motion.until = Math.max(until ?? 0, t ?? 0);
  if (t !== undefined) motion.seek(t);
}

/* the arrow of a number is pointed at, elsewhere in the page */
function lit(number) {
  const { motion } = document.getElementById("motion");
  if (!motion) return;
  motion.scene.lit = number;
  motion.scene.ask();
}

/* the body alone, on black, or again with all that is about it */
function project(is) {
  document.documentElement.classList.toggle("projected", is);
  dark(is);
  const { motion } = document.getElementById("motion");
  if (!motion) return;
  motion.scene.large = is ? 1.7 : 1;
  motion.recolour();
}

/* a file that is dropped here is dropped on the page, and a key that does nothing here is one for the page */
for (const kind of ["keydown", "dragover", "drop"]) addEventListener(kind, (e) => {
  if (e.defaultPrevented || e.key && e.target.closest("input, select")) return;
  if (!parent.document.body.dispatchEvent(new e.constructor(kind, e))) e.preventDefault();
});

addEventListener("message", async ({ data, source, origin }) => {
  if (source !== parent || origin !== location.origin) return;
  if (data.light !== undefined) lit(data.light);
  if (data.project !== undefined) project(data.project);
  if (data.seen) tell({ seen: seen(document.getElementById("motion").motion) });
  if (!data.source) return;
  document.documentElement.lang = data.lang;
  document.title = document.querySelector("h1").textContent = data.title;
  const url = URL.createObjectURL(new Blob([data.source], { type: "text/javascript" }));
  try {
    const emitted = await import(url), { driven, mount } = globalThis.drawing;
    const module = data.page?.signals ? driven(emitted, data.page) : emitted;
    const home = document.getElementById("motion");
    if (data.kept) {
      home.motion.keep(module, data.kept);
      tell({ kept: "" });
      return;
    }
    home.replaceChildren();
    home.motion = mount(home, { ...data.page, ...data.moving, repeats: true, module, pointed: (lit) => tell({ lit }) }, { ...chosen(data.pieces), graph: globalThis.drawing.graph, second: globalThis.drawing.second_motion });
    const into = document.createElement("button");
    Object.assign(into, { type: "button", className: "into", textContent: data.into });
    into.addEventListener("click", () => tell({ numbers: numbers(home.motion, data.page, module) }));
    home.querySelector(".values").append(into);
    home.querySelector(".controls").append(saving(home, data.name, data.saves));
    first = new Map(rows().map((x) => [x.dataset.name, said(x)]));
    if (data.restored) restore(data.restored, home.motion);
    tell({ moved: "" });
    new ResizeObserver(() => tell({ height: home.scrollHeight })).observe(home);
  } catch (e) {
    tell({ fault: String(e) });
  } finally {
    URL.revokeObjectURL(url);
  }
});
tell({ listens: true });
