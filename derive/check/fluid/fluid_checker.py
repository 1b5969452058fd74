"""The checker of a record about a fluid: every equation at random exact fields on its spaces."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Any

from ...algebra.samplers import RandomSource
from ...language.tree import Tree, names
from ...record.record import Derivation, Equation, Hypothesis, RecordError, Step
from ...record.vocabulary import OFF_MOTION, Type, Use
from ..form.hypotheses_checked import (
    IMPOSSIBLE,
    MOST_BITS,
    RefusedError,
    Verdict,
    bit_count,
    denominators,
    no_sense,
    refusal,
)
from ..form.symbols import undeclared, verdict
from ..form.well_formedness import Usage, definitions, occurrences
from ..trials.trial_points import SIZE
from ..values.arithmetic import EvaluationError
from ..values.draws import as_text
from ..values.residue import DegreeSource, ResidueSource, common_degree, random_prime, with_slots
from .field_values import FluidValues
from .fluid_model import FluidLocus, FluidModel
from .fluid_sides import BOUNDARY, LEAST, MORE, MOST_FIELDS, Reach, kind_of, needed, pairs, too_much
from .fluid_spaces import Ball, FlatTorus

# The declared symbols of a record about a fluid against its steps.

_PRIMITIVE = """
    U V Ũ dŨ u v η η′ δu δ′u u̇ ν ν̇ δg δ′g δν δ′ν ġ G D grad div Δ ∇ ∂ₙ n ρ ρ̇ ρ_0 ϑ ϑ̇
    δt δ′t δy δ′y X δ δ′ d/dt ∫ Γ_0 Γ̇ χ_s χ̇ ∂_s κ κ̇
    """
PRIMITIVE = frozenset(_PRIMITIVE.split())
"""The names that the walk of a fluid starts from."""
RATES = ("u̇", "ν̇", "ġ", "ρ̇", "ϑ̇", "Γ̇", "χ̇", "κ̇")
UNKNOWN = "p"
"""What an equation says to exist, and none defines."""
VARIATIONS = {"δy": "variation", "δ′y": "variation", "X": "variation"}
Kinds = Callable[[Step, Tree], str]


def first_fault(d: Derivation, kinds: Kinds) -> str:
    """What is wrong with the symbols of a record, in words; "" if nothing is. ``kinds``: the type
    of a tree at a point where a step is tried."""
    seen = used(d.steps)
    if reason := undeclared(d, (name for name, _ in seen)):
        return reason
    defined = definitions(d.steps, PRIMITIVE)
    for symbol in d.symbols:
        wanted = wanted_uses(symbol.name, seen, defined, kinds)
        if {*symbol.uses} != wanted or len(symbol.uses) != len(wanted):
            return f"{symbol.name} is not declared as it is used"
    return ""


Seen = dict[Usage, dict[tuple[Tree, ...], Step]]


def used(steps: Iterable[Step]) -> Seen:
    """The uses of names, with their arguments, and a step that has each."""
    found: Seen = {}
    for step in steps:
        for side in (x for e in step.equations for x in (e.lhs, e.rhs)):
            for usage, arguments in occurrences(side):
                found.setdefault(usage, {}).setdefault(arguments, step)
    return found


def wanted_uses(
    name: str, seen: Seen, defined: dict[Usage, tuple[str, tuple[Tree, ...]]], kinds: Kinds
) -> set[Use]:
    """The uses that a name must be declared with."""
    found: set[Use] = set()
    for usage, where in seen.items():
        if usage[0] != name:
            continue
        told = ("", ()) if name == UNKNOWN else defined.get(usage, ("", ()))
        types: dict[Type, list[tuple[Tree, ...]]] = {}
        for arguments, step in where.items():
            types.setdefault(type_of(usage, arguments, step, kinds), []).append(arguments)
        for type_, listed in types.items():
            key = told[0] if told[1] in listed else ""
            found.add(Use(type_, role(usage, key), key))
    return found


def type_of(usage: Usage, arguments: tuple[Tree, ...], step: Step, kinds: Kinds) -> Type:
    """The type of a use: of a name by its value, of a function by its arguments and its value."""

    def kind(t: Tree) -> str:
        return VARIATIONS[t] if isinstance(t, str) and t in VARIATIONS else kinds(step, t)

    name, position = usage
    if position == "value":
        return kind(name)
    if name == "∫":
        return ("function", "scalar", "scalar")
    return ("function", *map(kind, arguments), kind(("call", name, *arguments)))


def role(usage: Usage, key: str) -> str:
    """The role of a use; ``key``: of the equation that defines it, or ""."""
    name, position = usage
    if position == "function":
        return "value on X" if name == "η" else "function"
    if name in RATES:
        return "value on X"
    if name == UNKNOWN:
        return "unknown"
    return "definition" if key else "letter"


# The checker of a record about a fluid: every equation at random exact fields on T², T³, the disc
# and the ball.

SPACES: dict[str, tuple[type[FlatTorus] | type[Ball], int]] = {
    "T²": (FlatTorus, 2),
    "T³": (FlatTorus, 3),
    "disc": (Ball, 2),
    "ball": (Ball, 3),
}
"""Name → what it is, and its dimension."""
TORI, BALLS = ("T²", "T³"), ("disc", "ball")
LEVEL = Equation(("mul", ("nabla", "ϑ"), "ρ"), ("mul", "ρ", ("nabla", "ϑ")))
ONE_LEVEL = Equation(("mul", "Γ", "ρ"), ("mul", "κ", "Γ"))
GIVEN: dict[Equation, str] = {
    Equation("δt", 1): "contracted",
    Equation("δ′t", 0): "δ′t",
    Equation("η′", 0): "vertical",
    Equation(("call", "η", "X"), "u"): "along",
    Equation(("call", "δg", "X"), "ν"): "lift",
    LEVEL: "level",
    ONE_LEVEL: "one_level",
}
ACCELERATIONS = frozenset({"u̇", "ν̇"})
DENSE = Hypothesis("nonzero", "ρ")
SMALL = 3


@dataclass(frozen=True)
class FluidTrial:
    """A model, and its values."""

    model: FluidModel
    values: FluidValues


class FluidChecker:
    """The checker of one record; its models are shared by the steps."""

    primitive = PRIMITIVE

    def __init__(self, problem: Mapping[str, Any], seed: int | str):
        self.problem, self.seed = problem, seed
        self.advected = problem["fluid"]["density"] == "advected"
        self.forced = problem["fluid"]["forces"] == "potential"
        self._prime: int | None = None
        self._places: dict[tuple[str, FluidLocus, int, int], FluidTrial] = {}

    # -- points --------------------------------------------------------------------------------

    def source(self, name: str, at: FluidLocus, size: int) -> RandomSource:
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

    def place(
        self, name: str, at: FluidLocus, size: int = SIZE, reach: Reach = LEAST
    ) -> FluidTrial:
        """A random point on a space, by its name."""
        shape, dimension = SPACES[name]
        extent = reach.fields if shape is FlatTorus else reach.derivatives
        key = name, at, size, extent
        if key not in self._places:
            source = self.source(name, at, size)

            def draw() -> Any:
                found = source.randint(-size, size)
                return Fraction(found) if isinstance(found, int) else found

            def length() -> Any:
                return with_slots(draw(), 0)

            space: Any = None
            if shape is FlatTorus:
                k = tuple(tuple(length() for _ in range(dimension)) for _ in range(extent))
                space = FlatTorus(k, length())
            else:
                space = Ball(dimension, length(), extent)
            model = FluidModel(space, draw, at, advected=self.advected, forced=self.forced)
            self._places[key] = FluidTrial(model, FluidValues(model))
        return self._places[key]

    def spaces(self, equation: Equation, at: FluidLocus) -> tuple[str, ...]:
        """The names of the spaces on which an equation is tried: with a boundary, if it is of
        one; tori, where a level of the density has polygons."""
        used = {*names(equation.lhs), *names(equation.rhs)}
        if at.one_level:
            return TORI
        return BALLS if used & BOUNDARY else tuple(SPACES)

    def reach(self, equation: Equation, at: FluidLocus) -> Reach:
        """What points are to tell apart where an equation is tried; ``EvaluationError`` where it is
        more than they can."""
        inside = BOUNDARY.isdisjoint({*names(equation.lhs), *names(equation.rhs)})
        found = needed(equation, self.place("T²", at, 0).values if inside else None)
        if found.fields > MOST_FIELDS:
            raise EvaluationError(MORE.format("fields"))
        return found

    def degree(self, equation: Equation, at: FluidLocus, reach: Reach) -> int:
        """The degree of an equation in all that is drawn, of numerators and denominators."""
        return max(
            (
                common_degree(pair).total_degree
                for name in self.spaces(equation, at)
                for pair in pairs(equation, self.place(name, at, 0, reach).values)
            ),
            default=0,
        )

    # -- verdicts ------------------------------------------------------------------------------

    def check(self, step: Step) -> Verdict:
        """The verdict on one step; nothing is raised."""
        try:
            degree = self.degree_if_true(step)
        except RefusedError as error:
            return error.verdict
        except (EvaluationError, RecordError) as error:
            return Verdict(step.label, False, str(error), 1.0)
        except IMPOSSIBLE as error:
            return Verdict(step.label, False, no_sense(error), 1.0)
        tried = dict.fromkeys(x for e in step.equations for x in self.spaces(e, locus_of(step, e)))
        return Verdict(step.label, True, "", degree / SIZE, (len(step.equations), (*tried,)))

    def degree_if_true(self, step: Step) -> int:
        """One more than the degree of a step whose claims all hold; ``RefusedError`` or another
        error where one does not."""
        if step.scope != self.problem["group"]:
            raise RecordError("the steps of a fluid are about its group")
        if step.driven and self.problem["fluid"]["forces"] != "given":
            raise RecordError("no force is given that acts from outside")
        if reason := hypothesis_fault(step):
            raise RecordError(reason)
        found = 0
        for e in step.equations:
            if reason := ill_formed(e, step):
                raise RefusedError(refusal(step, e, reason))
            at = locus_of(step, e)
            try:
                reach = self.reach(e, at)
            except EvaluationError as error:
                raise RefusedError(refusal(step, e, str(error))) from error
            for name in self.spaces(e, at):
                if reason := self.difference(e, name, at, reach):
                    raise RefusedError(refusal(step, e, reason, f" on {name}"))
            found = max(found, self.degree(e, at, reach))
        return found + 1

    def difference(self, equation: Equation, name: str, at: FluidLocus, reach: Reach) -> str:
        """How the sides of an equation differ on a space; "" if they agree."""
        try:
            if all(x == y for x, y in pairs(equation, self.place(name, at, SIZE, reach).values)):
                return ""
            with suppress(*IMPOSSIBLE):  # a small denominator may be 0
                for x, y in pairs(equation, self.place(name, at, SMALL, reach).values):
                    if x != y:
                        return f"the sides differ: {as_text(x)} and {as_text(y)}"
        except EvaluationError as error:
            return str(error)
        return "the sides differ"

    def symbols(self, d: Derivation) -> Verdict:
        """The verdict on the symbols of a record."""
        return verdict(d, lambda: first_fault(d, self.kinds_at), SPACES)

    def kinds_at(self, step: Step, t: Tree) -> str:
        """The kind of the value of a tree where a step is tried."""
        name = "disc" if {*names(t)} & BOUNDARY else "T²"
        return kind_of(self.place(name, locus_of(step)).values.of(t))


def locus_of(step: Step, equation: Equation | None = None) -> FluidLocus:
    """Where a step is to hold; ``RecordError`` for what is given and cannot be tried."""
    told = set()
    for e in step.given:
        if e not in GIVEN:
            raise RecordError("what is given is not among what can be tried of a fluid")
        told.add(GIVEN[e])
    if ("δ′t" in told) != ("vertical" in told):
        raise RecordError("δ′t = 0 and η′ = 0 are given together")
    free = equation is not None and not ACCELERATIONS.isdisjoint(equation.for_all)
    flags = dict.fromkeys(told - {"δ′t"}, True)
    return FluidLocus(**flags, free=free or step.kind in OFF_MOTION, driven=step.driven)


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
    if reason := too_much(equation):
        return reason
    if equation.exists and (equation.exists != ("p",) or "p" not in used):
        return "what is said to exist is the pressure"
    return ""


def hypothesis_fault(step: Step) -> str:
    """What is wrong with the hypotheses of a step; "" if nothing is."""
    divided = any(t != "ρ" for e in step.equations for x in (e.lhs, e.rhs) for t in denominators(x))
    if divided:
        return "it divides by something else than the density"
    needed = any(True for e in step.equations for x in (e.lhs, e.rhs) for _ in denominators(x))
    if step.hypotheses != ((DENSE,) if needed else ()):
        return "it must suppose that ρ is nowhere 0, if and only if it divides by it"
    return ""
