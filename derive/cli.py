"""The command line: ``derive list | walk | emit | check | paper | build``."""

from __future__ import annotations

import argparse
import difflib
import io
import sys
from collections.abc import Callable, Sequence
from importlib import resources
from pathlib import Path

from . import __version__
from .guard import StoppedError, one_line, within
from .mechanics.problem import Problem, ProblemError
from .record.record import Derivation, RecordError
from .rendering import FORMATS, NOTES, RenderError, notes, pdf, render

READY = resources.files("derive") / "problems"


class UsageError(Exception):
    """Bad input: one clear line, exit 2."""


REFUSED = (UsageError, ProblemError, RecordError, RenderError)


def ready_made() -> list[str]:
    """The names of the ready-made problems."""
    return sorted(f.name.removesuffix(".toml") for f in READY.iterdir() if f.name.endswith(".toml"))


def load_problem(name: str, negative_mass: bool = False) -> Problem:
    """A ready-made problem by name, or a TOML file by path."""
    from .mechanics.toml import load

    if name in ready_made():
        return load(Path(str(READY / f"{name}.toml")))
    path = Path(name)
    if path.suffix == ".toml" or path.exists():
        return load(path, negative_mass)
    near = difflib.get_close_matches(name.lower(), ready_made(), 1)
    hint = f"did you mean {near[0]!r}? " if near else ""
    raise UsageError(
        f"unknown problem {name[:60]!r}; {hint}ready-made: {', '.join(ready_made())}; "
        "or give a .toml file"
    )


def derive(name: str, negative_mass: bool = False) -> tuple[Problem, Derivation]:
    """A problem and its record; a negative mass that is allowed gets a warning."""
    from .mechanics.inertia import negative_mass as where
    from .pipeline import walk

    problem = load_problem(name, negative_mass)
    if found := where(problem.body, problem.parameters):
        print(f"derive: warning: {one_line(name)}: {found} is negative", file=sys.stderr)
    try:
        return problem, walk(problem)
    except ProblemError as error:
        raise UsageError(f"{name}: {error}") from None


def save(text: str, out: str | None) -> None:
    """To stdout, or whole to a file."""
    from .writing import write

    if out is None:
        sys.stdout.write(text if text.endswith("\n") else text + "\n")
    else:
        path = Path(out)
        write({path.name: text}, path.parent, links=True)


def command_list(_: argparse.Namespace) -> int:
    """Groups and ready-made problems."""
    from .listing import listing

    print(listing({name: load_problem(name) for name in ready_made()}))
    return 0


def command_walk(args: argparse.Namespace) -> int:
    """Print the walk of a problem."""
    record = derive(args.problem, args.allow_negative_mass)[1]
    shown = render(record, args.format, args.lang, fragment=args.fragment, **notation(args))
    save(shown, args.out)
    return 0


def command_notes(args: argparse.Namespace) -> int:
    """Lecture notes of one or several problems: .tex, .pdf or .html."""
    from .writing import write

    out = Path(args.out)
    if out.suffix not in NOTES:
        raise UsageError(f"--out {args.out}: the name must end in {', '.join(NOTES)}")
    records = [derive(name)[1] for name in dict.fromkeys(args.problem)]
    text = notes(records, out.suffix, args.lang, **notation(args))
    if out.suffix != ".pdf":
        paths = write({out.name: text}, out.parent, links=True)
    else:
        paths = write({out.with_suffix(".tex").name: text}, out.parent)
        paths += write({out.name: pdf(text)}, out.parent, links=True)
    for path in paths:
        print(path)
    return 0


def notation(args: argparse.Namespace) -> dict[str, str]:
    """How transposes and skew matrices are to be written."""
    return {"transpose": args.notation, "hat": args.hat}


def command_emit(args: argparse.Namespace) -> int:
    """Write the numeric code of a problem."""
    from .code.emit import emit
    from .code.options import CHOICES, Options
    from .pipeline import program
    from .writing import stale, write

    problem, record = derive(args.problem, args.allow_negative_mass)
    chosen = {name: getattr(args, name) for name in CHOICES}
    options = Options(**chosen, jacobian=tuple(dict.fromkeys(args.jacobian or ())))
    compiled = program(problem, record, options)
    languages = tuple(dict.fromkeys(args.lang or ("c", "python")))
    prefix = problem.name if args.prefix is None else args.prefix
    files, folder = emit(compiled, record, languages, prefix, options), Path(args.out or ".")
    if args.check:
        old = stale(files, folder)
        for path in old:
            print(f"{path}: not current; run the same command without --check")
        return 1 if old else 0
    for path in write(files, folder):
        print(path)
    return 0


def command_check(args: argparse.Namespace) -> int:
    """Re-check every recorded step, independently of the code that derived it."""
    from .record.check import check
    from .record.record import read

    failed = 0
    for name in args.problem:
        if name.endswith(".json"):
            record = read(Path(name))
        else:
            record = derive(name, args.allow_negative_mass)[1]
        verdicts = check(record)
        for v in verdicts:
            print(
                f"{'holds' if v.holds else 'FAILS'}  {v.label}"
                + (f": {one_line(v.reason)}" if v.reason else "")
            )
        bad = sum(not v.holds for v in verdicts)
        bound = max(v.bound for v in verdicts)
        print(
            f"{one_line(name)}: {len(verdicts) - bad} of {len(verdicts)} steps hold exactly"
            + ("" if bad else f"; a false one passes with probability below {bound:.0e}")
        )
        failed += bad
    return 1 if failed else 0


def command_paper(args: argparse.Namespace) -> int:
    """The paper's numbered equations against the derivation."""
    from .record import paper
    from .views.paper import as_json, as_text

    findings = paper.compare([derive(name)[1] for name in paper.PROBLEMS])
    save(as_json(findings) if args.format == "json" else as_text(findings), args.out)
    return 0


def command_build(args: argparse.Namespace) -> int:
    """Make all of generated/ again."""
    from .code.emit import emit
    from .pipeline import program
    from .writing import write

    for name in ("so3", "se3", "sl3"):
        problem, record = derive(name)
        files = {f"walk.{end}": render(record, form) for form, end in FILES.items()}
        files |= emit(program(problem, record), record, ("c", "python"), name)
        for path in write(files, Path(args.out) / name):
            print(path, file=sys.stderr)
        if args.print:
            print(files["walk.txt"])
    return 0


FILES = {"text": "txt", "latex": "tex", "json": "json"}


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


def parser() -> argparse.ArgumentParser:
    """The options of every command."""
    from .views.language import LANGUAGES
    from .views.notation import NOTATIONS

    top = argparse.ArgumentParser(prog="derive", description=__doc__)
    top.add_argument("--version", action="version", version=f"derive {__version__}")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, run: Callable[[argparse.Namespace], int]) -> argparse.ArgumentParser:
        made = commands.add_parser(name, help=run.__doc__, description=run.__doc__)
        made.set_defaults(run=run)
        return made

    command("list", command_list)
    walk = command("walk", command_walk)
    walk.add_argument("problem", help="a ready-made name or a .toml file")
    walk.add_argument("--format", choices=FORMATS, default="text")
    walk.add_argument("--fragment", action="store_true", help="LaTeX to \\input: no preamble")
    made = command("notes", command_notes)
    made.add_argument("problem", nargs="+", help="ready-made names or .toml files")
    made.add_argument("--out", metavar="FILE", required=True, help="FILE.tex, .pdf or .html")
    for one in (walk, made):
        one.add_argument("--lang", choices=LANGUAGES, default="en", help="English or French")
        for option, name in (("--notation", "transpose"), ("--hat", "hat")):
            values, meaning = NOTATIONS[name]
            about = f"{meaning} (default: {values[0]})"
            one.add_argument(option, choices=values, default=values[0], help=about)
    walk.add_argument("--out", metavar="FILE")
    emit = command("emit", command_emit)
    emit.add_argument("problem", help="a ready-made name or a .toml file")
    emit.add_argument("--out", metavar="DIR", help="default: the current directory")
    emit.add_argument("--prefix", metavar="NAME", help="default: the problem's name")
    current = "write nothing; exit 1 if a file on disk is not what would be written"
    emit.add_argument("--check", action="store_true", help=current)
    emission(emit)
    check = command("check", command_check)
    check.add_argument("problem", nargs="+", help="ready-made names, .toml files or .json records")
    for one in (walk, made, emit, check):
        about = "stop after so many seconds of processor time"
        one.add_argument("--seconds", type=positive, metavar="N", help=about)
    for made in (walk, emit, check):
        allowed = "warn of a negative mass instead of refusing it"
        made.add_argument("--allow-negative-mass", action="store_true", help=allowed)
    paper = command("paper", command_paper)
    paper.add_argument("--format", choices=("text", "json"), default="text")
    paper.add_argument("--out", metavar="FILE")
    build = command("build", command_build)
    build.add_argument("--out", metavar="DIR", default="generated")
    build.add_argument("--print", action="store_true", help="print the walks as well")
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command: 0, 1 when a check failed, 2 for bad input."""
    from .code.emit import EmitError
    from .code.program import LoweringError
    from .writing import WriteError

    args = parser().parse_args(argv)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")  # a terminal without these letters shows ?
    try:
        with within(getattr(args, "seconds", None)):
            status = int(args.run(args))
        sys.stdout.flush()
        return status
    except (*REFUSED, EmitError, LoweringError, WriteError, StoppedError) as error:
        print(f"derive: {one_line(error)}", file=sys.stderr)
        return 2
    except (MemoryError, RecursionError) as error:
        what = "out of memory" if isinstance(error, MemoryError) else "nested too deeply"
        print(f"derive: {what}: the input is too large for this machine", file=sys.stderr)
        return 2
    except BrokenPipeError:
        sys.stderr.close()
        return 0
    except OSError as error:
        place = one_line(error.filename or "standard output")
        print(f"derive: {place}: {error.strerror}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
