"""The claims about equilibria under inputs, by the load M ζ̇ of a model at the very point.

Derivatives are exact modulo a random prime p: with g(1 + pX) for g a rational function F becomes
F + pF′ modulo p².  Of a root s = √q, with q = s² + pq′, it is s + pq′/2s; a root that is 0 becomes
py, y random: F has a derivative where F(x, py) − F(x, 0) is 0 modulo p².  Irrational numbers of the
state are taken modulo p², by √d there.  At an element that is not that of the state a root is one
modulo p², of either sign, as the conjugates of an algebraic function vanish together.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ...language.univariate import Number, Quadratic, coefficients_of, root, value_of
from ...record.record import RecordError, Step
from ...record.sentence import Claim
from ..trials.trial_points import AnyModel, model_at
from ..values.draws import Locus
from ..values.residue import Residue, random_prime
from .entries_checked import decided
from .equilibrium_claims import Coordinates, coordinates, silent
from .reduced_system import ClaimedRecord, Judge
from .spectra_and_residues import all_negative, characteristic, grows

SIZE, BITS = 2**64, 128
ELEMENTS, TRIES = 6, 400
"""At so many elements it is asked whether a motion is steady; so many are drawn for these."""
POINTS = ("trim.rest", "trim.steady")
ISOLATED = ("trim.isolated", "trim.isolated_with_turns", "trim.isolated_along")
VERDICTS = ("trim.stable", "trim.unstable", "trim.open")


class NoRootError(Exception):
    """A number is no square modulo p."""


class TrueRoots:
    """√x at the point, exact, which are remembered by x; and near it, modulo p²."""

    def __init__(self, random: Any):
        self.random, self.known = random, dict[Any, Number]()
        self.prime, self.field, self.image = random_prime(random), 0, 0
        self.bend = 0
        self.chosen = dict[int, int]()
        self.take(1)

    def take(self, d: int) -> None:
        """Let irrational numbers be those of √d: p ≡ 3 modulo 4 of which d is a square."""
        while self.prime % 4 < 3 or pow(d, (self.prime - 1) // 2, self.prime) != 1:
            self.prime = random_prime(self.random)
        self.field, self.image = d, self._lifted(d, pow(d, (self.prime + 1) // 4, self.prime))

    def _lifted(self, x: int, first: int) -> int:
        """The root of x modulo p² that is ``first`` modulo p."""
        p = self.prime
        return (first - (first * first - x) * pow(2 * first, -1, p)) % (p * p)

    def elsewhere(self, x: Any) -> Any:
        """A root modulo p² of a number modulo p²: of two that are near, near ones; of either sign
        by chance.  ``NoRootError`` where there is none."""
        p = self.prime
        square = x.numerator * pow(x.denominator, -1, p * p)
        if (at := square % p) not in self.chosen:
            sign = self.random.choice((1, -1))
            self.chosen[at] = sign * pow(at, (p + 1) // 4, p) % p
        first = self.chosen[at]
        if not first or (first * first - at) % p:
            raise NoRootError
        return Fraction(self._lifted(square, first))

    def rational(self, x: Any) -> Any:
        """A number modulo p², as a fraction."""
        if not isinstance(x, Quadratic):
            return x
        if x.d != self.field:
            raise RecordError("numbers of different square roots")
        return x.a + x.b * self.image

    def exact(self, x: Any) -> Number:
        """√x at the point."""
        self.known[x] = root(x)
        return self.known[x]

    def near(self, x: Any) -> Any:
        """√x of a number that is, modulo p, one at the point."""
        for square, s in self.known.items():
            left = x - self.rational(square)
            if left.numerator % self.prime == 0:
                y = self.rational(s)
                return y + left / (2 * y) if y else Fraction(self.prime * self.bend)
        raise RecordError("a root is met that is none in the state")


def placed(
    group: Group, point: Iterable[tuple[Tree, Any]]
) -> tuple[dict[str, Any], Matrix, list[Any], list[Any]]:
    """What a point tells: inputs by name, g, and the coordinates of ζ and of ξ in the problem's
    basis; the others are those of g = 1, and 0."""
    basis = group.in_user_basis
    held: dict[str, Any] = {}
    g: list[list[Any]] = [[*row] for row in q.identity(group.size)]
    zeta, xi = ([Fraction(0)] * basis.dimension for _ in range(2))
    for x, value in point:
        assert isinstance(x, tuple)
        if x[0] == "par":
            held[x[1]] = value
        elif x[1] in ("A", "T"):
            g[x[2] - 1][x[3] - 1 if x[1] == "A" else group.n] = value
        else:
            after = basis.dimension - basis.n if x[1] == "w" else 0
            (xi if x[1] == "ξ" else zeta)[after + x[2] - 1] = value
    return held, q.matrix(g), zeta, xi


def defaults(c: ClaimedRecord) -> dict[str, Fraction]:
    """The numbers of the parameters of a record."""
    given = c.record.problem.get("parameters", {})
    return {name: Fraction(str(data["default"])) for name, data in given.items()}


def standing(model: AnyModel, g: Matrix, Z: Matrix, t: Any, held: Mapping[str, Any]) -> AnyModel:
    """A model in a state, at a time, with these inputs."""
    found = copy(model)
    found.parameters = {**model.parameters}
    vars(found).pop("expressions", None)  # that of the other parameters
    found.g, found.Z, found.t = g, Z, t
    found.hold(held)
    return found


def velocity_of(group: Group, told: Coordinates) -> list[Any]:
    """The coordinates of a velocity that is told; ``RecordError`` for any other number."""
    if not all(isinstance(x, tuple) and x[0] == "entry" and x[1] in "ζw" for x, _ in told):
        raise RecordError("velocities alone are told along a motion")
    return placed(group, told)[2]


def seen_from(g: Matrix, group: Group, told: Coordinates, side: str) -> Matrix:
    """Y that is told, as a part of the velocity: g⁻¹Yg, on the right gYg⁻¹."""
    Y = group.in_user_basis.hat(velocity_of(group, told))
    first, last = (q.inverted(g), g) if side == "left" else (g, q.inverted(g))
    return q.times(q.times(first, Y), last)


def carried_along(model: AnyModel, rate: Any, other: Matrix) -> Matrix:
    """Another element a little later on the motion of a model: gZg⁻¹ moves it, which may be any, as
    it moves g."""
    g, left = model.g, model.side == "left"
    first, last = (g, q.inverted(g)) if left else (q.inverted(g), g)
    Y = q.times(q.times(first, model.Z), last)
    step = q.plus(q.identity(len(g)), q.scaled(rate, Y))
    return q.times(step, other) if left else q.times(other, step)


def linearised(model: AnyModel, rates: Matrix) -> Matrix:
    """The equations linearised in (η, δζ), for δg = gη or ηg: η̇ = δζ ∓ [Z, η], and δζ̇."""
    group, sign = model.group, -1 if model.side == "left" else 1
    turns = [group.nearest(q.scaled(sign, q.bracket(model.Z, e))) for e in group.basis]
    pairs = zip(q.transposed(turns), q.identity(group.dimension), strict=True)
    return (*((*turn, *one) for turn, one in pairs), *rates)


def the_one(step: Step, kinds: Sequence[str]) -> Claim:
    """The claim of a step that tells a point; ``RecordError`` where it has none, or several."""
    found = [x for x in step.claims if x.kind in kinds]
    if len(found) != 1:
        raise RecordError("no one point is told")
    return found[0]


class ClaimedTrim:
    """A state with its inputs, by the numbers that a step tells; the others are those of g = 1,
    and 0.  ``here``: the model there, exactly; others are modulo p²."""

    def __init__(self, c: ClaimedRecord, point: Coordinates):
        self.group, self.random = c.group, c.random
        self.roots = TrueRoots(c.random)
        numbers, problem, at = defaults(c), c.record.problem, Locus(driven=True)
        self.model: AnyModel = model_at(problem, c.group, c.random, SIZE, at, given=numbers)
        held, g, zeta, xi = placed(self.group, point)
        if any(xi):
            raise RecordError("a displacement of g is told, and no bounds of it")
        self.exact = g
        elementary, Z = self.model.elementary, self.group.in_user_basis.hat(zeta)
        elementary.true_root = self.roots.exact
        self.here = self.at(self.exact, Z, held)
        self.load, self.moving = [*self.here.load], any(map(any, Z))
        for x in (*zeta, *held.values(), *q.flatten(self.exact), *self.roots.known.values()):
            if isinstance(x, Quadratic) and self.roots.field == 1:
                self.roots.take(x.d)
        self.prime, of = self.roots.prime, self.roots.rational
        self.held = {x: of(y) for x, y in held.items()}
        self.g, self.Z = (tuple(tuple(map(of, row)) for row in x) for x in (self.exact, Z))
        elementary.true_root = self.roots.near
        self.here = self.at(self.g, self.Z)

    def at(self, g: Matrix, Z: Matrix, inputs: Mapping[str, Any] | None = None) -> AnyModel:
        """The model in a state, at any time."""
        held = self.held if inputs is None else inputs
        return standing(self.model, g, Z, self.model.draw(), held)

    @property
    def on_the_group(self) -> bool:
        """Is it proved that g is an element?"""
        span = range(self.group.size)
        at = {(i, j): self.exact[i][j] for i in span for j in span}
        return decided(self.group, at) == "yes"

    @cached_property
    def has_derivative(self) -> bool:
        """Have the rates one although a root may be 0?  Else that is a random number times p."""
        self.roots.bend = self.random.getrandbits(BITS)
        bent = self.at(self.g, self.Z)
        bent.t = self.here.t
        bent_load = [*bent.load]
        self.roots.bend = 0
        return not any(
            (y - x).numerator % self.prime**2
            for x, y in zip(self.here.load, bent_load, strict=True)
        )

    def change(self, model: AnyModel, moved: AnyModel) -> list[Residue]:
        """The derivative of the load, of which ``moved`` is p times a displacement away."""
        pairs = zip(model.load, moved.load, strict=True)
        return [Residue(0, self.prime) + (y - x) / self.prime for x, y in pairs]

    @property
    def goes_on(self) -> bool:
        """Is the load the same at all elements, random ones, along the motion that begins there?"""
        found = []
        self.model.elementary.true_root = self.roots.elsewhere
        for _ in range(TRIES):
            with suppress(NoRootError, ZeroDivisionError):
                found.append(self.stays_from(self.group.sample(self.random, SIZE)))
            if len(found) == ELEMENTS or not all(found):
                break
        self.model.elementary.true_root = self.roots.near
        return len(found) == ELEMENTS and all(found)

    def stays_from(self, other: Matrix) -> bool:
        """Is the derivative of the load 0 at another element, along the motion?"""
        moved = carried_along(self.here, self.prime, other)
        here, there = self.at(other, self.Z), self.at(moved, self.Z)
        there.t = here.t
        return not any(x.n for x in self.change(here, there))

    def shifted(self, by: Matrix, faster: Matrix) -> list[Residue]:
        """The derivative of the load by g, along an element of 𝔤, and by the velocity."""
        one, p = q.identity(self.group.size), self.prime
        there = self.at(
            self.model.ordered(self.g, q.plus(one, q.scaled(p, by))),
            q.plus(self.Z, q.scaled(p, faster)),
        )
        there.t = self.here.t
        return self.change(self.here, there)

    @cached_property
    def characteristic(self) -> list[Any]:
        """The characteristic polynomial, modulo p, of the linearised equations: M δζ̇ is what
        changes of the load."""
        zero, none = Residue(0, self.prime), q.scaled(Fraction(0), self.Z)
        changes = [self.shifted(e, none) for e in self.group.basis]
        changes += [self.shifted(none, e) for e in self.group.basis]
        M = tuple(tuple(zero + x for x in row) for row in self.here.metric)
        rates = q.solve(M, q.transposed(changes))
        assert rates
        return characteristic([[zero + x for x in row] for row in linearised(self.here, rates)])


@lru_cache(maxsize=8)
def _trim(c: ClaimedRecord, point: Coordinates) -> ClaimedTrim:
    """The trim of a record, computed once for all that is said of it."""
    return ClaimedTrim(c, point)


def _at(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """An element has the entries of g, the load vanishes, and goes on to; what follows of the
    stability is said."""
    here = _trim(c, coordinates(claim))
    if claim.kind == "trim.rest" and here.moving:
        return "the velocity is not 0"
    if not here.on_the_group:
        return "it is not proved that an element of the group has these entries"
    if any(here.load):
        return "a rate does not vanish there"
    if not here.has_derivative:
        return "a root is 0 there, and the rates have no derivative"
    if claim.kind == "trim.steady" and not here.goes_on:
        return "what acts may be other where the motion takes g"
    return silent(step, VERDICTS, "one of " + ", ".join(VERDICTS))


def _trim_of(c: ClaimedRecord, step: Step) -> ClaimedTrim:
    """The trim that a step tells; ``RecordError`` where it tells none, or several."""
    return _trim(c, coordinates(the_one(step, POINTS)))


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


def _isolated(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The derivatives of the load by these numbers are independent; by ξ, of δg = gξ or ξg, with
    what is seen of a Y that is told."""
    here, told = _trim_of(c, step), claim["numbers"]
    assert isinstance(told, tuple)
    basis, none, rows = c.group.in_user_basis, q.scaled(Fraction(0), here.Z), []
    side, of, Y = here.model.side, here.roots.rational, coordinates(claim, "along")
    if claim.kind == "trim.isolated_along" and not Y:
        return "no velocity is told along the motion"
    exact = seen_from(here.exact, c.group, Y, side)
    seen = tuple(tuple(map(of, row)) for row in exact)
    for x in told[1:]:
        assert isinstance(x, tuple)
        if x[0] == "par":
            more = here.held | {x[1]: here.held.get(x[1], Fraction(0)) + here.prime}
            rows.append(here.change(here.here, here.at(here.g, here.Z, more)))
        else:
            place = x[2] - 1 + (basis.dimension - basis.n if x[1] == "w" else 0)
            along = basis.basis[place]
            other = q.bracket(seen, along) if side == "left" else q.bracket(along, seen)
            turns = x[1] == "ξ"
            rows.append(here.shifted(along, other) if turns else here.shifted(none, along))
    return "" if q.rank(q.matrix(rows)) == len(rows) else "others may do so near there"


def _corner(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """A root is 0 there; that the rates have a derivative is asked of every trim."""
    del claim
    return "" if 0 in _trim_of(c, step).roots.known.values() else "no root is 0 there"


def _verdict(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The polynomial is that of the linearised equations, and it is what follows from it."""
    told = coefficients_of(claim["polynomial"], "λ")
    f = [Fraction(x) if isinstance(x, int) else x for x in map(value_of, told)]
    here = _trim_of(c, step)
    if [Residue(0, here.prime) + here.roots.rational(x) for x in f] != here.characteristic:
        return "the characteristic polynomial is another"
    found = "unstable" if grows(f) else "stable" if all_negative(f) else "open"
    return "" if claim.kind == f"trim.{found}" else f"what follows is: {found}"


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(POINTS, _at),
    "trim.unique": _unique,
    **dict.fromkeys(ISOLATED, _isolated),
    "trim.corner": _corner,
    **dict.fromkeys(VERDICTS, _verdict),
}
"""How claims about equilibria under inputs are judged."""
