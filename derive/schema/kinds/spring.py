"""U = ½ k (‖s‖ − ℓ)² between two points, or from one to an anchor in space."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from ..kind import Potential
from ..table import End, Number, Pair, Scalar, Stiffness, Vector, place


class Spring(Potential):
    """``between`` two points, counted from 1; or ``on`` one and from it to an ``anchor``."""

    kind, rank, phrase, drawn = "spring", 1, "a spring", True
    unturned = ""
    several, legend = "{n} springs", "Zigzags are springs."
    between: Pair | None = None
    on: End | None = None
    anchor: Vector | None = None
    stiffness: Stiffness
    length: Scalar = 0

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """Either ``between``, or an end with an ``anchor``."""
        if "between" in table:
            if any(x in table for x in ("at", "on", "anchor", "block")):
                return "give either 'between' or an end with an 'anchor'"
            return "between", "stiffness", "length"
        if "anchor" not in table:
            ends = "'between', or 'on' or 'at'" if last else "'at', a place of the body,"
            return f"give {ends} with an 'anchor'"
        return "on", "anchor", "stiffness", "length"

    @classmethod
    def word(
        cls,
        i: int | Sequence[Number],
        j: int | Sequence[Number],
        stiffness: Number,
        length: Number = 0,
        block: int | None = None,
    ) -> Any:
        """A spring, U = ½ k (‖s‖ − length)², between points i and j; or from point i, or a place i
        of the body, in a product of that of a block, to an anchor j in space."""
        between = {"between": [i, j], "block": block}
        ends = between if isinstance(j, int) else place(i, block) | {"anchor": j}
        return {"stiffness": stiffness, "length": length, **ends}

    @property
    def ends(self) -> tuple[int, int | None]:
        """The two points, or the one."""
        if self.between:
            return self.between
        assert self.on
        return self.on, None


def quadratic(potentials: Iterable[Potential], block: Callable[[int], int]) -> tuple[Spring, ...]:
    """Springs of natural length 0 inside one block: their energy is quadratic in A alone."""
    springs = (p for p in potentials if isinstance(p, Spring) and p.between and p.length == 0)
    return tuple(p for p in springs if p.between and len({*map(block, p.between)}) == 1)
