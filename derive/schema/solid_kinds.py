"""The kinds of solids and their sizes."""

from collections.abc import Mapping
from typing import Any

from .table import (
    Axes,
    Corners,
    Density,
    Faces,
    Inner,
    Length,
    Lengths,
    Number,
    Quadric,
    Shift,
    Table,
    Turn,
    Vertices,
)


class Solid(Table):
    """The points R r + s of a kind of solid: ``rotation`` R, 3 × 3, and ``shift`` s, 3 entries."""

    section, called = "solid", "Solid"
    density: Density
    rotation: Turn = None
    shift: Shift = None

    @property
    def sizes(self) -> dict[str, Any]:
        """The keys that only this kind has."""
        placed = Solid.keys()
        own = (x for x in self.keys() if x not in placed)
        return {x: getattr(self, x) for x in own if getattr(self, x) is not None}

    def plain(self) -> dict[str, Any]:
        """The sizes are a table of their own."""
        said = super().plain()
        sizes = {x: said.pop(x) for x in self.sizes}
        placed = {x: said.pop(x) for x in ("rotation", "shift")}
        return said | {"sizes": sizes} | placed

    @classmethod
    def word(cls, kind: str, density: Number, **sizes: Any) -> Any:
        """A solid of a density: ``Solid("ball", "rho", radius="a")``; a sum is a mixture."""
        return [{"kind": kind, "density": density, **sizes}]


SIZES: dict[str, dict[str, Any]] = {
    "ball": {"radius": Length},
    "box": {"sides": Lengths},  # full lengths; centred
    "ellipsoid": {"semi_axes": Axes, "quadric": Quadric},  # one of the two
    "cylinder": {"radius": Length, "height": Length},  # about z; centred
    "cone": {"radius": Length, "height": Length},  # about z; base in z = 0, apex at z = height
    "hollow_ball": {"outer": Length, "inner": Inner},
    "tetrahedron": {"vertices": Corners},
    "mesh": {"vertices": Vertices, "faces": Faces},
}
"""Of a mesh three coordinates for each vertex, and three numbers of vertices, from 0, each face."""


class Ellipsoid(Solid):
    """Semi-axes along those of R³; or ⟨r, Q r⟩ ≤ 1 in Rⁿ, ``quadric`` Q, where it stands."""

    kind = "ellipsoid"
    semi_axes: Axes = None
    quadric: Quadric = None

    @classmethod
    def chosen(cls, table: Mapping[str, Any], _: int) -> tuple[str, ...] | str:
        """One of the two."""
        own = [x for x in ("semi_axes", "quadric") if x in table]
        if len(own) != 1:
            return (
                "an ellipsoid has either 'semi_axes' or a 'quadric', the matrix Q of <r, Q r> <= 1"
            )
        placed = [x for x in ("rotation", "shift") if table.get(x) is not None]
        if own == ["quadric"] and placed:
            return f"key {placed[0]!r} goes with 'semi_axes'; turn the quadric itself"
        return ("density", "rotation", "shift", *own)


LAYERED = ("ball", "ellipsoid")
"""The kinds that are ⟨r, Q r⟩ ≤ 1, whose density may be a function of the level."""
SOLIDS: dict[str, type[Solid]] = {
    kind: type(kind, (Solid,), {"kind": kind, "__annotations__": sizes, "__doc__": Solid.__doc__})
    for kind, sizes in SIZES.items()
} | {"ellipsoid": Ellipsoid}
