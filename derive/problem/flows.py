"""Mass that leaves a body, or comes to it: what it pushes with, as forces of the state.

The body of the instant t has the moments m, c and J, functions of t. Of each particle of it the
mass is held (m a = F, Meshchersky), and what moves relative to the body acts on it: a flow with the
rate ṁ (dm/dt, < 0 leaves) at the place r, with the velocity u there, by the thrust ṁ u; what flows
to there through the body, of the moments p = Σ ρ v = ċ − Σ ṁ r and Q = Σ ρ (v r̄ + r v̄) =
J̇ − Σ ṁ r r̄ by continuity, by Coriolis' forces −2ζ ∧ v and by −dv/dt: together the force
−2ζ ∧ p − ṗ at the body's origin, and the moment −((Tr Q) 1 − Q) ζ, the jet damping; this where what
flows has no angular momentum of its own about the origin (no swirl). It is the balance of momentum
of a control volume (W. T. Thomson, Equations of motion for the variable mass system, AIAA J. 4
(1966); L. Meirovitch, General motion of a variable-mass flexible rocket with internal flow, J.
Spacecraft 7 (1970)).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product as pairs
from typing import Any

from ..algebra.groups import Group
from ..language.derivatives import derivative, product
from ..language.expression import names
from ..language.laurent import shortened
from ..language.tree import Tree, add, mul, neg, nodes
from ..schema.body_kinds import (
    Body,
    GivenBody,
    MomentBody,
    Moments,
    Place,
    PointBody,
)
from ..schema.kind import Flow, Input, StatedForce
from .entries_on_orbit import vanishes
from .fields import angular_velocity, names_in_forces, one_body, tables
from .file_reader import FileReader
from .problem import ProblemError, points_of

Row = tuple[Tree, ...]


def flows_of(
    data: Mapping[str, Any], body: Body | None, reader: FileReader, inputs: Sequence[Input]
) -> tuple[tuple[Flow, ...], tuple[StatedForce, ...]]:
    """The flows of a file, and how they push."""
    listed = enumerate(tables(data, "flow"), 1)
    flows = tuple(reader.typed(Flow, x, f"flow {k}") for k, x in listed)
    return flows, flow_forces(flows, body, reader, inputs)


def flow_forces(
    flows: Sequence[Flow], body: Body | None, reader: FileReader, inputs: Sequence[Input] = ()
) -> tuple[StatedForce, ...]:
    """The forces of flows; what flows inside acts at a place of its own, the origin of the body.

    ``ProblemError`` where masses depend on the time and nothing flows, or the rates are others.
    """
    changing = body is not None and _depends_on_time(body)
    if not flows:
        if changing:
            raise ProblemError(
                "body: its masses depend on t, and no [[flow]] says where the mass leaves, and how "
                "fast; of mass left at rest in space, d(mv)/dt = F, give a [lagrangian]"
            )
        return ()
    group = reader.moving()
    turns = "orthogonal" in group.relations and not group.factors and group.n in (2, 3)
    if not turns and not _translates(group):
        raise ProblemError(one_body(group))
    if not isinstance(body, PointBody | GivenBody):
        raise ProblemError(
            'flow 1: moments = "symbolic" do not say how they change; give them, of t, in [body] '
            "given = { m, c, J }, or masses of [[point]] tables"
        )
    for k, x in enumerate(flows, 1):
        given = [y.name for y in inputs if any(z.startswith(y.name) for z in names(x.rate))]
        if given:
            raise ProblemError(
                f"flow {k}, rate: {given[0]!r} is an input: the mass that is left would be a "
                "number of the state, dm/dt its rate, and a state has g and its velocity alone; "
                "give rates and masses as expressions of t, or let the input scale the thrust, a "
                "[[force]]"
            )
        if of_state := [y for y in names(x.rate) if y in names_in_forces(group)]:
            raise ProblemError(
                f"flow {k}, key 'rate': {of_state[0]!r} is of the state, and a rate knows t alone"
            )
    moments = body.moments()
    rates = add(*(x.rate for x in flows))
    if not vanishes(add(derivative(moments.m, "t"), neg(rates))):
        raise ProblemError(
            "flow 1, rate: the rates of all [[flow]] tables must add up to dm/dt of the body; give "
            "its mass as that expression of t, as m0 - b*t for the rate -b"
        )
    found = [
        StatedForce(
            name=x.name,
            on=x.on,
            frame="body",
            force=tuple(product(x.rate, u) for u in x.velocity),
        )
        for x in flows
    ]
    within = _within(flows, moments, reader)
    return (*(x for x in found if any(x.force)), *within)


def _translates(group: Group) -> bool:
    """Does a group shift one body, and turn nothing?"""
    return len(group.factors) == 1 and not group.factors[0].linear_basis


def _depends_on_time(body: Body) -> bool:
    """Do the masses of a body? ``ProblemError`` where a place does."""
    for i, x in enumerate(points_of(body), 1):
        if any("t" in nodes(y) for y in x.at):
            raise ProblemError(
                f"point {i}, at: t: a place of the body does not move in it; mass that moves there "
                "is one point that loses what another gains"
            )
    return not isinstance(body, MomentBody) and any("t" in nodes(t) for t in body.trees())


def _within(flows: Sequence[Flow], moments: Moments, reader: FileReader) -> tuple[StatedForce, ...]:
    """What flows inside the body, as a force at its origin and a moment; none where nothing
    does."""
    group, span = reader.moving(), range(len(moments.c))
    places = [reader.listed_places[x.on - 1].at for x in flows]
    rates = [(x.rate, at) for x, at in zip(flows, places, strict=True)]

    def left(moment: Tree, k: int, j: int | None = None) -> Tree:
        """The rate of a moment, less what leaves at the places."""
        gone = (product(-1, rate, r[k], 1 if j is None else r[j]) for rate, r in rates)
        return _collected(add(derivative(moment, "t"), *gone))

    shifts = _translates(group)
    p = [left(moments.c[k], k) if group.affine or shifts else 0 for k in span]
    Q = {(i, j): left(moments.J[i][j], i, j) for i, j in pairs(span, span) if not shifts}
    if not any(p) and not any(Q.values()):
        return ()
    if shifts:
        return (_at_origin(reader, tuple(neg(_collected(derivative(y, "t"))) for y in p)),)
    turning = angular_velocity(group, 1)
    trace = _collected(add(*(Q[i, i] for i in span)))
    if len(span) == 2:
        (w,) = turning
        across = [neg(mul(w, p[1])), mul(w, p[0])]
        moment: Row = (neg(mul(trace, w)),)
    else:
        across = [
            add(mul(turning[i], p[j]), neg(mul(turning[j], p[i])))
            for i, j in ((1, 2), (2, 0), (0, 1))
        ]
        moment = tuple(
            add(neg(mul(trace, turning[i])), *(mul(Q[i, j], turning[j]) for j in span))
            for i in span
        )
    force = tuple(
        add(mul(-2, x), neg(_collected(derivative(y, "t")))) for x, y in zip(across, p, strict=True)
    )
    return (_at_origin(reader, force if any(p) else (), moment if any(Q.values()) else ()),)


def _at_origin(reader: FileReader, force: Row, moment: Row = ()) -> StatedForce:
    """A force and a moment at the origin of the body, a place of its own."""
    reader.places.append(Place(at=(0,) * reader.moving().places[0][1].n))
    return StatedForce(on=len(reader.listed_places), frame="body", force=force, moment=moment)


def _collected(t: Tree) -> Tree:
    """The same with like terms added, 0 where it is."""
    return 0 if vanishes(t) else shortened(t)
