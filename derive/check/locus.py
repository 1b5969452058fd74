"""The locus of an equation: the points at which the hypotheses of its step hold."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..language.show import show
from ..language.tree import Tree
from ..record.record import Equation, RecordError, Step
from ..record.rules import OFF_MOTION
from .function_signatures import RATES

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
    ``still``: δt = 0. ``stepping``: g₂ is where the discrete motion goes.
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
    for e in step.given:
        lhs, rhs = e.lhs, e.rhs
        if lhs in known:
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
    return replace(found, inside=inside, still=still, stepping=_steps(step))


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
