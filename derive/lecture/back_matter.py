"""What stands before and behind the chapters: what the user gives for the title, the works that the
text refers to, and the table of symbols, from the records."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ..language.read import FormulaError
from ..language.tree import names
from ..record.record import Derivation
from ..views.language import Language
from ..views.outline import ON_FLUIDS, ON_STEPS_OF_TIME, REFERENCES
from .lecture_text import RELATION, Chapter, Entry, Formula, tree


@dataclass(frozen=True)
class Front:
    """What the user says of the lecture; what is empty is not printed."""

    title: str = ""
    author: str = ""
    course: str = ""
    date: str = ""

    @property
    def lines(self) -> tuple[str, ...]:
        """What stands below the title."""
        return tuple(filter(None, (self.author, self.course, self.date)))


UNTITLED = Front()
NOTE, AUDIN, NOTES = REFERENCES
WORKS = (
    ON_FLUIDS[0],
    AUDIN,
    ("Hol", "D. D. Holm", "Geometric Mechanics, Part II", "Imperial College Press, 2nd ed., 2011"),
    (*NOTES[:3], f"{NOTES[3]}, http://hermes.univ-mrs.fr/~patrick/"),
    NOTE,
    (
        "MR",
        "J. E. Marsden, T. S. Ratiu",
        "Introduction to Mechanics and Symmetry",
        "Springer, 2nd ed., 1999",
    ),
    *ON_STEPS_OF_TIME,
    (
        "Poi",
        "H. Poincaré",
        "Sur une forme nouvelle des équations de la mécanique",
        "Comptes rendus de l’Académie des sciences 132, 1901, 369–371",
    ),
    ("Sou", "J.-M. Souriau", "Structure des systèmes dynamiques", "Dunod, 1970"),
)
"""The works by their authors: key, author, title, where; ``@key``, in small letters, is the number
of one in the text."""
NUMBERS = {key.lower(): k for k, (key, *_) in enumerate(WORKS, 1)}


@dataclass(frozen=True)
class LetterUse:
    """A letter, what it means, the entry where it is first used with this meaning, and the place
    of its chapter among the chapters."""

    name: str
    meaning: str
    entry: Entry
    chapter: int


def letters(
    chapters: Sequence[Chapter], records: Mapping[str, Derivation], language: Language
) -> list[LetterUse]:
    """The letters of the text that the records of its chapters declare, in alphabetical order; not
    those of variations and rates, which are read off from their marks."""
    found: dict[tuple[str, str], LetterUse] = {}
    for k, chapter in enumerate(chapters, 1):
        declared = {
            s.name: language.of(s.meaning)
            for problem in reversed(chapter.problems)
            for s in records[problem].symbols
        }
        for entry in chapter.entries:
            for name in _names(entry):
                if name in declared and not _marked(name):
                    use = LetterUse(name, declared[name], entry, k)
                    found.setdefault((name, use.meaning), use)
    return sorted(found.values(), key=lambda x: (*_place(x.name), x.chapter))


def _names(entry: Entry) -> Iterator[str]:
    """The names in the formulas of an entry that are expressions."""
    texts = (x.text for x in entry.texts[0] if isinstance(x, Formula))
    for side in (y for x in texts for part in re.split(r",\s\s+", x) for y in RELATION.split(part)):
        try:
            yield from names(tree(side))
        except FormulaError:
            continue


def _marked(name: str) -> bool:
    """Is it the name of a variation, of a rate or of what belongs to the second variation?"""
    bare = unicodedata.normalize("NFD", name)
    return bare not in ("δ", "δ′") and (bare[0] == "δ" or "\u0307" in bare or "′" in bare)


def _place(name: str) -> tuple[bool, str, str]:
    """Where a name is in the alphabet: signs last; script letters are with their plain ones."""
    plain = unicodedata.normalize("NFKD", name)
    bare = "".join(c for c in plain if c.isalnum())
    return not plain[0].isalpha(), bare.casefold(), name
