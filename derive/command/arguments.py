"""The options of the command line; the commands themselves are in :mod:`derive.command.cli`."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from .. import __version__
from ..language.reserved import did_you_mean, near_name
from ..schema.table import nearest
from ..views.plot.kind_descriptions import described_kinds
from ..views.rendering import FORMATS
from .showing import ALLOWED, ready_made
from .writing import STDOUT, one_line

if TYPE_CHECKING:
    from ..language.univariate import Number


def add_emission_options(emit: argparse.ArgumentParser) -> None:
    """Add the options that choose what code is emitted."""
    from ..code.options import ADDED, CHOICES, DEPENDENT, REPEATED

    added = _group(emit, "what is added (docs/options.md)")
    for name, (values, about) in REPEATED.items():
        listed = f"{about}: {', '.join(values)}; repeated"
        added.add_argument(
            f"--{name}", action="append", choices=values, metavar=name.upper(), help=listed
        )
    for name, (values, about) in DEPENDENT.items():
        added.add_argument(f"--{name}", choices=values, help=about)
    for name, about in ADDED.items():
        added.add_argument(f"--{name}", action="store_true", help=about)
    form = _group(emit, "the form of the code (default: the first of each)")
    for name, (values, about) in CHOICES.items():
        word = name.upper() if len(values) > 2 else None
        form.add_argument(f"--{name}", choices=values, metavar=word, help=about)


def _group(one: argparse.ArgumentParser, title: str) -> argparse._ActionsContainer:
    """The group of the options of a command under a heading, the first one where there is none."""
    if not title:
        return one._optionals
    there = (x for x in one._action_groups if x.title == title)
    return next(there, None) or one.add_argument_group(title)


FILE = f"default, and {STDOUT}: standard output"


def text_file(words: str) -> str | None:
    """Where one text goes: the file of a name, ``None`` for standard output."""
    return None if words == STDOUT else words


def named_file(words: str) -> str:
    """A file, or a folder, by its name; ``ArgumentTypeError`` for standard output."""
    if words == STDOUT:
        raise argparse.ArgumentTypeError(
            f"{STDOUT} is standard output, which takes one text: give a name (a file is ./{STDOUT})"
        )
    return words


def positive(words: str) -> float:
    """A number of seconds from its text; ``ArgumentTypeError`` unless it is positive and below
    1e9."""
    try:
        seconds = float(words)
    except ValueError:
        seconds = 0.0
    if not 0 < seconds < 1e9:
        raise argparse.ArgumentTypeError(f"expected seconds, above 0, not {words[:40]!r}")
    return seconds


def natural(words: str) -> int:
    """An integer that is not negative, from its text; ``ArgumentTypeError`` for any other."""
    if not re.fullmatch(r"[0-9]{1,4000}", words):
        raise argparse.ArgumentTypeError(f"expected an integer, 0 or more, not {words[:40]!r}")
    return int(words)


def both(words: str) -> str:
    """The word "both"; ``ArgumentTypeError`` for any other."""
    if words != "both":
        key = f": trivialisation = {words!r} stands in the file, in [lagrangian] or [inertia]"
        own = key if words in ("left", "right") else ""
        raise argparse.ArgumentTypeError(f"expected both, not {words[:40]!r}{own}")
    return words


OTHER_OPTIONS = {"page": "html", "web": "html", "language": "lang", "output": "out", "o": "out"}
"""What others call an option."""

PICTURES = ("plot", "picture", "figure")
"""What is tried for a picture of a run."""


class Help(argparse.HelpFormatter):
    """The help of a command, whose usage is what it needs: all options are told below it."""

    def _format_usage(self, usage: Any, actions: Any, groups: Any, prefix: Any) -> str:
        needed = [x for x in actions if x.required or not x.option_strings]
        return f"{super()._format_usage(usage, needed, (), prefix).rstrip()} [options]\n\n"


Command = Callable[[argparse.Namespace], int]


class Parser(argparse.ArgumentParser):
    """A parser of one command, which reports an unknown option with the nearest known one."""

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """The parsed arguments; what is left over is an error."""
        found, left = super().parse_known_args(args, namespace)
        if hasattr(found, "labels") and not any(x.startswith("-") for x in left):
            found.labels, left = [*found.labels, *left], []  # steps behind an option
        if left:
            option = next((x for x in left if x.startswith("-")), "")
            what = f"unknown option {option!r}" if option else f"unexpected {left[0]!r}"
            self.error(one_line(what + self._hint(option.partition("=")[0])))
        return found, left

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """A choice that there is not, with the nearest that there is."""
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            choices, listed = [*map(str, action.choices or ())], str(value).split(",")
            near = nearest(str(value).lower(), choices)
            if action.metavar == "COMMAND":
                known = near or f"; there are {', '.join(choices)}"
                if value in ready_made() or str(value).endswith(".toml"):
                    known = f"; a problem comes after one: derive walk {str(value)[:40]} --answer"
                raise argparse.ArgumentError(
                    None, f"no command {str(value)[:40]!r}{known}"
                ) from None
            if "repeated" in (action.help or "") and len(listed) > 1 and {*listed} <= {*choices}:
                option = action.option_strings[0]
                near = f"; one at a time: {' '.join(f'{option} {x}' for x in listed)}"
            raise argparse.ArgumentError(action, f"{error.message}{near}") from None

    def error(self, message: str) -> NoReturn:
        """What is wrong in one line, and exit 2; --help has the usage."""
        self.exit(2, f"{self.prog}: error: {one_line(message)}\n")

    def _hint(self, option: str) -> str:
        """Where an option stands, or the nearest that there is."""
        known = {x.lstrip("-"): x for action in self._actions for x in action.option_strings}
        name = option.lstrip("-")
        if name in PICTURES and self.prog.endswith("simulate"):
            return "; derive plot draws the file of --out"
        near = OTHER_OPTIONS.get(name, "")
        near = near if near in known else near_name(name, known, 0.65)
        return did_you_mean(known.get(near, ""), "; ")


BEGIN = "To begin: derive walk top --answer. All of a command: derive COMMAND --help."
USAGE = "derive COMMAND [PROBLEM] [options], or derive --version"
GROUPS = {"list": "read", "symmetries": "find", "simulate": "move", "emit": "code", "check": "test"}
"""Which command begins which group of the help."""
STOP = "stop after so many seconds of processor time"


def real(words: str) -> float:
    """A finite number from its text; ``ArgumentTypeError`` for any other."""
    try:
        found = float(words)
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        raise argparse.ArgumentTypeError(f"expected a number, not {words[:40]!r}")
    return found


def reals(words: str) -> list[float]:
    """Numbers with commas between."""
    return [real(x) for x in words.split(",")]


def number(words: str) -> tuple[str, float]:
    """A name and a number from NAME=NUMBER; ``ArgumentTypeError`` for any other text."""
    name, text = named(words, "NAME=NUMBER, as zeta_3=2")
    return name, real(text)


def law(words: str) -> tuple[str, float, float, bool]:
    """A name, two numbers, and whether they are mean and deviation, from NAME=LOW:HIGH or
    NAME=normal:MEAN:SD; ``ArgumentTypeError`` for any other text."""
    form = "NAME=LOW:HIGH or NAME=normal:MEAN:SD"
    name, text = named(words, form)
    kind, _, rest = text.partition(":")
    numbers = (rest if kind == "normal" else text).split(":")
    if len(numbers) != 2 or not all(numbers):
        raise argparse.ArgumentTypeError(f"{words[:40]!r} is not {form}")
    return name, real(numbers[0]), real(numbers[1]), kind == "normal"


def named(words: str, form: str) -> tuple[str, str]:
    """The two sides of NAME=TEXT; ``ArgumentTypeError``, with the form, for any other text."""
    name, _, text = words.partition("=")
    if not re.fullmatch(r"\w{1,80}", name, re.ASCII) or not text:
        raise argparse.ArgumentTypeError(f"{words[:40]!r} is not {form}")
    return name, text


def coordinate(words: str) -> tuple[str, Number]:
    """A name and an exact number from NAME=NUMBER; ``ArgumentTypeError`` for any other text."""
    from ..search.equilibria.equilibrium_points import NoEquilibriumError, number_from

    name, text = named(words, "NAME=NUMBER, as Pi_3=2")
    try:
        return name, number_from(text)
    except NoEquilibriumError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def bounds(words: str) -> tuple[str, tuple[Number, Number]]:
    """A name and two exact numbers from NAME=LOW:HIGH; ``ArgumentTypeError`` for any other text."""
    form = "NAME=LOW:HIGH, as thrust=0:4, the lower number first"
    name, text = named(words, form)
    low, _, high = text.partition(":")
    if low and high:
        least, most = coordinate(f"{name}={low}")[1], coordinate(f"{name}={high}")[1]
        if float(least) <= float(most):
            return name, (least, most)
    raise argparse.ArgumentTypeError(f"{words[:40]!r} is not {form}")


def degree(words: str) -> int:
    """A degree from 1 to 40 from its text; ``argparse.ArgumentTypeError`` for any other."""
    if not words.isdecimal() or not 1 <= (number := int(words)) <= 40:
        raise argparse.ArgumentTypeError(f"expected an integer from 1 to 40, not {words!r}")
    return number


EACH = "end each search on a problem after so many seconds of processor time"
OPTIONS = Path(__file__).with_name("options.txt")
TYPES: dict[str, Callable[[str], Any]] = {
    x.__name__: x
    for x in (both, bounds, coordinate, degree, float, law, named_file, natural, number, real)
} | {"reals": reals, "text_file": text_file}


def parser(
    commands: Mapping[str, Command], about: str | None, words_typed: Sequence[str] | None = None
) -> argparse.ArgumentParser:
    """The parser of all commands: name → function, whose docstring is its help.

    ``words_typed``: only commands that are among these have their options, as to make those of all
    takes longer than to read a problem.
    """
    lines = [f"{GROUPS.get(x, ''):5} {x:11} {run.__doc__}" for x, run in commands.items()]
    about, own = "\n".join([about or "", "", *lines]), argparse.RawDescriptionHelpFormatter
    top = Parser("derive", USAGE, about, BEGIN, formatter_class=own, add_help=False)
    hidden: Any = {"help": argparse.SUPPRESS}
    top.add_argument("-h", "--help", action="help", **hidden)
    top.add_argument("--version", action="version", version=f"derive {__version__}", **hidden)
    subcommands = top.add_subparsers(dest="command", required=True, metavar="COMMAND", **hidden)
    made = {}
    for name, run in commands.items():
        wide = partial(Help, max_help_position=30)
        made[name] = one = subcommands.add_parser(
            name, prog=f"derive {name}", description=run.__doc__, formatter_class=wide,
            add_help=False,
        )  # fmt: skip
        one.set_defaults(run=run)
        one._optionals.title = "arguments"
    asked = made.keys() if words_typed is None else made.keys() & {*words_typed}
    words, choices = _told()
    for section in re.split(r"\n\n+", OPTIONS.read_text(encoding="utf-8").strip())[1:]:
        names, *listed = re.split(r"\n {4}(?! )", section)
        title = ""
        for line in listed:
            if line.startswith("# "):
                title = line[2:]
                continue
            spec, _, told = " ".join(line.split()).partition("| ")
            for name in asked & {*names.split()}:
                _add(made[name], title, spec.split(), told, words, choices)
    for name, one in ((x, made[x]) for x in asked):
        last, each = one._action_groups[-1], name == "lecture"
        last.add_argument("--seconds", type=positive, metavar="N", help=EACH if each else STOP,
                          dest="search_seconds" if each else "seconds")  # fmt: skip
        last.add_argument("-h", "--help", action="help", **hidden)
    return top


def _told() -> tuple[dict[str, str], dict[str, Sequence[str]]]:
    """What stands for words in braces of the options: in what is told of them, and as choices."""
    from ..code.languages import LANGUAGES as CODES
    from ..code.options import DEPENDENT
    from ..views.language import LANGUAGES
    from ..views.printing.signs import NOTATIONS

    values, order = DEPENDENT["order"]
    words = {"default": FILE, "stdout": STDOUT, "kinds": described_kinds(), "order": order}
    words["languages"] = ", ".join(CODES)
    choices: dict[str, Sequence[str]] = {"order": values, "formats": FORMATS, "tongues": LANGUAGES}
    choices["languages"] = tuple(CODES)
    for name, (signs, meaning) in NOTATIONS.items():
        words[name], choices[name] = f"{meaning} (default: {signs[0]})", signs
    return words | ALLOWED, choices


def _add(
    one: argparse.ArgumentParser,
    title: str,
    spec: Sequence[str],
    told: str,
    words: Mapping[str, str],
    choices: Mapping[str, Sequence[str]],
) -> None:
    """Add an option to a group of a command, as a line of the file says it."""
    name, *said = spec
    if name == "EMISSION":
        add_emission_options(one)
        return
    about: dict[str, Any] = {"help": told.format(**words)} if told else {}
    for x in said:
        if x in ("flag", "repeated"):
            about["action"] = "store_true" if x == "flag" else "append"
        elif x in ("*", "+"):
            about["nargs"] = x
        elif x == "required":
            about["required"] = True
        elif x.startswith("@"):
            about["type"] = TYPES[x[1:]]
        elif x.startswith("->"):
            about["dest"] = x[2:]
        elif x.startswith("="):
            about["default"] = [] if x == "=[]" else x[1:]
        elif x.startswith("{"):
            about["choices"] = choices.get(x[1:-1], x[1:-1].split(","))
            if x[1:-1] in ("transpose", "hat"):
                about["default"] = about["choices"][0]
        else:
            about["metavar"] = x
    _group(one, title).add_argument(name, **about)
