"""The tensor of inertia of a body of which only its Lagrangian is told."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..language.derivatives import derivative
from ..language.tree import Tree, replaced
from ..language.values import approximate
from ..schema.lagrangian_kinds import Lagrangian
from .run import Array

VELOCITY: tuple[Tree, ...] = tuple(("entry", "ζ", a) for a in (1, 2, 3))
"""The coordinates of Z that turn a body about its axes, in SO(3) and SE(3)."""


def inertia_of(lagrangian: Lagrangian, numbers: Mapping[str, float]) -> Array | None:
    """I of ℓ = ½⟨ζ, Iζ⟩ + …, (3, 3), where the momentum ∂ℓ/∂ζ is Iζ, I positive; ``None`` for
    another ℓ, as that of a gyrostat, of a body that drags a fluid, or of a thin rod."""
    if lagrangian.trivialisation != "left":
        return None
    try:
        momentum = [derivative(lagrangian.L, x) for x in VELOCITY]
        second = [[derivative(p, x) for x in VELOCITY] for p in momentum]
    except ValueError:  # a function that has no derivative
        return None
    rows = [[approximate(t, numbers, float) for t in row] for row in second]
    rest = [approximate(_at_rest(p), numbers, float) for p in momentum]
    if rest != [0, 0, 0] or any(x is None for row in rows for x in row):
        return None
    found = np.array(rows, float)
    return found if bool((np.linalg.eigvalsh(found) > 0).all()) else None


def _at_rest(t: Tree) -> Tree:
    for x in VELOCITY:
        t = replaced(t, x, 0)
    return t
