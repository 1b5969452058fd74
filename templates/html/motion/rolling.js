/* The ellipsoid of the energy of a body that only turns, in a picture of its velocity, at(x). Seen from space it rolls, where no
 * torque acts, on a plane across the momentum ℓ, where the end of the velocity draws the herpolhode. That end is dragged
 * on the ellipsoid, so that ℓ goes over its sphere: the motion begins there. */
function rolling(scene, { element: seen }, at) {
  const { page, energy } = scene, { words, body: { polhode: places, parts: [part] } } = page;
  const box = make("input", { type: "checkbox", change: () => scene.ask() });
  let I, axes, drawn = null, held = false;

  /* the place of the ellipsoid that is seen nearest to one of the picture */
  const nearest = ({ offsetX, offsetY }) => {
    const N = 6000;
    let best = Infinity, found;
    for (let i = 0; i < N; ++i) {
      const z = 1 - (2 * i + 1) / N, u = turn(0.618034 * i, sqrt(1 - z * z), z), r = axes.reduce((sum, a, k) => plus(sum, a, u[k]), [0, 0, 0]);
      const [x, y] = drawn.to(r), behind = drawn.to(times(I, r.map((v) => [v])).flat())[2] < 0;
      const far = behind ? Infinity : hypot(x - offsetX, y - offsetY);
      if (far < best) [best, found] = [far, r];
    }
    return found;
  };
  /* a number of the start, as if it were typed */
  const type = (name, v) => {
    const box = seen.closest(".motion").querySelector(`.adjuster[data-name=${name}] input`);
    box.value = v;
    box.dispatchEvent(new Event("change"));
  };
  on(seen, "pointerdown", (e) => {
    const [x, y] = drawn?.to(drawn.now) ?? [];
    if (!(hypot(x - e.offsetX, y - e.offsetY) < 16)) return;
    held = true;
    seen.setPointerCapture(e.pointerId);
    e.stopImmediatePropagation(); // the camera stays
  });
  on(seen, "pointermove", (e) => {
    if (held) nearest(e).forEach((v, i) => type(page.names[places[i]], v));
  });
  for (const over of ["pointerup", "pointercancel"]) on(seen, over, () => (held = false));

  return {
    element: make("label", { class: "within" }, box, " ", words.rolls),
    restart() {
      I = null;
    },
    /* the half axes of the ellipsoid; none where it has no end */
    axes(x) {
      I ??= energy ? inertia(scene, x, places) : [];
      const now = at(x), turning = dot(now, I.map((row) => dot(row, now)));
      axes = turning > 0 ? principal(I).map(([q, v]) => scaled(sqrt(turning / q), v)) : [];
      return axes = axes.flat().every(isFinite) ? axes : [];
    },
    /* what takes a vector of the body to where it is seen; with the ellipsoid, and the plane and the herpolhode */
    place(pic, x) {
      const { trail, colours } = scene, turned = (y) => (box.checked ? moved(part, y) : (r) => r), place = turned(x), now = at(x);
      drawn = axes[0] ? { now, to: (r) => pic.to(place(r)) } : null;
      axes.forEach((a, i) => {
        for (let k = 0; k < 48; ++k) {
          const on = (j) => place(plus(scaled(cos(j * PI / 24), a), axes[(i + 1) % 3], sin(j * PI / 24)));
          pic.line(on(k), on(k + 1), colours.soft, 0.8, 0.55);
        }
      });
      if (!box.checked || !drawn) return place;
      const l = place(I.map((row) => dot(row, now))), n = scaled(1 / size(l), l), foot = scaled(dot(place(now), n), n);
      const u = cross(n, abs(n[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]), wide = max(...axes.map(size)), a = scaled(wide / size(u), u), b = cross(n, a);
      const on = (s, t) => plus(plus(foot, a, s), b, t);
      for (let s = -1; s <= 1; s += 0.25) {
        for (const [p, q] of [[on(s, -1), on(s, 1)], [on(-1, s), on(1, s)]]) pic.line(p, q, colours.soft, 0.8, 0.35);
      }
      const path = trail.map(([, y]) => turned(y)(at(y)));
      for (let i = 0; i + 1 < path.length; ++i) pic.line(path[i], path[i + 1], colours.ghost, 2.2, 0.15 + 0.85 * i / path.length, 0.02 * wide);
      pic.arrow([0, 0, 0], scaled(1.25, foot), colours.ghost, "ℓ");
      return place;
    },
  };
}
