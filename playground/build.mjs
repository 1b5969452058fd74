/* The static folder of the playground: node build.mjs STAGE OUT
 *
 * STAGE is what stage.py made. The Python of the package and of its libraries is compiled by the
 * very Python that runs it in the browser, and packed; the scripts are bundled; the worker of the
 * service keeps every file, under the hash of them all. */
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { copyFileSync, cpSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { loadPyodide } from "pyodide";

const [stage, out] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const core = join(here, "node_modules", "pyodide");
const html = join(here, "..", "templates", "html");
const CORE = ["pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm"];

const files = (folder) => readdirSync(folder, { withFileTypes: true, recursive: true })
  .filter((x) => x.isFile()).map((x) => join(x.parentPath ?? x.path, x.name)).sort();

/* Python packs its own modules: pack.py */
async function pack() {
  const python = await loadPyodide({ env: { PYTHONHASHSEED: "0", PYTHONNODEBUGRANGES: "1" } });
  for (const file of ["first", "later"].flatMap((x) => files(join(stage, x)))) {
    const name = `/${relative(stage, file)}`;
    python.FS.mkdirTree(dirname(name));
    python.FS.writeFile(name, new Uint8Array(readFileSync(file)));
  }
  const packs = python.runPython(readFileSync(join(here, "python", "pack.py"), "utf8")).toJs();
  for (const [name, bytes] of Object.entries(packs)) {
    writeFileSync(join(out, name === "library" ? join("pyodide", "python_stdlib.zip") : `${name}.tar.gz`), bytes);
  }
}

rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, "pyodide"), { recursive: true });
for (const file of CORE) copyFileSync(join(core, file), join(out, "pyodide", file));
const lock = JSON.parse(readFileSync(join(core, "pyodide-lock.json"), "utf8"));
writeFileSync(join(out, "pyodide", "pyodide-lock.json"), JSON.stringify({ info: lock.info, packages: {} }));
await pack();
await build({
  entryPoints: ["main", "worker", "moving"].map((x) => join(here, "src", `${x}.js`)),
  bundle: true, format: "esm", minify: true, target: "es2022", outdir: out, legalComments: "none",
  external: ["./pyodide/pyodide.mjs"],
});
for (const file of ["index.html", "moving.html", "arrows.css", "icon.svg", "play.webmanifest"]) {
  copyFileSync(join(here, "src", file), join(out, file));
}
copyFileSync(join(html, "motion.css"), join(out, "motion.css"));
const together = (...paths) => paths.map((x) => readFileSync(x, "utf8")).join("");
const projector = join(html, "projector.css");
writeFileSync(join(out, "page.css"), together(join(html, "page.css"), join(here, "src", "walk.css"), projector));
writeFileSync(join(out, "play.css"), together(join(here, "src", "play.css"), projector));
for (const file of ["data.json", "gallery.json", "lecture.en.html", "lecture.fr.html", "motion.js"]) copyFileSync(join(stage, file), join(out, file));
cpSync(join(stage, "ready"), join(out, "ready"), { recursive: true });

const all = files(out).map((x) => relative(out, x));
const hash = createHash("sha256");
for (const file of all) hash.update(file).update(readFileSync(join(out, file)));
// too large, or too many, to be kept before they are asked for
const LATE = all.filter((x) => ["sympy.tar.gz", "gallery.json"].includes(x) || /^(ready\/|lecture\.)/.test(x));
const kept = all.filter((x) => x !== "index.html" && !LATE.includes(x));
writeFileSync(join(out, "keep.js"), readFileSync(join(here, "src", "keep.js"), "utf8")
  .replace("__LATE__", JSON.stringify(LATE))
  .replace("__VERSION__", hash.digest("hex").slice(0, 16))
  .replace("__FILES__", JSON.stringify(["./", ...kept])));
