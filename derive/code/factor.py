"""Fewer multiplications: names that hide a common factor, and factors in front of sums."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction

from .graph import PARAMETER, Graph, Image, Node, Rule, reachable, remade, rewritten
from .schedule import frontier

PASSES = 4


def factored(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """Nodes of the same values with fewer multiplications: of four ways the cheapest."""
    ways = [
        _factored(graph, start, numbers)
        for start in dict.fromkeys((tuple(roots), tuple(spread(graph, roots))))
        for numbers in (False, True)
    ]
    return min(ways, key=cost)


def cost(roots: Sequence[Node]) -> int:
    """Multiplications of nodes that vary with the state, plus constants to be loaded."""
    total = len(frontier(roots))
    for x in _moving_in(roots):
        if x.op == "mul":
            total += len(x.args) - 1
        elif x.op == "add":
            total += sum(abs(c) != 1 for c in x.data)
    return total


def _factored(graph: Graph, roots: Sequence[Node], numbers: bool) -> list[Node]:
    """The same values after one of the four ways: names lost, restored, factors in front."""
    found = list(roots)
    for _ in range(PASSES):
        lost = _lost(found, numbers)
        if not lost:
            break
        found = rewritten(found, _moving_in(found), _looking_through(lost))
    found = rewritten(found, order := _moving_in(found), _naming(order))
    return rewritten(found, order := _moving_in(found), _distributing(graph, found, order))


def spread(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """The nodes with p (q x + r y) as (pq) x + (pr) y where p, q, r depend on parameters alone."""
    order = _moving_in(roots)
    uses = _uses(roots, order)
    opened = {x: other for x in order if (other := spread_over(graph, x, uses)) is not None}
    return rewritten(roots, order, remade, opened) if opened else list(roots)


def _looking_through(lost: set[Node]) -> Rule:
    """The rule that replaces the value nodes in ``lost`` by what they name."""
    return lambda x, image: image(x.args[0]) if x in lost else remade(x, image)


def _naming(order: Sequence[Node]) -> Rule:
    """The rule that puts the named node wherever the same sum or product stands nameless."""
    named = {x.args[0]: x for x in order if x.op == "value"}

    def rule(x: Node, image: Image) -> Node:
        return remade(x, image if x.op == "value" else lambda y: image(named.get(y, y)))

    return rule


def _distributing(graph: Graph, roots: Sequence[Node], order: Sequence[Node]) -> Rule:
    """The rule that takes common factors of the terms of a sum in front of it."""
    uses = _uses(roots, order)

    def rule(x: Node, image: Image) -> Node:
        several = x.op == "add" and len(x.args) > 1
        return distributed(graph, x, uses, image) if several else remade(x, image)

    return rule


def _uses(roots: Sequence[Node], order: Sequence[Node]) -> Counter[Node]:
    """Node → how often it is an operand or a root."""
    return Counter(roots) + Counter(y for x in order for y in x.args)


def _moving_in(roots: Iterable[Node]) -> list[Node]:
    """The nodes reached that do not depend on parameters alone, operands first."""

    def moving(nodes: Iterable[Node]) -> list[Node]:
        return [x for x in nodes if x.stage != PARAMETER]

    return reachable(moving(roots), lambda x: moving(x.args))


def _lost(roots: Sequence[Node], merging: bool) -> set[Node]:
    """The value nodes whose names hide a common factor, or a number that could be merged."""
    order = _moving_in(roots)
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
    """Can the numbers in front of the sum x merge with those of its one parent?"""
    if len(x.args) == 1:
        return parent.op in ("add", "mul")
    scales = parent.op == "add" and len(parent.args) == 1 and abs(parent.data[0]) != 1
    return scales and all(abs(c) != 1 for c in x.data)


def _is_scaled(x: Node) -> bool:
    """Is it a product with a factor of the parameters alone, or a number times one?"""
    _, core = x.split
    return core.op == "mul" and core.args[0].stage == PARAMETER


def _moving(x: Node) -> tuple[Node, ...]:
    """The factors of a product that do not depend on parameters alone."""
    return tuple(y for y in x.args if y.stage != PARAMETER) if x.op == "mul" else (x,)


def _sharing(s: Node, single: set[Node]) -> list[Node]:
    """The named sums among the summands of s that share moving factors with the other summands."""
    own = {x: [_moving(y) for y in (x.args[0].args if x in single else (x,))] for x in s.args}
    count = Counter(m for moving in own.values() for m in set(moving))
    return [x for x in s.args if x in single and any(count[m] > 1 for m in own[x])]


# Common factors of a sum's terms in front: x a + x b = x (a + b), if none else needs x a.

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
