"""A body of fluid that linear maps move (Dirichlet): its motion, its pressure, its layers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from ...algebra.calculus import (
    coefficient_of,
    derivation,
    determinant,
    determinant_letter,
    gradient,
    reduce,
    substitute,
    substitute_trace,
    terms_with,
    without,
)
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Factor, Letter, inner, number, one, trace, word
from ...language.derivatives import derivative, product, quotient
from ...language.laurent import LEVEL, is_layered, vanishes
from ...language.read import read
from ...language.tree import Tree, add, mul, neg, replaced
from ...problem.problem import Problem
from ...problem.solids import integral_above, quadric_about_origin
from ...record.record import Equation, Step
from ...schema.body_kinds import GivenBody, Solid
from ...schema.potential_kinds import Volume
from ..chapter import Chapter, Draft, say
from ..given.body_and_potentials import Potentials
from ..given.potential_words import GradientLetter
from ..matrices.solution import MULTIPLIER, Solution
from ..matrices.specialisation import KernelOnGroup
from ..spine.alphabet import cancel_scalar, cancelling, inverse_letter
from ..spine.cartan import body_rule
from ..spine.lagrangian import sum_over

# The motion of a body of fluid that linear maps move, and Euler's equation at its places.


@dataclass
class FluidBody:
    """What is known of the motion of a body: Āα̇J = ĀN + θ 1, or without θ on GL(n)."""

    problem: Problem
    potentials: Potentials
    special: KernelOnGroup
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
    def is_about_centre(self) -> bool:
        """Is the centre of mass the fixed point, c = 0?"""
        assert self.problem.body is not None
        return all(x == 0 for x in self.problem.body.moments().c)

    @property
    def gravity(self) -> list[GradientLetter]:
        """The energies by C whose force may be central in the body, as that of its own gravity."""
        return [x for x in self.potentials.own if isinstance(x, GradientLetter)]

    def draft(self, label: str, rule: str, *more: Expr | Step) -> Draft:
        """A step that rests on the motion, and on more, in the making."""
        return self.c.draft(label, rule, self.found.motion, self.found.steps[0], *more)

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


# A body of fluid that linear maps move: Dirichlet's. Where the volume is kept, θ is the integral
# of the pressure; in an ellipsoid the pressure p balances the acceleration at every point.
#
# Q J = m/(n + 2) 1,   p = p₀(1 − ⟨r, Q r⟩),   p₀ = (n + 2)ρθ/(2m),   θ = ∫ p dx

HALF = Fraction(1, 2)
INSIDE: Tree = add(1, neg(("norm2", "Q_r", "r")))
"""1 − ⟨r, Q r⟩, which vanishes at the boundary."""


def fluid_steps(
    problem: Problem,
    group: Group,
    potentials: Potentials,
    special: KernelOnGroup,
    found: Solution,
    c: Chapter,
) -> tuple[Step, ...]:
    """The steps ``quadric``, ``pressure``, ``total`` of an ellipsoid, or ``virial`` of another
    solid, that a group of all maps that keep volumes moves; ``circulation`` and ``no_rotation``.
    Of a gas ``circulation`` alone; none elsewhere."""
    gas = any(isinstance(p, Volume) for p in problem.potentials)
    kept = "unimodular" in group.relations
    if group.affine or group.factors or not group.keeps_no_more_than_volume or not (kept or gas):
        return ()
    body = problem.body
    solids = body.solids if isinstance(body, GivenBody) else ()
    if not (solids or gas):
        return ()
    fluid = _Fluid(problem, potentials, special, found, c)
    if gas:
        return (fluid.circulation(),)
    outside = (*problem.inputs, *problem.forces, *problem.damping)
    free = not (problem.potentials or outside)
    one = len(solids) == 1 and not problem.points
    shape = quadric_about_origin(solids[0], group.n) if one else None
    linear = all(p.linear for p in problem.potentials) and not outside
    told = fluid.ellipsoid(solids[0], shape) if shape and linear else (fluid.virial(),)
    circulation = fluid.circulation()
    turned = (fluid.no_rotation(circulation),) if free and group.n % 2 else ()
    return (*told, circulation, *turned)


class _Fluid(FluidBody):
    """The steps of a body of fluid."""

    # -- an ellipsoid ------------------------------------------------------------------------------

    def ellipsoid(self, solid: Solid, shape: Tree) -> tuple[Step, ...]:
        """Its moments, the pressure at every point, and the integral of that."""
        if is_layered(solid.density):
            return LayeredFluid(self, solid.density).steps(shape)
        quadric = self._moments(shape)
        pressure = self._pressure(solid.density, quadric)
        return quadric, pressure, self._total(solid.density, quadric, pressure)

    def _inside(self) -> Expr:
        return number(1) - inner(word(self.r), word(self.Q) * word(self.r))

    def _moments(self, shape: Tree) -> Step:
        """Q J by the divergence theorem: the derivatives of r(1 − ⟨r, Q r⟩), which vanishes at the
        boundary, have the integral 0."""
        b, draft = self.b, self.c.draft("quadric", "relation", self.found.motion)
        h, Y = Letter("h", b.n), Letter("Y", b.n, b.n)
        field = word(self.r) * self._inside()
        derivatives = coefficient_of(derivation(field, {self.r: word(h)}.get), h)
        total = gradient(self.over_body(trace(derivatives * word(Y))), Y)  # (m − Tr QJ)1 − 2QJ
        QJ = word(self.Q) * word(b.J)
        traced = trace(total)
        masses, rest = without(traced, self.Q), terms_with(traced, self.Q)
        share = rest.terms[next(iter(trace(QJ).terms))]  # −(n + 2)
        both = HALF * (total + 2 * QJ)  # ½(m − Tr QJ)1
        self.QJ = substitute_trace(both, trace(QJ), masses * (-1 / share))
        return draft.step(
            (
                Equation("Q_r", shape),
                Equation(draft.tree(2 * QJ), draft.tree(total + 2 * QJ)),
                Equation(draft.tree(QJ), draft.tree(self.QJ)),
            ),
            say("quadric.stokes"),
        )

    def _central(self) -> Expr:
        """p₀ = ½(n + 2)ρθ/m, from Q J = m/(n + 2) 1."""
        share = next(iter(self.QJ.terms.values()))  # 1/(n + 2)
        m = word(inverse_letter(self.b.m))
        return HALF / share * word(self.rho) * word(MULTIPLIER) * m

    def _pressure(self, density: Tree, quadric: Step) -> Step:
        """p with its gradient, which balances the part of the acceleration that θ gives."""
        b, draft = self.b, self.draft("pressure", "solution", quadric)
        h = Letter("h", b.n)
        pressure = word(self.p_0) * self._inside()
        slope = gradient(derivation(pressure, {self.r: word(h)}.get), h)  # ∂p/∂r
        share = next(iter(self.QJ.terms.values()))
        inverse = Fraction(1) / share * word(inverse_letter(b.m)) * word(self.Q)  # J⁻¹, by QJ
        shown = WordNotation(display={self.rho: density})
        middle = quotient(product(Fraction(self.n + 2, 2), density, "θ"), "m")
        return draft.step(
            (
                Equation("p_0", middle),
                Equation("p_r", mul("p_0", INSIDE)),
                self.balance(draft, slope, inverse, shown, {self.p_0: self._central()}),
            ),
            say("pressure.balance") + (say("pressure.gravity") if self.gravity else ()),
        )

    def _total(self, density: Tree, quadric: Step, pressure: Step) -> Step:
        """θ = ∫ p dx, where dx = dm/ρ."""
        draft = self.draft("total", "solution", quadric, pressure)
        lighter = inverse_letter(self.b.m)
        volume = word(inverse_letter(self.rho))
        whole = volume * self.over_body(self._inside()) * self._central()
        QJ = trace(word(self.Q) * word(self.b.J))
        whole = substitute_trace(whole, QJ, trace(self.QJ))
        ones = {lighter: number(1), self.b.m: number(1), self.rho: number(1)}
        ones[inverse_letter(self.rho)] = number(1)  # m m⁻¹ and ρ ρ⁻¹
        if substitute(whole, ones) != word(MULTIPLIER):
            raise ValueError("the integral of the pressure is not the multiplier")
        return draft.step(
            (Equation(("call", "∫", "p_r"), product(density, "θ")),),
            say("total.pressure") + say("total.sign"),
        )

    # -- any body ----------------------------------------------------------------------------------

    def virial(self) -> Step:
        """n θ, by the trace of the balance: the total pressure that would be needed."""
        b, draft = self.b, self.draft("virial", "solution")
        moved = word(b.A.position).bar * word(b.A.acceleration) * word(b.J)
        rest = trace(moved) - trace(self.force)
        return draft.step((Equation(mul(self.n, "θ"), draft.tree(rest)),), say("virial.needed"))

    @property
    def turned(self) -> Expr:
        """Āα − ᾱA."""
        half = word(self.b.A.position).bar * word(self.b.A.velocity)
        return half - half.bar

    def circulation(self) -> Step:
        """Āα − ᾱA along the motion, where θJ⁻¹ drops out; and as the momentum of relabellings."""
        b, turned = self.b, self.turned
        along = {b.A.position: word(b.A.velocity), b.A.velocity: word(b.A.acceleration)}
        A, rate = (b.A.position, True), (b.A.acceleration, False)

        def rule(x: Factor, y: Factor) -> Expr | None:
            if (x, y) == (A, rate):
                return self.acceleration
            opposite = (x, y) == ((rate[0], True), (A[0], False))
            return self.acceleration.bar if opposite else None

        changed = reduce(derivation(turned, along.get), rule, cancelling(b.J))
        centred = b.c in changed.letters() and self.is_about_centre
        changed = without(changed, b.c) if centred else changed
        by_body = {x.gradient: x.slope for x in self.gravity}
        rules = [x.adjugate for x in self.gravity]
        own = by_body and not reduce(substitute(changed, by_body), cancelling(b.J), *rules)
        changed = changed * 0 if own else changed
        draft = self.draft("circulation", "solution" if changed else "conservation")
        if own:
            draft.depends_on(*self.potentials.steps)
        if centred:
            draft.depends_on(word(b.c).marked(self.c.label("body")))
        J, momentum = word(b.J), word(b.C) * word(b.Z.velocity) * word(b.J)
        image = {b.A.velocity: word(b.A.position) * word(b.Z.velocity)}
        carried = reduce(substitute(J * turned * J, image), body_rule(b, word(b.C)))
        if carried != J * momentum - momentum.bar * J:
            raise ValueError("the circulation is not the momentum of a relabelling")
        Pi = word(b.Pi.momentum)
        notation = WordNotation(display={inverse_letter(b.J): ("inv", "J")})
        return draft.step(
            (
                Equation("Υ", draft.tree(turned)),
                Equation(("mul", "J", "Υ", "J"), draft.tree(J * Pi - Pi.bar * J)),
                Equation("Υ̇", draft.tree(changed, notation)),
            ),
            say("circulation." + ("changed" if changed else "gravity" if own else "kept"))
            + (say("circulation.centred") if centred else ())
            + say("circulation.relabelling"),
        )

    def no_rotation(self, circulation: Step) -> Step:
        """det Υ = 0 for odd n, where det Ῡ = det Υ and Ῡ = −Υ, and det(Z² + Ż) by that of
        Āα̇ = θJ⁻¹: no rigid rotation without forces."""
        b, draft = self.b, self.draft("no_rotation", "solution")
        draft.depends_on(circulation, number(1).marked(self.c.label("relation")))
        if self.turned.bar != -self.turned:
            raise ValueError("the circulation is not skew")
        skew, rate = word(Letter("Υ", self.n, self.n, -1)), Letter("Y", self.n, self.n)
        twice = determinant(skew) - determinant(skew.bar)  # 0, and 2 det Υ where n is odd
        singular = determinant(skew) - HALF * twice
        moved = word(b.A.position).bar * word(b.A.position) * word(rate)  # Āα̇
        unimodular = {determinant_letter(b.A.position): number(1)}
        if substitute(determinant(moved), unimodular) != word(determinant_letter(rate)):
            raise ValueError("the map does not keep the volume")
        lighter = determinant_letter(inverse_letter(b.J))
        notation = WordNotation(display={lighter: quotient(1, ("det", "J"))})
        Z = word(b.Z.velocity)
        return draft.step(
            (
                Equation(("det", "Υ"), tree_of(singular)),
                Equation(
                    ("det", tree_of(Z * Z + word(b.Z.acceleration))),
                    product(draft.tree(determinant(self.acceleration), notation)),
                ),
            ),
            say("no_rotation.free"),
        )


# An ellipsoid of fluid in layers: its density ρ is a function of the level s = ⟨r, Q r⟩.
#
# σ = ∫ρ ds from s to 1,   ∂σ/∂r = −2ρ Q r,   Q J = κ 1,   2κ = ∫ σ dx,   p = θσ/(2κ)


class LayeredFluid:
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
        f, draft = self.fluid, self.fluid.draft("total", "solution", quadric, pressure)
        whole = cancel_scalar(self._over_volume(self.pressure), self.kappa)
        integral: Tree = ("call", "∫", ("div", "p_r", "ρ_r"))
        return draft.step(
            (Equation(integral, draft.tree(whole)),),
            say("total.layers") + (() if f.problem.signed else say("total.sign")),
        )
