"""Conditions on the parameters: the classical ones are found, a grid of numbers has no others."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
import sympy

from derive import first_integrals
from derive.check.checker import Checker
from derive.language.tree import neg
from derive.record.as_json import from_json, to_json
from derive.search.integrals.degree_search import TooLargeError
from tests.support.lagrangians import heavy, lagrangian, squares
from tests.support.walks import SEED, repeated


def real(names):
    return sympy.symbols(names, real=True)


def conditions(moments, potential, parameters, degree):
    return first_integrals(heavy(moments, potential, parameters), degree, conditions=True)


def told(found):
    return [{str(k): str(v) for k, v in x.values.items()} for x in found.conditions]


EQUATORIAL = (("I", "I", "I3"), "m*A_31", "I I3 m")


def test_kovalevskaya():
    """Weight in the plane of two equal moments: no weight, a third equal one, or half of them."""
    found = conditions(*EQUATORIAL, 4)
    assert told(found) == [{"m": "0"}, {"I": "I3"}, {"I": "2*I3"}]
    assert all(x.integrable for x in found.conditions)
    *_, last = found.conditions
    (fourth,) = (x.sympy() for x in last.integrals)
    assert sympy.Poly(fourth, *found.x).total_degree() == 4
    rate = sum(sympy.diff(fourth, x) * v for x, v in zip(found.x, found.rates, strict=True))
    moment, third = real("I I3")
    assert sympy.simplify(rate) != 0
    assert sympy.simplify(rate.subs(moment, 2 * third)) == 0
    assert told(conditions(*EQUATORIAL, 3)) == [{"m": "0"}, {"I": "I3"}]


def test_the_heavy_top():
    """Degrees 1 and 2: Lagrange's about each axis, a ball's, and Euler's, with all letters free."""
    found = conditions(("I1", "I2", "I3"), "a*A_31 + b*A_32 + c*A_33", "I1 I2 I3 a b c", 2)
    assert sorted(told(found), key=str) == [
        {"I1": "I2", "a": "0", "b": "0"},
        {"I1": "I3", "I2": "I3"},
        {"I1": "I3", "a": "0", "c": "0"},
        {"I2": "I3", "b": "0", "c": "0"},
        {"a": "0", "b": "0", "c": "0"},
    ]


def test_clebsch():
    """U = ½⟨Γ, KΓ⟩: the condition is one of first order in each moment."""
    found = conditions(("I1", "I2", "I3"), "a*A_31^2 + b*A_32^2 + c*A_33^2", "I1 I2 I3 a b c", 2)
    I1, I2, I3, a, b, c = real("I1 I2 I3 a b c")
    published = I1 * (b - c) + I2 * (c - a) + I3 * (a - b)
    values = [x.values for x in found.conditions]
    one = next(v for v in values if set(v) == {I1})
    assert sympy.simplify(published.subs(one)) == 0
    assert all(sympy.simplify(published.subs(v)) == 0 for v in values)


def monomials(weights, degree):
    """The exponents of a weighted degree."""
    if not weights:
        return [()] if degree == 0 else []
    first, *rest = weights
    steps = range(degree // first + 1)
    return [(k, *e) for k in steps for e in monomials(rest, degree - k * first)]


def product(f, g):
    found = {}
    for (e, x), (m, y) in itertools.product(f.items(), g.items()):
        target = tuple(np.add(e, m))
        found[target] = found.get(target, 0) + x * y
    return found


def unit(*places):
    return tuple(places.count(i) for i in range(6))


def columns(polynomials):
    """A matrix with a column for each polynomial."""
    rows = {e: k for k, e in enumerate(sorted({e for f in polynomials for e in f}))}
    matrix = np.zeros((len(rows) + 1, len(polynomials)))
    for j, f in enumerate(polynomials):
        for e, x in f.items():
            matrix[rows[e], j] = x
    return matrix


def more(moments, centre, degree):
    """Are there integrals of a weighted degree, Γ counting 2, beside products of H and Casimirs?
    Euler–Poisson by hand, ranks in floats."""
    pi, gamma = ([{unit(k + i): 1.0} for i in range(3)] for k in (0, 3))
    push = [{unit(): x} for x in centre]
    turn = [product(pi[i], {unit(): 1 / x}) for i, x in enumerate(moments)]

    def cross(a, b):
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            minus = {e: -x for e, x in product(a[k], b[j]).items()}
            yield [product(a[j], b[k]), minus]

    rates = [[*x, *y] for x, y in zip(cross(pi, turn), cross(gamma, push), strict=True)]
    rates += [*cross(gamma, turn)]
    images = []
    for e in monomials((1, 1, 1, 2, 2, 2), degree):
        image = {}
        for i in (i for i in range(6) if e[i]):
            lower = {tuple(np.subtract(e, unit(i))): e[i]}
            for term in rates[i]:
                for m, x in product(lower, term).items():
                    image[m] = image.get(m, 0) + x
        images.append(image)
    kernel = len(images) - np.linalg.matrix_rank(columns(images), tol=1e-9)
    energy = {unit(i, i): 0.5 / x for i, x in enumerate(moments)}
    energy |= {unit(3 + i): x for i, x in enumerate(centre)}
    along = {unit(i, 3 + i): 1.0 for i in range(3)}
    square = {unit(3 + i, 3 + i): 1.0 for i in range(3)}
    known = []
    for e in monomials((2, 3, 4), degree):
        f = {unit(): 1.0}
        for g, k in zip((energy, along, square), e, strict=True):
            for _ in range(k):
                f = product(f, g)
        known.append(f)
    return kernel > (np.linalg.matrix_rank(columns(known), tol=1e-9) if known else 0)


FAMILIES = {
    "equatorial": (("I", "I", "I3"), {"m": 1}, 4),
    "a plane": (("I", "I", "I3"), {"a": 1, "c": 3}, 4),
    "along an axis": (("I1", "I2", "I3"), {"m": 1}, 4),
}
"""The moments, the parameters of the centre of mass with their axes, the degree."""
GRID = {"I": (1, 2, 3), "I1": (1, 2), "I2": (1, 2, 3), "I3": (1, 2), "m": (0, 1), "a": (0, 1)}


@pytest.mark.parametrize("name", repeated(FAMILIES))
def test_a_grid_has_no_others(name):
    """At each point of a grid: there is more, by brute force, exactly where a condition holds."""
    moments, axes, degree = FAMILIES[name]
    potential = " + ".join(f"{x}*A_3{i}" for x, i in axes.items())
    names = [*dict.fromkeys(moments), *axes]
    found = conditions(moments, potential, " ".join(names), degree)
    assert not found.found.conditions.unsolved
    for values in itertools.product(*(GRID.get(x, (0, 2)) for x in names)):
        at = dict(zip(names, values, strict=True))
        numbers = {real(x): y for x, y in at.items()}
        holds = any(
            all(numbers[x] == y.subs(numbers) for x, y in c.values.items())
            for c in found.conditions
        )
        centre = [sum(at[x] for x, k in axes.items() if k == i) for i in (1, 2, 3)]
        own = [at[x] for x in moments]
        assert holds == any(more(own, centre, v) for v in range(1, degree + 1)), at


def verdict(step, found):
    """The checker's reason to refuse a step; "" for one that holds."""
    return Checker(found.record.problem, SEED).check(step).reason


def test_every_step_is_checked():
    found = conditions(*EQUATORIAL, 4)
    new = [s for s in found.record.steps if ".condition_" in s.label]
    assert [verdict(s, found) for s in new] == [""] * 3
    assert from_json(to_json(found.record)).steps == found.record.steps


CHANGES = {
    "another condition": lambda t: (t[0], ("add", ("par", "I"), ("par", "I3")), *t[2:]),
    "a sign": neg,
    "nothing": lambda t: 0,
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_false_condition_is_refused(change):
    found = conditions(*EQUATORIAL, 4)
    step = found.record["condition_3"]
    (side,) = step.equations
    false = replace(side, rhs=CHANGES[change](side.rhs))
    assert verdict(replace(step, equations=(false,)), found)


def test_what_vanishes_for_no_real_parameters_is_none():
    """k² + q² vanishes where both do; k² − 2q² where no rational numbers do, and is told."""
    (point,) = told(conditions("123", "(k^2 + q^2)*A_31", "k q", 2))
    assert point == {"k": "0", "q": "0"}
    found = conditions("123", "(k^2 - 2*q^2)*A_31", "k q", 2)
    assert not found.conditions
    assert "It is not decided whether there are where (1) k² − 2q² = 0" in " ".join(
        str(found).split()
    )
    none = conditions("123", "A_31 + k*A_32", "k", 2)
    assert "for special values" in str(none)


REFUSED = {
    "conditions on 0 parameters": (heavy("123", "A_31", ""), 2),
    "a linear system of": (heavy("123", "a*A_31 + b*A_32 + c*A_33", "a b c"), 8),
    "products of terms": (heavy(("I", "I", "I3"), "m*A_31", "I I3 m"), 4),
    "conditions on 10 parameters": (
        lagrangian(
            squares(*(f"k{a}" for a in range(10))), "SO(5)", " ".join(f"k{a}" for a in range(10))
        ),
        2,
    ),
}


@pytest.mark.parametrize("words", repeated(REFUSED, 2))
def test_what_is_too_large(words, monkeypatch):
    monkeypatch.setattr("derive.search.integrals.special_parameters.WORK", 500)
    problem, degree = REFUSED[words]
    with pytest.raises(TooLargeError, match=words) as error:
        first_integrals(problem, degree, conditions=True)
    assert "\n" not in str(error.value)
