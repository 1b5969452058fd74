/* The options of derive emit, with what each of them does in words, and why it cannot be chosen now. */
import { make } from "./dom.js";

export class Options {
  /* data: the tables of stage.py; changed: what is done when another one is chosen */
  constructor(data, changed) {
    Object.assign(this, { data, changed });
    this.languages = new Set(["c", "python"]);
    this.single = {};
    this.flags = new Set(); // those that stand alone, and each value of those that may be repeated
  }

  /* as words of the command line */
  get command() {
    return [
      ...[...this.languages].map((x) => `--lang ${x}`), ...Object.entries(this.single).map(([x, y]) => `--${x} ${y}`),
      ...[...this.flags].map((x) => `--${x}`),
    ].join(" ");
  }

  show(words, lang) {
    const { data } = this, about = (name) => data.about[lang][name];
    this.choices = new Map(); // words of the command line, "step gauss" → what chooses them
    this.places = {}; // option → where it is told why some of its values cannot be chosen
    this.fault = make("p", { class: "fault", role: "status" });
    const called = (name, x) => [x, data.values[name]?.[x]?.[lang]].filter(Boolean).join(" – ");
    const told = (name, ...inside) => make("div", { class: "option" }, ...inside, make("p", { id: `about-${name}` }, about(name)), this.#why(name));
    const one = ([name, values]) => told(name, make("label", {}, `${name} `, this.#select(name, values, (x) => called(name, x), words.default)));
    const several = ([name, values]) => told(name, make("fieldset", { "aria-describedby": `about-${name} why-${name}` },
      make("legend", {}, name), ...values.map((x) => this.#box(this.flags, `${name} ${x}`, `${name} ${x}`, called(name, x), name))));
    const added = (name) => told(name, this.#box(this.flags, name, name, name, name));
    return make("div", { class: "choices" },
      make("fieldset", {}, make("legend", {}, words.languages), ...data.languages.map((x) => this.#box(this.languages, x, `lang ${x}`, x, "lang")), this.#why("lang")),
      make("details", {}, make("summary", {}, words.options), make("div", { class: "options" },
        ...Object.entries(data.choices).map(one), ...Object.entries(data.repeated).map(several),
        make("h3", {}, words.further), ...data.added.map(added))), this.fault);
  }

  /* reasons: words of the command line → why the command would refuse them beside what is chosen; "" where that is refused itself */
  refuse(reasons) {
    this.fault.textContent = reasons[""] ?? "";
    for (const place of Object.values(this.places)) place.replaceChildren();
    const alike = new Map(); // the values of an option that have one reason
    for (const [choice, { input, shown }] of this.choices) {
      const reason = reasons[choice], [name, value = name] = choice.split(" ");
      input.disabled = Boolean(reason);
      shown.title = reason ?? "";
      if (!reason) continue;
      const key = `${name} ${reason}`;
      alike.set(key, { name, reason, values: [...alike.get(key)?.values ?? [], value] });
    }
    for (const { name, reason, values } of alike.values()) this.places[name].append(make("li", {}, make("b", {}, values.join(", ")), ` – ${reason}`));
  }

  #why(name) { return this.places[name] = make("ul", { class: "why", id: `why-${name}` }); }

  #select(name, [first, ...others], called, standard) {
    const select = make("select", { "aria-describedby": `about-${name} why-${name}`, change: () => {
      if (select.value) this.single[name] = select.value;
      else delete this.single[name];
      this.changed();
    } }, make("option", { value: "" }, standard(called(first))), ...others.map((x) => {
      const option = make("option", { value: x }, called(x));
      this.choices.set(`${name} ${x}`, { input: option, shown: option });
      return option;
    }));
    select.value = this.single[name] ?? "";
    return select;
  }

  #box(set, value, choice, text, name) {
    const input = make("input", { type: "checkbox", "aria-describedby": name === "lang" ? `why-${name}` : `about-${name} why-${name}`, change: () => {
      if (input.checked) set.add(value);
      else set.delete(value);
      this.changed();
    } });
    input.checked = set.has(value);
    const shown = make("label", { class: "box" }, input, ` ${text}`);
    this.choices.set(choice, { input, shown });
    return shown;
  }
}
