"""The body of a problem file: points, moments as parameters or given, solids and their mixtures."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from typing import Any

from ..schema.body_kinds import Body, GivenBody, MomentBody, Moments, Point, PointBody
from ..schema.solid_kinds import SOLIDS, Solid
from ..schema.table import Slot
from .fields import tables
from .file_reader import FileReader
from .moments import SolidError
from .problem import ProblemError
from .solids import moments, together


def body(data: Mapping[str, Any], reader: FileReader) -> Body | None:
    """The body of a file."""
    masses, solids, moved = tables(data, "point"), tables(data, "solid"), reader.group
    table = data.get("body")
    if moved is None:
        if masses or solids or table is not None:
            raise ProblemError("a text about any group has no body of its own; leave it out")
        return None
    points = tuple(reader.whole(Point, x, f"point {k}") for k, x in enumerate(masses, 1))
    if table is None and not solids:
        return PointBody(points=points) if points else None
    if table is not None and (not isinstance(table, dict) or solids):
        raise ProblemError("give either one table [body] or the tables [[solid]]")
    if moved.factors:
        what = "a product" if len(moved.factors) > 1 else "an affine group given by a basis"
        raise ProblemError(f"body: {what} moves [[point]] tables alone, no solids and no moments")
    if table is not None and "solid" not in table:
        if points:
            raise ProblemError("give either [[point]] tables or moments in [body]")
        return _moments(table, reader)
    listed_solids = solids if table is None else [table]
    if moved.n != 3 and not all("quadric" in x for x in listed_solids):
        raise ProblemError(
            f"a solid is in R^3, and {moved.name} moves points of R^{moved.n}; in R^n there are "
            "ellipsoids by their 'quadric'"
        )
    if table is None:
        listed = ((f"solid {k}", x) for k, x in enumerate(solids, 1))
        return _mixture({w: reader.one_of(SOLIDS, x, w) for w, x in listed}, points)
    for key in ("moments", "given"):
        if key in table:
            raise ProblemError(f"body: give either 'solid' or {key!r}")
    return _mixture({"body": reader.one_of(SOLIDS, table, "body", "solid")}, points)


def _moments(table: Mapping[str, Any], reader: FileReader) -> Body:
    """Moments as parameters, or given as expressions."""
    reader.known(table, ("moments", "given", "solid"), "body")
    if "given" not in table:
        reader.choice(Slot(table, "moments", "body"), ("symbolic",))
        return MomentBody(n=reader.moving().n)
    if not isinstance(table["given"], dict) or "moments" in table:
        raise ProblemError('body: give either moments = "symbolic" or given = { m, c, J }')
    return GivenBody(given=reader.whole(Moments, table["given"], "body, given"))


def _mixture(solids: Mapping[str, Solid], points: tuple[Point, ...]) -> GivenBody:
    """The moments of solids, each under its place in the file, and points together."""
    parts = []
    for where, solid in solids.items():
        try:
            parts.append(moments(solid, relations=False))
        except SolidError as error:
            raise ProblemError(f"{where}: {error}") from None
    total = reduce(together, parts)
    own = together(total, PointBody(points=points).moments()) if points else total
    return GivenBody(given=own, solids=tuple(solids.values()), points=points or None)
