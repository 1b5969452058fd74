"""The validator of the functions of a discrete step: what is emitted passes, no change of it."""

import re
import tomllib
from functools import cache

import pytest

import derive
from derive.code.emit import emit
from derive.code.options import Options
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.programs import program
from derive.validate.chart import Chart
from derive.validate.compare import compare
from derive.validate.emission import EmittedFiles
from derive.validate.exact_points import Claims
from derive.validate.read_file import read
from derive.validate.terms import CodeError
from tests.support.code_mutations import mutants
from tests.support.corpus import driven
from tests.validate.test_validation import ENDS, READ

KINDS = {
    "so3": "step_force, step_guess, step_newton",
    "se3": "step_force, step_guess, step_newton",
    "sl3": "step_guess, step_begin, step_newton",
    "saff3": "step_guess, step_begin, step_newton",
    "gl3": "step_force, step_end",
    "heisenberg": "step_turn, step_turn_little, step_newton",
    "sim3": "step_turn, step_turn_little, step_newton",
    "so4": "step_turn, step_turn_little, step_newton",
    "screw": "step_turn, step_turn_little, step_newton",
    "SO(3)": "step_turn, step_turn_little, step_newton",
    "SE(3)": "step_turn, step_turn_little, step_newton",
    "SL(3)": "step_turn, step_turn_little, step_newton",
}
"""Problem, or group of one with inputs and damping → what is read back of its step."""


@cache
def emitted(name, layout="row"):
    """The record, the files and the numbers in them."""
    options = Options(step=("discrete",), layout=layout)
    if "(" in name:
        text = driven(name).replace("length = 1 ", "length = 0 ")
        problem = problem_of(tomllib.loads(text))
    else:
        problem = derive.derive(name).problem
    record = walk(problem)
    compiled = program(problem, record, options)
    files = emit(compiled, record, READ, "own", options)
    return record, files, compiled.numbers()


@pytest.mark.parametrize("layout", ["row", "col"])
@pytest.mark.parametrize("name", KINDS)
def test_the_functions_of_a_step_are_read_back(name, layout):
    record, files, numbers = emitted(name, layout)
    reports = EmittedFiles(files, "own", Chart(layout), numbers).reports(record)
    found = [x for x in reports if x.read]
    assert len(found) == len(READ)
    for report in found:
        assert report.holds, report.text
        assert KINDS[name] in report.text
        assert "step_momentum, step_velocity, step_force" in report.text


@cache
def claims(name):
    return Claims(emitted(name)[0], Chart(), 2**64)


def compared(name, language, text):
    """Compare a changed file with the record."""
    _, files, numbers = emitted(name)
    file = f"own{ENDS[language]}"
    module = read(file, {**files, file: text}, "own").module
    compare(module, claims(name), numbers, "", 1e-3)
    return module


def transposed(text):
    """A text in which an entry of Y² and that of its transpose are one: Y is skew on SO(n)."""
    return re.sub(r"power_2_(\d)(\d)", lambda m: "power_2_" + "".join(sorted(m.groups())), text)


@pytest.mark.no_cover
@pytest.mark.parametrize("language", READ)
@pytest.mark.parametrize("name", ["so3", "se3", "sl3", "gl3", "so4", "SE(3)"])
def test_a_change_of_a_function_of_a_step_is_refused(name, language):
    text = emitted(name)[1][f"own{ENDS[language]}"]
    module = compared(name, language, text)
    found = [*mutants(text, language, module, r"step_\w+")]
    assert {x for x, *_ in found} >= {"step_momentum", "step_force", "step_end", "step_velocity"}
    passed = []
    for function, kind, place, changed in found[:: max(1, len(found) // 25)]:
        if name == "so4" and transposed(changed) == transposed(text):
            continue
        try:
            compared(name, language, changed)
        except CodeError:
            continue
        passed.append((function, kind, text.count("\n", 0, place) + 1))
    assert not passed
