"""--dynamics: the mass matrix is that of the points; what is supplied gives the rates wanted, and
the rates of a motion what was supplied, in every language."""

import tomllib

import numpy as np
import pytest

import derive
from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.code.options import Options
from derive.code.program import LoweringError
from derive.language.limits import LISTENER
from derive.problem.toml import problem_of
from derive.programs import program
from tests.oracles import general, relative_error
from tests.problems import PROBLEMS
from tests.support import corpus, walks
from tests.support.library import ONE_BUILD, emission, library

T = 0.4
OPTIONS = Options(dynamics=True)


def module_of(problem, record):
    """What the emitted Python defines."""
    compiled = assemble(record, problem.group, OPTIONS)
    (text,) = emit(compiled, record, ("python",), "test", OPTIONS).values()
    space = {}
    exec(compile(text, "test.py", "exec"), space)
    return space


@pytest.mark.parametrize("name", ["SE(3) outputs", "SL(2) outputs", "SE(3) torques"])
def test_it_is_the_metric_of_the_points(name):
    """Supplied by the covector input where there is one, M a + b gives the rates a."""
    data = tomllib.loads(PROBLEMS[name])
    space = module_of(problem_of(data), corpus.record(f"points {name}"))
    p, basis, rng = general.parameters(data), space["BASIS"], np.random.default_rng(3)
    k, d = space["constants"]([p[x] for x in space["PARAMETERS"]]), len(basis)
    x, u = general.random_state(data, basis, rng), rng.normal(size=len(space["INPUTS"]))
    found = general.places(data, p)
    G, _ = general.split(data, x, d)
    design = np.column_stack([found.moved(G @ E) for E in np.asarray(basis, float)])
    M = design.T @ (found.masses[:, None] * design)
    assert relative_error(space["mass_matrix"](T, x, k), M) < 1e-12
    rates = general.rhs(data, basis, p, T, x, u)[-d:]
    assert relative_error(space["bias"](T, x, k, u), -M @ rates) < 1e-11
    if any(y["kind"] == "covector" for y in data.get("input", ())):
        wanted, supplied = rng.normal(size=d), np.array(u)
        at = [i for i, y in enumerate(space["INPUTS"]) if y.startswith("u_")]
        supplied[at] += space["mass_matrix"](T, x, k) @ wanted + space["bias"](T, x, k, u)
        assert relative_error(space["rhs"](T, x, k, supplied)[-d:], wanted) < 1e-10


def test_a_motion_on_a_quotient_has_none():
    name = "spherical_pendulum"
    with pytest.raises(LoweringError, match="--dynamics is for motions on the whole group"):
        program(walks.problem(name), walks.record(name), OPTIONS)


def body(group, n, *blocks, **more):
    """Heavy points, driven by a covector on each factor."""
    rng = np.random.default_rng(8)
    places = [rng.integers(-3, 4, size=n).tolist() for _ in range(n + 2)]
    on = [{"block": x} for x in blocks] or [{}]
    data = {
        "name": "test",
        "group": group,
        "point": [{"mass": i, "at": x} | y for y in on for i, x in enumerate(places, 1)],
        "potential": [{"kind": "gravity", "g": [1, -2, 3][:n]}],
        "input": [{"name": "u", "kind": "covector"}],
    }
    return data | more


DRIVEN = {
    "SO(3)": lambda: body("SO(3)", 3),
    "SE(3)": lambda: body("SE(3)", 3),
    "SL(3)": lambda: body("SL(3)", 3),
    "SO(3) x SE(3)": lambda: body("SO(3) x SE(3)", 3, 1, 2),
    "SO(2)": lambda: body("SO(2)", 2, damping=[{"kind": "quadratic", "coefficient": 1, "on": [1]}]),
}


@pytest.mark.parametrize("language", ONE_BUILD)
@pytest.mark.parametrize("name", DRIVEN)
def test_the_rates_of_a_motion_tell_what_drives_it(name, language):
    data, rng = DRIVEN[name](), np.random.default_rng(2)
    problem = problem_of(data)
    code = library(ONE_BUILD[language], problem, dynamics=True)
    _, k = code.constants(np.zeros(0))
    basis = np.array(problem.group.in_user_basis.basis, float)
    x, u = general.random_state(data, basis, rng), rng.normal(size=len(basis))
    rates = code.said("rhs", x, T, k=k, u=u)[-len(u) :]
    assert relative_error(code.said("inverse", x, T, k=k, dzeta=rates), u) < 1e-12
    if language == "c":
        f = derive.compile(problem, dynamics=True)
        assert relative_error(f.inverse(T, x, rates), u) < 1e-12


def test_what_acts_without_inputs_has_no_rates_where_one_is_divided_by():
    force = [{"at": [1, 0], "frame": "space", "force": ["1/s", 0]}]
    given = [{"name": "s", "kind": "force", "at": [0, 1], "frame": "body", "direction": [1, 0]}]
    problem = problem_of(body("SO(2)", 2, input=given, force=force))
    heard = list[str]()
    told = LISTENER.set(heard.append)
    _, texts = emission(problem, ("c",), dynamics=True)
    LISTENER.reset(told)
    assert heard[-1].endswith("no inverse is written, as an input is divided by")
    assert "test_bias(" in texts["test.h"]
    assert "test_inverse(" not in texts["test.h"]
    with pytest.raises(ValueError, match="an input is divided by"):
        derive.compile(problem, dynamics=True).inverse(T, np.zeros(5), [0])
