"""The value of a tree over any ring: fractions, dual numbers, floats; elementary functions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache, reduce
from typing import Any

from ...language import rational as q
from ...language.intervals import Interval
from ...language.intervals import function as bounds
from ...language.tree import Tree
from ...language.univariate import Quadratic, root
from ..form.function_signatures import AXIS, INDEX_SETS, LATTICE, MATRICES, POINT
from .arithmetic import (
    EvaluationError,
    Nilpotent,
    Value,
    Varying,
    derivative_in,
    determinant,
    hat,
    inner,
    inverse,
    is_matrix,
    nilpotent,
    number,
    plus,
    power,
    reciprocal,
    times,
    trace,
    transpose,
    wedge,
)
from .residue import Graded

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
        return OPERATIONS[op](*(evaluate(x, env) for x in t[1:]))
    except (IndexError, TypeError, ZeroDivisionError) as error:
        raise EvaluationError(f"{op}: {error}") from error


def _mul(*factors: Value) -> Value:
    scalars = [x for x in factors if not is_matrix(x)]
    matrices = [x for x in factors if is_matrix(x)]
    product = reduce(times, matrices or [Fraction(1)])
    return reduce(lambda y, x: times(x, y), scalars, product)


def _matrix(*rows: Any) -> Value:
    if len({len(row) for row in rows}) != 1:
        raise EvaluationError("the rows of a matrix must be of one length")
    return rows


OPERATIONS: dict[str, Callable[..., Value]] = {
    "add": lambda *terms: reduce(plus, terms),
    "mul": _mul,
    "div": lambda a, b: times(a, reciprocal(b)),
    "T": transpose,
    "tr": trace,
    "det": determinant,
    "inv": inverse,
    "inner": inner,
    "metric": lambda m, a, b: inner(a, b, m),
    "norm2": lambda *x: inner(x[-1], x[-1], x[0] if len(x) == 2 else None),
    "bracket": lambda a, b: plus(times(a, b), times(Fraction(-1), times(b, a))),
    "wedge": wedge,
    "hat": hat,
    "row": lambda *x: tuple(map(number, x)),
    "matrix": _matrix,
    "pow": power,
}


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
    if isinstance(env.elementary, ElementaryValues) and env.elementary.bounded:
        match t:
            case ("fun", "sqrt", ("pow", x, 2)):
                return env.elementary.absolute(evaluate(x, env))
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
    "one": lambda t, env: q.scaled(env.unit, q.identity(env.size)),
    "sum": _sum,
    "at": _at,
    "entry": _entry,
    "call": _call,
    "fun": _function,
    "par": _parameter,
}


# Elementary functions in exact arithmetic: a random value at each argument.
#
# √x, sin x and the rest are no rational numbers. A claim in which they occur is put to the test
# with an independent random value y for each function at each argument, and derivatives by the
# rules of calculus, as (√x)′ = 1/(2y): what holds for every y holds for the true one. sin, cos
# and tan at one argument are those of a point of the circle, sinh, cosh and tanh of one of the
# hyperbola. The roots of the numbers that a claim writes, if they are of one quadratic field, are
# exact there.

PARTNERS = {"sin": "cos", "cos": "sin", "sinh": "cosh", "cosh": "sinh"}
SLOPES: dict[str, Callable[[Any, Any], Any]] = {
    "sqrt": lambda x, y: 1 / (2 * y),
    "exp": lambda x, y: y,
    "log": lambda x, y: 1 / x,
    "tan": lambda x, y: 1 + y * y,
    "tanh": lambda x, y: 1 - y * y,
    "atan": lambda x, y: 1 / (1 + x * x),
}
"""Function → its derivative at x, in x and in y, the value of the function there."""

ELEMENTARY = frozenset((*PARTNERS, *SLOPES))
"""The functions that a record has, and emitted code well_formedness."""

ON_CURVE = (("cos", "sin", "tan"), ("cosh", "sinh", "tanh"))
"""The functions that have their values from one point of a curve."""


def on_curve(names: tuple[str, ...], d: Any) -> dict[str, Any]:
    """Their values by the triangle of the sides 1 + 2d, 2d(1 + d), 1 + 2d(1 + d), all positive."""
    a, b = 1 + 2 * d, 2 * d * (1 + d)
    c = 1 + b
    values = (a / c, b / c, b / a) if names[0] == "cos" else (c / a, b / a, b / c)
    return dict(zip(names, values, strict=True))


AT_ZERO = {"cos": 1, "cosh": 1, "exp": 1, **dict.fromkeys(("sin", "tan", "sinh", "tanh"), 0)}
"""The values at 0, which are no others."""


class ElementaryValues:
    """The elementary functions at one model, f(name, x): y is drawn once for each argument.

    ``exact``: are numbers rational, so that they have square roots?
    """

    def __init__(self, draw: Callable[[], Any], *, exact: bool = False):
        self.draw, self.exact, self.radicand = draw, exact, 0
        self.true_root: Callable[[Any], Any] | None = None
        """√x, where it is not any number."""
        self.bounded = False
        """Are values those of the functions, within bounds?"""
        self.values: dict[tuple[str, Any], Any] = {}
        self.graded_arguments: list[Graded] = []

    def value(self, name: str, x: Any) -> Any:
        """The value of a function at x, the same each time; two graded numbers are different
        arguments unless they are one object."""
        if isinstance(x, Varying):
            y = self.value(name, x.value)
            return x.chained(y, self.slope(name, x.value, y))
        if name == "sqrt" and self.true_root:
            return self.true_root(x)
        if self.bounded:
            return bounds(name, Interval.of(x))
        if name in AT_ZERO and not isinstance(x, Graded) and x == 0:
            return x * 0 + AT_ZERO[name]
        at = self.key(x)
        if (name, at) not in self.values:
            d = self.drawn(x)
            curve = next((names for names in ON_CURVE if name in names), ())
            found = on_curve(curve, d) if curve else {name: d}
            self.values |= {(other, at): y for other, y in found.items()}
            if isinstance(x, Graded):
                self.graded_arguments.append(x)  # kept, so that its id is
        return self.values[name, at]

    def absolute(self, x: Any) -> Any:
        """|x| within bounds, its slopes from −1 to 1 where x may be 0: √(x²) has none there."""
        if not isinstance(x, Varying):
            return bounds("abs", x)
        sign = Interval.of(x.value).sign
        return x.chained(bounds("abs", x.value), sign or Interval.about(Fraction(0), Fraction(1)))

    def key(self, x: Any) -> Any:
        """What tells an argument from others."""
        return id(x) if isinstance(x, Graded) else x

    def drawn(self, x: Any) -> Any:
        """A random number for an argument."""
        del x
        return self.draw()

    def written(self, name: str, x: int | Fraction) -> Any:
        """The function of a number that a claim writes: a root of the first quadratic field that
        is met exactly, else as of any number."""
        if self.exact and not self.bounded and name == "sqrt" and x >= 0:
            y = root(x)
            if not isinstance(y, Quadratic) or self.radicand in (0, y.d):
                self.radicand = y.d if isinstance(y, Quadratic) else self.radicand
                return y
        return self(name, Fraction(x))

    @property
    def largest(self) -> int:
        """The largest degree of an argument in graded numbers."""
        return max((x.degree.total_degree for x in self.graded_arguments), default=0)

    def slope(self, name: str, x: Any, y: Any) -> Any:
        """The derivative of a function at x, where it is y; ``EvaluationError`` if unknown."""
        if name in PARTNERS:
            z = (self if isinstance(x, Nilpotent) else self.value)(PARTNERS[name], x)
            return -z if name == "cos" else z
        if name not in SLOPES:
            raise EvaluationError(f"no function {name!r}")
        return SLOPES[name](x, y)

    def __call__(self, name: str, x: Any) -> Any:
        """The function of a number; f(a + bε) = f(a) + f′(a)bε of one with nilpotent parts."""
        if not isinstance(x, Nilpotent):
            y = self.value(name, x)
            if not (name == "sqrt" and self.true_root):  # which may be 0
                self.slope(name, x, y)
            return y
        if not (most := max(x.parts)):
            return Nilpotent.of(self(name, x.part(0)))
        mask = 1 << (most.bit_length() - 1)
        a = Nilpotent({k: v for k, v in x.parts.items() if not k & mask} or {0: Fraction(0)})
        y = self(name, a)
        return y + self.slope(name, a, y) * derivative_in(x, mask) * nilpotent(mask)
