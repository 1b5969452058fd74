"""How a sum of vectors of R³ is written: double vector products whole, Iζ ∧ ζ without a sign."""

from __future__ import annotations

from ..algebra.space import fold_double
from ..algebra.word_trees import PLAIN, WordNotation, tree_of
from ..algebra.words import Expr
from ..language.tree import Tree, add, terms


def vector_sum(e: Expr, notation: WordNotation = PLAIN) -> Tree:
    """The tree of a sum of vectors in normal form, as the paper writes it."""
    return add(*map(flip_wedge, terms(tree_of(fold_double(e), notation))))


def flip_wedge(t: Tree) -> Tree:
    """The tree b ∧ a for −(a ∧ b) where the second factor is a product, as the paper writes
    Iζ ∧ ζ."""
    if isinstance(t, tuple) and t[0] == "mul" and len(t) == 3 and t[1] == -1:
        inside = t[2]
        if isinstance(inside, tuple) and inside[0] == "wedge" and isinstance(inside[2], tuple):
            return ("wedge", inside[2], inside[1])
    return t
