/* Where the reader was: an entry of the browser's history for each problem and each step that is gone to. */
import { packed, placed, spoken, tabbed } from "./link.js";

export class Places {
  /* does the walk of the entry that is shown stand in the page? */
  stands = false;

  /* the tab that it says */
  tab = "walk";

  constructor(equations) {
    this.equations = equations;
    history.scrollRestoration = "manual";
  }

  /* the problem of the entry that is shown: its name, or p=… */
  get word() { return location.hash.replace(/^#/, "").split(/[/&]/)[0]; }

  /* and its step, if any */
  get named() { return decodeURIComponent(location.hash.split("&")[0].split("/").slice(1).join("/")); }

  /* the place that the reader left the entry at which is shown */
  get left() { return history.state?.at ?? null; }

  /* where to go in its walk: there, or to the step that it names */
  aim(step) { return this.left ?? (step && { step }); }

  /* remember where the reader is */
  keep() {
    const at = this.stands && this.equations.at();
    if (at) history.replaceState({ at }, "");
  }

  /* The entry of a problem, by its name if it has one: another one where `anew`, and where a ready-made one was
   * changed, so that Back finds it. */
  async problem(lang, name, text, anew = false) {
    const word = name ?? `p=${await packed(text)}`, before = this.word;
    if (word === before && lang === spoken(location.search)) return;
    if (word !== before) this.stands = false;
    const changed = !name && !before.startsWith("p=");
    this.#enter(anew || changed, placed(lang, word, word === before ? this.named : "", anew ? {} : { tab: this.tab }));
  }

  /* the entry of a step; `again`: in the place of another step's, which was passed; seen: see link.js */
  step(lang, word, id, again, seen = { tab: this.tab }) {
    this.keep();
    this.#enter(!again, placed(lang, word, id, seen));
  }

  /* the same entry, which says what is seen */
  see(lang, word, step, seen) {
    this.tab = seen.tab ?? tabbed(step);
    history.replaceState(history.state, "", placed(lang, word, step, seen));
  }

  /* the same entry, in another tab */
  shows(lang, word, tab) {
    if (tab !== this.tab) this.see(lang, word, this.named, { tab });
  }

  #enter(anew, url) {
    history[anew ? "pushState" : "replaceState"]({}, "", url);
  }
}
