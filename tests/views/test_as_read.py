"""Records as they are read: entries of g by the blocks of a product, as problem files type them;
common factors of parameters before their sum."""

import re
from fractions import Fraction
from random import Random

import pytest

from derive.language.show import show
from derive.language.values import value
from derive.pipeline import walk
from derive.problem.fields import state_names
from derive.problem.toml import problem_of
from derive.views.as_read import Reading, as_read, factored
from derive.views.rendering import render

DOUBLE = {
    "name": "two_blocks",
    "group": "SO(2) x SE(2)",
    "parameters": {"l": 1.0, "m": 1.0, "n": 1.0},
    "lagrangian": {
        "L": "(m + n)*l^2*zeta_1^2/2 + zeta_2^2 + zeta_3^2 + zeta_4^2 + A2_11*A1_11 - T2_1^2/2"
    },
}
TYPED = re.compile(r"([AT])(\d)_(\d)(\d?)")


@pytest.fixture(scope="module")
def double():
    problem = problem_of(DOUBLE)
    return problem, walk(problem)


def test_each_entry_is_that_of_its_block_as_it_is_typed(double):
    problem, _ = double
    reading = Reading("SO(2) x SE(2)")
    typed = {name: t for name, t in state_names(problem.group).items() if TYPED.fullmatch(name)}
    assert len(typed) == 4 + 4 + 2
    for name, t in typed.items():
        letter, block, *at = TYPED.fullmatch(name).groups()
        places = (int(at[0]), int(at[1]) if letter == "A" else 3)
        assert reading.tree(t) == ("entry", ("at", "A", int(block)), *places), name


@pytest.mark.parametrize("form", ["text", "markdown", "latex", "html"])
def test_every_view_has_them_so(double, form):
    _, record = double
    shown = render(record, form)
    assert {"text": "(A₂)₁₁", "html": "A"}.get(form, "(A_{2})_{11}") in shown
    assert not re.search(r"\bA₃₃|\bA_\{33\}", shown)
    assert ("its blocks are" in shown) is (form != "markdown")  # which lists no names


def test_the_json_and_other_groups_stay(double):
    _, record = double
    assert '["entry", "A", 3, 3]' in re.sub(r"\s+", " ", render(record, "json"))
    assert Reading("SO(3)").tree(("entry", "A", 3, 3)) == ("entry", "A", 3, 3)
    assert Reading("SO(3)").text("A₃₃ = 1") == "A₃₃ = 1"
    assert Reading("SO(2) x SO(2)").text("A₃₃ = −A₄₄, J₃₃") == "(A₂)₁₁ = −(A₂)₂₂, J₃₃"


def test_what_is_factored_has_the_same_value_and_fewer_factors(double):
    _, record = double
    draw = Random(3)
    values = {x: Fraction(draw.randint(1, 99), 7) for x in "lmn"}
    sums = {x for s in record.steps for e in s.equations for x in _sums(e.rhs) if factored(x) != x}
    assert "l²(m + n)" in {show(factored(x)) for x in sums}
    for x in sums:
        assert value(x, {}, values) == value(factored(x), {}, values)
    for text in (("add", ("par", "m"), ("par", "n")), ("add", 1, ("par", "m"))):
        assert factored(text) == text
    read = as_read(record)
    assert [s.label for s in read.steps] == [s.label for s in record.steps]


def _sums(t):
    if isinstance(t, tuple):
        if t[0] == "add":
            yield t
        for x in t[1:]:
            yield from _sums(x)
