"""The well-formedness of a record: known heads, names introduced before use, steps used."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Set
from typing import Any

from ...language.show import show
from ...language.tree import Tree, names, nodes
from ...record.record import FIELDS, Equation, Step
from ...record.uses import paired
from ..values.draws import TIME, Locus
from ..values.evaluate import ELEMENTARY
from .function_signatures import (
    FORMS,
    HEADS,
    INDEX_SETS,
    INDICES,
    MOVED,
    NUMBERED,
    OF_ELEMENTS,
    QUANTIFIED,
    RATES,
    SOLVED,
    TRANSLATION,
    ArgumentKind,
    is_polynomial,
)

# The well-formedness of equations: known heads, arguments of their kinds, letters of indices.
#
# What stands around a head, or beside its arguments, has no value of its own: it is judged here,
# by the tables of function_signatures, before anything is evaluated.

SHOWN = 40
"""The most letters of a faulty subtree that a message shows."""


def first_fault(t: Tree, *, affine: bool, inside: str = "") -> str:
    """The first ill-formed head, argument or index of a tree, in words; "" if there is none.

    ``affine``: does the group translate? ``inside``: the operator of which the tree is an operand.
    """
    if not isinstance(t, tuple):
        return ""
    parts = (first_fault(x, affine=affine, inside=t[0]) for x in t[1:])
    return _operator_fault(t, inside, affine) or next(filter(None, parts), "")


def along_any(equation: Equation, used: Collection[str]) -> bool:
    """Does an equation speak of X, or of rates along it?"""
    inside = [*nodes(equation.lhs), *nodes(equation.rhs)]
    return "X" in used or any(isinstance(x, tuple) and x[:2] == ("call", "d/dt") for x in inside)


def quantifier_fault(equation: Equation, at: Locus) -> str:
    """What is wrong with the first quantified name of an equation, in words; "" if none.

    A name of ``for_all`` must be a variation or an acceleration that is drawn freely and stands in
    the equation, one of ``exists`` a multiplier that stands in it. ``at``: the hypotheses of the
    step, which may fix a variation.
    """
    used = {*_values_of(equation.lhs), *_values_of(equation.rhs)}
    if fault := _existence_fault(equation, used):
        return fault
    first, second, rates = ({x for form in forms for x in form} for forms in (*FORMS, RATES))
    fixed = (second if at.vanishing - {TIME} else set()) | (first if at.contracted else set())
    for name in equation.for_all:
        if name not in QUANTIFIED:
            return f"nothing holds for all {_shortened(name)}: it is no variation"
        if name not in used or equation.for_all.count(name) > 1:
            return f"it says nothing of {name}, for all values of which it is to hold"
        if name in fixed:
            return f"{name} is fixed by a hypothesis of the step: nothing holds for all of it"
        if name in rates and not along_any(equation, used):
            return f"nothing holds for all {name}: it is the acceleration of the motion"
        if name in rates and not used & rates <= {*equation.for_all}:
            return f"it is to hold for all {name}, and not for all of the acceleration"
        if used & {*OF_ELEMENTS} and used & {*first, *second}:
            return f"it has {name} beside another variation, which are tied to one another"
        if name in OF_ELEMENTS:
            continue
        together = used & next(x for x in (first, second, rates) if name in x)
        if not any(together <= {*form} for forms in (*FORMS, RATES) for form in forms):
            return f"it has {', '.join(sorted(together))}, which are tied to one another"
    return ""


def _existence_fault(equation: Equation, used: Set[str]) -> str:
    """What is wrong with a name of ``exists``, in words; "" if nothing is."""
    for name in equation.exists:
        if name not in SOLVED:
            return f"that there is some {_shortened(name)} is not found: it is no multiplier"
        if name not in used or equation.exists.count(name) > 1:
            return f"it says nothing of {name}, which is to exist"
    return ""


def _values_of(t: Tree) -> Iterator[str]:
    """The names in a tree that stand for their values, not for functions."""
    if isinstance(t, str):
        yield t
    elif isinstance(t, tuple):
        for x in t[2:] if t[0] in ("call", "par") else t[1:]:
            yield from _values_of(x)


def _operator_fault(t: tuple[Any, ...], inside: str, affine: bool) -> str:
    """What is wrong with the outermost operator of a tree, in words; "" if nothing is."""
    if t[0] == "call":
        return _call_fault(t[1], t[2:], affine)
    if t[0] == "row" and inside != "matrix":
        return "a row is part of a matrix"
    if t[0] == "at" and len(t) != 3:
        return f"a member of {_shortened(t[1])} has one index"
    if t[0] == "at" and t[1] not in INDEX_SETS:
        return f"no members of {_shortened(t[1])}, which is no family"
    index = next((x for x in _indices(t) if x not in INDICES), None)
    return "" if index is None else f"{_shortened(index)} is no index: {', '.join(INDICES)} are"


def _indices(t: tuple[Any, ...]) -> Iterator[str]:
    """The letters that stand in a tree's outermost operator in the place of an index."""
    places = {"sum": t[1:2], "at": t[2:], "entry": t[2:]}.get(t[0], ())
    return (x for x in places if isinstance(x, str))


def _call_fault(head: Tree, arguments: tuple[Tree, ...], affine: bool) -> str:
    """What is wrong with a call: its head, how many arguments, or the kind of one."""
    kinds = _kinds_of(head)
    if kinds is None:
        return f"no function is called {_shortened(head)}"
    kinds = tuple(x for x in kinds if affine or x is not TRANSLATION)
    if head in NUMBERED and len(arguments) > 1:
        kinds = NUMBERED[head]  # type: ignore[index]
    if len(arguments) != len(kinds):
        expected = f"{len(kinds)} argument{'s' * (len(kinds) != 1)}"
        return f"{_shortened(head)} has {expected}, not {len(arguments)}"
    for kind, x in zip(kinds, arguments, strict=True):
        if not _is_of(kind, x):
            return f"{_shortened(head)} is of {kind.description}, not of {_shortened(x)}"
    return ""


def _kinds_of(head: Tree) -> tuple[ArgumentKind, ...] | None:
    """The kinds of the arguments that a head takes; ``None`` for what is no head."""
    if isinstance(head, str):
        return HEADS.get(head)
    member = isinstance(head, tuple) and head[0] == "at" and len(head) == 3
    return MOVED.get(head[1]) if member and isinstance(head, tuple) else None


def _is_of(kind: ArgumentKind, x: Tree) -> bool:
    if x in kind.letters or (kind.polynomial and is_polynomial(x)):
        return True
    if kind.less and isinstance(x, tuple) and x[0] == "add" and x[1] in kind.letters:
        return {*map(_name, nodes(("add", 0, *x[2:])))} <= {None, "t", "A", "π"}
    if kind.members and isinstance(x, tuple) and x[:2] == ("at", kind.members):
        return True
    called = isinstance(x, tuple) and x[0] == "call" and isinstance(x[1], tuple)
    if called and (x[1][1], *x[2:]) == kind.applied:  # type: ignore[index]
        return True
    return bool(kind.family and called and x[1][:2] == ("at", kind.family))  # type: ignore[index]


def _name(t: Tree) -> str | None:
    """A name, or that of a function; ``None`` of any other tree."""
    return t if isinstance(t, str) else t[0] if isinstance(t, tuple) and t[0] == "call" else None


def _shortened(t: Tree) -> str:
    """A tree as text, cut to a length that fits a message."""
    text = show(t)
    return text if len(text) <= SHOWN else f"{text[:SHOWN]} …"


# The introduction of names: every name of a record is said what it is, before it is used.
#
# A name is introduced where it stands alone on one side of an equation, as in Z = j(ζ), or is the
# one unknown of a pairing or a sum: Z = Σ ζ_a E_a, Tr N j(Ω′)‾ = ⟨μ, Ω′⟩, Tr j(ζ) J j(Ω)‾ = ⟨ζ,
# Ω⟩_I; or where it is the coefficient of a variation, as δ(L̃) = ⟨Π, δZ⟩ + ⟨Φ, ξ⟩ says what L̃,
# Π, Φ are; where an equation says that there is one; and λ in what is given, there alone, as
# principal moments.

_PRIMITIVE = """
    Γ Γ̇ ρ Ψ Ψ_0 Ψ_1 Ψ_2 t π i a b e m U v r F A T E z u f_u X δ δ′ α τ α̇ τ̇ Ż ẇ ζ̇ ṗ ℓ̇ Ũ dŨ ∂ₜŨ ∂ₜL̃
    𝐦 𝐧 Ẇ δΠ δ′Π Π̇ Π̇_o δp_b δ′p_b ṗ_b δℓ_b δ′ℓ_b ℓ̇_b
    ι o r̂ h g_0 g_1 g_2 U_0 U_1 δg_0 δg_1 δ′g_0 δ′g_1
    Â ξ_L ξ_R ς
    ∫ d/dt δA δT δt δα δτ δx δy δZ δw δζ δ′A δ′T δ′t δ′α δ′τ δ′x δ′y δ′Z δ′w δ′ζ
    """
PRIMITIVE = frozenset(_PRIMITIVE.split()) | ELEMENTARY
"""The names that the walk starts from: the element and its parts, variations, rates of known names,
indices, functions, what the problem gives."""


def lone_name(t: Tree) -> set[str]:
    """The name that is all of one side of an equation, also as j(ζ), a transpose, an inverse, an
    entry or a call; the empty set if there is none."""
    if isinstance(t, str):
        return {t}
    if t == ("call", "δ", "L̃"):
        return {"L̃"}
    if isinstance(t, tuple) and t[0] in ("hat", "at", "call", "T", "inv", "entry"):
        return lone_name(t[1])
    return set()


def introduced(equation: Equation, known: set[str]) -> set[str]:
    """The names that an equation introduces when the names ``known`` are."""
    found = {*equation.exists, *lone_name(equation.lhs), *lone_name(equation.rhs)}
    unknown = {*names(equation.lhs), *names(equation.rhs)} - known - found
    several = any(unknown <= paired(x) for x in (equation.lhs, equation.rhs))
    alone = _pairing(equation) and len(unknown) == 1
    return found | unknown if alone or several else found


def unexplained(steps: Iterable[Step], primitive: Collection[str] = PRIMITIVE) -> Iterator[str]:
    """For each step a name that it uses and that is not introduced by then; "" if there is none.

    ``primitive``: the names that the walk starts from.
    """
    known = set(primitive)
    for step in steps:
        here = {"λ"} if any("λ" in names(e.rhs) for e in step.given) else set()
        told = (*(x for e in step.given for x in (e.lhs, e.rhs)), *(x.of for x in step.hypotheses))
        used = dict.fromkeys(x for t in told for x in names(t))
        for equation in step.equations:
            known |= introduced(equation, known)
            for side in (equation.lhs, equation.rhs):
                used |= dict.fromkeys(names(side))
        yield next((x for x in used if x not in known | here), "")


Usage = tuple[str, str]
"""A name and the position in which it stands: "value", "member" of a family, "function", or "moved"
for r_i(t)."""


def occurrences(t: Tree) -> Iterator[tuple[Usage, tuple[Tree, ...]]]:
    """The uses of names in a tree, each with the arguments where it is a function's; indices and
    parameters are none."""
    if isinstance(t, str):
        yield (t, "value"), ()
    if not isinstance(t, tuple) or t[0] == "par":
        return
    op, *parts = t
    if op == "call":
        whole, *arguments = parts
        member = isinstance(whole, tuple)
        yield (whole[1], "moved") if member else (whole, "function"), tuple(arguments)
        parts = arguments
    elif op == "at":
        yield (parts[0], "member"), ()
        parts = []
    for part in parts[:1] if op == "entry" else parts[op in ("sum", "fun") :]:
        yield from occurrences(part)


def definitions(
    steps: Iterable[Step], primitive: Collection[str] = PRIMITIVE
) -> dict[Usage, tuple[str, tuple[Tree, ...]]]:
    """Use of a name → the key of the equation that defines it, the first that says what it is, and
    the arguments there.

    What the walk starts from is defined only where it is the left side, alone.
    """
    defined: dict[Usage, tuple[str, tuple[Tree, ...]]] = {}
    known = {
        (name, usage) for name in primitive for usage in ("value", "member", "function", "moved")
    }
    known -= {(name, "value") for name in SUMS}
    for step in steps:
        for key, equation in zip(step.keys, step.equations, strict=True):
            if equation.lhs in FIELDS and equation in step.given:
                continue
            left, right = _lone_usage(equation.lhs), _lone_usage(equation.rhs)
            there = {usage for usage, _ in occurrences(equation.rhs)}
            for usage, arguments in left:
                if usage not in there:
                    defined.setdefault(usage, (key, arguments))
            for usage, arguments in right:
                if usage not in known and usage[1] in ("value", "member"):
                    defined.setdefault(usage, (key, arguments))
            known |= {usage for usage, _ in (*left, *right)}
            there |= {usage for usage, _ in occurrences(equation.lhs)}
            unknown = {x for x in there - known if x[1] in ("value", "member") and x[0] != "π"}
            several = {x for x, _ in unknown}
            told = any(several <= paired(x) for x in (equation.lhs, equation.rhs))
            if unknown and (told or (len(unknown) == 1 and _pairing(equation))):
                defined |= dict.fromkeys(unknown, (key, ()))
                known |= unknown
    return defined


SUMS = ("m", "F")
"""Names of PRIMITIVE that stand for the members of a family; the plain name is their sum."""


def _lone_usage(t: Tree) -> list[tuple[Usage, tuple[Tree, ...]]]:
    """The use of the name that :func:`lone_name` finds on a side, in a list; empty if none."""
    while isinstance(t, tuple) and t[0] in ("hat", "T", "inv", "entry"):
        t = t[1]
    return [*occurrences(t)][:1] if lone_name(t) else []


def _pairing(equation: Equation) -> bool:
    """Is a side of the equation an inner product or a sum?"""
    both = (equation.lhs, equation.rhs)
    return any(isinstance(x, tuple) and x[0] in ("inner", "metric", "sum") for x in both)


# Every step uses the steps from which it has its names.
#
# Of every name but those that all begins with, the first step that has it must say what it is
# (definitions); a later one must use a step in which it stands.

MEMBERS = frozenset(f"{x}_" for x in ("m", "r", "r̂", "v", "F", "E"))
"""The families that the walk starts from: a member m_i is another name than the sum m."""


def unused(steps: Iterable[Step], primitive: Collection[str] = PRIMITIVE) -> Iterator[str]:
    """For each step a name of earlier steps, but of none that it uses; "" if there is none.

    ``primitive``: the names that the walk starts from.
    """
    mentions: dict[str, set[str]] = {}
    known: set[str] = set()
    for step in steps:
        here = {
            x for e in step.equations for side in (e.lhs, e.rhs) for x in mentioned(side, primitive)
        }
        mentioned_before = set().union(*(mentions.get(x, ()) for x in step.uses))
        yield next(iter(sorted((here & known) - mentioned_before)), "")
        mentions[step.label] = here
        known |= here


def mentioned(t: Tree, primitive: Collection[str] = PRIMITIVE) -> Iterator[str]:
    """The names in a tree, without those of the beginning; dϖ counts as ϖ, m_i is ``m_``."""
    if isinstance(t, str):
        if t not in primitive:
            yield t.removeprefix("d") if t == "dϖ" else t
    elif isinstance(t, tuple) and t[0] == "at":
        if f"{t[1]}_" not in MEMBERS:
            yield f"{t[1]}_"
    elif isinstance(t, tuple) and t[0] != "par":
        for part in t[1:]:
            yield from mentioned(part, primitive)
