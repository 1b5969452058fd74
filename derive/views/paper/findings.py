"""The paper's print against the derivation: what holds as it stands, why the rest does not."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from random import Random
from typing import Any

from ...algebra.families import group
from ...check.trials.meaning import environment
from ...check.trials.model import Model
from ...check.trials.trial_points import SIZE
from ...check.values.draws import Locus, difference
from ...check.values.evaluate import Environment, evaluate
from ...language import rational as q
from ...language.show import show
from ...language.tree import Tree, names, neg
from ...record.record import Derivation, Equation
from .printed import PAPER, Printed

# What became of a numbered equation of the paper, as data: nothing is computed here.

CONFIRMED, DEFINITION = "confirmed", "definition"
SIGN, OMISSION, MISPRINT = "sign convention", "omission", "misprint"
VERDICTS = (CONFIRMED, SIGN, OMISSION, MISPRINT, DEFINITION)

HOLDS = {SIGN: "with −dϖ for dϖ, −ω for ω", OMISSION: "where there are no forces"}
"""How what is false as it stands is true, by its verdict."""


@dataclass(frozen=True)
class PaperFinding:
    """What became of one numbered equation.

    ``verdict``: one of :data:`VERDICTS`; ``equations``: those that are false as printed.
    """

    number: int
    verdict: str
    printed: str
    derived: str | None
    counterexample: dict[str, str] | None
    remark: str
    equations: tuple[Equation, ...] = ()

    @property
    def holds(self) -> str | None:
        """In words, how a print that is false as it stands is true; ``None`` for any other."""
        return HOLDS.get(self.verdict)


ORIENTED = ("dϖ", "ω")
"""Forms that change their sign with the convention: dϖ(δ, δ′) is δ[ϖ(δ′)] − δ′[ϖ(δ)], or the
opposite."""

PROBLEMS = ("so3", "affine")
"""The records that hold the derived form of the numbered equations."""

READABLE = 2
"""Counterexamples are sought among integers within ± this, most of them zero."""


class Sparse(Random):
    """A source of random numbers that draws zero more often than not, where it may."""

    def randint(self, a: int, b: int) -> int:
        """A random integer from a to b."""
        zero = self.random() < 0.7
        return 0 if zero and a <= 0 <= b else super().randint(a, b)


def compare(records: Sequence[Derivation]) -> list[PaperFinding]:
    """A finding for each of the numbered equations, by the records of :data:`PROBLEMS`."""
    return list(findings(records))


def findings(records: Sequence[Derivation]) -> Iterator[PaperFinding]:
    """The findings of :func:`compare`, one after the other."""
    return (_finding(p, records) for p in PAPER)


def amendments(numbers: Container[int]) -> list[PaperFinding]:
    """The findings of the given numbers, known to be false as printed, without the records."""
    found = []
    for p in PAPER:
        if p.number in numbers:
            tried = ((e, _counterexample(p, e, 5)) for e in p.equations)
            false, example = next((e, x) for e, x in tried if x is not None)
            what = (_cause(p), p.reads, None, example, p.remark, (false,))
            found.append(PaperFinding(p.number, *what))
    return found


def holds(
    p: Printed, equation: Equation, size: int = SIZE, seed: int = 0, *, forces: bool = True
) -> bool:
    """Does a printed equation hold at a random exact point of its group?"""
    return not bool(difference(equation, _anywhere(p.group, p.principal, size, seed, forces)))


@lru_cache(maxsize=8)
def _anywhere(group: str, principal: bool, size: int, seed: int, forces: bool) -> Environment:
    """A random exact point for all printed equations of a group."""
    return situation(group, principal, Random(f"paper {group} {seed}"), size, forces=forces)


def _cause(p: Printed) -> str:
    """The verdict on a print that is false as it stands: sign convention, omission or misprint."""
    if all(holds(p, _other_sign(e)) for e in p.equations):
        return SIGN
    return OMISSION if all(holds(p, e, forces=False) for e in p.equations) else MISPRINT


def _other_sign(e: Equation) -> Equation:
    """An equation with the opposite of dϖ and ω."""

    def opposite(t: Tree) -> Tree:
        if not isinstance(t, tuple):
            return t
        inside = tuple(map(opposite, t))
        return neg(inside) if t[0] == "call" and t[1] in ORIENTED else inside

    return Equation(opposite(e.lhs), opposite(e.rhs))


def point(
    p: Printed, size: int, seed: int, draw: type[Random] = Random, *, forces: bool = True
) -> Environment:
    """A random exact point for one printed equation."""
    random = draw(f"paper {p.number} {seed}")
    return situation(p.group, p.principal, random, size, forces=forces)


def situation(
    group_name: str, principal: bool, random: Random, size: int, *, forces: bool
) -> Environment:
    """A random exact point of the paper's situation, with an arbitrary potential or none."""
    g = group(group_name)
    problem = {"name": "paper", "group": group_name, "action": g.action}
    model = Model(problem, g, random, size, Locus(principal), generic=forces, few=True)
    env = environment(model)
    numbered = len(model.points)  # a counterexample may name one
    names = ChainMap(_meaningless(model), env.names)  # type: ignore[arg-type]
    return replace(env, names=names, listed=numbered)


def _meaningless(model: Model) -> dict[str, Any]:
    """Values for f′ and φ′: the print gives them no meaning, so they are any element of 𝔤."""
    if model.group.name != "SO(3)":
        return {}
    Z = model.algebra()
    return {"f′": Z, "φ′": ((Z[2][1],), (Z[0][2],), (Z[1][0],))}


def _finding(p: Printed, records: Sequence[Derivation]) -> PaperFinding:
    false = [e for e in p.equations if not holds(p, e)]
    verdict = _cause(p) if false else CONFIRMED if p.claim else DEFINITION
    counterexample = _counterexample(p, false[0]) if false else None
    assert bool(false) == (counterexample is not None), f"({p.number}) at small values"
    derived = _derived(p, records)
    return PaperFinding(p.number, verdict, p.reads, derived, counterexample, p.remark, tuple(false))


def _derived(p: Printed, records: Iterable[Derivation]) -> str | None:
    """What the records derive, as text: the printed left sides in the steps that carry the number.

    Failing that, all that such a step says; failing that, the left sides wherever they stand.
    """
    steps = [s for record in records if _suits(record, p) for s in record.steps]
    numbered = [s for s in steps if p.number in s.paper]
    wanted = [*(e.lhs for e in p.equations), *p.answers]
    choices = (
        [e for s in numbered for e in s.equations if e.lhs in wanted],
        [e for s in numbered[:1] for e in s.equations],
        [e for s in steps for e in s.equations if e.lhs in wanted],
    )
    found = next((c for c in choices if c), [])
    return ";  ".join(dict.fromkeys(f"{show(e.lhs)} = {show(e.rhs)}" for e in found)) or None


def _suits(record: Derivation, p: Printed) -> bool:
    """Is an equation to be read in this record: of SE(3) in the affine one, others in that of
    SO(3)?"""
    return bool((record.problem["action"] == "affine") == (p.group == "SE(3)"))


def _counterexample(p: Printed, equation: Equation, tries: int = 1000) -> dict[str, str] | None:
    """Small exact values of the names in the equation, of a body with a positive definite J, at
    which its sides differ, if any."""
    for seed in range(p.seed, p.seed + tries):
        try:
            env = point(p, READABLE, seed, Sparse)
        except (ZeroDivisionError, AssertionError):
            continue
        if q.definite(env.names["J"]) and difference(equation, env):
            used = dict.fromkeys(x for side in (equation.lhs, equation.rhs) for x in names(side))
            foot = ["A", "α"] if {"δα", "δ′α"} & {*used} else ["A"] * ("α" in used)
            used = dict.fromkeys([*foot, *used, *p.missing])  # a vector is tangent somewhere
            values = {x: text(env.names[x]) for x in used if x in env.names}
            sides = {
                f"true value of {show(equation.lhs)}": text(evaluate(equation.lhs, env)),
                "value of the printed right side": text(evaluate(equation.rhs, env)),
            }
            return values | sides
    return None


def text(x: Any) -> str:
    """The text of an exact value: a fraction, or the rows of a matrix."""
    if isinstance(x, tuple):
        return "[" + "; ".join(", ".join(text(y) for y in row) for row in x) + "]"
    q = Fraction(x)
    return str(q.numerator) if q.denominator == 1 else f"{q.numerator}/{q.denominator}"
