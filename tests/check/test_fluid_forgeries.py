"""Fields on balls and tori beside SymPy, integrals along closed curves beside quadrature;
statements about a fluid that have no meaning are refused, and it is said why."""

import cmath
import random
from dataclasses import replace
from fractions import Fraction

import pytest
import sympy
from scipy.integrate import quad

from derive.check.fluid.curves import curve
from derive.check.fluid.exact_functions import Function, divergence
from derive.check.fluid.fluid_checker import FluidChecker
from derive.check.fluid.fluid_spaces import Ball, FlatTorus, curl, on_boundary
from derive.language.read import read
from derive.record.record import Equation
from tests.support.walks import FLUIDS, SEED, record

D = record("ideal_fluid")
STRATIFIED = record("stratified_fluid")
STEP = D["ideal_fluid.pressure"]
WITHOUT = {
    "no name": (("add", "u", "foo"), "u", "no value for 'foo'"),
    "no function": (("call", "foo", "u"), "u", "no function 'foo'"),
    "no operation": ("j(u) = u", "has no meaning for fields"),
    "two kinds in a sum": ("u + p = u", "a sum of things of two kinds"),
    "two fields": ("uu = u", "these are not multiplied"),
    "a function as a factor": ("pu = u", "a function is no factor"),
    "one argument": ("dϖ(δy) = 0", "dϖ has 2 arguments, not 1"),
    "a form of a field": ("dϖ(u, δy) = 0", "a form is of a variation"),
    "X where nothing is given": ("ϖ(X) = 0", "nothing is given of X"),
    "the gradient of a field": ("grad u = u", "a function in space is expected"),
    "the divergence of a function": ("div p = p", "a field is expected"),
    "the divergence over the points": ("div ν = 0", "a field in space is expected"),
    "the integral of a field": ("∫ u dm = 0", "over the points"),
    "the variation of u": ("δ(u) = u", "δ is of η′, G and ρ"),
    "the rate of a field": ("d/dt(u) = u", "d/dt is of a scalar product"),
    "the density at the boundary": ("⟨grad ρ, n⟩ = 0", "a field is expected"),
    "the rate of a product": ("d/dt(⟨u, η⟩) = 0", "the rates of u and ϑ, of Γu and χ_s"),
    "Γ₀ in space": ("Γ₀ u = u", "Γ₀ is of what is over the points"),
    "Γ over the points": ("Γν = u", "Γ of what is in space"),
    "∂_s in space": ("∂_s u = u", "∂_s is of what is along the curve"),
    "κ without a level": ("κu = u", "which must be given"),
    "the tangent in space": ("⟨u, χ_s⟩ = 0", "a function over the points and one in space"),
    "the curve in space": ("Γu = u", "one side is over the points"),
    "a metric": ("d/dt(⟨u, ϑ⟩_D) = 0", "the metric is the density"),
    "along a function": ("∇_p u = u", "a field is expected"),
    "along ν": ("∇_ν u = u", "∇ is along a field in space"),
    "a field transposed": ("ū = u", "the transpose is of an operator"),
    "the same": ("u = u", "it claims nothing"),
    "another field": ("u = η", "the sides differ"),
    "a field and a function": ("u = p", "two kinds"),
    "over the points and in space": ("ν = u", "one side is over the points"),
}


def equation(text, *for_all):
    """The one that a text says."""
    return Equation(*map(read, text.split(" = ")), for_all)


def test_densities_are_not_multiplied():
    """ρ − 1 is small where it is tried, and its cube less than can be seen."""
    cube = Equation(("mul", NOTHING, NOTHING, NOTHING), 0)
    forged = replace(DENSE["inhomogeneous_fluid.pressure"], equations=(cube,))
    found = FluidChecker(DENSE.problem, SEED).check(forged)
    assert not found.holds
    assert "more densities" in found.reason


TWICE = ("add", "u̇", ("mul", 2, ("mul", ("nabla", "u"), "u")), ("mul", -1, "f"))
FORGED = {
    "carried backwards": ("advection", "ρ̇ − ⟨u, grad ρ⟩ = 0"),
    "carried at twice the speed": ("advection", "ρ̇ + 2 ⟨u, grad ρ⟩ = 0"),
    "at rest": ("advection", "ρ̇ = 0"),
    "carried along another field": ("advection", "ρ̇ + ⟨η, grad ρ⟩ = 0"),
    "no product rule": ("advection", "∇_u ρ = ρ ∇_u"),
    "a density of the places": ("advection", "Gρ = G"),
    "an energy without its half": ("energy_kept", "h̃ = ‖u‖²_ρ + Ũ"),
    "an energy without the potential": ("energy_kept", "h̃ = ½ ‖u‖²_ρ"),
    "an energy without the density": ("energy_kept", "h̃ = ½ ‖u‖² + Ũ"),
    "a fall upwards": ("energy_kept", "dŨ(ν) = ⟨f, u⟩_ρ"),
    "a density without its half": ("energy_kept", "⟨ρ̇u, u⟩ = ⟨u, ∇_u u⟩_ρ"),
    "a density of the other sign": ("energy_kept", "½ ⟨ρ̇u, u⟩ = −⟨u, ∇_u u⟩_ρ"),
    "a rate without ∇_u u": ("energy_kept", "d/dt(h̃) = ⟨u, u̇ − f⟩_ρ", "u̇"),
    "a rate without the force": ("energy_kept", "d/dt(h̃) = ⟨u, u̇ + ∇_u u⟩_ρ", "u̇"),
    "a rate with the force backwards": ("energy_kept", "d/dt(h̃) = ⟨u, u̇ + ∇_u u + f⟩_ρ", "u̇"),
    "a rate without the density": ("energy_kept", "d/dt(h̃) = ⟨u, u̇ + ∇_u u − f⟩", "u̇"),
    "the motion alone": ("energy_kept", "d/dt(⟨u, u⟩_ρ) = 0"),
    "a pressure that works": ("energy_kept", "⟨grad p, u⟩_ρ = 0"),
}
"""Of a stratified fluid: the step, a false equation, what it is said to hold for."""


def refused(label, false):
    """The reason to refuse an equation of a step of a stratified fluid."""
    step = replace(STRATIFIED[label], equations=(false,))
    found = FluidChecker(STRATIFIED.problem, SEED).check(step)
    assert not found.holds
    return found.reason


@pytest.mark.parametrize("case", FORGED)
def test_a_false_advection_or_energy_is_refused(case):
    label, *false = FORGED[case]
    assert "the sides differ" in refused(label, equation(*false))


def test_a_rate_with_twice_what_moves_the_fluid():
    twice = Equation(("call", "d/dt", "h̃"), ("metric", "ρ", "u", TWICE), ("u̇",))
    assert "the sides differ" in refused("energy_kept", twice)


NEEDY = {"skew", "energy_kept"}
RESTING = {"chain", "advection", *NEEDY}


@pytest.mark.parametrize("name", FLUIDS)
def test_what_advection_and_energy_rest_on(name, monkeypatch):
    """Any field carries the density along; the energy is kept by one that has no divergence and is
    tangent to the boundary."""
    d = record(name)

    def broken(space, field):
        with monkeypatch.context() as patched:
            patched.setattr(space, "solenoidal", field)
            checker = FluidChecker(d.problem, SEED)
            tried = (s for s in d.steps if s.label.partition(".")[2] in RESTING)
            return {s.label.partition(".")[2] for s in tried if not checker.check(s).holds}

    def through(self, draw):
        return curl(*(self.function(draw, 3) for _ in range(1 if self.dimension == 2 else 3)))

    assert broken(FlatTorus, lambda self, draw: self.any_field(draw)) == NEEDY
    assert broken(Ball, through) == NEEDY


def verdict(step):
    return FluidChecker(D.problem, SEED).check(step)


@pytest.mark.parametrize("case", WITHOUT)
def test_what_has_no_meaning_is_refused(case):
    *sides, why = WITHOUT[case]
    false = Equation(*sides) if len(sides) == 2 else equation(*sides)
    found = verdict(replace(STEP, equations=(false,)))
    assert not found.holds
    assert why in found.reason


EQUATION = STEP.equations[-1]
DENSE = record("inhomogeneous_fluid")
NOTHING = ("add", "ρ", ("mul", -1, ("one",)))
STEPS = {
    "another scope": (replace(STEP, scope="SO(3)"), "about its group"),
    "with inputs": (replace(STEP, driven=True), "no force is given"),
    "given something else": (replace(STEP, given=(Equation("u", 0),)), "what is given"),
    "for all u": (replace(STEP, equations=(replace(EQUATION, for_all=("u",)),)), "for all u"),
    "for all that it is": (
        replace(STEP, equations=(replace(EQUATION, for_all=("u̇",)),)),
        "the acceleration of the motion",
    ),
    "some u": (replace(STEP, equations=(replace(EQUATION, exists=("u",)),)), "is the pressure"),
    "δ′ beside a lift": (
        replace(D["ideal_fluid.dalembert"], equations=(Equation(("call", "ϖ", "δ′y"), 0),)),
        "a form is of a variation δy, δ′y or X",
    ),
    "X twice": (
        replace(D["ideal_fluid.dalembert"], equations=(Equation(("call", "dϖ", "X", "X"), 1),)),
        "the sides differ",
    ),
    "an inverse": (
        replace(STEP, equations=(Equation(("mul", ("inv", "D"), "u"), "u"),)),
        "something else than the density",
    ),
}


@pytest.mark.parametrize("case", STEPS)
def test_steps_that_cannot_be_tried(case):
    step, why = STEPS[case]
    found = verdict(step)
    assert not found.holds
    assert why in found.reason


K = ((0.3, -1.1), (0.7, 0.4), (-0.5, 0.9))
CORNERS = ((0.2, 0.1), (1.3, -0.4), (0.6, 1.5))
MODES = ((1, 0, 0, 0), (0, -1, 0, 0), (1, 1, -1, 0), (0, 0, 0, 0))


def uniform():
    draw = random.Random(5)
    return lambda: draw.uniform(-1, 1)


def dotted(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def number(f):
    (value,) = f.terms.values()
    return value


def test_a_polygon():
    """∮ f ds and ∮ ⟨c, dχ⟩ of exponentials, between corners that are places."""
    draw = uniform()
    space = FlatTorus(K)
    polygon = curve(space, space.of_points(), draw, level=False)
    after = [*CORNERS[1:], CORNERS[0]]
    polygon.edges = [
        [y - x for x, y in zip(a, b, strict=True)] for a, b in zip(CORNERS, after, strict=True)
    ]
    polygon.corners = [[cmath.exp(dotted(k, v)).real for k in K] for v in CORNERS]
    field = [Function(space, {m: draw() for m in MODES}) for _ in range(2)]

    def value(f, place):
        return sum(
            c * cmath.exp(dotted(space.frequency(m), place)).real for m, c in f.terms.items()
        )

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


def test_a_laurent_curve():
    """At z = e^{is}, over a whole turn; its points come from those that the turn takes there."""
    draw = uniform()
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
