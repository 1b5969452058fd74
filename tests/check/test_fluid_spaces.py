"""Fields on balls and tori: means and potentials beside SymPy, modes that tell all claims apart."""

import itertools
import random
from fractions import Fraction

import pytest
import sympy

from derive.check.fluid.exact_functions import Function, divergence, dot
from derive.check.fluid.fluid_spaces import Ball, FlatTorus, on_boundary

COORDINATES = sympy.symbols("x y z")
VOLUME = Fraction(7, 3)


def drawing():
    draw = random.Random(8)
    return lambda: Fraction(draw.randint(-9, 9), draw.randint(1, 5))


def expression(f):
    """A polynomial as SymPy's."""
    places = COORDINATES[: f.space.dimension]
    terms = f.terms.items()
    return sum(
        sympy.Rational(c) * sympy.prod(x**n for x, n in zip(places, m, strict=False))
        for m, c in terms
    )


def integral(f):
    """Over the unit ball, in polar coordinates."""
    r, a, b = sympy.symbols("r a b", positive=True)
    if f.space.dimension == 2:
        place, measure = (r * sympy.cos(a), r * sympy.sin(a)), r
        ranges = [(r, 0, 1), (a, 0, 2 * sympy.pi)]
    else:
        ring = r * sympy.sin(b)
        place = ring * sympy.cos(a), ring * sympy.sin(a), r * sympy.cos(b)
        measure, ranges = r**2 * sympy.sin(b), [(r, 0, 1), (a, 0, 2 * sympy.pi), (b, 0, sympy.pi)]
    there = expression(f).subs(dict(zip(COORDINATES, place, strict=False)), simultaneous=True)
    return sympy.integrate(sympy.expand(there * measure), *ranges)


@pytest.mark.parametrize("dimension", [2, 3])
def test_means_are_integrals(dimension):
    space = Ball(dimension, VOLUME)
    f = space.function(drawing(), 4)
    ball = {2: sympy.pi, 3: 4 * sympy.pi / 3}[dimension]
    (found,) = f.mean().terms.values()
    assert sympy.simplify(integral(f) / ball * sympy.Rational(VOLUME) - sympy.Rational(found)) == 0


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_potential_takes_divergence_and_flux_away(dimension):
    """Of any polynomial field; and a field of the algebra has neither."""
    space = Ball(dimension)
    draw = drawing()
    field = tuple(space.function(draw, 5) for _ in range(dimension))
    q = space.potential(field)
    rest = tuple(f - q.d(j) for j, f in enumerate(field))
    for u in (rest, space.solenoidal(draw)):
        assert any(expression(f) != 0 for f in u)
        assert sympy.expand(expression(divergence(u))) == 0
        assert on_boundary(space.outwards(u)) == 0
    normal = sympy.expand(expression(space.outwards(rest)))
    *others, last = COORDINATES[:dimension]
    assert sympy.rem(normal, last**2 - 1 + sum(x**2 for x in others), last) == 0


def test_a_rotation_is_one():
    """Composition with g₀ keeps ‖x‖ and means."""
    for space in (Ball(2), Ball(3)):
        f = space.function(drawing(), 4)
        assert space.pulled_back(space.square, space) == space.square
        assert space.pulled_back(f, space).mean() == f.mean()
        assert space.pulled_back(f, space) != f


@pytest.mark.parametrize("count", [3, 4, 5])
def test_fields_have_modes_of_any_frequencies(count):
    """n fields those of n that are any, n + 1 fields those of any with the sum 0."""
    space = FlatTorus(tuple((Fraction(j), Fraction(j * j)) for j in range(1, count + 1)))
    modes = {*space.modes}
    free = [tuple(int(i == j) for i in range(count)) for j in range(count)]
    for n in range(1, count + 1):
        assert {*free[:n]} <= modes
        closing = tuple(-sum(x) for x in zip(*free[:n], strict=True))
        assert closing in modes
    densities = {*space.levels}
    assert densities <= modes
    assert {*free[:2]} <= densities


def test_three_fields_differ_in_three_directions():
    """Tr (∇u)³ of a field on T³ is not 0, and its mean is; in a ball neither is."""
    draw = drawing()
    k = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    for space in (FlatTorus(k), Ball(3)):
        u = space.solenoidal(draw)
        jacobian = [[f.d(j) for j in range(3)] for f in u]
        trace = Function(space, {})
        for i, j, n in itertools.product(range(3), repeat=3):
            trace = trace + jacobian[i][j] * jacobian[j][n] * jacobian[n][i]
        assert trace != 0
        assert (trace.mean() == 0) is not space.bounded
        assert dot(u, u).mean() != 0


def test_a_volume_is_any():
    for space in (FlatTorus(((1, 2), (3, 5)), VOLUME), Ball(3, VOLUME)):
        one = Function(space, {(0,) * space.length: Fraction(1)})
        assert [*one.mean().terms.values()] == [VOLUME]
        assert space.of_points().volume == VOLUME
