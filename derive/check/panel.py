"""What is said of any group: the groups on which it is tried, and how many n are enough.

Both sides of such a claim are sums of contractions: traces of words, pairings.  On GL(n), where the
letters are free, those with 2m indices are perfect matchings of these, which are independent for
n ≥ m (second fundamental theorem of the invariants of O(n)): a relation that holds for one such n
has no coefficient that is not 0, so that it holds for each.  Traces of 1 make the coefficients
polynomials in n of degree e at most: 0 if they vanish for e + 1 of these n.  The inverse of a
letter is a letter: the words are reduced.  Some small groups in which letters are tied to one
another come first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache, partial
from typing import Any

from ..algebra.families import LARGEST, group, turning_about_a_point
from ..algebra.groups import Group
from ..algebra.stated_basis import group_of_basis
from ..language import rational as q
from ..language.show import show
from ..language.tree import Tree
from ..record.record import RecordError
from .counted import Grade


def triangular() -> Group:
    """The upper triangular maps of the plane."""
    return group_of_basis("B(2)", "linear", [q.unit(2, *at) for at in ((0, 0), (0, 1), (1, 1))])


def triangular_affine() -> Group:
    """The same with the translations along the first axis."""
    basis = [q.unit(3, *at) for at in ((0, 0), (0, 1), (1, 1), (0, 2))]
    return group_of_basis("B(2) ⋉ R", "affine", basis)


PANELS: dict[str, tuple[Callable[[], Group], ...]] = {
    "linear": (triangular, *(partial(group, x) for x in ("SO(3)", "SL(3)"))),
    "affine": (triangular_affine, partial(group, "SE(2)"), turning_about_a_point),
}
"""By the action: some with relations, one whose translations are not free, one whose Lie algebra
has neither transposes nor odd powers.  The one without relations has as large an n as is needed."""

FREE = {"linear": "GL", "affine": "Aff"}
LEAST = 6
"""As large as the words of the walk need: one point serves them all."""


@cache
def panel(action: str) -> tuple[Group, ...]:
    """Those with relations."""
    return tuple(make() for make in PANELS[action])


@cache
def free(action: str, n: int) -> Group:
    """That without relations, for one n."""
    return group(f"{FREE[action]}({n})")


def sizes(grade: Grade) -> range:
    """As many n as a claim needs, each large enough; ``RecordError`` where there are too few."""
    if not grade.degree:
        raise RecordError("it says nothing of any group, but of n alone")
    first = max(LEAST, -(-grade.slots // 2))
    if first + grade.loops > LARGEST:
        raise RecordError(
            f"traces of words of degree {-(-grade.slots // 2)}, with {grade.loops} of 1, are not "
            f"independent for the n that are tried, up to {LARGEST}"
        )
    return range(first, first + grade.loops + 1)


LETTERS = ("A", "C", "J", "J_c", "m", "t", "δt", "δ′t", ("at", "m", "i"))
"""Of which an inverse is a letter, or a number; of J and J_c, of which one is free, the one."""
OF_ONE_SPACE = ("det", "hat", "wedge", "matrix", "row", "par", "fun")


def unsayable(t: Tree) -> str:
    """What of a tree is no word in the letters of any group, for any n; empty where all are."""
    return next((f"{show(x)[:80]} is of no group but a given one" for x in _foreign(t)), "")


def _foreign(t: Tree) -> Iterator[Tree]:
    if not isinstance(t, tuple):
        return
    numbered = t[0] == "entry" and any(isinstance(i, int) for i in t[2:])
    if t[0] in OF_ONE_SPACE or numbered or not all(map(_word, inverted(t))):
        yield t
    for x in t[1:]:
        yield from _foreign(x)


def inverted(t: tuple[Any, ...]) -> tuple[Tree, ...]:
    """What an operator inverts."""
    if t[0] == "div":
        return t[2:]
    return t[1:2] if t[0] == "inv" or (t[0] == "pow" and int(t[2]) < 0) else ()


def _word(t: Tree) -> bool:
    """A product of letters that have inverses, and numbers."""
    if isinstance(t, tuple) and t[0] in ("mul", "T", "pow", "inv"):
        return all(map(_word, t[1:]))
    return t in LETTERS or not isinstance(t, (str, tuple))
