"""The equations of a record, evaluated at many states: a reference that shares nothing with code.

A name is given, or is what the last equation with that left side says.  Each tree is evaluated as
it stands, in the order of its terms; inverses are solved for.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import mpmath

from derive.algebra.groups import Group
from derive.language.tree import Tree, nodes
from derive.record.record import Derivation

from . import terms as q
from .terms import ONE, ZERO, Matrix, Terms

Value = Terms | Matrix


class Equations:
    """``given``: names and members of families; ``parameters``: by name."""

    def __init__(
        self,
        record: Derivation,
        group: Group,
        given: Mapping[Tree, Value],
        parameters: Mapping[str, Terms],
    ):
        self.record, self.group, self.n = record, group, group.n
        self.parameters = parameters
        self.memo: dict[Tree, Value] = {"π": Terms(+mpmath.mp.pi), **given}

    def knows(self, name: Tree) -> bool:
        """Is there such a name?"""
        return name in self.memo or self.record.definition(name) is not None

    def value(self, t: Tree) -> Any:
        """The value of a tree."""
        if isinstance(t, (int, Fraction)):
            return Terms.number(t)
        if t not in self.memo:
            self.memo[t] = self._found(t)
        return self.memo[t]

    def component(self, name: str, i: int) -> Terms:
        """Entry i of a column, from 1, which may have an equation of its own."""
        found = self.record.definition(("entry", name, i))
        if found is not None and not self.knows(name):
            return self.value(found[1].rhs)  # type: ignore[no-any-return]
        return self.value(name)[i - 1][0]  # type: ignore[no-any-return]

    def _found(self, t: Any) -> Value:
        if isinstance(t, str):
            return self._name(t)
        if t[0] == "at":
            return self._member(t)
        if t[0] == "call":
            return self._called(t)
        if t[0] == "sum":
            members = self._members(t[2], t[1])
            return self._add([self.value(bound(t[2], {t[1]: i})) for i in members])
        if t[0] == "par":
            return self.parameters[t[1]]
        if t[0] == "entry":
            row = self.value(t[1])[t[2] - 1]
            return row[t[3] - 1 if len(t) == 4 else 0]  # type: ignore[no-any-return]
        if t[0] == "fun":
            assert t[1] == "sqrt", t
            return self.value(t[2]).root()  # type: ignore[no-any-return]
        if (rest := traced(t)) is not None:
            return self._all_but(self.value(rest))
        return getattr(self, f"_{t[0]}_of")(*t[1:])  # type: ignore[no-any-return]

    # -- names -------------------------------------------------------------------------------

    def _name(self, name: str) -> Value:
        found = self.record.definition(name)
        if found is not None:
            return self.value(found[1].rhs)  # type: ignore[no-any-return]
        for e in (e for step in self.record.steps for e in step.equations):
            if isinstance(e.lhs, tuple) and e.lhs[:2] == ("entry", name):
                return self._table(e.lhs[2:], e.rhs)
        raise KeyError(name)

    def _table(self, indices: Any, t: Tree) -> Matrix:
        span = range(1, len(self.group.linear_basis) + 1)
        columns = span if len(indices) == 2 else (None,)
        return tuple(
            tuple(self.value(bound(t, dict(zip(indices, (i, j), strict=False)))) for j in columns)
            for i in span
        )

    def _member(self, t: Any) -> Value:
        if t[1] == "E":
            e = self.group.linear_part(self.group.basis[t[2] - 1])
            return tuple(tuple(Terms.number(x) for x in row) for row in e)
        found = self.record.definition(t)
        if found is None:
            raise KeyError(t)
        return self.value(found[1].rhs)  # type: ignore[no-any-return]

    def _members(self, body: Tree, index: str) -> list[int]:
        families = {x[1] for x in nodes(body) if _indexed(x, index) and x[0] == "at"}
        if "E" in families:
            return [*range(1, len(self.group.linear_basis) + 1)]
        lefts = [e.lhs for step in self.record.steps for e in step.equations]
        lefts += [x for x in self.memo if isinstance(x, tuple)]
        known = {(x[1], x[2]) for x in lefts if isinstance(x, tuple) and x[0] == "at"}
        listed = [{i for name, i in known if name == f and isinstance(i, int)} for f in families]
        return sorted(set.intersection(*listed))

    def _called(self, t: Any) -> Value:
        """r_i(t), by the equation for any index."""
        _, head, argument = t
        for e in (e for step in self.record.steps for e in step.equations):
            left = e.lhs
            if isinstance(left, tuple) and left[0] == "call" and left[2] == argument:
                pattern: Any = left[1]
                if isinstance(pattern, tuple) and pattern[1] == head[1]:
                    return self.value(bound(e.rhs, {pattern[2]: head[2]}))  # type: ignore[no-any-return]
        raise KeyError(t)

    # -- operators ---------------------------------------------------------------------------

    def _add_of(self, *parts: Tree) -> Value:
        return self._add([self.value(x) for x in parts])

    @staticmethod
    def _add(values: list[Any]) -> Value:
        if isinstance(values[0], Terms):
            return q.total(values)
        return tuple(
            tuple(q.total(entries) for entries in zip(*rows, strict=True))
            for rows in zip(*values, strict=True)
        )

    @staticmethod
    def _all_but(m: Matrix) -> Matrix:
        """(Tr M) 1 − M: what stands in both does not count among the terms."""
        span = range(len(m))
        return tuple(
            tuple(q.total([m[k][k] for k in span if k != i]) if i == j else -m[i][j] for j in span)
            for i in span
        )

    def _mul_of(self, *factors: Tree) -> Value:
        values = [(x, self._factor(x)) for x in factors]
        scale = ONE
        for _, value in values:
            scale = scale * value if isinstance(value, Terms) else scale
        matrices = [(x, value) for x, value in values if not isinstance(value, Terms)]
        if not matrices:
            return scale
        whole = self._chain(matrices)
        if len(whole) == 1 == len(whole[0]):
            return scale * whole[0][0]
        return tuple(tuple(scale * x for x in row) for row in whole)

    def _factor(self, t: Tree) -> Value:
        """The value of a factor; of M⁻¹ that of M, for which the others are solved."""
        if not _inverse(t):
            return self.value(t)  # type: ignore[no-any-return]
        m = self.value(t[1])  # type: ignore[index]
        return m.inverse() if isinstance(m, Terms) else m

    def _chain(self, factors: list[tuple[Any, Matrix]]) -> Matrix:
        *rest, (t, whole) = factors
        key: tuple[Tree, ...] = (t,)
        if _inverse(t):
            if rest and not _inverse(rest[-1][0]):  # X M = K by the rows of K
                before, k = rest.pop()
                bar, key = q.transposed(whole), (before, t)
                whole = q.transposed(q.solved(bar, q.transposed(k), positive=_positive(t)))
            else:
                whole = self.value(t)
        for t, value in reversed(rest):
            key = (t, *key)
            if ("chain", *key) not in self.memo:
                solve = _inverse(t)
                found = q.solved(value, whole, positive=_positive(t)) if solve else None
                self.memo["chain", *key] = found or q.times(value, whole)
            whole = self.memo["chain", *key]  # type: ignore[assignment]
        return whole

    def _div_of(self, a: Tree, b: Tree) -> Terms:
        over: Terms = self.value(b).inverse()
        x = self.value(a) * over
        # |a/b| S(b)/|b| and S(a)/|b|: not their product
        size = self.value(a).size * q.magnitude(over.value)
        return Terms(x.value, size + q.magnitude(x.value) * over.size / q.magnitude(over.value))

    def _pow_of(self, x: Tree, n: int) -> Value:
        base = self.value(x)
        if isinstance(base, Terms):
            base = base if n > 0 else base.inverse()
            found = base
            for _ in range(abs(n) - 1):
                found = found * base
            return found  # type: ignore[no-any-return]
        assert n == 2
        return q.times(base, base)

    def _inv_of(self, x: Tree) -> Value:
        m = self.value(x)
        if isinstance(m, Terms):
            return m.inverse()
        return q.inverted(m, positive=_positive(("inv", x)))

    def _T_of(self, x: Tree) -> Value:
        value = self.value(x)
        return value if isinstance(value, Terms) else q.transposed(value)

    def _tr_of(self, x: Any) -> Terms:
        """Of a product its diagonal alone."""
        factors = x[1:] if isinstance(x, tuple) and x[0] == "mul" else ()
        scalars = [t for t in factors if isinstance(self._factor(t), Terms)]
        matrices = [t for t in factors if t not in scalars]
        if len(matrices) > 1 and not any(map(_inverse, matrices)):
            rest = self.value(("mul", *matrices[1:]) if len(matrices) > 2 else matrices[1])
            found = self._dot(self.value(matrices[0]), q.transposed(rest))
            for t in scalars:
                found = self.value(t) * found
            return found
        m = self.value(x)
        return q.total([m[i][i] for i in range(len(m))])

    @staticmethod
    def _dot(a: Matrix, b: Matrix) -> Terms:
        rows = zip(a, b, strict=True)
        return q.total([x * y for r, s in rows for x, y in zip(r, s, strict=True)])

    def _one_of(self) -> Matrix:
        span = range(self.n)
        return tuple(tuple(ONE if i == j else ZERO for j in span) for i in span)

    def _inner_of(self, a: Tree, b: Tree) -> Terms:
        return self._dot(self.value(a), self.value(b))

    def _metric_of(self, m: Tree, a: Tree, b: Tree) -> Terms:
        return self._dot(self.value(a), self.value(("mul", m, b)))

    def _norm2_of(self, *x: Tree) -> Terms:
        return self._metric_of(x[0], x[1], x[1]) if len(x) == 2 else self._inner_of(x[0], x[0])

    def _wedge_of(self, a: Tree, b: Tree) -> Matrix:
        if isinstance(a, tuple) and a[0] == "mul" and a[2:] == (b,):
            found = self.record.definition(a[1])
            if found and (rest := traced(found[1].rhs)) is not None:
                return self._wedge_of(b, ("mul", rest, b))  # Tr J drops out of Iζ ∧ ζ
        ((x,), (y,), (z,)), ((u,), (v,), (w,)) = self.value(a), self.value(b)
        return ((y * w - z * v,), (z * u - x * w,), (x * v - y * u,))

    def _hat_of(self, a: Tree) -> Matrix:
        ((x,), (y,), (z,)) = self.value(a)
        return ((ZERO, -z, y), (z, ZERO, -x), (-y, x, ZERO))

    def _matrix_of(self, *rows: Any) -> Matrix:
        return tuple(tuple(self.value(x) for x in row[1:]) for row in rows)


def bound(t: Tree, values: Mapping[str, int]) -> Any:
    """A tree with indices replaced by their values."""
    if not isinstance(t, tuple):
        return t
    if t[0] in ("at", "entry"):
        return (t[0], bound(t[1], values), *(values.get(i, i) for i in t[2:]))
    return (t[0], *(bound(x, values) for x in t[1:]))


def traced(t: Any) -> Tree | None:
    """M of (Tr M) 1 − M."""
    match t:
        case ("add", ("mul", ("tr", m), ("one",)), ("mul", -1, other)) if m == other:
            return m  # type: ignore[no-any-return]
    return None


def _indexed(x: Any, index: str) -> bool:
    return isinstance(x, tuple) and x[0] in ("at", "entry") and index in x[2:]


def _inverse(t: Tree) -> bool:
    return isinstance(t, tuple) and t[0] == "inv"


def _positive(t: Any) -> bool:
    """Is the matrix that is inverted positive?  All are but A."""
    return t[1] not in ("A", ("T", "A"))
