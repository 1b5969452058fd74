/* The vectors of the equations, on the body: of each three numbers, in the frame of its part, among those that are read
 * off the motion. page.arrows: { at: the place of the first, part, centre: does it begin at the centre of mass?, scale:
 * those of one are compared, label }; scene.lit: the number, from 1, of the one that is pointed at, else 0;
 * scene.large: letters and lines are so many times larger. */
const LENGTHS = { turning: 1.35, momentum: 1.15, sliding: 1, torque: 0.85, force: 0.85 };

function arrows_of(scene, view) {
  const { arrows, module, pointed } = scene.page;
  let most = {}, seen = null, hues = [], drawn = []; // of each arrow that is drawn its number and its ends in the picture

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
    pointed(now);
  };
  on(view.element, "pointermove", (e) => !e.buttons && point(near(e.offsetX, e.offsetY)));
  on(view.element, "pointerleave", () => point(0));

  /* a label, on one side of its place: what follows a _ is smaller, and lower */
  const label = (pic, text, x, y, colour, side) => {
    const runs = text.split("_").flatMap((part, i) => (i ? [[part[0], 0.72], [part.slice(1), 1]] : [[part, 1]]));
    const font = (f) => (view.pen.font = `italic ${13 * f * (scene.large ?? 1)}px Georgia, serif`);
    const widths = runs.map(([part, f]) => font(f) && view.pen.measureText(part).width);
    let from = x - side * widths.reduce((a, b) => a + b);
    runs.forEach(([part, f], i) => {
      pic.text(part, from, f < 1 ? y + 4 : y, colour, "left", 13 * f);
      from += widths[i];
    });
  };

  return {
    restart() {
      most = {};
    },
    draw(pic, x, parts, spots) {
      const { colours, lit, run, u, time } = scene;
      if (seen !== colours) hues = arrows.map((_, i) => colours.read(`arrow-${i + 1}`));
      seen = colours;
      const read = module.outputs(time, x, run.k, u), size_of = (a) => size(vector(a));
      const vector = ({ at }) => [0, 1, 2].map((k) => read[at + k]);
      for (const a of arrows) most[a.scale] = max(most[a.scale] ?? 0, size_of(a) || 0);
      drawn = scene.drawn = [];
      arrows.forEach((a, i) => {
        const part = parts[a.part], at = spots[a.part], from = part.fixed || !a.centre ? [0, 0, 0] : part.centre;
        const long = size_of(a) / most[a.scale];
        if (!(long > 0.01)) return;
        const tip = plus(from, vector(a), LENGTHS[a.scale] * part.reach / most[a.scale]);
        drawn.push([i + 1, pic.to(at(from)), pic.to(at(tip))]);
        const [, p, q] = drawn.at(-1), wide = hypot(q[0] - p[0], q[1] - p[1]) || 1;
        const c = (q[0] - p[0]) / wide, s = (q[1] - p[1]) / wide, dim = lit && lit !== i + 1;
        pic.items.push([1e9 + (lit === i + 1), () => {
          view.pen.globalAlpha = dim ? 0.2 : 1;
          view.stroke([p, [q[0] - 4 * c, q[1] - 4 * s]], hues[i], (lit === i + 1 ? 4 : 2.5) * (scene.large ?? 1));
          pic.head(q[0], q[1], c, s, hues[i], 1.6);
          label(pic, a.label, q[0] + 9 * c, q[1] + 15 * s, hues[i], c < -0.3 ? 1 : c > 0.3 ? 0 : 0.5);
          view.pen.globalAlpha = 1;
        }]);
      });
    },
  };
}
