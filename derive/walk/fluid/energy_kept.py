"""The energy h̃ along the motion: its rate is what the kernel says of η′ = u, and vanishes.

    d/dt h̃ = ⟨u̇ + ∇_u u − f, u⟩_ρ = ⟨D̄p, u⟩ = ⟨p, Du⟩ = 0

∇_u is skew and Du = 0: u is divergence-free, and tangent to the boundary.
"""

from __future__ import annotations

from fractions import Fraction

from ...algebra.calculus import derivation, reduce, substitute, terms_with
from ...algebra.vector_fields import along
from ...algebra.words import inner, word, zero
from ...language.read import read
from ...language.tree import Tree
from ...record.record import Equation, Step
from ..cartan import Cartan
from ..chapter import Chapter
from ..factorisation import factored_tree
from ..wording import say
from .advection import RATE, rate_of_density
from .fluid_kernel import FluidKernel
from .fluid_letters import FluidAlphabet
from .pressure import GRADIENT, SHOWN, pair_rule
from .trivialised import trees


def energy_kept(stage: FluidKernel, form: Cartan, a: FluidAlphabet, c: Chapter) -> Step:
    """The rate of h̃, told by u in ``form``: for any acceleration it is what the kernel pairs with
    u, and along the motion 0."""
    draft = c.draft("energy_kept", "conservation")
    u, rate = word(a.w.velocity), a.w.acceleration
    turned = word(along(a.w.velocity)).marked(c.label("skew")) * u
    images = {a.w.velocity: word(rate), a.U: -substitute(form.work, {a.w.xi: u})}
    told = [Equation("h̃", draft.tree(form.energy, trees(a)))]
    if a.advected:
        images[a.C] = rate_of_density(a).marked(c.label("advection"), c.label("skew"))
        half, found = (inner(u, x * u) * Fraction(1, 2) for x in (word(RATE), images[a.C]))
        like = inner(u, a.volume * word(rate))
        shown = factored_tree(draft, found, like, {rate: turned}, trees(a))
        told.append(Equation(draft.tree(half), shown))
    else:
        told.append(Equation(read("⟨u, ∇_u u⟩"), draft.tree(inner(u, turned))))
    changed = derivation(form.energy, images.get)
    if changed != inner(u, stage.force):
        raise ValueError("the rate of the energy is not what the kernel pairs with u")
    # along the motion ``stage.force`` is D̄p, and f is D̄V where the density is the same everywhere
    still = pair_rule((a.D, False), (a.w.velocity, False), zero("k", 1))
    push = word(a.D).bar * word(a.p).marked(c.label("divergence"), c.label("pressure"))
    idle = reduce(inner(u, push), still)
    if a.forced:
        pulled = word(a.D).bar * word(a.V).marked(c.label("absorbed"))
        gone = {} if a.advected else {a.force: pulled}
        fallen, changed = (reduce(substitute(x, gone), still) for x in (images[a.U], changed))
        told.append(Equation(read("dŨ(ν)"), draft.tree(fallen, trees(a))))
    moved = word(rate) + turned - (word(a.force) if a.forced else zero(a.n, 1))
    moving = {rate: moved} if a.advected else {}
    shown = factored_tree(draft, changed, terms_with(changed, rate), moving, trees(a))
    draft.depends_on(stage.balance, push)
    rated: Tree = ("call", "d/dt", "h̃")
    return draft.step(
        (
            *told,
            Equation(rated, shown, (rate.name,)),
            Equation(draft.tree(inner(word(GRADIENT), u), SHOWN), draft.tree(-idle)),
            Equation(rated, draft.tree(idle)),
        ),
        say("energy_kept.kernel")
        + say(f"energy_kept.{'advected' if a.advected else 'homogeneous'}")
        + (say(f"energy_kept.{'forced' if a.advected else 'absorbed'}") if a.forced else ())
        + say("energy_kept.pressure"),
    )
