"""What is wrong in a file of one's own: one line that names the file, the key, the remedy; so of
options, claims, records, C; names of [initial] and [[event]] that the state has not are told with
the walk."""

import os
import re
import tomllib
from functools import cache
from pathlib import Path

import pytest

from derive.code.emit import emit
from derive.command.cli import main
from derive.command.showing import ready_made
from derive.pipeline import walk
from derive.problem.motion_tables import faults, numbers_followed
from derive.problem.problem import ProblemError
from derive.problem.toml import load, problem_of
from derive.programs import program
from derive.validate.read_file import read
from derive.validate.terms import CodeError
from tests.corpus import problems, table
from tests.problems import READY, moving
from tests.support.walks import own_verdicts, problem, record

NAME = "bad.toml"
NEGATIVE = "is negative; correct it, or allow it with --allow-negative-"
WALK, EMIT = ["walk", NAME, "--out", "walk.txt"], ["emit", NAME, "--out", "out"]


@pytest.mark.parametrize(
    ("text", "data", "words"), [pytest.param(*x, id=x[-1][0]) for x in problems("refused")]
)
def test_it_is_refused_in_one_line(text, data, words, tmp_path, monkeypatch, capsys):
    """By a walk, which writes nothing (tests/fuzz/corpus.py emits them); and in Python in the same
    words."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / NAME).write_bytes(text.encode("utf-8"))
    assert main(WALK) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"derive: {NAME}: ")
    assert err.count("\n") == 1
    assert err[:-1].isprintable()
    assert [x for x in words if x not in err] == []
    assert os.listdir() == [NAME]
    if data is not None:
        with pytest.raises(ProblemError) as told:
            walk(problem_of(data))
        assert str(told.value) in err


@pytest.mark.parametrize(("text", "data", "words"), [*problems("taken")])
def test_it_is_taken(text, data, words, tmp_path, monkeypatch, capsys):
    """However odd."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / NAME).write_bytes(text.encode("utf-8"))
    assert main(WALK) == 0, capsys.readouterr().err


@pytest.mark.parametrize(
    "text", ['title = "« a “b” »"\nm = = 1\n', "at = [1,5\n", 'a = 3 "b"\n', "m = 1.5.2\n"]
)
def test_what_is_not_known_is_not_guessed(text, tmp_path):
    (tmp_path / NAME).write_text(text, encoding="utf-8")
    with pytest.raises(ProblemError) as told:
        load(tmp_path / NAME)
    assert not re.search("curly|comma: |stands in quotes", str(told.value))


def test_too_many_parameters():
    data = table("problems")["base"]["two"]
    with pytest.raises(ProblemError, match="'parameters': more than"):
        problem_of(data | {"parameters": {f"k{i}": 1 for i in range(5000)}})


ALLOWED = re.compile(r"(.*) is negative; .* allow it with (\S+) \(in Python: (\w+)=True\)")
MADE_NEGATIVE = [x for x, _, words in problems("refused") if NEGATIVE in words[0]]


@pytest.mark.parametrize("text", MADE_NEGATIVE, ids=range(len(MADE_NEGATIVE)))
def test_what_may_be_negative_is_taken_with_a_warning(text, tmp_path, monkeypatch, capsys):
    """Where the refusal says how it is allowed; in Python too."""
    monkeypatch.chdir(tmp_path)
    Path(NAME).write_text(text, encoding="utf-8")
    assert main(WALK) == 2
    what, option, word = ALLOWED.match(capsys.readouterr().err.removeprefix("derive: ")).groups()
    for command in (WALK, EMIT):
        assert main([*command, option]) == 0
        assert f"derive: warning: {what} is negative\n" in capsys.readouterr().err
    record = walk(problem_of(tomllib.loads(text), **{word: True}))
    assert all(v.holds for v in own_verdicts(record))


FILE = f"""{moving.SPIN}[[input]]
name = "u"
kind = "covector"
[initial]
zeta_3 = "w"
"""
ENTRIES = "it has A_11 … A_33, zeta_1 … zeta_3, u_1 … u_3"


@pytest.fixture
def told(tmp_path, capsys):
    """The exit code and stderr of a command on a text."""

    def done(text, command, *options):
        path = tmp_path / "p.toml"
        path.write_text(text)
        code = main([command, str(path), *options])
        return code, capsys.readouterr().err.replace(str(path), "p.toml")

    return done


@pytest.mark.parametrize(
    "name", [x for x in ready_made() if x != "imu" and problem(x).group is not None]
)
def test_they_are_those_of_the_emitted_code(name):
    problem = load(READY / f"{name}.toml")
    assert problem.group is not None
    emitted = program(problem, walk(problem))
    assert {*numbers_followed(problem, problem.group)} == {*emitted.state, *emitted.inputs}
    assert [*faults(problem)] == []


@pytest.mark.parametrize(
    ("form", "when"),
    [(["--attitude", "quaternion"], "q_2 - w"), (["--velocity", "tangent"], "A_12_dot - w")],
)
def test_names_of_another_form_of_the_state_are_not_told(told, tmp_path, form, when):
    text = f'{FILE}[[event]]\nname = "e"\nwhen = "{when}"\n'
    emit = ("emit", "--lang", "c", "--step", "gauss", "--out", str(tmp_path))
    assert told(text, *emit, *form) == (0, "")
    assert told(text, *emit)[0] == 2


@pytest.mark.parametrize("command", [["walk"], ["emit", "--out"]])
@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[[event]]\nname = "e"\nwhen = "A_44 - w"\n', "event 1, when: the state has no A_44"),
        (
            '[[event]]\nname = "e"\nwhen = "u_4*t"\n',
            "event 1, when: the state has no u_4; did you mean 'u_3'?",
        ),
        (
            "omega_3 = 1\n",
            "initial, omega_3: the state has no such number; did you mean 'zeta_3'?",
        ),
    ],
)
def test_a_command_that_derives_tells_them(told, tmp_path, command, text, words):
    folder = [str(tmp_path)] * (command[-1] == "--out")
    code, err = told(FILE + text, *command, *folder)
    assert (code, err) == (0, f"derive: warning: p.toml: {words}; {ENTRIES}\n")


def test_a_motion_refuses_them_in_one_line(told):
    code, err = told(f'{FILE}[[event]]\nname = "e"\nwhen = "A_44"\n', "simulate", "--t", "1")
    assert (code, err.count("\n")) == (2, 1)
    assert "event e: no 'A_44' in the state" in err


@pytest.mark.parametrize("when", ["A_33 - w", "zeta_1*u_2", "t - 1", "sin(pi*A_11)"])
def test_what_the_state_has_is_not_told(told, when):
    assert told(f'{FILE}[[event]]\nname = "e"\nwhen = "{when}"\n', "walk") == (0, "")


@cache
def so3():
    compiled = program(problem("so3"), record("so3"))
    return emit(compiled, record("so3"), ("c", "python"), "so3")


IN_C = [
    ("#include <math.h>", "#include <math.h>\ntypedef int whole;", "'typedef'"),
    ("#include <math.h>", "#include <math.h>\nconst double table[] = {1.0};", "'const'"),
    ("#include <math.h>", "#include <math.h>\nenum { other };", "'other'"),
    ("#include <math.h>", "#include <math.h>\nenum { other = 0x10 };", "'other'"),
    ("#include <math.h>", "#include <math.h>\nenum { other = 'a' };", "'other'"),
    ("#include <math.h>", "#include <math.h>\n#if 1\n", "the directive"),
    ("#include <math.h>", "#include <math.h>\n#ifdef __cplusplus\n", "the directive"),
    ("#include <math.h>", "#include <math.h>\n#error no\n", "the directive"),
    ("const double I_11 =", "const long I_11 =", "'const'"),
    ("const double I_11 =", "const unsigned long I_11 =", "'const'"),
    ("const double I_11 =", "const double *I_11 =", "'.' is not"),
    ("    k[0] = J_12;\n", "    for (;;) k[0] = J_12;\n", "';'"),
    ("    k[0] = J_12;\n", "    if (k) k[0] = J_12;\n", "'.' is not"),
    ("    k[0] = J_12;\n", "    k[p] = J_12;\n", "'p'"),
    ("    k[0] = J_12;\n", "    J_12 = 1.0;\n", "'J_12'"),
    ("    k[0] = J_12;\n", "    return;\n", "';'"),
    ("double so3_energy(", "double so3_other(", "not known here"),
    ("    k[0] = J_12;\n", "    k[0] = J_12\n#ifndef __GNUC__\n+ 1.0\n#endif\n;", "the directive"),
    ("    k[0] = J_12;\n", "    k[0] = J_12 // see\r + 1.0\n;", "'.r' is not read"),
    ("    k[0] = J_12;\n", "    k[0] = J_12 + (50000*50000 - 2500000000.0);\n", "integers"),
    ("    k[0] = J_12;\n", "    k[0*0] = J_12;\n", "a product of integers"),
    ("    k[0] = J_12;\n", "    static const double a = 1.0;\n    k[0] = a;\n", "'static'"),
    ("#include <math.h>", "#include <math.h>\n#pragma redefine_extname sqrt cbrt", "directive"),
    ("#include <math.h>", "#include <math.h>\n#define y_H\n", "the directive"),
    ("#include <math.h>", "#include <math.h>\nint so3_constants();\n", "other arguments"),
    ('    "A_11",', '    [0] = "A_11",', "'='"),
    ('    "A_11",', "    A_11,", "','"),
    ("1.0/I_d_3", "sqrt()/I_d_3", "'.' is not"),
    ("u[0*n + s]", "n*1.0", "n stands"),
]


@pytest.mark.parametrize(("old", "new", "reason"), IN_C, ids=[x[1] for x in IN_C])
def test_c_that_is_not_read(old, new, reason):
    text = so3()["so3.c"]
    assert old in text
    with pytest.raises(CodeError, match=reason):
        read("so3.c", {**so3(), "so3.c": text.replace(old, new, 1)}, "so3")


def test_a_function_of_c_that_stands_twice():
    text = so3()["so3.c"]
    start = text.index("double so3_energy(")
    with pytest.raises(CodeError, match="defined twice"):
        read("so3.c", {**so3(), "so3.c": text + text[start:]}, "so3")
