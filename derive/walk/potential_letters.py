"""Potentials as words in A, T, m, c, J and letters of their own.

A letter of its own stands for a word that g moves, or for a power of one: what a displacement makes
of it is derived from that word, and products in it are written by the letters again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from ..algebra.calculus import PairRule, derivation, reduce
from ..algebra.words import Expr, Factor, Letter, word
from ..language.tree import Tree
from ..record.record import Equation
from ..record.sentence import Prose


@dataclass(frozen=True)
class PotentialLetter:
    """A letter of a potential's own, which stands for ``value``; for a product āb, if that is one:
    ``factors`` (a, b) and the ``share`` of the letter that āb is.

    ``axial``: in R³, the vector of the letter N, ⟨axial, x⟩ = Tr N j(x)‾.
    """

    letter: Letter
    value: Expr
    factors: tuple[Letter, Letter] | None = None
    share: Fraction = Fraction(1)
    axial: Letter | None = None

    def varied(self, delta: Callable[[Letter], Expr | None]) -> Expr:
        """The derivative of the letter along a displacement, whose value on other letters is
        ``delta``."""
        return derivation(self.value, delta)

    def written(self, left: Factor, right: Factor) -> Expr | None:
        """The product āb, or b̄a, by the letter; ``None`` for another pair of factors."""
        if self.factors:
            a, b = self.factors
            if (left, right) == ((a, True), (b, False)):
                return self.share * word(self.letter)
            if (left, right) == ((b, True), (a, False)):
                return self.share * word(self.letter).bar
        return None


@dataclass(frozen=True)
class FunctionLetter(PotentialLetter):
    """A letter x for a function of a scalar q, its ``value``: δx = slope · δq.

    ``rules``: what reduces δq.
    """

    slope: Expr = field(kw_only=True)
    rules: tuple[PairRule, ...] = ()

    def varied(self, delta: Callable[[Letter], Expr | None]) -> Expr:
        """The derivative of the letter, by the chain rule."""
        return self.slope * reduce(derivation(self.value, delta), *self.rules)


def power_letter(x: Letter, value: Expr, exponent: Fraction, over: Expr) -> FunctionLetter:
    """A letter for a power of a scalar; ``over``: the scalar's inverse by letters."""
    return FunctionLetter(x, value, slope=exponent * word(x) * over)


def moved(own: Iterable[PotentialLetter], images: Mapping[Letter, Expr]) -> dict[Letter, Expr]:
    """The images of A, T and so on under a displacement, completed by those of own letters."""
    found, listed = dict(images), [*own]
    rules: list[PairRule] = [x.written for x in listed]
    for x in listed:
        found[x.letter] = reduce(x.varied(found.get), *rules)
    return found


@dataclass(frozen=True)
class Words:
    """The potentials of one kind on words: ``energy``: what they add to Ũ; the same
    ``over_points``, as trees.

    ``definitions``: of the letters that are its own; ``prose``: what is said of them; ``own``: how
    those move, each after those that it stands for.
    """

    energy: Expr
    definitions: Sequence[Equation]
    over_points: Sequence[Tree]
    prose: Prose = ()
    own: Sequence[PotentialLetter] = ()
