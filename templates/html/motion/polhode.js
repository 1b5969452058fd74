/* The angular velocity in the body, on the ellipsoid of its energy where the body only turns. */
function polhode(scene) {
  const { body, words } = scene.page, { energy } = scene;
  const side = canvas(scene, words.polhode), glance = camera(scene, side, [0, 0, 1], 0.6, 0.4);
  let I;

  return {
    element: side.element,
    shape: "side",
    restart() {
      I = undefined;
    },
    draw(x) {
      const { trail, colours } = scene;
      const at = (y) => body.polhode.map((s) => y[s]);
      I ??= body.turns && energy ? inertia(scene, x, body.polhode) : null;
      const now = at(x), turning = I && dot(now, I.map((row) => dot(row, now)));
      const axes = turning > 0 && principal(I).map(([q, v]) => (q > 0 ? scaled(sqrt(turning / q), v) : null));
      const wires = axes && axes.every(Boolean) ? axes : [];
      const most = max(...trail.map(([, y]) => size(at(y))), size(now), ...wires.map(size)) || 1;
      const pic = picture(scene, side, glance, [0, 0, 0], 0.33 * min(side.width, side.height) / most * glance.zoom);
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
      for (let k = 0; k + 1 < trail.length; ++k) pic.line(at(trail[k][1]), at(trail[k + 1][1]), colours.mark, 2.2, 0.15 + 0.85 * k / trail.length, 0.02 * most);
      pic.line([0, 0, 0], now, colours.ink, 1.2, 0.7);
      pic.dot(now, 4.5, colours.mark);
      pic.done();
    },
  };
}
