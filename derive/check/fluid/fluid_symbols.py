"""The declared symbols of a record about a fluid against its steps."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ...language.tree import Tree
from ...record.names import Type, Use
from ...record.record import Derivation, Step
from ..definitions import Usage, definitions, occurrences

_PRIMITIVE = """
    U V Ũ dŨ u v η η′ δu δ′u u̇ ν ν̇ δg δ′g δν δ′ν ġ G D grad div Δ ∇ ∂ₙ n ρ ρ̇ ρ_0 ϑ ϑ̇
    δt δ′t δy δ′y X δ δ′ d/dt ∫ Γ_0 Γ̇ γ_s γ̇ ∂_s κ κ̇
    """
PRIMITIVE = frozenset(_PRIMITIVE.split())
"""The names that the walk of a fluid starts from."""
RATES = ("u̇", "ν̇", "ġ", "ρ̇", "ϑ̇", "Γ̇", "γ̇", "κ̇")
UNKNOWN = "p"
"""What an equation says to exist, and none defines."""
VARIATIONS = {"δy": "variation", "δ′y": "variation", "X": "variation"}
Kinds = Callable[[Step, Tree], str]


def first_fault(d: Derivation, kinds: Kinds) -> str:
    """What is wrong with the symbols of a record, in words; "" if nothing is. ``kinds``: the type
    of a tree at a point where a step is tried."""
    seen = used(d.steps)
    listed, known = [s.name for s in d.symbols], dict.fromkeys(x for x, _ in seen)
    for fault, faulty in (
        ("is declared twice", (x for k, x in enumerate(listed) if x in listed[:k])),
        ("is used, and not declared", (x for x in known if x not in listed)),
        ("is declared, and no step uses it", (x for x in listed if x not in known)),
    ):
        if name := next(faulty, ""):
            return f"{name} {fault}"
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
