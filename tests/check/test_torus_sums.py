"""Sums over the lattice of the torus, all points at once: as one point after the other."""

from dataclasses import replace
from random import Random

import pytest

from derive.algebra.torus import Torus
from derive.check.arithmetic import EvaluationError
from derive.check.equation_sides import index_bindings
from derive.check.evaluate import evaluate
from derive.check.torus.torus_model import TorusModel, environment
from derive.pipeline import walk
from derive.problem.toml import problem_of


@pytest.mark.parametrize("N", [3, 5])
def test_at_once_is_one_after_the_other(N):
    env = environment(TorusModel(Torus(N), Random(1), 2**40))
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
        ("mul", ("call", "T", "𝐦"), "W"),
        ("call", "ω̂", ("mul", "𝐦", ("call", "ζ", "𝐦"))),
        ("fun", "sin", ("call", "ζ", "𝐦")),
    ],
)
def test_other_sums_are_refused(term):
    env = environment(TorusModel(Torus(5), Random(1), 2**40))
    with pytest.raises(EvaluationError):
        evaluate(("sum", "𝐦", term), env)
