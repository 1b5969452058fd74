/* The menu of the ready-made problems, by their groups, and of one's own. */
import { make } from "./dom.js";

export function menu(select, problems, words, lang) {
  const groups = Map.groupBy?.(problems, (x) => x.group) ?? new Map([["", problems]]);
  select.replaceChildren(make("option", { value: "" }, words.own),
    ...[...groups].map(([group, list]) => make("optgroup", { label: group || "–" },
      ...list.map((x) => make("option", { value: x.name, title: x[`about_${lang}`] }, `${x.name}: ${x[`title_${lang}`]}`)))));
}

/* a small problem to begin with */
export const BEGUN = `name = "mine"
group = "SO(3)"

[parameters]
m = { default = 1, unit = "kg" }
l = { default = 1, unit = "m" }
g = { default = 9.81, unit = "m/s^2" }

[[point]]
mass = "m"
at = ["l", 0, 0]

[[point]]
mass = "m"
at = [0, "l", 0]

[[potential]]
kind = "gravity"
g = [0, 0, "-g"]
`;
