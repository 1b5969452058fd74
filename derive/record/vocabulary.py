"""The names of the walk: what each one means, its types and roles, how LaTeX writes it; the rules.

The tables are a contract between the walk, which uses the names, and the checker, which gives each
a value by its meaning alone.  They stand in the text files of ``prose/names``, as sentences do in
those of ``prose``: a label, English, French.  The label is the name, its LaTeX and its uses, with a
bar between them; or a name alone, which differs from another in its meaning.  Of the rules by which
steps are derived: a sentence for each, and of what kind its equations are.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple
from unicodedata import normalize

from ..schema.potential_kinds import kinds
from .prose import read, unmarked

Type = str | tuple[Any, ...]
"""``scalar``, ``(matrix, rows, columns)``, ``(vector, n)``; ``(algebra,)``, a matrix among the
linear parts of 𝔤; ``(function, types of the arguments …, type of the value)``; ``(family, what its
index counts, type of a member)``; a variation of the point y, with the time or without."""

SCALAR, VARIATION, AT_ONE_TIME = "scalar", "variation", "variation at one time"
SQUARE, VECTOR, COORDINATES = ("matrix", "n", "n"), ("vector", "n"), ("vector", "d")
ALGEBRA, PLACE = ("algebra",), ("vector", "block")
LATTICE = ("vector", "lattice")
ADVECTED = ("vector", "carried")
"""Sizes in types: n is the dimension of the space, d that of the linear parts of 𝔤, dim that of 𝔤,
block that of the space of a factor, where a product has several of any of them; carried, how many
entries what the algebra carries along has; lattice, 2; reduced, d and carried together; fields, how
many symmetries a problem is reduced by."""

FIELD, FUNCTION_ON_SPACE, OPERATOR = "vector field", "scalar field", "operator"
TENSOR = "tensor field"
"""Of a fluid: a vector, a number or a matrix at each place; a linear map of fields to fields."""
PLAIN = (SCALAR, VARIATION, AT_ONE_TIME, FIELD, FUNCTION_ON_SPACE, OPERATOR, TENSOR)
SIZED = {"algebra": 0, "vector": 1, "matrix": 2}
"""The types that are a word or two; the others, and how many sizes each of them has."""

ROLES = ("letter", "definition", "value on X", "unknown", "function")
"""What a name is: chosen freely; defined by an equation; a rate along the motion, or the value of a
variation on X; what exists by a theorem, as a multiplier does; a function."""
WORDS = Path(__file__).parent / "prose" / "names"


class Use(NamedTuple):
    """One of the ways in which a name is used: m is a number, and m_i a family of numbers.

    ``defined``: in a record, the key of the equation that defines it, or says what it is first.
    """

    type: Type
    role: str
    defined: str = ""


class Name(NamedTuple):
    """What a name means, in English and in French, formulas between dollars, how LaTeX writes it,
    and in which ways it is used in equations."""

    meaning: str
    french: str
    latex: str
    uses: tuple[Use, ...]


def letter(type: Type) -> Use:
    """The use of a name that the walk starts from; a step may say later what it is, as for U."""
    return Use(type, "letter")


def defined(type: Type) -> Use:
    """The use of a name that an equation defines."""
    return Use(type, "definition")


def tables(file: Path, known: Mapping[str, Name]) -> dict[str, dict[str, Name]]:
    """The names of a file by the part of the label before a point, empty without one; ``known``:
    those that a name alone differs from.  ``ValueError`` names what is no use and stands twice."""
    found: dict[str, dict[str, Name]] = {}
    for label, (meaning, french) in read([file]).items():
        head, *about = label.split(" | ")
        part, _, x = head.rpartition(".")
        latex, uses = (about[0], _uses(about[1:])) if about else known[x][2:]
        if x in found.setdefault(part, {}):
            raise ValueError(f"{file}: the name {head} stands twice")
        found[part][x] = Name(meaning, french, latex, uses)
    return found


def _uses(texts: Sequence[str]) -> tuple[Use, ...]:
    """The uses of a name, as ``definition: scalar; letter: points of scalar``; without any it
    occurs in sentences alone."""
    told = (x.split(": ") for text in texts for x in text.split("; "))
    found = tuple(Use(type_of(type), role) for role, type in told)
    for use in found:
        if use.role not in ROLES:
            raise ValueError(f"{use.role!r} is no role of a name")
    return found


def type_of(text: str) -> Type:
    """The type that a text says: ``matrix n n``; ``vector n, vector n → scalar``, of a function;
    ``points of scalar``, of a family; ``ValueError`` for none."""
    if text in PLAIN:
        return text
    index, of, member = text.partition(" of ")
    if of:
        return ("family", index, type_of(member))
    arguments, arrow, value = text.partition(" → ")
    if arrow:
        return ("function", *map(type_of, arguments.split(", ")), type_of(value))
    head, *sizes = text.split(" ")
    if SIZED.get(head) != len(sizes):
        raise ValueError(f"{text!r} is no type of a name")
    return (head, *sizes)


def with_derivatives(table: dict[str, Name], varied: str, moving: str) -> dict[str, Name]:
    """A table of names, with δX and δ′X for each X of ``varied`` and the rate Ẋ for each of
    ``moving``, names apart by spaces; what the table says of one itself stays."""
    found: dict[str, Name] = {}
    for x in varied.split():
        latex, use = table[x].latex, letter(table[x].uses[0].type)
        told = f"variation of ${x}$", f"variation de ${x}$"
        found[f"δ{x}"] = Name(*told, _of(r"\delta", latex), (use,))
        told = f"variation $δ′$ of ${x}$", f"variation $δ′$ de ${x}$"
        found[f"δ′{x}"] = Name(*told, _of(r"\delta'", latex), (use,))
    for x in moving.split():
        told = f"$d{x}/dt$ along the motion", f"$d{x}/dt$ le long du mouvement"
        rates = tuple(Use(use.type, "value on X") for use in table[x].uses)
        dotted = normalize("NFC", f"{x[0]}\u0307{x[1:]}")
        found[dotted] = Name(*told, _of(r"\dot", table[x].latex), rates)
    return found | table


def _of(mark: str, latex: str) -> str:
    """The LaTeX of a name behind a mark."""
    return f"{mark}{latex}" if latex.startswith("\\") else f"{mark} {latex}"


# The discrete road, where an affine map is its matrix on (r, 1).

WHICH = (("first", "premier"), ("second", "deuxième"), ("third", "troisième"))


def of_action(square: Type, algebra: Type, *, affine: bool) -> dict[str, Name]:
    """The names, for elements of the group of one type and elements of 𝔤; those of an affine map
    have a hat where they are of its size."""
    parts = tables(WORDS / "discrete.txt", {})
    hat, latex_hat = ("\u0302", r"\hat ") if affine else ("", "")
    hatted, chapeau = ("; of $(r, 1)$", " ; de $(r, 1)$") if affine else ("", "")
    inside = "$g_1⁻¹δg_1$, in the Lie algebra", "$g_1⁻¹δg_1$, dans l’algèbre de Lie"
    basis = ("family", "basis", algebra)
    found = {
        f"ξ{hat}": Name(*inside, rf"{latex_hat}\xi", (defined(algebra),)),
        "E": Name("basis of the Lie algebra", "base de l’algèbre de Lie", "E", (letter(basis),)),
    }
    for k, (which, french) in enumerate(WHICH):
        told = f"{which} element of the group", f"{french} élément du groupe"
        found[f"g_{k}"] = Name(*told, f"g_{k}", (letter(square),))
        at = f"$g_{k}$"
        told = f"moments of the forces at {at}{hatted}", f"moments des forces en {at}{chapeau}"
        found[f"N{hat}_{k}"] = Name(*told, f"{latex_hat}N_{k}", (defined(square),))
        for mark, latex in (("δ", r"\delta"), ("δ′", r"\delta'")):
            told = f"variation ${mark}$ of {at}", f"variation ${mark}$ de {at}"
            found[f"{mark}g_{k}"] = Name(*told, f"{latex} g_{k}", (letter(square),))
    common = parts["both"] | _numbered(parts["numbered"], 2)
    blocks = parts["affine"] | _numbered(parts["blocks"], 3) if affine else {}
    return common | found | blocks


def _numbered(table: Mapping[str, Name], count: int) -> dict[str, Name]:
    """The names of elements 0, 1, …, by those with {k}, and {next} for the number after it."""
    found = {}
    for k, (x, about) in product(range(count), table.items()):
        texts = (y.replace("{k}", f"{k}").replace("{next}", f"{k + 1}") for y in (x, *about[:3]))
        own, meaning, french, latex = texts
        found[own] = Name(meaning, french, latex, about.uses)
    return found


MATRIX = ("matrix", "size", "size")
DISCRETE: dict[str, dict[str, Name]] = {
    "linear": of_action(SQUARE, ALGEBRA, affine=False),
    "affine": of_action(MATRIX, MATRIX, affine=True),
}
"""By the action: meanings and types of the names of the discrete road."""


class Rule(NamedTuple):
    """The name of a rule in French, what a step with it does, in a sentence, and the kind of its
    equations.

    A *definition* says what names are; an *identity* holds at every point of the evolution space, a
    *restriction* for some arguments alone; a *kernel* step is what the variations test, those of
    ``for_all`` in its equations; a *solution* and a *conservation* hold along the motion.
    """

    french: str
    sentence: str
    kind: str


OFF_MOTION = ("definition", "identity", "restriction")
"""The kinds of what holds whether or not a point moves as the equations of motion say."""

TOLD = read([WORDS / "rules.txt"])
RULES = {
    name: Rule(french, unmarked(texts[0]), kind)
    for label, texts in TOLD.items()
    for name, french, kind in [label.split(" | ")]
}


def names() -> Iterator[tuple[str, ...]]:
    """The name of every rule, and its sentence, in English and in French."""
    yield from ((name, rule.french) for name, rule in RULES.items())
    yield from TOLD.values()


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
