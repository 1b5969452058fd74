"""Outputs, their derivatives, the mass matrix and the bias in files that are read back."""

import re
import tomllib
from functools import cache

import pytest

from derive.code.emit import emit
from derive.code.options import Options
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.programs import program
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.problems import PROBLEMS

NAME = "SO(2) outputs"
FUNCTIONS = (
    *("outputs", "jacobian_outputs", "jacobian_outputs_raw", "mass_matrix", "bias"),
    "inverse",
    "jacobian_outputs_inputs",
)
PUSHED = '[[input]]\nname = "push"\nkind = "force"\non = 2\ndirection = [1, 0]\n'


@cache
def emitted():
    """The files of a small problem with one input, the numbers in them, and its record."""
    problem = problem_of(tomllib.loads(PROBLEMS[NAME] + PUSHED))
    record = walk(problem)
    options = Options(jacobian=("outputs", "raw"), dynamics=True)
    compiled = program(problem, record, options)
    files = emit(compiled, record, ("c", "python"), "test", options)
    return files, compiled.numbers(), record


def refused(file, text):
    """What is said of the files, one of them changed; "" where they all hold."""
    files, numbers, record = emitted()
    found = EmittedFiles(files | {file: text}, "test", Chart(), numbers).reports(record)
    return " ".join(x.text for x in found if not x.holds)


def test_they_equal_the_record():
    files, numbers, record = emitted()
    for report in EmittedFiles(files, "test", Chart(), numbers).reports(record):
        assert report.holds, report.text
        assert all(f" {x}" in report.text for x in FUNCTIONS), report.text


@pytest.mark.parametrize("name", FUNCTIONS)
def test_numbers_all_over_are_compared(name):
    text = emitted()[0]["test.c"]
    start = text.index(f"void test_{name}(")
    end = text.index("\n}\n", start)
    stored = sorted({*re.findall(r"^    \w+\[\d+\] = ([^;]*);", text[start:end], re.M)})
    for old in stored[:: 1 + len(stored) // 4]:
        changed = text[start:end].replace(f"] = {old};", f"] = 1.0 + ({old});", 1)
        assert f"{name}: " in refused("test.c", text[:start] + changed + text[end:]), old


SWAPPED = '    "place_1",\n    "place_2",', '    "place_2",\n    "place_1",'


@pytest.mark.parametrize(
    ("file", "old", "new", "reason"),
    [
        (
            "test.py",
            '    "place_1",\n    "place_2",',
            '    "place_2",\n    "place_1",',
            "names of outputs",
        ),
        ("test.c", *SWAPPED, "outputs"),
        ("test.h", "test_Y_place_1 = 0", "test_Y_place_2 = 0", "places of the names of outputs"),
        ("test.h", "test_N_OUTPUTS = ", "test_N_OUTPUTS = 1", "size OUTPUTS"),
    ],
    ids=["Python", "C", "places", "size"],
)
def test_a_wrong_list_of_outputs_is_refused(file, old, new, reason):
    text = emitted()[0][file]
    assert old in text
    assert reason in refused(file, text.replace(old, new))
