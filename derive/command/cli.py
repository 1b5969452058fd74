"""The command line: ``derive list | walk | symmetries | reduction | integrals | equilibria | trim |
notes | lecture | emit | simulate | plot | check | compare | paper | build``."""

from __future__ import annotations

import argparse
import os
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from contextvars import copy_context
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..language.limits import LISTENER, Refused, tell
from .showing import (
    UsageError,
    allowed,
    columns,
    derive,
    discrete_walk,
    doubted,
    each_once,
    load_problem,
    ready_made,
    save,
    save_found,
    save_steps,
    steps_of,
)
from .writing import (
    StoppedError,
    one_line,
    replacing_unencodable,
    time_limit,
    with_progress,
    working,
)

if TYPE_CHECKING:
    from ..check.form.hypotheses_checked import Verdict
    from ..problem.problem import Problem
    from ..record.record import Derivation


def command_list(_: argparse.Namespace) -> int:
    """Groups and ready-made problems."""
    from .showing import listing

    print(listing({name: load_problem(name) for name in ready_made()}))
    return 0


def command_walk(args: argparse.Namespace) -> int:
    """The equations of motion, step by step; --answer: they alone."""
    from ..algebra.groups import names_by_block
    from ..pipeline import both_trivialisations

    if args.discrete and args.trivialisation:
        raise UsageError("--discrete and --trivialisation are of two roads: leave out one")
    if args.labels == ["answer"]:
        args.labels, args.answer = [], True
    if (args.answer or "answer" in args.labels) and (args.labels or args.trivialisation):
        said = "--answer" if args.answer else "answer"
        more = [x for x in args.labels if x != "answer"] + ["--trivialisation"] * bool(
            args.trivialisation
        )
        raise UsageError(f"{said} shows its own steps: leave out {', '.join(more) or 'the second'}")
    walked = discrete_walk if args.discrete else derive
    with working(args.problem):
        problem, record = walked(args.problem, **allowed(args))
    if args.answer:
        own = names_by_block(problem.group) if problem.group else {}
        save_steps(record, (), args, answer=True, by_block=own)
        return 0
    if args.trivialisation:
        if problem.fluid or problem.kinematics:
            told = "errors are told on both sides"
            if problem.fluid:
                told = "a fluid is told on the right alone"
            raise UsageError(f"{record.name}: {told}: leave out --trivialisation")
        if args.format == "json":
            raise UsageError("--trivialisation both is to be read: choose another --format")
        record = both_trivialisations(record)
    save_steps(record, steps_of(record, args.labels), args)
    return 0


def command_integrals(args: argparse.Namespace) -> int:
    """Polynomial first integrals of the reduced equations."""
    from ..searches import integrals

    problem = doubted(args.problem)
    chosen = {"at_defaults": args.at_defaults, "conditions": args.conditions}
    with working(args.problem):
        _, record = integrals(problem, args.degree, **chosen)
    save_found(record, args)
    return 0


def command_equilibria(args: argparse.Namespace) -> int:
    """Relative equilibria, steady motions, and their stability."""
    from ..search.equilibria.stability import PiError
    from ..searches import equilibria, equilibrium_near, families

    if args.letters and (args.near or args.at):
        raise UsageError("--letters has letters for the coordinates: give no --at and no --near")
    if args.near and args.at:
        raise UsageError("--at is exact and --near is not: give one of them")
    at, near = each_once("--at", args.at), each_once("--near", args.near)
    found: object
    problem = doubted(args.problem)
    with working(args.problem):
        if args.letters:
            found, record = families(problem, args.degree)
        elif near:
            found, record = equilibrium_near(problem, near, args.degree)
        else:
            try:
                found, record = equilibria(problem, at, args.degree)
            except PiError:
                if at:
                    raise
                reason = "the moments of its solid have π, which is no fraction and stays a letter"
                print(f"derive: {problem.name}: {reason}", file=sys.stderr)
                found, record = families(problem, args.degree, at_defaults=True)
    if not found:
        on_leaves = "with letters no family on a symplectic leaf of more than a point"
        remedy = "leave --letters out" if args.letters else "give one by --at NAME=NUMBER"
        raise UsageError(
            f"{record.name}: {on_leaves if args.letters else 'no equilibrium'} among the points "
            f"with at most one momentum, 1, and at most one other coordinate, 1 or -1: {remedy}"
        )
    save_found(record, args)
    return 0


def command_trim(args: argparse.Namespace) -> int:
    """Inputs and velocities that keep a state, and its stability."""
    from ..programs import trim
    from .showing import trim_lines

    at, given = each_once("--at", args.at), each_once("--given", args.given)
    bounds, along = each_once("--bounds", args.bounds), each_once("--along", args.along)
    free = [name for x in args.free or () for name in x.split(",")] or None
    with working(args.problem):
        problem = doubted(args.problem, given=given)
        found, record, units = trim(problem, at, free, given, bounds, along)
    save_found(record, args, trim_lines(found, problem.own_group, units, args.lang))
    return 0


def command_symmetries(args: argparse.Namespace) -> int:
    """Symmetries of the Lagrangian, what the motion keeps by each."""
    from ..searches import symmetries

    return _searched(args, symmetries)


def command_reduction(args: argparse.Namespace) -> int:
    """Routh's reduction by symmetries: effective potential."""
    from ..searches import reduction

    return _searched(args, reduction)


def _searched(args: argparse.Namespace, search: Callable[[Problem, Derivation], Any]) -> int:
    """Tell what a search finds in the walk of a problem."""
    problem, walked = derive(args.problem, **allowed(args))
    with working(args.problem):
        record = search(problem, walked).record
    save_found(record, args)
    return 0


def command_emit(args: argparse.Namespace) -> int:
    """The equations as code: C, C++, Rust, Julia, Python, FMU …"""
    from ..code.emit import planned
    from .emitting import (
        all_hold,
        checked,
        languages,
        made,
        options,
        packed,
        require_one_text,
        validated,
        wanted,
    )
    from .writing import STDOUT, write

    if args.names:
        prefix = args.prefix  # with one, the problem need not be there
        if prefix is None:
            prefix = load_problem(args.problem, **allowed(args)).name
        print(*planned(languages(args), prefix, options(args)), sep="\n")
        return 0
    require_one_text(args)
    if args.check:
        return checked(args)
    # steps refuse an event by a name that the state has not
    problem, record = derive(args.problem, followed=bool(args.step), **allowed(args))
    asked = wanted(args, problem)
    compiled, files = made(problem, record, asked)
    for told in dict.fromkeys(" ".join(x) for x in compiled.kinks.values() if x):
        tell(f"{problem.name}: {told}")
    if args.validate and not all_hold(validated(files, files, record, compiled, asked)):
        return 1  # and nothing is written
    if args.out == STDOUT:
        save("".join(files.values()), None, "code")
        return 0
    for path in write(packed(asked, files), Path(args.out or ".")):
        print(path)
    return 0


def command_plot(args: argparse.Namespace) -> int:
    """A run as a picture: .svg, .pdf or .png (needs matplotlib)."""
    from ..motion.ensemble_files import read_either
    from ..views.language import language
    from ..views.plot.ensemble_pictures import plot_precision
    from ..views.plot.kind_descriptions import PRECISION
    from ..views.plot.pictures import plot, plot_energies
    from ..views.plot.plot_sheet import ending
    from .writing import write

    paths, words = [Path(x) for x in args.run_file], language(args.lang)
    for x in (x for x in paths if not x.exists()):
        wanted = x.with_suffix(x.suffix or ".npz")
        raise UsageError(f"{x}: No such file; derive simulate PROBLEM --out {wanted} writes one")
    out = Path(args.out) if args.out else Path(paths[0].with_suffix(".svg").name)
    ending(str(out))
    word, mark = words.word, words.mark
    if args.kind == PRECISION:
        picture = plot_precision(paths, out.name, word, mark)
    elif len(paths) > 1 and args.kind == "energy":
        if args.column:
            raise UsageError("columns are chosen of an ensemble: leave out --column")
        picture = plot_energies([(str(x), read_either(x)) for x in paths], out.name, word, mark)
    elif len(paths) > 1:
        raise UsageError(f"several runs are for --kind {PRECISION} and --kind energy: give one")
    else:
        picture = plot(read_either(paths[0]), out.name, args.kind, word, args.column, mark)
    for path in write({out.name: picture}, out.parent, links=True):
        print(path)
    return 0


def command_check(args: argparse.Namespace) -> int:
    """Each step checked anew, by code that shares no rule with it."""
    from ..check.checker import fresh_seed
    from ..check.checker import verdicts as check
    from ..record.as_json import read

    steps, failed, refused = 0, 0, 0
    seed = fresh_seed() if args.seed is None else args.seed
    whole = args.verbose or not sys.stdout.isatty()
    for name in args.problem:
        try:
            record = (
                read(Path(name)) if name.endswith(".json") else derive(name, **allowed(args))[1]
            )
            verdicts = list(with_progress(check(record, seed), 1 + len(record.steps), name))
        except Refused as error:
            if len(args.problem) == 1:
                raise
            print(f"derive: {one_line(error)}", file=sys.stderr)
            refused += 1
            continue
        steps += sum(v.of == "equation" for v in verdicts)
        failed += told(name, verdicts, whole=whole)
    print(f"seed {seed} (--seed repeats this run)")
    if not whole:
        print("--verbose: a line for each step")
    if (several := len(args.problem)) > 1:
        unread = f"; not checked: {refused}" if refused else ""
        print(f"records: {several - refused}; steps: {steps}; failed: {failed}{unread}")
    return 2 if refused else 1 if failed else 0


def told(name: str, verdicts: Sequence[Verdict], *, whole: bool = True) -> int:
    """Print the verdicts on the record of a name: how many fail.  Not ``whole``: those that hold
    and say no more are counted, by what was tried."""
    from ..check.form.hypotheses_checked import in_a_line

    brief = [v for v in verdicts if v.holds and not v.note and v.of == "equation" and not whole]
    parts = Counter((v.label.partition(".")[0], ", ".join(v.tried[1])) for v in brief)
    for (part, groups), count in parts.items():
        print(f"holds  {part}: {count} step{'s' * (count != 1)}, at exact points of {groups}")
    for v in (x for x in verdicts if x not in brief):
        words = _trial_text(v) if v.holds else one_line(v.reason)
        print(f"{'holds' if v.holds else 'FAILS'}  {v.label}: {words}")
    print(f"{one_line(name)}: {in_a_line(verdicts)}")
    return sum(not v.holds for v in verdicts)


def _trial_text(v: Verdict) -> str:
    """What a verdict says was found to hold, and on which groups, as text."""
    count, groups = v.tried
    note = f"; {one_line(v.note)}" if v.note else ""
    return f"{count} {v.of}{'s' * (count != 1)} on {', '.join(groups)}{note}"


def command_paper(args: argparse.Namespace) -> int:
    """The note's numbered equations: confirmed, or what is wrong."""
    from ..views.book import as_json, as_text
    from ..views.language import language
    from ..views.paper import findings as paper
    from ..views.paper.findings import PAPER

    records = [derive(name)[1] for name in paper.PROBLEMS]
    findings = list(with_progress(paper.findings(records), len(PAPER), "equations"))
    if args.format == "json":
        shown = as_json(findings)
    else:
        shown = as_text(findings, language(args.lang), columns(args.out))
    save(shown, args.out, args.format)
    return 0


def command_build(args: argparse.Namespace) -> int:
    """All of generated/ again."""
    from ..code.emit import emit
    from ..programs import program
    from ..views.rendering import render
    from .writing import write

    def made(name: str) -> tuple[str, dict[str, str]]:
        problem, record = derive(name)
        files = {f"walk.{end}": render(record, form) for form, end in FILES.items()}
        return name, files | emit(program(problem, record), record, ("c", "python"), name)

    for name, files in with_progress(map(made, BUILT), len(BUILT), "problems"):
        for path in write(files, Path(args.out) / name):
            print(path, file=sys.stderr)
        if args.print:
            print(files["walk.txt"])
    return 0


def _in(module: str, about: str) -> Callable[[argparse.Namespace], int]:
    """The command of a module that is loaded when it is wanted; ``about``: its help."""

    def command(args: argparse.Namespace) -> int:
        found = import_module(f".{module}", __package__)
        return int(getattr(found, f"command_{args.command}")(args))

    command.__doc__ = about
    return command


BUILT = ("so3", "se3", "sl3")
FILES = {"text": "txt", "latex": "tex", "json": "json"}
COMMANDS = {
    "list": command_list,
    "walk": command_walk,
    "lecture": _in("lecturing", "A text for people, each claim a checked step: .pdf, .html …"),
    "notes": _in("noting", "All steps as lecture notes: .pdf, .html, .tex; .sty: macros."),
    "paper": command_paper,
    "symmetries": command_symmetries,
    "reduction": command_reduction,
    "integrals": command_integrals,
    "equilibria": command_equilibria,
    "trim": command_trim,
    "simulate": _in("simulating", "A motion, with what it keeps: a file, or a page that moves."),
    "plot": command_plot,
    "emit": command_emit,
    "compare": _in("simulating", "Your own right-hand side beside it: what is wrong in yours."),
    "check": command_check,
    "build": command_build,
}
"""In the order of the help."""


def _discard_stdout() -> None:
    """Drop what stdout holds, which the interpreter would try to write at its end."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


BROUGHT = {"numpy": "NumPy", "sympy": "SymPy"}
"""What comes with the package, though not in a browser, and is loaded where it is needed."""

ABOUT = """Describe a body: here are its equations of motion, derived step by step, each
step checked, and code that computes with them."""


def run(options: argparse.ArgumentParser, given: Sequence[str]) -> int:
    """Run the command of the arguments: its exit code."""
    try:
        args = options.parse_args(given or ["--help"])
    except SystemExit:
        sys.stdout.flush()  # the help: main tells what cannot be written
        raise
    with time_limit(getattr(args, "seconds", None)):
        return copy_context().run(heard, args)


def heard(args: argparse.Namespace) -> int:
    """The exit code of the command of some arguments; what it tells goes to stderr as it works."""
    LISTENER.set(lambda text: print(f"derive: note: {one_line(text)}", file=sys.stderr, flush=True))
    return int(args.run(args))


ENDING = (Refused, StoppedError, ModuleNotFoundError, MemoryError, RecursionError)
"""What ends a command with one line."""


def refusal(error: BaseException) -> str:
    """The line; it is raised again where it is a module that the package does not bring."""
    if isinstance(error, ModuleNotFoundError):
        if error.name not in BROUGHT:
            raise error
        return f"this needs {BROUGHT[error.name]}, which is not here"
    if isinstance(error, (MemoryError, RecursionError)):
        what = "out of memory" if isinstance(error, MemoryError) else "nested too deeply"
        return f"{what}: the input is too large for this machine"
    return one_line(error)


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command: 0, 1 when a check failed, 2 for bad input, 130 after Ctrl-C."""
    from .arguments import parser

    if sys.stdout is None:  # closed by who started us
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
    given = sys.argv[1:] if argv is None else argv
    try:
        with replacing_unencodable():
            status = run(parser(COMMANDS, ABOUT, given), given)
            sys.stdout.flush()
        return status
    except ENDING as error:
        print(f"derive: {refusal(error)}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # who reads has seen enough
        _discard_stdout()
        return 0
    except OSError as error:
        place = one_line(error.filename or "standard output")
        print(f"derive: {place}: {error.strerror}", file=sys.stderr)
        _discard_stdout()
        return 2
    except KeyboardInterrupt:
        return 130
