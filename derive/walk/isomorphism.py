"""j is an isomorphism of R³ onto so(3), as the footnote says."""

from __future__ import annotations

from ..algebra.space import normal_form
from ..algebra.words import trace
from ..algebra.written import tree_of
from ..record.record import Equation, Step
from ..record.sentence import say
from .chapter import Chapter
from .hat import OMEGA, ZETA, Reader


def isomorphism(read: Reader, c: Chapter) -> Step:
    """Tr j(x) j(y)‾ = 2⟨x, y⟩."""
    draft = c.draft("isomorphism", "identification")
    product = read.hatted(ZETA) * read.hatted(OMEGA).bar
    return draft.step(
        (Equation(tree_of(trace(product)), draft.tree(normal_form(trace(product)))),),
        say(
            "The operator j is an isomorphism of R³ onto 𝔰𝔬(3): both have dimension 3, and "
            "j(ζ) = 0 for ζ = 0 alone."
        ),
    )
