"""The checker of a record about a fluid: every equation at random exact fields on T², T³ and the
disc."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Any

from ...algebra.samplers import Source
from ...language.tree import Tree, names
from ...record.hypotheses import Hypothesis
from ...record.record import Derivation, Equation, RecordError, Step
from ..arithmetic import EvaluationError
from ..equation_sides import as_text
from ..grades import DegreeSource, common_degree
from ..necessary_hypotheses import denominators
from ..residue import ResidueSource, random_prime
from ..trial_points import SIZE
from ..verdict import IMPOSSIBLE, MOST_BITS, RefusedError, Verdict, bit_count, refusal
from . import fluid_symbols
from .disc import Disc
from .edges import Edges
from .field_algebra import Matrix, OnBoundary, Value, times
from .field_values import FluidValues
from .flat_torus import torus
from .fluid_model import FluidModel, Locus
from .functions import Function
from .operators import Operator, Told

SPACES: dict[str, Callable[[Source, int], Any]] = {
    "T²": lambda source, size: torus(2, source, size),
    "T³": lambda source, size: torus(3, source, size),
    "disc": lambda source, size: Disc(),
}
TORI = ("T²", "T³")
BOUNDARY = frozenset({"n", "∂ₙ"})
LEVEL = Equation(("mul", ("nabla", "ϑ"), "ρ"), ("mul", "ρ", ("nabla", "ϑ")))
ONE_LEVEL = Equation(("mul", "Γ", "ρ"), ("mul", "κ", "Γ"))
GIVEN: dict[Equation, str] = {
    Equation("δt", 1): "contracted",
    Equation("δ′t", 0): "δ′t",
    Equation("η′", 0): "η′",
    Equation(("call", "η", "X"), "u"): "along",
    Equation(("call", "δg", "X"), "ν"): "lift",
    LEVEL: "level",
    ONE_LEVEL: "one_level",
}
ACCELERATIONS = frozenset({"u̇", "ν̇"})
DENSE = Hypothesis("nonzero", "ρ")
SMALL = 3


@dataclass(frozen=True)
class Place:
    """A model, and its values."""

    model: FluidModel
    values: FluidValues


class FluidChecker:
    """The checker of one record; its models are shared by the steps."""

    primitive = fluid_symbols.PRIMITIVE

    def __init__(self, problem: Mapping[str, Any], seed: int | str):
        self.problem, self.seed = problem, seed
        self.advected = problem["fluid"]["density"] == "advected"
        self.forced = problem["fluid"]["forces"] == "potential"
        self._prime: int | None = None
        self._places: dict[tuple[str, Locus, int], Place] = {}

    # -- points --------------------------------------------------------------------------------

    def source(self, name: str, at: Locus, size: int) -> Source:
        """Residues modulo a random prime; plain integers for a ``size`` that is small, degrees
        for 0."""
        if not size:
            return DegreeSource()
        random = Random(f"{self.seed} {name} {at} {size}")
        if size != SIZE:
            return random
        if self._prime is None:
            self._prime = random_prime(Random(f"{self.seed} prime"))
        return ResidueSource(random, self._prime)

    def place(self, name: str, at: Locus, size: int = SIZE) -> Place:
        """A random point on a space, by its name."""
        key = name, at, size
        if key not in self._places:
            source = self.source(name, at, size)

            def draw() -> Any:
                found = source.randint(-size, size)
                return Fraction(found) if isinstance(found, int) else found

            space = SPACES[name](source, size)
            model = FluidModel(space, draw, at, advected=self.advected, forced=self.forced)
            self._places[key] = Place(model, FluidValues(model))
        return self._places[key]

    def spaces(self, equation: Equation, at: Locus) -> tuple[str, ...]:
        """The names of the spaces on which an equation is tried: with a boundary, if it is of
        one; tori, where a level of the density has polygons."""
        used = {*names(equation.lhs), *names(equation.rhs)}
        if at.one_level:
            return TORI
        return ("disc",) if used & BOUNDARY else tuple(SPACES)

    def degree(self, step: Step, equation: Equation) -> int:
        """The degree of an equation in all that is drawn, of numerators and denominators."""
        at = locus_of(step, equation)
        return max(
            common_degree(pair).total_degree
            for name in self.spaces(equation, at)
            for pair in pairs(equation, self.place(name, at, 0).values)
        )

    # -- verdicts ------------------------------------------------------------------------------

    def check(self, step: Step) -> Verdict:
        """The verdict on one step; nothing is raised."""
        try:
            degree = self.degree_if_true(step)
        except RefusedError as error:
            return error.verdict
        except (EvaluationError, RecordError, *IMPOSSIBLE) as error:
            reason = str(error).splitlines() or [type(error).__name__]
            return Verdict(step.label, False, reason[0] or type(error).__name__, 1.0)
        tried = dict.fromkeys(x for e in step.equations for x in self.spaces(e, locus_of(step, e)))
        return Verdict(step.label, True, "", degree / SIZE, (len(step.equations), (*tried,)))

    def degree_if_true(self, step: Step) -> int:
        """One more than the degree of a step whose claims all hold; ``RefusedError`` or another
        error where one does not."""
        if step.scope != self.problem["group"] or step.driven:
            raise RecordError("the steps of a fluid are about its group, without inputs")
        if reason := hypothesis_fault(step):
            raise RecordError(reason)
        found = 0
        for e in step.equations:
            if reason := ill_formed(e, step):
                raise RefusedError(refusal(step, e, reason))
            at = locus_of(step, e)
            for name in self.spaces(e, at):
                if reason := self.difference(e, name, at):
                    raise RefusedError(refusal(step, e, reason, f" on {name}"))
            found = max(found, self.degree(step, e))
        return found + 1

    def difference(self, equation: Equation, name: str, at: Locus) -> str:
        """How the sides of an equation differ on a space; "" if they agree."""
        try:
            if all(x == y for x, y in pairs(equation, self.place(name, at).values)):
                return ""
            with suppress(*IMPOSSIBLE):  # a small denominator may be 0
                for x, y in pairs(equation, self.place(name, at, SMALL).values):
                    if x != y:
                        return f"the sides differ: {as_text(x)} and {as_text(y)}"
        except EvaluationError as error:
            return str(error)
        return "the sides differ"

    def symbols(self, d: Derivation) -> Verdict:
        """The verdict on the symbols of a record."""
        label = f"{d.name}.symbols"
        try:
            reason = fluid_symbols.first_fault(d, self.kinds_at)
        except (EvaluationError, RecordError, *IMPOSSIBLE) as error:
            reason = str(error) or type(error).__name__
        if reason:
            return Verdict(label, False, reason, 1.0, of="symbol")
        return Verdict(label, True, "", 0.0, (len(d.symbols), (*SPACES,)), "symbol")

    def kinds_at(self, step: Step, t: Tree) -> str:
        """The kind of the value of a tree where a step is tried."""
        name = "disc" if {*names(t)} & BOUNDARY else "T²"
        return kind_of(self.place(name, locus_of(step)).values.of(t))


def locus_of(step: Step, equation: Equation | None = None) -> Locus:
    """Where a step is to hold; ``RecordError`` for what is given and cannot be tried."""
    told = set()
    for e in step.given:
        if e not in GIVEN:
            raise RecordError("what is given is not among what can be tried of a fluid")
        told.add(GIVEN[e])
    if ("δ′t" in told) != ("η′" in told):
        raise RecordError("δ′t = 0 and η′ = 0 are given together")
    return Locus(
        contracted="contracted" in told,
        vertical="η′" in told,
        along="along" in told,
        lift="lift" in told,
        level="level" in told,
        one_level="one_level" in told,
        free=equation is not None and not ACCELERATIONS.isdisjoint(equation.for_all),
    )


def ill_formed(equation: Equation, step: Step) -> str:
    """What is wrong with an equation before it is tried; "" if nothing is."""
    if equation.lhs == equation.rhs:
        return "both sides are the same tree: it claims nothing"
    if bit_count(equation.lhs) + bit_count(equation.rhs) > MOST_BITS:
        return "numbers that are too large"
    used = {*names(equation.lhs), *names(equation.rhs)}
    for x in equation.for_all:
        if x not in ("η′", *ACCELERATIONS) or x not in used or equation.for_all.count(x) > 1:
            return f"it says nothing for all {x[:20]}"
        if x == "η′" and locus_of(step).vertical:
            return "η′ is fixed by what is given"
        if x in ACCELERATIONS and not used & {"X", "d/dt"}:
            return f"nothing holds for all {x}: it is the acceleration of the motion"
    if max(densities(equation.lhs), densities(equation.rhs)) > 1:
        return "a product with more densities than those that are tried can tell"
    if equation.exists and (equation.exists != ("p",) or "p" not in used):
        return "what is said to exist is the pressure"
    return ""


def densities(t: Tree) -> int:
    """The most factors ρ, ρ₀, ρ⁻¹ or κ, or rates of them, in a term of a tree."""
    if not isinstance(t, tuple):
        return t in ("ρ", "ρ_0", "ρ̇", "κ", "κ̇")
    found = map(densities, t[1:])
    return max(found) if t[0] == "add" else sum(found)


def hypothesis_fault(step: Step) -> str:
    """What is wrong with the hypotheses of a step; "" if nothing is."""
    divided = any(t != "ρ" for e in step.equations for x in (e.lhs, e.rhs) for t in denominators(x))
    if divided:
        return "it divides by something else than the density"
    needed = any(True for e in step.equations for x in (e.lhs, e.rhs) for _ in denominators(x))
    if step.hypotheses != ((DENSE,) if needed else ()):
        return "it must suppose that ρ is nowhere 0, if and only if it divides by it"
    return ""


# -- the sides of an equation --------------------------------------------------------------------


def pairs(equation: Equation, values: FluidValues) -> Iterator[tuple[Any, Any]]:
    """The numbers that must agree, two by two; ``EvaluationError`` for sides of two kinds."""
    left, right = values.of(equation.lhs), values.of(equation.rhs)
    model = values.model
    written = 0 in (equation.lhs, equation.rhs)  # a 0 of any kind
    for x, y in ((left, right), (right, left)):
        if written and isinstance(x, Function) and x == 0 and not isinstance(y, Function):
            left, right = y, times(Fraction(0), y)
    if isinstance(left, Operator) and isinstance(right, Operator):
        b = model.space.any_field(model.draw)
        on_curve = {x.on_curve for x in (left, right)}
        if on_curve == {True}:
            b = tuple(map(model.curve.of_space, b))
        left, right = (times(x, b) for x in (left, right))
    if isinstance(left, Told) or isinstance(right, Told):
        like = next((x for x in (left, right) if not isinstance(x, Told)), ())
        if isinstance(like, Function):
            raise EvaluationError("the sides differ: a field and a number")
        if like and like[0].space is model.curve:
            test = tuple(map(model.curve.of_space, model.space.any_field(model.draw)))
        else:
            test = model.space.tangent(model.draw, like)
        left, right = (values.pair(x, test) for x in (left, right))
    if type(left) is not type(right):
        raise EvaluationError("the sides are of two kinds")
    for x, y in zip(functions(left), functions(right), strict=True):
        if x.space is not y.space and not (x.is_constant or y.is_constant):
            raise EvaluationError("one side is over the points, the other in space")
        for m in {**x.terms, **y.terms}:
            yield from entries(x.terms.get(m, Fraction(0)), y.terms.get(m, Fraction(0)))


def entries(x: Any, y: Any) -> Iterator[tuple[Any, Any]]:
    """Two numbers, or those of each edge."""
    if not isinstance(x, Edges) and not isinstance(y, Edges):
        yield x, y
        return
    size = len(x.each if isinstance(x, Edges) else y.each)
    each = (z.each if isinstance(z, Edges) else (z,) * size for z in (x, y))
    yield from zip(*each, strict=True)


def functions(x: Value) -> tuple[Function, ...]:
    """The functions that a value is made of."""
    if isinstance(x, Matrix):
        return tuple(f for row in x.rows for f in row)
    if isinstance(x, OnBoundary):
        return (x.f,)
    return x if isinstance(x, tuple) else (x,)


def kind_of(x: Value) -> str:
    """The type of a value, as a record has it."""
    if isinstance(x, Function):
        return "scalar" if x.is_constant else "scalar field"
    if isinstance(x, OnBoundary):
        return "scalar field"
    if isinstance(x, Matrix):
        return "tensor field"
    return "operator" if isinstance(x, Operator) else "vector field"
