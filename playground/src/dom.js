/* An element with attributes, listeners and what is in it; texts are never markup. */
export function make(tag, given = {}, ...inside) {
  const made = document.createElement(tag);
  for (const [name, v] of Object.entries(given)) {
    if (typeof v === "function") made.addEventListener(name, v);
    else if (v === true) made.setAttribute(name, "");
    else if (v !== false && v !== undefined) made.setAttribute(name, v);
  }
  made.append(...inside);
  return made;
}

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

const darkened = new Set();

/* the colours of the dark, whatever the reader's are, or again the reader's */
export function dark(always) {
  for (const rule of [...document.styleSheets].flatMap((x) => [...x.cssRules])) {
    if (rule.media?.mediaText.includes("dark")) darkened.add(rule);
  }
  for (const { media } of darkened) media.mediaText = always ? "all" : "(prefers-color-scheme: dark)";
}
