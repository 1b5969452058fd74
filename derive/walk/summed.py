"""Potentials as words in A, T, m, c, J and letters of their own.

A letter of its own stands for a word that g moves: what a displacement makes of it is derived from
that word, in which the letter is put back.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..algebra.words import Expr
from ..language.tree import Tree
from ..record.record import Equation
from ..record.sentence import Prose


@dataclass(frozen=True)
class Words:
    """``energy``: what the potentials of a kind add to Ũ; the same ``over_points``, as trees.

    ``definitions``: of the letters that are its own; ``prose``: what is said of them.
    """

    energy: Expr
    definitions: Sequence[Equation]
    over_points: Sequence[Tree]
    prose: Prose = ()
