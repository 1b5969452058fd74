/* The motion of the problem, in a frame: a new one for every problem, so that nothing of the last is left. */
import { written } from "./declared.js";
import { make, plainly } from "./dom.js";

/* a mesh as a solid of the body, with a place behind each of its triangles */
const drawn = (faces) => ({ shift: [], vertices: faces.flat(), faces: faces.map((_, k) => [3 * k, 3 * k + 1, 3 * k + 2]), closed: true });

/* what has nothing to move, by its text */
const STILL = { fluid: /^\[fluid\]/m, filter: /^\[kinematics\]/m, family: /^group\s*=\s*"any"/m };
export const still = (text) => Object.keys(STILL).find((x) => STILL[x].test(text));

export class Motion {
  /* text: () → { text }, which takes the numbers that the reader has set; engine: what is asked; say(state, instead) tells, and
   * ended(how) tells an ending other than "end"; lit(number): an arrow of the body is pointed at */
  constructor(place, { text, engine, say, ended, lit }) {
    Object.assign(this, { place, text, engine, say, ended });
    this.unset = [];
    addEventListener("message", ({ data, source, origin }) => {
      if (origin !== location.origin || source !== this.frame?.contentWindow) return;
      if (data.listens) source.postMessage(this.told, location.origin);
      else if (data.fault) this.fail(data.fault);
      else if (data.height) this.frame.style.setProperty("--height", `${data.height}px`);
      else if (data.lit !== undefined) lit(data.lit);
      else if (data.seen) this.heard?.(data.seen);
      else if (data.numbers) this.put(data.numbers, text());
      else Object.assign(this.frame.dataset, data);
      if (data.moved !== undefined) this.project(this.projected);
      this.send();
    });
  }

  /* the motion of a walk, { text, lang }, unless it is there, and then what it keeps */
  async of(walk, words) {
    const mark = `${walk.lang} ${walk.text}`, why = still(walk.text);
    if (this.moved !== mark) {
      this.moved = mark;
      this.keeping = null;
      this.clear();
      this.say(words.emitting);
      const how = await this.engine.ask({ ask: "motion", ...walk }, (kind, news) => {
        if (kind === "motion") this.show(words, walk.lang, news);
        else if (kind === "error" && why) this.clear(make("p", { class: "note" }, words.still[why]));
        else if (kind === "error") this.fail(`${words.nomotion} ${plainly(news.message)}`);
      });
      if (how !== "end") this.forget();
      if (!this.ended(how)) return;
      this.say("");
    }
    await this.seek(mark, walk, words);
  }

  /* what it keeps takes longer to be found, and another library: behind the motion, which does not wait for it */
  async seek(mark, walk, words) {
    if (this.keeping === mark || !this.frame) return;
    this.keeping = mark;
    this.say(words.keeping);
    const how = await this.engine.ask({ ask: "kept", ...walk }, (kind, news) => {
      if (kind === "kept" && this.moved === mark) this.keep(news);
    });
    if (how !== "end" && how !== "late" && this.keeping === mark) this.keeping = null;
    this.say(how === "late" ? words.notkept(this.engine.seconds) : how === "stopped" ? words.stopped : "", words.keeping);
  }

  /* what is seen of it: { t, eye, set }, see link.js; nothing where nothing moves */
  async seen() {
    if (this.frame?.dataset.moved === undefined) return {};
    return new Promise((done) => {
      this.heard = done;
      this.frame.contentWindow.postMessage({ seen: true }, location.origin);
    });
  }

  /* what is to be seen of the next one */
  restore(seen) {
    this.forget();
    this.restored = seen;
  }

  /* light an arrow of the body */
  light(number) { this.frame?.contentWindow?.postMessage({ light: number }, location.origin); }

  /* the body alone, on black, or again with all that is about it */
  project(is) {
    this.projected = is;
    this.frame?.contentWindow?.postMessage({ project: Boolean(is) }, location.origin);
  }

  /* it is made again when it is asked for */
  forget() { this.moved = null; }

  show(words, lang, told) {
    this.words = words;
    this.told = { ...told, lang, title: words.motion, into: words.into, moving: words.moving, restored: this.restored, saves: words.saves };
    const { line, faces } = this.mesh ?? {}, [part] = told.page.body.parts;
    if (line && part && this.text().text.includes(line)) part.solids = [drawn(faces)];
    this.told.name = this.text().text.match(/^\s*name\s*=\s*"(\w+)"/m)?.[1] ?? "motion";
    this.more = this.restored = null;
    this.frame = make("iframe", { src: "moving.html", title: words.motion });
    this.note = make("p", { class: "note", role: "status" }, [...(told.page.pushed ? [words.pushed] : []), ...this.unset].join(" "));
    this.unset = [];
    this.place.replaceChildren(this.note, this.frame);
  }

  /* the numbers set, in the text of the problem, where the frame shows it as it is */
  put(numbers, text) {
    if (this.frame.classList.contains("stale")) return;
    const found = written(text.text, numbers);
    this.unset = found.left.length ? [this.words.left(found.left.join(", "))] : [];
    if (found.text === text.text) this.note.textContent = this.unset.join("");
    else text.text = found.text;
  }

  /* the text is another one, or is wrong: what moves is that of before */
  stale() {
    if (!this.frame || this.frame.classList.contains("stale")) return;
    this.frame.classList.add("stale");
    this.note.textContent = this.words.stale;
  }

  /* what it keeps, which is found behind it */
  keep(told) {
    this.more = { ...told, lang: this.told.lang, title: this.told.title };
    this.send();
  }

  send() {
    if (!this.more || this.frame?.dataset.moved === undefined) return;
    this.frame.contentWindow.postMessage(this.more, location.origin);
    this.more = null;
  }

  fail(text) { this.clear(make("p", { class: "fault" }, text)); }

  clear(...instead) {
    this.frame = null;
    this.place.replaceChildren(...instead);
  }
}
