"""The prose of the walk as data: messages with places, and what stands in the places.

A message is an English sentence, or a part of one, with places ``{name}``; views have it in other
languages under that very text.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..language.limits import SENTENCE

PLACE = re.compile(r"\{([a-z]+)\}")


@dataclass(frozen=True)
class Sentence:
    """A message and what fills its places: sentences, or text that is the same in every language.

    Without places the message is taken to the letter, braces and all.
    """

    message: str
    places: tuple[tuple[str, Sentence | str], ...] = ()

    def __str__(self) -> str:
        return filled(self.message, {name: str(x) for name, x in self.places})


Prose = tuple[Sentence, ...]
"""Sentences one after the other."""


def filled(message: str, places: Mapping[str, str]) -> str:
    """The text of a message with each place ``{name}`` replaced by its value."""
    return PLACE.sub(lambda found: places[found[1]], message) if places else message


def phrase(message: str, **places: Sentence | str) -> Sentence:
    """A sentence, or a part of one to stand in a place, from a message and its places' values."""
    return Sentence(message, tuple(places.items()))


def say(message: str, **places: Sentence | str) -> Prose:
    """Prose of a single sentence, from its message and the values of its places."""
    return (phrase(message, **places),)


def listed(message: str, items: Sequence[Sentence]) -> Sentence:
    """Many sentences as one, two by two, by a message with the places ``first`` and ``second``."""
    if len(items) < 2:
        return items[0] if items else phrase("")
    half = len(items) // 2
    first, second = listed(message, items[:half]), listed(message, items[half:])
    return phrase(message, first=first, second=second)


def english(prose: Prose) -> str:
    """The prose as English text, its sentences separated by spaces."""
    return " ".join(map(str, prose))


def plain(prose: Prose) -> bool:
    """Is the prose one sentence without places, which its English text alone identifies?"""
    return len(prose) == 1 and not prose[0].places


def to_data(prose: Prose) -> list[dict[str, Any]]:
    """The prose as plain data: for each sentence its message and the values of its places."""
    return [_data(sentence) for sentence in prose]


def _data(x: Sentence) -> dict[str, Any]:
    places = {name: y if isinstance(y, str) else _data(y) for name, y in x.places}
    return {"message": x.message, "places": places}


def of_data(data: Any, where: str) -> Prose:
    """The inverse of :func:`to_data`; ``ValueError`` says what is wrong, and ``where``."""
    if not isinstance(data, list):
        raise ValueError(f"{where}: key 'sentences' must be a list")
    return tuple(_sentence(x, f"{where}, sentence {k}", 0) for k, x in enumerate(data, 1))


def _sentence(data: Any, where: str, depth: int) -> Sentence:
    """One sentence from its data, at some depth of sentences in places of others."""
    if depth > SENTENCE:
        raise ValueError(f"{where}: sentences nested deeper than {SENTENCE}")
    if not isinstance(data, dict) or set(data) != {"message", "places"}:
        raise ValueError(f"{where}: expected an object with the keys 'message' and 'places'")
    message, places = data["message"], data["places"]
    if not isinstance(message, str) or not isinstance(places, dict):
        raise ValueError(f"{where}: 'message' must be a str and 'places' a dict")
    # each once: what repeats a place could grow without bound when it is filled
    if places and sorted(PLACE.findall(message)) != sorted(places):
        raise ValueError(f"{where}: 'places' must be those of the message, each in it once")
    return Sentence(message, tuple((name, _filling(x, where, depth)) for name, x in places.items()))


def _filling(data: Any, where: str, depth: int) -> Sentence | str:
    return data if isinstance(data, str) else _sentence(data, where, depth + 1)
