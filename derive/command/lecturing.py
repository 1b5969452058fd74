"""``derive lecture``: the text for people, from its chapters and the records that prove it."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..language.limits import Refused
from ..language.show import show
from ..lecture import document, lecture_text, trials
from ..lecture.back_matter import Front
from ..lecture.fresh_numbers import drawn
from ..lecture.own_body import BodyOfLecture, OwnBody, place_of
from ..lecture.problem_chapter import Found, chapter_of
from ..lecture.ran_figure import Ran, letter_of
from ..lecture.recorded_text import OVER, UNSHOWN
from ..motion.emitted_code import VECTORS, parts
from ..motion.simulate import run
from ..motion.trajectory import Method
from ..pipeline import discrete, walk
from ..problem.fields import entry_places, state_names
from ..problem.problem import Problem
from ..problem.toml import load
from ..programs import motion_of, trim
from ..record.record import Derivation
from ..record.sentence import Sentence, phrase
from ..search import FIRST
from ..searches import equilibria, families, integrals, reduction, symmetries
from ..views.language import LANGUAGES, language
from .noting import pdf_of
from .showing import UsageError, derive, load_problem
from .writing import StoppedError, time_limit, with_progress, write

ENDINGS = (".tex", ".pdf", ".html")


def command_lecture(args: argparse.Namespace) -> int:
    """The lecture, a text for people whose claims are steps of walks: .tex, .pdf or .html."""
    out = Path(args.out)
    if out.suffix not in ENDINGS:
        raise UsageError(f"--out {args.out}: the name must end in {', '.join(ENDINGS)}")
    chapters = lecture_text.chapters(fresh=args.seed is not None)
    if args.seed is not None:
        chapters = drawn(chapters, args.seed, document.claims_of(chapters))
    records = records_of(chapters)
    body: OwnBody | None = None
    for name in args.problem:
        taken = body is not None
        own, found, its = chapter_on(name, args.search_seconds, taken=taken, lang=args.lang)
        if records.get(own.name, found[own.name]) != found[own.name]:
            raise UsageError(f"{name}: the lecture has another {own.name!r}: give it another name")
        chapters.append(own)
        records |= found
        body = body or its
    if body:
        chapters = about(body, chapters)
    for chapter in chapters:
        trials.tied(chapter, named_by(chapter, records))
    if args.check:
        tried = (len([*trials.tried(x, named_by(x, records))]) for x in chapters)
        print(f"{sum(with_progress(tried, len(chapters), 'chapters'))} equations hold")
    shown = document.page if out.suffix == ".html" else document.latex
    front = Front(args.title, args.author, args.course, args.date)
    text = shown(document.Lecture(chapters, language(args.lang), records, front, args.solutions))
    content = pdf_of(text, out, {}) if out.suffix == ".pdf" else text
    for path in write({out.name: content}, out.parent, links=True):
        print(path)
    return 0


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
CURVES = 3
"""The most curves of the picture of a motion."""


class OnProblem(NamedTuple):
    """The chapter on a problem of the user's, the records that its ties speak of, and its body,
    where that may have the place of the racket."""

    chapter: lecture_text.Chapter
    records: dict[str, Derivation]
    body: OwnBody | None


def chapter_on(
    name: str, seconds: float | None = None, *, taken: bool = False, lang: str = "en"
) -> OnProblem:
    """The chapter on a problem of the user's, each search for at most so many ``seconds`` of
    processor time; ``taken``: has another body the place of the racket? ``lang``: of what is said
    meanwhile."""
    problem, record = derive(name)
    found, records = {}, {record.name: record}
    asked = {k: x for k, x in SEARCHES.items() if k != "trim" or problem.inputs}
    for search, does in with_progress(asked.items(), len(asked), record.name):
        try:
            with time_limit(seconds):
                made = does(problem, record)
            records[f"{record.name}:{search}"] = made
            begins = f"{record.name}.{FIRST[search]}"
            there = any(x.label == begins for x in made.steps)
            found[search] = Found(made.since(begins) if there else ())
        except StoppedError:
            found[search] = Found(refused=OVER.format(seconds=f"{seconds:g}"))
        except Refused as error:
            found[search] = Found(refused=str(error))
    ran, speed = motion(problem, record)
    body, place = place_of(record, speed or 1.0, taken=taken)
    if body is None:
        print(f"{record.name}: {language(lang).of((place,))}", file=sys.stderr)
    # the momenta Π_a of a body are told by the searches alone
    made_of = [
        s for made in records.values() for s in made.steps if s.label == f"{record.name}.momenta"
    ]
    momenta = [s for s in made_of if ("at", "Π", 1) in (e.lhs for e in s.equations)][:1]
    told_of = replace(record, steps=(*dict.fromkeys((*momenta, *record.steps)),))
    chapter = chapter_of(told_of, found, tuple(records), place if body else None, ran)
    return OnProblem(replace(chapter, file=name), records, body)


def motion(problem: Problem, record: Derivation) -> tuple[Ran | Sentence, float]:
    """The motion of a problem from its start, or why there is none; how fast it turns at first."""
    try:
        code = motion_of(problem, record)
        made = run(code, problem, Method(), None, 400, given={}, compiled=False)
    except Refused as error:
        reason = str(error).removeprefix(f"{record.name}: ")
        return phrase(UNSHOWN, reason=reason), 0.0
    state = made.of_kind("state")
    rates = {x: y for x, y in state.items() if not x.startswith(("A_", "T_"))}
    turning = {x: y for x, y in rates.items() if x.startswith("zeta_")} or rates or state
    speed = math.hypot(*(float(y[0]) for y in turning.values()))
    widest = sorted(turning, key=lambda x: -float(np.ptp(turning[x])))[:CURVES]
    curves = [(x, y.tolist()) for x, y in turning.items() if x in widest]
    energy = [y.tolist() for y in made.of_kind("energy").values()]
    start = [(x, float(y[0])) for x, y in state.items()]
    kept = energy[0] if energy else ()
    units = {x.name: x.unit for x in code.columns()}
    momenta = {
        (VECTORS[base], k, x): y.tolist()
        for x, y in made.of_kind("conserved").items()
        for base, k in [parts(x)]
        if base in VECTORS and k
    }
    known = state_names(problem.group) if problem.group else {}
    moving = {show(known[x]): y.tolist() for x, y in state.items() if x in known}
    driven = [y for x in made.of_kind("input").values() for y in x]
    undriven = bool(driven) and not any(driven)
    turned = _turns(record, made.t, [y for x, y in turning.items()])
    ran = Ran(made.t.tolist(), curves, kept, [*_moved(problem, start)], units)
    return replace(ran, kept=momenta, state=moving, turned=turned, undriven=undriven), speed


def _turns(record: Derivation, times: Any, rates: Sequence[Any]) -> float:
    """By how many turns a body turns in all; 0 where its group is not that of a solid."""
    components = {"SO(2)": 1, "SO(3)": 3, "SE(3)": 3}.get(str(record.problem["group"]), 0)
    speed = np.linalg.norm(rates[:components], axis=0) if components else 0 * times
    return float(np.sum((speed[1:] + speed[:-1]) * np.diff(times))) / (4 * math.pi)


def _moved(problem: Problem, start: Sequence[tuple[str, float]]) -> Iterator[tuple[str, float]]:
    """The numbers of a start other than those of the identity at rest, by their letters."""
    known = state_names(problem.group) if problem.group else {}
    places = entry_places(problem.group) if problem.group else {}
    for name, value in start:
        i, j = places.get(name, (0, 1))
        if value != (i == j):
            yield show(known[name]) if name in known else letter_of(name), value


def about(body: OwnBody, chapters: list[lecture_text.Chapter]) -> list[lecture_text.Chapter]:
    """The chapters with a body in the place of the racket."""
    own = BodyOfLecture(body, document.claims_of(chapters))
    filled = [own.words(language(x)) for x in LANGUAGES]
    return [lecture_text.of_body(x, filled, own.figures) if x.of_course else x for x in chapters]


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
