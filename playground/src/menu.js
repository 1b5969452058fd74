/* The menu of the ready-made problems, shelf by shelf as things, and of one's own. */
import { make } from "./dom.js";

/* problems by their shelves, in order */
export const shelved = (problems, lang) => [...Map.groupBy?.(problems, (x) => x[`shelf_${lang}`]) ?? [["–", problems]]];

export function menu(select, problems, words, lang) {
  select.replaceChildren(make("option", { value: "" }, words.own),
    ...shelved(problems, lang).map(([shelf, list]) => make("optgroup", { label: shelf },
      ...list.map((x) => make("option", { value: x.name }, `${x[lang]} (${x.name})`)))));
}
