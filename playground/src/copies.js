/* The buttons that copy an equation. A step of the walk is one stop of the Tab key; arrows go from button to button. */
import { make } from "./dom.js";

/* a second button beside each, and what each says to whom only hears it */
export function copies(root, words) {
  for (const button of root.querySelectorAll("button[data-tex]")) {
    const number = button.parentElement.textContent.match(/\([^()]*\)/)?.[0] ?? "";
    const other = make("button", { type: "button", title: words.mathml, "aria-label": `MathML ${number}: ${words.mathml}` }, "MathML");
    button.setAttribute("aria-label", `TeX ${number}: ${words.tex}`);
    button.after(" ", other);
  }
  for (const step of root.querySelectorAll("article")) stop(step, step.querySelector(".number button"));
}

/* make one button of a step the one that Tab goes to */
function stop(step, chosen) {
  for (const button of step.querySelectorAll(".number button")) button.tabIndex = button === chosen ? 0 : -1;
}

/* what a key does on a button: the other one of the equation, or the same of another equation */
export function moved(root, button, key) {
  const sideways = key === "ArrowLeft" || key === "ArrowRight";
  const by = { ArrowDown: 1, ArrowUp: -1 }[key] ?? 0;
  if (!button?.closest(".number") || !sideways && !by) return false;
  const pair = (x) => [...x.querySelectorAll("button")], own = pair(button.closest(".number"));
  const numbers = [...root.querySelectorAll(".number")].filter((x) => pair(x).length > 1);
  const at = numbers.indexOf(button.closest(".number")), column = own.indexOf(button);
  const next = sideways ? own[1 - column] : numbers[at + by] && pair(numbers[at + by])[column];
  if (!next) return true;
  stop(next.closest("article"), next);
  next.focus();
  return true;
}
