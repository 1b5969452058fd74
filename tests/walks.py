"""The records of the ready-made problems, derived once for each test process."""

from functools import cache

from derive.cli import derive, ready_made

NAMES = ("linear", "affine", "so3", "se3", "sl3")
OTHERS = tuple(sorted({*ready_made()} - {*NAMES}))
SPECIAL = ("so3", "se3", "sl3")


@cache
def record(name):
    return derive(name)[1]


@cache
def problem(name):
    return derive(name)[0]
