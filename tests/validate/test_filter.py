"""The code of an estimate with the covariance of its error, read back; no change of it passes."""

import re
from functools import cache

import numpy as np
import pytest

from derive.code.emit import emit
from derive.code.options import Options
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.programs import program
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.support.code_mutations import BODIES, COMMENTS, blank

ENDS = {"c": ".c", "python": ".py", "rust": ".rs", "javascript": ".mjs", "julia": ".jl"}
RATE = [["A_12*w", "-A_11*w", "A_11*u"], ["A_22*w", "-A_21*w", "A_21*u"], [0, 0, 0]]
WHEEL = {
    "name": "wheel",
    "group": "SE(2)",
    "parameters": {"q": 0.01},
    "kinematics": {"inputs": ["u", "w"], "rate": RATE, "noise": ["2*q", "q^2"], "error": "right"},
}


@cache
def emitted(side="right"):
    problem = problem_of(WHEEL | {"kinematics": WHEEL["kinematics"] | {"error": side}})
    record, options = walk(problem), Options()
    compiled = program(problem, record, options)
    return record, emit(compiled, record, [*ENDS], "wheel", options), compiled.numbers()


def reports(side="right", **changed):
    record, files, numbers = emitted(side)
    own = files | {f"wheel{ENDS[x]}": text for x, text in changed.items()}
    return EmittedFiles(own, "wheel", Chart(), numbers).reports(record)


@pytest.mark.parametrize("side", ["left", "right"])
def test_it_is_read_back_in_all_languages(side):
    found = reports(side)
    assert len(found) == len(ENDS)
    assert all(x.holds and x.read for x in found)
    for x in found:
        assert "rhs, " in x.text
        assert "error_generator, error_noise equal the record" in x.text


@pytest.mark.parametrize("language", ENDS)
def test_no_change_of_an_operator_passes(language):
    """Some of those of each function, spread over it."""
    _, files, _ = emitted()
    end = ENDS[language]
    text = files[f"wheel{end}"]
    names = "rhs|error_generator|error_noise"
    for body in re.finditer(BODIES[language].format(names), text, re.MULTILINE | re.DOTALL):
        code = blank(COMMENTS[language], body[2])
        places = [body.start(2) + x.start() for x in re.finditer(r"(?<=\w)(\*| [-+] )(?=\w)", code)]
        for at in places[:: max(1, len(places) // 4)]:
            k = at + (text[at] == " ")
            changed = text[:k] + {"*": "+", "+": "-", "-": "+"}[text[k]] + text[k + 1 :]
            (found,) = (x for x in reports(**{language: changed}) if x.files[-1].endswith(end))
            assert not found.holds, (body[1], text[k - 60 : k + 30])


def test_the_noise_of_the_inputs_enters_by_a_column_for_each():
    """G of a unicycle whose error is (turn, ahead, aside) on the left, whatever the state is."""
    _, files, _ = emitted("left")
    f: dict = {}
    exec(files["wheel.py"], f)
    x = np.concatenate([[0.6, -0.8, 0.8, 0.6, 2, 3], np.eye(3)[np.triu_indices(3)]])
    D = f["error_noise"](0.0, x, f["constants"]([0.01]))
    assert np.array_equal(D, [[0, 1], [1, 0], [0, 0]])
