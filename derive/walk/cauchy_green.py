"""Where C is not 𝟏, and drops out of the metric nevertheless: Tr ξJZ̄C = Tr ξJZ̄ on 𝔤.

For every body, where ξ̄CZ = ξ̄Z on 𝔤: products of groups with skew linear parts, on (r, 1).  Or for
some: the points of a flat body under a shear.  The forces of a potential keep their C.
"""

from __future__ import annotations

from ..algebra.calculus import map_traces
from ..algebra.words import Expr, Word, expr_of_word, trace
from ..problem.left_invariant import EVERY, Bodies
from ..record.record import Equation, stated
from ..record.sentence import Prose
from .alphabet import Alphabet
from .chapter import Draft
from .wording import say


def without_cauchy_green(e: Expr, bodies: Bodies, a: Alphabet) -> Expr:
    """A scalar with 1 for each C that drops out of the metric: those between a barred letter of 𝔤
    and a plain one."""
    algebra = {x.name for f in a.algebra_parts for x in (f.velocity, f.xi, f.xi_prime)}
    algebra |= {
        x.name for f in a.algebra_parts for x in (f.d_velocity, f.dp_velocity, f.acceleration)
    }

    def drops(cycle: Word, k: int) -> bool:
        before, after = cycle[k - 1], cycle[(k + 1) % len(cycle)]
        between = before[0].name in algebra and before[1]
        between = between and after[0].name in algebra and not after[1]
        return between and (bodies == EVERY or {x.name for x, _ in cycle} - algebra == {"C", "J"})

    def left(cycle: Word) -> Expr:
        kept = tuple(x for k, x in enumerate(cycle) if x[0] != a.C or not drops(cycle, k))
        return trace(expr_of_word(kept))

    return map_traces(e, left)


def metric_equations(bodies: Bodies) -> list[Equation]:
    """The equation by which C drops out of the metric on 𝔤: for every body, or for this one."""
    return stated("ξ̄CZ = ξ̄Z" if bodies == EVERY else "Tr ξJZ̄C = Tr ξJZ̄")


def metric_prose(bodies: Bodies, draft: Draft) -> Prose:
    """The sentence of a step for :func:`metric_equations`."""
    if bodies == EVERY:
        return say("relation.lengths")
    return draft.claim("relation.left_invariant")
