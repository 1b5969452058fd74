"""A run, written and read: every bit, the same bytes, and what is no run.  Ctrl-C in a run, whose
last row is where it stopped, behind which it tells nothing; in an ensemble, which keeps the
motions that are done."""

import os
import signal
import threading

import numpy as np
import pytest

from derive.command import simulating
from derive.command.cli import main
from derive.command.writing import WriteError, require_place
from derive.motion import ensemble as of_parts
from derive.motion.emitted_code import Column
from derive.motion.native import Motion
from derive.motion.run import FORMATS, Run, RunFileError, read, written
from derive.motion.trajectory import MotionInPython, Trajectory
from derive.python.simulated import SimulatedEnsemble
from tests.problems import moving
from tests.support.library import derived
from tests.support.needs import need, needs

COLUMNS = (Column("t", "time", "s"), Column("A_11", "state"), Column("energy", "energy", "J"))
TABLE = np.array([[0.0, 1.0, 1 / 3], [0.1, -0.0, 5e-324], [0.2, np.inf, np.nan]])
RUN = Run(COLUMNS, TABLE, {"problem": "so3", "parameters": {"I": 2.0}, "ended": ""})


@pytest.mark.parametrize("ending", FORMATS)
def test_a_run_is_read_back_to_the_bit(tmp_path, ending):
    if ending == ".parquet":
        need("the module pyarrow")
    path = tmp_path / f"run{ending}"
    path.write_bytes(written(RUN, path.name))
    found = read(path)
    assert found.table.tobytes() == TABLE.tobytes()
    assert (found.columns, found.facts) == (COLUMNS, RUN.facts)
    assert written(found, path.name) == path.read_bytes()


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("a.npz", b"PK"),
        ("a.npz", b""),
        ("a.csv", b""),
        ("a.csv", b"t,x\n0,1\n"),
        ("a.csv", b"# {}\nt\n0\n"),
        ("a.csv", b"\xff\xfe"),
        ("a.csv", b'# {"file": "derive run", "columns": [["t", "time", ""]], "facts": {}}\nt\nx\n'),
        ("a.csv", b'# {"file": "derive run", "columns": [], "facts": {}}\n\n'),
        ("a.parquet", b"PAR1"),
    ],
)
def test_a_foreign_file_is_told(tmp_path, name, data):
    if name.endswith("parquet"):
        need("the module pyarrow")
    path = tmp_path / name
    path.write_bytes(data)
    with pytest.raises(RunFileError, match="not a run that derive simulate wrote"):
        read(path)


@pytest.mark.parametrize("last", ["0.5", "nan"])
def test_times_that_go_back_are_told(tmp_path, last):
    path = tmp_path / "a.csv"
    head = b'# {"file": "derive run", "columns": [["t", "time", ""]], "facts": {}}\n'
    path.write_bytes(b"t\n" + head + b"0\n1\n1\n" + last.encode() + b"\n")
    with pytest.raises(RunFileError, match=rf"a\.csv: row 4: t = {last} does not come after 1"):
        read(path)


def test_a_pickle_is_not_loaded(tmp_path):
    path = tmp_path / "evil.npz"
    np.savez(path, head=np.array([{}], dtype=object), table=TABLE)
    with pytest.raises(RunFileError, match="not a run"):
        read(path)


def test_files_that_are_not_there_or_have_no_format(tmp_path):
    with pytest.raises(RunFileError, match=r"x\.npz: No such file"):
        read(tmp_path / "x.npz")
    with pytest.raises(RunFileError, match=r"must end in \.npz, \.csv, \.parquet"):
        written(RUN, "run.txt")


def test_a_csv_is_a_table_for_numpy(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(written(RUN, path.name))
    table = np.genfromtxt(path, delimiter=",", names=True)
    assert table.dtype.names == ("t_s", "A_11", "energy_J")
    assert np.array_equal(table["t_s"], TABLE[:, 0])


@pytest.mark.parametrize("place", ["file/x.npz", "file/new/x.npz", "folder.npz"])
@pytest.mark.parametrize("options", [[], ["--ensemble", "9", "--vary", "zeta_1=0:1"]])
def test_a_place_that_cannot_be_is_told_before_the_run(
    tmp_path, capsys, monkeypatch, place, options
):
    def never(*_, **__):
        raise AssertionError("it has begun")

    for name in ("derive", "run", "command_ensemble"):
        monkeypatch.setattr(simulating, name, never)
    (tmp_path / "file").write_text("a file")
    (tmp_path / "folder.npz").mkdir()
    out = tmp_path / place
    assert main(["simulate", "so3", "--t", "1", *options, "--out", str(out)]) == 2
    text, err = capsys.readouterr()
    assert (text, err.count("\n")) == ("", 1)
    assert err.startswith(f"derive: {out}: ")
    assert "choose another --out" in err
    assert sorted(x.name for x in tmp_path.rglob("*")) == ["file", "folder.npz"]


def test_a_place_that_can_be_is_left_as_it_is(tmp_path):
    (tmp_path / "old.npz").write_text("old")
    for name in ("new.npz", "new/folder/x.npz", "old.npz"):
        require_place(tmp_path / name)
    assert [x.name for x in tmp_path.iterdir()] == ["old.npz"]
    assert (tmp_path / "old.npz").read_text() == "old"
    with pytest.raises(WriteError, match="Not a directory"):
        require_place(tmp_path / "old.npz" / "x.npz")


# ---------------------------------------------------------------- Ctrl-C

TURNS = f"""{moving.SPIN}[initial]
zeta_3 = "w"
[[event]]
name = "quarter"
when = "A_11"
"""
OPTIONS = ["--vary", "zeta_1=0:1", "--vary", "J_11=normal:1:0.01"]
METHODS = [{}, {"dt": 0.01}, {"dt": 0.01, "step": "rk4"}, {"step": "vern9"}]


@pytest.fixture
def turning():
    return derived(TURNS)


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
