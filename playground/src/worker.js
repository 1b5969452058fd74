/* The package, in a worker: { id, ask, ...arguments } in, { id, kind, news } out; "ready" first. */
import { loadPyodide } from "./pyodide/pyodide.mjs";

const base = new URL("./", import.meta.url).href;
const SITE = "/lib/site";

let now = 0;
const tell = (kind, news, moved = []) => postMessage({ id: now, kind, news }, moved);

async function unpacked(python, name) {
  const answer = await fetch(`${base}${name}.tar.gz`);
  if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
  return () => answer.arrayBuffer().then((x) => python().unpackArchive(new Uint8Array(x), "gztar", { extractDir: SITE }));
}

async function begun() {
  let python;
  const first = unpacked(() => python, "first");
  python = await loadPyodide({ indexURL: `${base}pyodide/` });
  await (await first)();
  python.runPython(`import sys; sys.path.insert(0, "${SITE}"); sys.dont_write_bytecode = True`);
  const Play = python.pyimport("play").Play;
  const play = Play((kind, news) => tell(kind, JSON.parse(news)));
  return { python, play };
}

const started = begun();
started.then(({ python }) => tell("ready", { python: python.version }), (e) => tell("broken", String(e)));

/* what is pure Python and not needed at first is loaded when an import of it fails */
async function withLater(does) {
  try {
    return does();
  } catch (e) {
    const { python } = await started;
    if (!String(e).includes("No module named 'mpmath'")) throw e;
    await (await unpacked(() => python, "later"))();
    python.runPython("import importlib; importlib.invalidate_caches()");
    return does();
  }
}

const ASKED = {
  walk: (play, m) => play.walk(m.text, m.lang),
  plain: (play, m) => play.plain(m.text),
  check: (play, m) => play.check(m.text),
  motion: (play, m) => play.motion(m.text, m.lang),
  files: (play, m) => {
    const made = play.files(m.text, m.words);
    if (!made) return;
    const bytes = made.toJs();
    made.destroy();
    tell("files", bytes.buffer, [bytes.buffer]);
  },
};

let line = Promise.resolve();
addEventListener("message", ({ data }) => {
  line = line.then(async () => {
    const { play } = await started;
    now = data.id;
    try {
      await withLater(() => ASKED[data.ask](play, data));
    } catch (e) {
      tell("error", { message: `derive: ${String(e).trim().split("\n").at(-1)}`, line: 1 });
    }
    tell("end", {});
  });
});
