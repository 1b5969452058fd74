"""The names of conserved quantities in emitted code, and their expressions: of a direction, or of a
turn of R³, the component along its unit vector."""

from __future__ import annotations

from collections import Counter

from ..language.tree import Tree, add
from .found import Found
from .scalar_lagrangian import by_state
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

CIRCULATION = "circulation"
"""What is kept by a relabelling of a body that its group deforms, be it a turn or not."""


def named(found: Found) -> dict[str, Tree]:
    """Name → the quantity, in Π_a, h̃, t, the entries of g and the parameters.

    ``momentum_1`` …: along an axis, if all of a kind are; else numbered; alone without a number.
    """
    relabelled = [found.of_points and relabels(x) for x in found.symmetries]
    bases = [
        CIRCULATION if is_one else NAMES.get(x.kind, x.kind)
        for x, is_one in zip(found.symmetries, relabelled, strict=True)
    ]
    many = Counter(bases)
    axes = [
        axis_of_relabelling(x) if is_one else axis(x)
        for x, is_one in zip(found.symmetries, relabelled, strict=True)
    ]
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
        value, length = x.conserved(momenta, "h̃"), length_of(x)
        plain = length == 1 or base == CIRCULATION
        names[base + number] = value if plain else ("div", value, length)
    return names


def length_of(x: Symmetry) -> Tree:
    """The length of the vector along which it shifts, or about which it turns R³, in the parameters
    that the vector has; 1 of any other."""
    shown = next((m for m in (*x.still, x.moving[0]) if full(m)), ())
    shifts = x.kind.startswith(("translation", "boost"))
    if not shifts and not x.kind.startswith(("rotation", "displacement")):
        return 1
    for offset, factor in x.group.places:
        rows = range(offset, offset + factor.n)
        pairs = [(i, offset + factor.n) for i in rows if factor.affine] if shifts else []
        if not shifts and factor.n == 3:
            pairs = [(i, j) for i in rows for j in rows if i < j]
        entries = [shown[i][j] for i, j in pairs if shown[i][j] != 0]
        if entries:
            square = by_state(add(*(("pow", y, 2) for y in entries)))
            return 1 if square == 1 else ("fun", "sqrt", square)
    return 1


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
    return _axis_of_plane(x, *places[0])


def relabels(x: Symmetry) -> bool:
    """Of a body of points: does it change their labels alone, δA = −AX with XJ + JX̄ = 0?

    ½ Tr(Z J Z̄ C) is left as it is where Tr Z(XJ + JX̄)Z̄C = 0; with all Z = uv̄, ⟨u, v⟩ = 0, among
    the velocities, as where all maps that keep the volume are in the group, XJ + JX̄ = 0.
    """
    if x.kind not in ("rotation_body", "deformation_body"):
        return False
    X = x.still[1]
    return all(
        factor.keeps_no_more_than_volume
        for offset, factor in x.group.places
        if full([row[offset : offset + factor.size] for row in X])
    )


def axis_of_relabelling(x: Symmetry) -> str:
    """That of the skew W in X = WJ⁻¹, by the rows of X; empty where W turns more than a plane."""
    rows = [i for i, row in enumerate(x.still[1], 1) if any(by_state(y) != 0 for y in row)]
    return _axis_of_plane(x, *rows) if len(rows) == 2 else ""


def _axis_of_plane(x: Symmetry, i: int, j: int) -> str:
    """The number of the axis of R³ about which a plane turns, else the two numbers of the plane."""
    spatial = [factor.n for _, factor in x.group.places] == [3]
    return str(6 - i - j) if spatial else f"{i}{j}"
