/* The playground: the problem on one side, what is derived of it on the other. */
import { the, make, copy } from "./dom.js";
import { editor } from "./editor.js";
import { Engine } from "./engine.js";
import { Equations } from "./equations.js";
import { Form } from "./form.js";
import { asked, packed } from "./link.js";
import { Motion } from "./see.js";
import { Take } from "./take.js";
import { WORDS, inWords } from "./words.js";

const WAIT = 500, SECONDS = 60;
const TABS = ["walk", "see", "take"];
const kept = (name, value) => {
  try {
    if (value === undefined) return localStorage.getItem(name);
    localStorage.setItem(name, value);
  } catch { /* a browser that keeps nothing */ }
  return null;
};

let lang = kept("lang") ?? (navigator.language?.startsWith("fr") ? "fr" : "en");
let words = WORDS[lang] ?? WORDS[lang = "en"];
const [data, css] = await Promise.all([fetch("data.json").then((x) => x.json()), fetch("page.css").then((x) => x.text())]);
const names = data.problems.map((x) => x.name);
const ready = (name) => data.problems.find((x) => x.name === name);

const equations = new Equations(the("walk"), css);
const motion = new Motion(the("see"), () => text);
const engine = typeof WebAssembly === "object" ? new Engine({ seconds: SECONDS, onstate }) : null;
const text = editor(the("editor"), data.schema, words, edited);
const form = new Form(the("form"), data.schema.groups, (made) => { text.text = made; });
const take = new Take(the("take"), data, files, () => ({ name: problem_name(), text: text.text, ready: chosen() }));

let tab = "walk", told = "", walked = null, moved = null, keeping = null, timer = 0, damaged = false;

const problem_name = () => text.text.match(/^\s*name\s*=\s*"([A-Za-z]\w{0,60})"/m)?.[1] ?? "problem";
const chosen = () => names.find((x) => ready(x).text === text.text);

/* ---- what is told */

function say(state) {
  told = state;
  the("state").textContent = state;
}

function onstate() {
  const busy = engine?.busy ?? false;
  the("stop").hidden = the("progress").hidden = !busy;
  the("check").disabled = !engine;
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
  if (how === "late") say(words.late(SECONDS));
  else if (how === "stopped") say(words.stopped);
  else if (how === "broken") athome(words.broken);
  return how === "end";
}

function athome(why) {
  equations.clear(make("p", {}, why), make("pre", {}, `pip install derive-mechanics\nderive walk ${chosen() ?? `${problem_name()}.toml`}`));
  say("");
}

/* ---- what is asked */

async function derive() {
  if (!engine) return athome(words.plain);
  const asking = text.text, begin = performance.now(), found = [];
  let begun = false, fault = false, steps = 0;
  motion.stale();
  say(words.deriving);
  const how = await engine.ask({ ask: "walk", text: asking, lang }, (kind, news) => {
    if (kind === "derived") steps = news.steps;
    else if (kind === "warning") found.push({ message: news, line: 1, severity: "warning" });
    else if (kind === "error") {
      fault = true;
      found.push({ ...news, severity: "error" });
    } else if (kind === "piece") {
      if (!begun) equations.begin(words, lang);
      begun = true;
      equations.write(news);
    } else if (kind === "walked") equations.end();
  });
  if (how === "superseded") return;
  the("walk").removeAttribute("aria-busy");
  if (!begun || fault) equations.clear(make("p", { class: "fault" }, fault ? found.at(-1).message : told));
  faults(damaged ? [{ message: words.damaged, line: 1, severity: "warning" }, ...found] : found);
  walked = null;
  if (!ended(how)) return;
  walked = fault ? null : { text: asking, lang };
  say(fault ? "" : words.derived(steps, ((performance.now() - begin) / 1000).toFixed(1)));
  document.body.dataset.walked = fault ? "fault" : chosen() ?? "own";
  if (!fault && tab === "see") await see();
}

async function check() {
  if (tab !== "walk") show("walk");
  if (!engine || walked?.text !== text.text) return;
  equations.unticked();
  say(words.checking);
  let count = 0, wrong = 0, bound = "", refused = "";
  const how = await engine.ask({ ask: "check", text: text.text }, (kind, news) => {
    if (kind === "error") refused = news.message;
    if (kind !== "verdict") return;
    equations.tick(news);
    if (news.of !== "equation") return;
    if (news.holds) ++count;
    else ++wrong;
    if (Number(news.bound) > Number(bound || 0)) bound = news.bound;
    say(`${words.checking} ${count + wrong}`);
  });
  if (how === "superseded" || !ended(how)) return;
  say(refused || (wrong ? words.failed(wrong) : words.checked(count, bound)));
  document.body.dataset.checked = refused ? "refused" : wrong ? "fails" : "holds";
}

async function see() {
  if (!engine || !walked) return;
  const mark = `${walked.lang} ${walked.text}`;
  if (moved === mark) return keep(mark);
  moved = mark;
  keeping = null;
  motion.clear();
  say(words.emitting);
  const how = await engine.ask({ ask: "motion", text: text.text, lang }, (kind, news) => {
    if (kind === "motion") motion.show(words, lang, news);
    else if (kind === "error") motion.say(`${words.nomotion} ${news.message}`);
  });
  if (how !== "end") moved = null;
  if (!ended(how)) return;
  say("");
  await keep(mark);
}

/* what a motion keeps takes longer to be found, and another library: behind the motion, which does not wait for it */
async function keep(mark) {
  if (keeping === mark || !motion.frame) return;
  keeping = mark;
  say(words.keeping);
  const how = await engine.ask({ ask: "kept", text: text.text, lang }, (kind, news) => {
    if (kind === "kept" && moved === mark) motion.keep(news);
  });
  if (how !== "end" && keeping === mark) keeping = null;
  if (told === words.keeping) say("");
}

async function files(command) {
  if (!engine) return null;
  let found = null;
  say(words.emitting);
  const how = await engine.ask({ ask: "files", text: text.text, words: command }, (kind, news) => {
    if (kind === "files") found = news;
    else if (kind === "error") say(news.message);
  });
  if (how === "end" && !found) return null;
  if (ended(how)) say("");
  return found;
}

/* ---- what changes */

function edited() {
  clearTimeout(timer);
  motion.stale();
  about();
  the("walk").setAttribute("aria-busy", "true");
  timer = setTimeout(async () => {
    moved = null;
    await address(false);
    take.told();
    await derive();
    damaged = false;
  }, WAIT);
}

function about() {
  const name = chosen(), own = ready(name);
  the("about").textContent = own ? own[`about_${lang}`] || own[`title_${lang}`] : "";
  the("ready").value = name ?? "";
}

/* the problem in the address; a step of the history where another one was chosen */
async function address(anew) {
  const name = chosen(), hash = name ? `#${name}` : `#p=${await packed(text.text)}`;
  if (hash === location.hash) return;
  history[anew ? "pushState" : "replaceState"](null, "", hash);
}

async function visit() {
  const found = await asked(location.hash, names);
  damaged = found.damaged ?? false;
  const now = found.text ?? ready(found.name).text;
  if (now !== text.text) text.text = now;
  clearTimeout(timer);
  moved = null;
  about();
  take.told();
  if (!the("form").hidden) await filled();
  await derive();
  damaged = false;
}

function menu() {
  const groups = Map.groupBy?.(data.problems, (x) => x.group) ?? new Map([["", data.problems]]);
  the("ready").replaceChildren(make("option", { value: "" }, words.own),
    ...[...groups].map(([group, list]) => make("optgroup", { label: group || "–" },
      ...list.map((x) => make("option", { value: x.name, title: x[`about_${lang}`] }, `${x.name}: ${x[`title_${lang}`]}`)))));
}

function speak() {
  words = WORDS[lang];
  document.documentElement.lang = lang;
  inWords(words);
  menu();
  about();
  text.inWords(words);
  take.show(words, lang);
  for (const button of document.querySelectorAll("[data-lang]")) button.setAttribute("aria-pressed", String(button.dataset.lang === lang));
}

function show(name) {
  tab = name;
  for (const x of TABS) {
    const at = the(`tab-${x}`);
    at.setAttribute("aria-selected", String(x === name));
    at.tabIndex = x === name ? 0 : -1;
    the(x).hidden = x !== name;
  }
  if (name === "see") see();
}

async function filled() {
  let plain = null;
  await engine?.ask({ ask: "plain", text: text.text }, (kind, news) => { if (kind === "plain") plain = news; });
  form.show(plain, words);
}

async function write(as) {
  const shown = as === "form";
  the("as-form").setAttribute("aria-pressed", String(shown));
  the("as-text").setAttribute("aria-pressed", String(!shown));
  if (shown) await filled();
  the("form").hidden = !shown;
  the("editor").hidden = shown;
}

the("ready").addEventListener("change", async (e) => {
  if (!e.target.value) return;
  text.text = ready(e.target.value).text;
  clearTimeout(timer);
  await address(true);
  await visit();
});
for (const button of document.querySelectorAll("[data-lang]")) {
  button.addEventListener("click", () => {
    lang = button.dataset.lang;
    kept("lang", lang);
    speak();
    moved = null;
    if (!the("form").hidden) filled();
    derive();
  });
}
for (const x of TABS) the(`tab-${x}`).addEventListener("click", () => show(x));
document.querySelector("[role=tablist]").addEventListener("keydown", (e) => {
  const by = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
  if (!by) return;
  show(TABS[(TABS.indexOf(tab) + by + TABS.length) % TABS.length]);
  the(`tab-${tab}`).focus();
});
the("check").addEventListener("click", check);
the("stop").addEventListener("click", () => engine.stop());
the("as-text").addEventListener("click", () => write("text"));
the("as-form").addEventListener("click", () => write("form"));
the("link").addEventListener("click", async (e) => {
  clearTimeout(timer);
  await address(false);
  await copy(location.href, e.target, words.linked);
});
addEventListener("popstate", visit);

speak();
onstate();
if (engine) say(words.loading);
globalThis.play = { engine, text, equations };
navigator.serviceWorker?.register("keep.js").catch(() => {});
await visit();
