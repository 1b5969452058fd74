"""The body, the group and the forces of a problem file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from typing import Any

from ..algebra.families import group, on_homogeneous
from ..algebra.groups import Group
from ..algebra.user_groups import group_of_basis
from ..language.expression import hypot, names
from ..language.tree import mul, neg
from ..schema.body_kinds import (
    SOLIDS,
    Body,
    GivenBody,
    MomentBody,
    Moments,
    Place,
    Point,
    PointBody,
    Solid,
)
from ..schema.force_kinds import (
    DAMPING,
    INPUTS,
    Acting,
    AnyDamping,
    CovectorInput,
    Damping,
    ForceInput,
    Input,
    LaplacianDamping,
    QuadraticDamping,
    RotationalDamping,
    ScalarInput,
    StatedForce,
    TorqueInput,
    acting_kind,
)
from ..schema.kind import GROUP, Parameter, StatedGroup
from ..schema.motion_kinds import (
    OUTPUTS,
    ExpressionOutput,
    Output,
    PowerOutput,
    fault_of_gravity,
)
from ..schema.potential_kinds import Potential, kinds
from ..schema.table import ACTIONS, Slot, Table
from .fields import angular_velocity, named_tables, tables, velocity_at_place
from .file_reader import FileReader
from .inertia import is_negative
from .problem import ProblemError, SolidError
from .solids import joined_moments, moments


def body(data: Mapping[str, Any], reader: FileReader) -> Body | None:
    """The body of a file."""
    masses, solids, moved = tables(data, "point"), tables(data, "solid"), reader.group
    table = data.get("body")
    if moved is None:
        if masses or solids or table is not None:
            raise ProblemError("a text about any group has no body of its own; leave it out")
        return None
    points = tuple(reader.typed(Point, x, f"point {k}") for k, x in enumerate(masses, 1))
    if table is None and not solids:
        return PointBody(points=points) if points else None
    if table is not None and (not isinstance(table, dict) or solids):
        raise ProblemError("give either one table [body] or the tables [[solid]]")
    if moved.factors:
        what = "a product" if len(moved.factors) > 1 else moved.name
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
    return GivenBody(given=reader.typed(Moments, table["given"], "body, given"))


def _mixture(solids: Mapping[str, Solid], points: tuple[Point, ...]) -> GivenBody:
    """The moments of solids, each under its place in the file, and points together."""
    parts = []
    for where, solid in solids.items():
        try:
            parts.append(moments(solid, relations=False))
        except SolidError as error:
            raise ProblemError(f"{where}: {error}") from None
    total = reduce(joined_moments, parts)
    own = joined_moments(total, PointBody(points=points).moments()) if points else total
    return GivenBody(given=own, solids=tuple(solids.values()), points=points or None)


# The group of a problem file: by its name, or a table with a basis of one's own.


def group_of(data: Mapping[str, Any], reader: FileReader) -> tuple[Group | None, str]:
    """The group, by its name or by a table with a basis, and its action."""
    which = data.get("group")
    if isinstance(which, dict):
        moved = _user_group(reader.typed(StatedGroup, which, "group"))
        if "action" in data:
            raise ProblemError("key 'action' belongs into the table [group]")
        return moved, moved.action
    if isinstance(which, list):
        raise ProblemError("key 'group' is one name; that of a product is \"SE(2) x SO(2)\"")
    which = reader.text(Slot(data, "group", "file"))
    if which.casefold() == GROUP.casefold():
        raise ProblemError(f"key 'group': {GROUP} is that of a table [fluid]; leave this out")
    try:
        named = None if which == "any" else group(which)
    except ValueError as error:
        raise ProblemError(f"key 'group': {error}") from None
    if named and "action" not in data:
        return named, named.action
    action = reader.choice(Slot(data, "action", "file"), ACTIONS)
    if named and action != named.action:
        raise ProblemError(f"key 'action': {named.name} acts by {named.action} maps")
    return named, action


def _user_group(own: StatedGroup) -> Group:
    try:
        moved = group_of_basis(
            own.name, "affine" if own.action == "affine" else "linear", [*own.basis]
        )
    except ValueError as error:
        raise ProblemError(f"group: {error}") from None
    return moved if not moved.affine or moved.free_translations else on_homogeneous(moved)


# The tables [[potential]], [[input]], [[damping]] and [[force]] of a problem file.

Forces = tuple[tuple[Potential, ...], tuple[Input, ...], tuple[AnyDamping, ...], tuple[Acting, ...]]


def forces(data: Mapping[str, object], reader: FileReader) -> Forces:
    """All of them; there is one of what may be there once."""
    potentials, inputs, damping, stated = (
        named_tables(data, key) for key in ("potential", "input", "damping", "force")
    )
    acting = [w for w, x in inputs.items() if x.get("kind") in (ForceInput.kind, TorqueInput.kind)]
    for where in (*potentials, *acting, *damping, *stated) if reader.group is None else ():
        raise ProblemError(f"{where}: a text about any group has no points on which this could act")
    found = tuple(reader.one_of(kinds(), x, where) for where, x in potentials.items())
    given = tuple(reader.one_of(INPUTS, x, where) for where, x in inputs.items())
    for k, p in enumerate(found, 1):
        if p.alone and any(x.kind == p.kind for x in found[: k - 1]):
            raise ProblemError(f"potential {k}: a second {p.kind}; there may be one")
    if sum(isinstance(i, CovectorInput) for i in given) > 1:
        raise ProblemError("key 'input': one covector holds every component; give one such table")
    reader.distinct(given, reader.parameters)
    damped: tuple[AnyDamping, ...] = tuple(
        reader.one_of(DAMPING, x, w) if "kind" in x else reader.typed(Damping, x, w)
        for w, x in damping.items()
    )
    of_state: tuple[Acting, ...] = tuple(
        reader.typed(acting_kind(x), x, w) for w, x in stated.items()
    )
    return found, given, damped, of_state


def require_known(inputs: Sequence[Input], acting: Sequence[Table]) -> None:
    """``ProblemError`` for a scalar that nothing has which acts by expressions."""
    known = {name for x in acting for t in x.trees() for name in names(t)}
    for k, x in enumerate(inputs, 1):
        if isinstance(x, ScalarInput) and x.name not in known:
            raise ProblemError(
                f"input {k}: no [[force]] and no [[flow]] has {x.name!r} in its expressions, by "
                "which alone a scalar acts"
            )


def outputs(
    data: Mapping[str, object],
    reader: FileReader,
    inputs: Sequence[Input],
    acting: Sequence[Acting],
    potentials: tuple[Potential, ...] = (),
) -> tuple[Output, ...]:
    """What is read off a motion; a table of expressions has no kind."""
    reader.potentials = potentials
    tabled = named_tables(data, "output")
    for where in tabled if reader.group is None else ():
        raise ProblemError(f"{where}: a text about any group has no motion to read this off")
    kind, reader.observing = ExpressionOutput.kind, True
    for where, x in tabled.items():
        if ("y" in x) == (x.get("kind", kind) != kind) or ("kind" not in x and "y" not in x):
            raise ProblemError(f"{where}: give either a 'kind', or expressions 'y'")
        if not reader.pointless and (wrong := fault_of_gravity(x, pointless=False)):
            raise ProblemError(f"{where}, {wrong}")
    found = tuple(
        reader.one_of(OUTPUTS, {"kind": kind, **x} if "y" in x else x, where)
        for where, x in tabled.items()
    )
    for where, output in zip(tabled, found, strict=True):
        if isinstance(output, PowerOutput) and not reader.acts:
            raise ProblemError(f"{where}: there is no power to be read off where nothing acts")
    reader.distinct_outputs(found, inputs, reader.parameters, acting)
    return found


def as_forces(
    damping: Sequence[AnyDamping], reader: FileReader
) -> tuple[tuple[Damping, ...], tuple[StatedForce, ...]]:
    """The damping that is linear, and the other, what has a name, and beside a Lagrangian all, as
    forces of the state, in the frame of ζ; a moment is at a place of its own, the origin of the
    body."""
    on_the_left = reader.pointless and not reader.on_the_right
    found, kept = list[StatedForce](), list[Damping]()
    for k, d in enumerate(damping, 1):
        own: dict[str, Any] = {"name": d.name, "table": f"damping {k}"}
        kind = next((x for x, y in DAMPING.items() if isinstance(d, y)), "linear")
        reader.require_unit(d.coefficient, f"a {kind} damping", f"damping {k}, coefficient")
        if isinstance(d, Damping) and not (d.name or reader.pointless):
            kept.append(d)
        elif isinstance(d, QuadraticDamping | Damping):
            if d.name and len(d.on) > 1:
                raise ProblemError(
                    f"damping {k}, name: it acts on {len(d.on)} points; give each a table"
                )
            for i in d.on:
                first, factor = reader.factor_of(i)
                turned = on_the_left and "orthogonal" in factor.relations
                still = (0,) * factor.n
                v = velocity_at_place(factor.n, first, i, still, turned=turned).values()
                size = (hypot(*v),) if isinstance(d, QuadraticDamping) else ()
                force = tuple(neg(mul(d.coefficient, *size, x)) for x in v)
                frame = "body" if turned else "space"
                found.append(StatedForce(**own, on=i, frame=frame, force=force))
        elif isinstance(d, RotationalDamping):
            _, factor = reader.moving().places[d.block - 1]
            reader.places.append(Place(at=(0,) * factor.n, block=d.block))
            frame = "space" if reader.on_the_right else "body"
            turning = angular_velocity(reader.moving(), d.block, reader.pointless)
            moment = tuple(neg(mul(d.coefficient, x)) for x in turning)
            on = len(reader.listed_places)
            found.append(StatedForce(**own, on=on, frame=frame, moment=moment))
    return tuple(kept), tuple(found)


def negative_stiffness_of(
    potentials: Sequence[Potential],
    damping: Sequence[AnyDamping | LaplacianDamping],
    parameters: Mapping[str, Parameter],
) -> str | None:
    """Where a stiffness, a damping or a constant of gravitation is negative, for the defaults of
    the parameters."""
    listed = [
        (f"{told} {k}: key {key!r}", value)
        for told, tables in (("potential", potentials), ("damping", damping))
        for k, p in enumerate(tables, 1)
        for key, about, value in p.values()
        if about.positive
    ]
    return next((where for where, t in listed if is_negative(t, parameters)), None)
