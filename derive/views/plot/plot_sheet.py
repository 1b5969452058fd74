"""The sheet that pictures are drawn on, and where the labels of marks stand."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...language.limits import Refused
from ...language.reserved import GREEK, letter_and_suffix
from ...motion.run import Array, Run

FORMATS: dict[str, dict[str, Any]] = {
    ".svg": {"metadata": {"Date": None, "Creator": None}},
    ".pdf": {"metadata": {"CreationDate": None, "ModDate": None, "Creator": None}},
    ".png": {"metadata": {"Software": None}, "dpi": 150},
}
"""Ending → what keeps dates and versions out of the file."""

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Colours that the colour-blind tell apart (Okabe and Ito)."""

LOOK: dict[Any, Any] = {
    "svg.hashsalt": "derive",
    "svg.fonttype": "path",
    "pdf.fonttype": 42,  # TrueType, where journals refuse the Type 3 of matplotlib
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#eeeeee",
    "legend.frameon": False,
    "legend.fontsize": 8,
    "lines.linewidth": 1.1,
}


class PlotError(Refused, ValueError):
    """A picture that cannot be made: the message says why, and what can."""


def ending(name: str) -> str:
    """The ending of the name of a picture; ``PlotError`` for one that means no format."""
    found = Path(name).suffix
    if found not in FORMATS:
        raise PlotError(f"{name}: the name of a picture must end in {', '.join(FORMATS)}")
    return found


def sheet(width: float, height: float) -> Any:
    """An empty figure, sizes in inches, in the style of :func:`look`."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def look() -> Any:
    """The style of every sheet, as a context; ``PlotError`` where there is no matplotlib."""
    try:
        import matplotlib
    except ImportError:
        raise PlotError("pictures need matplotlib: pip install matplotlib") from None
    # whatever the user's matplotlibrc says; the backend stays: to set it would start a display
    plain: dict[Any, Any] = {x: y for x, y in matplotlib.rcParamsDefault.items() if x != "backend"}
    return matplotlib.rc_context(plain | LOOK)


def written(figure: Any, name: str, mark: str = ".") -> bytes:
    """The bytes of a picture, in the format of the ending of ``name``, with a decimal mark."""
    form, file = ending(name), io.BytesIO()
    if mark != ".":
        with_mark(figure, mark)
    laid_out(figure)
    figure.savefig(file, format=form[1:], **FORMATS[form])
    return file.getvalue()


DECIMAL = re.compile(r"(?<![\w./])([0-9]+)\.([0-9]+)(?=(?:e[+-]?[0-9]+)?(?![\w.]))")
"""A decimal number, alone: none in the name of a file."""


def with_mark(figure: Any, mark: str) -> None:
    """Write the numbers of a figure with another decimal mark: in its texts, and at its ticks."""
    from matplotlib.text import Text

    def text(shown: str) -> str:
        parts = shown.split("$")  # a comma between dollars is followed by a space
        parts[::2] = (DECIMAL.sub(rf"\1{mark}\2", x) for x in parts[::2])
        parts[1::2] = (DECIMAL.sub(rf"\1{{{mark}}}\2", x) for x in parts[1::2])
        return "$".join(parts)

    for panel in figure.get_axes():
        for axis in (panel.xaxis, panel.yaxis):
            for own in (axis.get_major_formatter(), axis.get_minor_formatter()):
                own.format_ticks = lambda x, told=own.format_ticks: [*map(text, told(x))]
                own.get_offset = lambda told=own.get_offset: text(told())
    for x in figure.findobj(Text):
        x.set_text(text(x.get_text()))


def laid_out(figure: Any) -> None:
    """Lay a figure out once and for all, places rounded: the solver of the layout does not always
    find the last digits alike.  The first layout does not know where titles go above panels of a
    fixed shape; the second does."""
    figure.draw_without_rendering()
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for column in figure.subfigs:
        for part in (column, *column.subfigs):
            corners = part.bbox_relative.get_points().round(5)
            part.bbox_relative.p0, part.bbox_relative.p1 = corners
    for panel in figure.get_axes():
        place = panel.get_position(original=True)
        panel.set_position(place.from_extents(*place.extents.round(5)), which="original")


def at_time(run: Any, k: int) -> str:
    """When instant k of a run is, with its unit."""
    return f"$t = {run.t[k]:.3g}$ {run.columns[0].unit}".rstrip()


def label(name: str) -> str:
    """The name of a column as a formula: ``zeta_1`` → ζ with the index 1, ``A2_11`` → A₂, the
    matrix of block 2, in parentheses with the indices 1, 1."""
    letter, index = letter_and_suffix(name)
    stem = letter.rstrip("0123456789")  # zeta2 is ζ of block 2
    shown, block = f"\\{stem}" if stem in GREEK else stem, letter[len(stem) :]
    if not re.fullmatch(r"\\?[A-Za-z]+", shown) or not re.fullmatch(r"\w*", index, re.A):
        return name.replace("$", r"\$")
    if len(letter) > 2 and stem not in GREEK:
        return name.replace("_", " ")
    if block:
        shown = f"({shown}_{{{block}}})" if index else f"{shown}_{{{block}}}"
    lower = index.replace("_", ",")
    return f"${shown}_{{{lower}}}$" if lower else f"${shown}$"


def time_label(run: Run) -> str:
    """t with its unit."""
    return with_unit("$t$", run.columns[0].unit)


def with_unit(text: str, unit: str) -> str:
    """A label with its unit, if there is one."""
    raised = unit.replace("^2", "²").replace("^3", "³")
    return f"{text} [{raised}]" if unit else text


def method_in_words(run: Run, word: Any) -> str:
    """The step of a run, with its tolerance as a power of ten, or the size of its steps."""
    told = str(run.facts.get("method", "?")).replace("$", r"\$")
    told = re.sub(r"^discrete of order(?= \d)", word("discrete of order"), told)
    return re.sub(r"\b(?:(\d\.?\d*)e)(-?)0*(\d+)$", _power, told)


def _power(found: re.Match[str]) -> str:
    digits = "" if found[1] == "1" else rf"{found[1]} \cdot "
    return f"${digits}10^{{{found[2]}{found[3]}}}$"


# Where the labels of marks stand: off the outline of an ellipsoid, off other labels and marks.

FONT = 7
"""The size of a label, in points, and about its height."""

GROUND = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.5}
ON_CURVES: dict[str, Any] = {"fontsize": FONT, "zorder": 5, "bbox": GROUND}
"""A label that may lie on curves."""

GAP, FREE = 5.0, 2.0
"""How far a label is from its mark, and what is left free about it, in points."""


def beside(
    places: Array, labels: Sequence[str], shadow: Array, points: float
) -> list[tuple[float, float]]:
    """Of each label its lower left corner from its mark, in points.

    ``places``: of the marks, (labels, 2); ``shadow``: M, 3 × 2, of which the rows uM, |u| = 1, fill
    what is seen of the ellipsoid; ``points``: how long a unit of both is, in points.
    """
    marks: Array = places * points
    gram = np.asarray(np.linalg.inv(shadow.T @ shadow) / points**2, dtype=float)
    boxes: list[tuple[Array, Array]] = [(x - GAP, x + GAP) for x in marks]
    found = []
    for k, (mark, text) in enumerate(zip(marks, labels, strict=True)):
        size: Array = np.array([width(text), FONT])
        others = [box for j, box in enumerate(boxes) if j != k]
        offsets = [*_around(size)]
        faults = [_faults(mark + x, size, gram, others) for x in offsets]
        best = offsets[int(np.argmin(faults))]
        boxes.append((mark + best, mark + best + size))
        found.append((round(float(best[0]), 1), round(float(best[1]), 1)))
    return found


def width(text: str) -> float:
    """How wide a label is, in points."""
    from matplotlib.textpath import TextPath

    return float(TextPath((0, 0), text, size=FONT).get_extents().width)


def _around(size: Array) -> Iterator[Array]:
    """The lower left corners of a box about a mark, the best first: above, below, at its height;
    right, left, across."""
    for y in (GAP - 1, 1 - GAP - size[1], -size[1] / 2):
        for x in (GAP, -GAP - size[0]):
            yield np.array([x, y])
    for y in (GAP + 1, -1 - GAP - size[1]):
        yield np.array([-size[0] / 2, y])


def _faults(corner: Array, size: Array, gram: Array, others: list[tuple[Array, Array]]) -> int:
    """How many things a box lies on: the outline, and other boxes."""
    low, high = corner - FREE, corner + size + FREE
    x, y = (np.linspace(low[k], high[k], 9) for k in (0, 1))
    edge = [*((a, b) for a in x for b in (low[1], high[1]))]
    edge += [(a, b) for a in (low[0], high[0]) for b in y]
    inside = [np.array(p) @ gram @ np.array(p) < 1 for p in edge]
    crossed = any(inside) and not all(inside)
    return crossed + sum(bool((low < b).all() and (a < high).all()) for a, b in others)
