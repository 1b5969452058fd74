"""The checker: every equation of a record, put to the test in exact arithmetic.

Claims, what sentences say beside the equations, are computed again from the trees.
"""

from __future__ import annotations

import hashlib
import json
import secrets
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.show import show
from ..record import mass_signs
from ..record.as_json import step_data, to_json
from ..record.record import ANY_GROUP, Derivation, Equation, RecordError, Step
from ..record.sentence import Claim, fault
from .claims import (
    claims_by_ranks,
    enclosed_trims,
    enclosure,
    equilibrium_claims,
    family_claims,
    integral_claims,
    position_claims,
    reduction_claims,
    symmetry_count,
    symmetry_kinds,
    trim_claims,
)
from .claims.enclosure import enclosure_fault, kept_claims
from .claims.reduced_system import ClaimedRecord, Judge
from .form import symbols, well_formedness
from .form.hypotheses_checked import (
    IMPOSSIBLE,
    MOST_BITS,
    ORDER,
    RefusedError,
    Verdict,
    bit_count,
    false_by_default,
    false_hypothesis,
    missing_hypothesis,
    missing_mass_hypotheses,
    no_sense,
    refusal,
)
from .form.well_formedness import PRIMITIVE, unexplained, unused
from .trials.trial_points import (
    LEAST,
    LEAST_BY_MOMENTA,
    SIZE,
    TrialPoints,
    action_of,
    fault_for_any_group,
    free,
    side_of,
    sizes,
)
from .values.arithmetic import EvaluationError
from .values.draws import Locus, difference, largest_degree, locus_of

if TYPE_CHECKING:
    from .fluid.fluid_checker import FluidChecker


LARGEST_DEGREE = 2**25
"""The largest Schwartz–Zippel degree of a claim that is tried: its numbers have 128 times as many
bits. Over the size 2¹²⁸ it is less than 1e-30, the largest probability of a false pass that is
allowed."""

SMALL = 3
"""The largest random integer at the point that serves as a counterexample in a message."""

READABLE = 1000
"""The largest degree of an equation that has a counterexample: of 3²⁰⁰⁰⁰⁰⁰⁰ nobody reads the
digits, and they take a minute."""

ORDERED = range(2**16, 2**16 + 6)
"""The sizes of the points in rational numbers at which inequalities are tried: residues have no
order."""

UNEXPLAINED = "{} is used, and neither this step nor one before it says what it is"

UNUSED = "{} is used, and no step that this one uses speaks of it"

ENCLOSURE = "enclosure"
"""The rule of steps that claim more than their equations: a critical point nearby."""


class Checker(TrialPoints):
    """The checker of one record: exact models of its scopes, made once and shared by its steps."""

    primitive = PRIMITIVE

    def __init__(self, problem: Mapping[str, Any], seed: int | str | None = None):
        super().__init__(problem, fresh_seed() if seed is None else seed)

    def groups_for(self, step: Step, equation: Equation) -> tuple[Group, ...]:
        """The groups on which an equation is tried; a claim about any group also on as many GL(n)
        or Aff(n) as prove it for all n. ``RecordError`` if it is not of words, or needs too large
        an n."""
        found = self.groups(step.scope, driven=step.driven)
        if step.scope != ANY_GROUP:
            return found
        for side in (equation.lhs, equation.rhs):
            if reason := fault_for_any_group(side):
                raise RecordError(reason)
        action = action_of(self.problem)
        least = LEAST_BY_MOMENTA if side_of(self.problem) else LEAST
        _, grade = self.grade(free(action, least), step, equation)
        return (*found, *(free(action, n) for n in sizes(grade, least)))

    def universal_key(self, step: Step) -> str:
        """All on which the verdict on a step about any group depends but the random points;
        ``RecordError`` for a problem that is none."""
        self.groups(step.scope, driven=step.driven)
        of_masses = [mass_signs.any_sign(self.problem), false_by_default(step, self.problem)]
        kind = [action_of(self.problem), self._kind, *(of_masses if step.hypotheses else ())]
        return json.dumps([kind, step_data(step)])

    def bound(self, step: Step) -> int:
        """The Schwartz–Zippel degree of a step's claims; ``RecordError`` if it is too large."""
        degrees = [0, *(self.degree(step, e) for e in step.equations)]
        if step.rule == ENCLOSURE:
            degrees += (self.degree(step, e) for e in kept_claims(step))
        for g in self.groups(step.scope, driven=step.driven):
            env = self.graded_point(g, step)[1]
            degrees += (largest_degree(x.of, env) for x in step.hypotheses)
        return self.checked_degree(max(degrees))

    def checked_degree(self, degree: int) -> int:
        """One more than the degree, for residues modulo the random prime that are equal by chance;
        ``RecordError`` for a degree above LARGEST_DEGREE."""
        if degree > LARGEST_DEGREE:
            raise RecordError(f"a claim of degree {degree}, more than {LARGEST_DEGREE}")
        return degree + 1

    def degree(self, step: Step, equation: Equation) -> int:
        """The largest degree of an equation on its groups; ``RefusedError`` if it has none."""
        try:
            groups = self.groups_for(step, equation)
            return max(self.grade(g, step, equation)[0] for g in groups)
        except (EvaluationError, RecordError) as error:
            raise RefusedError(refusal(step, equation, str(error))) from error

    def check(self, step: Step) -> Verdict:
        """The verdict on one step; whatever is wrong with the step is in it, nothing is raised."""
        try:
            bound = self.degree_if_true(step)
        except RefusedError as error:
            return error.verdict
        except (EvaluationError, RecordError, ZeroDivisionError) as error:
            return Verdict(step.label, False, str(error), 1.0)
        except (ArithmeticError, AssertionError, LookupError, TypeError, ValueError) as error:
            return Verdict(step.label, False, no_sense(error), 1.0)
        except (AttributeError, RecursionError) as error:
            return Verdict(step.label, False, f"not a claim: {type(error).__name__}", 1.0)
        groups = {g.name: 0 for e in step.equations for g in self.groups_for(step, e)}
        tried, note = (len(step.equations), (*groups,)), false_by_default(step, self.problem)
        return Verdict(step.label, True, "", bound / SIZE, tried, note=note)

    def degree_if_true(self, step: Step) -> int:
        """The Schwartz–Zippel degree of a step whose claims all hold; ``RefusedError`` or another
        error where one does not."""
        at, affine = locus_of(step), action_of(self.problem) == "affine"
        groups = self.groups(step.scope, driven=step.driven)
        for e in step.equations:
            if reason := ill_formed(e, at, affine=affine):
                raise RefusedError(refusal(step, e, reason))
        for x in (*(x.of for x in step.hypotheses), *(e.lhs for e in step.given)):
            if reason := well_formedness.first_fault(x, affine=affine):
                raise RefusedError(Verdict(step.label, False, reason, 1.0))
        sides = (x for e in (*step.equations, *step.given) for x in (e.lhs, e.rhs))
        if any(bit_count(x) > MOST_BITS for x in (*sides, *(x.of for x in step.hypotheses))):
            raise RecordError("a claim of powers of numbers that are too large")
        bound = self.bound(step)
        self.refuse_hypotheses(step, groups, self.false_hypothesis_on)
        for e in step.equations:
            for g in self.groups_for(step, e):
                if reason := difference(e, self.environment(g, step, SIZE, e)):
                    reason = (bound <= READABLE and self.example(g, step, e)) or reason
                    raise RefusedError(refusal(step, e, reason, f" on {g.name}"))
        if step.rule == ENCLOSURE and (reason := self.enclosure_fault(step)):
            raise RefusedError(Verdict(step.label, False, reason, 1.0))
        self.refuse_hypotheses(step, groups, self.missing_hypothesis)
        return self.checked_degree(bound + self.coincidence(step.scope))

    def enclosure_fault(self, step: Step) -> str:
        """Why a step encloses no critical point on a level of what motions keep; "" if it does."""
        along = replace(step, rule="Poisson bracket")  # what motions keep is so along them
        for e in kept_claims(step):
            for g in self.groups_for(along, e):
                if reason := difference(e, self.environment(g, along, SIZE, e)):
                    return f"motions do not keep the left side of a level: {reason}"
        (group,) = self.groups(step.scope, driven=step.driven)
        return enclosure_fault(step, group, side_of(self.problem))

    def refuse_hypotheses(
        self, step: Step, groups: Iterable[Group], find_fault: Callable[[Group, Step], str]
    ) -> None:
        """Raise ``RefusedError`` for the first fault that ``find_fault`` finds in the hypotheses of
        a step on these groups."""
        for reason in (find_fault(g, step) for g in groups):
            if reason:
                raise RefusedError(Verdict(step.label, False, reason, 1.0))

    def missing_hypothesis(self, g: Group, step: Step) -> str:
        """A hypothesis that the equations of a step need and it does not make; "" if none."""
        model, env = self.point(g, step)
        return missing_hypothesis(step, self.problem, env, model)

    def false_hypothesis_on(self, g: Group, step: Step) -> str:
        """A hypothesis of a step that does not hold on a group, in words; "" if none."""
        model, env = self.point(g, step)
        for e in step.given:
            if reason := difference(e, env):
                what = f"what is given, {show(e.lhs)} = {show(e.rhs)}, cannot be tried"
                return f"{what}: {reason}"
        if any(x.property in ORDER for x in step.hypotheses):
            ordered = [self.environment(g, step, size) for size in ORDERED]
        else:
            ordered = []
        return false_hypothesis(step, self.problem, env, model, ordered)

    def symbols(self, d: Derivation) -> Verdict:
        """The verdict on the symbols of a record: types, roles, defining equations, no others."""
        groups: dict[str, Group] = {}

        def fault() -> str:
            for s in d.steps:
                groups.update((g.name, g) for g in self.groups(s.scope, driven=s.driven))
            return symbols.first_fault(d, self.environments)

        return symbols.verdict(d, fault, groups)

    def example(self, g: Group, step: Step, equation: Equation) -> str:
        """How an equation fails at a point of small integers, as a readable counterexample; "" if
        it does not fail there."""
        with suppress(ArithmeticError, AssertionError, LookupError, TypeError, ValueError):
            return difference(equation, self.environment(g, step, SMALL, equation))
        return ""


def ill_formed(equation: Equation, at: Locus, *, affine: bool) -> str:
    """What is wrong with a head, argument, index or quantifier of an equation; "" if nothing is."""
    both = (well_formedness.first_fault(x, affine=affine) for x in (equation.lhs, equation.rhs))
    return next(filter(None, both), "") or well_formedness.quantifier_fault(equation, at)


def fresh_seed() -> int:
    """A random seed of 128 bits: no one can know it before, and it is as fine as the bound."""
    return secrets.randbits(128)


def check(d: Derivation, seed: int | None = None) -> list[Verdict]:
    """A verdict for the symbols and one for every step, at points that are new each time.

    A ``seed`` repeats a run.
    """
    return list(verdicts(d, seed))


_UNIVERSAL: dict[str, Verdict] = {}
"""What held for any group in this process, by all that it depends on."""


def _verdict(checker: Checker | FluidChecker, step: Step) -> Verdict:
    """The verdict on a step.  One about any group that held is not tried again: it stands in many
    records, letter by letter, and nothing of their problems but what is in the key is used."""
    if step.scope != ANY_GROUP or not isinstance(checker, Checker):
        return checker.check(step)
    try:
        key = checker.universal_key(step)
    except IMPOSSIBLE:
        return checker.check(step)  # which says what is wrong
    if (known := _UNIVERSAL.get(key)) is None:
        known = checker.check(step)
        if known.holds:
            _UNIVERSAL[key] = known
    return known


def checker_of(problem: Mapping[str, Any], seed: int | str | None = None) -> Checker | FluidChecker:
    """The checker of a record with this problem."""
    if "fluid" in problem:
        from .fluid.fluid_checker import FluidChecker

        return FluidChecker(problem, fresh_seed() if seed is None else seed)
    return Checker(problem, seed)


def verdicts(
    d: Derivation, seed: int | None = None, labels: Collection[str] | None = None
) -> Iterator[Verdict]:
    """The verdicts of :func:`check`, one after the other; of some steps, by their labels.

    The points are drawn from the seed and a hash of the whole record: whoever writes a record
    cannot aim it at them, even where a seed is agreed upon.
    """
    digest = hashlib.sha256(to_json(d).encode("utf-8", "surrogatepass")).hexdigest()
    seeded = f"{fresh_seed() if seed is None else seed} {digest}"
    checker, claims = checker_of(d.problem, seeded), ClaimChecker(d, seeded)
    yield checker.symbols(d)
    faults = zip(
        unexplained(d.steps, checker.primitive),
        unused(d.steps, checker.primitive),
        missing_mass_hypotheses(d.steps, d.problem),
        strict=True,
    )
    for step, (new, old, other) in zip(d.steps, faults, strict=True):
        if labels is not None and step.label not in labels:
            continue
        verdict = _verdict(checker, step)
        reason = UNEXPLAINED.format(new) if new else UNUSED.format(old) if old else other
        if verdict.holds:
            reason = reason or claims.fault(step)
        stands = not reason or not verdict.holds
        yield verdict if stands else Verdict(verdict.label, False, reason, 1.0)


# The claims about the orbit of a body's configurations: its dimension, and that of the group.

POINTS = 4


def _tetrahedron(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The displacements of four random points by the algebra have this rank, those by its linear
    maps and the translations together that of the orbit."""
    n = c.group.n
    places = q.matrix(
        [[c.random.randint(1, SIZE) for _ in range(POINTS)] for _ in range(n)] + [[1] * POINTS]
    )
    moved = [q.flatten(q.times(e[:n], places[: len(e)])) for e in c.group.basis]
    shifted = [[int(i == k) for i in range(n) for _ in range(POINTS)] for k in range(n)]
    whole, own = (q.rank(q.matrix(x)) for x in ([*moved, *shifted], moved))
    if claim["orbit"] != whole:
        return f"the orbit has the dimension {whole}"
    told = whole if claim.kind == "tetrahedron.affine" else claim["linear"]
    return "" if told == own else f"the group moves the points in {own} dimensions"


def steady_flows(record: Derivation) -> list[int]:
    """The flows of a problem, from 1, of which what flows inside is said to be steady."""
    return [k for k, x in enumerate(record.problem.get("flows", ()), 1) if x.get("steady")]


def _steady(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """These flows are steady inside, by the problem: without that its equations have ṗ."""
    known = steady_flows(c.record)
    return "" if claim["flows"] == ("row", *known) else f"the problem says so of the flows {known}"


ORBIT_JUDGES = {"tetrahedron.affine": _tetrahedron, "tetrahedron.linear": _tetrahedron}


class ClaimChecker(ClaimedRecord):
    """The claims of one record."""

    def fault(self, step: Step) -> str:
        """What is wrong with the claims of a step, or with a sentence that is a claim and has none;
        "" if nothing is."""
        try:
            if any(bit_count(x) > MOST_BITS for c in step.claims for _, x in c.values):
                return "a claim of powers of numbers that are too large"
            reasons = (self._fault(step, claim) for claim in step.claims)
            found = fault(step.prose, step.claims) or next(filter(None, reasons), "")
            return found or silent(step, self.record) or reduction_claims.missing(step)
        except IMPOSSIBLE as error:
            return f"a claim makes no sense: {type(error).__name__}"

    def _fault(self, step: Step, claim: Claim) -> str:
        """What is wrong with one claim, in words; "" if nothing is."""
        try:
            reason = JUDGES[claim.kind](self, step, claim)
        except RecordError as error:
            reason = str(error)
        except IMPOSSIBLE as error:
            reason = no_sense(error)
        return reason and f"the claim {claim.kind}: {reason}"


OBLIGATORY = {
    "reduction": ("poisson.group", "poisson.advected", "reduction.quadrature"),
    "Poisson bracket": (
        *("casimirs.kept", "level.multiple", "condition.one", "condition.several"),
        *(f"first_integrals.all{x}" for x in ("", "_large", "_generic", "_generic_large")),
    ),
    "expansion": ("equilibrium.form", "family.form"),
    "enclosure": ("enclosure.within",),
    "trim": (*trim_claims.POINTS, *enclosed_trims.POINTS),
}
"""Rule → the claims of which each of its steps makes one: without it no claim is judged there."""


def silent(step: Step, record: Derivation) -> str:
    """That a step makes none of the claims of its rule, that the first momentum of a reduction
    stands without the number of these, or what acts without what is neglected; "" where all is
    claimed."""
    wanted = OBLIGATORY.get(step.rule, ())
    if step.rule == "input" and steady_flows(record):
        wanted = ("input.flow_steady",)
    if any(e.lhs == ("at", "𝒥", 1) for e in step.equations):
        wanted = ("reduction.taken",)
    if not wanted or any(x.kind in wanted for x in step.claims):
        return ""
    return f"the step makes no claim of its rule: {', '.join(wanted)}"


def _of_reduced(judge: integral_claims.Judge) -> Judge:
    """The judge of a claim about reduced equations, which must be Hamiltonian."""
    return lambda c, step, x: c.reduced.fault or judge(c.reduced, step, x)


def _of_symmetries(judge: symmetry_count.Judge) -> Judge:
    """The judge of a claim about the symmetries of a Lagrangian."""
    return lambda c, step, x: judge(c.symmetries, c.record, step, x)


JUDGES: dict[str, Judge] = {
    **reduction_claims.JUDGES,
    **claims_by_ranks.JUDGES,
    **ORBIT_JUDGES,
    "input.flow_steady": _steady,
    **trim_claims.JUDGES,
    **enclosed_trims.JUDGES,
    **{kind: _of_symmetries(judge) for kind, judge in symmetry_count.JUDGES.items()},
    **{kind: _of_symmetries(judge) for kind, judge in symmetry_kinds.JUDGES.items()},
    **{kind: _of_reduced(judge) for kind, judge in integral_claims.JUDGES.items()},
    **{kind: _of_reduced(judge) for kind, judge in equilibrium_claims.JUDGES.items()},
    **{kind: _of_reduced(judge) for kind, judge in family_claims.JUDGES.items()},
    **position_claims.AXES,
    **{kind: _of_reduced(judge) for kind, judge in position_claims.JUDGES.items()},
    **{kind: _of_reduced(judge) for kind, judge in enclosure.JUDGES.items()},
}
"""How each kind of claim is judged."""
