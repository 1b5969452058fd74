"""The line about how far a command is: on a terminal only, and gone in the end."""

import os
import re
import subprocess
import sys

import pytest

from tests.support.terminals import read_to_end

pty = pytest.importorskip("pty", reason="this system has no pty")


def on_a_terminal(*command, cwd):
    """The exit code, stdout, and what a terminal gets on stderr."""
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "derive", *map(str, command)]
    run = subprocess.Popen(command, cwd=cwd, stdout=subprocess.PIPE, stderr=theirs, text=True)
    os.close(theirs)
    shown = read_to_end(ours)
    out = run.communicate()[0]
    return run.returncode, out, shown


def screen(shown):
    """The lines that are left when each return has been to the start of the line."""
    lines = []
    for line in shown.replace("\r\n", "\n").split("\n"):
        row = ""
        for part in line.split("\r"):
            row = part + row[len(part) :]
        lines.append(row.rstrip())
    return [x for x in lines if x]


COMMANDS = {
    "build": (["build", "--out", "out"], "problems: 2 of 3"),
    "check": (["check", "so3"], "so3: 3 of "),
    "notes": (["notes", "linear", "so3", "--out", "n.html"], "walks: 1 of 2"),
    "paper": (["paper"], "equations: 10 of 39"),
}


@pytest.mark.parametrize("name", COMMANDS)
def test_it_counts_on_a_terminal(name, tmp_path):
    command, line = COMMANDS[name]
    status, out, shown = on_a_terminal(*command, cwd=tmp_path)
    assert status == 0
    assert line in shown
    assert not re.search(r"\d of \d.*\r", out)
    left = screen(shown)
    assert not any(" of " in x for x in left)
    assert all(x.startswith("out") for x in left) if name == "build" else not left


def test_an_error_has_a_line_of_its_own(tmp_path):
    (tmp_path / "bad.toml").write_text("name = 1")
    status, _, shown = on_a_terminal("notes", "so3", "bad.toml", "--out", "n.html", cwd=tmp_path)
    assert status == 2
    assert len(screen(shown)) == 1
    assert screen(shown)[0].startswith("derive: bad.toml")


def test_nothing_elsewhere(tmp_path):
    command = [sys.executable, "-m", "derive", "notes", "so3", "--out", "n.html"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.stderr == ""
    assert done.stdout == "n.html\n"
