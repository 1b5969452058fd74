"""The options of the command line; what they start is in :mod:`derive.cli`."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping

from . import __version__
from .rendering import FORMATS


def emission(emit: argparse.ArgumentParser) -> None:
    """The choices about the emitted code."""
    from .code.languages import LANGUAGES
    from .code.options import CHOICES, JACOBIANS

    lang = f"one of {', '.join(LANGUAGES)}; may be repeated; C and Python when left out"
    emit.add_argument("--lang", action="append", choices=LANGUAGES, metavar="LANG", help=lang)
    for name, (values, meaning) in CHOICES.items():
        about = f"{meaning} (default: {values[0]})"
        emit.add_argument(f"--{name}", choices=values, default=values[0], help=about)
    about = "also the linearised equations, in the state, the inputs or the parameters; repeated"
    emit.add_argument("--jacobian", action="append", choices=JACOBIANS, help=about)


def positive(words: str) -> float:
    """A number of seconds."""
    if not 0 < (seconds := float(words)) < 1e9:
        raise ValueError(words)
    return seconds


Command = Callable[[argparse.Namespace], int]


def parser(commands: Mapping[str, Command], about: str | None) -> argparse.ArgumentParser:
    """The options of every command, by the functions that run them, with their docstrings."""
    from .views.language import LANGUAGES
    from .views.notation import NOTATIONS

    top = argparse.ArgumentParser(prog="derive", description=about)
    top.add_argument("--version", action="version", version=f"derive {__version__}")
    made_of = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str) -> argparse.ArgumentParser:
        run = commands[name]
        made = made_of.add_parser(name, help=run.__doc__, description=run.__doc__)
        made.set_defaults(run=run)
        return made

    command("list")
    walk = command("walk")
    walk.add_argument("problem", help="a ready-made name or a .toml file")
    walk.add_argument("--format", choices=FORMATS, default="text")
    walk.add_argument("--fragment", action="store_true", help="LaTeX to \\input: no preamble")
    made = notes = command("notes")
    made.add_argument("problem", nargs="*", help="ready-made names or .toml files")
    made.add_argument("--out", metavar="FILE", required=True, help="FILE.tex, .pdf, .html or .sty")
    made.add_argument("--fragment", action="store_true", help="LaTeX to \\input: no preamble")
    for one in (walk, made):
        one.add_argument("--lang", choices=LANGUAGES, default="en", help="English or French")
        for option, name in (("--notation", "transpose"), ("--hat", "hat")):
            values, meaning = NOTATIONS[name]
            about = f"{meaning} (default: {values[0]})"
            one.add_argument(option, choices=values, default=values[0], help=about)
    walk.add_argument("--out", metavar="FILE")
    emit = command("emit")
    emit.add_argument("problem", help="a ready-made name or a .toml file")
    emit.add_argument("--out", metavar="DIR", help="default: the current directory")
    emit.add_argument("--prefix", metavar="NAME", help="default: the problem's name")
    current = "write nothing; exit 1 if a file on disk is not what would be written"
    emit.add_argument("--check", action="store_true", help=current)
    about = "read the C and Python back before they are written (with --check: those on disk), "
    about += "hold them against the record"
    emit.add_argument("--validate", action="store_true", help=f"{about}; exit 1 if they differ")
    emission(emit)
    check = command("check")
    check.add_argument("problem", nargs="+", help="ready-made names, .toml files or .json records")
    for one in (walk, notes, emit, check):
        about = "stop after so many seconds of processor time"
        one.add_argument("--seconds", type=positive, metavar="N", help=about)
    for made in (walk, emit, check):
        allowed = "warn of a negative mass instead of refusing it"
        made.add_argument("--allow-negative-mass", action="store_true", help=allowed)
    paper = command("paper")
    paper.add_argument("--format", choices=("text", "json"), default="text")
    paper.add_argument("--lang", choices=LANGUAGES, default="en", help="English or French")
    paper.add_argument("--out", metavar="FILE")
    build = command("build")
    build.add_argument("--out", metavar="DIR", default="generated")
    build.add_argument("--print", action="store_true", help="print the walks as well")
    return top
