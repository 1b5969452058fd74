"""What the walk supposes: hypotheses as data, by the sign of the masses.

With positive masses the metric of the kinetic energy is definite on the group.  Without that it is
a quadratic form, degenerate for some bodies and, where it changes from place to place, at some
elements of the group: then the steps hold wherever it is invertible, and say so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction

from ..algebra.calculus import derivation, substitute
from ..algebra.word_trees import WordNotation, metrics, tree_of
from ..algebra.words import Expr, Letter, word
from ..language.read import read
from ..language.tree import Tree, nodes, operands
from ..record.record import Hypothesis, Step
from .alphabet import Alphabet

ALWAYS = ("A", "C", read("Ā"), "g_1", ("T", "g_1"), "A_1", ("T", "A_1"))
"""The element of the group and C = ĀA, which have inverses without a hypothesis."""


# -- data ----------------------------------------------------------------------------------------


def kinetic_metric(kinetic: Expr, a: Alphabet) -> Hypothesis:
    """The hypothesis that the form ⟨δg, δ′g⟩ is not degenerate, half of which at δg = δ′g = ν is
    the kinetic energy."""
    form = derivation(kinetic, {p.velocity: word(p.d_position) for p in a.parts}.get)
    form = substitute(form, {p.velocity: word(p.dp_position) for p in a.parts})
    return regular(tree_of(form, metrics() if a.affine else metrics("J")), "T_g G")


def regular(form: Tree, space: str) -> Hypothesis:
    """The hypothesis that a form on a space is not degenerate; of ⟨Ω, Ω′⟩_I that I has an
    inverse."""
    if isinstance(form, tuple) and form[0] == "metric" and {*form[2:]} == {"Ω", "Ω′"}:
        return Hypothesis("invertible", form[1])
    return Hypothesis("nondegenerate", form, space)


def vertical_metric(
    vertical: Expr, horizontal: Mapping[Letter, Expr], notation: WordNotation, space: str
) -> Hypothesis:
    """The hypothesis that the metric is not degenerate, as it stands in −dϖ(δ, δ′) for a δ′ that
    varies the velocity alone.

    ``horizontal``: δ′v ↦ δ′x, of the same kind.
    """
    return regular(tree_of(-substitute(vertical, horizontal), notation), space)


def of_masses(a: Alphabet) -> tuple[Hypothesis, ...]:
    """The hypothesis that the masses are positive; none where they may have any sign."""
    return () if a.signed else (Hypothesis("positive", read("mᵢ")),)


def of_moments(signed: bool) -> tuple[Hypothesis, ...]:
    """The hypotheses that m, c, J are those of some positive masses: m > 0, and J − m⁻¹cc̄ has no
    negative square; none where masses may be negative."""
    if signed:
        return ()
    return Hypothesis("positive", "m"), Hypothesis("semidefinite", read("J − m⁻¹cc̄"))


MATRICES = frozenset({"J", "J_c", "J_D", "I", "I_c", "M", "K_G"})
"""The names that are matrices, among those that are inverted."""


def supposing(step: Step) -> Step:
    """The step with hypotheses for all that its equations divide by, or invert."""
    trees = (t for e in step.equations for side in (e.lhs, e.rhs) for t in _inverted(side))
    needed = (Hypothesis("invertible" if _matrix(t) else "nonzero", t) for t in trees)
    return replace(step, hypotheses=tuple(dict.fromkeys((*step.hypotheses, *needed))))


def _matrix(t: Tree) -> bool:
    if isinstance(t, tuple):
        return t[0] == "matrix" or (t[0] == "add" and _matrix(t[1]))
    return t in MATRICES


def supposing_all(steps: Iterable[Step]) -> tuple[Step, ...]:
    """Every step with hypotheses for what it divides by, or inverts."""
    return tuple(map(supposing, steps))


def _inverted(t: Tree) -> Iterator[Tree]:
    """The trees that stand in a denominator of a tree, or are inverted; without numbers, A
    and C."""
    if not isinstance(t, tuple):
        return
    for x in operands(t):
        yield from _inverted(x)
    inverse = t[0] in ("inv", "div") or (t[0] == "pow" and t[2] < 0)
    below = t[2] if t[0] == "div" else t[1] if inverse else 1
    if below not in ALWAYS and not _constant(below):
        yield below


def _constant(t: Tree) -> bool:
    """Is a tree a number as it stands, made of numbers and π alone?"""
    leaves = (x for x in nodes(t) if not operands(x))
    return all(x == "π" or isinstance(x, (int, Fraction)) or x == ("one",) for x in leaves)
