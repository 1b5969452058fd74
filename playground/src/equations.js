/* The walk, in a tree of its own with the style of the notes: pieces of markup as they come, ticks, copies. */
import { copy, make } from "./dom.js";

const MATHML = "http://www.w3.org/1998/Math/MathML";

const STYLE = `
:host { display: block; overflow-wrap: break-word; font: 1.0625rem/1.55 Charter, "Bitstream Charter", "Sitka Text", Cambria, Georgia, serif; }
article { content-visibility: auto; contain-intrinsic-size: auto 9rem; }
.tick { color: var(--right); font-size: .85rem; font-weight: 400; }
.tick.wrong { color: var(--wrong); }
button { opacity: 1; min-height: 24px; min-width: 24px; }
h1:first-child { margin-top: 0; }
a { text-decoration: underline; text-underline-offset: .15em; text-decoration-thickness: from-font; }
a:focus-visible, button:focus-visible, summary:focus-visible { outline: 2px solid var(--mark); outline-offset: 1px; }
@media (min-width: 68rem) { .printed { position: static; width: auto; } .printed > span { display: inline; } }
`;

export class Equations {
  #root;
  #open = null;
  #words;
  /* what is wider than its box can be moved by keys */
  #seen = new IntersectionObserver((found) => {
    for (const { target } of found) {
      if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    }
  });

  constructor(host, css) {
    this.#root = host.attachShadow({ mode: "open" });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(css + STYLE);
    this.#root.adoptedStyleSheets = [sheet];
    this.#root.addEventListener("click", (e) => this.#clicked(e));
  }

  get root() { return this.#root; }

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

  write(piece) {
    this.#open.write(piece);
  }

  end() {
    this.#open.write("</div>");
    this.#open.close();
    this.#open = null;
    for (const summary of this.#root.querySelectorAll("summary")) unlinked(summary);
    for (const wide of this.#root.querySelectorAll(".wide")) this.#seen.observe(wide);
    for (const button of this.#root.querySelectorAll("button[data-tex]")) {
      button.setAttribute("aria-label", `${this.#words.tex} ${button.parentElement.textContent.trim()}`);
      const other = make("button", { type: "button", title: this.#words.mathml }, "MathML");
      other.setAttribute("aria-label", `${this.#words.mathml} ${button.parentElement.textContent.trim()}`);
      button.after(" ", other);
    }
  }

  clear(...inside) {
    this.#open = null;
    this.#root.replaceChildren(...inside);
  }

  unticked() {
    for (const tick of this.#root.querySelectorAll(".tick")) tick.remove();
  }

  tick({ id, holds, bound, reason }) {
    const place = this.#root.getElementById(id)?.querySelector("h3 .rule");
    if (!place) return;
    const text = holds ? `✓ < ${bound}` : "✗";
    const title = holds ? this.#words.holds(bound) : `${this.#words.fails}: ${reason}`;
    place.after(" ", make("span", { class: holds ? "tick" : "tick wrong", title }, text));
  }

  #clicked(e) {
    const link = e.target.closest("a[href^='#']"), button = e.target.closest("button");
    if (link) {
      e.preventDefault();
      this.go(link.getAttribute("href").slice(1));
    } else if (button?.dataset.tex) {
      copy(button.dataset.tex, button, "✓");
    } else if (button) {
      copy(mathml(button.closest(".equation")), button, "✓");
    }
  }

  go(id) {
    const place = this.#root.getElementById(id);
    if (!place) return;
    place.scrollIntoView({ block: "start" });
    place.tabIndex = -1;
    place.focus({ preventScroll: true });
  }
}

/* the links of a summary, which opens and shuts, stand in what it opens */
function unlinked(summary) {
  const links = [...summary.querySelectorAll("a")];
  if (!links.length) return;
  const list = make("p", { class: "note" });
  for (const link of links) {
    link.replaceWith(link.textContent);
    list.append(link, " ");
  }
  summary.after(list);
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
