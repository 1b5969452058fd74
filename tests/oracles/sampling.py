"""Random bodies, group elements and states for so3, se3 and sl3, and what points make of them.

At the end, a body with given moments.

Conventions: a point r of the body is at ``q = A r`` (so3, sl3) or ``q = A r + T`` (se3).  A state
is ``A`` row-major, then ``T`` (se3), then the coordinates of ``Z = G^-1 dG/dt``: ``zeta`` for so3,
``zeta, w`` for se3, the first eight entries of Z for sl3.
"""

from dataclasses import dataclass

import numpy as np

AXES = "123"


@dataclass(frozen=True)
class Body:
    """N points: ``masses`` (N,), ``points`` (N, 3), a ``gravity`` (3,) and ``springs`` (N, N).

    ``springs`` is symmetric: the stiffness of the spring, of natural length 0, between two points.
    """

    masses: np.ndarray
    points: np.ndarray
    gravity: np.ndarray
    springs: np.ndarray

    def forces(self, q):
        """Forces (N, 3) of gravity and springs on the points at ``q`` (N, 3)."""
        pull = self.springs @ q - self.springs.sum(axis=1)[:, None] * q
        return self.masses[:, None] * self.gravity + pull

    def energy(self, q, v):
        """Kinetic and potential energy of the points at ``q`` with velocities ``v``."""
        gaps = np.sum((q[:, None] - q[None, :]) ** 2, axis=2)
        kinetic = 0.5 * np.sum(self.masses * np.sum(v * v, axis=1))
        return kinetic - self.masses @ (q @ self.gravity) + 0.25 * np.sum(self.springs * gaps)


def moments(body):
    """``m`` = sum m_i, ``c`` = sum m_i r_i, ``J`` = sum m_i r_i r_i^T."""
    weighted = body.masses[:, None] * body.points
    return body.masses.sum(), weighted.sum(axis=0), weighted.T @ body.points


def inertia(body):
    """The inertia tensor about the body's origin, from its definition on points."""
    squares = np.sum(body.points**2, axis=1)
    outer = body.points[:, :, None] * body.points[:, None, :]
    terms = squares[:, None, None] * np.eye(3) - outer
    return np.einsum("i,iab->ab", body.masses, terms)


def parameters(name, body):
    """The body as the named parameters of the problem ``name`` (more names than it may need)."""
    if name == "sl3":
        values = {f"m{i + 1}": mass for i, mass in enumerate(body.masses)}
        for i, point in enumerate(body.points):
            values |= {f"{axis}{i + 1}": entry for axis, entry in zip("xyz", point, strict=True)}
        for i, j in zip(*np.triu_indices(4, 1), strict=True):
            values[f"k{i + 1}{j + 1}"] = body.springs[i, j]
        return values
    m, c, J = moments(body)
    values = {"m": m}
    values |= {f"c_{a}": c[i] for i, a in enumerate(AXES)}
    values |= {f"g_{a}": body.gravity[i] for i, a in enumerate(AXES)}
    values |= {f"J_{AXES[i]}{AXES[j]}": J[i, j] for i in range(3) for j in range(i, 3)}
    return values


def cross_matrix(v):
    """The matrix j(v): j(v) y = v x y."""
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]], float)


def algebra(name, coordinates):
    """The matrix Z (3 x 3, for se3 4 x 4) with these coordinates."""
    z = np.asarray(coordinates, float)
    if name == "so3":
        return cross_matrix(z)
    if name == "se3":
        matrix = np.zeros((4, 4))
        matrix[:3, :3], matrix[:3, 3] = cross_matrix(z[:3]), z[3:]
        return matrix
    return np.append(z, -z[0] - z[4]).reshape(3, 3)


DIMENSION = {"so3": 3, "se3": 6, "sl3": 8}


def basis(name):
    """The basis (d, n, n) of the Lie algebra in which the coordinates are stated."""
    return np.array([algebra(name, row) for row in np.eye(DIMENSION[name])])


def split(name, x):
    """A state as matrices ``G``, ``Z``: 3 x 3, and for se3 4 x 4."""
    G = np.eye(4 if name == "se3" else 3)
    G[:3, :3] = x[:9].reshape(3, 3)
    if name == "se3":
        G[:3, 3] = x[9:12]
    return G, algebra(name, x[-DIMENSION[name] :])


def join(name, G, coordinates):
    """A state from the matrix ``G`` (or its velocity from dG/dt) and d coordinates."""
    shift = G[:3, 3] if name == "se3" else []
    return np.concatenate([G[:3, :3].ravel(), shift, coordinates])


def homogeneous(name, points):
    """Points as the group moves them: (N, 3), and for se3 (N, 4) with a last column of ones."""
    return np.column_stack([points, np.ones(len(points))]) if name == "se3" else points


def motion(name, x, body):
    """Positions and velocities (N, 3) of the body's points in the state ``x``."""
    G, Z = split(name, x)
    points = homogeneous(name, body.points)
    return (points @ G.T)[:, :3], (points @ (G @ Z).T)[:, :3]


def well_spread(name, masses, points):
    """Whether the body is far from flat, and its first three points from a plane through 0."""
    centre = masses @ points / masses.sum() if name == "se3" else 0
    sizes = np.linalg.svd(np.sqrt(masses)[:, None] * (points - centre), compute_uv=False)
    return sizes[2] > 0.25 * sizes[0] and abs(np.linalg.det(points[:3])) > 0.3


def random_body(name, rng):
    """A body of 4 (sl3) or 4 to 6 points, with gravity (so3, se3) or six springs (sl3)."""
    count = 4 if name == "sl3" else int(rng.integers(4, 7))
    while True:
        masses, points = rng.uniform(0.5, 2, count), rng.normal(size=(count, 3))
        if well_spread(name, masses, points):
            break
    springs = np.zeros((count, count))
    if name != "sl3":
        return Body(masses, points, rng.normal(scale=3, size=3), springs)
    springs[np.triu_indices(4, 1)] = rng.uniform(0.2, 3, 6)
    return Body(masses, points, np.zeros(3), springs + springs.T)


def random_rotation(rng):
    """A rotation matrix, uniformly distributed."""
    Q, R = np.linalg.qr(rng.normal(size=(3, 3)))
    Q = Q * np.sign(np.diag(R))
    return Q if np.linalg.det(Q) > 0 else Q[:, [1, 0, 2]]


def random_element(name, rng):
    """A group element: a rotation, a displacement (4 x 4), or a matrix of determinant 1."""
    G = np.eye(4 if name == "se3" else 3)
    G[:3, :3] = random_rotation(rng)
    if name == "se3":
        G[:3, 3] = rng.normal(size=3)
    if name == "sl3":
        stretch = rng.uniform(-0.6, 0.6, 3)
        G = G @ np.diag(np.exp(stretch - stretch.mean())) @ random_rotation(rng)
    return G


def random_state(name, rng):
    """A state with a random group element and normally distributed velocity."""
    return join(name, random_element(name, rng), rng.normal(size=DIMENSION[name]))


def turn(axis, angle):
    """The rotation by ``angle`` about ``axis``."""
    j = cross_matrix(np.asarray(axis) / np.linalg.norm(axis))
    return np.eye(3) + np.sin(angle) * j + (1 - np.cos(angle)) * j @ j


def quaternion(A):
    """A unit quaternion e, scalar first, of the rotation A: the largest column of 4 e e^T."""
    K, trace = np.zeros((4, 4)), np.trace(A)
    K[0, 0], K[1:, 1:] = 1 + trace, A + A.T + (1 - trace) * np.eye(3)
    K[0, 1:] = K[1:, 0] = A[2, 1] - A[1, 2], A[0, 2] - A[2, 0], A[1, 0] - A[0, 1]
    column = K[:, np.argmax(np.diag(K))]
    return column / np.linalg.norm(column)


def solid_body(inertia, mass=1.0, centre=(0.0, 0.0, 0.0), gravity=(0.0, 0.0, 0.0)):
    """Seven points with this mass, centre of mass and tensor of inertia (3, 3) about it.

    Half of the mass is at the centre, the rest in three pairs on the axes of J about it.
    """
    sizes, axes = np.linalg.eigh(np.trace(inertia) / 2 * np.eye(3) - inertia)
    arms = (axes * np.sqrt(6 * sizes / mass)).T
    points = np.vstack([np.zeros(3), arms, -arms]) + centre
    masses = mass * np.array([1 / 2] + [1 / 12] * 6)
    return Body(masses, points, np.array(gravity, float), np.zeros((7, 7)))
