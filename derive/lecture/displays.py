"""Displays of the lecture as LaTeX: in several lines where they are wide, in several displays where
they are tall, with brackets as tall as what is in them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from ..record.record import Equation
from ..views.layout import broken, indented
from ..views.printing.letters import NAMES
from ..views.printing.tex import formula
from ..views.printing.typeset import Formula, literal, measure, plain
from ..views.text import aligned

WIDTH, TALL = 36.0, 14
"""The width of a display in em; the most rows of one that no page parts."""
FEW_ROWS = 3


LETTERS = NAMES | {"free rho": r"\rho"}
"""Name → LaTeX; in the walks of the text ρ means nothing else: it is free for a parameter."""


def displayed(x: Formula) -> str:
    """A display as LaTeX; one that is too wide in several lines."""
    first, *others = broken(x.tex, WIDTH)
    if not others:
        return tall(first.text)
    rows = [f"&{first.text}", *("&" + indented(line, 1) for line in others)]
    return tall("\n".join((r"\begin{aligned}", " \\\\\n".join(rows), r"\end{aligned}")))


def blocks(equations: Sequence[Equation]) -> str:
    """Equations of a record as displays, which a page may part: short ones below one another, one
    that is too wide in several lines."""
    found: list[str] = []
    for (wide, family), run in groupby(equations, _manner):
        together = [*run]
        if wide:
            found += [displayed(sides(e)) for e in together]
        elif family and together[1:]:
            found += _side_by_side(together)
        else:
            found += [tall(y) for x in _parted(together) for y in aligned(x, LETTERS)]
    return "\\]\n\\[".join(found)


def _manner(e: Equation) -> tuple[bool, str]:
    """Is an equation too wide? If it is narrow, the letter of a family of which a member is a
    number or a column of some."""
    width = measure(plain(sides(e).tex))
    family = str(e.lhs[1]) if isinstance(e.lhs, tuple) and e.lhs[0] == "at" else ""
    single = not isinstance(e.rhs, tuple) or e.rhs[0] == "par"
    column = isinstance(e.rhs, tuple) and e.rhs[0] == "matrix" and len(e.rhs) > FEW_ROWS
    return width > WIDTH, family if width < WIDTH / 2 and (column or single) else ""


def _side_by_side(equations: Sequence[Equation]) -> Iterator[str]:
    """Equations beside one another, as many as are no wider than the text."""
    line = ""
    for tex in (plain(sides(e).tex) for e in equations):
        both = f"{line},\\qquad {tex}"
        if line and measure(both) > WIDTH:
            yield tall(line)
        line = both if line and measure(both) <= WIDTH else tex
    yield tall(line)


def _parted(equations: Sequence[Equation]) -> Iterator[list[Equation]]:
    """Equations in displays of at most TALL rows, between which a page may end; those of a family
    stand side by side."""
    part: list[Equation] = []
    rows = 0
    for _, run in groupby(equations, lambda e: e.lhs[:2] if isinstance(e.lhs, tuple) else e.lhs):
        alike = [*run]
        height = 1 + max(plain(sides(e).tex).count(r" \\") for e in alike)
        if part and rows + height > TALL:
            yield part
            part, rows = [], 0
        part += alike
        rows += height
    yield part


def sides(e: Equation) -> Formula:
    """An equation as a formula."""
    return formula(e.lhs, LETTERS) + literal(" = ") + formula(e.rhs, LETTERS)


def tall(tex: str) -> str:
    """LaTeX with larger brackets about what has a fraction in it."""
    opened: list[int] = []
    found = [*tex]
    for k, c in enumerate(tex):
        if c == "(":
            opened.append(k)
        elif c == ")" and opened and r"\frac" in tex[(start := opened.pop()) : k]:
            found[start], found[k] = r"\biggl(", r"\biggr)"
    return "".join(found)
