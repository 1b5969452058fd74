"""What the commands say of a fluid on the torus, in one line."""

import numpy as np
import pytest

from derive import derive
from derive.command.simulating import summary
from derive.problem.problem import ProblemError

FILE = """
name = "fluid"
[algebra]
of = "OF"
N = 9
[inertia]
operator = "laplacian"
"""


@pytest.fixture
def fluid(tmp_path):
    path = tmp_path / "fluid.toml"
    path.write_text(FILE.replace("OF", "torus"), encoding="utf-8")
    return path


def test_text_is_told_from_a_name():
    with pytest.raises(ProblemError, match="not its text"):
        derive(FILE)


def test_the_end_of_a_large_state_is_its_largest_numbers(fluid):
    start = {"re_1_0": 1.0, "im_0_1": -2.0, "re_3_2": 3.0}
    run = derive(fluid).simulate(1e-3, points=1, start=start)
    *told, rest = summary(run)[-1].removeprefix("  at the end: ").split(", ")
    assert rest == "… (the largest of 80)"
    assert len(told) == 8
    found = {name: float(x) for name, x in (one.split(" = ") for one in told)}
    assert {*start} <= {*found}
    at_end = np.sort(np.abs(run.states[-1]))[-8:]
    assert np.allclose(np.sort(np.abs([*found.values()])), at_end, rtol=1e-5)


def test_a_sum_over_the_lattice_is_bad_input(fluid):
    with pytest.raises(ProblemError, match="place of the lattice"):
        derive(fluid)["energy"].sympy()
