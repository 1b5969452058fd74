"""Equations of a record as SymPy's: ``Eq`` of scalars, explicit matrices and matrix expressions.

What each operator of a tree becomes is in :class:`Translation`, one method each; docs/sympy.md has
the table.  Nothing is simplified, and nothing is evaluated but what SymPy does by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any

import sympy

from ..language.read import read
from ..language.reserved import advected_entries
from ..language.show import show, show_name
from ..language.tree import Tree, nodes, replaced
from ..problem.problem import ProblemError
from ..record.record import Derivation, Equation
from ..record.vocabulary import (
    ALGEBRA,
    FIELD,
    FUNCTION_ON_SPACE,
    OPERATOR,
    SCALAR,
    SQUARE,
    TENSOR,
    VOCABULARY,
    Type,
)
from ..views.outline import named_numbers
from ..views.text import clashing
from .expressions import FunctionValue, Hat, MatrixSum, Member, scalar_member

OF_A_FLUID = (FIELD, FUNCTION_ON_SPACE, OPERATOR, TENSOR)
OF_ITS_ARGUMENT = ("δ", "δ′", "∫", "d/dt")
"""Functions whose value is of the shape of what they are applied to."""


class Translation:
    """From the trees of one record to SymPy.

    ``n``: the dimension of the space, a symbol where it is any; ``own``: the numbers that the
    problem names, and ``apart`` those that no letter means as well; ``quoted``: those that text
    has in quotes; ``count``: how many members a family has, by what its index counts.
    """

    def __init__(self, record: Derivation):
        problem = record.problem
        n = problem["n"]
        self.n = sympy.Integer(n) if isinstance(n, int) else _natural("n")
        self.own = {*named_numbers(record)}
        self.apart = self.own - ({"m"} if problem["body"]["kind"] == "moments" else set())
        self.carried = advected_entries(problem)
        self.types = {x.name: [use.type for use in x.uses] for x in record.symbols}
        self.count = _counts(record)
        self.quoted = clashing(record)

    def read(self, formula: str) -> Any:
        """What a formula is, as text shows it; ``ValueError`` for any other."""
        known = {f"‘{y}’": x for x in self.quoted for y in (x, show_name(x))}
        t = read(formula, *sorted(self.own - self.quoted))
        for shown, name in known.items():
            t = replaced(t, ("par", shown), ("par", name))
        for i, name in enumerate(self.carried, 1):
            t = replaced(t, ("par", name), ("entry", "Γ", i))
        return self.of(t)

    def equation(self, e: Equation) -> Any:
        """lhs = rhs; the number 0 beside a matrix is the zero matrix."""
        left, right = self.of(e.lhs), self.of(e.rhs)
        if _is_matrix(left) and right == 0:
            right = sympy.ZeroMatrix(*left.shape)
        if _is_matrix(right) and left == 0:
            left = sympy.ZeroMatrix(*right.shape)
        return sympy.Eq(left, right, evaluate=False)

    def of(self, t: Tree) -> Any:
        """The SymPy object of a tree."""
        if isinstance(t, str):
            return sympy.pi if t == "π" else self.letter(t)
        if isinstance(t, (int, Fraction)):
            return sympy.Rational(t.numerator, t.denominator)
        if t[0] == "nabla":
            raise ValueError("∇ is an operator of a fluid, which SymPy has not")
        if own := getattr(self, f"op_{t[0]}", None):  # not all operands are trees
            return own(*t[1:])
        return OPERATIONS[t[0]](*map(self.of, t[1:]))

    # -- names ---------------------------------------------------------------------------------

    def letter(self, name: str) -> Any:
        """A name of the walk: a real symbol, a matrix, or the symbol of a variation."""
        for known in self._types(name):
            if known[0] not in ("family", "function"):
                return self._symbol(name, known)
        raise ValueError(f"{name!r} has an index, or is a function of what stands behind it")

    def _types(self, name: str) -> Iterable[Type]:
        if name in self.types:
            return self.types[name]
        if name not in VOCABULARY:
            raise ValueError(f"{name!r} is no name of the walk")
        return [use.type for use in VOCABULARY[name].uses]

    def _symbol(self, name: str, type_: Type) -> Any:
        if type_ in OF_A_FLUID:
            raise ValueError(f"{name!r} is a field or an operator of a fluid, which SymPy has not")
        if type_ == SCALAR:
            return sympy.Symbol(f"{name}_" if name in self.apart else name, real=True)
        if isinstance(type_, str):
            return sympy.Symbol(name)
        return sympy.MatrixSymbol(name, *self.shape(type_))

    def shape(self, type_: Type) -> tuple[Any, Any]:
        """Rows and columns of what is of a type."""
        size = {"n": self.n}
        if type_ == ALGEBRA:
            type_ = SQUARE
        rows, columns = (*type_[1:], 1)[:2]
        return size.get(rows, rows), size.get(columns, columns)

    def op_one(self) -> Any:
        """The unit matrix."""
        return sympy.Identity(self.n)

    def op_at(self, name: str, *indices: Any) -> Any:
        """A member of a family by its index."""
        type_ = self.family(name)[2]
        return self._member(f"{name}_{{}}", indices[0], type_)

    def family(self, name: str) -> tuple[Any, ...]:
        """The type of a family: what is counted, and what a member is."""
        return next(x for x in self._types(name) if isinstance(x, tuple) and x[0] == "family")

    def _member(self, template: str, index: Any, type_: Type) -> Any:
        at = self.index(index)
        if type_ == SCALAR:
            start, end = template.split("{}")
            taken = any(x.startswith(start) and x.endswith(end) for x in self.apart)
            return scalar_member(f"{template}_" if taken else template)(at)
        return Member(template, at, *self.shape(type_))

    def index(self, i: Any) -> Any:
        """An index, counted from 1: a number or a symbol."""
        return sympy.Integer(i) if isinstance(i, int) else _natural(i)

    def op_entry(self, t: Tree, *indices: Any) -> Any:
        """An entry of a matrix, or of a vector by one index."""
        places = [self.index(i) - 1 for i in indices]
        return self.of(t)[(*places, 0)[:2]]

    def op_sum(self, index: str, body: Tree) -> Any:
        """Σ of a number or a matrix over an index."""
        inside, i = self.of(body), self.index(index)
        count = self.span(body, index)
        if _is_matrix(inside):
            return MatrixSum(inside, i, count)
        return sympy.Sum(inside, (i, 1, count))

    def span(self, body: Tree, index: str) -> Any:
        """How many values an index of a tree has."""
        for x in nodes(body):
            if isinstance(x, tuple) and x[0] == "at" and index in x[2:]:
                return self.count[self.family(x[1])[1]]
            if isinstance(x, tuple) and x[0] == "entry" and index in x[2:]:
                return self.of(x[1]).shape[x[2:].index(index)]
        raise ProblemError(f"a sum over {index}, a place of the lattice, is none of SymPy's")

    # -- functions -----------------------------------------------------------------------------

    def op_call(self, head: Any, *arguments: Tree) -> Any:
        """A function at its arguments: a number, or a matrix of the shape that its type says."""
        if isinstance(head, tuple):  # r_i(t)
            type_ = next(x[2][-1] for x in self._types(head[1]) if _moves(x))
            return self._member(
                f"{head[1]}_{{}}({', '.join(map(show, arguments))})", head[2], type_
            )
        values = [self.of(x) for x in arguments]
        if head in OF_ITS_ARGUMENT:
            shape = getattr(values[0], "shape", None)
        else:
            result = next(x[-1] for x in self._types(head) if x[0] == "function")
            shape = None if result == SCALAR else self.shape(result)
        if shape:
            return FunctionValue(head, values, *shape)
        return sympy.Function(head, commutative=True)(*values)

    def op_fun(self, name: str, x: Tree) -> Any:
        """An elementary function."""
        return getattr(sympy, name)(self.of(x))

    def op_pow(self, x: Tree, n: int) -> Any:
        """An integer power."""
        base = self.of(x)
        return sympy.MatPow(base, n) if _is_matrix(base) else base**n

    def op_par(self, name: str) -> Any:
        """A parameter of the problem, the symbol of :class:`derive.python.expressions`."""
        if name not in self.own:
            raise ValueError(f"{name!r} is no parameter of the problem")
        return sympy.Symbol(name, real=True)


def _natural(name: str) -> Any:
    return sympy.Symbol(name, integer=True, positive=True)


def _moves(type_: Type) -> bool:
    return type_[0] == "family" and type_[2][0] == "function"


def _is_matrix(x: Any) -> bool:
    return bool(getattr(x, "is_Matrix", False))


def _counts(record: Derivation) -> dict[str, Any]:
    """How many members a family has, by what its index counts: of points a symbol N, where they are
    not listed; of others as many as the record names."""
    problem = record.problem
    listed = problem["body"].get("points") or ()
    known: dict[str, Any] = {"points": _natural("N")}
    if listed and not problem["places"]:
        known["points"] = len(listed)
    for x in record.symbols:
        for use in x.uses:
            if use.type[0] == "family" and use.type[1] != "points":
                known[use.type[1]] = max(known.get(use.type[1], 0), _named(record, x.name))
    return known


def _named(record: Derivation, family: str) -> int:
    """The largest number of a member of a family in the record."""
    sides = (t for s in record.steps for e in s.equations for t in (e.lhs, e.rhs))
    found = (
        x[2]
        for t in sides
        for x in nodes(t)
        if isinstance(x, tuple) and x[:2] == ("at", family) and isinstance(x[2], int)
    )
    return max(found, default=0)


# -- operators ---------------------------------------------------------------------------------


def _add(*terms: Any) -> Any:
    return sympy.MatAdd(*terms) if _is_matrix(terms[0]) else sympy.Add(*terms)


def _mul(*factors: Any) -> Any:
    """A product; a row times a column is a number, the trace of the product."""
    numbers = [x for x in factors if not _is_matrix(x)]
    row: list[Any] = []
    for x in (x for x in factors if _is_matrix(x)):
        row.append(x)
        if row[0].shape[0] == 1 == x.shape[1] and len(row) > 1 and x.shape[0] != 1:
            numbers.append(sympy.Trace(sympy.MatMul(*row)))
            row = []
    if not row:
        return sympy.Mul(*numbers)
    front = [sympy.Mul(*numbers)] if numbers else []
    return sympy.MatMul(*front, *row) if front or len(row) > 1 else row[0]


def _inner(a: Any, b: Any, *metric: Any) -> Any:
    """Tr ā M b of vectors, Tr a M b̄ of matrices."""
    if a.shape[1] == 1:
        return sympy.Trace(sympy.MatMul(sympy.Transpose(a), *metric, b))
    return sympy.Trace(sympy.MatMul(a, *metric, sympy.Transpose(b)))


def _bracket(a: Any, b: Any) -> Any:
    return sympy.MatAdd(sympy.MatMul(a, b), sympy.MatMul(-1, b, a))


OPERATIONS: dict[str, Callable[..., Any]] = {
    "add": _add,
    "mul": _mul,
    "div": lambda a, b: _mul(a, 1 / b),
    "T": sympy.Transpose,
    "tr": sympy.Trace,
    "det": sympy.Determinant,
    "inv": lambda x: sympy.Inverse(x) if _is_matrix(x) else 1 / x,
    "inner": _inner,
    "metric": lambda m, a, b: _inner(a, b, m),
    "norm2": lambda *x: _inner(x[-1], x[-1], *x[:-1]),
    "bracket": _bracket,
    "wedge": lambda a, b: sympy.MatMul(Hat(a), b) if a.rows != 2 else a[0] * b[1] - a[1] * b[0],
    "hat": Hat,
    "row": lambda *x: x,
    "matrix": lambda *rows: sympy.ImmutableMatrix(rows),
}
