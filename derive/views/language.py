"""Languages of the views: the messages of the record and of the views, from the catalogue."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from ..prose import LANGUAGES as LANGUAGES
from ..prose import entries as steps
from ..prose import read
from ..record import rules, vocabulary
from ..record.sentence import Prose, Sentence, filled, phrase

CATALOGUE = Path(__file__).with_name("catalogue.txt")
POINT = re.compile(r"(?<=[0-9])\.(?=[0-9])")
"""The point of a decimal number."""
THIN, WIDE = "\u202f", "\u00a0"
SPACES = ((r" (?=[;!?])", THIN), (r" (?=[:»])|(?<=«) ", WIDE))
"""Where French has a space that does not break: in the catalogue it is an ordinary one."""


@dataclass(frozen=True)
class Language:
    """A language of the views; ``messages``: English → this one, missing ones stay English."""

    name: str
    messages: Mapping[str, str] = field(default_factory=dict)

    def of(self, prose: Prose) -> str:
        """The sentences of a step, or of a caption, in this language."""
        return " ".join(map(self.sentence, prose))

    def sentence(self, x: Sentence) -> str:
        """One sentence in this language, its places filled."""
        places = {
            name: self.numbers(y) if isinstance(y, str) else self.sentence(y)
            for name, y in x.places
        }
        return filled(self.messages.get(x.message, x.message), places)

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
        return listed.replace("; ", f"{THIN}; ")

    def decimal(self, x: float) -> str:
        """A number with the decimal mark of the language."""
        return self.numbers(f"{x:g}")

    def word(self, message: str, **places: str) -> str:
        """A message of the views in this language, or a word of the user's, which stays."""
        return self.sentence(phrase(message, **places))


ENGLISH = Language("en")


@cache
def language(name: str) -> Language:
    """The language of a name in ``LANGUAGES``, with the messages of the catalogue."""
    if name == ENGLISH.name:
        return ENGLISH
    return Language(name, {x["en"]: typeset(x[name]) for x in entries()})


def entries() -> list[dict[str, str]]:
    """The prose of the steps, the names and rules of the record, and the catalogue."""
    words = dict.fromkeys((*vocabulary.meanings(), *rules.names()))
    catalogue = ((en, *texts) for en, texts in read([CATALOGUE], LANGUAGES[1:]).items())
    return [*steps(), *(dict(zip(LANGUAGES, x, strict=True)) for x in (*words, *catalogue))]


def typeset(french: str) -> str:
    """French with the spaces that do not break where French has them."""
    for pattern, space in SPACES:
        french = re.sub(pattern, space, french)
    return french
