"""The elements of a figure, and a scene printed as SVG or as TikZ."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import groupby
from textwrap import wrap

from ...record.sentence import Prose
from ..printing.letters import parameter
from ..printing.sentences import spelt
from ..printing.typeset import display_width, plain

Point = tuple[float, float]
Box = tuple[float, float, float, float]
"""A rectangle by its left, bottom, right and top, in millimetres."""

SIZE, SMALL = 3.7, 2.6
"""Heights of type in millimetres: letters and their indices."""
INDEXED = re.compile(r"([A-Za-z][A-Za-z0-9]*)_([A-Za-z0-9]{1,3})|([A-Za-z]+)([0-9]{1,3})")
"""A name that ends in an index, as in :func:`parameter`."""
NUMBER = re.compile(r"−?[0-9.,]+")
LONGEST = 24
"""The most letters of a name; longer ones are cut."""
HEAD, HALF_HEAD = 2.3, 0.75
"""The length and half the width of the head of an arrow, in millimetres."""


@dataclass(frozen=True)
class Stroke:
    """A line through points, or the outline of an area; ``role``: what it draws, ``pen``: how."""

    points: tuple[Point, ...]
    role: str
    pen: str = "line"


@dataclass(frozen=True)
class Dot:
    """A disc, or a ``ring`` with an empty middle; ``role``: what it draws."""

    at: Point
    radius: float
    role: str
    ring: bool = False


@dataclass(frozen=True)
class Label:
    """A letter or a short formula, with an index; or, where ``name``, an upright name that a user
    gave."""

    base: str
    index: str = ""
    name: bool = False
    at: Point = (0.0, 0.0)

    @property
    def latex(self) -> str:
        """The label in LaTeX, without dollars."""
        if self.name:
            return parameter(shortened(self.base)).tex.replace(r"\text{", r"\mbox{")  # no amsmath
        base = plain(spelt(self.base).tex)
        return f"{base}_{{{self.index}}}" if self.index else base

    @property
    def parts(self) -> tuple[str, str]:
        """The text on the line, and the index below it."""
        if not self.name:
            return self.base, self.index
        name = shortened(self.base)
        match = INDEXED.fullmatch(name)
        base, index = (x for x in match.groups() if x) if match else (name, "")
        return base, index

    @property
    def box(self) -> Box:
        """The rectangle that the label covers, about."""
        w, h = self.half
        return self.at[0] - w, self.at[1] - h, self.at[0] + w, self.at[1] + h

    @property
    def half(self) -> Point:
        """Half the width and half the height of the label in millimetres, about."""
        base, index = self.parts
        width = 0.56 * (SIZE * display_width(base) + SMALL * display_width(index))
        return width / 2, (SIZE * 0.42 if self.name else SIZE * (0.46 if index else 0.38))


@dataclass(frozen=True)
class Scene:
    """A figure in millimetres, from its lower left corner; ``caption``: sentences below it."""

    width: float
    height: float
    strokes: tuple[Stroke, ...]
    dots: tuple[Dot, ...]
    labels: tuple[Label, ...]
    title: str
    caption: Prose


def shortened(name: str) -> str:
    """A name cut to LONGEST letters, the last of them then an ellipsis."""
    return name if len(name) <= LONGEST else name[: LONGEST - 1] + "…"


def arrow(a: Point, b: Point, role: str) -> list[Stroke]:
    """The strokes of an arrow from a to b."""
    length = max(math.dist(a, b), 1e-9)
    x, y = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    neck = (b[0] - HEAD * x, b[1] - HEAD * y)
    wings = [(neck[0] - s * HALF_HEAD * y, neck[1] + s * HALF_HEAD * x) for s in (1, -1)]
    notch = (b[0] - 0.75 * HEAD * x, b[1] - 0.75 * HEAD * y)
    return [Stroke((a, notch), role), Stroke((b, wings[0], notch, wings[1]), role, "solid")]


def zigzag(a: Point, b: Point) -> Iterator[Point]:
    """The points of a spring's zigzag from a to b."""
    length = max(math.dist(a, b), 1e-9)
    x, y = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    coil = min(0.72 * length, 26.0)
    teeth = max(3, round(coil / 2.3))
    yield a
    for k in range(2 * teeth + 1):
        along = (length - coil) / 2 + coil * k / (2 * teeth)
        aside = 0.0 if k in (0, 2 * teeth) else (0.9 if k % 2 else -0.9)
        yield a[0] + along * x - aside * y, a[1] + along * y + aside * x
    yield b


def support(at: Point, towards: Point) -> list[Stroke]:
    """The strokes of a hatched support at ``at``; what hangs from it lies ``towards``."""
    dx, dy = towards[0] - at[0], towards[1] - at[1]
    level = abs(dy) >= abs(dx)
    back = -math.copysign(1.6, dy if level else dx)

    def line(u0: float, v0: float, u1: float, v1: float, pen: str) -> Stroke:
        ends = ((u0, v0), (u1, v1)) if level else ((v0, u0), (v1, u1))
        return Stroke(tuple((at[0] + x, at[1] + y) for x, y in ends), "support", pen)

    hatches = (line(u, 0.0, u + 1.3, back, "thin") for u in (1.5 * k - 4.2 for k in range(6)))
    return [line(-4.5, 0.0, 4.5, 0.0, "line"), *hatches]


def quadrants(at: Point, radius: float) -> list[Stroke]:
    """The two full quarters of the mark of a centre of mass."""
    return [
        Stroke((at, *_arc(at, radius, start, start + math.pi / 2)), "body", "solid")
        for start in (0.0, math.pi)
    ]


def _arc(at: Point, radius: float, start: float, end: float) -> Iterator[Point]:
    for k in range(9):
        angle = start + (end - start) * k / 8
        yield at[0] + radius * math.cos(angle), at[1] + radius * math.sin(angle)


def hull(points: Sequence[Point]) -> tuple[Point, ...]:
    """The vertices of the convex hull of points, counterclockwise."""
    ordered = sorted({(round(x, 9), round(y, 9)) for x, y in points})
    if len(ordered) < 3:
        return tuple(ordered)
    sides: list[list[Point]] = []
    for run in (ordered, ordered[::-1]):
        side: list[Point] = []
        for p in run:
            while len(side) > 1 and turn(side[-2], side[-1], p) <= 0:
                side.pop()
            side.append(p)
        sides.append(side[:-1])
    return tuple(sides[0] + sides[1])


def turn(a: Point, b: Point, c: Point) -> float:
    """Twice the signed area of the triangle a b c, positive where it turns left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def from_segment(p: Point, a: Point, b: Point) -> float:
    """The distance of the point p from the segment a b."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square if square else 0.0
    t = min(1.0, max(0.0, t))
    return math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)


# A scene printed as SVG or as TikZ.
#
# The SVG stands alone or within a page: it is drawn in the colour of the text, or in what the
# page says by ``--figure-body``, ``--figure-axis``, ``--figure-spring``, ``--figure-support``,
# ``--figure-attraction``, ``--figure-gravity``, ``--figure-force`` and ``--figure-label``.

PENS = {
    "wash": (0.0, 0.07), "hidden": (0.22, 0.5), "thin": (0.22, 0.6), "dashed": (0.28, 1.0),
    "line": (0.35, 1.0), "thick": (0.7, 1.0), "solid": (0.0, 1.0),
}  # fmt: skip
"""Pen → the width of its lines in millimetres, and its opacity."""
THINNER = {"axis": 0.28, "spring": 0.28, "support": 0.28}
DASHES = {"hidden": (0.9, 0.8), "dashed": (1.4, 1.0)}
AREAS = ("wash", "solid")
RING = 0.3
LETTERS = "STIX Two Math, Latin Modern Math, Cambria Math, Times New Roman, Times, serif"
NAMES = "Latin Modern Sans, Helvetica, Arial, sans-serif"
UPRIGHT = ' font-style="normal"'
BELOW = 0.95
"""How far an index stands below its letter, in millimetres."""


def svg(scene: Scene) -> str:
    """The scene as an element ``svg`` of its width, without scripts and identifiers."""
    w, h = _n(scene.width), _n(scene.height)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" width="{w}mm"'
        f' height="{h}mm" role="img" style="max-width:100%;height:auto">',
        f"<title>{_text(scene.title)}</title>",
    ]
    for (pen, role), strokes in groupby(scene.strokes, key=lambda s: (s.pen, s.role)):
        lines.append(f"<g {_pen(pen, role)}>")
        lines += (f'<path d="{_path(s, scene.height)}"/>' for s in strokes)
        lines.append("</g>")
    lines += (_disc(d, scene.height) for d in scene.dots)
    lines.append(f'<g fill="currentColor" text-anchor="middle" {_style("label")}>')
    lines += (_svg_label(x, scene.height) for x in scene.labels)
    return "\n".join([*lines, "</g>", "</svg>", ""])


def _style(role: str) -> str:
    return f'style="color:var(--figure-{role},currentColor)"'


def _pen(pen: str, role: str) -> str:
    width, opacity = _width(pen, role), PENS[pen][1]
    if pen in AREAS:
        return f'fill="currentColor" fill-opacity="{opacity}" {_style(role)}'
    dash = f' stroke-dasharray="{_n(DASHES[pen][0])} {_n(DASHES[pen][1])}"' if pen in DASHES else ""
    return (
        f'fill="none" stroke="currentColor" stroke-width="{width}" stroke-opacity="{opacity}"'
        f'{dash} stroke-linecap="round" stroke-linejoin="round" {_style(role)}'
    )


def _width(pen: str, role: str) -> float:
    return THINNER.get(role, PENS[pen][0]) if pen == "line" else PENS[pen][0]


def _path(s: Stroke, height: float) -> str:
    points = (f"{_n(x)} {_n(height - y)}" for x, y in _thinned(s.points))
    return "M" + "L".join(points) + ("Z" if s.pen in AREAS or _closed(s) else "")


def _closed(s: Stroke) -> bool:
    return len(s.points) > 3 and _near(s.points[0], s.points[-1])


def _near(a: Point, b: Point) -> bool:
    return abs(a[0] - b[0]) + abs(a[1] - b[1]) < 1e-6


def _thinned(points: tuple[Point, ...]) -> Iterator[Point]:
    """The points without those in the middle of a straight piece."""
    kept: list[Point] = []
    for k, p in enumerate(points):
        if kept and 0 < k < len(points) - 1:
            (ax, ay), (bx, by) = kept[-1], points[k + 1]
            area = (p[0] - ax) * (by - ay) - (p[1] - ay) * (bx - ax)
            ahead = (p[0] - ax) * (bx - p[0]) + (p[1] - ay) * (by - p[1]) >= 0
            if abs(area) < 1e-6 and ahead:
                continue
        kept.append(p)
    return iter(kept)


def _disc(d: Dot, height: float) -> str:
    circle = f'<circle cx="{_n(d.at[0])}" cy="{_n(height - d.at[1])}" r="{_n(d.radius)}"'
    if d.ring:
        ink = f'fill="none" stroke="currentColor" stroke-width="{RING}"'
    else:
        ink = 'fill="currentColor"'
    return f"{circle} {ink} {_style(d.role)}/>"


def _svg_label(label: Label, height: float) -> str:
    base, index = label.parts
    family = f'font-family="{NAMES}"' if label.name else f'font-family="{LETTERS}"'
    slant = "" if label.name or NUMBER.fullmatch(base) else ' font-style="italic"'
    y = height - label.at[1] + (0.27 if label.name else 0.2) * SIZE
    lower = f'<tspan dy="{BELOW}" font-size="{SMALL}"{UPRIGHT * index.isdigit()}>{_text(index)}'
    return (
        f'<text x="{_n(label.at[0])}" y="{_n(y)}" {family} font-size="{SIZE}"{slant}>'
        f"{_text(base)}{f'{lower}</tspan>' if index else ''}</text>"
    )


def _text(words: str) -> str:
    return escape("".join(c for c in words if c.isprintable()))


def tikz(scene: Scene, colours: Collection[str] = ()) -> str:
    r"""The scene as a ``tikzpicture``, which needs ``\usepackage{tikz}`` alone; ``colours``: roles
    that are colours of the document."""
    w, h = _n(scene.width), _n(scene.height)
    lines = [
        r"\begin{tikzpicture}[x=1mm, y=1mm, line cap=round, line join=round]",
        rf"\path[use as bounding box] (0, 0) rectangle ({w}, {h});",
    ]
    for s in scene.strokes:
        points = [f"({_n(x)}, {_n(y)})" for x, y in _thinned(s.points)]
        if s.pen in AREAS or _closed(s):
            points.append("cycle")
        lines += _wrapped(_command(s.pen, s.role, s.role if s.role in colours else ""), points)
    for d in scene.dots:
        ink = rf"\draw[line width={RING}mm]" if d.ring else r"\fill"
        if d.role in colours and not d.ring:
            ink += f"[{d.role}]"
        lines.append(f"{ink} {_at(d.at)} circle[radius={_n(d.radius)}];")
    for x in scene.labels:
        lines.append(rf"\node[inner sep=0pt] at {_at(x.at)} {{${x.latex}$}};")
    return "\n".join([*lines, r"\end{tikzpicture}", ""])


def _command(pen: str, role: str, colour: str) -> str:
    opacity = PENS[pen][1]
    ink = [colour] if colour else []
    if pen in AREAS:
        options = [*ink, *([f"fill opacity={opacity}"] if opacity < 1 else ())]
        return rf"\fill[{', '.join(options)}]" if options else r"\fill"
    options = [*ink, f"line width={_width(pen, role)}mm"]
    if pen in DASHES:
        on, off = DASHES[pen]
        options.append(f"dash pattern=on {on}mm off {off}mm")
    if opacity < 1:
        options.append(f"draw opacity={opacity}")
    return rf"\draw[{', '.join(options)}]"


def _wrapped(command: str, points: Iterable[str]) -> list[str]:
    joined = " -- ".join(p.replace(" ", "~") for p in points)
    lines = wrap(f"{joined};", 96, break_long_words=False, break_on_hyphens=False)
    return [command, *("  " + line.replace("~", " ") for line in lines)]


def _at(p: Point) -> str:
    return f"({_n(p[0])}, {_n(p[1])})"


def _n(x: float) -> str:
    """A number as text, to hundredths of a millimetre."""
    return f"{round(x, 2) + 0.0:g}"
