"""The claims about equilibria under inputs, by the load M ζ̇ of a model at the very point.

Derivatives are exact modulo a random prime p: with g(1 + pX) for g a rational function F becomes
F + pF′ modulo p².
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...record.record import RecordError, Step
from ...record.sentence import Claim
from ..trials.trial_points import AnyModel, model_at
from ..values.draws import Locus
from ..values.residue import Residue, random_prime
from .entries_checked import decided
from .equilibrium_claims import Coordinates, coordinates, silent
from .exact_spectra import all_negative, characteristic, grows
from .reduced_system import ClaimedRecord

SIZE = 2**64
POINTS = ("trim.rest", "trim.steady")
VERDICTS = ("trim.stable", "trim.unstable", "trim.open")


class ClaimedTrim:
    """A state with its inputs, by the numbers that a step tells; the others are those of g = 1,
    and 0."""

    def __init__(self, c: ClaimedRecord, point: Coordinates):
        self.group, self.random = c.group, c.random
        self.prime = random_prime(c.random)
        given = c.record.problem.get("parameters", {})
        numbers = {name: Fraction(str(data["default"])) for name, data in given.items()}
        problem, at = c.record.problem, Locus(driven=True)
        self.model: AnyModel = model_at(problem, c.group, c.random, SIZE, at, given=numbers)
        self.held: dict[str, Any] = {}
        g: list[list[Any]] = [[*row] for row in q.identity(self.group.size)]
        basis = self.group.in_user_basis
        zeta: list[Any] = [Fraction(0)] * basis.dimension
        for x, value in point:
            assert isinstance(x, tuple)
            if x[0] == "par":
                self.held[x[1]] = value
            elif x[1] in ("A", "T"):
                g[x[2] - 1][x[3] - 1 if x[1] == "A" else self.group.n] = value
            else:
                after = basis.dimension - basis.n if x[1] == "w" else 0
                zeta[after + x[2] - 1] = value
        self.g, self.Z = q.matrix(g), basis.hat(zeta)

    def at(self, g: Matrix, Z: Matrix, inputs: Mapping[str, Any] | None = None) -> AnyModel:
        """The model in a state, at any time."""
        found = copy(self.model)
        found.parameters = {**self.model.parameters}
        vars(found).pop("expressions", None)  # that of the other parameters
        found.g, found.Z, found.t = g, Z, found.draw()
        found.hold(self.held if inputs is None else inputs)
        return found

    @property
    def on_the_group(self) -> bool:
        """Is it proved that g is an element?"""
        span = range(self.group.size)
        return decided(self.group, {(i, j): self.g[i][j] for i in span for j in span}) == "yes"

    @cached_property
    def here(self) -> AnyModel:
        """The model in the state."""
        return self.at(self.g, self.Z)

    def _change(self, model: AnyModel, moved: AnyModel) -> list[Residue]:
        """The derivative of the load, of which ``moved`` is p times a displacement away."""
        pairs = zip(model.load, moved.load, strict=True)
        return [Residue(0, self.prime) + (y - x) / self.prime for x, y in pairs]

    @property
    def goes_on(self) -> bool:
        """Is the load the same at all elements, random ones, along the motion that begins there?"""
        model, other = self.model, self.group.sample(self.random)
        undone = q.inverted(self.g)
        first = (self.g, self.Z, undone) if model.side == "left" else (undone, self.Z, self.g)
        Y = q.times(q.times(*first[:2]), first[2])
        step = q.plus(q.identity(self.group.size), q.scaled(self.prime, Y))
        moved = q.times(step, other) if model.side == "left" else q.times(other, step)
        here, there = self.at(other, self.Z), self.at(moved, self.Z)
        there.t = here.t
        return not any(x.n for x in self._change(here, there))

    def shifted(self, by: Matrix, faster: Matrix) -> list[Residue]:
        """The derivative of the load by g, along an element of 𝔤, and by the velocity."""
        one, p = q.identity(self.group.size), self.prime
        there = self.at(
            self.model.ordered(self.g, q.plus(one, q.scaled(p, by))),
            q.plus(self.Z, q.scaled(p, faster)),
        )
        there.t = self.here.t
        return self._change(self.here, there)

    @cached_property
    def characteristic(self) -> list[Any]:
        """The characteristic polynomial, modulo p, of the equations linearised in (η, δζ), for
        δg = gη or ηg: η̇ = δζ ∓ [Z, η], and M δζ̇ is what changes of the load."""
        zero, d = Residue(0, self.prime), self.group.dimension
        none = q.scaled(Fraction(0), self.Z)
        sign = -1 if self.model.side == "left" else 1
        turns = [self.group.nearest(q.scaled(sign, q.bracket(self.Z, e))) for e in self.group.basis]
        changes = [self.shifted(e, none) for e in self.group.basis]
        changes += [self.shifted(none, e) for e in self.group.basis]
        M = tuple(tuple(zero + x for x in row) for row in self.here.metric)
        rates = q.solve(M, q.transposed(changes))
        assert rates
        pairs = zip(q.transposed(turns), q.identity(d), strict=True)
        rows = [[zero + x for x in (*turn, *one)] for turn, one in pairs]
        return characteristic([*rows, *map(list, rates)])


@lru_cache(maxsize=8)
def _trim(c: ClaimedRecord, point: Coordinates) -> ClaimedTrim:
    """The trim of a record, computed once for all that is said of it."""
    return ClaimedTrim(c, point)


def _at(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """An element has the entries of g, the load vanishes, and goes on to; what follows of the
    stability is said."""
    here = _trim(c, coordinates(claim))
    if claim.kind == "trim.rest" and any(map(any, here.Z)):
        return "the velocity is not 0"
    if not here.on_the_group:
        return "it is not proved that an element of the group has these entries"
    if any(here.here.load):
        return "a rate does not vanish there"
    if claim.kind == "trim.steady" and not here.goes_on:
        return "what acts may be other where the motion takes g"
    return silent(step, VERDICTS, "one of " + ", ".join(VERDICTS))


def _trim_of(c: ClaimedRecord, step: Step) -> ClaimedTrim:
    """The trim that a step tells; ``RecordError`` where it tells none, or several."""
    found = [x for x in step.claims if x.kind in POINTS]
    if len(found) != 1:
        raise RecordError("no one point is told")
    return _trim(c, coordinates(found[0]))


def _unique(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The load changes independently with these inputs, and linearly, at random values of all."""
    here, told = _trim_of(c, step), claim["inputs"]
    assert isinstance(told, tuple)
    names = [x[1] for x in told[1:] if isinstance(x, tuple)]

    def changed(by: Mapping[str, Any]) -> Matrix:
        """What the load is more with these inputs more, as a row."""
        more = here.held | {x: here.held.get(x, Fraction(0)) + y for x, y in by.items()}
        pairs = zip(here.here.load, here.at(here.g, here.Z, more).load, strict=True)
        return (tuple(y - x for x, y in pairs),)

    rows = tuple(row for name in names for row in changed({name: Fraction(1)}))
    by = [here.model.draw() for _ in names]
    if changed(dict(zip(names, by, strict=True))) != q.times((tuple(by),), rows):
        return "inputs do not act linearly"
    return "" if q.rank(rows) == len(names) else "others do so as well"


def _verdict(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The coefficients are those of the linearised equations, and it is what follows from them."""
    told = claim["coefficients"]
    assert isinstance(told, tuple)
    f = [Fraction(x) for x in told[1:]]
    here = _trim_of(c, step)
    if [Residue(0, here.prime) + x for x in f] != here.characteristic:
        return "the characteristic polynomial has other coefficients"
    found = "unstable" if grows(f) else "stable" if all_negative(f) else "open"
    return "" if claim.kind == f"trim.{found}" else f"what follows is: {found}"


JUDGES: dict[str, Callable[[ClaimedRecord, Step, Claim], str]] = {
    **dict.fromkeys(POINTS, _at),
    "trim.unique": _unique,
    **dict.fromkeys(VERDICTS, _verdict),
}
"""How claims about equilibria under inputs are judged."""
