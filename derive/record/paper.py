"""The paper's print against the derivation: confirmed, or misprinted with a counterexample.

Every printed equation is evaluated, as it stands, at exact points of the group; the correction is
read from the records.  A printed name that means nothing (f′) is given a value of its own.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from random import Random
from typing import Any

from ..algebra.families import group
from ..algebra.show import show
from ..algebra.tree import names
from .check import SIZE, difference
from .evaluate import Environment, evaluate
from .meaning import environment
from .model import Model
from .printed_solid import SOLID
from .printed_top import TOP
from .printing import Printed
from .record import Derivation, Equation

PAPER = tuple(sorted(SOLID + TOP, key=lambda p: p.number))
"""All that is numbered in the paper."""

PROBLEMS = ("so3", "affine")
"""The records that hold the derived form of the numbered equations."""

READABLE = 2
"""Counterexamples are sought among parameters of this size, most of them zero."""


class Sparse(Random):
    """Draws zero more often than not, where it may."""

    def randint(self, a: int, b: int) -> int:
        """An integer from a to b."""
        zero = self.random() < 0.6
        return 0 if zero and a <= 0 <= b else super().randint(a, b)


@dataclass(frozen=True)
class Finding:
    """What became of one numbered equation; ``equations`` are those that are false as printed."""

    number: int
    verdict: str
    printed: str
    derived: str | None
    counterexample: dict[str, str] | None
    remark: str
    equations: tuple[Equation, ...] = ()


def compare(records: Sequence[Derivation]) -> list[Finding]:
    """A finding for each of the numbered equations."""
    return list(findings(records))


def findings(records: Sequence[Derivation]) -> Iterator[Finding]:
    """The findings of :func:`compare`, one after the other."""
    return (_finding(p, records) for p in PAPER)


def misprints(numbers: Container[int]) -> list[Finding]:
    """The findings of some numbers that are known to be misprinted, from counterexamples alone."""
    found = []
    for p in PAPER:
        if p.number in numbers:
            tried = ((e, _counterexample(p, e, 5)) for e in p.equations)
            false, example = next((e, x) for e, x in tried if x is not None)
            what = ("misprinted", p.reads, None, example, p.remark, (false,))
            found.append(Finding(p.number, *what))
    return found


def holds(p: Printed, equation: Equation, size: int = SIZE, seed: int = 0) -> bool:
    """Does a printed equation hold at a random exact point?"""
    return not bool(difference(equation, point(p, size, seed)))


def point(p: Printed, size: int, seed: int, draw: type[Random] = Random) -> Environment:
    """A random exact point of the paper's situation, with an arbitrary potential."""
    g = group(p.group)
    random = draw(f"paper {p.number} {seed}")
    problem = {"name": "paper", "group": p.group, "action": g.action}
    model = Model(problem, g, random, size, opaque=True, principal=p.principal, spare=0)
    env = environment(model)
    numbered = len(model.points)  # a counterexample may name one
    return replace(env, names={**env.names, **_meaningless(model)}, listed=numbered)


def _meaningless(model: Model) -> dict[str, Any]:
    """f′ and φ′: the print gives them no meaning, so they are any element of the algebra."""
    if model.group.name != "SO(3)":
        return {}
    Z = model.algebra()
    return {"f′": Z, "φ′": ((Z[2][1],), (Z[0][2],), (Z[1][0],))}


def _finding(p: Printed, records: Sequence[Derivation]) -> Finding:
    false = [e for e in p.equations if not holds(p, e)]
    verdict = "misprinted" if false else "confirmed" if p.claim else "definition"
    counterexample = _counterexample(p, false[0]) if false else None
    assert bool(false) == (counterexample is not None), f"({p.number}) at small values"
    derived = _derived(p, records)
    return Finding(p.number, verdict, p.reads, derived, counterexample, p.remark, tuple(false))


def _derived(p: Printed, records: Iterable[Derivation]) -> str | None:
    """What the records derive: the printed left sides in the steps that carry the number.

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
    """Equations of SE(3) are read in the affine record, the others in that of SO(3)."""
    return bool((record.problem["action"] == "affine") == (p.group == "SE(3)"))


def _counterexample(p: Printed, equation: Equation, tries: int = 1000) -> dict[str, str] | None:
    """Small exact values of the names in the equation, at which its sides differ, if any."""
    for seed in range(p.seed, p.seed + tries):
        try:
            env = point(p, READABLE, seed, Sparse)
        except (ZeroDivisionError, AssertionError):
            continue
        if difference(equation, env) and _of_a_body(env.names.get("λ")):
            used = dict.fromkeys(x for side in (equation.lhs, equation.rhs) for x in names(side))
            used = dict.fromkeys([*["A"] * ("α" in used), *used, *p.missing])
            values = {x: text(env.names[x]) for x in used if x in env.names}
            sides = {
                f"true value of {show(equation.lhs)}": text(evaluate(equation.lhs, env)),
                "value of the printed right side": text(evaluate(equation.rhs, env)),
            }
            return values | sides
    return None


def _of_a_body(moments: Any) -> bool:
    """Are these principal moments of inertia, where there are any, those of some masses?"""
    if moments is None:
        return True
    a, b, c = sorted(x for (x,) in moments)
    return bool(a > 0 and c <= a + b)


def text(x: Any) -> str:
    """An exact value: a fraction, or the rows of a matrix."""
    if isinstance(x, tuple):
        return "[" + "; ".join(", ".join(text(y) for y in row) for row in x) + "]"
    q = Fraction(x)
    return str(q.numerator) if q.denominator == 1 else f"{q.numerator}/{q.denominator}"
