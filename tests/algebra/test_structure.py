"""Algebras by their structure constants: Jacobi, representations, matrices that stand for them."""

from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
import sympy

from derive.algebra.structure import (
    adjoint,
    brackets_of,
    derivations,
    dual,
    faithful,
    rank,
    require_jacobi,
    require_representation,
    table_of,
)

ONE = Fraction(1)
ALGEBRAS = {  # dimension, rows
    "so(3)": (3, [(1, 2, 3, ONE), (2, 3, 1, ONE), (3, 1, 2, ONE)]),
    "Heisenberg": (3, [(1, 2, 3, ONE)]),
    "Heisenberg in R^5": (5, [(1, 2, 5, ONE), (3, 4, 5, Fraction(2))]),
    "oscillator": (4, [(1, 2, 3, ONE), (4, 1, 2, ONE), (4, 2, 1, -ONE)]),
    "abelian": (4, []),
    "line": (1, []),
    "ax + b": (2, [(1, 2, 2, ONE)]),
    "with a centre": (4, [(1, 2, 3, ONE), (2, 3, 1, ONE), (3, 1, 2, ONE)]),
    "filiform": (5, [(1, 2, 3, ONE), (1, 3, 4, ONE), (1, 4, 5, ONE)]),
}


@pytest.mark.parametrize("name", ALGEBRAS)
def test_matrices_that_stand_for_an_algebra(name):
    """They are independent, and their commutators are the brackets: by NumPy."""
    dimension, rows = ALGEBRAS[name]
    brackets = brackets_of(rows)
    require_jacobi(brackets, dimension)
    E = np.array(faithful(brackets, dimension), float)
    assert np.linalg.matrix_rank(E.reshape(dimension, -1)) == dimension
    table = np.array(table_of(brackets, dimension), float)
    for a, b in combinations(range(dimension), 2):
        assert np.allclose(E[a] @ E[b] - E[b] @ E[a], np.tensordot(table[a, b], E, 1))


@pytest.mark.parametrize("name", ALGEBRAS)
def test_the_adjoint_and_its_dual(name):
    dimension, rows = ALGEBRAS[name]
    brackets = brackets_of(rows)
    for found in (adjoint(brackets, dimension), dual(adjoint(brackets, dimension))):
        require_representation(found, brackets)


@pytest.mark.parametrize("name", ALGEBRAS)
def test_derivations(name):
    """As many as SymPy finds, and each is one."""
    dimension, rows = ALGEBRAS[name]
    brackets = brackets_of(rows)
    c = np.array(table_of(brackets, dimension), float)
    found = derivations(brackets, dimension)
    for D in np.array(found, float).reshape(len(found), dimension, dimension):
        moved = np.einsum("abk,ik->abi", c, D)
        assert np.allclose(moved, np.einsum("ia,ibk->abk", D, c) + np.einsum("ib,aik->abk", D, c))
    d = sympy.Matrix(dimension, dimension, lambda i, j: sympy.Symbol(f"d_{i}_{j}"))
    conditions = [
        sum(int(c[a, b, k] * 2) * d[i, k] for k in range(dimension))
        - sum(
            int(c[j, b, i] * 2) * d[j, a] + int(c[a, j, i] * 2) * d[j, b] for j in range(dimension)
        )
        for a, b in combinations(range(dimension), 2)
        for i in range(dimension)
    ]
    system = sympy.Matrix([[x.coeff(y) for y in d] for x in map(sympy.expand, conditions) if x])
    assert len(found) == dimension**2 - (system.rank() if len(system) else 0)


def test_jacobi_names_the_triple():
    rows = [(1, 2, 3, ONE), (2, 3, 2, ONE), (3, 1, 2, ONE)]
    with pytest.raises(ValueError, match=r"fails for E_1, E_2, E_3: .* is −E_3, not 0"):
        require_jacobi(brackets_of(rows), 3)


def test_an_algebra_that_is_not_seen():
    """Characteristically nilpotent, of dimension 7: no derivation moves the centre."""
    rows = [(1, i, i + 1) for i in range(2, 7)] + [(2, 3, 6), (2, 4, 7), (2, 5, 7)]
    brackets = brackets_of([*((*row, ONE) for row in rows), (3, 4, 7, -ONE)])
    require_jacobi(brackets, 7)
    with pytest.raises(ValueError, match="give it by a basis of matrices"):
        faithful(brackets, 7)


def test_rank_counts_independent_matrices():
    assert rank([((1, 2), (0, 0)), ((2, 4), (0, 0)), ((0, 0), (0, 0)), ((0, 1), (0, 0))]) == 2
