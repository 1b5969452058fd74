"""What an enclosure rests on, for random polynomials and by SymPy: the contraction number κ < ½ on
all of the cube of half-width 2a, one critical point in it, and slopes that stay in their bounds."""

from fractions import Fraction
from itertools import product

import numpy as np
import pytest
import sympy
from scipy.optimize import fsolve

from derive.algebra.families import group
from derive.check.claims.enclosure import enclosure_fault
from derive.language.tree import add, mul
from derive.record.record import Equation, Step
from derive.search.equilibria.enclosed_points import _slopes, certified
from derive.search.equilibria.equilibrium_points import NoEquilibriumError

Y = sympy.symbols("y1 y2")
HIGHER = [e for e in product(range(5), repeat=2) if 2 < sum(e) < 5]
KAPPA = (0.2, 0.3, 0.4, 0.45, 0.49, 0.51, 0.55, 0.7, 0.9)
"""About what the contraction numbers are: some of each side, and near ½."""


def polynomial(seed, kappa):
    """A polynomial of degree 4 with a contraction number of about κ in a cube whose half-width has
    one digit, as the radii that are told, exponents → coefficient."""
    rng = np.random.default_rng(seed)
    terms = {(2, 0): 3, (1, 1): int(rng.integers(-2, 3)), (0, 2): int(rng.choice([-2, 2]))}
    terms |= {e: int(rng.integers(-3, 4)) for e in HIGHER}
    terms = {e: Fraction(c) for e, c in terms.items()}
    terms |= {e: Fraction(int(x)) for e, x in zip(ONES, rng.integers(1, 10, size=2), strict=True)}
    width, _ = contraction(terms)
    terms |= {e: terms[e] * WIDTH / Fraction(str(width)) for e in ONES}
    _, exact = contraction(terms)  # which is linear in the higher terms
    by = Fraction(kappa / float(exact)).limit_denominator(10**4)
    return terms | {e: terms[e] * by for e in HIGHER}


ONES = ((1, 0), (0, 1))
WIDTH = Fraction(1, 5)


def summed(terms):
    return sum(sympy.Rational(str(c)) * Y[0] ** i * Y[1] ** j for (i, j), c in terms.items())


def contraction(terms):
    """The half-width 2a of the cube, and κ there."""
    at_0 = dict.fromkeys(Y, 0)
    f = summed(terms)
    inverse = sympy.hessian(f, Y).subs(at_0).inv()
    step = inverse * sympy.Matrix([f.diff(y) for y in Y]).subs(at_0)
    width = 2 * max(abs(x) for x in step)
    above = summed({e: abs(c) for e, c in terms.items() if sum(e) > 2})
    change = sympy.hessian(above, Y).subs(dict.fromkeys(Y, width))
    moved = inverse.applyfunc(abs) * change
    return width, max(sum(moved.row(i)) for i in range(2))


def told(terms):
    """The step that claims a critical point, as the checker has it."""
    places = [("at", "Π", 1), ("at", "Π", 2)]
    powers = {e: [("pow", x, k) for x, k in zip(places, e, strict=True) if k] for e in terms}
    rhs = add(*(mul(c, *powers[e]) for e, c in terms.items() if c))
    return Step("x.enclosure", "enclosure", (), (Equation("h̃", rhs),), ())


def critical(terms, width):
    """The critical points in the cube."""
    f = summed(terms)
    slope = sympy.lambdify(Y, [f.diff(y) for y in Y])
    second = sympy.lambdify(Y, sympy.hessian(f, Y))
    found = []
    for start in product(np.linspace(-width, width, 5), repeat=2):
        x, _, ok, _ = fsolve(lambda x: slope(*x), start, fprime=lambda x: second(*x), full_output=1)
        if ok == 1 and max(abs(x)) <= width and all(max(abs(x - y)) > 1e-9 for y in found):
            found.append(x)
    return found


@pytest.mark.parametrize("kappa", KAPPA)
def test_engine_and_checker_enclose_where_it_is_below_a_half(kappa):
    terms = polynomial(KAPPA.index(kappa), kappa)
    width, exact = contraction(terms)
    assert abs(exact - kappa) < 0.01
    try:
        radius, (positive, negative) = certified(terms, 2, 0)
    except NoEquilibriumError:
        radius = None
    fault = enclosure_fault(told(terms), group("SO(2) x SO(2)"), "left")
    assert (radius is not None) == (fault == "") == (exact < sympy.Rational(1, 2))
    if radius is not None:
        assert radius == width
        (x,) = critical(terms, float(width))
        there = sympy.hessian(summed(terms), Y).subs(dict(zip(Y, x, strict=True)))
        signs = np.sign(np.linalg.eigvalsh(np.array(there, float)))
        assert (sum(signs > 0), sum(signs < 0)) == (positive, negative)


@pytest.mark.parametrize("seed", range(3))
def test_slopes_stay_in_their_bounds(seed):
    """Those of f and of f with positive coefficients, whose bounds are met at a corner."""
    radius = Fraction(1, 7)
    terms = polynomial(seed, 0.4)
    for own in (terms, {e: abs(c) for e, c in terms.items()}):
        f = summed(own)
        bounds = _slopes(own, 2, radius)
        for at in product((-radius, Fraction(0), radius / 3, radius), repeat=2):
            for bound, y in zip(bounds, Y, strict=True):
                slope = f.diff(y).subs(dict(zip(Y, map(sympy.Rational, map(str, at)), strict=True)))
                assert (bound - Fraction(str(slope))).sign == 0
