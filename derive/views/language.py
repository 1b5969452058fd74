"""Languages of the views: the messages of the record and of the views; numbered entries."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache
from itertools import groupby
from pathlib import Path

from ..language.show import show
from ..language.tree import Tree
from ..record import vocabulary
from ..record.prose import LANGUAGES as LANGUAGES
from ..record.prose import MARK, read, unmarked
from ..record.prose import entries as steps
from ..record.record import Equation
from ..record.sentence import Prose, Sentence, filled
from .paper.findings import remarks
from .printing.sentences import FORMULA
from .printing.tex import latex_tree
from .printing.typeset import display_width, measure

CATALOGUE = Path(__file__).with_name("catalogue.txt")
LABELLED = Path(__file__).with_name("outline.txt")
POINT = re.compile(r"(?<=[0-9])\.(?=[0-9])")
"""The point of a decimal number."""
SEPARATOR, NUMBER = re.compile(r"(\s*[,;]\s+)"), re.compile(r"\(\d+\) ")
"""What stands between the formulas of a list, and before each, if anything does."""
WORD = re.compile(r"[A-Za-z]{2,}|[A-Z]\d+|\d+|[A-Z][A-Za-z]*\(\d+\).*")
"""What is no formula in such a list: words, a number alone, groups by their names."""
THIN, WIDE = "\u202f", "\u00a0"
SPACES = ((r" (?=[;!?])", THIN), (r" (?=[:»])|(?<=«) ", WIDE))
"""Where French has a space that does not break: in the catalogue it is an ordinary one."""


@dataclass(frozen=True)
class Language:
    """A language of the views; ``messages``: English → this one, missing ones stay English.

    ``marks``: formulas stand between marks (FORMULA), to be typeset.
    """

    name: str
    messages: Mapping[str, str] = field(default_factory=dict)
    marks: bool = False

    def of(self, prose: Prose) -> str:
        """The sentences of a step, or of a caption, in this language."""
        return " ".join(map(self.sentence, prose))

    def sentence(self, x: Sentence) -> str:
        """One sentence in this language, its places filled."""
        message, places = self.messages.get(x.message, x.message), {}
        for name, y in x.places:
            if not isinstance(y, str):
                places[name] = self.sentence(y)
            elif f"{FORMULA}{{{name}}}" in message:  # it goes on
                places[name] = f"{FORMULA}{self.numbers(y)}{FORMULA}"
            else:
                places[name] = self.formula(self.numbers(y))
        said = filled(message, places)
        return said.replace(2 * FORMULA, "") if self.marks else said

    @property
    def marked(self) -> Language:
        """The language with its formulas between marks."""
        return _marked(self.name)

    def formula(self, text: str) -> str:
        """A text that is the same in all languages, each formula of a list between marks."""
        if not self.marks:
            return text
        found, whole = "", ""
        for piece in SEPARATOR.split(text.replace(FORMULA, "")):
            whole += piece
            if all(whole.count(a) == whole.count(b) for a, b in ("()", "⟨⟩", "[]")):
                number = NUMBER.match(whole)
                at = number.end() if number else 0
                word = SEPARATOR.fullmatch(whole) or WORD.fullmatch(whole[at:])
                found += whole if word else f"{whole[:at]}{FORMULA}{whole[at:]}{FORMULA}"
                whole = ""
        return found + whole

    @property
    def mark(self) -> str:
        """The decimal mark."""
        return "," if self.name == "fr" else "."

    def numbers(self, text: str) -> str:
        """A text that is the same in all languages, with the marks of this one: in a list of
        decimals with commas they are apart by semicolons."""
        marked = POINT.sub(self.mark, text)
        if self.name != "fr":
            return marked
        listed = marked.replace(", ", "; ") if marked != text else marked
        return re.sub(f"(?<!{THIN}); ", f"{THIN}; ", listed)

    def decimal(self, x: float) -> str:
        """A number with the decimal mark of the language."""
        return self.numbers(f"{x:g}")

    def word(self, message: str, **places: str) -> str:
        """A message of the views in this language, or a word of the user's, which stays; what
        fills the places has its marks already."""
        told = {name: self.numbers(x) for name, x in places.items()}
        return filled(self.messages.get(message, message), told)

    def listed(self, words: Sequence[str]) -> str:
        """Words one after the other, with "and" before the last."""
        *first, last = words
        joined = ", ".join(first)
        return self.word("{first} and {second}", first=joined, second=last) if first else last


ENGLISH = Language("en")


@cache
def language(name: str) -> Language:
    """The language of a name in ``LANGUAGES``, with the messages of the catalogue."""
    if name == ENGLISH.name:
        return ENGLISH
    return Language(
        name, {unmarked(x["en"]): typeset(x[name], name, "") for x in catalogue_entries()}
    )


@cache
def _marked(name: str) -> Language:
    messages = {unmarked(x["en"]): typeset(x[name], name, FORMULA) for x in catalogue_entries()}
    return Language(name, messages, marks=True)


@cache
def labelled() -> dict[str, tuple[str, ...]]:
    """Label → what views say of a whole record, in each of ``LANGUAGES``."""
    return read([LABELLED])


def told(label: str) -> str:
    """The English of a label."""
    return unmarked(labelled()[label][0])


def catalogue_entries() -> list[dict[str, str]]:
    """The prose of the steps, the names and rules of the record, what views say of all, remarks on
    the note, and the catalogue."""
    tables = vocabulary.meanings(), vocabulary.names(), labelled().values(), remarks().values()
    words = dict.fromkeys(x for table in tables for x in table)
    catalogue = ((en, *texts) for en, texts in read([CATALOGUE], LANGUAGES[1:]).items())
    return [*steps(), *(dict(zip(LANGUAGES, x, strict=True)) for x in (*words, *catalogue))]


def typeset(text: str, language: str = "fr", mark: str = MARK) -> str:
    """A text with a mark around its formulas, and, between them, the spaces that do not break where
    French has them."""
    parts = text.split(MARK)
    for pattern, space in SPACES if language == "fr" else ():
        parts[::2] = (re.sub(pattern, space, x) for x in parts[::2])
    return mark.join(parts)


# The numbered entries of a step: equations one by one, short ones of a family by the row.

TABLE, CELL, ROW = 4, 24, 72
"""Above how many cells they stand side by side; the width, in letters, of a cell and a row."""
WIDE_MATRIX, LETTER = 30.0, 10
"""A matrix wider than WIDE (in em) has letters for its entries of more than LETTER letters."""
SIMPLE = ("par", "entry", "matrix", "add", "mul")


@dataclass(frozen=True)
class Entry:
    """Equations under one number; ``first`` is the place of the first of them in the step.

    ``where``: what letters in it stand for.
    """

    first: int
    equations: tuple[Equation, ...]
    where: tuple[Equation, ...] = ()

    @property
    def only(self) -> Equation | None:
        """The equation of an entry that has one; else ``None``."""
        return self.equations[0] if len(self.equations) == 1 else None


def entries(equations: Sequence[Equation]) -> list[Entry]:
    """The entries of a step; that a parameter is itself is not said beside other equations."""
    numbered = list(enumerate(equations))
    kept = [(k, e) for k, e in numbered if not _itself(e)] or numbered
    found: list[Entry] = []
    for row in rows(kept):
        place = row[0][0] if found else 0
        found.append(
            _lettered(place, row[0][1]) if len(row) == 1 else Entry(place, equations_of(row))
        )
    return found


Placed = tuple[int, Equation]


def rows(equations: Iterable[Placed]) -> Iterator[list[Placed]]:
    """The equations in rows: many short ones side by side, a few zeros in one row, others alone."""
    for short, run in groupby(equations, key=lambda x: bool(cell(x[1]))):
        members = [*run]
        if short and len(members) > TABLE:
            size = columns([e for _, e in members])
            yield from (members[at : at + size] for at in range(0, len(members), size))
            continue
        for zero, part in groupby(members, key=lambda x: short and x[1].rhs == 0):
            together = [*part]
            yield from [together] if zero else ([x] for x in together)


def equations_of(row: Sequence[Placed]) -> tuple[Equation, ...]:
    """The equations of a row, without their places."""
    return tuple(e for _, e in row)


def _lettered(place: int, e: Equation) -> Entry:
    """An equation as an entry; the long entries of a wide matrix get letters of their own."""
    matrix = isinstance(e.rhs, tuple) and e.rhs[0] == "matrix"
    if not matrix or not isinstance(e.lhs, str) or breadth(e.rhs) <= WIDE_MATRIX:
        return Entry(place, (e,))
    letters: dict[Tree, Tree] = {}

    def letter(x: Tree, *index: int) -> Tree:
        if display_width(show(x)) <= LETTER:
            return x
        return letters.setdefault(x, ("entry", e.lhs, *index))

    rows = [
        ("row", *(letter(x, i, j) for j, x in enumerate(row[1:], 1)))
        if isinstance(row, tuple) and row[0] == "row"
        else letter(row, i)
        for i, row in enumerate(e.rhs[1:], 1)  # type: ignore[index]
    ]
    where = tuple(Equation(name, x) for x, name in letters.items())
    return Entry(place, (replace(e, rhs=("matrix", *rows)),), where)


def breadth(matrix: Tree) -> float:
    """The width of a matrix in em: that of its columns, each entry on one line."""
    rows = [row[1:] if row[0] == "row" else (row,) for row in matrix[1:]]  # type: ignore[index]
    across = zip(*rows, strict=True)
    return sum(max(measure(latex_tree(x)) for x in column) for column in across)


def columns(cells: Sequence[Equation]) -> int:
    """How many cells stand in a row: an even number, for families often come in pairs."""
    return 4 if 4 * max(map(width, cells)) <= ROW else 2


def width(e: Equation) -> int:
    """The width of a cell in letters; a column vector is as wide as its widest entry."""
    if isinstance(e.rhs, tuple) and e.rhs[0] == "matrix":
        return display_width(f"{show(e.lhs)} = ") + max(display_width(show(x)) for x in e.rhs[1:])
    return display_width(cell(e))


def cell(e: Equation) -> str:
    """The text of a short equation that names a number or an entry; empty for others."""
    named = isinstance(e.lhs, tuple) and e.lhs[0] in ("at", "entry")
    simple = isinstance(e.rhs, (str, int, Fraction)) or e.rhs[0] in SIMPLE
    text = f"{show(e.lhs)} = {show(e.rhs)}"
    return (
        text
        if named and simple and not (e.for_all or e.exists) and display_width(text) <= CELL
        else ""
    )


def _itself(e: Equation) -> bool:
    """Is it m = m, for a parameter m that has the name of what it is?"""
    return isinstance(e.rhs, tuple) and e.rhs[0] == "par" and show(e.lhs) == show(e.rhs)
