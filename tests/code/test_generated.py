"""generated/ is what ``derive build`` makes now; the emitted code has the shape it should have;
what would be too large for compilers is refused before it is made, with the numbers."""

import difflib
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from derive import Gravity, Moments, Problem, derive
from derive.code.program import LoweringError
from tests.support.walks import SPECIAL

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A build under another hash seed, locale, encoding, day and working directory."""
    out = tmp_path_factory.mktemp("build")
    env = {**os.environ, "PYTHONHASHSEED": "12345", "LC_ALL": "C", "PYTHONPATH": str(ROOT)}
    env |= {"PYTHONUTF8": "0", "TZ": "Pacific/Kiritimati", "SOURCE_DATE_EPOCH": "1"}
    made = subprocess.run(
        [sys.executable, "-m", "derive", "build", "--out", str(out)],
        capture_output=True,
        text=True,
        env=env,
        cwd=out,
    )
    assert made.returncode == 0, made.stderr
    return out


def test_generated_is_current(built):
    now = {p.relative_to(built): p for p in sorted(built.rglob("*")) if p.is_file()}
    kept = {
        p.relative_to(ROOT / "generated"): p
        for p in sorted((ROOT / "generated").rglob("*"))
        if p.is_file() and "__pycache__" not in p.parts
    }
    assert set(now) == set(kept), "run: make derive"
    differences = []
    for name, path in now.items():
        old, new = (p.read_text(encoding="utf-8").splitlines() for p in (kept[name], path))
        differences += difflib.unified_diff(
            old, new, f"generated/{name}", f"now/{name}", lineterm=""
        )
    assert not differences, "run: make derive\n" + "\n".join(differences[:60])


@pytest.mark.parametrize("name", SPECIAL)
def test_sources_say_nothing_of_the_machine(name):
    for path in (ROOT / "generated" / name).iterdir():
        if path.is_file():
            text = path.read_text(encoding="utf-8")
            assert str(ROOT) not in text
            assert not re.search(r"\b20[0-9][0-9]-[01][0-9]-", text)


def operations(name):
    """Multiplications, additions and divisions of rhs, counted in the C text itself."""
    text = (ROOT / "generated" / name / f"{name}.c").read_text(encoding="utf-8")
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    body = text[text.index(f"void {name}_rhs") :]
    body = body[body.index("{") : body.index(f"void {name}_rhs_batch")]
    statements = [s.split("=", 1)[1] for s in body.split(";") if "=" in s]
    return (
        sum(s.count("*") for s in statements),
        sum(len(re.findall(r" [+-] ", s)) for s in statements),
        sum(s.count("/") for s in statements),
    )


# what a specialist writes by hand, with the constants staged: the code must not grow beyond this
LIMITS = {"so3": (57, 39, 0), "se3": (96, 75, 0), "sl3": (120, 95, 1)}


@pytest.mark.parametrize("name", SPECIAL)
def test_the_code_is_short(name):
    assert all(n <= most for n, most in zip(operations(name), LIMITS[name], strict=True))


@pytest.mark.parametrize("name", SPECIAL)
def test_the_header_counts_its_operations(name):
    text = (ROOT / "generated" / name / f"{name}.h").read_text(encoding="utf-8")
    said = re.search(r"rhs ([0-9]+) mul, ([0-9]+) add(?:, ([0-9]+) div)?;", text)
    assert tuple(int(x or 0) for x in said.groups()) == operations(name)


# ---------------------------------------------------------------- what is too large


def of(group):
    n = int(group[group.index("(") + 1 : -1])
    return derive(Problem("large", group, Moments(), [Gravity(*[0] * (n - 1), -9)]))


@pytest.mark.parametrize(("group", "entries"), [("Aff(8)", 20736), ("Sim(8)", 5476)])
def test_a_large_matrix_is_refused_at_once(group, entries):
    with pytest.raises(
        LoweringError, match=f"a matrix of {entries} entries .* compilers manage 4000"
    ):
        of(group).emit(None, ("c",), jacobian="state")


def test_too_many_operands_are_refused(monkeypatch):
    monkeypatch.setattr("derive.code.graph.OPERANDS", 500)
    with pytest.raises(LoweringError, match="more than 500 operands, too many for compilers"):
        of("Sim(3)").emit(None, ("c",))
    monkeypatch.undo()
    assert of("Sim(3)").emit(None, ("c",))


def test_a_large_matrix_by_parameters_is_refused_at_once():
    with pytest.raises(LoweringError, match="jacobian parameters is a matrix of 6480"):
        of("Aff(8)").emit(None, ("c",), jacobian="parameters")
    assert of("SE(3)").emit(None, ("c",), jacobian="parameters")
