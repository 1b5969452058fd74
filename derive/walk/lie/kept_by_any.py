"""What motions keep where a problem has its own Lagrangian: the energy, the other momentum."""

from __future__ import annotations

from collections.abc import Sequence

from ...algebra.groups import Group
from ...language.tree import names
from ...problem.moved_entries import vanishes_on
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import Prose
from ..chapter import Chapter
from ..wording import enumerated, say
from .any_lagrangian import AnyLagrangian
from .expressed import Expressed


def kept(
    stage: Expressed,
    problem: Problem,
    group: Group,
    general: AnyLagrangian,
    balance: Sequence[Step],
    c: Chapter,
) -> tuple[Step, ...]:
    """The step of what the motion of a problem keeps, the energy and all of Π_o; none where it
    keeps neither."""
    assert problem.lagrangian is not None
    laws: Prose = ()
    equations = []
    draft = c.draft("conserved", "conservation")
    expression, momenta, energy = stage.steps
    draft.depends_on(
        general["moment_map"], next(x for x in balance if x.label == c.label("motion"))
    )
    if "t" not in names(problem.lagrangian.L):
        draft.depends_on(expression, energy)
        equations.append(Equation("ḣ", 0))
        laws += say("conserved.energy")
    forced = not all(vanishes_on(group, x) for x in stage.forces)
    whole = not forced and group.has_inner_samples  # else no exact element is known
    if whole:
        draft.depends_on(momenta)
        equations.append(Equation("Π̇_o", 0))
        laws += say("conserved.other")
    if not equations:
        return ()
    prose = say("conserved.kept_by_any", kept=enumerated(laws))
    if forced:
        prose += say("conserved.components")
    elif whole and problem.advected is not None:
        prose += say("conserved.no_element")
    return (draft.step(equations, prose + say("conserved.noether")),)
