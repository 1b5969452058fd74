"""What a trim is, an equilibrium under inputs, exact or enclosed; and the step of a record that
tells it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from ...algebra.groups import Group
from ...language.intervals import characteristic, signs_of_real_parts
from ...language.rational import Matrix
from ...language.tree import Tree
from ...language.univariate import Number, grows, polynomial_tree, routh, tree
from ...record.record import Step
from ...record.sentence import Prose
from ...walk.chapter import Chapter, Draft
from ..equilibria.equilibrium_steps import scientific
from ..equilibria.stability import eigenvalues, polynomial
from .question import Numbers, entries_of


@dataclass(frozen=True)
class Trim:
    """An equilibrium under inputs.  ``state``, ``inputs``: name → number; ``free``: the names of
    those inputs that were found, ``sought``: of the velocities and turns of g; ``matrix``: D of the
    equations linearised in (η, δζ), (2d, 2d), the inputs held; ``resting``: is the velocity 0?
    ``corner``: is a root 0 there, which has no derivative?"""

    state: Numbers
    inputs: Numbers
    free: tuple[str, ...]
    sought: tuple[str, ...]
    matrix: Matrix
    resting: bool
    corner: bool

    @cached_property
    def characteristic(self) -> tuple[Number, ...]:
        """The characteristic polynomial of the matrix, from the highest power."""
        return polynomial(self.matrix)

    @property
    def verdict(self) -> str:
        """What is proved with the inputs held: "stable", by the real parts of all eigenvalues,
        "unstable", or "open" for nothing."""
        if grows(self.characteristic[::-1]):
            return "unstable"
        return "stable" if routh(self.characteristic) > 0 else "open"

    @property
    def eigenvalues(self) -> tuple[complex, ...]:
        """About those of the matrix, in 1/s."""
        return eigenvalues(self.matrix)


@dataclass(frozen=True)
class EnclosedTrim(Trim):
    """One of which is proved that it is the only one within a ``radius`` of ``near``, velocities,
    turns of g and inputs by name, and of the exact numbers of ``start``; decimals of these, and of
    the entries of g that are ``changed``, stand in ``state`` and ``inputs``, and ``matrix`` is one
    of intervals; ``right``: does ξ stand before g?"""

    near: Numbers
    start: Numbers
    changed: tuple[str, ...]
    radius: Fraction
    right: bool

    @cached_property
    def characteristic(self) -> tuple[Number, ...]:
        """About the characteristic polynomial of the matrix, from the highest power."""
        return tuple(x.middle for x in characteristic(self.matrix))

    @property
    def verdict(self) -> str:
        """What is proved with the inputs held: "stable", "unstable" or "open"."""
        found = signs_of_real_parts(characteristic(self.matrix))
        return {"negative": "stable", "positive": "unstable", "unknown": "open"}[found]


def told(trim: Trim, group: Group, steps: Iterable[Step], c: Chapter) -> Step:
    """The equations of motion once more, and what vanishes in them; ``steps``: of the record."""
    by_label = {s.label: s for s in steps}
    motion = next(s for x in ("explicit", "motion") if (s := by_label.get(c.label(x))))
    draft = (c.with_input() if motion.driven else c).draft("trim", "trim")
    draft.depends_on(motion)
    if isinstance(trim, EnclosedTrim):
        return draft.step(motion.equations, _says_enclosed(trim, group, draft))
    return draft.step(motion.equations, _says_exact(trim, group, draft))


def _says_exact(trim: Trim, group: Group, draft: Draft) -> Prose:
    point = _equations(_rows(trim.state, trim, group, ()))
    prose = draft.claim("trim.rest" if trim.resting else "trim.steady", point=point)
    if trim.corner:
        prose += draft.claim("trim.corner")
    if trim.sought:
        names = (*(_named(x, group, trim) for x in (*trim.sought, *trim.free)),)
        turns = any(x not in trim.state for x in trim.sought)
        kind = "trim.isolated_with_turns" if turns else "trim.isolated"
        prose += draft.claim(kind, numbers=("row", *names))
    elif trim.free:
        inputs: Tree = ("row", *(("par", x) for x in trim.free))
        prose += draft.claim("trim.unique", inputs=inputs)
    polynomial = polynomial_tree(trim.characteristic, "λ")
    return prose + draft.claim(f"trim.{trim.verdict}", polynomial=polynomial)


def _says_enclosed(trim: EnclosedTrim, group: Group, draft: Draft) -> Prose:
    near = _equations((_named(x, group, trim), y) for x, y in trim.near.items())
    point, radius = _equations(_rows(trim.start, trim, group, trim.near)), scientific(trim.radius)
    kind = "trim.near_rest" if trim.resting else "trim.near_steady"
    prose = draft.claim(kind, near=near, point=point, radius=radius)
    if trim.changed:
        entries = _equations((_named(x, group, trim), trim.state[x]) for x in trim.changed)
        side = "trim.near_turned_on_the_left" if trim.right else "trim.near_turned"
        prose += draft.claim(side, entries=entries, radius=radius)
    return prose + draft.claim(f"trim.near_{trim.verdict}")


def _equations(rows: Iterable[tuple[Tree, Number]]) -> Tree:
    return ("matrix", *(("row", x, tree(y)) for x, y in rows))


def _rows(
    state: Numbers, trim: Trim, group: Group, near: Collection[str]
) -> list[tuple[Tree, Number]]:
    """The exact numbers that are not those of g = 1, and 0, and all inputs that were found; where
    there are none, those of the velocity, else the first of g."""
    places, d = entries_of(group), group.dimension
    found: list[tuple[Tree, Number]] = []
    for name, x in state.items():
        i, j = places.get(name, (0, 1))
        if x != int(i == j) and name not in near:
            found.append((_named(name, group, trim), x))
    inputs = {n: u for n, u in trim.inputs.items() if n not in near}
    found += [(("par", n), u) for n, u in inputs.items() if u or n in trim.free]
    still = [x for x in [*state][-d:] if x not in near] or [*state][:1]
    return found or [(_named(x, group, trim), state[x]) for x in still]


def _named(name: str, group: Group, trim: Trim) -> Tree:
    """A number of the state as a tree: an entry of A, T, ζ or w; of ξ for a turn of g; an input."""
    places, velocity = entries_of(group), [*trim.state][-group.dimension :]
    if name in trim.inputs:
        return ("par", name)
    if name in places:
        i, j = places[name]
        return ("entry", "T", i + 1) if name.startswith("T_") else ("entry", "A", i + 1, j + 1)
    if name not in velocity:
        return ("entry", "ξ", velocity.index(name.replace("eta", "zeta")) + 1)
    a = velocity.index(name) + 1
    if name.startswith("w"):
        return ("entry", "w", a - len(velocity) + group.n)
    return ("entry", "ζ", a)
