"""What a step needs to be so of a number, a matrix or a form: its hypotheses as data."""

from __future__ import annotations

from dataclasses import dataclass

from ..language.tree import Tree

PROPERTIES: dict[str, str] = {
    "positive": "a number that is > 0",
    "semidefinite": "a symmetric matrix of which no vector has a negative square",
    "nonzero": "a number that is not 0",
    "invertible": "a matrix with an inverse",
    "nondegenerate": "a form in two variations, such that 0 alone is orthogonal to all of a space",
}
"""What a tree may be said to be; with a free index, each of its members."""

OF_MASSES = ("positive", "semidefinite")
"""What is so where the masses are positive."""

SPACES: dict[str, str] = {
    "T_g G": "the tangent vectors of the group at g: δA and δ′A, or (δA, δT) and (δ′A, δ′T)",
    "𝔤": "the Lie algebra: ξ and ξ′, or (ξ, η) and (ξ′, η′), where Ω is for ξ = j(Ω)",
}
"""Where the two variations of a form run."""


@dataclass(frozen=True)
class Hypothesis:
    """``of`` has a ``property``; ``space``: of a form, where its variations run."""

    property: str
    of: Tree
    space: str = ""
