"""What searches find of first integrals and of the reduction of a problem, in sentences of a text
for people: what is sought and where, its equations, what follows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby

from ..language.show import in_sentence
from ..language.tree import Tree
from ..record.prose import message
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Prose, Sentence, enumerated, phrase
from ..views.language import labelled, told
from .lecture_text import Entry
from .recorded_text import display, kind_of, lecture, sentence, stated, symmetry_kind
from .steady_sentences import variables_of

LECTURE = "lecture."
RETOLD = [x.removeprefix(LECTURE) for x in labelled() if x.startswith(LECTURE)]
"""Labels of sentences of the record instead of which the lecture has one of the same places."""
SAID_AGAIN = {message(x): told(f"{LECTURE}{x}") for x in RETOLD}
FREE, DIVIDED = message("reduction.free"), message("reduction.divided")
NAMED = message("reduction.named")
WORDS = {"2": "two", "3": "three", "4": "four"}
BOTH = "{first} and {second}"


def space(steps: Sequence[Step]) -> Iterator[Entry]:
    """Of which variables the integrals are, in which bracket, and how degrees are counted."""
    for step in (s for s in steps if s.label.endswith(".poisson")):
        first, *others = step.prose
        where = "space_of_group" if first.message == message("poisson.group") else "space"
        told_first = lecture(where, variables=", ".join(variables_of(step)))
        yield sentence((told_first, *map(retold, others)), [step.label])


def momenta(d: Derivation, steps: Sequence[Step]) -> Iterator[Entry]:
    """The symmetries by which a problem is reduced, and their momenta."""
    found = [(s, e) for s in steps for e in s.equations if of_momentum(e.lhs)]
    if not found:
        return
    used = [s for s, _ in found]
    kinds = enumerated([kind_of(d, [*run]) for _, run in groupby(used, symmetry_kind)])
    yield stated("along" if used[1:] else "by_one", kinds=kinds)
    yield display([e for _, e in found], [s.label for s in used])


def of_momentum(t: Tree) -> bool:
    """Is it one of the momenta of a reduction?"""
    return isinstance(t, tuple) and t[:2] == ("at", "𝒥")


def around(step: Step) -> tuple[Prose, Prose]:
    """What is said of a step before its equations, and what behind them."""
    said = {x.message for x in step.prose}
    left_out = {NAMED, *({DIVIDED} if FREE in said else ())}
    first, *others = [retold(x, step.equations) for x in step.prose if x.message not in left_out]
    return (first,), (*others,)


def retold(x: Sentence, equations: Sequence[Equation] = ()) -> Sentence:
    """A sentence as the lecture says it; integrals, which the record numbers, by themselves."""
    places = [(name, _named(name, y, equations)) for name, y in x.places]
    return replace(x, message=SAID_AGAIN.get(x.message, x.message), places=tuple(places))


def _named(name: str, value: Sentence | str, equations: Sequence[Equation]) -> Sentence | str:
    """The integrals of some numbers, how many they are in a word; any other value as it is."""
    if not isinstance(value, str):
        return value
    if name == "half":
        return phrase(WORDS[value]) if value in WORDS else value
    if name not in ("number", "numbers"):
        return value
    *first, last = (_constant(equations, int(x)) for x in value.split(", "))
    return phrase(BOTH, first=", ".join(first), second=last) if first else last


def _constant(equations: Sequence[Equation], number: int) -> str:
    """An integral, by the equation that its rate is 0; of the first one, the energy, its name."""
    lhs = equations[number - 1].lhs
    assert isinstance(lhs, tuple)
    return in_sentence(lhs[-1] if number > 1 else "h̃")
