"""A graph is gone through and rewritten in one way: operands first, then what they stand in."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from .graph import Node

Image = Callable[[Node], Node]
"""What became of a node; itself, where nothing did."""

Rule = Callable[[Node, Image], Node]
"""What becomes of a node."""


def operands(x: Node) -> Sequence[Node]:
    """The nodes that a node is computed from."""
    return x.args


def reachable(
    roots: Iterable[Node], within: Callable[[Node], Iterable[Node]] = operands
) -> list[Node]:
    """Nodes, their operands within what is looked at, the operands of these …, operands first."""
    seen: set[Node] = set()
    stack = list(roots)
    while stack:
        x = stack.pop()
        if x not in seen:
            seen.add(x)
            stack.extend(within(x))
    return sorted(seen, key=lambda x: x.id)


def rewritten(
    roots: Sequence[Node],
    order: Iterable[Node],
    rule: Rule,
    known: Mapping[Node, Node] | None = None,
) -> list[Node]:
    """What becomes of some nodes when those in ``order``, operands first, are rewritten."""
    found = dict(known or {})

    def image(x: Node) -> Node:
        return found.get(x, x)

    for x in order:
        if x not in found:
            found[x] = rule(x, image)
    return [image(x) for x in roots]


def remade(x: Node, image: Image) -> Node:
    """The same operation on what became of the operands, under the same name if it has one."""
    g, args = x.graph, [image(y) for y in x.args]
    if all(a is b for a, b in zip(args, x.args, strict=True)):
        return x
    if x.op == "value":
        name, label, given = g.titles[x]
        return g.value(args[0], name, label, given=given)
    if x.op == "add":
        return g.linear(zip(x.data, args, strict=True))
    if x.op == "mul":
        return g.product(args)
    if x.op == "fun":
        return g.function(x.data, args[0])
    return {"recip": g.recip, "none": g.none, "abs": g.magnitude}[x.op](args[0])


def replaced(x: Node, images: Mapping[Node, Node]) -> Node:
    """The value of a node when some are others; names are left behind."""

    def nameless(y: Node, image: Image) -> Node:
        return image(y.args[0]) if y.op == "value" else remade(y, image)

    return rewritten([x], reachable([x]), nameless, images)[0]
