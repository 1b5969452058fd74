/* The tabs: one of them is shown, by click, by arrow keys, Home or End. */
import { along, the } from "./dom.js";

export class Tabs {
  /* names: of the panels, whose tabs are called tab-NAME; shown: what is done when one is */
  constructor(names, shown) {
    Object.assign(this, { names, shown, now: names[0] });
    for (const x of names) the(`tab-${x}`).addEventListener("click", () => this.show(x));
    the(`tab-${names[0]}`).parentElement.addEventListener("keydown", (e) => {
      const to = along(e.key, names.indexOf(this.now), names.length);
      if (to === undefined) return;
      e.preventDefault();
      this.show(names.at(to % names.length));
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
