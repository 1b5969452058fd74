"""What a command shows of a record: which of its steps, in which notation, to where."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from ..printing.line_breaking import WIDTH
from ..record.record import Derivation, Step
from ..schema.table import nearest
from ..views.rendering import render, unprinted
from .encoding import as_in_a_file
from .guard import one_line
from .loading import UsageError

LEAST = 40
"""The fewest columns of a text."""


def save(text: str, out: str | None, form: str) -> None:
    """Write a text of one of the formats to stdout, or whole to the file ``out``."""
    from .writing import write

    if out is None:
        if form != "text":
            as_in_a_file()
        sys.stdout.write(text if text.endswith("\n") else text + "\n")
    else:
        path = Path(out)
        write({path.name: text}, path.parent, links=True)


def columns(out: str | None) -> int:
    """How many columns a line of text has: on standard output those of the terminal, or COLUMNS; as
    many as ever in the file ``out``, and where another program reads."""
    if out is not None or not (sys.stdout.isatty() or os.environ.get("COLUMNS")):
        return WIDTH
    return max(shutil.get_terminal_size((WIDTH, 24)).columns, LEAST)


def save_steps(record: Derivation, steps: Sequence[Step], args: argparse.Namespace) -> None:
    """Write some steps of a record, or all of it, as the options of a command ask."""
    chosen = {"fragment": args.fragment, "steps": steps, **notation(args)}
    shown = render(record, args.format, args.lang, width=columns(args.out), **chosen)
    if args.format == "latex":
        warn_of_letters([record])
    save(shown, args.out, args.format)


def save_record(
    record: Derivation, own: Callable[[Derivation], list[Step]], args: argparse.Namespace
) -> None:
    """Write the steps of a record that are asked for, else its ``own``; in JSON all."""
    steps = steps_of(record, args.labels)
    if not steps and args.format != "json":
        steps = own(record)
    save_steps(record, steps, args)


def told_steps(record: Derivation, first: str = "poisson") -> list[Step]:
    """The steps of a record from one on: those that tell integrals, or equilibria."""
    labels = [step.label for step in record.steps]
    return [*record.steps[labels.index(f"{record.name}.{first}") :]]


def steps_of(record: Derivation, labels: Sequence[str]) -> list[Step]:
    """The steps with these labels, which may lack the problem's name; ``UsageError`` for others."""
    by_label = {s.label: s for s in record.steps}
    short = {x.removeprefix(f"{record.name}."): x for x in by_label}
    found = []
    for label in labels:
        if label not in by_label and label not in short:
            hint = nearest(label, {*short, *by_label})
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
