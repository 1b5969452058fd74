/* What is searched of the equations, as the commands of these names print it: what is chosen is sought when the tab is shown. */
import { make } from "./dom.js";
import { Equations } from "./equations.js";
import { option } from "./link.js";

const SEARCHES = { symmetries: "symmetries", integrals: "integrals", equilibria: "equilibria", letters: "equilibria --letters", reduction: "reduction" };

export class Found {
  #now = "symmetries";
  #shown = "";

  /* ask(what, heard): how the search of a problem ended; go: what a link to a step of the walk does */
  constructor(place, css, bar, { ask, go }) {
    this.ask = ask;
    this.choice = make("div", { class: "switch", role: "group" });
    this.command = make("code", { translate: "no" });
    const result = make("div");
    place.append(this.choice, make("p", { class: "told" }, this.command), result);
    this.equations = new Equations(result, css, bar, (id) => this.equations.go(id) || go(id));
  }

  /* what is chosen, of a walk { text, lang }, unless it stands there; file: the name of its file */
  async of({ text, lang }, words, file) {
    const key = `${this.#now} ${lang} ${text}`, what = this.#now;
    const buttons = Object.keys(SEARCHES).map((x) => make("button", {
      type: "button", "data-search": x, "aria-pressed": String(x === what),
      click: () => {
        this.#now = x;
        this.of({ text, lang }, words, file);
        this.choice.querySelector("[aria-pressed=true]").focus();
      },
    }, words.searches[x]));
    this.choice.setAttribute("aria-label", words.find);
    this.choice.replaceChildren(...buttons);
    const [command, ...options] = SEARCHES[what].split(" ");
    this.command.textContent = ["derive", command, file, ...options].join(" ") + option(lang);
    if (this.#shown === key) return;
    this.#shown = key;
    this.equations.clear(make("p", {}, words.searching));
    let refused = "", page = "";
    const how = await this.ask(SEARCHES[what], { text, lang }, (kind, news) => {
      if (kind === "error") refused = news.message;
      if (kind === "found") page = news;
    });
    if (this.#shown !== key) return;
    if (how !== "end" || refused) {
      this.#shown = "";
      return this.equations.clear(make("p", { class: "fault" }, refused || words.unfound));
    }
    this.equations.begin(words, lang);
    this.equations.write(page);
    this.equations.end();
    // the steps alone: what stands before them is said of the walk
    for (const x of this.equations.root.querySelectorAll("header.page, nav, nav + div > p, section > :is(h2, .subtitle, figure)")) x.remove();
    this.equations.linked((id) => `#${id}`);
  }
}
