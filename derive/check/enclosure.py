"""The claim of a step of rule "enclosure": a critical point of h̃ on a level of what is kept.

The last equation of the step has h̃ with multiples of the left sides of the others, C_j − c_j; all
right sides are polynomials.  𝓛 = their last, plus Σ δ_j times the others, has one critical point
near the place of its distances, if Newton's step there is a contraction: computed here once more,
from the trees, in fractions.  Entries of g there must be those of an element of the group.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, reduce
from typing import Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.show import show
from ..language.tree import Tree, nodes
from ..record.record import Equation, Step
from .entries_on_a_level import Entries

Powers = tuple[tuple[Tree, int], ...]
Terms = dict[Powers, Fraction]
"""A polynomial: powers of names, sorted → coefficient."""
VARIABLES = (("at", "Π"), ("entry", "A"), ("entry", "Γ"))
DIGITS = 10**6
"""Decimals are of so many parts of 1."""
SIZE, TERMS = 60, 20_000
"""The most variables and multipliers; and the most products of terms at once."""


def kept_claims(step: Step) -> list[Equation]:
    """That motions keep the left sides of all equations but the last."""
    return [Equation(("call", "d/dt", e.lhs), 0) for e in step.equations[:-1]]


@dataclass(frozen=True)
class Enclosure:
    """The function 𝓛 of a step of rule "enclosure", in powers of the distances from the ``centre``
    and of δ_j: ``names``, of the variables and the multipliers; the ``slope`` and the ``second``
    derivatives at 0; ``above``, the terms of higher order, by the numbers of the names."""

    centre: dict[Tree, Fraction]
    names: list[Tree]
    slope: list[Fraction]
    second: list[list[Fraction]]
    above: list[tuple[dict[int, int], Fraction]]

    @cached_property
    def _inverse(self) -> q.Matrix | None:
        return q.inverse(q.matrix(self.second))

    @cached_property
    def least(self) -> Fraction:
        """2a for a = |J⁻¹g|, for the slope g and second derivatives J at 0."""
        assert self._inverse is not None
        steps = q.flatten(q.times(self._inverse, q.column(self.slope)))
        return Fraction(2 * max(abs(x) for x in steps))

    @property
    def isolated(self) -> bool:
        """Is one critical point within 2a?"""
        return self._inverse is not None and self.contracts(self.least)

    def contracts(self, radius: Fraction) -> bool:
        """Is a ≤ ρ/2 and ‖|J⁻¹|B(ρ)‖ < ½ for this radius ρ?"""
        if self._inverse is None or self.least > radius:
            return False
        change = [[Fraction(0)] * len(self.names) for _ in self.names]
        for powers, c in self.above:
            small = radius ** (sum(powers.values()) - 2)
            for i, j, k in _pairs(powers):
                change[i][j] += k * c * small
        size = tuple(tuple(map(abs, row)) for row in self._inverse)
        moved: Any = q.times(size, q.matrix(change))
        return bool(2 * max(map(sum, moved)) < 1)


def enclosure_of(step: Step) -> Enclosure:
    """What the right sides of a step say; ``ValueError`` where they are no polynomials."""
    *levels, energy = (e.rhs for e in step.equations)
    centre = {x: _centre(x, (*levels, energy)) for x in _variables((*levels, energy))}
    names = [*centre, *(f"δ{j}" for j, _ in enumerate(levels))]
    if len(names) > SIZE:
        raise ValueError(f"{len(names)} variables and multipliers; at most {SIZE}")
    function = polynomial(energy, centre)
    for j, t in enumerate(levels):
        for m, c in polynomial(t, centre).items():
            function[*m, (f"δ{j}", 1)] = c
    place = {x: i for i, x in enumerate(names)}
    slope = [Fraction(0)] * len(names)
    second = [[Fraction(0)] * len(names) for _ in names]
    above: list[tuple[dict[int, int], Fraction]] = []
    for m, c in function.items():
        powers = {place[x]: e for x, e in m}
        degree = sum(powers.values())
        if degree == 1:
            slope[next(iter(powers))] += c
        if degree > 2:
            above.append((powers, abs(c)))
        for i, j, k in _pairs(powers) if degree == 2 else ():
            second[i][j] += k * c
    return Enclosure(centre, names, slope, second, above)


def enclosure_fault(step: Step, group: Group, side: str) -> str:
    """Why the equations of a step enclose no critical point at entries of an element of a group; ""
    where they do.  ``side``: "right" where entries of g move by E_bg."""
    *lefts, own = (polynomial(e.lhs, {}) for e in step.equations)
    if own.pop((("h̃", 1),), None) != 1 or not _spanned(own, lefts):
        return "the left side is not h̃ with multiples of what is kept"
    found = enclosure_of(step)
    entries = Entries(group, [*found.centre], left=side != "right")
    momenta: list[Tree] = [("at", "Π", a + 1) for a in range(group.dimension)]
    if free := [x for x in (*momenta, *entries.missing()) if x not in found.centre]:
        return f"no critical point is enclosed: {show(free[0])} is free"
    if not found.isolated:
        return "no critical point is enclosed: no contraction"
    return entries.fault(lefts, found.centre, found.least)


def _variables(trees: Sequence[Tree]) -> list[Tree]:
    found = {x for t in trees for x in nodes(t) if isinstance(x, tuple) and x[:2] in VARIABLES}
    return sorted(found, key=str)


def _centre(x: Tree, trees: Sequence[Tree]) -> Fraction:
    """The number that a variable is written as a distance from; 0 where it is from none."""
    sums = (y for t in trees for y in nodes(t) if isinstance(y, tuple) and y[0] == "add")
    shifts = (y[2] for y in sums if len(y) == 3 and y[1] == x)
    return next((-Fraction(z) for z in shifts if isinstance(z, (int, Fraction))), Fraction(0))


def polynomial(t: Tree, centre: dict[Tree, Fraction]) -> Terms:
    """A tree as a polynomial in its names, those with a centre less this."""
    if isinstance(t, (int, Fraction)):
        return {(): Fraction(t)} if t else {}
    if t == "h̃" or (isinstance(t, tuple) and t[:2] in VARIABLES):
        shift = centre.get(t, Fraction(0))
        return {((t, 1),): Fraction(1)} | ({(): shift} if shift else {})
    if not isinstance(t, tuple):
        raise ValueError(f"{t} in a polynomial")
    if t[0] == "add":
        return reduce(_plus, (polynomial(x, centre) for x in t[1:]))
    if t[0] == "mul":
        return reduce(_times, (polynomial(x, centre) for x in t[1:]))
    if t[0] == "pow" and isinstance(t[2], int) and 0 < t[2] <= 8:
        return reduce(_times, [polynomial(t[1], centre)] * t[2])
    if t[0] == "div" and isinstance(t[2], (int, Fraction)):
        return _times(polynomial(t[1], centre), {(): 1 / Fraction(t[2])})
    raise ValueError(f"{t[0]} in a polynomial")


def _plus(f: Terms, g: Terms) -> Terms:
    found = dict(f)
    for m, c in g.items():
        found[m] = found.get(m, Fraction(0)) + c
    return {m: c for m, c in found.items() if c}


def _times(f: Terms, g: Terms) -> Terms:
    if len(f) * len(g) > TERMS:
        raise ValueError("a polynomial of too many terms")
    found: Terms = {}
    for m, x in f.items():
        for k, y in g.items():
            powers: dict[Tree, int] = dict(m)
            for name, e in k:
                powers[name] = powers.get(name, 0) + e
            key = tuple(sorted(powers.items(), key=str))
            found[key] = found.get(key, Fraction(0)) + x * y
    return {m: c for m, c in found.items() if c}


def _spanned(f: Terms, others: Sequence[Terms]) -> bool:
    """Is a polynomial a combination of others, up to a constant?"""
    monomials = sorted({m for g in (f, *others) for m in g if m}, key=str)
    rows = [[g.get(m, Fraction(0)) for m in monomials] for g in (*others, f)]
    if not any(rows[-1]):
        return True
    return q.rank(q.matrix(rows)) == q.rank(q.matrix(rows[:-1])) if others else False


def _pairs(powers: dict[int, int]) -> list[tuple[int, int, int]]:
    """Where the second derivatives of a monomial are, and by how much each is multiplied."""
    return [
        (i, j, e * (f - (i == j)))
        for i, e in powers.items()
        for j, f in powers.items()
        if i != j or e > 1
    ]
