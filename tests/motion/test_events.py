"""[[event]] of problem files: at known times, against SciPy, in files, and what is refused; the
steps that a run may take, in C and in Python: the same motion, events and faults."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.command.cli import main
from derive.motion import native
from derive.motion.first_numbers import MotionError
from derive.motion.native import CompileError
from derive.motion.run import FORMATS, read, written
from derive.problem.problem import ProblemError
from derive.problem.toml import load
from derive.programs import motion_of
from tests.problems import moving
from tests.support.needs import need, needs

SPIN = f'{moving.SPIN}[initial]\nzeta_3 = "w"\n'
QUARTERS = (
    SPIN
    + """
[[event]]
name = "quarter"
when = "A_11"
[[event]]
name = "up"
when = "A_11"
direction = "rising"
[[event]]
name = "down"
when = "A_11"
direction = "falling"
"""
)
FALL = f"""{moving.STONE}
[[event]]
name = "half"
when = "T_3 - H/2"
[[event]]
name = "never"
when = "T_3 - 2*H"
"""


def problem(tmp_path, text):
    path = tmp_path / "p.toml"
    path.write_text(text)
    return path


def times(run, name):
    return np.array([x.t for x in run.events if x.name == name])


CHOSEN = [
    ({}, 1e-12),
    ({"tol": 1e-5}, 1e-12),
    ({"dt": 0.3}, 1e-12),
    ({"dt": 0.3, "compiled": True}, 1e-12),
    ({"dt": 4.0}, 1e-8),  # made in parts, each still coarse
    ({"dt": 0.01, "step": "rk4"}, 1e-6),
    ({"points": 1}, 1e-12),
]


@pytest.mark.parametrize(("chosen", "off"), CHOSEN)
def test_a_rotation_has_its_quarters(tmp_path, chosen, off):
    """About an axis, A_11 = cos ωt."""
    run = derive.derive(problem(tmp_path, QUARTERS)).simulate(10.0, **chosen)
    every = np.pi / 4 + np.pi / 2 * np.arange(6)
    assert times(run, "quarter") == pytest.approx(every, rel=0, abs=off)
    assert times(run, "down") == pytest.approx(every[::2], rel=0, abs=off)
    assert times(run, "up") == pytest.approx(every[1::2], rel=0, abs=off)
    assert [x.t for x in run.events] == sorted(x.t for x in run.events)
    assert all(abs(x.state[0]) < 1e-14 for x in run.events)
    assert {x.direction for x in run.events if x.name == "up"} == {"rising"}


@pytest.mark.parametrize("height", [0.5, 3.0])
def test_a_stone_meets_the_ground_and_the_run_ends(tmp_path, height):
    """The state is of degree 2 in t along T: long steps and short ones, the body turning."""
    run = derive.derive(problem(tmp_path, FALL)).simulate(10.0, start={"H": height})
    lands = np.sqrt(2 * height / 9.81)
    assert times(run, "ground") == pytest.approx([lands], rel=0, abs=1e-12)
    assert times(run, "half") == pytest.approx([np.sqrt(height / 9.81)], rel=0, abs=1e-12)
    assert (run.ended, run.t[-1]) == ("event ground", run.events[-1].t)
    assert np.array_equal(run.states[-1], run.events[-1].state)
    assert np.all(np.diff(run.t) > 0)
    assert abs(run["T_3"][-1]) < 1e-12
    assert "never" not in {x.name for x in run.events}


@pytest.mark.parametrize("step", ["gauss", "vern9", "rk4", "discrete"])
@pytest.mark.parametrize("compiled", [True, False])
def test_steps_of_one_size_are_the_same_with_events(tmp_path, step, compiled):
    """Up to a last one that is shorter; and hardly more rates are asked for."""
    watched = f'{FALL}[[event]]\nname = "over"\nwhen = "A_11"\n'.replace("terminal = true", "")
    plain = watched[: watched.index("[[event]]")]
    chosen = {"step": step, "dt": 0.05, "points": 7, "compiled": compiled}
    run, other = (
        derive.derive(problem(tmp_path, text)).simulate(1.52, **chosen) for text in (watched, plain)
    )
    assert [x.name for x in run.events] == ["over", "half", "ground"]
    assert all(x.direction == "falling" for x in run.events)
    assert np.array_equal(run.t, other.t)
    assert np.abs(run.states - other.states).max() < 1e-12
    few, many = (x.facts["evaluations"] for x in (other, run))
    # the parts of an event's step, each of which gauss, in C, solves by itself
    assert many <= (1.5 if step == "gauss" else 1.05) * few + 200


@pytest.mark.parametrize("N", [3, 5, 9])
@pytest.mark.parametrize("compiled", [True, False])
def test_events_on_the_torus(tmp_path, N, compiled):
    """Written out and by loops, against DOP853 on the emitted code."""
    text = f"""
name = "flow"
[algebra]
of = "torus"
N = {N}
[inertia]
operator = "laplacian"
[initial]
re_1_0 = 1
im_0_1 = 0.7
re_1_1 = -0.4
[[event]]
name = "e"
when = "re_1_0/(2 + im_0_1)^2 - sin(im_0_1 + t/2)/2"
"""
    d = derive.derive(problem(tmp_path, text))
    run = d.simulate(30.0, tol=1e-13, points=5, compiled=compiled)
    code, start = motion_of(d.problem, d.record).python, run.states[0]
    k = code.constants([])
    i, j = code.STATE.index("re_1_0"), code.STATE.index("im_0_1")
    found = solve_ivp(
        code.rhs, (0, 30), start, method="DOP853", rtol=1e-13, atol=1e-13, args=(k,),
        events=lambda t, x, k: x[i] / (2 + x[j]) ** 2 - np.sin(x[j] + t / 2) / 2,
    )  # fmt: skip
    assert len(run.events) > 3
    assert times(run, "e") == pytest.approx(found.t_events[0], rel=0, abs=1e-9)


def test_an_event_at_the_start_is_none_and_one_at_an_instant_is_seen_once(tmp_path):
    text = SPIN + '[[event]]\nname = "e"\nwhen = "t*(t - 1)*(t - 2)"\n'
    run = derive.derive(problem(tmp_path, text)).simulate(3.0, points=3)
    assert times(run, "e") == pytest.approx([1, 2], rel=0, abs=1e-13)
    assert [x.direction for x in run.events] == ["falling", "rising"]


@pytest.mark.parametrize("ending", FORMATS)
def test_a_file_has_the_events(tmp_path, ending):
    if ending == ".parquet":
        need("the module pyarrow")
    run = derive.derive(problem(tmp_path, QUARTERS)).simulate(2.0, points=3)
    path = tmp_path / f"run{ending}"
    path.write_bytes(written(run, path.name))
    found = read(path).events
    assert [x.plain() for x in found] == [x.plain() for x in run.events]
    assert len(found) == 2


def test_the_command_tells_the_events(tmp_path, capsys):
    assert main(["simulate", str(problem(tmp_path, QUARTERS)), "--t", "10"]) == 0
    out, err = capsys.readouterr()
    assert "  event quarter: 6 times, at t = 0.785398163397, 2.35619449019, 3.926" in out
    assert ", 7.06858347058, 8.63937979737\n" in out
    assert err == ""
    assert main(["simulate", str(problem(tmp_path, QUARTERS)), "--t", "20"]) == 0
    out, err = capsys.readouterr()
    assert "  event quarter: 13 times, at t = 0.785398163397, 2.35619449019, 3.926" in out
    assert ", …, 19.6349540849 (all are in the file of --out, and run.events in Python)\n" in out
    assert main(["simulate", str(problem(tmp_path, FALL)), "--t", "10"]) == 0
    out, err = capsys.readouterr()
    assert f"  event ground: once, at t = {np.sqrt(6 / 9.81):.12g}\n" in out
    assert err == ""


def test_more_than_their_limit_are_refused(tmp_path):
    listed = "".join(f'[[event]]\nname = "e{k}"\nwhen = "t"\n' for k in range(51))
    with pytest.raises(ProblemError, match="more than 50 tables"):
        load(problem(tmp_path, SPIN + listed))


def test_an_event_in_words():
    body = derive.Moments(m=1, c=[0, 0, 0], J=[[2, 0, 0], [0, 1, 0], [0, 0, 1]])
    event = derive.Event("e", "A_11", terminal=True)
    p = derive.Problem("free", derive.SO(3), body, [event], initial={"zeta_3": 1})
    run = derive.derive(p).simulate(5.0, points=3)
    assert run.t[-1] == pytest.approx(np.pi / 2, abs=1e-12)


# ---------------------------------------------------------------- methods

METHODS = [
    {"step": "gauss"},
    {"step": "gauss", "dt": 0.01},
    {"step": "vern9", "tol": 1e-11},
    {"step": "vern9", "dt": 0.01},
    {"step": "rk4", "dt": 0.003},
]
QUARTERED = f'{moving.STONE}[[event]]\nname = "quarter"\nwhen = "A_11"\n'


def in_both(d, duration, **chosen):
    need("cc")
    found = [d.simulate(duration, compiled=x, **chosen) for x in (True, False)]
    assert [x.facts["language"] for x in found] == ["C", "Python"]
    return found


@pytest.mark.parametrize("method", [*METHODS, {"step": "discrete", "dt": 0.005}], ids=str)
@pytest.mark.parametrize(("name", "start"), [("so3", {}), ("se3", {"zeta_1": 1.0, "w_1": 1.0})])
def test_c_and_python_agree(name, start, method):
    in_c, in_python = in_both(derive.derive(name), 1.0, start=start, points=7, **method)
    assert in_c.columns == in_python.columns
    assert np.array_equal(in_c.t, in_python.t)
    assert np.abs(in_c.table - in_python.table).max() < 1e-12
    # gauss of C ends its iterations where they are exact enough
    own = {"language": "", **({"evaluations": 0} if method["step"] == "gauss" else {})}
    assert in_c.facts | own == in_python.facts | own


@pytest.mark.parametrize("method", METHODS, ids=str)
def test_events_are_those_of_both(tmp_path, method):
    found = in_both(derive.derive(problem(tmp_path, QUARTERED)), 2.0, points=5, **method)
    lands, exact = np.sqrt(6 / 9.81), 1e-12 if method["step"] != "rk4" else 1e-9
    for run in found:
        assert run.ended == "event ground"
        assert [x.name for x in run.events] == ["quarter", "ground"]
        assert run.events[-1].t == pytest.approx(lands, rel=0, abs=exact)
        assert np.array_equal(run.states[-1], run.events[-1].state)
    assert found[0].events[0].t == pytest.approx(found[1].events[0].t, rel=0, abs=1e-12)


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

    d = derive.derive(problem(tmp_path, SLIDER))
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


@needs("the module scipy")
@pytest.mark.parametrize("sign", ["tanh(v_1/eps)", "2*atan(v_1/eps)/3"])
def test_the_default_step_sees_a_steep_friction(sign, tmp_path):
    """A friction that stands for a sign of v, seven times through rest, by SciPy's integrator."""
    from scipy import integrate

    law = SLIDER.replace("-3/10*abs(v_1)*v_1", f"-{sign}/10").replace("eps", "(1/500)")
    run = derive.derive(problem(tmp_path, law)).simulate(
        20.0, start={"w_1": 1.0}, points=1, compiled=False
    )
    assert run.facts["method"] == "vern9, tol 1e-09"
    steep = np.tanh if "tanh" in sign else lambda x: 2 * np.arctan(x) / 3

    def rates(_, y):
        return [y[1], -y[0] - steep(500 * y[1]) / 10]

    by_scipy = integrate.solve_ivp(rates, (0, 20), [0, 1], "DOP853", rtol=1e-12, atol=1e-13)
    assert abs(by_scipy.y[:, -1] - [run["T_1"][-1], run["w_1"][-1]]).max() < 1e-8
