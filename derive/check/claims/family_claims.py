"""The claims about families of equilibria in letters: each at random numbers, and on both sides of
every inequality that it has, by what is true there of the equilibrium in numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...language import rational as q
from ...language.tree import Tree, nodes
from ...language.univariate import Number, coefficients_of, value_of
from ...record.record import RecordError, Step
from ...record.sentence import Claim
from .equilibrium_claims import ClaimedEquilibrium, has_multiples, kept
from .integral_claims import Judge, listed
from .reduced_system import ReducedSystem, substituted
from .spectra_and_residues import second_derivatives, signature, value_there

Numbers = Mapping[Tree, Fraction]
DRAWS = 8
"""So many random numbers for the letters; and beside each inequality two that are nearly equal."""
TRIES = 400
HALVINGS = 40
"""So many times the distance between these is halved."""
FINE = 2**20
LARGEST = (40 * FINE, 12 * FINE)
"""Numbers are quotients of up to these: small ones are often those where the energy has a pole."""
POINTS = ("family.at", "family.origin")
SOMEWHERE = ("stable", "stable_beyond", "on_the_leaf")
DEFINITE = (*SOMEWHERE, *(f"{x}_always" for x in SOMEWHERE), "indefinite")
ROOTS = ("unstable", "unstable_large", "unstable_always", "imaginary")
PROVED = {f"family.{x}" for x in (*DEFINITE, "positive")}
"""The claims of which each family has one."""
Inequalities = Sequence[tuple[Tree, Tree]]


@dataclass(frozen=True)
class ClaimedFamily:
    """What a step and those that it uses say of a family."""

    system: ReducedSystem
    step: Step

    @cached_property
    def claims(self) -> dict[str, Claim]:
        """The claims about it, by their kinds; ``RecordError`` where its point is told by none, or
        by several."""
        steps = (self.step, *(self.system.record[x] for x in self.step.uses))
        there = [s for s in steps if any(x.kind in POINTS for x in s.claims)]
        if len(there) != 1:
            raise RecordError("no one family is told")
        found = (*there[0].claims, *self.step.claims)
        return {x.kind.partition(".")[2]: x for x in found if x.kind.startswith("family.")}

    @cached_property
    def point(self) -> list[tuple[Tree, Tree]]:
        """The coordinates that are told."""
        rows = self.claims["at"]["point"] if "at" in self.claims else ("matrix",)
        assert isinstance(rows, tuple)
        return [(x, y) for _, x, y in _once(rows[1:])]

    @cached_property
    def letters(self) -> list[Tree]:
        """The parameters, and the letters of the family."""
        own = (x for _, y in self.point for x in nodes(y) if isinstance(x, tuple))
        return [*dict.fromkeys((*self.system.parameters, *own))]

    def cases(self, kind: str) -> list[Inequalities]:
        """The cases of a claim, each its inequalities, two sides of which the first is greater."""
        told = dict(self.claims[kind].values) if kind in self.claims else {}
        return [*map(_sides, _once(listed(told["cases"])))] if "cases" in told else []

    @cached_property
    def supposed(self) -> Inequalities:
        """That the kinetic energy is positive definite."""
        return _sides(self.claims["positive"]["positive"]) if "positive" in self.claims else []

    # -- numbers -------------------------------------------------------------------------------

    def drawn(self, *, fair: bool = True) -> Numbers:
        """Random numbers for the letters, π positive; ``fair``: with a positive kinetic energy, as
        the claims have it."""
        random = self.system.random
        alone = {a for a, b in self.supposed if b == 0}
        for _ in range(TRIES):
            sizes = (Fraction(*(random.randint(1, x) for x in LARGEST)) for _ in self.letters)
            numbers = {
                x: y if x == "π" or (fair and x in alone) or random.random() < 0.5 else -y
                for x, y in zip(self.letters, sizes, strict=True)
            }
            if not fair or _hold(self.supposed, numbers):
                return numbers
        raise RecordError("no numbers are found for which the kinetic energy is positive")

    def beside(self, a: Tree, b: Tree, *, fair: bool = True) -> Iterator[Numbers]:
        """Numbers at which a side of an inequality is a little greater than the other, and a little
        less, all but one letter the same, where some are found; ``fair``: the kinetic energy is
        positive where this letter comes from, too."""
        own = {*nodes(a), *nodes(b)}
        for _ in range(TRIES):
            letter = self.system.random.choice([x for x in self.letters if x in own])
            one, other = self.drawn(), self.drawn(fair=fair)
            ends = [{**one, letter: x[letter]} for x in (one, other)]
            greater = [_greater(a, b, x) for x in ends]
            if greater[0] == greater[1]:
                continue
            low, high = (x[letter] for x in ends)
            for _ in range(HALVINGS):
                middle = (low + high) / 2
                if _greater(a, b, {**one, letter: middle}) is greater[0]:
                    low = middle
                else:
                    high = middle
            yield from ({**one, letter: x} for x in (low, high))
            return

    def at(self, numbers: Numbers) -> EquilibriumInNumbers:
        """The family at these numbers."""
        found = self.system.with_numbers(numbers)
        at = {x: value_of(substituted(y, numbers)) for x, y in self.point}
        form = None
        if "form" in self.claims:
            (equation,) = self.step.equations
            lhs = substituted(equation.lhs, numbers)
            form = replace(self.step, equations=(replace(equation, lhs=lhs),))
        return EquilibriumInNumbers(ClaimedEquilibrium(found, at), form)

    def trials(self) -> Iterator[tuple[Numbers, EquilibriumInNumbers]]:
        """Numbers at random and beside every inequality, with the equilibrium there."""
        several = [self.drawn() for _ in range(DRAWS)]
        for kind in (*SOMEWHERE, "unstable", "unstable_large"):
            for case in self.cases(kind):
                several += [x for pair in case for x in self.beside(*pair)]
        for numbers in several:
            if _hold(self.supposed, numbers):
                yield numbers, self.at(numbers)


@dataclass(frozen=True)
class EquilibriumInNumbers:
    """A ``point`` of a family in numbers, and the step of its form there, if it has one."""

    point: ClaimedEquilibrium
    step: Step | None

    @cached_property
    def form(self) -> q.Matrix | None:
        """The second derivatives of the form; ``RecordError`` where it is not critical."""
        if self.step is None:
            return None
        return self.point.form_of(kept(self.point.system, self.step))

    @property
    def definite(self) -> bool:
        """Is the form definite on the tangent space of the leaf, of more than a point?"""
        dimension = self.point.dimension
        return dimension > 0 and dimension in self.point.squares(self.form)


def _sides(case: Tree) -> Inequalities:
    """The inequalities of a case, rows of a matrix."""
    rows = case[1:] if isinstance(case, tuple) else ()
    if not all(isinstance(x, tuple) and len(x) == 3 for x in rows):
        raise RecordError("a case is no list of inequalities")
    return [(x[1], x[2]) for x in _once(rows) if isinstance(x, tuple)]


def _once(rows: Sequence[Any]) -> Sequence[Any]:
    """Rows; ``RecordError`` where one stands there twice."""
    if len({*rows}) < len(rows):
        raise RecordError("something is told twice")
    return rows


def _greater(a: Tree, b: Tree, numbers: Numbers) -> bool:
    x, y = (value_of(substituted(t, numbers)) for t in (a, b))
    return bool(x > y)


def _hold(inequalities: Inequalities, numbers: Numbers) -> bool:
    return all(_greater(a, b, numbers) for a, b in inequalities)


def _any(cases: Sequence[Inequalities], numbers: Numbers) -> bool:
    return any(_hold(x, numbers) for x in cases)


def _at(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """Nothing moves there, whatever the letters, which an element of the group has; and what is
    proved of the stability is said."""
    using = [s for s in system.record.steps if step.label in s.uses]
    kinds = {x.kind for s in (step, *using) for x in s.claims}
    if not kinds & PROVED:
        return "no step says what is proved of its stability"
    told = next(s for s in (step, *using) if any(x.kind in PROVED for x in s.claims))
    family = ClaimedFamily(system, told)
    if unknown := [x for x, _ in family.point if x not in system.variables]:
        return f"{unknown[0]} is no variable"
    for _ in range(DRAWS):
        point = family.at(family.drawn()).point
        if any(value_there(x) != 0 for x in point.rates):
            return "something moves there"
        if point.entries != "yes":
            return "that an element of the group has these entries is not proved"
    return ""


def _letter(system: ReducedSystem, step: Step, claim: Claim) -> str:
    family = ClaimedFamily(system, step)
    momenta = [y for x, y in family.point if isinstance(x, tuple) and x[1] == "Π"]
    fresh = claim["letter"] not in system.parameters and claim["letter"] in momenta
    return "" if fresh else "it is no momentum of a family"


def _positive(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The inequalities say that the kinetic energy is positive definite, no more and no less."""
    family, m = ClaimedFamily(system, step), system.momenta
    several = [family.drawn(fair=k % 2 == 0) for k in range(2 * DRAWS)]
    several += [x for pair in family.supposed for x in family.beside(*pair, fair=False)]
    for numbers in several:
        energy = family.at(numbers).point
        origin = ClaimedEquilibrium(energy.system, {})
        second = [row[:m] for row in second_derivatives(origin.energy, origin.n)[:m]]
        if (signature(second) == (m, 0)) is not _hold(family.supposed, numbers):
            return "the kinetic energy is positive elsewhere, or not there"
    return ""


def _definite(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The form is definite where it is claimed, no more and no less, and proves what is said."""
    family, kind = ClaimedFamily(system, step), claim.kind.partition(".")[2]
    cases, always = family.cases(kind), kind.endswith("_always")
    proves = {"stable_beyond"}
    proves |= set() if kind.startswith("stable_beyond") else {"stable", "stable_compact"}
    proves |= {"on_the_leaf"} if kind.startswith("on_the_leaf") else set()
    for numbers, x in family.trials():
        if x.definite is not (always or _any(cases, numbers)):
            return "the second derivative is definite elsewhere, or not there"
        if x.definite and (found := x.point.verdict(x.form)) not in proves:
            return f"what follows is: {found}"
    return ""


def _orbit(system: ReducedSystem, step: Step, claim: Claim) -> str:
    family = ClaimedFamily(system, step)
    return has_multiples(family.at(family.drawn()).point)


def _form(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The left side is kept, its derivative vanishes there, and what follows is said."""
    family = ClaimedFamily(system, step)
    if not {x.kind for x in step.claims} & PROVED:
        return "the step does not say what follows of the stability"
    assert family.at(family.drawn()).form is not None
    return ""


def _roots(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The polynomial is the characteristic one, and some root has a positive real part where it is
    claimed, and nowhere else, unless that is left open."""
    family, kind = ClaimedFamily(system, step), claim.kind.partition(".")[2]
    cases = family.cases(kind)
    told = coefficients_of(claim["polynomial"], "λ")
    for numbers, x in family.trials():
        found: list[Number] = [value_of(substituted(c, numbers)) for c in told]
        if found != x.point.characteristic:
            return "the characteristic polynomial is another"
        claimed = kind == "unstable_always" or _any(cases, numbers)
        if x.point.grows is not claimed and (claimed or kind != "unstable_large"):
            return "an eigenvalue has a positive real part elsewhere, or none has there"
    return ""


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(POINTS, _at),
    "family.letter": _letter,
    "family.positive": _positive,
    "family.orbit": _orbit,
    "family.form": _form,
    **dict.fromkeys((f"family.{x}" for x in DEFINITE), _definite),
    **dict.fromkeys((f"family.{x}" for x in ROOTS), _roots),
}
"""How claims about families of equilibria are judged."""
