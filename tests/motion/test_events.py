"""[[event]] of problem files: at known times, against SciPy, in files, and what is refused."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.command.cli import main
from derive.motion.run import FORMATS, read, written
from derive.problem.problem import ProblemError
from derive.problem.toml import load
from derive.programs import motion_of
from tests.problems import moving
from tests.support.needs import need

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
FALL = f"""
name = "stone"
group = "SE(3)"
[parameters]
H = {{ default = 3.0, meaning = "height" }}
{moving.BODY}{moving.WEIGHT}[initial]
zeta_2 = 2
w_1 = 1
T_3 = "H"
[[event]]
name = "ground"
when = "T_3"
terminal = true
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
    """Up to a last one that is shorter."""
    watched = f'{FALL}[[event]]\nname = "over"\nwhen = "A_11"\n'.replace("terminal = true", "")
    plain = watched[: watched.index("[[event]]")]
    chosen = {"step": step, "dt": 0.05, "points": 7, "compiled": compiled}
    run, other = (
        derive.derive(problem(tmp_path, text)).simulate(1.52, **chosen) for text in (watched, plain)
    )
    assert [x.name for x in run.events] == ["half", "ground", "over"]
    assert all(x.direction == "falling" for x in run.events)
    assert np.array_equal(run.t, other.t)
    assert np.abs(run.states - other.states).max() < 1e-12


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
    from derive import SO, Event, Moments, Problem

    body = Moments(m=1, c=[0, 0, 0], J=[[2, 0, 0], [0, 1, 0], [0, 0, 1]])
    p = Problem("free", SO(3), body, [Event("e", "A_11", terminal=True)], initial={"zeta_3": 1})
    run = derive.derive(p).simulate(5.0, points=3)
    assert run.t[-1] == pytest.approx(np.pi / 2, abs=1e-12)
