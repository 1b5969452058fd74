"""The names of the walk: what each one means, how LaTeX writes it, and what it is.

The tables are a contract between the walk, which uses the names, and the checker, which gives each
a value by its meaning alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..schema.kinds import kinds
from .names import DISCRETE, WORDS, Name, defined, tables, with_derivatives

VOCABULARY: dict[str, Name] = with_derivatives(
    tables(WORDS / "general.txt", {})[""],
    varied="A T α τ Z w ζ Π p_b ℓ_b",
    moving="A T Z w ζ Π Π_o p_b ℓ_b p ℓ Γ Υ",
)
OF_POTENTIALS = tables(WORDS / "potentials.txt", {})
"""Kind of a potential → the letters that its words have for their own."""


def add_letters(known: dict[str, Name], own: Mapping[str, Name]) -> None:
    """Add letters of a kind; ``ValueError`` for a known one."""
    for x in own:
        if x in known:
            raise ValueError(f"the letter {x} has a meaning: {known[x].meaning}")
    known |= own


for _kind in kinds():
    add_letters(VOCABULARY, OF_POTENTIALS.get(_kind, {}))
FLUID = with_derivatives(tables(WORDS / "fluid.txt", {})[""], varied="ν u", moving="Γ κ")
KINEMATICS: dict[str, Name] = tables(WORDS / "kinematics.txt", {})[""]
for _table in (FLUID, KINEMATICS, *DISCRETE.values()):
    VOCABULARY |= {x: about for x, about in _table.items() if x not in VOCABULARY}

_OF_GROUPS = tables(WORDS / "groups.txt", VOCABULARY)
_BRACKETS = VOCABULARY["𝕁"]
ROTATIONS = with_derivatives(_OF_GROUPS["rotations"], varied="ℓ_b", moving="ℓ ℓ_b")
DISPLACEMENTS = (
    ROTATIONS
    | {"𝕁": _BRACKETS._replace(uses=(defined(("matrix", "dim", "dim")),))}
    | _OF_GROUPS["displacements"]
)
"""Meanings and types of names that are more precise for rotations and displacements of R³."""
PRODUCTS = _OF_GROUPS["products"]
"""Meanings of names where the group is a product, whose affine factors act on (r, 1)."""
ON_THE_TORUS = _OF_GROUPS["torus"]
"""Meanings of names on the torus."""

_OF_LAGRANGIANS = tables(WORDS / "lagrangians.txt", VOCABULARY)
_REDUCED = _BRACKETS._replace(uses=(defined(("matrix", "reduced", "reduced")),))
LAGRANGIANS = {
    side: _OF_LAGRANGIANS["any"] | _OF_LAGRANGIANS[side] | {"𝕁": _REDUCED}
    for side in ("left", "right")
}
"""Meanings of names where no points give the Lagrangian, by the trivialisation."""
CARRYING = _OF_LAGRANGIANS["carrying"]
"""Meanings of names where an algebra carries something along."""

DERIVATIVE_OF = {"dϖ": "ϖ", "ḣ": "h̃", "ℓ̇": "ℓ", "ṗ": "p", "Π̇_o": "Π_o"}
DERIVATIVE_OF |= {"dΘ⁺": "Θ⁺", "dΘ⁻": "Θ⁻"}
DERIVATIVE_OF |= {"ρ̇": "ρ", "ϑ̇": "ϑ"}
DERIVATIVE_OF |= {"Γ̇": "Γ", "δΓ": "Γ", "Ẇ": "W", "Υ̇": "Υ", "dϖ_h": "ϖ_h", "d𝒜": "𝒜"}
DERIVATIVE_OF |= {"δΠ": "Π", "δ′Π": "Π", "Π̇": "Π", "δp_b": "p_b", "δ′p_b": "p_b", "ṗ_b": "p_b"}
DERIVATIVE_OF |= dict.fromkeys(("δℓ_b", "δ′ℓ_b", "ℓ̇_b"), "ℓ_b")
"""Name → the name of which it is a derivative or a variation."""


def meanings() -> Iterator[tuple[str, str]]:
    """The meaning of every name, in English and in French."""
    for table in (
        *(VOCABULARY, ROTATIONS, DISPLACEMENTS, PRODUCTS, ON_THE_TORUS, FLUID),
        *LAGRANGIANS.values(),
        *DISCRETE.values(),
        CARRYING,
        KINEMATICS,
    ):
        yield from ((x.meaning, x.french) for x in table.values())
