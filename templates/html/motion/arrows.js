/* The vectors of the equations, on the body: of each three numbers, in the frame of its part, among those that are read
 * off the motion. page.arrows: { number, from 1; at: the place of the first, part, centre: does it begin at the centre of
 * mass?, matrix: are they nine, of a matrix, whose product with each point is a vector there?, scale: those of one are
 * compared, label }; in a plane a vector out of it is an arc. scene.lit: the number of the one that is pointed at, else 0;
 * scene.large: letters and lines are so many times larger. */
const LENGTHS = { turning: 1.35, momentum: 1.15, sliding: 1, torque: 0.85, force: 0.85 };

function arrows_of(scene, view) {
  const { arrows, meanings, module, pointed, body: { planar } } = scene.page;
  let seen = null, hues = [], drawn = []; // of each line that is drawn the number of its arrow and its ends in the picture

  /* the one that passes near a place of the picture: its number, else 0 */
  const near = (x, y) => {
    let best = 9, found = 0;
    for (const [i, [a, b], [c, d]] of drawn) {
      const u = c - a, v = d - b, s = max(0, min(1, ((x - a) * u + (y - b) * v) / (u * u + v * v || 1)));
      const far = hypot(x - a - s * u, y - b - s * v);
      if (far < best) [best, found] = [far, i];
    }
    return found;
  };
  const point = (now) => {
    if (now === scene.lit) return;
    scene.lit = now;
    scene.ask();
    pointed?.(now);
  };
  on(view.element, "pointermove", (e) => !e.buttons && point(near(e.offsetX, e.offsetY)));
  on(view.element, "pointerleave", () => point(0));

  /* a label, on one side of its place: what follows a _ is smaller, and lower */
  const label = (pic, text, x, beside, colour, side) => {
    const runs = text.split("_").flatMap((part, i) => (i ? [[part[0], 0.72], [part.slice(1), 1]] : [[part, 1]]));
    const font = (f) => (view.pen.font = `italic ${13 * f * (scene.large ?? 1)}px Georgia, serif`);
    const widths = runs.map(([part, f]) => font(f) && view.pen.measureText(part).width);
    const wide = widths.reduce((a, b) => a + b);
    let from = x - side * wide, y = beside;
    const taken = (at) => at > view.height - 6 || pic.written.some(([a, b, w]) => abs(b - at) < 15 && a < from + wide && from < a + w);
    for (let k = 1; taken(y) && k < 20; ++k) y = beside + (k % 2 ? 7 : -7) * (k + 1); // below or above those that are there
    pic.written.push([from, y, wide]);
    if (abs(y - beside) > 14) view.stroke([[x, beside], [x, y + (y < beside ? 6 : -6)]], colour, 0.6); // to its place
    runs.forEach(([part, f], i) => {
      pic.text(part, from, f < 1 ? y + 4 : y, colour, "left", 13 * f);
      from += widths[i];
    });
  };

  /* the points of a part that a matrix is seen at: those that have a mass, else the ends of its axes */
  const places = ({ points, tips, reach }) => {
    const heavy = Object.values(points).filter((x) => x.mass > 0).map((x) => x.at);
    return heavy.length ? heavy : tips.map((tip) => scaled(1 - 0.28 * reach / size(tip), tip));
  };
  /* where the vectors of an arrow begin, and what they are */
  const vectors = ({ at, matrix, centre }, part, read) => {
    const row = (k) => [0, 1, 2].map((j) => read[at + 3 * k + j]);
    if (matrix) return places(part).map((r) => [r, [0, 1, 2].map((k) => dot(row(k), r))]);
    return [[part.fixed || !centre ? [0, 0, 0] : part.centre, row(0)]];
  };
  /* an arrow as a line: straight, or about its beginning */
  const line = (from, v, long, far) => {
    if (!planar || !v[2]) return [from, plus(from, v, long)];
    return Array.from({ length: 17 }, (_, k) => plus(from, [cos(v[2] * long / far * k / 16), sin(v[2] * long / far * k / 16), 0], far));
  };

  const sized = (t, x, parts, spots) => {
    const read = module.outputs(t, x, scene.run.k, scene.u);
    return arrows.flatMap((a) => vectors(a, parts[a.part], read).map(([from, v], k) => {
      const at = spots[a.part]; // a body that stretches takes its vectors along
      return { ...a, from, v, long: size(plus(at(plus(from, v)), at(from), -1)) || 0, first: k === 0 };
    }));
  };

  return {
    /* on a page that stands alone */
    legend: pointed ? "" : make("p", { class: "legend" }, ...meanings.map((meaning, i) =>
      make("span", { style: `color: var(--arrow-${i + 1})` }, `${arrows.find((x) => x.number === i + 1).label.replaceAll("_", "")} ${meaning}`))),
    /* the longest of each scale, of others and at an instant */
    longest(most, ...instant) {
      const found = { ...most };
      for (const { scale, long } of sized(...instant)) found[scale] = max(found[scale] ?? 0, long);
      return found;
    },
    draw(pic, x, parts, spots, so_far) {
      const { colours, lit, time } = scene, most = this.longest(so_far, time, x, parts, spots);
      if (seen !== colours) hues = Object.fromEntries(arrows.map(({ number }) => [number, colours.read(`arrow-${number}`)]));
      seen = colours;
      const all = sized(time, x, parts, spots);
      drawn = scene.drawn = [];
      for (const { number, from, v, long, scale, label: name, part: k, matrix, first } of all) {
        if (!(long > 0.01 * most[scale])) continue;
        // those of a small body are longer than it, so that their letters are apart
        const reach = max(parts[k].reach, 90 / pic.scale), far = (0.3 + 0.11 * number) * reach;
        const path = line(from, v, (matrix ? 0.8 : 1) * LENGTHS[scale] * reach / most[scale], far).map((r) => pic.to(spots[k](r)));
        for (let i = 0; i + 1 < path.length; ++i) drawn.push([number, path[i], path[i + 1]]);
        const [p, q] = path.slice(-2), wide = hypot(q[0] - p[0], q[1] - p[1]) || 1, hue = hues[number];
        const c = (q[0] - p[0]) / wide, s = (q[1] - p[1]) / wide, is = lit === number;
        path.splice(-1, 1, wide > 4 ? [q[0] - 4 * c, q[1] - 4 * s] : p);
        pic.items.push([1e9 + is, () => {
          view.pen.globalAlpha = lit && !is ? 0.2 : 1;
          view.stroke(path, hue, (is ? 4 : matrix ? 1.8 : 2.5) * (scene.large ?? 1));
          pic.head(q[0], q[1], c, s, hue, 1.6);
          view.pen.globalAlpha = 1;
        }]);
        if (first || is) pic.items.push([2e9, () => {
          view.pen.globalAlpha = lit && !is ? 0.2 : 1;
          label(pic, name, q[0] + 9 * c, q[1] + 15 * s, hue, c < -0.3 ? 1 : c > 0.3 ? 0 : 0.5);
          view.pen.globalAlpha = 1;
        }]);
      }
    },
  };
}
