"""Integrals along closed curves beside quadrature: no code of derive but the curves themselves."""

import cmath
import random

import pytest
from scipy.integrate import quad

from derive.check.fluid.curves import curve
from derive.check.fluid.exact_functions import Function
from derive.check.fluid.fluid_spaces import Ball, FlatTorus

K = ((0.3, -1.1), (0.7, 0.4), (-0.5, 0.9))
CORNERS = ((0.2, 0.1), (1.3, -0.4), (0.6, 1.5))
MODES = ((1, 0, 0, 0), (0, -1, 0, 0), (1, 1, -1, 0), (0, 0, 0, 0))


def drawing():
    draw = random.Random(5)
    return lambda: draw.uniform(-1, 1)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def number(f):
    (value,) = f.terms.values()
    return value


def test_a_polygon():
    """∮ f ds and ∮ ⟨c, dχ⟩ of exponentials, between corners that are places."""
    draw = drawing()
    space = FlatTorus(K)
    polygon = curve(space, space.of_points(), draw, level=False)
    after = [*CORNERS[1:], CORNERS[0]]
    polygon.edges = [
        [y - x for x, y in zip(a, b, strict=True)] for a, b in zip(CORNERS, after, strict=True)
    ]
    polygon.corners = [[cmath.exp(dot(k, v)).real for k in K] for v in CORNERS]
    field = [Function(space, {m: draw() for m in MODES}) for _ in range(2)]

    def value(f, place):
        return sum(c * cmath.exp(dot(space.frequency(m), place)).real for m, c in f.terms.items())

    def along(edge, start, s):
        return [x + s * e for x, e in zip(start, edge, strict=True)]

    whole, work = 0, 0
    for edge, start in zip(polygon.edges, CORNERS, strict=True):
        whole += quad(lambda s, e=edge, v=start: value(field[0], along(e, v, s)), 0, 1)[0]
        for j, f in enumerate(field):
            work += (
                quad(lambda s, e=edge, v=start, f=f: value(f, along(e, v, s)), 0, 1)[0] * edge[j]
            )
    composed = [polygon.of_space(f) for f in field]
    assert number(composed[0].mean()) == pytest.approx(whole, rel=1e-10)
    circulation = sum(
        (a * b for a, b in zip(composed, polygon.tangent, strict=True)), Function(polygon, {})
    ).mean()
    assert number(circulation) == pytest.approx(work, rel=1e-10)
    assert number(composed[0].d(0).mean()) == pytest.approx(0, abs=1e-12)


def test_a_level():
    """On a polygon of a level the first exponential is constant: only the others are left."""
    draw = drawing()
    for k in (K, tuple((*x, 0.3) for x in K)):
        space = FlatTorus(k)
        polygon = curve(space, space.of_points(), draw, level=True)
        assert all(abs(dot(k[0], edge)) < 1e-12 for edge in polygon.edges)
        layered = polygon.of_space(space.layered(draw))
        assert layered.is_constant
        assert not polygon.of_space(space.function(draw)).is_constant


def test_a_laurent_curve():
    """At z = e^{is}, over a whole turn; its points come from those that the turn takes there."""
    draw = drawing()
    space, points = Ball(2), Ball(2)
    laurent = curve(space, points, draw, level=False)
    laurent.pace = 1j
    f = Function(space, {(2, 1, 0): draw(), (1, 0, 0): draw(), (0, 3, 0): draw()})

    def at(g, s):
        return sum(c * cmath.exp(1j * s) ** m[0] for m, c in g.terms.items())

    def value(s):
        x, y = (at(g, s) for g in laurent.place)
        return sum(c * x ** m[0] * y ** m[1] for m, c in f.terms.items())

    for s in (0.3, 2.0):
        assert at(laurent.of_space(f), s) == pytest.approx(value(s), rel=1e-12)
        slope = (value(s + 1e-5) - value(s - 1e-5)) / 2e-5
        assert at(laurent.of_space(f).d(0), s) == pytest.approx(slope, rel=1e-7)
        carried = laurent.of_points(space.pulled_back(f, points))
        assert at(carried, s) == pytest.approx(value(s), rel=1e-12)
    found = number(laurent.of_space(f).mean())
    for part in ("real", "imag"):
        whole = quad(lambda s, part=part: getattr(value(s), part), 0, 2 * cmath.pi)[0]
        assert getattr(complex(found), part) == pytest.approx(whole / (2 * cmath.pi), abs=1e-10)
