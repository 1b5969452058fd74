"""``derive emit``: what is asked for, the files of an emission read back, options refused."""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..code.emit import EmitError, archives, emit, included, planned
from ..code.languages import LANGUAGES
from ..code.options import ADDED, CHOICES, DEPENDENT, REPEATED, Options
from ..code.program import Program
from ..code.requests import EmissionRequest, request_of
from ..language.limits import Refused
from ..motion.first_numbers import first_numbers
from ..problem.bodies import negative_stiffness_of
from ..problem.problem import Problem, ProblemError
from ..programs import program, require_program
from ..record.record import Derivation
from .showing import UsageError, allowed, derive
from .writing import REMEDY, STDOUT, stale, text_on_disk

if TYPE_CHECKING:
    from ..validate.emission import Report


HEAD = 10_000
"""In so many characters a file says what it was made by."""


def languages(args: argparse.Namespace) -> tuple[str, ...]:
    """Those that are asked for."""
    return tuple(dict.fromkeys(args.lang or ("c", "python")))


def options(args: argparse.Namespace, others: Options | None = None) -> Options:
    """Those that are given; the rest as in others, or by default."""
    one = (*CHOICES, *DEPENDENT)
    given = {name: getattr(args, name) for name in one if getattr(args, name) is not None}
    given |= {x: tuple(dict.fromkeys(ys)) for x in REPEATED if (ys := getattr(args, x))}
    given |= {name: True for name in ADDED if getattr(args, name)}
    return replace(others or Options(), **given)


def allowances(p: Problem) -> tuple[str, ...]:
    """What may be negative in a problem, as the flags of the command line call it."""
    stiffness = negative_stiffness_of(p.potentials, p.damping, p.parameters)
    return ("mass",) * p.signed + ("stiffness",) * bool(stiffness)


def require_one_text(args: argparse.Namespace) -> None:
    """``UsageError`` where several files are to go to standard output, or some are looked for
    there."""
    if args.out != STDOUT:
        return
    files = planned(languages(args), args.prefix or "NAME", options(args))
    if args.check or len(files) > 1:
        raise UsageError(
            f"--out {STDOUT}: standard output takes one text, and these are files of a folder: "
            f"{', '.join(files)}; name the folder"
        )


def wanted(args: argparse.Namespace, p: Problem) -> EmissionRequest:
    """The emission that a command asks for."""
    prefix = p.name if args.prefix is None else args.prefix
    return EmissionRequest(p.name, prefix, languages(args), options(args), allowances(p))


def made(p: Problem, record: Derivation, e: EmissionRequest) -> tuple[Program, dict[str, str]]:
    """The program of an emission, and its files by name."""
    try:
        compiled = program(p, record, e.options)
    except ProblemError as error:
        if not e.options.conserved:
            raise
        require_program(p, record, e.options)  # what has no code at all says so itself
        raise ProblemError(f"{error}; without --conserved the rest is written") from None
    if "fmu" in e.languages:
        compiled = replace(compiled, start=at_start(compiled, p))
    return compiled, emit(compiled, record, e.languages, e.prefix, e.options, e.allowed)


def at_start(compiled: Program, p: Problem) -> tuple[tuple[float, ...], ...]:
    """The state, parameters and inputs at the start, all of which an FMU states."""
    if missing := [name for name, default, _, _ in compiled.parameters if default is None]:
        raise EmitError(
            f"{p.name}: --lang fmu needs a number for each parameter: give {missing[0]} a default "
            "in the problem"
        )
    return tuple(tuple(x) for x in first_numbers(compiled, p, {})[:3])


def packed(e: EmissionRequest, files: Mapping[str, str]) -> dict[str, str | bytes]:
    """The emitted files, and their archives where they have some."""
    return {**files, **(archives(e.prefix, files) if "fmu" in e.languages else {})}


def checked(args: argparse.Namespace) -> int:
    """0 where the files of a folder are what is emitted now, 1 where they are not, and how.

    What a file states holds but for what the command says.
    """
    folder = Path(args.out or ".")
    stated = statements(folder)
    as_stated = {f"negative_{x}": True for e in stated.values() for x in e.allowed}
    p, record = derive(args.problem, **allowed(args) | as_stated)
    own = {
        file: e
        for file, e in stated.items()
        if e.problem == p.name and args.prefix in (None, e.prefix)
    }
    right, reports = True, []
    for e, now in emissions(args, p, own.values()):
        compiled, files = made(p, record, now)
        places = planned(now.languages, now.prefix, now.options)
        chosen = {
            x for x, (name, _) in places.items() if name in covered(args.lang or now.languages)
        }
        files = {x: text for x, text in files.items() if x in chosen and own.get(x, e) == e}
        command = ["derive", "emit", args.problem, "--out", str(folder)]
        full = f"run: {shlex.join(command)} {' '.join(now.words)}"
        remedy = REMEDY if now == wanted(args, p) else full
        both = packed(now, files) if "fmu" in (args.lang or now.languages) else files
        old = stale(both, folder, included(args.lang or now.languages), remedy)
        for path, how in old.items():
            print(f"{path}: {how}")
        right = right and not old
        if args.validate:
            kept = {x: text_on_disk(folder / x) for x in files}
            reports += validated(kept, files, record, compiled, now)
    right = (not args.validate or all_hold(reports)) and right
    return 0 if right else 1


def statements(folder: Path) -> dict[str, EmissionRequest]:
    """What the emitted files of a folder say that they were made by."""
    ends = {
        x.rpartition(":")[2] for y in LANGUAGES.values() for form in y.files.values() for x in form
    }
    found = {}
    for path in sorted(folder.iterdir() if folder.is_dir() else ()):
        if path.is_file() and path.name.endswith(tuple(ends)):
            with path.open(encoding="utf-8", errors="replace") as file:
                e = request_of(file.read(HEAD))
            if e is not None:
                found[path.name] = e
    return found


def covered(names: Collection[str]) -> set[str]:
    """Some languages, and those whose files theirs include."""
    return {*names, *(LANGUAGES[x].needs for x in names)}


def emissions(
    args: argparse.Namespace, p: Problem, stated: Collection[EmissionRequest]
) -> Iterator[tuple[EmissionRequest, EmissionRequest]]:
    """Each emission that files state, and what it is now; then what no file states."""
    known = [*dict.fromkeys(stated)]
    for e in known:
        if not args.lang or {*args.lang} & covered(e.languages):
            yield e, replace(e, options=options(args, e.options), allowed=allowances(p))
    left = [x for x in languages(args) if not any(x in covered(e.languages) for e in known)]
    if left and (args.lang or not known):
        base = known[0].options if known else None
        prefix = args.prefix or (known[0].prefix if known else p.name)
        new = EmissionRequest(p.name, prefix, tuple(left), options(args, base), allowances(p))
        yield new, new


def validated(
    files: Mapping[str, str],
    fresh: Mapping[str, str],
    d: Derivation,
    program: Program,
    e: EmissionRequest,
) -> list[Report]:
    """Whether the files that can be read back equal the record, a line on stderr for each.

    ``fresh``: what is emitted now.
    """
    from ..validate import emission
    from ..validate.chart import Chart

    chart = Chart(*(getattr(e.options, x.name) for x in fields(Chart)))
    as_given = e.options.frame == "given"
    reports = emission.EmittedFiles(
        files, e.prefix, chart, program.numbers(), as_given, fresh
    ).reports(d)
    for report in reports:
        print(f"{', '.join(report.files)}: {report.text}", file=sys.stderr)
    return reports


def all_hold(reports: Collection[Report]) -> bool:
    """Do all files equal the record?  False, with a line on stderr, where none can be read back."""
    if not any(report.read for report in reports):
        print("derive: nothing of this can be validated", file=sys.stderr)
        return False
    return all(report.holds for report in reports)


# What each further option of an emission would be refused for, told before it is chosen.
#
# The reasons are the command's own: those that are known before the code is made.

Choice = tuple[tuple[str, ...], Options]
"""Languages and options."""


def refused(
    p: Problem, record: Derivation, languages: Sequence[str], chosen: Options
) -> dict[str, str]:
    """Option → why it cannot be chosen beside the others: ``lang julia``, ``step gauss``,
    ``momenta``; where what is chosen is refused itself, that alone, by the name ""."""
    own = (*languages,), chosen
    if reason := _reason(p, record, own):
        return {"": reason}
    reasons = {words: _reason(p, record, choice) for words, choice in further(*own)}
    return {words: reason for words, reason in reasons.items() if reason}


def further(languages: tuple[str, ...], chosen: Options) -> Iterator[tuple[str, Choice]]:
    """Each option that is not chosen, and the choice with it."""
    for name in LANGUAGES:
        if name not in languages:
            yield f"lang {name}", ((*languages, name), chosen)
    for name, (values, _) in (CHOICES | DEPENDENT).items():
        for x in values:
            if x != getattr(chosen, name):
                yield f"{name} {x}", (languages, _with(chosen, name, x))
    for name, (values, _) in REPEATED.items():
        given = getattr(chosen, name)
        for x in values:
            if x not in given:
                yield f"{name} {x}", (languages, _with(chosen, name, (*given, x)))
    for name in ADDED:
        if not getattr(chosen, name):
            yield name, (languages, _with(chosen, name, True))


def _with(chosen: Options, name: str, value: object) -> Options:
    changed: dict[str, Any] = {name: value}
    return replace(chosen, **changed)


def _reason(p: Problem, record: Derivation, choice: Choice) -> str:
    """Why a choice is refused; empty where it is not, as far as is known before it is made."""
    languages, options = choice
    try:
        require_program(p, record, options)
        planned(languages, p.name, options)
    except Refused as error:
        return str(error)
    return ""
