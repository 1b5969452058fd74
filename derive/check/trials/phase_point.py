"""A random exact point (t, g, Z) of R × G × 𝔤 with two variations, and the motion, of any ℓ.

No structure equation is used: dϖ comes from nilpotent numbers on a family in the group.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from operator import mul
from typing import Any, NamedTuple

from ...language import rational as q
from ...language.rational import Matrix
from ...record.as_json import decode
from ..values.arithmetic import (
    EPS,
    EPS_PRIME,
    ETA,
    derivative_in,
    derivative_of,
    nilpotent,
    part,
)
from ..values.draws import LINEAR, TIME, TRANSLATION, Draws, Locus
from ..values.evaluate import Environment, evaluate
from ..values.residue import with_slots

ENTRY = 2
"""The indices of an entry of a matrix; Ż, too, has them, which may be anything where any forces
act."""


@dataclass(frozen=True)
class TangentVector:
    """A tangent vector of the evolution space: δt, and the matrices ξ̂ = g⁻¹δg, δẐ in 𝔤; on the
    right ξ̂ = δg g⁻¹."""

    time: Any
    xi: Matrix
    velocity: Matrix


class Nearby(NamedTuple):
    """t, g, Z on a family through the point, and h, h⁻¹ for g = g₀h; on the right g = hg₀."""

    t: Any
    g: Matrix
    Z: Matrix
    h: Matrix
    back: Matrix


Form = Callable[[Any, Matrix], Any]
"""A one-form, of δt and ξ."""


class PhasePoint(Draws):
    """What a point is drawn with, whatever gives the Lagrangian.

    ``at``: the hypotheses that hold there. ``side``: of the trivialisation. X is the motion, or a
    random vector with δt = 1 that has what the locus tells of it.
    """

    side = "left"
    Z: Matrix
    vector: TangentVector | None

    def stand(self, at: Locus, *, inside: bool) -> None:
        """Draw t and g, which is ``inside`` the least algebraic group that has 𝔤 or in any."""
        self.at = at
        self.hypothesis_failures: dict[Any, str] = {}
        _ = self.t
        sample = self.group.sample_inside if inside else self.group.sample
        self.g = sample(self.random, self.size)

    def vary(self) -> None:
        """Draw two variations, as the locus has them."""
        at = self.at
        self.first, self.second, self.mixed = (
            TangentVector(self.draw(), self.algebra(), self.algebra()) for _ in range(3)
        )
        if at.still:
            self.first = replace(self.first, time=Fraction(0))
        if at.vanishing:
            time = Fraction(0) if TIME in at.vanishing else self.second.time
            xi = self._without_parts(at.vanishing, self.second.xi)
            self.second = replace(self.second, time=time, xi=xi)

    def aim(self, *, at_random: bool) -> None:
        """Draw X where it is not the motion, ``at_random``, and the covector of the inputs."""
        at, self.vector = self.at, None
        if at.along is not None and at_random:
            any_xi = self.first.xi if at.contracted else self.algebra()
            free = self._without_parts(at.along, any_xi)
            xi = q.plus(self.Z, free) if at.along else free
            self.vector = TangentVector(Fraction(1), xi, self.algebra())
        if at.contracted and self.vector is not None:
            self.first = self.vector
        pulled = at.driven and bool(self.inputs_of("covector"))
        self.covector = [self.draw() if pulled else Fraction(0) for _ in self.group.basis]
        self.parameters |= self.name_covector(self.covector)

    @cached_property
    def acting_covector(self) -> list[Any]:
        """The values on the basis of the covector of the inputs and of those of the state."""
        still = [Fraction(0) for _ in self.group.basis]
        return [*map(sum, zip(still, *(x for _, x in self.covectors()), strict=True))]

    def covectors(self) -> Iterator[tuple[str, list[Any]]]:
        """The covectors apart: the name, "" where it has none, and the values on the basis."""
        yield from ((x["name"], self.covector) for x in self.inputs_of("covector"))
        forces = self.problem.get("forces", ()) if self.at.driven and not self.generic else ()
        columns = [self.group.in_user_basis.nearest(e) for e in self.group.basis]
        for x in forces:
            if "covector" in x:
                own = [evaluate(decode(y, "covector"), self.of_state) for y in x["covector"]]
                yield x.get("name", ""), [sum(map(mul, c, own), Fraction(0)) for c in columns]

    def _without_parts(self, parts: Collection[str], xi: Matrix) -> Matrix:
        """A random element of 𝔤 without these parts; ``xi`` where the group has none of them."""
        rows = []
        for e in self.group.basis:
            linear = q.flatten(self.group.linear_part(e)) if LINEAR in parts else ()
            moved = self.group.affine and TRANSLATION in parts
            rows.append((*linear, *(row[-1] for row in e[:-1] if moved)))
        if not rows[0]:
            return xi
        total = q.scaled(Fraction(0), xi)
        for weights in q.nullspace(q.transposed(tuple(rows))):
            total = q.plus(total, q.scaled(self.draw(), self.group.hat(weights)))
        return total

    def direction(self, name: str) -> TangentVector:
        """What an argument of a form is: "X", "δy", "δ′x", …; x stands for what has δt = 0."""
        if name == "X":
            return self.motion
        full = self.second if "′" in name else self.first
        return replace(full, time=Fraction(0)) if "x" in name else full

    @property
    @abstractmethod
    def of_state(self) -> Environment:
        """The environment of expressions of the state."""

    # -- the Lagrangian ------------------------------------------------------------------------

    @abstractmethod
    def lagrangian(self, t: Any, g: Matrix, Z: Matrix) -> Any:
        """ℓ(t, g, Z)."""

    def momentum(self, t: Any, g: Matrix, Z: Matrix, xi: Matrix) -> Any:
        """The derivative of ℓ with respect to Z along ξ."""
        faster = q.plus(Z, q.scaled(nilpotent(ETA), xi))
        return derivative_in(self.lagrangian(t, g, faster), ETA)

    def momenta(self, t: Any, g: Matrix, Z: Matrix) -> list[Any]:
        """∂ℓ/∂Z along each element of the basis."""
        return [self.momentum(t, g, Z, e) for e in self.group.basis]

    def energy(self, t: Any, g: Matrix, Z: Matrix) -> Any:
        """⟨p, Z⟩ − ℓ."""
        return self.momentum(t, g, Z, Z) - self.lagrangian(t, g, Z)

    def as_letter(self, x: Matrix, slots: int = ENTRY) -> Matrix:
        """A matrix as one of indeterminates of so many indices, where ℓ is left open: what is found
        by solving is then as free as it is."""
        if not self.generic:
            return x
        return tuple(tuple(with_slots(y, slots) for y in row) for row in x)

    # -- families in the group -----------------------------------------------------------------

    def ordered(self, a: Matrix, b: Matrix) -> Matrix:
        """ab, on the right ba: the tangent vector gξ or ξg, the velocity h⁻¹ḣ or ḣh⁻¹."""
        return q.times(a, b) if self.side == "left" else q.times(b, a)

    @cached_property
    def nu(self) -> Matrix:
        """ν, the velocity of g."""
        return self.ordered(self.g, self.Z)

    def displaced(self, *moves: tuple[Any, Matrix]) -> tuple[Matrix, Matrix]:
        """(1 + ε₁x₁)(1 + ε₂x₂) …, in the other order on the right; and its inverse."""
        h = back = one = q.identity(self.group.size)
        for weight, x in moves:
            step, undo = (q.plus(one, q.scaled(s * weight, x)) for s in (1, -1))
            h, back = self.ordered(h, step), self.ordered(undo, back)
        return h, back

    def family(self, a: TangentVector, b: TangentVector) -> Nearby:
        """A two-parameter family with the derivatives a and b, to first order in each.

        The mixed part is arbitrary: dϖ does not depend on it, but δξ′ and δ′ξ do.
        """
        e, f = nilpotent(EPS), nilpotent(EPS_PRIME)
        moves = ((e, a), (f, b), (e * f, self.mixed))
        t, Z = self.t, self.Z
        for weight, x in moves:
            t, Z = t + weight * x.time, q.plus(Z, q.scaled(weight, x.velocity))
        h, back = self.displaced(*((weight, x.xi) for weight, x in moves))
        return Nearby(t, self.ordered(self.g, h), Z, h, back)

    @cached_property
    def varied(self) -> Nearby:
        """The family of δ and δ′."""
        return self.family(self.first, self.second)

    @cached_property
    def onward(self) -> Nearby:
        """The motion for a time ε."""
        e = nilpotent(EPS)
        h, back = self.displaced((e, self.Z))
        faster = q.plus(self.Z, q.scaled(e, self.acceleration))
        return Nearby(self.t + e, self.ordered(self.g, h), faster, h, back)

    def undone(self, family: Nearby) -> Matrix:
        """g⁻¹ on a family."""
        return self.ordered(family.back, q.inverted(self.g))

    def field(self, family: Nearby, mask: int) -> Matrix:
        """g⁻¹ ∂g, or ∂g g⁻¹, in a parameter of a family, a function of the other."""
        return self.ordered(family.back, derivative_of(family.h, mask))

    def field_varied(self, mask: int) -> Matrix:
        """δ of the field of δ′, or δ′ of that of δ, on the family of both."""
        other = EPS_PRIME if mask == EPS else EPS
        return part(self.field(self.varied, other), mask)  # type: ignore[no-any-return]

    # -- the forms -----------------------------------------------------------------------------

    def cartan(self, a: TangentVector) -> Any:
        """ϖ(δ) at the point."""
        pushed = self.momentum(self.t, self.g, self.Z, a.xi)
        return part(pushed - self.energy(self.t, self.g, self.Z) * a.time, 0)

    def cartan_on(self, family: Nearby) -> Form:
        """ϖ at the points of a family."""
        t, g, Z, *_ = family
        energy = self.energy(t, g, Z)
        return lambda time, xi: self.momentum(t, g, Z, xi) - energy * time

    def exterior(
        self, a: TangentVector, b: TangentVector, *, on: Callable[[Nearby], Form] | None = None
    ) -> Any:
        """dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)] on the family; or that of another form ``on`` it."""
        family = self.family(a, b)
        form = (on or self.cartan_on)(family)

        def along(mask: int) -> Any:
            """On the derivative of the family in one parameter, a function of the other."""
            return form(derivative_in(family.t, mask), self.field(family, mask))

        return part(along(EPS_PRIME), EPS) - part(along(EPS), EPS_PRIME)

    def brackets(self) -> Matrix:
        """The brackets of the momenta on the basis, by flows: that of Π_b moves g to gh, or hg,
        h = 1 + sE_b, and takes the covector along, so that ⟨p, gE_a⟩ becomes ⟨p, ghE_ah⁻¹⟩. No
        structure constant."""
        flows = [self.displaced((nilpotent(EPS), y)) for y in self.group.basis]

        def turned(x: Matrix, h: Matrix, back: Matrix) -> Any:
            rate = part(self.ordered(self.ordered(h, x), back), EPS)
            return part(self.momentum(self.t, self.g, self.Z, rate), 0)

        return tuple(tuple(turned(x, *flow) for flow in flows) for x in self.group.basis)

    # -- the motion ----------------------------------------------------------------------------

    @property
    @abstractmethod
    def metric(self) -> Matrix:
        """∂²ℓ/∂Z² on the basis, d × d."""

    @property
    @abstractmethod
    def load(self) -> list[Any]:
        """The right side of M ζ̇ = β, with inputs and damping."""

    def solved(self, metric: Matrix, covector: list[Any]) -> Matrix:
        """The element of 𝔤, as a matrix, that a metric sends to a covector, by its values on the
        basis; ``ZeroDivisionError`` where the metric is singular."""
        solution = q.solve(metric, q.column(covector))
        if solution is None:
            raise ZeroDivisionError("the kinetic metric is singular at this point")
        return self.group.hat([row[0] for row in solution])

    @cached_property
    def acceleration(self) -> Matrix:
        """Ż of the motion; of X where that is any."""
        if self.at.free_acceleration and self.vector is not None:
            return self.vector.velocity
        return self.as_letter(self.solved(self.metric, self.load))

    @property
    def motion(self) -> TangentVector:
        """X, with δt = 1: the direction of the motion, or the random vector that stands for it."""
        return self.vector or TangentVector(Fraction(1), self.Z, self.acceleration)
