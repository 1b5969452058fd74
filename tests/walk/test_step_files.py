"""The five steps in their files: each opens with its formula, and what computes it comes first."""

import re
from pathlib import Path

import pytest

from derive.record.record import stated
from tests.support.walks import record

SPINE = Path(__file__).parents[2] / "derive" / "walk" / "spine"
HEADINGS = {
    found[1]: found[0]
    for path in SPINE.glob("*.py")
    for found in re.finditer(r"# Step (\d)\. (?:# .*\n|#\n|.*\n)*?(?=\n)", path.read_text("utf-8"))
}
GENERAL = [
    e for name in ("linear", "affine") for step in record(name).steps for e in step.equations
]


@pytest.mark.parametrize("number", range(1, 6))
def test_a_step_opens_with_its_formula(number):
    """One that the walk derives, for every group."""
    lines = [x.removeprefix("#").strip() for x in HEADINGS[str(number)].splitlines()]
    shown = "\n".join(lines).split("\n\n")[1]
    formulas = {(e.lhs, e.rhs) for e in stated(shown)}
    assert formulas
    assert formulas <= {(e.lhs, e.rhs) for e in GENERAL}
