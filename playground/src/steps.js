/* The list of the steps of the walk that stands in the page: it shows the one that is read, and goes to others. */
import { make } from "./dom.js";

const TURN = 1500;

export class Steps {
  #last = -Infinity;

  /* go: (id of a step, is it another turn of the same list?) */
  constructor(select, go) {
    this.select = select;
    select.addEventListener("change", () => {
      const now = performance.now(), again = now - this.#last < TURN;
      this.#last = now;
      if (select.value) go(select.value, again);
    });
  }

  /* the steps of a walk, section by section */
  fill(root, words) {
    const option = (article) => {
      const number = article.querySelector(".number")?.textContent.match(/\([\w.]+\)/)?.[0] ?? "";
      const name = article.querySelector("h3 .rule").textContent;
      return make("option", { value: article.id }, `${number} ${name}: ${article.id}`.trim());
    };
    const sections = [...root.querySelectorAll("section[id]")].map((x) =>
      make("optgroup", { label: x.querySelector("h2").textContent }, ...[...x.querySelectorAll("article")].map(option)));
    this.select.replaceChildren(make("option", { value: "" }, `${words.steps} …`), ...sections);
    this.select.hidden = !sections.length;
  }

  get order() { return [...this.select.options].map((x) => x.value); }

  /* the step that is read */
  show(id) {
    this.select.value = this.order.includes(id) ? id : "";
  }
}
