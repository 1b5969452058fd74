"""The claims about enclosed trims, by the load M ζ̇ of a model with numbers known within bounds.

Krawczyk's operator leads from bounds to inside of them: then one solution is there, and no other.
As many loads are taken as numbers are told; at random exact values of these all loads together are
of no more dimensions, whatever the functions in them are, so that the others vanish with them.
That a motion goes on is asked at random values of these numbers, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from copy import copy
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

from ...language import rational as q
from ...language.intervals import (
    Interval,
    UnknownSignError,
    characteristic,
    krawczyk,
    root_near,
    signs_of_real_parts,
)
from ...language.rational import Matrix
from ...language.univariate import value_of
from ...record.record import RecordError, Step
from ...record.sentence import Claim
from ..trials.trial_points import AnyModel, model_at
from ..values.arithmetic import EvaluationError, Varying, slopes_of
from ..values.arithmetic import value_of as value
from ..values.draws import Locus
from . import trim_claims
from .entries_checked import decided
from .equilibrium_claims import Coordinates, coordinates, silent
from .reduced_system import ClaimedRecord, Judge

SIZE, BOUNDED_SIZE, TRIED, LARGEST = 2**16, 4, 3, 16
"""Numbers are drawn up to a size, smaller ones where their differences are within bounds; so many
elements are tried; so many numbers are told at most."""
DRAWN, REFINED = 20, 4
POINTS = ("trim.near_rest", "trim.near_steady", "trim.near_along")
VERDICTS = {
    "negative": "trim.near_stable",
    "positive": "trim.near_unstable",
    "unknown": "trim.near_open",
}
Numbers = Sequence[Any]


class EnclosedState:
    """A state with its inputs: some exact numbers, and ``names`` of others, which are within a
    ``radius`` of ``near``; ξ of Cayley's transform, which turns g from its exact entries; and what
    is seen ``along`` of a velocity in space."""

    def __init__(
        self,
        c: ClaimedRecord,
        exact: Coordinates,
        near: Coordinates,
        along: Coordinates,
        radius: Fraction,
    ):
        if not 0 < len(near) <= LARGEST:
            raise RecordError(f"between 1 and {LARGEST} numbers are told to be near")
        d = c.group.dimension
        known = {("entry", x, a) for x in "ξζw" for a in range(1, d + 1)}
        inputs = (x for x, _ in near if x not in known)
        if not all(isinstance(x, tuple) and x[0] == "par" for x in inputs):
            raise RecordError("velocities, displacements and inputs are told to be near")
        if any(trim_claims.placed(c.group, exact)[3]):
            raise RecordError("a displacement of g is told as an exact number")
        if not all(isinstance(y, Fraction) for _, y in near):
            raise RecordError("what is told to be near is a fraction")
        self.c, self.group, self.exact, self.along = c, c.group, exact, along
        self.names, self.radius = [x for x, _ in near], radius
        self.near = [y for _, y in near if isinstance(y, Fraction)]
        numbers = trim_claims.defaults(c)

        def model(size: int, *, bounded: bool) -> AnyModel:
            chosen = {"given": numbers, "bounded": bounded}
            at = Locus(driven=True)
            for _ in range(DRAWN):
                # points that are drawn may leave no mass for the others
                with suppress(ZeroDivisionError):
                    return model_at(c.record.problem, c.group, c.random, size, at, **chosen)
            raise RecordError("no points have these moments")

        self.bounded = model(BOUNDED_SIZE, bounded=True)
        self.free = model(SIZE, bounded=False)

    def at(self, model: AnyModel, y: Numbers, t: Any = None) -> AnyModel:
        """The model where the numbers that are near have these values."""
        basis = self.group.in_user_basis
        pairs = (*self.exact, *zip(self.names, y, strict=True))
        held, g, zeta, xi = trim_claims.placed(self.group, pairs)
        if any(x[1] == "ξ" for x in self.names if isinstance(x, tuple)):
            g = model.ordered(g, cayley(basis.hat(xi)))
        Z = basis.hat(zeta)
        if self.along:
            Z = q.plus(Z, trim_claims.seen_from(g, self.group, self.along, model.side))
        return trim_claims.standing(model, g, Z, model.t if t is None else t, held)

    # -- one solution is there ---------------------------------------------------------------------

    def any_numbers(self) -> list[Any]:
        """Random exact ones in the place of those that are near."""
        draw = self.c.random.randint
        return [x + Fraction(draw(-SIZE, SIZE), SIZE) for x in self.near]

    @cached_property
    def rows(self) -> list[int]:
        """The numbers of as many loads as there are names, with which all vanish;
        ``RecordError`` where these are more or less."""
        many = range(2 * self.group.dimension + 2)
        loads = [[*self.at(self.free, self.any_numbers()).load] for _ in many]
        _, rows = q.echelon(q.matrix(loads))
        if len(rows) != len(self.names):
            free = f"{len(self.names)} numbers are free"
            raise RecordError(f"{free} in loads of {len(rows)} dimensions")
        return [*rows]

    @cached_property
    def box(self) -> list[Interval] | None:
        """Bounds of the one solution; ``None`` where none is proved."""
        found = [Interval.about(x, self.radius) for x in self.near]
        for k in range(REFINED):
            smaller = self.newton_step(found)
            pairs = zip(smaller or (), found, strict=False)
            if smaller is None or (not k and not all(x.within(y) for x, y in pairs)):
                return None
            found = smaller
        return found

    def newton_step(self, box: Sequence[Interval]) -> list[Interval] | None:
        """Krawczyk's operator for the loads."""
        m = len(box)
        varied = [Varying(x, unit) for x, unit in zip(box, q.identity(m), strict=True)]
        loads = [*self.at(self.bounded, varied).load]
        there = [*self.at(self.bounded, [Interval.of(x.middle) for x in box]).load]
        slopes = [[*map(value, slopes_of(loads[i], m))] for i in self.rows]
        return krawczyk(box, [there[i] for i in self.rows], slopes)

    # -- it goes on, and what its neighbours do ----------------------------------------------------

    @property
    def moving(self) -> bool:
        """Is there a velocity?"""
        return any(map(any, self.at(self.free, self.any_numbers()).Z))

    @property
    def goes_on(self) -> bool:
        """Is the load the same at all times, and elements along the motion?"""
        return all(self._stays() for _ in range(TRIED))

    def _stays(self) -> bool:
        here = self.at(self.free, self.any_numbers())
        there, rate = copy(here), Varying(Fraction(0), [Fraction(1)])
        there.g = trim_claims.carried_along(here, rate, self.group.sample(self.c.random, SIZE))
        there.t = here.t + rate
        return not any(any(slopes_of(x, 1)) for x in there.load)

    @cached_property
    def polynomial(self) -> list[Interval]:
        """The characteristic polynomial of the equations linearised in (η, δζ), within bounds."""
        assert self.box is not None
        d, group = self.group.dimension, self.group
        here = self.at(self.bounded, self.box)
        small = [Varying(Interval.of(0), unit) for unit in q.identity(2 * d)]
        near = copy(here)
        vars(near).pop("expressions", None)
        displaced = q.plus(q.identity(group.size), group.hat(small[:d]))
        near.g, near.Z = here.ordered(here.g, displaced), q.plus(here.Z, group.hat(small[d:]))
        slopes = q.matrix([slopes_of(x, 2 * d) for x in near.load])
        # the load vanishes there: what changes of M adds nothing
        rates = q.solve(_all_bounded(here.metric), _all_bounded(slopes))
        if rates is None:
            raise RecordError("the mass matrix is singular")
        return characteristic(trim_claims.linearised(here, rates))

    # -- the element -------------------------------------------------------------------------------

    @property
    def on_the_group(self) -> bool:
        """Is it proved that g is an element, and that Cayley's transforms of any such ξ are?"""
        y = [Fraction(0) for _ in self.names]
        found = [self.at(self.free, y).g]
        turns = [isinstance(x, tuple) and x[1] == "ξ" for x in self.names]
        for _ in range(TRIED if any(turns) else 0):
            pairs = zip(self.any_numbers(), turns, strict=True)
            y = [x if turn else Fraction(0) for x, turn in pairs]
            found.append(q.times(q.inverted(found[0]), self.at(self.free, y).g))
        span = range(self.group.size)
        entries = ({(i, j): g[i][j] for i in span for j in span} for g in found)
        return all(decided(self.group, at) == "yes" for at in entries)


def cayley(x: Matrix) -> Matrix:
    """(1 − ½x)⁻¹(1 + ½x)."""
    one, half = q.identity(len(x)), q.scaled(Fraction(1, 2), x)
    return q.times(q.inverted(q.minus(one, half)), q.plus(one, half))


def _all_bounded(a: Matrix) -> Matrix:
    """A matrix of numbers within bounds, but for those that are 0."""
    return tuple(tuple(Interval.of(value(x)) if x else Fraction(0) for x in row) for row in a)


@lru_cache(maxsize=8)
def _enclosed(
    c: ClaimedRecord,
    exact: Coordinates,
    near: Coordinates,
    along: Coordinates,
    radius: Fraction,
) -> EnclosedState:
    """The state of a record, computed once for all that is said of it."""
    return EnclosedState(c, exact, near, along, radius)


def _radius(claim: Claim) -> Fraction:
    """That of a claim; ``RecordError`` where it is none."""
    radius = value_of(claim["radius"])
    if not isinstance(radius, Fraction) or not 0 < radius < 1:
        raise RecordError("the radius is no fraction between 0 and 1")
    return radius


def _of_claim(c: ClaimedRecord, claim: Claim) -> EnclosedState:
    exact, near = coordinates(claim), coordinates(claim, "near")
    if len({x for x, _ in (*exact, *near)}) < len(exact) + len(near):
        raise RecordError("a coordinate is told twice")
    return _enclosed(c, exact, near, coordinates(claim, "along"), _radius(claim))


def _of_step(c: ClaimedRecord, step: Step) -> EnclosedState:
    """The state that a step tells; ``RecordError`` where it tells none, or several."""
    return _of_claim(c, trim_claims.the_one(step, POINTS))


def _at(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """One state is within the bounds where the load vanishes, and goes on to; what follows of the
    stability is said."""
    here = _of_claim(c, claim)
    if claim.kind == "trim.near_rest" and here.moving:
        return "the velocity is not 0"
    if not here.on_the_group:
        return "it is not proved that an element of the group has these entries"
    with suppress(UnknownSignError, ZeroDivisionError, EvaluationError):
        if here.box is not None:
            if not here.goes_on:
                return "what acts may be other later, or where the motion takes g"
            told = [*VERDICTS.values()]
            return silent(step, told, "one of " + ", ".join(told)) or _silent_of_turns(here, step)
    return "that one solution is within the bounds is not proved"


def _silent_of_turns(here: EnclosedState, step: Step) -> str:
    """Why a step should tell the entries of g, where ξ turns it."""
    turns = any(isinstance(x, tuple) and x[1] == "ξ" for x in here.names)
    told = any(x.kind.startswith("trim.near_turned") for x in step.claims)
    return "the entries of g are not told" if turns and not told else ""


def _turned(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The entries of g are these, and no others differ from the exact ones; ξ stands on this side
    of g."""
    here, told = _of_step(c, step), dict(coordinates(claim, "entries"))
    side = "right" if claim.kind.endswith("_on_the_left") else "left"
    if here.free.side != side or here.box is None:
        return "Cayley’s transform stands on the other side of g"
    none = [Fraction(0)] * len(here.names)
    before, after = (here.at(here.bounded, y).g for y in (none, here.box))
    for i, row in enumerate(after):
        for j, x in enumerate(row):
            about = told.pop(("entry", "A", i + 1, j + 1), None)
            if about is None and j == here.group.n:
                about = told.pop(("entry", "T", i + 1), None)
            if about is None and x != before[i][j]:
                return f"the entry {i + 1}{j + 1} changes"
            if about is not None and (Interval.of(x) - about).size > _radius(claim):
                return f"the entry {i + 1}{j + 1} is another"
    return "one is no entry" if told else ""


def _velocity(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The velocity has these coordinates, and others are 0."""
    here, told = _of_step(c, step), trim_claims.velocity_of(c.group, coordinates(claim, "entries"))
    Z = here.at(here.bounded, here.box or here.near).Z
    pairs = zip(c.group.in_user_basis.nearest(Z), told, strict=True)
    same = all((Interval.of(x) - y).size <= _radius(claim) for x, y in pairs)
    return "" if same else "the velocity is another"


def _verdict(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """What follows from the characteristic polynomial is told."""
    found = VERDICTS[signs_of_real_parts(_of_step(c, step).polynomial)]
    return "" if claim.kind == found else f"what follows is: {found}"


def _eigenvalues(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """Within the radius of each number is a root of the characteristic polynomial, and of no two
    the same; so many others are there."""
    f, told, r = _of_step(c, step).polynomial, claim["eigenvalues"], _radius(claim)
    if not isinstance(told, tuple) or len(told) < 2:
        raise RecordError("no eigenvalues are told")
    numbers = [(value_of(re), value_of(im)) for _, re, im in told[1:]]
    for k, (re, im) in enumerate(numbers):
        if not isinstance(re, Fraction) or not isinstance(im, Fraction) or not (not im or im > r):
            raise RecordError("an eigenvalue is two fractions, the second not near 0, or 0")
        if any((a - re) ** 2 + (b - im) ** 2 <= 4 * r**2 for a, b in numbers[:k]):
            return "two are near one another"
        if (near := root_near(f, re, im)) is None or near > r**2:
            return "that one is within the radius is not proved"
    others = len(f) - 1 - sum(1 + bool(im) for _, im in numbers)
    return "" if claim["others"] == others else f"{others} others are there"


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(POINTS, _at),
    **dict.fromkeys(("trim.near_turned", "trim.near_turned_on_the_left"), _turned),
    "trim.near_velocity": _velocity,
    **dict.fromkeys(VERDICTS.values(), _verdict),
    "trim.near_eigenvalues": _eigenvalues,
}
"""How claims about enclosed trims are judged."""
