"""Single changes of the equations of a record: signs, factors, terms, bars."""

import tomllib
from dataclasses import replace

from derive.language.tree import mul, neg
from derive.pipeline import walk
from derive.problem.toml import problem_of
from tests.problems import READY

TURNED = 'rotation = { axis = [1, 2, 2], angle = "pi/3" }'
TWINS = {
    "ellipsoid": [('"c"]', f'"c"]\nshift = [0.1, 0.2, 0.3]\n{TURNED}')],
    "saff3": [("at = [0, 0, 0]", "at = [1, 2, 3]")],
    "jelly": [
        ("at = [0, 0, 0]", "at = [0.1, 0.2, 0.3]"),
        ("between = [1, 3]", "on = 3\nanchor = [2, 3, 5]"),
    ],
    "sim3": [
        ("at = [0, 0, 0]", "at = [1, 2, 3]"),
        ("between = [1, 2]", "on = 1\nanchor = [2, 3, 5]"),
    ],
    "su2": [("between = [1, 2]", "on = 1\nanchor = [2, 3, 5, 7]")],
}
"""Bodies of which more is true than of any: c = 0, a point at the origin, forces whose sum is zero.
There some changes give other true equations; of a body and forces in general position, none."""


def twin(name, road=walk):
    """The record of a ready-made problem with its body and forces in general position."""
    text = (READY / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in TWINS[name]:
        assert old in text
        text = text.replace(old, new)
    return road(problem_of(tomllib.loads(text)))


def without_term(k):
    def change(t):
        rest = t[1:k] + t[k + 1 :]
        return rest[0] if len(rest) == 1 else ("add", *rest)

    return change


def subtrees(t, path=()):
    """Every subtree with the path that leads to it."""
    yield path, t
    if isinstance(t, tuple):
        for k, part in enumerate(t[1:], 1):
            yield from subtrees(part, (*path, k))


def replace_at(t, path, change):
    """The tree with change(subtree) for the subtree at ``path``."""
    if not path:
        return change(t)
    k = path[0]
    return (*t[:k], replace_at(t[k], path[1:], change), *t[k + 1 :])


def corruptions(equation):
    """Every change of sign, factor, term and bar on either side: (kind, equation)."""
    for side in ("lhs", "rhs"):
        tree = getattr(equation, side)
        for path, t in subtrees(tree):
            for kind, change in changes(t, side, path, equation):
                yield kind, replace(equation, **{side: replace_at(tree, path, change)})


def changes(t, side, path, equation):
    if path == () and side == "rhs":
        if t == 0:
            yield "zero", lambda _: 1
            return
        yield "sign", neg
        yield "factor", lambda x: mul(2, x)
    if not isinstance(t, tuple):
        return
    if t[0] == "T":
        yield "bar", lambda x: x[1]
    if t[0] == "add":
        for k in range(1, len(t)):
            yield "term", without_term(k)
            yield "sign", lambda x, k=k: (*x[:k], neg(x[k]), *x[k + 1 :])
            yield "factor", lambda x, k=k: (*x[:k], mul(2, x[k]), *x[k + 1 :])
