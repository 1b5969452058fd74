/* A fluid on the torus: its vorticity Σ ω_n eⁱⁿˣ, ω₋ₙ the conjugate of ω_n, on a square of one period: where it turns to the
 * left in one colour, to the right in another, as strong as the strongest at the start.
 * page.body.waves: [n₁, n₂, the places of the real part of ω_n and of the imaginary one]. */
function vorticity_stage(scene) {
  const SIDE = 96, span = [...Array(SIDE).keys()], view = canvas(scene, scene.page.words.stage);
  const picture = make("canvas", { width: SIDE, height: SIDE }), on = picture.getContext("2d"), pixels = on.createImageData(SIDE, SIDE);
  const unit = span.map((k) => [cos(2 * PI * k / SIDE), sin(2 * PI * k / SIDE)]), wave = (n, k) => unit[(n * k % SIDE + SIDE) % SIDE];
  let most = 0;

  /* a sum for each n₁ and row, then one for each place */
  const field = (x) => {
    const rows = new Map(), found = new Float64Array(SIDE * SIDE);
    for (const [n, m, re, im] of scene.page.body.waves) {
      if (!rows.has(n)) rows.set(n, span.map(() => [0, 0]));
      rows.get(n).forEach((sum, k) => {
        const [c, s] = wave(m, k);
        sum[0] += x[re] * c - x[im] * s;
        sum[1] += x[re] * s + x[im] * c;
      });
    }
    for (const [n, sums] of rows) {
      sums.forEach(([a, b], k) => span.forEach((i) => {
        const [c, s] = wave(n, i);
        found[k * SIDE + i] += 2 * (a * c - b * s);
      }));
    }
    return found;
  };

  return {
    element: view.element,
    restart(x) { most = max(1e-12, ...field(x).map(abs)); },
    draw(x) {
      const { pen, width, height } = view, { colours, page } = scene, long = min(width - 130, height - 40);
      const [paper, left, right] = ["paper", "mark", "e3"].map((name) => [1, 3, 5].map((k) => parseInt(colours[name].slice(k, k + 2), 16)));
      field(x).forEach((v, k) => {
        const place = 4 * ((SIDE - 1 - floor(k / SIDE)) * SIDE + k % SIDE); // the second coordinate goes up
        paper.forEach((c, j) => (pixels.data[place + j] = c + min(1, abs(v) / most) * ((v > 0 ? left : right)[j] - c)));
        pixels.data[place + 3] = 255;
      });
      on.putImageData(pixels, 0, 0);
      const X = (width - long) / 2, Y = (height - long) / 2 - 8, strongest = shown(most, page, 3, most);
      pen.clearRect(0, 0, width, height);
      pen.drawImage(picture, X, Y, long, long);
      view.stroke([[X, Y], [X, Y + long], [X + long, Y + long]], colours.line);
      const write = (what, x, y, align, colour = colours.soft) => {
        pen.fillStyle = colour;
        pen.font = "13px Georgia, serif";
        pen.textAlign = align;
        pen.textBaseline = "middle";
        pen.fillText(what, x, y);
      };
      write("0", X, Y + long + 12, "center");
      write("2π", X + long, Y + long + 12, "center");
      write("2π", X - 8, Y + 4, "right");
      write(`↺ ${strongest}`, X + long + 10, Y + 8, "left", colours.mark);
      write(`↻ ${strongest}`, X + long + 10, Y + 26, "left", colours.e3);
    },
  };
}

/* beside it the largest numbers of the state */
function coefficients(scene) {
  return { ...chart(scene, scene.page.words.coefficients, scene.page.curves), shape: "side flat" };
}
