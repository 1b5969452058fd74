"""Newton's law for N points whose coordinates are tied by constraints, with multipliers.

The constraints know no group: so3 keeps every scalar product of positions, se3 every mutual
distance, sl3 the linear relation of the fourth point with the first three and their volume.
Twice differentiated in time, a constraint ``f(q) = constant`` reads ``df(a) = -d2f(v, v)``; the
rows of df and these right-hand sides are written out below.
"""

import numpy as np

from tests.oracles import general, sampling

RANK_TOLERANCE = 1e-11


def scalar_products(q, v, body):
    """Rows and right-hand sides of ``<q_i, q_j> = constant`` for i <= j."""
    first, second = np.triu_indices(len(q))
    rows = np.zeros((len(first), len(q), 3))
    for row, i, j in zip(rows, first, second, strict=True):
        row[i] += q[j]
        row[j] += q[i]
    return rows.reshape(len(rows), -1), -2 * np.sum(v[first] * v[second], axis=1)


def distances(q, v, body):
    """Rows and right-hand sides of ``|q_i - q_j|^2 / 2 = constant`` for i < j."""
    first, second = np.triu_indices(len(q), 1)
    rows = np.zeros((len(first), len(q), 3))
    for row, i, j in zip(rows, first, second, strict=True):
        row[i], row[j] = q[i] - q[j], q[j] - q[i]
    return rows.reshape(len(rows), -1), -np.sum((v[first] - v[second]) ** 2, axis=1)


def dependency_and_volume(q, v, body):
    """Rows and right-hand sides of ``q_4 = sum s_k q_k`` and ``det(q_1, q_2, q_3) = constant``."""
    shares = np.linalg.solve(body.points[:3].T, body.points[3])
    rows, sides = np.zeros((4, 4, 3)), np.zeros(4)
    for axis in range(3):
        rows[axis, :3, axis], rows[axis, 3, axis] = -shares, 1
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        rows[3, i] = np.cross(q[j], q[k])
        sides[3] -= 2 * q[i] @ np.cross(v[j], v[k])
    return rows.reshape(4, -1), sides


CONSTRAINTS = {"so3": scalar_products, "se3": distances, "sl3": dependency_and_volume}


def accelerations(rows, sides, masses, forces):
    """Solve ``M a - rows^T l = F``, ``rows a = sides`` for ``a`` (N, 3), by least squares.

    In the unknowns ``sqrt(m) a``; multipliers of redundant constraints are left undetermined.
    """
    root = np.sqrt(np.repeat(masses, 3))
    scaled, size = rows / root, len(rows)
    system = np.block([[np.eye(len(root)), -scaled.T], [scaled, np.zeros((size, size))]])
    right = np.concatenate([forces.ravel() / root, sides])
    solution = np.linalg.lstsq(system, right, rcond=RANK_TOLERANCE)[0]
    return (solution[: len(root)] / root).reshape(-1, 3)


def rhs(name, x, body, u):
    """dx/dt in the state ``x``, with the covector ``u`` (d,) turned into the smallest forces on the
    points that have its work; the acceleration is one of the group."""
    data, basis = body.listed(name), sampling.basis(name)
    G, zeta = general.split(data, x, len(basis))
    Z, found = np.tensordot(zeta, basis, 1), general.places(data, {})
    q, v = (found.moved(m).reshape(-1, 3) for m in (G, G @ Z))
    moved = np.array([found.moved(G @ E) for E in basis])
    force = general.forces(data, {}, 0.0, found, q.ravel())
    force = force + np.linalg.lstsq(moved, u, rcond=RANK_TOLERANCE)[0]
    a = accelerations(*CONSTRAINTS[name](q, v, body), body.masses, force)
    remaining = a.ravel() - found.moved(G @ Z @ Z)
    change = np.linalg.lstsq(moved.T, remaining, rcond=RANK_TOLERANCE)[0]
    assert np.abs(change @ moved - remaining).max() < 1e-9 * np.abs(remaining).max()
    return general.join(data, G @ Z, change)
