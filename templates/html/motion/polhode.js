/* The angular velocity in the body; pieces.rolling: what there is where the body only turns. */
function polhode(scene, pieces) {
  const { body, words } = scene.page, at = (y) => body.polhode.map((s) => y[s]);
  const side = canvas(scene, words.polhode), rolls = pieces.rolling?.(scene, side, at), glance = camera(scene, side, [0, 0, 1], 0.6, 0.4);

  return {
    element: side.element,
    more: rolls?.element,
    shape: "side",
    restart() {
      rolls?.restart();
    },
    draw(x) {
      const { trail, colours } = scene, now = at(x), wires = rolls?.axes(x) ?? [];
      const most = max(...trail.map(([, y]) => size(at(y))), size(now), ...wires.map(size)) || 1;
      const pic = picture(scene, side, glance, [0, 0, 0], 0.33 * min(side.width, side.height) / most * glance.zoom);
      const place = rolls?.place(pic, x) ?? ((r) => r);
      for (let k = 0; k < 3; ++k) {
        const e = [0, 0, 0];
        e[k] = 1.08 * most;
        pic.arrow([0, 0, 0], place(e), colours[`e${k + 1}`], `ζ${low(String(k + 1))}`);
      }
      for (let k = 0; k + 1 < trail.length; ++k) pic.line(place(at(trail[k][1])), place(at(trail[k + 1][1])), colours.mark, 2.2, 0.15 + 0.85 * k / trail.length, 0.02 * most);
      pic.line([0, 0, 0], place(now), colours.ink, 1.2, 0.7);
      pic.dot(place(now), 4.5, colours.mark);
      pic.done();
    },
  };
}
