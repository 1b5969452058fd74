"""Random bodies, group elements and states for so3, se3 and sl3, and what points make of them.

At the end, a body with given moments.

Conventions: a point r of the body is at ``q = A r`` (so3, sl3) or ``q = A r + T`` (se3).  A state
is ``A`` row-major, then ``T`` (se3), then the coordinates of ``Z = G^-1 dG/dt``: ``zeta`` for so3,
``zeta, w`` for se3, the first eight entries of Z for sl3.
"""

from dataclasses import dataclass

import numpy as np

from tests.oracles import general

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

    def listed(self, name):
        """The body and its forces as a problem file has them, on the group of so3, se3 or sl3."""
        points = zip(self.masses, self.points, strict=True)
        data = {"group": f"{name[:2].upper()}(3)", "input": [{"name": "u", "kind": "covector"}]}
        data["point"] = [{"mass": m, "at": [*r]} for m, r in points]
        data["potential"] = [{"kind": "gravity", "g": [*self.gravity]}]
        for i, j in np.argwhere(np.triu(self.springs)):
            ends = {"between": [i + 1, j + 1], "stiffness": self.springs[i, j]}
            data["potential"].append({"kind": "spring", **ends})
        return data


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


DIMENSION = {"so3": 3, "se3": 6, "sl3": 8}


def basis(name):
    """The basis (d, n, n) of the Lie algebra in which the coordinates are stated."""
    turns = np.array([cross_matrix(e) for e in np.eye(3)])
    units = np.eye(16).reshape(4, 4, 4, 4)
    if name == "so3":
        return turns
    if name == "se3":
        return np.concatenate([np.pad(turns, [(0, 0), (0, 1), (0, 1)]), units[:3, 3]])
    square = np.eye(9).reshape(9, 3, 3)
    return square[:8] - np.einsum("aii->a", square[:8])[:, None, None] * square[8]


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


def random_state(name, rng):
    """A state with a random group element and normally distributed velocity."""
    return general.random_state(Body(*[np.zeros(0)] * 4).listed(name), basis(name), rng)


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
