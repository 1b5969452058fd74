"""derive simulate --state RUN: a run goes on with its own numbers; another problem's is told."""

from dataclasses import replace

import numpy as np
import pytest

import derive
from derive.command.cli import main
from derive.motion.first_numbers import MotionError
from derive.motion.run import read, written
from derive.motion.start import continued

TOP = """
name = "pushed"
group = "SO(3)"
[parameters]
m = { default = 0.5, unit = "kg" }
g = 9.81
w = 3.0
[body]
given = { m = "m", centre = [0.01, 0, 0.06], I = [[0.004, 0, 0], [0, 0.003, 0], [0, 0, 0.0015]] }
[[potential]]
kind = "gravity"
g = [0, 0, "-g"]
[[input]]
name = "tau"
kind = "covector"
[initial]
exp = [0.5, 0, 0]
zeta_3 = "2*w"
tau_2 = 0.125
"""
GIVEN = ["--set", "m=0.75", "--set", "tau_3=0.01", "--set", "w=4"]


@pytest.fixture
def simulate(tmp_path, capsys):
    """Does a command on a text: its exit code, the run, stderr."""

    def done(text, *options, t="0.5"):
        path, out = tmp_path / "p.toml", tmp_path / "out.npz"
        path.write_text(text)
        code = main(["simulate", str(path), "--t", t, "--out", str(out), *map(str, options)])
        return code, read(out), capsys.readouterr().err

    return done


@pytest.fixture
def first(simulate, tmp_path):
    """A run with numbers that are not those of its file, in a file of its own."""
    run, path = simulate(TOP, *GIVEN)[1], tmp_path / "first.npz"
    path.write_bytes(written(run, path.name))
    return run, path


def test_two_halves_are_the_whole(simulate, first):
    run, path = first
    code, second, err = simulate(TOP, "--state", path)
    assert (code, err) == (0, "")
    for name in ("parameters", "inputs"):
        assert second.facts[name] == run.facts[name]
    assert second.facts["parameters"] == {"m": 0.75, "g": 9.81, "w": 4.0}
    assert second.facts["inputs"] == {"tau_1": 0.0, "tau_2": 0.125, "tau_3": 0.01}
    whole = simulate(TOP, *GIVEN, t="1")[1]
    assert np.abs(second.states[-1] - whole.states[-1]).max() < 1e-9


def test_what_is_set_wins(simulate, first):
    run, path = first
    code, second, _ = simulate(TOP, "--state", path, "--set", "m=1", "--set", "zeta_1=0.25")
    assert code == 0
    assert second.facts["parameters"]["m"] == 1
    assert second.facts["inputs"] == run.facts["inputs"]
    assert second["zeta_1"][0] == 0.25
    assert np.array_equal(second["zeta_3"][:1], run["zeta_3"][-1:])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (TOP.replace('"pushed"', '"other"'), "a run of 'pushed', not of 'other'"),
        (TOP.replace("9.81", "1.62"), "a run of another 'pushed', as the file was then"),
    ],
)
def test_another_problem_on_the_group_is_told(simulate, first, text, words):
    run, path = first
    code, second, err = simulate(text, "--state", path)
    assert (code, err.count("\n")) == (0, 1)
    assert f"warning: {path}: {words}: its state alone is taken" in err
    assert second.facts["parameters"]["m"] == 0.5
    assert second.facts["inputs"]["tau_3"] == 0
    assert np.array_equal(second.states[0], run.states[-1])


def test_a_run_on_another_group_is_refused(first, capsys):
    _, path = first
    assert main(["simulate", "se3", "--t", "1", "--state", str(path)]) == 2
    out, err = capsys.readouterr()
    words = "a run of 'pushed', not of 'se3': it moves by SO(3), this by SE(3)"
    assert (out, err) == ("", f"derive: {path}: {words}\n")


def test_a_run_in_python_goes_on_as_its_file():
    d = derive.derive("so3")
    run = d.simulate(0.1, start={"zeta_1": 1.0, "J_11": 2.0}, points=1)
    held, doubt = continued(run, d.problem, d.record)
    assert doubt == ""
    assert (held["J_11"], held["zeta_1"]) == (2.0, run["zeta_1"][-1])


def test_a_time_that_begins_again_is_told(simulate, tmp_path):
    at = ("[1, 0, 0]", "[0, 2, 0]", "[0, 0, 3]")
    text = 'name = "timed"\ngroup = "SO(3)"\n'
    text += "".join(f"[[point]]\nmass = 1\nat = {x}\n" for x in at)
    text += '[[potential]]\nkind = "expression"\nU = "r1_z*cos(t)"\n[initial]\nzeta_3 = 1\n'
    path = tmp_path / "first.npz"
    run = simulate(text)[1]
    path.write_bytes(written(run, path.name))
    code, _, err = simulate(text, "--state", path)
    assert (code, err.count("\n")) == (0, 1)
    assert "depend on t, which begins again at 0" in err


def test_a_place_that_is_said_twice_is_refused(simulate, first, capsys):
    path = first[1]
    own = path.with_name("p.toml")
    assert main(["simulate", str(own), "--t", "1", "--state", str(path), "--exp", "0.5,0,0"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.endswith("exp and A_11, … both say where the body is: leave out one")


def test_a_run_of_no_instants_starts_nothing():
    d = derive.derive("so3")
    run = d.simulate(0.1, points=1)
    with pytest.raises(MotionError, match="a run of no instants"):
        continued(replace(run, table=run.table[:0]), d.problem, d.record)
