"""Emitted files say what they were made by, and --check asks for nothing more."""

import itertools
import re

import pytest

from derive import SE, Gravity, Points, Problem, derive
from derive.code.languages import LANGUAGES
from derive.code.options import CHOICES, REPEATED, Options
from derive.code.requests import EmissionRequest, request_of
from derive.command.cli import main
from tests.fuzz.mutate import toml

MASSES = ((3, [1, 0, 0]), (2, [0, 1, 1]), (2, [0, 0, -1]), ("-1/2", [0, 0, 1]))
REPELLED = {"kind": "spring", "at": [1, 0, 0], "anchor": [0, 0, 0], "stiffness": -2, "length": 0}
NEGATIVE = {"name": "bubble", "group": "SE(3)", "potential": [REPELLED]}
NEGATIVE["point"] = [{"mass": m, "at": at} for m, at in MASSES]
ASKED = (
    [],
    ["--lang", "c"],
    ["--lang", "rust", "--real", "float"],
    ["--lang", "c", "--form", "header", "--lang", "cpp", "--prefix", "boat"],
    ["--lang", "julia", "--attitude", "quaternion", "--jacobian", "state"],
    ["--velocity", "tangent", "--layout", "col", "--jacobian", "state", "--jacobian", "parameters"],
    ["--lang", "cvode", "--frame", "principal", "--lang", "python", "--jacobian", "inputs"],
)


def emitted(folder, *words):
    assert main(["emit", "so3", "--out", str(folder), *words]) == 0


def check(folder, *words, problem="so3"):
    return main(["emit", problem, "--check", "--out", str(folder), *words])


@pytest.mark.parametrize("asked", ASKED, ids=" ".join)
def test_a_check_needs_no_options(asked, tmp_path):
    emitted(tmp_path, *asked)
    assert check(tmp_path) == check(tmp_path, *asked) == 0


@pytest.mark.parametrize("asked", ASKED[1:], ids=" ".join)
def test_an_option_that_is_given_is_compared(asked, tmp_path, capsys):
    emitted(tmp_path, *asked)
    other = ["--real", "double" if "float" in asked else "float"]
    assert check(tmp_path, *other) == 1
    said = capsys.readouterr().out
    assert "not current" in said
    assert " ".join(other) in said


def test_the_remedy_that_is_said_helps(tmp_path, capsys):
    """And the line that is said is the first one that was changed."""
    emitted(tmp_path, *ASKED[5])
    header = tmp_path / "so3.h"
    before, changed, rest = header.read_text().partition("enum {")
    header.write_text(f"{before} {changed}{rest}")
    capsys.readouterr()
    assert check(tmp_path) == 1
    said = capsys.readouterr().out
    line = before.count("\n") + 1
    assert f"so3.h: not current from line {line} on" in said
    command = re.search(r"run: derive (.*)", said)[1]
    assert main(command.split()) == check(tmp_path) == 0


def test_files_of_several_emissions_are_each_held_to_their_own(tmp_path, capsys):
    emitted(tmp_path, "--lang", "c", "--jacobian", "state")
    emitted(tmp_path, "--lang", "rust", "--real", "float")
    emitted(tmp_path, "--lang", "python", "--prefix", "other", "--velocity", "tangent")
    assert check(tmp_path) == 0
    for name in ("so3.c", "so3.rs", "other.py"):
        path, text = tmp_path / name, (tmp_path / name).read_text()
        path.write_text(text + " ")
        capsys.readouterr()
        assert check(tmp_path) == 1
        assert capsys.readouterr().out.count("\n") == 1
        path.write_text(text)


@pytest.mark.parametrize("name", ["so3.h", "so3.c", "so3.py"])
def test_what_is_missing_is_missed(name, tmp_path, capsys):
    emitted(tmp_path, "--jacobian", "state")
    (tmp_path / name).unlink()
    assert check(tmp_path) == 1
    assert f"{name}: missing" in capsys.readouterr().out


def test_a_language_that_is_asked_for_is_missed(tmp_path, capsys):
    emitted(tmp_path, "--jacobian", "state")
    assert check(tmp_path, "--lang", "c") == 0
    assert check(tmp_path, "--lang", "rust") == 1
    assert "so3.rs: missing" in capsys.readouterr().out
    assert check(tmp_path, "--prefix", "boat") == 1


@pytest.mark.parametrize("lang", ["c", "cpp", "python"])
def test_one_language_of_several_is_held_to_the_same(lang, tmp_path, capsys):
    """Also C that is there because C++ includes it, and a form that a language does not know."""
    emitted(tmp_path, "--lang", "cpp", "--lang", "python", "--form", "header")
    assert check(tmp_path, "--lang", lang) == 0
    for path in tmp_path.iterdir():
        path.write_text(path.read_text() + " ")
    capsys.readouterr()
    assert check(tmp_path, "--lang", lang) == 1
    said = capsys.readouterr().out
    assert ("so3.py" in said) == (lang == "python")
    assert ("so3.h:" in said) == (lang != "python")


def test_a_check_of_an_empty_folder(tmp_path, capsys):
    assert check(tmp_path / "none") == 1
    assert capsys.readouterr().out.count("missing") == 3


def test_other_problems_of_a_folder_are_left_alone(tmp_path):
    emitted(tmp_path, "--jacobian", "state")
    assert main(["emit", "screw", "--out", str(tmp_path), "--real", "float"]) == 0
    (tmp_path / "screw.c").write_text("")
    assert check(tmp_path) == 0
    assert check(tmp_path, problem="screw") == 1


def test_what_may_be_negative_is_stated(tmp_path):
    file = tmp_path / "bubble.toml"
    file.write_text(toml(NEGATIVE))
    allowed = ["--allow-negative-mass", "--allow-negative-stiffness"]
    assert main(["emit", str(file), "--out", str(tmp_path), *allowed]) == 0
    assert request_of((tmp_path / "bubble.h").read_text()).allowed == ("mass", "stiffness")
    assert check(tmp_path, problem=str(file)) == 0


def test_python_states_the_same(tmp_path):
    emitted(tmp_path, "--real", "float", "--jacobian", "state")
    made = derive("so3").emit(None, real="float", jacobian="state")
    assert made == {x: (tmp_path / x).read_text() for x in made}


@pytest.mark.parametrize("values", [*itertools.product(*(x[0] for x in CHOICES.values()))])
def test_what_is_stated_is_read_back(values):
    for jacobian in ((), REPEATED["jacobian"][0]):
        for allowed in ((), ("mass",), ("mass", "stiffness")):
            options = Options(**dict(zip(CHOICES, values, strict=True)), jacobian=jacobian)
            e = EmissionRequest("boat", "a_long_prefix", (*LANGUAGES,), options, allowed)
            lines = [
                "Generated by derive 1 from problem 2; do not edit.",
                *e.option_lines,
                "",
                "A is 3",
            ]
            assert max(map(len, lines)) < 96
            for mark in ("", " * ", "// ", "# "):
                text = "\n".join(mark + x for x in ["/* Options: so3 --lang c", *lines])
                assert request_of(text) == e


@pytest.mark.parametrize(
    ("old", "new"), [("--real double", "--real half"), ("--lang c", "--lang d"), ("--form", "--x")]
)
def test_what_is_no_statement_is_none(old, new):
    e = EmissionRequest("boat", "boat", ("c",))
    text = "\n".join(["Generated; do not edit.", *e.option_lines])
    assert request_of(text) == e
    assert request_of(text.replace(old, new)) is None


def test_a_title_states_nothing(tmp_path):
    """It stands before the statement, in a line of its own."""
    title = "; do not edit. Options: so3 --lang c --prefix x --real float"
    points = Points(*[(1, x) for x in ([1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1])])
    files = derive(Problem("boat", SE(3), points, [Gravity(0, 0, -1)], title=title)).emit()
    assert {request_of(x).prefix for x in files.values()} == {"boat"}
