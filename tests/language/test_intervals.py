"""Numbers of every class obey the laws of a field; within bounds, what is computed of them has all
its values there, and Routh’s signs."""

import pickle
from fractions import Fraction
from random import Random

import mpmath
import numpy as np
import pytest

from derive.check.fluid.lattice_values import LatticeResidues, Multiples
from derive.check.values.arithmetic import Nilpotent
from derive.check.values.residue import Residue
from derive.language.intervals import (
    BITS,
    Interval,
    UnknownSignError,
    characteristic,
    function,
    pi,
    signs_of_real_parts,
)
from derive.language.laurent import Laurent
from derive.language.univariate import Quadratic
from derive.language.values import arithmetic

SMALL = Fraction(1, 10**12)
FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh", "atan")


def holds(x, value):
    """Is a number of mpmath within bounds?"""
    return mpmath.mpf(x.low) / 2**BITS <= value <= mpmath.mpf(x.high) / 2**BITS


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("at", [Fraction(1, 3), Fraction(7, 2), Fraction(1, 10**9)])
def test_functions_have_their_values_within_bounds(name, at):
    with mpmath.workprec(2 * BITS):
        for radius in (Fraction(0), at * SMALL):
            found = function(name, Interval.about(at, radius))
            for x in (at - radius, at, at + radius):
                exact = getattr(mpmath, name)(mpmath.mpf(x.numerator) / x.denominator)
                assert holds(found, exact)
            assert found.high - found.low < (radius + Fraction(1, 2**200)) * 2**BITS * 300 / at


def test_sums_products_and_powers_are_enclosed():
    random = Random(4)
    for _ in range(200):
        a, b = (Fraction(random.randint(-99, 99), 7) for _ in range(2))
        x, y = (Interval.about(z, SMALL) for z in (a, b))
        for e, f in ((-SMALL, SMALL), (SMALL, SMALL), (Fraction(0), -SMALL)):
            p, q = a + e, b + f
            pairs = [(x + y, p + q), (x - y, p - q), (x * y, p * q), (x**3, p**3), (x * x, p * p)]
            pairs += [(x / y, p / q)] if b else []
            assert all(z.low <= w * 2**BITS <= z.high for z, w in pairs)


def test_what_is_exact_stays_so():
    x = Interval.about(Fraction(1, 3), SMALL)
    assert not x * 0
    assert x * 0 == 0
    assert ((x - x) * (x - x)).sign == 0
    y = Interval.about(Fraction(0), SMALL)
    assert y * y != 0
    assert (y * y).low == 0
    assert holds(Interval.of(Quadratic(Fraction(1), Fraction(2), 3)), 1 + 2 * mpmath.sqrt(3))
    with mpmath.workprec(2 * BITS):
        assert holds(pi(), mpmath.pi)


@pytest.mark.parametrize("name", ["sqrt", "log", "none"])
def test_a_sign_that_matters_must_be_known(name):
    with pytest.raises(UnknownSignError):
        function(name, Interval.about(Fraction(0), SMALL))
    with pytest.raises(ZeroDivisionError):
        1 / Interval.about(Fraction(0), SMALL)


def test_signs_of_real_parts_are_those_of_eigenvalues():
    random = Random(1)
    for _ in range(100):
        n = random.randint(2, 6)
        a = [[Fraction(random.randint(-9, 9), 4) for _ in range(n)] for _ in range(n)]
        a = [[x - 3 * (i == j) for j, x in enumerate(row)] for i, row in enumerate(a)]
        largest = max(np.linalg.eigvals(np.array(a, dtype=float)).real)
        expected = "negative" if largest < 0 else "positive"
        assert signs_of_real_parts(characteristic(a)) == expected


@pytest.mark.parametrize(
    ("a", "expected"),
    [
        ([[0, 1, 0], [0, 0, 0], [0, 0, 2]], "positive"),
        ([[0, 1, 0], [0, 0, 0], [0, 0, -2]], "unknown"),
        ([[0, 1], [-1, 0]], "unknown"),
        ([[0]], "unknown"),
        ([[-1]], "negative"),
    ],
)
def test_roots_that_are_0_or_imaginary_are_not_decided(a, expected):
    assert signs_of_real_parts(characteristic(a)) == expected


# -- rings ------------------------------------------------------------------------------------


P = 1000003
NUMBERS = {
    "quadratic": Quadratic(Fraction(1, 2), Fraction(3), 2),
    "laurent": Laurent.symbol("x") * Fraction(2, 3),
    "nilpotent": Nilpotent({0: Fraction(2), 1: Fraction(3), 2: Fraction(1, 2)}),
    "residue": Residue(17, P),
    "residues": LatticeResidues([1, 2, 3], P),
    "multiples": Multiples([1, -2, 3], P, Fraction(1, 3)),
}


def same(a, b):
    """Are they equal? A number with nilpotent parts by its parts."""
    parts = [{k: v for k, v in Nilpotent.of(x).parts.items() if v} for x in (a, b)]
    return parts[0] == parts[1] if isinstance(a, Nilpotent) else a == b


@pytest.mark.parametrize("kind", NUMBERS)
@pytest.mark.parametrize("c", [3, Fraction(-2, 5)])
def test_the_operators_that_follow_from_sum_and_product(kind, c):
    x = NUMBERS[kind]
    assert same(c + x, x + c)
    assert same(c * x, x * c)
    assert same((x - c) + c, x)
    assert same((c - x) + x, x - x + c)
    assert same(-x + x, x * 0)
    assert same((x / c) * c, x)
    assert same((c / x) * x, x / x * c)
    assert same(x**3, x * x * x)
    assert same(x**-2 * x * x, x / x)


def test_trees_have_their_values_in_it():
    known = {"x": NUMBERS["quadratic"], "y": Fraction(3)}
    x, y = known["x"], known["y"]
    assert arithmetic(("add", "x", "y", "y"), known.get) == x + 6
    assert arithmetic(("mul", "x", "y", "x"), known.get) == 3 * x * x
    assert arithmetic(("div", "x", "y"), known.get) == x / y
    assert arithmetic(("pow", "x", -2), known.get) == 1 / (x * x)
    with pytest.raises(ValueError, match="no value for the operator 'tr'"):
        arithmetic(("tr", "x"), known.get)


def test_a_tree_as_a_symbol_is_the_same_tuple_in_any_process():
    """Its hash, once found, does not go along: elsewhere texts have another."""
    tree = ("div", 1, ("add", "x", Fraction(13, 10)))
    (((symbol, _),),) = Laurent.symbol(tree).terms
    again = pickle.loads(pickle.dumps(symbol))
    assert symbol == again == tree
    assert hash(symbol) == hash(tree)
    assert repr(symbol) == repr(tree)
    assert type(again) is tuple
