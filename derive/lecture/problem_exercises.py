"""Exercises on a problem of the reader's, made of its records: what is kept, by hand; a sign to
find; a motion to predict."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from itertools import pairwise
from zlib import crc32

import numpy as np

from ..language.show import in_sentence, show
from ..language.tree import Tree, neg, nodes, replaced
from ..language.values import approximate
from ..record.record import Derivation, Equation, Step
from ..record.sentence import phrase
from ..views.language import ENGLISH, Language, told
from .lecture_text import Block, Entry, Formula, Typed, Words, words_of
from .ran_figure import Ran, written
from .recorded_text import SPOKEN, alone, display, in_each, kept_by, kind_of, sentence, words
from .search_sentences import of_momentum

HAND, MISTAKE, WATCH = "By hand.", "Find the mistake.", "Predict, then watch."
KEPT = "Show that this is constant along every motion:"
NOETHER = "It is what a symmetry of the Lagrangian leaves, {kind} (Noether)."
SIGN = "This equation of motion was copied with one sign changed. Which?"
TERM = "That of this term: {term}. The equation is"
START, NUMBERS = told("lecture:start"), told("lecture:numbers")
BETWEEN_WHICH, BETWEEN = told("lecture:between_which"), told("lecture:between")
SHOWN = "shows it."
MOST, CLOSE = 9, 1e-6
"""The most numbers of a start that an exercise says; what is 0 but for rounding."""


def exercises(
    d: Derivation,
    motion: Sequence[tuple[Equation, str]],
    kept: Sequence[Step],
    found: Sequence[Step],
    ran: Ran | None,
    command: str,
    short: Callable[[Equation], bool],
) -> Iterator[Block]:
    """Exercises on a problem by its record, each with its solution: on what the motion keeps, by
    the steps ``kept`` and by those that are ``found``, of integrals and of a reduction; on the
    equations of ``motion``, with the labels of their steps; on the motion that ran, which
    ``command`` shows; of equations that are ``short``."""
    fit = [x for x in kept if kept_by(x) != "h̃" and short(Equation("ϖ", kept_by(x)))]
    if fit:
        yield from _on_kept(d, max(fit, key=lambda x: len(in_sentence(kept_by(x)))), found)
    copied = [x for x in motion if short(x[0]) and len(_terms(x[0].rhs)) > 1]
    if copied:
        drawn = crc32(d.name.encode())
        yield from _on_sign(*copied[drawn % len(copied)], drawn // len(copied))
    if ran:
        yield from _on_motion(d, found, ran, command)


def _of(asked: Sequence[Entry], solved: Sequence[Entry]) -> list[Block]:
    return [Block("exercise", "", "", (*asked,), 0), Block("solution", "", "", (*solved,), 0)]


def _said(message: str, kind: str = "") -> Entry:
    """A sentence, after the kind of the exercise."""
    kinds = (f"_{x.word(kind)}_ " if kind else "" for x in SPOKEN)
    return in_each(*(words_of(y + x.word(message)) for x, y in zip(SPOKEN, kinds, strict=True)))


def _on_kept(d: Derivation, step: Step, integrals: Sequence[Step]) -> list[Block]:
    """What a step says to be kept, and that its rate is zero, where one of ``integrals`` has it."""
    kept = kept_by(step)
    solved = [sentence(lambda x: x.word(NOETHER, kind=kind_of(d, step, x)), (step.label,))]
    rate = Equation(("call", "d/dt", kept), 0)
    proved = [x.label for x in integrals for e in x.equations if (e.lhs, e.rhs) == (rate.lhs, 0)]
    solved += [display([rate], proved[:1])] if proved else []
    return _of([_said(KEPT, HAND), alone(kept)], solved)


def _terms(t: Tree) -> tuple[Tree, ...]:
    return t[1:] if isinstance(t, tuple) and t[0] == "add" else (t,)


def _on_sign(e: Equation, label: str, drawn: int) -> list[Block]:
    """An equation with the sign of one of its terms changed, the one that is ``drawn``."""
    terms = [*_terms(e.rhs)]
    k = drawn % len(terms)
    copied = Equation(e.lhs, ("add", *terms[:k], neg(terms[k]), *terms[k + 1 :]))
    asked = [_said(SIGN, MISTAKE), display([copied], condition=True)]
    term = (_with(x.word(TERM, term="\0"), terms[k]) for x in SPOKEN)
    return _of(asked, [in_each(*term), display([e], (label,))])


def _with(told: str, t: Tree) -> Words:
    before, _, after = told.partition("\0")
    return (before, Formula(in_sentence(t), condition=True), after)


def _on_motion(d: Derivation, steps: Sequence[Step], ran: Ran, command: str) -> Iterator[Block]:
    """Between which values a coordinate stays that moves by a quadrature, in the motion that ran;
    nothing where there is none, or the start is long to say. ``steps``: of the reduction."""
    step = next((s for s in steps if s.label == f"{d.name}.quadrature"), None)
    if step is None or not ran.energy or not 0 < len(ran.start) <= MOST:
        return
    places = between(d, step, _constants(d, steps, ran), ran)
    if not places:
        return
    start = ", ".join(f"{x} = {written(y)}" for x, y in ran.start)
    said = [START, *([NUMBERS] if d.problem.get("parameters") else []), BETWEEN_WHICH]
    asked = (
        (
            *words_of(f"_{x.word(WATCH)}_ "),
            *words(" ".join(_placed(y, {**places, "start": start}, x.marked) for y in said)),
            " ",
            Typed(command if x is ENGLISH else f"{command} --lang {x.name}"),
            f" {x.word(SHOWN)}",
        )
        for x in SPOKEN
    )
    answer = sentence(partial(_placed, BETWEEN, places), [step.label])
    yield from _of([in_each(*asked)], [answer])


def _constants(d: Derivation, steps: Sequence[Step], ran: Ran) -> dict[Tree, float]:
    """The energy and the momenta of a reduction at the start."""
    momenta = (e for s in steps for e in s.equations if of_momentum(e.lhs))
    return {"h̃": ran.energy[0]} | {e.lhs: _value(d, e.rhs, ran) for e in momenta}


def between(d: Derivation, step: Step, constants: Mapping[Tree, float], ran: Ran) -> dict[str, str]:
    """The roots of the polynomial of a quadrature on both sides of the first value of its
    coordinate, with what else the sentences on them say; empty where there are none, or where no
    number is known of a constant."""
    if not all(map(math.isfinite, constants.values())):
        return {}
    degree = [int(str(y)) for x in step.prose for name, y in x.places if name == "degree"]
    t = step.equations[0].rhs
    (u,) = {x for x in nodes(t) if isinstance(x, tuple) and x[0] == "entry"}
    for letter, number in constants.items():
        t = replaced(t, letter, Fraction(number))
    places = np.linspace(-1, 1, degree[0] + 1 if degree else 0)
    values = [_value(d, replaced(t, u, Fraction(x)), ran) for x in places]
    if not degree or not np.isfinite(values).all():
        return {}
    roots = np.roots(np.polyfit(places, values, degree[0]))
    first = _value(d, u, ran)
    for low, high in pairwise(sorted(x.real for x in roots if abs(x.imag) < CLOSE)):
        inside = _value(d, replaced(t, u, Fraction((low + high) / 2)), ran)
        if low - CLOSE < first < high + CLOSE and inside > 0:
            said = ", ".join(f"{show(x)} = {written(y)}" for x, y in constants.items())
            ends = {x: f"{y:.3f}".replace("-", "−") for x, y in (("low", low), ("high", high))}
            return {**ends, "letter": show(u), "given": said}
    return {}


def _value(d: Derivation, t: Tree, ran: Ran) -> float:
    """The value of an expression at the start of a motion; not a number where it has none."""
    momenta = (s for s in d.steps if s.label == f"{d.name}.momenta")
    for e in (e for s in momenta for e in s.equations if isinstance(e.lhs, tuple)):
        assert isinstance(e.lhs, tuple)
        if e.lhs[:2] == ("at", "Π") and isinstance(e.lhs[2], int):
            t = replaced(t, e.lhs, e.rhs)
    start = dict(ran.start)
    for x in {x for x in nodes(t) if isinstance(x, tuple) and x[0] == "entry"}:
        unmoved = float(x[1] == "A" and x[2] == x[-1])
        t = replaced(t, x, Fraction(start.get(show(x), unmoved)))
    given = {x: y["default"] for x, y in d.problem["parameters"].items()}
    found = approximate(t, {x: float(y) for x, y in given.items() if y is not None})
    return math.nan if found is None else found


def _placed(message: str, places: dict[str, str], spoken: Language) -> str:
    """A message with formulas in its places."""
    return spoken.sentence(phrase(message, **places))
