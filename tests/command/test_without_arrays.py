"""Where NumPy and SymPy are not there, as in a browser: walks, pages, checks, symmetries and code
are the same, and what needs them says so in a line."""

import json
import os
import re
import subprocess
import sys

import pytest

from derive.command.cli import main
from derive.command.loading import ready_made

WITHOUT = """
import sys
sys.modules.update(dict.fromkeys(sys.argv[1].split()))
from derive.command.cli import main
for words in sys.argv[2].split(";"):
    if status := main(words.split()):
        sys.exit(status)
"""
MESH = 'name = "cube"\ngroup = "SO(3)"\n[body]\nsolid = "mesh"\nfile = "cube.off"\ndensity = 1\n'
FORGED = {
    "motion": ('["wedge", "𝐦", "𝐧"]', '["wedge", "𝐧", "𝐦"]'),
    "algebra": ('"sin"', '"cos"'),
    "momenta": ('["call", "T", "𝐧"]', '["call", "T", ["mul", -1, "𝐧"]]'),
}


@pytest.fixture
def said(capsys):
    def printed(*words):
        assert main([*words]) == 0
        return capsys.readouterr().out

    return printed


def joined(source):
    """Comments in one line."""
    return re.sub(r"[\s*#/]+", " ", source)


def without(*commands, code=0, folder=None, hidden="numpy sympy"):
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT, hidden, ";".join(commands)],
        cwd=folder,
        env=dict(os.environ),  # without the COLUMNS that readline puts beside it
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == code, done.stderr[-2000:]
    return done


@pytest.mark.parametrize("name", ["so3", "comet", "two_tops", "affine", "zeitlin", "ideal_fluid"])
def test_the_walk_is_the_same(name, said):
    command = f"walk {name} --format html --fragment"
    assert without(command).stdout == said(*command.split())


def test_every_ready_made_problem_has_a_walk_and_a_page(tmp_path):
    names = ready_made()
    commands = [f"walk {name} --format html --out {name}.html" for name in names]
    without(*commands, folder=tmp_path)
    assert sorted(x.stem for x in tmp_path.iterdir()) == names


@pytest.mark.parametrize(
    ("command", "hidden"),
    [
        ("so3 --lang c --lang javascript --lang python", "numpy sympy"),
        ("so3 --lang c --lang python --step gauss", "numpy sympy"),
        ("se3 --lang javascript --step gauss", "numpy sympy"),
        ("riemann_ellipsoid --lang c --step gauss --conserved", "numpy sympy"),
        ("so3 --lang c --step gauss --conserved", "numpy"),
        ("kovalevskaya_top --lang python --step gauss --conserved", "numpy"),
    ],
)
def test_code_is_the_same(said, tmp_path, command, hidden):
    without(f"emit {command} --out here", folder=tmp_path, hidden=hidden)
    said("emit", *command.split(), "--out", str(tmp_path / "there"))
    here, there = (
        {x.name: x.read_text() for x in (tmp_path / y).iterdir()} for y in ("here", "there")
    )
    assert here == there
    told = any("In this form of the state it keeps" in x for x in map(joined, here.values()))
    assert told == ("gauss" in command and "riemann" not in command)  # whose energy is an integral


@pytest.mark.parametrize("name", ["so3", "top", "comet", "riemann_ellipsoid"])
def test_symmetries_are_the_same(name, said):
    command = f"symmetries {name}"
    assert without(command).stdout == said(*command.split())


def test_checks_are_the_same(said):
    command = "check so3 se3 zeitlin --seed 1"
    assert without(command).stdout == said(*command.split())


def test_forged_records_of_the_torus_are_refused_alike(said, tmp_path, capsys):
    text = said("walk", "zeitlin", "--format", "json")
    files = []
    for label, (old, new) in FORGED.items():
        record = json.loads(text)
        (step,) = (x for x in record["steps"] if x["label"] == f"zeitlin.{label}")
        equations = json.dumps(step["equations"], ensure_ascii=False)
        assert old in equations
        step["equations"] = json.loads(equations.replace(old, new))
        files.append(str(tmp_path / f"{label}.json"))
        (tmp_path / f"{label}.json").write_text(json.dumps(record), encoding="utf-8")
    command = ["check", *files, "--seed", "1"]
    found = without(" ".join(command), code=1).stdout
    assert main(command) == 1
    assert found == capsys.readouterr().out
    failed = [x.split()[1] for x in found.splitlines() if x.startswith("FAILS")]
    assert failed == [f"zeitlin.{x}:" for x in FORGED]


def test_what_needs_arrays_is_refused_in_a_line(tmp_path):
    (tmp_path / "cube.off").write_text("OFF\n")
    (tmp_path / "cube.toml").write_text(MESH)
    needs = {
        "NumPy": ("walk cube.toml", "simulate so3 --t 1"),
        "SymPy": ("integrals so3", "emit so3 --conserved --out here"),
    }
    for library, commands in needs.items():
        for command in commands:
            line = without(command, code=2, folder=tmp_path).stderr
            assert line == f"derive: this needs {library}, which is not here\n"
    assert not (tmp_path / "here").exists()
