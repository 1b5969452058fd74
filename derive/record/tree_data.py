"""Trees as plain data: names, integers, fractions as strings, operators as lists."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any

from ..language.limits import TREE
from ..language.tree import OPERATORS, Tree
from .record import RecordError
from .shape import tree_shape


def encode(t: Tree) -> Any:
    """A tree as plain data: names, integers, fractions as strings "p/q", operators as lists."""
    if isinstance(t, Fraction):
        return f"{t.numerator}/{t.denominator}"
    return [t[0], *(encode(x) for x in t[1:])] if isinstance(t, tuple) else t


def decode(data: Any, where: str, depth: int = 0) -> Tree:
    """The inverse of :func:`encode`; :class:`RecordError` for anything that is not a tree."""
    if depth > TREE:
        raise RecordError(f"{where}: tree deeper than {TREE}")
    if isinstance(data, str):
        if re.fullmatch(r"-?[0-9]{1,4000}/0*[1-9][0-9]{0,4000}", data):
            return Fraction(data)
        if not data or not data.isprintable():
            raise RecordError(f"{where}: a name may not be {ascii(data)[:40]}")
        return data
    if isinstance(data, int) and not isinstance(data, bool):
        return data
    if isinstance(data, list) and data and isinstance(data[0], str):
        arity = OPERATORS.get(data[0])
        if arity is None:
            raise RecordError(f"{where}: unknown operator {data[0][:20]!r}")
        least, most = arity
        if len(data) - 1 < least or (most is not None and len(data) - 1 > most):
            raise RecordError(f"{where}: {data[0]!r} with {len(data) - 1} operands")
        found = (data[0], *(decode(x, where, depth + 1) for x in data[1:]))
        if wrong := tree_shape(found):
            raise RecordError(f"{where}: {data[0]!r}: {wrong}")
        return found
    raise RecordError(f"{where}: not an operator tree: {type(data).__name__}")
