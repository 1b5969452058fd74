"""Where NumPy and SymPy are not there, as in a browser: walks, pages, checks, symmetries and code
are the same, and what needs them says so in a line."""

import json
import os
import re
import subprocess
import sys
from types import SimpleNamespace

import pytest

from derive.command.cli import main
from derive.command.showing import ready_made
from tests.problems import READY

WITHOUT = """
import sys
sys.modules.update(dict.fromkeys(sys.argv[1].split()))
from derive.command.cli import main
print([main(words.split()) for words in sys.argv[2].split(";")], file=sys.stderr)
"""
"""Commands, and their exit codes at last."""
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


def without(*commands, code=None, folder=None, hidden="numpy sympy"):
    """What a process prints in which modules are hidden, and ends with the exit codes."""
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT, hidden, ";".join(commands)],
        cwd=folder,
        env=dict(os.environ),  # without the COLUMNS that readline puts beside it
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == 0, done.stderr[-2000:]
    *said, codes = done.stderr.splitlines(keepends=True)
    assert json.loads(codes) == (code or [0] * len(commands)), done.stderr[-2000:]
    return SimpleNamespace(stdout=done.stdout, stderr="".join(said))


PARTS = 5
"""All walks in so many processes."""


@pytest.mark.parametrize("part", range(PARTS))
def test_walks_are_the_same(part, said, tmp_path):
    names = ready_made()[part::PARTS]
    shown = "--format html --fragment"
    without(*(f"walk {x} {shown} --out {x}.html" for x in names), folder=tmp_path)
    for name in names:
        found = (tmp_path / f"{name}.html").read_text(encoding="utf-8")
        assert found == said("walk", name, *shown.split()), name


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


@pytest.mark.parametrize("names", [("so3", "top", "comet"), ("riemann_ellipsoid",)], ids=str)
def test_symmetries_are_the_same(names, said):
    found = without(*(f"symmetries {x}" for x in names)).stdout
    assert found == "".join(said("symmetries", x) for x in names)


def test_checks_are_the_same(said, tmp_path, capsys):
    """Of points, and of a torus of 5, three steps of which are forged and refused, no other."""
    small = tmp_path / "zeitlin.toml"
    whole = (READY / small.name).read_text(encoding="utf-8")
    small.write_text(whole.replace("N = 31", "N = 5"), encoding="utf-8")
    record = json.loads(said("walk", str(small), "--format", "json"))
    for label, (old, new) in FORGED.items():
        (step,) = (x for x in record["steps"] if x["label"] == f"zeitlin.{label}")
        equations = json.dumps(step["equations"], ensure_ascii=False)
        assert old in equations
        step["equations"] = json.loads(equations.replace(old, new))
    file = tmp_path / "forged.json"
    file.write_text(json.dumps(record), encoding="utf-8")
    command = ["check", "se3", str(file), "--seed", "1"]
    found = without(" ".join(command), code=[1]).stdout
    assert main(command) == 1
    assert found == capsys.readouterr().out
    failed = [x.split()[1] for x in found.splitlines() if x.startswith("FAILS")]
    assert sorted(failed) == sorted(f"zeitlin.{x}:" for x in FORGED)


def test_what_needs_arrays_is_refused_in_a_line(tmp_path):
    (tmp_path / "cube.off").write_text("OFF\n")
    (tmp_path / "cube.toml").write_text(MESH)
    needs = {
        "walk cube.toml": "NumPy",
        "simulate so3 --t 1": "NumPy",
        "integrals so3": "SymPy",
        "emit so3 --conserved --out here": "SymPy",
    }
    lines = without(*needs, code=[2] * len(needs), folder=tmp_path).stderr.splitlines()
    assert lines == [f"derive: this needs {x}, which is not here" for x in needs.values()]
    assert not (tmp_path / "here").exists()
