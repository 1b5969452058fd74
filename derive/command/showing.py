"""What a command shows: lists, the problem that it names, steps of its record."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..algebra.families import FAMILIES
from ..language.limits import Refused
from ..problem.fields import entry_places
from ..problem.problem import Problem, ProblemError
from ..record.record import Derivation, Step
from ..schema.table import nearest
from ..search import FIRST
from ..views.printing.typeset import WIDTH
from ..views.rendering import render, unprinted
from .writing import as_in_a_file, one_line, show, write

if TYPE_CHECKING:
    from ..algebra.groups import Group
    from ..search.equilibria.trim import Trim

# The list of groups and ready-made problems that ``derive list`` prints.


def listing(problems: Mapping[str, Problem]) -> str:
    """The text of the list: groups with their sizes, then problems by name."""
    lines = ["groups"]
    for name, family in FAMILIES.items():
        sizes = f"n = {family.least} … {family.most}"
        lines.append(f"  {name + '(n)':8} {sizes}  {family.meaning}")
    lines.append('  products of these, "SO(3) x SE(3)", and any group given by a basis')
    lines.append("problems")
    groups = {name: p.group_name for name, p in problems.items()}
    widest, wider = (max(map(len, x)) for x in (groups, groups.values()))
    for name, p in problems.items():
        lines.append(f"  {name:{widest}}  {groups[name]:{wider}}  {p.title}")
    return "\n".join(lines)


# The problem that a command names, and its walk.

ALLOWED = {"mass": "mass", "stiffness": "stiffness or damping"}
"""What may be negative where a flag allows it: the name in the flag → the quantity in messages."""
NEAR = 3
"""How many ready-made problems are named that are nearly called so."""
READY = Path(__file__).resolve().parents[1] / "problems"
LECTURE = READY.with_name("lecture") / "chapters"
"""The problems that the lecture alone tells of."""


class UsageError(Refused):
    """Bad input on the command line: one clear line, and the exit code 2."""


def each_once(option: str, pairs: Sequence[tuple[str, Any]] | None) -> dict[str, Any]:
    """The numbers that an option gives by names; ``UsageError`` for a name that stands twice."""
    several = Counter(name for name, _ in pairs or ())
    if twice := [name for name, count in several.items() if count > 1]:
        raise UsageError(f"{option} {twice[0]}: given more than once; leave out all but one")
    return dict(pairs or ())


def ready_made() -> list[str]:
    """The names of the ready-made problems."""
    return sorted(f.name.removesuffix(".toml") for f in READY.iterdir() if f.name.endswith(".toml"))


def load_problem(name: str, **allowances: bool) -> Problem:
    """A ready-made problem by name, or a TOML file by path, or a problem of the lecture by name;
    ``allowances``: what may be negative, as in ``problem.toml.load``. ``ProblemError`` where there
    is none of them."""
    from ..problem.toml import load

    if name in ready_made():
        return load(READY / f"{name}.toml")
    path = Path(name)
    if path.suffix == ".toml" or path.exists():
        return load(path, **allowances)
    if path.name == name and (of_lecture := LECTURE / f"{name}.toml").is_file():
        return load(of_lecture)
    if "\n" in name:
        raise ProblemError("a problem is a name or a .toml file, not its text: write it to a file")
    near = get_close_matches(name.lower()[:60], ready_made(), NEAR, 0.5)
    if path.with_name(f"{path.name}.toml").is_file():
        near = [f"{name}.toml"[:60]]
    hint = f"did you mean {' or '.join(map(repr, near))}? " if near else ""
    raise ProblemError(
        f"unknown problem {name[:60]!r}; {hint}derive list has the ready-made ones; "
        "or give a .toml file"
    )


def doubted(
    name: str, *, followed: bool = False, given: Mapping[str, float] | None = None, **allows: bool
) -> Problem:
    """A problem, with warnings of what may be meant otherwise in it.

    ``followed``: a motion is to be, which refuses names that the state has not; ``given``: numbers
    of parameters in place of their defaults.
    """
    from ..problem.toml import doubts

    problem = load_problem(name, **allows)
    for doubt in doubts(problem, given or {}, followed=followed):
        print(f"derive: warning: {one_line(name)}: {one_line(doubt)}", file=sys.stderr)
    return problem


def derive(name: str, **chosen: Any) -> tuple[Problem, Derivation]:
    """A problem, :func:`doubted`, and its record; ``UsageError`` where it has no walk."""
    from ..pipeline import walk

    problem = doubted(name, **chosen)
    try:
        return problem, walk(problem)
    except ProblemError as error:
        raise UsageError(f"{name}: {error}") from None


def discrete_walk(name: str, **allowances: Any) -> tuple[Problem, Derivation]:
    """A problem, :func:`doubted`, and the record of its discrete motion."""
    from ..pipeline import discrete

    problem = doubted(name, **allowances)
    return problem, discrete(problem)


def allowed(args: argparse.Namespace) -> dict[str, bool]:
    """The keywords of :func:`load_problem` for what the flags allow to be negative."""
    return {f"negative_{x}": getattr(args, f"allow_negative_{x}") for x in ALLOWED}


# What a command shows of a record: which of its steps, in which notation, to where.

LEAST, MOST = 40, 120
"""The fewest and the most columns of a text."""


def save(text: str, out: str | None, form: str, *, paged: bool = True) -> None:
    """Write a text of one of the formats to stdout, where it may be ``paged``, or whole to the file
    ``out``."""
    if out is None:
        if form != "text":
            as_in_a_file()
        text = text if text.endswith("\n") else text + "\n"
        show(text, paged=paged) if form == "text" else sys.stdout.write(text)
    else:
        path = Path(out)
        write({path.name: text}, path.parent, links=True)


def columns(out: str | None) -> int:
    """How many columns a line of text has: on standard output those of the terminal, or COLUMNS; as
    many as ever in the file ``out``, and where another program reads."""
    if out is not None or not (sys.stdout.isatty() or os.environ.get("COLUMNS")):
        return WIDTH
    return min(max(shutil.get_terminal_size((WIDTH, 24)).columns, LEAST), MOST)


def save_steps(
    record: Derivation,
    steps: Sequence[Step],
    args: argparse.Namespace,
    *,
    answer: bool = False,
    by_block: Mapping[str, str] | None = None,
    before: Sequence[str] = (),
) -> None:
    """Write some steps of a record, its answer with names ``by_block``, or all of it, as the
    options of a command ask; lines ``before`` stand at the head of a text."""
    chosen = {"fragment": args.fragment, "steps": steps, "answer": answer, **notation(args)}
    wide = columns(args.out)
    shown = render(record, args.format, args.lang, width=wide, by_block=by_block, **chosen)
    if args.format == "latex":
        warn_of_letters([record])
    if args.format == "text" and before:
        shown = "\n".join((*before, "", shown))
    save(shown, args.out, args.format, paged=not answer)


def save_found(record: Derivation, args: argparse.Namespace, before: Sequence[str] = ()) -> None:
    """Write the steps of a record that are asked for, else those that tell what the search of the
    command found; in JSON all, which can be checked."""
    steps: Sequence[Step] = steps_of(record, getattr(args, "labels", ()))
    if not steps and args.format != "json":
        steps = record.since(FIRST[args.command])
    save_steps(record, steps, args, before=before)


SMALL = 1e-12
"""A number of the state that is nearer to that of g = 1, or to 0, is not listed."""


def trim_lines(found: Trim, group: Group, units: Mapping[str, str], lang: str) -> list[str]:
    """A trim at a glance: the inputs, and what of the state is not that of g = 1 and rest, by the
    names of the options, with their units, and its verdict."""
    from ..views.language import language

    words, places = language(lang), entry_places(group)
    rows = {x: float(y) for x, y in found.inputs.items()}
    for name, y in found.state.items():
        here, (i, j) = float(y), places.get(name, (0, 1))
        if abs(here - int(i == j)) > SMALL:
            rows[name] = here
    shown = [(x, words.decimal(y), units.get(x, "")) for x, y in rows.items()]
    if found.verdict != "open":
        growth = max(x.real for x in found.eigenvalues)
        shown.append((words.word(found.verdict), f"Re λ ≤ {words.decimal(growth)}", "1/s"))
    wide, wider = (max(len(x[k]) for x in shown) for k in (0, 1)) if shown else (0, 0)
    return [f"  {name:{wide}}  {y:>{wider}}  {unit}".rstrip() for name, y, unit in shown]


def steps_of(record: Derivation, labels: Sequence[str]) -> list[Step]:
    """The steps with these labels, which may lack the problem's name; ``UsageError`` for others."""
    by_label = {s.label: s for s in record.steps}
    short = {x.removeprefix(f"{record.name}."): x for x in by_label}
    found: list[Step] = []
    for label in labels:
        if label not in by_label and label not in short:
            own = [x for x, y in short.items() if y.startswith(f"{record.name}.")]
            listed = f"; of this problem are {', '.join(own)}" if own else ""
            hint = nearest(label, {*short, *by_label}) or listed
            raise UsageError(f"{record.name} has no step {label[:60]!r}{hint}")
        found.append(by_label[short.get(label, label)])
    return found


def warn_of_letters(records: Sequence[Derivation]) -> None:
    """Warn on stderr of the letters of some records that LaTeX does not have."""
    if lost := unprinted(records):
        shown = ", ".join(lost[:20])
        print(f"derive: warning: LaTeX has no {one_line(shown)} here, and shows ?", file=sys.stderr)


def notation(args: argparse.Namespace) -> dict[str, str]:
    """The notations that were chosen for transposes and skew matrices."""
    return {"transpose": args.notation, "hat": args.hat}
