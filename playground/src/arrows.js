/* The vectors of the answer: its letters and terms, and the legend below it, light their arrow on the body, and are lit by it. */
import { make } from "./dom.js";

export class Arrows {
  #held = 0;

  /* place: of the answer; light(number): what is done when the arrow of a number, from 1, is pointed at, or 0: none is; go(id): to
   * the step of an equation */
  constructor(place, light, go) {
    Object.assign(this, { place, light });
    const number = (e) => Number(e.target.closest("[data-arrow]")?.getAttribute("data-arrow") ?? 0);
    for (const come of ["pointerover", "focusin"]) place.addEventListener(come, (e) => this.#point(number(e)));
    for (const go of ["pointerleave", "focusout"]) place.addEventListener(go, () => this.#point(0));
    place.addEventListener("click", (e) => {
      const n = number(e), to = e.target.closest("[data-to]")?.dataset.to;
      if (to && (e.ctrlKey || e.metaKey || e.shiftKey)) return; // elsewhere
      e.preventDefault();
      if (to && !n) go(to);
      if (n) this.#hold(n === this.#held ? 0 : n);
    });
  }

  /* the answer, [{ id, shown }], the step and the MathML of each equation, and [{ shown, meaning }] of its vectors; address: id → address */
  show(answer, arrows, address) {
    this.arrows = arrows;
    this.#held = 0;
    this.place.replaceChildren(...answer.map(({ id, shown }) => {
      const link = make("a", { href: address(id), "data-to": id });
      link.innerHTML = shown;
      link.setAttribute("aria-label", `${id}: ${link.textContent}`);
      return make("p", {}, link);
    }));
    if (!arrows.length) return;
    // behind the equations in vectors, where many components would hide it
    const last = answer.length > 6 ? answer.findLastIndex(({ id }) => id === answer[0].id) : answer.length - 1;
    this.place.children[last].after(make("ul", { class: "legend" }, ...arrows.map(({ shown, meaning }, i) => {
      const button = make("button", { type: "button", "data-arrow": i + 1, "aria-pressed": "false" });
      button.innerHTML = shown;
      button.append(` ${meaning}`);
      return make("li", {}, button);
    })));
    this.lit(0);
  }

  #point(n) {
    const now = n || this.#held;
    this.lit(now);
    this.light(now);
  }

  /* it stays lit, without a pointer, until it is pressed again */
  #hold(n) {
    this.#held = n;
    for (const x of this.place.querySelectorAll("button")) x.setAttribute("aria-pressed", String(Number(x.dataset.arrow) === n));
    this.#point(n);
  }

  /* the letters, the terms and the entry of an arrow; 0: as they are without one */
  lit(n = 0) {
    const now = n || this.#held;
    for (const x of this.place.querySelectorAll("[data-arrow]")) {
      x.classList.toggle("on", x.getAttribute("data-arrow") === String(now));
    }
  }
}
