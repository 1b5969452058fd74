"""A record to be read beside the other trivialisation: what holds for any Lagrangian, step by step
on the left and on the right."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ..record.record import Derivation, Symbol


def both_sides(d: Derivation, left: Derivation, right: Derivation) -> Derivation:
    """A record behind the steps of ``left`` and ``right``, each beside its like.

    To be read, not to be checked: of the names, it explains those that mean the same on both sides.
    """
    general = [step for pair in zip(left.steps, right.steps, strict=True) for step in pair]
    there = {step.label for step in general}
    own = [step for step in d.steps if step.label not in there]
    return replace(d, steps=(*general, *own), symbols=(*_symbols(d, left, right),))


def _symbols(d: Derivation, left: Derivation, right: Derivation) -> Iterator[Symbol]:
    """The symbols of the three, without those that the sides define each in its own way."""
    others = {s.name: s.meaning for s in right.symbols}
    sided = {s.name for s in left.symbols if others.get(s.name) != s.meaning}
    found = {s.name: s for s in (*left.symbols, *d.symbols)}
    yield from (s for s in found.values() if s.name not in sided)
