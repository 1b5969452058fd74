"""A tree that is evaluated at many points, with what is the same at all of them computed once.

Moments of a turned solid are long expressions in parameters, and stand in a Lagrangian a thousand
times; with respect to the entries of g and the coordinates of Z they are numbers.
"""

from __future__ import annotations

from ...language.tree import Tree
from ..arithmetic import Value
from ..evaluate import Environment, evaluate


def settled(t: Tree, env: Environment) -> tuple[Tree, dict[str, Value]]:
    """The tree with a name for each of its largest parts that speak of parameters, numbers and
    names of ``env`` alone, and the values of these names, which no record can have; equal parts
    have one name.
    """
    named: dict[Tree, str] = {}

    def short(x: Tree) -> Tree:
        if not isinstance(x, tuple) or x[0] == "par":
            return x
        if is_settled(x, env):
            return named.setdefault(x, f"\0{len(named)}")
        return (x[0], *map(short, x[1:]))

    tree = short(t)
    return tree, {name: evaluate(x, env) for x, name in named.items()}


def is_settled(t: Tree, env: Environment) -> bool:
    """Does a tree speak of parameters, numbers and names of ``env`` alone?"""
    if isinstance(t, str):
        return t in env.names
    if not isinstance(t, tuple) or t[0] == "par":
        return True
    return all(is_settled(x, env) for x in t[2 if t[0] == "fun" else 1 :])
