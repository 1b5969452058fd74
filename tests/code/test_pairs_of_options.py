"""Any two options that go together: a few emissions have each such pair, of a problem, of numbers,
of forms of the state, of derivatives, of steps, of what is added.  In each every language says the
same as C, and C and Python equal the record."""

import itertools
from functools import cache
from random import Random

import pytest

from derive.code.emit import planned
from derive.code.languages import LANGUAGES
from derive.code.options import ADDED, CHOICES, REPEATED, Options
from derive.language.limits import Refused
from derive.programs import require_program
from tests.support.emitted_files import Emission
from tests.support.languages import Case
from tests.support.library import BUILDS
from tests.support.needs import need
from tests.support.walks import problem, record

PROBLEMS = ("so3", "se3", "sl3", "saff3", "so4", "two_tops", "screw", "kirchhoff", "euler_poisson")
APART = ("form", "ensemble", "gauss_jax")
"""A form of C alone, and steps that only C or only Python has: these have tests of their own."""
AXES = {"problem": PROBLEMS} | {x: y for x, (y, _) in CHOICES.items() if x not in APART}
AXES |= {x: ((), *((y,) for y in own if y not in APART)) for x, (own, _) in REPEATED.items()}
AXES |= {x: (False, True) for x in ADDED if x not in APART}
ROWS = 60
"""No fewer than there are; those that are too many say nothing."""


@cache
def goes(row):
    """Do the options of a row go together?"""
    name, options = row[0], dict(zip(list(AXES)[1:], row[1:], strict=True))
    try:
        planned(("c",), "row", Options(**options))
        require_program(problem(name), record(name), Options(**options))
    except (Refused, ValueError):
        return False
    return True


def pairs(row):
    """Those of the values of a row, each with the axis that it is on."""
    return {*itertools.combinations(enumerate(row), 2)}


def with_value(row, axis, value):
    """A row with another value on one axis."""
    return (*row[:axis], value, *row[axis + 1 :])


@cache
def rows():
    """Rows that have between them each pair of values that goes together with the first values of
    all other axes, of some problem."""
    values, some, found = [*AXES.values()], Random(1), []
    plain = tuple(x[0] for x in values)
    left, each = {}, [(a, x) for a, own in enumerate(values) for x in own]
    for (a, x), (b, y) in itertools.combinations(each, 2):
        row = with_value(with_value(plain, a, x), b, y)
        of_each = [row] if a == 0 else [with_value(row, 0, name) for name in PROBLEMS]
        if a != b and (possible := [x for x in of_each if goes(x)]):
            left[(a, x), (b, y)] = possible[0]
    while left:
        first, row = next(iter(left.items()))
        for axis in some.sample(range(len(values)), len(values)):
            others = [with_value(row, axis, x) for x in values[axis]]
            kept = [x for x in others if first in pairs(x) and goes(x)]
            row = max(kept, key=lambda x: len(pairs(x) & {*left}), default=row)
        found.append(row)
        left = {pair: x for pair, x in left.items() if pair not in pairs(row)}
    return found


def options_of(k):
    """The problem of a row and its options; ``None`` where there are not so many rows."""
    if k >= len(rows()):
        return None
    return rows()[k][0], dict(zip(list(AXES)[1:], rows()[k][1:], strict=True))


def test_all_are_tried():
    assert 20 < len(rows()) <= ROWS


@cache
def case(k):
    """The problem of a row with its options and numbers."""
    need("cc")
    name, options = options_of(k)
    real = options.pop("real")
    return Case(name, options, real, tolerance=1e-11, prefix="row")


@pytest.mark.parametrize("k", range(ROWS))
@pytest.mark.parametrize("build", [x for x in BUILDS if BUILDS[x][0] != "c"])
def test_every_language_says_the_same(build, k):
    """And moves alike, by the steps that there are."""
    if options_of(k) is None:
        return
    language, known = LANGUAGES[BUILDS[build][0]], case(k)
    able = {*known.options["step"]} <= {*language.steps} and (
        known.options["frame"] == "given" or language.framed
    )
    double = known.real == "double"
    if able and (double or build != "python"):
        known.agrees(build, None if double else 2e-5)


@pytest.mark.parametrize("k", range(ROWS))
def test_they_equal_the_record(k):
    if options_of(k) is None:
        return
    name, options = options_of(k)
    made = Emission(name, ("c", "python"), "row", **options)
    for report in made.reports(fresh=made.files):
        assert report.holds, (rows()[k], report.text)
        if report.read:  # of C steps stand in a file of their own
            within = bool(made.options.step) and report.files != ("row.h", "row.c")
            assert ("steps in time, which are not read back" in report.text) == within, report.text
