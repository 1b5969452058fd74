"""Inputs in time: tables whose rows are held or joined, expressions, functions of the state."""

import re
import tomllib

import numpy as np
import pytest

from derive import MotionError, derive
from derive.command.cli import main
from derive.problem.problem import ProblemError
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
    table.write_text("t [s], F_3\n# newtons\n-1, 1.2\n0.5, 1.2\n")
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
        ("t,F_1,F_1 [N]\n0,1,2\n", "two columns of one name"),
        ("t [ms],F_1\n0,1\n", "t is in s, not in 'ms': convert the column"),
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
    with pytest.raises(MotionError, match=r"none\.csv: No such file"):
        body[0].simulate(1, inputs=tmp_path / "none.csv")


# Inputs that change all the time: a mass at the tip of a body that does not turn, pushed along z.

OMEGA = 3.0
BALL = """
name = "ball"
group = "SE(3)"
parameters = { w = 3.0 }
[body]
given = { m = "w - 1", centre = [0, 0, 0], I = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }
[[input]]
name = "F"
kind = "force"
at = [0, 0, 0]
"""
RAMP = """
[[signal]]
input = "F_3"
times = [0, 0.5, "w/4"]
values = [0, 2, "w - 3"]
hold = false
"""
SINE = """
[[signal]]
input = "F_1"
u = "sin(w*t)"
"""
STEPS = [({}, 1e-9), ({"step": "vern9"}, 1e-9), ({"step": "rk4", "dt": 0.01}, 1e-7)]


def ball(more=""):
    return derive(problem_of(tomllib.loads(BALL + more)))


def height(t):
    """Of the ball under the force 4t up to ½, then 2 − 8(t − ½) up to ¾, by its integral twice."""
    a, b = np.clip(t - 0.5, 0, None), np.clip(t - 0.75, 0, None)
    return (4 * t**3 - 12 * a**3 + 8 * b**3) / 6 / 2


@needs("cc")
@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize(("how", "near"), STEPS)
def test_signals_of_the_file(how, near, compiled):
    """Lines are met at their kinks, so that even the steps of a fixed size lose no order there."""
    run = ball(RAMP + SINE).simulate(1, points=8, compiled=compiled, **how)
    across = (run.t / OMEGA - np.sin(OMEGA * run.t) / OMEGA**2) / 2
    assert np.abs(run["T_3"] - height(run.t)).max() < near
    assert np.abs(run["T_1"] - across).max() < near
    assert np.allclose(run["F_1"], np.sin(OMEGA * run.t), atol=1e-15)
    assert np.allclose(run["F_3"], np.interp(run.t, [0, 0.5, 0.75], [0, 2, 0]), atol=1e-15)
    assert not run["F_2"].any()


@needs("cc")
@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize(("how", "near"), STEPS)
def test_a_function_of_time_and_state(how, near, compiled):
    """A spring by feedback: T_3 = cos(ωt)."""
    drive = lambda t, x: {"F_3": -2 * OMEGA**2 * x[11]}  # noqa: E731
    start = {"T_3": 1.0}
    run = ball(RAMP).simulate(1, start=start, points=8, inputs=drive, compiled=compiled, **how)
    assert np.abs(run["T_3"] - np.cos(OMEGA * run.t)).max() < near * 10
    assert np.allclose(run["F_3"], -2 * OMEGA**2 * run["T_3"])
    listed = ball().simulate(
        1, start=start, points=8, inputs=lambda t, x: [0, 0, drive(t, x)["F_3"]], **how
    )
    assert np.abs(listed.states - run.states).max() < 1e-12


@needs("cc")
@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize(
    ("inputs", "words"),
    [
        (lambda t, x: [1], "expected 3 numbers, or some by name; there is F_1, F_2, F_3"),
        (lambda t, x: {"F": 1}, "no input 'F'; there is F_1"),
        (lambda t, x: {"F_1": np.inf if t > 0.5 else 0}, "no finite number at t = 0.5"),
    ],
)
def test_what_a_function_gives_is_looked_at(inputs, words, compiled):
    with pytest.raises(MotionError, match=words):
        ball().simulate(1, inputs=inputs, compiled=compiled)


def test_a_function_of_what_has_no_inputs():
    with pytest.raises(MotionError, match="the problem has no"):
        derive("top").simulate(1, inputs=lambda t, x: {})


@needs("cc")
@pytest.mark.parametrize("compiled", [True, False])
def test_what_a_function_raises_is_raised(compiled):
    with pytest.raises(ZeroDivisionError):
        ball().simulate(1, inputs=lambda t, x: [0, 0, 1 / (t < 0.5)], compiled=compiled)


def test_what_is_given_wins(tmp_path, capsys):
    """A table over a signal, and so a number that is set; lines by --linear."""
    d = ball(RAMP)
    held = d.simulate(1, points=4, start={"F_3": 2.0})
    assert np.abs(held["T_3"] - held.t**2 / 2).max() < 1e-9
    path, table = tmp_path / "ball.toml", tmp_path / "push.csv"
    table.write_text("t,F_3\n0,0\n2,4\n")
    command = ["simulate", str(path), "--t", "1", "--points", "1"]
    path.write_text(BALL + '[[signal]]\ninput = "F_3"\nu = "5*w*t"\n')
    for more, end in (["--linear"], 1 / 6), ([], 0):
        assert main([*command, "--input", str(table), *more, "--out", f"{tmp_path}/r.npz"]) == 0
        assert abs(np.load(tmp_path / "r.npz")["table"][-1][12] - end) < 1e-9
    capsys.readouterr()
    page = ["--t", "1", "--html", str(tmp_path / "ball.html")]
    for more in ["--set", "F_3=2"], []:
        assert main([*command[:2], *page, *more]) == 0
        assert not capsys.readouterr().err
        told = "inputs in time, until they are changed here: F_3"
        assert (told in (tmp_path / "ball.html").read_text()) == (not more)


def test_a_run_that_goes_on_has_its_signals_again(tmp_path, capsys):
    path, run = tmp_path / "ball.toml", tmp_path / "run.npz"
    path.write_text(BALL + RAMP)
    ball(RAMP).simulate(0.5, points=1).save(run)
    assert main(["simulate", str(path), "--t", "1", "--state", str(run)]) == 0
    told = capsys.readouterr()
    assert "its signals depend on t, which begins again at 0" in told.err
    speed, at = 0.5 / 2, height(np.array([0.5, 1.0]))
    assert f"T_3 = {at[0] + speed + at[1]:.6g}" in told.out


def test_a_name_may_have_its_unit(tmp_path, capsys):
    """As the columns of runs have it; of a number whose unit is not known it is not looked at."""
    path, table = tmp_path / "ball.toml", tmp_path / "push.csv"
    command = ["simulate", str(path), "--t", "1", "--input", str(table)]
    for parameters, unit in (UNITED, "N"), (UNITED, "kg m/s^2"), ("w = 3.0", "kN"):
        path.write_text(BALL.replace("w = 3.0", parameters))
        ends = []
        for head in ("t,F_3", f"t [s], F_3 [{unit}]"):
            table.write_text(f"{head}\n0,1.2\n0.5,-3\n")
            assert main(command) == 0
            ends.append(capsys.readouterr().out)
        assert ends[0] == ends[1] != ""
    path.write_text(BALL.replace("w = 3.0", UNITED))
    assert main(command) == 2
    assert "F_3 is in N, not in 'kN': convert the column" in capsys.readouterr().err


UNITED = 'w = { default = 3.0, unit = "kg" }'


def test_a_number_beside_a_column_is_refused(tmp_path, capsys):
    """Of the run that goes on it is none that anyone set: the column wins."""
    path, table, run = (tmp_path / x for x in ("ball.toml", "push.csv", "run.npz"))
    path.write_text(BALL)
    table.write_text("t,F_3\n0,1.2\n0.5,-3\n")
    command = ["simulate", str(path), "--t", "1", "--input", str(table)]
    assert main([*command, "--set", "F_3=2"]) == 2
    told = capsys.readouterr()
    assert "F_3 has a column, and is set to a number too" in told.err
    assert told.err.count("\n") == 1
    with pytest.raises(MotionError, match="F_3 has a column"):
        ball().simulate(1, start={"F_3": 2.0}, inputs={"t": [0], "F_3": [1]})
    assert main([*command, "--out", str(run)]) == 0
    assert main([*command, "--set", "F_1=2", "--state", str(run)]) == 0


@pytest.mark.parametrize(
    ("times", "words"),
    [
        ("[0, 2, 1]", "signal 1, times: number 3, 1, does not come after 2"),
        ("[0, 2, 2]", "signal 1, times: number 3, 2, does not come after 2"),
        ('[0, 1, "w/3"]', "signal 1, times: number 3, 1, does not come after 1"),
        ("[0.5, 1, 2]", "signal 1, times: the first is 0.5: a motion begins at t = 0"),
    ],
)
def test_times_of_a_signal_increase(times, words):
    """Refused where the file is read; of a parameter without a default nothing is known there."""
    with pytest.raises(ProblemError, match=re.escape(words)):
        ball(RAMP.replace('[0, 0.5, "w/4"]', times))
    text = BALL.replace("{ w = 3.0 }", "{ w = 3.0, p = {} }")
    problem_of(tomllib.loads(text + RAMP.replace('[0, 0.5, "w/4"]', '[0, "p", 1]')))


def test_in_an_ensemble_they_are_held():
    """What is told is the number at the start, by the default of what is varied."""
    cosine = SINE.replace("sin(w*t)", "2*w*cos(w*t)")
    for signal, held in (RAMP.replace("[0, 2,", "[1.5, 2,"), "F_3=1.5"), (cosine, "F_1=6"):
        with pytest.raises(MotionError, match=f"is for one motion: hold it, as start {held}$"):
            ball(signal).simulate(1, ensemble=2, vary={"w": (1, 2)})
