"""The checker: every equation of a record, put to the test in exact rational arithmetic.

The names of a step are given the values that they mean (:mod:`derive.record.meaning`) at random
exact points of the group, and both sides must agree, with no tolerance.  A false equation survives
with probability at most  degree / size  (Schwartz–Zippel), which is computed and reported.
Nothing is imported from the walk.
"""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ..algebra.families import group, on_homogeneous
from ..algebra.given import group_of_basis
from ..algebra.groups import Group
from ..algebra.show import show
from . import degree
from .arithmetic import EvaluationError, scalar
from .evaluate import Environment, evaluate, free_indices, index_values
from .introduced import unexplained
from .meaning import environment
from .model import Model
from .panel import PANELS
from .record import Derivation, Equation, RecordError, Step, to_json
from .vocabulary import ANY_GROUP

SIZE = 2**128
"""Random parameters are integers of at most this absolute value."""

LARGEST_DEGREE = 2000
"""Claims of a larger degree are refused before evaluation: as they are written, whatever the body;
those about the problem's group for each of its dimensions, ``WRITTEN_OUT`` times."""

WRITTEN_OUT = 64
"""A claim about a problem writes out its expressions and their derivatives."""

SMALL = 3
"""That of the example for a claim that fails."""

SHOWN = 120
"""Letters of an equation that fails, in the message."""

UNEXPLAINED = "{} is used, and neither this step nor one before it says what it is"

LARGEST_BOUND = SIZE // 10**30
"""A claim whose false pass would be more probable than 1e-30 is refused."""

DIGITS = 10**6
"""Bits of the numbers that a step has, its powers multiplied out."""


@dataclass(frozen=True)
class Verdict:
    """``holds``, with ``reason`` when it does not; ``bound`` on the probability of a false pass.

    ``tried``: how many equations, on which groups.
    """

    label: str
    holds: bool
    reason: str
    bound: float
    tried: tuple[int, tuple[str, ...]] = (0, ())


class Checker:
    """Exact models for the scopes of one record, made once and shared by its steps."""

    def __init__(self, problem: Mapping[str, Any], seed: int | str = 20):
        self.problem, self.seed = problem, seed
        self._environments: dict[tuple[str, tuple[str, ...], int], Environment] = {}

    def groups(self, scope: str, given: tuple[str, ...] = ()) -> list[Group]:
        """The groups on which a step of this scope, with these hypotheses, is tried."""
        if scope == ANY_GROUP:
            if "input" in given:
                raise RecordError("an input is of a problem, not of any group")
            return [make() for make in PANELS[_action(self.problem)]]
        if scope != self.problem.get("group"):
            raise RecordError(f"scope {scope!r} is neither {ANY_GROUP!r} nor the problem's group")
        return [self._own]

    @cached_property
    def _own(self) -> Group:
        """The problem's group: a named one, or that of the basis in the record."""
        name = str(self.problem.get("group"))
        rows = [tuple(tuple(Fraction(x) for x in row) for row in e) for e in self.problem["basis"]]
        try:
            named = group(name)
        except ValueError as error:
            if not rows:
                raise RecordError(str(error)) from None
        else:
            if tuple(rows) != named.basis:
                raise RecordError(f"the basis is not that of {name}, in its order")
            return named
        if self.problem.get("homogeneous"):
            return on_homogeneous(group_of_basis(name, "affine", rows))
        return group_of_basis(
            name, "affine" if _action(self.problem) == "affine" else "linear", rows
        )

    def environments(self, step: Step) -> Iterator[tuple[Group, Environment]]:
        """The exact points at which a step is tried."""
        for g in self.groups(step.scope, step.given):
            yield g, self.environment(g, step)

    def environment(self, g: Group, step: Step, size: int = SIZE) -> Environment:
        """A random exact point, the same for all steps of a kind."""
        key = (g.name + step.scope, step.given, size)
        if key not in self._environments:
            self._environments[key] = environment(self.model(g, step.scope, step.given, size))
        return self._environments[key]

    def model(self, g: Group, scope: str, given: tuple[str, ...], size: int = SIZE) -> Model:
        """A random exact point."""
        seed = f"{self.seed} {g.name} {scope} {given}"
        return Model(
            self.problem,
            g,
            Random(seed),
            size,
            principal="principal axes" in given,
            driven="input" in given,
            motion="any" if "any X" in given else "coasting" if "any acceleration" in given else "",
            vertical="vertical" in given,
            opaque=scope == ANY_GROUP,
        )

    def bound(self, step: Step) -> int:
        """The degree of its claims; ``RecordError`` for one that is too large."""
        groups = self.groups(step.scope, step.given)
        pairs = [(e, g) for g in groups for e in step.equations]
        written = max(degree.bound(e, g, {}) for e, g in pairs)
        most = LARGEST_DEGREE
        if step.scope != ANY_GROUP:
            most *= WRITTEN_OUT * max(g.dimension for g in groups)
        if written > most:
            raise RecordError(f"a claim of degree {written}, more than {most}")
        if any(degree.digits(x) > DIGITS for e in step.equations for x in (e.lhs, e.rhs)):
            raise RecordError("a claim of powers of numbers that are too large")
        if step.scope == ANY_GROUP:  # it is tried on points of its own, drawn at random
            return written
        axes = "principal axes" in step.given
        found = max(degree.bound(e, g, self.problem, principal=axes) for e, g in pairs)
        if found > LARGEST_BOUND:
            raise RecordError(f"a claim of degree {found}, more than {LARGEST_BOUND}")
        return found

    def check(self, step: Step) -> Verdict:
        """One step."""
        try:
            bound = self.bound(step)
            for g, env in self.environments(step):
                for k, equation in enumerate(step.equations, 1):
                    reason = difference(equation, env)
                    if reason:
                        said = f"{show(equation.lhs)} = {show(equation.rhs)}"
                        said = said if len(said) <= SHOWN else f"{said[:SHOWN]} …"
                        where = f"equation {k} on {g.name}, {said}"
                        reason = self.example(g, step, equation) or reason
                        return Verdict(step.label, False, f"{where}: {reason}", 1.0)
        except (EvaluationError, RecordError, ZeroDivisionError) as error:
            return Verdict(step.label, False, str(error), 1.0)
        except (ArithmeticError, AssertionError, LookupError, TypeError, ValueError) as error:
            reason = f"the problem or the step makes no sense: {type(error).__name__}: {error}"
            return Verdict(step.label, False, reason.splitlines()[0], 1.0)
        except (AttributeError, RecursionError) as error:
            return Verdict(step.label, False, f"not a claim: {type(error).__name__}", 1.0)
        tried = len(step.equations), tuple(g.name for g in self.groups(step.scope, step.given))
        return Verdict(step.label, True, "", bound / SIZE, tried)

    def example(self, g: Group, step: Step, equation: Equation) -> str:
        """What differs at a point of small numbers; empty if nothing does there."""
        with suppress(EvaluationError, ArithmeticError, AssertionError):
            return difference(equation, self.environment(g, step, SMALL))
        return ""


def difference(equation: Equation, env: Environment) -> str:
    """Empty when both sides agree, for every value of a free index; else what differs."""
    if equation.lhs == equation.rhs:
        return "both sides are the same tree: it claims nothing"
    both = ("add", equation.lhs, equation.rhs)
    free = sorted(free_indices(both))
    if len(free) > 2:
        return "more than two free indices"
    try:
        spans = [index_values(both, index, env) for index in free]
    except EvaluationError as error:
        return str(error)
    for values in itertools.product(*spans):
        bound = env
        for index, value in zip(free, values, strict=True):
            bound = bound.with_index(index, value)
        reason = _difference(equation, bound)
        if reason:
            return reason
    return ""


def _difference(equation: Equation, env: Environment) -> str:
    try:
        left, right = evaluate(equation.lhs, env), evaluate(equation.rhs, env)
    except EvaluationError as error:
        return str(error)
    if _same(left, right):
        return ""
    return f"the sides differ{_apart(scalar(left), scalar(right))}"


def _same(a: Any, b: Any) -> bool:
    a, b = scalar(a), scalar(b)
    if isinstance(a, tuple) != isinstance(b, tuple):
        matrix, number = (a, b) if isinstance(a, tuple) else (b, a)
        return number == 0 and all(x == 0 for row in matrix for x in row)
    return bool(a == b)


def _apart(a: Any, b: Any) -> str:
    """Where, and the numbers there."""
    if not isinstance(a, tuple) and not isinstance(b, tuple):
        return f": {_brief(a)} and {_brief(b)}"
    x, y = (c if isinstance(c, tuple) else None for c in (a, b))
    if x and y and (len(x), len(x[0])) != (len(y), len(y[0])):
        return f": a {len(x)}×{len(x[0])} and a {len(y)}×{len(y[0])} matrix"
    for i, row in enumerate(x or y or ()):
        for j in range(len(row)):
            left, right = (c[i][j] if c else whole for c, whole in ((x, a), (y, b)))
            if left != right:
                return f" in entry ({i + 1}, {j + 1}): {_brief(left)} and {_brief(right)}"
    return ""


def _brief(x: Any) -> str:
    if Fraction(x).denominator < 10**6 and abs(x) < 10**9:
        return str(x)
    return f"{float(x):.6g}" if abs(x) < Fraction(10) ** 300 else "a large number"


def _action(problem: Mapping[str, Any]) -> str:
    action = problem.get("action")
    if action not in PANELS:
        raise RecordError("record, problem: key 'action' must be linear or affine")
    return str(action)


def check(d: Derivation, seed: int = 20) -> list[Verdict]:
    """A verdict for every step."""
    return list(verdicts(d, seed))


def verdicts(d: Derivation, seed: int = 20) -> Iterator[Verdict]:
    """The verdicts one after the other.

    The points are drawn from a hash of the whole record and the seed: they are the same at every
    run, and whoever writes a record cannot aim it at them.
    """
    digest = hashlib.sha256(to_json(d).encode("utf-8", "surrogatepass")).hexdigest()
    checker = Checker(d.problem, f"{seed} {digest}")
    for verdict, name in zip(map(checker.check, d.steps), unexplained(d.steps), strict=True):
        said = not name or not verdict.holds
        yield verdict if said else Verdict(verdict.label, False, UNEXPLAINED.format(name), 1.0)
