"""The value of a tree over any ring: fractions, dual numbers, floats, SymPy expressions.

A value is a scalar, or a matrix as a tuple of rows (a vector is a matrix of one column).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache, reduce
from typing import Any

from ..language import rational as q
from ..language.tree import Tree
from .arithmetic import (
    EvaluationError,
    Value,
    determinant,
    hat,
    inner,
    inverse,
    is_matrix,
    number,
    plus,
    power,
    reciprocal,
    times,
    trace,
    transpose,
    wedge,
)
from .elementary_values import ElementaryValues
from .function_signatures import AXIS, INDEX_SETS, LATTICE, MATRICES, POINT

LARGEST_NESTING = 3


@dataclass
class Environment:
    """Values of names, of the members of indexed families, and of functions.

    ``functions[name](arguments, environment)`` receives the argument trees.  ``listed``: of the
    points, those that may be named by their numbers.  ``copies``: how often each point is there.
    ``unit``: the 1 of the identity, and of sums over all axes.  ``lattice``: the points that an
    index of the lattice counts; ``at_once``: all the points as one value, the index 0, where sums
    over them and what is said of any are taken so; ``known``: what then has no other index.
    """

    size: int
    names: Mapping[str, Value]
    families: Mapping[str, Mapping[tuple[int, ...], Value]] = field(default_factory=dict)
    functions: Mapping[str, Callable[..., Value]] = field(default_factory=dict)
    parameters: Mapping[str, Value] = field(default_factory=dict)
    indices: Mapping[str, int] = field(default_factory=dict)
    elementary: Callable[[str, Value], Value] | None = None
    listed: int = 0
    copies: Sequence[Any] = ()
    unit: Any = Fraction(1)
    lattice: Sequence[tuple[int, int]] = ()
    at_once: Value = None
    known: dict[Tree, Value] = field(default_factory=dict)

    def with_index(self, name: str, value: int) -> Environment:
        """A copy of the environment with one index bound to a number."""
        return replace(self, indices={**self.indices, name: value})


def evaluate(t: Tree, env: Environment) -> Value:
    """The value of a tree; :class:`EvaluationError` when it has none."""
    if isinstance(t, str):
        if t in LATTICE and t in env.indices:
            i = env.indices[t]
            return tuple((Fraction(x),) for x in env.lattice[i - 1]) if i else env.at_once
        try:
            return env.names[t]
        except KeyError:
            raise EvaluationError(f"no value for {t!r}") from None
    if isinstance(t, (int, Fraction)):
        return Fraction(t)
    if env.at_once is None or 0 not in env.indices.values():
        return _of_head(t, env)
    if any(env.indices.get(x, 0) for x in indices_in(t)):
        return _of_head(t, env)
    if t not in env.known:
        env.known[t] = _of_head(t, env)
    return env.known[t]


def _of_head(t: tuple[Any, ...], env: Environment) -> Value:
    """The value of a tree by its head."""
    op = t[0]
    try:
        if op in STRUCTURAL:
            return STRUCTURAL[op](t, env)
        return OPERATIONS[op](*(evaluate(x, env) for x in t[1:]), env=env)
    except (IndexError, TypeError, ZeroDivisionError) as error:
        raise EvaluationError(f"{op}: {error}") from error


def _add(*terms: Value, env: Environment) -> Value:
    del env
    total = terms[0]
    for term in terms[1:]:
        total = plus(total, term)
    return total


def _mul(*factors: Value, env: Environment) -> Value:
    del env
    scalars = [x for x in factors if not is_matrix(x)]
    matrices = [x for x in factors if is_matrix(x)]
    product = matrices[0] if matrices else Fraction(1)
    for x in matrices[1:]:
        product = times(product, x)
    for x in scalars:
        product = times(x, product)
    return product


OPERATIONS: dict[str, Callable[..., Value]] = {
    "add": _add,
    "mul": _mul,
    "div": lambda a, b, env: times(a, reciprocal(b)),
    "T": lambda x, env: transpose(x),
    "tr": lambda x, env: trace(x),
    "det": lambda x, env: determinant(x),
    "inv": lambda x, env: inverse(x),
    "one": lambda env: q.scaled(env.unit, q.identity(env.size)),
    "inner": lambda a, b, env: inner(a, b),
    "metric": lambda m, a, b, env: inner(a, b, m),
    "norm2": lambda *x, env: inner(x[-1], x[-1], x[0] if len(x) == 2 else None),
    "bracket": lambda a, b, env: plus(times(a, b), times(Fraction(-1), times(b, a))),
    "wedge": lambda a, b, env: wedge(a, b),
    "hat": lambda a, env: hat(a),
    "row": lambda *x, env: tuple(map(number, x)),
    "matrix": lambda *rows, env: _matrix(rows),
    "pow": lambda x, n, env: power(x, n),
}


def _matrix(rows: tuple[Any, ...]) -> Value:
    if len({len(row) for row in rows}) != 1:
        raise EvaluationError("the rows of a matrix must be of one length")
    return rows


def _sum(t: tuple[Any, ...], env: Environment) -> Value:
    """The value of Σ_index body over the members of the families that the index counts."""
    _, index, body = t
    if index in env.indices or len(env.indices) >= LARGEST_NESTING:
        raise EvaluationError(f"sums nested deeper than {LARGEST_NESTING}, or an index bound twice")
    counted, members = _range(body, index, env)
    if not members:
        raise EvaluationError(f"the sum over {index!r} has no members")
    if counted == "lattice" and env.at_once is not None and 0 not in env.indices.values():
        found = evaluate(body, env.with_index(index, 0))
        if not hasattr(found, "total"):
            raise EvaluationError("sums over the lattice are of numbers, and of multiples of T(𝐧)")
        return found.total()
    often = env.copies if counted == POINT else ()
    terms = (evaluate(body, env.with_index(index, i)) for i in members)
    if counted == AXIS:
        terms = (times(env.unit, x) for x in terms)
    if often:
        terms = (times(often[i - 1], x) for i, x in zip(members, terms, strict=True))
    return reduce(plus, terms)


def _range(body: Tree, index: str, env: Environment) -> tuple[str, list[int]]:
    """What an index of a tree counts, "" for nothing, and its values in order.

    ``EvaluationError`` where it does not count the same members in all families in which it stands:
    the sum, or the equation, would then be about a few members only.
    """
    spans = [*_spans(body, index, env)]
    if any(x != spans[0] for x in spans):
        raise EvaluationError(f"the index {index!r} is not that of the same members everywhere")
    return (spans[0][0], sorted(spans[0][1])) if spans else ("", [])


def _spans(t: Tree, index: str, env: Environment) -> Iterator[tuple[str, set[int]]]:
    """What an index counts, and its values, for each place of a tree in which it stands."""
    if t == index and index in LATTICE:
        yield "lattice", {*range(1, len(env.lattice) + 1)}
    if not isinstance(t, tuple):
        return
    if t[0] == "entry" and index in t[2:]:
        value = evaluate(t[1], env)
        if not is_matrix(value):
            raise EvaluationError("entries of matrices and vectors only")
        yield AXIS, {*range(1, len(value if t[2] == index else value[0]) + 1)}
    elif t[0] == "at" and index in t[2:]:
        family = env.families.get(t[1])
        if not family:
            raise EvaluationError(f"no members of {t[1]!r}")
        yield INDEX_SETS[t[1]], {i for (i,) in family}
    else:
        for part in t[1:]:
            yield from _spans(part, index, env)


@lru_cache(2**12)
def indices_in(t: Tree) -> frozenset[str]:
    """The indices of the lattice in a tree."""
    if isinstance(t, tuple):
        return frozenset().union(*map(indices_in, t))
    return frozenset({t} if isinstance(t, str) and t in LATTICE else ())


def free_indices(t: Tree) -> set[str]:
    """The indices in a tree that no sum binds: an equation holds for each of their values."""
    if not isinstance(t, tuple):
        return {t} if isinstance(t, str) and t in LATTICE else set()
    if t[0] in ("at", "entry"):
        return {i for i in t[2:] if isinstance(i, str)}
    inside: set[str] = set().union(*(free_indices(x) for x in t[1:]))
    return inside - {t[1]} if t[0] == "sum" else inside


def index_values(t: Tree, index: str, env: Environment) -> list[int]:
    """The values of a free index of a tree; ``EvaluationError`` where it has none."""
    _, found = _range(t, index, env)
    if not found:
        raise EvaluationError(f"the index {index!r} has no values")
    return found


def point_index(i: Any, env: Environment) -> int:
    """The number of a point, from 1: the value of a bound index, or a number by which the problem
    lists it; ``EvaluationError`` for any other."""
    if isinstance(i, int) and not 1 <= i <= env.listed:
        raise EvaluationError(f"the problem lists no point {i}")
    return _index(i, env)


def _index(i: Any, env: Environment) -> int:
    if isinstance(i, int):
        return i
    if i not in env.indices:
        raise EvaluationError(f"unbound index {i!r}")
    return env.indices[i]


def _at(t: tuple[Any, ...], env: Environment) -> Value:
    number = point_index if INDEX_SETS.get(t[1]) == POINT else _index
    key = tuple(number(i, env) for i in t[2:])
    try:
        return env.families[t[1]][key]
    except KeyError:
        raise EvaluationError(f"no member {key} of {t[1]!r}") from None


def _entry(t: tuple[Any, ...], env: Environment) -> Value:
    value = evaluate(t[1], env)
    places = [_index(i, env) for i in t[2:]]
    if min(places) < 1 or not is_matrix(value):
        raise EvaluationError("entries of matrices and vectors are counted from 1")
    if len(places) != 1 + (len(value[0]) > 1 or t[1] in MATRICES):
        raise EvaluationError("a vector has entries of one index, a matrix of two")
    return value[places[0] - 1][places[-1] - 1 if len(places) == 2 else 0]


def _call(t: tuple[Any, ...], env: Environment) -> Value:
    key = t[1][1] if isinstance(t[1], tuple) else t[1]
    if key not in env.functions:
        raise EvaluationError(f"no function {key!r}")
    return env.functions[key](t[1], t[2:], env)


def _function(t: tuple[Any, ...], env: Environment) -> Value:
    value = evaluate(t[2], env)
    if env.elementary is None or is_matrix(value):
        raise EvaluationError(f"no value of the function {t[1]!r}")
    if isinstance(t[2], (int, Fraction)) and isinstance(env.elementary, ElementaryValues):
        return env.elementary.written(t[1], t[2])
    return env.elementary(t[1], value)


def _parameter(t: tuple[Any, ...], env: Environment) -> Value:
    if t[1] not in env.parameters:
        raise EvaluationError(f"no parameter {t[1]!r}")
    return env.parameters[t[1]]


STRUCTURAL: dict[str, Callable[[tuple[Any, ...], Environment], Value]] = {
    "sum": _sum,
    "at": _at,
    "entry": _entry,
    "call": _call,
    "fun": _function,
    "par": _parameter,
}
