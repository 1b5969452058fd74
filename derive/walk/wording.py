"""Sentences of the walk, by the labels of their steps in :mod:`derive.prose`."""

from __future__ import annotations

from ..prose import english
from ..record import sentence
from ..record.sentence import Prose, Sentence


def phrase(key: str, **places: Sentence | str) -> Sentence:
    """A sentence, or a part of one, that ``kernel.line`` names, its places filled."""
    return sentence.phrase(english(key), **places)


def say(key: str, **places: Sentence | str) -> Prose:
    """One sentence as prose."""
    return (phrase(key, **places),)


def say_signed(key: str, signed: bool, **places: Sentence | str) -> Prose:
    """A sentence for positive masses, or if they may be negative (``signed``) another."""
    return say(f"{key}_signed" if signed else key, **places)
