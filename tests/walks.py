"""The records of the ready-made problems, derived once for each test process."""

from functools import cache

from derive.cli import derive, ready_made
from derive.record.check import Checker
from derive.record.vocabulary import ANY_GROUP

NAMES = ("linear", "affine", "so3", "se3", "sl3")
OTHERS = tuple(sorted({*ready_made()} - {*NAMES}))
SPECIAL = ("so3", "se3", "sl3")


@cache
def record(name):
    return derive(name)[1]


@cache
def problem(name):
    return derive(name)[0]


def own_verdicts(found, seed=20):
    """Of the steps about the problem's group; those about any group are the same in all records."""
    checker = Checker(found.problem, seed)
    return [checker.check(step) for step in found.steps if step.scope != ANY_GROUP]
