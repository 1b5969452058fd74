"""The rules by which steps are derived: a sentence for each, and of what kind its equations are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from .names import WORDS
from .prose import read


class Rule(NamedTuple):
    """The name of a rule in French, what a step with it does, in a sentence in both languages, and
    the kind of its equations.

    A *definition* says what names are; an *identity* holds at every point of the evolution space, a
    *restriction* for some arguments alone; a *kernel* step is what the variations test, those of
    ``for_all`` in its equations; a *solution* and a *conservation* hold along the motion.
    """

    french: str
    sentence: str
    sentence_in_french: str
    kind: str


OFF_MOTION = ("definition", "identity", "restriction")
"""The kinds of what holds whether or not a point moves as the equations of motion say."""

RULES = {
    name: Rule(french, sentence, sentence_in_french, kind)
    for label, (sentence, sentence_in_french) in read([WORDS / "rules.txt"]).items()
    for name, french, kind in [label.split(" | ")]
}


def names() -> Iterator[tuple[str, str]]:
    """The name of every rule, and its sentence, in English and in French."""
    for name, rule in RULES.items():
        yield name, rule.french
        yield rule.sentence, rule.sentence_in_french
