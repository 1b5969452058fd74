"""Symmetries that commute, and the quadrature of the one degree of freedom that they leave."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import reduce
from itertools import groupby, product
from typing import Any

from ...language.tree import Tree
from ...problem.problem import ProblemError
from .found_symmetries import SymmetriesFound, axis, named
from .routhian import Routhian
from .scalar_lagrangian import full
from .state_functions import Element, entries_in
from .symmetry import Symmetry

# Which symmetries a reduction is by: of L̃ itself, without time, each commuting with the others.


def choices(found: SymmetriesFound) -> Iterator[tuple[Symmetry, ...]]:
    """The symmetries that may be taken, several times; ``ProblemError`` where there is none.

    They are taken in turn, kind by kind, of several axes the last first; listed in their order.
    Then so again, with each of the others as the first.
    """
    fit = [k for k, x in enumerate(found.symmetries) if _fits(x)]
    if not fit:
        raise ProblemError(f"{found.problem.name}: {_why_not(found)}, so that nothing is reduced")
    by_kind = groupby(fit, key=lambda k: found.symmetries[k].kind)
    turn = [
        k
        for _, group in by_kind
        for k in sorted(group, key=lambda k: axis(found.symmetries[k]), reverse=True)
    ]
    told = set[tuple[int, ...]]()
    for first in turn:
        taken: list[int] = []
        for k in (first, *turn):
            if k not in taken and all({k, j} in found.commuting for j in taken):
                taken.append(k)
        if (own := tuple(sorted(taken))) not in told:
            told.add(own)
            yield tuple(found.symmetries[k] for k in own)


def _fits(x: Symmetry) -> bool:
    """Does it leave L̃ alone, at δt = 0, by a field that does not depend on the time?"""
    return x.exact and x.tau == 0 and not any(map(full, x.moving))


def _why_not(found: SymmetriesFound) -> str:
    """Why no symmetry fits, in words."""
    others = [x for x in found.symmetries if x.kind != "time"]
    if not others:
        return "there is no symmetry of L but of the time"
    if all(x.exact for x in others):
        return "its symmetries move the time as well"
    return "its symmetries change L by the derivative of a function F, or depend on the time"


# Do the symmetries of a problem leave one degree of freedom, and what are their momenta called?


def leaves_one(found: SymmetriesFound) -> bool:
    """Do the symmetries that a reduction takes leave one degree of freedom?"""
    problem, taken = found.problem, next(choices(found))
    left = problem.own_group.dimension - len(problem.own_lagrangian.held) - len(taken)
    return left == 1


def momenta_of(found: SymmetriesFound, taken: Iterable[Symmetry]) -> tuple[str, ...]:
    """The names of 𝒥_1, 𝒥_2, … of the symmetries that a reduction takes."""
    names = dict(zip(map(id, found.symmetries), named(found), strict=True))
    return tuple(names[id(x)] for x in taken)


Vector = list[Element]


@dataclass(frozen=True)
class Quadrature:
    """One degree of freedom is left: u̇² = 2 ``slope`` (h̃ − V), u the ``entry`` of g.

    ``degree``: of the right side in u, where it is a polynomial, else 0; ``left``: of its factors
    of odd multiplicity, which say what kind of integral 1/√ of it has; ``leading``: what its
    leading coefficient vanishes with, by monomials in the 𝒥_i, the places of these, but for h̃,
    ``None``.
    """

    entry: Tree
    slope: Element
    degree: int = 0
    left: int = 0
    leading: Mapping[tuple[int, ...] | None, Element] = field(default_factory=dict)


def reduced(found: SymmetriesFound) -> tuple[Routhian, Quadrature | None]:
    """A reduction by symmetries that commute, and its quadrature: where those that are taken first
    leave one degree of freedom and no quadrature, by others that have one, if there are such."""
    first: Routhian | None = None
    for taken in choices(found):
        own = Routhian(found, taken)
        first = first or own
        try:
            left = quadrature_of(own)
        except ProblemError:  # of others: their fields depend on one another
            if own is first:
                raise
            continue
        if left or first.freedom != 1:
            return own, left
    assert first is not None
    return first, None


def quadrature_of(r: Routhian) -> Quadrature | None:
    """The square of the rate of an invariant entry of g by the energy, where that is all that
    is left."""
    if r.freedom != 1 or r.named:
        return None
    for k in r.functions.invariant:
        entry = r.functions.leaves[k]
        slope = _slope(r, r.slopes(entry))
        if slope and all(_depends_on_alone(r, k, x) for x in _all(r, slope)):
            return Quadrature(entry, slope, *_degrees(r, k, slope) or ())
    return None


def _all(r: Routhian, slope: Element) -> Vector:
    """The functions of which the right side is made."""
    parts = [y for s in r.squares for y in (s.weight, s.rest, *s.factors.values())]
    return [slope, r.functions.simplified(r.potential), *parts]


def _depends_on_alone(r: Routhian, k: int, x: Element) -> bool:
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


def _degrees(
    r: Routhian, k: int, slope: Element
) -> tuple[int, int, Mapping[tuple[int, ...] | None, Element]] | None:
    """The degree in u of f = 2 ``slope`` (h̃ − V), that of its factors of odd multiplicity, and its
    leading coefficient; ``None`` where it is no polynomial in u.

    f is linear in h̃: what has no h̃ in it divides all coefficients, and the rest is a factor
    alone.
    """
    U = r.functions.simplified(r.potential)
    by_letters = {None: r.functions.field(1)} | {x: -y for x, y in _by_momenta(r, U).items()}
    found = {x: slope * y for x, y in by_letters.items() if y}
    functions = r.functions.moving - {k}
    if any(r.functions.depends_on(x) & functions or _degree_in(k, x.denom) for x in found.values()):
        return None
    of = r.functions.field
    whole = of(reduce(lambda x, y: x.lcm(y), (x.denom for x in found.values())))
    cleared = {x: y * whole for x, y in found.items()}  # over numbers, which lcm leaves out
    parts = [y.numer for y in cleared.values()]
    common = reduce(lambda x, y: x.gcd(y), parts)
    degree = max(_degree_in(k, x) for x in parts)
    squared = (_degree_in(k, x) * (n - n % 2) for x, n in common.sqf_list()[1])
    leading = {x: of(_coefficient(k, degree, y.numer)) / y.denom for x, y in cleared.items()}
    return degree, degree - sum(squared), {x: y for x, y in leading.items() if y}


def _by_momenta(r: Routhian, U: Element) -> dict[tuple[int, ...], Element]:
    """The coefficients of V, a polynomial in the 𝒥_i, by the places of these."""
    found: dict[tuple[int, ...], Element] = {(): U}
    for s in r.squares:
        row = [*s.factors.items(), (None, -s.rest)]
        for (i, x), (j, y) in product(row, row):
            key = tuple(sorted(n for n in (i, j) if n is not None))
            found[key] = found.get(key, 0) + s.weight * x * y
    return found


def _coefficient(k: int, degree: int, p: Any) -> Any:
    """The coefficient of a power of one leaf in a polynomial."""
    terms = {(*e[:k], 0, *e[k + 1 :]): c for e, c in p.items() if e[k] == degree}
    return p.ring.from_dict(terms)


def _degree_in(k: int, p: Any) -> int:
    """The degree of a polynomial in one leaf."""
    return max((int(e[k]) for e in p), default=0)
