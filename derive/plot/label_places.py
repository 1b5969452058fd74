"""Where the labels of marks stand: off the outline of an ellipsoid, off other labels and marks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..motion.run import Array

FONT = 7
"""The size of a label, in points, and about its height."""

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
