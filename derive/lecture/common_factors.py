"""Sums as people write them: before a bracket what several terms have of parameters, equal factors
as a power.  What is shown instead of a tree is equal to it as a rational function, or the tree
stays."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import gcd, lcm

from ..language.laurent import OverlongError, vanishes
from ..language.tree import Tree, add, mul, names, neg, terms
from ..record.record import Equation

NUMBERS = ("ζ", "w", "Π", "𝒥", "ζ_h", "ζ̇", "ẇ")
"""Letters whose components are numbers."""
SINGLE = ("h̃", "𝒱", "π", "t", "m")
"""Letters that are numbers themselves."""
FIRST = ("π", "m")
"""Of them those before the parameters of a product."""
Factors = Counter[Tree]
"""How often each factor is in a product; fewer than 0 times, below the line."""


def tidied(e: Equation, order: Sequence[str] = ()) -> Equation:
    """An equation with its sides as people write them; ``order``: of parameters in a product."""
    return Equation(_tidied(e.lhs, order), _tidied(e.rhs, order), e.for_all, e.exists)


def _tidied(t: Tree, order: Sequence[str]) -> Tree:
    if not isinstance(t, tuple) or t[0] in ("par", "at", "entry"):
        return t
    t = (t[0], *(_tidied(x, order) if isinstance(x, tuple) else x for x in t[1:]))
    if t[0] not in ("add", "mul") or not _is_number(t):
        return t
    if t[0] == "mul":
        return in_order(mul(*(_power(x, t[1:].count(x)) for x in dict.fromkeys(t[1:]))), order)
    found = add(*(in_order(_together(x), order) for x in _groups(t)))
    try:
        return found if vanishes(add(t, neg(found))) else t
    except OverlongError:
        return t


def in_order(t: Tree, order: Sequence[str]) -> Tree:
    """A product of numbers with what is constant first, its parameters in an order, and sums of
    parameters alone, m₁ + m₂, where the first of these is; within it the same of quotients and
    sums; where no order is told, as it is."""
    if not order or not isinstance(t, tuple) or t[0] not in ("add", "mul", "div", "pow"):
        return t
    first, *others = (in_order(x, order) for x in t[1:])
    if t[0] != "mul":
        return (t[0], first, *others)

    def place(x: Tree) -> int:
        base = x[1] if isinstance(x, tuple) and x[0] == "pow" else x
        parts = [neg(y) if _split(y)[0] < 0 else y for y in terms(base)]
        letters = [y[1] for y in parts if isinstance(y, tuple) and y[0] == "par"]
        if len(letters) == len(parts):
            return min(order.index(y) if y in order else len(order) for y in letters)
        if base in FIRST or isinstance(base, (int, Fraction)):
            return -1
        return len(order) if _is_constant(base) else len(order) + 1

    return mul(*sorted((first, *others), key=place))


def _is_number(t: Tree) -> bool:
    """Is it made of what is known to be a number, so that factors may change places?"""
    if not isinstance(t, tuple):
        return not isinstance(t, str) or t in SINGLE
    if t[0] in ("add", "mul", "div"):
        return all(map(_is_number, t[1:]))
    if t[0] == "pow":
        return isinstance(t[2], int) and _is_number(t[1])
    return t[0] in ("par", "entry") or (t[0] == "at" and t[1] in NUMBERS)


def _power(x: Tree, k: int) -> Tree:
    return x if k == 1 else ("pow", x, k)


def _split(t: Tree) -> tuple[Fraction, Factors]:
    """A product as a number and its factors."""
    if isinstance(t, (int, Fraction)):
        return Fraction(t), Counter()
    if isinstance(t, tuple) and t[0] in ("mul", "div"):
        number, factors = Fraction(1), Factors()
        for k, x in enumerate(t[1:]):
            q, of = _split(x)
            below = t[0] == "div" and k == 1
            number = number / q if below else number * q
            for y, n in of.items():
                factors[y] += -n if below else n
        return number, factors
    if isinstance(t, tuple) and t[0] == "pow":
        q, of = _split(t[1])
        return q ** t[2], Factors({x: n * t[2] for x, n in of.items()})
    return Fraction(1), Factors({t: 1})


def _product(number: Fraction, factors: Factors) -> Tree:
    """The tree of a product, a quotient where something is below the line."""
    above = mul(abs(number.numerator), *(_power(x, n) for x, n in factors.items() if n > 0))
    below = mul(number.denominator, *(_power(x, -n) for x, n in factors.items() if n < 0))
    return mul(-1 if number < 0 else 1, above if below == 1 else ("div", above, below))


def _groups(t: Tree) -> Iterable[list[Tree]]:
    """All terms, if they differ by parameters alone, and are not of these alone; else terms with
    the same factors of parameters, or with the same sum below the line, in the order in which the
    first of each stands; of the others those of parameters alone, and those with the same number
    below the line."""
    others = [{x: n for x, n in _split(y)[1].items() if not _is_constant(x)} for y in terms(t)]
    if others[0] and all(x == others[0] for x in others):
        return [[*terms(t)]]
    found: dict[object, list[Tree]] = {}
    for k, term in enumerate(terms(t)):
        same = {x: n for x, n in _split(term)[1].items() if _is_constant(x)}
        below = {x: n for x, n in same.items() if n < 0 and terms(x)[1:]}
        found.setdefault(frozenset((below or same).items()) or k, []).append(term)
    merged: dict[object, list[Tree]] = {}
    for key, (first, *rest) in found.items():
        number, factors = _split(first)
        if not rest and _is_constant(first):
            key = "parameters"
        elif not rest and number.denominator > 1 and min(factors.values()) > 0:
            key = f"over {number.denominator}"
        merged.setdefault(key, []).extend((first, *rest))
    return merged.values()


def _is_constant(t: Tree) -> bool:
    """Is it made of parameters?"""
    return {*names(t)} <= {"π"}


def _together(alike: list[Tree]) -> Tree:
    """The sum of terms, what all have before a bracket."""
    if len(alike) == 1:
        return alike[0]
    numbers, products = zip(*map(_split, alike), strict=True)
    number = Fraction(gcd(*(q.numerator for q in numbers)), lcm(*(q.denominator for q in numbers)))
    number *= -1 if max(numbers) < 0 else 1
    common = Factors()
    for x in products[0]:
        powers = [of[x] for of in products]
        common[x] = min(powers) if min(powers) > 0 else min(max(powers), 0)
    for of in products:
        of.subtract(common)
    left = sorted(zip(numbers, products, strict=True), key=lambda x: x[0] / number < 0)
    inside = add(*(_product(q / number, of) for q, of in left))
    return _product(number, Factors({**common, inside: 1}))


def positive(t: Tree, numbers: Mapping[str, float]) -> bool:
    """Is an expression positive by its terms, for all values but 0 of what has no number?"""
    if not isinstance(t, tuple):
        return t == "π" or (not isinstance(t, str) and t > 0)
    if t[0] == "par":
        return numbers.get(t[1], 0) > 0
    if t[0] == "pow":
        letter = t[2] % 2 == 0 and isinstance(t[1], tuple) and t[1][0] == "par"
        return (letter and numbers.get(t[1][1], 1) != 0) or positive(t[1], numbers)
    return t[0] in ("add", "mul", "div") and all(positive(x, numbers) for x in t[1:])
