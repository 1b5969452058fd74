"""The rules by which steps are derived: a sentence for each, and of what kind its equations are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from .names import WORDS
from .prose import read, unmarked


class Rule(NamedTuple):
    """The name of a rule in French, what a step with it does, in a sentence, and the kind of its
    equations.

    A *definition* says what names are; an *identity* holds at every point of the evolution space, a
    *restriction* for some arguments alone; a *kernel* step is what the variations test, those of
    ``for_all`` in its equations; a *solution* and a *conservation* hold along the motion.
    """

    french: str
    sentence: str
    kind: str


OFF_MOTION = ("definition", "identity", "restriction")
"""The kinds of what holds whether or not a point moves as the equations of motion say."""

TOLD = read([WORDS / "rules.txt"])
RULES = {
    name: Rule(french, unmarked(texts[0]), kind)
    for label, texts in TOLD.items()
    for name, french, kind in [label.split(" | ")]
}


def names() -> Iterator[tuple[str, ...]]:
    """The name of every rule, and its sentence, in English and in French."""
    yield from ((name, rule.french) for name, rule in RULES.items())
    yield from TOLD.values()
