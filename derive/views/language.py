"""The language of a view: the messages of the record and of the views, by the catalogue."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import resources

from ..prose import LANGUAGES as LANGUAGES
from ..prose import entries as steps
from ..record.sentence import Prose, Sentence, filled, phrase

CATALOGUE = resources.files(__package__) / "catalogue.toml"
THIN, WIDE = "\u202f", "\u00a0"
SPACES = ((r" (?=[;!?])", THIN), (r" (?=[:»])|(?<=«) ", WIDE))
"""Where French has a space that does not break: in the catalogue it is an ordinary one."""


@dataclass(frozen=True)
class Language:
    """``messages``: English messages in this language; what is not there stays as it is."""

    name: str
    messages: Mapping[str, str] = field(default_factory=dict)

    def of(self, prose: Prose) -> str:
        """Sentences in this language."""
        return " ".join(map(self.sentence, prose))

    def sentence(self, x: Sentence) -> str:
        """One sentence in this language, and what fills its places."""
        places = {name: y if isinstance(y, str) else self.sentence(y) for name, y in x.places}
        return filled(self.messages.get(x.message, x.message), places)

    def decimal(self, x: float) -> str:
        """A number with the mark of the language."""
        return f"{x:g}".replace(".", "," if self.name == "fr" else ".")

    def word(self, message: str, **places: str) -> str:
        """A message of the views, or what a problem says: one of the user’s own stays as it is."""
        return self.sentence(phrase(message, **places))


ENGLISH = Language("en")


@cache
def language(name: str) -> Language:
    """One of ``LANGUAGES``."""
    if name == ENGLISH.name:
        return ENGLISH
    return Language(name, {x["en"]: typeset(x[name]) for x in entries()})


def entries() -> list[dict[str, str]]:
    """The prose of the steps, then the catalogue, where a line break is a space."""
    listed = tomllib.loads(CATALOGUE.read_text(encoding="utf-8"))["message"]
    flat = ({k: " ".join(text.split()) for k, text in entry.items()} for entry in listed)
    return [*steps(), *flat]


def typeset(french: str) -> str:
    """French with the spaces that do not break."""
    for pattern, space in SPACES:
        french = re.sub(pattern, space, french)
    return french
