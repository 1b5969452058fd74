"""A scalar expression and its derivatives at many points at once, by reverse accumulation."""

from __future__ import annotations

import operator
from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any, Protocol

from ...algebra.exact_kernel import ResidueVector, ResidueVectorSource
from ...language.derivatives import DERIVATIVES
from ...language.tree import Tree
from ...language.values import arithmetic

Number = Any
"""A residue at each point, or floats."""
Leaves = Mapping[Tree, Number]


class Numbers(Protocol):
    """A ring of numbers: its constants."""

    def constant(self, x: int | Fraction, /) -> Number:
        """A rational number in it."""


class Values(Protocol):
    """Values of elementary functions."""

    def value(self, name: str, x: Number, /) -> Number:
        """The value of a function at x."""


class Floats:
    """Floats, and the elementary functions of NumPy on them."""

    def constant(self, x: int | Fraction) -> Number:
        """A rational number as a float."""
        return float(x)

    def value(self, name: str, x: Number) -> Number:
        """The value of a function, by its name."""
        import numpy as np

        return getattr(np, {"atan": "arctan"}.get(name, name))(x)


class Tape:
    """The distinct subtrees of an expression, operands first; ``given``: those whose values are
    given, as those of letters are."""

    def __init__(self, tree: Tree, given: Collection[Tree] = ()):
        self.given = frozenset(given)
        self.places: dict[Tree, int] = {}
        self.ops: list[tuple[Any, tuple[int, ...], Any]] = []
        self.moves: list[bool] = []
        self.last = self._place(tree)

    def _place(self, t: Tree) -> int:
        known = self.places.get(t)
        if known is not None:
            return known
        if isinstance(t, (int, Fraction)):
            entry: tuple[Any, tuple[int, ...], Any] = ("number", (), t)
        elif isinstance(t, str) or t[0] in ("par", "entry") or t in self.given:
            entry = ("leaf", (), t)
        elif t[0] == "pow":
            entry = ("pow", (self._place(t[1]),), t[2])
        elif t[0] == "fun":
            slope = DERIVATIVES[t[1]](t[2])
            base = self._place(t[2])
            entry = ("fun", (base,), (t[1], slope))
        else:
            entry = (t[0], tuple(map(self._place, t[1:])), None)
        self.places[t] = len(self.ops)
        self.ops.append(entry)
        fixed = t == "π" or t in self.given or (isinstance(t, tuple) and t[0] == "par")
        by_state = entry[0] == "leaf" and not fixed
        self.moves.append(by_state or any(self.moves[k] for k in entry[1]))
        return self.places[t]

    @property
    def functions(self) -> set[str]:
        """The elementary functions that occur."""
        return {data[0] for op, _, data in self.ops if op == "fun"}

    def at(self, leaves: Leaves, source: Numbers, found: Values) -> Evaluated:
        """The values of all entries, those of the leaves given."""
        values: list[Number] = []
        for op, args, data in self.ops:
            a = [values[k] for k in args]
            if op == "number":
                values.append(source.constant(data))
            elif op == "leaf":
                values.append(leaves[data])
            elif op in ("add", "mul"):
                values.append(reduce(operator.add if op == "add" else operator.mul, a))
            elif op == "div":
                values.append(a[0] / a[1])
            elif op == "pow":
                values.append(a[0] ** data)
            elif op == "fun":
                values.append(found.value(data[0], a[0]))
            else:
                raise ValueError(f"no value of {op!r}")
        return Evaluated(self, values, source, found)


CIRCULAR, HYPERBOLIC = ("sin", "cos", "tan"), ("sinh", "cosh", "tanh")


class FunctionsAtPoints:
    """Values of elementary functions at the points: true square roots, where there are any; sin,
    cos and tan by a point of the circle, sinh, cosh and tanh by one of the hyperbola; another
    function has any number as its value at each argument, and so has a root where not
    ``true_roots``.

    ``valid``: the points at which all roots are true.
    """

    def __init__(self, source: ResidueVectorSource, *, true_roots: bool = True):
        self.source, self.true_roots = source, true_roots
        self.known: list[tuple[str, ResidueVector, ResidueVector]] = []
        self.valid = [True] * source.points

    def value(self, name: str, x: ResidueVector) -> ResidueVector:
        """The value of a function at x, the same at the same x."""
        for other, at, value in self.known:
            if other == name and at == x:
                return value
        if name in CIRCULAR:
            return self._on_curve(CIRCULAR, 1, name, x)
        if name in HYPERBOLIC:
            return self._on_curve(HYPERBOLIC, -1, name, x)
        if name == "sqrt" and self.true_roots:
            value = x.root()
            square = value * value
            pairs = zip(self.valid, square.values, x.values, strict=True)
            self.valid = [known and a == b for known, a, b in pairs]
        else:
            value = self.source.randint(1, 1)
        self.known.append((name, x, value))
        return value

    def at(self, places: Sequence[int], source: ResidueVectorSource) -> FunctionsAtPoints:
        """The same at some of the points; ``source``: of so many."""
        found = FunctionsAtPoints(source, true_roots=self.true_roots)
        found.known = [(name, x.at(places), y.at(places)) for name, x, y in self.known]
        return found

    def _on_curve(
        self, names: tuple[str, ...], sign: int, name: str, x: ResidueVector
    ) -> ResidueVector:
        """A point of c² ± s² = 1 by the tangent u of half its argument, and s/c."""
        u = self.source.randint(1, 1)
        above, below = 1 - sign * u * u, 1 + sign * u * u
        values: tuple[ResidueVector, ...] = (2 * u / below, above / below, 2 * u / above)
        self.known += [(other, x, y) for other, y in zip(names, values, strict=True)]
        return values[names.index(name)]


class Evaluated:
    """The values of a tape in a ring of numbers."""

    def __init__(self, tape: Tape, values: list[Number], source: Numbers, found: Values):
        self.tape, self.values, self.source, self.found = tape, values, source, found

    def at(self, places: Sequence[int], source: ResidueVectorSource) -> Evaluated:
        """The same, of residues, at some of the points; ``source``: of so many."""
        assert isinstance(self.found, FunctionsAtPoints)
        values = [x.at(places) for x in self.values]
        return Evaluated(self.tape, values, source, self.found.at(places, source))

    @property
    def value(self) -> Number:
        """The value of the expression."""
        return self.values[self.tape.last]

    def gradient(self) -> dict[Tree, Number]:
        """The derivative by each leaf that is no parameter."""
        adjoint: dict[int, Number] = {self.tape.last: self.source.constant(1)}
        found: dict[Tree, Number] = {}
        for k in range(len(self.tape.ops) - 1, -1, -1):
            if k not in adjoint:
                continue
            whole = adjoint.pop(k)
            op, args, data = self.tape.ops[k]
            if op == "leaf":
                found[data] = whole
            fixed = [self.values[j] for j in args if not self.tape.moves[j]]
            moving = [j for j in args if self.tape.moves[j]]
            slopes = self._slopes(op, [self.values[j] for j in moving], fixed, args, data)
            for j, slope in zip(moving, slopes, strict=True):
                part = whole if slope is None else whole * slope
                adjoint[j] = adjoint[j] + part if j in adjoint else part
        return found

    def _slopes(
        self, op: str, a: list[Number], fixed: list[Number], args: tuple[int, ...], data: Any
    ) -> list[Number | None]:
        """The derivative of an operation by each operand ``a`` that moves; ``None`` for 1."""
        if op == "add":
            return [None] * len(a)
        if op == "mul":
            return _others(a, fixed)
        if op == "div":
            above, below = (self.values[k] for k in args)
            back = 1 / below
            slopes = [back, -(above * back * back)]
            return [x for x, k in zip(slopes, args, strict=True) if self.tape.moves[k]]
        if op == "pow":
            return [a[0] ** (data - 1) * data]
        if op == "fun":
            return [self._slope(data[1])]
        return []

    def _slope(self, slope: Tree) -> Number:
        """The derivative of a function, an expression in its argument."""
        known = {t: self.values[k] for t, k in self.tape.places.items()}

        def at(t: Tree) -> Number:
            if t in known:
                return known[t]
            if isinstance(t, (int, Fraction)):
                return self.source.constant(t)
            assert isinstance(t, tuple)
            return self.found.value(t[1], at(t[2])) if t[0] == "fun" else arithmetic(t, at)

        return at(slope)


def _others(a: list[Number], fixed: list[Number]) -> list[Number | None]:
    """For each of some factors the product of the others, and of what is fixed; ``None`` for 1."""
    before = [reduce(operator.mul, fixed) if fixed else None]
    for x in a[:-1]:
        before.append(x if before[-1] is None else before[-1] * x)
    found: list[Number | None] = []
    after: Number | None = None
    for x, y in zip(reversed(a), reversed(before), strict=True):
        found.append(after if y is None else y if after is None else y * after)
        after = x if after is None else x * after
    return found[::-1]
