"""When a motion separates into those of the linear parts and of the centre of mass (Exercise 2).

With  R = T + A c / m  in place of T the kinetic energy is always a sum of the two; the motion
separates where the potential is one as well.
"""

from __future__ import annotations

from ..algebra.calculus import substitute, terms_with, without
from ..algebra.word_trees import WordNotation
from ..algebra.words import Expr, Letter, word
from ..language.read import read
from ..problem.problem import Problem
from ..record.record import Equation, Step, stated
from ..record.sentence import Prose, listed
from .alphabet import Alphabet
from .chapter import Chapter
from .contraction import AND
from .inverse import cancel_scalar, inverse_letter
from .potential import U_Q, Potentials
from .translation import central_moments
from .wording import phrase, say


def _notation(a: Alphabet) -> WordNotation:
    return WordNotation(display={inverse_letter(a.m): read("m⁻¹")})


def _centred(e: Expr, a: Alphabet, mark: str = "") -> Expr:
    """An expression with T and τ by the centre of mass R, Ṙ, and J by J_c; ``mark``: the step that
    says so."""
    moment, value = central_moments(a)
    lighter, first = word(inverse_letter(a.m)), word(a.c)
    place, rate = Letter("R", a.n), Letter("Ṙ", a.n)
    images = {
        a.T.position: word(place) - lighter * word(a.A.position) * first,
        a.T.velocity: word(rate) - lighter * word(a.A.velocity) * first,
        a.J: word(moment) + word(a.J) - value,
    }
    if mark:
        images = {x: y.marked(mark) for x, y in images.items()}
    return cancel_scalar(substitute(e, images), a.m)


def kinetic_separation(kinetic: Expr, a: Alphabet, c: Chapter) -> Step:
    """The step that writes L̃ by the centre of mass: no term has both α and Ṙ."""
    draft = c.draft("separation", "identification")
    equations = (
        *stated("R = T + m⁻¹Ac,  Ṙ = τ + m⁻¹αc"),
        Equation("J_c", draft.tree(central_moments(a)[1], _notation(a))),
        Equation("L̃", draft.tree(_centred(kinetic, a) - word(a.U), _notation(a))),
    )
    return draft.step(
        equations,
        say("separation.kinetic") + say("separation.condition"),
    )


def potential_separation(
    problem: Problem, v: Potentials, b: Alphabet, c: Chapter
) -> tuple[Step, ...]:
    """The step that writes Ũ by the centre of mass, and says whether the motion of this problem
    separates; none where Ũ is no sum of such terms."""
    if any(b.T.position in x.value.letters() for x in v.own):
        return ()  # a function of T that is no sum
    draft = c.draft("separation", "identification")
    energy = _centred(v.energy, b, Chapter(b.chapter).label("separation"))
    place = Letter("R", b.n)
    inside = v.pointwise.shifts
    both = bool(terms_with(terms_with(energy, place), b.A.position))
    rest = bool(without(energy, U_Q)) and not both
    prose = _prose(
        problem, decided=inside and not both, rest=rest, pointwise=bool(v.pointwise.energies)
    )
    return (draft.step((Equation("Ũ", draft.tree(energy, _notation(b))),), prose),)


def _prose(problem: Problem, *, decided: bool, rest: bool, pointwise: bool) -> Prose:
    damping = [phrase("separation.damping")] if problem.damping else []
    outside = damping + ([phrase("separation.inputs")] if problem.inputs else [])
    if not decided:
        prose = say("separation.pointwise")
        if rest:
            prose += say("separation.rest")
        if outside:
            prose += say(
                "separation.outside_too",
                forces=listed(AND, outside),
            )
        return prose
    if outside:
        prose = say(
            "separation.outside",
            forces=listed(AND, outside),
        )
    else:
        prose = say("separation.separates")
    if pointwise:
        prose += say("separation.differences")
    return prose
