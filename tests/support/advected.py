"""Algebras without a group in the state, beside vectors that are carried along."""

import numpy as np

from derive.algebra.families import group
from derive.problem.toml import problem_of


def matrices(name):
    """A basis of a known algebra, as the oracle has it: on (r, 1) where it is affine."""
    found = group(name).in_user_basis
    return np.array([[[float(x) for x in row] for row in e] for e in found.basis])


def brackets(E):
    """The rows of a table for these matrices, by least squares."""
    flat = np.linalg.pinv(E.reshape(len(E), -1).T)
    rows = []
    for a in range(len(E)):
        for b in range(a + 1, len(E)):
            found = flat @ (E[a] @ E[b] - E[b] @ E[a]).reshape(-1)
            rows += [[a + 1, b + 1, k + 1, round(x)] for k, x in enumerate(found) if abs(x) > 0.5]
    return rows


def square(d):
    return " + ".join(f"{2 + k}*zeta_{k + 1}^2" for k in range(d)) + " + zeta_1*zeta_2"


GIVEN = {  # group, side, representation, the terms beside the square
    "heavy top": ("SO(3)", "left", "standard", "-3*x_3 + x_1*zeta_2"),
    "on the right": ("SO(3)", "right", "standard", "-3*x_3 + x_1*zeta_2"),
    "underwater": ("SE(3)", "left", "dual", "x_1^2 - x_2*x_4"),
    "Heisenberg": ("UT(3)", "left", "standard", "x_1*x_2 + x_2*zeta_3"),
    "Heisenberg on the right": ("UT(3)", "right", "dual", "sin(x_1)*zeta_1 + t*x_3"),
    "plane": ("SL(2)", "right", "standard", "exp(x_1/3) + x_2^3"),
    "displacements of the plane": ("SE(2)", "left", "standard", "x_1*x_2*zeta_3"),
}
BY_BRACKETS = {"heavy top": "adjoint", "Heisenberg": "coadjoint", "plane": "adjoint"}
"""Given without matrices: the representation is then one that every algebra has."""
CASES = [(x, GIVEN[x][2], False) for x in GIVEN] + [(x, y, True) for x, y in BY_BRACKETS.items()]


def lagrangian(case):
    """ℓ as text."""
    name, *_, terms = GIVEN[case]
    return f"{square(len(matrices(name)))} + {terms}"


def problem(case, kind, by_brackets):
    """A problem named test, with a covector as its input."""
    name, side, *_ = GIVEN[case]
    E = matrices(name)
    algebra = {"brackets": brackets(E), "dimension": len(E)} if by_brackets else {"of": name}
    return problem_of(
        {
            "name": "test",
            "algebra": algebra,
            "advected": [{"name": "x", "representation": kind}],
            "lagrangian": {"L": lagrangian(case), "trivialisation": side},
            "input": [{"name": "u", "kind": "covector"}],
        }
    )
