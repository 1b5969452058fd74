"""What a person at a terminal sees: weight and colour of a text, a pager, that work goes on."""

from __future__ import annotations

import os
import re
import shutil
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

PLAIN, BOLD, FAINT, BLUE = "\x1b[0m", "\x1b[1m", "\x1b[2m", "\x1b[1;34m"
LABEL = re.compile(r"(\S+)(  ·  .*)")
"""The first line of a step: its label, and its rule with notes."""


def coloured() -> bool:
    """Does standard output show weight and colour? Not where NO_COLOR is set (no-color.org)."""
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM", "dumb") == "dumb"
    return sys.stdout.isatty() and not plain


def emphasised(text: str) -> str:
    """A text of steps with headings, labels and equations in weight, rules faint."""
    from ..views.text import EQUATION

    lines, margin = text.split("\n"), " " * EQUATION
    return "\n".join(map(partial(_emphasised, margin), lines, [*lines[1:], ""]))


def _emphasised(margin: str, line: str, below: str) -> str:
    if label := LABEL.fullmatch(line):
        return f"{BLUE}{label[1]}{PLAIN}{FAINT}{label[2]}{PLAIN}"
    if line.startswith(margin) or (line and {*below} in ({"="}, {"-"})):
        return f"{BOLD}{line}{PLAIN}"
    return line


def show(text: str, *, paged: bool = True) -> None:
    """A text on standard output: at a terminal emphasised, and, ``paged``, by a pager (PAGER, else
    less) where it is longer than the screen."""
    if coloured():
        text = emphasised(text)
    if paged and sys.stdout.isatty() and text.count("\n") >= shutil.get_terminal_size().lines:
        import pydoc  # which a browser's Python has not

        os.environ.setdefault("LESS", "FRX")  # colours as they are, the text stays on the screen
        pydoc.pager(text)
    else:
        sys.stdout.write(text)


def filled(line: str, width: int) -> list[str]:
    """A line at the width of a terminal, or of COLUMNS, what is more below it, further in; else as
    it is."""
    from ..views.text import paragraph

    if not (sys.stdout.isatty() or os.environ.get("COLUMNS")):
        return [line]
    together = line.replace(" = ", "\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}")
    first, *rest = paragraph(together, 2 * line.startswith("  "), width)
    below = paragraph(" ".join(x.strip() for x in rest), 4, width) if rest else ()
    return [x.replace("\N{NO-BREAK SPACE}", " ") for x in (first, *below)]


PATIENCE = 1.0
"""After so many seconds it is said that work goes on."""


@contextmanager
def working(what: str) -> Iterator[None]:
    """While the body takes longer than a second, stderr says so, where that is a terminal."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield
        return
    done, start = threading.Event(), time.monotonic()
    shown = ""

    def tell() -> None:
        nonlocal shown
        while not done.wait(PATIENCE):
            shown = f"{what}: {time.monotonic() - start:.0f} s"
            print(shown, end="\r", file=sys.stderr, flush=True)

    teller = threading.Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield
    finally:
        done.set()
        teller.join()
        if shown:
            print(" " * len(shown), end="\r", file=sys.stderr, flush=True)
