/* Vectors of three numbers, and small matrices. */

const { abs, atan2, cbrt, ceil, cos, exp, floor, hypot, log10, log2, max, min, round, sqrt, sin, PI, sign } = Math;
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const plus = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const scaled = (s, a) => [s * a[0], s * a[1], s * a[2]];
const size = (a) => hypot(...a);
const times = (A, B) => A.map((row) => B[0].map((_, j) => row.reduce((sum, v, i) => sum + v * B[i][j], 0)));

/* exp X by the series of X/2^s, squared s times */
function exponential(X) {
  const large = max(...X.map((row) => row.reduce((sum, v) => sum + abs(v), 0)));
  const halvings = large > 0 ? max(0, ceil(log2(large)) + 1) : 0;
  let term = X.map((row, i) => row.map((_, j) => Number(i === j))), total = term;
  for (let k = 1; k < 18; ++k) {
    term = times(term, X.map((row) => row.map((v) => v / 2 ** halvings / k)));
    total = total.map((row, i) => row.map((v, j) => v + term[i][j]));
  }
  for (let k = 0; k < halvings; ++k) total = times(total, total);
  return total;
}

/* eigenvalues and unit eigenvectors of a symmetric 3 × 3, by Jacobi's rotations */
function principal(S) {
  let A = S.map((row) => [...row]), V = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let k = 0; k < 24; ++k) {
    const [i, j] = [[0, 1], [0, 2], [1, 2]][k % 3];
    const a = atan2(2 * A[i][j], A[j][j] - A[i][i]) / 2;
    const R = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], T = R.map((row) => [...row]);
    R[i][i] = R[j][j] = T[i][i] = T[j][j] = cos(a);
    R[i][j] = T[j][i] = sin(a);
    R[j][i] = T[i][j] = -sin(a);
    A = times(T, times(A, R));
    V = times(V, R);
  }
  return [0, 1, 2].map((i) => [A[i][i], V.map((row) => row[i])]);
}

/* Where a motion starts: the state x turned by exp of theta in the basis of the Lie algebra. */
function turned_start({ entries, basis, order }, x, theta) {
  const square = (f) => Array.from({ length: order }, (_, i) => Array.from({ length: order }, (_, j) => f(i, j)));
  const g = square((i, j) => Number(i === j)), X = square(() => 0);
  for (const [i, j, at] of entries) g[i][j] = x[at];
  basis.forEach((E, k) => E.forEach(([i, j, v]) => (X[i][j] += theta[k] * v)));
  const turned = times(g, exponential(X));
  for (const [i, j, at] of entries) x[at] = turned[i][j];
}
