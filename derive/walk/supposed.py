"""What the walk supposes: hypotheses as data, and the words for them, by the sign of the masses.

With positive masses the metric of the kinetic energy is definite on the group.  Without that it is
a quadratic form, degenerate for some bodies and, where it changes from place to place, at some
elements of the group: then the steps hold wherever it is invertible, and say so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction

from ..algebra.calculus import derivation, substitute
from ..algebra.words import Expr, Letter, word
from ..algebra.written import Notation, metrics, tree_of
from ..language.read import read
from ..language.tree import Tree, nodes, operands
from ..record.hypotheses import Hypothesis
from ..record.record import Step
from ..record.sentence import Prose, Sentence, say
from .alphabet import Alphabet

WORDS: dict[str, tuple[str, str]] = {
    "kinetic energy": (
        "From here on the masses are positive and no tangent vector of the group but 0 leaves all "
        "the points at rest: the kinetic energy is then half the square of a norm, a metric on the "
        "group.",
        "Masses may be negative here: the kinetic energy is half the value of a quadratic form, "
        "which is called the metric; what follows holds wherever it is invertible on the tangent "
        "vectors of the group.",
    ),
    "velocity of X": (
        "As {regular}, this expression vanishes for all such variations only if X has the velocity "
        "of the motion, which is inserted; {rates}.",
        "Wherever {regular}, this expression vanishes for all such variations only if X has the "
        "velocity of the motion, which is inserted; {rates}.",
    ),
    "metric of a displacement": (
        "the metric is not degenerate (the masses are not all on one line)",
        "the metric is not degenerate",
    ),
    "metric of a rotation": (
        "the tensor I is invertible (the masses are not all on one line through the fixed point)",
        "the tensor I is invertible",
    ),
    "line": (
        "With δt = 0 the same two tests leave X = 0: the kernel is a line.",
        "With δt = 0 the same two tests leave X = 0 wherever the metric is invertible: there the "
        "kernel is a line.",
    ),
    "mass": (
        "As m > 0, the balance of forces gives ẇ; inserted into the balance of moments, it makes "
        "I_c appear there, the tensor of inertia about the centre of mass r_c, which follows from "
        "J_c as I does from J.",
        "Wherever m is not 0, the balance of forces gives ẇ; inserted into the balance of "
        "moments, it makes I_c appear there, the tensor of inertia about the centre of mass r_c, "
        "which follows from J_c as I does from J.",
    ),
    "mass of a map": (
        "As the group has every translation, the coefficient of η′ gives ẇ; put into that of ξ′, "
        "it leaves the equations of the linear parts about the centre of mass r_c, with the "
        "moments of masses and forces about it; here ξ′ runs over the linear parts of 𝔤.",
        "As the group has every translation, the coefficient of η′ gives ẇ wherever m is not 0; "
        "put into that of ξ′, it leaves the equations of the linear parts about the centre of mass "
        "r_c, with the moments of masses and forces about it; here ξ′ runs over the linear parts "
        "of 𝔤.",
    ),
    "Euler": (
        "Euler's equations, solved for the angular acceleration: the tensor I is invertible.",
        "Euler's equations, solved for the angular acceleration wherever the tensor I is "
        "invertible.",
    ),
    "rotation": (
        "The equations of motion of this problem, solved for the accelerations: the tensor I is "
        "invertible where the masses are not all on one line through the fixed point.",
        "The equations of motion of this problem, solved for the accelerations wherever the "
        "tensor I is invertible.",
    ),
    "displacement": (
        "The equations of motion of this problem, solved for the accelerations: the tensor I_c is "
        "invertible where the masses are not all on one line.",
        "The equations of motion of this problem, solved for the accelerations wherever the "
        "tensor I_c is invertible and m is not 0.",
    ),
    "affine maps of a volume": (
        "The equations of motion of this problem: {metric} is invertible where the masses do not "
        "lie in one hyperplane, and that Ż is in the Lie algebra gives θ.",
        "The equations of motion of this problem, wherever m is not 0, {metric} is invertible and "
        "θ has a value: that Ż is in the Lie algebra gives it.",
    ),
    "affine maps": (
        "The equations of motion of this problem: {metric} is invertible where the masses do not "
        "lie in one hyperplane.",
        "The equations of motion of this problem, wherever m is not 0 and {metric} is invertible.",
    ),
    "maps of a volume": (
        "The equations of motion of this problem: {metric} is invertible where the masses span the "
        "space, and that Ż is in the Lie algebra gives θ.",
        "The equations of motion of this problem, wherever {metric} is invertible and θ has a "
        "value: that Ż is in the Lie algebra gives it.",
    ),
    "maps": (
        "The equations of motion of this problem: {metric} is invertible where the masses span the "
        "space.",
        "The equations of motion of this problem, wherever {metric} is invertible.",
    ),
    "places": (
        "The places of the points tell g where they span the space: g_t is then the only element "
        "that moves the body so, and is as smooth in t as they are.",
        "The places of the points tell g wherever J is invertible: g_t is then the only element "
        "that moves the body so, and is as smooth in t as they are.",
    ),
    "affine places": (
        "The places of the points tell g where they are not in one hyperplane: g_t is then the "
        "only element that moves the body so, and is as smooth in t as they are.",
        "The places of the points tell g wherever m is not 0 and J_c is invertible: g_t is then "
        "the only element that moves the body so, and is as smooth in t as they are.",
    ),
    "mass matrix": (
        "M is invertible where no direction of the group leaves every mass in its place.",
        "They are solved for the ζ̇_b wherever M is invertible.",
    ),
    "moments": (
        "The moments of the body are parameters: those of some positive masses.",
        "The moments of the body are parameters: those of some masses, which may be negative.",
    ),
}
"""What is said where the masses are positive, and where they may be of any sign."""

ALWAYS = ("A", "C", read("Ā"))
"""The element of the group and C = ĀA have inverses."""


def told(what: str, signed: bool, **places: Sentence | str) -> Prose:
    """The words for a hypothesis; ``signed``: masses may be negative."""
    return say(WORDS[what][signed], **places)


# -- data ----------------------------------------------------------------------------------------


def kinetic_metric(kinetic: Expr, a: Alphabet) -> Hypothesis:
    """The form ⟨δg, δ′g⟩ whose half at δg = δ′g = ν is the kinetic energy: not degenerate."""
    form = derivation(kinetic, {p.velocity: word(p.d_position) for p in a.parts}.get)
    form = substitute(form, {p.velocity: word(p.dp_position) for p in a.parts})
    return regular(tree_of(form, metrics() if a.affine else metrics("J")), "T_g G")


def regular(form: Tree, space: str) -> Hypothesis:
    """A form on a space is not degenerate; of ⟨Ω, Ω′⟩_I this says that I has an inverse."""
    if isinstance(form, tuple) and form[0] == "metric" and {*form[2:]} == {"Ω", "Ω′"}:
        return Hypothesis("invertible", form[1])
    return Hypothesis("nondegenerate", form, space)


def vertical_metric(
    vertical: Expr, horizontal: Mapping[Letter, Expr], notation: Notation, space: str
) -> Hypothesis:
    """The metric as it stands in −dϖ(δ, δ′) for a δ′ that varies the velocity alone.

    ``horizontal``: δ′v ↦ δ′x, of the same kind.
    """
    return regular(tree_of(-substitute(vertical, horizontal), notation), space)


def of_masses(a: Alphabet) -> tuple[Hypothesis, ...]:
    """The masses are positive, unless they may have any sign."""
    return () if a.signed else (Hypothesis("positive", read("mᵢ")),)


def of_moments(signed: bool) -> tuple[Hypothesis, ...]:
    """m, c, J are those of some positive masses: m > 0, and J − m⁻¹cc̄ has no negative square."""
    if signed:
        return ()
    return Hypothesis("positive", "m"), Hypothesis("semidefinite", read("J − m⁻¹cc̄"))


MATRICES = frozenset({"J", "J_c", "I", "I_c", "M"})
"""What is inverted and no number."""


def supposing(step: Step) -> Step:
    """The step with the hypotheses of all that its equations divide by, or invert."""
    trees = (t for e in step.equations for side in (e.lhs, e.rhs) for t in _inverted(side))
    needed = (Hypothesis("invertible" if _matrix(t) else "nonzero", t) for t in trees)
    return replace(step, hypotheses=tuple(dict.fromkeys((*step.hypotheses, *needed))))


def _matrix(t: Tree) -> bool:
    return _matrix(t[1]) if isinstance(t, tuple) and t[0] == "add" else t in MATRICES


def supposing_all(steps: Iterable[Step]) -> tuple[Step, ...]:
    """Every step with what it inverts."""
    return tuple(map(supposing, steps))


def _inverted(t: Tree) -> Iterator[Tree]:
    """What stands in a denominator, or is inverted; numbers and the group's element apart."""
    if not isinstance(t, tuple):
        return
    for x in operands(t):
        yield from _inverted(x)
    inverse = t[0] in ("inv", "div") or (t[0] == "pow" and t[2] < 0)
    below = t[2] if t[0] == "div" else t[1] if inverse else 1
    if below not in ALWAYS and not _constant(below):
        yield below


def _constant(t: Tree) -> bool:
    """A number, as it stands."""
    leaves = (x for x in nodes(t) if not operands(x))
    return all(x == "π" or isinstance(x, (int, Fraction)) or x == ("one",) for x in leaves)
