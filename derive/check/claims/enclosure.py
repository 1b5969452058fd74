"""An enclosed equilibrium: the critical point of h̃, how near it is, its signs, its stability."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Context, Decimal, localcontext
from fractions import Fraction
from functools import cached_property, partial, reduce
from typing import Any

from ...algebra.groups import Group
from ...language import rational as q
from ...language.intervals import Interval, characteristic
from ...language.laurent import Laurent, Monomial
from ...language.show import show
from ...language.tree import Tree, nodes
from ...language.univariate import value_of
from ...record.record import Equation, RecordError, Step
from ...record.sentence import Claim
from ..values.arithmetic import Varying
from .entries_checked import Entries, sure_rank
from .equilibrium_claims import ClaimedEquilibrium, coordinates, not_from, others_squared, silent
from .integral_claims import Judge
from .reduced_system import ReducedSystem
from .spectra_and_residues import DIGITS as PRECISION
from .spectra_and_residues import (
    all_roots,
    decimal,
    digits_given,
    expansion,
    gradient,
    is_rounded,
    signature,
    size,
)

# The claim of a step of rule "enclosure": a critical point of h̃ on a level of what is kept.
#
# The last equation of the step has h̃ with multiples of the left sides of the others, C_j − c_j;
# all right sides are polynomials. 𝓛 = their last, plus Σ δ_j times the others, has one critical
# point near the place of its distances, if Newton's step there is a contraction: computed here
# once more, from the trees, in fractions. Entries of g there must be those of an element of the
# group.

Terms = dict[Monomial, Fraction]
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
    trees = (*levels, energy)
    seen = {x for t in trees for x in nodes(t) if isinstance(x, tuple) and x[:2] in VARIABLES}
    centre: dict[Tree, Fraction] = {x: _centre(x, trees) for x in sorted(seen, key=str)}
    names: list[Tree] = [*centre, *(f"δ{j}" for j, _ in enumerate(levels))]
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


def _centre(x: Tree, trees: Sequence[Tree]) -> Fraction:
    """The number that a variable is written as a distance from; 0 where it is from none."""
    sums = (y for t in trees for y in nodes(t) if isinstance(y, tuple) and y[0] == "add")
    shifts = (y[2] for y in sums if len(y) == 3 and y[1] == x)
    return next((-Fraction(z) for z in shifts if isinstance(z, (int, Fraction))), Fraction(0))


def polynomial(t: Tree, centre: dict[Tree, Fraction]) -> Terms:
    """A tree as a polynomial in its names, those with a centre less this."""
    return _polynomial(t, centre).terms


def _polynomial(t: Tree, centre: dict[Tree, Fraction]) -> Laurent:
    if isinstance(t, (int, Fraction)):
        return Laurent.of(t)
    if t == "h̃" or (isinstance(t, tuple) and t[:2] in VARIABLES):
        return Laurent.symbol(t) + centre.get(t, Fraction(0))
    if not isinstance(t, tuple):
        raise ValueError(f"{t} in a polynomial")
    of = partial(_polynomial, centre=centre)
    if t[0] == "add":
        return sum(map(of, t[1:]), Laurent.of(0))
    if t[0] == "mul":
        return reduce(_times, map(of, t[1:]))
    if t[0] == "pow" and isinstance(t[2], int) and 0 < t[2] <= 8:
        return reduce(_times, [of(t[1])] * t[2])
    if t[0] == "div" and isinstance(t[2], (int, Fraction)):
        return of(t[1]) * (1 / Fraction(t[2]))
    raise ValueError(f"{t[0]} in a polynomial")


def _times(f: Laurent, g: Laurent) -> Laurent:
    if len(f.terms) * len(g.terms) > TERMS:
        raise ValueError("a polynomial of too many terms")
    return f * g


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


# The claims about an enclosed equilibrium: how near it is, its signs, whether it is stable.
#
# All eigenvalues are on the leaf or 0 where Λ has the corank of the level's Casimirs: their
# polynomial is μᵏq(μ²), whose coefficients are found within bounds, as the point is.


def _near(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The equations are in powers of the distance from the point, which is enclosed."""
    using = (s for s in system.record.steps if step.label in s.uses)
    if not any(x.kind == "enclosure.within" for s in using for x in s.claims):
        return "no step encloses it"
    return not_from(step, coordinates(claim), constants=True)


def enclosed(system: ReducedSystem, step: Step) -> Enclosure:
    """What a step encloses, about the decimals of a step that it uses; ``RecordError`` where it
    does not, or takes for a Casimir what is none."""
    steps = [system.record[x] for x in step.uses]
    (told,) = (x for s in steps for x in s.claims if x.kind == "equilibrium.near")
    found, decimals = enclosure_of(step), dict(coordinates(told))
    if any(y != decimals.get(x, 0) for x, y in found.centre.items()):
        raise RecordError("these are not the decimals")
    if any(any(system.anywhere.field(e.lhs)) for e in step.equations[:-1]):
        raise RecordError("what has values on the level is no Casimir")
    return found


def _within(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """One critical point is within the radius, which is not much larger than is needed, and what
    is proved of its stability is said."""
    found, told = enclosed(system, step), value_of(claim["radius"])
    if fault := silent(step, PROVED, _proved(system, step)):
        return fault
    assert isinstance(told, Fraction)
    if not found.contracts(told):
        return "Newton's step is not proved to contract"
    return "" if told <= max(2 * found.least, Fraction(1, DIGITS)) else "it is nearer"


def _squares(system: ReducedSystem, step: Step) -> tuple[int, int]:
    """The signs on the level: those of J, less one of each for every Casimir."""
    several = len(step.equations) - 1
    positive, negative = signature(enclosed(system, step).second)
    return positive - several, negative - several


def _signs(system: ReducedSystem, step: Step, claim: Claim) -> str:
    return others_squared(_squares(system, step), claim)


NEAR_0 = Fraction(1, 1000)
"""Of eigenvalues up to this size nothing is computed again."""
UNKNOWN = Decimal("1e-6")
"""The part of an eigenvalue that is not known: the decimals have so many digits."""
PROVED = ("enclosure.stable", "enclosure.unstable", "enclosure.open")
"""The claims of which each enclosure has one."""


def _proved(system: ReducedSystem, step: Step) -> str:
    """What is proved of the stability: the name of the sentence."""
    definite = 0 in _squares(system, step)
    return "stable" if definite else "unstable" if grows(system, step) else "open"


def _verdict(system: ReducedSystem, step: Step, claim: Claim) -> str:
    found = _proved(system, step)
    return "" if claim.kind == f"enclosure.{found}" else f"what follows is: {found}"


def _eigenvalues(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """Each number is a root of the characteristic polynomial p of the rates at the decimals,
    rounded, and each root, but for its sign, is one of the numbers; all that are near 0, and known
    less well, are taken for one."""
    told = claim["eigenvalues"]
    p = ClaimedEquilibrium(system, enclosed(system, step).centre).characteristic_of_all
    assert isinstance(told, tuple)
    with localcontext(Context(prec=PRECISION)):
        numbers = [(decimal(re), decimal(im)) for _, re, im in told[1:]]
        roots, digits = [(abs(re), abs(im)) for re, im in all_roots(p)], digits_given(numbers)
        if len({*numbers}) < len(numbers):
            return "one is told twice"
        large, known = ([z for z in x if size(z) > decimal(NEAR_0)] for x in (numbers, roots))
        pairs = {(z, x) for z in large for x in known if is_rounded(z, x, digits, UNKNOWN)}
        if {z for z, _ in pairs} < {*large}:
            return "one is no eigenvalue"
        small = p[-1] == 0 or len(known) < len(roots)
        all_told = {x for _, x in pairs} == {*known} and small is (len(large) < len(numbers))
        return "" if all_told else "they are not all"


# -- instability ----------------------------------------------------------------------------------


def grows(system: ReducedSystem, step: Step) -> bool:
    """Have the linearised rates an eigenvalue with positive real part?  True is proved."""
    found = enclosed(system, step)
    several, n = len(step.equations) - 1, len(system.variables)
    point = ClaimedEquilibrium(system, found.centre)
    centre, radius = found.centre, found.least
    box = [Interval.about(centre.get(x, Fraction(0)), radius) for x in system.variables]
    off = [[Fraction(0)] * n for _ in box]
    for (i, j), x in system.tensor.at(box).items():
        off[i][j] = Interval.of(x - point.tensor[i][j]).size
    if sure_rank(point.tensor, off) != n - several:
        return False
    triples = zip(system.variables, box, q.identity(n), strict=True)
    at = {x: Varying(y, unit) for x, y, unit in triples}
    coefficients = characteristic([gradient(expansion(t, at), n) for t in system.rates])
    return not_real_and_not_positive(coefficients[: n - several + 1 : 2])


def not_real_and_not_positive(c: Sequence[Interval]) -> bool:
    """Has a polynomial with coefficients within bounds surely a root that is not real and at most
    0: a negative coefficient, or c_j² j(d − j) < c_{j−1}c_{j+1}(j + 1)(d − j + 1) for some j
    (Newton)?"""
    d, least, most = len(c) - 1, [max(x.low, 0) for x in c], [max(-x.low, x.high) for x in c]
    return any(x.high < 0 for x in c) or any(
        most[j] ** 2 * j * (d - j) < least[j - 1] * least[j + 1] * (j + 1) * (d - j + 1)
        for j in range(1, d)
    )


JUDGES: dict[str, Judge] = {
    "equilibrium.near": _near,
    "enclosure.within": _within,
    "enclosure.signs": _signs,
    "enclosure.eigenvalues": _eigenvalues,
    **dict.fromkeys(PROVED, _verdict),
}
"""How claims about enclosed equilibria are judged, of equations that are Hamiltonian."""
