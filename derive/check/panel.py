"""The groups on which a claim about any group is tried."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial

from ..algebra import rational as q
from ..algebra.families import group, turning_about_a_point
from ..algebra.given import group_of_basis
from ..algebra.groups import Group


def triangular() -> Group:
    """The upper triangular maps of the plane."""
    return group_of_basis("B(2)", "linear", [q.unit(2, *at) for at in ((0, 0), (0, 1), (1, 1))])


def triangular_affine() -> Group:
    """The same with the translations along the first axis."""
    basis = [q.unit(3, *at) for at in ((0, 0), (0, 1), (1, 1), (0, 2))]
    return group_of_basis("B(2) ⋉ R", "affine", basis)


PANELS: dict[str, tuple[Callable[[], Group], ...]] = {
    "linear": (*(partial(group, x) for x in ("GL(4)", "SL(3)", "SO(3)")), triangular),
    "affine": (
        *(partial(group, x) for x in ("Aff(3)", "SE(2)")),
        turning_about_a_point,
        triangular_affine,
    ),
}
"""By the action: one without relations, some with, one whose translations are not free, one whose
Lie algebra has neither transposes nor odd powers."""


@cache
def panel(action: str) -> tuple[Group, ...]:
    """The groups themselves, made once."""
    return tuple(make() for make in PANELS[action])
