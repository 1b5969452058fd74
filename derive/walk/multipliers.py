"""The kernel through the normal space of 𝔤 in gl(n): one multiplier, or none.

The equations hold for every ξ′ in 𝔤, so what they leave lies in the normal space, whose dimension
is the number of constraints on A.  For SL(n) it is spanned by 1, for GL(n) it is zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from ..algebra import rational as q
from ..algebra.calculus import gradient, reduce, substitute, without
from ..algebra.groups import Group
from ..algebra.notation import Notation, tree_of
from ..algebra.tree import Tree, add
from ..algebra.words import Expr, Letter, inner, number, one, word
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .cartan import rates
from .chapter import Chapter
from .gather import terms_with
from .inverse import cancelling, inverse_letter

LAMBDA = Letter("λ")


def multiplier_steps(
    inertial: Expr,
    force: Expr,
    metric: Letter,
    group: Group,
    b: Alphabet,
    uses: str,
    c: Chapter,
    translation: tuple[Equation, ...] = (),
) -> tuple[Step, ...]:
    """Ż and λ from  Tr ξ′ (residue − force)‾ = 0,  with J (or J_c) as ``metric``."""
    residue = gradient(inertial, b.Z.xi_prime)
    direction, letters, definition = _direction(group, b)
    pressed = word(LAMBDA) * direction if direction else force * 0
    lighter = Notation(display={inverse_letter(b.m): ("inv", "m")})
    balance = Equation(tree_of(residue), add(tree_of(force, lighter), tree_of(pressed)))
    left, right = word(inverse_letter(b.C)), word(inverse_letter(metric))
    free = reduce(left * (force + pressed - residue) * right, cancelling(b.C, metric))
    solved = free + word(b.Z.acceleration)
    display = {inverse_letter(x): ("inv", x.name) for x in (b.C, metric, b.m)}
    notation = Notation(display=display)
    equations = rates(b)
    if direction:
        numerator, denominator = _multiplier(solved, direction)
        ratio: Tree = ("div", tree_of(numerator, notation), tree_of(denominator, notation))
        equations.append(Equation("λ", ratio))
    equations += [Equation("Ż", tree_of(solved, notation)), *translation]
    prose = _prose(direction, letters)
    space = () if b.affine else (_in_space(solved, b, display, c),)
    return (
        c.step("multiplier", "multiplier", uses, (*definition, balance), prose),
        c.step(
            "motion",
            "solution",
            f"multiplier {uses}" if translation else "multiplier",
            equations,
            f"The equations of motion of this problem: {metric.name} is invertible where the "
            f"masses {'do not lie in one hyperplane' if b.affine else 'span the space'}"
            + (", and that Ż is in the Lie algebra gives λ." if direction else "."),
        ),
        *space,
    )


def _in_space(solved: Expr, b: Alphabet, display: Mapping[Letter, Tree], c: Chapter) -> Step:
    """α̇ = A(Ż + Z²), with C⁻¹ = A⁻¹Ā⁻¹: the acceleration of the point r is α̇r."""
    left, right = Letter("A⁻¹", b.n, b.n), Letter("Ā⁻¹", b.n, b.n)
    Z = word(b.Z.velocity)
    within = substitute(solved + Z * Z, {inverse_letter(b.C): word(left) * word(right)})
    total = reduce(word(b.A.position) * within, cancelling(b.A.position))
    shown = {**display, left: ("inv", "A"), right: ("inv", ("T", "A"))}
    return c.step(
        "space",
        "solution",
        "motion .trivialisation",
        (Equation(b.A.acceleration.name, tree_of(total, Notation(display=shown))),),
        "The same in space, by C⁻¹ = A⁻¹Ā⁻¹: A(Ż + Z²) is the acceleration of A.",
    )


def _direction(group: Group, b: Alphabet) -> tuple[Expr | None, list[Letter], list[Equation]]:
    """The normal direction as a word: 1, or a letter Λ with its value; ``None`` for GL(n)."""
    if not group.normal_space_of_linear_parts:
        return None, [], []
    normal = group.normal_direction
    n = group.n
    if normal == q.identity(n):
        return one(b.n), [], []
    letter = Letter("Λ", n, n)
    rows = tuple(("row", *(_number(x) for x in row)) for row in normal)
    return word(letter), [letter], [Equation("Λ", ("matrix", *rows))]


def _number(x: Fraction) -> Tree:
    return int(x) if x.denominator == 1 else x


def _multiplier(solved: Expr, direction: Expr) -> tuple[Expr, Expr]:
    """λ = numerator / denominator from ⟨Λ, Ż⟩ = 0."""
    total = inner(solved, direction)
    denominator = substitute(terms_with(total, LAMBDA), {LAMBDA: number(1)})
    return -without(total, LAMBDA), denominator


def _prose(direction: Expr | None, letters: list[Letter]) -> str:
    if direction is None:
        return "The equations hold for every matrix ξ′, so that its coefficient vanishes."
    if letters:
        return "The difference of the two sides is orthogonal to the Lie algebra: a multiple of Λ."
    return (
        "The difference of the two sides is orthogonal, for Tr a b̄, to every matrix of trace "
        "zero: a multiple λ of 1, the multiplier of the volume."
    )
