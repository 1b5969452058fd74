"""Several records as one text: what holds for any group once, then a chapter for each problem."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from unicodedata import normalize

from ..record.paper import Finding
from ..record.record import Derivation, Step, Symbol
from ..record.vocabulary import ANY_GROUP
from .language import ENGLISH, Language
from .outline import capitalised, subtitle, title

VARIATIONS = ("δ′", "δ")
RATE = "\u0307"
MOTION = "Equations of motion"
REGULAR = "The rates Ẋ are along the motion; δX and δ′X are two variations of X."
GENERAL = ("For any group of matrices, linear action", "For any group of matrices, affine action")


@dataclass(frozen=True)
class Part:
    """Steps under a heading; ``name`` is the anchor; ``record`` is that of a problem's own part."""

    name: str
    heading: str
    about: str
    steps: tuple[Step, ...]
    source: Derivation
    record: Derivation | None = None

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        """The letters to explain: without variations and rates, which have one rule."""
        return tuple(s for s in self.source.symbols if not _regular(s.name))


def book(records: Sequence[Derivation], language: Language = ENGLISH) -> list[Part]:
    """The parts, each step once."""
    parts: list[Part] = []
    seen: set[str] = set()
    for d in records:
        general = tuple(s for s in d.steps if s.scope == ANY_GROUP and s.label not in seen)
        if general:
            kind = general[0].label.partition(".")[0]
            heading = language.word(GENERAL[kind == "affine"])
            parts.append(Part(kind, heading, "", general, d))
            seen |= {s.label for s in general}
    for d in records:
        own = tuple(s for s in d.steps if s.scope != ANY_GROUP)
        if own:
            about = capitalised(subtitle(d, language))
            parts.append(Part(d.name, title(d, language), about, own, d, d))
    return parts


def _regular(name: str) -> bool:
    """δA, δ′A and Ȧ beside A, of which ``REGULAR`` speaks."""
    return name.startswith(VARIATIONS) or RATE in normalize("NFD", name)


def steps(parts: Sequence[Part]) -> Iterator[tuple[Part, Step]]:
    """All steps with their parts."""
    for part in parts:
        for step in part.steps:
            yield part, step


def corrected(step: Step, findings: Iterable[Finding], language: Language) -> Iterator[str]:
    """For each number of a step whose print is wrong: what was printed, and values that show it."""
    for f in findings:
        if f.number not in step.paper:
            continue
        values = [*(f.counterexample or {}).items()]
        given, (left, right) = values[:-2], values[-2:]
        printed = language.word(
            "The paper prints in {number}: {printed}.", number=f"({f.number})", printed=f.printed
        )
        example = language.word(
            "For {values} the left side is {left}, the printed right side {right}.",
            values=", ".join(f"{name} = {value}" for name, value in given),
            left=left[1],
            right=right[1],
        )
        yield f"{printed} {example}"
