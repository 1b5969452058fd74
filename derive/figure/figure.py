"""A scene printed as SVG or as TikZ.

The SVG stands alone or within a page: it is drawn in the colour of the text, or in what the page
says by ``--figure-body``, ``--figure-axis``, ``--figure-spring``, ``--figure-support``,
``--figure-attraction``, ``--figure-gravity``, ``--figure-force`` and ``--figure-label``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from html import escape
from itertools import groupby
from textwrap import wrap

from .drawing import SIZE, SMALL, Dot, Label, Point, Scene, Stroke

PENS = {
    "wash": (0.0, 0.07), "hidden": (0.22, 0.5), "thin": (0.22, 0.6), "dashed": (0.28, 1.0),
    "line": (0.35, 1.0), "solid": (0.0, 1.0),
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
    slant = "" if label.name else ' font-style="italic"'
    y = height - label.at[1] + (0.27 if label.name else 0.2) * SIZE
    lower = f'<tspan dy="{BELOW}" font-size="{SMALL}"{UPRIGHT * index.isdigit()}>{_text(index)}'
    return (
        f'<text x="{_n(label.at[0])}" y="{_n(y)}" {family} font-size="{SIZE}"{slant}>'
        f"{_text(base)}{f'{lower}</tspan>' if index else ''}</text>"
    )


def _text(words: str) -> str:
    return escape("".join(c for c in words if c.isprintable()))


def tikz(scene: Scene) -> str:
    r"""The scene as a ``tikzpicture``, which needs ``\usepackage{tikz}`` alone."""
    w, h = _n(scene.width), _n(scene.height)
    lines = [
        r"\begin{tikzpicture}[x=1mm, y=1mm, line cap=round, line join=round]",
        rf"\path[use as bounding box] (0, 0) rectangle ({w}, {h});",
    ]
    for s in scene.strokes:
        points = [f"({_n(x)}, {_n(y)})" for x, y in _thinned(s.points)]
        if s.pen in AREAS or _closed(s):
            points.append("cycle")
        lines += _wrapped(_command(s.pen, s.role), points)
    for d in scene.dots:
        ink = rf"\draw[line width={RING}mm]" if d.ring else r"\fill"
        lines.append(f"{ink} {_at(d.at)} circle[radius={_n(d.radius)}];")
    for x in scene.labels:
        lines.append(rf"\node[inner sep=0pt] at {_at(x.at)} {{${x.latex}$}};")
    return "\n".join([*lines, r"\end{tikzpicture}", ""])


def _command(pen: str, role: str) -> str:
    opacity = PENS[pen][1]
    if pen in AREAS:
        return rf"\fill[fill opacity={opacity}]" if opacity < 1 else r"\fill"
    options = [f"line width={_width(pen, role)}mm"]
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
