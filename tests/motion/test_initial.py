"""[initial] of problem files: what a motion starts from, and what the command line says instead."""

import numpy as np
import pytest

import derive
from derive.code.emit import problem_hash
from derive.command.cli import main
from derive.command.showing import ready_made
from derive.problem.problem import ProblemError
from derive.problem.toml import load
from tests.problems import READY

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


def test_off_the_group_it_is_refused_and_can_be_projected(tmp_path, capsys):
    path = problem(tmp_path, BODY + "[initial]\nA_11 = 1.1\nzeta_1 = 1\n")
    assert main(["simulate", str(path), "--t", "1"]) == 2
    assert "not on the group: --project takes it there; its defect is 0.21" in (
        capsys.readouterr().err
    )
    assert main(["simulate", str(path), "--t", "1", "--project"]) == 0


def test_a_text_about_any_group_has_no_motion(tmp_path):
    with pytest.raises(ProblemError, match="a text about any group has no motion to follow"):
        load(problem(tmp_path, 'name = "x"\ngroup = "any"\naction = "linear"\n[initial]\na = 1\n'))


@pytest.mark.parametrize(
    "name", [x for x in ready_made() if load(READY / f"{x}.toml").initial.trees()]
)
def test_the_ready_made_starts_move(name):
    run = derive.derive(name).simulate(0.1, points=1)
    assert run.ended == ""
    assert np.any(run.states[1] != run.states[0])


def test_a_start_in_words():
    from derive import SO, Moments, Problem

    p = Problem("free", SO(3), Moments(m=1, c=[0, 0, 0], J=[[2, 0, 0], [0, 1, 0], [0, 0, 1]]),
                initial={"zeta_1": "2*w"}, parameters={"w": 0.5})  # fmt: skip
    assert first(p)[0]["zeta_1"] == 1
