import { dark, make } from "../../templates/html/projector.js";

export { dark, make };

export const the = (id) => document.getElementById(id);

/* where a key leads in a row of so many things; undefined where it does not */
export const along = (key, at, count) => ({ ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: count - 1 })[key];

/* what the command line refuses, without its name and that of the problem */
export const plainly = (message) => message.replace(/^derive: (\w+: )?/, "");

/* let the reader save bytes as a file */
export function save(name, content, type = "application/octet-stream") {
  const url = URL.createObjectURL(new Blob([content], { type }));
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/* copy a text, and say so on the button for a moment */
export async function copy(text, button, done) {
  const before = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = make("textarea", { class: "away", "aria-hidden": "true" });
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
    button.focus();
  }
  button.textContent = done;
  setTimeout(() => { button.textContent = before; }, 1200);
}

/* a choice that the browser keeps for the next visit */
export function kept(name, value) {
  try {
    if (value === undefined) return localStorage.getItem(name);
    localStorage.setItem(name, value);
  } catch { /* a browser that keeps nothing */ }
  return null;
}
