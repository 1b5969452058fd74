"""The body of a problem: points, moments as parameters, or given, or those of solids."""

from collections.abc import Mapping
from typing import Annotated, Any

from ..language.laurent import is_layered
from ..language.tree import Tree, add, mul
from .kind import Parameter
from .table import (
    At,
    Axes,
    Block,
    Central,
    Corners,
    Density,
    Faces,
    First,
    Inner,
    Key,
    Length,
    Lengths,
    Number,
    Quadric,
    Rows,
    Scalar,
    Second,
    Shift,
    Space,
    Table,
    Turn,
    Vertices,
)

# The kinds of solids and their sizes.


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


class Place(Table):
    """A place in the body without mass, where a force acts; ``block``: the factor of a product that
    moves it, counted from 1."""

    at: At
    block: Block = 1


class Point(Table):
    """A point mass."""

    section, called, timed = "point", "Points", True
    mass: Scalar
    at: At
    block: Block = 1

    @classmethod
    def word(cls, *points: tuple[Any, ...]) -> Any:
        """A body of points: (mass, place) for each, and in a product the block that moves it."""
        said = (p if isinstance(p, list) else [p] for p in points)
        return [dict(zip(("mass", "at", "block"), p, strict=False)) for p in said]


class Moments(Table):
    """m, c = Σ m r (n entries) and J = Σ m r r̄ (n × n); a file may say c and J by others.

    ``central``: did it say J by the tensor of inertia about the centre of mass?
    """

    section, called, timed = "body", "Moments", True
    m: Scalar
    c: First
    J: Second
    central: Central = False

    @classmethod
    def word(cls, **given: Any) -> Any:
        """A body by its moments: m, c and J as given, or as parameters when none is given."""
        return [{"given": given} if given else {"moments": "symbolic"}]


Points = Annotated[tuple[Point, ...], Key("tables", 1, own=Point)]


class PointBody(Table):
    """Point masses alone."""

    kind = "points"
    points: Points

    @classmethod
    def chosen(cls, table: Mapping[str, Any], _: int) -> tuple[str, ...] | str:
        """One at least."""
        return ("points",) if table.get("points") else "key 'points' must list points"

    def moments(self) -> Moments:
        """Those of all points, where one group moves them."""
        span = range(len(self.points[0].at))
        rows: list[list[Tree]] = [[0 for _ in span] for _ in span]
        mass: Tree = 0
        first: list[Tree] = [0 for _ in span]
        for p in self.points:
            mass = add(mass, p.mass)
            first = [add(x, mul(p.mass, y)) for x, y in zip(first, p.at, strict=True)]
            rows = [[add(rows[i][j], mul(p.mass, p.at[i], p.at[j])) for j in span] for i in span]
        return Moments(m=mass, c=tuple(first), J=tuple(map(tuple, rows)))


class MomentBody(Table):
    """A body known by its moments, which are parameters m, c_1 …, J_11, J_12, …"""

    kind = "moments"
    n: Space

    def moments(self) -> Moments:
        """The upper triangle of J is named row by row."""
        span = range(1, self.n + 1)
        J: Rows = tuple(tuple(("par", f"J_{min(i, j)}{max(i, j)}") for j in span) for i in span)
        return Moments(m=("par", "m"), c=tuple(("par", f"c_{i}") for i in span), J=J)

    def parameters(self) -> dict[str, Parameter]:
        """All the moments, in the order of the emitted parameters."""
        span = range(1, self.n + 1)
        meanings = {"m": "total mass"}
        meanings |= {f"c_{i}": "first moment, the sum of m r" for i in span}
        meanings |= {
            f"J_{i}{j}": "entry of the matrix of moments J (not of the tensor of inertia)"
            for i in span
            for j in span[i - 1 :]
        }
        return {name: Parameter(meaning=meaning) for name, meaning in meanings.items()}


class GivenBody(Table):
    """A body whose moments are given, or are those of solids and points together."""

    kind = "given"
    given: Annotated[Moments, Key("table", own=Moments)]
    solids: Annotated[tuple[Solid, ...], Key("solids", 1)] = ()
    points: Points | None = None

    @classmethod
    def chosen(cls, table: Mapping[str, Any], _: int) -> tuple[str, ...] | str:
        """Points are listed among solids alone."""
        if table.get("points") and not table.get("solids"):
            return "given moments are of no listed points; leave these out"
        return ("given", "solids", *(x for x in table if x == "points"))

    def moments(self) -> Moments:
        """Those of all that it is made of."""
        return self.given


class AnyBody(Table):
    """None: the text is about any."""

    kind = "any"


class NoBody(Table):
    """None: the problem says all of its Lagrangian."""

    kind = "none"


def is_ellipsoid(body: Table | None) -> bool:
    """Is a body one homogeneous ellipsoid about the origin, and nothing else?"""
    if not isinstance(body, GivenBody) or len(body.solids) != 1 or body.points:
        return False
    (solid,) = body.solids
    shifted = any(x != 0 for x in solid.shift or ())
    return solid.kind in LAYERED and not shifted and not is_layered(solid.density)


Body = PointBody | MomentBody | GivenBody


def by_block(body: Body) -> dict[int, Body]:
    """What each block of a product moves, by its number from 1: points; of other groups all."""
    if not isinstance(body, PointBody):
        return {1: body}
    blocks = sorted({p.block for p in body.points})
    return {b: PointBody(points=tuple(p for p in body.points if p.block == b)) for b in blocks}


_ALL: tuple[type[Table], ...] = (PointBody, GivenBody, MomentBody, AnyBody, NoBody)
BODIES: dict[str, type[Table]] = {x.kind: x for x in _ALL}
