"""The records of the ready-made problems, derived once for each state of the sources."""

from functools import cache

import pytest

from derive.check.checker import Checker, checker_of
from derive.command.showing import derive, load_problem, ready_made
from derive.pipeline import walk
from derive.python.derived import Derived
from derive.record.as_json import from_json, to_json
from derive.record.record import ANY_GROUP
from tests.support.cached import on_disk

NAMES = ("linear", "affine", "so3", "se3", "sl3")
FLUIDS = ("ideal_fluid", "inhomogeneous_fluid", "stratified_fluid")
"""Problems whose group has no matrices, and that have nothing to emit."""
ESTIMATES = ("imu",)
"""Problems of first order, which have no Lagrangian: tests/walk/test_kinematics.py."""
OTHERS = tuple(sorted({*ready_made()} - {*NAMES, *FLUIDS, *ESTIMATES}))
SPECIAL = ("so3", "se3", "sl3")

SEED = 20
"""Of a check that is to be the same at every run of the tests."""


def repeated(cases, first=1):
    """Cases of a long test: all are run, and the coverage of the first alone is measured, for the
    others take the same lines."""
    cases = [*cases]
    return cases[:first] + [pytest.param(x, marks=pytest.mark.no_cover) for x in cases[first:]]


@on_disk
def record(name):
    return derive(name)[1]


@cache
def problem(name):
    return load_problem(name)


@cache
def derived(name):
    """A ready-made problem and its record, as ``derive.derive`` has them."""
    return Derived(problem(name), record(name))


def own_verdicts(found, seed=SEED):
    """Of the steps about the problem's group; those about any group are the same in all records."""
    checker = Checker(found.problem, seed)
    return [checker.check(step) for step in found.steps if step.scope != ANY_GROUP]


def stands(found, label, seed=SEED):
    """Does a step of a record hold, of the problem that the record says?  Others are not tried."""
    return checker_of(found.problem, seed).check(found[label]).holds


def record_that_holds(problem):
    """The record of a problem, as another program reads it, with every step checked."""
    made = walk(problem)
    again = from_json(to_json(made))
    assert again == made
    verdicts = own_verdicts(again)
    assert [f"{v.label}: {v.reason}" for v in verdicts if not v.holds] == []
    assert max(v.bound for v in verdicts) < 1e-30
    return made
