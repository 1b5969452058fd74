"""The kernel of dϖ of a fluid, the principle, and the pressure that is its multiplier."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ...algebra.calculus import (
    PairRule,
    coefficient_of,
    derivation,
    gradient,
    reduce,
    strip,
    substitute,
    terms_with,
    without,
)
from ...algebra.word_trees import PLAIN, WordNotation, with_derivatives
from ...algebra.words import Expr, Factor, Letter, inner, one, trace, word, zero
from ...language.read import read
from ...language.tree import Tree, add, neg
from ...record.record import Equation, Step, stated
from ..chapter import Chapter, say
from ..matrices.coordinates import factored_tree
from ..spine.cartan import Cartan, Exterior
from ..spine.principle import (
    ACROSS,
    CONTRACTED,
    CONTRACTION,
    Contraction,
    Principle,
    extremal,
    velocities,
)
from .fluid_forms import GRADIENT_OF_V, FluidAlphabet, Points, trees

# The kernel of dϖ of a fluid: it moves with u, and u̇ + ∇_u u is orthogonal to every field that
# keeps the volume.
#
# η = u,  ⟨u̇ + ∇_u u, η′⟩ = 0


@dataclass(frozen=True)
class FluidKernel:
    """``balance``: what vanishes for every η′; ``force``: the field that η′ is paired with."""

    balance: Expr
    force: Expr
    steps: tuple[Step, ...]


def kernel(stage: Exterior, principle: Principle, a: FluidAlphabet, c: Chapter) -> FluidKernel:
    """The steps ``contraction``, ``vertical``, ``second_order`` and ``kernel``: by the
    ``principle`` of the tangents of the motions."""
    w = a.w
    found = Contraction(
        stage.form.of(principle.across),
        terms_with(without(stage.form, a.dt, a.dpt), w.d_velocity, w.dp_velocity),
        stage.images,
        with_derivatives({w.xi: word(w.velocity)}),
        {w.d_velocity: w.acceleration},
        (w.dp_velocity,),
        trees(a),
        resting={w.dp_velocity: w.xi_prime},
    )
    putting, testing, finding = (
        c.draft("contraction", "contraction"),
        c.draft("vertical", "restriction"),
        c.draft("second_order", "kernel"),
    )
    first = putting.step(
        (Equation(CONTRACTION, found.any_vector(putting)),),
        say("contraction.extremals") + say("contraction.unknown", unknown="η, δu"),
        where=(CONTRACTED,),
    )
    found = found.marked_by(putting)
    second = testing.step(
        (Equation(CONTRACTION, found.on_vertical(testing)),),
        say("vertical.velocity"),
        where=(CONTRACTED, *found.at_rest()),
    )
    along = velocities(finding, {w.xi: testing.mark(word(w.velocity))}, [w.xi])
    third = finding.step(
        (*along, Equation(CONTRACTION, found.remaining(finding), found.rates())),
        say("second_order.fluid"),
        where=along,
    )
    draft = c.draft("kernel", "kernel")
    balance = finding.mark(without(found.second_order, a.dpt))
    moving = {x: y for x, y in found.shifts.items() if x == w.acceleration}
    shown = factored_tree(draft, balance, found.remaining_core, moving, trees(a))
    last = draft.step(
        (Equation("ġ", draft.tree(word(a.T.velocity))), Equation(shown, 0, (w.xi_prime.name,))),
        say("kernel.fluid") + say("kernel.fluid_line"),
    )
    balance = draft.mark(balance)
    return FluidKernel(balance, gradient(balance, w.xi_prime), (first, second, third, last))


def forcing(stage: FluidKernel, a: FluidAlphabet, c: Chapter) -> FluidKernel:
    """A force that is given, by the principle of d'Alembert: the step ``forcing``."""
    if not a.given:
        return replace(stage, steps=())
    draft, w = c.draft("forcing", "kernel"), a.w
    balance = stage.balance - inner(word(w.xi_prime), a.volume * word(a.force))
    force = gradient(balance, w.xi_prime)
    moved = word(w.acceleration) + word(a.Z.velocity) * word(w.velocity) - word(a.force)
    core = terms_with(balance, w.acceleration)
    shown = factored_tree(draft, balance, core, {w.acceleration: moved}, trees(a))
    step = draft.step((Equation(shown, 0, (w.xi_prime.name,)),), say("forcing.fluid"))
    return FluidKernel(draft.mark(balance), draft.mark(force), (step,))


# The principle for a fluid: a lift is an extremal of the action if and only if its tangent is in
# the kernel of dϖ.
#
# δ[ϖ(X)] = dϖ(δy, X) + d/dt ϖ(δy),  dϖ(δy, X) = −⟨ν̇ − Gf, δg − ν δt⟩


def principle(points: Points, form: Cartan, a: FluidAlphabet, c: Chapter) -> Principle:
    """The variation of the action by dϖ, and what dϖ is there: the steps ``extremal`` and
    ``dalembert``."""
    varying, working = c.draft("extremal", "variation"), c.draft("dalembert", "contraction")
    first, across = extremal(varying, points.lagrangian, form.form, form.work, a)
    moved, acceleration = a.T.d_position, a.T.acceleration
    resting = without(across, a.dt)
    shifts = {
        moved: word(moved) - word(a.T.velocity) * word(a.dt),
        acceleration: -gradient(resting, moved),
    }
    core = terms_with(resting, acceleration)
    second = working.step(
        (
            Equation(
                ACROSS,
                factored_tree(working, across, core, shifts, PLAIN),
                (acceleration.name,),
            ),
        ),
        say("dalembert.extremal") + say("dalembert.fluid"),
        (2, 5),
        first.given,
    )
    return Principle(working.mark(across), (first, second))


# The pressure: the multiplier of div u = 0, by the letter D and its adjoint.
#
# u̇ + ∇_u u − f = D̄p = −grad p,  −Δp = Tr (∇u)²,  ∂ₙp = −⟨∇_u u, n⟩
#
# What is orthogonal to every field η′ with Dη′ = 0 is in the image of D̄ (Helmholtz). Then D is
# put before this equation; D∇_u u is found at each place, where ∇_u u is (∇u)u, a matrix times a
# vector.

GRADIENT = Letter("grad p", "n")
"""−D̄p as one vector."""
SHOWN = WordNotation(
    display={GRADIENT: ("call", "grad", "p"), GRADIENT_OF_V: ("call", "grad", "V")}
)


def pressure(stage: FluidKernel, points: Points, a: FluidAlphabet, c: Chapter) -> tuple[Step, ...]:
    """The steps ``divergence``, ``pressure``, ``absorbed`` of a force where the density is the same
    everywhere, ``divergence_along``, ``pressure_equation`` and ``boundary``."""
    u, rate = (word(x) for x in (a.w.velocity, a.w.acceleration))
    D, pushed = word(a.D), word(a.D).bar * word(a.p)
    dividing, pressing = c.draft("divergence", "definition"), c.draft("pressure", "multiplier")
    first = dividing.step(
        (
            *stated("D∇_u u = div(∇_u u)"),
            *(Equation(dividing.tree(D * x), 0) for x in (u, rate)),
        ),
        say("divergence.fields"),
    )
    pressing.depends_on(first)
    inert = without(stage.force, a.force)
    driving = substitute(inert - stage.force, {a.force: points.potential})
    second = pressing.step(
        (
            Equation(pressing.tree(stage.force), pressing.tree(pushed), exists=("p",)),
            Equation(pressing.tree(pushed), pressing.tree(by_gradient(pushed, a), SHOWN)),
            Equation(pressing.tree(inert), pressing.tree(by_gradient(pushed, a) + driving, SHOWN)),
        ),
        say("pressure.helmholtz") + (() if a.advected else say("pressure.curved")),
    )
    twice = divergence_along(a, c)
    elliptic = _poisson(stage, points, a, c, first, twice)
    joined = _absorbed(stage, points, a, c) if a.forced and not a.advected else ()
    return (first, second, *joined, twice, elliptic, _boundary(stage, points, a, c))


def _absorbed(stage: FluidKernel, points: Points, a: FluidAlphabet, c: Chapter) -> tuple[Step]:
    """A force with potential where the density is 1: it is in the image of D̄, as the pressure
    is."""
    draft = c.draft("absorbed", "elimination")
    turned = word(a.D).bar * word(a.V).marked(*points.potential.lineage, c.label("pressure"))
    if _gradients(turned, a) != points.potential:
        raise ValueError("the force is not the opposite of the gradient of its potential")
    still = pair_rule((a.D, False), (a.w.xi_prime, False), zero("k", 1))
    balance = reduce(substitute(stage.balance, {a.force: turned}), still)
    moved = {a.w.acceleration: gradient(balance, a.w.xi_prime)}
    shown = factored_tree(draft, balance, terms_with(balance, a.w.acceleration), moved, trees(a))
    both = Letter("p + V", "k")
    image = word(a.D).bar * word(a.p) + turned
    if image != substitute(word(a.D).bar * word(both), {both: word(a.p) + word(a.V)}):
        raise ValueError("the force is not in the image of the pressure")
    return (
        draft.step(
            (
                Equation(draft.tree(word(a.force)), draft.tree(turned)),
                Equation(shown, 0, (a.w.xi_prime.name,)),
                Equation(
                    draft.tree(without(stage.force, a.force)),
                    neg(("call", "grad", add(a.p.name, a.V.name))),
                ),
            ),
            say("absorbed.pressure"),
        ),
    )


def _gradients(e: Expr, a: FluidAlphabet) -> Expr:
    """An expression with −grad V for D̄V."""
    return reduce(e, pair_rule((a.D, True), (a.V, False), -word(GRADIENT_OF_V)))


def by_gradient(e: Expr, a: FluidAlphabet) -> Expr:
    """An expression with −grad p for D̄p."""
    return reduce(e, pair_rule((a.D, True), (a.p, False), -word(GRADIENT)))


def pair_rule(left: Factor, right: Factor, value: Expr) -> PairRule:
    """The relation that a pair of factors has this value."""
    return lambda x, y: value if (x, y) == (left, right) else None


def divergence_along(a: FluidAlphabet, c: Chapter) -> Step:
    """D∇_u u at one place, by the matrix B of ∇u there: the trace of the derivative of Bu."""
    draft = c.draft("divergence_along", "variation")
    n, u = a.n, a.w.velocity
    B, e = Letter("∇u", n, n, traceless=True), Letter("e", n)
    along_e, along_u = Letter("∂_e B", n, n), Letter("∂_u B", n, n, traceless=True)
    varied = derivation(word(B) * word(u), {B: word(along_e), u: word(B) * word(e)}.get)
    # second derivatives commute: (∂_e B)u = (∂_u B)e, whose trace is that of B along u, 0
    crossed = reduce(varied, pair_rule((along_e, False), (u, False), word(along_u) * word(e)))
    found = trace(coefficient_of(crossed, e))
    notation = WordNotation(display={B: ("call", "∇", "u")})
    return draft.step(
        (Equation(read("div(∇_u u)"), draft.tree(found, notation)),), say("divergence_along.twice")
    )


def _poisson(
    stage: FluidKernel,
    points: Points,
    a: FluidAlphabet,
    c: Chapter,
    adjoint: Step,
    twice: Step,
) -> Step:
    """D before the equation of motion, solved for the acceleration; D u̇ = 0."""
    draft = c.draft("pressure_equation", "elimination", adjoint, twice)
    inverse = Letter("ρ⁻¹", a.n, a.n, 1)
    over = word(inverse) if a.advected else one(a.n)
    cancelled = pair_rule((inverse, False), (a.C, False), one(a.n))
    still = pair_rule((a.D, False), (a.w.acceleration, False), zero("k", 1))
    ((_, value),) = ((e.lhs, e.rhs) for e in twice.equations)
    along = reduce(word(a.D) * reduce(over * stage.force, cancelled), still)
    spread = substitute(along - without(along, a.force), {a.force: points.potential})
    if along - terms_with(along, a.force) != word(a.D) * word(a.Z.velocity) * word(a.w.velocity):
        raise ValueError("the divergence of the acceleration is not that of ∇_u u")
    pushed = strip(word(a.D) * by_gradient(over * word(a.D).bar * word(a.p), a), a.D)
    notation = WordNotation(display={**SHOWN.display, inverse: ("inv", "ρ")})
    laplacian = ("call", "div", draft.tree(-pushed.of(stage.force), notation))
    left = neg(laplacian if a.advected else read("Δp"))
    known = [] if a.advected else [Equation(read("Δp"), laplacian)]
    if a.forced:
        of_V = strip(spread, a.D)
        known.append(Equation(read("ΔV"), ("call", "div", draft.tree(of_V, SHOWN))))
        value = add(value, read("ΔV"))
    elif a.given:
        value = add(value, neg(("call", "div", draft.tree(-strip(spread, a.D)))))
    kind = "force" if a.given else "advected" if a.advected else "homogeneous"
    return draft.step((*known, Equation(left, value)), say(f"pressure_equation.{kind}"))


def _boundary(stage: FluidKernel, points: Points, a: FluidAlphabet, c: Chapter) -> Step:
    """The equation of motion paired with n, to which u̇ and with it ρu̇ is orthogonal."""
    draft = c.draft("boundary", "elimination")
    n = word(Letter("n", a.n))
    still = a.volume * word(a.w.acceleration)
    push = by_gradient(word(a.D).bar * word(a.p), a)
    inert = without(stage.force, a.force)
    driving = substitute(stage.force - inert, {a.force: points.potential})
    paired = inner(n, push) - inner(n, inert - still)  # 0 = ⟨n, D̄p − ρ(u̇ + ∇_u u − f)⟩
    normal = inner(n, word(GRADIENT))
    against: Tree = neg(("inner", draft.tree(driving, SHOWN), "n")) if driving else 0
    if a.given:
        against = ("inner", draft.tree(-driving), "n")
    return draft.step(
        (
            Equation(read("∂ₙp"), draft.tree(normal, SHOWN)),
            Equation(read("∂ₙp"), add(draft.tree(paired + normal, SHOWN), against)),
        ),
        say("boundary.tangent"),
    )
