/* The walk, in a tree of its own with the style of the notes: pieces of markup as they come, ticks, copies. */
import { copies, moved } from "./copies.js";
import { copy, make } from "./dom.js";

/* half the height, in px, that a step has in walk.css until it is laid out */
const LOW = 72;
const MATHML = "http://www.w3.org/1998/Math/MathML";

export class Equations {
  #root;
  #open = null;
  #words;
  #host;
  #bar;
  #taken = null;
  /* what is wider than its box can be moved by keys */
  #seen = new IntersectionObserver((found) => {
    for (const { target } of found) {
      if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    }
  });

  /* bar: what the walk moves under; go: what a link to a step does; says: what a tick tells */
  constructor(host, css, bar, go, says = () => {}) {
    this.#host = host;
    this.#bar = bar;
    this.wanted = go;
    this.says = says;
    this.#root = host.attachShadow({ mode: "open" });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(css);
    this.#root.adoptedStyleSheets = [sheet];
    this.#root.addEventListener("click", (e) => this.#clicked(e));
    this.#root.addEventListener("keydown", (e) => { if (moved(this.#root, e.target.closest("button"), e.key)) e.preventDefault(); });
  }

  get root() { return this.#root; }

  get title() { return this.#root.querySelector("h1")?.textContent ?? ""; }

  /* begin anew; markup that comes in pieces is parsed as a page is that is loading */
  begin(words, lang) {
    this.#seen.disconnect();
    this.#words = words;
    const loading = document.implementation.createHTMLDocument("");
    loading.open();
    loading.write("<!DOCTYPE html><body><div>");
    const place = loading.body.firstChild;
    place.lang = lang;
    this.#root.replaceChildren(place);
    this.#open = loading;
  }

  write(piece) { this.#open.write(piece); }

  end() {
    this.#open.write("</div>");
    this.#open.close();
    this.#open = null;
    for (const wide of this.#root.querySelectorAll(".wide")) this.#seen.observe(wide);
    told(this.#root, this.#words);
    copies(this.#root, this.#words);
  }

  /* let the links in the walk be addresses, which may be opened elsewhere; address: id → address */
  linked(address) {
    for (const link of this.#root.querySelectorAll("a[href^='#']")) {
      link.dataset.to ??= link.getAttribute("href").slice(1);
      link.setAttribute("href", address(link.dataset.to));
    }
  }

  clear(...inside) {
    this.#open = null;
    this.#root.replaceChildren(...inside);
  }

  unticked() { for (const tick of this.#root.querySelectorAll(".tick")) tick.remove(); }

  tick({ id, holds, bound, reason }) {
    const place = this.#root.getElementById(id)?.querySelector("h3 .rule");
    if (!place) return;
    const text = holds ? `✓ < ${power(bound)}` : "✗";
    const title = holds ? this.#words.holds(power(bound)) : `${this.#words.fails}: ${reason}`;
    place.after(" ", make("button", { type: "button", class: holds ? "tick" : "tick wrong", title, "aria-label": title }, text));
  }

  #clicked(e) {
    const link = e.target.closest("a[data-to]"), button = e.target.closest("button");
    if (link && !e.ctrlKey && !e.metaKey && !e.shiftKey) {
      e.preventDefault();
      this.wanted(link.dataset.to);
    } else if (button?.matches(".tick")) {
      this.says(button.title);
    } else if (button?.dataset.tex) {
      copy(button.dataset.tex, button, "✓");
    } else if (button) {
      copy(mathml(button.closest(".equation")), button, "✓");
    }
  }

  /* where the reader is: the step last gone to, until the walk is moved, else the one under the bar, and how far below it that
   * begins; nothing where there is no step */
  at() {
    if (this.#open) return null;
    const edge = this.#edge(), taken = this.#taken;
    if (taken?.place.isConnected && Math.abs(this.#below(taken.place) - taken.by) < 2) return { id: taken.place.id, by: taken.by };
    for (const step of this.#root.querySelectorAll("header, article")) {
      const { top, bottom } = step.getBoundingClientRect();
      if (bottom > edge + 1) return { id: step.id, by: Math.round(top - edge) };
    }
    return null;
  }

  /* Go to where at() was, by default the beginning. The steps about it are laid out first, as far as two screens: their heights,
   * which come some frames later else, would move it. */
  back({ id, by }) {
    if (!id && by === undefined) return this.#scrolls().scrollTo(0, 0);
    const place = id ? this.#root.getElementById(id) : this.#root.querySelector("header");
    if (!place) return;
    const steps = [...this.#root.querySelectorAll("article")], k = steps.indexOf(place), about = Math.ceil(innerHeight / LOW);
    for (const x of steps.slice(Math.max(0, k - about), k + about)) x.classList.add("near");
    place.scrollIntoView({ block: "start", behavior: "instant" });
    this.#scrolls().scrollBy(0, this.#below(place) - by);
    this.#taken = id ? { place, by: this.#below(place) } : null;
  }

  /* go to a step, and mark it; is there such a one? */
  go(id) {
    const place = this.#root.getElementById(id);
    if (!place) return false;
    this.back({ id, by: 0 });
    for (const marked of this.#root.querySelectorAll(".aimed")) marked.classList.remove("aimed");
    place.classList.add("aimed");
    place.tabIndex = -1;
    place.focus({ preventScroll: true });
    return true;
  }

  #below(place) { return Math.round(place.getBoundingClientRect().top - this.#edge()); }

  #edge() { return Math.max(0, this.#bar.getBoundingClientRect().bottom); }

  /* on a phone the page is moved, else the walk in it */
  #scrolls() { return getComputedStyle(this.#host).overflowY === "visible" ? window : this.#host; }
}

/* a number as a power of ten: 9e-38 */
export function power(text) {
  const [digits, exponent] = String(text).split("e");
  const raised = (x) => [...x].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)])).join("");
  return exponent ? `${digits} × 10${raised(exponent.replace("+", ""))}` : digits;
}

/* "(26)*" at a step that has no correction: a link to the step that has it, or to the page of all */
function told(root, words) {
  const corrected = new Map();
  for (const step of root.querySelectorAll("article")) {
    const printed = step.querySelector(".printed");
    const found = printed?.lastChild?.textContent.match(/\(\d+\)\*/g) ?? [];
    const own = step.querySelector(".correction");
    for (const number of found) {
      if (own && !corrected.has(number)) corrected.set(number, step.id);
      const to = own && corrected.get(number) === step.id ? "" : corrected.get(number);
      if (to === "") continue;
      const link = make("a", { href: to ? `#${to}` : "../trust.html#the-print-of-the-note", title: words.corrected }, "*");
      link.setAttribute("aria-label", `${words.corrected} ${number.slice(0, -1)}`);
      const text = [...printed.childNodes].find((x) => x.nodeType === 3 && x.data.includes(number));
      if (!text) continue;
      const rest = text.splitText(text.data.indexOf(number) + number.length - 1);
      rest.data = rest.data.slice(1);
      rest.before(link);
    }
  }
}

/* one equation as one formula, which needs no style of this page */
export function mathml(equation) {
  const parts = [...equation.querySelectorAll("math")].filter((x) => !x.closest("button"));
  const inside = parts.map((x) => `${x.closest(".clause") ? '<mspace width="1em"></mspace>' : ""}<mrow>${barred(x).innerHTML}</mrow>`);
  return `<math xmlns="${MATHML}" display="block">${inside.join("").replaceAll("&nbsp;", "&#160;")}</math>`;
}

/* a formula whose bars are accents, not borders */
function barred(math) {
  const plain = math.cloneNode(true);
  const element = (name, attributes, ...within) => {
    const made = document.createElementNS(MATHML, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...within);
    return made;
  };
  for (const row of plain.querySelectorAll(".overline")) {
    row.replaceWith(element("mover", { accent: "true" }, element("mrow", {}, ...row.childNodes), element("mo", { stretchy: "true" }, "‾")));
  }
  return plain;
}
