"""The emitted program and conserved quantities as SymPy expressions; and matrix expressions that
SymPy has not: members of families, values of functions, sums, j(a).

They take part in SymPy's own: ``subs`` reaches their arguments, ``as_explicit`` their entries, and
``doit`` writes out sums whose members are counted, and j(a).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any

import sympy
from sympy.core.symbol import Str
from sympy.matrices.expressions.matexpr import MatrixElement

from ..code.ellipsoid import BUNDLES, is_item
from ..code.program import EmittedFunction, Expression, Program
from ..language.tree import Tree
from ..problem.entries_on_orbit import element
from ..problem.fields import coordinates
from ..search.symmetries.found_symmetries import SymmetriesFound
from ..search.symmetries.symmetry import Symmetry

LARGEST = 10**6
"""The largest denominator of an exact number; a larger one is that of a number such as √2, which
programs have to 53 bits."""
PI = Fraction(math.pi)


@dataclass(frozen=True)
class Expressions:
    """dx/dt and the energy in t, the state x, the parameters p, the constants k and the inputs u.

    ``x``, ``p``, ``u`` are tuples of real symbols with the names of the emitted code; ``k`` maps
    the symbols of its constants to what they are in the parameters; ``rhs`` is a column of length
    len(x).  Nothing is simplified; ``rhs.subs(k)`` has the parameters alone.

    >>> from derive import derive
    >>> e = derive("so3").expressions()
    >>> e.rhs.shape, e.rhs.jacobian(e.x).shape, e.x[-3:]
    ((12, 1), (12, 12), (zeta_1, zeta_2, zeta_3))
    >>> e.k[next(x for x in e.k if x.name == "I_11")]
    J_22 + J_33
    """

    t: sympy.Symbol
    x: tuple[sympy.Symbol, ...]
    p: tuple[sympy.Symbol, ...]
    k: Mapping[sympy.Symbol, sympy.Expr]
    u: tuple[sympy.Symbol, ...]
    rhs: sympy.Matrix
    energy: sympy.Expr


def expressions(program: Program) -> Expressions:
    """The functions of a program, which must be in the given frame, as SymPy expressions."""
    names = {
        "t": ["t"],
        "x": program.state,
        "p": [x[0] for x in program.parameters],
        "k": program.constants,
        "u": program.inputs,
    }
    t, x, p, k, u = symbols = [tuple(sympy.Symbol(y, real=True) for y in v) for v in names.values()]
    arrays = dict(zip(names, symbols, strict=True))
    constants = _values(program.functions["constants"], arrays)
    rates = _values(program.functions["rhs"], arrays)
    (energy,) = _values(program.functions["energy"], arrays)
    # a parameter that is kept as it is has one name
    kept = {a: b for a, b in zip(k, constants, strict=True) if a != b}
    return Expressions(t[0], x, p, kept, u, sympy.Matrix(rates), energy)


def _values(f: EmittedFunction, arrays: Mapping[str, Sequence[Any]]) -> list[Any]:
    """The outputs of a function as expressions in the symbols of the arrays that it loads from."""
    found = {x.name: arrays[x.array][x.index] for x in f.loads}
    for section in f.sections:
        for value in section.values:
            found[value.name] = _expression(value.expression, found)
    return [_expression(e, found) for e in f.outputs]


def _number(q: Fraction) -> Any:
    """A number of a program as SymPy has it: a fraction, a fraction of π, or a decimal."""
    for unit, name in ((Fraction(1), sympy.Integer(1)), (PI, sympy.pi)):
        part = q / unit
        if part.denominator < LARGEST:
            return sympy.Rational(part.numerator, part.denominator) * name
    return sympy.Float(q.numerator / q.denominator)


def _expression(
    e: Expression | Tree,
    found: Mapping[Any, Any],
    number: Callable[[Fraction], sympy.Expr] = _number,
) -> Any:
    """An expression of a program, or a tree, by what its names stand for."""
    if e in found:
        return found[e]
    if isinstance(e, (int, Fraction)):
        return number(Fraction(e))
    if e[0] == "none":  # of a spring: what it is added to is exact without it
        return sympy.Integer(0)
    if e[0] == "par":
        return sympy.Symbol(e[1], real=True)
    if e[0] == "pow":
        return _expression(e[1], found, number) ** e[2]
    operands = [_expression(x, found, number) for x in e[2 if e[0] == "fun" else 1 :]]
    if e[0] == "div":
        return operands[0] / operands[1]
    if e[0] == "fun" and e[1] in BUNDLES:
        return sympy.Tuple(*operands)
    if e[0] == "fun" and is_item(e[1]):
        return sympy.Function(e[1])(*operands[0])
    own = {"add": "Add", "mul": "Mul", "abs": "Abs"}
    return getattr(sympy, e[1] if e[0] == "fun" else own[e[0]])(*operands)


# A conserved quantity as a SymPy expression, by L̃, its derivatives, and matrices.


def expression(s: Symmetry, found: SymmetriesFound) -> sympy.Expr:
    """⟨Π, η⟩ − τh̃ − F in real symbols with the names of the emitted state; not simplified."""
    found.require_whole()
    group = s.group
    symbols = {tree: sympy.Symbol(x, real=True) for x, tree in found.state.items()}
    symbols |= {"t": sympy.Symbol("t", real=True), "π": sympy.pi}

    def of(t: Tree) -> Any:
        return _expression(t, symbols, _rational)

    L = of(found.lagrangian.L)
    zeta = [symbols[x] for x in coordinates(group)]
    momenta = [sympy.diff(L, x) for x in zeta]
    energy = sum((p * z for p, z in zip(momenta, zeta, strict=True)), sympy.Integer(0)) - L

    def matrix(m: Any) -> sympy.Matrix:
        return sympy.Matrix([[of(x) for x in row] for row in m])

    g, (Y, X) = matrix(element(group)), map(matrix, s.matrices)
    if s.entries is not None:
        eta = matrix(s.entries)
    elif s.side == "left":
        eta = g.adjugate() * Y * g / g.det() - X
    else:
        eta = Y - g * X * g.adjugate() / g.det()
    total = -of(s.tau) * energy - of(s.F)
    for a, p in enumerate(momenta):
        terms = group.coordinate_terms(a)
        total += p * sum(_rational(Fraction(c)) * eta[i, j] for c, i, j in terms)
    return total


def _rational(x: Fraction) -> sympy.Rational:
    return sympy.Rational(x.numerator, x.denominator)


class _OfASize(sympy.MatrixExpr):  # type: ignore[misc]
    """What has a name, what it is of, rows and columns for its arguments."""

    @property
    def shape(self) -> tuple[Any, Any]:
        """Rows and columns."""
        _, _, rows, columns = self.args
        return rows, columns

    def _entry(self, i: Any, j: Any, **_: Any) -> Any:
        return MatrixElement(self, i, j)


class Member(_OfASize):
    """Member of a family of matrices of rows × columns, by its index: r_i, r_i(t).

    ``template`` is its name, with {} for the index.  A member by a number is a ``MatrixSymbol``.
    """

    def __new__(cls, template: Any, index: Any, rows: Any, columns: Any) -> Any:
        """The member; a symbol of its own for an index that is a number."""
        index = sympy.sympify(index)
        if index.is_Integer:
            return sympy.MatrixSymbol(str(template).format(index), rows, columns)
        return super().__new__(cls, Str(str(template)), index, *map(sympy.sympify, (rows, columns)))

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


class FunctionValue(_OfASize):
    """Value of a function that is a matrix of rows × columns: δ(r), ξ(X)."""

    def __new__(cls, name: Any, arguments: Any, rows: Any, columns: Any) -> Any:
        """The value of the function of that name at its arguments."""
        arguments = sympy.Tuple(*arguments)
        return super().__new__(cls, Str(str(name)), arguments, *map(sympy.sympify, (rows, columns)))

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
