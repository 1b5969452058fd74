"""The forces of a problem at g₁: N₁ and f₁ on words, as its potential gives them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from ...algebra.calculus import derivation, gradient, reduce, substitute
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation
from ...algebra.words import Expr, Letter, word
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ..alphabet import Alphabet
from ..body import body_step
from ..chapter import Chapter
from ..inverse import cancelling, inverse_letter
from ..potential import Potentials, potentials
from ..wording import say
from .discrete_letters import DiscreteAlphabet


@dataclass(frozen=True)
class DiscreteForces:
    """``moments`` N₁ and ``resultant`` f₁ on words in g₁, or A₁, and its ``inverse``;
    ``potential``: on words in A and T, of ``letters``, which the step ``place`` says."""

    moments: Expr
    resultant: Expr
    potential: Potentials
    letters: Alphabet
    notation: WordNotation
    inverse: Expr
    place: Step
    steps: tuple[Step, ...]


def forces(
    problem: Problem, group: Group, general: DiscreteAlphabet, a: Alphabet, c: Chapter
) -> DiscreteForces:
    """The numbers of the body, the potential where A is that of g₁, and its forces there.

    ``general``: the letters of any group, for the name of their chapter.
    """
    place: tuple[str, ...] = ("A_1", "T_1") if group.affine else ("g_1",)
    naming, acting = c.draft("place", "definition"), c.draft("force", "variation")
    located = [*zip(a.parts, place, strict=True)]
    parts = (Equation(x.position.name, y) for x, y in located)
    named = naming.step(parts, say("place.discrete"))
    v = potentials(problem, a, c)
    heard = {f"{a.chapter}.action": named.label}
    heard[f"{a.chapter}.moments"] = Chapter(general.chapter).label("moments")
    told = tuple(_hearing(x, heard) for x in v.steps)
    back, moved = inverse_letter(a.A.position), (a.A.d_position, a.T.d_position)
    eta = word(back) * word(moved[1]) if a.affine else None
    images = v.moved(a, word(back) * word(moved[0]), eta)
    work = reduce(-derivation(v.energy, images.get), cancelling(a.A.position))
    here = {x.position: word(replace(x.position, name=y)) for x, y in located}
    inverse = Letter(f"{place[0]}⁻¹", a.n, a.n)
    turned = "orthogonal" in group.relations
    here[back] = here[a.A.position].bar if turned else word(inverse)
    moments, resultant = (substitute(gradient(work, x), here) for x in moved)
    notation = WordNotation(display={inverse: ("inv", place[0])})
    equations = [Equation("U_1", "Ũ"), Equation("N_1", acting.tree(moments, notation))]
    if a.affine:
        equations.append(Equation("f_1", acting.tree(resultant, notation)))
    steps = (
        *body_step(problem, None, a, c),
        named,
        *told,
        acting.step(equations, say("force.at_element")),
    )
    moments, resultant = acting.mark(moments), acting.mark(resultant)
    return DiscreteForces(moments, resultant, v, a, notation, here[back], named, steps)


def _hearing(step: Step, heard: Mapping[str, str]) -> Step:
    """A step of the continuous walk by the steps of this record that say what it uses."""
    return replace(step, uses=tuple(dict.fromkeys(heard.get(x, x) for x in step.uses)))
