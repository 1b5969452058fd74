"""What a person sees: at a terminal weight, a pager, how far a command is; where standard output is
not UTF-8, what it lacks."""

import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

from derive.command import cli, writing
from derive.command.arguments import parser
from derive.command.cli import main
from derive.views.printing.typeset import display_width
from derive.views.rendering import FORMATS
from tests.support.processes import environment

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
    assert f"{writing.BLUE}top.kernel{writing.PLAIN}" in shown
    assert writing.BOLD in shown
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


def test_the_check_of_a_terminal_is_short_and_that_of_a_pipe_whole(tmp_path, capsys):
    told = ("check", "euler_poisson", "--seed", "1")
    assert main([*told]) == 0
    whole = capsys.readouterr().out.splitlines()
    shown = [x.split("\r")[-1] for x in seen(*told, cwd=tmp_path).split("\n")]
    steps = [int(x.split(": ")[1].split()[0]) for x in shown if " at exact points of " in x]
    assert sum(steps) == sum(" on " in x and "symbol" not in x for x in whole) > 20
    assert len(shown) < 12
    assert {*whole[-2:]} <= {*shown}
    every = seen(*told, "--verbose", cwd=tmp_path)
    assert [x.split("\r")[-1] for x in every.splitlines()] == whole


def test_the_help_of_all_commands_fits_the_smallest_terminal(monkeypatch, capfd):
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit):
        main(["--help"])
    lines = capfd.readouterr().out.splitlines()
    assert len(lines) <= 24
    assert max(map(len, lines)) <= 80
    listed = [x[6:].split()[0] for x in lines if x[6:18].strip() in cli.COMMANDS]
    assert {*listed} == {*cli.COMMANDS}


@pytest.mark.parametrize("command", cli.COMMANDS)
def test_the_help_of_a_command_fits_a_screen_and_tells_every_option(command, monkeypatch, capfd):
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit):
        main([command, "--help"])
    lines = capfd.readouterr().out.splitlines()
    assert len(lines) <= 40
    assert max(map(len, lines)) <= 80
    own = parser(cli.COMMANDS, None)._subparsers._group_actions[0].choices[command]
    told = {x.split()[0] for x in lines if x.startswith("  -")}
    assert told == {*own._option_string_actions} - {"-h", "--help"}


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
    monkeypatch.setattr(writing, "QUIET", 0.001)
    with writing.working("top"):
        while "top: 0 s" not in screen.text:
            time.sleep(0.001)
    assert screen.text.endswith(" " * len("top: 0 s") + "\r")


def test_short_work_says_nothing(monkeypatch):
    screen = Screen()
    monkeypatch.setattr(sys, "stderr", screen)
    with writing.working("top"):
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


def read_to_end(ours):
    """All that comes from the other end of a terminal, until that is closed."""
    shown = b""
    try:
        while part := os.read(ours, 4096):
            shown += part
    except OSError:  # the other end is closed
        pass
    os.close(ours)
    return shown.decode()
