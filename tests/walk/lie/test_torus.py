"""Zeitlin's model: the sums that its steps write out, what is false of them, and the files."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from derive.check.checker import Checker, check
from derive.language.show import show
from derive.language.tree import add, mul
from derive.record.record import ANY_GROUP, Equation
from tests.support import corpus
from tests.support.walks import SEED


def record(N):
    return corpus.record(f"torus {N}")


def checker(N):
    return corpus.checker(f"torus {N}")


@cache
def own(N):
    return tuple(s for s in record(N).steps if s.scope != ANY_GROUP)


def rates(N, values):
    """dω̂/dt by mode, of the step that writes the sums out, in numbers."""
    found = {}
    for e in record(N)["modes"].equations:
        n = e.lhs[2][2:]
        text = show(e.rhs)
        assert "∑" not in text
        found[n] = number(e.rhs, values)
    return found


def number(t, values):
    """A tree in numbers; ω̂ by its places."""
    if not isinstance(t, tuple):
        return {"π": np.pi}.get(t, t) if isinstance(t, str) else float(t)
    if t[:2] == ("call", "ω̂"):
        return values[t[2:]]
    if t[0] == "fun":
        return getattr(np, t[1])(number(t[2], values))
    parts = [number(x, values) for x in t[1:]]
    return {"add": sum, "mul": np.prod, "div": lambda p: p[0] / p[1]}[t[0]](parts)


@pytest.mark.parametrize("N", [3, 5])
def test_the_modes_are_the_double_sum(N):
    """Against the sum over all pairs, in complex numbers."""
    span = range(-(N // 2), N // 2 + 1)
    places = [(x, y) for x in span for y in span if (x, y) != (0, 0)]
    draw = np.random.default_rng(7)
    values = {}
    for n in places:
        if n not in values:
            values[n] = complex(*draw.normal(size=2))
            values[-n[0], -n[1]] = values[n].conjugate()
    found = rates(N, values)
    assert len(found) == (N * N - 1) // 2
    for n, rate in found.items():
        total = 0
        for m in places:
            k = tuple((x - y + N // 2) % N - N // 2 for x, y in zip(n, m, strict=True))
            if k == (0, 0):
                continue
            turn = np.sin(2 * np.pi * (m[0] * k[1] - m[1] * k[0]) / N)
            total += turn * values[m] * values[k] / (k[0] ** 2 + k[1] ** 2)
        assert abs(rate - N / (2 * np.pi) * total) < 1e-12 * (1 + abs(total))


def changed(label, number, new):
    step = record(7)[label]
    equations = list(step.equations)
    equations[number] = new(equations[number])
    return checker(7).check(replace(step, equations=tuple(equations)))


FALSE = {
    "the other orientation": ("fluid.motion", 0, ("𝐦", "𝐧"), ("𝐧", "𝐦")),
    "another N": ("fluid.motion", 0, 7, 9),
    "cos for sin": ("fluid.algebra", 0, "sin", "cos"),
    "another place": ("fluid.algebra", 0, ("add", "𝐦", "𝐧"), ("add", "𝐧", ("mul", -1, "𝐦"))),
    "the conjugate": ("fluid.lagrangian", 0, ("mul", -1, "𝐧"), "𝐧"),
    "P for W": ("fluid.coadjoint", 0, "P", "W"),
}


@pytest.mark.parametrize("name", FALSE)
def test_false_equations_are_refused(name):
    label, number, old, new = FALSE[name]

    def put(t):
        if isinstance(old, tuple) and old == ("𝐦", "𝐧"):
            if isinstance(t, tuple) and t[0] == "wedge":
                return ("wedge", *t[:0:-1])
        elif t == old:
            return new
        return (t[0], *map(put, t[1:])) if isinstance(t, tuple) else t

    verdict = changed(label, number, lambda e: Equation(e.lhs, put(e.rhs)))
    assert not verdict.holds


@pytest.mark.parametrize("true", [(1, 2, 4, 5, 8), (9, 10, 13, 18)], ids=["small", "large"])
@pytest.mark.parametrize("seed", range(2))
def test_an_equation_that_is_true_at_half_of_the_places_is_refused(seed, true):
    """Where |n|² is one of some numbers; each time, whatever is drawn."""
    step = record(7)["fluid.motion"]
    (e,) = step.equations
    else_0 = mul(*(add(("norm2", "𝐧"), -v) for v in true))
    wrong = Equation(e.lhs, add(e.rhs, mul(else_0, ("call", "ω̂", "𝐧"))))
    assert not Checker(record(7).problem, seed).check(replace(step, equations=(wrong,))).holds


def test_a_record_of_another_group_is_refused():
    d = record(5)
    for key, value in (("group", "SU(7)"), ("n", 7), ("torus", {"N": 7})):
        wrong = replace(d, problem={**d.problem, key: value})
        assert not all(v.holds for v in check(wrong, SEED))
