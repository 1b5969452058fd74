"""Kelvin's theorem: the circulation along a closed curve γ = g ∘ γ₀ that the fluid carries along.

    Γ = Γ₀G,  d/dt⟨Γu, γ_s⟩ = ⟨Γ(u̇ + ∇_u u), γ_s⟩ + ⟨Γu, ∂_sΓu⟩ = 0

Γ is the composition with γ and ∂_s the derivative along it, skew as γ is closed: so the last term
vanishes, and so does the first, where Γ(u̇ + ∇_u u) is that of gradients.  With a density it is
where Γρ = κΓ.
"""

from __future__ import annotations

from ...algebra.calculus import PairRule, derivation, reduce, substitute, terms_with, without
from ...algebra.vector_fields import along
from ...algebra.words import Expr, Factor, Letter, col_dim, inner, row_dim, word, zero
from ...language.read import read
from ...language.tree import Tree
from ...record.record import Equation, Step, stated
from ..chapter import Chapter
from ..factorisation import factored_tree
from ..trivialisation import trivial_images
from ..wording import say
from .advection import rate_of_density
from .fluid_kernel import FluidKernel
from .fluid_letters import FluidAlphabet
from .fluid_points import GRADIENT_OF_V, Points
from .pressure import GRADIENT, SHOWN, by_gradient, pair_rule

BODY, CURVE = Letter("Γ_0", "curve", "n"), Letter("Γ", "curve", "n")
"""The composition with γ₀, of fields over the points, and with γ, of fields in space."""
ALONG = Letter("∂_s", "curve", "curve", symmetry=-1)
TANGENT, LEVEL, CHANGE = Letter("γ_s", "curve"), Letter("κ"), Letter("κ̇")


def kelvin(stage: FluidKernel, points: Points, a: FluidAlphabet, c: Chapter) -> tuple[Step, ...]:
    """The steps ``curve``, ``closed_curve``, of a density ``level_curve``, and ``kelvin``."""
    level = (_level(a, c),) if a.advected else ()
    return (_carried(a, c), _closed(a, c), *level, _kept(stage, points, a, c))


def _carried(a: FluidAlphabet, c: Chapter) -> Step:
    """Γ = Γ₀G, and the rates of γ and Γ by those of g and G."""
    draft = c.draft("curve", "variation")
    G = a.A.position
    whole = pair_rule((BODY, False), (G, False), word(CURVE))
    turned = word(G) * word(along(a.w.velocity))
    draft.depends_on(turned.marked(c.label("chain")))
    moving = word(BODY) * trivial_images(a)[a.T.velocity]
    turning = derivation(word(BODY) * word(G), {G: turned}.get)
    return draft.step(
        (
            *stated("Γ = Γ₀G,  γ̇ = Γ₀ν"),
            Equation("γ̇", draft.tree(reduce(moving, whole))),
            Equation("Γ̇", draft.tree(reduce(turning, whole))),
        ),
        say("curve.carried"),
    )


def _closed(a: FluidAlphabet, c: Chapter) -> Step:
    """∂_s is skew: of gradients nothing is left along the curve, nor of u along itself."""
    draft = c.draft("closed_curve", "relation")
    moved = word(CURVE).marked(c.label("curve")) * word(a.w.velocity)
    pushed = inner(word(CURVE) * word(GRADIENT), word(TANGENT))
    return draft.step(
        (
            Equation(("T", ALONG.name), draft.tree(word(ALONG).bar)),
            *stated("∂_sΓ = ∇_γ_s"),
            Equation(draft.tree(pushed, SHOWN), draft.tree(reduce(pushed, along_curve(GRADIENT)))),
            Equation(read("⟨Γu, ∂_sΓu⟩"), draft.tree(inner(moved, word(ALONG) * moved))),
        ),
        say("closed_curve.skew"),
    )


def along_curve(slope: Letter) -> PairRule:
    """⟨Γ grad p, γ_s⟩ = ⟨1, ∇_γ_s p⟩ = ⟨1, ∂_sΓp⟩ over the curve, and ∂_s1 = 0: as rules."""
    values, unit, pushed = Letter("Γp", "values"), Letter("1", "values"), Letter("Γ grad", "curve")
    down = Letter("∂_s", "values", "values", symmetry=-1)

    def rule(x: Factor, y: Factor) -> Expr | None:
        if (x, y) == ((CURVE, False), (slope, False)):
            return word(pushed)
        if (x, y) == ((slope, True), (CURVE, True)):
            return word(pushed).bar
        if {x[0], y[0]} == {pushed, TANGENT}:
            return inner(word(unit), word(down) * word(values))
        return zero(row_dim(x), col_dim(y)) if {x[0], y[0]} == {down, unit} else None

    return rule


def _level(a: FluidAlphabet, c: Chapter) -> Step:
    """The rate of both sides of Γρ = κΓ."""
    draft = c.draft("level_curve", "variation")
    images = {
        CURVE: (word(CURVE) * word(along(a.w.velocity))).marked(c.label("curve")),
        a.C: rate_of_density(a).marked(c.label("advection")),
        LEVEL: word(CHANGE),
    }
    both = word(CURVE) * word(a.C) - word(LEVEL) * word(CURVE)
    changed = reduce(derivation(both, images.get), on_level(a))
    draft.depends_on(changed)
    if changed != -word(CHANGE) * word(CURVE):
        raise ValueError("the density on the curve is not kept")
    return draft.step((Equation(CHANGE.name, 0),), say("level_curve.kept"), where=(one_level(a),))


def one_level(a: FluidAlphabet) -> Equation:
    """Γρ = κΓ: on the curve ρ has one value, κ."""
    return Equation(("mul", CURVE.name, a.C.name), ("mul", LEVEL.name, CURVE.name))


def on_level(a: FluidAlphabet) -> PairRule:
    """The same as a rule."""
    return pair_rule((CURVE, False), (a.C, False), word(LEVEL) * word(CURVE))


def _kept(stage: FluidKernel, points: Points, a: FluidAlphabet, c: Chapter) -> Step:
    """The rate of ⟨Γu, γ_s⟩, which is 0 by the equation of motion."""
    draft = c.draft("kelvin", "conservation")
    u, rate, curve = a.w.velocity, a.w.acceleration, word(CURVE)
    images = {
        u: word(rate),
        CURVE: (curve * word(along(u))).marked(c.label("curve")),
        TANGENT: (word(ALONG) * curve * word(u)).marked(c.label("curve")),
    }
    moved = {rate: word(rate) + word(along(u)) * word(u)}
    carried, circulating = curve * word(u), inner(curve * word(u), word(TANGENT))
    changed = derivation(circulating, images.get)
    inert = without(stage.force, a.force)
    driving = substitute(inert - stage.force, {a.force: points.potential})
    push = by_gradient(word(a.D).bar * word(a.p), a).marked(c.label("pressure"))
    pushed, left = (reduce(curve * x, on_level(a)) for x in (push + driving, inert))
    scaled = word(LEVEL) * changed if a.advected else changed
    gradients = (along_curve(x) for x in (GRADIENT, GRADIENT_OF_V))
    if scaled != inner(left, word(TANGENT)) or reduce(inner(pushed, word(TANGENT)), *gradients):
        raise ValueError("the circulation along a curve is not kept")
    draft.depends_on(changed.marked(c.label("closed_curve")))
    if a.advected:
        draft.depends_on(word(LEVEL).marked(c.label("level_curve")))

    def written(e: Expr) -> Tree:
        return factored_tree(draft, e, terms_with(e, rate), moved, SHOWN)

    rated: Tree = ("call", "d/dt", draft.tree(circulating))
    return draft.step(
        (
            Equation(
                ("call", "d/dt", draft.tree(carried)),
                written(derivation(carried, images.get)),
                (rate.name,),
            ),
            Equation(("call", "d/dt", TANGENT.name), draft.tree(images[TANGENT])),
            Equation(written(left), draft.tree(pushed, SHOWN)),
            Equation(rated, written(changed), (rate.name,)),
            Equation(rated, 0),
        ),
        say(f"kelvin.{'advected' if a.advected else 'homogeneous'}"),
        where=(one_level(a),) if a.advected else (),
    )
