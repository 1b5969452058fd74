/* Shapes as faces, each of corners v and with a tone, 0 or 1. */

/* a sheet of m × n faces of a map of the square */
const sheet = (f, m, n, tone = () => 0) => {
  const faces = [];
  for (let i = 0; i < m; ++i) {
    for (let j = 0; j < n; ++j) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
      faces.push({ tone: tone(i, j), v: corners.map(([a, b]) => f(a / m, b / n)) });
    }
  }
  return faces;
};
const turn = (a, r, z) => [r * cos(2 * PI * a), r * sin(2 * PI * a), z];
const sector = (i) => floor(i / 4) % 2;
const disc = (z) => sheet((a, b) => turn(a, b, z), 32, 2, sector);

function ball() {
  return sheet((a, b) => turn(a, sin(PI * b), -cos(PI * b)), 32, 16, (i, j) => (sector(i) + Number(j < 8)) % 2);
}

function cylinder() {
  return [...sheet((a, b) => turn(a, 1, 2 * b - 1), 32, 4, sector), ...disc(1), ...disc(-1)];
}

function cone() {
  return [...sheet((a, b) => turn(a, 1 - b, b), 32, 6, sector), ...disc(0)];
}

function box() {
  return [0, 1, 2].flatMap((k) => [1, -1].flatMap((side) => sheet((a, b) => {
    const u = [0, 0, 0];
    u[k] = side;
    u[(k + 1) % 3] = 2 * a - 1;
    u[(k + 2) % 3] = 2 * b - 1;
    return u;
  }, 4, 4, () => Number(k === 2))));
}

function tetrahedron() {
  const c = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
  return c.map((_, k) => ({ tone: k % 2, v: c.filter((_, i) => i !== k) }));
}

/* the columns of the map that takes the ball to the solid r · Q r < 1 */
function quadric(Q) {
  return principal(Q).map(([q, v]) => scaled(1 / sqrt(q), v));
}

/* the solid ellipsoid that has a mass m, a centre, and moments J */
function of_moments(m, centre, J) {
  const axes = principal(J.map((row, i) => row.map((v, j) => v / m - centre[i] * centre[j])));
  const half = axes.map(([q]) => sqrt(5 * max(q, 0)) || 0), least = 0.02 * max(...half);
  if (!least) return [];
  const thick = axes.map(([, v], k) => scaled(max(half[k], least), v));
  return convex(ball().map((f) => ({ ...f, v: f.v.map((u) => thick.reduce((r, a, k) => plus(r, a, u[k]), centre)) })));
}

/* the matrix of the kinetic energy in the velocities at some places of the state, which the energy says; 0 where there is no place */
function inertia({ energy, run, velocity }, x, places) {
  const E = (w) => {
    const y = Float64Array.from(x);
    for (const s of velocity) y[s] = 0;
    places.forEach((s, i) => (y[s] = w[i]));
    return energy(0, y, run.k);
  };
  const e = (i, j) => places.map((_, k) => Number(k === i) + Number(k === j)), rest = E(e(-1, -1));
  const one = (i) => 2 * (E(e(i, -1)) - rest);
  return places.map((_, i) => places.map((_, j) => (i === j ? one(i) : E(e(i, j)) - rest - (one(i) + one(j)) / 2)));
}
const trace = (A) => A.reduce((sum, row, i) => sum + row[i], 0);

/* the solid ellipsoid that has the inertia of a part; of mass 1 where that is not told */
function of_inertia(scene, x, { turning, sliding, n }) {
  if (!scene.energy) return [];
  const I = inertia(scene, x, turning), m = trace(inertia(scene, x, sliding)) / n || 1;
  return of_moments(m, [0, 0, 0], I.map((row, i) => row.map((v, j) => (i === j) * trace(I) / 2 - v)));
}
