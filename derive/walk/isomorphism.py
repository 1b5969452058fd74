"""so(3) ≅ R³: the operator j, an isomorphism as the footnote says, and the tensor of inertia."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.space import normal_form
from ..algebra.word_trees import tree_of
from ..algebra.words import Expr, trace
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .chapter import Chapter
from .hat import OMEGA, ZETA, HatMap, identified
from .wording import say


@dataclass(frozen=True)
class Axial:
    """The identification of so(3) with R³, ``hat_map``; ``inertia``: the step that says I."""

    hat_map: HatMap
    inertia: Step
    steps: tuple[Step, ...]


def axial(b: Alphabet, C: Expr, c: Chapter) -> Axial:
    """The identification by j, with the steps of j, that it is an isomorphism, and of the metric of
    J as that of I."""
    hat_map, (identification, inertia) = identified(b, C, c)
    return Axial(hat_map, inertia, (identification, isomorphism(hat_map, c), inertia))


def isomorphism(hat_map: HatMap, c: Chapter) -> Step:
    """The step Tr j(x) j(y)‾ = 2⟨x, y⟩, by which j is one to one."""
    draft = c.draft("isomorphism", "identification")
    product = hat_map.hatted(ZETA) * hat_map.hatted(OMEGA).bar
    return draft.step(
        (Equation(tree_of(trace(product)), draft.tree(normal_form(trace(product)))),),
        say("isomorphism.onto"),
    )
