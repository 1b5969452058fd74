/* The code that was made, and programs that call it: one of the files at a time, to read, to copy or to save. */
import { copy, make, save } from "./dom.js";
import { about, snippets } from "./snippets.js";

export class Code {
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
