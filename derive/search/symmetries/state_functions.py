"""Rational functions of the state, and what the relations of the group make of them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations_with_replacement
from math import comb, gcd, isqrt, lcm
from typing import Any

from ...algebra.exact_kernel import PRIMES, ResidueVectorSource, kernel, rational
from ...algebra.groups import Group
from ...language.tree import Tree, add, mul, nodes
from ...language.values import arithmetic
from .conditions import EXTRA
from .scalar_lagrangian import entries

Element = Any
"""An element of the field."""
Exponents = tuple[int, ...]

MONOMIALS = 400
"""Of so many monomials at most normal forms are sought."""


def leaves(t: Tree) -> Iterator[Tree]:
    """What an expression is a rational function of: names, parameters, entries, and elementary
    functions, each with its argument one leaf."""
    if isinstance(t, str) or (isinstance(t, tuple) and t[0] in ("par", "entry", "fun")):
        yield t
    elif isinstance(t, tuple):
        for x in t[1:2] if t[0] == "pow" else t[1:]:
            yield from leaves(x)


def entries_in(t: Tree) -> list[Tree]:
    """The entries of g in an expression."""
    return [x for x in nodes(t) if isinstance(x, tuple) and x[:2] == ("entry", "A")]


class StateFunctions:
    """The field of rational functions over Q in the leaves of some trees.

    ``invariant``: entries of g that come first in normal forms; ``moving``: the places of the
    leaves that vary with g, its entries and functions of these.
    """

    def __init__(self, group: Group, trees: Iterable[Tree]):
        from sympy import QQ
        from sympy.polys.fields import field

        places = entries(group)
        found = dict.fromkeys(x for t in trees for x in leaves(t))
        self.group, self.places = group, places
        self.leaves = (*(x for x in found if x not in places), *places)
        self.first_entry = len(self.leaves) - len(places)
        self.moving = {k for k, x in enumerate(self.leaves) if entries_in(x)}
        names = [f"x{k}" for k, _ in enumerate(self.leaves)]
        self.field, *generators = field(names, QQ)
        self.known: dict[Tree, Element] = dict(zip(self.leaves, generators, strict=True))
        self.invariant: tuple[int, ...] = ()
        self._rules: dict[tuple[tuple[int, ...], int], dict[Exponents, Any]] = {}

    def of(self, t: Tree) -> Element:
        """The function that an expression is."""
        if t not in self.known:
            self.known[t] = self._made(t)
        return self.known[t]

    def _made(self, t: Tree) -> Element:
        if isinstance(t, (int, Fraction)):
            return self.field(self.field.domain(t.numerator, t.denominator))
        assert isinstance(t, tuple)
        return arithmetic(t, self.of)

    # -- on the group --------------------------------------------------------------------------

    def used(self, p: Any) -> tuple[int, ...]:
        """The entries that occur in a polynomial, by their places among the leaves."""
        span = range(self.first_entry, len(self.leaves))
        return tuple(k for k in span if any(e[k] for e in p))

    def depends_on(self, x: Element) -> set[int]:
        """The leaves that occur in a function."""
        return {k for p in (x.numer, x.denom) for e in p for k, n in enumerate(e) if n}

    def simplified(self, x: Element) -> Element:
        """The same function on the group, its numerator and denominator written with less."""
        above, below = (self._simpler(p) for p in (x.numer, x.denom))
        return self.field(above) / self.field(below)

    def _simpler(self, p: Any) -> Any:
        """A polynomial or its normal form: fewer entries that are not invariant, then shorter."""
        normal = self._normal(p)
        return min((p, normal), key=self._length) if normal else normal

    def _length(self, p: Any) -> tuple[int, int]:
        return len({*self.used(p)} - {*self.invariant}), len(p)

    def _normal(self, p: Any) -> Any:
        used = self.used(p)
        degree = max((sum(e[k] for k in used) for e in p), default=0)
        for these in (tuple(sorted({*used, *self.invariant})), used):
            if degree and comb(len(these) + degree, degree) <= MONOMIALS:
                return self._rewritten(p, these, self._found(these, degree))
        return p

    def _rewritten(self, p: Any, these: Sequence[int], rules: Mapping[Exponents, Any]) -> Any:
        """A polynomial with the monomials in these entries replaced by the rules."""
        total = p.ring.zero
        for e, c in p.items():
            key = tuple(e[k] for k in these)
            if key not in rules:
                total += p.ring.from_dict({e: c})
                continue
            rest = [*e]
            for own, x in rules[key].items():
                for k, n in zip(these, own, strict=True):
                    rest[k] = n
                total += p.ring.from_dict({tuple(rest): c * x})
        return total

    def _found(self, these: tuple[int, ...], degree: int) -> dict[Exponents, Any]:
        """Monomial → what it is on the group by earlier ones, for those that depend on these."""
        key = these, degree
        if key not in self._rules:
            self._rules[key] = self._relations(these, degree)
        return self._rules[key]

    def _relations(self, these: Sequence[int], degree: int) -> dict[Exponents, Any]:
        places = range(len(these))
        listed = [
            tuple(x.count(k) for k in places)
            for n in range(degree + 1)
            for x in combinations_with_replacement(places, n)
        ]
        others = [k for k, at in enumerate(these) if at not in self.invariant]
        listed.sort(key=lambda e: (sum(e[k] for k in others), sum(e)))
        found = [kernel(self._values(these, listed, p), len(listed), p) for p in PRIMES[:2]]
        rules = {}
        for c, *rows in zip(found[0][1], *(x for x, _ in found), strict=True):
            residues = [[row[k] for row in rows] for k, _ in enumerate(listed)]
            numbers = [rational(x, PRIMES[:2]) for x in residues]
            if None not in numbers:
                rules[listed[c]] = {
                    e: self.field.domain(-x.numerator, x.denominator)
                    for k, (e, x) in enumerate(zip(listed, numbers, strict=True))
                    if x and k != c
                }
        return rules

    def _values(
        self, these: Sequence[int], listed: Sequence[Exponents], p: int
    ) -> Iterator[tuple[int, ...]]:
        """The monomials at random elements, a row for each of these."""
        source = ResidueVectorSource(p, len(listed) + EXTRA, 6)
        g = self.group.sample_inside(source, 1)
        at = [source.constant(0) + g[i][j] for i, j in (self.places[self.leaves[k]] for k in these)]
        columns = []
        for e in listed:
            total = source.constant(1)
            for x, n in zip(at, e, strict=True):
                total = total * x**n if n else total
            columns.append(total.values)
        return zip(*columns, strict=True)

    # -- as trees ------------------------------------------------------------------------------

    def tree(self, x: Element, *beside: Tree) -> Tree:
        """A function as a tree, times what stands beside it above the line: numbers, powers and
        squares taken out of sums."""
        if not x:
            return 0
        (c, above), (d, below) = map(self._factors, (x.numer, x.denom))
        q = c / d
        numerator = mul(abs(q.numerator), *above, *beside)
        bottom = mul(q.denominator, *below)
        whole = numerator if bottom == 1 else ("div", numerator, bottom)
        return mul(-1, whole) if q < 0 else whole

    def _factors(self, p: Any) -> tuple[Fraction, list[Tree]]:
        """A polynomial as a number and factors: powers of leaves, then of sums whose simplest term
        is positive."""
        common = [min(column) for column in zip(*p, strict=True)]
        left = ((tuple(n - k for n, k in zip(e, common, strict=True)), c) for e, c in p.items())
        rest = p.ring.from_dict(dict(left))
        root = _root(rest)
        scale, whole = self._primitive(rest if root is None else root)
        found = self._powers(common)
        if root is None:
            return scale, found + ([] if whole == 1 else [whole])
        return scale**2, [*found, ("pow", whole, 2)]

    def _primitive(self, p: Any) -> tuple[Fraction, Tree]:
        """A polynomial as a number times a sum."""
        numbers = [Fraction(int(c.numerator), int(c.denominator)) for c in p.values()]
        scale = Fraction(
            gcd(*(x.numerator for x in numbers)), lcm(*(x.denominator for x in numbers))
        )
        terms = [*zip(p, numbers, strict=True)]
        first = min(terms, key=lambda x: self._order(x[0]))
        scale = -scale if first[1] < 0 else scale
        return scale, self._sum((e, x / scale) for e, x in terms)

    def _order(self, e: Exponents) -> tuple[Any, ...]:
        """How terms are listed: by the entries of g in them, the simplest first."""
        inner = e[self.first_entry :]
        return sum(inner), tuple(-n for n in e)

    def _sum(self, terms: Iterable[tuple[Exponents, Fraction]]) -> Tree:
        """Σ of what has the same parameters, each with a sum of monomials in entries of g."""
        groups: dict[Exponents, list[tuple[Exponents, Fraction]]] = {}
        for e, c in terms:
            groups.setdefault(e[: self.first_entry], []).append((e[self.first_entry :], c))
        found, zeros = list[tuple[Tree, Tree]](), (0,) * self.first_entry
        for outer in sorted(groups, reverse=True):
            inner = sorted(groups[outer], key=lambda x: self._order((*outer, *x[0])))
            scale = gcd(*(int(c) for _, c in inner)) * (-1 if inner[0][1] < 0 else 1)
            whole = add(*(mul(int(c / scale), *self._powers((*zeros, *e))) for e, c in inner))
            found.append((mul(scale, *self._powers(outer)), whole))
        found.sort(key=lambda x: _signed(x[0]))
        if len({whole for _, whole in found}) == 1:  # (of parameters)(of entries)
            return mul(add(*(front for front, _ in found)), found[0][1])
        return add(*(_distributed(*x) for x in found))

    def _powers(self, exponents: Collection[int]) -> list[Tree]:
        pairs = zip(self.leaves, exponents, strict=False)
        return [x if n == 1 else ("pow", x, n) for x, n in pairs if n]


def _root(p: Any) -> Any:
    """The polynomial whose square a polynomial of several terms is; ``None`` for none."""
    if len(p) < 3:
        return None
    c, half = Fraction(int(p.LC.numerator), int(p.LC.denominator)), tuple(n // 2 for n in p.LM)
    ends = isqrt(abs(c.numerator)), isqrt(c.denominator)
    if c < 0 or Fraction(*ends) ** 2 != c or any(n % 2 for n in p.LM):
        return None
    first = p.ring.from_dict({half: p.ring.domain(*ends)})
    root, left = first, p - first**2
    while left and len(root) < len(p):
        step, rest = divmod(left.leading_term(), 2 * first)
        if rest or not step:
            return None
        root, left = root + step, left - 2 * root * step - step**2
    return None if left else root


def _distributed(front: Tree, whole: Tree) -> Tree:
    """A product; a sum where a number stands before one."""
    if isinstance(front, int) and isinstance(whole, tuple) and whole[0] == "add":
        return add(*(mul(front, x) for x in whole[1:]))
    return mul(front, whole)


def _signed(t: Tree) -> bool:
    """Does a product begin with a minus?"""
    first = t[1] if isinstance(t, tuple) and t[0] == "mul" else t
    return isinstance(first, int) and first < 0
