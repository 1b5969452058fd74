"""The claims about an enclosed equilibrium: how near it is, its signs, whether it is stable.

All eigenvalues are on the leaf or 0 where Λ has the corank of the level's Casimirs: their
polynomial is μᵏq(μ²).  Within ρ of the decimals M changes by at most off_ij, so that a coefficient
of det(μ − M), a sum of minors, changes by at most that of Π(1 + (r_i + Σ_j off_ij)t) −
Π(1 + r_i t), with r_i = Σ_j |M_ij|, as a determinant is at most the product of the sums of its
rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Context, Decimal, localcontext
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ...language.quadratic import value_of
from ...language.tree import Tree
from ...record.record import RecordError, Step
from ...record.sentence import Claim
from ..enclosure import DIGITS, Enclosure, enclosure_of, polynomial
from ..entries_on_a_level import invertible
from .equilibrium_claims import coordinates, not_from, silent
from .exact_spectra import characteristic, signature
from .integral_claims import Judge
from .reduced_system import ReducedSystem
from .rounded_roots import DIGITS as PRECISION
from .rounded_roots import all_roots, decimal, digits_told, is_rounded, size

Numbers = Sequence[Fraction]


def _near(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The equations are in powers of the distance from the point, which is enclosed."""
    if not any(step.label in s.uses and _says_within(s) for s in system.record.steps):
        return "no step encloses it"
    return not_from(step, coordinates(claim), constants=True)


def _says_within(step: Step) -> bool:
    return any(x.kind == "enclosure.within" for x in step.claims)


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
    found = _squares(system, step)
    if found == (claim["positive"], claim["negative"]):
        return ""
    return f"it has {found[0]} positive and {found[1]} negative squares"


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
    centre = enclosed(system, step).centre
    at, told = {x: centre.get(x, Fraction(0)) for x in system.variables}, claim["eigenvalues"]
    p = characteristic([[x for x, _ in slopes(t, at, Fraction(0))] for t in system.rates])
    assert isinstance(told, tuple)
    with localcontext(Context(prec=PRECISION)):
        numbers = [(decimal(re), decimal(im)) for _, re, im in told[1:]]
        roots, digits = [(abs(re), abs(im)) for re, im in all_roots(p)], digits_told(numbers)
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
    centre, radius = {x: found.centre.get(x, Fraction(0)) for x in system.variables}, found.least
    if not has_rank(system.tensor.forms, [*centre.values()], radius, n - several):
        return False
    rows = [slopes(t, centre, radius) for t in system.rates]
    mid, off = ([[x[k] for x in row] for row in rows] for k in (0, 1))
    pairs: Any = zip(characteristic(mid), changes_of_coefficients(mid, off), strict=True)
    return not_real_and_not_positive([*pairs][: n - several + 1 : 2])


def has_rank(forms: Any, at: Numbers, radius: Fraction, rank: int) -> bool:
    """Has Λ this rank everywhere within the radius?"""
    n = len(at)
    mid, off = ([[Fraction(0)] * n for _ in at] for _ in range(2))
    for (i, j), form in forms.items():
        mid[i][j] = sum((x if k is None else x * at[k] for k, x in form.items()), Fraction(0))
        off[i][j] = radius * sum(abs(x) for k, x in form.items() if k is not None)
    rows, columns = (q.echelon(q.matrix(x))[1] for x in (q.transposed(q.matrix(mid)), mid))
    chosen, change = ([[x[i][j] for j in columns] for i in rows] for x in (mid, off))
    return len(rows) == rank and invertible(q.matrix(chosen), change)


def slopes(
    t: Tree, centre: dict[Tree, Fraction], radius: Fraction
) -> list[tuple[Fraction, Fraction]]:
    """The first derivatives of a polynomial, and how much they change within the radius."""
    found = {x: (Fraction(0), Fraction(0)) for x in centre}
    for m, c in polynomial(t, centre).items():
        degree = sum(k for _, k in m)
        for x, k in m:
            mid, off = found[x]
            if degree == 1:
                found[x] = mid + c, off
            else:
                found[x] = mid, off + abs(c) * k * radius ** (degree - 1)
    return [*found.values()]


def changes_of_coefficients(mid: Sequence[Numbers], off: Sequence[Numbers]) -> list[Fraction]:
    """How much the coefficients of det(μ − M) change at most with the entries of M."""

    def by_rows(a: Sequence[Numbers], change: Sequence[Numbers]) -> list[Fraction]:
        sums = [sum(map(abs, row), Fraction(0)) for row in a]
        more = [x + sum(row) for x, row in zip(sums, change, strict=True)]
        return [x - y for x, y in zip(symmetric(more), symmetric(sums), strict=True)]

    columns = (q.transposed(q.matrix(x)) for x in (mid, off))
    return [*map(min, by_rows(mid, off), by_rows(*columns))]


def symmetric(x: Numbers) -> list[Fraction]:
    """The coefficients of Π(1 + x_i t)."""
    zero, found = Fraction(0), [Fraction(1)]
    for y in x:
        found = [a + y * b for a, b in zip([*found, zero], [zero, *found], strict=True)]
    return found


def not_real_and_not_positive(c: Sequence[tuple[Fraction, Fraction]]) -> bool:
    """Has a polynomial with such coefficients, each with a bound of its error, surely a root that
    is not real and at most 0: a negative coefficient, or c_j² j(d − j) < c_{j−1}c_{j+1}(j + 1)(d −
    j + 1) for some j (Newton)?"""
    d = len(c) - 1
    if any(x + e < 0 for x, e in c):
        return True
    least, most = [max(x - e, Fraction(0)) for x, e in c], [abs(x) + e for x, e in c]
    return any(
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
