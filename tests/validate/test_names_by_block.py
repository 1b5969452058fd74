"""The velocity of a product by the names of its blocks: in files of every language, in problem
files, in runs; the record knows nothing of it."""

import tomllib
from functools import cache

import numpy as np
import pytest

import derive
from derive.algebra.families import group
from derive.algebra.groups import names_by_block
from derive.code.emit import emit
from derive.command.cli import main
from derive.motion.first_numbers import first_numbers
from derive.motion.run import Column, Run, read
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.programs import program
from derive.record.as_json import to_json
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.support.needs import need

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
SAME = "w2_1: the same number as zeta_3; leave out one"
VARIED = ["--vary", "zeta_3=5:6"]
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


TWO = ["w2_1=1", "zeta_3=2"]


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (["trim", "--at", TWO[0], "--at", TWO[1]], SAME),
        (["simulate", "--t", "1", "--set", TWO[0], "--set", TWO[1]], SAME),
        (["simulate", "--t", "1", "--set", TWO[0], "--set", TWO[0]], "given more than once"),
        (["simulate", "--t", "1", "--state", "{}/both.toml"], SAME),
        (["simulate", "--t", "1", "--set", "w2_3=1"], "did you mean 'w2_2'?"),
        (["trim", "--at", "w2_3=1"], "did you mean 'w2_2'?"),
        (["simulate", "--t", "1", "--ensemble", "2", "--vary", "w2_1=0:1", *VARIED], SAME),
    ],
)
def test_one_number_is_given_once(command, said, tmp_path, capsys):
    (tmp_path / "pair.toml").write_text(OWN, encoding="utf-8")
    (tmp_path / "both.toml").write_text("\n".join(TWO), encoding="utf-8")
    name, *options = (x.format(tmp_path) for x in command)
    assert main([name, str(tmp_path / "pair.toml"), *options]) == 2
    assert said in capsys.readouterr().err.splitlines()[-1]


def test_a_number_of_a_file_and_what_varies_have_either_name(tmp_path):
    need("cc")
    for name, x in (("pair.toml", OWN), ("start.toml", "zeta_3 = 2")):
        (tmp_path / name).write_text(x, encoding="utf-8")
    path, out = str(tmp_path / "pair.toml"), str(tmp_path / "run.npz")
    start = ["--state", str(tmp_path / "start.toml"), "--set", "w2_1=7"]
    assert main(["simulate", path, "--t", "0.1", *start, "--out", out]) == 0
    assert read(tmp_path / "run.npz")["w2_1"][0] == 7
    many = derive.derive(path).simulate(0.01, ensemble=3, vary={"w2_1": (0, 1)}, points=2)
    assert np.array_equal(many["w2_1"][:, 0], many.varied[:, 0])
    assert len(set(many.varied[:, 0])) == 3


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
