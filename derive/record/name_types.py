"""The types of names: what sort of value a name has, and in which role the equations use it."""

from __future__ import annotations

from typing import Any, NamedTuple
from unicodedata import normalize

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

ROLES = ("letter", "definition", "value on X", "unknown", "function")
"""What a name is: chosen freely; defined by an equation; a rate along the motion, or the value of a
variation on X; what exists by a theorem; a function."""


class Use(NamedTuple):
    """One of the ways in which a name is used: m is a number, and m_i a family of numbers.

    ``defined``: in a record, the key of the equation that defines it, or says what it is first.
    """

    type: Type
    role: str
    defined: str = ""


class Name(NamedTuple):
    """What a name means, in English and in French, how LaTeX writes it, and in which ways it is
    used in equations."""

    meaning: str
    french: str
    latex: str
    uses: tuple[Use, ...]


def name(meaning: str, french: str, latex: str, *uses: Use) -> Name:
    """The :class:`Name` of a meaning, with its uses; without any it occurs in sentences alone."""
    return Name(meaning, french, latex, uses)


def letter(type: Type) -> Use:
    """The use of a name that the walk starts from; a step may say later what it is, as for U."""
    return Use(type, "letter")


def defined(type: Type) -> Use:
    """The use of a name that an equation defines."""
    return Use(type, "definition")


def rate(type: Type) -> Use:
    """The use of a name whose value is a rate along the motion."""
    return Use(type, "value on X")


def unknown(type: Type) -> Use:
    """The use of a name that exists by a theorem: a multiplier."""
    return Use(type, "unknown")


def function(*types: Type) -> Use:
    """The use of a name as a function: the types of its arguments, then that of its value."""
    return Use(("function", *types), "function")


def of_X(type: Type) -> Use:
    """The use of a name as the value of a variation on X."""
    return Use(("function", VARIATION, type), "value on X")


def family(index: str, type: Type) -> Type:
    """The type of a family of members of a type, and what their index counts."""
    return ("family", index, type)


def with_derivatives(table: dict[str, Name], varied: str, moving: str) -> dict[str, Name]:
    """A table of names, with δX and δ′X for each X of ``varied`` and the rate Ẋ for each of
    ``moving``, names apart by spaces; what the table says of one itself stays."""
    found: dict[str, Name] = {}
    for x in varied.split():
        latex, use = table[x].latex, letter(table[x].uses[0].type)
        told = f"variation of {x}", f"variation de {x}"
        found[f"δ{x}"] = name(*told, _of(r"\delta", latex), use)
        told = f"variation δ′ of {x}", f"variation δ′ de {x}"
        found[f"δ′{x}"] = name(*told, _of(r"\delta'", latex), use)
    for x in moving.split():
        told = f"d{x}/dt along the motion", f"d{x}/dt le long du mouvement"
        rates = (rate(use.type) for use in table[x].uses)
        dotted = normalize("NFC", f"{x[0]}\u0307{x[1:]}")
        found[dotted] = name(*told, _of(r"\dot", table[x].latex), *rates)
    return found | table


def _of(mark: str, latex: str) -> str:
    """The LaTeX of a name behind a mark."""
    return f"{mark}{latex}" if latex.startswith("\\") else f"{mark} {latex}"
