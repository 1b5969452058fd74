"""The groups on which a claim about any group is tried, and how many n are enough.

Both sides of such a claim are sums of contractions: traces of words, pairings. On GL(n), where the
letters are free, those with 2m indices are perfect matchings of these, which are independent for n
≥ m (second fundamental theorem of the invariants of O(n)): a relation that holds for one such n has
no coefficient that is not 0, so that it holds for each. Traces of 1 make the coefficients
polynomials in n of degree e at most: 0 if they vanish for e + 1 of these n. The inverse of a letter
is a letter: the words are reduced. Some small groups in which letters are tied to one another come
first.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import Any

from ..algebra.families import LARGEST, group, turning_about_a_point
from ..algebra.groups import Group
from ..algebra.stated_basis import group_of_basis
from ..language import rational as q
from ..language.show import show
from ..language.tree import Tree, nodes
from ..record.record import RecordError
from .grades import Grade


def triangular() -> Group:
    """B(2), the upper triangular maps of the plane."""
    return group_of_basis("B(2)", "linear", [q.unit(2, *at) for at in ((0, 0), (0, 1), (1, 1))])


def triangular_affine() -> Group:
    """B(2) ⋉ R: upper triangular maps of the plane, and translations along its first axis."""
    basis = [q.unit(3, *at) for at in ((0, 0), (0, 1), (1, 1), (0, 2))]
    return group_of_basis("B(2) ⋉ R", "affine", basis)


TRIED: dict[str, tuple[Callable[[], Group], ...]] = {
    "linear": (triangular, *(partial(group, x) for x in ("SO(3)", "SL(3)"))),
    "affine": (triangular_affine, partial(group, "SE(2)"), turning_about_a_point),
}
"""By the action, small groups with relations: also one whose translations are not free, and one
whose Lie algebra has neither transposes nor odd powers. GL(n) or Aff(n), without relations, is
tried besides for as large an n as is needed."""

FREE = {"linear": "GL", "affine": "Aff"}
LEAST = 6
"""The least n of a free group that is tried, as large as the words of the walk need: one point
serves them all."""
LEAST_BY_MOMENTA = 3
"""The same where the longest word is a momentum paired with a bracket."""


@cache
def groups_with_relations(action: str) -> tuple[Group, ...]:
    """The groups with relations on which a claim for an action, "linear" or "affine", is tried."""
    return tuple(make() for make in TRIED[action])


@cache
def free(action: str, n: int) -> Group:
    """The group without relations of an action, GL(n) or Aff(n)."""
    return group(f"{FREE[action]}({n})")


def sizes(grade: Grade, least: int = LEAST) -> range:
    """As many n, from ``least`` on, as prove a claim of this grade for all n, each large enough;
    ``RecordError`` where the largest would be too large."""
    if not grade.degree:
        raise RecordError("it says nothing of any group, but of n alone")
    first = max(least, -(-grade.slots // 2))
    if first + grade.loops > LARGEST:
        raise RecordError(
            f"traces of words of degree {-(-grade.slots // 2)}, with {grade.loops} of 1, are not "
            f"independent for the n that are tried, up to {LARGEST}"
        )
    return range(first, first + grade.loops + 1)


LETTERS = ("A", "C", "J", "J_c", "g_1", "h", "m", "t", "δt", "δ′t", ("at", "m", "i"))
"""The names whose inverse is a letter again, or a number; of J and J_c one is free, and only
one."""
OF_ONE_SPACE = ("det", "hat", "wedge", "matrix", "row", "par", "fun")


def fault_for_any_group(t: Tree) -> str:
    """Why a tree is no word in the letters of any group, for any n, in words; "" if it is one."""
    foreign = (x for x in nodes(t) if isinstance(x, tuple) and _foreign(x))
    return next((f"{show(x)[:80]} is of no group but a given one" for x in foreign), "")


def _foreign(t: tuple[Any, ...]) -> bool:
    """Is the operator of a tree, or what it inverts, not of the letters of any group?"""
    numbered = t[0] == "entry" and any(isinstance(i, int) for i in t[2:])
    return t[0] in OF_ONE_SPACE or numbered or not all(map(_word, inverted(t)))


def inverted(t: tuple[Any, ...]) -> tuple[Tree, ...]:
    """The operands that an operator inverts or divides by."""
    if t[0] == "div":
        return t[2:]
    return t[1:2] if t[0] == "inv" or (t[0] == "pow" and int(t[2]) < 0) else ()


def _word(t: Tree) -> bool:
    """Is the tree a product of letters that have inverses, and of numbers?"""
    if isinstance(t, tuple) and t[0] in ("mul", "T", "pow", "inv"):
        return all(map(_word, t[1:]))
    return t in LETTERS or not isinstance(t, (str, tuple))
