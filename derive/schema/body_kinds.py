"""The body of a problem: points, or moments that are parameters, or given, or those of solids."""

from collections.abc import Mapping
from typing import Annotated, Any

from ..language.layers import is_layered
from ..language.tree import Tree, add, mul
from .declared import Parameter
from .solid_kinds import LAYERED, Solid
from .table import At, Block, Central, First, Key, Rows, Scalar, Second, Space, Table


class Place(Table):
    """A place in the body without mass, where a force acts; ``block``: the factor of a product that
    moves it, counted from 1."""

    at: At
    block: Block = 1


class Point(Table):
    """A point mass."""

    section, called = "point", "Points"
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

    section, called = "body", "Moments"
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
_ALL: tuple[type[Table], ...] = (PointBody, GivenBody, MomentBody, AnyBody, NoBody)
BODIES: dict[str, type[Table]] = {x.kind: x for x in _ALL}
