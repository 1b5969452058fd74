"""``derive lecture``: the text for people, from its chapters and the records that prove it."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

from ..language.limits import Refused
from ..lecture import document, lecture_text, trials
from ..lecture.back_matter import Front
from ..lecture.problem_chapter import Found, chapter_of
from ..pipeline import discrete, walk
from ..problem.problem import Problem
from ..problem.toml import load
from ..programs import trim
from ..record.record import Derivation
from ..search import FIRST
from ..searches import equilibria, families, integrals, reduction, symmetries
from ..views.language import language
from .noting import pdf_of
from .showing import UsageError, derive, load_problem
from .writing import with_progress, write

ENDINGS = (".tex", ".pdf", ".html")


def command_lecture(args: argparse.Namespace) -> int:
    """The lecture, a text for people whose claims are steps of walks: .tex, .pdf or .html."""
    out = Path(args.out)
    if out.suffix not in ENDINGS:
        raise UsageError(f"--out {args.out}: the name must end in {', '.join(ENDINGS)}")
    chapters = lecture_text.chapters()
    records = records_of(chapters)
    for name in args.problem:
        own, found = chapter_on(name)
        if records.get(own.name, found[own.name]) != found[own.name]:
            raise UsageError(f"{name}: the lecture has another {own.name!r}: give it another name")
        chapters.append(own)
        records |= found
    for chapter in chapters:
        trials.tied(chapter, named_by(chapter, records))
    if args.check:
        tried = (len([*trials.tried(x, named_by(x, records))]) for x in chapters)
        print(f"{sum(with_progress(tried, len(chapters), 'chapters'))} equations hold")
    shown = document.page if out.suffix == ".html" else document.latex
    front = Front(args.title, args.author, args.course, args.date)
    solutions = args.solutions == "end"
    text = shown(document.Lecture(chapters, language(args.lang), records, front, solutions))
    content = pdf_of(text, out, {}) if out.suffix == ".pdf" else text
    for path in write({out.name: content}, out.parent, links=True):
        print(path)
    return 0


SEARCHES: dict[str, Callable[[Problem, Derivation], Derivation]] = {
    "symmetries": lambda problem, record: symmetries(problem, record).record,
    "integrals": lambda problem, _: integrals(problem)[1],
    "reduction": lambda problem, record: reduction(problem, record).record,
    "equilibria": lambda problem, _: equilibria(problem, {})[1],
    "trim": lambda problem, _: trim(problem, {}, None, {})[1],
}
"""Search → the record of what it finds of a problem, by the record of its walk."""


RECORDS = SEARCHES | {
    "families": lambda problem, _: families(problem)[1],
    "discrete": lambda problem, _: discrete(problem),
}
"""And those of equilibria in letters and of the motion in steps."""


def chapter_on(name: str) -> tuple[lecture_text.Chapter, dict[str, Derivation]]:
    """The chapter on a problem of the user's, and the records that its ties speak of."""
    problem, record = derive(name)
    found, records = {}, {record.name: record}
    asked = {k: x for k, x in SEARCHES.items() if k != "trim" or problem.inputs}
    for search, does in with_progress(asked.items(), len(asked), record.name):
        try:
            made = records[f"{record.name}:{search}"] = does(problem, record)
            begins = f"{record.name}.{FIRST[search]}"
            there = any(x.label == begins for x in made.steps)
            found[search] = Found(made.since(begins) if there else ())
        except Refused as error:
            found[search] = Found(refused=str(error))
    return chapter_of(record, found, tuple(records)), records


def named_by(
    chapter: lecture_text.Chapter, records: dict[str, Derivation]
) -> dict[str, Derivation]:
    """The records that the ties of a chapter speak of."""
    return {name: records[name] for name in chapter.problems}


def records_of(chapters: Sequence[lecture_text.Chapter]) -> dict[str, Derivation]:
    """The records of all chapters by the names that these give them."""
    names = [*dict.fromkeys(x for c in chapters for x in c.problems)]
    made = with_progress(map(record_of, names), len(names), "walks")
    return dict(zip(names, made, strict=True))


def record_of(name: str) -> Derivation:
    """The record of a ready-made problem or of one beside the chapters; NAME:SEARCH, of what is
    found of it."""
    problem_name, _, search = name.partition(":")
    file = lecture_text.FOLDER / f"{problem_name}.toml"
    problem = load(file) if file.is_file() else load_problem(problem_name)
    record = walk(problem)
    return RECORDS[search](problem, record) if search else record
