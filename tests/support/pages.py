"""README and the pages of docs/ as blocks, and what runs them.

A page is run as a reader would, from top to bottom in one folder: problem files and programs are
saved, commands are typed; the Python of the page is one program, run in the end, but what begins
with ``# NAME.py``, which is saved.  A command with the comment ``# exit 1`` must end so.  The block
after ``<!-- output -->`` is in what the block before it printed, on stderr after ``<!-- output:
stderr -->``; … stands there for anything, and 1e-67 for any such power.
"""

import os
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from tests.support.needs import CC, missing

ROOT = Path(__file__).parents[2]
PAGES = {
    str(x.relative_to(ROOT)): x.read_text(encoding="utf-8")
    for x in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(ROOT.glob("docs/**/*.md")))
}
FENCE = re.compile(r"^(?:<!-- (output.*?) -->\n+)?```(\S*)\n(.*?)^```$", re.M | re.S)
SAVED = {
    "c": "main.c",
    "cpp": "main.cpp",
    "rust": "main.rs",
    "javascript": "main.mjs",
    "latex": "main.tex",
    "cmake": "CMakeLists.txt",
    "make": "Makefile",
    "meson": "meson.build",
}
"""Under which name a program is saved, by its language."""
NEEDED = {
    "cc": ("cc",),
    "c++": ("g++",),
    "rustc": ("rustc",),
    "node": ("node",),
    "pdflatex": ("pdflatex",),
    "cmake": ("cmake", "make", "cc"),
    "make": ("make",),
    "meson": ("meson", "ninja", "cc"),
}
"""What a command needs that Python does not bring."""
IMPORTED = {
    "from scipy": "the module scipy",
    "import dask": "the module distributed",
    "derive.compile": "cc",
    "import jax": "the module jax",
    "import casadi": "the module casadi",
    "import fmpy": "the module fmpy",
    "import torch": "the module torch",
    "ensemble=": "cc",
}
MARK = "-- the next part --"
TARGETS = re.findall(r"^([a-z]+):.*##", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M)
GIVEN = ("pip install ", ". .venv/bin/activate")
"""Commands that are not run: they make the environment in which the others are."""


OWN = re.compile(r"# (\w+\.py)\n")
"""The first line of Python that is saved under this name, not run."""


class Block(NamedTuple):
    """A block: its language, "output" or "output: stderr", and its text."""

    kind: str
    text: str


def blocks(page: str) -> list[Block]:
    """Those of a page, but for the drawings and what is for the site alone."""
    found = [Block(output or kind, text) for output, kind, text in FENCE.findall(PAGES[page])]
    return [x for x in found if x.kind != "text" and not x.kind.startswith("{")]


def commands(text: str) -> list[str]:
    """The lines of a shell, without their comments."""
    return [line for x in text.splitlines() if (line := x.partition(" #")[0].strip())]


def shown(expected: str, printed: str) -> bool:
    """Is a block in what was printed?"""
    pattern = re.escape(expected.strip("\n")).replace("…", ".*?")
    return bool(re.search(re.sub(r"1e\\-\d+", r"1e-\\d+", pattern), printed, flags=re.S))


@dataclass
class Reader:
    """Who reads a page in a folder, with the Python and the derive of an environment.

    ``derive``: what runs its commands, which end with this code, in place of a process, and gives
    stdout and stderr.
    ``absent``: what is not here, for which something was left out.
    """

    folder: Path
    python: str = sys.executable
    derive: Callable[[list[str], int], tuple[str, str]] | None = None
    environment: Mapping[str, str] = field(default_factory=dict)
    absent: set[str] = field(default_factory=set)

    def read(self, page: str) -> None:
        """Run a page."""
        last, printed, program = "", None, []
        for kind, text in blocks(page):
            if kind.startswith("output") and last == "python":
                program[-1] = (program[-1][0], text)
            elif kind.startswith("output"):
                assert printed is None or shown(text, printed["stderr" in kind]), (
                    page,
                    text,
                    printed["stderr" in kind][-500:],
                )
            elif own := kind == "python" and OWN.match(text):
                (self.folder / own[1]).write_text(text, encoding="utf-8")
            elif kind == "python":
                program.append((text, ""))
            elif kind == "sh":
                printed = self.typed(text)
            else:
                name = f"{tomllib.loads(text)['name']}.toml" if kind == "toml" else SAVED[kind]
                (self.folder / name).write_text(text, encoding="utf-8")
            last = kind
        if program:
            self.ran(program)

    def typed(self, text: str) -> tuple[str, str] | None:
        """What commands print together; nothing is known where one of them is left out."""
        printed, left = ["", ""], False
        for whole in filter(commands, text.splitlines()):
            (line,), code = commands(whole), int(whole.endswith("# exit 1"))
            words = shlex.split(line)
            if line.startswith(GIVEN) or (words[0] == "make" and self.of_the_project(words[1])):
                continue
            asked = {"pdflatex": ".pdf", "cc": "--ensemble"}
            of_options = [need for need, word in asked.items() if word in line]
            absent = missing([*NEEDED.get(words[0], ()), *of_options])
            self.absent |= {*absent}
            if absent or (self.absent and self.unmade(words[0])):
                left = True
                continue
            for i, told in enumerate(self.command(words, code)):
                printed[i] += told
        return None if left else (printed[0], printed[1])

    def unmade(self, program: str) -> bool:
        """Is it a program of the page that was not built?"""
        return program.startswith("./") and not (self.folder / program).exists()

    def of_the_project(self, target: str) -> bool:
        """Is it a target of derive's own Makefile?  Which are not run here."""
        own = not (self.folder / "Makefile").exists()
        assert not own or target in TARGETS, target
        return own

    def command(self, words: list[str], code: int) -> tuple[str, str]:
        """What a command prints, which must end with this code."""
        if words[0] == "derive" and self.derive is not None:
            return self.derive(words[1:], code)
        words = [{"cc": CC, "c++": "g++"}.get(words[0], words[0]), *words[1:]]
        return self.process(words, code)

    def process(self, words: list[str], code: int = 0) -> tuple[str, str]:
        """What a process prints, which must end with this code."""
        path = f"{Path(self.python).parent}{os.pathsep}{os.environ['PATH']}"
        here = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "VIRTUAL_ENV"))}
        environment = here | {"PATH": path, "CC": CC} | dict(self.environment)
        found = subprocess.run(
            words, cwd=self.folder, env=environment, capture_output=True, encoding="utf-8"
        )
        assert found.returncode == code, (words, found.stdout[-2000:], found.stderr[-2000:])
        return found.stdout, found.stderr

    def ran(self, program: list[tuple[str, str]]) -> None:
        """Run the parts of a program, each with what it is to print."""
        whole = f"\nprint({MARK!r})\n".join(text for text, _ in program)
        self.absent |= {*missing([x for word, x in IMPORTED.items() if word in whole])}
        if not any(x in self.absent for word, x in IMPORTED.items() if word in whole):
            printed = self.process([self.python, "-c", whole])[0].split(MARK)
            for (_, expected), text in zip(program, printed, strict=True):
                assert shown(expected, text), (expected, text)
