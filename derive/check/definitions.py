"""The introduction of names: every name of a record is said what it is, before it is used.

A name is introduced where it stands alone on one side of an equation, as in Z = j(ζ), or is the one
unknown of a pairing or a sum: Z = Σ ζ_a E_a, Tr N j(Ω′)‾ = ⟨μ, Ω′⟩, Tr j(ζ) J j(Ω)‾ = ⟨ζ, Ω⟩_I;
or where it is the coefficient of a variation, as δ(L̃) = ⟨Π, δZ⟩ + ⟨Φ, ξ⟩ says what L̃, Π, Φ are;
where an equation says that there is one; and λ in what is given, there alone, as principal moments.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from ..language.tree import Tree, names
from ..record.record import FIELDS, Equation, Step
from .elementary_values import ELEMENTARY

_PRIMITIVE = """
    Γ Γ̇ ρ Ψ Ψ_0 Ψ_1 Ψ_2 t π i a b e m U v r F A T E z u f_u X δ δ′ α τ α̇ τ̇ Ż ẇ ζ̇ ṗ ℓ̇ Ũ dŨ ∂ₜŨ ∂ₜL̃
    𝐦 𝐧 Ẇ δΠ δ′Π Π̇ Π̇_o δp_b δ′p_b ṗ_b δℓ_b δ′ℓ_b ℓ̇_b
    ι o r̂ h g_0 g_1 g_2 U_0 U_1 δg_0 δg_1 δ′g_0 δ′g_1
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


def paired(t: Tree) -> set[str]:
    """The names that a sum pairs each with a variation of its own: they are its coefficients."""
    found = t[1:] if isinstance(t, tuple) and t[0] == "add" else (t,)
    pairs = [x[1:] for x in found if isinstance(x, tuple) and x[0] == "inner"]
    partners = [y for _, y in pairs]
    return {x for x, y in pairs if isinstance(x, str) and partners.count(y) == 1}


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
        used = dict.fromkeys(x for t in _hypothesis_trees(step) for x in names(t))
        for equation in step.equations:
            known |= introduced(equation, known)
            for side in (equation.lhs, equation.rhs):
                used |= dict.fromkeys(names(side))
        yield next((x for x in used if x not in known | here), "")


def _hypothesis_trees(step: Step) -> Iterator[Tree]:
    """The trees of a step's hypotheses: of what is given, and of what properties are supposed."""
    for e in step.given:
        yield from (e.lhs, e.rhs)
    yield from (x.of for x in step.hypotheses)


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
