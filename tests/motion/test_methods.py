"""The steps that a run may take, in C and in Python: the same motion, events and faults."""

import numpy as np
import pytest

import derive
from derive.command.cli import main
from derive.motion import native
from derive.motion.first_numbers import MotionError
from derive.motion.native import CompileError
from derive.motion.run import read
from tests.problems.moving import BODY, WEIGHT
from tests.support.needs import need, needs

METHODS = [
    {"step": "gauss"},
    {"step": "gauss", "dt": 0.01},
    {"step": "vern9", "tol": 1e-11},
    {"step": "vern9", "dt": 0.01},
    {"step": "rk4", "dt": 0.003},
]
FALL = f"""
name = "stone"
group = "SE(3)"
{BODY}{WEIGHT}[initial]
zeta_2 = 3
w_1 = 1
T_3 = 3
[[event]]
name = "ground"
when = "T_3"
terminal = true
[[event]]
name = "quarter"
when = "A_11"
"""


def in_both(d, duration, **chosen):
    need("cc")
    found = [d.simulate(duration, compiled=x, **chosen) for x in (True, False)]
    assert [x.facts["language"] for x in found] == ["C", "Python"]
    return found


@pytest.mark.parametrize("method", METHODS, ids=str)
@pytest.mark.parametrize(("name", "start"), [("so3", {}), ("se3", {"zeta_1": 1.0, "w_1": 1.0})])
def test_c_and_python_agree(name, start, method):
    in_c, in_python = in_both(derive.derive(name), 1.0, start=start, points=7, **method)
    assert in_c.columns == in_python.columns
    assert np.array_equal(in_c.t, in_python.t)
    assert np.abs(in_c.table - in_python.table).max() < 1e-12
    told = [{**x.facts, "language": "", "evaluations": 0} for x in (in_c, in_python)]
    assert told[0] == told[1]


@pytest.mark.parametrize("name", ["vern9", "rk4"])
def test_explicit_steps_ask_equally_often(name):
    in_c, in_python = in_both(derive.derive("so3"), 0.5, step=name, dt=0.01, points=1)
    stages = {"vern9": 16, "rk4": 4}[name]
    assert in_c.facts["evaluations"] == in_python.facts["evaluations"] == 50 * stages


@pytest.mark.parametrize("method", METHODS, ids=str)
def test_events_are_those_of_both(tmp_path, method):
    (tmp_path / "stone.toml").write_text(FALL)
    found = in_both(derive.derive(tmp_path / "stone.toml"), 2.0, points=5, **method)
    lands, exact = np.sqrt(6 / 9.81), 1e-12 if method["step"] != "rk4" else 1e-9
    for run in found:
        assert run.ended == "event ground"
        assert [x.name for x in run.events] == ["quarter", "ground"]
        assert run.events[-1].t == pytest.approx(lands, rel=0, abs=exact)
        assert np.array_equal(run.states[-1], run.events[-1].state)
    assert found[0].events[0].t == pytest.approx(found[1].events[0].t, rel=0, abs=1e-12)


@needs("cc")
@pytest.mark.parametrize("step", ["gauss", "vern9", "rk4"])
def test_steps_of_one_size_cost_no_more_of_them(tmp_path, step):
    """And the events are those of the motion in closed form."""
    text = FALL.partition("[[event]]")[0]
    (tmp_path / "plain.toml").write_text(text)
    (tmp_path / "stone.toml").write_text(f'{text}[[event]]\nname = "quarter"\nwhen = "A_11"\n')
    plain, run = (
        derive.derive(tmp_path / name).simulate(10.0, step=step, dt=1e-3, points=2)
        for name in ("plain.toml", "stone.toml")
    )
    quarters = (np.pi / 2 + np.pi * np.arange(10)) / 3
    assert [x.t for x in run.events] == pytest.approx(quarters[quarters < 10], rel=0, abs=1e-9)
    assert run.facts["evaluations"] < 1.05 * plain.facts["evaluations"]


@pytest.mark.parametrize("method", [{"step": "gauss"}, {"step": "vern9"}], ids=str)
def test_a_collision_is_told_by_both(method):
    fall = {"T_1": 0.0, "w_2": 0.0, "zeta_3": 0.0}
    found = in_both(derive.derive("comet"), 1.0, start=fall, points=1000, **method)
    for run in found:
        assert "the steps become too short at t = 0.06471" in run.ended
        assert 0.0638 < run.t[-1] < 0.0648
    assert np.array_equal(found[0].t, found[1].t)


@needs("cc")
def test_what_is_long_is_compiled():
    d = derive.derive("so3")
    assert d.simulate(1.0, points=2).facts["language"] == "Python"
    assert d.simulate(1.0, points=2, step="rk4", dt=1e-4).facts["language"] == "C"
    fast = {"zeta_3": 1000.0, "c_1": 0.0, "c_3": 0.0}  # where A changes, and ζ hardly
    assert d.simulate(2.0, points=2, start=fast).facts["language"] == "C"


def test_without_a_compiler_it_is_the_python(monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler")
    d = derive.derive("hammer")  # that no other test compiles
    run = d.simulate(0.2, points=2, step="rk4", dt=1e-4)
    assert run.facts["language"] == "Python"
    with pytest.raises(CompileError, match="not on the path"):
        d.simulate(0.2, points=2, compiled=True)


@needs("cc")
def test_calls_of_c_end_so_that_ctrl_c_is_heard(monkeypatch):
    """A motion in many calls is that in one."""
    d = derive.derive("so3")
    for method in METHODS:
        monkeypatch.undo()
        whole = d.simulate(1.0, points=1, compiled=True, **method)
        monkeypatch.setattr(native, "MANY", 3)
        assert np.array_equal(d.simulate(1.0, points=1, compiled=True, **method).table, whole.table)


def test_the_discrete_step_is_one_of_them():
    in_c, in_python = in_both(derive.derive("so3"), 0.5, step="discrete", dt=0.005, points=5)
    assert np.abs(in_c.table - in_python.table).max() < 1e-12


def test_a_step_that_there_is_not_makes_no_run(tmp_path, capsys):
    out = tmp_path / "run.npz"
    given = ["--t", "5", "--set", "zeta_3=100", "--step", "discrete", "--dt", "0.02"]
    assert main(["simulate", "so3", *given, "--out", str(out)]) == 2
    text, err = capsys.readouterr()
    assert (text, err.count("\n")) == ("", 1)
    assert "so3: there is no discrete step of this size at t = 0: take a smaller one" in err
    assert "h|ζ|" in err
    assert not out.exists()


def test_a_motion_that_stops_before_what_is_kept_has_its_last_state():
    fall = {"T_1": 0.0, "w_2": 0.0, "zeta_3": 0.0}
    run = derive.derive("comet").simulate(1.0, start=fall, points=1)
    assert "the steps become too short" in run.ended
    assert run.t[0] == 0
    assert 0.06 < run.t[1] < 0.0648
    assert len(run.t) == 2


def test_the_discrete_step_of_an_order_is_told(tmp_path, capsys):
    out = tmp_path / "run.csv"
    given = ["simulate", "so3", "--t", "1", "--set", "zeta_1=1", "--dt", "0.1", "--step"]
    assert main([*given, "discrete", "--order", "4", "--out", str(out)]) == 0
    assert ", by discrete of order 4, dt 0.1, in " in capsys.readouterr().out
    assert read(out).facts["method"] == "discrete of order 4, dt 0.1"
    with pytest.raises(MotionError, match="the order must be one of 2, 4, 6, 8, not 3"):
        derive.derive("so3").simulate(1.0, step="discrete", dt=0.1, order=3)


SLIDER = """
name = "slider"
group = "SE(3)"
[body]
given = { m = 1, c = [0, 0, 0], J = [[1, 0, 0], [0, 2, 0], [0, 0, 3]] }
[[potential]]
kind = "spring"
at = [0, 0, 0]
anchor = [0, 0, 0]
stiffness = 1
[[force]]
at = [0, 0, 0]
force = ["-3/10*abs(v_1)*v_1", 0, 0]
"""
DRAG = 0.3


def squared_speed(x, since, side):
    """v² at x in a half swing: y' = -2x - 2 side c y from a place and its y, in closed form."""
    a = 2 * side * DRAG
    free = [-2 * q / a + 2 / a**2 for q in (x, since[0])]
    return free[0] + (since[1] - free[1]) * np.exp(-a * (x - since[0]))


@needs("the module scipy")
def test_the_default_step_sees_where_a_drag_bends(tmp_path):
    """A drag -c|v|v, seven times through rest: v² at the end by the amplitudes in closed form. The
    estimate of gauss does not see that its second derivative jumps."""
    from scipy import optimize

    (tmp_path / "slider.toml").write_text(SLIDER, encoding="utf-8")
    d = derive.derive(tmp_path / "slider.toml")
    run = d.simulate(20.0, start={"w_1": 1.0}, points=1, compiled=False)
    assert run.facts["method"] == "vern9, tol 1e-09"
    x, v = run["T_1"][-1], run["w_1"][-1]
    since, side, swings = (0.0, 1.0), 1, 0
    while not (side * v > 0 and swings >= 6):
        at = optimize.brentq(squared_speed, 1e-3 * side, 2.0 * side, args=(since, side), xtol=1e-15)
        since, side, swings = (at, 0.0), -side, swings + 1
    assert abs(squared_speed(x, since, side) - v * v) < 3e-9
    by_gauss = d.simulate(20.0, start={"w_1": 1.0}, points=1, compiled=False, step="gauss")
    off = squared_speed(by_gauss["T_1"][-1], since, side) - by_gauss["w_1"][-1] ** 2
    assert abs(off) > 3e-9
    assert derive.derive("so3").simulate(0.1, points=1).facts["method"] == "gauss, tol 1e-09"
