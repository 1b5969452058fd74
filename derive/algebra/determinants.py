"""Determinants and adjugates of words: det (xy) = det x det y, det x̄ = det x, and the theorem of
Cayley and Hamilton for 3 × 3 matrices."""

from __future__ import annotations

from fractions import Fraction

from .calculus import map_terms
from .words import Expr, Letter, Traces, Word, number, one, scalar_of, trace, word


def determinant_letter(x: Letter) -> Letter:
    """The scalar letter det x; that of the letter x⁻¹ is (det x)⁻¹."""
    return Letter(f"det_{x.name}")


def determinant(e: Expr) -> Expr:
    """det e of one term, n × n for a number n; ``ValueError`` for a sum."""
    if len(e.terms) != 1 or not isinstance(e.rows, int):
        raise ValueError("the determinant of a sum is no product")
    ((traces, w), c), total = next(iter(e.terms.items())), number(1)
    for x, _ in w:
        total = total * word(determinant_letter(x))
    for _ in range(e.rows):
        total = total * scalar_of(traces, c)
    return total


def adjugate(e: Expr) -> Expr:
    """adj e of a 3 × 3 expression, e² − (Tr e) e + ½((Tr e)² − Tr e²)1; ``ValueError`` for another
    size."""
    if (e.rows, e.cols) != (3, 3):
        raise ValueError("the adjugate of a 3 × 3 matrix")
    first, square = trace(e), e * e
    return square - first * e + Fraction(1, 2) * (first * first - trace(square)) * one(3)


def power_of(e: Expr, x: Letter, k: int) -> Expr:
    """The coefficient of the k-th power of a scalar letter in an expression."""

    def kept(traces: Traces, w: Word, c: Fraction) -> Expr:
        others = tuple(y for y in traces if y != ((x, False),))
        return e.like({(others, w): c} if len(traces) - len(others) == k else {})

    return map_terms(e, kept)
