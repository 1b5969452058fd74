/* The static folder of the playground: node build.mjs STAGE OUT
 *
 * STAGE is what stage.py made. The Python of the package and of its libraries is compiled by the
 * very Python that runs it in the browser, and packed; the scripts are bundled; the worker of the
 * service keeps every file, under the hash of them all. */
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { loadPyodide } from "pyodide";

const [stage, out] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const core = join(here, "node_modules", "pyodide");
const html = join(here, "..", "templates", "html");
const CORE = ["pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip"];

const files = (folder) => readdirSync(folder, { withFileTypes: true, recursive: true })
  .filter((x) => x.isFile()).map((x) => join(x.parentPath ?? x.path, x.name)).sort();

/* a folder of modules, compiled, without sources, as .tar.gz: the same bytes on any day */
const PACK = `
import compileall, gzip, io, os, tarfile
from py_compile import PycInvalidationMode as Mode

def packed(folder):
    os.chdir(folder)
    assert compileall.compile_dir(".", quiet=1, legacy=True, invalidation_mode=Mode.UNCHECKED_HASH)
    names = sorted(os.path.join(at, x)[2:] for at, _, xs in os.walk(".") for x in xs if not x.endswith(".py"))
    tar = io.BytesIO()
    with tarfile.open(fileobj=tar, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name in names:
            with open(name, "rb") as file:
                content = file.read()
            about = tarfile.TarInfo(name)
            about.size = len(content)
            archive.addfile(about, io.BytesIO(content))
    return gzip.compress(tar.getvalue(), 9, mtime=0)

packed
`;

async function pack() {
  const python = await loadPyodide({ env: { PYTHONHASHSEED: "0" } });
  const packed = python.runPython(PACK);
  for (const part of ["first", "later"]) {
    for (const file of files(join(stage, part))) {
      const name = `/${part}/${relative(join(stage, part), file)}`;
      python.FS.mkdirTree(dirname(name));
      python.FS.writeFile(name, new Uint8Array(readFileSync(file)));
    }
    writeFileSync(join(out, `${part}.tar.gz`), packed(`/${part}`).toJs());
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
for (const file of ["index.html", "moving.html", "play.css", "icon.svg", "play.webmanifest"]) {
  copyFileSync(join(here, "src", file), join(out, file));
}
for (const file of ["page.css", "motion.css", "motion.js"]) copyFileSync(join(html, file), join(out, file));
copyFileSync(join(stage, "data.json"), join(out, "data.json"));

const all = files(out).map((x) => relative(out, x));
const hash = createHash("sha256");
for (const file of all) hash.update(file).update(readFileSync(join(out, file)));
const kept = all.filter((x) => x !== "index.html");
writeFileSync(join(out, "keep.js"), readFileSync(join(here, "src", "keep.js"), "utf8")
  .replace("__VERSION__", hash.digest("hex").slice(0, 16))
  .replace("__FILES__", JSON.stringify(["./", ...kept])));
