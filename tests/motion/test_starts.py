"""What a motion starts from: [initial] of problem files, what the command line says instead; a run,
which goes on with its own numbers by --state RUN, where another problem's is told."""

from dataclasses import replace

import numpy as np
import pytest

import derive
from derive.code.emit import problem_hash
from derive.command.cli import main
from derive.command.showing import ready_made
from derive.motion.first_numbers import MotionError
from derive.motion.run import read, written
from derive.motion.start import continued
from derive.problem.problem import ProblemError
from derive.problem.toml import load
from tests.support import walks

BODY = """
name = "swing"
group = "SO(3)"
[body]
given = { m = 1, c = [0, 0, 0], J = [["7/4", 0, 0], [0, 1, 0], [0, 0, "1/4"]] }
[[input]]
name = "u"
kind = "covector"
"""
START = (
    BODY
    + """
[parameters]
w = 2.0
[initial]
exp = ["pi/6", 0, 0]
zeta_3 = "2*w"
u_1 = 0.5
"""
)


def problem(tmp_path, text):
    path = tmp_path / "swing.toml"
    path.write_text(text)
    return path


def first(path, **given):
    run = derive.derive(path).simulate(1e-3, points=1, **given)
    return dict(zip(run.names, run.table[0], strict=True)), run


def test_a_motion_starts_where_the_file_says(tmp_path):
    x, run = first(problem(tmp_path, START))
    assert x["A_22"] == pytest.approx(np.cos(np.pi / 6), abs=1e-15)
    assert x["A_32"] == pytest.approx(0.5, abs=1e-15)
    assert (x["zeta_1"], x["zeta_3"]) == (0, 4)
    assert run.facts["inputs"]["u_1"] == 0.5
    assert run.facts["parameters"] == {"w": 2.0}


def test_what_is_given_wins(tmp_path):
    path = problem(tmp_path, START)
    assert first(path, start={"w": 3})[0]["zeta_3"] == 6
    assert first(path, start={"w": 3, "zeta_3": 1})[0]["zeta_3"] == 1
    x, _ = first(path, exp=(0, 0, np.pi / 2))
    assert x["A_21"] == pytest.approx(1)
    assert x["zeta_3"] == 4
    own = problem(tmp_path, BODY + "[initial]\nA_11 = -1\nA_22 = -1\n")
    assert first(own)[0]["A_11"] == -1
    assert first(own, exp=(0, 0, 0.5))[0]["A_11"] == pytest.approx(np.cos(0.5))


def test_the_record_and_the_code_do_not_know_it(tmp_path):
    with_it = derive.derive(problem(tmp_path, START.replace("w = 2.0", "").replace("2*w", "4")))
    without = derive.derive(problem(tmp_path, BODY + "[parameters]\n"))
    assert problem_hash(with_it.record) == problem_hash(without.record)
    assert with_it.emit() == without.emit()
    header = derive.derive(problem(tmp_path, START)).emit()["swing.h"]
    assert "swing_N_PARAMETERS = 0" in header


def turns(axis, angle):
    """Right-handed, about an axis of R³ by its number."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    R = np.eye(3)
    R[[j, k], [j, k]], R[k, j], R[j, k] = np.cos(angle), np.sin(angle), -np.sin(angle)
    return R


@pytest.mark.parametrize(
    ("text", "A"),
    [
        ('rpy = ["w/4", -1, "pi/2"]', turns(2, np.pi / 2) @ turns(1, -1) @ turns(0, 0.5)),
        ("quaternion = [2, 0, 0, -2]", turns(2, -np.pi / 2)),
        ("quaternion = [1, 2, 3, 4]", np.array([[-10, 2, 11], [10, -5, 10], [5, 14, 2]]) / 15),
        ('rotation = { axis = [0, 2, 0], angle = "w" }', turns(1, 2)),
    ],
)
def test_a_start_is_turned(tmp_path, text, A):
    """R_z R_y R_x; a quaternion of any length, scalar first."""
    given = START.replace('exp = ["pi/6", 0, 0]', text)
    x, _ = first(problem(tmp_path, given))
    found = [[x[f"A_{i}{j}"] for j in (1, 2, 3)] for i in (1, 2, 3)]
    assert np.array(found) == pytest.approx(A, abs=1e-15)


def test_the_blocks_of_a_product_are_turned(tmp_path):
    """Each by what has its number; one that nothing turns is at 1."""
    blocks = "".join(
        f"[[point]]\nmass = 1\nat = {at}\nblock = {k}\n"
        for k in (1, 2, 3)
        for at in ("[1, 0, 0]", "[0, 1, 0]", "[0, 0, 2]")
    )
    start = '[initial]\nrpy2 = [0, 0, "pi/2"]\nquaternion3 = [1, 2, 3, 4]\nT3_1 = 2\n'
    x, _ = first(
        problem(tmp_path, f'name = "three"\ngroup = "SO(3) x SO(3) x SE(3)"\n{blocks}{start}')
    )
    expected = [
        np.eye(3),
        turns(2, np.pi / 2),
        np.array([[-10, 2, 11], [10, -5, 10], [5, 14, 2]]) / 15,
    ]
    for k, A in enumerate(expected, 1):
        found = [[x[f"A{k}_{i}{j}"] for j in (1, 2, 3)] for i in (1, 2, 3)]
        assert np.array(found) == pytest.approx(A, abs=1e-15)
    assert x["T3_1"] == 2


def test_a_text_about_any_group_has_no_motion(tmp_path):
    with pytest.raises(ProblemError, match="a text about any group has no motion to follow"):
        load(problem(tmp_path, 'name = "x"\ngroup = "any"\naction = "linear"\n[initial]\na = 1\n'))


@pytest.mark.parametrize("name", [x for x in ready_made() if walks.problem(x).initial.trees()])
def test_the_ready_made_starts_move(name):
    run = derive.derive(name).simulate(0.1, points=1)
    assert run.ended == ""
    assert np.any(run.states[1] != run.states[0])


# ---------------------------------------------------------------- a run that goes on

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
def first_run(simulate, tmp_path):
    """A run with numbers that are not those of its file, in a file of its own."""
    run, path = simulate(TOP, *GIVEN)[1], tmp_path / "first.npz"
    path.write_bytes(written(run, path.name))
    return run, path


def test_two_halves_are_the_whole(simulate, first_run):
    run, path = first_run
    code, second, err = simulate(TOP, "--state", path)
    assert (code, err) == (0, "")
    for name in ("parameters", "inputs"):
        assert second.facts[name] == run.facts[name]
    assert second.facts["parameters"] == {"m": 0.75, "g": 9.81, "w": 4.0}
    assert second.facts["inputs"] == {"tau_1": 0.0, "tau_2": 0.125, "tau_3": 0.01}
    whole = simulate(TOP, *GIVEN, t="1")[1]
    assert np.abs(second.states[-1] - whole.states[-1]).max() < 1e-9


def test_what_is_set_wins_over_a_run(simulate, first_run):
    run, path = first_run
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
def test_another_problem_on_the_group_is_told(simulate, first_run, text, words):
    run, path = first_run
    code, second, err = simulate(text, "--state", path)
    assert (code, err.count("\n")) == (0, 1)
    assert f"warning: {path}: {words}: its state alone is taken" in err
    assert second.facts["parameters"]["m"] == 0.5
    assert second.facts["inputs"]["tau_3"] == 0
    assert np.array_equal(second.states[0], run.states[-1])


def test_a_run_on_another_group_is_refused(first_run, capsys):
    _, path = first_run
    assert main(["simulate", "se3", "--t", "1", "--state", str(path)]) == 2
    out, err = capsys.readouterr()
    words = "a run of 'pushed', not of 'se3': it moves by SO(3), this by SE(3)"
    assert (out, err) == ("", f"derive: {path}: {words}\n")


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


def test_a_place_that_is_said_twice_is_refused(simulate, first_run, capsys):
    path = first_run[1]
    own = path.with_name("p.toml")
    assert main(["simulate", str(own), "--t", "1", "--state", str(path), "--exp", "0.5,0,0"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.endswith("exp and A_11, … both say where the body is: leave out one")


def test_a_run_of_no_instants_starts_nothing():
    d = derive.derive("so3")
    run = d.simulate(0.1, points=1)
    with pytest.raises(MotionError, match="a run of no instants"):
        continued(replace(run, table=run.table[:0]), d.problem, d.record)
