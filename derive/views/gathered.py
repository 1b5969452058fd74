"""Sums of numbers as a person writes them: what their terms share stands before or below them once,
what is constant before what moves; (Āv)₁ for A₁₁v₁ + A₂₁v₂ + A₃₁v₃, ‖v‖ for the root of its
squares, 1 for A₁₁² + A₁₂² in the plane."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Any

from ..language.tree import Tree, add, mul, neg, nodes, plain, terms
from ..record.vocabulary import SCALAR, VOCABULARY

MOVING = {"A", "Ȧ", "T", "Ṫ", "ζ", "ζ̇", "w", "ẇ", "v", "Z", "Ż", "Γ", "r", "d", "t"}
"""What changes with the motion, vectors and matrices by their entries: no sum is split by it."""
SEVERAL = 12
"""Beyond it the multiples of a common part of numbers are not seen at a glance."""
SIMPLE = 8
"""A denominator beyond it that divides a power of ten is better told by a decimal number."""

Powers = Counter[Any]
Monomial = tuple[Fraction, Powers]


def decimal(t: Tree) -> bool:
    """Is it a number like 9.81 rather than one like 3/4 or 1/20?"""
    if not isinstance(t, Fraction) or (t.denominator <= SIMPLE and abs(t) < 100):
        return False
    return 1 < abs(t.numerator) < 10**5 and 10**5 % t.denominator == 0


@dataclass(frozen=True)
class Gathering:
    """``order``: the place of each parameter in a product; ``sizes``: the rows of A, or of its
    blocks; ``plane``: A turns a plane."""

    order: Mapping[str, int]
    sizes: Mapping[Tree, int]
    plane: bool

    def tree(self, t: Tree) -> Tree:
        """A tree with its sums of numbers gathered."""
        if not isinstance(t, tuple) or t[0] == "par":
            return t
        if t[0] in ("add", "mul", "div") and _number(t):
            return self._written(self._contracted(_merged(self._expanded(t))))
        head = 2 if t[0] == "fun" else 1
        return self._norm((*t[:head], *map(self.tree, t[head:])))

    # A sum as its monomials.

    def _expanded(self, t: Tree) -> list[Monomial]:
        """The monomials of a sum; a sum that is not constant before an entry of A multiplied
        out."""
        if isinstance(t, tuple) and t[0] == "add":
            return [x for y in t[1:] for x in self._expanded(y)]
        factors = [*_factors(t)]
        sums = [x for x in factors if x[1] == 1 and self._varies(x[0])]
        if sums and any(k == 1 and self._turns(x) for x, k in factors):
            factors.remove(sums[0])
            rest = self._monomial(factors)
            return [_product([x, rest]) for x in self._expanded(sums[0][0])]
        return [self._monomial(factors)]

    def _turns(self, t: Tree) -> bool:
        return isinstance(t, tuple) and t[0] == "entry" and len(t) == 4 and t[1] in self.sizes

    def _varies(self, t: Tree) -> bool:
        """Is it a sum in which more than declared parameters stands?"""
        inside = nodes(t) if isinstance(t, tuple) and t[0] == "add" else []
        told = (x for x in inside if isinstance(x, tuple) and x[0] in ("par", "entry"))
        return any(x[0] == "entry" or x[1] not in self.order for x in told)

    def _monomial(self, factors: Iterable[tuple[Tree, int]]) -> Monomial:
        """Factors with their powers as a monomial, what is in them gathered."""
        return _product(_power(y, j * k) for x, k in factors for y, j in _factors(self.tree(x)))

    def _contracted(self, monomials: list[Monomial]) -> list[Monomial]:
        """Monomials with (Āv)_j for the sum of all A_ij v_i, and 1 for the squares of cos and
        sin."""
        first, second = (("entry", "A", 1, j) for j in (1, 2))
        for c, p in [x for x in monomials if self.plane and x[1][second] == 2]:
            rest = less(p, Powers({second: 2}))
            if (other := (c, Powers({**rest, first: 2}))) in monomials:
                monomials = [(c, rest) if x == other else x for x in monomials if x != (c, p)]
        rows: dict[tuple[Any, ...], dict[int, Monomial]] = {}
        turned: dict[tuple[Any, ...], Monomial] = {}
        for c, p in monomials:
            for a in (x for x, k in p.items() if k == 1 and self._turns(x)):
                _, block, i, j = a
                for v in (x for x, k in p.items() if k == 1 and self._of_space(x, i)):
                    rest = less(p, Powers([a, v]))
                    key = block, j, v[1], c, frozenset(rest.items())
                    rows.setdefault(key, {})[i] = c, p
                    new = ("entry", ("mul", ("T", block), v[1]), j)
                    turned[key] = c, Powers({**rest, new: 1})
        for key, members in rows.items():
            whole = len(members) == self.sizes[key[0]]
            there = [x for x in monomials if x in members.values()] if whole else []
            if whole and len(there) == len(members):
                one: dict[int, list[Monomial]] = {id(x): [] for x in there}
                one[id(there[0])] = [turned[key]]
                monomials = [y for x in monomials for y in one.get(id(x), [x])]
        return monomials

    def _of_space(self, x: Tree, i: int) -> bool:
        """Is it entry i of a vector with as many entries as A has rows, in a product a block?"""
        if not (isinstance(x, tuple) and x[0] == "entry" and x[2:] == (i,)):
            return False
        inner = x[1] if isinstance(x[1], tuple) else ("",)
        return "A" in self.sizes or inner[:2] in (("at", "d"), ("at", "χ"))

    def _norm(self, t: Tree) -> Tree:
        """‖v‖ for the root of the squares of all entries of v, less something or not."""
        if not (isinstance(t, tuple) and t[:2] == ("fun", "sqrt")):
            return t
        squares = [x for x in terms(t[2]) if isinstance(x, tuple) and x[0] == "pow" and x[2] == 2]
        entries = [terms(x[1])[0] for x in squares]
        told = all(self._of_space(x, k) for k, x in enumerate(entries, 1))
        vectors = {x[1] for x in entries if told and isinstance(x, tuple)}
        if len(vectors) != 1 or not len(terms(t[2])) == len(squares) == max(
            self.sizes.values(), default=0
        ):
            return t
        away = [neg(add(*terms(x[1])[1:])) for x in squares]
        shift = neg(("matrix", *(("row", x) for x in away))) if any(away) else 0
        return ("fun", "sqrt", ("norm2", add(*vectors, shift)))

    # Monomials as a sum.

    def _written(self, monomials: Sequence[Monomial]) -> Tree:
        """The sum of monomials, what they share apart; else what most of them share."""
        while len(monomials) > 1:
            shared = shared_powers([p for _, p in monomials])
            if any(k < 0 for _, p in monomials for k in less(p, shared).values()):
                shared = +shared  # no fraction in a fraction
            content = _content([c for c, _ in monomials], bool(shared))
            if shared or content != 1:
                inner = self._written([(c / content, less(p, shared)) for c, p in monomials])
                return self._term(*_product([(content, shared), as_monomial(inner)]))
            if (factor := _most_shared([p for _, p in monomials])) is None:
                return self._sum(monomials)
            has = [p[factor[0]] * factor[1] > 0 for _, p in monomials]
            at, group = has.index(True), [x for x, y in zip(monomials, has, strict=True) if y]
            others = [x for x, y in zip(monomials, has, strict=True) if not y]
            monomials = [*others[:at], as_monomial(self._written(group)), *others[at:]]
        return self._term(*monomials[0]) if monomials else 0

    def _sum(self, monomials: Sequence[Monomial]) -> Tree:
        """Monomials that share nothing, one that is added first; those of parameters in order."""
        if all(map(of_parameters, (p for _, p in monomials))):
            monomials = sorted(monomials, key=lambda x: min(map(self._rank, x[1]), default=(9, 0)))
        first = next((k for k, (c, _) in enumerate(monomials) if c > 0), 0)
        return add(
            *(
                self._term(*x)
                for x in (monomials[first], *monomials[:first], *monomials[first + 1 :])
            )
        )

    def _term(self, c: Fraction, p: Powers) -> Tree:
        """A monomial as a product, or as a fraction whose line is below all of it."""
        ranked = sorted(p.items(), key=lambda y: self._rank(y[0]))
        above, below = (
            [("pow", x, k * sign) if k * sign > 1 else x for x, k in ranked if k * sign > 0]
            for sign in (1, -1)
        )
        if not below:
            return mul(plain(c), *above)
        lead, under = (c, 1) if decimal(c) else (c.numerator, c.denominator)
        return ("div", mul(lead, *above), mul(under, *below))

    def _rank(self, x: Tree) -> tuple[int, int]:
        """The place of a factor: constants, sums, what moves, functions."""
        head = x[0] if isinstance(x, tuple) else ""
        if head == "par":
            return 1, self.order.get(x[1], len(self.order))  # type: ignore[index]
        places = {"": 0, "add": 3, "fun": 5}
        return (4 if _moves(x) else places.get(head, 2)), 0


def _types(name: str) -> set[object]:
    known = VOCABULARY.get(name)
    return {use.type for use in known.uses} if known else set()


def _number(t: Tree) -> bool:
    """Is it a number, whatever the group?"""
    if not isinstance(t, tuple):
        return not isinstance(t, str) or t == "π" or SCALAR in _types(t)
    if t[0] in ("add", "mul", "div", "pow", "inv"):
        return all(map(_number, t[1:]))
    if t[0] == "at":
        families = (x for x in _types(str(t[1])) if isinstance(x, tuple) and x[0] == "family")
        return any(x[2] == SCALAR for x in families)
    return t[0] in ("par", "entry", "fun", "inner", "metric", "norm2", "tr", "det")


def _moves(x: Tree) -> bool:
    """Is it an entry of what changes with the motion, or of a product with it?"""
    if isinstance(x, tuple):
        return x[0] in ("entry", "at", "mul", "call") and any(map(_moves, x[1:]))
    return x in MOVING


def _factors(t: Tree, k: int = 1) -> Iterator[tuple[Tree, int]]:
    """The factors of a product or quotient of numbers, with their powers."""
    match t:
        case ("mul", *factors) if _number(t):
            for x in factors:
                yield from _factors(x, k)
        case ("div", above, below):
            yield from _factors(above, k)
            yield from _factors(below, -k)
        case ("pow", x, n):
            yield from _factors(x, k * n)
        case ("inv", x):
            yield from _factors(x, -k)
        case _:
            yield t, k


def _power(x: Tree, k: int) -> Monomial:
    if isinstance(x, (int, Fraction)):
        return Fraction(x) ** k, Powers()
    return Fraction(1), Powers({x: k})


def as_monomial(t: Tree) -> Monomial:
    """A product or quotient as it stands."""
    return _product(_power(*x) for x in _factors(t))


def _product(factors: Iterable[Monomial]) -> Monomial:
    c, found = Fraction(1), Powers()
    for q, p in factors:
        c *= q
        found.update(p)
    return c, less(found, Powers())


def _merged(monomials: Iterable[Monomial]) -> list[Monomial]:
    """Monomials of different powers, none zero."""
    found: dict[object, Monomial] = {}
    for c, p in monomials:
        key = frozenset(p.items())
        found[key] = (found[key][0] + c if key in found else c), p
    return [x for x in found.values() if x[0]]


def shared_powers(powers: Sequence[Powers]) -> Powers:
    """What is a factor, or a divisor, of every monomial."""
    found = {x: [p[x] for p in powers] for x in powers[0]}
    return Powers({x: k for x, ks in found.items() if (k := max(0, min(ks)) + min(0, max(ks)))})


def less(p: Powers, q: Powers) -> Powers:
    """A product of powers divided by another."""
    return Powers({x: k - q[x] for x, k in p.items() if k != q[x]})


def of_parameters(p: Powers) -> bool:
    """Are all factors parameters?"""
    return all(isinstance(x, tuple) and x[0] == "par" for x in p)


def _most_shared(powers: Sequence[Powers]) -> tuple[Tree, int] | None:
    """The constant that is a divisor, or factor, of most monomials, and which of both."""
    counts = Counter((x, 1 if k > 0 else -1) for p in powers for x, k in p.items() if not _moves(x))
    counts = Counter({x: k for x, k in counts.items() if k < len(powers)})
    most = max(counts, key=lambda y: (counts[y], -y[1]), default=None)
    return most if most and counts[most] > 1 else None


def _content(numbers: Sequence[Fraction], shared: bool) -> Fraction:
    """The number before a sum with such numbers before its terms; 1 where they are better left."""
    below, sign = {c.denominator for c in numbers}, -1 if all(c < 0 for c in numbers) else 1
    if not shared and (below == {1} or len(below) > 1):
        return Fraction(1)
    whole = Fraction(gcd(*(c.numerator for c in numbers)), lcm(*below))
    mixed = 1 in below and len(below) > 1
    far = max(abs(c / whole) for c in numbers) > SEVERAL
    return Fraction(sign) if mixed or far else sign * whole
