"""What stands before and behind the chapters: what the user gives for the title, the works that the
text refers to, and the table of symbols, from the records."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from shlex import quote

from ..language.read import FormulaError
from ..language.show import show
from ..language.tree import names, nodes
from ..record.record import Derivation
from ..views.language import Language, labelled, told
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
SECOND, UNPUBLISHED = "second ed.", "unpublished note"
UNDATED = "without a date (2000 or later)"
COMPTES_RENDUS = "Comptes rendus de l’Académie des sciences 132, 1901, 369–371"
OWN_WORKS = f"""
HLW | E. Hairer, C. Lubich, G. Wanner | Geometric Numerical Integration | Springer, {SECOND}, 2006
Hol | D. D. Holm | Geometric Mechanics, Part II | Imperial College Press, {SECOND}, 2011
MR | J. E. Marsden, T. S. Ratiu | Introduction to Mechanics and Symmetry | Springer, {SECOND}, 1999
Poi | H. Poincaré | Sur une forme nouvelle des équations de la mécanique | {COMPTES_RENDUS}
Sou | J.-M. Souriau | Structure des systèmes dynamiques | Dunod, 1970
"""


WORKS: Sequence[Sequence[str]] = sorted(
    (
        *(ON_FLUIDS[0], AUDIN, *ON_STEPS_OF_TIME, (*NOTE[:3], f"{UNPUBLISHED}, {UNDATED}")),
        (*NOTES[:3], f"{NOTES[3]}, http://hermes.univ-mrs.fr/~patrick/"),
        *(x.split(" | ") for x in OWN_WORKS.strip().split("\n")),
    ),
    key=lambda work: work[1].partition(",")[0].split()[-1],
)
"""The works by the surnames of their authors: key, author, title, where; ``@key``, in small
letters, is the number of one in the text."""
NUMBERS = {key.lower(): k for k, (key, *_) in enumerate(WORKS, 1)}


LETTER = "letter:"
OWN = {
    (*x.removeprefix(LETTER).split(" ", 1),): told(x) for x in labelled() if x.startswith(LETTER)
}
"""Chapter and letter → what it means there, where no record says it, or with letters that the text
does not have."""


PRINTED_BY = {
    "": "walk {}",
    "families": "equilibria {} --letters",
    "discrete": "walk {} --discrete",
}
"""What is found of a problem, as chapters name it → the command that prints it, where that has not
the same name."""


def sources(
    chapters: Sequence[Chapter], records: Mapping[str, Derivation]
) -> dict[str, tuple[str, str]]:
    """The labels in the margins, each with the name of the record that has its step, and how that
    is typed; as few records as there may be."""
    found: dict[str, tuple[str, str]] = {}
    steps = {name: {s.label for s in d.steps} for name, d in records.items()}
    taken: dict[str, dict[str, str]] = {}
    for chapter in chapters:
        for label in (x for e in chapter.entries for x in e.labels):
            places = taken.setdefault(label.partition(".")[0], {})
            name = next(x for x in (*places, *chapter.problems) if label in steps[x])
            # of a problem of the reader's as that was called
            called = chapter.name if chapter.of_course else quote(chapter.file)
            places.setdefault(name, name.replace(chapter.name, called, 1))
            found[label] = name, places[name]
    return found


def homes(chapters: Sequence[Chapter], records: Mapping[str, Derivation]) -> dict[str, list[str]]:
    """How the labels in the margins begin → the commands that print these steps."""
    found: dict[str, dict[str, None]] = {}
    for label, (_, called) in sources(chapters, records).items():
        found.setdefault(label.partition(".")[0], {})[printing(called)] = None
    return {x: [*commands] for x, commands in sorted(found.items())}


def printing(name: str) -> str:
    """The command that prints the steps of a record, by the name that it is typed by."""
    problem, _, search = name.partition(":")
    return f"derive {PRINTED_BY.get(search, f'{search} {{}}').format(problem)}"


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
    """The letters of the text that the records of its chapters declare, or ``OWN``, in alphabetical
    order; not those of variations and rates, which are read off from their marks.  What a record
    declares a letter means where a formula is tried: in one that is supposed it may be another."""
    found: dict[tuple[str, str], LetterUse] = {}
    for k, chapter in enumerate(chapters, 1):
        declared = {
            s.name: language.marked.of(s.meaning)
            for problem in reversed(chapter.problems)
            for s in records[problem].symbols
        }
        told_of = (x for x in OWN if chapter.of_course and x[0] == chapter.name)
        own = {x[1]: language.marked.word(OWN[x]) for x in told_of}
        for entry in chapter.entries:
            for name, formula in _names(entry):
                meaning = own.get(name, "" if formula.condition else declared.get(name, ""))
                if meaning and not _marked(name):
                    use = LetterUse(name, meaning, entry, k)
                    found.setdefault((name, use.meaning), use)
    return sorted(found.values(), key=lambda x: (*_place(x.name), x.chapter))


def _names(entry: Entry) -> Iterator[tuple[str, Formula]]:
    """The names in the formulas of an entry that are expressions, and whole sides of formulas."""
    for x in entry.formulas:
        if x.recorded:  # as text a parameter may look as a letter
            yield from ((y, x) for e in x.recorded for t in (e.lhs, e.rhs) for y in names(t))
            continue
        for side in (y for part in re.split(r",\s\s+", x.text) for y in RELATION.split(part)):
            yield side, x
            with suppress(FormulaError):
                t = tree(side)
                numbered = (show(y) for y in nodes(t) if isinstance(y, tuple) and y[0] == "entry")
                yield from ((name, x) for name in (*names(t), *numbered))


def _marked(name: str) -> bool:
    """Is it the name of a variation, of a rate or of what belongs to the second variation?"""
    bare = unicodedata.normalize("NFD", name)
    return bare not in ("δ", "δ′") and (bare[0] == "δ" or "\u0307" in bare or "′" in bare)


def _place(name: str) -> tuple[bool, str, str]:
    """Where a name is in the alphabet: signs last; script letters are with their plain ones."""
    plain = unicodedata.normalize("NFKD", name.strip("‘’"))
    bare = "".join(c for c in plain if c.isalnum())
    return not plain[0].isalpha(), bare.casefold(), name
