"""Exercises on a problem of the reader's, made of its records: what is kept, by hand; a sign to
find; a motion to predict."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from zlib import crc32

from ..language.show import in_sentence
from ..language.tree import Tree, neg
from ..record.record import Derivation, Equation, Step
from ..record.sentence import phrase
from ..views.language import ENGLISH, Language
from .lecture_text import Block, Entry, Formula, Typed, Words, words_of
from .ran_figure import Ran, letter_of, written
from .recorded_text import SPOKEN, alone, display, in_each, kept_by, kind_of, sentence, words

HAND, MISTAKE, WATCH = "By hand.", "Find the mistake.", "Predict, then watch."
KEPT = "Show that this is constant along every motion:"
NOETHER = "It is what a symmetry of the Lagrangian leaves, {kind} (Noether)."
SIGN = "This equation of motion was copied with one sign changed. Which?"
TERM = "That of this term: {term}. The equation is"
ASKED = (
    "The problem starts with {start}, at the identity and at rest but for these. Between which "
    "values does {letter} stay, until the time {time}?"
)
ASKED_WITH_PARAMETERS = (
    "The problem starts with {start}, at the identity and at rest but for these, and its "
    "parameters have the numbers of the table. Between which values does {letter} stay, until the "
    "time {time}?"
)
SHOWN = "shows it."
BETWEEN = "Between {low} and {high}."
SEEN, MOST = 0.05, 9
"""The part of the largest number of a figure by which a curve varies that is asked for; the most
numbers of a start that an exercise says."""


def exercises(
    d: Derivation,
    motion: Sequence[tuple[Equation, str]],
    kept: Sequence[Step],
    integrals: Sequence[Step],
    ran: Ran | None,
    command: str,
    short: Callable[[Equation], bool],
) -> Iterator[Block]:
    """Exercises on a problem by its record, each with its solution: on what the motion keeps, by
    the steps ``kept`` and ``integrals``, on the equations of ``motion``, with the labels of their
    steps, and on the motion that ran, which ``command`` shows; of equations that are ``short``."""
    fit = [x for x in kept if kept_by(x) != "h̃" and short(Equation("ϖ", kept_by(x)))]
    if fit:
        yield from _on_kept(d, max(fit, key=lambda x: len(in_sentence(kept_by(x)))), integrals)
    copied = [x for x in motion if short(x[0]) and len(_terms(x[0].rhs)) > 1]
    if copied:
        drawn = crc32(d.name.encode())
        yield from _on_sign(*copied[drawn % len(copied)], drawn // len(copied))
    if ran:
        yield from _on_motion(ran, command, parameters=bool(d.problem.get("parameters")))


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
    told = (_with(x.word(TERM, term="\0"), terms[k]) for x in SPOKEN)
    return _of(asked, [in_each(*told), display([e], (label,))])


def _with(told: str, t: Tree) -> Words:
    before, _, after = told.partition("\0")
    return (before, Formula(in_sentence(t), condition=True), after)


def _on_motion(ran: Ran, command: str, *, parameters: bool) -> list[Block]:
    """Between which values the number that varies most stays; nothing where that is hardly seen, or
    the start is long to say."""
    name, curve = max(ran.curves, key=lambda x: max(x[1]) - min(x[1]))
    largest = max(abs(x) for _, values in ran.curves for x in values)
    if max(curve) - min(curve) < SEEN * largest or not 0 < len(ran.start) <= MOST:
        return []
    start = ", ".join(f"{x} = {written(y)}" for x, y in ran.start)
    places = {"letter": letter_of(name), "time": f"{ran.times[-1]:g}", "start": start}
    low, high = min(curve), max(curve)
    digits = len(written(max(-low, high, key=abs), 3).partition(".")[2])
    told = {x: f"{y:.{digits}f}".replace("-", "−") for x, y in (("low", low), ("high", high))}
    message = ASKED_WITH_PARAMETERS if parameters else ASKED
    asked = (
        (
            *words_of(f"_{x.word(WATCH)}_ "),
            *words(_placed(message, places, x.marked)),
            " ",
            Typed(command if x is ENGLISH else f"{command} --lang {x.name}"),
            f" {x.word(SHOWN)}",
        )
        for x in SPOKEN
    )
    return _of([in_each(*asked)], [sentence(partial(_placed, BETWEEN, told))])


def _placed(message: str, places: dict[str, str], spoken: Language) -> str:
    """A message with formulas in its places."""
    return spoken.sentence(phrase(message, **places))
