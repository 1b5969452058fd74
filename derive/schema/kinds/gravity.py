"""U = −Σ m_i ⟨g, r_i⟩."""

from collections.abc import Iterable, Sequence
from typing import Any

from ...language.tree import Tree, add
from ..kind import Potential
from ..table import Number, Vector


class Gravity(Potential):
    """A uniform acceleration g of all masses; several add up."""

    kind, rank, phrase, drawn = "gravity", 0, "its weight", True
    unturned = ""
    needs = ("one space",)
    g: Vector

    @classmethod
    def word(cls, *g: Number | Sequence[Number]) -> Any:
        """Uniform gravity, U = −Σ m_i ⟨g, r_i⟩; the entries of g, or g as a list."""
        return {"g": g[0] if len(g) == 1 and isinstance(g[0], list) else g}


def gravity(potentials: Iterable[Potential]) -> tuple[Tree, ...] | None:
    """The acceleration of gravity, the sum of all that are given."""
    given = [p.g for p in potentials if isinstance(p, Gravity)]
    return tuple(add(*entries) for entries in zip(*given, strict=True)) if given else None
