"""Entries of a chapter that are made of records: sentences in each language, equations of steps."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace

from ..language.show import in_sentence, show
from ..language.tree import Tree
from ..record.record import Equation
from ..views.as_read import Reading
from ..views.language import LANGUAGES, Language, language
from ..views.printing.sentences import prose
from .lecture_text import Block, Entry, Formula, Tie, Words, words_of

FACTOR = re.compile(r"(?<![^ ])(\(*[0-9]+) `(?=‘)")
SPOKEN: tuple[Language, ...] = tuple(map(language, LANGUAGES))


def words(text: str) -> Words:
    """A sentence of a record, whose formulas are as true as it; with them the numbers before
    parameters, and their brackets, which alone would be words."""
    return tuple(
        Formula(x.text, condition=True) if isinstance(x, Formula) else x
        for x in words_of(FACTOR.sub(r"`\1 ", prose(text, escape=str, formula="`{}`".format)))
    )


def in_each(*texts: Words, labels: Sequence[str] = ()) -> Entry:
    """An entry of a text in each language."""
    return Entry(texts, (Tie(tuple(labels)),) if labels else (), display=False, line=0)


def sentence(said: Callable[[Language], str], labels: Sequence[str] = ()) -> Entry:
    """A sentence in each language, by what it is in one."""
    return in_each(*(words(said(x)) for x in SPOKEN), labels=labels)


def alone(t: Tree) -> Entry:
    """The display of an expression of a step."""
    return Entry(((Formula(in_sentence(t), condition=True),),) * len(LANGUAGES), (), True, 0)


def display(
    equations: Sequence[Equation], labels: Sequence[str] = (), *, condition: bool = False
) -> Entry:
    """Equations of steps, one below the other; ``condition``: they are not tried."""
    text = ",  ".join(f"{show(e.lhs)} = {show(e.rhs)}" for e in equations)
    formula: Words = (Formula(text, condition, tuple(equations)),)
    ties = (Tie(tuple(labels)),) if labels else ()
    return Entry((formula,) * len(LANGUAGES), ties, display=True, line=0)


def as_read(block: Block, reading: Reading) -> Block:
    """A block of a chapter as it is read."""

    def part(x: str | Formula) -> str | Formula:
        if not isinstance(x, Formula):
            return x
        shown = tuple(map(reading.equation, x.recorded))
        return replace(x, text=reading.text(x.text), shown=shown)

    entries = (replace(x, texts=tuple(tuple(map(part, y)) for y in x.texts)) for x in block.entries)
    return replace(block, entries=tuple(entries))
