"""What a trim is: an equilibrium under inputs, exact or enclosed."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from ...language.intervals import characteristic, signs_of_real_parts
from ...language.rational import Matrix
from ...language.univariate import Number, grows, routh
from ..equilibria.stability import eigenvalues, polynomial
from .question import Numbers


@dataclass(frozen=True)
class Trim:
    """An equilibrium under inputs.  ``state``, ``inputs``: name → number; ``free``: the names of
    those inputs that were found, ``sought``: of the velocities and turns of g; ``matrix``: D of the
    equations linearised in (η, δζ), (2d, 2d), the inputs held; ``resting``: is the velocity 0?
    ``corner``: is a root 0 there, which has no derivative?"""

    state: Numbers
    inputs: Numbers
    free: tuple[str, ...]
    sought: tuple[str, ...]
    matrix: Matrix
    resting: bool
    corner: bool

    @cached_property
    def characteristic(self) -> tuple[Number, ...]:
        """The characteristic polynomial of the matrix, from the highest power."""
        return polynomial(self.matrix)

    @property
    def verdict(self) -> str:
        """What is proved with the inputs held: "stable", by the real parts of all eigenvalues,
        "unstable", or "open" for nothing."""
        if grows(self.characteristic[::-1]):
            return "unstable"
        return "stable" if routh(self.characteristic) > 0 else "open"

    @property
    def eigenvalues(self) -> tuple[complex, ...]:
        """About those of the matrix, in 1/s."""
        return eigenvalues(self.matrix)


@dataclass(frozen=True)
class EnclosedTrim(Trim):
    """One of which is proved that it is the only one within a ``radius`` of ``near``, velocities,
    turns of g and inputs by name, and of the exact numbers of ``start``; decimals of these, and of
    the entries of g that are ``changed``, stand in ``state`` and ``inputs``, and ``matrix`` is one
    of intervals; ``right``: does ξ stand before g?"""

    near: Numbers
    start: Numbers
    changed: tuple[str, ...]
    radius: Fraction
    right: bool

    @cached_property
    def characteristic(self) -> tuple[Number, ...]:
        """About the characteristic polynomial of the matrix, from the highest power."""
        return tuple(x.middle for x in characteristic(self.matrix))

    @property
    def verdict(self) -> str:
        """What is proved with the inputs held: "stable", "unstable" or "open"."""
        found = signs_of_real_parts(characteristic(self.matrix))
        return {"negative": "stable", "positive": "unstable", "unknown": "open"}[found]
