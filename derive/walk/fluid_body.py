"""The motion of a body of fluid that linear maps move, and Euler's equation at its places."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..algebra.calculus import gradient, reduce, substitute, terms_with, without
from ..algebra.word_trees import WordNotation
from ..algebra.words import Expr, Factor, Letter, one, word
from ..language.tree import Tree
from ..problem.problem import Problem
from ..record.record import Equation
from ..schema.kinds.volume import Volume
from .chapter import Chapter, Draft
from .inverse import cancelling, inverse_letter
from .kinds.self_gravity_walked import GradientLetter
from .multipliers import MULTIPLIER
from .potential import Potentials
from .pullback import sum_over
from .solution import Solution
from .specialisation import Special


@dataclass
class FluidBody:
    """What is known of the motion of a body: Āα̇J = ĀN + θ 1, or without θ on GL(n)."""

    problem: Problem
    potentials: Potentials
    special: Special
    found: Solution
    c: Chapter

    def __post_init__(self) -> None:
        b = self.b = self.special.letters
        self.n = int(b.n)
        self.Q, self.p_0 = Letter("Q_r", b.n, b.n, 1), Letter("p_0")
        self.r, self.rho = Letter("r", b.n), Letter("ρ_r")
        self.force = self.special.forces[b.Z.xi_prime]
        residue = gradient(self.special.inertial, b.Z.xi_prime)
        back, A, Z = Letter("A⁻¹", b.n, b.n), word(b.A.position), word(b.Z.velocity)
        rate = word(back) * word(b.A.acceleration) - Z * Z
        moved = substitute(residue, {b.Z.acceleration: rate, b.C: A.bar * A})
        if reduce(moved, cancelling(b.A.position)) != A.bar * word(b.A.acceleration) * word(b.J):
            raise ValueError("the moments of the acceleration are not those of a linear map")
        pressed = self.force * 0 if self.gas else word(MULTIPLIER) * one(b.n)
        inverse = word(inverse_letter(b.J))
        self.acceleration = reduce((self.force + pressed) * inverse, cancelling(b.J))  # Āα̇

    @property
    def gas(self) -> bool:
        """Has it an energy of the volume, on GL(n)?"""
        return any(isinstance(p, Volume) for p in self.problem.potentials)

    @property
    def centred(self) -> bool:
        """Is the centre of mass the fixed point, c = 0?"""
        assert self.problem.body is not None
        return all(x == 0 for x in self.problem.body.moments().c)

    @property
    def gravity(self) -> list[GradientLetter]:
        """The energies by C whose force may be central in the body, as that of its own gravity."""
        return [x for x in self.potentials.own if isinstance(x, GradientLetter)]

    def draft(self, label: str, rule: str) -> Draft:
        """A step that rests on the motion, in the making."""
        draft = self.c.draft(label, rule)
        draft.depends_on(self.found.motion, self.found.steps[0])
        return draft

    def over_body(self, summand: Expr) -> Expr:
        """∫ of a function of r dm, in m and J."""
        b = self.b
        table = {(b.m_i,): word(b.m), (b.m_i, b.r_i, b.r_i): word(b.J)}
        inside = substitute(summand, {self.r: word(b.r_i)})
        return sum_over(word(b.m_i) * inside, {b.m_i, b.r_i}, table)

    def balance(
        self,
        draft: Draft,
        slope: Expr,
        inverse: Expr,
        notation: WordNotation,
        values: Mapping[Letter, Expr],
    ) -> Equation:
        """Euler's equation at r, for the ``slope`` ∂p/∂r, in letters of these ``values``, and J⁻¹
        as it is there."""
        b, r = self.b, word(self.r)
        pushed = word(self.rho) * substitute(
            terms_with(self.acceleration, MULTIPLIER), {inverse_letter(b.J): inverse}
        )
        if pushed * r + substitute(slope, values):
            raise ValueError("the pressure does not balance the acceleration")
        left = Letter("Ā⁻¹", b.n, b.n)

        def rule(x: Factor, y: Factor) -> Expr | None:
            return b.unit if (x, y) == ((left, False), (b.A.position, True)) else None

        A = word(b.A.position)
        applied = word(self.rho) * without(self.acceleration, MULTIPLIER)
        applied = substitute(applied, {b.C: A.bar * A})
        force = reduce(word(left) * (applied * r - slope), rule, cancelling(b.J))
        own: dict[Letter, Tree] = {left: ("inv", ("T", "A")), inverse_letter(b.J): ("inv", "J")}
        shown = WordNotation(display={**notation.display, **own})
        moved = word(self.rho) * (word(b.A.acceleration) * r)
        return Equation(draft.tree(moved, shown), draft.tree(force, shown))
