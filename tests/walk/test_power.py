"""The rate of the energy is said where something acts, or the time itself does."""

import pytest

from derive.language.show import show
from tests.support.corpus import record
from tests.support.walks import OTHERS

TIMED = {"forces SO(3) forces", "forces SL(3) forces"}
STILL = ("lagrange_top", "rod", "two_tops", "kirchhoff")


def power(name):
    """The step that says the power, if there is one."""
    return next((s for s in record(name).steps if s.label.endswith(".power")), None)


@pytest.mark.parametrize("name", ["ready se3", "ready ellipsoid", "ready jelly", *sorted(TIMED)])
def test_what_acts_changes_the_energy(name):
    step = power(name)
    equation = next(e for e in step.equations if e.lhs == "ḣ")
    assert step.driven
    assert ("∂ₜŨ" in step.names) == (name in TIMED), show(equation.rhs)


def test_nothing_is_said_where_nothing_acts():
    assert {*STILL} <= {*OTHERS}
    assert not any(power(f"ready {x}") for x in STILL)
