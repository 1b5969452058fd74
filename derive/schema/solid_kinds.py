"""The kinds of solids and their sizes."""

from dataclasses import dataclass
from typing import Any

from .table import (
    Corners,
    Faces,
    Inner,
    Length,
    Lengths,
    Number,
    Scalar,
    Shift,
    Table,
    Turn,
    Vertices,
)


@dataclass(frozen=True, kw_only=True)
class Solid(Table):
    """The points R r + s of a kind of solid: ``rotation`` R, 3 × 3, and ``shift`` s, 3 entries."""

    section, called = "solid", "Solid"
    density: Scalar
    rotation: Turn = None
    shift: Shift = None

    @property
    def sizes(self) -> dict[str, Any]:
        """The keys that only this kind has."""
        placed = Solid.keys()
        return {x: getattr(self, x) for x in self.keys() if x not in placed}

    def plain(self) -> dict[str, Any]:
        """The sizes are a table of their own."""
        said = super().plain()
        sizes = {x: said.pop(x) for x in self.sizes}
        placed = {x: said.pop(x) for x in ("rotation", "shift")}
        return said | {"sizes": sizes} | placed

    @classmethod
    def word(cls, kind: str, density: Number, **sizes: Any) -> Any:
        """A solid of uniform density: ``Solid("ball", "rho", radius="a")``; a sum is a mixture."""
        return [{"kind": kind, "density": density, **sizes}]


@dataclass(frozen=True, kw_only=True)
class Ball(Solid):
    """Of a radius."""

    kind = "ball"
    radius: Length


@dataclass(frozen=True, kw_only=True)
class Box(Solid):
    """Full lengths; centred."""

    kind = "box"
    sides: Lengths


@dataclass(frozen=True, kw_only=True)
class Ellipsoid(Solid):
    """Centred."""

    kind = "ellipsoid"
    semi_axes: Lengths


@dataclass(frozen=True, kw_only=True)
class Cylinder(Solid):
    """About z; centred."""

    kind = "cylinder"
    radius: Length
    height: Length


@dataclass(frozen=True, kw_only=True)
class Cone(Solid):
    """About z; base in the plane z = 0, apex at z = height."""

    kind = "cone"
    radius: Length
    height: Length


@dataclass(frozen=True, kw_only=True)
class HollowBall(Solid):
    """Between two spheres."""

    kind = "hollow_ball"
    outer: Length
    inner: Inner


@dataclass(frozen=True, kw_only=True)
class Tetrahedron(Solid):
    """Four points."""

    kind = "tetrahedron"
    vertices: Corners


@dataclass(frozen=True, kw_only=True)
class Mesh(Solid):
    """A closed surface of triangles: three coordinates each, three numbers from 0 each."""

    kind = "mesh"
    vertices: Vertices
    faces: Faces


SOLIDS: dict[str, type[Solid]] = {x.kind: x for x in Solid.__subclasses__()}
