"""The names of conserved quantities in emitted code, and their expressions."""

from __future__ import annotations

from collections import Counter

from ..language.tree import Tree
from .found import Found
from .symmetry import Symmetry
from .tree_matrices import full

NAMES = {
    "time": "energy",
    "translation_space": "momentum",
    "rotation_space": "angular_momentum",
    "boost": "centre",
    "translation_body": "body_momentum",
    "rotation_body": "body_angular_momentum",
}
"""What is kept by a symmetry of a kind; by another it has the name of the kind."""


def named(found: Found) -> dict[str, Tree]:
    """Name → the quantity, in Π_a, h̃, t, the entries of g and the parameters.

    ``momentum_1`` …: along an axis, if all of a kind are; else numbered; alone without a number.
    """
    bases = [NAMES.get(x.kind, x.kind) for x in found.symmetries]
    many = Counter(bases)
    axes = [axis(x) for x in found.symmetries]
    by_axis = {
        base: all(own) and len({*own}) == len(own)
        for base in many
        if (own := [a for a, b in zip(axes, bases, strict=True) if b == base])
    }
    group = found.problem.group
    assert group is not None
    momenta: list[Tree] = [("at", "Π", a) for a in range(1, group.dimension + 1)]
    names, seen = {}, Counter[str]()
    for x, base, place in zip(found.symmetries, bases, axes, strict=True):
        seen[base] += 1
        number = f"_{place}" if by_axis[base] else f"_{seen[base]}" if many[base] > 1 else ""
        names[base + number] = x.conserved(momenta, "h̃")
    return names


def axis(x: Symmetry) -> str:
    """The number of the axis along which it shifts, or about which it turns; of more dimensions
    than three the two of the plane; empty where it is along none, or not of this kind."""
    (Y, X), moving = x.still, x.moving[0]
    shown = next((m for m in (Y, X, moving) if full(m)), ())
    places = [(i + 1, j + 1) for i, row in enumerate(shown) for j, y in enumerate(row) if y != 0]
    if x.kind.startswith(("translation", "boost")):
        return str(places[0][0]) if len(places) == 1 else ""
    if not x.kind.startswith("rotation") or len(places) != 2 or places[0] != places[1][::-1]:
        return ""
    i, j = places[0]
    spatial = [factor.n for _, factor in x.group.places] == [3]
    return str(6 - i - j) if spatial else f"{i}{j}"
