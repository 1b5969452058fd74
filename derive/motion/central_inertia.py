"""The tensor of inertia by which a body turns that is free in space."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ..language.tree import Tree
from ..language.values import approximate
from ..problem.problem import Problem
from .run import Array


class Centre(NamedTuple):
    """The mass m and the first moment c of a body, trees in its parameters."""

    m: Tree
    c: tuple[Tree, ...]

    def inertia(self, about_origin: Array, numbers: Mapping[str, float]) -> Array | None:
        """The tensor about the centre of mass, (3, 3), of that about the origin, by Steiner's
        theorem; ``None`` where there is no mass or no number."""
        found = [approximate(x, numbers, float) for x in (self.m, *self.c)]
        if any(x is None for x in found) or not found[0]:
            return None
        m, *c = np.array(found, float)
        tensor: Array = about_origin - (np.dot(c, c) * np.eye(3) - np.outer(c, c)) / m
        return tensor


def centre_of(problem: Problem) -> Centre | None:
    """Where the body of a problem is that also moves freely from place to place; ``None`` where its
    group does not have all translations, or there is no such body."""
    body, group = problem.body, problem.group
    if body is None or group is None or not (group.affine and group.turns_space):
        return None
    own = body.moments()
    return Centre(own.m, own.c)
