"""A figure of the body of a problem, from its record: points, solids, springs, forces; of a stated
Lagrangian the ellipsoids of inertia that stand for its body.

A schematic drawing in an upright parallel view; :mod:`figure` prints it as SVG or TikZ.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from ...language.tree import Tree, replaced
from ...language.values import approximate
from ...record.as_json import decode
from ...record.record import Derivation
from ...record.sentence import Prose, say
from ...schema.potential_kinds import kinds
from .drawing import Box, Label, Point, Scene, arrow, from_segment
from .drawn_body import (
    FLAT,
    LARGEST,
    ORIGIN,
    UNITS,
    BodyPart,
    DrawnSolid,
    ExpressionValues,
    Vector,
    View,
    Wish,
    cholesky,
    parts,
    placed,
    plus,
    ranked,
)
from .panels import Panel, Sheet, draw, heaviest, named_forces, shows_centre

SIZES = {"SO(3)": 3, "SE(3)": 4}
"""The factors that turn a body of space, and the size of their matrices."""
THINNEST = 0.02
"""The least thickness of an ellipsoid that is drawn, in its largest."""


def turns(offset: int) -> list[dict[tuple[int, int], int]]:
    """The entries of the matrices that turn about e_1, e_2, e_3, for the factor of a product whose
    entries begin at ``offset``, from 0."""
    pairs = ((offset + (i + 1) % 3, offset + (i + 2) % 3) for i in range(3))
    return [{(after, before): 1, (before, after): -1} for before, after in pairs]


def shifts(offset: int, n: int) -> list[dict[tuple[int, int], int]]:
    """Those of the matrices that shift along the first n axes."""
    return [{(offset + i, offset + n): 1} for i in range(n)]


def along(basis: Sequence[Any], wanted: Sequence[dict[tuple[int, int], int]]) -> list[int]:
    """The numbers, from 0, of the elements of a basis that have the entries wanted; −1 where it
    has none."""
    at = [{(i, j): x for i, row in enumerate(E) for j, x in enumerate(row) if x} for E in basis]
    return [at.index(x) if x in at else -1 for x in wanted]


def basis_of(problem: Mapping[str, Any]) -> list[list[list[Fraction]]]:
    """The basis of the Lie algebra of a record's problem."""
    return [[[*map(Fraction, row)] for row in E] for E in problem["basis"]]


def parts_of_inertia(problem: Mapping[str, Any], value: ExpressionValues) -> list[BodyPart]:
    """A part for each factor SO(3), SE(3) of the group of a record whose Lagrangian is stated: the
    homogeneous ellipsoid of its inertia, at the identity and the numbers at hand, and of mass 1
    where the Lagrangian tells none; no part where the group has other factors."""
    names = str(problem["group"]).split(" x ")
    stated = (problem.get("lagrangian") or {}).get("L")
    if stated is None or sum(SIZES.get(x, 0) for x in names) != problem["n"]:
        return []
    energy = decode(stated, "figure")
    basis = basis_of(problem)
    found, offset = [], 0
    for name in names:
        turning = along(basis, turns(offset))
        sliding = along(basis, shifts(offset, 3)) if name == "SE(3)" else []
        offset += SIZES[name]
        rows = _ellipsoid(energy, turning, sliding, value) if -1 not in turning else None
        if rows is None:
            return []
        columns = [(x, y, z) for x, y, z in zip(*rows, strict=True)]
        solid = DrawnSolid("ellipsoid", {"map": columns}, UNITS, ORIGIN)
        found.append(BodyPart(name, 3, name == "SO(3)", solids=[solid]))
    return found


def _ellipsoid(
    energy: Tree, turning: Sequence[int], sliding: Sequence[int], value: ExpressionValues
) -> list[Vector] | None:
    """The rows of a map of the unit ball to the ellipsoid: L L̄ = 5 J/m, with J = ½ tr I − I."""
    inertia = quadratic(energy, turning, value)
    masses = quadratic(energy, sliding, value) if sliding and -1 not in sliding else None
    if inertia is None or not 0 < (whole := sum(inertia[i][i] for i in range(3))) < LARGEST:
        return None
    m = sum(masses[i][i] for i in range(3)) / 3 if masses else 1.0
    scale = 5 / m if m > 0 else 5.0
    J = [
        [scale * ((i == j) * whole / 2 - x) for j, x in enumerate(row)]
        for i, row in enumerate(inertia)
    ]
    return cholesky(J, THINNEST**2 * max(abs(J[i][i]) for i in range(3)))


def quadratic(
    energy: Tree, places: Sequence[int], value: ExpressionValues
) -> list[list[float]] | None:
    """The matrix of the terms of a Lagrangian that are quadratic in some coordinates of the
    velocity, by its values at the identity; ``None`` where it has none there."""

    def at(*w: tuple[int, int]) -> float:
        moving = replaced(at_velocity(energy, dict(w)), "t", 0)
        found = approximate(moving, value.parameters)
        return float("nan") if found is None else found

    rest = at()
    one = {i: at((i, 1)) for i in places}
    rows = [
        [one[i] + at((i, -1)) - 2 * rest if i == j else at((i, 1), (j, 1)) - one[i] - one[j] + rest
         for j in places]
        for i in places
    ]  # fmt: skip
    return rows if all(x == x for r in rows for x in r) else None


def at_velocity(t: Tree, velocity: Mapping[int, int]) -> Tree:
    """A tree at the identity of the group, for some coordinates of the velocity, the others 0."""
    if not isinstance(t, tuple):
        return t
    if t[0] == "entry":
        return velocity.get(t[2] - 1, 0) if t[1] == "ζ" else int(len(t) == 4 and t[2] == t[3])
    return (t[0], *(at_velocity(part, velocity) for part in t[1:]))


GRAVITY = "γ"
WIDTH, MARGIN, GAP = 80.0, 1.5, 13.0
ROOM = {1: (58.0, 50.0), 2: (46.0, 46.0)}
SMALLER = (36.0, 40.0)
"""Sizes in millimetres: of the figure, and of a panel where there are one, two or more."""
ROW = 3
FEW = 3
"""The most springs of which each bears the name of its stiffness."""
PENS = ("wash", "hidden", "thin", "dashed", "line", "solid")
LOW = 0.25
"""Gravity is drawn if more than this part of it lies in the paper."""
TRIED, CLEAR = 60, 3.0
"""How many views are tried at most, until springs between panels pass all other marks at a distance
of CLEAR millimetres."""
End = tuple[Panel, Vector]
Spring = tuple[End, End, Any]


def scene(d: Derivation) -> Scene | None:
    """The figure of a record's body, or of the ellipsoid of the inertia that it states; ``None``
    for a text with neither."""
    problem = d.problem
    value = ExpressionValues(problem)
    drawn = parts(problem, value) or parts_of_inertia(problem, value)
    panels = [Panel(part, problem, value) for part in drawn]
    if not panels:
        return None
    gravity = _gravity(problem, value)
    springs = [p for p in problem["potentials"] if p["kind"] == "spring"]
    joined, named = _springs_between(panels, springs), len(springs) <= FEW
    _choose_view(panels, gravity, joined)
    sheet = Sheet(heaviest=heaviest(panels))
    for panel in panels:
        draw(panel, sheet, named)
    for (one, a), (other, b), stiffness in joined:
        sheet.spring(one.to(a), other.to(b), stiffness, named)
    _name_panels(sheet, panels)
    fall = panels[0].view(gravity)
    falls = math.hypot(*fall) > LOW * math.hypot(*gravity)
    if falls:
        _draw_gravity(sheet, fall, math.hypot(*gravity))
    caption = _caption(problem, value, panels, falls)
    return _finished(sheet, str(problem.get("title") or d.name), caption)


def _gravity(problem: Mapping[str, Any], value: ExpressionValues) -> Vector:
    """The sum of the accelerations of gravity, its first three coordinates."""
    total = ORIGIN
    for p in problem["potentials"]:
        if p["kind"] == "gravity":
            total = plus(total, value.vector(p["g"]))
    return total


def _choose_view(panels: Sequence[Panel], gravity: Vector, joined: Sequence[Spring]) -> None:
    """Choose one view for all panels, in which springs between panels run free."""
    space = [p for p in panels if p.part.size > 2]
    size = min((p.size for p in space), default=1.0)
    views = ranked([p.marks() for p in space], size, gravity) if space else [FLAT]

    def take(view: View) -> float:
        for panel in panels:
            panel.look(view if panel in space else FLAT)
        _place_panels(panels)
        return _clearance(panels, joined) if joined else CLEAR

    rooms = []
    for view in views[:TRIED]:
        rooms.append(take(view))
        if rooms[-1] >= CLEAR:
            return
    take(views[rooms.index(max(rooms))])


def _clearance(panels: Sequence[Panel], joined: Sequence[Spring]) -> float:
    """How near the springs between panels come to other marks, in millimetres."""
    marks = [(panel, p) for panel in panels for p in panel.marks()[0]]
    return min(
        from_segment(panel.to(p), one.to(a), other.to(b))
        for (one, a), (other, b), _ in joined
        for panel, p in marks
        if (panel, p) not in ((one, a), (other, b))
    )


def _place_panels(panels: Sequence[Panel]) -> None:
    """Choose one scale for all panels, and place them in rows, each row level."""
    width, height = ROOM.get(len(panels), SMALLER)
    boxes = [box_of(panel.extent()) for panel in panels]
    scales = [
        min(width / max(x1 - x0, 1e-12), height / max(y1 - y0, 1e-12)) for x0, y0, x1, y1 in boxes
    ]
    scale, top = min(scales), 0.0
    for start in range(0, len(panels), ROW):
        right, low = 0.0, 0.0
        for panel, (x0, y0, x1, y1) in [*zip(panels, boxes, strict=True)][start : start + ROW]:
            tall = (y1 - y0) * scale
            panel.scale = scale
            panel.offset = right - scale * x0, top - scale * (y0 + y1) / 2
            right, low = right + scale * (x1 - x0) + GAP, max(low, tall)
        top -= low + 2 * GAP


def box_of(points: Sequence[Point]) -> Box:
    """The rectangle about points."""
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def _springs_between(panels: Sequence[Panel], springs: Sequence[Mapping[str, Any]]) -> list[Spring]:
    """The springs from a point of one panel to a point of another."""
    home = {i: panel for panel in panels for i in panel.at}
    pairs = [(p["between"], p["stiffness"]) for p in springs if "between" in p]
    return [
        ((home[i], home[i].at[i]), (home[j], home[j].at[j]), stiffness)
        for (i, j), stiffness in pairs
        if home[i] is not home[j]
    ]


def _name_panels(sheet: Sheet, panels: Sequence[Panel]) -> None:
    """Name the factors of a product, each below its panel."""
    if len(panels) < 2:
        return
    for panel in panels:
        x0, y0, x1, _ = box_of([panel.to_paper(p) for p in panel.extent()])
        below = (x0 + x1) / 2, y0 - 4.0
        sheet.wishes.insert(0, Wish(Label(panel.part.name, name=True), below, 0.0, (0.0, -1.0)))


def _draw_gravity(sheet: Sheet, fall: Point, strength: float) -> None:
    """Draw gravity as an arrow at the right of the panels."""
    points = [p for s in sheet.strokes for p in s.points]
    _, y0, right, y1 = box_of(points)
    long = 12.0 / strength
    dx, dy = long * fall[0], long * fall[1]
    start = right + 9.0 + max(0.0, -dx), y0 + 0.72 * (y1 - y0) - dy / 2
    end = start[0] + dx, start[1] + dy
    sheet.strokes += arrow(start, end, "gravity")
    middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    sheet.wishes.append(Wish(Label(GRAVITY), middle, 0.9, (1.0, 0.0)))


def _finished(sheet: Sheet, title: str, caption: Prose) -> Scene:
    """The scene: labels placed, all in the positive quadrant, as wide as a column at least."""
    labels = placed(sheet.wishes, sheet.strokes, sheet.dots)
    reach = [p for s in sheet.strokes for p in s.points]
    reach += [(d.at[0] + s * d.radius, d.at[1] + s * d.radius) for d in sheet.dots for s in (1, -1)]
    reach += [corner for x in labels for corner in (x.box[:2], x.box[2:])]
    x0, y0, x1, y1 = box_of(reach)
    width = max(WIDTH, x1 - x0 + 2 * MARGIN)
    dx, dy = (width - x0 - x1) / 2, MARGIN - y0

    def moved(p: Point) -> Point:
        return p[0] + dx, p[1] + dy

    strokes = [replace(s, points=tuple(map(moved, s.points))) for s in sheet.strokes]
    return Scene(
        width,
        y1 - y0 + 2 * MARGIN,
        tuple(sorted(strokes, key=lambda s: PENS.index(s.pen))),
        tuple(replace(d, at=moved(d.at)) for d in sheet.dots),
        tuple(replace(x, at=moved(x.at)) for x in labels),
        title,
        caption,
    )


def _caption(
    problem: Mapping[str, Any], value: ExpressionValues, panels: Sequence[Panel], falls: bool
) -> Prose:
    """The sentences of the caption: what the drawing does not say by itself."""
    sentences: list[Prose] = [
        say("The body at the identity of the group, with the axes of its frame.")
    ]
    sentences += _about_the_body(panels, problem["body"]["kind"] == "none")
    potentials = problem["potentials"]
    there = {p["kind"] for p in potentials}
    legends = [x for kind, x in kinds().items() if kind in there and x.legend]
    legend = {x.kind: say(x.legend) for x in legends if x.drawn}
    if any(panel.anchors for panel in panels):
        legend["spring"] += say("The hatched supports are fixed in space.")
    sentences += legend.values()
    elsewhere = any(panel.centre_of(p)[1] for panel in panels for p in panel.attractions)
    if elsewhere or any(panel.moved for panel in panels):
        sentences.append(say("Distances to fixed places are not to scale."))
    if "gravity" in there and not falls:
        sentences.append(say("Gravity has no component in the drawing."))
    if any(i["kind"] == "force" for i in problem["inputs"]):
        sentences.append(say("The directions of the input forces are arbitrary."))
    sentences += [
        say("The input {name} is a covector and not drawn.", name=i["name"])
        for i in problem["inputs"]
        if i["kind"] == "covector"
    ]
    torques = (i["name"] for i in problem["inputs"] if i["kind"] == "torque")
    sentences += [say("The input {name} is a torque and not drawn.", name=x) for x in torques]
    sentences += [say(x.legend) for x in legends if not x.drawn]
    if problem["damping"]:
        sentences.append(say("Damping is not drawn."))
    stated, drawn = problem.get("forces", ()), named_forces(problem)
    if drawn:
        sentences.append(say("The directions of the forces of the state are arbitrary."))
    if stated and not drawn:
        sentences.append(say("Forces of the state are not drawn."))
    elif len(stated) > len(drawn):
        sentences.append(say("Forces of the state without a name are not drawn."))
    if problem.get("flows"):
        sentences.append(say("Mass that flows is not drawn."))
    if value.invented:
        sentences.append(say("Parameters without a default have sample values."))
    return tuple(sentence for prose in sentences for sentence in prose)


def _about_the_body(panels: Sequence[Panel], stated: bool) -> Iterator[Prose]:
    if len(panels) > 1:
        yield say("Each factor of the group has a panel of its own.")
    size = max(panel.part.size for panel in panels)
    if size > 3:
        yield say("Of the {n} coordinates the first three are drawn.", n=str(size))
    if any(panel.part.moments for panel in panels):
        yield say("As only its moments are given, its outline is free.")
    if stated:
        yield say("The ellipsoid has the inertia of the Lagrangian for rotations alone.")
    masses = {m for panel in panels for m, _ in panel.part.points.values()}
    if len(masses) > 1:
        yield say("The larger a dot, the larger its mass.")
    if any(panel.part.fixed for panel in panels):
        yield say("The ring is the fixed origin.")
    if any(shows_centre(panel) for panel in panels):
        yield say("The centre of mass is r_c.")
