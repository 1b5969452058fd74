/* The road to the equations in a few stations, at the foot of the page: each with its formula leads to its step, the last one
 * to the code. */
import { power } from "./equations.js";
import { make } from "./dom.js";

export class Road {
  #buttons = [];

  /* go(id): what a station does, of a step or, "", of the code */
  constructor(place, go) {
    Object.assign(this, { place, go });
  }

  /* stations: [{ name, id, shown, paper }] as the record has them; name: of what is moved by the code */
  show(stations, words, name) {
    this.place.parentElement.hidden = !stations.length;
    if (!stations.length) return;
    this.words = words;
    const code = { name: "code", id: "", shown: `<code>${name}_rhs(t, x, k, …)</code>`, paper: words.codein };
    const all = stations.some((x) => x.name === "body") ? [...stations, code] : stations;
    let count = 0;
    this.#buttons = all.map(({ name: place, id, shown, paper }) => {
      const told = place === "kept" ? words.road.kept : `${++count} ${words.road[place]}`;
      const button = make("button", { type: "button", class: place, "data-to": id, click: () => this.go(id) }, make("b", {}, told), make("span", { class: "formula" }), make("small", {}, paper || id));
      button.children[1].innerHTML = shown;
      return button;
    });
    this.place.replaceChildren(...this.#buttons.map((x) => make("li", {}, x)));
    for (const x of stations) if (x.bound) this.tick(x); // those of what was made with the page
  }

  /* the step that is read: the stations that are behind it, of all the steps in their order; or is it the code? */
  here(id, order, code) {
    const at = order.indexOf(id);
    const place = (x) => order.indexOf(x.dataset.to), passed = (x) => (code ? !x.dataset.to : x.dataset.to && place(x) <= at);
    const last = this.#buttons.filter(passed).sort((x, y) => place(x) - place(y)).at(-1);
    for (const x of this.#buttons) x.setAttribute("aria-current", x === last ? "step" : "false");
  }

  unticked() { for (const tick of this.place.querySelectorAll(".tick")) tick.remove(); }

  tick({ id, holds, bound, reason }) {
    const title = holds ? this.words.holds(power(bound)) : `${this.words.fails}: ${reason}`;
    for (const x of this.#buttons.filter((y) => y.dataset.to === id)) {
      x.firstChild.append(make("span", { class: holds ? "tick" : "tick wrong", role: "img", title, "aria-label": title }, holds ? " ✓" : " ✗"));
    }
  }
}
