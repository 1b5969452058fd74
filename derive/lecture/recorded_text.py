"""Entries of a chapter that are made of records: sentences in each language, equations of steps."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..language.show import in_sentence, show
from ..language.tree import Tree
from ..record.record import Equation
from ..views.language import LANGUAGES, Language, language
from ..views.printing.sentences import FORMULA
from .lecture_text import Entry, Formula, Tie, Words

SPOKEN: tuple[Language, ...] = tuple(map(language, LANGUAGES))


def words(text: str) -> Words:
    """A sentence of a record with marks, whose formulas are as true as it."""
    parts = enumerate(text.split(FORMULA))
    return tuple(Formula(x, condition=True) if k % 2 else x for k, x in parts if x)


def in_each(*texts: Words, labels: Sequence[str] = ()) -> Entry:
    """An entry of a text in each language."""
    return Entry(texts, (Tie(tuple(labels)),) if labels else (), display=False, line=0)


def sentence(said: Callable[[Language], str], labels: Sequence[str] = ()) -> Entry:
    """A sentence in each language, by what it is in one."""
    return in_each(*(words(said(x.marked)) for x in SPOKEN), labels=labels)


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
