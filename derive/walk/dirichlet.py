"""A body of fluid that linear maps move: Dirichlet's.  Where the volume is kept, θ is the integral
of the pressure; in an ellipsoid the pressure p balances the acceleration at every point.

    Q J = m/(n + 2) 1,   p = p₀(1 − ⟨r, Q r⟩),   p₀ = (n + 2)ρθ/(2m),   θ = ∫ p dx
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..algebra.calculus import (
    coefficient_of,
    derivation,
    gradient,
    reduce,
    substitute,
    terms_with,
    without,
)
from ..algebra.groups import Group
from ..algebra.word_trees import WordNotation, tree_of
from ..algebra.words import Expr, Factor, Letter, inner, number, one, trace, word
from ..language import rational as q
from ..language.derivatives import product, quotient
from ..language.tree import Tree, add, mul, neg
from ..problem.problem import Problem
from ..record.record import Equation, Step
from ..schema.body_kinds import GivenBody
from ..schema.kinds.volume import Volume
from ..schema.solid_kinds import Solid
from .chapter import Chapter, Draft
from .inverse import cancelling, inverse_letter
from .kinds.self_gravity_walked import GradientLetter
from .multipliers import MULTIPLIER
from .potential import Potentials
from .pullback import sum_over
from .solution import Solution
from .specialisation import Special
from .trivialisation import body_rule
from .wording import say

HALF = Fraction(1, 2)
INSIDE: Tree = add(1, neg(("norm2", "Q_r", "r")))
"""1 − ⟨r, Q r⟩, which vanishes at the boundary."""


def fluid_steps(
    problem: Problem,
    group: Group,
    potentials: Potentials,
    special: Special,
    found: Solution,
    c: Chapter,
) -> tuple[Step, ...]:
    """The steps ``quadric``, ``pressure``, ``total`` of an ellipsoid, or ``virial`` of another
    solid, that a group of all maps that keep volumes moves; ``circulation`` and ``no_rotation``.
    Of a gas ``circulation`` alone; none elsewhere."""
    gas = any(isinstance(p, Volume) for p in problem.potentials)
    if group.affine or group.factors or not (_keeps_volumes(group) or (gas and _moves_all(group))):
        return ()
    body = problem.body
    solids = body.solids if isinstance(body, GivenBody) else ()
    if not (solids or gas):
        return ()
    fluid = _Fluid(problem, potentials, special, found, c)
    if gas:
        return (fluid.circulation(),)
    free = not (problem.potentials or problem.inputs or problem.damping)
    shape = _quadric(solids, group.n) if not problem.points else None
    linear = all(p.linear for p in problem.potentials) and not problem.inputs + problem.damping
    told = fluid.ellipsoid(solids[0], shape) if shape and linear else (fluid.virial(),)
    circulation = fluid.circulation()
    turned = (fluid.no_rotation(circulation),) if free and group.n % 2 else ()
    return (*told, circulation, *turned)


def _keeps_volumes(group: Group) -> bool:
    normal = group.normal_space_of_linear_parts
    return len(normal) == 1 and group.normal_direction == q.identity(group.n)


def _moves_all(group: Group) -> bool:
    return not group.normal_space_of_linear_parts


def _quadric(solids: tuple[Solid, ...], n: int) -> tuple[tuple[Tree, ...], ...] | None:
    """Q of the one solid ⟨r, Q r⟩ ≤ 1 in its own frame; ``None`` where it is none."""
    solid, *others = solids
    if others or solid.rotation is not None or solid.shift is not None:
        return None
    if solid.kind == "ball":
        axes = (solid.sizes["radius"],) * n
    elif solid.kind == "ellipsoid" and "semi_axes" in solid.sizes:
        axes = solid.sizes["semi_axes"]
    else:
        return solid.sizes.get("quadric")
    span = range(n)
    return tuple(
        tuple(quotient(1, ("pow", axes[i], 2)) if i == j else 0 for j in span) for i in span
    )


@dataclass
class _Fluid:
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
        pressed = self.force * 0 if self._gas else word(MULTIPLIER) * one(b.n)
        inverse = word(inverse_letter(b.J))
        self.acceleration = reduce((self.force + pressed) * inverse, cancelling(b.J))  # Āα̇

    @property
    def _gas(self) -> bool:
        return any(isinstance(p, Volume) for p in self.problem.potentials)

    @property
    def _gravity(self) -> list[GradientLetter]:
        """The energies by C whose force may be central in the body, as that of its own gravity."""
        return [x for x in self.potentials.own if isinstance(x, GradientLetter)]

    def _draft(self, label: str, rule: str) -> Draft:
        draft = self.c.draft(label, rule)
        draft.depends_on(self.found.motion, self.found.steps[0])
        return draft

    # -- an ellipsoid ------------------------------------------------------------------------------

    def ellipsoid(self, solid: Solid, shape: tuple[tuple[Tree, ...], ...]) -> tuple[Step, ...]:
        """Its moments, the pressure at every point, and the integral of that."""
        quadric = self._moments(shape)
        pressure = self._pressure(solid.density, quadric)
        return quadric, pressure, self._total(solid.density, quadric, pressure)

    def _inside(self) -> Expr:
        return number(1) - inner(word(self.r), word(self.Q) * word(self.r))

    def _over_body(self, summand: Expr) -> Expr:
        """∫ of a function of r dm, in m and J."""
        b = self.b
        table = {(b.m_i,): word(b.m), (b.m_i, b.r_i, b.r_i): word(b.J)}
        inside = substitute(summand, {self.r: word(b.r_i)})
        return sum_over(word(b.m_i) * inside, {b.m_i, b.r_i}, table)

    def _moments(self, shape: tuple[tuple[Tree, ...], ...]) -> Step:
        """Q J by the divergence theorem: the derivatives of r(1 − ⟨r, Q r⟩), which vanishes at the
        boundary, have the integral 0."""
        b, draft = self.b, self.c.draft("quadric", "relation")
        h, Y = Letter("h", b.n), Letter("Y", b.n, b.n)
        field = word(self.r) * self._inside()
        derivatives = coefficient_of(derivation(field, {self.r: word(h)}.get), h)
        total = gradient(self._over_body(trace(derivatives * word(Y))), Y)  # (m − Tr QJ)1 − 2QJ
        QJ = word(self.Q) * word(b.J)
        traced = trace(total)
        masses, rest = without(traced, self.Q), terms_with(traced, self.Q)
        share = rest.terms[next(iter(trace(QJ).terms))]  # −(n + 2)
        both = HALF * (total + 2 * QJ)  # ½(m − Tr QJ)1
        self.QJ = substitute_trace(both, trace(QJ), masses * (-1 / share))
        draft.depends_on(self.found.motion)
        return draft.step(
            (
                Equation("Q_r", ("matrix", *(("row", *row) for row in shape))),
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
        b, draft = self.b, self._draft("pressure", "solution")
        h, r = Letter("h", b.n), word(self.r)
        pressure = word(self.p_0) * self._inside()
        slope = gradient(derivation(pressure, {self.r: word(h)}.get), h)  # ∂p/∂r
        share = next(iter(self.QJ.terms.values()))
        inverse = Fraction(1) / share * word(inverse_letter(b.m)) * word(self.Q)  # J⁻¹, by QJ
        pushed = word(self.rho) * substitute(
            terms_with(self.acceleration, MULTIPLIER), {inverse_letter(b.J): inverse}
        )
        if pushed * r + substitute(slope, {self.p_0: self._central()}):
            raise ValueError("the pressure does not balance the acceleration")
        left = Letter("Ā⁻¹", b.n, b.n)

        def rule(x: Factor, y: Factor) -> Expr | None:
            return b.unit if (x, y) == ((left, False), (b.A.position, True)) else None

        A = word(b.A.position)
        applied = word(self.rho) * without(self.acceleration, MULTIPLIER)
        applied = substitute(applied, {b.C: A.bar * A})
        force = reduce(word(left) * (applied * r - slope), rule, cancelling(b.J))
        shown = WordNotation(
            display={self.rho: density, left: ("inv", ("T", "A"))}
            | {inverse_letter(b.J): ("inv", "J")}
        )
        draft.depends_on(quadric)
        middle = quotient(product(Fraction(self.n + 2, 2), density, "θ"), "m")
        moved = word(self.rho) * (word(b.A.acceleration) * r)
        return draft.step(
            (
                Equation("p_0", middle),
                Equation("p_r", mul("p_0", INSIDE)),
                Equation(draft.tree(moved, shown), draft.tree(force, shown)),
            ),
            say("pressure.balance") + (say("pressure.gravity") if self._gravity else ()),
        )

    def _total(self, density: Tree, quadric: Step, pressure: Step) -> Step:
        """θ = ∫ p dx, where dx = dm/ρ."""
        draft = self._draft("total", "solution")
        draft.depends_on(quadric, pressure)
        lighter = inverse_letter(self.b.m)
        volume = word(inverse_letter(self.rho))
        whole = volume * self._over_body(self._inside()) * self._central()
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
        b, draft = self.b, self._draft("virial", "solution")
        moved = word(b.A.position).bar * word(b.A.acceleration) * word(b.J)
        rest = trace(moved) - trace(self.force)
        return draft.step((Equation(mul(self.n, "θ"), draft.tree(rest)),), say("virial.needed"))

    def circulation(self) -> Step:
        """Āα − ᾱA along the motion, where θJ⁻¹ drops out; and as the momentum of relabellings."""
        b = self.b
        turned = word(b.A.position).bar * word(b.A.velocity)
        turned = turned - turned.bar
        along = {b.A.position: word(b.A.velocity), b.A.velocity: word(b.A.acceleration)}
        A, rate = (b.A.position, True), (b.A.acceleration, False)

        def rule(x: Factor, y: Factor) -> Expr | None:
            if (x, y) == (A, rate):
                return self.acceleration
            opposite = (x, y) == ((rate[0], True), (A[0], False))
            return self.acceleration.bar if opposite else None

        changed = reduce(derivation(turned, along.get), rule, cancelling(b.J))
        by_body = {x.gradient: x.slope for x in self._gravity}
        rules = [x.adjugate for x in self._gravity]
        own = by_body and not reduce(substitute(changed, by_body), cancelling(b.J), *rules)
        changed = changed * 0 if own else changed
        draft = self._draft("circulation", "solution" if changed else "conservation")
        if own:
            draft.depends_on(*self.potentials.steps)
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
            + say("circulation.relabelling"),
        )

    def no_rotation(self, circulation: Step) -> Step:
        """det Υ = 0 for odd n, as of any skew matrix, and det(Z² + Ż) by θ: no rigid rotation
        without forces."""
        draft = self._draft("no_rotation", "solution")
        draft.depends_on(circulation)
        b = self.b
        if self.acceleration != word(MULTIPLIER) * word(inverse_letter(b.J)):
            raise ValueError("a force acts")
        Z = word(b.Z.velocity)
        return draft.step(
            (
                Equation(("det", "Υ"), 0),
                Equation(
                    ("det", tree_of(Z * Z + word(b.Z.acceleration))),
                    ("div", ("pow", "θ", self.n), ("det", "J")),
                ),
            ),
            say("no_rotation.free"),
        )


def substitute_trace(e: Expr, old: Expr, new: Expr) -> Expr:
    """An expression with a trace, of one word, replaced by a scalar."""
    ((traces, _),) = old.terms
    total = e * 0
    for (found, w), k in e.terms.items():
        if traces[0] in found:
            left = tuple(x for i, x in enumerate(found) if i != found.index(traces[0]))
            total = total + e.like({(left, w): k}) * new
        else:
            total = total + e.like({(found, w): k})
    return total
