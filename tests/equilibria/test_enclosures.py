"""What an enclosure rests on, by SymPy: the contraction number κ < ½ on all of the cube of half-
width 2a, one critical point in it, slopes in their bounds; equilibria enclosed near decimals,
beside SciPy's."""

from dataclasses import replace
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
import sympy
from scipy.optimize import fsolve

from derive import ProblemError, derive, searches
from derive.algebra.families import group
from derive.check.checker import Checker
from derive.check.claims.enclosure import enclosure_fault
from derive.language.intervals import Interval, characteristic
from derive.language.tree import add, mul, replaced
from derive.record.as_json import from_json, to_json
from derive.record.record import Equation, Step
from derive.search.equilibria import enclosed_points
from derive.search.equilibria.enclosed_points import _slopes, certified
from derive.search.equilibria.equilibrium_points import NoEquilibriumError
from tests.oracles.sampling import cross_matrix
from tests.support.coadjoint_orbits import match, orbit_signature
from tests.support.lagrangians import LINE, bent, heavy, lagrangian, squares
from tests.support.walks import SEED, repeated

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
        radius, (positive, negative), y = certified(terms, 2, 0)
    except NoEquilibriumError:
        radius = None
    fault = enclosure_fault(told(terms), group("SO(2) x SO(2)"), "left")
    assert (radius is not None) == (fault == "") == (exact < sympy.Rational(1, 2))
    if radius is not None:
        assert radius == width
        (x,) = critical(terms, float(width))
        assert np.allclose([*map(float, y)], x, rtol=0, atol=1e-9)
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


MOMENTS = np.array([1.0, 3.0, 2.0])
WEIGHT = np.array([1 / 2, 0, 1 / 3])
STARTS = {
    "stands": {"A_31": "0.7", "A_33": "0.5"},
    "hangs": {"A_31": "-0.7", "A_33": "-0.5"},
    "turns": {"Pi_1": "0.9", "Pi_3": 1, "A_31": "0.8", "A_33": "0.5"},
    "swings": {"Pi_1": "0.9", "Pi_2": "0.3", "A_31": "-0.7", "A_33": "-0.7"},
}
VERDICTS = {"stands": "unstable", "hangs": "stable", "turns": "unstable", "swings": "stable"}


def critical_by_hand(y, level):
    """dH + λ dC = 0 on the level, by hand: the eight equations that are solved."""
    pi, gamma, a, b = y[:3], y[3:6], y[6], y[7]
    above = [pi @ gamma - level, gamma @ gamma - 1]
    return [*(pi / MOMENTS + a * gamma), *(WEIGHT + a * pi + 2 * b * gamma), *above]


def nothing_moves(x):
    """Are the rates of Euler and Poisson 0, and is Γ a unit vector, to rounding?"""
    pi, gamma = x[:3], x[3:]
    rates = np.cross(pi, pi / MOMENTS) + np.cross(gamma, WEIGHT), np.cross(gamma, pi / MOMENTS)
    return np.allclose(rates, 0, atol=1e-15) and abs(gamma @ gamma - 1) < 1e-15


def slopes(x):
    """The linearised Euler–Poisson equations."""
    pi, gamma = x[:3], x[3:]
    turn = np.diag(1 / MOMENTS)
    top = [cross_matrix(pi) @ turn - cross_matrix(pi / MOMENTS), -cross_matrix(WEIGHT)]
    return np.block([top, [cross_matrix(gamma) @ turn, -cross_matrix(pi / MOMENTS)]])


@pytest.mark.parametrize("name", repeated(STARTS, 2))
def test_an_equilibrium_beside_scipy(name):
    found = bent().equilibrium_near(STARTS[name])
    x = np.array([*found.at.values()])
    start = np.array([float(STARTS[name].get(k, 0)) for k in found.at])
    level = start[:3] @ start[3:]
    multipliers = [float(y) for y in found.found.multipliers]
    true = fsolve(critical_by_hand, [*x, *multipliers], args=(level,), xtol=1e-12)
    assert np.allclose(critical_by_hand(true, level), 0, atol=1e-12)
    decimals = np.array([*map(float, found.found.about.at)])
    assert max(abs(true[:6] - decimals)) <= found.radius < 1e-5
    assert nothing_moves(x)
    assert match(np.linalg.eigvals(slopes(true[:6])), found.eigenvalues, 1e-4)
    assert orbit_signature(true[:6], MOMENTS, WEIGHT) == found.signature
    assert found.verdict == VERDICTS[name]


def test_all_imaginary_proves_nothing():
    top = derive(heavy("132", "A_33/2", ""))
    near = {"A_31": "0.866", "A_33": "0.5", "Pi_1": "0.866", "Pi_3": 1}
    found = top.equilibrium_near(near)
    assert (found.verdict, found.signature) == ("open", (2, 2))
    assert max(x.real for x in found.eigenvalues) < 1e-5
    exact = top.equilibria({"A_31": "sqrt(3)/2", "A_33": "1/2", "Pi_1": "sqrt(3)/2", "Pi_3": 1})[0]
    assert exact.signature == found.signature


CHANGES = {
    "a term": lambda e: replace(e, rhs=add(e.rhs, ("at", "Π", 1))),
    "another level": lambda e: replace(e, lhs=add(e.lhs, -1), rhs=add(e.rhs, -1)),
    "what is not kept": lambda e: replace(
        e, lhs=add(e.lhs, ("at", "Π", 1)), rhs=add(e.rhs, ("at", "Π", 1))
    ),
}


def test_the_checker_encloses_once_more():
    record = bent().equilibrium_near(STARTS["turns"]).record
    assert from_json(to_json(record)).steps == record.steps
    checker = Checker(record.problem, SEED)
    rates, step = (record[x] for x in ("equilibrium_1", "enclosure_1"))
    assert [checker.check(s).reason for s in (rates, step)] == ["", ""]
    first, *others = step.equations
    for change in CHANGES.values():
        false = replace(step, equations=(change(first), *others))
        assert checker.check(false).reason
    for equations in (others, step.equations[:-1], (*others, first)):
        assert checker.check(replace(step, equations=(*equations,))).reason


def forged(monkeypatch, problem, near, value=None, changed=None):
    """The steps of a record whose entries of g were never compared with those of an element: with
    another ``value`` of what they keep, or its Casimirs ``changed``; each with its verdict."""
    monkeypatch.setattr(enclosed_points, "near_the_group", lambda *_: True)
    if value is not None:

        def other(system, f, else_):
            return else_ if any(any(e[: system.momenta]) for e in f) else Fraction(value)

        monkeypatch.setattr(enclosed_points, "group_value", other)
    if changed:
        found = searches.integrals

        def integrals(*args, **options):
            whole, record = found(*args, **options)
            return replace(whole, casimirs=(*changed(whole.casimirs),)), record

        monkeypatch.setattr(searches, "integrals", integrals)
    record = problem.equilibrium_near(near).record
    checker = Checker(record.problem, SEED)
    return [checker.check(record[x]).reason for x in ("equilibrium_1", "enclosure_1")]


LEVELS = {
    "another value": ("13/144", None),
    "nearly the same": ("1000001/1000000", None),
    "hidden in a sum": ("13/144", lambda c: (c[0] + c[1], c[0] - c[1])),
    "hidden in a square": ("13/144", lambda c: (c[0], c[0] ** 2 + c[1])),
}


@pytest.mark.parametrize("name", LEVELS)
def test_a_level_that_no_element_has(name, monkeypatch):
    """|Γ|² is 1 on SO(3): whatever a record fixes, its level has to say that."""
    value, changed = LEVELS[name]
    reasons = forged(monkeypatch, bent(), STARTS["hangs"], value, changed)
    assert reasons[0] == ""
    assert "element" in reasons[1]


BOWL = squares(1, 2, 3, 5) + " - "
PLACES = {
    "a row that is 0": (lagrangian(BOWL + "(A_11^2 + A_12^2)", "GL(2)"), {"A_11": "0.001"}),
    "a column that is 0": (
        lagrangian(BOWL + "(A_11^2 + A_21^2)", "GL(2)", side="right"),
        {"A_11": "0.001"},
    ),
    "what is positive": (lagrangian("zeta_1^2 + zeta_2^2 - (A_11 + 2)^2", LINE), {"A_11": "-2"}),
}


@pytest.mark.parametrize("name", PLACES)
def test_entries_that_no_element_has(name, monkeypatch):
    problem, near = PLACES[name]
    with pytest.raises(ProblemError, match="has the entries of g near there is not proved"):
        derive(problem).equilibrium_near(near)
    reasons = forged(monkeypatch, derive(problem), near)
    assert reasons[0] == ""
    assert "element" in reasons[1]


HELD = {
    "SO(3), its last row": ("SO(3)", "A_31 - A_33/2", {"A_31": -1}),
    "SO(3), a column": ("SO(3)", "A_13 - A_33/2", {"A_13": -1}),
    "SL(2), a row": ("SL(2)", "(A_11 - 1)^2 + (A_12 - 2)^2", {"A_11": 1, "A_12": 2}),
    "a line": (LINE, "(A_11 - 3)^2 + A_12^2", {"A_11": 3}),
}


@pytest.mark.parametrize("name", HELD)
def test_entries_of_elements_pass(name):
    g, U, near = HELD[name]
    side = "right" if "column" in name else "left"
    kinetic = squares(1, 2) if g is LINE else squares(1, 2, 3)
    problem = lagrangian(f"{kinetic} - ({U})", g, side=side)
    record = derive(problem).equilibrium_near(near).record
    checker = Checker(record.problem, SEED)
    assert checker.check(record["enclosure_1"]).reason == ""


def test_a_variable_that_stays_free():
    """Of the level and the energy without a variable, there is no single critical point."""
    record = bent().equilibrium_near(STARTS["hangs"]).record
    step = record["enclosure_1"]
    flat = [
        replace(e, lhs=replaced(e.lhs, ("at", "Π", 2), 0), rhs=replaced(e.rhs, ("at", "Π", 2), 0))
        for e in step.equations
    ]
    fault = enclosure_fault(replace(step, equations=(*flat,)), group("SO(3)"), "left")
    assert "Π₂ is free" in fault


@pytest.mark.parametrize("power", [9, 0])
def test_a_polynomial_of_too_many_terms_is_none(power):
    record = bent().equilibrium_near(STARTS["hangs"]).record
    step = record["enclosure_1"]
    first, *others = step.equations
    false = replace(first, rhs=("pow", first.rhs, power))
    with pytest.raises(ValueError, match="in a polynomial"):
        enclosure_fault(replace(step, equations=(false, *others)), group("SO(3)"), "left")


def test_a_characteristic_polynomial_is_enclosed():
    rng = np.random.default_rng(2)
    a = rng.integers(-5, 6, size=(4, 4))
    near = [[Interval.about(Fraction(int(x)), Fraction(1, 100)) for x in row] for row in a]
    found = characteristic(near)
    assert [float(x) for x in characteristic(a.tolist())] == pytest.approx(np.poly(a))
    for _ in range(20):
        moved = np.poly(a + rng.uniform(-1, 1, size=(4, 4)) / 100)
        assert all((y - Fraction(x)).sign == 0 for x, y in zip(moved, found, strict=True))


def test_a_family_of_equilibria_is_not_enclosed():
    near = {"A_31": "0.866", "A_33": "0.5", "Pi_1": "0.866", "Pi_3": 1}
    with pytest.raises(ProblemError, match="the only one on its level"):
        derive(heavy("112", "A_33/2", "")).equilibrium_near(near)


def test_numbers_are_needed():
    with pytest.raises(ProblemError, match="has no default"):
        derive(heavy("123", "m*A_31", "m")).equilibrium_near({"A_31": 1})
