/* The walk in a room, a step a screen: what stood before it, why, and what is now; beside the steps of a body, that body. */

/* An element with attributes, listeners and what is in it; texts are never markup. */
export function make(tag, given = {}, ...inside) {
  const made = document.createElement(tag);
  for (const [name, v] of Object.entries(given)) {
    if (typeof v === "function") made.addEventListener(name, v);
    else if (v === true) made.setAttribute(name, "");
    else if (v !== false && v !== undefined) made.setAttribute(name, v);
  }
  made.append(...inside);
  return made;
}

const BEFORE = 2, LEAST = 28, LARGEST = 56;
const BY = { ArrowRight: 1, PageDown: 1, ArrowLeft: -1, PageUp: -1, Home: -Infinity, End: Infinity };

export class Projector {
  #at = 0;
  #steps = [];

  /* place: what is shown; equations: the walk; answer: its last screen, if it has one; words(): those of the page; passed(id): a step is on the
   * screen, or, "", the answer; beside(is): is the body? left(id): it has been left at a step */
  constructor(place, { equations, answer, words, passed, beside, left }) {
    Object.assign(this, { place, equations, answer, words, passed, beside, left });
    [this.head, this.screen, this.foot] = place.children;
    this.told = this.screen.firstElementChild.attachShadow({ mode: "open" });
    this.told.adoptedStyleSheets = equations.root.adoptedStyleSheets;
    const [before, after, leave] = this.foot.querySelectorAll("button");
    before.addEventListener("click", () => this.go(-1));
    after.addEventListener("click", () => this.go(1));
    leave.addEventListener("click", () => this.leave());
    addEventListener("resize", () => this.shown && this.#fit());
  }

  get #last() { return this.#steps.length - (this.answer ? 0 : 1); }

  get shown() { return !this.place.hidden; }

  /* a key that was pressed here, or in the frame of the body; was it for the projector? */
  key(key) {
    if (!this.shown) return false;
    if (key === "Escape" || key === "p") this.leave();
    else if (BY[key]) this.go(BY[key]);
    else return false;
    return true;
  }

  /* show the walk from a step, by default its first, or the answer, its last screen */
  enter(id, last = false) {
    this.#steps = [...this.equations.root.querySelectorAll("article")];
    if (!this.#steps.length) return;
    this.#at = last ? this.#last : Math.max(0, this.#steps.findIndex((x) => x.id === id));
    this.place.hidden = false;
    document.body.classList.add("projecting");
    dark(true);
    this.go(0);
    this.screen.focus();
  }

  leave() {
    if (!this.shown) return;
    this.place.hidden = true;
    document.body.classList.remove("projecting");
    dark(false);
    this.beside(false);
    this.left(this.#steps[this.#at]?.id ?? "");
  }

  /* go on by so many steps, and back by fewer than none */
  go(by) {
    this.#at = Math.max(0, Math.min(this.#last, this.#at + by));
    const step = this.#steps[this.#at], words = this.words();
    const own = this.#steps.at(-1).closest("section"), now = (step ?? this.#steps.at(-1)).closest("section");
    const rule = step ? step.querySelector("h3 .rule").textContent : words.answer;
    const where = words.stepof(this.#at + 1, this.#last + 1);
    this.head.replaceChildren(make("h1", {}, rule), make("span", {}, where), make("span", { class: "from" }, step?.id ?? ""));
    this.told.replaceChildren(...(step ? told(step, this.equations.root, words) : []));
    this.screen.lastElementChild.hidden = Boolean(step);
    if (!step) this.answer(this.screen.lastElementChild);
    this.screen.setAttribute("aria-label", `${where}: ${rule}`);
    this.screen.scrollTop = 0;
    this.beside(own === now);
    this.passed(step?.id ?? "");
    this.#fit();
  }

  /* as large as there is room for, and never too small to be read at the back of a room: what was goes before what is now */
  #fit() {
    const { screen } = this, was = [...this.told.querySelectorAll(".was")], high = () => screen.scrollHeight > screen.clientHeight;
    const boxes = [...this.told.querySelectorAll(".now .wide"), ...screen.querySelectorAll("p"), screen];
    for (const x of was) x.hidden = false;
    for (let size = Math.max(LEAST, Math.min(LARGEST, innerWidth / 20)); size >= LEAST; size -= 4) {
      screen.style.setProperty("--now", `${size}px`);
      if (!high() && boxes.every((x) => x.scrollWidth <= x.clientWidth)) break;
    }
    for (const x of was) x.hidden = high();
  }
}

/* what a screen shows of a step: the equations of the last steps that it uses, its sentence, its own */
function told(step, root, words) {
  const order = [...root.querySelectorAll("article")].map((x) => x.id);
  const used = [...step.querySelectorAll("details a")].map((x) => x.dataset.to ?? x.hash.slice(1)).filter((x) => order.includes(x));
  const before = [...new Set(used)].sort((a, b) => order.indexOf(a) - order.indexOf(b)).slice(-BEFORE);
  const copied = (of) => [...of.children].filter((x) => x.matches(".equations")).map(plain);
  return [
    ...before.map((id) => make("div", { class: "was" }, ...copied(root.getElementById(id)))),
    make("p", { class: "why" }, ...[...step.children].filter((x) => x.matches("p")).slice(0, 1).flatMap((x) => [...plain(x).childNodes])),
    make("div", { class: "now", "aria-label": words.now, role: "group" }, ...copied(step)),
  ];
}

/* a copy without what can be pressed, or is gone to */
function plain(element) {
  const made = element.cloneNode(true);
  for (const x of made.querySelectorAll("[id]")) x.removeAttribute("id");
  for (const x of made.querySelectorAll("button")) x.remove();
  return made;
}

const darkened = new Set();

/* the colours of the dark, whatever the reader's are, or again the reader's */
export function dark(always) {
  for (const rule of [...document.styleSheets].flatMap((x) => [...x.cssRules])) {
    if (rule.media?.mediaText.includes("dark")) darkened.add(rule);
  }
  for (const { media } of darkened) media.mediaText = always ? "all" : "(prefers-color-scheme: dark)";
}
