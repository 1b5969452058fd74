/* The run: marks on a grid of times, between them the motion is made again when asked for. It has no end: where there are
 * more than GRID marks, every other one goes. */

/* a power of two: the times of the marks are exact */
const GRID = 2048;
const CHUNK = 64;

function begun(page, p, u, x) {
  const { module } = page;
  const k = module.constants(p);
  let each = page.t / GRID, marks = [Float64Array.from(x)];
  const ahead = module.begin(0, x);
  let here = module.begin(0, x), from = 0, ended = false;
  const until = (m, t, late) => {
    while (m.t < t) {
      if (performance.now() > late) return false;
      const next = min(t, m.t + CHUNK * (m.h_next || each));
      if (module.gauss_to(m, k, u, next, page.tol) !== 0) {
        ended = true;
        return false;
      }
    }
    return true;
  };
  const run = {
    k, u,
    get last() { return ended ? ahead.t : (marks.length - 1) * each; },
    get ended() { return ended; },
    /* are all times up to t known, or is it too late? */
    reach(t, late) {
      while (!ended && run.last < t) {
        if (marks.length > GRID) {
          marks = marks.filter((_, i) => i % 2 === 0);
          each *= 2;
        }
        if (!until(ahead, marks.length * each, late)) return false;
        marks.push(ahead.x.slice());
      }
      return true;
    },
    at(t) {
      const i = min(floor(t / each), marks.length - 1), mark = i * each;
      if (!(from >= mark && here.t <= t) || i === 0 && t === 0) {
        here = module.begin(mark, marks[i]);
        from = mark;
      }
      until(here, t, Infinity);
      return here.x;
    },
  };
  return run;
}
