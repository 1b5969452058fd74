"""Rewriting of a graph: operands first, then what they stand in."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from .graph import Node

Image = Callable[[Node], Node]
"""What became of a node under a rewriting; the node itself, where nothing did."""

Rule = Callable[[Node, Image], Node]
"""What becomes of a node, by the images of its operands."""


def operands(x: Node) -> Sequence[Node]:
    """The nodes that a node is computed from."""
    return x.args


def reachable(
    roots: Iterable[Node], within: Callable[[Node], Iterable[Node]] = operands
) -> list[Node]:
    """The nodes that some nodes are computed from, these included, operands first.

    ``within``: the operands of a node that are looked at.
    """
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
    """The images of ``roots`` when the nodes in ``order``, operands first, follow the rule.

    ``known``: nodes whose image is given already.
    """
    found = dict(known or {})

    def image(x: Node) -> Node:
        return found.get(x, x)

    for x in order:
        if x not in found:
            found[x] = rule(x, image)
    return [image(x) for x in roots]


def remade(x: Node, image: Image) -> Node:
    """The same operation on the images of the operands, under the same name if it has one."""
    g, args = x.graph, [image(y) for y in x.args]
    if all(a is b for a, b in zip(args, x.args, strict=True)):
        return x
    if x.op == "value":
        name, label, recorded = g.titles[x]
        return g.value(args[0], name, label, recorded=recorded)
    if x.op == "add":
        return g.linear(zip(x.data, args, strict=True))
    if x.op == "mul":
        return g.product(args)
    if x.op == "fun":
        return g.function(x.data, *args)
    return {"recip": g.recip, "none": g.none, "abs": g.magnitude}[x.op](args[0])


def replaced(x: Node, images: Mapping[Node, Node]) -> Node:
    """The node with images in place of some nodes; names are left behind."""

    def nameless(y: Node, image: Image) -> Node:
        return image(y.args[0]) if y.op == "value" else remade(y, image)

    return rewritten([x], reachable([x]), nameless, images)[0]
