"""Sentences of the walk, by the labels of their steps in :mod:`derive.prose`."""

from __future__ import annotations

from collections.abc import Sequence

from ..prose import message
from ..record import sentence
from ..record.sentence import Prose, Sentence, listed


def phrase(key: str, **places: Sentence | str) -> Sentence:
    """The sentence, or a part of one, of a key as ``kernel.line``, its places filled."""
    return sentence.phrase(message(key), **places)


def say(key: str, **places: Sentence | str) -> Prose:
    """One sentence as prose, by its key, its places filled."""
    return (phrase(key, **places),)


def say_signed(key: str, signed: bool, **places: Sentence | str) -> Prose:
    """The sentence for positive masses or, where they may be negative (``signed``), the other
    one."""
    return say(f"{key}_signed" if signed else key, **places)


def enumerated(items: Sequence[Sentence]) -> Sentence:
    """Parts of a sentence, at least one, with commas and an "and" before the last."""
    *before, last = items
    if not before:
        return last
    first = listed("{first}, {second}", before)
    return sentence.phrase("{first} and {second}", first=first, second=last)
