"""What is the same at all points of a Lagrangian is computed once, and is what it was."""

from fractions import Fraction
from random import Random

import pytest

from derive.algebra.families import group
from derive.check.lagrangian.lagrangian_model import LagrangianModel, with_constants_named
from derive.check.values.draws import Locus
from derive.check.values.evaluate import ElementaryValues, Environment, evaluate
from derive.language.read import read
from derive.language.tree import nodes
from derive.record.as_json import decode, encode
from derive.record.record import RecordError

MOMENT = ("add", ("pow", ("fun", "sin", ("mul", Fraction(1, 3), "π")), 2), ("par", "a"))
"""(sin π/3)² + a: of a problem, and of nothing that moves."""
Z = tuple(("entry", "ζ", i) for i in (1, 2, 3))
L = ("add", *(("mul", MOMENT, z, z) for z in Z), ("mul", "t", Z[0], ("fun", "cos", "t")))
"""The energy of a ball of that moment, and what has no part that is settled."""


def environment(**names):
    """π = 22/7, a = 5."""
    draw = Random(1)
    values = ElementaryValues(lambda: Fraction(draw.randint(1, 99)))
    known = {"π": Fraction(22, 7), **names}
    return Environment(3, known, parameters={"a": Fraction(5)}, elementary=values)


def test_equal_parts_have_one_name_and_the_value_is_the_same():
    of_the_problem = environment()
    tree, known = with_constants_named(L, of_the_problem)
    (name,) = known
    with pytest.raises(RecordError, match="a name may not be"):
        decode(name, "L")
    assert [x for x in nodes(tree) if x in (("par", "a"), "π")] == []
    column = tuple((Fraction(x),) for x in (2, 3, 7))
    at = environment(t=Fraction(11), ζ=column)
    at.elementary = of_the_problem.elementary
    short = environment(t=Fraction(11), ζ=column, **known)
    short.elementary = of_the_problem.elementary
    assert evaluate(tree, short) == evaluate(L, at)
    sine = at.elementary.values["sin", Fraction(22, 21)]
    cosine = at.elementary.values["cos", Fraction(11)]
    assert evaluate(L, at) == (sine**2 + 5) * (4 + 9 + 49) + 22 * cosine


def test_what_moves_is_not_settled():
    moving = read("t + A")
    assert with_constants_named(moving, environment()) == (moving, {})


def test_the_moments_of_a_model_are_computed_once(monkeypatch):
    """However often its Lagrangian is asked for."""
    problem = {
        "parameters": {"a": {}},
        "lagrangian": {"trivialisation": "left", "L": encode(L)},
    }
    asked = []
    value = ElementaryValues.__call__

    def noted(self, name, x):
        asked.append(name)
        return value(self, name, x)

    monkeypatch.setattr(ElementaryValues, "__call__", noted)
    model = LagrangianModel(problem, group("SO(3)"), Random(3), 99, Locus())
    assert len(model.second_derivatives) == 3
    assert asked.count("sin") == 1
    assert asked.count("cos") > 1
