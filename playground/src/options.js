/* The options of derive emit, with what each of them does in words. */
import { make } from "./dom.js";

export class Options {
  /* data: the tables of stage.py; changed: what is done when another one is chosen */
  constructor(data, changed) {
    Object.assign(this, { data, changed });
    this.languages = new Set(["c", "python"]);
    this.single = {};
    this.repeated = new Set();
    this.added = new Set();
  }

  /* as words of the command line */
  get command() {
    return [
      ...[...this.languages].map((x) => `--lang ${x}`), ...Object.entries(this.single).map(([x, y]) => `--${x} ${y}`),
      ...[...this.repeated].map((x) => `--${x}`), ...[...this.added].map((x) => `--${x}`),
    ].join(" ");
  }

  show(words) {
    const { data } = this, about = (name) => words.about[name] ?? data.about[name];
    const told = (name, ...inside) => make("div", { class: "option" }, ...inside, make("p", { id: `about-${name}` }, about(name)));
    const one = ([name, [first, ...others]]) => told(name, make("label", {}, `${name} `, this.#select(name, words.default(first), others)));
    const several = ([name, values]) => told(name, make("fieldset", { "aria-describedby": `about-${name}` },
      make("legend", {}, name), ...values.map((x) => this.#box(this.repeated, `${name} ${x}`, x))));
    const added = (name) => told(name, this.#box(this.added, name, name, `about-${name}`));
    return make("div", { class: "choices" },
      make("fieldset", {}, make("legend", {}, words.languages), ...data.languages.map((x) => this.#box(this.languages, x, x))),
      make("details", {}, make("summary", {}, words.options), make("div", { class: "options" },
        ...Object.entries(data.choices).map(one), ...Object.entries(data.repeated).map(several),
        make("h3", {}, words.further), ...data.added.map(added))));
  }

  #select(name, standard, others) {
    const select = make("select", { "aria-describedby": `about-${name}`, change: () => {
      if (select.value) this.single[name] = select.value;
      else delete this.single[name];
      this.changed();
    } }, make("option", { value: "" }, standard), ...others.map((x) => make("option", { value: x }, x)));
    select.value = this.single[name] ?? "";
    return select;
  }

  #box(set, value, text, about) {
    const input = make("input", { type: "checkbox", "aria-describedby": about, change: () => {
      if (input.checked) set.add(value);
      else set.delete(value);
      this.changed();
    } });
    input.checked = set.has(value);
    return make("label", { class: "box" }, input, ` ${text}`);
  }
}
