"""The figures of the first chapter with a reader's body in the place of the racket, and the numbers
that its sentences then have."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, partial

from ..views.figure.drawing import Label, Scene
from ..views.figure.drawn_body import UNITS, ExpressionValues, View, dot, parts, placed, seen_from
from ..views.figure.panels import Panel, Sheet, draw, heaviest
from ..views.figure.scene import box_of, parts_of_inertia
from ..views.language import LANGUAGES, Language
from .figures import Figure, Spun, bow, displacement, polhodes
from .lecture_text import Given
from .motion_figures import MOMENTS, poinsot
from .own_body import FREE, OwnBody
from .sheets import Claims, Vector, euler, numbered, panel, solved

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
