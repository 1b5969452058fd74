"""The gallery of the playground: each ready-made problem as a thing, with a small picture."""

import re
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

from derive.record.record import Derivation
from derive.views.figure.drawing import Scene, svg
from derive.views.figure.scene import scene

FILE = Path(__file__).with_name("gallery.toml")
THING = ("name", "en", "fr", "like", "group", "group_fr")
"""What is said of a thing, the last three of few."""
MARGIN = 1.0
"""Around a picture, in millimetres."""
LEFT_OUT = ("gravity", "force")
"""What a small picture has not, beside the letters."""


def shelves() -> list[dict[str, Any]]:
    """Those of the file, in order: titles in both languages, things by the names of their problems
    and their own; ``like``: the problem whose picture it has; ``group``, where it is called
    otherwise than in the problem, and in French otherwise still."""
    shelf_of = tomllib.loads(FILE.read_text(encoding="utf-8"))["shelf"]
    return [
        x | {"things": [dict(zip(THING, y, strict=False)) for y in x["things"]]} for x in shelf_of
    ]


def picture(record: Derivation) -> str:
    """The figure of a record's body as a small SVG, without letters and for the eye alone; empty
    where it has none."""
    found = scene(record)
    if found is None:
        return ""
    drawn = svg(_cropped(found))
    drawn = re.sub(r"<title>.*?</title>\n|<g [^>]*>\n</g>\n", "", drawn)
    drawn = re.sub(
        r' width="[\d.]*mm"| height="[\d.]*mm"| role="img"| style="max-[^"]*"', "", drawn
    )
    return drawn.replace("<svg ", '<svg aria-hidden="true" ').replace("\n", "")


def _cropped(found: Scene) -> Scene:
    """A scene without letters and what acts, as large as the rest."""
    strokes = [s for s in found.strokes if s.role not in LEFT_OUT]
    reach = [p for s in strokes for p in s.points]
    reach += [(d.at[0] + s * d.radius, d.at[1] + s * d.radius) for d in found.dots for s in (1, -1)]
    xs, ys = zip(*reach, strict=True)
    left, low = min(xs) - MARGIN, min(ys) - MARGIN
    return replace(
        found,
        width=max(xs) - left + MARGIN,
        height=max(ys) - low + MARGIN,
        strokes=tuple(
            replace(s, points=tuple((x - left, y - low) for x, y in s.points)) for s in strokes
        ),
        dots=tuple(replace(d, at=(d.at[0] - left, d.at[1] - low)) for d in found.dots),
        labels=(),
    )
