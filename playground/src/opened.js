/* Files of the reader: chosen by a button, or dropped on the page. A problem file is opened, a mesh becomes the body; of others a line
 * says what to do. */
import { make } from "./dom.js";
import { moments } from "./mesh.js";

const LARGEST = 500_000, MESH = 50_000_000;
/* what a file is by the end of its name, but for a record, which is told by what is in it */
const OTHERS = { stl: "mesh", obj: "mesh", off: "mesh", csv: "run", npz: "run" };

/* button: what asks for a file; open(text): of a problem file; body({ m, c, J, faces }, file): of a mesh; say(line): why another is not; words(): of the language */
export function opens(button, { open, body, say, words }) {
  const choice = make("input", { type: "file", accept: ".toml, .stl, .obj, .off", hidden: true, "aria-hidden": "true", change: () => {
    read(choice.files[0]);
    choice.value = "";
  } });
  button.after(choice);
  button.addEventListener("click", () => choice.click());

  async function read(file) {
    if (!file) return;
    const kind = file.name.split(".").at(-1).toLowerCase();
    const is = kind === "json" && /"steps"\s*:/.test(await file.text()) ? "record" : OTHERS[kind] ?? "other";
    if (kind !== "toml" && is !== "mesh") return say(words().opened[is](file.name));
    if (file.size > (is === "mesh" ? MESH : LARGEST)) return say(words().opened.large(file.name));
    if (is === "mesh") {
      const found = moments(kind, await file.arrayBuffer());
      return found ? body(found, file.name) : say(words().opened.mesh(file.name));
    }
    try {
      open(new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer()));
    } catch {
      say(words().opened.unread(file.name));
    }
  }

  const files = (e) => [...e.dataTransfer?.types ?? []].includes("Files");
  addEventListener("dragover", (e) => { if (files(e)) e.preventDefault(); }, true);
  addEventListener("drop", (e) => {
    if (!files(e)) return;
    e.preventDefault();
    e.stopPropagation();
    read(e.dataTransfer.files[0]);
  }, true);
}
