/* The worker that derives: one question at a time, ended by a button, or by the clock where nothing is heard of it.
 *
 * It is begun from a blob, so that the policy of the page holds in it, too. */
const PATIENCE = 3000;
const base = new URL("./", import.meta.url).href;

function begun() {
  const source = `import ${JSON.stringify(`${base}worker.js`)};`;
  const url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  return new Worker(url, { type: "module" });
}

export class Engine {
  #worker;
  #asked = null;
  #count = 0;
  #turn = 0;
  #ready;

  /* stored(question): the news that were made with the page, or null; onbegin: the worker begins, when it is first needed;
   * onlate(question): does it go on when nothing has been heard for so long? */
  constructor({ seconds = 60, onstate, onbegin, stored, onlate }) {
    Object.assign(this, { seconds, onstate, onbegin, stored, onlate });
  }

  #begin() {
    if (typeof WebAssembly !== "object") {
      this.#ready = Promise.reject(new Error("no WebAssembly"));
      this.#ready.catch(() => {});
      return;
    }
    const worker = this.#worker = begun();
    this.#ready = new Promise((resolve, reject) => {
      worker.addEventListener("message", ({ data }) => {
        if (data.kind === "ready") resolve();
        else if (data.kind === "broken") reject(new Error(data.news));
        else if (this.#asked?.id === data.id) this.#asked.heard(data);
      });
      worker.addEventListener("error", (e) => reject(new Error(e.message || "the worker does not start")));
    });
    this.#ready.catch(() => {});
  }

  get busy() { return this.#asked !== null; }

  /* Ask, and hear every answer; resolves at the end: "end", "stopped", "late", "broken", or "superseded" by a later
   * question. One that waits for another long is not kept waiting. */
  async ask(question, heard) {
    const turn = ++this.#turn;
    const made = await this.stored?.(question);
    if (turn !== this.#turn) return "superseded";
    if (made) {
      if (question.ask === "walk") this.stop("superseded"); // what is asked of the last problem
      for (const [kind, news] of made) heard(kind, news);
      return "end";
    }
    while (this.#asked) {
      const before = this.#asked, left = PATIENCE - (performance.now() - before.since);
      await Promise.race([before.over, new Promise((resolve) => { setTimeout(resolve, left); })]);
      if (turn !== this.#turn) return "superseded";
      if (this.#asked === before) this.stop("superseded");
    }
    const id = ++this.#count, asked = this.#asked = { id, since: performance.now() };
    asked.over = new Promise((resolve) => {
      asked.end = (how) => {
        clearTimeout(asked.clock);
        if (this.#asked === asked) this.#asked = null;
        resolve(how);
        this.onstate?.();
      };
    });
    asked.wind = () => {
      clearTimeout(asked.clock);
      asked.clock = setTimeout(() => (this.onlate?.(question) ? asked.wind() : this.stop("late")), 1000 * this.seconds);
    };
    asked.heard = ({ kind, news }) => {
      if (kind === "end") return asked.end("end");
      asked.wind();
      heard(kind, news);
    };
    if (!this.#worker) {
      this.onbegin?.();
      this.#begin();
    }
    this.onstate?.();
    try {
      await this.#ready;
    } catch {
      asked.end("broken");
    }
    if (this.#asked === asked) {
      asked.wind();
      asked.since = performance.now();
      this.#worker.postMessage({ id, ...question });
    }
    return asked.over;
  }

  /* End what is being asked: Python cannot be interrupted, so that a new worker begins. */
  stop(how = "stopped") {
    const asked = this.#asked;
    if (!asked) return;
    if (asked.clock !== undefined) {
      this.#worker.terminate();
      this.#begin();
    }
    asked.end(how);
  }
}
