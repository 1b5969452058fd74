/* The tabs: one of them is shown, by click or by arrow keys. */
import { the } from "./dom.js";

export class Tabs {
  /* names: of the panels, whose tabs are called tab-NAME; shown: what is done when one is */
  constructor(names, shown) {
    Object.assign(this, { names, shown, now: names[0] });
    for (const x of names) the(`tab-${x}`).addEventListener("click", () => this.show(x));
    the(`tab-${names[0]}`).parentElement.addEventListener("keydown", (e) => {
      const by = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
      if (!by) return;
      this.show(names[(names.indexOf(this.now) + by + names.length) % names.length]);
      the(`tab-${this.now}`).focus();
    });
  }

  show(name) {
    this.now = name;
    for (const x of this.names) {
      const at = the(`tab-${x}`);
      at.setAttribute("aria-selected", String(x === name));
      at.tabIndex = x === name ? 0 : -1;
      the(x).hidden = x !== name;
    }
    this.shown(name);
  }
}
