/* A motion in an element of a page: mount(element, page) builds all that is seen, and returns what
 * moves it: { time, state, seek, play, pause, run }.
 *
 * page: { module: the emitted module, with gauss; x, p, u: the start, in the module's order;
 * t, tol: how long, how exact; entries: [row, column, place] of the element of the group in x;
 * labels: { name: [meaning, unit] }; kept: { name: words }; units: { t, energy }; body: see moving_body.py; words, comma }.
 * Texts of a problem come in as text, never as markup. */
function mount(element, page) {
  const module = page.module, words = page.words, body = page.body;
  const { abs, atan2, cbrt, ceil, cos, exp, floor, hypot, log10, log2, max, min, round, sqrt, sin, PI, sign } = Math;
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;

  /* ---- words and numbers */

  const letters = "alpha α beta β gamma γ delta δ epsilon ε zeta ζ eta η theta θ kappa κ lambda λ mu μ nu ν xi ξ rho ρ sigma σ tau τ phi φ chi χ psi ψ omega ω Gamma Γ Delta Δ Theta Θ Pi Π Omega Ω".split(" ");
  const low = (digits) => [...digits].map((d) => "₀₁₂₃₄₅₆₇₈₉"[d] ?? d).join("");
  /* zeta_1 is ζ₁; longer names stay words */
  const called = (name) => {
    const [, stem, end] = new RegExp("^([A-Za-z]+?)_?([0-9_]*)$").exec(name) ?? [];
    const short = letters[letters.indexOf(stem) + 1 || -1] ?? (stem?.length < 3 ? stem : "");
    return short ? short + low(end.replaceAll("_", ",")) : name.replaceAll("_", " ");
  };
  const mark = (text) => (page.comma ? text.replace(".", ",") : text).replace("-", "−");
  const shown = (v, digits = 5) => {
    const size = abs(v);
    const small = size !== 0 && size < 1e-3, large = size >= 1e6;
    if (digits > 2 && size < 1e-14) return "0";
    return mark(small || large ? v.toExponential(min(digits - 1, 3)) : String(Number(v.toPrecision(digits))));
  };
  const on = (what, name, does, how) => what.addEventListener(name, does, how);
  const make = (tag, given = {}, ...inside) => {
    const made = document.createElement(tag);
    for (const [name, v] of Object.entries(given)) {
      if (typeof v === "function") on(made, name, v);
      else made.setAttribute(name, v);
    }
    made.append(...inside);
    return made;
  };

  /* ---- the run: marks on a grid of times, between them the motion is made again when asked for */

  const GRID = 1500, CHUNK = 64;
  function begun(p, u, x) {
    const k = module.constants(p), each = page.t / GRID;
    const marks = [Float64Array.from(x)];
    const ahead = module.begin(0, x);
    let here = module.begin(0, x), from = 0, ended = false;
    const until = (m, t, late) => {
      while (m.t < t) {
        if (performance.now() > late) return false;
        const next = min(t, m.t + CHUNK * (m.next || each));
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
        while (!ended && run.last < t && marks.length <= GRID) {
          const next = marks.length === GRID ? page.t : marks.length * each;
          if (!until(ahead, next, late)) return false;
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

  /* ---- small matrices */

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const plus = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
  const scaled = (s, a) => [s * a[0], s * a[1], s * a[2]];
  const size = (a) => hypot(...a);
  const times = (A, B) => A.map((row) => B[0].map((_, j) => row.reduce((sum, v, i) => sum + v * B[i][j], 0)));

  /* exp X by the series of X/2^s, squared s times */
  function exponential(X) {
    const large = max(...X.map((row) => row.reduce((sum, v) => sum + abs(v), 0)));
    const halvings = large > 0 ? max(0, ceil(log2(large)) + 1) : 0;
    let term = X.map((row, i) => row.map((_, j) => Number(i === j))), total = term;
    for (let k = 1; k < 18; ++k) {
      term = times(term, X.map((row) => row.map((v) => v / 2 ** halvings / k)));
      total = total.map((row, i) => row.map((v, j) => v + term[i][j]));
    }
    for (let k = 0; k < halvings; ++k) total = times(total, total);
    return total;
  }

  /* eigenvalues and unit eigenvectors of a symmetric 3 × 3, by Jacobi's rotations */
  function principal(S) {
    let A = S.map((row) => [...row]), V = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    for (let k = 0; k < 24; ++k) {
      const [i, j] = [[0, 1], [0, 2], [1, 2]][k % 3];
      const a = atan2(2 * A[i][j], A[j][j] - A[i][i]) / 2;
      const R = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], T = R.map((row) => [...row]);
      R[i][i] = R[j][j] = T[i][i] = T[j][j] = cos(a);
      R[i][j] = T[j][i] = sin(a);
      R[j][i] = T[i][j] = -sin(a);
      A = times(T, times(A, R));
      V = times(V, R);
    }
    return [0, 1, 2].map((i) => [A[i][i], V.map((row) => row[i])]);
  }

  /* ---- the body: what its trees are for some parameters */

  function valued(p) {
    const by = Object.fromEntries(module.PARAMETERS.map((name, i) => [name, p[i]]));
    const rules = {
      add: (...a) => a.reduce((x, y) => x + y),
      mul: (...a) => a.reduce((x, y) => x * y),
      div: (a, b) => a / b,
      pow: (a, b) => a ** b,
    };
    const of = (t) => {
      if (typeof t === "number") return t;
      if (typeof t === "string") {
        const [over, under = 1] = t.split("/");
        return t === "π" ? PI : over / under;
      }
      if (t[0] === "par") return by[t[1]] ?? 1; /* a mass that the motion does not need */
      if (t[0] === "fun") return Math[t[1]](of(t[2]));
      return rules[t[0]]?.(...t.slice(1).map(of)) ?? NaN;
    };
    const vector = (list) => [0, 1, 2].map((i) => (i < list.length ? of(list[i]) : 0));
    return { of, vector };
  }

  /* a sheet of m × n faces of a map of the square; each with its tone, 0 or 1 */
  const sheet = (f, m, n, tone = () => 0) => {
    const faces = [];
    for (let i = 0; i < m; ++i) {
      for (let j = 0; j < n; ++j) {
        const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        faces.push({ tone: tone(i, j), v: corners.map(([a, b]) => f(a / m, b / n)) });
      }
    }
    return faces;
  };
  const turn = (a, r, z) => [r * cos(2 * PI * a), r * sin(2 * PI * a), z];
  const sector = (i) => floor(i / 4) % 2;
  const disc = (z) => sheet((a, b) => turn(a, b, z), 32, 2, sector);
  const SHAPES = {
    ball: () => sheet((a, b) => turn(a, sin(PI * b), -cos(PI * b)), 32, 16,
      (i, j) => (sector(i) + Number(j < 8)) % 2),
    cylinder: () => [...sheet((a, b) => turn(a, 1, 2 * b - 1), 32, 4, sector), ...disc(1), ...disc(-1)],
    cone: () => [...sheet((a, b) => turn(a, 1 - b, b), 32, 6, sector), ...disc(0)],
    box: () => [0, 1, 2].flatMap((k) => [1, -1].flatMap((side) => sheet((a, b) => {
      const u = [0, 0, 0];
      u[k] = side;
      u[(k + 1) % 3] = 2 * a - 1;
      u[(k + 2) % 3] = 2 * b - 1;
      return u;
    }, 4, 4, () => Number(k === 2)))),
    tetrahedron: () => {
      const c = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
      return c.map((_, k) => ({ tone: k % 2, v: c.filter((_, i) => i !== k) }));
    },
  };

  function built(p) {
    const { of, vector } = valued(p);
    const parts = body.parts.map((part) => {
      const points = Object.fromEntries(part.points.map(([id, m, at]) => [id, { mass: of(m), at: vector(at) }]));
      const matter = Object.values(points).filter((x) => x.mass > 0);
      const faces = [];
      for (const solid of part.solids) {
        const shift = vector(solid.shift);
        if (solid.faces) {
          faces.push(...solid.faces.map((f) => ({ tone: 0, v: f.map((i) => solid.vertices[i]) })));
          continue;
        }
        const columns = solid.quadric
          ? principal(solid.quadric.map(vector)).map(([q, v]) => scaled(1 / sqrt(q), v))
          : solid.columns.map(vector);
        const place = (u) => columns.reduce((r, column, k) => plus(r, column, u[k]), shift);
        faces.push(...SHAPES[solid.shape]().map((f) => ({ ...f, v: f.v.map(place) })));
      }
      let centre = [0, 0, 0];
      if (part.moments) {
        const m = of(part.moments.m), c = vector(part.moments.c), J = part.moments.J.map(vector);
        if (m > 0) centre = scaled(1 / m, c);
        if (!faces.length && !matter.length) { /* the solid ellipsoid of these moments */
          const spread = J.map((row, i) => row.map((v, j) => v / m - centre[i] * centre[j]));
          const axes = principal(spread).map(([q, v]) => scaled(sqrt(5 * max(q, 0)) || 0, v));
          const least = 0.02 * max(...axes.map(size));
          const thick = axes.map((a, k) => (size(a) > least ? a : scaled(least, principal(spread)[k][1])));
          faces.push(...SHAPES.ball().map((f) => ({ ...f, v: f.v.map((u) => thick.reduce((r, a, k) => plus(r, a, u[k]), centre)) })));
        }
      } else if (matter.length) {
        const m = matter.reduce((sum, x) => sum + x.mass, 0);
        centre = matter.reduce((r, x) => plus(r, x.at, x.mass / m), centre);
      }
      const edges = [];
      if (!faces.length && matter.length < 5) {
        const corners = matter.map((x) => x.at);
        if (part.fixed && corners.length < 4) corners.push([0, 0, 0]);
        corners.forEach((a, i) => corners.slice(0, i).forEach((b) => edges.push([a, b])));
        if (corners.length > 2) {
          const skip = corners.length > 3 ? corners.map((_, k) => k) : [-1];
          faces.push(...skip.map((k) => ({ tone: 0, clear: true, v: corners.filter((_, i) => i !== k) })));
        }
      }
      const every = [...faces.flatMap((f) => f.v), ...Object.values(points).map((x) => x.at)];
      const reach = max(...every.map(size), 0) || 1;
      const tips = [0, 1, 2].slice(0, part.n).map((k) => {
        const e = [0, 0, 0];
        e[k] = max(0.5 * reach, ...every.map((r) => r[k])) + 0.28 * reach;
        return e;
      });
      const heavy = max(...matter.map((x) => x.mass), 0) || 1;
      const traced = part.deforms ? matter.slice(0, 4).map((x) => x.at) : part.fixed ? [tips.at(-1)] : [centre];
      const centres = part.attractions.map((a) => ({ at: vector(a.centre), on: a.on }));
      const anchors = part.anchors.map((a) => ({ on: a.on, at: vector(a.at) }));
      return { ...part, points, faces, edges, centre, reach, tips, heavy, traced, centres, anchors };
    });
    return { parts, gravity: vector(body.gravity), reach: max(...parts.map((x) => x.reach)) };
  }

  /* what is built, with the height of its middle at first, and that of the ground: where it stands */
  function placed(made, x) {
    const { above } = eye;
    const heights = made.parts.flatMap((part) => {
      const at = moved(part, x);
      return [...part.faces.flatMap((f) => f.v), ...Object.values(part.points).map((r) => r.at)].map((r) => dot(above, at(r)));
    });
    const low = min(...heights, 0), high = max(...heights, 0);
    made.middle = scaled((low + high) / 2, above);
    made.level = low > -1e-6 * made.reach && made.parts[0].fixed ? 0 : low - 0.25 * made.reach;
    return made;
  }

  /* the place in space of a point of the body */
  const moved = ({ map }, x) => {
    const M = map.map((row, i) => row.map((at, j) => (at < 0 ? Number(i === j) : x[at])));
    return (r) => [0, 1, 2].map((i) => M[i][0] * r[0] + M[i][1] * r[1] + M[i][2] * r[2] + M[i][3]);
  };

  /* ---- colours */

  const scheme = matchMedia("(prefers-color-scheme: dark)");
  let colours = {};
  function recolour() {
    const style = getComputedStyle(element);
    const read = (name) => style.getPropertyValue(`--${name}`).trim();
    const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
    const shades = (name) => Array.from({ length: 33 }, (_, i) => {
      const light = 0.62 + 0.48 * i / 32;
      return `rgb(${rgb(read(name)).map((v) => min(255, round(light < 1 ? v * light : v + (255 - v) * (light - 1)))).join(" ")})`;
    });
    colours = { tones: [["body", "pale"], ["other", "pale"]].map((pair) => pair.map(shades)) };
    for (const name of ["ink", "soft", "line", "paper", "mark", "e1", "e2", "e3"]) colours[name] = read(name);
    colours.lines = ["e3", "e1", "e2", "mark", "other", "soft"].map(read);
  }

  /* ---- canvases: sharp on every screen; a camera that turns by mouse, touch and keys */

  function canvas(label) {
    const shown = make("canvas", { role: "img", "aria-label": label, tabindex: 0 });
    const pen = shown.getContext("2d");
    const sized = { element: shown, pen, width: 1, height: 1 };
    new ResizeObserver(() => {
      const sharp = min(devicePixelRatio || 1, 2.5);
      sized.width = shown.clientWidth;
      sized.height = shown.clientHeight;
      shown.width = round(sized.width * sharp);
      shown.height = round(sized.height * sharp);
      pen.setTransform(sharp, 0, 0, sharp, 0, 0);
      if (run) show(run.at(time), before); // the new size has wiped it
      ask();
    }).observe(shown);
    return sized;
  }

  function camera({ element: seen }, up, azimuth, elevation) {
    const eye = { azimuth, elevation, zoom: 1 };
    const k = up.reduce((most, v, i) => (abs(v) >= abs(up[most]) ? i : most), 0);
    const unit = (i, s = 1) => [0, 1, 2].map((j) => (i % 3 === j ? s : 0));
        const ahead = unit(up[k] < 0 ? k + 2 : k + 1), aside = unit(up[k] < 0 ? k + 1 : k + 2), above = unit(k, up[k] < 0 ? -1 : 1);
    eye.above = above;
    eye.look = () => {
      const a = eye.azimuth, e = eye.elevation;
      const level = plus(scaled(cos(a), ahead), aside, sin(a));
      eye.right = plus(scaled(-sin(a), ahead), aside, cos(a));
      eye.up = plus(scaled(-sin(e), level), above, cos(e));
      eye.towards = plus(scaled(cos(e), level), above, sin(e));
    };
    const turned = (dx, dy) => {
      eye.azimuth -= dx;
      eye.elevation = max(-1.55, min(1.5708, eye.elevation + dy));
      ask();
    };
    const zoomed = (by) => {
      eye.zoom = max(0.1, min(20, eye.zoom * by));
      ask();
    };
    const down_at = new Map();
    const apart = () => {
      const [a, b] = [...down_at.values()];
      return b ? hypot(a[0] - b[0], a[1] - b[1]) : 0;
    };
    on(seen, "pointerdown", (e) => {
      down_at.set(e.pointerId, [e.clientX, e.clientY]);
      seen.setPointerCapture(e.pointerId);
    });
    on(seen, "pointermove", (e) => {
      const was = down_at.get(e.pointerId), before = apart();
      if (!was) return;
      down_at.set(e.pointerId, [e.clientX, e.clientY]);
      if (before) zoomed(apart() / before);
      else turned((e.clientX - was[0]) / 130, (e.clientY - was[1]) / 130);
    });
    for (const over of ["pointerup", "pointercancel"]) on(seen, over, (e) => down_at.delete(e.pointerId));
    on(seen, "wheel", (e) => {
      e.preventDefault();
      zoomed(exp(-e.deltaY / 600));
    }, { passive: false });
    on(seen, "dblclick", () => {
      Object.assign(eye, { azimuth, elevation, zoom: 1 });
      ask();
    });
    on(seen, "keydown", (e) => {
      const by = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[e.key];
      const nearer = { "+": 1.15, "=": 1.15, "-": 1 / 1.15 }[e.key];
      if (by) turned(...by);
      else if (nearer) zoomed(nearer);
      else return;
      e.preventDefault();
      e.stopPropagation();
    });
    return eye;
  }

  /* ---- pictures: items with a depth, the farthest first */

  function picture(view, eye, target, scale) {
    eye.look();
    const far = 8 * min(view.width, view.height) / scale / 2, items = [];
    const to = (r) => {
      const q = plus(r, target, -1), z = dot(eye.towards, q);
      const f = scale * far / max(far - z, far / 20);
      return [view.width / 2 + f * dot(eye.right, q), view.height / 2 - f * dot(eye.up, q), z];
    };
    const { pen } = view;
    const path = (list) => {
      pen.beginPath();
      list.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    };
    const mean = (list) => list.reduce((sum, v) => sum + v[2], 0) / list.length;
    const lit = scaled(1 / size([-0.45, 0.65, 0.75]), [-0.45, 0.65, 0.75]);
    const own = {
      to, path,
      face(v, tones, clear) {
        const s = v.map(to), m = cross(plus(v[2], v[0], -1), plus(v.at(-1), v[1], -1));
        const w = [dot(m, eye.right), dot(m, eye.up), dot(m, eye.towards)], long = size(w) || 1;
        const light = max(0, sign(w[2] || 1) * dot(w, lit) / long);
        items.push([mean(s), () => {
          path(s);
          pen.closePath();
          pen.globalAlpha = clear ? 0.28 : 1;
          pen.fillStyle = pen.strokeStyle = tones[round(32 * light)];
          pen.fill();
          pen.lineWidth = 0.8;
          if (!clear) pen.stroke();
          pen.globalAlpha = 1;
        }]);
      },
      line(a, b, colour, width = 1.2, alpha = 1, lift = 0) {
        const s = [to(a), to(b)];
        items.push([mean(s) + lift, () => {
          path(s);
          pen.globalAlpha = alpha;
          pen.strokeStyle = colour;
          pen.lineWidth = width;
          pen.stroke();
          pen.globalAlpha = 1;
        }]);
      },
      dot(r, radius, colour, ring) {
        const [x, y, z] = to(r);
        items.push([z, () => {
          pen.beginPath();
          pen.arc(x, y, radius, 0, 7);
          pen.fillStyle = ring ? colours.paper : colour;
          pen.strokeStyle = ring ? colour : colours.paper;
          pen.lineWidth = ring ? 1.4 : 1;
          pen.fill();
          pen.stroke();
        }]);
      },
      spring(a, b, colour) {
        const [p, q] = [to(a), to(b)], long = hypot(q[0] - p[0], q[1] - p[1]);
        if (long < 3) return;
        const aside = [-(q[1] - p[1]) / long, (q[0] - p[0]) / long], turns = 14, wide = min(5, long / 8);
        const points = [p];
        for (let i = 0; i <= turns; ++i) {
          const f = 0.14 + 0.72 * i / turns, s = i === 0 || i === turns ? 0 : (i % 2 ? wide : -wide);
          points.push([0, 1].map((k) => p[k] + f * (q[k] - p[k]) + s * aside[k]));
        }
        points.push(q);
        items.push([(p[2] + q[2]) / 2, () => {
          path(points);
          pen.strokeStyle = colour;
          pen.lineWidth = 1.2;
          pen.stroke();
        }]);
      },
      arrow(a, b, colour, name) {
        for (let i = 0; i < 8; ++i) own.line(plus(scaled(1 - i / 8, a), b, i / 8), plus(scaled(1 - (i + 1) / 8, a), b, (i + 1) / 8), colour, 1.6);
        const [x, y, z] = to(b), [u, v] = to(plus(scaled(0.1, a), b, 0.9));
        const long = hypot(x - u, y - v) || 1, c = (x - u) / long, s = (y - v) / long;
        items.push([z, () => {
          if (long > 1) {
            path([[x + 3 * c, y + 3 * s], [x - 6 * c - 3 * s, y - 6 * s + 3 * c], [x - 6 * c + 3 * s, y - 6 * s - 3 * c]]);
            pen.fillStyle = colour;
            pen.fill();
          }
          own.text(name, x + 13 * c, y + 13 * s, colour);
        }]);
      },
      text(what, x, y, colour, align = "center") {
        pen.fillStyle = colour;
        pen.font = "italic 13px Georgia, serif";
        pen.textAlign = align;
        pen.textBaseline = "middle";
        pen.fillText(what, x, y);
      },
      done() {
        items.sort((a, b) => a[0] - b[0]).forEach((x) => x[1]());
      },
    };
    pen.clearRect(0, 0, view.width, view.height);
    pen.lineJoin = pen.lineCap = "round";
    return own;
  }

  /* ---- what is moved by the reader */

  const p = [...page.p], u = [...page.u], x0 = [...page.x];
  const theta = page.entries.length ? module.BASIS.map(() => 0) : [];
  const place = new Map(page.entries.map(([i, j, at]) => [at, [i, j]]));
  const velocity = x0.map((_, s) => s).filter((s) => !place.has(s));

  function start() {
    const x = [...x0];
    if (!theta.some((a) => a !== 0)) return x;
    const g = module.BASIS[0].map((row, i) => row.map((_, j) => Number(i === j)));
    for (const [i, j, at] of page.entries) g[i][j] = x0[at];
    const X = g.map((row, i) => row.map((_, j) => theta.reduce((sum, a, k) => sum + a * module.BASIS[k][i][j], 0)));
    const turned = times(g, exponential(X));
    for (const [i, j, at] of page.entries) x[at] = turned[i][j];
    return x;
  }

  let run, drawn, time = 0, wanted = null, playing = false, trail = [], reached = 0, first = {}, told = 0;

  const message = make("p", { class: "message", role: "status" });
  function restart(keep) {
    try {
      run = begun(p, u, start());
    } catch (e) {
      message.textContent = words.singular;
      pause();
      return;
    }
    message.textContent = "";
    drawn = body.parts.length ? placed(built(p), run.at(0)) : null;
    reached = 0;
    trail = [];
    first = invariants(0, run.at(0));
    time = 0;
    wanted = keep ? time : null;
    told = 0;
    ask();
  }

  function invariants(t, x) {
    const found = {};
    if (module.energy) found.energy = module.energy(t, x, run.k);
    const kept = module.CONSERVED ?? [];
    const values = kept.length ? module.conserved(t, x, run.k) : [];
    kept.forEach((name, i) => {
      if (name !== "energy") found[name] = values[i];
    });
    if (module.defect) found.defect = module.defect(x);
    if (module.multiplier) found.multiplier = module.multiplier(t, x, run.k, u);
    return found;
  }

  /* ---- the stage */

  const stage = canvas(words.stage);
  const eye = camera(stage, body.parts.length ? scaled(-1, built(p).gravity) : [0, 0, 1],
    body.planar ? -PI / 2 : 0.55, body.planar ? 1.5708 : 0.33);

  function draw_body(x) {
    const { parts, gravity } = drawn;
    const spots = parts.map((part) => moved(part, x));
    const free = parts.every((part) => !part.fixed && !part.centres.length && !part.anchors.length);
    const target = free ? spots[0](parts[0].centre) : drawn.middle;
    const ends = parts.flatMap((part, i) => [...part.tips, ...Object.values(part.points).map((r) => r.at)].map((r) => size(plus(spots[i](r), target, -1))));
    const about = parts.flatMap((part) => [...part.centres, ...part.anchors].map((c) => min(size(plus(c.at, target, -1)), 4 * drawn.reach)));
    reached = max(reached, drawn.reach, ...ends, ...about);
    const scale = 0.42 * min(stage.width, stage.height) / reached * eye.zoom;
    const pic = picture(stage, eye, target, scale);
    ground(pic, target, spots);
    parts.forEach((part, i) => {
      const at = spots[i], tones = colours.tones[i % 2];
      for (const f of part.faces) pic.face(f.v.map(at), tones[f.tone], f.clear);
      for (const [a, b] of part.edges) pic.line(at(a), at(b), tones[0][10], 1.4);
      for (const r of Object.values(part.points)) {
        pic.dot(at(r.at), r.mass > 0 ? 6.5 * cbrt(max(r.mass / part.heavy, 0.1)) : 2.5, tones[0][6]);
      }
      const o = at([0, 0, 0]);
      part.tips.forEach((tip, k) => pic.arrow(o, at(tip), colours[`e${k + 1}`], `e${low(String(k + 1))}`));
      if (part.fixed) pic.dot(o, 4, colours.ink, true);
      for (const { at: c, on } of part.centres) {
        for (const id of on) pic.line(at(part.points[id].at), c, colours.soft, 1, 0.6);
        pic.dot(c, 6, colours.mark, true);
        pic.dot(plus(c, eye.towards, 1e-6), 2, colours.mark);
      }
      for (const { at: c, on } of part.anchors) {
        pic.spring(at(part.points[on].at), c, colours.ink);
        pic.dot(c, 4.5, colours.soft);
      }
      for (let k = 0; k + 1 < trail.length; ++k) {
        const [, a] = trail[k], [, b] = trail[k + 1];
        const age = (k + 1) / trail.length, from = moved(part, a), to = moved(part, b);
        for (const r of part.traced) pic.line(from(r), to(r), colours.mark, 1.5, age * age);
      }
    });
    for (const [i, a, j, b] of body.springs) pic.spring(spots[i](parts[i].points[a].at), spots[j](parts[j].points[b].at), colours.ink);
    pic.done();
    const strength = size(gravity);
    if (strength) {
      const g = scaled(30 / strength, gravity), dx = dot(g, eye.right), dy = -dot(g, eye.up);
      const X = stage.width - 34, Y = 44, { pen } = stage;
      const long = hypot(dx, dy), c = dx / (long || 1), s = dy / (long || 1);
      pen.strokeStyle = pen.fillStyle = colours.soft;
      pen.lineWidth = 1.5;
      pic.path([[X - dx / 2, Y - dy / 2], [X + dx / 2, Y + dy / 2]]);
      pen.stroke();
      pic.path([[X + dx / 2 + 4 * c, Y + dy / 2 + 4 * s], [X + dx / 2 - 5 * c - 3.5 * s, Y + dy / 2 - 5 * s + 3.5 * c], [X + dx / 2 - 5 * c + 3.5 * s, Y + dy / 2 - 5 * s - 3.5 * c]]);
      pen.fill();
      pic.text("g", X + 14, Y, colours.soft);
    }
  }

  /* a faint net below the body, or where it stands; it goes with a body that flies, line by line */
  function ground(pic, target, spots) {
    if (body.planar) return;
    const { above } = eye, k = above.findIndex((v) => v !== 0), s = above[k];
    const h = s * drawn.level, side = reached / 2, lines = 5;
    if (abs(h - target[k]) > 6 * reached) return;
    const [i, j] = [(k + 1) % 3, (k + 2) % 3];
    const middle = [i, j].map((a) => side * round(target[a] / side));
    const { pen } = stage;
    pen.strokeStyle = colours.line;
    pen.lineWidth = 1;
    for (let a = -lines; a <= lines; ++a) {
      for (const [c, d, m] of [[i, j, 0], [j, i, 1]]) {
        const end = (b) => {
          const r = [0, 0, 0];
          r[k] = h;
          r[c] = middle[m] + a * side;
          r[d] = middle[1 - m] + b * side;
          return pic.to(r);
        };
        const wide = sqrt(lines * lines - a * a + 0.01);
        pic.path([end(-wide), end(wide)]);
        pen.stroke();
      }
    }
  }

  /* curves of some places of the state in time */
  function draw_chart(view, places) {
    const { pen } = view;
    pen.clearRect(0, 0, view.width, view.height);
    if (trail.length < 2) return;
    const t0 = trail[0][0], t1 = trail.at(-1)[0] || 1;
    const all = trail.flatMap(([, x]) => places.map((s) => x[s]));
    let low = min(...all), high = max(...all);
    const middle = (low + high) / 2, half = max((high - low) / 2, 0.02 * max(abs(low), abs(high)), 1e-12);
    [low, high] = [middle - 1.08 * half, middle + 1.08 * half];
    const X = (t) => 8 + (view.width - 50) * (t - t0) / (t1 - t0), Y = (v) => 8 + (view.height - 16) * (high - v) / (high - low);
    pen.lineWidth = 1;
    pen.strokeStyle = colours.line;
    if (low < 0 && high > 0) {
      pen.beginPath();
      pen.moveTo(8, Y(0));
      pen.lineTo(view.width - 42, Y(0));
      pen.stroke();
    }
    pen.font = "12px Georgia, serif";
    pen.textBaseline = "middle";
    pen.textAlign = "left";
    const ends = places.map((s, i) => [Y(trail.at(-1)[1][s]), s, colours.lines[i % 6]]).sort((a, b) => a[0] - b[0]);
    let above = -Infinity;
    for (const [y, s, colour] of ends) {
      pen.strokeStyle = pen.fillStyle = colour;
      pen.lineWidth = 1.5;
      pen.beginPath();
      trail.forEach(([t, x], i) => (i ? pen.lineTo(X(t), Y(x[s])) : pen.moveTo(X(t), Y(x[s]))));
      pen.stroke();
      above = max(y, above + 13);
      if (above < view.height - 4) pen.fillText(called(module.STATE[s]), view.width - 38, above);
    }
  }

  /* the angular velocity in the body, on the ellipsoid of its energy where the body only turns */
  function draw_polhode(x) {
    const at = (y) => body.polhode.map((s) => y[s]);
    const inertia = drawn.inertia ??= found_inertia(x);
    const now = at(x), turning = inertia && dot(now, inertia.map((row) => dot(row, now)));
    const axes = turning > 0 && principal(inertia).map(([q, v]) => (q > 0 ? scaled(sqrt(turning / q), v) : null));
    const wires = axes && axes.every(Boolean) ? axes : [];
    const most = max(...trail.map(([, y]) => size(at(y))), size(now), ...wires.map(size)) || 1;
    const pic = picture(side, glance, [0, 0, 0], 0.4 * min(side.width, side.height) / most * glance.zoom);
    wires.forEach((a, i) => {
      const b = wires[(i + 1) % 3];
      for (let k = 0; k < 48; ++k) {
        const on = (j) => plus(scaled(cos(j * PI / 24), a), b, sin(j * PI / 24));
        pic.line(on(k), on(k + 1), colours.soft, 0.8, 0.55);
      }
    });
    for (let k = 0; k < 3; ++k) {
      const e = [0, 0, 0];
      e[k] = 1.08 * most;
      pic.arrow([0, 0, 0], e, colours[`e${k + 1}`], `ζ${low(String(k + 1))}`);
    }
    for (let k = 0; k + 1 < trail.length; ++k) pic.line(at(trail[k][1]), at(trail[k + 1][1]), colours.mark, 1.6, 0.15 + 0.85 * k / trail.length, 0.02 * most);
    pic.line([0, 0, 0], now, colours.ink, 1.2, 0.7);
    pic.dot(now, 3.5, colours.mark);
    pic.done();
  }

  /* the matrix of the kinetic energy in the angular velocity, which the energy says */
  function found_inertia(x) {
    if (!body.turns || !module.energy) return null;
    const E = (w) => {
      const y = Float64Array.from(x);
      body.polhode.forEach((s, i) => (y[s] = w[i]));
      return module.energy(0, y, run.k);
    };
    const e = (i, j) => [0, 1, 2].map((k) => Number(k === i) + Number(k === j)), rest = E([0, 0, 0]);
    const one = (i) => 2 * (E(e(i, -1)) - rest);
    return [0, 1, 2].map((i) => [0, 1, 2].map((j) => (i === j ? one(i) : E(e(i, j)) - rest - (one(i) + one(j)) / 2)));
  }

  /* ---- the frame */

  let asked = 0, before = 0;
  function ask() {
    asked ||= requestAnimationFrame(frame);
  }

  function frame(now) {
    asked = 0;
    if (!run) return;
    const late = performance.now() + 14;
    if (playing) {
      const by = min(0.1, (now - before) / 1000 || 1 / 60) * speed;
      const next = min(time + by, page.t);
      run.reach(next, late);
      time = min(next, run.last >= next ? next : max(time, run.last));
      if (time >= page.t || run.ended && time >= run.last) pause();
      push();
    } else if (wanted !== null) {
      const ready = run.reach(wanted, late);
      time = min(wanted, run.last);
      if (ready || run.ended) {
        wanted = null;
        fill();
      }
    } else if (!trail.length) {
      fill();
    }
    before = now;
    show(run.at(time), now);
    if (playing || wanted !== null) ask();
  }

  const TRAIL = 480;
  function push() {
    if (!trail.length || time > trail.at(-1)[0]) trail.push([time, run.at(time).slice()]);
    if (trail.length > TRAIL) trail.shift();
  }

  /* the trail before a time that was not played up to */
  function fill() {
    const each = speed / 60, count = min(TRAIL, floor(time / each));
    trail = [];
    for (let i = count; i >= 0; --i) {
      const t = max(0, time - i * each);
      trail.push([t, run.at(t).slice()]);
    }
  }

  function show(x, now) {
    if (drawn) draw_body(x);
    else draw_chart(stage, state_places);
    if (drawn && body.polhode.length) draw_polhode(x);
    else if (drawn) draw_chart(side, velocity.slice(0, 9));
    clock.textContent = ["t =", mark(time.toFixed(places)), page.units.t].join(" ");
    if (document.activeElement !== slider || playing) slider.value = time / page.t * 1000;
    slider.setAttribute("aria-valuetext", clock.textContent);
    if (now - told > 90 || !playing) {
      told = now;
      for (const [name, v] of Object.entries(invariants(time, x))) {
        const [value, change] = rows[name];
        value.textContent = name === "defect" ? shown(v, 2) : shown(v);
        value.classList.toggle("wrong", name === "multiplier" && !(v > 0));
        if (change) {
          const by = abs(v - first[name]);
          change.textContent = by === 0 ? "0" : mark(by.toExponential(0));
        }
      }
      if (run.ended && time >= run.last) message.textContent = words.ended;
    }
  }

  const many = [...x0.keys()].sort((a, b) => abs(x0[b]) - abs(x0[a]) || a - b);
  const state_places = many.slice(0, 12).sort((a, b) => a - b);

  /* ---- controls */

  const nice = (v) => {
    const power = 10 ** floor(log10(v));
    return power * [1, 2, 5, 10].reduce((best, c) => (c * power <= v * 1.001 ? c : best), 1);
  };
  function first_speed() {
    const k = module.constants(p), x = start(), rates = module.rhs(0, x, k, u);
    const places = page.entries.length ? page.entries.map((e) => e[2]) : velocity;
    const large = (list) => max(...list.map(abs), 1e-12);
    const rate = large(places.map((s) => rates[s])) / large(places.map((s) => x[s]));
    return nice(max(1e-6, min(max(1, page.t / 60), 16 / max(rate, 1e-9))));
  }
  let speed = 1;
  try {
    speed = first_speed();
  } catch (e) { /* told by restart */ }
  const places = max(2, min(6, ceil(2 - log10(speed))));

  const button = (glyph, label, does) => make("button", { type: "button", "aria-label": label, title: label, click: does }, glyph);
  const toggle = button("▶", words.play, () => (playing ? pause() : play()));
  function play() {
    if (time >= page.t || run?.ended && time >= run.last) restart();
    playing = true;
    wanted = null;
    before = NaN;
    toggle.textContent = "❚❚";
    toggle.setAttribute("aria-label", toggle.title = words.pause);
    ask();
  }
  function pause() {
    playing = false;
    toggle.textContent = "▶";
    toggle.setAttribute("aria-label", toggle.title = words.play);
  }
  function seek(t) {
    pause();
    wanted = max(0, min(page.t, t));
    ask();
  }
  const stepped = (by) => seek((wanted ?? time) + by * speed / 30);
  const clock = make("span", { class: "clock" });
  const slider = make("input", {
    type: "range", min: 0, max: 1000, step: "any", value: 0, "aria-label": words.time, class: "time",
    input: () => seek(slider.value / 1000 * page.t),
  });
  const speeds = make("select", { "aria-label": words.speed, title: words.speed, change: () => {
    speed = Number(speeds.value);
    trail = [];
    ask();
  } });
  for (let e = floor(log10(speed)) - 1; e < log10(speed) + 2; ++e) {
    for (const c of [1, 2, 5]) {
      const v = Number(`${c}e${e}`);
      speeds.append(make("option", { value: v, ...(abs(v / speed - 1) < 1e-6 ? { selected: "" } : {}) }, `× ${mark(String(v))}`));
    }
  }
  speed = Number(speeds.value);

  const adjusters = [];
  function adjuster(name, title, unit, initial, low_end, high_end, put) {
    const range = make("input", { type: "range", min: low_end, max: high_end, step: "any", value: initial, "aria-label": `${called(name)} ${title}` });
    const exact = make("input", { type: "number", step: "any", value: initial, "aria-label": called(name) });
    const take = (v, other) => {
      if (!Number.isFinite(v)) return;
      put(v);
      other.value = Number(v.toPrecision(6));
      restart();
    };
    on(range, "input", () => take(range.valueAsNumber, exact));
    on(exact, "change", () => {
      const v = exact.valueAsNumber;
      if (v < Number(range.min)) range.min = v;
      if (v > Number(range.max)) range.max = v;
      take(v, range);
      range.value = v;
    });
    adjusters.push(() => {
      put(initial);
      exact.value = range.value = initial;
    });
    exact.value = Number(initial.toPrecision(6));
    return make("div", { class: "adjuster", "data-name": name },
      make("span", { class: "name" }, called(name)), range, exact, make("span", { class: "unit" }, unit.replace("^2", "²").replace("^3", "³")),
      ...(title ? [make("small", {}, title)] : []));
  }
  const span = (v, least = 1) => (v > 0 ? [0, 2 * v] : v < 0 ? [2 * v, 0] : [-least, least]);
  const about = (name) => page.labels[name] ?? ["", ""];
  const fast = max(...velocity.map((s) => abs(x0[s])), 0) || 1;
  const MOST = 24;
  const group = (title, note, rows, open) => rows.length
    ? [make("details", open ? { open: "" } : {}, make("summary", {}, title), ...(note ? [make("p", {}, note)] : []), ...rows)] : [];

  const rows = {};
  const table = make("table", {}, make("thead", {}, make("tr", {}, make("th", {}, words.kept), make("th", {}), make("th", {}, words.change))));
  const lines = make("tbody");
  table.append(lines);
  function tabulate() {
    for (const name of Object.keys(first)) {
      const cells = [make("td"), make("td")], special = name === "defect" || name === "multiplier";
      rows[name] = special ? [cells[0]] : cells;
      const unit = name === "energy" || name === "multiplier" ? page.units.energy : "";
      const label = words[name] ?? page.kept[name];
      lines.append(make("tr", { "data-name": name }, make("th", { scope: "row" }, label, ...(unit ? [make("span", { class: "unit" }, ` ${unit}`)] : [])), ...cells));
    }
  }

  let side, glance;
  const beside = [];
  if (body.parts.length) {
    side = canvas(body.polhode.length ? words.polhode : words.velocities);
    side.element.className = body.polhode.length ? "side" : "side flat";
    if (body.polhode.length) glance = camera(side, [0, 0, 1], 0.6, 0.4);
    beside.push(make("figure", {}, side.element, make("figcaption", {}, body.polhode.length ? words.polhode : words.velocities)));
  }
  const settings = [
    ...group(words.start, "", velocity.slice(0, MOST).map((s) => adjuster(module.STATE[s], ...about(module.STATE[s]), x0[s], ...span(x0[s], fast), (v) => (x0[s] = v))), true),
    ...group(words.element, words.turned, theta.slice(0, MOST).map((_, k) => adjuster(`theta_${k + 1}`, "", "", 0, -3, 3, (v) => (theta[k] = v))), false),
    ...group(words.parameters, "", module.PARAMETERS.map((name, i) => adjuster(name, ...about(name), p[i], ...span(p[i]), (v) => (p[i] = v))), true),
    ...group(words.inputs, "", module.INPUTS.map((name, i) => adjuster(name, ...about(name), u[i], ...span(u[i]), (v) => (u[i] = v))), false),
  ];
  const reset = make("button", { type: "button", class: "reset", click: () => {
    for (const back of adjusters) back();
    restart();
  } }, words.reset);

  element.classList.add("motion");
  element.append(
    make("div", { class: "stage" }, stage.element, message),
    make("div", { class: "controls", role: "group", "aria-label": words.controls },
      button("❘◂", words.again, () => seek(0)), button("◂", words.back, () => stepped(-1)), toggle,
      button("▸", words.step, () => stepped(1)), slider, clock, speeds),
    make("div", { class: "beside" }, ...beside, table, ...settings, reset, make("p", { class: "keys" }, words.keys)),
  );
  on(document, "keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || e.target.closest("input, select, summary, textarea")) return;
    if (e.key === " " && e.target.closest("button")) return;
    const does = { " ": () => (playing ? pause() : play()), ArrowLeft: () => stepped(-1), ArrowRight: () => stepped(1), Home: () => seek(0), End: () => seek(page.t) }[e.key];
    if (does) {
      e.preventDefault();
      does();
    }
  });
  on(scheme, "change", () => {
    recolour();
    ask();
  });
  recolour();
  restart();
  if (run) {
    tabulate();
    if (!still) play();
  }
  return { get time() { return time; }, get state() { return run.at(time); }, get run() { return run; }, seek: seek, play: play, pause: pause };
}
