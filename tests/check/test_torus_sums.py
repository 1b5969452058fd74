"""The lattice of the torus, all points at once, in sums and in what is said of any: as one point
after the other, and no point is left out."""

from dataclasses import replace
from random import Random

import pytest

from derive.algebra.structure import TorusLattice
from derive.check.fluid.torus_model import TorusModel, environment
from derive.check.values.arithmetic import EvaluationError
from derive.check.values.draws import difference, index_bindings
from derive.check.values.evaluate import evaluate
from derive.language.tree import mul
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.record import Equation


@pytest.mark.parametrize("N", [3, 5])
def test_at_once_is_one_after_the_other(N):
    env = environment(TorusModel(TorusLattice(N), Random(1), 2**40))
    slowly = replace(env, at_once=None)
    algebra, inertia = {"of": "torus", "N": N}, {"operator": "laplacian"}
    d = walk(problem_of({"name": "fluid", "algebra": algebra, "inertia": inertia}))
    sums = 0
    for label in (
        "lagrangian",
        "momenta",
        "stream",
        "energy",
        "motion",
        "coordinates",
        "conserved",
    ):
        for e in d[label].equations:
            if "'sum'" in repr(e.rhs):
                for here, there in zip(
                    index_bindings(e.rhs, env), index_bindings(e.rhs, slowly), strict=True
                ):
                    assert evaluate(e.rhs, here) == evaluate(e.rhs, there)
                    sums += 1
    assert sums > N**2


@pytest.mark.parametrize(
    "term",
    [
        ("mul", ("call", "T", "𝐦"), ("call", "T", "𝐦")),
        ("mul", ("call", "ω̂", "𝐦"), "W"),
        ("call", "ω̂", ("mul", "𝐦", ("call", "ζ", "𝐦"))),
        ("fun", "sin", ("call", "ζ", "𝐦")),
    ],
)
def test_other_sums_are_refused(term):
    env = environment(TorusModel(TorusLattice(5), Random(1), 2**40))
    with pytest.raises(EvaluationError):
        evaluate(("sum", "𝐦", term), env)


T = {x: ("call", "T", x) for x in ("𝐦", "𝐧")}
BACK = ("call", "T", ("mul", -1, "𝐧"))
PHASE = ("div", ("mul", 2, "π", ("wedge", "𝐦", "𝐧")), 5)
TRUE = {
    "a product": (
        mul(T["𝐦"], T["𝐧"]),
        mul(
            ("add", ("fun", "cos", PHASE), mul(-1, "i", ("fun", "sin", PHASE))),
            ("call", "T", ("add", "𝐦", "𝐧")),
        ),
    ),
    "a trace": (("tr", mul("W", BACK)), mul(5, ("call", "ω̂", "𝐧"))),
    "bars": (("T", mul("W", T["𝐧"], "P")), mul(("T", "P"), ("T", T["𝐧"]), ("T", "W"))),
    "the trace of a bar": (("tr", ("T", mul(T["𝐧"], "W"))), ("inner", T["𝐧"], ("T", "W"))),
    "multiples": (mul(("call", "ζ", "𝐧"), "W", T["𝐧"]), mul("W", T["𝐧"], ("call", "ζ", "𝐧"))),
    "a bracket": (
        ("bracket", "W", T["𝐧"]),
        ("add", mul("W", T["𝐧"]), mul(-1, T["𝐧"], "W")),
    ),
    "an inverse": (mul(("norm2", "𝐧"), ("inv", ("norm2", "𝐧"))), 1),
    "a sum inside": (
        ("sum", "𝐦", mul(("call", "ω̂", "𝐦"), T["𝐦"], T["𝐧"])),
        mul("W", T["𝐧"]),
    ),
    "coordinates": (("wedge", "𝐧", "𝐦"), mul(-1, ("wedge", "𝐦", "𝐧"))),
    "half a place": (mul(("call", "ω̂", "𝐧"), "𝐧"), mul("𝐧", ("call", "ω̂", "𝐧"))),
}


@pytest.mark.parametrize("name", TRUE)
def test_what_is_said_of_any_point(name):
    env = environment(TorusModel(TorusLattice(5), Random(1), 2**40))
    slowly = replace(env, at_once=None)
    equation = Equation(*TRUE[name])
    assert difference(equation, env) == difference(equation, slowly) == ""
    wrong = replace(equation, rhs=mul(2, equation.rhs))
    assert difference(wrong, env)
    assert difference(wrong, slowly)


def only_at_the_corners(n, half):
    """A number that is 0 at all places but (± half, ± half)."""
    span = range(half + 1)
    squares = {a * a + b * b for a in span for b in span} - {0, 2 * half * half}
    return mul(*(("add", ("norm2", n), -x) for x in sorted(squares)))


@pytest.mark.parametrize("N", [7, 11])
def test_four_of_all_places_are_enough(N):
    env = environment(TorusModel(TorusLattice(N), Random(1), 2**40))
    corner, n = only_at_the_corners("𝐧", N // 2), ("call", "ω̂", "𝐧")
    right = Equation(n, mul(("norm2", "𝐧"), ("call", "ζ", "𝐧")))
    assert difference(right, env) == ""
    assert difference(replace(right, rhs=("add", right.rhs, mul(corner, n))), env)
    other = only_at_the_corners("𝐦", N // 2)
    right = Equation(("bracket", T["𝐦"], T["𝐧"]), mul(-1, ("bracket", T["𝐧"], T["𝐦"])))
    wrong = ("add", right.rhs, mul(corner, other, ("call", "T", ("add", "𝐦", "𝐧"))))
    assert difference(right, env) == ""
    assert difference(replace(right, rhs=wrong), env)
