"""The velocity of a product by the names of its blocks: in files of every language, in problem
files, in runs; the record knows nothing of it."""

import tomllib
from functools import cache

import numpy as np
import pytest

from derive.algebra.families import group
from derive.algebra.groups import names_by_block
from derive.code.emit import emit
from derive.motion.first_numbers import first_numbers
from derive.motion.run import Column, Run
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.programs import program
from derive.record.as_json import to_json
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles

OWN = """
name = "pair"
group = "SO(2) x SE(2)"

[lagrangian]
L = "(2*zeta1_1^2 + 3*zeta2_1^2 + w2_1^2 + w2_2^2)/2 - zeta1_1*w2_2/5"

[[force]]
covector = ["-zeta2_1", 0, "-w2_1", 0]

[initial]
w2_2 = 3

[[event]]
name = "slow"
when = "w2_2 - 1"
"""
RUNNING = {"zeta1_1": "zeta_1", "zeta2_1": "zeta_2", "w2_1": "zeta_3", "w2_2": "zeta_4"}
LANGUAGES = ("c", "cpp", "python", "rust", "julia", "javascript")


@cache
def emitted():
    problem = problem_of(tomllib.loads(OWN))
    record = walk(problem)
    compiled = program(problem, record)
    return emit(compiled, record, LANGUAGES, "pair"), compiled, record, problem


def test_each_has_the_name_that_its_block_has_alone():
    known = names_by_block(group("SO(2) x SE(2)"))
    assert {own: x for x, own in known.items()} == RUNNING
    assert names_by_block(group("SE(3)")) == {}


def test_a_file_may_say_them_and_the_record_is_the_same():
    text = OWN
    for own, name in RUNNING.items():
        text = text.replace(own, name)
    other = problem_of(tomllib.loads(text))
    assert to_json(walk(other)) == to_json(emitted()[2])
    assert (other.initial, other.events) == (emitted()[3].initial, emitted()[3].events)


def test_one_number_has_one_start():
    with pytest.raises(ProblemError, match="w2_2: the same number as zeta_4"):
        problem_of(tomllib.loads(OWN.replace("w2_2 = 3", "zeta_4 = 1\nw2_2 = 3")))


def test_a_start_and_a_column_are_found_by_them():
    _, compiled, _, problem = emitted()
    found = first_numbers(compiled, problem, {"zeta2_1": 0.25})
    assert found.x[compiled.state.index("zeta_2")] == 0.25
    assert found.x[compiled.state.index("zeta_4")] == 3
    columns = tuple(Column(x, "state", "") for x in compiled.state)
    table = [[float(k) for k in range(len(columns))]]
    run = Run(columns, np.array(table), {"by_block": compiled.by_block})
    assert all(run[own] == run[name] for own, name in RUNNING.items())


def test_every_language_lists_them():
    files = emitted()[0]
    assert "pair_X_w2_1 = pair_X_zeta_3," in files["pair.h"]
    for end in (".hpp", ".py", ".rs", ".jl", ".mjs"):
        words = " ".join(files[f"pair{end}"].split())
        assert '"zeta1_1", "zeta2_1", "w2_1", "w2_2",' in words, end


@pytest.mark.parametrize("end", [".h", ".py", ".rs", ".jl", ".mjs"])
def test_they_are_read_back_and_exchanged_ones_are_seen(end):
    files, compiled, record, _ = emitted()
    old = f"pair{end}"
    other = files[old].replace("w2_1", "@@").replace("w2_2", "w2_1").replace("@@", "w2_2")
    for text, good in ((files[old], True), (other, False)):
        given = EmittedFiles({**files, old: text}, "pair", Chart(), compiled.numbers())
        said = [*given.reports(record)]
        assert all(x.holds for x in said) == good, [x.text for x in said]
        assert good or "the names of state_by_block are not" in " ".join(x.text for x in said)
