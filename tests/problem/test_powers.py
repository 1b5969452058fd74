"""Every integer power of a name and of a place, on every road, against powers of fractions."""

import json
from fractions import Fraction

import numpy as np
import pytest

from derive import SO, Points, Potential, Problem, derive
from derive.check.checker import Checker
from derive.check.values.evaluate import Environment, evaluate
from derive.language.derivatives import derivative
from derive.language.expression import ExpressionError, parse
from derive.language.limits import EXPONENT
from derive.language.values import value
from derive.record.as_json import from_json, to_json
from tests.support.library import library, module_of

EXPONENTS = [n for n in range(-EXPONENT, EXPONENT + 1) if n]
A, B, C = Fraction(3, 7), Fraction(-5, 3), Fraction(11, 2)
VALUES = {"a": A, "b": B, "c": C}
COS, SIN = Fraction(3, 5), Fraction(4, 5)
"""Of the turn in which the point (1, 0) of the emitted problem is."""
FORMS = {
    "a^{n}": lambda n: A**n,
    "a^ {n}": lambda n: A**n,
    "2*b^{n}": lambda n: 2 * B**n,
    "-b^{n}": lambda n: -(B**n),
    "c/b^{n}": lambda n: C / B**n,
    "(a + b)^{n}*c": lambda n: (A + B) ** n * C,
    "a^{n} + b^{n} - 1": lambda n: A**n + B**n - 1,
    "(2/3)^{n}": lambda n: Fraction(2, 3) ** n,
    "1/(a*c^{n})": lambda n: 1 / (A * C**n),
}


@pytest.mark.parametrize("form", FORMS)
def test_expressions(form):
    """As they are read, evaluated by the problem's reader and by the checker."""
    environment = Environment(3, {}, parameters=VALUES)
    for n in (*EXPONENTS, 0):
        tree, expected = parse(form.format(n=n)), FORMS[form](n)
        assert value(tree, {}, VALUES) == expected, n
        assert evaluate(tree, environment) == expected, n


def test_an_exponent_beyond_is_refused():
    for n in (EXPONENT + 1, -EXPONENT - 1):
        with pytest.raises(ExpressionError, match="an integer up to"):
            parse(f"a^{n}")


def test_derivatives():
    environment = Environment(3, {}, parameters=VALUES)
    for n in EXPONENTS:
        found = derivative(parse(f"a^{n}"), ("par", "a"))
        assert evaluate(found, environment) == n * A ** (n - 1), n


def summed(name="powers"):
    """U = Σ s_n a^n x + Σ z_n x^n: the switches s and z choose one power."""
    switches = [f"{'sz'[on]}{'np'[n > 0]}{abs(n)}" for on in (0, 1) for n in EXPONENTS]
    terms = [f"{switches[i]}*a^{n}*r1_x" for i, n in enumerate(EXPONENTS)]
    terms += [f"{switches[i + len(EXPONENTS)]}*r1_x^{n}" for i, n in enumerate(EXPONENTS)]
    forces = [Potential("+".join(terms[i::32])) for i in range(32)]
    values = dict.fromkeys(["a", *switches], 1)
    return Problem(name, SO(2), Points((1, [1, 0])), forces, values), switches


def expected(i):
    """Energy at rest and angular acceleration −dU/dθ for the switch i alone."""
    x, y = COS, SIN  # dx/dθ = −y
    n = EXPONENTS[i % len(EXPONENTS)]
    return (A**n * x, A**n * y) if i < len(EXPONENTS) else (x**n, n * x ** (n - 1) * y)


STATE = [float(x) for x in (COS, -SIN, SIN, COS)] + [0.0]


def close(found, wanted):
    assert abs(Fraction(found) - wanted) <= Fraction(1, 10**13) * abs(wanted)


@pytest.mark.parametrize("build", ["python", "c", "javascript"])
def test_emitted_code(build):
    """For the switches, one after the other."""
    problem, switches = summed()
    made = library(build, problem)
    energy, rhs = (next(x for x in made.calls if x.name == y) for y in ("energy", "rhs"))
    names = module_of(problem).PARAMETERS
    for i, name in enumerate(switches):
        p = np.array([float(A) if x == "a" else float(x == name) for x in names])
        status, k = made.constants(p)
        assert status == 0
        values = made.values(t=0.0, p=p, k=k, u=np.zeros(0), x=np.array(STATE))
        for call, wanted in zip((energy, rhs), expected(i), strict=True):
            close(float(made.shown(call, values, False)[0][-1]), wanted)


STEPS = ("power.potential", "power.pushes")


def verdicts(data):
    """What the checker makes of the steps of the powers in a record."""
    record = from_json(json.dumps(data))
    checker = Checker(record.problem)
    return [checker.check(record[label]).holds for label in STEPS]


def forged(tree, old, new):
    """Copies of a tree, each with one exponent changed."""
    if isinstance(tree, list):
        if tree[:1] == ["pow"] and tree[2] == old:
            yield [*tree[:2], new]
        for i, part in enumerate(tree):
            yield from ([*tree[:i], x, *tree[i + 1 :]] for x in forged(part, old, new))


@pytest.mark.parametrize("signed", [-1, 1])
def test_every_power_holds_in_a_record(signed):
    """What the walk makes of them, derivatives among it, beside the checker's dual numbers."""
    for some in (range(k, k + 16) for k in range(1, EXPONENT + 1, 16)):
        U = "+".join(f"a^{signed * n}*r1_y + b*r1_x^{signed * n}" for n in some)
        points = Points((1, [1, 0]))
        d = derive(Problem("power", SO(2), points, Potential(U), {"a": 1, "b": 1}))
        assert all(verdicts(json.loads(to_json(d.record)))), U


HIGH = ("r1_x^64*r1_x^64", "1/r1_x^64", "r1_x^-64*r1_x^-64", "(r1_x^8)^64", "1/(r1_x^4)^-64")


@pytest.mark.parametrize("U", HIGH)
def test_higher_powers_of_a_derivative_hold(U):
    d = derive(Problem("power", SO(2), Points((1, [1, 0])), Potential(U)))
    assert all(verdicts(json.loads(to_json(d.record))))


@pytest.mark.parametrize("n", [s * n for n in (1, 2, 3, 4, 5, 6, 7, 16, 33, 64) for s in (-1, 1)])
def test_another_exponent_is_refused(n):
    """With the exponent of the other sign in one place of a record, a step fails."""
    potential = Potential(f"a^{n}*r1_x + r1_x^{n}")
    d = derive(Problem("power", SO(2), Points((1, [1, 0])), potential, {"a": 1}))
    data = json.loads(to_json(d.record))
    assert all(verdicts(data))
    (potential,) = data["problem"]["potentials"]
    U, changed = potential["U"], 0
    for potential["U"] in forged(U, n, -n):
        assert not all(verdicts(data))
        changed += 1
    potential["U"] = U
    (pushes,) = (s["equations"][0] for s in data["steps"] if s["label"] == STEPS[1])
    Q = pushes["rhs"]
    for m in {abs(n), abs(n - 1), n, n - 1}:
        for pushes["rhs"] in forged(Q, m, -m):
            assert not all(verdicts(data))
            changed += 1
    assert changed >= 2 * (n != 1)
