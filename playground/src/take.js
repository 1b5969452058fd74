/* What may be taken: notes, record, notebook, code in any language with any option; and the command for each at home. */
import { copy, make, save } from "./dom.js";

const TYPES = { ".tex": "text/x-tex", ".json": "application/json", ".html": "text/html", ".ipynb": "application/x-ipynb+json" };

/* the problem as a notebook that derives it */
export function notebook(name, text) {
  const lines = (x) => x.split(/(?<=\n)/);
  const code = (id, source) => ({ cell_type: "code", id, execution_count: null, metadata: {}, outputs: [], source: lines(source) });
  const quoted = JSON.stringify(text).replace(/\\u2028|\\u2029/g, "");
  return JSON.stringify({
    nbformat: 4, nbformat_minor: 5,
    metadata: { kernelspec: { display_name: "Python 3", language: "python", name: "python3" } },
    cells: [
      code("problem", `from pathlib import Path\n\nimport derive\n\nPath("${name}.toml").write_text(${quoted}, encoding="utf-8")\nd = derive.derive("${name}.toml")`),
      code("walk", "d"),
      code("check", "d.check()"),
    ],
  }, null, 1);
}

export class Take {
  /* ask: (words) → the bytes of a zip, or nothing; file: () → { name, text } */
  constructor(place, data, ask, file) {
    Object.assign(this, { place, data, ask, file });
    this.chosen = { languages: new Set(["c", "python"]), single: {}, repeated: new Set(), added: new Set() };
  }

  show(words, lang) {
    this.words = words;
    const spoken = lang === "en" ? "" : ` --lang ${lang}`;
    this.tells = [];
    this.place.replaceChildren(
      make("h2", {}, words.notes),
      this.row("LaTeX", ".tex", () => `notes FILE${spoken} --out out/NAME.tex`),
      this.row(words.page, ".html", () => `notes FILE${spoken} --out out/NAME.html`),
      this.row(words.record, ".json", () => "walk FILE --format json --out out/NAME.json"),
      make("div", { class: "row" }, make("button", { type: "button", click: () => {
        const { name, text } = this.file();
        save(`${name}.ipynb`, notebook(name, text), TYPES[".ipynb"]);
      } }, words.save(`${words.notebook} .ipynb`))),
      make("h2", {}, words.code), this.choices(), this.row("zip", ".zip", () => `emit FILE ${this.options()} --out out`),
    );
    this.told();
  }

  /* a button that saves, and the command that does it */
  row(title, end, command) {
    const shown = make("code", {}), words = this.words;
    const tell = () => { shown.textContent = this.athome(command()); };
    this.tells.push(tell);
    const button = make("button", { type: "button", click: async () => {
      const { name } = this.file();
      const zip = await this.ask(command().replaceAll("NAME", name));
      if (!zip) return;
      if (end === ".zip") save(`${name}.zip`, zip, "application/zip");
      else save(`${name}${end}`, await only(zip), TYPES[end]);
    } }, words.save(title === "zip" ? ".zip" : `${title} ${end}`));
    const copies = make("button", { type: "button", class: "quiet", click: () => copy(shown.textContent, copies, "✓") }, words.copy);
    return make("div", { class: "row" }, button, make("div", { class: "command" }, make("span", {}, words.command), shown, copies));
  }

  athome(command) {
    const { name, ready } = this.file();
    return `derive ${command.replaceAll("out/NAME", name).replace("FILE", ready ?? `${name}.toml`).replace(/ --out out$/, ` --out ${name}`)}`;
  }

  told() {
    for (const tell of this.tells) tell();
  }

  options() {
    const { languages, single, repeated, added } = this.chosen;
    return [
      ...[...languages].map((x) => `--lang ${x}`), ...Object.entries(single).map(([x, y]) => `--${x} ${y}`),
      ...[...repeated].map((x) => `--${x}`), ...[...added].map((x) => `--${x}`),
    ].join(" ");
  }

  choices() {
    const { words, data, chosen } = this;
    const box = (set, value, text) => {
      const input = make("input", { type: "checkbox", change: () => {
        if (input.checked) set.add(value);
        else set.delete(value);
        this.told();
      } });
      input.checked = set.has(value);
      return make("label", { class: "box" }, input, ` ${text}`);
    };
    const one = ([name, values]) => {
      const select = make("select", { change: () => {
        if (select.value) chosen.single[name] = select.value;
        else delete chosen.single[name];
        this.told();
      } }, make("option", { value: "" }, "–"), ...values.map((x) => make("option", { value: x }, x)));
      select.value = chosen.single[name] ?? "";
      return make("label", { title: data.about[name] }, `${name} `, select);
    };
    const several = Object.entries(data.repeated).map(([name, values]) => make("fieldset", { title: data.about[name] },
      make("legend", {}, name), ...values.map((x) => box(chosen.repeated, `${name} ${x}`, x))));
    return make("div", { class: "choices" },
      make("fieldset", {}, make("legend", {}, words.languages), ...data.languages.map((x) => box(chosen.languages, x, x))),
      make("details", {}, make("summary", {}, words.options),
        make("div", { class: "choices" }, ...Object.entries(data.choices).map(one), ...several,
          make("fieldset", {}, make("legend", {}, "+"), ...data.added.map((x) => box(chosen.added, x, x))))));
  }
}

/* the only file of a zip whose entries are deflated */
async function only(zip) {
  const view = new DataView(zip), start = 30 + view.getUint16(26, true) + view.getUint16(28, true);
  const size = new DataView(zip).getUint32(18, true);
  const stream = new Blob([new Uint8Array(zip, start, size)]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).blob();
}
