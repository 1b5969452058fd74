"""Derivatives of scalar trees; what they cost, and divisors that are zero whatever the names."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from hashlib import sha256
from typing import Any, NamedTuple

from .tree import Tree, add, fold, mul, neg, nodes, operands, replaced


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


MULTILINEAR = ("mul", "inner", "metric", "wedge", "tr", "T", "hat", "entry")
"""Operators that are linear in each of their operands but indices."""


def rate(t: Tree, known: Mapping[Tree, Tree]) -> Tree:
    """The rate of a tree of numbers, vectors and matrices, 0 where nothing in it varies; ``known``:
    the rates of what varies by itself. ``ValueError`` for operators that have none."""
    if t in known:
        return known[t]
    if not isinstance(t, tuple) or t[0] in ("par", "at") or t[:1] + t[2:] == ("call", "t"):
        return 0
    op, parts = t[0], operands(t)
    if op == "sum":
        return _rate_of_sum(parts[0], parts[1], known)
    rates = [rate(x, known) for x in parts]
    varied = [(k, x) for k, x in enumerate(rates) if x != 0]
    if not varied:
        return 0
    if op in ("add", "row"):
        return add(*rates) if op == "add" else ("row", *rates)
    if op == "matrix":
        rows = zip(rates, parts, strict=True)
        return ("matrix", *(x or ("row", *(0 for _ in y[1:])) for x, y in rows))  # type: ignore[index]
    if op in MULTILINEAR:
        moved = ((*parts[:k], x, *parts[k + 1 :]) for k, x in varied)
        return add(*(_multiple(mul(*x)) if op == "mul" else (op, *x) for x in moved))
    if op == "norm2" and len(parts) == 1:
        return mul(2, ("inner", *parts, *rates))
    if op in ("div", "pow", "fun"):
        return add(*(product(_slope(t, k), x) for k, x in varied))
    raise ValueError(f"no rate of {op!r}")


def _rate_of_sum(index: Tree, body: Tree, known: Mapping[Tree, Tree]) -> Tree:
    """The rate of a sum: of what varies in all its terms, and of members of families that do."""
    inside = rate(body, known)
    found: list[Tree] = [("sum", index, inside)] if inside != 0 else []
    for x, own in known.items():
        if isinstance(x, tuple) and x[0] == "at" and ("at", x[1], index) in nodes(body):
            found.append(rate(replaced(body, index, x[2]), {x: own}))
    return add(*found)


def _multiple(t: Tree) -> Tree:
    """A product, of a number and a matrix by entries."""
    match t:
        case ("mul", int() | Fraction() as c, ("matrix", *rows)):
            return ("matrix", *(("row", *(mul(c, x) for x in row[1:])) for row in rows))
    return t


def _slope(t: tuple[Any, ...], k: int) -> Tree:
    """The derivative of an operator by its operand k alone."""
    before = t[:2] if t[0] == "fun" else t[:1]
    parts, after = operands(t), t[2:] if t[0] == "pow" else ()
    slots = [f"∂{i}" for i, _ in enumerate(parts)]
    found = derivative((*before, *slots, *after), slots[k])
    for slot, x in zip(slots, parts, strict=True):
        found = replaced(found, slot, x)
    return found


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


# What an expression will cost: how deep it is, its degree, and how long its derivatives are.

FUNCTION = 8
"""The degree of a function and its first three derivatives, as the checker bounds it."""


class Weight(NamedTuple):
    """What an expression costs: leaves; operands of all its first derivatives; degree."""

    leaves: int
    slope: int
    degree: int


def depth(tree: Tree) -> int:
    """The number of operations of a tree that are in one another; without recursion, which this
    bounds."""
    level, inside = 0, [tree]
    while inside := [x for t in inside if isinstance(t, tuple) for x in t[1:]]:
        level += 1
    return level


@fold
def weight(t: Tree, *parts: Weight) -> Weight:
    """The weight of a tree that is not too deep."""
    if isinstance(t, (int, Fraction)):
        return Weight(1, 0, 0)
    if isinstance(t, str) or t[0] == "par":
        return Weight(1, 1, 1)
    if t[0] == "pow":
        (base,), n = parts, abs(int(t[2]))
        return Weight(base.leaves + 1, base.slope + base.leaves + 1, n * base.degree)
    if t[0] == "fun":
        (inside,) = parts
        return Weight(inside.leaves + 1, inside.slope + inside.leaves, FUNCTION + inside.degree)
    leaves = sum(x.leaves for x in parts)
    if t[0] == "add":  # a derivative has those of its terms; in a product all factors stay
        return Weight(leaves, sum(x.slope for x in parts), max(x.degree for x in parts))
    slope = sum(x.slope + leaves - x.leaves for x in parts if x.slope)
    return Weight(leaves, slope, sum(x.degree for x in parts))


# Is a divisor of an expression zero whatever the names in it, as in 1/(a − a)?
#
# The expression is evaluated in residues modulo a large prime, names and functions by a hash: a
# divisor that does not vanish identically is zero there with probability below 1e-14 (Schwartz,
# Zippel), and is held to be zero only where two primes agree.

DIVISOR_PRIMES = (2**61 - 1, 2**89 - 1)


def has_zero_divisor(tree: Tree) -> bool:
    """Does a tree divide by what is identically zero, or take the root or logarithm of it?"""
    return all(_divides_by_zero(tree, p) for p in DIVISOR_PRIMES)


def _divides_by_zero(tree: Tree, p: int) -> bool:
    try:
        residue(tree, p)
    except ZeroDivisionError:
        return True
    return False


def residue(tree: Tree, p: int) -> int:
    """The value of a tree modulo p; ``ZeroDivisionError`` for a divisor, root or logarithm of 0
    modulo p."""
    if isinstance(tree, (int, Fraction)):
        q = Fraction(tree)
        return q.numerator * inverse(q.denominator, p) % p
    if isinstance(tree, str) or tree[0] in ("par", "entry"):
        return hashed(str(tree), p)
    if tree[0] == "fun":
        inside = residue(tree[2], p)
        if inside == 0 and tree[1] in ("sqrt", "log"):
            raise ZeroDivisionError
        return hashed(f"{tree[1]} {inside}", p)
    if tree[0] == "pow":
        base = residue(tree[1], p)
        return pow(base if tree[2] > 0 else inverse(base, p), abs(tree[2]), p)
    first, *others = (residue(x, p) for x in tree[1:])
    if tree[0] == "div":
        return first * inverse(others[0], p) % p
    return sum(others, first) % p if tree[0] == "add" else math.prod(others, start=first) % p


def inverse(x: int, p: int) -> int:
    """The inverse of x modulo p; ``ZeroDivisionError`` of 0."""
    if x % p == 0:
        raise ZeroDivisionError
    return pow(x, -1, p)


def hashed(text: str, p: int) -> int:
    """A residue modulo p, not 0, that a text determines."""
    return int.from_bytes(sha256(text.encode()).digest()) % (p - 1) + 1
