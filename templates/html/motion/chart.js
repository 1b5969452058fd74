/* Curves of some places of the state in time. */
function chart(scene, label, places) {
  const view = canvas(scene, label);
  return {
    element: view.element,
    draw() {
      const { pen } = view, { trail, colours } = scene;
      pen.clearRect(0, 0, view.width, view.height);
      if (trail.length < 2) return;
      const t0 = trail[0][0], t1 = trail.at(-1)[0] || 1;
      const all = trail.flatMap(([, x]) => places.map((s) => x[s]));
      let low = min(...all), high = max(...all);
      const middle = (low + high) / 2, half = max((high - low) / 2, 0.02 * max(abs(low), abs(high)), 1e-12);
      [low, high] = [middle - 1.08 * half, middle + 1.08 * half];
      const X = (t) => 8 + (view.width - 50) * (t - t0) / (t1 - t0), Y = (v) => 8 + (view.height - 16) * (high - v) / (high - low);
      if (low < 0 && high > 0) view.stroke([[8, Y(0)], [view.width - 42, Y(0)]], colours.line, 1);
      pen.font = "12px Georgia, serif";
      pen.textBaseline = "middle";
      pen.textAlign = "left";
      const ends = places.map((s, i) => [Y(trail.at(-1)[1][s]), s, colours.lines[i % 6]]).sort((a, b) => a[0] - b[0]);
      let above = -Infinity;
      for (const [y, s, colour] of ends) {
        view.stroke(trail.map(([t, x]) => [X(t), Y(x[s])]), colour, 1.5);
        pen.fillStyle = colour;
        above = max(y, above + 13);
        if (above < view.height - 4) pen.fillText(called(scene.page.names[s]), view.width - 38, above);
      }
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
