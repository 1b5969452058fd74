"""Exercises on a problem of the reader's, made of its records: what is kept, by hand; a sign to
find; a motion to predict."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial

from ..language.tree import Tree, names, neg
from ..record.record import Equation, Step
from ..views.language import ENGLISH, Language
from .lecture_text import Block, Entry, Typed, words_of
from .ran_figure import Ran, letter_of
from .recorded_text import SPOKEN, display, in_each, sentence, words

HAND, MISTAKE, WATCH = "By hand.", "Find the mistake.", "Predict, then watch."
KEPT = "Show that this is constant along every motion:"
NOETHER = "It is what a symmetry of the Lagrangian leaves (Noether):"
SIGN = "This equation of motion was copied with one sign changed. Which?"
LAST = "That of the last term:"
ASKED = "Between which values does {letter} stay, from the start of the problem to the time {time}?"
SHOWN = "shows it."
BETWEEN = "Between {low} and {high}."


def exercises(
    motion: Sequence[tuple[Equation, str]],
    kept: Sequence[Step],
    ran: Ran | None,
    command: str,
    short: Callable[[Equation], bool],
) -> Iterator[Block]:
    """Exercises, each with its solution: on what the motion keeps, by the steps ``kept``, on the
    equations of ``motion``, with the labels of their steps, and on the motion that ran, which
    ``command`` shows; of equations that are ``short``."""
    several = (_on_kept(x, short) for x in kept)
    yield from max(filter(None, several), key=_length, default=())
    copied = [x for x in motion if short(x[0]) and len(_terms(x[0].rhs)) > 1]
    if copied:
        yield from _on_sign(*max(copied, key=lambda x: len(_terms(x[0].rhs))))
    if ran:
        yield from _on_motion(ran, command)


def _of(asked: Sequence[Entry], solved: Sequence[Entry]) -> list[Block]:
    return [Block("exercise", "", "", (*asked,), 0), Block("solution", "", "", (*solved,), 0)]


def _said(message: str, kind: str = "") -> Entry:
    """A sentence, after the kind of the exercise."""
    kinds = (f"_{x.word(kind)}_ " if kind else "" for x in SPOKEN)
    return in_each(*(words_of(y + x.word(message)) for x, y in zip(SPOKEN, kinds, strict=True)))


def _on_kept(step: Step, short: Callable[[Equation], bool]) -> list[Block]:
    """What a step says to be kept: its value, and that its rate is zero; nothing if it is long."""
    value = [e for e in step.equations if e.rhs != 0 and "ϖ" in names(e.lhs)]
    rate = [e for e in step.equations if e.rhs == 0 and "d/dt" in names(e.lhs)]
    if not value or not rate or not all(map(short, (*value, *rate))):
        return []
    asked = [_said(KEPT, HAND), display(value, condition=True)]
    return _of(asked, [_said(NOETHER), display(rate, (step.label,))])


def _length(blocks: Sequence[Block]) -> int:
    return max(len(x.text) for e in blocks[0].entries for x in e.formulas)


def _terms(t: Tree) -> tuple[Tree, ...]:
    return t[1:] if isinstance(t, tuple) and t[0] == "add" else (t,)


def _on_sign(e: Equation, label: str) -> list[Block]:
    """An equation with the sign of its last term changed."""
    *others, last = _terms(e.rhs)
    copied = Equation(e.lhs, ("add", *others, neg(last)))
    asked = [_said(SIGN, MISTAKE), display([copied], condition=True)]
    return _of(asked, [_said(LAST), display([e], (label,))])


def _on_motion(ran: Ran, command: str) -> list[Block]:
    """Between which values the number that varies most stays."""
    name, curve = max(ran.curves, key=lambda x: max(x[1]) - min(x[1]))
    places = {"letter": letter_of(name), "time": f"{ran.times[-1]:g}"}
    ends = {"low": min(curve), "high": max(curve)}
    told = {k: f"{y:.3g}".replace("-", "−") for k, y in ends.items()}
    asked = (
        (
            *words_of(f"_{x.word(WATCH)}_ "),
            *words(x.word(ASKED, **places)),
            " ",
            Typed(command if x is ENGLISH else f"{command} --lang {x.name}"),
            f" {x.word(SHOWN)}",
        )
        for x in SPOKEN
    )
    return _of([in_each(*asked)], [sentence(partial(_between, told))])


def _between(ends: dict[str, str], spoken: Language) -> str:
    return spoken.word(BETWEEN, **ends)
