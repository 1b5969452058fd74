"""Left-invariance of the metric of a body on its group, where C = ĀA is not 1.

Decided exactly, in polynomials of the parameters.
"""

from __future__ import annotations

from typing import Literal

from ..algebra.invariance import for_every_body, pairings, skew
from ..language.divisors import PRIMES, residue
from ..language.laurent import OverlongError, vanishes
from ..language.rational import Matrix
from ..language.tree import Tree, add, mul, plain
from ..schema.body_kinds import Body, PointBody
from .problem import Problem

Bodies = Literal["every body", "this body"]
EVERY: Bodies = "every body"
THIS: Bodies = "this body"


def invariant(problem: Problem) -> Bodies | None:
    """For which bodies, this one among them, Tr Y J Ȳ′ C = Tr Y J Ȳ′ for all Y, Y′ of 𝔤.

    ``None`` where not for this one, or where to tell would take polynomials that are too long.
    """
    group, body = problem.group, problem.body
    if group is None or body is None or group.affine or skew(group):
        return None
    if for_every_body(group):
        return EVERY
    if group.larger:
        return None
    J = _moments(problem, body)
    try:
        return THIS if all(_vanishes(_paired(k, J)) for k in pairings(group)) else None
    except (OverlongError, ZeroDivisionError):
        return None


def _paired(k: Matrix, J: tuple[tuple[Tree, ...], ...]) -> Tree:
    """The tree Σ k_ij J_ij."""
    pairs = zip(k, J, strict=True)
    return add(*(mul(plain(x), t) for a, b in pairs for x, t in zip(a, b, strict=True) if x))


def _vanishes(t: Tree) -> bool:
    """Is it 0 for all parameters? A residue that is not 0 settles it without multiplying out."""
    return residue(t, PRIMES[0]) == 0 and vanishes(t)


def _moments(problem: Problem, body: Body) -> tuple[tuple[Tree, ...], ...]:
    """The matrix Σ m r r̄ with r as the matrices of the group act on it."""
    group = problem.group
    assert group is not None
    if isinstance(body, PointBody):
        masses = [(p.mass, group.in_block(p.block, p.at, 1)) for p in body.points]
        span = range(group.n)
        return tuple(
            tuple(add(*(mul(m, r[i], r[j]) for m, r in masses)) for j in span) for i in span
        )
    return body.moments().J
