"""The body of a reader's problem in the place of the racket, where it turns freely as one: its
principal moments and axes, by its record; or why the racket stays.  Its figures of the first
chapter, and the numbers that the sentences there then have."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from ..language.tree import Tree, names
from ..language.values import approximate
from ..record.as_json import decode
from ..record.record import Derivation
from ..record.sentence import Sentence, phrase
from ..views.figure.drawing import Label, Scene
from ..views.figure.drawn_body import (
    UNITS,
    ExpressionValues,
    View,
    dot,
    moments_of,
    parts,
    placed,
    seen_from,
)
from ..views.figure.panels import Panel, Sheet, draw, heaviest
from ..views.figure.scene import along, at_velocity, box_of, parts_of_inertia, quadratic, turns
from ..views.language import LANGUAGES, Language, language
from ..views.outline import group, title
from .figures import Figure, Spun, bow, displacement, polhodes
from .lecture_text import Given
from .motion_figures import MOMENTS, poinsot
from .sheets import Claims, Vector, euler, numbered, panel, solved

HELD, FREE = "SO(3)", "SE(3)"
APART = 0.01
"""The least difference of two principal moments, in the largest, that a picture shows."""
SMALL = 1e-9
"""What is less, beside the whole, is that of rounding."""
HERE = "In chapter 1 this body has the place of a racket; its flip is drawn there."
TAKEN = "In the first chapter another body has the place of the racket already."
ACTING = ("damping", "forces", "flows")
"""What a problem may have that no potential energy tells."""


class RacketStaysError(Exception):
    """The body of a problem is none that turns as a racket: ``reason`` says why."""

    def __init__(self, reason: str, **places: str) -> None:
        super().__init__(reason)
        self.reason: Sentence = phrase(reason, **places)


@dataclass(frozen=True)
class OwnBody:
    """A body that turns freely: the title of its problem in each language, its ``group``, its
    principal moments, rising, the axes (columns, right-handed) to which they belong, in the frame
    of the problem, how fast it turns at first, and the problem, as the record has it."""

    titles: tuple[str, ...]
    group: str
    moments: Vector
    axes: np.ndarray[Any, np.dtype[np.float64]]
    speed: float
    problem: Mapping[str, Any]


def body_of(d: Derivation, speed: float = 1.0) -> OwnBody:
    """The body of a record that turns freely about a fixed point or its centre of mass;
    ``RacketStaysError`` for any other."""
    problem = d.problem
    if problem["body"]["kind"] == "any":
        raise RacketStaysError("it has no body of its own")
    if problem["group"] not in (HELD, FREE):
        raise RacketStaysError("its group is {group}, not that of a solid", group=group(d))
    value = ExpressionValues(problem)
    inertia = _inertia(problem, value)
    if value.invented:
        raise RacketStaysError("some of its parameters have no number")
    moments, axes = np.linalg.eigh(inertia)
    first, second, third = (float(x) for x in moments)
    if not first > SMALL * third:
        raise RacketStaysError("its inertia is not positive")
    if min(second - first, third - second) < APART * third:
        raise RacketStaysError("two of its principal moments are equal, or nearly so")
    axes = axes * np.sign(axes[np.abs(axes).argmax(axis=0), range(3)])
    axes[:, 1] *= np.sign(np.linalg.det(axes))
    titles = tuple(title(d, language(x)) for x in LANGUAGES)
    return OwnBody(titles, str(problem["group"]), (first, second, third), axes, speed, problem)


def place_of(d: Derivation, speed: float, *, taken: bool) -> tuple[OwnBody | None, Sentence]:
    """The body of a record, if it turns freely, and what its chapter says of that; ``taken``: has
    another body the place of the racket?"""
    try:
        body = body_of(d, speed)
    except RacketStaysError as stays:
        return None, phrase("In the first chapter the racket stays: {reason}.", reason=stays.reason)
    return body, phrase(TAKEN if taken else HERE)


def _inertia(problem: Mapping[str, Any], value: ExpressionValues) -> Any:
    """The tensor of inertia about the point about which the body turns; ``RacketStaysError``."""
    kind = problem["body"]["kind"]
    if any(problem.get(x) for x in ACTING) or not {"gravity"} >= {
        x["kind"] for x in problem["potentials"]
    }:
        raise RacketStaysError("more than its weight acts on it")
    if kind == "none":
        return _stated(problem, value)
    m, c, J = _of_points(problem, value) if kind == "points" else _of_moments(problem, value)
    if problem["group"] == HELD:
        if problem["potentials"] and abs(c).max() > SMALL * np.trace(J) ** 0.5:
            raise RacketStaysError("it is heavy, and not held at its centre of mass")
    elif not m > 0:
        raise RacketStaysError("some of its parameters have no number")
    else:
        J = J - np.outer(c, c) / m
    return np.trace(J) * np.eye(3) - J


def _of_points(problem: Mapping[str, Any], value: ExpressionValues) -> tuple[float, Any, Any]:
    """Mass, first moment and matrix of moments of points."""
    points = problem["body"]["points"]
    masses = np.array([value.of(x["mass"]) for x in points])
    places = np.array([value.vector(x["at"]) for x in points])
    return masses.sum(), masses @ places, (places.T * masses) @ places


def _of_moments(problem: Mapping[str, Any], value: ExpressionValues) -> tuple[float, Any, Any]:
    """The same of a body that has its moments in the record; a mass without a number is 0."""
    mass, c, J = moments_of(problem)
    m = value.of(mass)
    if problem["body"]["kind"] == "moments" and problem["parameters"]["m"]["default"] is None:
        m = 0.0
    return m, np.array(value.vector(c)), np.array([value.vector(row) for row in J[:3]])


def _stated(problem: Mapping[str, Any], value: ExpressionValues) -> Any:
    """The inertia of a Lagrangian that is half a quadratic form of the angular velocity in the
    body, and no more; ``RacketStaysError``."""
    lagrangian = problem.get("lagrangian") or {}
    if "L" not in lagrangian or problem["group"] != HELD or problem["inputs"]:
        raise RacketStaysError("its Lagrangian is stated, and not that of a solid held at a point")
    energy = decode(lagrangian["L"], "lecture")
    turning = along([[[*map(float, r)] for r in E] for E in problem["basis"]], turns(0))
    wrong = RacketStaysError(
        "its Lagrangian is not half a quadratic form of the angular velocity alone"
    )
    if lagrangian.get("trivialisation") == "right" or -1 in turning or {*names(energy)} != {"ζ"}:
        raise wrong
    form = quadratic(energy, turning, value)
    if form is None or not _is_half(energy, turning, np.array(form), value):
        raise wrong
    return np.array(form)


def _is_half(energy: Tree, turning: list[int], form: Any, value: ExpressionValues) -> bool:
    """Is L half the form at a few velocities, not small nor large?"""
    for w in ((1, 2, 3), (-2, 3, 1), (3, -1, 2)):
        there = at_velocity(energy, dict(zip(turning, w, strict=True)))
        found, wanted = approximate(there, value.parameters), np.dot(w, form @ w) / 2
        if found is None or not abs(found - wanted) <= SMALL * abs(wanted):
            return False
    return True


TILTED = 0.004
"""The angular velocity about the first axis at first, in that about the second."""
FINE = 0.04
"""A step of time, in the least time that a turn by one radian may take."""
CALM = ("potentials", "inputs", "damping", "forces")
"""What is not drawn of a body that turns freely."""
DRAWN = (46.0, 38.0)
"""The largest width and height of one of two bodies, in millimetres."""
FREE_OF = {
    FREE: "turns about its centre of mass as if nothing acted on it (proposition @falls)",
    "SO(3)": "turns about its fixed point, about which nothing has a moment",
}
"""Group → why the body turns as a racket does."""


def step_of(moments: Vector, speed: float) -> float:
    """A step of time in which a body that turns near its second axis turns little, however fast."""
    return FINE / speed * math.sqrt(moments[0] / moments[2])


def turned(claims: Claims, moments: Vector, start: Vector) -> float:
    """When a body has first turned over half, ζ₂ = 0, from an angular velocity near the second axis
    whose third component is 0: there ζ₂ is at its largest, and this is a quarter of its period."""
    rate, x, t, step = euler(claims, moments), start, 0.0, step_of(moments, start[1])
    while True:
        for time, y in solved(rate, x, 100 * step, 100)[1:]:
            if y[1] <= 0:
                return t + time - y[1] / rate(y)[1]
        x, t = y, t + 100 * step


@dataclass(frozen=True)
class BodyOfLecture:
    """A body in the place of the racket, and the equations that the text displays."""

    body: OwnBody
    claims: Claims

    @cached_property
    def start(self) -> Vector:
        """Its angular velocity at first, in principal axes: near the second one."""
        return TILTED * self.body.speed, self.body.speed, 0.0

    @cached_property
    def turned(self) -> float:
        """When it has first turned over half."""
        return turned(self.claims, self.body.moments, self.start)

    @cached_property
    def spun(self) -> Spun:
        """Its motion over two flips, with the marks of the axes."""
        end = 4.3 * self.turned
        step = step_of(self.body.moments, self.body.speed)
        steps = 4 * max(260, math.ceil(end / step / 4))
        whole = Spun(self.body.moments, self.start, end, steps)
        rate = euler(self.claims, self.body.moments)
        largest = max(abs(x) for _, zeta in solved(rate, self.start, end, steps) for x in zeta)
        times, speeds = marks(0.0, end), marks(-largest, largest)
        return replace(whole, largest=1.1 * largest, times=times, speeds=speeds)

    @property
    def figures(self) -> dict[str, Figure]:
        """The figures by the labels of their blocks."""
        scale = MOMENTS[1] / self.body.moments[1]
        moments = tuple(scale * x for x in self.body.moments)
        return {
            "theory": lambda _: theory(self.body),
            "polhodes": lambda claims: polhodes(claims, self.spun),
            "rolling": partial(poinsot, moments=moments),
        }

    def words(self, words: Language) -> dict[str, str]:
        """What stands in the places of its sentences."""
        numbers = {f"m{k}": x for k, x in enumerate(self.body.moments, 1)}
        numbers |= {f"z{k}": x for k, x in enumerate(self.start, 1)}
        numbers |= {"turned": self.turned, "period": 2 * self.turned}
        return {
            "title": Given(self.body.titles[LANGUAGES.index(words.name)]),
            "free": words.word(FREE_OF[self.body.group]),
            **{name: words.decimal(float(f"{x:.3g}")) for name, x in numbers.items()},
        }


def marks(low: float, high: float) -> dict[float, str]:
    """Round numbers from ``low`` to ``high``, 0 among them: some four on the longer side of it."""
    least = max(-low, high) / 4.5
    power = 10.0 ** math.floor(math.log10(least))
    step = next(k * power for k in (1, 2, 5, 10) if k * power >= least)
    span = range(math.ceil(low / step), math.floor(high / step) + 1)
    return numbered(k * step for k in span)


# The whole theory in one picture: the body, and what the group makes of it.


def theory(body: OwnBody) -> Scene:
    """The reference body, and the body at a time; the rotation that carries one to the other."""
    value = ExpressionValues(body.problem)
    part = (parts(dict(body.problem), value) or parts_of_inertia(body.problem, value))[0]
    calm = {**body.problem, **dict.fromkeys(CALM, ())}
    panels = [Panel(part, calm, value) for _ in range(2)]
    view = seen_from(-55, 24)
    moved = View(_back(view.right), _back(view.up), _back(view.towards))
    for each, seen in zip(panels, (view, moved), strict=True):
        each.look(seen)
    boxes = [box_of(x.extent()) for x in panels]
    scale = min(room / max(box[k + 2] - box[k] for box in boxes) for k, room in enumerate(DRAWN))
    height = scale * max(y1 - y0 for _, y0, _, y1 in boxes)
    sheet, left = Sheet(), 4.0
    labels: list[Label] = []
    for each, (x0, y0, x1, y1), letter in zip(panels, boxes, ("", "A"), strict=True):
        each.scale = scale
        each.offset = left - scale * x0, 4 + height / 2 - scale * (y0 + y1) / 2
        own = Sheet(heaviest=heaviest(panels))
        draw(each, own, named=False)
        named = placed(own.wishes, own.strokes, own.dots)
        labels += (replace(x, base=f"{letter}{x.base}") for x in named)
        sheet.strokes += own.strokes
        sheet.dots += own.dots
        left += scale * (x1 - x0) + 22
    middle = 4 + scale * (boxes[0][2] - boxes[0][0]) + 7
    strokes, name = bow((middle, 7 + height), 16)
    return panel((left - 14, height + 16), [*sheet.strokes, *strokes], [*labels, name], sheet.dots)


def _back(v: Vector) -> tuple[float, float, float]:
    """Āv, so that ⟨Āv, r⟩ is ⟨v, A r⟩ for the rotation A of the picture."""
    x, y, z = (dot(displacement(e), v) for e in UNITS)
    return x, y, z
