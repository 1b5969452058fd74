"""The options of the command line; the commands themselves are in :mod:`derive.command.cli`."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NoReturn

from .. import __version__
from ..language.reserved import did_you_mean, near_name
from ..schema.table import nearest
from ..views.plot.kind_descriptions import described_kinds
from ..views.rendering import FORMATS
from .writing import STDOUT, one_line

if TYPE_CHECKING:
    from ..language.univariate import Number

ALLOWED = {"mass": "mass", "stiffness": "stiffness or damping"}
"""What may be negative where a flag allows it: the name in the flag → the quantity in messages."""


def add_emission_options(emit: argparse.ArgumentParser) -> None:
    """Add the options that choose what code is emitted."""
    from ..code.languages import LANGUAGES
    from ..code.options import ADDED, CHOICES, DEPENDENT, REPEATED

    lang = f"one of {', '.join(LANGUAGES)}; may be repeated; C and Python when left out"
    emit.add_argument("--lang", action="append", choices=LANGUAGES, metavar="LANG", help=lang)
    for name, (values, meaning) in CHOICES.items():
        about = f"{meaning} (default: {values[0]})"
        emit.add_argument(f"--{name}", choices=values, help=about)
    for name, (values, about) in REPEATED.items():
        emit.add_argument(f"--{name}", action="append", choices=values, help=about)
    for name, (values, about) in DEPENDENT.items():
        emit.add_argument(f"--{name}", choices=values, help=about)
    for name, about in ADDED.items():
        emit.add_argument(f"--{name}", action="store_true", help=about)


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
            near = nearest(str(value), choices)
            if not near and action.metavar == "COMMAND":
                raise argparse.ArgumentError(
                    None, f"no command {str(value)[:40]!r}; derive --help has them"
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


BEGIN = "To begin: derive walk top --answer, then derive walk top; derive COMMAND --help."


def add_trim_options(held: argparse.ArgumentParser) -> None:
    """What ``derive trim`` is told: the state, what is free, parameters."""
    about = "of the state or an input, as zeta_3=1/2; repeated, others are those of g = 1, and 0"
    held.add_argument("--at", action="append", type=coordinate, metavar="NAME=NUMBER", help=about)
    about = (
        "an input or a velocity to be found, this near what --at gives, or a turn of g from there, "
        "eta_1; repeated, or with commas "
    )
    about += "(default: all inputs that --at does not give)"
    held.add_argument("--free", action="append", metavar="NAME", help=about)
    about = (
        "what an input, or a number of the state, may be: of several trims one within is taken, "
        "one outside is refused; repeated"
    )
    held.add_argument("--bounds", action="append", type=bounds, metavar="NAME=LOW:HIGH", help=about)
    about = "a parameter, in place of its default; repeated"
    held.add_argument("--given", action="append", type=number, metavar="NAME=NUMBER", help=about)


STOP = "stop after so many seconds of processor time"


def parser(commands: Mapping[str, Command], about: str | None) -> argparse.ArgumentParser:
    """The parser of all commands: name → function, whose docstring is its help."""
    top = Parser(prog="derive", description=about, epilog=BEGIN)
    top.add_argument("--version", action="version", version=f"derive {__version__}")
    subcommands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, stop: str = STOP, limit: str = "seconds") -> argparse.ArgumentParser:
        run = commands[name]
        made = subcommands.add_parser(name, help=run.__doc__, description=run.__doc__)
        made.set_defaults(run=run)
        made.add_argument("--seconds", type=positive, metavar="N", help=stop, dest=limit)
        return made

    command("list")
    walk, symmetries, reduction, searched, steady, held = map(
        command, ("walk", "symmetries", "reduction", "integrals", "equilibria", "trim")
    )
    made, emit, check = map(command, ("notes", "emit", "check"))
    add_reading_options((walk, symmetries, reduction), (searched, steady, held), made)
    about = "first what holds for any Lagrangian, on the left beside the right"
    walk.add_argument("--trivialisation", type=both, metavar="both", help=about)
    about = "the equations of motion alone, with what their letters are; so does the step 'answer'"
    walk.add_argument("--answer", action="store_true", help=about)
    about = "the discrete motion, a time step h apart"
    for one in (walk, made):
        one.add_argument("--discrete", action="store_true", help=about)
    add_search_options(searched, steady)
    about = "a coordinate of an equilibrium, as Pi_3=2 or sqrt(3)/2; repeated, others are 0"
    steady.add_argument("--at", action="append", type=coordinate, metavar="NAME=NUMBER", help=about)
    about = "a coordinate near that of an equilibrium, which is enclosed; repeated, others are 0"
    steady.add_argument(
        "--near", action="append", type=coordinate, metavar="NAME=NUMBER", help=about
    )
    about = "parameters and momenta stay letters: inequalities for what is stable, and what is not"
    steady.add_argument("--letters", action="store_true", help=about)
    add_trim_options(held)
    emit.add_argument("problem", help="a ready-made name or a .toml file")
    add_writing_options(emit)
    add_emission_options(emit)
    check.add_argument("problem", nargs="+", help="ready-made names, .toml files or .json records")
    about = "the seed of a run that is to be repeated (default: a new one)"
    check.add_argument("--seed", type=natural, metavar="N", help=about)
    simulated = command("simulate")
    add_motion_options(simulated)
    for one in (walk, emit, check, symmetries, reduction, simulated):
        for name, what in ALLOWED.items():
            about = f"warn of a negative {what} instead of refusing it"
            one.add_argument(f"--allow-negative-{name}", action="store_true", help=about)
    add_picture_options(command("plot"))
    add_comparison_options(command("compare"))
    each = "end each search on a problem after so many seconds of processor time"
    add_lecture_options(command("lecture", each, "search_seconds"), command("paper"))
    build = command("build")
    build.add_argument("--out", type=named_file, metavar="DIR", default="generated")
    build.add_argument("--print", action="store_true", help="print the walks as well")
    return top


def add_comparison_options(compare: argparse.ArgumentParser) -> None:
    """Add the options of ``compare``: whose code, as what, at how many states."""
    compare.add_argument("problem", help="a ready-made name or a .toml file")
    about = "your code: FILE.c, LIB.so or MODULE.py; it is compiled and run"
    compare.add_argument("--with", dest="file", metavar="FILE", required=True, help=about)
    about = "the function in it (default: rhs, NAME_rhs in C, or that of the table)"
    compare.add_argument("--function", metavar="NAME", default="", help=about)
    about = "your conventions, a .toml file (default: the state and the signature of our code)"
    compare.add_argument("--as", dest="table", metavar="TABLE", help=about)
    about = "at how many states (default: 24)"
    compare.add_argument("--states", type=natural, metavar="N", help=about)
    about = "the seed of the states (default: 0)"
    compare.add_argument("--seed", type=natural, metavar="N", help=about)


def add_picture_options(plot: argparse.ArgumentParser) -> None:
    """Add the options of ``plot``: of what, which picture, to where."""
    from ..views.language import LANGUAGES

    about = "a run or an ensemble: .npz, .csv or .parquet; several for energy; for precision "
    about += "several, or a table"
    plot.add_argument("run_file", metavar="RUN", nargs="+", help=about)
    plot.add_argument("--kind", default="", help=described_kinds())
    about = "a column of an ensemble that is drawn; repeated"
    plot.add_argument("--column", metavar="NAME", action="append", default=[], help=about)
    plot.add_argument("--lang", choices=LANGUAGES, default="en", help="English or French")
    about = "FILE.svg, .pdf or .png (default: the first RUN, as .svg)"
    plot.add_argument("--out", type=named_file, metavar="FILE", help=about)


def add_motion_options(simulated: argparse.ArgumentParser) -> None:
    """Add the options of ``simulate``: how long, how exact, from where, and what is kept."""
    from ..code.options import DEPENDENT
    from ..views.language import LANGUAGES

    simulated.epilog = """An [[event]] of the file happens where its expression changes its sign;
    what only touches 0 is none, or is one by rounding."""
    simulated.add_argument("problem", help="a ready-made name or a .toml file")
    about = "the time, from 0 on (default: about ten turns or swings)"
    simulated.add_argument("--t", type=real, metavar="T", help=about)
    about = "the error of a short run, relative to the size of the state (default: 1e-9)"
    simulated.add_argument("--tol", type=real, metavar="TOL", help=about)
    simulated.add_argument("--dt", type=real, metavar="DT", help="steps of this size instead")
    about = "how the motion is followed: gauss (the default), vern9 (that where a force has abs, "
    about += "sign, min, max or hypot), or, with --dt, rk4 or discrete"
    simulated.add_argument("--step", dest="method", metavar="STEP", help=about)
    values, about = DEPENDENT["order"]
    simulated.add_argument("--order", choices=values, help=about)
    about = "a number of the state, a parameter or an input, as zeta_3=2; repeated"
    simulated.add_argument("--set", action="append", type=number, metavar="NAME=NUMBER", help=about)
    about = "inputs in time: FILE.csv with columns t and NAME, each row held up to the next one"
    simulated.add_argument("--input", metavar="FILE", help=about)
    about = "join the rows of --input by straight lines"
    simulated.add_argument("--linear", action="store_true", help=about)
    about = "such numbers from a .toml file, or the end of a run (whole|moving is of derive emit)"
    simulated.add_argument("--state", metavar="FILE", help=about)
    about = "start at exp of these coordinates in the basis of the Lie algebra, as 0.3,0,0"
    simulated.add_argument("--exp", type=reals, metavar="NUMBERS", help=about)
    about = "take the start to the group by Newton's method"
    simulated.add_argument("--project", action="store_true", help=about)
    about = "how many states are kept, about (default: 500; of an ensemble the last one)"
    simulated.add_argument("--points", type=natural, metavar="N", help=about)
    about = "many motions, by the emitted C, from what --vary draws for each"
    simulated.add_argument("--ensemble", type=natural, metavar="N", help=about)
    about = "a parameter, an input or a number of the start: uniform, or normal:MEAN:SD; repeated"
    simulated.add_argument("--vary", action="append", type=law, metavar="NAME=LOW:HIGH", help=about)
    about = "follow them on a graphics card: by nvcc, which is needed"
    simulated.add_argument("--device", choices=("cuda",), help=about)
    about = "the seed of what is drawn (default: 0)"
    simulated.add_argument("--seed", type=natural, metavar="N", help=about)
    about = "FILE.npz, .csv or .parquet"
    simulated.add_argument("--out", type=named_file, metavar="FILE", help=about)
    about = "a page FILE.html in which the body moves, with sliders; alone, instead of a run"
    simulated.add_argument("--html", type=named_file, metavar="FILE", help=about)
    about = "English or French, of the page"
    simulated.add_argument("--lang", choices=LANGUAGES, default="en", help=about)


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


def add_search_options(searched: argparse.ArgumentParser, steady: argparse.ArgumentParser) -> None:
    """Add the options of searches, ``integrals`` and ``equilibria``: up to which degree; of the
    first, for which parameters."""
    about = "the highest degree of integrals that is searched, momenta being of degree 1, other "
    about += "variables of what makes the energy homogeneous (default: 4)"
    for one in (searched, steady):
        one.add_argument("--degree", type=degree, default=4, metavar="N", help=about)
    about = "put the default values of parameters in their place (default: they stay letters)"
    searched.add_argument("--at-defaults", action="store_true", help=about)
    about = "also find the conditions on the parameters under which there are more integrals"
    searched.add_argument("--conditions", action="store_true", help=about)


def add_lecture_options(lecture: argparse.ArgumentParser, paper: argparse.ArgumentParser) -> None:
    """Add the options of ``lecture``, file, language, solutions, trial of its claims, and of
    ``paper``."""
    from ..views.language import LANGUAGES

    about = "problems that get a chapter each, behind the others"
    lecture.add_argument("problem", nargs="*", help=about)
    about = "FILE.tex, .pdf or .html"
    lecture.add_argument("--out", type=named_file, metavar="FILE", required=True, help=about)
    for name in ("title", "author", "course", "date"):
        about = f"the {name} of the lecture, printed as it is given"
        lecture.add_argument(f"--{name}", default="", metavar="TEXT", help=about)
    about = "of the exercises: at the end of each chapter, or of the whole, or left out"
    places = ("chapter", "end", "none")
    lecture.add_argument("--solutions", choices=places, default="chapter", help=about)
    about = "numbers in the exercises that have some, other ones for each seed (default: none)"
    lecture.add_argument("--seed", type=natural, metavar="N", help=about)
    about = "try every equation of the text anew, as derive check does those of a record"
    lecture.add_argument("--check", action="store_true", help=about)
    paper.add_argument("--format", choices=("text", "json"), default="text")
    paper.add_argument("--out", type=text_file, metavar="FILE", help=FILE)
    for one in (lecture, paper):
        one.add_argument("--lang", choices=LANGUAGES, default="en", help="English or French")


def add_reading_options(
    walks: Sequence[argparse.ArgumentParser],
    searched: Sequence[argparse.ArgumentParser],
    notes: argparse.ArgumentParser,
) -> None:
    """Add the options of ``walk`` and its like and of ``notes``: problems, format, language,
    notations."""
    from ..views.language import LANGUAGES
    from ..views.printing.signs import NOTATIONS

    for one in (*walks, *searched):
        one.add_argument("problem", help="a ready-made name or a .toml file")
        one.add_argument("--format", choices=FORMATS, default="text")
        one.add_argument("--out", type=text_file, metavar="FILE", help=FILE)
    for one in walks:
        about = "steps to print alone, as kernel or linear.kernel"
        one.add_argument("labels", nargs="*", metavar="step", help=about)
    notes.add_argument("problem", nargs="*", help="ready-made names or .toml files")
    about = "FILE.tex, .pdf, .html or .sty"
    notes.add_argument("--out", type=named_file, metavar="FILE", required=True, help=about)
    about = "beside FILE.html a page for each problem, linked from it, in which the body moves"
    notes.add_argument("--motion", metavar="T", type=float, help=f"{about} for a time T")
    about = "a picture of the motion of each problem for a time T, beside FILE and shown in it"
    notes.add_argument("--picture", metavar="T", type=float, help=f"{about} (needs matplotlib)")
    for one in (*walks, *searched, notes):
        one.add_argument(
            "--fragment", action="store_true", help="LaTeX to \\input, HTML to put into a page"
        )
        one.add_argument("--lang", choices=LANGUAGES, default="en", help="English or French")
        for option, name in (("--notation", "transpose"), ("--hat", "hat")):
            values, meaning = NOTATIONS[name]
            about = f"{meaning} (default: {values[0]})"
            one.add_argument(option, choices=values, default=values[0], help=about)


def add_writing_options(emit: argparse.ArgumentParser) -> None:
    """Add the options of ``emit``: where code goes, and what is done instead."""
    about = f"default: the current directory; {STDOUT}: standard output, of one file"
    emit.add_argument("--out", metavar="DIR", help=about)
    emit.add_argument("--prefix", metavar="NAME", help="default: the problem's name")
    current = "write nothing; exit 1 if a file on disk is not what would be written, "
    current += "with the options that it states where none are given"
    emit.add_argument("--check", action="store_true", help=current)
    names = "print the names of the files, a line each, and write nothing (for builds)"
    emit.add_argument("--names", action="store_true", help=names)
    about = "read the files back before they are written (with --check: those on disk), "
    about += "hold them against the record"
    emit.add_argument("--validate", action="store_true", help=f"{about}; exit 1 if they differ")
