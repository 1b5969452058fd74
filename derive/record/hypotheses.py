"""Hypotheses as data: the property that a number, matrix or form must have for a step to hold."""

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
"""Property → what it says of a tree; of a tree with a free index it says that of each member."""

OF_MASSES = ("positive", "semidefinite")
"""The properties that follow from positive masses."""

SPACES: dict[str, str] = {
    "T_g G": "the tangent vectors of the group at g: δA and δ′A, or (δA, δT) and (δ′A, δ′T)",
    "𝔤": "the Lie algebra: ξ and ξ′, or (ξ, η) and (ξ′, η′), where Ω is for ξ = j(Ω)",
}
"""Name of a space → the two variations of a form that run in it."""


@dataclass(frozen=True)
class Hypothesis:
    """The tree ``of`` has the property ``property``, a key of PROPERTIES; ``space``: of a form, a
    key of SPACES, where its two variations run."""

    property: str
    of: Tree
    space: str = ""
