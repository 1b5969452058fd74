"""An ellipsoid of fluid in layers: its density ρ is a function of the level s = ⟨r, Q r⟩.

σ = ∫ρ ds from s to 1,   ∂σ/∂r = −2ρ Q r,   Q J = κ 1,   2κ = ∫ σ dx,   p = θσ/(2κ)
"""

from __future__ import annotations

from fractions import Fraction

from ..algebra.calculus import (
    coefficient_of,
    derivation,
    gradient,
    substitute,
    terms_with,
    without,
)
from ..algebra.word_trees import WordNotation
from ..algebra.words import Expr, Letter, inner, number, trace, word
from ..language.derivatives import derivative
from ..language.laurent import vanishes
from ..language.layers import LEVEL
from ..language.read import read
from ..language.tree import Tree, add, replaced
from ..problem.solids import integral_above
from ..record.record import Equation, Step
from .fluid_body import FluidBody
from .inverse import cancel_scalar, inverse_letter
from .multipliers import MULTIPLIER
from .wording import say

HALF = Fraction(1, 2)


class Layers:
    """A fluid whose ellipsoid has a ``density`` by levels."""

    def __init__(self, fluid: FluidBody, density: Tree) -> None:
        self.fluid, self.density = fluid, density
        self.sigma, self.kappa = Letter("σ_r"), Letter("κ_Q")
        self.above = integral_above(density)
        slope, end = derivative(self.above, LEVEL), replaced(self.above, LEVEL, 1)
        if not (vanishes(add(slope, density)) and vanishes(end)):
            raise ValueError("the integral of the density does not end at the boundary")
        self.notation = WordNotation(display={inverse_letter(self.kappa): read("κ_Q⁻¹")})

    def steps(self, shape: Tree) -> tuple[Step, ...]:
        """Its moments, the pressure at every point, and the integral of that."""
        quadric = self._moments(shape)
        pressure = self._pressure(quadric)
        return quadric, pressure, self._total(quadric, pressure)

    def _along(self, e: Expr, h: Letter) -> Expr:
        """The derivative of a function of r and σ along h; that of σ by the chain rule, −ρ along
        the level."""
        f = self.fluid
        level = inner(word(f.r), word(f.Q) * word(f.r))
        images = {f.r: word(h)}
        images[self.sigma] = -(word(f.rho) * derivation(level, {f.r: word(h)}.get))
        return derivation(e, images.get)

    def _over_volume(self, e: Expr) -> Expr:
        """∫ e dx, where ρ dx is dm, and ∫ σ dx = 2κ."""
        f = self.fluid
        heavy = substitute(terms_with(e, f.rho), {f.rho: number(1)})
        light = substitute(without(e, f.rho), {self.sigma: 2 * word(self.kappa)})
        return f.over_body(heavy) + light

    def _moments(self, shape: Tree) -> Step:
        """Q J by the divergence theorem: the field rσ vanishes at the boundary."""
        f, draft = self.fluid, self.fluid.c.draft("quadric", "relation")
        h, Y = Letter("h", f.b.n), Letter("Y", f.b.n, f.b.n)
        field = word(f.r) * word(self.sigma)
        derivatives = coefficient_of(self._along(field, h), h)
        total = gradient(self._over_volume(trace(derivatives * word(Y))), Y)  # 2κ1 − 2QJ
        QJ = word(f.Q) * word(f.b.J)
        self.QJ = HALF * (total + 2 * QJ)
        draft.depends_on(f.found.motion)
        return draft.step(
            (
                Equation("Q_r", shape),
                Equation(LEVEL, ("norm2", "Q_r", "r")),
                Equation("ρ_r", self.density),
                Equation("σ_r", self.above),
                Equation("κ_Q", ("mul", HALF, ("call", "∫", ("div", "σ_r", "ρ_r")))),
                Equation(draft.tree(QJ), draft.tree(self.QJ)),
            ),
            say("quadric.layers"),
        )

    def _pressure(self, quadric: Step) -> Step:
        """p as the multiple of σ whose gradient balances the part of the acceleration that θ
        gives."""
        f, draft = self.fluid, self.fluid.draft("pressure", "solution")
        h, lighter = Letter("h", f.b.n), word(inverse_letter(self.kappa))
        inverse = lighter * word(f.Q)  # J⁻¹, by QJ = κ 1
        per_sigma = gradient(self._along(word(self.sigma), h), h)  # −2ρ Q r
        share = next(iter(per_sigma.terms.values()))
        self.pressure = -1 / share * word(MULTIPLIER) * lighter * word(self.sigma)
        slope = gradient(self._along(self.pressure, h), h)
        draft.depends_on(quadric)
        balance = f.balance(draft, slope, inverse, self.notation, {})
        known = {**self.notation.display, self.sigma: integral_above(self.density, middle=True)}
        return draft.step(
            (
                Equation("p_r", draft.tree(self.pressure, self.notation)),
                Equation("p_0", draft.tree(self.pressure, WordNotation(display=known))),
                balance,
            ),
            say("pressure.layers") + say("pressure.balance"),
        )

    def _total(self, quadric: Step, pressure: Step) -> Step:
        """θ = ∫ p dx, where dx = dm/ρ."""
        f, draft = self.fluid, self.fluid.draft("total", "solution")
        draft.depends_on(quadric, pressure)
        whole = cancel_scalar(self._over_volume(self.pressure), self.kappa)
        integral: Tree = ("call", "∫", ("div", "p_r", "ρ_r"))
        return draft.step(
            (Equation(integral, draft.tree(whole)),),
            say("total.layers") + (() if f.problem.signed else say("total.sign")),
        )
