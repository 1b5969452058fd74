"""Laurent polynomials over Q in symbols, and densities that are polynomials in the level."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cached_property
from typing import Any

from .rational import FieldElement, summed
from .tree import Tree, add, mul, names, plain, replaced

Monomial = tuple[tuple[Tree, int], ...]
"""(symbol, exponent ≠ 0), sorted by how the symbols are written; a symbol is any tree."""


ONE = Fraction(1)
MOST = 40
"""As many terms has a tree at most that is multiplied out: a power of a sum has any number of
them."""


class OverlongError(ValueError):
    """A tree that has too many terms when it is multiplied out."""


class LaurentSymbol(tuple[Any, ...]):
    """A tree as a symbol: the same tuple, but its hash and how it is written, for which products
    and sums ask again and again, are found once."""

    @cached_property
    def hashed(self) -> int:
        """Its hash."""
        return super().__hash__()

    @cached_property
    def text(self) -> str:
        """How it is written."""
        return repr(self)

    def __hash__(self) -> int:
        return self.hashed

    def __reduce__(self) -> tuple[type, tuple[tuple[Any, ...]]]:
        return tuple, (tuple(self),)  # in another process texts have another hash


class Laurent(FieldElement):
    """A sum of q · monomial with exponents in Z; only a monomial can be divided by.

    >>> x, y = Laurent.symbol("x"), Laurent.symbol("y")
    >>> ((x + y) * (x - y) / x).terms == {(("x", 1),): 1, (("x", -1), ("y", 2)): -1}
    True
    """

    __slots__ = ("terms",)

    def __init__(self, terms: Mapping[Monomial, Fraction]) -> None:
        self.terms = {m: q for m, q in terms.items() if q}

    @classmethod
    def symbol(cls, name: Tree) -> Laurent:
        """The polynomial that is one symbol."""
        return cls({((LaurentSymbol(name) if isinstance(name, tuple) else name, 1),): ONE})

    @classmethod
    def monomial(cls, factors: Iterable[tuple[Tree, int]], q: Fraction = ONE) -> Laurent:
        """The polynomial q times powers of symbols, in any order and with repetitions."""
        return cls({_product((), factors): q})

    @classmethod
    def of(cls, x: Laurent | Fraction | int) -> Laurent:
        """A number as a constant polynomial; a polynomial as it is."""
        return x if isinstance(x, Laurent) else cls({(): Fraction(x)})

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __add__(self, other: Laurent | Fraction | int) -> Laurent:
        return Laurent(summed((*self.terms.items(), *Laurent.of(other).terms.items())))

    def __mul__(self, other: Laurent | Fraction | int) -> Laurent:
        right = Laurent.of(other).terms
        if not self.terms or not right:
            return Laurent({})
        if right.keys() == {()}:
            return Laurent({m: p * right[()] for m, p in self.terms.items()})
        pairs = ((m, p, n, q) for m, p in self.terms.items() for n, q in right.items())
        return Laurent(
            summed(
                (_product(m, n) if m else n, q if p is ONE else p if q is ONE else p * q)
                for m, p, n, q in pairs
            )
        )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, (Laurent, Fraction, int)):
            return NotImplemented
        return self.terms == Laurent.of(other).terms

    def __hash__(self) -> int:
        return hash(frozenset(self.terms.items()))

    def reciprocal(self) -> Laurent:
        """The polynomial 1/p of a monomial p; ``ZeroDivisionError`` of anything else."""
        if len(self.terms) != 1:
            raise ZeroDivisionError("only a monomial has an inverse here")
        ((m, q),) = self.terms.items()
        return Laurent({tuple((s, -e) for s, e in m): 1 / q})

    inverse = property(reciprocal)


def _product(m: Monomial, n: Iterable[tuple[Tree, int]]) -> Monomial:
    exponents = dict(m)
    for symbol, e in n:
        exponents[symbol] = exponents.get(symbol, 0) + e
    return tuple(sorted([(s, e) for s, e in exponents.items() if e], key=_written))


def _written(factor: tuple[Tree, int]) -> tuple[str, int]:
    symbol, exponent = factor
    return symbol.text if isinstance(symbol, LaurentSymbol) else repr(symbol), exponent


# -- and trees ----------------------------------------------------------------------------------


def polynomial(t: Tree) -> Laurent:
    """The polynomial of a tree of numbers; what is neither sum nor product in it is a symbol.

    ``OverlongError`` where that has more than ``MOST`` terms.
    """
    if isinstance(t, (int, Fraction)):
        return Laurent.of(t)
    if isinstance(t, tuple) and t[0] in ("add", "mul"):
        total = Laurent.of(int(t[0] == "mul"))
        for x in t[1:]:
            total = total + polynomial(x) if t[0] == "add" else total * polynomial(x)
            if len(total.terms) > MOST:
                raise OverlongError("too many terms")
        return total
    if isinstance(t, tuple) and t[0] == "pow" and isinstance(t[2], int) and t[2] > 0:
        return polynomial(("mul", *[t[1]] * t[2]))
    if isinstance(t, tuple) and t[0] == "div":
        below = polynomial(t[2])
        if len(below.terms) == 1:
            return polynomial(t[1]) * below.reciprocal()
    return Laurent.symbol(t)


LONGEST = 5000
"""As many terms has a polynomial at most that is asked whether it is 0."""


def vanishes(t: Tree) -> bool:
    """Is a rational function of parameters 0 everywhere? Functions of them count as parameters."""
    return not _quotient_of(t)[0]


def _quotient_of(t: Tree) -> tuple[Laurent, Laurent]:
    """The numerator and the denominator of a tree; ``OverlongError`` where one has more than
    ``LONGEST`` terms."""
    above, below = Laurent.symbol(t), Laurent.of(1)
    if isinstance(t, (int, Fraction)):
        above = Laurent.of(t)
    elif isinstance(t, tuple) and t[0] == "pow":
        above, below = (_power(x, abs(t[2])) for x in _quotient_of(t[1]))
        above, below = (above, below) if t[2] > 0 else (below, above)
    elif isinstance(t, tuple) and t[0] == "div":
        (above, below), (over, under) = map(_quotient_of, t[1:])
        above, below = _long(above, under), _long(below, over)
    elif isinstance(t, tuple) and t[0] in ("add", "mul"):
        (above, below), *others = map(_quotient_of, t[1:])
        for over, under in others:
            if t[0] == "mul":
                above = _long(above, over)
            elif under == below:
                above, under = above + over, Laurent.of(1)
            else:
                above = _long(above, under) + _long(over, below)
            below = _long(below, under)
    return above, below


def _power(p: Laurent, k: int) -> Laurent:
    whole = Laurent.of(1)
    for _ in range(k):
        whole = _long(whole, p)
    return whole


def _long(p: Laurent, r: Laurent) -> Laurent:
    """The product of two polynomials; ``OverlongError`` if it may have too many terms."""
    if len(p.terms) * len(r.terms) > LONGEST:
        raise OverlongError("too many terms")
    return p * r


def collected(t: Tree) -> Tree:
    """A tree of numbers, multiplied out, with its like terms added."""
    return written(polynomial(t))


def shortened(t: Tree) -> Tree:
    """The same with like terms added, where that is not too long."""
    try:
        return collected(t)
    except OverlongError:
        return t


def written(p: Laurent) -> Tree:
    """The tree of a polynomial, a sum of its terms."""
    return grouped(p, lambda _: False, lambda _: False)


def grouped(p: Laurent, together: Callable[[Tree], bool], last: Callable[[Tree], bool]) -> Tree:
    """The tree Σ (sum of some symbols)/(their divisor) · others of a polynomial, in which terms
    with the same others are one.

    ``together`` picks the symbols that are summed; terms that have a symbol of ``last`` come last.
    """
    groups: dict[Monomial, dict[Monomial, Fraction]] = {}
    for m, q in p.terms.items():
        rest = tuple(x for x in m if not together(x[0]))
        groups.setdefault(rest, {})[tuple(x for x in m if together(x[0]))] = q
    # what is added before what is taken away
    order = sorted(
        groups,
        key=lambda m: (any(last(s) for s, _ in m), max(groups[m].values()) < 0, repr(m)),
    )
    return add(*(_quotient(groups[m], m) for m in order))


def _quotient(terms: dict[Monomial, Fraction], others: Monomial) -> Tree:
    """The tree of a sum over what divides every term of it, times others; of one term they stand
    above the line."""
    below = {s: e for m in terms for s, e in m if e < 0}
    common = tuple(sorted(((s, -e) for s, e in below.items()), key=_written))
    lifted = (Laurent(terms) * Laurent({common: ONE})).terms
    order = sorted(lifted, key=lambda m: (lifted[m] < 0, repr(m)))
    if common and len(order) == 1:
        q = lifted[order[0]]
        whole = mul(plain(abs(q)), _monomial(order[0]), _monomial(others))
        return mul(-1 if q < 0 else 1, ("div", whole, _monomial(common)))
    above = add(*(mul(plain(lifted[m]), _monomial(m)) for m in order))
    return mul(("div", above, _monomial(common)) if common else above, _monomial(others))


def _monomial(m: Monomial) -> Tree:
    return mul(1, *(s if e == 1 else ("pow", s, e) for s, e in m))


# The density of an ellipsoid as a polynomial in the level s = ⟨r, Q r⟩ of a place r in it: 0 in
# the middle, 1 at the boundary.

LEVEL = "s_r"
WRITTEN: Tree = ("par", "s")
"""How a problem file writes it."""
TRIED = 64
"""A density is tried at so many levels, and in the middle, for its sign."""


def is_layered(density: Tree) -> bool:
    """Is it a function of the level?"""
    return LEVEL in names(density)


def degree_in_level(t: Tree) -> int | None:
    """The degree of a polynomial in the level, if nothing cancels; ``None`` for what is none."""
    if not isinstance(t, tuple) or not is_layered(t):
        return int(t == LEVEL)
    parts = [degree_in_level(x) for x in t[1:] if t[0] in ("add", "mul", "div", "pow")]
    found = [x for x in parts if x is not None]
    if not found or len(found) < len(parts):
        return None
    if t[0] == "pow":
        return found[0] * t[2] if t[2] > 0 else None
    if t[0] == "div":
        return None if is_layered(t[2]) else found[0]
    return max(found) if t[0] == "add" else sum(found)


def at_levels(density: Tree) -> Iterator[tuple[Fraction, Tree]]:
    """Levels from the middle to the boundary, each with the density there; one for all, where it is
    the same."""
    for k in range(TRIED + 1 if is_layered(density) else 1):
        yield Fraction(k, TRIED), replaced(density, LEVEL, Fraction(k, TRIED))
