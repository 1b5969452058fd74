/* A closed mesh of triangles, STL, OBJ or OFF, as the moments of its solid. */

const numbers = (text) => text.trim().split(/\s+/).map(Number);

/* the shortest decimal that has the 32 bits of a number: a tenth for 0.10000000149 */
const decimal = (x) => [6, 7, 8, 9].map((k) => Number(x.toPrecision(k))).find((y) => Math.fround(y) === x) ?? x;

/* the triangles of a file, each of three places; kind: the end of its name */
function triangles(kind, bytes) {
  const view = new DataView(bytes), count = bytes.byteLength > 84 ? view.getUint32(80, true) : 0, three = [0, 1, 2];
  if (kind === "stl" && bytes.byteLength === 84 + 50 * count) {
    return Array.from({ length: count }, (_, i) => three.map((j) => three.map((k) => decimal(view.getFloat32(96 + 50 * i + 12 * j + 4 * k, true)))));
  }
  const text = new TextDecoder().decode(bytes).replace(/#.*/g, "");
  const rows = (mark) => [...text.matchAll(new RegExp(`^[ \\t]*${mark}[ \\t]+(.+)`, "gm"))].map((x) => x[1]);
  let points = rows("v").map(numbers), faces = rows("f").map((x) => numbers(x.replace(/\/\S*/g, "")).map((k) => (k < 0 ? points.length + k : k - 1)));
  if (kind === "stl") {
    points = rows("vertex").map(numbers);
    faces = points.flatMap((_, k) => (k % 3 ? [] : [[k, k + 1, k + 2]]));
  } else if (kind === "off") {
    const all = numbers(text.replace("OFF", "")), [n, many] = all;
    points = Array.from({ length: n }, (_, k) => all.slice(3 + 3 * k, 6 + 3 * k));
    for (let at = 3 + 3 * n; faces.length < many && all[at]; at += all[at] + 1) faces.push(all.slice(at + 1, at + 1 + all[at]));
  }
  return faces.flatMap((f) => f.slice(2).map((_, i) => [f[0], f[i + 1], f[i + 2]].map((k) => points[k]?.slice(0, 3) ?? [NaN])));
}

/* { m, c, J } of density 1, and its triangles, outwards; null where its triangles do not close up: of 0abc, with D = det(a, b, c) and s = a + b + c, they are D/6,
 * D s/24 and D (a ā + b b̄ + c c̄ + s s̄)/120 */
export function moments(kind, bytes) {
  const all = triangles(kind, bytes), edges = new Map(), c = [0, 0, 0], J = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  if (!all.flat(2).every(Number.isFinite)) return null;
  let m = 0;
  for (const t of all) {
    const [a, b, d] = t, s = a.map((x, i) => x + b[i] + d[i]), names = t.map(String);
    const D = a[0] * (b[1] * d[2] - b[2] * d[1]) + a[1] * (b[2] * d[0] - b[0] * d[2]) + a[2] * (b[0] * d[1] - b[1] * d[0]);
    names.forEach((x, i) => {
      const y = names[(i + 1) % 3], [key, by] = x < y ? [`${x} ${y}`, 1] : [`${y} ${x}`, -1];
      if (x !== y) edges.set(key, (edges.get(key) ?? 0) + by);
    });
    m += D / 6;
    for (let i = 0; i < 3; ++i) {
      c[i] += D * s[i] / 24;
      for (let j = 0; j < 3; ++j) J[i][j] += D * (a[i] * a[j] + b[i] * b[j] + d[i] * d[j] + s[i] * s[j]) / 120;
    }
  }
  if (!m || [...edges.values()].some(Boolean)) return null;
  const size = Math.sqrt(Math.abs((J[0][0] + J[1][1] + J[2][2]) / m)), outwards = Math.sign(m);
  const rounded = (x, k) => (Math.abs(x) < 1e-13 * Math.abs(m) * size ** k ? 0 : Number((outwards * x).toPrecision(14)));
  const faces = outwards > 0 ? all : all.map((t) => t.toReversed());
  return { m: rounded(m, 0), c: c.map((x) => rounded(x, 1)), J: J.map((row) => row.map((x) => rounded(x, 2))), faces };
}
