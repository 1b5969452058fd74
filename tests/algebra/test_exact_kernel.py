"""Kernels modulo primes, rational numbers from residues, and vectors of residues; determinants and
adjugates of words, beside those of NumPy at random matrices."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest
import sympy

from derive.algebra.calculus import adjugate, determinant, determinant_letter, power_of
from derive.algebra.exact_kernel import (
    PRIMES,
    ResidueVector,
    ResidueVectorSource,
    echelon,
    fraction_of,
    kernel,
    pivots,
    rational,
    residue_of,
)
from derive.algebra.words import Letter, one, trace, word

P = PRIMES[0]


@pytest.mark.parametrize("shape", [(4, 7), (7, 4), (6, 6), (1, 3)])
def test_a_kernel_is_that_of_sympy(shape):
    random = Random(str(shape))
    rank = min(shape) - 1
    rows = [[random.randint(-5, 5) for _ in range(shape[1])] for _ in range(max(rank, 1))]
    rows += [[sum(x) for x in zip(*rows, strict=True)] for _ in range(shape[0] - len(rows))]
    residues, width = [[x % P for x in row] for row in rows], shape[1]
    found, free = kernel(residues, width, P)
    matrix = sympy.Matrix(rows)
    assert len(found) == len(free) == len(matrix.nullspace())
    reduced, leading = matrix.rref()
    there = [[residue_of(Fraction(x.p, x.q), P) for x in row] for row in reduced.tolist()]
    assert echelon(residues, width, P) == (there[: len(leading)], [*leading])
    assert pivots(residues, width, P) == [*leading]
    for x in found:
        assert not any(sum(a * b for a, b in zip(row, x, strict=True)) % P for row in rows)
    assert all(found[k][c] == 1 for k, c in enumerate(free))


@pytest.mark.parametrize("p", [P, 3])
def test_digits_do_not_overflow(p):
    """The largest residues, in more rows and columns than one digit of 62 bits would bear."""
    n = 70
    rows = [[p - 1 - (i == j) for j in range(n)] for i in range(n)]
    matrix = sympy.Matrix(rows)
    rank = sympy.polys.matrices.DomainMatrix.from_Matrix(matrix).convert_to(sympy.GF(p)).rank()
    assert len(pivots(rows, n, p)) == rank
    for x in kernel(rows, n, p)[0]:
        assert not any(sum(a * b for a, b in zip(row, x, strict=True)) % p for row in rows)


def test_there_may_be_no_rows():
    assert kernel([], 2, P) == ([[1, 0], [0, 1]], [0, 1])
    assert echelon([[0, 0]], 2, P) == ([], [])


def test_primes():
    assert all(sympy.isprime(p) and p % 4 == 3 and p < 2**31 for p in PRIMES)
    assert len({*PRIMES}) == len(PRIMES)


@pytest.mark.parametrize("x", [Fraction(0), Fraction(-3, 7), Fraction(30000, 32767), Fraction(5)])
def test_a_fraction_is_found_again(x):
    assert fraction_of(residue_of(x, P), P) == x
    assert rational([residue_of(x, p) for p in PRIMES[:2]], PRIMES[:2]) == x


def test_a_long_fraction_needs_more_primes():
    x = Fraction(123456789, 1000000007)
    residues = [residue_of(x, p) for p in PRIMES]
    assert rational(residues[:2], PRIMES[:2]) is None
    assert rational(residues[:4], PRIMES[:4]) == x


def test_residues_compute_as_numbers():
    x, y = (ResidueVector([a, b], P) for a, b in ((3, 5), (7, 11)))
    for found, expected in (
        (x + y, (10, 16)),
        (x - 1, (2, 4)),
        (2 - x, (-1, -3)),
        (x * Fraction(1, 3), (1, Fraction(5, 3))),
        (x / y, (Fraction(3, 7), Fraction(5, 11))),
        (1 / x, (Fraction(1, 3), Fraction(1, 5))),
        (x**-2, (Fraction(1, 9), Fraction(1, 25))),
        (-x, (-3, -5)),
        (x * 0 + y, (7, 11)),
        (
            ResidueVector.dot([x, 2, y, 3, 0], [y, x, Fraction(1, 3), 5, x]),
            (21 + 6 + Fraction(7, 3) + 15, 55 + 10 + Fraction(11, 3) + 15),
        ),
    ):
        assert [*found.values] == [residue_of(Fraction(e), P) for e in expected]


def test_roots_are_roots():
    source = ResidueVectorSource(P, 100, 3)
    x = source.randint(1, 1)
    square = x * x
    root = square.root()
    assert root * root == square


# -- determinants of words --------------------------------------------------------------------


X, Y, U = Letter("X", 3, 3), Letter("Y", 3, 3), Letter("u")
AT = dict(zip("XY", np.random.default_rng(3).normal(size=(2, 3, 3)), strict=True)) | {"u": 0.7}


def value(e):
    """The matrix of a 3 x 3 expression, or a number."""

    def of(w):
        total = np.eye(3)
        for letter, bar in w:
            x = np.atleast_2d(AT.get(letter.name, 0))
            total = x[0, 0] * total if x.size == 1 else total @ (x.T if bar else x)
        return total

    total = np.zeros((3, 3))
    for (traces, w), c in e.terms.items():
        scalars = [of(t)[0, 0] if t[0][0].rows == 1 else np.trace(of(t)) for t in traces]
        total = total + float(c) * np.prod(scalars) * of(w)
    return total[0, 0] if e.is_scalar else total


def test_the_determinant_of_a_product():
    e = 2 * word(U) * trace(word(Y)) * word(X, Y, X).bar
    found = determinant(e)
    names = {determinant_letter(x).name: np.linalg.det(AT[x.name]) for x in (X, Y)}
    AT.update(names)
    assert value(found) == pytest.approx(np.linalg.det(value(e)))
    with pytest.raises(ValueError, match="of a sum"):
        determinant(word(X) + word(Y))


def test_a_skew_one_of_odd_size():
    for n in (2, 3, 4, 5):
        skew = word(Letter("S", n, n, -1))
        assert (determinant(skew) == determinant(skew.bar)) == (n % 2 == 0)


def test_the_adjugate_in_powers():
    shifted = adjugate(word(X) * word(Y).bar + word(U) * one(3))
    matrix = AT["X"] @ AT["Y"].T + AT["u"] * np.eye(3)
    wanted = np.linalg.det(matrix) * np.linalg.inv(matrix)
    assert pytest.approx(value(shifted)) == wanted
    parts = (value(power_of(shifted, U, k)) * AT["u"] ** k for k in range(3))
    assert sum(parts) == pytest.approx(wanted)
    with pytest.raises(ValueError, match="3 × 3"):
        adjugate(word(Letter("Z", 2, 2)))
