"""The quadrature of the one degree of freedom that a reduction leaves, u̇² by the energy and the
momenta, and of which kind that integral is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from itertools import product
from typing import TYPE_CHECKING, Any

from ..language.tree import Tree
from .state_functions import Element, entries_in

if TYPE_CHECKING:
    from .routhian import Routhian

Vector = list[Element]


@dataclass(frozen=True)
class Quadrature:
    """One degree of freedom is left: u̇² = 2 ``slope`` (h̃ − V), u the ``entry`` of g.

    ``degree``: of the right side in u, where it is a polynomial, else 0; ``left``: of its factors
    of odd multiplicity, which say what kind of integral 1/√ of it has.
    """

    entry: Tree
    slope: Element
    degree: int
    left: int


def quadrature_of(r: Routhian) -> Quadrature | None:
    """The square of the rate of an invariant entry of g by the energy, where that is all that
    is left."""
    if r.freedom != 1 or r.named:
        return None
    for k in r.functions.invariant:
        entry = r.functions.leaves[k]
        slope = _slope(r, r.slopes(entry))
        if slope and all(_told_by(r, k, x) for x in _all(r, slope)):
            return Quadrature(entry, slope, *_degrees(r, k, slope))
    return None


def _all(r: Routhian, slope: Element) -> Vector:
    """The functions of which the right side is made."""
    parts = [y for s in r.squares for y in (s.weight, s.rest, *s.factors.values())]
    return [slope, r.functions.simplified(r.potential), *parts]


def _told_by(r: Routhian, k: int, x: Element) -> bool:
    """Has a function no entry of g but one, also in the functions that it has?"""
    own, first = r.functions.leaves, r.functions.first_entry
    places = r.functions.depends_on(x)
    inside = (y for i in places if i < first for y in entries_in(own[i]))
    return {i for i in places if i >= first} <= {k} and {*inside} <= {own[k]}


def _slope(r: Routhian, rates: Vector) -> Element:
    """⟨du, M⁻¹du⟩, by completing squares."""
    kept = [a for a, _ in enumerate(r.zeta) if a not in r.held]
    left = [[r.metric[a][b] for b in kept] for a in kept]
    form, total = [rates[a] for a in kept], r.functions.field(0)
    open_ = [*range(len(kept))]
    while open_:
        p = min(open_, key=lambda i: r.size(left[i][i]))
        open_.remove(p)
        if not left[p][p]:
            return r.functions.field(0)
        total = total + form[p] ** 2 / left[p][p]
        for i in open_:
            ratio = left[i][p] / left[p][p]
            form[i] = form[i] - ratio * form[p]
            left[i] = [x - ratio * y for x, y in zip(left[i], left[p], strict=True)]
    return r.functions.simplified(total)


def _degrees(r: Routhian, k: int, slope: Element) -> tuple[int, int]:
    """The degree in u of f = 2 ``slope`` (h̃ − V), and that of its factors of odd multiplicity;
    0, 0 where it is no polynomial in u.

    f is linear in h̃: what has no h̃ in it divides all coefficients, and the rest is a factor
    alone.
    """
    U = r.functions.simplified(r.potential)
    if any(
        i < r.functions.first_entry and [*entries_in(r.functions.leaves[i])]
        for i in r.functions.depends_on(U)
    ):
        return 0, 0
    found = [slope * x for x in (r.functions.field(1), *_by_momenta(r, U)) if x]
    if any(e[k] for x in found for e in x.denom):
        return 0, 0
    whole = reduce(lambda x, y: x.lcm(y), (x.denom for x in found))
    parts = [(x * r.functions.field(whole)).numer for x in found]
    common = reduce(lambda x, y: x.gcd(y), parts)
    degree = max(_degree_in(k, x) for x in parts)
    squared = (_degree_in(k, x) * (n - n % 2) for x, n in common.sqf_list()[1])
    return degree, degree - sum(squared)


def _by_momenta(r: Routhian, U: Element) -> Vector:
    """The coefficients of V, a polynomial in the 𝒥_i."""
    found: dict[tuple[int, ...], Element] = {(): U}
    for s in r.squares:
        row = [*s.factors.items(), (None, -s.rest)]
        for (i, x), (j, y) in product(row, row):
            key = tuple(sorted(n for n in (i, j) if n is not None))
            found[key] = found.get(key, 0) + s.weight * x * y
    return [*found.values()]


def _degree_in(k: int, p: Any) -> int:
    """The degree of a polynomial in one leaf."""
    return max((int(e[k]) for e in p), default=0)
