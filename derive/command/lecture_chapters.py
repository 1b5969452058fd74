"""The chapters of the lecture on problems of the user's, and a body in the place of the racket."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ..language.limits import Refused
from ..language.show import show
from ..lecture import document, lecture_text
from ..lecture.own_body import BodyOfLecture, OwnBody, place_of
from ..lecture.problem_chapter import Found, chapter_of
from ..lecture.ran_figure import Ran, letter_of
from ..lecture.recorded_text import OVER, UNSHOWN
from ..motion.emitted_code import VECTORS, parts
from ..motion.simulate import run
from ..motion.trajectory import Method
from ..problem.fields import entry_places, state_names
from ..problem.problem import Problem
from ..programs import motion_of
from ..record.record import Derivation
from ..record.sentence import Sentence, phrase
from ..search import FIRST
from ..views.language import LANGUAGES, language
from .showing import derive
from .writing import StoppedError, time_limit, with_progress

Searches = Mapping[str, Callable[[Problem, Derivation], Derivation]]
"""Search → the record of what it finds of a problem, by the record of its walk."""
CURVES = 3
"""The most curves of the picture of a motion."""


class OnProblem(NamedTuple):
    """The chapter on a problem of the user's, the records that its ties speak of, and its body,
    where that may have the place of the racket."""

    chapter: lecture_text.Chapter
    records: dict[str, Derivation]
    body: OwnBody | None


def chapter_on(
    name: str,
    seconds: float | None = None,
    *,
    searches: Searches,
    taken: bool = False,
    lang: str = "en",
) -> OnProblem:
    """The chapter on a problem of the user's, by ``searches``, each for at most so many ``seconds``
    of processor time; ``taken``: has another body the place of the racket? ``lang``: of what is
    said meanwhile."""
    problem, record = derive(name)
    found, records = {}, {record.name: record}
    asked = {k: x for k, x in searches.items() if k != "trim" or problem.inputs}
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
