"""Fresh numbers in the exercises, by a seed: the letters of an exercise get numbers that are drawn,
and the solution has the values of the formulas that stand in it, in exact arithmetic by the
evaluator of the checker, or those of a motion by the equations that the text displays."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, reduce
from typing import Any

from ..check.values.arithmetic import is_matrix
from ..check.values.evaluate import Environment, evaluate
from ..language.show import show
from ..language.tree import Tree, replaced
from ..language.values import elementary
from ..views.language import LANGUAGES, Language, language
from .lecture_text import ASKED, Block, Chapter, Entry, Formula, LectureError, tree
from .own_body import turned
from .sheets import Claims
from .sheets import value as number

RANGE = re.compile(r"(−?\d+)…(−?\d+)")
LEAD = "In numbers:"
Known = dict[Tree, Tree]
"""A letter, or what is read as one, as ζ₁ → its value, as a tree of numbers."""


def drawn(chapters: Sequence[Chapter], seed: int, claims: Claims) -> list[Chapter]:
    """The chapters with numbers in their exercises; ``LectureError`` where a value is none."""
    return [replace(c, blocks=tuple(_blocks(c, seed, claims))) for c in chapters]


def _blocks(chapter: Chapter, seed: int, claims: Claims) -> list[Block]:
    """The blocks with their numbers; a solution knows those of the exercise before it."""
    found, known = [], Known()
    for block in chapter.blocks:
        known = Known() if block.kind == "exercise" else known
        draws = random.Random(f"{seed} {chapter.name} {block.label}")
        entries: list[Entry] = []
        for entry in block.entries:
            if not entry.fresh:
                entries.append(entry)
            elif entry.display:
                entries.append(_given(entry, draws, known))
            else:
                try:
                    entries.append(_answered(entry, known, claims))
                except (ArithmeticError, ValueError) as error:
                    where = f"{chapter.file}, line {entry.line}"
                    raise LectureError(f"{where}: {error}") from error
        found.append(replace(block, entries=tuple(entries)))
    return found


def _given(entry: Entry, draws: random.Random, known: Known) -> Entry:
    """What the letters of an exercise are, drawn among their choices, which ``known`` has then."""
    said = []
    for part in re.split(r",\s\s+", entry.formulas[0].text):
        name, _, choices = part.partition(" = ")
        chosen = draws.choice(choices.split(" | "))
        text = RANGE.sub(lambda x: _within(draws, x), chosen)
        known[tree(name)] = tree(text)
        said.append(Formula(name, condition=True, value=f" = {_shown(known[tree(name)])}"))
    listed = [y for x in said for y in (x, ", ")][:-1]
    texts = ((f"{language(x).word(LEAD)} ", *listed, ".") for x in LANGUAGES)
    return replace(entry, texts=tuple(texts), display=False)


def _within(draws: random.Random, limits: re.Match[str]) -> str:
    low, high = (int(x.replace("−", "-")) for x in limits.groups())
    return str(draws.randint(low, high)).replace("-", "−")


def _answered(entry: Entry, known: Known, claims: Claims) -> Entry:
    """A sentence of a solution, with the values of its formulas, which ``known`` has then."""
    values: dict[Formula, Any] = {}
    for x in entry.formulas:
        if asked := ASKED.search(x.value):
            sides = [*map(tree, x.text.split(" = "))]
            values[x] = MOTIONS[asked[2]](claims, known) if asked[2] else value(sides[-1], known)
            known[sides[0]] = _literal(values[x])

    def part(x: str | Formula, spoken: Language) -> str | Formula:
        if not isinstance(x, Formula) or x not in values:
            return x
        return replace(x, value=_told(values[x], spoken))

    spoken = zip(entry.texts, map(language, LANGUAGES), strict=True)
    texts = (tuple(part(x, lang) for x in text) for text, lang in spoken)
    return replace(entry, texts=tuple(texts))


def value(t: Tree, known: Mapping[Tree, Tree]) -> Any:
    """The value of a tree by those of its letters: a fraction or, of a root or a logarithm that is
    none, a float; a matrix, or a vector of one column, by its rows."""
    filled = reduce(lambda x, letter: replaced(x, letter, known[letter]), known, t)
    return evaluate(filled, Environment(size=3, names={}, elementary=_function))


def _function(name: str, x: Any) -> Any:
    """A function of a number; the root of a square is exact."""
    if name == "sqrt" and isinstance(x, Fraction) and x >= 0:
        root = Fraction(math.isqrt(x.numerator), math.isqrt(x.denominator))
        if root**2 == x:
            return root
    return elementary(name, float(x))


def _literal(x: Any) -> Tree:
    """A value as a tree."""
    if is_matrix(x):
        return ("matrix", *(("row", *map(_literal, row)) for row in x))
    exact = Fraction(x)
    return exact.numerator if exact.denominator == 1 else exact


def _shown(t: Tree) -> str:
    """A number, a matrix, or a vector as a row in brackets."""
    if isinstance(t, tuple) and t[0] == "matrix" and all(len(row) == 2 for row in t[1:]):
        return f"({', '.join(show(row[1]) for row in t[1:])})"
    return show(t)


def _told(x: Any, words: Language) -> str:
    """A relation and a value, in a language: one that is not exact with three digits."""
    if isinstance(x, float):
        return f" ≈ {words.decimal(float(f'{x:.3g}'))}".replace("-", "−")
    return f" = {_shown(_literal(x))}"


# Motions, by the equations that the text displays.

TILT = tree("A₃₃")


@dataclass(frozen=True)
class Top:
    """A top whose axis is at its ``upper`` tilt at first, by its cosine, and precesses at the rate
    ``precession``; ``spin``: the momentum about the axis."""

    claims: Claims
    precession: float
    parameters: Mapping[Tree, float]
    spin: float
    upper: float

    @cached_property
    def constants(self) -> dict[Tree, float]:
        """Its parameters and what its motion keeps, by their letters."""
        found = {**self.parameters, tree("𝒥₂"): self.spin, TILT: self.upper}
        # the rate of precession is of degree 1 in 𝒥₁
        slow, fast = (self._of("heavy.connection", found | {tree("𝒥₁"): x}) for x in (0.0, 1.0))
        found[tree("𝒥₁")] = (self.precession - slow) / (fast - slow)
        found[tree("h̃")] = self._of("heavy.effective", found)
        return found

    def _of(self, label: str, values: Mapping[Tree, float]) -> float:
        return float(number(self.claims[label][0].rhs, values))

    @cached_property
    def lower(self) -> float:
        """The cosine of the lower tilt: the other root of the cubic in the well, by halving."""
        below, above = -1.0, self.upper - 1e-6
        for _ in range(60):
            middle = (below + above) / 2
            if self._of("heavy.quadrature", self.constants | {TILT: middle}) > 0:
                above = middle
            else:
                below = middle
        return above


def _turned(claims: Claims, known: Mapping[Tree, Tree]) -> float:
    """When a body has first turned over half, from ζ₁ = ε ζ₂, ζ₃ = 0."""
    first, second, third = (float(value(tree(f"λ{k}"), known)) for k in "₁₂₃")
    speed, tilt = (float(value(tree(x), known)) for x in ("ζ₂", "ε"))
    return turned(claims, (first, second, third), (tilt * speed, speed, 0.0))


def _lower(claims: Claims, known: Mapping[Tree, Tree]) -> float:
    """The cosine of the lower tilt of a top that is let go, its axis at rest."""
    letters = [tree(x) for x in ("‘I_1’", "‘I_3’", "‘mgl’")]
    parameters = {x: float(value(x, known)) for x in letters}
    spin, upper = (float(value(tree(x), known)) for x in ("𝒥₂", "A₃₃"))
    return Top(claims, 0.0, parameters, spin, upper).lower


MOTIONS: dict[str, Callable[[Claims, Mapping[Tree, Tree]], float]] = {
    "turned": _turned,
    "lower": _lower,
}
"""What a motion tells, by the name behind the sign # of the text."""
