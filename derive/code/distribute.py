"""Common factors of a sum's terms in front: x a + x b = x (a + b), if none else needs x a."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from fractions import Fraction

from .graph import PARAMETER, Graph, Node
from .rewrite import Image

Term = tuple[Fraction, Node]


def distributed(graph: Graph, s: Node, uses: Mapping[Node, int], image: Image) -> Node:
    """The sum s of the images of its terms, with common factors in front.

    ``uses``: how often each old node stands; only products that stand here alone are taken apart.
    """
    free: list[Term] = []
    kept: list[Term] = []
    for c, x in zip(s.data, s.args, strict=True):
        alone = x.op == "mul" and uses[x] == 1 and x.stage != PARAMETER
        (free if alone else kept).append((c, image(x)))
    while (found := _common(free)) is not None:
        factor, chosen = found
        rest = [(c, _without(graph, x, factor)) for c, x in chosen]
        free = [term for term in free if term not in chosen]
        kept.append((Fraction(1), graph.product([factor, _looked_through(graph, rest)])))
    return graph.linear([*kept, *free])


def spread_over(graph: Graph, x: Node, uses: Mapping[Node, int]) -> Node | None:
    """p (q x + r y + …) with p in each term; ``None`` where that saves no multiplication."""
    if x.op != "mul" or len(x.args) != 2 or x.args[0].stage != PARAMETER:
        return None
    factor, moving = x.args
    terms = _terms(moving, uses)
    if len(terms) < 2 or not all(y.op == "mul" and y.args[0].stage == PARAMETER for _, y in terms):
        return None
    return graph.linear((c, graph.product((factor, y))) for c, y in terms)


def _terms(x: Node, uses: Mapping[Node, int]) -> list[Term]:
    """The terms of a sum, and of the named sums in it that nothing else uses."""
    inner = x.args[0] if x.op == "value" and uses[x] == 1 else x
    if inner.op != "add" or uses[x] > 1:
        return [(Fraction(1), x)]
    return [
        (c * k, z) for c, y in zip(inner.data, inner.args, strict=True) for k, z in _terms(y, uses)
    ]


def _common(terms: Sequence[Term]) -> tuple[Node, list[Term]] | None:
    """The factor, not of the parameters alone, that most terms share, and these terms."""
    count = Counter(
        f for _, x in terms if x.op == "mul" for f in set(x.args) if f.stage != PARAMETER
    )
    if not count:
        return None
    factor, most = min(count.items(), key=lambda item: (-item[1], item[0].id))
    if most < 2:
        return None
    return factor, [(c, x) for c, x in terms if x.op == "mul" and factor in x.args]


def _without(graph: Graph, x: Node, factor: Node) -> Node:
    """A product with this factor taken out once."""
    args = list(x.args)
    args.remove(factor)
    return graph.product(args)


def _looked_through(graph: Graph, terms: Sequence[Term]) -> Node:
    """The sum of the terms, with its named sums opened where all then cancels to a leaf."""
    opened = []
    for c, x in terms:
        inner = x.args[0] if x.op == "value" else x
        opened.append((c, inner if inner.op == "add" else x))
    whole = graph.linear(opened)
    return whole if whole.split[1].is_atom else graph.linear(terms)
