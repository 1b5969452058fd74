/* The package, in a worker: { id, ask, ...arguments } in, { id, kind, news } out; "ready" first. */
import { loadPyodide } from "./pyodide/pyodide.mjs";

const base = new URL("./", import.meta.url).href;
const SITE = "/lib/site";

let now = 0;
const tell = (kind, news, moved = []) => postMessage({ id: now, kind, news }, moved);

let python;

/* a part of the package, fetched now, and unpacked when it is asked for */
function part(name) {
  const fetched = fetch(`${base}${name}.tar.gz`).then((x) => {
    if (!x.ok) throw new Error(`${name}: ${x.status}`);
    return x.arrayBuffer();
  });
  fetched.catch(() => {});
  let done;
  return () => (done ??= fetched.then((x) => {
    python.unpackArchive(new Uint8Array(x), "gztar", { extractDir: SITE });
    python.runPython("import sys; sys.path_importer_cache.clear()");
  }));
}

async function begun() {
  const first = part("first");
  python = await loadPyodide({ indexURL: `${base}pyodide/` });
  await first();
  python.runPython(`import sys; sys.path.insert(0, "${SITE}"); sys.dont_write_bytecode = True`);
  const Play = python.pyimport("play").Play;
  return Play((kind, news) => tell(kind, JSON.parse(news)));
}

const started = begun();
started.then(() => tell("ready", { python: python.version }), (e) => tell("broken", String(e)));

const parts = new Map(), tried = new Set();
const begin = (name) => parts.get(name) ?? parts.set(name, part(name)).get(name);

/* what a walk does not need is fetched behind the first one; some libraries when an import of them fails */
async function answered(ask, does) {
  if (ask !== "walk") await begin("rest")();
  for (;;) {
    try {
      does();
      break;
    } catch (e) {
      const missing = /No module named '(derive|mpmath|sympy)\b/.exec(String(e))?.[1], name = missing === "derive" ? "rest" : missing;
      if (!name || tried.has(name)) throw e;
      await begin(name)().catch((why) => {
        parts.delete(name); // to be fetched when there is a network again
        throw why;
      });
      tried.add(name);
    }
  }
  begin("rest");
}

/* what is asked, with what of the question behind its text; a zip is bytes */
const ASKED = { walk: ["lang"], check: [], motion: ["lang"], refused: ["words"], kept: ["lang"], found: ["what", "lang"], files: ["words", "zip"] };

function asked(play, m) {
  const made = play[m.ask](m.text, ...ASKED[m.ask].map((x) => m[x]));
  if (!made) return;
  const bytes = made.toJs();
  made.destroy();
  tell("zip", bytes.buffer, [bytes.buffer]);
}

let line = Promise.resolve();
addEventListener("message", ({ data }) => {
  line = line.then(async () => {
    const play = await started;
    now = data.id;
    try {
      await answered(data.ask, () => asked(play, data));
    } catch (e) {
      tell("error", { message: `derive: ${String(e).trim().split("\n").at(-1)}`, line: 1 });
    }
    tell("end", {});
  });
});
