"""A problem in which every number is a parameter of its own: what a fault in code may change."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from ..language.tree import Tree, add, mul, neg, replaced
from ..language.values import approximate
from ..problem.problem import Problem
from ..schema.body_kinds import GivenBody, MomentBody, Moments, PointBody
from ..schema.kind import Parameter
from ..schema.table import Table


@dataclass(frozen=True)
class Slot:
    """A number of a problem: the ``name`` of its parameter, the ``tree`` that it is, in words the
    ``key`` that it is an entry of, and itself."""

    name: str
    tree: Tree
    key: str
    words: str


@dataclass(frozen=True)
class Opened:
    """The problem with a parameter for each of its ``slots``, and as it was ``given``; ``central``:
    are those of its body the centre of mass and the tensor about it?"""

    problem: Problem
    slots: tuple[Slot, ...]
    given: Problem
    central: bool = False

    def entries(self, key: str) -> list[str]:
        """The parameters that stand for the entries of a key."""
        return [x.name for x in self.slots if x.key == key]

    def vectors(self, values: Mapping[str, float]) -> dict[str, list[str]]:
        """Each key in words → the parameters that stand for those of its entries that are not 0."""
        found: dict[str, list[str]] = {}
        for x in self.slots:
            if values[x.name]:
                found.setdefault(x.key, []).append(x.name)
        return found

    def values(self, parameters: Mapping[str, float]) -> dict[str, float]:
        """All parameters by name, for those of the problem that was opened; ``ValueError`` where
        a number has no value."""
        known = dict(parameters)
        for x in self.slots:
            found = approximate(x.tree, parameters, float)
            if found is None:
                raise ValueError(f"{x.words} has no value at these parameters")
            known[x.name] = found
        return known


class Opening:
    """Makes slots of the numbers of tables."""

    def __init__(self, problem: Problem, parameters: Mapping[str, float]):
        self.problem, self.parameters = problem, parameters
        self.slots: list[Slot] = []

    def slot(self, tree: Tree, key: str, words: str) -> Tree:
        """The parameter that stands for a number; a function of the state stays as it is."""
        if approximate(tree, self.parameters, float) is None:
            return tree
        name = f"slot_{len(self.slots) + 1}"
        self.slots.append(Slot(name, tree, key, words))
        return ("par", name)

    def table(self, table: Any, of: str) -> Any:
        """A table with parameters for its numbers; ``of``: whose it is, in words."""
        changed = {}
        for name, about, value in table.values():
            if about.trees:
                changed[name] = self._entries(value, about.depth, f"{name} of {of}", name, of)
        if wind := getattr(table, "relative_to", ()):
            for v, other in self._blown(table, wind, of):
                for name in table.expressed:
                    changed[name] = tuple(replaced(t, v, other) for t in changed[name])
        return replace(table, **changed)

    def _blown(self, x: Any, wind: Any, of: str) -> Iterator[tuple[Tree, Tree]]:
        """The velocities of a place, from which a wind w is taken, as v + w − s, s its slot: a
        number of its own, or where w is a function its factor times w."""
        block, _ = self.problem.acted_on(x)
        first = self.problem.own_group.places[block - 1][0]
        key = f"relative_to of {of}"
        for k, w in enumerate(wind, 1):
            s = self.slot(w, key, words := f"relative_to_{k} of {of}")
            if s == w:
                s = mul(self.slot(1, key, words), w)
            v = ("entry", ("at", "v", x.on), first + k)
            yield v, add(v, w, neg(s))

    def _entries(self, value: Any, depth: int, key: str, words: str, of: str) -> Any:
        if value is None or not depth:
            return value if value is None else self.slot(value, key, f"{words} of {of}")
        mark = "" if words[-1].isdigit() else "_"
        pairs = enumerate(value, 1)
        return tuple(self._entries(x, depth - 1, key, f"{words}{mark}{i}", of) for i, x in pairs)

    def moments(self, given: Moments, turns: bool) -> Moments:
        """Of a body: the mass, the first moment or the centre, J or the tensor of inertia, of one
        that ``turns`` in the plane the number I."""
        n, central = len(given.c), given.central
        span = range(n)
        m = self.slot(given.m, "mass", "the mass m")
        c, J = given.c, given.J
        if central:
            c = tuple(div(x, given.m) for x in c)
            J = _shifted(J, c, neg(given.m))
        first = "centre" if central else "c"
        own = tuple(self.slot(x, first, f"{first}_{i}") for i, x in enumerate(c, 1))
        letter = "I_centre" if central else "I" if turns else "J"
        if letter == "J":
            rows = self._tensor(J, letter)
        elif n == 3:
            rows = _other(self._tensor(_other(J, 1), letter), Fraction(1, 2))
        else:
            half = div(self.slot(add(J[0][0], J[1][1]), letter, letter), 2)
            rows = tuple(tuple(half if i == j else 0 for j in span) for i in span)
        if central:
            rows, own = _shifted(rows, own, m), tuple(mul(m, x) for x in own)
        return Moments(m=m, c=own, J=rows, central=given.central)

    def _tensor(self, given: Any, letter: str) -> Any:
        """A symmetric matrix with a slot for each number."""
        made: dict[tuple[int, int], Tree] = {}
        for i, row in enumerate(given):
            for j in range(i, len(row)):
                key = f"{letter} on the diagonal" if i == j else f"{letter} off the diagonal"
                entry = self.slot(row[j], key, f"{letter}_{i + 1}{j + 1}")
                made[i, j] = made[j, i] = entry
        return tuple(tuple(made[i, j] for j in range(len(given))) for i in range(len(given)))


def div(a: Tree, b: Tree) -> Tree:
    """A quotient."""
    return ("div", a, b)


def _shifted(J: Any, c: Any, m: Tree) -> Any:
    """J + m c c̄."""
    span = range(len(c))
    return tuple(tuple(add(J[i][j], mul(m, c[i], c[j])) for j in span) for i in span)


def _other(J: Any, half: int | Fraction) -> Any:
    """(Tr J)1 − J of J, with 1; J = ½(Tr I)1 − I of I, with ½."""
    span = range(len(J))
    trace = mul(half, add(*(J[i][i] for i in span)))
    return tuple(tuple(add(*([trace] if i == j else []), neg(J[i][j])) for j in span) for i in span)


def opened(problem: Problem, parameters: Mapping[str, float]) -> Opened:
    """The problem with a parameter for every number of its body, forces, inputs and damping;
    ``parameters``: the values of its own."""
    problem = replace(problem, outputs=(), events=())
    made = Opening(problem, parameters)
    body, masses = problem.body, problem.masses
    turning = ("SO(2)", "SE(2)", "SO(3)", "SE(3)")
    turns, central = problem.group is not None and problem.group.name in turning, False
    if isinstance(body, PointBody):
        points = (made.table(x, f"point {k}") for k, x in enumerate(body.points, 1))
        body = replace(body, points=tuple(points))
    elif isinstance(body, GivenBody | MomentBody) and not masses:
        given = body.moments()
        central = given.central
        own = made.moments(given, turns)
        body = GivenBody(given=own, solids=body.solids if isinstance(body, GivenBody) else ())

    def each(tables: tuple[Any, ...], word: Callable[[int, Any], str]) -> tuple[Any, ...]:
        return tuple(made.table(x, word(k, x)) for k, x in enumerate(tables, 1))

    lagrangian = problem.lagrangian
    if lagrangian and problem.group and problem.group.dimension <= ENTRIES:
        more = quadratic(problem.group.dimension, made)
        lagrangian = replace(lagrangian, L=add(lagrangian.L, *more))
    acting: dict[int, str] = {}
    for x in (*problem.inputs, *problem.forces, *problem.damping, *problem.potentials):
        named = getattr(x, "on", ())
        for i in named if isinstance(named, tuple) else (named,):
            acting.setdefault(i, called(problem, x))
    replaced = replace(
        problem,
        body=body,
        lagrangian=lagrangian,
        potentials=each(problem.potentials, lambda _, x: called(problem, x)),
        inputs=each(problem.inputs, lambda _, x: called(problem, x)),
        damping=each(problem.damping, lambda _, x: called(problem, x)),
        forces=each(problem.forces, lambda _, x: called(problem, x)),
        places=each(problem.places, lambda k, _: acting.get(masses + k, f"place {k}")),
    )
    slots = {x.name: Parameter() for x in made.slots}
    whole = replace(replaced, parameters={**problem.parameters, **slots})
    return Opened(whole, tuple(made.slots), problem, central)


ENTRIES = 6
"""A kinetic energy of so many coordinates at most is opened entry by entry."""


ADDED = "what is added to "


def quadratic(d: int, made: Opening) -> list[Tree]:
    """What may be added to the entries of the operator of inertia, as terms of ℓ, each 0."""
    zeta = [("entry", "ζ", a) for a in range(1, d + 1)]
    pairs = [(a, b) for a in range(d) for b in range(a, d)]
    return [
        mul(
            Fraction(1, 2) if a == b else 1,
            made.slot(0, "operator", f"{ADDED}operator_{a + 1}{b + 1}"),
            zeta[a],
            zeta[b],
        )
        for a, b in pairs
    ]


def called(problem: Problem, table: Table) -> str:
    """A force of a problem in words."""
    if table in problem.inputs:
        return f"the input {table.plain()['name']}"
    acting = (*problem.forces, *problem.damping)
    if getattr(table, "table", "") == "flow":
        return "what flows inside"
    for word in ("force", "damping", "flow"):
        tables = [x for x in acting if (getattr(x, "table", "") or x.section).startswith(word)]
        if table not in tables:
            continue
        name = getattr(table, "name", None)
        if len(tables) > 1 and not name:
            return f"{word} {tables.index(table) + 1}"
        given = [x for x in getattr(table, "expressed", ()) if getattr(table, x)]
        word = given[0] if (word, len(given)) == ("force", 1) else word
        return f"the {word} {name}" if name else f"the {word}"
    kind = table.kind.replace("_", " ")
    same = [x for x in problem.potentials if x.kind == table.kind]
    return f"{kind} {[*map(id, same)].index(id(table)) + 1}" if len(same) > 1 else kind
