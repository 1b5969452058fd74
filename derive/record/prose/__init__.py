"""The prose of each step in every language, from the text files beside this one.

A message is its label and, each in an indented line, its English and its French; ``#`` begins a
comment.  The label of a sentence is ``kernel.line``: that of its step without the chapter, and a
name, which ends in ``_signed`` where it is said of masses that may be negative.  Behind it stands
``(claim)`` where the sentence is computed again whenever a record has it, ``(condition)`` where its
values stand in the sentence alone (record/sentence.py).  Formulas stand between dollars, which no
record has: :func:`unmarked`.  Spaces that French does not break are written as ordinary ones
(views/language.py).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path

LANGUAGES = ("en", "fr")
"""The languages of the prose, in the order of the texts of a sentence."""
LISTS = ("{first}, {second}", "{first}; {second}", "{first} and {second}", "{first}; or {second}")
"""How parts of a sentence are strung together; in French in the catalogue of the views."""
INDENT = "  "
MARK = "$"
"""What stands before and after a formula."""


def unmarked(text: str) -> str:
    """A text as a record has it."""
    return text.replace(MARK, "")


def read(files: Iterable[Path], languages: Sequence[str] = LANGUAGES) -> dict[str, tuple[str, ...]]:
    """Label → the texts in some languages, for all messages of some files; ``ValueError`` names the
    file and the line of what is none."""
    found: dict[str, tuple[str, ...]] = {}
    for file in files:
        for number, label, texts in _messages(file):
            if label in found:
                raise ValueError(f"{file}, line {number}: {label!r} stands twice; rename one")
            if len(texts) != len(languages):
                needed = f"an indented line in each of {', '.join(languages)}"
                raise ValueError(f"{file}, line {number}: {label!r} has {len(texts)}, not {needed}")
            found[label] = tuple(texts)
    return found


def _messages(file: Path) -> list[tuple[int, str, list[str]]]:
    """The messages of a file: the line where each begins, its label, its texts."""
    found: list[tuple[int, str, list[str]]] = []
    for number, line in enumerate(file.read_text(encoding="utf-8").split("\n"), 1):
        text = line.strip()
        if not line or line.startswith("#"):
            continue
        if line == text:
            found.append((number, text, []))
        elif found and text and line == INDENT + text:
            found[-1][2].append(text)
        else:
            raise ValueError(f"{file}, line {number}: no label, and no text two spaces below one")
    return found


@cache
def _with_marks() -> dict[str, tuple[str, ...]]:
    """Label and mark → the sentence in each of ``LANGUAGES``."""
    return read(sorted(Path(__file__).parent.glob("*.txt")))


@cache
def sentences() -> dict[str, tuple[str, ...]]:
    """Label → the sentence in each of ``LANGUAGES``."""
    found = {x.partition(" ")[0]: texts for x, texts in _with_marks().items()}
    assert len(found) == len(_with_marks()), "a label stands twice, with different marks"
    return found


def marked(mark: str) -> frozenset[str]:
    """The labels with a mark behind them."""
    pairs = (x.partition(" ") for x in _with_marks())
    return frozenset(label for label, _, own in pairs if own == mark)


@cache
def messages() -> frozenset[str]:
    """All that steps of a record say, in English: nothing else is a sentence of a step."""
    return frozenset(("", *LISTS, *(unmarked(texts[0]) for texts in sentences().values())))


def message(label: str) -> str:
    """The English of a sentence; ``KeyError`` for none."""
    return unmarked(sentences()[label][0])


def entries() -> Iterator[dict[str, str]]:
    """Every sentence, as its text by language."""
    for texts in sentences().values():
        yield dict(zip(LANGUAGES, texts, strict=True))
