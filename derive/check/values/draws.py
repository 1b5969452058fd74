"""What is drawn at random for a model; the locus of an equation, and its two sides."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...algebra.groups import Group
from ...algebra.samplers import RandomSource
from ...language.intervals import pi as bounds_of_pi
from ...language.rational import Matrix, flatten
from ...language.reserved import suffixed
from ...language.show import show
from ...language.tree import Tree
from ...record.as_json import decode
from ...record.record import Equation, RecordError, Step
from ...record.vocabulary import OFF_MOTION
from ..form.function_signatures import LATTICE, RATES
from . import residue
from .arithmetic import (
    EPS,
    ETA,
    EvaluationError,
    Nilpotent,
    describe_shapes,
    is_matrix,
    nilpotent,
    shape,
)
from .evaluate import ElementaryValues, Environment, evaluate, free_indices, index_values

# What is drawn at random for a model before it has points: parameters, π, functions.

SPARE = 2
"""So many points more than are needed, where the problem leaves them open: no equation may hold by
a symmetry of few points."""


def at_time(env: Environment, t: Any) -> Environment:
    """An environment of expressions at a time."""
    return replace(env, names={**env.names, "t": t})


def onward(env: Environment, flows: Sequence[Mapping[str, Any]], t: Any, s: Any) -> Environment:
    """An environment of expressions at the time t + s, s nilpotent: the masses that are of the
    state have gone on by the rates of the flows, at inputs that are held."""
    moved = at_time(env, t + s)
    for _ in range(2):  # s³ is 0
        gone: dict[str, Any] = {}
        for x in flows:
            if name := x.get("mass"):
                rate = integral(evaluate(decode(x["rate"], "rate"), moved), s)
                gone[name] = gone.get(name, env.parameters[name]) + rate
        moved = replace(moved, parameters={**env.parameters, **gone})
    return moved


def integral(rate: Any, s: Any) -> Any:
    """An integral of a rate over s, in nilpotent numbers, whose derivatives are it and its own."""
    x = Nilpotent.of(rate)
    return x.part(0) * s + x.part(ETA) * nilpotent(ETA) * nilpotent(EPS)


class Draws:
    """The random numbers of a model before it has points, and the values of the problem's own
    expressions in them.

    ``size``: integers are drawn within ±size. ``generic``: the potential is left open, and with it
    inputs and places. ``pi``: the value of π, as in code, where roots of numbers are numbers like
    others; else any number. ``few``: no spare points; ``given``: the values of some parameters;
    ``bounded``: π and functions are within bounds.
    """

    def __init__(
        self,
        problem: Mapping[str, Any],
        group: Group,
        random: RandomSource,
        size: int,
        *,
        generic: bool = False,
        pi: Fraction | None = None,
        few: bool = False,
        given: Mapping[str, Any] | None = None,
        bounded: bool = False,
    ):
        self.problem, self.group, self.random, self.size = problem, group, random, size
        self.generic, self.spare, self.n = generic, 0 if few else SPARE, group.n
        self.parameters = {x: self.draw(positive=True) for x in problem.get("parameters", {})}
        self.parameters |= given or {}
        exact = pi is None and not isinstance(random, residue.ResidueSource)
        self.elementary = ElementaryValues(lambda: self.draw(positive=True), exact=exact)
        self.elementary.bounded = bounded
        self.graded = isinstance(random, residue.DegreeSource)
        self.unit = residue.indeterminate(0, 1) if self.graded else Fraction(1)
        self.pi: Any = bounds_of_pi() if bounded else self.draw(positive=True) if pi is None else pi

    def draw(self, *, positive: bool = False, slots: int = 0) -> Any:
        """A random integer of the ring drawn from, ``positive`` from 1 on; ``slots``: counted as an
        entry of a tensor of so many indices."""
        x = Fraction(1) * self.random.randint(1 if positive else -self.size, self.size)
        return residue.indeterminate(slots) if isinstance(x, residue.Graded) else x

    def place(self) -> tuple[Any, ...]:
        """A random point of space, n numbers."""
        return tuple(self.draw(slots=1) for _ in range(self.n))

    def algebra(self) -> Matrix:
        """A random element of 𝔤, as a matrix of the group's size."""
        return self.group.hat([self.draw(slots=2) for _ in self.group.basis])

    @cached_property
    def t(self) -> Any:
        """The time."""
        return self.draw()

    @cached_property
    def expressions(self) -> Environment:
        """The environment of the problem's own expressions, in its parameters and π; where mass
        flows, in t."""
        known = Environment(
            self.n, {"π": self.pi}, parameters=self.parameters, elementary=self.elementary
        )
        return at_time(known, self.t) if "flows" in self.problem else known

    def name_covector(self, covector: Sequence[Any]) -> dict[str, Any]:
        """The numbers of the covector by their names in the problem, ``u_3``: its values on the
        basis that the problem states."""
        found: dict[str, Any] = {}
        for data in self.inputs_of("covector"):
            for a, e in enumerate(self.group.in_user_basis.basis, 1):
                parts = zip(self.group.nearest(e), covector, strict=True)
                found[suffixed(data["name"], a)] = sum((x * u for x, u in parts), Fraction(0))
        return found

    def inputs_of(self, *kinds: str) -> list[Mapping[str, Any]]:
        """The inputs of some kinds, "force", "torque", "covector"; none where the potential is left
        open."""
        if self.generic:
            return []
        return [i for i in self.problem.get("inputs", []) if i["kind"] in kinds]


# The locus of an equation: the points at which the hypotheses of its step hold.

TIME, LINEAR, TRANSLATION = "time", "linear", "translation"

EVALUATION = "evaluation"
"""The rule of steps that put the problem's numbers in, and its group's element."""

PRINCIPAL: Tree = (
    "matrix",
    *(("row", *(("entry", "λ", i) if i == j else 0 for j in (1, 2, 3))) for i in (1, 2, 3)),
)
"""diag(λ₁, λ₂, λ₃)."""

VANISHING: dict[str, str] = {
    "δ′t": TIME,
    **dict.fromkeys(("δ′A", "ξ′", "Ω′"), LINEAR),
    **dict.fromkeys(("δ′T", "η′"), TRANSLATION),
}
"""The parts of δ′ that a hypothesis such as δ′t = 0 or ξ′ = 0 may make vanish, by its left side."""

ALONG: dict[tuple[str, str], str] = {
    **dict.fromkeys((("δA", "α"), ("ξ", "Z"), ("Ω", "ζ")), LINEAR),
    **dict.fromkeys((("δT", "τ"), ("η", "w")), TRANSLATION),
}
"""The parts of the velocity of X that a hypothesis such as ξ(X) = Z may fix, by its two sides:
those in which X has the velocity of the motion."""


@dataclass(frozen=True)
class Locus:
    """The points at which an equation is to hold.

    ``principal``: those with I = diag(λ₁, λ₂, λ₃). ``contracted``: δt = 1, and X is the vector of
    δ. ``vanishing``: the parts of δ′ that vanish; ``along``: the parts of the velocity of X that
    are those of the motion, ``None`` where X is the motion. ``free_acceleration``: the
    acceleration is any, and that of X. ``driven``: inputs and damping act. ``field``: δt and δA
    where δ is a field, functions of t and A; ``field_prime``: those of δ′. ``inside``: g is in the
    least algebraic group that has 𝔤, not in a larger one with the same relations.
    ``still``: δt = 0. ``stepping``: g₂ is where the discrete motion goes. ``elements``: those that
    are given, by their names.
    """

    principal: bool = False
    contracted: bool = False
    vanishing: frozenset[str] = frozenset()
    along: frozenset[str] | None = None
    free_acceleration: bool = False
    driven: bool = False
    field: tuple[tuple[str, Tree], ...] = ()
    field_prime: tuple[tuple[str, Tree], ...] = ()
    inside: bool = False
    still: bool = False
    stepping: bool = False
    elements: tuple[tuple[str, Tree], ...] = ()

    @property
    def as_text(self) -> str:
        """The hypotheses as text, whatever the order of sets: a part of a point's seed."""
        sets = sorted(self.vanishing), sorted(self.along or ())
        fields = f" {self.field} {self.field_prime}" if self.field or self.field_prime else ""
        flags = f"{self.principal} {self.contracted} {sets} {self.free_acceleration} {self.driven}"
        return (
            flags
            + fields
            + " inside" * self.inside
            + " still" * self.still
            + " stepping" * self.stepping
            + (f" {self.elements}" if self.elements else "")
        )


def locus_of(step: Step, equation: Equation | None = None) -> Locus:
    """The locus of a step; with ``equation``, also whether that holds for all accelerations, as
    what is no claim about the motion does.

    ``RecordError`` for a hypothesis that is none of these.
    """
    principal = contracted = still = False
    vanishing: set[str] = set()
    along: set[str] = set()
    fields = [_field(step, names) for names in (("δt", "δA"), ("δ′t", "δ′A"))]
    known = {name for field in fields for name, _ in field}
    elements: dict[str, Tree] = {}
    for e in step.given:
        lhs, rhs = e.lhs, e.rhs
        if lhs in known:
            continue
        if lhs in ("A", "Â") and isinstance(rhs, tuple) and rhs[0] == "matrix":
            elements[str(lhs)] = rhs
            continue
        if (lhs, rhs) == ("I", PRINCIPAL):
            principal = True
        elif (lhs, rhs) == ("δt", 1):
            contracted = True
        elif (lhs, rhs) == ("δt", 0):
            still = True
        elif isinstance(lhs, str) and lhs in VANISHING and rhs == 0:
            vanishing.add(VANISHING[lhs])
        elif part := part_of_velocity(lhs, rhs):
            along.add(part)
        else:
            text = f"{show(lhs)} = {show(rhs)}"
            raise RecordError(f"the hypothesis {text[:80]} is not one that can be tried")
    any_rate = equation is not None and any({*equation.for_all} & {*form} for form in RATES)
    free = any_rate or step.kind in OFF_MOTION
    told = frozenset(vanishing), frozenset(along)
    found = Locus(principal, contracted, *told, free, step.driven, fields[0], fields[1])
    if still and contracted:
        raise RecordError("the hypotheses δt = 0 and δt = 1 exclude each other")
    inside = step.rule == EVALUATION or bool(step.names & {*CARRIED})
    return replace(
        found, inside=inside, still=still, stepping=_steps(step), elements=(*elements.items(),)
    )


CARRIED = ("Π_o", "Π̇_o")
"""What g carries to the other side, A⁻¹ξ′A, is in 𝔤 for g in the group alone."""


def _steps(step: Step) -> bool:
    """Does a step speak of g₂ on the discrete motion?"""
    return step.kind in ("kernel", "solution", "conservation") and bool(step.names & {*AFTER})


AFTER = ("g_2", "A_2", "T_2", "R_2", "M_1", "ℓ_1", "p_1", "m_1", "H")
"""What the discrete motion says of the time after t₁."""


def _field(step: Step, names: tuple[str, str]) -> tuple[tuple[str, Tree], ...]:
    """The given δt and δA of a field, each once and not both 0; else nothing."""
    given = tuple((str(e.lhs), e.rhs) for e in step.given if e.lhs in names)
    whole = tuple(lhs for lhs, _ in given) == names and any(rhs != 0 for _, rhs in given)
    return given if whole else ()


def part_of_velocity(lhs: Tree, rhs: Tree) -> str:
    """The part of the velocity of X that lhs = rhs fixes, as δA(X) = α; "" for any other."""
    if isinstance(lhs, tuple) and lhs[0] == "call" and lhs[2:] == ("X",):
        return ALONG.get((lhs[1], rhs), "") if isinstance(rhs, str) else ""
    return ""


# The two sides of an equation at a point: how they differ, and of what degree the claim is.

MOST_INDICES = 2


def index_bindings(t: Tree, env: Environment, *, at_once: bool = False) -> Iterator[Environment]:
    """The environment with the free indices of a tree bound, once for each of their values;
    ``at_once``: the last of those of a lattice to all of its points, where that has a value."""
    free = sorted(free_indices(t))
    if len(free) > MOST_INDICES:
        raise EvaluationError("more than two free indices")
    every = [index_values(t, index, env) for index in free]
    if at_once and env.at_once is not None and {*free} <= {*LATTICE}:
        every[-1:] = [[0]] * len(free[-1:])
    for numbers in itertools.product(*every):
        bound = env
        for index, number in zip(free, numbers, strict=True):
            bound = bound.with_index(index, number)
        yield bound


def difference(equation: Equation, env: Environment) -> str:
    """How the sides of an equation differ, for some value of a free index; "" if they agree."""
    if equation.lhs == equation.rhs:
        return "both sides are the same tree: it claims nothing"
    try:
        found = (_difference(*both) for both in _sides(equation, env))
        return next(filter(None, found), "")
    except EvaluationError as error:
        return str(error)


def _sides(equation: Equation, env: Environment) -> Iterator[tuple[Any, Any]]:
    """The values of both sides for each value of the free indices, of one shape, or one side the
    number 0; ``EvaluationError`` for other shapes."""
    trees = (equation.lhs, equation.rhs)
    for there in index_bindings(("add", *trees), env, at_once=True):
        left, right = values = [evaluate(x, there) for x in trees]
        if shape(left) != shape(right) and 0 not in trees:
            raise EvaluationError(f"the sides differ: {describe_shapes(*map(shape, values))}")
        yield left, right


def _entries(x: Any) -> tuple[Any, ...]:
    """Those of a matrix; a number, or what is one for each of many points, is its own."""
    return flatten(x) if isinstance(x, tuple) else (x,)


def _difference(a: Any, b: Any) -> str:
    """The first entry in which two values differ, in words; "" if they are equal."""
    whole = a if is_matrix(a) else b
    alike, both = shape(a) == shape(b), (_entries(a), _entries(b))
    for k, (x, y) in enumerate(zip(*both, strict=True) if alike else itertools.product(*both)):
        if x != y:
            row, column = divmod(k, len(whole[0])) if isinstance(whole, tuple) else (0, 0)
            where = f" in entry ({row + 1}, {column + 1})" if isinstance(whole, tuple) else ""
            numbers = isinstance(x, (int, Fraction)) and isinstance(y, (int, Fraction))
            return f"the sides differ{where}" + (
                f": {as_text(x)} and {as_text(y)}" if numbers else ""
            )
    return ""


def as_text(x: Any) -> str:
    """A rational number as short text for a message: exact if that is short, else to six digits."""
    if Fraction(x).denominator < 10**6 and abs(x) < 10**9:
        return str(x)
    return f"{float(x):.6g}" if abs(x) < Fraction(10) ** 300 else "a large number"


def claim_grade(equation: Equation, env: Environment) -> tuple[int, residue.Grade]:
    """At a point in graded numbers: the degree of an equation, of numerators and denominators
    together, and the grade of its numerators, open indices closed in pairs."""
    whole, top = 0, residue.ZERO_GRADE
    for a, b in _sides(equation, env):
        pairs = zip(_entries(a), _entries(b), strict=True)
        if shape(a) != shape(b):
            pairs = itertools.product(_entries(a), _entries(b))  # type: ignore[assignment]
        open_ = sum(k > 1 for k in max(shape(a), shape(b)))
        open_ += len(free_indices(("add", equation.lhs, equation.rhs)))
        for x in map(residue.common_degree, pairs):
            g = x.numerator
            whole = max(whole, x.total_degree)
            top = residue.Grade(*map(max, top, (g.degree, g.slots + open_, g.loops)))
    return whole, top


def largest_degree(t: Tree, env: Environment) -> int:
    """The largest degree of a value of a tree at a point in graded numbers."""
    values = (evaluate(t, there) for there in index_bindings(t, env))
    found: Iterator[residue.Degree] = (d for x in values for d in residue.degrees(_entries(x)))
    return max((d.total_degree for d in found), default=0)
