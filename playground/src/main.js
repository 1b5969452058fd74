/* The playground: the problem on one side, what is derived of it on the other. */
import { Arrows } from "./arrows.js";
import { copy, kept, make, plainly, the } from "./dom.js";
import { editor } from "./editor.js";
import { Engine } from "./engine.js";
import { Equations, power } from "./equations.js";
import { Form } from "./form.js";
import { Gallery, menu } from "./gallery.js";
import { Places } from "./history.js";
import { Found } from "./found.js";
import { TABS, asked, option, spoken, tabbed } from "./link.js";
import { meshed, stated } from "./made.js";
import { opens } from "./opened.js";
import { Motion, still } from "./see.js";
import { Projector } from "../../templates/html/projector.js";
import { Road } from "./road.js";
import { Sentence } from "./sentence.js";
import { Steps } from "./steps.js";
import { Tabs } from "./tabs.js";
import { Take } from "./take.js";
import { WORDS, inWords } from "./words.js";

const WAIT = 500, MOVED = 150, SECONDS = 60, TRIANGLES = 6000;

let lang = spoken(location.search) ?? kept("lang") ?? (navigator.language?.startsWith("fr") ? "fr" : "en");
let words = WORDS[lang] ?? WORDS[lang = "en"];
const [data, css] = await Promise.all([fetch("data.json").then((x) => x.json()), fetch("page.css").then((x) => x.text())]);
for (const x of Object.keys(WORDS)) Object.assign(WORDS[x], data.spoken[x]);
const formulas = new CSSStyleSheet(); // those beside the walk are set as those in it
formulas.replaceSync(css.match(/^(math|mover|mtable|\.(overline|kept|bold|parameter))\b.*$/gm).join(""));
document.adoptedStyleSheets = [formulas];
const names = data.problems.map((x) => x.name);
const ready = (name) => data.problems.find((x) => x.name === name);

const equations = new Equations(the("walk"), css, document.querySelector(".read .bar"), (id) => go(id), (meaning) => say(meaning));
const places = new Places(equations);
const steps = new Steps(the("steps"), (id, again) => go(id, again));
const engine = new Engine({
  seconds: SECONDS, onstate, onbegin: () => say(words.loading), stored,
  onlate: ({ ask }) => ask !== "kept" && confirm(words.slow(told, engine.seconds)),
});
const motion = new Motion(the("see"), { text: () => text, engine, say, ended, lit: (number) => arrows.lit(number) });
const arrows = new Arrows(the("answer").lastElementChild, (number) => motion.light(number), (id) => go(id));
const text = editor(the("editor"), data.schema, words, edited);
const faces = { form: Form, sentence: Sentence };
for (const [x, Face] of Object.entries(faces)) faces[x] = new Face(the(x), data.schema, (made) => { text.text = made; });
/* the face of the problem that is seen in the place of its text */
const face = () => Object.keys(faces).find((x) => !the(x).hidden);
const projector = new Projector(the("projector"), {
  equations, words: () => words,
  answer: (place) => { place.innerHTML = arrows.place.innerHTML; },
  passed: (id) => {
    places.step(lang, chosen() ?? places.word, id, true, { projected: id ? "" : "answer" });
    road.here(id || steps.order.at(-1), steps.order, false);
  },
  beside: (is) => {
    is &&= !still(text.text); // which has no body
    document.body.classList.toggle("beside", is);
    motion.project(is);
    if (is && tabs.now !== "see") see();
  },
  left: (id) => {
    if (id) return go(id, true);
    places.step(lang, chosen() ?? places.word, "", true);
    tabs.show("see");
  },
});
const road = new Road(the("road").firstElementChild, (id) => {
  if (id && projector.shown) return projector.enter(id);
  projector.leave();
  if (id) go(id);
  else tabs.show("take");
});
const take = new Take(the("take"), data, {
  ask: files, reasons, file: () => ({ name: problem_name(), text: text.text, title: equations.title || problem_name(), ready: chosen() }),
});
const searches = new Found(the("find"), css, document.querySelector(".read .bar"), {
  go: (id) => go(id),
  ask: async (what, asking, heard) => {
    say(words.searching);
    const how = await engine.ask({ ask: "found", what, ...asking }, heard);
    if (ended(how)) say("");
    return how;
  },
});
const gallery = new Gallery(the("gallery"), { problems: data.problems, chosen: () => chosen(), choose: (now) => choose(now) });
const tabs = new Tabs(TABS, (name) => {
  the("steps").parentElement.hidden = name !== "walk";
  const below = the(name).getBoundingClientRect().top - document.querySelector(".read .bar").getBoundingClientRect().bottom;
  if (below < 0 && name === "walk" && places.left) equations.back(places.left);
  else if (below < 0) scrollBy(0, below); // on a phone the page is moved
  places.shows(lang, chosen() ?? places.word, name);
  passed();
  opened();
});
/* what the tab that is seen makes of the walk that stands */
const opened = () => ({ see, find, lecture, take: () => walked && take.opened() })[tabs.now]?.();

async function unzipped(file) {
  const found = await fetch(file);
  if (!found.ok) return null;
  const told = await new Response(found.body.pipeThrough(new DecompressionStream("gzip"))).json();
  const source = told.motion?.find(([kind]) => kind === "motion")?.[1].source;
  for (const [kind, news] of told.kept ?? []) if (kind === "kept") news.source = source; // it stands once
  return told;
}

/* the news of a ready-made problem that were made with the page, by its name and language */
const made = new Map();
async function stored({ ask, text: asking, lang: spoken, words: command, zip }) {
  const name = names.find((x) => ready(x).text === asking), code = ask === "files";
  if (!name || zip || !(code ? command === data.emission : ["walk", "motion", "kept"].includes(ask))) return null;
  const file = `ready/${name}.${code ? "code" : spoken}.json.gz`;
  if (!made.has(file)) made.set(file, unzipped(file).catch(() => null));
  return (await made.get(file))?.[ask] ?? null;
}

/* what is derived: the text and language of the walk that stands, the walk that runs; is a check to follow? */
let walked = null, running = null, wanted = false;
/* what changed: when it will be derived; what is wrong with the address; where to go in the next walk */
let timer = 0, notice = "", aim = null;
let told = "";

const problem_name = () => text.text.match(/^\s*name\s*=\s*"([A-Za-z]\w{0,60})"/m)?.[1] ?? "problem";
const file = () => chosen() ?? `${problem_name()}.toml`; // as a command has it
const chosen = () => names.find((x) => ready(x).text === text.text);
const address = (id) => `#${chosen() ?? places.word}/${encodeURIComponent(id)}`;

/* ---- what is told */

/* instead of what is told now, or of another text alone */
function say(state, instead = told) {
  if (told !== instead) return;
  told = state;
  the("state").textContent = state;
}

function onstate() {
  const { busy } = engine;
  the("stop").hidden = the("progress").hidden = !busy;
  if (!busy) setTimeout(() => take.weigh()); // behind a question that waits
}

function faults(list) {
  text.show(list);
  the("errors").replaceChildren(...list.map(({ message, line, severity }) => {
    const go = make("button", { type: "button", class: "quiet", click: () => text.go(line) }, words.line(line));
    return make("p", { class: severity }, ...(severity === "error" ? [go, " "] : []), message);
  }));
}

/* what an ending other than "end" says */
function ended(how) {
  if (how === "late") say(words.late(engine.seconds));
  else if (how === "stopped") say(words.stopped);
  else if (how === "broken") athome(typeof WebAssembly === "object" ? words.broken : words.plain);
  return how === "end";
}

/* the equations of motion, at the head of what is derived */
function answer(equations, vectors = []) {
  the("answer").hidden = !equations.length;
  if (!equations.length) road.show([]);
  arrows.show(equations, vectors, address);
}

function athome(why) {
  answer([]);
  if (tabs.now !== "walk") tabs.show("walk");
  equations.clear(make("p", {}, why), make("pre", {}, `${words.install}\nderive walk ${file()}`));
  say("");
}

/* ---- what is asked */

/* derive what is written; a check that was asked for meanwhile follows */
async function derive() {
  const run = running = walk();
  const how = await run;
  if (running !== run) return;
  running = null;
  if (how === "superseded" && !timer) return derive();
  if (timer || !walked) return;
  if (wanted) {
    wanted = false;
    await check();
  } else await opened();
}

async function walk() {
  const asking = text.text, begin = performance.now(), found = [];
  const here = equations.at();
  let begun = false, fault = false, count = 0;
  if (here?.id) aim ??= here;
  motion.stale();
  say(wanted ? words.queued : words.deriving);
  const how = await engine.ask({ ask: "walk", text: asking, lang }, (kind, news) => {
    if (kind === "derived") {
      count = news.steps;
      the("about").textContent = news.about;
      answer(news.answer, news.arrows);
      road.show(news.road, words, news.name);
    }
    else if (kind === "warning") found.push({ line: 1, ...(news.message ? news : { message: news }), severity: "warning" });
    else if (kind === "error") {
      fault = true;
      found.push({ ...news, severity: "error" });
    } else if (kind === "piece") {
      if (!begun) equations.begin(words, lang);
      begun = true;
      equations.write(news);
    } else if (kind === "walked") equations.end();
  });
  if (how === "superseded") return how;
  the("walk").removeAttribute("aria-busy");
  if (!begun || fault) answer([]);
  if (!begun || fault) equations.clear(make("p", { class: "fault" }, fault ? found.at(-1).message : told));
  if (fault && tabs.now === "see" && !motion.frame) tabs.show("walk"); // which says it
  faults(notice ? [{ message: notice, line: 1, severity: "warning" }, ...found] : found);
  notice = "";
  walked = null;
  if (ended(how) && !fault) {
    walked = { text: asking, lang };
    say(words.derived(count, ((performance.now() - begin) / 1000).toFixed(1)));
    stands();
  } else {
    if (how === "end") say("");
    wanted = false;
    steps.fill(equations.root, words);
  }
  if (how === "end") document.body.dataset.walked = fault ? "fault" : chosen() ?? "own";
  return how;
}

/* the walk of the address stands in the page: its steps are links, and listed, and the reader is taken to one of them */
function stands() {
  const to = aim;
  equations.linked(address);
  steps.fill(equations.root, words);
  places.stands = true;
  aim = null;
  if (to?.step && !equations.go(to.step)) say(words.nostep(to.step));
  else if (to && !to.step) equations.back(to);
  passed();
  if (to?.projected !== undefined) projector.enter(places.named, to.projected === "answer");
}

async function check() {
  if (tabs.now !== "walk") tabs.show("walk");
  if (running || timer) {
    wanted = true;
    say(words.queued);
    return;
  }
  if (walked?.text !== text.text) return say(words.unfit);
  equations.unticked();
  road.unticked();
  say(words.checking);
  let count = 0, wrong = 0, bound = "", refused = "";
  const how = await engine.ask({ ask: "check", text: text.text }, (kind, news) => {
    if (kind === "error") refused = news.message;
    if (kind !== "verdict") return;
    equations.tick(news);
    road.tick(news);
    if (news.of !== "equation") return;
    if (news.holds) ++count;
    else ++wrong;
    if (Number(news.bound) > Number(bound || 0)) bound = news.bound;
    say(`${words.checking} ${words.stepof(count + wrong, steps.order.length - 1)}`);
  });
  if (how === "superseded" || !ended(how)) return;
  say(refused || (wrong ? words.failed(wrong) : words.checked(count, power(bound))));
  document.body.dataset.checked = refused ? "refused" : wrong ? "fails" : "holds";
}

async function see() {
  if (walked && !running && !timer) await motion.of(walked, words);
}

async function find() {
  if (walked && !running && !timer) await searches.of(walked, words, file());
}

/* the course in the language of the page, fetched when it is seen, and the command for a chapter on the problem */
function lecture() {
  const page = `lecture.${lang}.html`, [about, frame] = the("lecture").children;
  about.firstElementChild.href = page;
  about.lastElementChild.textContent = `derive lecture ${file()} --out ${problem_name()}.html${option(lang)}`;
  if (frame.getAttribute("src") !== page) frame.setAttribute("src", page);
}

/* the files of a command, { files: name → text, start: name → number }, with what else they are in a zip, or what it { refused }; behind a walk that runs */
async function files(command, zip) {
  let refused = "";
  const found = {};
  await running;
  say(words.emitting);
  const how = await engine.ask({ ask: "files", text: text.text, words: command, zip }, (kind, news) => {
    if (kind === "error") refused = plainly(news.message);
    else if (["files", "start", "zip"].includes(kind)) found[kind] = news;
  });
  if (ended(how)) say("");
  else refused = how === "superseded" ? words.overtaken : told;
  return found.files ? found : { refused };
}

/* why options of the code cannot be added to others; null while something else is asked, or is to be derived */
async function reasons(command) {
  if (tabs.now !== "take" || engine.busy || walked?.text !== text.text) return null;
  let found = null;
  await engine.ask({ ask: "refused", text: walked.text, words: command }, (kind, news) => { if (kind === "refused") found = news; });
  return found;
}

/* ---- what changes */

function later(does, after) {
  clearTimeout(timer);
  timer = does ? setTimeout(() => {
    timer = 0;
    does();
  }, after) : 0;
}

function edited() {
  motion.stale();
  about();
  the("taken").replaceChildren();
  the("walk").setAttribute("aria-busy", "true");
  later(async () => {
    motion.forget();
    await places.problem(lang, chosen(), text.text);
    take.told();
    await derive();
  }, WAIT);
}

function about() { the("ready").value = chosen() ?? ""; }

/* go to a step, which gets an entry of its own in the history; `again`: in the place of the last one's */
function go(id, again = false) {
  places.step(lang, chosen() ?? places.word, id, again);
  if (tabs.now !== "walk") tabs.show("walk");
  equations.go(id);
  passed();
}

/* show what the address asks for, in a tab, at the place that it was left at, if it was */
async function visit(tab) {
  const where = location.href, found = await asked(location.hash, names), asks = spoken(location.search);
  if (location.href !== where) return; // the reader went on meanwhile, to what another visit shows
  notice = found.damaged ? words.damaged : found.missing !== undefined ? words.missing(found.missing) : "";
  if (asks in WORDS && asks !== lang) {
    lang = asks;
    speak();
  }
  const now = found.text ?? ready(found.name).text;
  aim = { ...places.aim(found.step), projected: found.seen.projected };
  places.stands &&= Boolean(notice);
  if (!notice) places.see(lang, found.name ?? places.word, found.step, found.seen);
  tab ??= found.seen.tab ?? (still(now) ? "walk" : tabbed(found.step));
  if (tab === "see") motion.restore(found.seen);
  if (now === walked?.text && now === text.text && lang === walked.lang && !notice) {
    later(null);
    stands();
    tabs.show(tab);
    return;
  }
  places.stands = false;
  if (now !== text.text) text.text = now;
  walked = null;
  tabs.show(tab);
  later(null);
  motion.forget();
  about();
  take.told();
  faces[face()]?.show(words);
  await derive();
}

/* another problem, in an entry of its own, and in a tab, by default that of its address */
async function choose(now, tab) {
  places.keep();
  text.text = now;
  later(null);
  await places.problem(lang, chosen(), now, true);
  await visit(tab === "see" && still(now) ? "walk" : tab);
}

/* a mesh becomes the body, until that is undone; one of many triangles is drawn as the ellipsoid of its inertia */
function embody(mesh, file) {
  const before = text.text, line = stated(mesh), many = mesh.faces.length > TRIANGLES;
  motion.mesh = many ? null : { line, faces: mesh.faces };
  choose(meshed(before, line, data.schema, file), "see");
  const undo = make("button", { type: "button", click: () => choose(before, tabs.now) }, words.undo);
  the("taken").replaceChildren(words.taken(file, many), " ", undo);
}

function speak() {
  words = WORDS[lang];
  document.documentElement.lang = lang;
  inWords(words);
  menu(the("ready"), data.problems, words, lang);
  about();
  text.inWords(words);
  take.show(words, lang);
  for (const button of document.querySelectorAll("[data-lang]")) button.setAttribute("aria-pressed", String(button.dataset.lang === lang));
}

function write(as) {
  for (const x of ["text", ...Object.keys(faces)]) {
    the(`as-${x}`).setAttribute("aria-pressed", String(x === as));
    the(x === "text" ? "editor" : x).hidden = x !== as;
  }
  faces[as]?.show(words);
}

function widen(wide) {
  const at = equations.at();
  document.body.classList.toggle("wide", wide);
  the("wide").setAttribute("aria-pressed", String(wide));
  kept("wide", wide ? "yes" : "");
  if (at?.id) equations.back(at);
}

the("ready").addEventListener("change", (e) => choose(e.target.value ? ready(e.target.value).text : data.schema.scaffold, still(text.text) ? undefined : tabs.now));
for (const button of document.querySelectorAll("[data-lang]")) {
  button.addEventListener("click", async () => {
    lang = button.dataset.lang;
    kept("lang", lang);
    speak();
    motion.forget();
    await places.problem(lang, chosen(), text.text);
    faces[face()]?.show(words);
    derive();
  });
}
the("things").addEventListener("click", () => gallery.open(words, lang));
the("check").addEventListener("click", check);
the("stop").addEventListener("click", () => {
  wanted = false;
  engine.stop();
});
for (const x of ["text", ...Object.keys(faces)]) the(`as-${x}`).addEventListener("click", () => write(x));
the("link").addEventListener("click", async (e) => {
  await places.problem(lang, chosen(), text.text);
  const seen = tabs.now === "see" ? await motion.seen() : {};
  places.see(lang, places.word, places.named, { tab: tabs.now, ...seen });
  await copy(location.href, e.target, words.linked);
});
opens(the("open"), { open: (now) => choose(now), body: embody, say: (line) => say(line), words: () => words });
the("wide").addEventListener("click", () => widen(!document.body.classList.contains("wide")));
const project = () => places.stands && projector.enter(tabs.now === "walk" ? equations.at()?.id : places.named);
the("project").addEventListener("click", project);
addEventListener("keydown", (e) => {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  if (projector.key(e.key)) e.preventDefault();
  else if (e.key === "F8") {
    e.preventDefault();
    the("wide").click();
  } else if (e.target.closest("input, select, textarea, [contenteditable], dialog")) return;
  else if (e.key === "p") project();
  else if (e.key === "Escape") the(`tab-${tabs.now}`).focus(); // from among the stops of a walk
});
addEventListener("popstate", () => visit());

/* what is read now, a while after the reader stopped moving */
function passed() {
  const at = places.stands && equations.at();
  if (at) steps.show(at.id);
  if (at) places.keep();
  road.here(steps.select.value, steps.order, tabs.now === "take");
}
let resting = 0;
addEventListener("scroll", () => {
  clearTimeout(resting);
  resting = setTimeout(passed, MOVED);
}, true);

widen(kept("wide") === "yes");
speak();
onstate();
globalThis.play = { engine, text, equations };
navigator.serviceWorker?.register("keep.js").catch(() => {});
await visit();
