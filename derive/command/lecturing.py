"""``derive lecture``: the text for people, from its chapters and the records that prove it."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from ..lecture import document, lecture_text, ticked_steps, trials
from ..lecture.back_matter import Front
from ..pipeline import discrete, walk
from ..problem.problem import Problem
from ..problem.toml import load
from ..programs import trim
from ..record.record import Derivation
from ..searches import equilibria, families, integrals, reduction, symmetries
from ..views.language import language
from .noting import pdf_of
from .showing import UsageError, load_problem
from .writing import with_progress, write

ENDINGS = (".tex", ".pdf", ".html")


def command_lecture(args: argparse.Namespace) -> int:
    """The lecture, a text for people whose claims are steps of walks: .tex, .pdf or .html."""
    out = Path(args.out)
    if out.suffix not in ENDINGS:
        raise UsageError(f"--out {args.out}: the name must end in {', '.join(ENDINGS)}")
    chapters = lecture_text.chapters(fresh=args.seed is not None)
    if args.seed is not None:
        from ..lecture.fresh_numbers import drawn  # as below, what most texts need not

        chapters = drawn(chapters, args.seed, document.claims_of(chapters))
    records = records_of(chapters)
    if args.problem:
        chapters = with_problems(args, chapters, records)
    for chapter in chapters:
        trials.tied(chapter, named_by(chapter, records))
    if args.check:
        tried = (len([*trials.tried(x, named_by(x, records))]) for x in chapters)
        print(f"{sum(with_progress(tried, len(chapters), 'chapters'))} equations hold")
    front = Front(args.title, args.author, args.course, args.date)
    lecture = document.Lecture(chapters, language(args.lang), records, front, args.solutions)
    if out.suffix == ".html":
        judgements = ticked_steps.judged(chapters, records) if args.check else {}
        text = document.page(replace(lecture, judgements=judgements))
    else:
        text = document.latex(lecture)
    content = pdf_of(text, out, {}) if out.suffix == ".pdf" else text
    for path in write({out.name: content}, out.parent, links=True):
        print(path)
    return 0


def with_problems(
    args: argparse.Namespace, chapters: list[lecture_text.Chapter], records: dict[str, Derivation]
) -> list[lecture_text.Chapter]:
    """The chapters with one on each problem of the user's, whose records come to the others."""
    from .lecture_chapters import about, chapter_on

    body = None
    for name in args.problem:
        taken = body is not None
        own, found, its = chapter_on(
            name, args.search_seconds, searches=SEARCHES, taken=taken, lang=args.lang
        )
        if records.get(own.name, found[own.name]) != found[own.name]:
            raise UsageError(f"{name}: the lecture has another {own.name!r}: give it another name")
        chapters.append(own)
        records |= found
        body = body or its
    return about(body, chapters) if body else chapters


SEARCHES: dict[str, Callable[[Problem, Derivation], Derivation]] = {
    "symmetries": lambda problem, record: symmetries(problem, record).record,
    "integrals": lambda problem, _: integrals(problem)[1],
    "reduction": lambda problem, record: reduction(problem, record).record,
    "equilibria": lambda problem, _: equilibria(problem, {})[1],
    "families": lambda problem, _: families(problem)[1],
    "trim": lambda problem, _: trim(problem, {}, None, {})[1],
}
"""Search → the record of what it finds of a problem, by the record of its walk."""


RECORDS = SEARCHES | {"discrete": lambda problem, _: discrete(problem)}
"""And that of the motion in steps."""


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
