"""The density is carried along: ρ = ρ₀ ∘ g⁻¹, with ρ₀ that of the points.

    Gρ = ρ₀G,  ρ̇ = ρ∇_u − ∇_uρ,  ρ̇ + ⟨u, grad ρ⟩ = 0

By the chain rule, Ġ = G∇_u; the rate of ḠG = ρ, where ∇_u is skew, is the same.
"""

from __future__ import annotations

from ...algebra.calculus import coefficient_of, derivation, reduce
from ...algebra.forms import strip_left
from ...algebra.vector_fields import along
from ...algebra.word_trees import WordNotation
from ...algebra.words import Expr, Letter, word
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..trivialisation import varied_cauchy_green
from ..wording import say
from .fluid_letters import FluidAlphabet
from .pressure import pair_rule

RATE, BODY = Letter("ρ̇", "n", "n", 1), Letter("ρ_0", "n", "n", 1)
SLOPE = Letter("⟨u, grad ρ⟩", "n", "n", 1)
"""The derivative of ρ along u, and the product with it at each place."""
SHOWN = WordNotation(display={SLOPE: ("inner", "u", ("call", "grad", "ρ"))})


def advection(a: FluidAlphabet, c: Chapter) -> tuple[Step, ...]:
    """The step ``advection`` of a density that is carried along."""
    if not a.advected:
        return ()
    draft = c.draft("advection", "variation")
    G, rho, nabla, any_field = word(a.A.position), word(a.C), along(a.w.velocity), Letter("a", a.n)
    draft.depends_on(rho.marked(c.label("chain"), c.label("transport")))
    rate = rate_of_density(a)
    # at each place, where the product rule holds along u
    by_places = coefficient_of(
        derivation(
            rho * word(any_field), {a.C: word(SLOPE), any_field: word(nabla, any_field)}.get
        ),
        any_field,
    )
    local = reduce(rate, pair_rule((nabla, False), (a.C, False), by_places))
    return (
        draft.step(
            (
                Equation(draft.tree(G * rho), draft.tree(word(BODY) * G)),
                Equation(RATE.name, draft.tree(rate)),
                Equation(draft.tree(word(nabla) * rho), draft.tree(by_places, SHOWN)),
                Equation(draft.tree(word(RATE) - local, SHOWN), 0),
            ),
            say("advection.carried") + say("advection.place"),
        ),
    )


def rate_of_density(a: FluidAlphabet) -> Expr:
    """ρ̇ = ρ∇_u − ∇_uρ by Gρ = ρ₀G and the chain rule; ``ValueError`` where ḠG has another."""
    G, rho, turning = word(a.A.position), word(a.C), word(along(a.w.velocity))
    carried = pair_rule((BODY, False), (a.A.position, False), G * rho)
    left = derivation(G * rho - word(BODY) * G, {a.A.position: G * turning, a.C: word(RATE)}.get)
    rate = word(RATE) - strip_left(reduce(left, carried), a.A.position)
    if rate != varied_cauchy_green(a, along(a.w.velocity)):
        raise ValueError("the density is not carried along with the volume")
    return rate
