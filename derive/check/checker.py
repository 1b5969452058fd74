"""The checker: every equation of a record, put to the test in exact rational arithmetic.

The names of a step are given the values that they mean (:mod:`derive.check.meaning`) at random
exact points of the group, and both sides must agree, with no tolerance.  A false equation survives
with probability at most  degree / size  (Schwartz–Zippel), which is computed and reported.
Nothing is imported from the walk.
"""

from __future__ import annotations

import hashlib
import itertools
import secrets
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ..algebra.groups import Group
from ..algebra.show import show
from ..record.record import Derivation, Equation, RecordError, Step, to_json
from ..record.vocabulary import ANY_GROUP
from . import calls, degree, symbols
from .arithmetic import EvaluationError, scalar
from .assumed import Assumed, assumed
from .evaluate import Environment, evaluate, free_indices, index_values
from .header import group_of
from .introduced import unexplained
from .meaning import environment
from .model import Model
from .needed import unfounded, unsaid, untrue
from .panel import PANELS, panel
from .used import unused

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

UNUSED = "{} is used, and no step that this one uses speaks of it"

IMPOSSIBLE = (
    *(ArithmeticError, AssertionError, LookupError, TypeError, ValueError),
    *(AttributeError, RecursionError),
)
"""What comes of a record that no walk writes."""

LARGEST_BOUND = SIZE // 10**30
"""A claim whose false pass would be more probable than 1e-30 is refused."""

DIGITS = 10**6
"""Bits of the numbers that a step has, its powers multiplied out."""


@dataclass(frozen=True)
class Verdict:
    """``holds``, with ``reason`` when it does not; ``bound`` on the probability of a false pass.

    ``tried``: how many equations, on which groups; ``of``: or what else it is about.
    """

    label: str
    holds: bool
    reason: str
    bound: float
    tried: tuple[int, tuple[str, ...]] = (0, ())
    of: str = "equation"


class Checker:
    """Exact models for the scopes of one record, made once and shared by its steps."""

    def __init__(self, problem: Mapping[str, Any], seed: int | str | None = None):
        self.problem, self.seed = problem, fresh_seed() if seed is None else seed
        self._points: dict[tuple[str, Assumed, int], tuple[Model, Environment]] = {}

    def groups(self, scope: str, *, driven: bool = False) -> list[Group]:
        """The groups on which a step of this scope, with inputs or without, is tried."""
        own = self._own
        if scope == ANY_GROUP:
            if driven:
                raise RecordError("an input is of a problem, not of any group")
            return [*panel(_action(self.problem))]
        if own is None or scope != own.name:
            raise RecordError(f"scope {scope!r} is neither {ANY_GROUP!r} nor the problem's group")
        return [own]

    @cached_property
    def _own(self) -> Group | None:
        return group_of(self.problem)

    def environment(
        self, g: Group, step: Step, size: int = SIZE, equation: Equation | None = None
    ) -> Environment:
        """A random exact point, the same for all equations of a kind."""
        return self.point(g, step, size, equation)[1]

    def environments(self, step: Step) -> Iterator[tuple[Group, Environment]]:
        """The exact points at which a step is tried."""
        for g in self.groups(step.scope, driven=step.driven):
            yield g, self.environment(g, step)

    def point(
        self, g: Group, step: Step, size: int = SIZE, equation: Equation | None = None
    ) -> tuple[Model, Environment]:
        """The same with the model; an equation may hold for all accelerations."""
        key = (g.name + step.scope, assumed(step, equation), size)
        if key not in self._points:
            model = self.model(g, step.scope, key[1], size)
            self._points[key] = model, environment(model)
        return self._points[key]

    def model(self, g: Group, scope: str, at: Assumed, size: int = SIZE) -> Model:
        """A random exact point."""
        return Model(
            self.problem,
            g,
            Random(f"{self.seed} {g.name} {scope} {at.said}"),
            size,
            principal=at.principal,
            driven=at.driven,
            along=at.along,
            contracted=at.contracted,
            coasting=at.coasting,
            still=at.still,
            opaque=scope == ANY_GROUP,
        )

    def bound(self, step: Step) -> int:
        """The degree of its claims; ``RecordError`` for one that is too large."""
        groups = self.groups(step.scope, driven=step.driven)
        about = [(x, Equation(x.of, 0)) for x in step.hypotheses]
        claims = [*step.equations, *(e for x, e in about if x.property == "nondegenerate")]
        others = [*step.given, *(e for _, e in about)]
        written = max(degree.bound(e, g, {}) for g in groups for e in (*claims, *others))
        most = LARGEST_DEGREE
        if step.scope != ANY_GROUP:
            most *= WRITTEN_OUT * max(g.dimension for g in groups)
        if written > most:
            raise RecordError(f"a claim of degree {written}, more than {most}")
        if any(degree.digits(x) > DIGITS for e in (*claims, *others) for x in (e.lhs, e.rhs)):
            raise RecordError("a claim of powers of numbers that are too large")
        # about any group it is tried on points of its own, drawn at random
        problem = {} if step.scope == ANY_GROUP else self.problem
        axes = assumed(step).principal
        found = max(degree.bound(e, g, problem, principal=axes) for g in groups for e in claims)
        if found > LARGEST_BOUND:
            raise RecordError(f"a claim of degree {found}, more than {LARGEST_BOUND}")
        return found

    def check(self, step: Step) -> Verdict:
        """One step."""
        try:
            at, affine = assumed(step), _action(self.problem) == "affine"
            bound = self.bound(step)
            for equation in step.equations:
                if reason := ill_formed(equation, at, affine=affine):
                    return refused(step, equation, reason)
            for x in (*(x.of for x in step.hypotheses), *(e.lhs for e in step.given)):
                if reason := calls.wrong(x, affine=affine):
                    return Verdict(step.label, False, reason, 1.0)
            groups = self.groups(step.scope, driven=step.driven)
            for g in groups:
                if found := self.refusal(g, step):
                    return found
        except (EvaluationError, RecordError, ZeroDivisionError) as error:
            return Verdict(step.label, False, str(error), 1.0)
        except (ArithmeticError, AssertionError, LookupError, TypeError, ValueError) as error:
            reason = f"the problem or the step makes no sense: {type(error).__name__}: {error}"
            return Verdict(step.label, False, reason.splitlines()[0], 1.0)
        except (AttributeError, RecursionError) as error:
            return Verdict(step.label, False, f"not a claim: {type(error).__name__}", 1.0)
        tried = len(step.equations), tuple(g.name for g in groups)
        return Verdict(step.label, True, "", bound / SIZE, tried)

    def refusal(self, g: Group, step: Step) -> Verdict | None:
        """Of one group: a hypothesis or an equation that is not so, or what is not supposed and
        must be; ``None`` where nothing is wrong."""
        model, env = self.point(g, step)
        for e in step.given:
            if reason := difference(e, env):
                said = f"what is given, {show(e.lhs)} = {show(e.rhs)}, cannot be tried"
                return Verdict(step.label, False, f"{said}: {reason}", 1.0)
        if reason := untrue(step, self.problem, env, model):
            return Verdict(step.label, False, reason, 1.0)
        for equation in step.equations:
            if reason := difference(equation, self.environment(g, step, SIZE, equation)):
                reason = self.example(g, step, equation) or reason
                return refused(step, equation, reason, f" on {g.name}")
        reason = unsaid(step, self.problem, env, model)
        return Verdict(step.label, False, reason, 1.0) if reason else None

    def symbols(self, d: Derivation) -> Verdict:
        """The names of a record: types, roles, the equations that define them, and no others."""
        label = f"{d.name}.symbols"
        try:
            groups = {g.name: g for s in d.steps for g in self.groups(s.scope, driven=s.driven)}
            reason = symbols.wrong(d, self.environments)
        except (EvaluationError, RecordError) as error:
            reason = str(error)
        except IMPOSSIBLE as error:
            reason = f"the problem or a step makes no sense: {type(error).__name__}"
        if reason:
            return Verdict(label, False, reason, 1.0, of="symbol")
        return Verdict(label, True, "", 0.0, (len(d.symbols), tuple(groups)), "symbol")

    def example(self, g: Group, step: Step, equation: Equation) -> str:
        """What differs at a point of small numbers; empty if nothing does there."""
        with suppress(ArithmeticError, AssertionError, LookupError, TypeError, ValueError):
            return difference(equation, self.environment(g, step, SMALL, equation))
        return ""


def refused(step: Step, equation: Equation, reason: str, where: str = "") -> Verdict:
    """A verdict that names the equation."""
    said = f"{show(equation.lhs)} = {show(equation.rhs)}"
    said = said if len(said) <= SHOWN else f"{said[:SHOWN]} …"
    place = f"{step.key(equation)}{where}, {said}"
    return Verdict(step.label, False, f"{place}: {reason}", 1.0)


def ill_formed(equation: Equation, at: Assumed, *, affine: bool) -> str:
    """What is no head, argument, index or quantifier in an equation; empty where all are."""
    both = (calls.wrong(x, affine=affine) for x in (equation.lhs, equation.rhs))
    return next(filter(None, both), "") or calls.wrong_quantifier(equation, at)


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


def fresh_seed() -> int:
    """A seed that no one can know before: 128 bits, of the granularity of the bound."""
    return secrets.randbits(128)


def check(d: Derivation, seed: int | None = None) -> list[Verdict]:
    """A verdict for the symbols and one for every step, at points that are new each time.

    A ``seed`` repeats a run.
    """
    return list(verdicts(d, seed))


def verdicts(d: Derivation, seed: int | None = None) -> Iterator[Verdict]:
    """The verdicts of :func:`check`, one after the other.

    The points are drawn from the seed and a hash of the whole record: whoever writes a record
    cannot aim it at them, even where a seed is agreed upon.
    """
    digest = hashlib.sha256(to_json(d).encode("utf-8", "surrogatepass")).hexdigest()
    checker = Checker(d.problem, f"{fresh_seed() if seed is None else seed} {digest}")
    yield checker.symbols(d)
    wanting = zip(unexplained(d.steps), unused(d.steps), unfounded(d.steps, d.problem), strict=True)
    for verdict, (new, old, other) in zip(map(checker.check, d.steps), wanting, strict=True):
        reason = UNEXPLAINED.format(new) if new else UNUSED.format(old) if old else other
        said = not reason or not verdict.holds
        yield verdict if said else Verdict(verdict.label, False, reason, 1.0)
