"""Numbers of every class obey the laws of a field, and trees have their values in it."""

from fractions import Fraction

import pytest

from derive.check.fluid.lattice_values import LatticeResidues, Multiples
from derive.check.values.arithmetic import Nilpotent
from derive.check.values.residue import Residue
from derive.language.laurent import Laurent
from derive.language.univariate import Quadratic
from derive.language.values import arithmetic

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
