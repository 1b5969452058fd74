"""Standard output that is not UTF-8: what it lacks is said, and no file of a format is spoilt."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from derive.views.rendering import FORMATS
from tests.support.unmeasured import environment

WALK = ("walk", "so3")
ASCII = {"LC_ALL": "C", "LANG": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}


def run(*arguments, folder, **variables):
    """The bytes of stdout, and the lines of stderr; the exit code is 0."""
    here = {k: v for k, v in environment().items() if not k.startswith(("LC_", "PYTHONIO"))}
    command = [sys.executable, "-m", "derive", *arguments]
    done = subprocess.run(command, cwd=folder, env=here | variables, capture_output=True)
    assert done.returncode == 0, done.stderr
    return done.stdout, done.stderr.decode("utf-8").splitlines()


@pytest.fixture(scope="module")
def utf8(tmp_path_factory):
    """The walk in UTF-8, of which nothing is said."""
    folder = tmp_path_factory.mktemp("utf8")
    text, told = run(*WALK, folder=folder, PYTHONIOENCODING="utf-8")
    assert told == []
    return text.decode("utf-8")


@pytest.mark.parametrize(
    ("codec", "variables"),
    [
        ("latin-1", {"PYTHONIOENCODING": "latin-1"}),
        ("cp1252", {"PYTHONIOENCODING": "cp1252"}),
        ("ascii", {"PYTHONIOENCODING": "ascii"}),
        ("ascii", ASCII),
    ],
)
def test_letters_that_are_lost_are_said_once(codec, variables, utf8, tmp_path):
    text, told = run(*WALK, folder=tmp_path, **variables)
    assert text == utf8.encode(codec, errors="replace")
    lacks = {x for x in utf8 if x.encode(codec, errors="ignore") == b""}
    assert len(told) == 1
    assert f"lacks {len(lacks)} letters, shown as ?" in told[0]
    assert "PYTHONIOENCODING=utf-8" in told[0]
    assert told[0].isascii()


@pytest.mark.parametrize("form", [x for x in FORMATS if x != "text"])
def test_formats_that_are_files_stay_utf8(form, tmp_path):
    """Through a pipe they are what --out writes: a record with ? in it would be another one."""
    out = tmp_path / "walk"
    assert run(*WALK, "--format", form, "--out", str(out), folder=tmp_path, **ASCII) == (b"", [])
    text, told = run(*WALK, "--format", form, folder=tmp_path, **ASCII)
    assert text.rstrip(b"\n") == out.read_bytes().rstrip(b"\n")
    assert "ζ" in text.decode("utf-8") or form in ("latex", "markdown")
    assert told == []
    if form == "json":
        assert json.loads(text)["problem"]["name"] == "so3"


def test_nothing_is_said_where_nothing_is_lost(tmp_path):
    assert run("list", "--help", folder=tmp_path, **ASCII)[1] == []
    _, told = run(*WALK, "--out", "walk.txt", folder=tmp_path, **ASCII)
    assert told == []
    assert "ζ" in Path(tmp_path / "walk.txt").read_text(encoding="utf-8")
