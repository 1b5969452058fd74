"""Right-hand sides as textbooks have them, in conventions of their own."""

import numpy as np

E3 = np.array([0, 0, 1.0])


def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def turned(q):
    """The matrix of a quaternion (x, y, z, w)."""
    v, w = q[:3], q[3]
    return (w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * hat(v)


def gyrostat(x):
    """In space: x is a quaternion (x, y, z, w) and the angular velocity along axes of space."""
    q, w = x[:4], x[4:]
    R = turned(q)
    tensor, h = np.diag([1.0, 1.6, 2.2]), np.array([0.3, 0, 0.8])
    L = R @ (tensor @ R.T @ w + h)
    moment = np.cross(R @ E3, -1.5 * E3)
    dw = np.linalg.solve(R @ tensor @ R.T, moment - np.cross(w, L))
    dq = np.array([*(q[3] * w + np.cross(w, q[:3])), -q[:3] @ w]) / 2
    return np.concatenate([dq, dw])


def bob(x):
    """Newton's: a bob of length 0.8 on the third axis, n in space; A and ω with ω₃ = 0."""
    A, w = x[:9].reshape(3, 3), np.array([x[9], x[10], 0.0])
    n, rate = A @ E3, A @ np.cross(w, E3)
    weight = np.array([0, 0, -9.81])
    bend = (weight - (weight @ n) * n) / 0.8 - (rate @ rate) * n
    seen = A.T @ bend - np.cross(w, np.cross(w, E3))
    return np.concatenate([(A @ hat(w)).ravel(), [-seen[1], seen[0]]])


def charged(x):
    """Larmor's: x is A by columns and the angular velocity; momenta p = Iw + b K g / 2."""
    A, w = x[:9].reshape(3, 3).T, x[9:]
    tensor, K, b = np.diag([1, 1.4, 1.9]), np.diag([0.5, 0.2, 0.6]), 0.7
    g = A.T @ E3
    p = tensor @ w + b / 2 * K @ g
    dp = np.cross(p, w) + np.cross(b / 2 * K @ w, g)
    dw = np.linalg.solve(tensor, dp - b / 2 * K @ np.cross(g, w))
    return np.concatenate([(A @ hat(w)).T.ravel(), dw])


def kovalevskaya(x):
    """Euler's angles Z, X, Z (precession, nutation, spin) and Euler–Poisson equations."""
    (_, theta, psi), (p, q, r) = x[:3], x[3:]
    g2, g3 = np.sin(theta) * np.cos(psi), np.cos(theta)
    precession = (p * np.sin(psi) + q * np.cos(psi)) / np.sin(theta)
    nutation = p * np.cos(psi) - q * np.sin(psi)
    turning = [precession, nutation, r - precession * np.cos(theta)]
    return [*turning, q * r / 2, -p * r / 2 + 0.75 * g3, -1.5 * g2]


def lagrange(t, x, dx):
    """Heavy, of revolution: matrix from space to body by rows, angular velocity in space."""
    R, w = x[:9].reshape(3, 3).T, x[9:]
    e, I1, I3, mgl = R @ E3, 1.0, 0.4, 1.5
    spin = I3 * (w @ e)
    de = np.cross(w, e)
    # the momentum I1 e × ė + spin e has the rate e × (−mgl z), and w = e × ė + spin/I3 e
    dx[:9] = (-R.T @ hat(w)).ravel()
    dx[9:] = (np.cross(e, -mgl * E3) - spin * de) / I1 + spin / I3 * de


def comet(x):
    """Three masses: place, matrix by rows, and both velocities along the axes of space."""
    T, R, v, w = x[:3], x[3:12].reshape(3, 3), x[12:15], x[15:]
    arms = 0.1 * (R @ np.array([[1, -1, 0], [0, 0, 1.0], [0, 0, 0]])).T
    places = T + arms
    forces = -places / np.linalg.norm(places, axis=1)[:, None] ** 3
    s = arms.mean(axis=0)
    tensor = sum(np.eye(3) * (r @ r) - np.outer(r, r) for r in arms - s)
    moment = np.cross(arms - s, forces).sum(axis=0)
    dw = np.linalg.solve(tensor, moment - np.cross(w, tensor @ w))
    dv = forces.sum(axis=0) / 3 - np.cross(dw, s) - np.cross(w, np.cross(w, s))
    return np.concatenate([v, (hat(w) @ R).ravel(), dv, dw])


def bar(x):
    """By the two ends of a bar, as masses on springs that a constraint holds together."""
    A, T, w, v = x[:4].reshape(2, 2), x[4:6], x[6], x[7:]
    J = np.array([[0, -1], [1, 0]])
    ends = np.array([[-0.5, 0], [0.5, 0]])
    pulls = []
    for end in ends:
        reach = T + A @ end - end
        length = np.linalg.norm(reach)
        pulls.append([0, -9.81] - 40 * (1 - 0.4 / length) * reach)
    total, along = sum(pulls), A @ [0.5, 0]
    turning = (pulls[1] - pulls[0]) @ (J @ along) / 0.5
    return np.concatenate([(w * A @ J).ravel(), A @ v, [turning], A.T @ total / 2 - w * J @ v])


def pendulum(x):
    """A bob on a rod, by the cosine and the sine of its angle."""
    cos, sin, w = x[0], x[2], x[4]
    return [-sin * w, -cos * w, cos * w, -sin * w, -9.81 / 0.8 * sin]
