"""Inputs in time, from a table whose rows are held."""

import tomllib

import numpy as np
import pytest

from derive import MotionError, derive
from derive.command.cli import main
from derive.problem.toml import problem_of
from tests.problems import thrown
from tests.support.needs import needs

NAMES = ("F_1", "F_2", "F_3")
SWITCHES = (0.0, 0.4, 0.75)
FACTORS = (1.0, 2.0, -1.0)
"""Of the push of the thrown body, from each of the switches on."""


def expected(t):
    """The state in closed form, with what the changes of the push add to the place and velocity."""
    x, pushed = thrown.state(t), np.array(thrown.PUSH) / thrown.MASS
    A = x[:9].reshape(3, 3)
    for k in (1, 2):
        past = max(t - SWITCHES[k], 0.0)
        more = pushed * (FACTORS[k] - FACTORS[k - 1])
        x[9:12] += more * past**2 / 2
        x[15:18] += A.T @ more * past
    return x


def columns(factors=FACTORS):
    return {"t": SWITCHES, **{x: np.outer(factors, thrown.PUSH)[:, k] for k, x in enumerate(NAMES)}}


@pytest.fixture(scope="module")
def body():
    d = derive(problem_of(tomllib.loads(thrown.TEXT)))
    return d, dict(zip(d.simulate(1e-3, points=1).names[1:19], thrown.state(0), strict=True))


@needs("cc")
@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize(
    ("how", "near"),
    [({}, 1e-7), ({"step": "vern9"}, 1e-7), ({"step": "rk4", "dt": 0.01}, 1e-5)],
)
def test_each_row_is_held_up_to_the_next(body, how, near, compiled):
    d, start = body
    run = d.simulate(1, start=start, points=7, inputs=columns(), compiled=compiled, **how)
    exact = np.array([expected(t) for t in run.t])
    assert np.abs(run.states - exact).max() < near
    assert run["F_3"][0] == thrown.PUSH[2]
    assert run["F_3"][-1] == -thrown.PUSH[2]


def test_from_a_file_through_the_command(tmp_path, capsys):
    """As held by --set where no row changes; others are as --set has them."""
    path, table = tmp_path / "thrown.toml", tmp_path / "push.csv"
    path.write_text(thrown.TEXT)
    table.write_text("t, F_3\n# newtons\n-1, 1.2\n0.5, 1.2\n")
    command = ["simulate", str(path), "--t", "1", "--set", "F_1=0.4", "--set", "zeta_1=2"]
    ends = []
    for more in (["--set", "F_3=1.2"], ["--input", str(table)]):
        assert main([*command, *more]) == 0
        ends.append(capsys.readouterr().out.partition("at the end: ")[2])
    assert ends[0] == ends[1] != ""


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "an empty file; its first line names t and the inputs"),
        ("F_1\n1\n", "no column 't' of times; it has F_1"),
        ("t\n0\n", "no column but the times"),
        ("t,F_1\n", "expected columns of one length, with a row at least"),
        ("t,F_1\n0,1\n0,2\n", "row 2: t = 0 does not come after 0"),
        ("t,F_1\n0,1\n1\n", "row 2: 1 numbers under 2 names"),
        ("t,F_1\n0,nan\n", "row 1, F_1: nan is no finite number"),
        ("t,F_1\n0,x\n", "row 1, F_1: 'x' is no number"),
        ("t,F_1\n0.5,1\n", "the first time is 0.5: a motion begins at t = 0"),
        ("t,F_4\n0,1\n", "no input 'F_4'; did you mean"),
        ("t,F_1,F_1\n0,1,2\n", "two columns of one name"),
    ],
)
def test_a_bad_table_is_told(tmp_path, capsys, text, words):
    path, table = tmp_path / "thrown.toml", tmp_path / "push.csv"
    path.write_text(thrown.TEXT)
    table.write_text(text)
    assert main(["simulate", str(path), "--t", "1", "--input", str(table)]) == 2
    told = capsys.readouterr().err
    assert words in told
    assert "push.csv" in told


def test_it_is_for_one_motion(body, tmp_path):
    with pytest.raises(MotionError, match="leave out ensemble"):
        body[0].simulate(1, ensemble=2, inputs=columns())
    with pytest.raises(MotionError, match="cannot be read"):
        body[0].simulate(1, inputs=tmp_path / "none.csv")
