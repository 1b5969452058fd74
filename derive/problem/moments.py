"""The moments of a file, carried to m, c and J: by the centre of mass, by a tensor of inertia."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from ..language.derivatives import product, quotient
from ..language.laurent import OverlongError, collected
from ..language.tree import Tree, add, mul, neg, plain
from ..schema.table import Rows
from .problem import ProblemError
from .solids import Row

MEANINGS = {
    "c": "the first moment, mass times centre of mass",
    "centre": "the centre of mass",
    "J": "the matrix of moments about the origin",
    "I": "the tensor of inertia about the origin",
    "I_centre": "that about the centre of mass",
}
"""How a body's first and second moments are given; I in R³ alone."""


def given_by(given: Mapping[str, Any], names: tuple[str, ...], where: str) -> str:
    """The one key of some that is there."""
    found = [x for x in names if x in given]
    if len(found) != 1:
        listed = ", or ".join(f"{x}, {MEANINGS[x]}" for x in names)
        raise ProblemError(f"{where}: give {'one of ' * (len(names) > 1)}{listed}")
    return found[0]


def first_moment(mass: Tree, centre: Row) -> Row:
    """c = m s."""
    return tuple(_exact(product(mass, x)) for x in centre)


def second_moment(name: str, rows: Rows, mass: Tree, first: Row, where: str) -> Rows:
    """J, from itself or from a tensor of inertia, I or I_centre; in the plane ½ I 1 stands for
    I."""
    J = rows if name == "J" or len(rows) == 2 else _from_inertia(rows)
    return _from_centre(J, mass, first, where) if name == "I_centre" else J


def require_symmetric(rows: Rows, where: str) -> None:
    """``ProblemError`` where a matrix is not equal to its transpose."""
    if any(rows[i][j] != rows[j][i] for i in range(len(rows)) for j in range(i)):
        raise ProblemError(f"{where}: the matrix must be symmetric")


def _from_inertia(tensor: Rows) -> Rows:
    """J = ½ (Tr I) 1 − I, from I = (Tr J) 1 − J."""
    span = range(3)
    half = [_half(*(tensor[j][j] for j in span if j != i), neg(tensor[i][i])) for i in span]
    return tuple(tuple(half[i] if i == j else neg(tensor[i][j]) for j in span) for i in span)


def _from_centre(J: Rows, mass: Tree, first: Row, where: str) -> Rows:
    """J + c c̄/m, from J about the centre of mass (Steiner)."""
    if mass == 0:
        raise ProblemError(f"{where}, m: a body without mass has no centre of mass")

    def entry(i: int, j: int) -> Tree:
        return _exact(add(J[i][j], quotient(product(first[i], first[j]), mass)))

    span = range(len(first))
    return tuple(tuple(entry(min(i, j), max(i, j)) for j in span) for i in span)


def _exact(t: Tree) -> Tree:
    """The same with like terms added, a number where it is one."""
    try:
        found = collected(t)
    except OverlongError:
        raise ProblemError(
            "body, given: centre or I_centre is too long to be carried to the origin; give c and I "
            "or J, or a parameter of its own for each sum"
        ) from None
    return int(found) if isinstance(found, Fraction) and found.denominator == 1 else found


def _half(*terms: Tree) -> Tree:
    """½ Σ, a number where all terms are."""
    numbers = [x for x in terms if isinstance(x, (int, Fraction))]
    if len(numbers) < len(terms):
        return collected(mul(Fraction(1, 2), add(*terms)))
    return plain(Fraction(sum(numbers), 2))
