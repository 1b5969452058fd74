"""Every group × potential × input: C = Python = Gauss's principle."""

import re
import tomllib
from fractions import Fraction

import pytest

from derive.check.checker import Checker
from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.language.tree import mul, neg
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.sentence import english
from tests.oracles import solids
from tests.problems import PROBLEMS
from tests.support import corpus, walks
from tests.support.corpus import SOLIDS, SOLIDS_ON
from tests.support.gauss import agrees
from tests.support.library import loaded, module
from tests.support.needs import present
from tests.support.walks import SEED, own_verdicts

STATES = 12
HALF = Fraction(1, 2)


def emitted(problem, record):
    """The emitted files by name, and the Python module."""
    files = emit(assemble(record, problem.group), record, ("c", "python"), "test")
    return files, module("test", files["test.py"])


@pytest.mark.parametrize("name", PROBLEMS)
def test_code_agrees_with_the_oracle(name):
    data = tomllib.loads(PROBLEMS[name])
    problem = problem_of(data)
    roads = (x for x in ("ready", "forces", "points") if name in corpus.ROADS[x])
    record = corpus.record(f"{next(roads)} {name}")
    files, m = emitted(problem, record)
    c = loaded("c", "test", files) if present("cc") else None
    agrees(m, c, data, {}, states=STATES, tolerance=1e-11)


@pytest.mark.parametrize("name", ["SE(2) torques", "SO(3) torques", "SE(2) of the state"])
def test_forces_from_outside(name):
    """Torques, directions, a wind: the Python code of small problems, in every run."""
    data = tomllib.loads(PROBLEMS[name])
    _, m = emitted(problem_of(data), corpus.record(f"points {name}"))
    agrees(m, None, data, {}, states=3, tolerance=1e-11)


@pytest.mark.parametrize("name", ["SL(3) covector of the state", "se(3) mixed of the state"])
def test_a_covector_of_the_state(name):
    """By the code, and by the checker."""
    data, record = tomllib.loads(PROBLEMS[name]), corpus.record(f"points {name}")
    agrees(emitted(problem_of(data), record)[1], None, data, {}, states=3, tolerance=1e-11)
    assert all(v.holds for v in own_verdicts(record))


@pytest.mark.parametrize("group", SOLIDS_ON)
def test_solids_are_their_moments(group):
    """The body of solids moves like one whose moments are the integrals by quadrature."""
    solid = tomllib.loads(SOLIDS.replace("GROUP", group))
    record, data = corpus.record(f"points solids on {group}"), solids.by_moments(solid)
    files, m = emitted(problem_of(solid), record)
    assert re.sub(r"/\*.*?\*/", "", files["test.c"], flags=re.DOTALL).isascii()  # cos(π/3) too
    agrees(m, None, data, {}, tolerance=1e-9)


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("saff3", "the motion separates"),
        ("jelly", "The motion separates if U_Q"),
        ("sim3", "the motion separates"),
    ],
)
def test_separation_of_the_centre_of_mass(name, says):
    """Exercise 2 in space: the kinetic energy is a sum; the potential decides."""
    record = walks.record(name)
    kinetic = record["affine.separation"].equations[-1]
    inertia = ("tr", ("mul", "α", "J_c", ("T", "α")))
    assert kinetic.rhs[1:3] == (mul(HALF, inertia), mul(HALF, "m", ("norm2", "Ṙ")))
    assert kinetic.rhs[3:] == (neg("Ũ"),)
    assert says in english(record[f"{name}.separation"].prose)
    assert Checker(record.problem, SEED).check(record[f"{name}.separation"]).holds


def test_a_potential_that_ties_the_centre_of_mass():
    text = PROBLEMS["SAff(2)"].replace("between = [1, 2]", "on = 1\nanchor = [0, 0]\nlength = 1")
    record = walk(problem_of(tomllib.loads(text)))
    assert "if U_Q" in english(record["test.separation"].prose)


TETRAHEDRON = """OFF
4 4 6
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
"""


def test_a_mesh_is_the_solid_it_bounds(tmp_path):
    (tmp_path / "body.off").write_text(TETRAHEDRON, encoding="utf-8")
    head = 'name = "test"\ngroup = "SE(3)"\n[body]\ndensity = 2\n'
    mesh = problem_of(tomllib.loads(head + 'solid = "mesh"\nfile = "body.off"'), tmp_path)
    corners = "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]"
    whole = problem_of(tomllib.loads(f'{head}solid = "tetrahedron"\nvertices = {corners}'))
    found, expected = walk(mesh), walk(whole)
    assert found["body"].equations == expected["body"].equations
    assert Checker(found.problem, SEED).check(found["body"]).holds
