"""Of the two ways to solve the kernel, the one taken is the one that costs fewer operations."""

import tomllib

import pytest

from derive import pipeline, programs
from derive.problem.toml import problem_of
from derive.walk.matrices import solution

BODY = '[body]\nmoments = "symbolic"\n'


def operations(group, monkeypatch, multipliers):
    monkeypatch.setattr(solution, "MULTIPLIERS", multipliers)
    problem = problem_of(tomllib.loads(f'name = "test"\ngroup = "{group}"\n{BODY}'))
    program = programs.program(problem, pipeline.walk(problem))
    return sum(program.functions["rhs"].operations().values())


@pytest.mark.parametrize(
    "group", ["SL(2)", "SL(3)", "SL(4)", "GL(2)", "GL(3)", "SAff(2)", "Aff(3)"]
)
def test_the_cheaper_road_is_taken(group, monkeypatch):
    """By multipliers where 𝔤 has at most one condition in gl(n), never by the mass matrix."""
    taken = operations(group, monkeypatch, solution.MULTIPLIERS)
    other = operations(group, monkeypatch, -1)
    assert taken < other
