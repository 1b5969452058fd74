"""What may be otherwise in someone's code, and how it is said."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import pi

import numpy as np

from .balance import Balance, Term
from .users_code import Array

SIMPLE = {-1.0: "has the other sign", 0.0: "is missing"}
SIMPLE |= {x: f"has the factor {words}" for x, words in ((2.0, "2"), (0.5, "1/2"), (4.0, "4"))}
SIMPLE |= {-2.0: "has the factor −2", -0.5: "has the factor −1/2", 0.25: "has the factor 1/4"}
"""Factors that say what happened."""
UNITS = {
    "180/π (degrees, not radians)": 180 / pi,
    "2π (turns, not radians)": 2 * pi,
    "30/π (turns a minute, not radians a second)": 30 / pi,
    "9.80665 (kilograms of force, not newtons)": 9.80665,
    "1000 (a unit with kilo or milli)": 1000.0,
}
"""Factors between units, in words."""
SIMPLE |= {x: f"has the factor {words}" for words, x in UNITS.items()}
SIMPLE |= {1 / x: f"is divided by {words}" for words, x in UNITS.items()}
FACTORS = (-1.0, 0.0, 2.0, 0.5)
"""What something is multiplied by that is not fitted."""
STANDARD_GRAVITY = 9.80665
NEAR = 1e-7
"""How near a number is to one that has a name."""
SHIFT = 1e-3
"""By so much of itself a number is moved, to see what depends on it."""
ABOUT = " about the centre of mass"


@dataclass(frozen=True)
class Hypothesis:
    """What may be otherwise in the user's code, in ``words``; how far it is from saying what
    happened (``rank``, the least first); what it leaves, (N, d)."""

    words: str
    rank: int
    left: Array


@dataclass(frozen=True)
class Changed:
    """Our equations with one change, in words, and how far it is from saying what happened."""

    words: str
    rank: int
    balance: Balance


def told(name: str, old: float, new: float, others: Mapping[str, float]) -> tuple[str, int]:
    """What became of a number, in words, and how telling this is."""
    if old:
        for factor, words in SIMPLE.items():
            if abs(new - factor * old) <= NEAR * abs(old):
                return (f"{name} {words}" if factor else f"{name} is 0, not {old:.6g}"), 0
        if abs(new * old - 1) <= NEAR:
            return f"{name} stands as its reciprocal", 0
        if abs(abs(new) - STANDARD_GRAVITY) <= NEAR:
            return f"{name} is that of standard gravity, {new:.6g}, not {old:.6g}", 0
    for other, value in others.items():
        if other != name and value and abs(abs(new) - abs(value)) <= NEAR * abs(value):
            return f"{name} is {'−' * (new * value < 0)}{other}", 1
    return f"{name} is {new:.6g}, not {old:.6g}", 4


def changed(
    name: str,
    factor: float,
    known: Mapping[str, float],
    related: Callable[[str], bool] = lambda _: True,
) -> tuple[str, int]:
    """What is said of a term that has a factor, perhaps a ``known`` number that is ``related`` to
    it, or its reciprocal, and how telling this is."""
    if abs(factor) <= NEAR:
        return f"{name} is missing", 0
    words, rank = told(name, 1.0, factor, {})
    if rank == 0:
        return words, 0
    for other, value in known.items():
        for how, x in (("has the factor", value), ("is divided by", value and 1 / value)):
            if x and abs(abs(factor) - abs(x)) <= NEAR * abs(x) and related(other):
                return f"{name} {how} {'−' * (factor * x < 0)}{other}", 0
    return f"{name} has the factor {factor:.6g}", 4


def with_other(b: Balance, name: str) -> Balance:
    """The balance with another value of a number, by what it is ``named`` there."""
    other = b.named[name] * (1 + SHIFT)
    if slot := next((x.name for x in b.opened.slots if x.words == name), ""):
        return replace(b, changed={**b.changed, slot: other})
    return replace(b, parameters={**b.parameters, name: other})


def is_inertia(b: Balance, name: str) -> bool:
    """Is a number one on the diagonal of the mass matrix, by which a load may have been divided?"""
    diagonal = np.diagonal(b.mass(b.values()), axis1=1, axis2=2)
    near = np.abs(diagonal - b.named[name]) <= NEAR * abs(b.named[name])
    return bool(near.all(axis=0).any())


def stands_in(b: Balance, name: str, term: Term) -> bool:
    """Is a number related to a term: an inertia, or one on which the term depends?"""
    if is_inertia(b, name):
        return True
    called, moved = term.name(""), with_other(b, name)
    try:
        found = next(x for x in (*moved.terms(), *moved.together()) if x.name("") == called)
    except (ValueError, StopIteration):  # no body has this number
        return False
    change = np.abs(found.values - term.values).max()
    return bool(change > NEAR * SHIFT * np.abs(term.values).max())


def possible(b: Balance, values: Mapping[str, float] | None = None) -> Array | None:
    """What is left at some numbers, or at those of the balance; none where no body has them."""
    try:
        return b.unexplained if values is None else b.left(values)
    except ValueError:
        return None
