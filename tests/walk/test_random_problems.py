"""Random problems that are valid: the record holds, and C = Python = Gauss's principle."""

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings

from derive.check.checker import Checker
from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.record.as_json import from_json, to_json
from derive.record.record import ANY_GROUP
from tests.oracles import general, relative_error, solids
from tests.support.emitted import compile_c
from tests.support.needs import present
from tests.support.random_problems import of_both, of_points, of_solids
from tests.support.walks import SEED

pytestmark = pytest.mark.no_cover
EXAMPLES = int(os.environ.get("EXAMPLES", "16"))
"""`make fuzz` takes more."""
STATES = 3
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
    record = walk(problem)
    again = from_json(to_json(record))
    assert again == record
    checker = Checker(again.problem, SEED)
    verdicts = [checker.check(step) for step in again.steps if step.scope != ANY_GROUP]
    assert [f"{v.label}: {v.reason}" for v in verdicts if not v.holds] == []
    assert max(v.bound for v in verdicts) < 1e-30
    return problem, record


def agree(problem, record, data, folder, p):
    """The emitted code against the oracle, which gets ``data``; C once in a while."""
    files = emit(assemble(record, problem.group), record, ("c", "python"), "test")
    space = {}
    exec(compile(files["test.py"], "test.py", "exec"), space)
    rng = np.random.default_rng(len(files["test.py"]))
    values = [{**general.parameters(data), **p}[name] for name in space["PARAMETERS"]]
    k, basis, library = space["constants"](values), space["BASIS"], None
    if len(files["test.py"]) % COMPILED == 0 and present("cc"):
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
        library = compile_c("cc", "test", folder, folder)
    for _ in range(STATES):
        x = general.random_state(data, basis, rng)
        t, u = rng.normal(), rng.normal(size=len(space["INPUTS"]))
        try:
            expected = general.rhs(data, basis, general.parameters(data), t, x, u)
        except np.linalg.LinAlgError:  # the points are nearly on a plane
            assume(False)
        found = space["rhs"](t, x, k, u)
        assert relative_error(found, expected) < 1e-8
        energy = general.energy(data, basis, general.parameters(data), t, x)
        assert abs(space["energy"](t, x, k) - energy) < 1e-9 * max(1, abs(energy))
        if library is not None:
            assert relative_error(library.rhs(t, x, library.constants(values)[1], u), found) < 1e-11


@RANDOM
@given(data=of_points())
def test_points(tmp_path_factory, data):
    problem, record = derived(data)
    agree(problem, record, data, tmp_path_factory.mktemp("random"), {})


@FEWER
@given(data=of_solids())
def test_solids(tmp_path_factory, data):
    """The oracle gets the moments of the solids by quadrature."""
    problem, record = derived(data)
    other = solids.by_moments(data)
    agree(problem, record, other, tmp_path_factory.mktemp("random"), data["parameters"])


@FEWER
@given(data=of_both())
def test_solids_and_points(tmp_path_factory, data):
    """The oracle gets points in place of the solids, with their moments."""
    problem, record = derived(data)
    other = solids.by_points(data)
    agree(problem, record, other, tmp_path_factory.mktemp("random"), data["parameters"])
