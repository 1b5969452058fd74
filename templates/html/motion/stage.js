/* The body on the stage, with gravity and the ground; pieces: see built. A plane is seen as it is. */
/* of all trails: what a frame has time for */
const PIECES = 480;
/* the height of the eye at first */
const HIGH = 0.33;
function solid_stage(scene, pieces) {
  const { page } = scene, { body } = page;
  const stage = canvas(scene, page.words.stage);
  const falling = () => valued(page.module, scene.p).vector(body.gravity);
  const eye = scene.eye = camera(scene, stage, ...(body.planar ? [[0, 0, 1], -PI / 2, PI / 2] : [scaled(-1, falling()), 0.55, HIGH]));
  const vectors = pieces.arrows?.(scene, stage);
  let drawn, reached = 0, furthest = [], seen_within;

  /* a faint net below the body, or where it stands; it goes with a body that flies, line by line */
  const ground = (pic, target) => {
    if (body.planar) return;
    const { above } = eye, k = above.findIndex((v) => v !== 0), s = above[k];
    const h = s * drawn.level, side = reached / 2, lines = 5;
    if (abs(h - target[k]) > 6 * reached) return;
    const [i, j] = [(k + 1) % 3, (k + 2) % 3];
    const middle = [i, j].map((a) => side * round(target[a] / side));
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
        stage.stroke([end(-wide), end(wide)], scene.colours.line, 1);
      }
    }
  };

  /* the places of what leaves a trail in the states of an instant; is it of the ghost? */
  const traces = (parts, [, ...states]) => states.flatMap((x, ghost) => parts.flatMap((part) => part.traced.map(moved(part, x)).map((r) => [r, ghost])));

  const placed_at = (states) => states.map((x) => drawn.parts.map((part) => moved(part, x)));
  /* what stands in the middle of the picture */
  const middle = (spots) => {
    const { parts } = drawn, free = parts.every((part) => !part.fixed && !part.centres.length && !part.anchors.length);
    return free || scene.within ? spots[0](parts[0].centre) : drawn.middle;
  };
  /* how far from it what is seen reaches, and so far has reached: at instants that do not depend on what was played */
  const about = (far) => drawn.parts.flatMap((part) => [...part.centres, ...part.anchors].map((c) => min(far(c.at), 4 * drawn.reach)));
  const extent = (all) => {
    const from = middle(all[0]), far = (r) => size(plus(r, from, -1));
    return max(drawn.reach, ...all.flatMap((places) => places.flatMap((at, i) => drawn.parts[i].ends.map((r) => far(at(r))))), ...about(far));
  };
  /* the same in the height of the picture, as it is seen at first: less where it is flat */
  const height = (all) => {
    const from = middle(all[0]);
    const high = (r) => {
      const v = plus(r, from, -1), up = abs(dot(eye.above, v));
      return sqrt(max(0, dot(v, v) - up * up)) * sin(HIGH) + up * cos(HIGH);
    };
    return max(...all.flatMap((places) => places.map((at, i) => high(at([0, 0, 0])) + 1.3 * drawn.parts[i].reach)), ...about(high));
  };
  const so_far = () => {
    const each = page.t / 1024;
    if (seen_within !== scene.within) furthest = [];
    seen_within = scene.within;
    while (furthest.length * each <= scene.time) {
      const t = furthest.length * each, [far, tall, longest] = furthest.at(-1) ?? [0, 0, {}], states = scene.states(t), all = placed_at(states);
      furthest.push([max(far, extent(all)), max(tall, height(all)), vectors?.longest(longest, t, states[0], drawn.parts, all[0])]);
    }
    return furthest[floor(scene.time / each)] ?? furthest.at(-1);
  };

  /* a part where it is; or the ghost of it, where it is in the second motion */
  const of_part = (pic, part, at, tones, ghost) => {
    for (const f of part.faces) pic.face(f.v.map(at), tones[f.tone], ghost || f.clear, f.inside && at(f.inside));
    for (const [a, b] of part.edges) pic.line(at(a), at(b), tones[0][10], 1.4);
    for (const r of Object.values(part.points)) {
      pic.dot(at(r.at), r.mass > 0 ? 6.5 * cbrt(max(r.mass / part.heavy, 0.1)) : 2.5, tones[0][6]);
    }
    for (const { at: c, on } of part.anchors) pieces.spring(stage, pic, at(part.points[on].at), c, ghost ? scene.colours.ghost : scene.colours.ink);
  };

  return {
    element: stage.element,
    legend: vectors?.legend,
    restart(x) {
      drawn = placed(built(scene, x, pieces), x, eye.above);
      furthest = [];
    },
    draw(x) {
      const { parts } = drawn, gravity = falling(), { trail, colours } = scene;
      const y = scene.other?.at(scene.time).slice(), [spots, others = []] = placed_at([x, ...(y ? [y] : [])]);
      const target = middle(spots);
      eye.along = scene.within && ((v) => plus(spots[0](v), spots[0]([0, 0, 0]), -1));
      const [far, tall, longest] = so_far(), now = [spots, others];
      reached = max(far, extent(now));
      const least = min(reached, max(tall, height(now))), over = max(0, (abs(sin(eye.elevation)) - sin(HIGH)) / (1 - sin(HIGH)));
      const scale = 0.42 * min(stage.width / reached, stage.height / (least + over * (reached - least))) * eye.zoom;
      const pic = picture(scene, stage, eye, target, scale);
      ground(pic, target);
      parts.forEach((part, i) => {
        const at = spots[i], tones = colours.tones[i % 2];
        if (y) of_part(pic, part, others[i], colours.ghosts, true);
        of_part(pic, part, at, tones);
        const o = at([0, 0, 0]);
        // letters would hide a small body
        part.tips.forEach((tip, k) => pic.arrow(o, at(tip), colours[`e${k + 1}`], scale * part.reach > 60 ? "e" + "₁₂₃"[k] : ""));
        if (part.fixed) pic.dot(o, 4, colours.ink, true);
        for (const { at: c, on } of part.centres) {
          for (const id of on) pic.line(at(part.points[id].at), c, colours.soft, 1, 0.6);
          pic.dot(c, 6, colours.mark, true);
          pic.dot(plus(c, eye.towards, 1e-6), 2, colours.mark);
        }
        for (const { at: c } of part.anchors) pic.dot(c, 4.5, colours.soft);
      });
      const path = trail.map((e) => (e.places ??= traces(parts, e)));
      const joined = max(3, ceil(path.length * (path[0]?.length ?? 0) / PIECES));
      for (let k = 0; k + 1 < path.length; k += joined) {
        const piece = path.slice(k, k + joined + 1), age = (k + piece.length - 1) / path.length;
        const coarse = piece.filter((_, n) => n % 2 === 0 || n === piece.length - 1);
        piece[0].forEach(([, ghost], i) => pic.drawn_line((ghost ? coarse : piece).map((x) => pic.to(x[i][0])), ghost ? colours.ghost : colours.mark, 1 + 2.5 * age, age * age));
      }
      path.at(-1)?.forEach(([r, ghost]) => ghost || pic.dot(r, 4.5, colours.mark));
      for (const [i, a, j, b] of body.springs) {
        for (const at of y ? [others, spots] : [spots]) pieces.spring(stage, pic, at[i](parts[i].points[a].at), at[j](parts[j].points[b].at), at === spots ? colours.ink : colours.ghost);
      }
      vectors?.draw(pic, x, parts, spots, longest);
      pic.done();
      const strength = size(gravity);
      if (strength) {
        const g = scaled(30 / strength, gravity), dx = dot(g, eye.right), dy = -dot(g, eye.up);
        const X = stage.width - 34, Y = 44, long = hypot(dx, dy) || 1;
        stage.stroke([[X - dx / 2, Y - dy / 2], [X + dx / 2, Y + dy / 2]], colours.soft, 1.5);
        pic.head(X + dx / 2, Y + dy / 2, dx / long, dy / long, colours.soft);
        pic.text("g", X + 14, Y, colours.soft);
      }
    },
  };
}
