"""Random problems that are valid: the record holds, and C = Python = Gauss's principle."""

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings

from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.record.as_json import from_json, to_json
from tests.oracles import solids
from tests.support.gauss import agrees
from tests.support.library import loaded, module
from tests.support.needs import present
from tests.support.random_problems import of_both, of_points, of_solids
from tests.support.walks import own_verdicts

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
    verdicts = own_verdicts(again)
    assert [f"{v.label}: {v.reason}" for v in verdicts if not v.holds] == []
    assert max(v.bound for v in verdicts) < 1e-30
    return problem, record


def held(problem, record, data, values):
    """The emitted code against the oracle, which gets ``data``; C once in a while."""
    files = emit(assemble(record, problem.group), record, ("c", "python"), "test")
    compiled = len(files["test.py"]) % COMPILED == 0 and present("cc")
    c = loaded("c", "test", files) if compiled else None
    m = module("test", files["test.py"])
    try:
        agrees(m, c, data, values, states=STATES, tolerance=1e-8)
    except np.linalg.LinAlgError:  # the points are nearly on a plane
        assume(False)


@RANDOM
@given(data=of_points())
def test_points(data):
    problem, record = derived(data)
    held(problem, record, data, {})


@FEWER
@given(data=of_solids())
def test_solids(data):
    """The oracle gets the moments of the solids by quadrature."""
    problem, record = derived(data)
    other = solids.by_moments(data)
    held(problem, record, other, data["parameters"])


@FEWER
@given(data=of_both())
def test_solids_and_points(data):
    """The oracle gets points in place of the solids, with their moments."""
    problem, record = derived(data)
    other = solids.by_points(data)
    held(problem, record, other, data["parameters"])
