"""Trees and SymPy: the components of a vector equation, and expressions handed to users."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import sympy

from ..algebra.tree import Tree, add, mul, names
from .evaluate import Environment, evaluate

AXES = (1, 2, 3)
MATRICES = frozenset({"A", "C", "J", "Z", "f", "N"})
"""Names that stand for matrices; the others stand for vectors."""


def vector(name: str) -> tuple[tuple[sympy.Symbol, ...], ...]:
    """A column of three symbols name_1, name_2, name_3."""
    return tuple((sympy.Symbol(f"{name}_{i}"),) for i in AXES)


def matrix(name: str) -> tuple[tuple[sympy.Symbol, ...], ...]:
    """Nine symbols name_11 … name_33."""
    return tuple(tuple(sympy.Symbol(f"{name}_{i}{j}") for j in AXES) for i in AXES)


def principal_environment(t: Tree) -> Environment:
    """The names of a tree by components, and I = diag(λ_1, λ_2, λ_3)."""
    moments = [sympy.Symbol(f"λ_{i}", positive=True) for i in AXES]
    inertia = tuple(
        tuple(moments[i] if i == j else sympy.Integer(0) for j in range(3)) for i in range(3)
    )
    symbols = {x: matrix(x) if x in MATRICES else vector(x) for x in names(t)}
    return Environment(3, {**symbols, "I": inertia})


def components(t: Tree) -> list[Tree]:
    """The components of a vector tree in principal axes, quadratic terms gathered."""
    value = evaluate(t, principal_environment(t))
    trees = []
    for (x,) in value:
        constant = sympy.expand(x).subs({s: 0 for (s,) in vector("ζ")})
        trees.append(add(from_sympy(constant), from_sympy(sympy.factor(x - constant))))
    return trees


def from_sympy(e: Any) -> Tree:
    """A rational SymPy expression in symbols name_i as a tree."""
    if e.is_Symbol:
        name, _, index = e.name.rpartition("_")
        return ("entry", name, *(int(i) for i in index))
    if e.is_Rational:
        return int(e) if e.is_Integer else Fraction(int(e.p), int(e.q))
    if e.is_Pow:
        base = from_sympy(e.base)
        power = int(e.exp)
        if power < 0:
            return ("div", 1, base if power == -1 else ("pow", base, -power))
        return ("pow", base, power)
    if e.is_Add:
        return add(*(from_sympy(x) for x in _ordered(e.args)))
    if e.is_Mul:
        numerator, denominator = sympy.fraction(_sign_inside(e))
        sums = [x for x in sympy.Mul.make_args(numerator) if x.is_Add]
        others = [x for x in sympy.Mul.make_args(numerator) if not x.is_Add]
        rest = [from_sympy(x) for x in _ordered(others) if x != 1]
        lead = mul(1, *(from_sympy(x) for x in sums))
        if denominator != 1:
            lead = ("div", lead, from_sympy(denominator))
        return mul(lead, *rest) if rest else lead
    raise ValueError(f"no tree for {e}")


def _sign_inside(e: Any) -> Any:
    """−(a − b)c as (b − a)c."""
    sums = [x for x in e.args if x.is_Add]
    if e.args[0] == -1 and len(sums) == 1:
        others = [x for x in e.args[1:] if x is not sums[0]]
        return sympy.Mul(sympy.Add(*(-x for x in sums[0].args)), *others, evaluate=False)
    return e


def _ordered(args: Any) -> list[Any]:
    return sorted(args, key=lambda x: (str(x).startswith("-"), sympy.default_sort_key(x)))
