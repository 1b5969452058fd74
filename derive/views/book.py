"""Several records as one text: what holds for any group once, then a chapter for each problem."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from unicodedata import normalize

from ..language.tree import names
from ..record.record import ACTIONS, ANY_GROUP, Derivation, Step, Symbol
from ..record.sentence import english, say
from ..record.vocabulary import VOCABULARY
from .language import ENGLISH, Language
from .outline import title
from .system import system

VARIATIONS = ("δ′", "δ")
RATE = "\u0307"
MOTION = "Equations of motion"
SIDES = ("left", "right")
REGULAR = "Ẋ is the derivative of X along the motion; δX and δ′X are two variations of X."
GENERAL = {
    "linear": "For any group of matrices, linear action",
    "affine": "For any group of matrices, affine action",
    "left": "For any Lagrangian on a group, Z = g⁻¹ν on the left",
    "right": "For any Lagrangian on a group, Z = νg⁻¹ on the right",
    "discrete": "For any group of matrices, in steps of time",
    "discrete_affine": "For any group of affine maps, in steps of time",
    "both": "For any Lagrangian on a group, on the left beside the right",
}
"""Headings of what is said of any group, by what the labels begin with."""


@dataclass(frozen=True)
class BookPart:
    """A chapter: steps under a heading; ``name`` is the anchor; ``record``: of a problem's own
    part.

    ``symbols``: the letters to explain here, which no part before has with the same meaning.
    """

    name: str
    heading: str
    about: str
    steps: tuple[Step, ...]
    source: Derivation
    symbols: tuple[Symbol, ...]
    record: Derivation | None = None


def book(records: Sequence[Derivation], language: Language = ENGLISH) -> list[BookPart]:
    """The parts of several records: each step stands once, those of any group first."""
    parts: list[BookPart] = []
    seen: set[str] = set()
    explained: dict[str, str] = {}
    for d in records:
        left = [s for s in d.steps if s.scope == ANY_GROUP and s.label not in seen]
        for kind, general in _by_kind(left):
            heading = language.word(GENERAL.get(kind, GENERAL["linear"]))
            known = [*map(of_any_group, d.symbols)] if kind in ACTIONS else d.symbols
            letters = new_letters(known, general, explained)
            parts.append(BookPart(kind, heading, "", general, d, letters))
            seen |= {s.label for s in general}
    for d in records:
        own = tuple(s for s in d.steps if s.scope != ANY_GROUP)
        if own:
            letters = new_letters(d.symbols, own, explained)
            parts.append(
                BookPart(d.name, title(d, language), system(d, language), own, d, letters, d)
            )
    return parts


def _by_kind(steps: Sequence[Step]) -> Iterator[tuple[str, tuple[Step, ...]]]:
    """Steps of any group by what their labels begin with; both sides are one kind."""
    chapters = {s.label.partition(".")[0] for s in steps}
    both = dict.fromkeys(SIDES, "both") if chapters.issuperset(SIDES) else {}

    def kind(step: Step) -> str:
        chapter = step.label.partition(".")[0]
        return both.get(chapter, chapter)

    for name, some in groupby(steps, kind):
        yield name, tuple(some)


def new_letters(
    symbols: Sequence[Symbol], steps: Sequence[Step], explained: dict[str, str]
) -> tuple[Symbol, ...]:
    """The symbols of these steps whose meaning is not explained before; ``explained`` gets them.

    Without variations and rates, which have one rule.
    """
    sides = (x for s in steps for e in s.equations for x in (e.lhs, e.rhs))
    used = {name for side in sides for name in names(side)}
    found = []
    for s in symbols:
        meaning = english(s.meaning)
        if s.name in used and explained.get(s.name) != meaning and not _regular(s.name):
            explained[s.name] = meaning
            found.append(s)
    return tuple(found)


def parameters(d: Derivation | None, language: Language) -> list[tuple[list[str], str, str]]:
    """The parameters of a problem in runs of one meaning and unit: names, meaning, unit."""
    declared = d.problem.get("parameters") if d else None
    found: list[tuple[list[str], str, str]] = []
    for name, about in declared.items() if isinstance(declared, Mapping) else ():
        about = about if isinstance(about, Mapping) else {}
        meaning = language.word(str(about.get("meaning") or "parameter"))
        unit = str(about.get("unit") or "")
        if found and found[-1][1:] == (meaning, unit):
            found[-1][0].append(str(name))
        else:
            found.append(([str(name)], meaning, unit))
    return found


def of_any_group(s: Symbol) -> Symbol:
    """The symbol with the meaning that it has whatever the group."""
    known = VOCABULARY.get(s.name)
    return replace(s, meaning=say(known.meaning)) if known else s


def _regular(name: str) -> bool:
    """Is it a variation or rate as δA, δ′A, Ȧ, which REGULAR explains?"""
    return name.startswith(VARIATIONS) or RATE in normalize("NFD", name)


def steps(parts: Sequence[BookPart]) -> Iterator[tuple[BookPart, Step]]:
    """All steps of the parts, each with its part."""
    for part in parts:
        for step in part.steps:
            yield part, step
