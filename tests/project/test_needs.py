"""What a run leaves out it says, with what brings it; a C compiler is enough for all to pass."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.needs import CC, ELSEWHERE, PACKAGES, left_out, needs
from tests.support.unmeasured import environment

ROOT = Path(__file__).parents[2]


def run(path, *tests):
    """What pytest prints of these tests with that PATH.

    Warnings aside: what other runs left in the folder of temporary files would add some.
    """
    without = ["-p", "no:cacheprovider", "-p", "no:warnings"]
    command = [sys.executable, "-m", "pytest", *without, *tests]
    done = subprocess.run(
        command, cwd=ROOT, env=environment() | {"PATH": str(path)}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout
    return done.stdout.splitlines()


@needs("cc")
def test_what_is_left_out_is_said_in_one_line(tmp_path):
    """With nothing on the PATH: by a mark, in a fixture and by a call."""
    some = "(pdf and not sentence) or (runs and build) or are_found or three or browser"
    files = [f"tests/{x}.py" for x in ("project/test_docs", "views/test_notes", "views/test_html")]
    *_, said, closing = run(tmp_path, *files, "-k", some)
    number = re.fullmatch(r"1 passed, (\d+) skipped, \d+ deselected in .*", closing)[1]
    assert said.startswith(f"left out: {number} tests, which need cc (Debian: gcc")
    assert "pdflatex (Debian: texlive-" in said
    assert said.endswith("chromium (Debian: chromium)")
    *_, closing = run(
        os.environ["PATH"], "tests/project/test_docs.py::test_a_page_runs[docs/options.md]"
    )
    assert re.fullmatch(r"1 passed in .*", closing)


def test_reasons_that_no_package_mends():
    reasons = ["needs node; the module torch", "root may", "root may"]
    line = left_out([f"Skipped: {x}" for x in reasons])
    told = "node (Debian: nodejs), the module torch (pip install torch)"
    assert line == f"left out: 3 tests, which need {told}; because root may"
    assert left_out([]) == ""


def test_every_package_is_named():
    """And a name that has none is a mistake at once."""
    assert all({**PACKAGES, **ELSEWHERE}.values())
    with pytest.raises(KeyError, match=r"frobnicate: tests/support/needs.py does not say"):
        needs("frobnicate")


def test_tests_leave_themselves_out_in_one_way():
    """A name of a program in a skip of its own would have no package in the line."""
    for path in sorted((ROOT / "tests").glob("*/test_*.py")):
        text = path.read_text(encoding="utf-8")
        if path != Path(__file__):
            assert "importorskip" not in re.sub(r'importorskip\("pty"', "", text), path.name
            found = re.findall(r'(?:skipif|skip)\(.*?(?:which|find_spec|reason=f?"needs)', text)
            assert not found, (path.name, found)


@needs("make")
def test_make_test_asks_for_any_c_compiler(tmp_path):
    """And says so before it begins: there is none, then one of each name."""
    for tool in ("make", "sh", "touch", "true", "test"):
        if found := shutil.which(tool):
            (tmp_path / tool).symlink_to(found)
    for name in ("ruff", "mypy", "python"):
        (tmp_path / name).symlink_to(shutil.which("true"))
    fixed = [f"BIN={tmp_path}", "STAMP=Makefile"]

    def told():
        command = ["make", *fixed, "test"]
        here = environment() | {"PATH": str(tmp_path)}
        done = subprocess.run(command, cwd=ROOT, env=here, capture_output=True, text=True)
        return done.returncode, done.stderr

    status, said = told()
    assert status
    assert "no C compiler on the path" in said
    for name in ("cc", "gcc", "clang"):
        (tmp_path / name).symlink_to(shutil.which(CC) or shutil.which("true"))
        assert told() == (0, "")
        (tmp_path / name).unlink()
