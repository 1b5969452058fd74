"""What the commands say of a fluid on the torus, in one line."""

import numpy as np
import pytest

from derive import derive
from derive.command.cli import main
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


def refused(capsys, *words):
    """The one line of a command that is refused."""
    assert main([str(x) for x in words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


@pytest.mark.parametrize("command", ["symmetries", "integrals", "equilibria", "reduction"])
def test_what_is_not_searched_is_named(command, fluid, capsys):
    line = refused(capsys, command, fluid)
    assert {"symmetries,", "integrals,", "equilibria", "reductions"} <= {*line.split()}
    assert line.endswith("step fluid.conserved")


def test_a_conjugate_is_named(fluid, capsys):
    line = refused(capsys, "simulate", fluid, "--t", 1, "--set", "im_m2_0=1")
    assert "the conjugate of ω̂(𝐧): give im_2_0" in line
    assert "did you mean 're_" in refused(capsys, "simulate", fluid, "--t", 1, "--set", "re_x_0=1")


def test_lanes_name_the_problem(fluid, tmp_path, capsys):
    out = ("--out", tmp_path / "out")
    line = refused(capsys, "emit", fluid, "--lang", "c", "--ensemble", *out)
    assert line.startswith("derive: fluid: --ensemble")


def test_another_surface_is_told_that_there_is_none(tmp_path, capsys):
    path = tmp_path / "sphere.toml"
    path.write_text(FILE.replace("OF", "sphere"), encoding="utf-8")
    assert "of: with N it is \"torus\", not 'sphere'" in refused(capsys, "walk", path)


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
