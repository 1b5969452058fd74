"""The moments of a body: what solids and meshes are integrated to."""

from __future__ import annotations

from dataclasses import dataclass

from ..language.tree import Tree

Row = tuple[Tree, ...]


class SolidError(ValueError):
    """What is wrong with a solid, in one line."""


@dataclass(frozen=True)
class Moments:
    """The moments of a body in R³: m, c (3 entries) and J (3 × 3); they add."""

    mass: Tree
    first: Row
    second: tuple[Row, ...]
