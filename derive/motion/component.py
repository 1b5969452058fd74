"""Is an element in the part of its group that motions reach?  Relations alone do not tell: that
ĀA = 1 holds for reflections, too.  And Newton's method to the group, which stays in that part."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..code.program import Block
from .run import Array

SINGULAR = 1e-12
"""A determinant that is not larger is 0 to rounding."""

STEPS, LARGEST = 200, 0.9
"""So many Newton steps at most, X = A⁻¹ΔA no larger: 1 + X is then invertible, and of a form that
is orthogonal it is positive and commutes with ĀA, so that the rotation in A = RP stays."""

CONVERGED = 1e-9
"""A step that is smaller is the last one."""


def determinants(block: Block, x: Array) -> Array:
    """det A of one block, of states (…, size of the state)."""
    with np.errstate(all="ignore"):
        return np.asarray(np.linalg.det(_matrix(block, x)), dtype=float)


def _matrix(block: Block, x: Array) -> Array:
    n = round(len(block.places) ** 0.5)
    return x[..., list(block.places)].reshape(*x.shape[:-1], n, n)


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


def taken_to_group(project: Callable[[Array], Array], blocks: Sequence[Block], x: Array) -> Array:
    """States (…, size of the state) after Newton's method in steps of bounded size, ``project`` or
    a part of it each; among rotations the nearest to their A."""
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            step = np.asarray(project(x), dtype=float) - x
            if not np.isfinite(step).all():
                break
            part = np.ones(x.shape[:-1])
            for block in blocks:
                A, change = (_matrix(block, y) for y in (x, step))
                size = np.linalg.norm(np.linalg.pinv(A) @ change, 2, axis=(-2, -1))
                part = np.minimum(part, LARGEST / size)
            x = x + part[..., None] * step
            if np.abs(step).max() < CONVERGED * max(1.0, np.abs(x).max()):
                break  # the error is now the square of that
    return x
