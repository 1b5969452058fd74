"""Displays of the lecture as LaTeX: in several lines where they are wide, in several displays where
they are tall, with brackets as tall as what is in them; letters for sums within roots and
quotients, where these make an equation wider than the text."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

from ..language.tree import Tree, nodes, replaced
from ..record.record import Equation
from ..views.layout import broken, indented
from ..views.printing.letters import NAMES
from ..views.printing.tex import formula
from ..views.printing.typeset import Formula, literal, measure, plain
from ..views.text import aligned
from .common_factors import tidied

WIDTH, TALL = 36.0, 14
"""The width of a display in em; the most rows of one that no page parts."""
FEW_ROWS = 3
LAST = re.compile(r"(\n\\end\{aligned\})?\Z")
"""Where the last line of a display ends."""


LETTERS = NAMES | {"free rho": r"\rho"}
"""Name → LaTeX; in the walks of the text ρ means nothing else: it is free for a parameter."""


def displayed(x: Formula) -> str:
    """A display as LaTeX; one that is too wide in several lines."""
    first, *others = broken(x.tex, WIDTH)
    if not others:
        return tall(first.text)
    rows = [f"&{first.text}", *("&" + indented(line, 1) for line in others)]
    return tall("\n".join((r"\begin{aligned}", " \\\\\n".join(rows), r"\end{aligned}")))


def blocks(equations: Sequence[Equation], sign: str = "") -> str:
    """Equations of a record as displays, which a page may part: short ones below one another, one
    that is too wide in several lines; behind the last a ``sign``."""
    found: list[str] = []
    for (wide, family), run in groupby(equations, _manner):
        together = [*run]
        if wide:
            found += [displayed(sides(e)) for e in together]
        elif family and together[1:]:
            found += _side_by_side(together)
        else:
            found += [tall(y) for x in _parted(together) for y in aligned(x, LETTERS)]
    found[-1] = LAST.sub(lambda x: sign + x[0], found[-1], count=1)
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


LEAST = 10.0
"""The width, in em, from which a sum gets a letter."""
SUMS = "SNDXY"
"""What sums are called, with an index, by the first of these letters that a text does not have."""


class NamedSums:
    """The letters of a chapter: one sum, one letter; ``used``: the names that its equations have,
    ``parameters``: in the order in which they stand in a product.
    Where a letter is first used, its definition stands below."""

    def __init__(self, used: Iterable[str], parameters: Iterable[str] = ()):
        self.order = (*parameters,)
        used = {*used, *self.order}
        self.letter = next(x for x in SUMS if not any(y.startswith(x) for y in used))
        self.sums: dict[Tree, Tree] = {}
        self._shown: dict[tuple[Equation, ...], tuple[Equation, ...]] = {}

    def equations(self, told: Sequence[Equation]) -> tuple[Equation, ...]:
        """Equations with letters for sums where they are too wide, and what the letters are; the
        same for both languages."""
        if (told := tuple(told)) not in self._shown:
            self._shown[told] = self._named(told)
        return self._shown[told]

    def _named(self, told: Sequence[Equation]) -> tuple[Equation, ...]:
        # a Lagrangian that is typed keeps the order in which it is
        left = [tidied(e, () if e.lhs == "L̃" else self.order) for e in told]
        found: list[Equation] = []
        while left:
            e = left.pop(0)
            new: list[Equation] = []
            while measure(plain(sides(e).tex)) > WIDTH and (sum_ := self._chosen(e.rhs)):
                if sum_ not in self.sums:
                    self.sums[sum_] = ("at", self.letter, len(self.sums) + 1)
                    new.append(Equation(self.sums[sum_], sum_))
                e = Equation(e.lhs, replaced(e.rhs, sum_, self.sums[sum_]), e.for_all, e.exists)
            found.append(e)
            left = new + left
        return tuple(found)

    def _chosen(self, t: Tree) -> Tree:
        """The widest of the sums within roots and quotients that have neither in them; 0 if none
        is."""
        return max(_within(t), key=_width, default=0)


def _width(t: Tree) -> float:
    return measure(plain(formula(t).tex))


def _within(t: Tree, *, inside: bool = False) -> Iterator[Tree]:
    """The sums within a root or a quotient of a tree that are wide and have neither in them."""
    if not isinstance(t, tuple):
        return
    if inside and t[0] == "add" and not any(map(_divided, nodes(t))):
        if _width(t) > LEAST:
            yield t
        return
    for x in t[1:]:
        yield from _within(x, inside=inside or _divided(t))


def _divided(t: Tree) -> bool:
    """Is a tree a quotient, but by a number, or a function as a root?"""
    if not isinstance(t, tuple):
        return False
    return t[0] in ("inv", "fun", "call") or (t[0] == "div" and not isinstance(t[2], int))
