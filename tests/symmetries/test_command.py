"""The command: formats, steps, what is refused in one line."""

import subprocess
import sys

import pytest

from derive.command.cli import main
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.python.derived import derive

SPIRAL = [[0, -1, 0], [1, 0, 0], [0, 0, 2]]
CUBIC = [[0, 0, 2], [1, 0, 0], [0, 1, 0]]


def said(capsys, *words, code=0):
    assert main(["symmetries", *words]) == code
    return capsys.readouterr()


def test_it_prints_the_symmetries_alone(capsys):
    words = said(capsys, "top").out
    assert words.startswith("top.symmetries")
    assert words.count("By a symmetry") == 3
    assert "trois" not in words


def test_it_speaks_french(capsys):
    words = said(capsys, "top", "--lang", "fr").out
    assert words.count("Par une symétrie") == 3


def test_a_step_alone(capsys):
    words = said(capsys, "top", "momenta").out
    assert words.startswith("top.momenta")
    assert "symmetries" not in words


@pytest.mark.parametrize("form", ["latex", "markdown", "html", "json"])
def test_formats(capsys, tmp_path, form):
    file = tmp_path / "out"
    said(capsys, "top", "--format", form, "--out", str(file))
    assert "top.conserved_3" in file.read_text(encoding="utf-8").replace("\\_", "_")


def test_a_record_is_checked(capsys, tmp_path):
    file = tmp_path / "top.json"
    said(capsys, "top", "--format", "json", "--out", str(file))
    assert main(["check", str(file)]) == 0


def stated(basis, L="zeta_1^2/2"):
    group = {"name": "Own", "action": "linear", "basis": [basis]}
    return problem_of({"name": "own", "group": group, "lagrangian": {"L": L}})


def test_a_spiral_has_exact_elements():
    """A turn about an axis and a stretch along it: the metric of one coordinate is flat, but its
    boost is no polynomial in the entries of g."""
    found = derive(stated(SPIRAL)).symmetries()
    assert [x.kind for x in found] == ["time", "deformation_space"]
    assert all(v.holds for v in found.check(1))


def test_a_group_without_exact_elements_is_refused():
    with pytest.raises(ProblemError, match="no exact elements"):
        derive(stated(CUBIC)).symmetries()


def test_the_walk_imports_neither_sympy_nor_what_finds_symmetries():
    code = (
        "import sys; from derive.command.cli import main; main(['walk', 'so3']); "
        "sys.exit(any(x.startswith(('sympy', 'derive.symmetries')) for x in sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, cwd=".")
    assert done.returncode == 0


def test_symmetries_import_no_sympy():
    code = (
        "import sys; from derive.command.cli import main; main(['symmetries', 'so3']); "
        "sys.exit('sympy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True).returncode == 0
