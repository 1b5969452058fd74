"""A conserved quantity as a SymPy expression, by L̃, its derivatives, and matrices."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import sympy

from ..language.tree import Tree
from ..problem.moved_entries import element
from ..problem.state_names import coordinates
from ..symmetries.found import Found
from ..symmetries.symmetry import Symmetry


def expression(s: Symmetry, found: Found) -> sympy.Expr:
    """⟨Π, η⟩ − τh̃ − F in real symbols with the names of the emitted state; not simplified."""
    found.require_whole()
    group = s.group
    symbols = {tree: sympy.Symbol(x, real=True) for x, tree in found.state.items()}
    symbols["t"] = sympy.Symbol("t", real=True)
    L = _of(found.lagrangian.L, symbols)
    zeta = [symbols[x] for x in coordinates(group)]
    momenta = [sympy.diff(L, x) for x in zeta]
    energy = sum((p * z for p, z in zip(momenta, zeta, strict=True)), sympy.Integer(0)) - L

    def matrix(m: Any) -> sympy.Matrix:
        return sympy.Matrix([[_of(x, symbols) for x in row] for row in m])

    g, (Y, X) = matrix(element(group)), map(matrix, s.matrices)
    if s.entries is not None:
        eta = matrix(s.entries)
    elif s.side == "left":
        eta = g.adjugate() * Y * g / g.det() - X
    else:
        eta = Y - g * X * g.adjugate() / g.det()
    total = -_of(s.tau, symbols) * energy - _of(s.F, symbols)
    for a, p in enumerate(momenta):
        terms = group.coordinate_terms(a)
        total += p * sum(_number(Fraction(c)) * eta[i, j] for c, i, j in terms)
    return total


def _of(t: Tree, symbols: Mapping[Tree, sympy.Symbol]) -> Any:
    """A tree as a SymPy expression."""
    if t in symbols:
        return symbols[t]
    if isinstance(t, (int, Fraction)):
        return _number(Fraction(t))
    if t == "π":
        return sympy.pi
    assert isinstance(t, tuple)
    if t[0] == "par":
        return sympy.Symbol(t[1], real=True)
    if t[0] == "pow":
        return _of(t[1], symbols) ** int(t[2])
    if t[0] == "fun":
        return getattr(sympy, t[1])(_of(t[2], symbols))
    parts = [_of(x, symbols) for x in t[1:]]
    if t[0] == "div":
        return parts[0] / parts[1]
    return {"add": sympy.Add, "mul": sympy.Mul}[t[0]](*parts)


def _number(x: Fraction) -> sympy.Rational:
    return sympy.Rational(x.numerator, x.denominator)
