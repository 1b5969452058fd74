/* The menu of the ready-made problems, by their groups, and of one's own. */
import { make } from "./dom.js";

export function menu(select, problems, words, lang) {
  const groups = Map.groupBy?.(problems, (x) => x[`group_${lang}`]) ?? new Map([["", problems]]);
  select.replaceChildren(make("option", { value: "" }, words.own),
    ...[...groups].map(([group, list]) => make("optgroup", { label: group || "–" },
      ...list.map((x) => make("option", { value: x.name }, `${x[`title_${lang}`]} (${x.name})`)))));
}
