"""What the motion keeps by the symmetries of the right side; along curves, see :mod:`loops`.

Displacements of the fluid before g, which keep the volume, leave u alone: g goes to g ∘ h, δu = 0
and δg = Gϑ, where ϑ is carried along by the motion.  So p̃(Gϑ) = ⟨u, ϑ⟩ is constant.
"""

from __future__ import annotations

from ...algebra.calculus import derivation, reduce, substitute, terms_with, without
from ...algebra.vector_fields import along, with_derivatives
from ...algebra.words import Expr, Factor, Letter, inner, word, zero
from ...language.tree import Tree
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..exterior import brackets_of
from ..factorisation import factored_tree
from ..wording import say
from .advection import rate_of_density
from .fluid_kernel import FluidKernel
from .fluid_letters import FluidAlphabet
from .fluid_points import Points
from .trivialised import trees


def circulation(
    stage: FluidKernel, points: Points, a: FluidAlphabet, c: Chapter
) -> tuple[Step, ...]:
    """The steps ``relabelling`` and ``circulation``."""
    moving, keeping = c.draft("relabelling", "variation"), c.draft("circulation", "conservation")
    w, u = a.w, word(a.w.velocity)
    carried = word(a.moved_field)
    # δη′ − δ′η for δ the relabelling and δ′ the motion: δu = 0, and δ′η is the rate of ϑ
    crossed = brackets_of(a)[w.xi_prime]
    found = -substitute(crossed, with_derivatives({w.xi: carried, w.xi_prime: u}))
    images = {a.moved_field: moving.mark(found), w.velocity: word(w.acceleration)}
    given: list[Equation] = []
    if a.advected:
        images[a.C] = rate_of_density(a).marked(c.label("advection"))
        turned, density = word(along(a.moved_field)), word(a.C)
        given = [Equation(keeping.tree(turned * density), keeping.tree(density * turned))]
    told = (Equation(a.moved_rate.name, moving.tree(found)),)
    first = moving.step(told, say("relabelling.field"))
    momentum = inner(u, a.volume * carried)
    changed = derivation(momentum, images.get)
    driven = substitute(stage.balance, {w.xi_prime: carried})
    inert = without(driven, a.force)
    keeping.depends_on(driven, points.potential, changed, word(a.C).marked(c.label("skew")))
    left = skew_part(changed - inert, a) + work_on(driven - inert, a)
    if left:
        raise ValueError("the circulation is not kept")
    moved = word(w.acceleration) + word(along(w.velocity)) * u
    pushed = factored_tree(
        keeping, inert, terms_with(inert, w.acceleration), {w.acceleration: moved}, trees(a)
    )
    rated: Tree = ("call", "d/dt", keeping.tree(momentum, trees(a)))
    second = keeping.step(
        (
            Equation(rated, pushed, (w.acceleration.name,)),
            Equation(rated, 0),
        ),
        say(f"circulation.{'advected' if a.advected else 'homogeneous'}")
        + (say("circulation.potential") if a.forced else ()),
        where=given,
    )
    return first, second


def work_on(e: Expr, a: FluidAlphabet) -> Expr:
    """A scalar with D̄V for f, where ϑ, and the product with a density that it leaves alone, is
    without divergence."""
    product = Letter("ρϑ", a.n)

    def rule(x: Factor, y: Factor) -> Expr | None:
        if (x[0], y[0]) == (a.C, a.moved_field):
            return word(product)
        return zero("k", 1) if x == (a.D, False) and y[0] in (product, a.moved_field) else None

    return reduce(substitute(e, {a.force: word(a.D).bar * word(a.V)}), rule)


def skew_part(e: Expr, a: FluidAlphabet) -> Expr:
    """A scalar in which ρ∇_ϑ = ∇_ϑρ is one letter, skew as ∇_ϑ is."""
    both = {along(a.moved_field), a.C}
    product = word(Letter("ρ∇_ϑ", a.n, a.n, symmetry=-1))
    return reduce(e, lambda x, y: product if {x[0], y[0]} == both else None)
