/* Canvases, sharp on every screen; a camera that turns by mouse, touch and keys; pictures. */

function canvas(scene, label) {
  const shown = make("canvas", { role: "img", "aria-label": label, tabindex: 0 });
  const pen = shown.getContext("2d");
  const path = (list) => {
    pen.beginPath();
    list.forEach(([x, y], i) => (isFinite(list[i - 1]?.[1]) ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  };
  const stroke = (list, colour, width = 1.2) => {
    path(list);
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.stroke();
  };
  const sized = { element: shown, pen, path, stroke, width: 1, height: 1 };
  const fit = () => {
    const sharp = min(devicePixelRatio || 1, 2.5);
    sized.width = shown.clientWidth;
    sized.height = shown.clientHeight;
    shown.width = round(sized.width * sharp);
    shown.height = round(sized.height * sharp);
    pen.setTransform(sharp, 0, 0, sharp, 0, 0);
    scene.redraw(); // the new size has wiped it
  };
  new ResizeObserver(fit).observe(shown);
  return sized;
}

/* the eye may go along with something that turns: along(v), where a direction of it is now */
function camera({ ask }, { element: seen }, up, azimuth, elevation) {
  const eye = { azimuth, elevation, zoom: 1 };
  const k = up.reduce((most, v, i) => (abs(v) >= abs(up[most]) ? i : most), 0);
  const unit = (i, s = 1) => [0, 1, 2].map((j) => (i % 3 === j ? s : 0));
  const down = up[k] < 0 ? 1 : 0, ahead = unit(k + 1 + down), aside = unit(k + 2 - down), above = unit(k, 1 - 2 * down);
  eye.above = above;
  eye.look = () => {
    const a = eye.azimuth, e = eye.elevation, c = e < PI / 2 ? cos(e) : 0; // all of a plane is as deep
    const level = plus(scaled(cos(a), ahead), aside, sin(a));
    eye.right = plus(scaled(-sin(a), ahead), aside, cos(a));
    eye.up = plus(scaled(-sin(e), level), above, c);
    eye.towards = plus(scaled(c, level), above, sin(e));
    if (eye.along) for (const e of ["right", "up", "towards"]) eye[e] = eye.along(eye[e]);
  };
  const turned = (dx, dy) => {
    eye.azimuth -= dx;
    eye.elevation = max(-1.55, min(PI / 2, eye.elevation + dy));
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
    if (!e.ctrlKey) return; // it scrolls
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

/* a picture: items with a depth, drawn the farthest first */
function picture({ colours, large = 1 }, view, eye, target, scale) {
  eye.look();
  const far = 4 * min(view.width, view.height) / scale, items = [], from = plus(target, eye.towards, far);
  const to = (r) => {
    const q = plus(r, target, -1), z = dot(eye.towards, q);
    const f = scale * far / max(far - z, far / 20);
    return [view.width / 2 + f * dot(eye.right, q), view.height / 2 - f * dot(eye.up, q), z];
  };
  const { pen, path, stroke } = view;
  const mean = (list) => list.reduce((sum, v) => sum + v[2], 0) / list.length;
  const lit = scaled(1 / size([-0.45, 0.65, 0.75]), [-0.45, 0.65, 0.75]);
  const own = {
    to, items, scale, written: [], // where the letters stand: x, y, width
    /* inside: a place in the convex solid of which it is a face, whose far side is hidden */
    face(v, tones, clear, inside) {
      const s = v.map(to), m = cross(plus(v[2], v[0], -1), plus(v.at(-1), v[1], -1));
      if (inside && dot(m, plus(v[0], inside, -1)) * dot(m, plus(v[0], from, -1)) > 0) return;
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
    line(a, b, colour, width, alpha, lift) {
      own.drawn_line([to(a), to(b)], colour, width, alpha, lift);
    },
    drawn_line(s, colour, width = 1.2, alpha = 1, lift = 0) {
      items.push([mean(s) + lift, () => {
        pen.globalAlpha = alpha;
        pen.lineCap = alpha < 1 ? "butt" : "round"; // no beads where pieces of a trail meet
        stroke(s, colour, width);
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
    arrow(a, b, colour, name) {
      for (let i = 0; i < 8; ++i) own.line(plus(scaled(1 - i / 8, a), b, i / 8), plus(scaled(1 - (i + 1) / 8, a), b, (i + 1) / 8), colour, 1.6);
      const [x, y, z] = to(b), [u, v] = to(plus(scaled(0.1, a), b, 0.9));
      const long = hypot(x - u, y - v) || 1, c = (x - u) / long, s = (y - v) / long;
      items.push([z, () => {
        if (long > 1) own.head(x, y, c, s, colour);
      }]);
      if (!name) return;
      own.written.push([x + 13 * c - 8, y + 13 * s, 16]);
      items.push([z, () => own.text(name, x + 13 * c, y + 13 * s, colour)]);
    },
    /* that of an arrow which points along (c, s) */
    head(x, y, c, s, colour, f = 1) {
      path([[3, 0], [-6, 3], [-6, -3]].map(([a, b]) => [x + f * (a * c - b * s), y + f * (a * s + b * c)]));
      pen.fillStyle = colour;
      pen.fill();
    },
    text(what, x, y, colour, align = "center", high = 13) {
      pen.fillStyle = colour;
      pen.font = `italic ${high * large}px Georgia, serif`;
      pen.textAlign = align;
      pen.textBaseline = "middle";
      pen.lineWidth = 3;
      pen.strokeStyle = colours.paper;
      pen.strokeText(what, x, y);
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

/* a spring in a picture */
function spring({ stroke }, { to, items }, a, b, colour) {
  const [p, q] = [to(a), to(b)], long = hypot(q[0] - p[0], q[1] - p[1]);
  if (long < 3) return;
  const aside = [-(q[1] - p[1]) / long, (q[0] - p[0]) / long], turns = 14, wide = min(5, long / 8);
  const points = [p];
  for (let i = 0; i <= turns; ++i) {
    const f = 0.14 + 0.72 * i / turns, s = i === 0 || i === turns ? 0 : (i % 2 ? wide : -wide);
    points.push([0, 1].map((k) => p[k] + f * (q[k] - p[k]) + s * aside[k]));
  }
  points.push(q);
  items.push([(p[2] + q[2]) / 2, () => stroke(points, colour)]);
}

/* a canvas as a file, on the colour of the page */
function save_picture(from) {
  const { width, height } = from, to = make("canvas", { width, height }), pen = to.getContext("2d");
  pen.fillStyle = getComputedStyle(document.body).backgroundColor;
  pen.fillRect(0, 0, width, height);
  pen.drawImage(from, 0, 0);
  make("a", { href: to.toDataURL(), download: `${document.title}.png` }).click();
}
