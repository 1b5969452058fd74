"""The five steps in their files: each opens with its formula, and what computes it comes first."""

import ast
from pathlib import Path

import pytest

from derive.record.record import stated
from tests.support.walks import record

ROOM = Path(__file__).parents[2] / "derive" / "walk"
STEPS = ("lagrangian", "pullback", "cartan", "exterior", "kernel")
GENERAL = [
    e for name in ("linear", "affine") for step in record(name).steps for e in step.equations
]


def parsed(name):
    return ast.parse((ROOM / f"{name}.py").read_text(encoding="utf-8"))


@pytest.mark.parametrize(("number", "name"), [*enumerate(STEPS, 1)])
def test_a_step_opens_with_its_formula(number, name):
    """One that the walk derives, for every group."""
    head = ast.get_docstring(parsed(name))
    said, shown, *_ = head.split("\n\n")
    assert said.startswith(f"Step {number}.")
    assert {(e.lhs, e.rhs) for e in stated(shown)} <= {(e.lhs, e.rhs) for e in GENERAL}
