"""Inverse letters: x⁻¹ as a letter with the relation x⁻¹x = xx⁻¹ = 1."""

from __future__ import annotations

from fractions import Fraction

from ..algebra.calculus import PairRule, map_terms
from ..algebra.words import Expr, Factor, Letter, Traces, Word, one
from ..language.tree import Tree


def inverse_letter(x: Letter) -> Letter:
    """The letter x⁻¹, with the symmetry of x."""
    return Letter(f"{x.name}⁻¹", x.rows, x.cols, x.symmetry)


def inverse_tree(x: Letter) -> Tree:
    """The tree of x⁻¹."""
    return ("inv", x.name)


def cancelling(*letters: Letter) -> PairRule:
    """The relations x⁻¹x = 1 and xx⁻¹ = 1 for these matrix letters."""
    inverses = {inverse_letter(x): x for x in letters}

    def rule(left: Factor, right: Factor) -> Expr | None:
        pair = (left[0], right[0])
        inverse = any(inverses.get(x) == y for x, y in (pair, pair[::-1]))
        return one(left[0].rows) if inverse and left[1] == right[1] else None

    return rule


def cancel_scalar(e: Expr, x: Letter) -> Expr:
    """An expression with x x⁻¹ = 1 for the scalar letter x, as m."""
    up, down = ((x, False),), ((inverse_letter(x), False),)

    def cancelled(traces: Traces, w: Word, c: Fraction) -> Expr:
        kept = list(traces)
        while up in kept and down in kept:
            kept.remove(up)
            kept.remove(down)
        return e.like({(tuple(kept), w): c})

    return map_terms(e, cancelled)
