"""The declared symbols of a record against its steps."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from ...algebra.groups import Group
from ...language import rational as q
from ...language.show import show
from ...language.tree import Tree
from ...record.record import ANY_GROUP, Derivation, Equation, RecordError, Step, Symbol
from ...record.vocabulary import Type, Use
from ..values.arithmetic import EvaluationError, is_matrix
from ..values.evaluate import Environment, evaluate, free_indices
from . import well_formedness
from .function_signatures import AT_ONE_TIME, AXIS, HEADS, INDEX_SETS, MOTION, SOLVED, VARIATION
from .hypotheses_checked import IMPOSSIBLE, Verdict, no_sense
from .well_formedness import Usage, definitions, occurrences

RATES: tuple[str, ...] = ("Ȧ", "Ṫ", "α̇", "τ̇", "Ż", "ẇ", "ζ̇", "ℓ̇", "ṗ", "ḣ", "Π̇", "Π̇_o")
RATES += ("ṗ_b", "ℓ̇_b", "Γ̇", "Ẇ", "Υ̇")
"""The names whose value is one on X: rates along the motion."""


INDEX = {x: x for x in INDEX_SETS.values()} | {
    "forces along a distance": "distances",
    AXIS: "basis",
}
"""How a record says what the index of a family counts."""

VARIATIONS = dict.fromkeys(VARIATION.letters, "variation")
VARIATIONS |= dict.fromkeys(AT_ONE_TIME.letters, "variation at one time")
"""The types of names that stand for directions, and have no value in a model."""

CONSTANTS = ("π",)
"""Names that need no symbol."""

Hypotheses = tuple[tuple[Equation, ...], bool]
Places = Mapping[tuple[str, Hypotheses], list[tuple[Group, Environment]]]
Points = Callable[[Step], Iterable[tuple[Group, Environment]]]
Arguments = tuple[Tree, ...]


@dataclass
class NameUses:
    """The uses of a name in one position: for each tuple of arguments, in each scope, the
    hypotheses of one such step. ``general``: is it used in the text about any group?"""

    where: dict[Arguments, dict[str, Hypotheses]] = field(default_factory=dict)
    general: bool = False


def first_fault(d: Derivation, points: Points) -> str:
    """What is wrong with the symbols of a record, in words; "" if nothing is. ``points``: the
    groups and exact points where the checker tries a step."""
    if reason := undeclared(d, (name for name, _ in used(d.steps))):
        return reason
    affine = d.problem.get("action") == "affine"
    heads = (_call(usage, x) for usage, seen in used(d.steps).items() for x in seen.where)
    if reason := next(
        filter(None, (well_formedness.first_fault(t, affine=affine) for t in heads)), ""
    ):
        return reason  # nothing else is evaluated
    return next(filter(None, map(judge(d.steps, points).fault_of, d.symbols)), "")


def undeclared(d: Derivation, occurring: Iterable[str]) -> str:
    """A symbol that is declared twice, or not, or for nothing, by the names that occur; "" if none
    is."""
    listed, names = [s.name for s in d.symbols], dict.fromkeys(occurring)
    for fault, faulty in (
        ("is declared twice", (x for k, x in enumerate(listed) if x in listed[:k])),
        ("is used, and not declared", (x for x in names if x not in listed)),
        ("is declared, and no step uses it", (x for x in listed if x not in names)),
    ):
        if name := next(faulty, ""):
            return f"{name} {fault}"
    return ""


def verdict(d: Derivation, fault: Callable[[], str], tried: Collection[str]) -> Verdict:
    """The verdict on the symbols of a record, by their first fault; ``tried``: where."""
    label = f"{d.name}.symbols"
    try:
        reason = fault()
    except (EvaluationError, RecordError) as error:
        reason = str(error)
    except IMPOSSIBLE as error:
        reason = no_sense(error)
    if reason:
        return Verdict(label, False, reason, 1.0, of="symbol")
    return Verdict(label, True, "", 0.0, (len(d.symbols), (*tried,)), "symbol")


def judge(steps: Sequence[Step], points: Points) -> Judge:
    """The :class:`Judge` of the symbols of some steps; ``points``: where a step is tried."""
    kinds = {(s.scope, _hypotheses(s)): s for s in steps}
    places = {kind: [*points(step)] for kind, step in kinds.items()}
    return Judge(used(steps), definitions(steps), places)


def _hypotheses(step: Step) -> Hypotheses:
    """The hypotheses under which a step holds: what is given, and whether inputs act."""
    return step.given, step.driven


def used(steps: Iterable[Step]) -> dict[Usage, NameUses]:
    """All uses of names in some steps, with the arguments, scopes and hypotheses of each."""
    found: dict[Usage, NameUses] = {}
    for step in steps:
        for side in (x for e in step.equations for x in (e.lhs, e.rhs)):
            for usage, arguments in occurrences(side):
                if usage[0] not in CONSTANTS:
                    here = found.setdefault(usage, NameUses())
                    here.where.setdefault(arguments, {})[step.scope] = _hypotheses(step)
                    here.general |= step.scope == ANY_GROUP
    return found


@dataclass(frozen=True)
class Judge:
    """What the steps do with names: where they use them (``seen``), which equation defines them
    (``defined``), at which points they are tried (``places``)."""

    seen: Mapping[Usage, NameUses]
    defined: Mapping[Usage, tuple[str, Arguments]]
    places: Places
    memo: dict[tuple[int, Tree], list[Any]] = field(default_factory=dict)

    def fault_of(self, symbol: Symbol) -> str:
        """What is wrong with a declared symbol, in words; "" if nothing is."""
        name, uses = symbol.name, symbol.uses
        here = {position for x, position in self.seen if x == name}
        declared = {position_of(use.type) for use in uses}
        if here != declared:
            return f"{name} is used as a {_list(here)}, and declared as a {_list(declared)}"
        for k, use in enumerate(uses):
            if any(x.type == use.type for x in uses[:k]):
                return f"{name} is declared twice as the same"
            if reason := self.fault_of_use(name, use):
                return f"{name}: {reason}"
        return next(filter(None, (self.uncovered(name, x, uses) for x in sorted(here))), "")

    def fault_of_use(self, name: str, use: Use) -> str:
        """What is wrong with one declared use of a name: its type, its defining equation or its
        role; "" if nothing is."""
        usage = (name, position_of(use.type))
        if not [*self.arguments_of_type(usage, use.type)]:
            words = use.type if isinstance(use.type, str) else f"[{', '.join(map(str, use.type))}]"
            return f"type {words:.60} is not that of its values"
        key, arguments = self.defined.get(usage, ("", ()))
        key = key if self.fits(usage, use.type, arguments) else ""
        if use.defined != key:
            wanted, found = (x or "no equation" for x in (key, use.defined))
            return f"{wanted} says first what it is, not {found:.60}"
        role = _role(usage, use.type, key)
        return "" if use.role == role else f"its role is {role!r}, not {use.role!r}"

    def uncovered(self, name: str, position: str, uses: Iterable[Use]) -> str:
        """The first use of a name that none of its declared types covers; "" if there is none."""
        kept = {x for use in uses for x in self.arguments_of_type((name, position), use.type)}
        over = [x for x in self.seen[name, position].where if x not in kept]
        return f"{show(_call((name, position), over[0]))} has none of its types" if over else ""

    def arguments_of_type(self, usage: Usage, type_: Type) -> Iterator[Arguments]:
        """The arguments for which a type is that of a usage; () for what is no function."""
        return (x for x in self.seen[usage].where if self.fits(usage, type_, x))

    def fits(self, usage: Usage, type_: Type, arguments: Arguments) -> bool:
        """Is a type that of a name in some position, at these arguments where it is a function?"""
        name, position = usage
        if position != position_of(type_) or arguments not in self.seen[usage].where:
            return False
        if position in ("member", "moved"):
            if type_[1] != INDEX.get(INDEX_SETS.get(name, "")):
                return False
            type_ = type_[2]
        kinds = type_[1:] if position in ("function", "moved") else (type_,)
        trees = (*arguments, _call(usage, arguments))
        where, general = self.seen[usage].where[arguments], self.seen[usage].general
        return len(kinds) == len(trees) and all(
            x == 0 or self.is_narrowest(kind, x, where, general)
            for kind, x in zip(kinds, trees, strict=True)
        )

    def is_narrowest(
        self, type_: Type, t: Tree, where: Mapping[str, Hypotheses], general: bool
    ) -> bool:
        """Is it the narrowest type of a tree's values at all points where it occurs? Its shape is
        the same under any hypotheses."""
        if isinstance(t, str) and t in VARIATIONS:
            return type_ == VARIATIONS[t]
        places = [at for kind in where.items() for at in self.places[kind]]
        found = [(x, g) for g, env in places for x in self.values(t, env)]
        if not found or not all(_is(type_, x, g, general) for x, g in found):
            return False
        basis = isinstance(t, tuple) and t[0] == "at" and INDEX_SETS.get(t[1]) == AXIS
        if type_ == ("algebra",):  # of one group alone that may be by chance
            return general or basis or self.known_of_any_group(t)
        proper = [(x, g) for x, g in found if len(g.linear_basis) < g.n**2]
        narrower = proper and all(_in_algebra(x, g) for x, g in proper) and (general or basis)
        return type_[0] != "matrix" or not narrower

    def known_of_any_group(self, t: Tree) -> bool:
        """Is it a name that the text about any group uses as well?"""
        return isinstance(t, str) and (t, "value") in self.seen and self.seen[t, "value"].general

    def values(self, t: Tree, env: Environment) -> list[Any]:
        """The values of a tree at a point, by :func:`values`, found once."""
        key = (id(env), t)
        if key not in self.memo:
            self.memo[key] = values(t, env)
        return self.memo[key]


def position_of(type_: Type) -> str:
    """The position of a name of a type in equations: value, member, function or moved."""
    match type_:
        case ("family", _, ("function", *_)):
            return "moved"
        case ("family", _, _):
            return "member"
        case ("function", *_):
            return "function"
    return "value"


def _role(usage: Usage, type_: Type, key: str) -> str:
    """The role of a name in some position; ``key``: of the equation that defines it, or ""."""
    name, position = usage
    if position in ("function", "moved"):
        return "value on X" if HEADS.get(name) == (MOTION,) else "function"
    if name in RATES:
        return "value on X"
    if name in SOLVED:
        return "unknown"
    return "definition" if key else "letter"


def _call(usage: Usage, arguments: Arguments) -> Tree:
    """The tree in which a use stands in equations, with i for an index."""
    name, position = usage
    head: Tree = ("at", name, "i") if position in ("member", "moved") else name
    return ("call", head, *arguments) if position in ("function", "moved") else head


def values(t: Tree, env: Environment) -> list[Any]:
    """The values of a tree for the first value of its indices; all members of a family.

    What an integral is taken of is a function of the place r, here that of the first point.
    """
    if isinstance(t, tuple) and t[0] == "at":
        return [*env.families[t[1]].values()]
    first = {i: 1 for i in free_indices(t) if isinstance(i, str)}
    place = {"r": env.families["r"][1,]} if "r" in env.families else {}
    there = replace(env, names=ChainMap(place, env.names), indices=first)  # type: ignore[arg-type]
    return [evaluate(t, there)]


def _is(type_: Type, x: Any, g: Group, general: bool) -> bool:
    """Is a value of a type? The sizes of the type are n where it is of any group, and numbers
    elsewhere.

    In a product with factors in spaces of several dimensions, "block" is the dimension of any of
    them.
    """
    rows, columns = (len(x), len(x[0])) if is_matrix(x) else (0, 0)

    def size(k: Any) -> int:
        blocks = {factor.n for _, factor in g.places}
        if general:
            return {"n": g.n, "size": g.size}.get(k, -1)
        if k == "block":
            return rows if len(blocks) > 1 and rows in blocks else -1
        return k if type(k) is int else -1

    match type_:
        case "scalar":
            return rows == 0
        case ("vector", n):
            return (rows, columns) == (size(n), 1)
        case ("matrix", n, m):
            return (rows, columns) == (size(n), size(m)) and (columns > 1 or rows == 1)
        case ("algebra",):
            return rows == columns == g.n and _in_algebra(x, g)
    return False


def _in_algebra(x: Any, g: Group) -> bool:
    """Is a value an n × n matrix among the linear parts of 𝔤?"""
    if not is_matrix(x) or not len(x) == len(x[0]) == g.n:
        return False
    if not g.basis:  # su(N), without a table
        return bool(q.trace(x) == 0)
    rows = tuple(q.flatten(e) for e in g.linear_basis)
    return q.rank((*rows, q.flatten(x))) == len(rows)


def _list(words: Iterable[str]) -> str:
    return " and a ".join(sorted(words)) or "nothing"
