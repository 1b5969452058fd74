"""The oracle for any problem file, against Newton's law.

Shapes are those of the oracle: ``basis`` (d, s, s), a group element and then zeta (d,) in a state.
"""

import numpy as np
import pytest

from tests.oracles import general, relative_error

SCREW = {"action": "affine", "basis": [[[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0.5], [0, 0, 0, 0]]]}
GROUPS = [
    *("SO(2)", "SO(4)", "SE(2)", "SE(3)", "SL(3)", "SAff(2)", "GL(2)", "Aff(2)", "Sp(4)", "Sim(3)"),
    *("UT(3)", "U(2)", "SU(2)", "SO(3) x SE(3)", "Aff(2) x SL(2)", "U(1) x SE(3)", SCREW),
]
AFFINE = {"SE": "SO", "SAff": "SL", "Aff": "GL", "Sim": "CO"}


def factor(name):
    """A basis (d, s, s) of the algebra of a named group, from the equations that define it."""
    family, number = name[:-1].split("(")
    n = int(number) * (2 if family in ("U", "SU") else 1)
    s, J = n + (family in AFFINE), np.kron([[0, 1], [-1, 0]], np.eye(n // 2))
    vanishing = {
        "SO": lambda X: X + X.T,
        "SL": np.trace,
        "GL": lambda X: 0,
        "CO": lambda X: X + X.T - 2 * np.eye(n) * np.trace(X) / n,
        "Sp": lambda X: X.T @ J + J @ X,
        "UT": np.tril,
        "U": lambda X: [X + X.T, X @ J - J @ X],
        "SU": lambda X: [X + X.T, X @ J - J @ X, np.eye(n) * np.trace(J @ X)],
    }[AFFINE.get(family, family)]
    units = np.eye(s * s).reshape(-1, s, s)
    rows = [np.append(np.ravel(vanishing(X[:n, :n])), X[n:]) for X in units]
    _, sizes, V = np.linalg.svd(np.array(rows).T)
    return V[np.sum(sizes > 1e-9) :].reshape(-1, s, s)


def algebra(group):
    """A basis (d, s, s) for a named group, a product, or a group that is given by a table."""
    if isinstance(group, dict):
        return np.array(group["basis"], float)
    parts = [factor(name) for name in group.split(" x ")]
    ends = np.cumsum([0, *(basis.shape[1] for basis in parts)])
    margins = [((0, 0), *[(ends[k], ends[-1] - ends[k + 1])] * 2) for k in range(len(parts))]
    return np.concatenate([*map(np.pad, parts, margins)])


def matrices(data, basis, x, dx):
    """G and its first and second derivatives, (s, s), which give points their q, v and a."""
    G, zeta = general.split(data, x, len(basis))
    Z, change = np.tensordot(zeta, basis, 1), np.tensordot(dx[-len(basis) :], basis, 1)
    return G, G @ Z, G @ (change + Z @ Z)


def by_hand(q, v, A, masses, weights, u, t):
    """The forces (N, n) of :func:`test_newtons_law`, written out; ``weights`` (N,) of the place."""
    n = q.shape[1]
    F = masses[:, None] * np.arange(n) - 0.3 * v
    F -= masses[:, None] * 1.7 * (q - 3) / np.linalg.norm(q - 3, axis=1)[:, None] ** 3
    gap = q[0] - q[1]
    pull = 2.5 * (np.linalg.norm(gap) - 0.7) * gap / np.linalg.norm(gap)
    F[0] += u[:n] - pull
    F[1] += A @ u[n : 2 * n] + pull - 4 * (q[1] - 0.2) - 0.9 * v[1]
    F[0, 0] -= 2 * np.sin(t) * q[0, 0] * q[1, 1]
    F[1, 1] -= np.sin(t) * q[0, 0] ** 2 - 3 * q[1, 1] ** -4
    return F + np.outer(weights, A @ u[2 * n :] - 1.5 * (weights @ q + 1))


@pytest.mark.parametrize("group", ["GL(2)", "GL(3)", "GL(4)", "Aff(2)", "Aff(3)"])
def test_newtons_law(group):
    """As many points as the group moves freely: m a = F for each, and no constraint."""
    rng, basis, n, affine = np.random.default_rng(3), algebra(group), int(group[-2]), "A" in group
    X, Y = ("r1_x", "r2_y") if n < 4 else ("r1_1", "r2_2")
    for _ in range(10):
        at = np.eye(n + affine)[:, :n] + 0.3 * rng.normal(size=(n + affine, n))
        masses, weights = rng.uniform(0.5, 2, n + affine), rng.normal(size=n + affine)
        weights /= weights.sum() if affine else 1
        there = {"at": [*weights @ at]}
        data = {"group": group, "damping": [{"coefficient": 0.3}, {"coefficient": 0.9, "on": [2]}]}
        data["point"] = [{"mass": m, "at": [*r]} for m, r in zip(masses, at, strict=True)]
        data["potential"] = [
            {"kind": "spring", "between": [1, 2], "stiffness": 2.5, "length": 0.7},
            {"kind": "spring", "on": 2, "stiffness": "2^2", "anchor": [0.2] * n},
            {"kind": "spring", **there, "stiffness": 1.5, "anchor": [-1] * n},
            {"kind": "attraction", "strength": 1.7, "centre": [3] * n},
            {"kind": "expression", "U": f"sin(t)*{X}^2*{Y} + 1/{Y}^3"},
            {"kind": "gravity", "g": [*range(n)]},
        ]
        places = {"on": 1}, {"on": 2, "frame": "body"}, {**there, "frame": "body"}
        data["input"] = [
            {"kind": "force", "name": f"f{k}", **place} for k, place in enumerate(places)
        ]
        x, t, u = general.random_state(data, basis, rng), rng.normal(), rng.normal(size=3 * n)
        dx = general.rhs(data, basis, {}, t, x, u)
        matrix = matrices(data, basis, x, dx)
        q, v, a = (np.array(general.positions(data, {}, x)) for x in matrix)
        F = by_hand(q, v, matrix[0][:n, :n], masses, weights, u, t)
        assert relative_error(a * masses[:, None], F) < 1e-11


@pytest.mark.parametrize("group", GROUPS, ids=str)
def test_random_states_are_in_the_group(group):
    """G E_a G^-1 is in the algebra, determinants are right; split and join agree."""
    rng, basis, data = np.random.default_rng(7), algebra(group), {"group": group}
    x = general.random_state(data, basis, rng)
    G, zeta = general.split(data, x, len(basis))
    np.testing.assert_array_equal(general.join(data, G, zeta), x)
    flat = basis.reshape(len(basis), -1)
    images = (G @ basis @ np.linalg.inv(G)).reshape(len(basis), -1)
    assert relative_error(images @ np.linalg.pinv(flat) @ flat, images) < 1e-13
    if group in ("SO(2)", "SO(4)", "U(2)", "SU(2)"):
        np.testing.assert_allclose(G.T @ G, np.eye(len(G)), atol=1e-14)
    if str(group)[:2] not in ("GL", "Af", "Si"):
        assert abs(np.linalg.det(G) - 1) < 1e-13
