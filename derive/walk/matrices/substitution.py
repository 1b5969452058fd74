"""What names stand for in a problem's own numbers and parameters, as Laurent polynomials."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import chain
from math import prod
from typing import Any

from ...language import rational as q
from ...language.laurent import Laurent, OverlongError, written
from ...language.tree import Tree, nodes, operands, replaced
from ...language.values import LARGEST_POWER, OPERATIONS, Value
from ...record.record import Equation
from .rotation import symbols

# Names have Laurent polynomials for values, also as the entries of vectors and matrices.
# What is no such polynomial keeps its name: a function of its argument, the tension σ_e of an
# element that depends on its length, the entries of a force Q_i or P_i on a point.

MOST = 200
"""As many terms has a value at most."""
PAIRS = 60_000
"""As many products of a term with a term are formed at most, in all."""
KEPT = ("σ", "P", "Q", "r_c")
"""What keeps its name, or its members theirs, where it is no polynomial or one longer than
``SHORT``."""
ENDS = "d"
"""The family of differences of places: where the answer is long, each keeps its name."""
SHORT = 3
UNKNOWN = (ArithmeticError, IndexError, KeyError, OverlongError, TypeError, ValueError)
"""What evaluation raises where a name has no value here, or no short one."""


class Substitution:
    """Names and members of families with their values; ``size``: of the identity matrix."""

    def __init__(self, known: Mapping[str, Value], size: int, opaque: str = ""):
        self.names: dict[str, Value] = {"π": Laurent.symbol("π"), "t": Laurent.symbol("t"), **known}
        self.families: dict[str, dict[int, Value]] = {}
        self.one, self.pairs, self.opaque = q.identity(size), 0, opaque

    def member(self, family: str, k: int, value: Value) -> None:
        """Give a member of a family its value."""
        self.families.setdefault(family, {})[k] = value

    def learn(self, equations: Iterable[Equation]) -> None:
        """The values of names and members that equations define, where they have one."""
        for e in equations:
            try:
                if isinstance(e.lhs, str):
                    self.names[e.lhs] = self._value_or_name(e.lhs, e.rhs)
                elif isinstance(e.lhs, tuple) and e.lhs[0] == "at" and isinstance(e.lhs[2], int):
                    self.member(e.lhs[1], e.lhs[2], self._value_or_name(e.lhs, e.rhs))
            except UNKNOWN:
                continue

    def _value_or_name(self, whole: Tree, t: Tree) -> Value:
        """The value of a tree, or the name that it defines; of a vector 0 stays 0."""
        head = whole[1] if isinstance(whole, tuple) else whole
        named = Laurent.symbol(whole) if head == "σ" else symbols(whole, len(self.one))
        try:
            found = self.of(t)
        except UNKNOWN:
            if head not in KEPT:
                raise
            return named
        if head not in KEPT:
            return named if head == self.opaque else found
        if all(map(_is_short, _numbers_in(found))):
            return found
        if not isinstance(named, tuple):
            return named
        return tuple(y if any(x) else x for x, y in zip(found, named, strict=True))

    def of(self, t: Tree) -> Value:
        """The value of a tree; ``UNKNOWN`` where there is none."""
        found = self._of(t)
        if any(len(x.terms) > MOST for x in _numbers_in(found) if isinstance(x, Laurent)):
            raise OverlongError("too many terms")
        return found

    def _of(self, t: Tree) -> Value:
        if isinstance(t, (int, Fraction)):
            return Laurent.of(t)
        if isinstance(t, str):
            return self.names[t]
        op, *parts = t
        if op in SPECIAL:
            return SPECIAL[op](self, *parts)
        found = [*map(self.of, operands(t))]
        if op == "mul":
            return self._product(*found)
        return OPERATIONS[op](*(found if op in APART else self._bounded(op, *found)))

    def _product(self, *factors: Value) -> Value:
        """The product, factor by factor; ``OverlongError`` before one is too long to be formed."""
        total, *rest = factors
        for x in rest:
            total = OPERATIONS["mul"](*self._bounded("mul", total, x))
        return total

    def _bounded(self, op: str, *parts: Value) -> Sequence[Value]:
        """What is to be multiplied; ``OverlongError`` where the products of terms are too many."""
        self.pairs += prod(map(_length, parts)) * (_length(parts[-1]) if op == "norm2" else 1)
        if self.pairs > PAIRS:
            raise OverlongError("too many terms")
        return parts

    def _sum(self, index: str, body: Tree) -> Value:
        """The sum over the members that all families with this index have."""
        having = (x for x in nodes(body) if isinstance(x, tuple) and x[0] == "at")
        spans = [{*self.families[x[1]]} for x in having if x[2] == index]
        terms = [self.of(replaced(body, index, k)) for k in sorted(set.intersection(*spans))]
        return OPERATIONS["add"](*terms)

    def _entry(self, whole: Tree, *at: int) -> Value:
        i, j = (*at, 1)[:2]
        return self.of(whole)[i - 1][j - 1]

    def _call(self, head: Tree, *arguments: Tree) -> Value:
        """r_i(t)."""
        if not isinstance(head, tuple) or head[1] != "r" or arguments != ("t",):
            raise KeyError(head)
        moved = q.times(self.names["A"], self.of(head))
        return q.plus(moved, self.names["T"]) if "T" in self.names else moved

    def _power(self, base: Tree, n: int) -> Value:
        x = self.of(base)
        if abs(n) > LARGEST_POWER:
            raise OverlongError("too large a power")
        if n < 0:
            return self._power(("inv", base), -n)
        return self._product(*[x] * n)

    def _inverse(self, t: Tree) -> Value:
        x = self.of(t)
        if isinstance(x, tuple):
            raise KeyError(t)
        if len(x.terms) == 1:
            return x.reciprocal()
        return Laurent.symbol(("div", 1, written(x)))


SPECIAL: dict[str, Any] = {
    "par": lambda _, name: Laurent.symbol(("par", name)),
    "one": lambda known: known.one,
    "matrix": lambda known, *rows: tuple(tuple(map(known.of, row[1:])) for row in rows),
    "at": lambda known, family, k: known.families[family][k],
    "sum": Substitution._sum,
    "entry": Substitution._entry,
    "call": Substitution._call,
    "pow": Substitution._power,
    "inv": Substitution._inverse,
    "fun": lambda known, name, t: Laurent.symbol(("fun", name, written(known.of(t)))),
    "div": lambda known, a, b: known._product(known.of(a), known.of(("inv", b))),
}
APART = ("add", "row", "T", "tr", "hat")
"""Operations in which no terms are multiplied."""


def _length(x: Value) -> int:
    """The number of terms of a value, at least 1."""
    return max(1, sum(len(y.terms) if isinstance(y, Laurent) else bool(y) for y in _numbers_in(x)))


def _numbers_in(x: Value) -> Sequence[Any]:
    return [*chain.from_iterable(x)] if isinstance(x, tuple) else [x]


def _is_short(x: Any) -> bool:
    """Is a value a polynomial in names, of few terms?"""
    if not isinstance(x, Laurent):
        return True
    whole = (s for m in x.terms for s, _ in m if isinstance(s, tuple))
    return len(x.terms) <= SHORT and all(s[0] not in ("fun", "div") for s in whole)
