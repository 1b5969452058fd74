/* The body: what its trees are for some parameters, and where it is. */

function valued(module, p) {
  const by = Object.fromEntries(module.PARAMETERS.map((name, i) => [name, p[i]]));
  const rules = {
    add: (...a) => a.reduce((x, y) => x + y),
    mul: (...a) => a.reduce((x, y) => x * y),
    div: (a, b) => a / b,
    pow: (a, b) => a ** b,
  };
  const number = (t) => {
    if (typeof t === "number") return t;
    if (typeof t === "string") {
      const [over, under = 1] = t.split("/");
      return t === "π" ? PI : t === "t" ? 0 : over / under; /* what moves is drawn as it is at first */
    }
    if (t[0] === "par") return by[t[1]] ?? 1; /* a mass that the motion does not need */
    if (t[0] === "fun") return Math[t[1]](number(t[2]));
    return rules[t[0]]?.(...t.slice(1).map(number)) ?? NaN;
  };
  const vector = (list) => [0, 1, 2].map((i) => (i < list.length ? number(list[i]) : 0));
  return { number, vector };
}

/* the faces of a convex solid, with a place inside */
function convex(faces) {
  const corners = faces.flatMap((f) => f.v), inside = corners.reduce((r, v) => plus(r, v, 1 / corners.length), [0, 0, 0]);
  return faces.map((f) => ({ ...f, inside }));
}

/* a face of a closed surface, whose corners go round it as they are seen from outside, with a place behind it */
function backed({ v, ...face }) {
  return { ...face, v, inside: plus(v[0], cross(plus(v[1], v[0], -1), plus(v[2], v[0], -1)), -1) };
}

/* the parts of the body in the state x; pieces: the shapes that it has, and what makes them */
function built(scene, x, pieces) {
  const { page: { body, module }, p } = scene, { number, vector } = valued(module, p);
  const parts = body.parts.map((part) => {
    const points = Object.fromEntries(part.points.map(([id, m, at]) => [id, { mass: number(m), at: vector(at) }]));
    const matter = Object.values(points).filter((x) => x.mass > 0);
    const faces = [];
    for (const solid of part.solids) {
      const shift = vector(solid.shift);
      if (solid.faces) {
        const made = solid.faces.map((f) => ({ tone: 0, v: f.map((i) => solid.vertices[i]) }));
        faces.push(...(solid.closed ? made.map(backed) : made));
        continue;
      }
      const columns = solid.quadric
        ? pieces.quadric(solid.quadric.map(vector))
        : solid.columns.map(vector);
      const place = (u) => columns.reduce((r, column, k) => plus(r, column, u[k]), shift);
      faces.push(...convex(pieces[solid.shape]().map((f) => ({ ...f, v: f.v.map(place) }))));
    }
    let centre = [0, 0, 0];
    if (part.moments) {
      const m = number(part.moments.m), c = vector(part.moments.c), J = part.moments.J.map(vector);
      if (m > 0) centre = scaled(1 / m, c);
      if (!faces.length && !matter.length) faces.push(...pieces.of_moments(m, centre, J));
    } else if (matter.length) {
      const m = matter.reduce((sum, x) => sum + x.mass, 0);
      centre = matter.reduce((r, x) => plus(r, x.at, x.mass / m), centre);
    }
    if (part.turning) faces.push(...pieces.of_inertia(scene, x, part));
    const edges = [];
    if (!faces.length && matter.length < 5) {
      const corners = matter.map((x) => x.at);
      if (part.fixed && corners.length < 4) corners.push([0, 0, 0]);
      corners.forEach((a, i) => corners.slice(0, i).forEach((b) => edges.push([a, b])));
      if (corners.length > 2) {
        const skip = corners.length > 3 ? corners.map((_, k) => k) : [-1];
        faces.push(...skip.map((k) => ({ tone: 0, clear: true, v: corners.filter((_, i) => i !== k) })));
      }
    }
    const every = [...faces.flatMap((f) => f.v), ...Object.values(points).map((x) => x.at)];
    const reach = max(...every.map(size), 0) || 1;
    const axes = [0, 1, 2].slice(0, part.n), along = (k, v) => [0, 1, 2].map((j) => (j === k ? v : 0));
    const tips = axes.map((k) => along(k, max(0.5 * reach, ...every.map((r) => r[k])) + 0.28 * reach));
    const backs = axes.map((k) => along(k, min(0, ...every.map((r) => r[k]))));
    const heavy = max(...matter.map((x) => x.mass), 0) || 1;
    /* about a fixed place the centre of mass, or the tip of the last axis where that goes through it */
    const pole = part.fixed && centre[part.n - 1] >= 0.999 * size(centre) ? tips.at(-1) : centre;
    const traced = part.deforms ? matter.slice(0, 4).map((x) => x.at) : [pole];
    const centres = part.attractions.map((a) => ({ at: vector(a.centre), on: a.on }));
    const anchors = part.anchors.map((a) => ({ on: a.on, at: vector(a.at) }));
    const ends = [...tips, ...backs, ...Object.values(points).map((x) => x.at)];
    return { ...part, points, faces, edges, centre, reach, tips, ends, heavy, traced, centres, anchors };
  });
  return { parts, reach: max(...parts.map((x) => x.reach)) };
}

/* what is built, with the height of its middle at first, and that of the ground: where it stands */
function placed(made, x, above) {
  const heights = made.parts.flatMap((part) => {
    const at = moved(part, x);
    return [...part.faces.flatMap((f) => f.v), ...Object.values(part.points).map((r) => r.at)].map((r) => dot(above, at(r)));
  });
  const low = min(...heights, 0), high = max(...heights, 0);
  made.middle = scaled((low + high) / 2, above);
  made.level = low > -1e-6 * made.reach && made.parts[0].fixed ? 0 : low - 0.25 * made.reach;
  return made;
}

/* the place in space of a point of the body */
const moved = ({ map }, x) => {
  const M = map.map((row, i) => row.map((at, j) => (at < 0 ? Number(i === j) : x[at])));
  return (r) => [0, 1, 2].map((i) => M[i][0] * r[0] + M[i][1] * r[1] + M[i][2] * r[2] + M[i][3]);
};

/* has a part become flat? Then its velocity in the body, Ȧ = AΩ, has no end; the points move on. */
function flattened({ body }, x) {
  return body.parts.some((part) => {
    const at = moved(part, x), [a, b, c] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((e) => plus(at(e), at([0, 0, 0]), -1));
    return abs(dot(a, cross(b, c))) < 1e-4 * size(a) * size(b) * size(c);
  });
}
