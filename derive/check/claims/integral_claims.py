"""The claims about Casimirs and integrals of reduced equations: rank, involution, completeness."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

from ...language.show import show
from ...language.tree import Tree, add, neg, nodes, replaced
from ...language.values import approximate
from ...record.record import RecordError, Step
from ...record.sentence import Claim
from ..values.residue import Residue
from .claims_by_ranks import (
    Completeness,
    TooManyMonomialsError,
    along_every_field,
    along_the_motion,
    degree,
    monomials,
)
from .reduced_system import ReducedSystem, ResiduePoint, rates_of
from .spectra_and_residues import signature, value

Judge = Callable[[ReducedSystem, Step, Claim], str]


def listed(t: Tree) -> tuple[Tree, ...]:
    """The values in a place: those of a row, or the only one."""
    return t[1:] if isinstance(t, tuple) and t[0] == "row" else (t,)


def number(t: Tree) -> Fraction:
    """A value that is a number; ``RecordError`` for any other."""
    if not isinstance(t, (int, Fraction)):
        raise RecordError("a number is expected")
    return Fraction(t)


def _dimension(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """As many rates as are claimed, of momenta alone or not."""
    size = len(system.variables)
    if claim["dimension"] != size:
        return f"{size} rates"
    alone = claim.kind == "poisson.group"
    return "" if (system.momenta == size) is alone else "momenta alone, or not"


# -- degrees ------------------------------------------------------------------------------------


def weights(system: ReducedSystem) -> list[Fraction]:
    """The degrees of the variables, as the record says them: 1, where it says nothing."""
    size, momenta = len(system.variables), system.momenta
    found = [Fraction(1)] * size
    for claim in system.claims:
        if claim.kind == "poisson.weighted":
            found[momenta:] = [number(claim["weight"])] * (size - momenta)
        if claim.kind == "poisson.weights":
            found[momenta:] = map(number, listed(claim["weights"]))
    if len(found) != size or not all(w > 0 for w in found):
        raise RecordError("as many positive degrees are needed as there are variables")
    return found


def _degrees(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """Are there degrees, and are they told once?"""
    kinds = ("poisson.weighted", "poisson.weights")
    several = sum(x.kind in kinds for x in system.claims)
    return "" if weights(system) and several == 1 else "the degrees are told more than once"


def _all_casimirs(system: ReducedSystem, step: Step, claim: Claim) -> str:
    completeness = Completeness(system, weights(system), number(claim["degree"]), system.casimirs)
    return completeness.fault(*along_every_field(system))


def _all_integrals(system: ReducedSystem, step: Step, claim: Claim) -> str:
    generators = (*system.casimirs, *system.integrals)
    completeness = Completeness(system, weights(system), number(claim["degree"]), generators)
    return _generic_fault(system, claim) or completeness.fault(*along_the_motion(system))


def _generic_fault(system: ReducedSystem, claim: Claim) -> str:
    if "generic" in claim.kind or not system.parameters:
        return ""
    return "there are parameters, and it is not said that they are generic"


def _large(system: ReducedSystem, step: Step, claim: Claim) -> str:
    try:
        monomials(weights(system), number(claim["degree"]))
    except TooManyMonomialsError:
        return "" if claim.kind == "casimirs.all_large" else _generic_fault(system, claim)
    return "it is small enough to be computed again"


def _these(system: ReducedSystem, step: Step, claim: Claim) -> str:
    several = len(system.integrals) > 1
    name = ("these" if several else "it") + ("_and_casimirs" if system.casimirs else "")
    return "" if claim.kind == f"first_integrals.{name}" else "others are recorded"


def _dependent(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """A function of those before and of the Casimirs, and no polynomial in them."""
    k = int(number(claim["number"]))
    if not 1 < k <= len(system.integrals):
        return f"there are {len(system.integrals)} integrals"
    before, f = (*system.casimirs, *system.integrals[: k - 1]), system.integrals[k - 1]
    point = system.anywhere
    if point.rank([*before, f]) > point.rank(before):
        return "it is independent of them"
    grading = weights(system)
    most = degree(f, dict(zip(system.variables, grading, strict=True)))
    return "it is one" if Completeness(system, grading, most, before).contains(f) else ""


# -- rank and involution ------------------------------------------------------------------------


def _size_fault(point: ResiduePoint, claim: Claim) -> str:
    """Why the rank, the dimension or half the rank are not those that are claimed."""
    rank, size = point.poisson_rank, len(point.system.variables)
    claimed = dict(claim.values)
    if claimed.get("rank", rank) != rank or rank == 0:
        return f"the rank is {rank}"
    if claimed.get("dimension", size) != size:
        return f"the dimension is {size}"
    return "" if claimed.get("half", Fraction(rank, 2)) == Fraction(rank, 2) else f"half of {rank}"


def in_involution(point: ResiduePoint, f: Sequence[Tree], several: int) -> tuple[Tree, ...] | None:
    """So many of some functions that are in involution and independent on the leaves; ``None``
    where there are none."""

    def extended(chosen: tuple[Tree, ...], left: Sequence[Tree]) -> tuple[Tree, ...] | None:
        if len(chosen) == several:
            return chosen
        if point.rank_on_leaves([*chosen, *left]) < several:
            return None
        for k, x in enumerate(left):
            if point.rank_on_leaves([*chosen, x]) > len(chosen):
                commuting = [y for y in left[k + 1 :] if not point.bracket(x, y)]
                if found := extended((*chosen, x), commuting):
                    return found
        return None

    return extended((), f)


def _complete(system: ReducedSystem, step: Step, claim: Claim) -> str:
    point, claimed = system.anywhere, dict(claim.values)
    if reason := _size_fault(point, claim):
        return reason
    if "half" not in claimed and point.poisson_rank != 2:
        return f"the rank is {point.poisson_rank}"
    places = listed(claimed.get("numbers", claimed.get("number", 1)))
    if not all(x in range(1, len(system.integrals) + 1) for x in places):
        return f"there are {len(system.integrals)} integrals"
    chosen = [system.integrals[int(number(x)) - 1] for x in places]
    if any(point.bracket(x, y) for k, x in enumerate(chosen) for y in chosen[:k]):
        return "two of them are not in involution"
    if 2 * len(chosen) != point.poisson_rank or point.rank_on_leaves(chosen) < len(chosen):
        return "they are not half as many as the rank, or dependent on each other and the Casimirs"
    return ""


def _undecided(system: ReducedSystem, step: Step, claim: Claim) -> str:
    point = system.anywhere
    if reason := _size_fault(point, claim):
        return reason
    there = in_involution(point, system.integrals, point.poisson_rank // 2)
    return "they are among the integrals" if there else ""


def _still(system: ReducedSystem, step: Step, claim: Claim) -> str:
    return "it does not" if system.anywhere.poisson_rank else ""


def _unknown_rank(system: ReducedSystem, step: Step, claim: Claim) -> str:
    point = system.anywhere
    left = len(system.variables) - point.rank(system.casimirs)
    return "they do" if left // 2 * 2 == point.poisson_rank else ""


# -- on a level, under a condition ----------------------------------------------------------------


def _level_of(system: ReducedSystem, step: Step) -> Tree:
    (claim,) = (x for x in step.claims if x.kind == "level.multiple")
    k = int(number(claim["number"]))
    if not 1 <= k <= len(system.casimirs):
        raise RecordError(f"there are {len(system.casimirs)} Casimirs")
    return system.casimirs[k - 1]


def _multiple(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The rates vanish where the Casimir does."""
    there = system.place(level=_level_of(system, step))
    conserved = not any(there.bracket(f, system.energy) for f in rates_of(step))
    return "" if conserved else "they are no multiples of it"


def _complete_there(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The rank, and half as many in involution among all integrals and those of a step, on its
    level, or under its condition."""
    if claim.kind == "level.complete":
        there = system.place(level=_level_of(system, step))
    else:
        there = system.place(values=_condition_of(step))
    if reason := _size_fault(there, claim):
        return reason
    every = (*system.integrals, *rates_of(step))
    found = in_involution(there, every, there.poisson_rank // 2)
    return "" if found else "there are not as many in involution"


def _rows(t: Tree) -> tuple[Tree, ...]:
    if not isinstance(t, tuple) or t[0] != "matrix":
        raise RecordError("a condition is a matrix, its rows letters with their values")
    return t[1:]


def _solved(t: Tree) -> list[tuple[Tree, Tree]]:
    """The letters of a condition, each with its value in the others."""
    pairs = [listed(x) for x in _rows(t)]
    letters = {x[0] for x in pairs if len(x) == 2}
    if len(letters) < len(pairs) or letters & {x for _, y in pairs for x in nodes(y)}:
        raise RecordError("a condition gives letters their values in others")
    return [(letter, t) for letter, t in pairs]


def _condition_of(step: Step) -> list[tuple[Tree, Tree]]:
    (claim,) = (x for x in step.claims if x.kind in ("condition.one", "condition.several"))
    return _solved(claim["condition"])


def _under(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The polynomials of a step are integrals where its condition holds."""
    f = rates_of(step)
    if (len(f) > 1) is (claim.kind == "condition.one") or not f:
        return f"{len(f)} polynomials"
    there = system.place(values=_solved(claim["condition"]))
    conserved = not any(there.bracket(x, system.energy) for x in f)
    return "" if conserved else "a polynomial is no integral under it"


def _further(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """Each condition, if there is one, has a step, with polynomials that are none in the generic
    ones."""
    grading, most = weights(system), number(claim["degree"])
    degrees = dict(zip(system.variables, grading, strict=True))
    cases = listed(claim["conditions"]) if claim.kind == "first_integrals.further" else ()
    if not _same_degree(system, claim):
        return "all integrals are told up to another degree"
    if len(cases) != len(system.conditions):
        return f"{len(system.conditions)} steps tell such polynomials"
    for case, there in zip(cases, system.conditions, strict=True):
        if _solved(case) != _condition_of(there) or _complement(system, there, degrees, most):
            return f"the step {there.label} has another condition, or nothing new up to the degree"
    return _elsewhere(system, step, claim)


def _same_degree(system: ReducedSystem, claim: Claim) -> bool:
    """Is the degree that up to which all integrals are told?"""
    upper_bounds = (x for x in system.claims if x.kind.startswith("first_integrals.all"))
    return [claim["degree"]] == [x["degree"] for x in upper_bounds]


POINTS, LARGEST = 8, 3
"""Further integrals are sought at so many points, whose parameters are whole numbers from 1 to
this, and at some where one of them is 0."""
ROUNDING = 1e-9
"""A number that is smaller is taken for 0: then the point is left out."""


def _elsewhere(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """Where, at some points of small whole numbers at which none of the conditions that the step
    lists holds and the kinetic energy is positive, there are more integrals; "" for nowhere."""
    grading, most = weights(system), number(claim["degree"])
    rows = (x["conditions"] for x in step.claims if "conditions" in dict(x.values))
    listed_cases = [_rows(case) for x in rows for case in listed(x)]
    known, along = (*system.casimirs, *system.integrals), along_the_motion(system)
    for at in _numbers(system):
        if any(_holds(case, at) for case in listed_cases) or not _kinetic_is_positive(system, at):
            continue
        try:
            more = Completeness(system, grading, most, known, [*at.items()]).fault(*along)
        except TooManyMonomialsError:
            return ""  # the sentence says "at best"
        if more:
            where = ", ".join(f"{show(x)} = {n}" for x, n in at.items())
            return f"there are more where {where}"
    return ""


def _numbers(system: ReducedSystem) -> list[dict[Tree, int]]:
    """Some numbers of the parameters."""
    letters = [x for x in system.parameters if x != "π"]
    still = [{}, *({x: 0} for x in letters)]
    times = (POINTS, *(2 for _ in letters))
    found = [
        {x: system.random.randint(1, LARGEST) for x in letters} | none
        for none, several in zip(still, times, strict=True)
        for _ in range(several)
    ]
    return [x for k, x in enumerate(found) if x not in found[:k]]


def _holds(case: Sequence[Tree], at: Mapping[Tree, int]) -> bool:
    """Do the equations of a condition hold, or have no value, at numbers of the parameters?"""
    left = (_at(add(x, neg(y)), at) for x, y in map(listed, case))
    return all(x is None or abs(x) < ROUNDING for x in left)


def _kinetic_is_positive(system: ReducedSystem, at: Mapping[Tree, int]) -> bool:
    """Is h̃ positive definite in the momenta, at numbers of the parameters?"""
    momenta = system.variables[: system.momenta]

    def energy(*moved: Tree) -> Fraction:
        there = {x: moved.count(x) for x in system.variables}
        return Fraction(_at(system.energy, {**at, **there}) or 0)

    single, still = {x: energy(x) for x in momenta}, energy()
    metric = [[energy(x, y) - single[x] - single[y] + still for y in momenta] for x in momenta]
    return signature(metric) == (len(momenta), 0)


def _at(t: Tree, numbers: Mapping[Tree, int]) -> float | None:
    """The value of a tree at whole numbers; ``None`` where it has none."""
    for x, n in numbers.items():
        t = replaced(t, x, n)
    return approximate(t, {}, Fraction)


def _unsolved(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """Each condition gives letters their values in others, and a polynomial, of first order in no
    parameter, that vanishes.  That it is not decided states nothing that is computed again."""
    cases = listed(claim["conditions"])
    for case in cases:
        *solved, last = _rows(case)
        _solved(("matrix", *solved))
        f, zero = listed(last)
        if zero != 0 or not _no_first_order(system, f):
            return f"{show(f)} is of first order in a parameter, or in none"
    return "" if cases and len({*cases}) == len(cases) else "they are none, or told twice"


def _no_first_order(system: ReducedSystem, f: Tree) -> bool:
    """Is a polynomial in parameters, and for none a first-order one?"""
    p, random = system.prime, system.random
    letters = [x for x in dict.fromkeys(nodes(f)) if x in system.parameters]
    at = {x: Residue(random.randrange(1, p), p) for x in letters}
    for x in letters:
        first, second, third = (value(f, {**at, x: at[x] + k}, p) for k in range(3))
        if first != second and first - 2 * second + third == 0:
            return False
    return bool(letters)


def _complement(
    system: ReducedSystem, step: Step, degrees: Mapping[Tree, Fraction], most: Fraction
) -> str:
    """Is a polynomial of a step of too high a degree, or one in the generic integrals under its
    condition?  "" if none is."""
    known = (*system.casimirs, *system.integrals)
    for f in rates_of(step):
        of_degree = degree(f, degrees)
        completeness = Completeness(
            system, [*degrees.values()], of_degree, known, _condition_of(step)
        )
        if of_degree > most or completeness.contains(f):
            return show(f)
    return ""


JUDGES: dict[str, Judge] = {
    "poisson.group": _dimension,
    "poisson.advected": _dimension,
    "casimirs.kept": lambda system, step, claim: "",
    "casimirs.all": _all_casimirs,
    "casimirs.all_large": _large,
    "poisson.weighted": _degrees,
    "poisson.weights": _degrees,
    "first_integrals.all": _all_integrals,
    "first_integrals.all_generic": _all_integrals,
    "first_integrals.all_large": _large,
    "first_integrals.all_generic_large": _large,
    "first_integrals.it": _these,
    "first_integrals.it_and_casimirs": _these,
    "first_integrals.these": _these,
    "first_integrals.these_and_casimirs": _these,
    "first_integrals.dependent": _dependent,
    "first_integrals.complete": _complete,
    "first_integrals.complete_by_one": _complete,
    "first_integrals.complete_by_energy": _complete,
    "first_integrals.undecided": _undecided,
    "first_integrals.still": _still,
    "first_integrals.unknown_rank": _unknown_rank,
    "first_integrals.further": _further,
    "first_integrals.no_further": _further,
    "first_integrals.unsolved": _unsolved,
    "level.multiple": _multiple,
    "level.complete": _complete_there,
    "condition.one": _under,
    "condition.several": _under,
    "condition.complete": _complete_there,
}
"""How claims are judged of equations that are Hamiltonian, with the Casimirs and the integrals that
are recorded."""
