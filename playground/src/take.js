/* What may be taken: the file, notes, record, notebook, code in any language with any option; and the command for each at home. */
import { copy, make, save } from "./dom.js";
import { option } from "./link.js";
import { notebook } from "./notebook.js";
import { Options } from "./options.js";
import { about, snippets } from "./snippets.js";

const TYPES = { ".tex": "text/x-tex", ".json": "application/json", ".html": "text/html", ".ipynb": "application/x-ipynb+json", ".toml": "application/toml" };

export class Take {
  /* ask: (words of a command, what else is in a zip) → { files, start, zip } or { refused }; reasons: (options of an emission) → why others cannot be added, or null while
   * that cannot be known; file: () → { name, text, title, ready } */
  constructor(place, data, { ask, reasons, file }) {
    Object.assign(this, { place, ask, reasons, file, made: data.emission.slice(10, -10) });
    this.options = new Options(data, () => this.told());
    this.code = new Code();
  }

  show(words, lang) {
    this.words = words;
    this.weighed = this.seen = null;
    const speaks = option(lang);
    this.tells = [];
    this.place.replaceChildren(
      make("h2", {}, words.code), this.options.show(words, lang),
      this.emission = this.row(() => `emit FILE ${this.options.command} --out out`, [words.show, (found) => this.code.show(found, words)],
        [words.save(".zip"), (found, command) => this.zip(found, command)]),
      this.code.place,
      make("h2", {}, words.write),
      make("div", { class: "row" }, this.own((x) => `${x.name}.toml`, ".toml", (x) => x.text), make("span", { class: "told" }, words.reads)),
      make("h2", {}, words.notes),
      this.row(() => `notes FILE${speaks} --out out/NAME.tex`, this.saves("LaTeX", ".tex")),
      this.row(() => `notes FILE${speaks} --out out/NAME.html`, this.saves(words.page, ".html")),
      this.row(() => "walk FILE --format json --out out/NAME.json", this.saves(words.record, ".json")),
      make("div", { class: "row" }, this.own(() => `${words.notebook} .ipynb`, ".ipynb", (x) => notebook(x.name, x.text, x.title)), make("span", { class: "told" }, words.runs)),
      make("h2", {}, words.figure), this.row(() => `simulate FILE --out out/NAME.npz && derive plot out/NAME.npz${speaks}`),
    );
    this.place.querySelector("details").addEventListener("toggle", () => this.weigh());
    this.told();
  }

  /* a button that saves what the page makes itself */
  own(title, end, content) {
    const button = make("button", { type: "button", click: () => {
      const file = this.file();
      save(`${file.name}${end}`, content(file), TYPES[end]);
    } });
    this.tells.push(() => { button.textContent = this.words.save(title(this.file())); });
    return button;
  }

  /* the code, and the programs that call it, which say how they are compiled */
  async zip({ files, start }, command) {
    const { zip } = await this.ask(command, JSON.stringify(Object.fromEntries(snippets(Object.entries(files), start))));
    if (zip) save(`${this.file().name}.zip`, zip, "application/zip");
  }

  /* a button that saves the only file of a command */
  saves(title, end) {
    return [this.words.save(`${title} ${end}`), ({ files }) => save(`${this.file().name}${end}`, Object.values(files)[0], TYPES[end])];
  }

  /* the tab is seen: its code, once, then what could not be added to it */
  opened() {
    if (this.seen === this.file().text) return this.weigh();
    this.seen = this.file().text;
    this.emission.firstChild.click();
  }

  /* buttons that do something with the files of a command; the command itself, and what it refuses */
  row(command, ...does) {
    const shown = make("code", {}), fault = make("p", { class: "fault", role: "alert" }), { words } = this;
    this.tells.push(() => {
      shown.textContent = this.athome(command());
      fault.textContent = "";
    });
    const buttons = does.map(([text, does]) => {
      const button = make("button", { type: "button", click: async () => {
        fault.textContent = "";
        button.disabled = true;
        const asking = command().replaceAll("NAME", this.file().name), found = await this.ask(asking);
        if (found.files) await does(found, asking);
        button.disabled = false;
        if (document.activeElement === document.body) button.focus(); // who pressed it by a key goes on from there
        if (!found.files) fault.textContent = found.refused;
        this.weigh();
      } }, text);
      return button;
    });
    const copies = make("button", { type: "button", class: "quiet", click: () => copy(shown.textContent, copies, "✓") }, words.copy);
    return make("div", { class: "row" }, ...buttons, make("div", { class: "command" }, make("span", {}, words.command), shown, copies), fault);
  }

  athome(command) {
    const { name, ready } = this.file();
    return `derive ${command.replaceAll("out/NAME", name).replace("FILE", ready ?? `${name}.toml`).replace(/ --out out$/, ` --out ${name}`)}`;
  }

  /* the problem, or an option, is another one */
  told() {
    this.code.clear();
    for (const tell of this.tells) tell();
    this.weigh();
  }

  /* options that would be refused beside those that are chosen now cannot be chosen; asked again when the worker is free */
  async weigh() {
    const { text } = this.file(), { command } = this.options, now = `${command} ${text}`;
    if (this.weighed === now || command === this.made && !this.place.querySelector("details").open) return; // Python is not asked before there is a choice
    if (this.text !== text) this.options.refuse({});
    Object.assign(this, { text, weighed: now });
    const found = await this.reasons(command);
    if (this.weighed !== now) return;
    if (found) this.options.refuse(found);
    else this.weighed = null;
  }
}

/* the code that was made, and programs that call it: one of the files at a time, to read, to copy or to save */
class Code {
  constructor() {
    this.place = make("div", { class: "code", "aria-live": "polite" });
  }

  clear() { this.place.replaceChildren(); }

  /* files: { name: text }; start: { name of the state: number } */
  show({ files, start }, words) {
    const made = Object.entries(files), texts = new Map([...snippets(made, start), ...made]); // the program first: it says how it is run
    const shown = make("pre", { tabindex: "0", translate: "no" }), lines = make("span", { class: "told" });
    const select = make("select", { "aria-label": words.file, change: () => {
      shown.textContent = texts.get(select.value);
      shown.scrollTop = shown.scrollLeft = 0;
      shown.setAttribute("aria-label", select.value);
      const text = texts.get(select.value), kB = (new Blob([text]).size / 1e3).toFixed(1);
      const header = texts.get(select.value.replace(/\.c$/, ".h")) ?? ""; // of C it alone tells the operations
      lines.textContent = [words.lines(text.split("\n").length - 1, kB), about(text).operations || about(header).operations].filter(Boolean).join("; ");
    } }, ...[...texts.keys()].map((x) => make("option", { value: x }, x)));
    const copies = make("button", { type: "button", click: () => copy(shown.textContent, copies, "✓") }, words.copy);
    const saves = make("button", { type: "button", click: () => save(select.value, texts.get(select.value)) }, words.savefile);
    this.place.replaceChildren(make("div", { class: "row" }, make("label", {}, `${words.file} `, select), copies, saves, lines), shown);
    shown.setAttribute("role", "region");
    select.dispatchEvent(new Event("change"));
  }
}
