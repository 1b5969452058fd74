"""j is an isomorphism of R³ onto so(3), as the footnote says."""

from __future__ import annotations

from ..algebra.notation import tree_of
from ..algebra.space import hat, normal_form
from ..algebra.words import trace, word
from ..record.record import Equation, Step
from ..record.sentence import say
from .chapter import Chapter
from .hat import OMEGA, ZETA


def isomorphism(naming: Step, c: Chapter) -> Step:
    """Tr j(x) j(y)‾ = 2⟨x, y⟩; ``naming``: the step that says what is read by vectors."""
    draft = c.draft("isomorphism", "identification")
    draft.read(naming)
    product = word(hat(ZETA)) * word(hat(OMEGA)).bar
    return draft.step(
        (Equation(tree_of(trace(product)), draft.tree(normal_form(trace(product)))),),
        say(
            "The operator j is an isomorphism of R³ onto 𝔰𝔬(3): both have dimension 3, and "
            "j(ζ) = 0 for ζ = 0 alone."
        ),
    )
