"""Reading a factored form off an expanded one.

dϖ vanishes on its kernel X, so it only sees variations with X δt taken away: the expanded sum is
its part at constant time with  δx − X δt  in place of each δx.  Here such a form is built and
compared with the expansion; what it does not account for is kept as further terms, so the result
is always equal to what was derived.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ..algebra.calculus import substitute
from ..algebra.word_trees import WordNotation, tree_of
from ..algebra.words import Expr, Letter, Traces, Word, number
from ..language.tree import Tree, add
from .chapter import Draft


def solve_for(e: Expr, x: Letter) -> Expr | None:
    """The y for which ``e = 0`` says x = y, by the terms between the same factors as x; ``None``
    where x does not occur alone."""
    for (traces, w), c in e.terms.items():
        places = [k for k, factor in enumerate(w) if factor == (x, False)]
        if len(places) == 1 and not traces:
            head, tail = w[: places[0]], w[places[0] + 1 :]
            return _same_place(e, head, tail, x, -1 / c)
    return None


def _same_place(e: Expr, head: Word, tail: Word, x: Letter, factor: object) -> Expr:
    """What stands in the place of x, times ``factor``, in the terms that begin with ``head`` and
    end with ``tail``."""
    terms: dict[tuple[Traces, Word], object] = {}
    size = len(head) + len(tail)
    for (traces, w), c in e.terms.items():
        middle = w[len(head) : len(w) - len(tail)]
        fits = len(w) > size and w[: len(head)] == head and w[len(w) - len(tail) :] == tail
        shape = middle and _shape(middle) == (x.rows, x.cols)
        if fits and shape and not any(y == x for y, _ in middle):
            terms[traces, middle] = c * factor  # type: ignore[operator]
    return Expr(x.rows, x.cols, terms, e.lineage)  # type: ignore[arg-type]


def _shape(w: Word) -> tuple[object, object]:
    (first, first_bar), (last, last_bar) = w[0], w[-1]
    return (first.cols if first_bar else first.rows, last.rows if last_bar else last.cols)


def factored_tree(
    d: Draft, e: Expr, core: Expr, images: Mapping[Letter, Expr], notation: WordNotation
) -> Tree:
    """The tree of ``e``: ``core`` with letters replaced by parenthesised sums, and whatever of
    ``e`` that leaves."""
    d.depends_on(e, *(images[x] for x in core.letters() if x in images))
    display = {**notation.display, **{x: tree_of(y) for x, y in images.items()}}
    remainder = e - substitute(core, images)
    shown = tree_of(core, replace(notation, display=display))
    return add(shown, tree_of(remainder, notation))


def at_constant_time(e: Expr, *times: Letter) -> Expr:
    """An expression with δt = δ′t = 0."""
    return substitute(e, {t: number(0) for t in times})
