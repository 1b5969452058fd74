"""Derivatives of scalar trees, and products and quotients with like powers in one."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from .tree import Tree, add, mul, neg


def _f(name: str, x: Tree) -> Tree:
    return ("fun", name, x)


def _plus_square(x: Tree, sign: int = 1) -> Tree:
    return add(1, mul(sign, ("pow", x, 2)))


DERIVATIVES: dict[str, Callable[[Tree], Tree]] = {
    "sqrt": lambda x: ("div", 1, mul(2, _f("sqrt", x))),
    "sin": lambda x: _f("cos", x),
    "cos": lambda x: neg(_f("sin", x)),
    "tan": lambda x: _plus_square(_f("tan", x)),
    "exp": lambda x: _f("exp", x),
    "log": lambda x: ("div", 1, x),
    "sinh": lambda x: _f("cosh", x),
    "cosh": lambda x: _f("sinh", x),
    "tanh": lambda x: _plus_square(_f("tanh", x), -1),
    "atan": lambda x: ("div", 1, _plus_square(x)),
}
"""The elementary functions of problem files, by name, and the derivative of each at a tree."""


def derivative(t: Tree, x: Tree) -> Tree:
    """The derivative ∂t/∂x of a scalar tree by a subtree x of it, taken as a variable;
    ``ValueError`` for operators that have none."""
    if t == x:
        return 1
    if not isinstance(t, tuple) or t[0] in ("par", "at", "entry", "norm2", "call", "inner"):
        return 0
    op = t[0]
    if op == "add":
        return add(*(derivative(y, x) for y in t[1:]))
    if op == "mul":
        terms = []
        for k, y in enumerate(t[1:], 1):
            varied = derivative(y, x)
            terms.append(product(*t[1:k], varied, *t[k + 1 :]) if varied != 0 else 0)
        return add(*terms)
    if op == "div":
        above, below = derivative(t[1], x), derivative(t[2], x)
        first = quotient(above, t[2]) if above != 0 else 0
        second = quotient(product(-1, t[1], below), ("pow", t[2], 2)) if below != 0 else 0
        return add(first, second)
    if op == "pow":
        inner = derivative(t[1], x)
        return product(t[2], power(t[1], t[2] - 1), inner) if inner != 0 else 0
    if op == "fun":
        inner = derivative(t[2], x)
        return product(DERIVATIVES[t[1]](t[2]), inner) if inner != 0 else 0
    raise ValueError(f"no derivative of {op!r}")


def power(x: Tree, n: int) -> Tree:
    """The tree xⁿ; 1 and x where n is 0 and 1."""
    return 1 if n == 0 else x if n == 1 else ("pow", x, n)


def product(*factors: Tree) -> Tree:
    """The product of trees as number · powers / powers, the powers of one base in one."""
    powers: dict[Tree, int] = {}
    number = _factor_powers(mul(1, *factors) if 0 not in factors else 0, 1, powers)
    if number == 0:
        return 0
    above = [power(x, n) for x, n in powers.items() if n > 0]
    below = [power(x, -n) for x, n in powers.items() if n < 0]
    top = mul(number.numerator, *above) if below else mul(number, *above)
    bottom = mul(number.denominator, *below) if below else 1
    return top if bottom == 1 else ("div", top, bottom)


def quotient(a: Tree, b: Tree) -> Tree:
    """The quotient a / b, as :func:`product` writes it."""
    return product(a, ("div", 1, b))


def _factor_powers(t: Tree, n: int, powers: dict[Tree, int]) -> Fraction:
    """The rational factor of tⁿ; the exponents of all other factors are added to ``powers``."""
    if isinstance(t, (int, Fraction)):
        return Fraction(t) ** n
    if isinstance(t, tuple) and t[0] == "mul":
        number = Fraction(1)
        for x in t[1:]:
            number *= _factor_powers(x, n, powers)
        return number
    if isinstance(t, tuple) and t[0] == "div":
        return _factor_powers(t[1], n, powers) * _factor_powers(t[2], -n, powers)
    if isinstance(t, tuple) and t[0] == "pow":
        return _factor_powers(t[1], n * t[2], powers)
    powers[t] = powers.get(t, 0) + n
    return Fraction(1)
