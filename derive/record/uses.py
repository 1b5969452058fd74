"""The uses of names in the steps of a record, and the equation that defines each.

A use is a name and the position in which it stands: as a value, as the members of a family (m_i),
as a function (ϖ(δy)) or as a family of functions (r_i(t)).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from ..language.show import FIELD_OPERATORS
from ..language.tree import Tree
from .record import ANY_GROUP, FIELDS, Equation, Step
from .vocabulary import ALGEBRA, SCALAR, SQUARE, VECTOR, VOCABULARY, Name, Type, Use

Usage = tuple[str, str]
"""A name and the position in which it stands: "value", "member", "function" or "moved"."""


TREE_OPERANDS: dict[str, Any] = {
    "entry": lambda t: t[1:2],
    **dict.fromkeys(("sum", "fun", "call"), lambda t: t[2:]),
}
"""Operator → its operands that are trees, for operators where not all are."""


class Occurrence(NamedTuple):
    """A use of a name in an equation, with the arguments where it is that of a function."""

    usage: Usage
    arguments: tuple[Tree, ...] = ()


def occurrences(t: Tree) -> list[Occurrence]:
    """The uses of names in a tree, from left to right; parameters and indices are none."""
    found: list[Occurrence] = []
    _collect(t, found)
    return found


def _collect(t: Tree, found: list[Occurrence]) -> None:
    """Append the uses in a tree to ``found``."""
    if isinstance(t, str):
        found.append(Occurrence((t, "value")))
    elif isinstance(t, tuple) and t[0] == "at":
        found.append(Occurrence((t[1], "member")))
    elif isinstance(t, tuple) and t[0] != "par":
        if t[0] == "call":
            # a function, or a member of a family of functions
            head: Usage = (t[1], "function") if isinstance(t[1], str) else (t[1][1], "moved")
            found.append(Occurrence(head, t[2:]))
        for part in TREE_OPERANDS.get(t[0], lambda x: x[1:])(t):
            if isinstance(part, (str, tuple)):
                _collect(part, found)


def position_of(type_: Type) -> str:
    """The position in which a name of this type stands in equations."""
    if type_[0] == "family":
        return "moved" if type_[2][0] == "function" else "member"
    return "function" if type_[0] == "function" else "value"


class ReadEquation(NamedTuple):
    """An equation of a step with its key, its scope, and the uses on its two sides in order.

    ``told``: is it given as well?
    """

    scope: str
    key: str
    equation: Equation
    told: bool
    left: dict[Occurrence, None]
    right: dict[Occurrence, None]


def read_equations(steps: Iterable[Step]) -> list[ReadEquation]:
    """The equations of some steps, with their uses."""

    def side(t: Tree) -> dict[Occurrence, None]:
        return dict.fromkeys(occurrences(t))

    return [
        ReadEquation(step.scope, key, e, e in step.given, side(e.lhs), side(e.rhs))
        for step in steps
        for key, e in zip(step.keys, step.equations, strict=True)
    ]


def of_steps(
    steps: Iterable[Step], meant: Mapping[str, Name], sizes: Mapping[str, int]
) -> dict[str, tuple[Use, ...]]:
    """Name → its declared uses in some steps, in the order in which the names occur.

    ``meant``: all uses that each name may have. ``sizes``: the values of n and d, for what only the
    text about the problem's group has.
    """
    equations = read_equations(steps)
    listed = [(e.scope, x) for e in equations for x in (*e.left, *e.right)]
    general = {x.usage for scope, x in listed if scope == ANY_GROUP}
    found = definitions(equations, meant)
    seen: dict[str, dict[Occurrence, None]] = {}
    for _, x in listed:
        if x.usage[0] in meant:
            seen.setdefault(x.usage[0], {})[x] = None

    def use(name: str, kept: Use) -> Use:
        usage = (name, position_of(kept.type))
        sized = {k: x for k, x in sizes.items() if k not in ("n", "size") or usage not in general}
        key, occurring = found.get(usage, ("", Occurrence(usage)))
        key = key if _fits(name, kept, [occurring], meant) else ""
        role = ("definition" if key else "letter") if kept.role in DECIDED_ROLES else kept.role
        return Use(with_sizes(kept.type, sized), role, key)

    return {
        name: tuple(use(name, x) for x in meant[name].uses if _fits(name, x, occurring, meant))
        for name, occurring in seen.items()
    }


DECIDED_ROLES = ("letter", "definition")
"""The two roles between which the steps decide, by whether an equation defines the name."""


def with_sizes(type_: Type, sizes: Mapping[str, int]) -> Type:
    """A type with the letters of its sizes replaced by numbers, as far as ``sizes`` has them."""
    if isinstance(type_, str):
        return type_
    inside = (sizes.get(x, x) if isinstance(x, str) else with_sizes(x, sizes) for x in type_[1:])
    return (type_[0], *inside)


def _fits(name: str, use: Use, occurring: Iterable[Occurrence], meant: Mapping[str, Name]) -> bool:
    """Does a name occur as declared: in its position, and as a function of its arguments' types?"""
    usage = (name, position_of(use.type))
    if usage[1] != "function":
        return any(x.usage == usage for x in occurring)
    kinds = tuple(use.type[1:-1])
    taken = (x.arguments for x in occurring if x.usage == usage)
    return any(
        len(xs) == len(kinds)
        and all(x == 0 or type_of(x, meant) == k for x, k in zip(xs, kinds, strict=True))
        for xs in taken
    )


def type_of(argument: Tree, meant: Mapping[str, Name] = VOCABULARY) -> Type:
    """The type of a function's argument: a name, a product with A, r r̄, r_i(t), or a number; or of
    what is made of fields."""
    if isinstance(argument, str):
        return next(x.type for x in meant[argument].uses if position_of(x.type) == "value")
    if not isinstance(argument, tuple) or _is_number(argument):
        return SCALAR
    last = argument[-1]
    if argument[0] == "call" and argument[1] in FIELD_OPERATORS:
        return meant[argument[1]].uses[0].type[-1]
    if argument[0] == "call":
        return SCALAR if argument[1] in ("ϖ", "ω̂") else _value_of(argument[1])
    if argument[0] in ("inner", "norm2", "metric"):
        return SCALAR
    if argument[0] == "add":
        return type_of(argument[1], meant)
    if isinstance(last, tuple) and last[:1] == ("call",) and last[1] in FIELD_OPERATORS:
        return type_of(last, meant)
    if isinstance(last, tuple):
        return SQUARE
    inside = type_of(last, meant)
    return SQUARE if inside == ALGEBRA else inside


def _is_number(t: Tree) -> bool:
    """Is a tree made of numbers, parameters, entries and members Π_a?"""
    if not isinstance(t, tuple):
        return not isinstance(t, str) or t == "π"
    if t[0] in ("add", "mul", "div", "pow"):
        return all(map(_is_number, t[1:]))
    return t[0] in ("par", "entry") or t[:2] in (("at", "Π"), ("at", "𝒥"))


def _value_of(head: Tree) -> Type:
    """The type of the values of a family of functions; that of a place for any other function."""
    uses = VOCABULARY[head[1]].uses if isinstance(head, tuple) else ()
    return next((x.type[2][-1] for x in uses if position_of(x.type) == "moved"), VECTOR)


def definitions(
    equations: Iterable[ReadEquation], meant: Mapping[str, Name]
) -> dict[Usage, tuple[str, Occurrence]]:
    """Use → the key of the equation that defines it, and how it occurs there; of a family that is
    listed, of its first member.

    A use is defined where it stands alone on the left; or is new and alone on the right, as in Z =
    j(ζ), or the one new name of a pairing or a sum: Z = Σ ζ_a E_a; or a coefficient of a variation.
    """
    listed = [(x, position_of(y.type), y.role) for x, about in meant.items() for y in about.uses]
    known = {(x, position) for x, position, role in listed if role != "definition"}
    allowed = {(x, position) for x, position, _ in listed}
    found: dict[Usage, tuple[str, Occurrence]] = {}
    for e in equations:
        if e.told and e.equation.lhs in FIELDS:
            continue
        left, right = lone_occurrence(e.equation.lhs), lone_occurrence(e.equation.rhs)
        if left and left.usage not in {x.usage for x in e.right}:
            found.setdefault(left.usage, (e.key, left))
        if right and right.usage not in known:
            found.setdefault(right.usage, (e.key, right))
        known |= {x.usage for x in (left, right) if x}
        both = (e.equation.lhs, e.equation.rhs)
        new = {x.usage for x in (*e.left, *e.right)} & allowed - known
        told = any({x for x, _ in new} <= paired(x) for x in both)
        if told or (len(new) == 1 and any(map(_is_pairing, both))):
            for usage in new:
                found.setdefault(usage, (e.key, Occurrence(usage)))
            known |= new
    return found


def lone_occurrence(t: Tree) -> Occurrence | None:
    """The use that is all of a tree, also under j, a bar, an inverse, as an entry; or ``None``."""
    while isinstance(t, tuple) and t[0] in ("hat", "T", "inv", "entry"):
        t = t[1]
    alone = isinstance(t, str) or (isinstance(t, tuple) and t[0] in ("at", "call"))
    return occurrences(t)[0] if alone else None


def paired(t: Tree) -> set[str]:
    """The names that a sum pairs each with a variation of its own: they are its coefficients."""
    summed = t[1:] if isinstance(t, tuple) and t[0] == "add" else (t,)
    pairs = [x[1:] for x in summed if isinstance(x, tuple) and x[0] == "inner"]
    partners = [y for _, y in pairs]
    return {x for x, y in pairs if isinstance(x, str) and partners.count(y) == 1}


def _is_pairing(t: Tree) -> bool:
    """Is the tree an inner product or a sum?"""
    return isinstance(t, tuple) and t[0] in ("inner", "metric", "sum")
