"""--dynamics: the mass matrix is that of the points; what is supplied gives the rates wanted."""

import tomllib

import numpy as np
import pytest

from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.code.options import Options
from derive.code.program import LoweringError
from derive.problem.toml import problem_of
from derive.programs import program
from tests.oracles import general, relative_error
from tests.problems import PROBLEMS
from tests.support import corpus, walks

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
