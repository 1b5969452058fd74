"""Corrections of the paper's print: what it says, why that is wrong, a counterexample."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from ..language.tree import Tree
from ..paper.finding import OMISSION, SIGN, Finding
from .book import BookPart
from .language import Language
from .paper import grouped

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
    parts: Sequence[BookPart], findings: Sequence[Finding], language: Language
) -> dict[str, dict[int, list[Passage]]]:
    """Label of a step → number of the paper → its correction, at the first step that has it."""
    left = {f.number: f for f in findings}
    found: dict[str, dict[int, list[Passage]]] = {}
    for part in parts:
        for step in part.steps:
            here = [left.pop(n) for n in step.paper if n in left]
            found[step.label] = {f.number: [*_passages(f, language)] for f in here}
    return found


def _passages(f: Finding, language: Language) -> Iterator[Passage]:
    """A correction: what was printed, how it is true, what is wrong, values that show it."""
    formulas: list[tuple[Tree, ...]] = []

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
