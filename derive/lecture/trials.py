"""The claims of the lecture, tried: each equation by the checker, in the company of its step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import reduce

from ..check.checker import Checker, checker_of
from ..check.fluid.fluid_checker import FluidChecker
from ..language.derivatives import derivative
from ..language.laurent import vanishes
from ..language.show import show
from ..language.tree import Tree, add, neg, replaced
from ..record.record import ANY_GROUP, Derivation, Equation, Hypothesis, Step
from .lecture_text import Chapter, Entry, LectureError, rate_of


@dataclass(frozen=True)
class Claim:
    """An equation of an entry, and the step in whose company it holds."""

    entry: Entry
    equation: Equation
    step: Step


def tied(chapter: Chapter, records: Mapping[str, Derivation]) -> None:
    """``LectureError`` for a tie that is no step of the records, or a number of the note that
    none of the steps of its entry has."""
    steps = {s.label: s for d in records.values() for s in d.steps}
    for entry in chapter.entries:
        for tie in entry.ties:
            where = f"{chapter.file}, line {entry.line}"
            for label in tie.labels:
                if label not in steps:
                    raise LectureError(f"{where}: no step {label}")
            numbers = {n for label in entry.labels for n in steps[label].paper}
            if tie.labels and (strange := {*tie.numbers} - numbers):
                raise LectureError(f"{where}: ({min(strange)}) is no number of {tie.labels[0]}")


def tried(
    chapter: Chapter, records: Mapping[str, Derivation], seed: int | None = None
) -> Iterator[Claim]:
    """The equations of the entries that rest on steps, each with the first step in whose company
    it holds; ``LectureError`` for one that holds in none.

    A function of the time is put into its rate, and for a letter that is a name what it names.  A
    step's company is what it supposes: its rule, what is given, its hypotheses, its group; where
    that is any group, then the group of the problem.  A step that supposes equations is company for
    its own left sides alone: under what it supposes much else is true, as 0 = 0.
    """
    companies: dict[str, list[tuple[Checker | FluidChecker, Step]]] = {}
    for d in records.values():
        checker, group = checker_of(d.problem, seed), group_of(d)
        for s in d.steps:
            several = dict.fromkeys((s, replace(s, scope=group)))
            companies.setdefault(s.label, [(checker, one) for one in several])
    named = [x for x in chapter.entries if any(tie.named for tie in x.ties)]
    names = {e.lhs: e.rhs for x in named for e in x.equations}

    def put_back(t: Tree) -> Tree:
        return reduce(lambda x, y: replaced(x, y, names[y]), names, t)

    for entry in chapter.entries:
        if entry.solved:
            _solved(chapter, entry)
        for e in entry.equations if entry.labels and not entry.solved else ():
            equation = Equation(put_back(e.lhs), put_back(e.rhs))
            company = [x for label in entry.labels for x in companies[label]]
            fit = [x for x in company if not _supposing(x[1]) or _of_step(equation, x[1])]
            yield _claim(chapter, entry, equation, fit)


def _solved(chapter: Chapter, entry: Entry) -> None:
    """``LectureError`` where a letter, as a function of the time, does not have the rate that
    stands beside it, exactly: of functions as tanh no more is used than their derivatives."""
    told = {e.lhs: e.rhs for e in entry.equations}
    found = [(x, told[rate_of(x)]) for x in told if rate_of(x) in told]
    moved = (add(derivative(told[x], "t"), neg(replaced(y, x, told[x]))) for x, y in found)
    if not found or not all(map(vanishes, moved)):
        raise LectureError(f"{chapter.file}, line {entry.line}: its solution does not hold")


def _supposing(step: Step) -> bool:
    """Does a step suppose equations? That the axes are principal, I = diag(λ), names letters."""
    return any(e.lhs != "I" for e in step.given)


def _of_step(equation: Equation, step: Step) -> Equation | None:
    """The equation of a step that is the same, or else one with the same left side."""
    same = [e for e in step.equations if e.lhs == equation.lhs]
    return next((e for e in same if e.rhs == equation.rhs), same[0] if same else None)


def group_of(d: Derivation) -> str:
    """The group of a record's problem."""
    return next((s.scope for s in d.steps if s.scope != ANY_GROUP), ANY_GROUP)


def _claim(
    chapter: Chapter,
    entry: Entry,
    equation: Equation,
    company: list[tuple[Checker | FluidChecker, Step]],
) -> Claim:
    reasons: dict[str, str] = {}
    for checker, step in company:
        supposed = (*step.hypotheses, *_implied(step))
        claimed = replace(step, equations=(_quantified(equation, step),), hypotheses=supposed)
        verdict = checker.check(claimed)
        if verdict.holds:
            return Claim(entry, equation, step)
        reasons.setdefault(step.label, f"{step.label}: {verdict.reason}")
    shown = f"{show(equation.lhs)} = {show(equation.rhs)}"
    where = f"{chapter.file}, line {entry.line}"
    raise LectureError("\n".join((f"{where}: {shown} does not hold", *reasons.values())))


def _implied(step: Step) -> Iterator[Hypothesis]:
    """What is not 0 where its product with a parameter is not, as the step supposes."""
    for x in step.hypotheses:
        if x.property == "nonzero" and isinstance(x.of, tuple) and x.of[0] == "mul":
            head, *factors = x.of
            for k, factor in enumerate(factors):
                if isinstance(factor, tuple) and factor[0] == "par":
                    yield replace(x, of=(head, *factors[:k], *factors[k + 1 :]))


def _quantified(equation: Equation, step: Step) -> Equation:
    """The equation for all values for which the step's own with the same left side is."""
    same = _of_step(equation, step) or equation
    return replace(equation, for_all=same.for_all, exists=same.exists)
