"""Ensembles: each motion is that of a run, files of every kind, what is refused, what is kept."""

import os
import subprocess
import sys
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

import derive
from derive.command.cli import main
from derive.command.simulating import Tally, kept
from derive.motion import ensemble as of_parts
from derive.motion import native
from derive.motion.ensemble import ParameterDraws, VariedNumber
from derive.problem.toml import problem_of
from derive.programs import motion_of
from derive.python.simulated import SimulatedEnsemble
from tests.problems.moving import FALLING, SPIN, STONE
from tests.support.library import derived
from tests.support.needs import need, needs
from tests.support.processes import environment

VARY = {"zeta_1": (0, 1), "J_11": ("normal", 1.0, 0.01)}
OPTIONS = ["--vary", "zeta_1=0:1", "--vary", "J_11=normal:1:0.01"]


@pytest.fixture(scope="module")
def so3():
    need("cc")
    return derive.derive("so3")


@pytest.fixture(scope="module")
def some(so3):
    return so3.simulate(2.0, ensemble=40, vary=VARY, points=2, tol=1e-12, seed=3)


def small(monkeypatch, motions=7):
    monkeypatch.setattr(of_parts, "MOTIONS", motions)


# ---------------------------------------------------------------- the motions


def test_each_motion_is_that_of_a_run(so3, some):
    assert some.t.tolist() == [0, 1, 2]
    assert some.facts["units"] == {
        "t": "s", **{f"zeta_{k}": "rad/s" for k in (1, 2, 3)}, "J_11": "kg m^2"
    }  # fmt: skip
    assert not some.status.any()
    for k in (0, 17, 39):
        start = dict(zip(some.varied_names, some.varied[k].tolist(), strict=True))
        run = so3.simulate(2.0, start=start, points=2, tol=1e-13)
        assert np.abs(run.states - some.states[k]).max() < 1e-10


READ = {
    "name": "test",
    "group": "SE(2)",
    "parameters": {"k": 1.5},
    "point": [{"mass": 1, "at": [1, 0]}, {"mass": 2, "at": [0, 1]}],
    "input": [{"name": "f", "kind": "force", "at": [1, 1]}],
    "output": [
        {"name": "range", "kind": "distance", "at": [1, 1], "to": ["k", 2], "unit": "ft"},
        {"name": "felt", "kind": "acceleration", "at": [1, 1], "frame": "body"},
        {"name": "own", "y": ["t + k*f_1"]},
    ],
    "event": [{"name": "far", "when": "T_1 - 2", "terminal": True}],
}


@needs("cc")
@pytest.mark.parametrize("ending", ["npz", "csv"])
def test_outputs_are_columns_as_of_runs(tmp_path, ending):
    d = derived(problem_of(READ))
    start, vary = {"w_1": 1.0, "f_2": 0.5}, {"zeta_1": (0, 2), "f_1": (-1, 2), "k": (1, 2)}
    made = d.simulate(3.0, ensemble=12, start=start, vary=vary, points=6, tol=1e-12)
    outputs = ["range", "felt_1", "felt_2", "own"]
    assert made.names[-4:] == tuple(outputs) == tuple(made.facts["outputs"])
    assert made.facts["units"]["range"] == "ft"
    made.save(tmp_path / f"e.{ending}")
    e = SimulatedEnsemble.read(tmp_path / f"e.{ending}")
    assert 0 < e.at_event.sum() < 12
    for k in range(12):
        own = start | dict(zip(e.varied_names, e.varied[k].tolist(), strict=True))
        run = d.simulate(3.0, start=own, points=6, tol=1e-12)
        whole = np.stack([run[x] for x in e.names], axis=1)
        seen = np.vstack([e.states[k], e.end[k, 1:]])
        seen = seen[~np.isnan(seen).any(axis=1)]
        assert seen.shape == whole.shape
        assert np.abs(seen - whole).max() < 1e-8


def test_what_is_drawn_is_by_its_law_whatever_the_parts():
    laws = (VariedNumber("a", -1.0, 3.0), VariedNumber("b", 2.0, 0.5, normal=True))
    whole = ParameterDraws(laws, 5).next(20000)
    parts = ParameterDraws(laws, 5)
    assert np.array_equal(whole, np.concatenate([parts.next(n) for n in (1, 4999, 15000)]))
    a, b = whole.T
    assert -1 <= a.min() < -0.99
    assert 2.99 < a.max() <= 3
    # within five deviations of a mean
    assert abs(a.mean() - 1) < 5 * 4 / np.sqrt(12 * 20000)
    assert abs(b.mean() - 2) < 5 * 0.5 / np.sqrt(20000)
    assert abs(b.std() / 0.5 - 1) < 0.03
    assert not np.array_equal(whole, ParameterDraws(laws, 6).next(20000))


def test_an_ensemble_in_parts_is_the_same(so3, some, monkeypatch):
    small(monkeypatch)
    again = so3.simulate(2.0, ensemble=40, vary=VARY, points=2, tol=1e-12, seed=3)
    assert np.array_equal(again.varied, some.varied)
    # other neighbours in the vector lanes, the same steps
    assert np.abs(again.states - some.states).max() < 1e-13
    monkeypatch.setattr(of_parts, "BYTES", 1)
    again = so3.simulate(2.0, ensemble=3, vary=VARY, points=2, tol=1e-12, seed=3)
    assert np.abs(again.states - some.states[:3]).max() < 1e-13


def test_a_start_that_is_an_expression_follows_its_parameter():
    need("cc")
    e = derived(f'{SPIN}[initial]\nzeta_3 = "2*w"\n').simulate(1.0, ensemble=5, vary={"w": (1, 3)})
    assert np.abs(e["zeta_3"][:, 0] - 2 * e["w"]).max() < 1e-12
    assert np.abs(e["A_11"][:, 0] - np.cos(2 * e["w"])).max() < 1e-8


def test_each_has_a_status_of_its_own(so3):
    """Bodies that there are not; points that fall into a centre."""
    e = so3.simulate(1.0, ensemble=50, vary={"J_11": (-3, 1)})
    assert {*e.status.tolist()} == {0, 1}
    assert np.array_equal(np.isnan(e.states).all(axis=(1, 2)), e.status == 1)
    e = derived(FALLING).simulate(5.0, ensemble=20, vary={"T_1": (1, 60)}, points=5)
    assert {*e.status.tolist()} == {0, 3}
    ended = np.isnan(e.states[..., 0])
    assert np.array_equal(ended[:, -1], e.status == 3)
    assert not (ended[:, :-1] & ~ended[:, 1:]).any()
    assert not ended[:, 0].all()


def test_starts_are_taken_to_the_group(so3):
    e = so3.simulate(1e-9, ensemble=5, vary={"A_12": (0, 0.1)}, project=True)
    A = e.states[:, 0, :9].reshape(5, 3, 3)
    assert np.abs(A @ A.transpose(0, 2, 1) - np.eye(3)).max() < 1e-14
    with pytest.raises(ValueError, match=r"motion 0 starts off the group"):
        so3.simulate(1.0, ensemble=5, vary={"A_12": (0, 0.1)})


# ---------------------------------------------------------------- files


@pytest.mark.parametrize("ending", [".npz", ".csv", ".parquet"])
def test_a_file_holds_the_ensemble(so3, some, ending, tmp_path, monkeypatch, capsys):
    """In several parts by the command, in one by Python."""
    if ending == ".parquet":
        need("the module pyarrow")
    small(monkeypatch, 16)
    out = tmp_path / f"e{ending}"
    how = ["--t", "2", "--tol", "1e-12", "--points", "2", "--seed", "3", "--ensemble", "40"]
    assert main(["simulate", "so3", *how, *OPTIONS, "--out", str(out)]) == 0
    text, err = capsys.readouterr()
    assert text.endswith(f"\n{out}\n")
    assert "40 reached the end" in text
    assert err == ""
    first = out.read_bytes()
    main(["simulate", "so3", *how, *OPTIONS, "--out", str(out)])
    assert out.read_bytes() == first
    for found in (SimulatedEnsemble.read(out), SimulatedEnsemble.read(some.save(out))):
        assert (found.names, found.facts) == (some.names, some.facts)
        assert np.array_equal(found["J_11"], some.varied[:, 1])
        for name in ("t", "varied", "status"):
            assert np.array_equal(getattr(found, name), getattr(some, name))
        assert np.abs(found.states - some.states).max() < 1e-13
    assert [x.name for x in tmp_path.iterdir()] == [out.name]


def test_no_more_than_a_part_is_in_memory(so3, tmp_path, monkeypatch):
    """NumPy tells tracemalloc of its arrays."""
    small(monkeypatch, 256)
    out = tmp_path / "e.npz"
    plan = of_parts.Plan(8192, (VariedNumber("zeta_1", 0.0, 1.0),), 1e-3, 40)
    many = of_parts.EnsembleMotions(motion_of(so3.problem, so3.record), so3.problem, plan)
    tracemalloc.start()
    with kept(many, str(out)) as add:
        for part in many.parts():
            add(part)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert out.stat().st_size > 8192 * 40 * 12 * 8
    assert peak < out.stat().st_size / 5


def test_numpy_reads_an_npz_and_its_states_are_mapped(some, tmp_path):
    path = some.save(tmp_path / "e.npz")
    with np.load(path) as found:
        assert np.array_equal(found["states"], some.states)
    assert isinstance(SimulatedEnsemble.read(path).states, np.memmap)


def test_a_file_that_is_no_ensemble_is_told(some, tmp_path, capsys):
    run = derive.derive("so3").simulate(0.1, points=1).save(tmp_path / "run.npz")
    with pytest.raises(ValueError, match="no ensemble that derive simulate wrote"):
        SimulatedEnsemble.read(run)
    with pytest.raises(ValueError, match="No such file"):
        SimulatedEnsemble.read(tmp_path / "missing.npz")
    with pytest.raises(ValueError, match="must end in"):
        SimulatedEnsemble.read(tmp_path / "e.txt")
    with pytest.raises(KeyError, match="there are A_11"):
        some["x"]


# ---------------------------------------------------------------- what goes wrong


def test_the_bits_are_no_matter_of_time(so3, monkeypatch):
    """Some motions have no body, some end on the way: what is beside the others stays the same."""
    vary = {"zeta_1": (0, 1), "J_11": ("normal", 0.2, 1)}
    asked = {"ensemble": 600, "vary": vary, "points": 3, "seed": 3}
    whole = so3.simulate(2.0, **asked)
    assert {*whole.status.tolist()} == {0, 1}
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    monkeypatch.setattr(of_parts, "SECONDS", 1e-9)
    assert np.array_equal(so3.simulate(2.0, **asked).states, whole.states, equal_nan=True)


LIMITED = """\
import resource, signal, sys
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
from derive.command.cli import main
from derive.motion import emitted, ensemble
ensemble.MOTIONS = 512
library = emitted.Emitted.compiled_ensemble.func

def limited(self):
    found = library(self)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000,) * 2)
    return found

emitted.Emitted.compiled_ensemble = property(limited)
sys.exit(main(sys.argv[1:]))
"""


@needs("cc")
@pytest.mark.skipif(sys.platform == "win32", reason="files have no limit on their size")
@pytest.mark.parametrize("ending", [".npz", ".csv"])
def test_a_full_disk_is_told_and_the_old_file_stays(ending, tmp_path):
    """As on a full disk, after the compiler has written."""
    out = tmp_path / f"e{ending}"
    out.write_text("old")
    asked = ["simulate", "so3", "--t", "1", "--ensemble", "5000", *OPTIONS, "--out", out]
    command = [sys.executable, "-B", "-c", LIMITED, *asked]
    done = subprocess.run(command, capture_output=True, text=True, env=environment())
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"derive: {out}: File too large; choose another --out\n"
    assert [x.name for x in tmp_path.iterdir()] == [out.name]
    assert out.read_text() == "old"


def test_an_ensemble_needs_a_compiler(monkeypatch, capsys):
    monkeypatch.setenv("CC", "no-such-compiler")
    assert main(["simulate", "hammer", "--t", "1", "--ensemble", "9", *OPTIONS[:2]]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert "an ensemble is run by the emitted C: 'no-such-compiler' is not on the path" in err


@pytest.mark.parametrize(
    ("chosen", "words"),
    [
        ({"vary": {"zeta_1": 1}}, "is varied by"),
        ({"vary": {"zeta_1": ("uniform", 0, 1)}}, "is varied by"),
        ({"seed": 0, "ensemble": None}, "for many motions: give ensemble"),
        ({"vary": VARY, "compiled": False}, "by the emitted C alone"),
    ],
)
def test_what_python_refuses(so3, chosen, words):
    with pytest.raises(ValueError, match=words):
        so3.simulate(1.0, **{"ensemble": 3} | chosen)


STONES = f'{STONE}[[event]]\nname = "turned"\nwhen = "A_11"\nterminal = true\n'


@pytest.fixture(scope="module")
def stones():
    need("cc")
    d, vary = derived(STONES), {"H": (0.5, 4.0), "zeta_2": (1.5, 2.5)}
    return d, d.simulate(0.8, ensemble=60, vary=vary, points=4, tol=1e-12, seed=2)


def test_motions_end_at_the_first_of_their_terminal_events(stones):
    d, e = stones
    lands, turned = np.sqrt(2 * e["H"] / 9.81), np.pi / 2 / e.varied[:, 1]
    first = np.minimum(lands, turned)
    expected = np.where(first > 0.8, 0, np.where(lands < turned, 4, 5))
    assert np.array_equal(e.status, expected)
    assert {*expected} == {0, 4, 5}
    ended = expected > 0
    assert e.facts["ends"] == ["ground", "turned"]
    assert e.end[ended, 0] == pytest.approx(first[ended], rel=0, abs=1e-11)
    assert np.isnan(e.end[~ended]).all()
    place = e.names.index("T_3") + 1
    assert np.abs(e.end[expected == 4, place]).max() < 1e-13
    assert np.abs(e.end[expected == 5, 1]).max() < 1e-13
    assert np.array_equal(np.isfinite(e.states[..., 0]), e.t <= np.where(ended, first, 1)[:, None])
    k = int(np.flatnonzero(expected == 5)[0])
    start = dict(zip(e.varied_names, e.varied[k].tolist(), strict=True))
    run = d.simulate(0.8, start=start, points=4, tol=1e-13)
    assert np.abs(run.states[-1] - e.end[k, 1:]).max() < 1e-10


@pytest.mark.parametrize("ending", [".npz", ".csv", ".parquet"])
def test_a_file_has_the_ends(stones, tmp_path, ending):
    if ending == ".parquet":
        need("the module pyarrow")
    _, e = stones
    found = SimulatedEnsemble.read(e.save(tmp_path / f"stones{ending}"))
    for name in ("varied", "status", "states", "end"):
        assert np.array_equal(getattr(found, name), getattr(e, name), equal_nan=True)


@needs("cc")
def test_events_that_are_not_terminal_are_told_to_be_left_out(tmp_path, capsys):
    text = 'name = "e"\nwhen = "A_11"\n'
    (tmp_path / "line.toml").write_text(f"{FALLING}\n[[event]]\n{text}")
    asked = [str(tmp_path / "line.toml"), "--t", "0.1", "--ensemble", "2", "--vary", "T_1=50:60"]
    assert main(["simulate", *asked]) == 0
    assert "events that are not terminal are not looked for" in capsys.readouterr().err


def test_mean_and_deviation_are_those_of_all_parts():
    """Also where the ends of the first part are one state, as of a part of one motion."""
    tally, ends = Tally(1), [[3.0], [3.0], [5.0], [9.0]]
    for some in (ends[:1], ends[1:2], ends[2:]):
        states = np.array(some)[:, None, :]
        none = np.empty((len(some), 0))
        tally.add(of_parts.Part(none, np.zeros(len(some), int), states, none))
    mean, off = tally.ends()
    assert (mean[0], off[0]) == pytest.approx((np.mean(ends), np.std(ends)))


# ---------------------------------------------------------------- on a graphics card

CARD = Path(__file__).parents[1] / "support" / "card.h"
ON_CARD = ["--t", "2", "--ensemble", "40", "--vary", "zeta_1=0:1", "--device", "cuda"]


def as_nvcc(name, *flags):
    """A compiler of CUDA whose card is the host, for the header of a problem."""
    return f"""\
#!/bin/sh
exec g++ -x c++ -include {CARD} -D{name}_LAUNCH=launched {" ".join(flags)} \\
    $(echo "$@" | sed 's/-x cu//; s/-arch=native//; s/-Xcompiler//')
"""


@pytest.fixture
def nvcc(tmp_path, monkeypatch):
    """The file that is the compiler of CUDA, beside a card."""
    found = tmp_path / "bin" / "nvcc"
    found.parent.mkdir()
    found.touch(0o755)
    monkeypatch.setattr("sysconfig.get_path", lambda _: str(tmp_path))
    monkeypatch.setenv("PATH", f"{found.parent}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setattr(native, "has_card", lambda: True)
    return found


@needs("g++")
def test_an_ensemble_on_a_card_is_that_of_the_host(some, nvcc, tmp_path, monkeypatch, capsys):
    """In several parts, through the same files; of some there is no body."""
    nvcc.write_text(as_nvcc("so3"))
    monkeypatch.setattr(of_parts, "BYTES", 16 * 8 * 12 * 3)
    out = tmp_path / "e.npz"
    how = [*ON_CARD, *OPTIONS[2:], "--tol", "1e-12", "--points", "2", "--out", str(out)]
    assert main(["simulate", "so3", *how, "--seed", "3"]) == 0
    told = capsys.readouterr().out
    assert "by vern9, tol 1e-12, in CUDA; seed 3" in told
    assert "40 reached the end" in told
    found = SimulatedEnsemble.read(out)
    assert np.array_equal(found.varied, some.varied)
    assert np.abs(found.states - some.states).max() < 1e-10
    assert main(["simulate", "so3", *how, "--vary", "J_22=-3:1"]) == 0
    assert {*SimulatedEnsemble.read(out).status.tolist()} == {0, 1}


def refused(capsys, problem):
    """The line in which an ensemble on a card is refused."""
    assert main(["simulate", str(problem), *ON_CARD]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    return err


@needs("g++")
def test_what_a_card_lacks_is_told(nvcc, tmp_path, monkeypatch, capsys):
    nvcc.write_text(as_nvcc("hammer", "-DCARDS_MEMORY=99", "-no-such-option"))
    assert "nvcc refused the emitted C: " in refused(capsys, "hammer")
    nvcc.write_text(as_nvcc("hammer", "-DCARDS_MEMORY=99"))
    said = "derive: the graphics card: out of memory: leave out --device\n"
    assert refused(capsys, "hammer") == said
    monkeypatch.setattr(native, "has_card", lambda: False)
    assert "no card of NVIDIA, or no driver of it: leave out --device" in refused(capsys, "top")
    nvcc.unlink()
    if not native.nvcc():  # one that the machine has otherwise
        assert "no nvcc on the path: install CUDA, or pip install" in refused(capsys, "top")
    packaged = tmp_path / "nvidia" / "cu13" / "bin" / "nvcc"
    packaged.parent.mkdir(parents=True)
    packaged.touch()
    assert native.nvcc()
    ends = '[[event]]\nname = "turned"\nwhen = "zeta_3 - w"\nterminal = true\n'
    (tmp_path / "spin.toml").write_text(f"{SPIN}{ends}")
    assert "terminal events are not looked for" in refused(capsys, tmp_path / "spin.toml")
