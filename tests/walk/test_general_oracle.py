"""The oracle for any problem file, against Newton's law.

Shapes are those of the oracle: ``basis`` (d, s, s), a group element and then zeta (d,) in a state.
"""

import numpy as np
import pytest

from tests.oracles import general, relative_error


def algebra(group):
    """A basis (d, s, s) of all matrices, on (r, 1) with the last row 0."""
    n, s = int(group[-2]), int(group[-2]) + ("A" in group)
    return np.eye(s * s).reshape(-1, s, s)[: n * s]


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
