"""``derive lecture``: the text for people, from its chapters and the records that prove it."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from ..language.limits import Refused
from ..lecture import document, lecture_text, ticked_steps, trials
from ..lecture.back_matter import Front
from ..lecture.ran_figure import label_of
from ..motion.trajectory import Method
from ..pipeline import discrete, walk
from ..problem.problem import Problem
from ..problem.toml import load
from ..programs import trim
from ..record.record import Derivation
from ..searches import equilibria, families, integrals, reduction, symmetries
from ..views.language import language
from ..views.outline import title
from .noting import pdf_of
from .showing import UsageError, derive, load_problem
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
    moving = dict(MOVING)
    if args.problem:
        chapters = with_problems(args, chapters, records, moving)
    for chapter in chapters:
        trials.tied(chapter, named_by(chapter, records))
    if args.check:
        tried = (len([*trials.tried(x, named_by(x, records))]) for x in chapters)
        print(f"{sum(with_progress(tried, len(chapters), 'chapters'))} equations hold")
    front = Front(args.title, args.author, args.course, args.date)
    lecture = document.Lecture(chapters, language(args.lang), records, front, args.solutions)
    if out.suffix == ".html":
        judgements = ticked_steps.judged(chapters, records) if args.check else {}
        frames = frames_of(chapters, moving, args.lang)
        text = document.page(replace(lecture, judgements=judgements, frames=frames))
    else:
        text = document.latex(lecture)
    content = pdf_of(text, out, {}) if out.suffix == ".pdf" else text
    for path in write({out.name: content}, out.parent, links=True):
        print(path)
    return 0


MOVING = {"polhodes": "euler_top", "paths": "top"}
"""Label of a figure of the course → the problem that moves behind it on the page."""


def frames_of(
    chapters: Sequence[lecture_text.Chapter], moving: Mapping[str, str], lang: str
) -> dict[str, document.Frame]:
    """The pages that stand behind figures of the chapters; none where a problem has no motion."""
    from .simulating import moving_page  # which other documents need not

    labels = {b.label for c in chapters for b in c.blocks if b.kind == "figure"}
    found: dict[str, document.Frame] = {}
    for name in dict.fromkeys(x for label, x in moving.items() if label in labels):
        with suppress(Refused):
            problem, record = derive(name)
            page = moving_page(problem, record, None, Method(), lang, given={})
            found[name] = document.Frame(title(record, language(lang)), page)
    return {x: found[name] for x, name in moving.items() if x in labels and name in found}


def with_problems(
    args: argparse.Namespace,
    chapters: list[lecture_text.Chapter],
    records: dict[str, Derivation],
    moving: dict[str, str],
) -> list[lecture_text.Chapter]:
    """The chapters with one on each problem of the user's, whose records come to the others, and
    what is ``moving`` behind their figures."""
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
        moving |= dict.fromkeys((label_of(own.name), *(["polhodes"] if its else [])), name)
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
