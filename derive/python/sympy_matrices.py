"""Matrix expressions that SymPy has not: members of families, values of functions, sums, j(a).

They take part in SymPy's own: ``subs`` reaches their arguments, ``as_explicit`` their entries, and
``doit`` writes out sums whose members are counted, and j(a).
"""

from __future__ import annotations

from functools import cache
from typing import Any

import sympy
from sympy.core.symbol import Str
from sympy.matrices.expressions.matexpr import MatrixElement


class Member(sympy.MatrixExpr):  # type: ignore[misc]
    """Member of a family of matrices of rows × columns, by its index: r_i, r_i(t).

    ``template`` is its name, with {} for the index.  A member by a number is a ``MatrixSymbol``.
    """

    def __new__(cls, template: Any, index: Any, rows: Any, columns: Any) -> Any:
        """The member; a symbol of its own for an index that is a number."""
        index = sympy.sympify(index)
        if index.is_Integer:
            return sympy.MatrixSymbol(str(template).format(index), rows, columns)
        return super().__new__(cls, Str(str(template)), index, *map(sympy.sympify, (rows, columns)))

    @property
    def shape(self) -> tuple[Any, Any]:
        """Rows and columns."""
        _, _, rows, columns = self.args
        return rows, columns

    def _entry(self, i: Any, j: Any, **_: Any) -> Any:
        return MatrixElement(self, i, j)

    def _sympystr(self, printer: Any) -> str:
        return str(self.args[0]).format(printer.doprint(self.args[1]))

    _latex = _sympystr


@cache
def scalar_member(template: str) -> Any:
    """The family of numbers of that name: called with an index, a function of it; with a number, a
    real symbol."""

    def eval_(_: Any, index: Any) -> Any:
        if index.is_Integer:
            return sympy.Symbol(template.format(index), real=True)
        return None

    own = {"eval": classmethod(eval_), "_eval_is_real": lambda _: True}
    return type(template.format("").strip("_"), (sympy.Function,), own)


class FunctionValue(sympy.MatrixExpr):  # type: ignore[misc]
    """Value of a function that is a matrix of rows × columns: δ(r), ξ(X)."""

    def __new__(cls, name: Any, arguments: Any, rows: Any, columns: Any) -> Any:
        """The value of the function of that name at its arguments."""
        arguments = sympy.Tuple(*arguments)
        return super().__new__(cls, Str(str(name)), arguments, *map(sympy.sympify, (rows, columns)))

    @property
    def shape(self) -> tuple[Any, Any]:
        """Rows and columns."""
        _, _, rows, columns = self.args
        return rows, columns

    def _entry(self, i: Any, j: Any, **_: Any) -> Any:
        return MatrixElement(self, i, j)

    def _sympystr(self, printer: Any) -> str:
        return f"{self.args[0]}({', '.join(map(printer.doprint, self.args[1]))})"

    _latex = _sympystr


class Hat(sympy.MatrixExpr):  # type: ignore[misc]
    """The skew matrix j(a) of a vector a of R³, 3 × 1: j(a) b = a ∧ b."""

    shape = (sympy.Integer(3), sympy.Integer(3))

    def __new__(cls, a: Any) -> Any:
        """j(a)."""
        return super().__new__(cls, a)

    def _entry(self, i: Any, j: Any, **_: Any) -> Any:
        a = self.args[0]
        if not (i.is_Integer and j.is_Integer):
            return MatrixElement(self, i, j)
        return sum((-sympy.LeviCivita(i, j, k) * a[k, 0] for k in range(3)), sympy.Integer(0))

    def doit(self, **hints: Any) -> Any:
        """The matrix of its entries."""
        return Hat(self.args[0].doit(**hints)).as_explicit()

    def _sympystr(self, printer: Any) -> str:
        return f"j({printer.doprint(self.args[0])})"

    _latex = _sympystr


class MatrixSum(sympy.MatrixExpr):  # type: ignore[misc]
    """Σ of a matrix over an index from 1 to a count."""

    def __new__(cls, body: Any, index: Any, count: Any) -> Any:
        """The sum of what ``body`` is for each value of the index."""
        return super().__new__(cls, body, index, sympy.sympify(count))

    @property
    def shape(self) -> tuple[Any, Any]:
        """That of each term."""
        own: tuple[Any, Any] = self.args[0].shape
        return own

    @property
    def free_symbols(self) -> set[Any]:
        """All but the index."""
        body, index, count = self.args
        return {*body.free_symbols} - {index} | {*count.free_symbols}

    def _entry(self, i: Any, j: Any, **_: Any) -> Any:
        body, index, count = self.args
        return sympy.Sum(body[i, j], (index, 1, count))

    def doit(self, **hints: Any) -> Any:
        """The terms written out, where they are counted."""
        body, index, count = self.args
        if not count.is_Integer:
            return self
        terms = [body.subs(index, k).doit(**hints) for k in range(1, int(count) + 1)]
        return sympy.MatAdd(*terms).doit(**hints)

    def _sympystr(self, printer: Any) -> str:
        body, index, count = map(printer.doprint, self.args)
        return f"Sum({body}, ({index}, 1, {count}))"

    _latex = _sympystr
