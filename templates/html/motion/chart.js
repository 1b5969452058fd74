/* Curves of some places of the state in time, or of other values there, with their names; those after the sixth are
 * dashed, in the same colours; those of the second motion, where there is one, are faint. What is no number is a gap, and told. */
function chart(scene, label, places, names = scene.page.names, values = (t, x) => x) {
  const view = canvas(scene, label);
  return {
    element: view.element,
    draw() {
      const { pen } = view, { colours, page } = scene;
      pen.clearRect(0, 0, view.width, view.height);
      if (scene.trail.length < 2) return;
      const trail = scene.trail.map(([t, x, y]) => [t, values(t, x), y && values(t, y)]);
      const t0 = trail[0][0], t1 = trail.at(-1)[0] || 1;
      const all = trail.flatMap(([, x, y]) => places.flatMap((s) => [x[s], y?.[s]])).filter(isFinite);
      const lost = trail.filter(([, x]) => places.some((s) => isNaN(x[s])));
      const least = min(...all), most = max(...all), large = max(abs(least), abs(most)), range = most - least;
      const middle = (least + most) / 2, half = max(range / 2, 0.02 * large, 1e-12), many = places.length > 1;
      pen.font = "12px Georgia, serif";
      const label = (s) => called(names[s]), left = 64, right = view.width - 16 - max(...places.map((s) => pen.measureText(label(s)).width)), foot = view.height - 18;
      const X = (t) => left + (right - left) * (t - t0) / (t1 - t0), Y = (v) => (8 + foot) / 2 - (foot - 8) * (v - middle) / half / 2.16;
      const write = (what, x, y, align, colour = colours.soft) => {
        pen.fillStyle = colour;
        pen.textAlign = align;
        pen.fillText(what, x, y);
      };
      const short = (v) => shown(v, page, 3, v);
      pen.textBaseline = "middle";
      pen.setLineDash([]);
      view.stroke([[left, 8], [left, foot], [right, foot]], colours.line, 1);
      if (least < 0 && most > 0) view.stroke([[left, Y(0)], [right, Y(0)]], colours.line, 1);
      const digits = range > 1e-9 * large ? min(7, max(3, 2 + ceil(log10(large / range)))) : 3; // so that the two differ
      const ends_of = [...new Set([most, least].map((v) => shown(v, page, digits, large)))];
      ends_of.forEach((what, k) => write(what, left - 5, ends_of[1] ? min(max(Y(k ? least : most), 6 + 14 * k), foot - 14 + 14 * k) : Y(middle), "right"));
      write(`t = ${short(t0)}`, left, foot + 10, "left");
      write(`${short(t1)} ${page.units.t}`, right, foot + 10, "right");
      if (lost[0]) write(`${lost.length} NaN, t = ${short(lost[0][0])} …`, (left + right) / 2, foot + 10, "center");
      const ends = places.map((s, i) => [Y(trail.at(-1)[1][s]) || 0, s, i]).sort((a, b) => a[0] - b[0]), at = [];
      ends.forEach(([y], k) => (at[k] = max(y, k ? at[k - 1] + 13 : 6)));
      for (let k = ends.length - 1, most_low = foot; k >= 0; --k, most_low = at[k + 1] - 13) at[k] = min(at[k], most_low);
      ends.forEach(([y, s, i], k) => {
        const colour = colours.lines[i % 6];
        pen.setLineDash(i > 5 ? [4, 3] : []);
        if (trail[0][2]) {
          pen.globalAlpha = many ? 0.4 : 1;
          view.stroke(trail.map(([t, , y]) => [X(t), Y(y[s])]), many ? colour : colours.ghost, 1.5);
          pen.globalAlpha = 1;
        }
        view.stroke(trail.map(([t, x]) => [X(t), Y(x[s])]), colour, 1.5);
        view.stroke([[right + 2, y], [right + 11, at[k]]], colours.line); // to its name: no part of the curve
        write(label(s), right + 13, at[k], "left", colour);
      });
    },
  };
}

/* the largest numbers of the state on the stage, where no body is drawn */
function chart_stage(scene) {
  return chart(scene, scene.page.words.stage, scene.page.curves);
}

/* the velocity beside the body */
function velocities(scene) {
  return { ...chart(scene, scene.page.words.velocities, scene.velocity.slice(0, 9)), shape: "side flat" };
}

/* one quantity in time, chosen from a list of [words, (t, x) => number]; of two motions its distance, too, as a logarithm */
function graph(scene, label, between) {
  let all = [], now = 0;
  const list = make("select", { "aria-label": label, change: () => {
    now = list.selectedIndex;
    scene.ask();
  } });
  const view = chart(scene, label, [0], [""], (t, x) => [all[now][1](t, x)]);
  const log = (t, x, y) => [y ? log10(max(abs(all[now][1](t, x) - all[now][1](t, y)), 1e-16)) : 0];
  const apart = chart({ __proto__: scene, get trail() { return scene.trail.map(([t, x, y]) => [t, log(t, x, y)]); } }, between, [0], [""]);
  const below = make("figure", { hidden: "" }, make("figcaption", {}, between), apart.element);
  for (const x of [view, apart]) x.element.className = "flat";
  return { figure: make("figure", { class: "graph" }, list, view.element, below), draw() {
    below.hidden = !scene.other;
    view.draw();
    if (scene.other) apart.draw();
  }, offer(choices) {
    all = choices;
    now = max(0, min(now, all.length - 1));
    list.replaceChildren(...all.map(([words]) => make("option", {}, words)));
    list.selectedIndex = now;
  } };
}

/* what is read off the motion, beside the body: what has one unit together */
function readings(scene) {
  const { page } = scene, said = page.words.readings;
  const values = (t, x) => page.module.outputs(t, x, scene.run.k, scene.u);
  const views = page.panels.map((of) => chart(scene, said, of, page.outputs, values));
  for (const x of views) x.element.className = "flat";
  return { element: make("div", { "aria-label": said }, ...views.map((x) => x.element)), draw() {
    views.forEach((x) => x.draw());
  }, shape: "" };
}
