"""What a person at a terminal sees: weight, a pager, that work goes on."""

import os
import re
import subprocess
import sys
import time

import pytest

from derive.command import terminal
from derive.command.cli import main
from derive.views.printing.line_breaking import display_width
from tests.support.terminals import read_to_end

pty = pytest.importorskip("pty", reason="this system has no pty")
ESCAPES = re.compile(r"\x1b\[[0-9;]*m")


def seen(*command, cwd, **environment):
    """What a terminal of 24 lines and 80 columns gets on stdout."""
    ours, theirs = pty.openpty()
    pty_size(theirs, 24, 80)
    own = {x: y for x, y in os.environ.items() if x not in ("COLUMNS", "LINES", "NO_COLOR")}
    own |= {"TERM": "xterm", "PAGER": "cat", **environment}
    command = [sys.executable, "-m", "derive", *command]
    run = subprocess.Popen(command, cwd=cwd, stdin=theirs, stdout=theirs, env=own)
    os.close(theirs)
    shown = read_to_end(ours)
    assert run.wait() == 0
    return shown.replace("\r\n", "\n")


def pty_size(terminal, lines, columns):
    import fcntl
    import struct
    import termios

    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", lines, columns, 0, 0))


def test_weight_where_there_is_a_terminal(tmp_path):
    """Labels and equations; without their escapes the text is that of a file."""
    shown = seen("walk", "top", "kernel", cwd=tmp_path)
    assert f"{terminal.BLUE}top.kernel{terminal.PLAIN}" in shown
    assert terminal.BOLD in shown
    plain = seen("walk", "top", "kernel", cwd=tmp_path, NO_COLOR="1")
    assert ESCAPES.sub("", shown) == plain
    assert "\x1b" not in plain
    assert 40 < max(map(display_width, plain.splitlines())) <= 80
    assert "top.kernel  ·" in plain
    assert "\x1b" not in seen("walk", "top", "kernel", cwd=tmp_path, TERM="dumb")


def test_a_pager_for_what_is_longer_than_the_screen(tmp_path):
    mark = "sed -e '1s/^/paged /'"
    assert seen("walk", "so3", cwd=tmp_path, PAGER=mark, NO_COLOR="1").startswith("paged ")
    short = seen("walk", "so3", "kernel", cwd=tmp_path, PAGER=mark, NO_COLOR="1")
    assert short.startswith("so3.kernel")
    answer = seen("walk", "saff3", "--answer", cwd=tmp_path, PAGER=mark, NO_COLOR="1")
    assert answer.count("\n") > 24
    assert not answer.startswith("paged ")


def test_derive_alone_prints_help(capfd):
    done = subprocess.run([sys.executable, "-m", "derive"], capture_output=True, text=True)
    assert done.returncode == 0
    assert "walk" in done.stdout
    assert "simulate" in done.stdout


class Screen:
    """A stderr that is a terminal."""

    def __init__(self):
        self.text = ""

    def isatty(self):
        return True

    def write(self, text):
        self.text += text

    def flush(self):
        pass


def test_work_that_takes_long_is_told_and_wiped(monkeypatch):
    screen = Screen()
    monkeypatch.setattr(sys, "stderr", screen)
    monkeypatch.setattr(terminal, "PATIENCE", 0.001)
    with terminal.working("top"):
        while "top: 0 s" not in screen.text:
            time.sleep(0.001)
    assert screen.text.endswith(" " * len("top: 0 s") + "\r")


def test_short_work_says_nothing(monkeypatch):
    screen = Screen()
    monkeypatch.setattr(sys, "stderr", screen)
    with terminal.working("top"):
        pass
    assert screen.text == ""


def test_what_a_run_says_is_as_wide_as_what_shows_it(tmp_path, monkeypatch, capsys):
    """Of a terminal, or of COLUMNS, also where another program reads; else lines are whole."""
    words = ["simulate", "top", "--t", "0.01"]
    for columns in ("", "72"):
        monkeypatch.setenv("COLUMNS", columns)
        assert main(words) == 0
        widest = max(map(len, capsys.readouterr().out.splitlines()))
        assert (widest <= 72) == bool(columns)
    assert max(map(len, seen(*words, cwd=tmp_path).splitlines())) <= 80
