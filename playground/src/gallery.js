/* The gallery: every ready-made problem as a thing, shelf by shelf, with a small picture; and the list of them. */
import { along, make } from "./dom.js";
import { placed } from "./link.js";
import { still } from "./see.js";

/* problems by their shelves, in order */
const shelved = (problems, lang) => [...Map.groupBy?.(problems, (x) => x[`shelf_${lang}`]) ?? [["–", problems]]];

/* the list of the ready-made problems, and of one's own */
export function menu(select, problems, words, lang) {
  select.replaceChildren(make("option", { value: "" }, words.own),
    ...shelved(problems, lang).map(([shelf, list]) => make("optgroup", { label: shelf },
      ...list.map((x) => make("option", { value: x.name }, `${x[lang]} (${x.name})`)))));
}

export class Gallery {
  /* dialog: where it opens; problems: the ready-made ones; chosen(): the name of the one that is there; choose(text) */
  constructor(dialog, { problems, chosen, choose }) {
    Object.assign(this, { dialog, problems, chosen, choose });
    this.place = dialog.querySelector(".shelves");
    dialog.querySelector(".close").addEventListener("click", () => dialog.close());
    dialog.addEventListener("click", (e) => { if (e.target === dialog) dialog.close(); }); // beside it
    dialog.addEventListener("keydown", (e) => this.#step(e));
  }

  /* its file is asked for when it is opened first */
  async open(words, lang) {
    this.dialog.showModal();
    this.file ??= fetch("gallery.json").then((x) => x.json());
    try {
      this.#show(await this.file, words, lang);
    } catch {
      this.file = null;
      this.place.replaceChildren(make("p", { class: "fault", role: "alert" }, words.nogallery));
    }
  }

  #show(pictures, words, lang) {
    this.place.replaceChildren(...shelved(this.problems, lang).map(([shelf, things]) => make("section", {}, make("h3", {}, shelf),
      make("ul", {}, ...things.map((x) => make("li", {}, this.#thing(x, pictures[x.name], words, lang)))))));
    (this.place.querySelector("[aria-current]") ?? this.place.querySelector("a"))?.focus();
  }

  #thing(problem, picture, words, lang) {
    const { name, text } = problem, moved = problem[`group_${lang}`], shown = make("span", { class: "picture" });
    if (picture) shown.innerHTML = picture; // made with the page
    else shown.append(moved);
    return make("a", {
      href: placed(lang, name), title: problem[`title_${lang}`], "aria-current": name === this.chosen() && "true",
      click: (e) => {
        if (e.ctrlKey || e.metaKey || e.shiftKey) return; // in a page of its own
        e.preventDefault();
        this.dialog.close();
        this.choose(text);
      },
    }, shown, make("span", { class: "name" }, problem[lang]), ...(picture ? [make("small", {}, moved)] : []),
    ...(still(text) ? [make("small", {}, words.wide)] : []));
  }

  /* the arrows go from thing to thing, up and down to the nearest of the next row; Home and End to the first and the last */
  #step(e) {
    const things = [...this.place.querySelectorAll("a")], at = things.indexOf(document.activeElement);
    if (at < 0 || !/^(Arrow.*|Home|End)$/.test(e.key)) return;
    e.preventDefault();
    const to = along(e.key, at, things.length);
    if (to !== undefined) return things[to]?.focus();
    const down = e.key === "ArrowDown", boxes = things.map((x) => x.getBoundingClientRect()), here = boxes[at];
    const rows = boxes.map((x) => (down ? x.top - here.top : here.top - x.top)), next = Math.min(...rows.filter((x) => x > 1));
    const aside = (k) => Math.abs(boxes[k].left - here.left);
    const row = [...things.keys()].filter((k) => Math.abs(rows[k] - next) < 1);
    things[row.sort((a, b) => aside(a) - aside(b))[0]]?.focus();
  }
}
