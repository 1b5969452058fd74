"""The prose of each step in every language, by the label of the step.

A sentence is called ``kernel.line``: the label without the chapter, and a name, which ends in
``_signed`` where it is said of masses that may be negative.  Spaces that
French does not break are written as ordinary ones (views/language.py).
"""

from __future__ import annotations

from collections.abc import Iterator

from .answer import STEPS as ANSWER
from .discrete import STEPS as DISCRETE
from .equilibria import STEPS as EQUILIBRIA
from .first_integrals import STEPS as FIRST_INTEGRALS
from .fluid import STEPS as FLUID
from .general import STEPS as GENERAL
from .material import STEPS as MATERIAL
from .matrices import STEPS as MATRICES
from .momentum_form import STEPS as MOMENTUM_FORM
from .reduction import STEPS as REDUCTION
from .rotations import STEPS as ROTATIONS
from .symmetries import STEPS as SYMMETRIES
from .zeitlin import STEPS as ZEITLIN

ROADS = (
    *(GENERAL, ROTATIONS, MATRICES, MATERIAL, FIRST_INTEGRALS, SYMMETRIES, MOMENTUM_FORM),
    *(ANSWER, DISCRETE, EQUILIBRIA, REDUCTION, ZEITLIN, FLUID),
)
STEPS: dict[str, dict[str, tuple[str, str]]] = {}
for road in ROADS:
    for label, sentences in road.items():
        STEPS.setdefault(label, {}).update(sentences)
"""Label → name → the sentence in each of ``LANGUAGES``."""
LISTS = ("{first}, {second}", "{first}; {second}", "{first} and {second}")
"""How parts of a sentence are strung together; in French in the catalogue of the views."""
MESSAGES = frozenset(("", *LISTS, *(en for named in STEPS.values() for en, _ in named.values())))
"""All that steps of a record say, in English: nothing else is a sentence of a step."""
LANGUAGES = ("en", "fr")
"""The languages of the prose, in the order of the texts of a sentence."""


def english(key: str) -> str:
    """The English of a sentence, by its key ``label.name``; ``KeyError`` for none."""
    label, name = key.split(".")
    return STEPS[label][name][0]


def entries() -> Iterator[dict[str, str]]:
    """Every sentence, as its text by language."""
    for named in STEPS.values():
        for texts in named.values():
            yield dict(zip(LANGUAGES, texts, strict=True))
