/* The gallery: every ready-made problem as a thing, shelf by shelf, with a small picture. */
import { make } from "./dom.js";
import { placed } from "./link.js";

export class Gallery {
  /* dialog: where it opens; ready(name): a ready-made problem; chosen(): the name of the one that is there;
   * choose(name, moves) */
  constructor(dialog, { ready, chosen, choose }) {
    Object.assign(this, { dialog, ready, chosen, choose });
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

  #show(shelves, words, lang) {
    const now = this.chosen();
    this.place.replaceChildren(...shelves.map((shelf) => make("section", {}, make("h3", {}, shelf[lang]),
      make("ul", {}, ...shelf.things.map((x) => make("li", {}, this.#thing(x, words, lang, x.name === now)))))));
    (this.place.querySelector("[aria-current]") ?? this.place.querySelector("a"))?.focus();
  }

  #thing({ name, picture, moves, ...called }, words, lang, current) {
    const problem = this.ready(name), moved = problem[`group_${lang}`], shown = make("span", { class: "picture" });
    if (picture) shown.innerHTML = picture; // made with the page
    else shown.append(moved);
    return make("a", {
      href: placed(lang, name), title: problem[`title_${lang}`], "aria-current": current && "true",
      click: (e) => {
        if (e.ctrlKey || e.metaKey || e.shiftKey) return; // in a page of its own
        e.preventDefault();
        this.dialog.close();
        this.choose(name, moves);
      },
    }, shown, make("span", { class: "name" }, called[lang]), ...(picture ? [make("small", {}, moved)] : []),
    ...(moves ? [] : [make("small", {}, words.wide)]));
  }

  /* the arrows go from thing to thing, up and down to the nearest of the next row */
  #step(e) {
    const things = [...this.place.querySelectorAll("a")], at = things.indexOf(document.activeElement);
    if (at < 0 || !e.key.startsWith("Arrow")) return;
    e.preventDefault();
    const by = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
    if (by) return things[at + by]?.focus();
    const down = e.key === "ArrowDown", boxes = things.map((x) => x.getBoundingClientRect()), here = boxes[at];
    const rows = boxes.map((x) => (down ? x.top - here.top : here.top - x.top)), next = Math.min(...rows.filter((x) => x > 1));
    const aside = (k) => Math.abs(boxes[k].left - here.left);
    const row = [...things.keys()].filter((k) => Math.abs(rows[k] - next) < 1);
    things[row.sort((a, b) => aside(a) - aside(b))[0]]?.focus();
  }
}
