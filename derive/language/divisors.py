"""Is a divisor of an expression zero whatever the names in it, as in 1/(a − a)?

The expression is evaluated in residues modulo a large prime, names and functions by a hash: a
divisor that does not vanish identically is zero there with probability below 1e-14 (Schwartz,
Zippel), and is held to be zero only where two primes agree.
"""

from __future__ import annotations

import math
from fractions import Fraction
from hashlib import sha256

from .tree import Tree

PRIMES = (2**61 - 1, 2**89 - 1)


def has_zero_divisor(tree: Tree) -> bool:
    """Does a tree divide by what is identically zero, or take the root or logarithm of it?"""
    return all(_divides_by_zero(tree, p) for p in PRIMES)


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
