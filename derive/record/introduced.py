"""Is every name of a record said what it is, before it is used?

A name is introduced where it stands alone on one side of an equation, as in Z = j(ζ), or is the one
unknown of a pairing or a sum: Z = Σ ζ_a E_a, Tr N j(Ω′)‾ = ⟨μ, Ω′⟩, Tr j(ζ) J j(Ω)‾ = ⟨ζ, Ω⟩_I.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..algebra.tree import Tree, names
from .record import Equation, Step

_FIRST = """
    t π i a b e m U v r F A T E u f_u λ X δ δ′ α τ α̇ τ̇ Ż ẇ ζ̇ ṗ ℓ̇ Ũ dŨ ∂ₜŨ
    δA δT δt δα δτ δx δy δZ δw δζ δ′A δ′T δ′t δ′α δ′τ δ′x δ′y δ′Z δ′w δ′ζ
    sqrt sin cos tan exp log sinh cosh tanh atan
    """
FIRST = frozenset(_FIRST.split())
"""What the walk starts from: the element and its parts, variations, rates of known names, indices,
functions, what the problem gives; λ is a multiplier or the principal moments, as the prose says."""


def alone(t: Tree) -> set[str]:
    """The name that stands alone on a side, also as j(ζ), an entry or a function."""
    if isinstance(t, str):
        return {t}
    if isinstance(t, tuple) and t[0] in ("hat", "at", "call", "T", "inv", "entry"):
        return alone(t[1])
    return set()


def introduced(equation: Equation, known: set[str]) -> set[str]:
    """The names that an equation says what they are, when others are known."""
    found, both = set(), (equation.lhs, equation.rhs)
    for side in both:
        found |= alone(side)
    unknown = {x for side in both for x in names(side)} - known - found
    pairing = any(isinstance(x, tuple) and x[0] in ("inner", "metric", "sum") for x in both)
    return found | unknown if pairing and len(unknown) == 1 else found


def unexplained(steps: Iterable[Step]) -> Iterator[str]:
    """For each step a name that it uses and nothing introduces; empty when there is none."""
    known = set(FIRST)
    for step in steps:
        used: dict[str, None] = {}
        for equation in step.equations:
            known |= introduced(equation, known)
            for side in (equation.lhs, equation.rhs):
                used |= dict.fromkeys(names(side))
        yield next((x for x in used if x not in known), "")
