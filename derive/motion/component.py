"""Is an element in the part of its group that motions reach?  Relations alone do not tell: that
ĀA = 1 holds for reflections, too."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..code.program import Block
from .run import Array

SINGULAR = 1e-12
"""A determinant that is not larger is 0 to rounding."""


def determinants(block: Block, x: Array) -> Array:
    """det A of one block, of states (…, size of the state)."""
    n = round(len(block.places) ** 0.5)
    A = x[..., list(block.places)].reshape(*x.shape[:-1], n, n)
    with np.errstate(all="ignore"):
        return np.asarray(np.linalg.det(A), dtype=float)


def reflection(blocks: Sequence[Block], x: Array) -> str:
    """That a state, or the first such of many, is a reflection, in words; empty where none is."""
    for block in blocks:
        found = determinants(block, x)
        if block.turns and (found < 0).any():
            det = float(np.extract(found < 0, found)[0])
            return f"det A = {det:.3g}: a reflection is no element of {block.group}"
    return ""


def not_near(blocks: Sequence[Block], x: Array) -> str:
    """That a state is on no side from which ``project`` reaches the group, in words, or empty."""
    found = [float(determinants(block, x)) for block in blocks]
    return next((f"det A = {det:.3g} is not above 0" for det in found if not det > SINGULAR), "")


def unreached(blocks: Sequence[Block], x: Array) -> str:
    """Why Newton's method finds no element of the group from a state, in words."""
    return not_near(blocks, x) or "it is too far off for Newton's method"
