"""Ctrl-C in a run, whose last row is where it stopped, behind which it tells nothing; in an
ensemble, which keeps the motions that are done."""

import os
import signal
import threading

import numpy as np
import pytest

import derive
from derive.command.cli import main
from derive.motion import ensemble as of_parts
from derive.motion.native import Motion
from derive.motion.run import read
from derive.motion.trajectory import MotionInPython, Trajectory
from derive.python.simulated import SimulatedEnsemble
from tests.problems import moving
from tests.support.needs import need, needs

TURNS = f"""{moving.SPIN}[initial]
zeta_3 = "w"
[[event]]
name = "quarter"
when = "A_11"
"""
OPTIONS = ["--vary", "zeta_1=0:1", "--vary", "J_11=normal:1:0.01"]
METHODS = [{}, {"dt": 0.01}, {"dt": 0.01, "step": "rk4"}, {"step": "vern9"}]


@pytest.fixture
def turning(tmp_path):
    path = tmp_path / "turning.toml"
    path.write_text(TURNS)
    return derive.derive(path)


def interrupted_at(monkeypatch, owner, name, call):
    """Ctrl-C in a call of a method of some number, before that does anything."""
    whole, calls = getattr(owner, name), []

    def stopped(self, *given):
        calls.append(given)
        if len(calls) == call:
            raise KeyboardInterrupt
        return whole(self, *given)

    monkeypatch.setattr(owner, name, stopped)


def told_to_its_end(run, whole):
    """Is a run the beginning of another, with all events up to its last row?"""
    last = run.t[-1]
    assert run.ended == "interrupted"
    assert run.facts["events"] == [x for x in whole.facts["events"] if x["t"] <= last]
    k = int((whole.t <= last).sum())
    assert np.array_equal(run.table[:k], whole.table[:k])
    assert len(run.t) - k in (0, 1)
    return last


@needs("cc")
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("points", [1, 40])
def test_in_c_it_is_where_the_call_has_led(turning, monkeypatch, method, points):
    """The signal is heard when a call is over, before anything of it is read."""
    chosen = {"points": points, "compiled": True, **method}
    whole, ends = turning.simulate(4.0, **chosen), []
    for call in (1, 2, 3):
        with monkeypatch.context() as patched:
            interrupted_at(patched, Motion, "settle", call)
            run = turning.simulate(4.0, **chosen)
        ends.append(told_to_its_end(run, whole))
        assert ends[-1] > 0
        w = run["zeta_3"][0]
        assert run["A_11"][-1] == pytest.approx(np.cos(w * ends[-1]), abs=1e-7)
    assert ends[0] < ends[1] < ends[2]
    assert bool(whole.events)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("points", [1, 40])
def test_in_python_it_is_where_the_last_call_has_led(turning, monkeypatch, method, points):
    chosen = {"points": points, "compiled": False, **method}
    whole = turning.simulate(4.0, **chosen)
    interrupted_at(monkeypatch, MotionInPython, "_ended", 3)
    run = turning.simulate(4.0, **chosen)
    last = told_to_its_end(run, whole)
    assert 0 < last < 4
    assert run["A_11"][-1] == pytest.approx(np.cos(run["zeta_3"][0] * last), abs=1e-7)


@needs("cc")
@pytest.mark.skipif(os.name != "posix", reason="this is no POSIX")
def test_a_signal_in_a_long_run(tmp_path, capsys, monkeypatch):
    """Between two instants: the time is told, and the file ends there."""
    path, out = tmp_path / "turning.toml", tmp_path / "run.npz"
    path.write_text(TURNS)
    reach = Trajectory.reach

    def signalled(self, times):
        threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
        return reach(self, times)

    monkeypatch.setattr(Trajectory, "reach", signalled)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    asked = ["--t", "1000", "--dt", "1e-6", "--points", "1", "--out", str(out)]
    try:
        code = main(["simulate", str(path), *asked])
    finally:
        signal.signal(signal.SIGINT, before)
    run = read(out)
    assert (code, len(run.t)) == (130, 2)
    assert 0 < run.t[1] < 1000
    assert f"spin: interrupted at t = {run.t[1]:g}\n" in capsys.readouterr().err
    assert 0 < run.events[-1].t <= run.t[1]


def test_between_two_parts_it_is_where_the_last_one_has_led(tmp_path, capsys, monkeypatch):
    interrupted_at(monkeypatch, Trajectory, "reach", 3)
    out = tmp_path / "run.npz"
    given = ["--t", "1", "--set", "zeta_1=1", "--points", "200", "--out", str(out)]
    assert main(["simulate", "so3", *given]) == 130
    assert len(read(out).t) == 3
    assert "interrupted at t = 0.01" in capsys.readouterr().err


# ---------------------------------------------------------------- ensembles


@needs("cc")
@pytest.mark.parametrize("ending", [".npz", ".csv", ".parquet"])
def test_ctrl_c_within_a_part_keeps_what_is_done_of_it(ending, tmp_path, capsys, monkeypatch):
    """A part is made by several calls of C."""
    if ending == ".parquet":
        need("the module pyarrow")
    monkeypatch.setattr(of_parts, "SECONDS", 1e-9)
    monkeypatch.setattr(of_parts, "TOGETHER", 4)
    monkeypatch.setattr(of_parts, "MOTIONS", 16)
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    made, calls = of_parts.EnsembleMotions._follow, []

    def interrupted(self, *given):
        calls.append(given)
        if len(calls) == stop:
            os.kill(os.getpid(), signal.SIGINT)
        return made(self, *given)

    monkeypatch.setattr(of_parts.EnsembleMotions, "_follow", interrupted)
    out = tmp_path / f"e{ending}"
    asked = ["simulate", "so3", "--t", "1", "--ensemble", "40", *OPTIONS, "--out", str(out)]
    stop, before = 3, signal.getsignal(signal.SIGINT)
    assert main(asked) == 130
    assert signal.getsignal(signal.SIGINT) is before
    assert "interrupted after 12 of 40 motions" in capsys.readouterr().err
    some = SimulatedEnsemble.read(out)
    stop = 0
    assert main(asked) == 0
    whole = SimulatedEnsemble.read(out)
    assert np.array_equal(some.states[:12], whole.states[:12])
    assert np.array_equal(some.varied[:12], whole.varied[:12])
    assert {*some.status[12:].tolist()} <= {-1}


@needs("cc")
def test_a_second_ctrl_c_ends_at_once(tmp_path, monkeypatch):
    """And leaves no file."""
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    made = of_parts.EnsembleMotions._follow

    def interrupted(self, *given):
        os.kill(os.getpid(), signal.SIGINT)
        os.kill(os.getpid(), signal.SIGINT)
        made(self, *given)
        raise AssertionError("it goes on")

    monkeypatch.setattr(of_parts.EnsembleMotions, "_follow", interrupted)
    asked = ["simulate", "so3", "--t", "1", "--ensemble", "40", *OPTIONS]
    assert main([*asked, "--out", str(tmp_path / "e.npz")]) == 130
    assert not [*tmp_path.iterdir()]
