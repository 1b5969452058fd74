"""Fewer multiplications: names that hide a common factor are looked through.

Some names are worth losing.  k·x, with k of the parameters alone, where each use multiplies it by
another such factor: the constants merge; so do numbers, where that pays.  And a summand that is a
sum of its own, where another summand has the same moving factors: their constants add.  At the end
what has a name gets it wherever it stands, and common factors go in front of sums.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from .distribute import distributed, spread_over
from .graph import PARAMETER, Graph, Node
from .schedule import frontier

PASSES = 4
NOTHING: Mapping[Node, Node] = MappingProxyType({})


def factored(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """The same values with fewer multiplications: of four ways the one that counts fewest."""
    ways = [
        _factored(graph, start, numbers)
        for start in dict.fromkeys((tuple(roots), tuple(spread(graph, roots))))
        for numbers in (False, True)
    ]
    return min(ways, key=cost)


def cost(roots: Sequence[Node]) -> int:
    """Multiplications in what moves, each value computed once, and constants to be loaded."""
    total = len(frontier(roots))
    for x in _reachable(roots):
        if x.op == "mul":
            total += len(x.args) - 1
        elif x.op == "add":
            total += sum(abs(c) != 1 for c in x.data)
    return total


def _factored(graph: Graph, roots: Sequence[Node], numbers: bool) -> list[Node]:
    found = list(roots)
    for _ in range(PASSES):
        lost = _lost(found, numbers)
        if not lost:
            break
        images = _rebuilt(graph, found, lost)
        found = [images[x] for x in found]
    images = _rebuilt(graph, found, set(), {x.args[0]: x for x in _values(found)})
    found = [images[x] for x in found]
    images = _rebuilt(graph, found, set(), sums=True)
    return [images[x] for x in found]


def spread(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """The same with p (q x + r y) as (pq) x + (pr) y, where p, q, r depend on parameters alone."""
    order = _reachable(roots)
    uses = Counter(roots) + Counter(y for x in order for y in x.args)
    opened = {x: other for x in order if (other := spread_over(graph, x, uses)) is not None}
    images = _rebuilt(graph, roots, set(), opened=opened) if opened else {}
    return [images.get(x, x) for x in roots]


def _values(roots: Sequence[Node]) -> list[Node]:
    return [x for x in _reachable(roots) if x.op == "value"]


def _reachable(roots: Iterable[Node]) -> list[Node]:
    """The moving nodes, operands first."""
    seen: set[Node] = set()
    stack = [x for x in roots if x.stage != PARAMETER]
    while stack:
        x = stack.pop()
        if x not in seen:
            seen.add(x)
            stack.extend(y for y in x.args if y.stage != PARAMETER)
    return sorted(seen, key=lambda x: x.id)


def _lost(roots: Sequence[Node], merging: bool) -> set[Node]:
    """The value nodes to look through."""
    order = _reachable(roots)
    parents: dict[Node, list[Node]] = defaultdict(list)
    for x in order:
        for y in x.args:
            parents[y].append(x)
    outputs = set(roots)
    inner = [x for x in order if x.op == "value" and x not in outputs]
    scaled = {x for x in inner if _is_scaled(x.args[0]) and all(map(_is_scaled, parents[x]))}
    single = {x for x in inner if x.args[0].op == "add" and len(parents[x]) == 1}
    sums = {parents[x][0] for x in single if parents[x][0].op == "add"}
    numbers = {x for x in single if merging and _numeric(x.args[0], parents[x][0])}
    return scaled | numbers | {x for s in sums for x in _sharing(s, single)}


def _numeric(x: Node, parent: Node) -> bool:
    """May the number in front of x, or that of its parent in front of all its terms, be merged?"""
    if len(x.args) == 1:
        return parent.op in ("add", "mul")
    scales = parent.op == "add" and len(parent.args) == 1 and abs(parent.data[0]) != 1
    return scales and all(abs(c) != 1 for c in x.data)


def _is_scaled(x: Node) -> bool:
    """Is it a product with a factor of the parameters, or a number times one?"""
    core = x.args[0] if x.op == "add" and len(x.args) == 1 else x
    return core.op == "mul" and core.args[0].stage == PARAMETER


def _moving(x: Node) -> tuple[Node, ...]:
    """The factors that do not depend on parameters alone."""
    return tuple(y for y in x.args if y.stage != PARAMETER) if x.op == "mul" else (x,)


def _sharing(s: Node, single: set[Node]) -> list[Node]:
    """The summands that are sums of their own and have moving factors in common with the rest."""
    own = {x: [_moving(y) for y in (x.args[0].args if x in single else (x,))] for x in s.args}
    count = Counter(m for moving in own.values() for m in set(moving))
    return [x for x in s.args if x in single and any(count[m] > 1 for m in own[x])]


def _rebuilt(
    graph: Graph,
    roots: Sequence[Node],
    lost: set[Node],
    named: Mapping[Node, Node] = NOTHING,
    *,
    sums: bool = False,
    opened: Mapping[Node, Node] = NOTHING,
) -> dict[Node, Node]:
    """Old node → new node; what depends on parameters alone stays as it is.

    ``named``: sums and products that have a name; where they stand without it, they get it.
    ``sums``: common factors of the terms of sums are taken in front of them.  ``opened``: nodes
    that stand otherwise.
    """
    order = _reachable(roots)
    uses = Counter(roots) + Counter(y for x in order for y in x.args) if sums else Counter()
    images: dict[Node, Node] = {x: x for x in roots if x.stage == PARAMETER}
    for x in order:
        other = {} if x.op == "value" else named
        args = [images.get(other.get(y, y), other.get(y, y)) for y in x.args]
        if x in opened:
            images[x] = opened[x]
        elif x in lost:
            images[x] = args[0]
        elif sums and x.op == "add" and len(x.args) > 1:
            images[x] = distributed(graph, x, uses, images)
        elif all(a is b for a, b in zip(args, x.args, strict=True)):
            images[x] = x
        elif x.op == "value":
            name, label, given = graph.titles[x]
            images[x] = graph.value(args[0], name, label, given=given)
        elif x.op == "add":
            images[x] = graph.linear(zip(x.data, args, strict=True))
        elif x.op == "mul":
            images[x] = graph.product(args)
        elif x.op == "recip":
            images[x] = graph.recip(args[0])
        elif x.op == "fun":
            images[x] = graph.function(x.data, args[0])
        elif x.op == "none":
            images[x] = graph.none(args[0])
        else:
            images[x] = graph.magnitude(args[0])
    return images
