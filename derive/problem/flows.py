"""Mass that leaves a body, or comes to it: what it pushes with, as forces of the state.

The body of the instant t has the moments m, c and J, functions of t. Of each particle of it the
mass is held (m a = F, Meshchersky), and what moves relative to the body acts on it: a flow with the
rate ṁ (dm/dt, < 0 leaves) at the place r, with the velocity u there, by the thrust ṁ u; what flows
to there through the body, of the moments p = Σ ρ v = ċ − Σ ṁ r and Q = Σ ρ (v r̄ + r v̄) =
J̇ − Σ ṁ r r̄ by continuity, by Coriolis' forces −2ζ ∧ v and by −dv/dt: together the force
−2ζ ∧ p − ṗ at the body's origin, and the moment −((Tr Q) 1 − Q) ζ, the jet damping; this where what
flows has no angular momentum of its own about the origin (no swirl). In a product this is said of
the body of each block. A rate that inputs say has
no rate of its own: the mass is a number of the state then, and ṗ may not depend on such a rate, as
where mass leaves from where it is, or ṗ is neglected, as textbooks do: of a steady flow inside the
force of unsteadiness is 0 (Meirovitch). It is the balance of momentum
of a control volume (W. T. Thomson, Equations of motion for the variable mass system, AIAA J. 4
(1966); L. Meirovitch, General motion of a variable-mass flexible rocket with internal flow, J.
Spacecraft 7 (1970)).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from itertools import product as pairs
from typing import Any

from ..language.derivatives import product, rate
from ..language.expression import names
from ..language.laurent import shortened
from ..language.reserved import rate_of_mass
from ..language.tree import Tree, add, mul, neg, nodes
from ..schema.body_kinds import Body, GivenBody, MomentBody, Moments, Place, PointBody, by_block
from ..schema.force_kinds import Flow, Input, StatedForce
from .entries_on_orbit import vanishes, wedge
from .fields import angular_velocity, named_tables, names_in_forces
from .file_reader import FileReader
from .problem import Problem, ProblemError, masses_of_state, points_of

Row = tuple[Tree, ...]


def flows_of(
    data: Mapping[str, Any], body: Body | None, reader: FileReader, inputs: Sequence[Input]
) -> tuple[tuple[Flow, ...], tuple[StatedForce, ...]]:
    """The flows of a file, and how they push."""
    flows = tuple(reader.typed(Flow, x, w) for w, x in named_tables(data, "flow").items())
    stored = masses_of_state(flows)
    for k, x in enumerate(flows, 1):
        if x.mass and x.mass not in reader.parameters:
            raise ProblemError(
                f"flow {k}, mass: {x.mass!r} is not declared; add it to [parameters], where its "
                "default is what there is at the start"
            )
        if taken := next((y for y in map(rate_of_mass, stored) if y in reader.parameters), ""):
            raise ProblemError(f"parameter {taken!r}: the rate of a mass; choose another name")
    return flows, flow_forces(flows, body, reader, inputs)


def require_bodies_own(problem: Problem) -> None:
    """``ProblemError`` where a potential, or a place, depends on a mass that is of the state."""
    listed = [(f"potential {k}", x) for k, x in enumerate(problem.potentials, 1)]
    for where, x in (*listed, *(("at", x) for x in problem.places)):
        for name in (y for t in x.trees() for y in names(t) if y in problem.stored):
            what = (
                "a place of the body that depends on it would move"
                if where == "at"
                else ("potentials do not know it: the weight of the body does by its masses")
            )
            raise ProblemError(f"{where}: {name!r} is a mass, a number of the state; {what}")


def flow_forces(
    flows: Sequence[Flow], body: Body | None, reader: FileReader, inputs: Sequence[Input] = ()
) -> tuple[StatedForce, ...]:
    """The forces of flows; what flows inside acts at a place of its own, the origin of the body.

    ``ProblemError`` where masses depend on the time and nothing flows, or the rates are others.
    """
    stored = masses_of_state(flows)
    rates: dict[Tree, Tree] = {"t": 1, **{("par", x): t for x, t in stored.items()}}
    changing = body is not None and _depends_on_time(body, rates)
    if not flows:
        if changing:
            raise ProblemError(
                "body: its masses depend on t, and no [[flow]] says where the mass leaves, and how "
                "fast; of mass left at rest in space, d(mv)/dt = F, give a [lagrangian]"
            )
        return ()
    group = reader.moving()
    if not isinstance(body, PointBody | GivenBody):
        raise ProblemError(
            'flow 1: moments = "symbolic" do not say how they change; give them, of t, in [body] '
            "given = { m, c, J }, or masses of [[point]] tables"
        )
    for k, x in enumerate(flows, 1):
        given = [y for y in names(x.rate) if y not in reader.parameters and _of_inputs(y, inputs)]
        if given and not x.mass:
            raise ProblemError(
                f"flow {k}, rate: {given[0]!r} is an input, so that the mass that is left is a "
                'number of the state: name it, as mass = "fuel", with fuel among [parameters] '
                "and in the masses of the body"
            )
        if of_state := [y for y in names(x.rate) if y in names_in_forces(group)]:
            raise ProblemError(
                f"flow {k}, key 'rate': {of_state[0]!r} is of the state, and a rate knows t alone, "
                "inputs and masses"
            )
    found = [
        StatedForce(
            table=f"flow {k}",
            name=x.name,
            on=x.on,
            frame="body",
            force=tuple(product(x.rate, u) for u in x.velocity),
        )
        for k, x in enumerate(flows, 1)
        if x.mass or any(x.velocity)  # a mass of the state has its rate beside what acts
    ]
    for b, _ in enumerate(group.places, 1):
        found += _of_block(b, flows, by_block(body).get(b), reader, rates, inputs)
    return tuple(found)


def _of_block(
    b: int,
    flows: Sequence[Flow],
    own: Body | None,
    reader: FileReader,
    rates: Mapping[Tree, Tree],
    inputs: Sequence[Input],
) -> tuple[StatedForce, ...]:
    """What flows inside the body, if any, that a block (from 1) moves."""
    listed = {k: x for k, x in enumerate(flows, 1) if reader.listed_places[x.on - 1].block == b}
    if listed and own is None:
        raise ProblemError(f"flow {min(listed)}: in block {b} no [[point]] has a mass")
    if own is None:
        return ()
    factor, moments = reader.moving().places[b - 1][1], own.moments()
    if not listed and not any(rate(x, rates) for x in moments.trees()):
        return ()
    first = min(listed, default=1)
    if factor.linear_basis and not ("orthogonal" in factor.relations and factor.n in (2, 3)):
        raise ProblemError(
            f"flow {first}: mass flows in a body that turns in the plane or in R^3, as in SO(3) or "
            f"SE(3), or shifts, as in R(3), and not in {factor.name}; give a [lagrangian] of t, "
            "and a [[force]]"
        )
    whole = add(*(x.rate for x in listed.values()))
    if not vanishes(add(rate(moments.m, rates), neg(whole))):
        stored = [x.mass for x in listed.values() if x.mass]
        where = f", of block {b}" if len(reader.moving().places) > 1 else ""
        raise ProblemError(
            f"flow {first}, rate: the rates of all [[flow]] tables must add up to dm/dt of the "
            f"body{where}; give its mass as that expression of t, as m0 - b*t for the rate -b"
            + (f", or as what has {stored[0]} in it" if stored else "")
        )
    steady = {bool(x.steady) for x in listed.values()}
    if len(steady) > 1:
        raise ProblemError(
            f"flow {first}, steady: what flows inside a body has one momentum, and all [[flow]] "
            "tables of this body say alike if it is steady"
        )
    return _within(b, [*listed.values()], moments, reader, rates, inputs)


def _of_inputs(name: str, inputs: Sequence[Input]) -> bool:
    """Is it a number of an input?"""
    return any(name == x.name or name.startswith(f"{x.name}_") for x in inputs)


def _depends_on_time(body: Body, rates: Collection[Tree]) -> bool:
    """Do the masses of a body, or on what has a rate? ``ProblemError`` where a place does."""

    def varies(t: Tree) -> bool:
        return any(x in nodes(t) for x in rates)

    for i, x in enumerate(points_of(body), 1):
        if found := [y for y in x.at if varies(y)]:
            told = "t" if "t" in nodes(found[0]) else ", ".join(names(found[0]))
            raise ProblemError(
                f"point {i}, at: {told}: a place of the body does not move in it; mass that moves "
                "there is one point that loses what another gains"
            )
    return not isinstance(body, MomentBody) and any(map(varies, body.trees()))


def _within(
    b: int,
    flows: Sequence[Flow],
    moments: Moments,
    reader: FileReader,
    rates: Mapping[Tree, Tree],
    inputs: Sequence[Input],
) -> tuple[StatedForce, ...]:
    """What flows inside the body of a block, as a force at its origin and a moment; none where
    nothing does. ``rates``: of what the moments depend on."""
    factor, span = reader.moving().places[b - 1][1], range(len(moments.c))
    places = [reader.listed_places[x.on - 1].at for x in flows]
    leaving = [(x.rate, at) for x, at in zip(flows, places, strict=True)]

    def left(moment: Tree, k: int, j: int | None = None) -> Tree:
        """The rate of a moment, less what leaves at the places."""
        gone = (product(-1, x, r[k], 1 if j is None else r[j]) for x, r in leaving)
        return _collected(add(rate(moment, rates), *gone))

    shifts = not factor.linear_basis
    p = [left(moments.c[k], k) if factor.affine else 0 for k in span]
    Q = {(i, j): left(moments.J[i][j], i, j) for i, j in pairs(span, span) if not shifts}
    if not any(p) and not any(Q.values()):
        return ()
    steady = any(x.steady for x in flows)
    for name in (z for y in p for z in names(y) if not steady):
        if name not in reader.parameters and _of_inputs(name, inputs):
            raise ProblemError(
                f"flow 1, at: what flows there from where the mass is has a momentum with {name!r} "
                "in it, an input, whose rate would push; neglect that of a flow which is steady "
                "inside, as textbooks do, by steady = true in its [[flow]]; or let the mass leave "
                "from where it is, 'on' its point, or give rates as expressions of t"
            )
    unsteady = [0 if steady else neg(_collected(rate(y, rates))) for y in p]
    if shifts:
        return () if steady else (_at_origin(reader, b, tuple(unsteady)),)
    turning = angular_velocity(reader.moving(), b)
    trace = _collected(add(*(Q[i, i] for i in span)))
    if len(span) == 2:
        (w,) = turning
        across = [neg(mul(w, p[1])), mul(w, p[0])]
        moment: Row = (neg(mul(trace, w)),)
    else:
        across = [*wedge(turning, p)]
        moment = tuple(
            add(neg(mul(trace, turning[i])), *(mul(Q[i, j], turning[j]) for j in span))
            for i in span
        )
    force = tuple(add(mul(-2, x), y) for x, y in zip(across, unsteady, strict=True))
    return (_at_origin(reader, b, force if any(p) else (), moment if any(Q.values()) else ()),)


def _at_origin(reader: FileReader, b: int, force: Row, moment: Row = ()) -> StatedForce:
    """A force and a moment at the origin of the body of a block, a place of its own."""
    reader.places.append(Place(at=(0,) * reader.moving().places[b - 1][1].n, block=b))
    on = len(reader.listed_places)
    return StatedForce(table="flow", on=on, frame="body", force=force, moment=moment)


def _collected(t: Tree) -> Tree:
    """The same with like terms added, 0 where it is."""
    return 0 if vanishes(t) else shortened(t)
