"""Zeitlin's model: the sums that its steps write out, what is false of them, and the files."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from random import Random

import numpy as np
import pytest

from derive.algebra.structure import TorusLattice
from derive.algebra.words import Letter, trace, word
from derive.check.checker import Checker, check
from derive.language.show import show
from derive.language.tree import add, mul, replaced
from derive.record.record import ANY_GROUP, Equation
from derive.walk.fluid import vorticity
from derive.walk.fluid.lattice import Coefficient, Unit, paired, traced
from derive.walk.spine.alphabet import Alphabet
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


def test_larger_sums_are_not_written_out():
    assert "fluid.modes" not in {s.label for s in own(9)}


def test_the_equations_are_those_of_any_size():
    summed = [s for s in own(3) if s.label != "fluid.modes"]
    for three, seven in zip(summed, own(7), strict=True):
        assert len(three.equations) == len(seven.equations)
        assert len(show(three.equations[0].rhs)) <= len(show(seven.equations[0].rhs))


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


def test_what_is_true_in_another_form_holds():
    """The checker compares values, not trees: n ∧ m with the other sign."""

    def turned(e):
        unit, total = e.rhs[1:-1], e.rhs[-1]
        swapped = put_wedge(total)
        return Equation(e.lhs, mul(-1, *unit, swapped))

    def put_wedge(t):
        if isinstance(t, tuple) and t[0] == "wedge":
            return ("wedge", *t[:0:-1])
        return (t[0], *map(put_wedge, t[1:])) if isinstance(t, tuple) else t

    assert changed("fluid.motion", 0, turned).holds


def test_a_record_of_another_group_is_refused():
    d = record(5)
    for key, value in (("group", "SU(7)"), ("n", 7), ("torus", {"N": 7})):
        wrong = replace(d, problem={**d.problem, key: value})
        assert not all(v.holds for v in check(wrong, SEED))


def otherwise(changed, label, number, old, new):
    """The verdict on a step of the stirred fluid with another tree in an equation."""
    step = corpus.record("torus stirred")[f"fluid.{label}"]
    equations = list(step.equations)
    there = replaced(equations[number].rhs, old, new)
    assert changed == (there != equations[number].rhs)
    equations[number] = replace(equations[number], rhs=there)
    return corpus.checker("torus stirred").check(replace(step, equations=tuple(equations)))


KAPPA, NU, F_HAT = ("par", "kappa"), ("par", "nu"), ("call", "f̂", "𝐧")
WRONG = {
    "another coefficient": ("forcing", 0, KAPPA, NU),
    "another power": ("motion", 0, 2, 3),
    "the input twice": ("motion", 0, F_HAT, ("mul", 2, F_HAT)),
    "the conjugate input": ("motion", 0, F_HAT, ("call", "f̂", ("mul", -1, "𝐧"))),
    "no drag": ("motion", 0, KAPPA, 0),
    "no input": ("coadjoint", 0, "F", 0),
    "the input of another mode": ("modes", 0, ("call", "f̂", 1, 0), ("call", "f̂", 0, 1)),
    "no power of the input": ("power", 0, F_HAT, 0),
    "no hyperviscosity in the energy": ("power", 0, NU, 0),
    "twice the trace": ("power", 2, 3, 6),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_false_of_forcing_and_drag_is_refused(name):
    label, number, old, new = WRONG[name]
    assert not otherwise(True, label, number, old, new).holds
    assert otherwise(False, label, number, "nothing", new).holds


def test_a_step_without_the_input_is_another_claim():
    """That the energy is kept, said of the motion with an input."""
    step = corpus.record("torus stirred")["fluid.power"]
    kept = replace(step.equations[0], rhs=0)
    assert not corpus.checker("torus stirred").check(replace(step, equations=(kept,))).holds


def test_coefficients_follow_from_the_inertia_operator(monkeypatch):
    """With 2|n|² in its place: ω̂ and L̃ twice, P and h̃ by ω̂ half, and the motion half as fast."""
    a = Alphabet("n", affine=False)
    one = vorticity.fluid_of(TorusLattice(7), a)
    monkeypatch.setattr(vorticity, "inertia", lambda x: x.times(2, 1))
    two = vorticity.fluid_of(TorusLattice(7), a)
    assert (two.slope, two.stream) == (one.slope.times(2), one.stream.times(Fraction(1, 2)))
    assert two.lagrangian == one.lagrangian.times(2)
    assert two.energy == one.energy.times(Fraction(1, 2))
    assert (two.momentum, two.velocity) == (one.momentum, one.velocity)


def test_forms_are_sums_over_the_lattice():
    """δ, a gradient and a substitution, beside sums of numbers."""
    random, places = Random(0), TorusLattice(5).places
    square = {n: n[0] ** 2 + n[1] ** 2 for n in places}
    values = {x: {n: random.randint(1, 99) for n in places} for x in ("a", "b", "c")}

    def total(form, values):
        return sum(
            u.q * square[n] ** p * values[x][n] * values[y][-n[0], -n[1]]
            for (x, y, p), u in form.terms.items()
            for n in places
        )

    a, b, c = map(Coefficient, "abc")
    form = paired(a.times(3, 1), a) - paired(a, b)
    ahead, back = (
        total(form, values | {"a": {n: x + s * values["c"][n] for n, x in values["a"].items()}})
        for s in (1, -1)
    )
    assert total(form.varied("a", "c"), values) == (ahead - back) / 2
    put = values | {"b": {n: 5 * square[n] * x for n, x in values["c"].items()}}
    assert total(form.put("b", c.times(5, 1)), values) == total(form, put)
    slope = paired(b.times(7, -1), c).gradient("c")
    assert slope.solved_for("b") == Coefficient("b", Unit(Fraction(1, 7)), 1)
    with pytest.raises(ValueError, match="multiple"):
        paired(a, b).over(paired(a, c))


def test_the_trace_form_is_that_of_matrices():
    """Tr XY of elements of su(5), as products of the clock and of the shift, with numbers."""
    N, rng = 5, np.random.default_rng(0)
    clock, shift = np.diag(np.exp(4j * np.pi * np.arange(N) / N)), np.roll(np.eye(N), 1, axis=1)
    power = np.linalg.matrix_power
    values = {x: {n: rng.normal() for n in TorusLattice(N).places} for x in "XY"}

    def element(x):
        return sum(
            v
            * np.exp(2j * np.pi * n[0] * n[1] / N)
            * power(clock, n[0] % N)
            @ power(shift, n[1] % N)
            for n, v in values[x].items()
        )

    X, Y = (Letter(x, "n", "n") for x in "XY")
    form = traced(trace(word(X, Y)), {X: Coefficient("X"), Y: Coefficient("Y")}, N)
    ((x, y, p), u), found = form.only, np.trace(element("X") @ element("Y"))
    expected = float(u.q) * sum(
        values[x][n] * values[y][-n[0], -n[1]] for n in TorusLattice(N).places
    )
    assert p == 0
    assert abs(found - expected) < 1e-12 * abs(expected) + 1e-12
