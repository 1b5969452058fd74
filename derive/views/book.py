"""Several records as one text, and what is said of the paper's print beside them."""

from __future__ import annotations

import json
import re
import textwrap
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import groupby
from typing import Any
from unicodedata import normalize

from ..language.tree import Tree, names
from ..record.prose import unmarked
from ..record.record import ACTIONS, ANY_GROUP, Derivation, Step, Symbol
from ..record.sentence import english, say
from ..record.vocabulary import VOCABULARY
from .language import ENGLISH, Language
from .outline import Letter, parameters, system, title
from .paper.findings import OMISSION, SIGN, VERDICTS, PaperFinding
from .printing.typeset import WIDTH

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

    def letters(self, language: Language) -> Iterator[Letter]:
        """These letters with their meanings, then the parameters of the problem."""
        for s in self.symbols:
            yield Letter((s.name,), language.marked.of(s.meaning))
        yield from parameters(self.record, language, defaults=False)


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
                BookPart(d.name, title(d, language), system(d, language.marked), own, d, letters, d)
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


def of_any_group(s: Symbol) -> Symbol:
    """The symbol with the meaning that it has whatever the group."""
    known = VOCABULARY.get(s.name)
    return replace(s, meaning=say(unmarked(known.meaning))) if known else s


def _regular(name: str) -> bool:
    """Is it a variation or rate as δA, δ′A, Ȧ, which REGULAR explains?"""
    return name.startswith(VARIATIONS) or RATE in normalize("NFD", name)


def steps(parts: Sequence[BookPart]) -> Iterator[tuple[BookPart, Step]]:
    """All steps of the parts, each with its part."""
    for part in parts:
        for step in part.steps:
            yield part, step


# Corrections of the paper's print: what it says, why that is wrong, a counterexample.

FORMULA = re.compile("\ue000([^\ue001]*)\ue001")
"""The number of a formula among the words of a sentence."""

TRUE = {
    SIGN: "This is true in the other convention of signs, with −dϖ for dϖ.",
    OMISSION: "This is true where there are no forces.",
}
"""Verdict → how a print that is false as it stands is true."""


@dataclass(frozen=True)
class Passage:
    """A stretch of a correction: words, or a formula whose sides are equal."""

    text: str
    formula: tuple[Tree, ...] = ()

    def shown(self, words: Callable[[str], str], formula: Callable[[Sequence[Tree]], str]) -> str:
        """The stretch in a language of markup; the spaces at the ends of words stay."""
        if self.formula:
            return formula(self.formula)
        inside = self.text.strip()
        before, _, after = self.text.partition(inside) if inside else (self.text, "", "")
        return f"{before}{words(inside)}{after}"


def corrections(
    parts: Sequence[BookPart], findings: Sequence[PaperFinding], language: Language
) -> dict[str, dict[int, list[Passage]]]:
    """Label of a step → number of the paper → its correction, at the first step that has it."""
    left = {f.number: f for f in findings}
    found: dict[str, dict[int, list[Passage]]] = {}
    for part in parts:
        for step in part.steps:
            here = [left.pop(n) for n in step.paper if n in left]
            found[step.label] = {f.number: [*_passages(f, language)] for f in here}
    return found


def _passages(f: PaperFinding, language: Language) -> Iterator[Passage]:
    """A correction: what was printed, how it is true, what is wrong, values that show it."""
    formulas: list[tuple[Tree, ...]] = []
    language = language.marked

    def formula(*sides: Tree) -> str:
        formulas.append(sides)
        return f"\ue000{len(formulas) - 1}\ue001"

    printed = ", ".join(formula(e.lhs, e.rhs) for e in f.equations)
    *point, (_, left), (_, right) = (f.counterexample or {}).items()
    sides = {"left": formula(value_of(left)), "right": formula(value_of(right))}
    values = ", ".join(formula(*names, value_of(x)) for *names, x in grouped(point))
    template = "For {values}, the left side is {left}, the printed right side {right}."
    sentences = (
        language.word(
            "The paper prints in {number}, here in the letters of these notes: {printed}.",
            number=f"({f.number})",
            printed=printed,
        ),
        language.word(TRUE[f.verdict]) if f.holds else "",
        language.word(f.remark),
        language.word(template, values=values, **sides),
    )
    for k, piece in enumerate(FORMULA.split(" ".join(filter(None, sentences)))):
        if piece:
            yield Passage(piece, formulas[int(piece)] if k % 2 else ())


def value_of(text: str) -> Tree:
    """An exact value as a tree: a fraction, or the rows of a matrix."""
    if not text.startswith("["):
        return Fraction(text)
    rows = (row.split(", ") for row in text[1:-1].split("; "))
    return ("matrix", *(("row", *map(Fraction, row)) for row in rows))


# The findings about the paper's print, as text and as JSON.

TOTAL = (
    "{confirmed} confirmed, {sign} in another sign convention, {omission} with an omission, "
    "{misprint} misprinted, {definition} definitions"
)
HEADS = ("printed", "derived", "holds", "but for", "remark")


def as_json(findings: Sequence[PaperFinding]) -> str:
    """The findings as JSON: a list of objects, one for each numbered equation."""
    data = [
        {
            "number": f.number,
            "verdict": f.verdict,
            "printed": f.printed,
            "derived": f.derived,
            "holds": f.holds,
            "counterexample": f.counterexample,
            "remark": f.remark or None,
        }
        for f in findings
    ]
    return json.dumps(data, ensure_ascii=False, indent=1) + "\n"


def as_text(
    findings: Sequence[PaperFinding], language: Language = ENGLISH, width: int = WIDTH
) -> str:
    """The findings as text, a paragraph each, its lines of ``width`` columns at most; what is false
    with its correction."""
    lines, word = [], language.word
    heads = [word(x) for x in HEADS]
    wide = max(map(len, heads))
    for f in findings:
        lines.append(f"({f.number}) {word(f.verdict)}")
        derived = f.derived if f.verdict != "definition" else None
        example = _example(f, language) if f.counterexample else None
        holds = word(f.holds) if f.holds else None
        texts = (f.printed, derived, holds, example, word(f.remark))
        for head, text in zip(heads, texts, strict=True):
            first = f"     {head:{wide}}  "
            fill: dict[str, Any] = {"initial_indent": first, "subsequent_indent": " " * len(first)}
            lines += textwrap.wrap(text or "", width, break_long_words=False, **fill)
    counts = Counter(f.verdict for f in findings)
    numbers = {x.split()[0]: str(counts[x]) for x in VERDICTS}
    return "\n".join([*lines, "", *textwrap.wrap(word(TOTAL, **numbers), width)]) + "\n"


def _example(f: PaperFinding, language: Language) -> str:
    """The values at which a printed equation is false, and its two sides there."""
    *point, (_, left), (_, right) = (f.counterexample or {}).items()
    values = ",  ".join(" = ".join(x) for x in grouped(point))
    template = "{values}: the left side is {left}, the printed right side {right}"
    return language.word(template, values=values, left=left, right=right)


def grouped(values: Iterable[tuple[str, str]]) -> Iterator[tuple[str, ...]]:
    """Names and their values; names that are 0, or 1, together before that value."""
    together: dict[str, list[str]] = {"1": [], "0": []}
    others = []
    for name, value in values:
        short = _short(value)
        together.get(short, []).append(name)
        if short not in together:
            others.append((name, value))
    yield from others
    yield from ((*equal, value) for value, equal in together.items() if equal)


def _short(value: str) -> str:
    """0 or 1 for a matrix that is zero or the identity; else the value."""
    if not value.startswith("["):
        return value
    rows = [row.split(", ") for row in value[1:-1].split("; ")]
    if all(x == "0" for row in rows for x in row):
        return "0"
    square = all(len(row) == len(rows) for row in rows)
    one = [["1" if i == j else "0" for j in range(len(rows))] for i in range(len(rows))]
    return "1" if square and rows == one else value
