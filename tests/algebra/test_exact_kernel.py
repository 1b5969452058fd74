"""Kernels modulo primes, rational numbers from residues, and arrays of residues."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest
import sympy

from derive.algebra.exact_kernel import echelon, fraction_of, kernel, rational
from derive.algebra.residue_arrays import PRIMES, Residues, ResidueSource, residue_of

P = PRIMES[0]


@pytest.mark.parametrize("shape", [(4, 7), (7, 4), (6, 6), (1, 3)])
def test_a_kernel_is_that_of_sympy(shape):
    random = Random(str(shape))
    rank = min(shape) - 1
    rows = [[random.randint(-5, 5) for _ in range(shape[1])] for _ in range(max(rank, 1))]
    rows += [[sum(x) for x in zip(*rows, strict=True)] for _ in range(shape[0] - len(rows))]
    found, free = kernel(np.array(rows), P)
    matrix = sympy.Matrix(rows)
    assert len(found) == len(free) == len(matrix.nullspace())
    assert echelon(np.array(rows), P)[1] == [*matrix.rref()[1]]
    products = (np.array(rows) % P)[:, None, :] * found % P
    assert not (products.sum(axis=2) % P).any()
    assert all(found[k, c] == 1 for k, c in enumerate(free))


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
    x, y = (Residues(np.array([a, b], np.int64), P) for a, b in ((3, 5), (7, 11)))
    for found, expected in (
        (x + y, (10, 16)),
        (x - 1, (2, 4)),
        (2 - x, (-1, -3)),
        (x * Fraction(1, 3), (1, Fraction(5, 3))),
        (x / y, (Fraction(3, 7), Fraction(5, 11))),
        (1 / x, (Fraction(1, 3), Fraction(1, 5))),
        (x**-2, (Fraction(1, 9), Fraction(1, 25))),
        (-x, (-3, -5)),
    ):
        assert [*found.values] == [residue_of(Fraction(e), P) for e in expected]


def test_roots_are_roots():
    source = ResidueSource(P, 100, 3)
    x = source.randint(1, 1)
    square = x * x
    root = square.root()
    assert root * root == square
