"""Every group × potential × input: C = Python = Gauss's principle, also of random problems, of
other sizes at exact points against d'Alembert, and of what acts twice."""

import os
import re
import tomllib
from fractions import Fraction
from random import Random

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings

from derive import Gravity, Group, Moments, Problem, derive
from derive.check.checker import Checker
from derive.check.trials.model import Model
from derive.check.values.draws import Locus
from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.language import rational as q
from derive.language.tree import mul, neg
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.record.sentence import english
from derive.walk.matrices import solution
from tests.fuzz.mutate import mesh
from tests.oracles import solids
from tests.problems import PROBLEMS
from tests.support import corpus, walks
from tests.support.corpus import LARGE, SOLIDS, SOLIDS_ON, record
from tests.support.gauss import agrees
from tests.support.library import loaded, module, module_of
from tests.support.needs import present
from tests.support.random_problems import of_both, of_points, of_solids
from tests.support.walks import SEED, own_verdicts, record_that_holds

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


def test_a_mesh_is_the_solid_it_bounds(tmp_path):
    (tmp_path / "body.off").write_text(mesh("off"), encoding="utf-8")
    head = 'name = "test"\ngroup = "SE(3)"\n[body]\ndensity = 2\n'
    bounded = problem_of(tomllib.loads(head + 'solid = "mesh"\nfile = "body.off"'), tmp_path)
    corners = "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]"
    whole = problem_of(tomllib.loads(f'{head}solid = "tetrahedron"\nvertices = {corners}'))
    found, expected = walk(bounded), walk(whole)
    assert found["body"].equations == expected["body"].equations
    assert Checker(found.problem, SEED).check(found["body"]).holds


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("name", LARGE)
def test_code_against_points(name, seed):
    p, d = LARGE[name](), record(f"points many on {name}")
    g = p.group
    code = module_of(p)
    model = Model(d.problem, g, Random(seed), 2, Locus(driven=bool(p.inputs)))
    n = g.n
    A = [float(x) for row in model.g[:n] for x in row[:n]]
    zeta = [float(x) for x in g.vee(model.Z)]
    T = [float(row[n]) for row in model.g[:n]] if g.affine else []
    x = np.array([*A, *T, *zeta])
    k = code.constants([float(model.parameters[name]) for name in code.PARAMETERS])
    u = [float(x) for x in model.input] if p.inputs else None
    dx = code.rhs(0.0, x, k, u)
    rate = [float(x) for x in g.vee(model.acceleration)]
    scale = max(map(abs, rate))
    # a random element of SL(4) may be far from a rotation: C = ĀA is inverted with its condition
    condition = np.linalg.cond(np.reshape(A, (n, n))) ** 2
    assert np.abs(dx[-g.dimension :] - rate).max() <= max(1e-12, 1e-14 * condition) * scale
    motion = q.times(model.g, model.Z)
    assert np.allclose(dx[: n * n], [float(x) for row in motion[:n] for x in row[:n]])
    energy = float(model.energy(model.t, model.g, model.Z))
    assert code.energy(0.0, x, k) == pytest.approx(energy, rel=1e-9)


GROUPS = ("SL(2)", "SL(3)", "SL(4)", "GL(2)", "GL(3)", "SAff(2)", "SAff(3)", "Aff(2)", "Aff(3)")


@pytest.mark.parametrize("group", GROUPS)
def test_a_multiplier_costs_less_than_the_mass_matrix(group, monkeypatch):
    """Why the normal space of 𝔤 is used where it has at most one dimension."""
    n = int(group[-2])
    problem = Problem("p", Group(group), Moments(), [Gravity(*[0] * (n - 1), -1)])

    def operations():
        d = derive(problem)
        return assemble(d.record, d.problem.group).functions["rhs"].operations()

    ours = operations()
    monkeypatch.setattr(solution, "MULTIPLIERS", -1)
    other = operations()
    assert sum(ours.values()) < sum(other.values())
    assert "Aff" not in group or 3 * ours["mul"] < 2 * other["mul"]


def test_a_problem_in_numbers_has_no_parameters():
    """What is 0, 1 or alike for this body is folded: J diagonal, gravity along an axis."""
    J = [[1, 0, 0], [0, 2, 0], [0, 0, 3]]
    body = Moments(m=1, c=[0, 0, 0.2], J=J)
    d = derive(Problem("heavy", Group("SO(3)"), body, [Gravity(0, 0, -9.81)]))
    program = assemble(d.record, d.problem.group)
    assert program.parameters == program.constants == ()
    operations = program.functions["rhs"].operations()
    assert operations["mul"] <= 27
    assert operations["add"] <= 11


POINTS = [{"mass": m, "at": r} for m, r in ((1, [1, 0, 0]), (2, [0, 1, 0.5]), (1.5, [0.2, 0, -1]))]
ON = {"on": 2}
TABLES = {
    "damping": ("damping", {"coefficient": 0.3, "on": [2]}),
    "damping of all": ("damping", {"coefficient": 0.3}),
    "gravity": ("potential", {"kind": "gravity", "g": [1, 2, -9]}),
    "spring": ("potential", {"kind": "spring", **ON, "anchor": [2, 1, 1], "stiffness": 3}),
    "spring with a length": (
        "potential",
        {"kind": "spring", **ON, "anchor": [2, 1, 1], "stiffness": 3, "length": 0.5},
    ),
    "spring at a place": (
        "potential",
        {"kind": "spring", "at": [1, 1, 1], "anchor": [2, 0, 1], "stiffness": 3},
    ),
    "attraction": ("potential", {"kind": "attraction", "strength": 2, "centre": [3, 4, 5]}),
    "expression": ("potential", {"kind": "expression", "U": "r2_x^2*r3_y + sin(t)*r1_z"}),
    "force on a point": ("input", {"kind": "force", **ON}),
    "force in the body": ("input", {"kind": "force", **ON, "frame": "body"}),
    "force at a place": ("input", {"kind": "force", "at": [1, 1, 1]}),
}
STATE = [0, -1, 0, 1, 0, 0, 0, 0, 1, 0.5, -0.3, 0.2, 0.7, -0.4, 1.1, 0.3, 0.6, -0.8]


def rates(kind, table, several):
    """dx/dt with so many tables, the same numbers as inputs for each."""
    own = [table | {"name": f"f{k}"} if kind == "input" else table for k in range(several)]
    problem = problem_of({"name": "x", "group": "SE(3)", "point": POINTS, kind: own})
    space = module_of(problem)
    each = len(space.INPUTS) // several
    u = np.tile(np.linspace(1, 2, each), several)
    return space.rhs(0.3, np.array(STATE), space.constants([]), u)


@pytest.mark.parametrize("name", TABLES)
def test_the_second_of_two_adds_what_the_first_adds(name):
    kind, table = TABLES[name]
    one, two, three = (rates(kind, table, several) for several in (1, 2, 3))
    assert np.abs(two - one).max() > 1e-2
    assert np.abs((three - two) - (two - one)).max() < 1e-12


EXAMPLES = int(os.environ.get("EXAMPLES", "6"))
"""The same ones in each run; `make fuzz` takes 300."""
FEW_STATES = 3
COMPILED = 5
"""One in so many problems is compiled as C, too."""
RANDOM = settings(
    max_examples=EXAMPLES,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=[*HealthCheck],
)
FEWER = settings(RANDOM, max_examples=max(EXAMPLES // 3, 1))


def derived(data):
    """The problem of a file and its record, which holds; degenerate bodies are left out."""
    try:
        problem = problem_of(data)
    except ProblemError as error:
        assume("moves no mass" not in str(error))
        raise
    return problem, record_that_holds(problem)


def held(problem, record, data, values):
    """The emitted code against the oracle, which gets ``data``; C once in a while."""
    files = emit(assemble(record, problem.group), record, ("c", "python"), "test")
    compiled = len(files["test.py"]) % COMPILED == 0 and present("cc")
    c = loaded("c", "test", files) if compiled else None
    m = module("test", files["test.py"])
    try:
        agrees(m, c, data, values, states=FEW_STATES, tolerance=1e-8)
    except np.linalg.LinAlgError:  # the points are nearly on a plane
        assume(False)


@pytest.mark.no_cover
@RANDOM
@given(data=of_points())
def test_random_points(data):
    problem, record = derived(data)
    held(problem, record, data, {})


@pytest.mark.no_cover
@FEWER
@given(data=of_solids())
def test_random_solids(data):
    """The oracle gets the moments of the solids by quadrature."""
    problem, record = derived(data)
    other = solids.by_moments(data)
    held(problem, record, other, data["parameters"])


@pytest.mark.no_cover
@FEWER
@given(data=of_both())
def test_random_solids_and_points(data):
    """The oracle gets points in place of the solids, with their moments."""
    problem, record = derived(data)
    other = solids.by_points(data)
    held(problem, record, other, data["parameters"])
