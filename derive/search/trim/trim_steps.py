"""The step of a record that tells an equilibrium under inputs."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from ...algebra.groups import Group
from ...language.tree import Tree
from ...language.univariate import Number, polynomial_tree, tree
from ...record.record import Step
from ...record.sentence import Prose
from ...walk.chapter import Chapter, Draft
from ..equilibria.equilibrium_steps import scientific
from .question import Numbers, entries_of
from .trim import EnclosedTrim, Trim


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
    there are none, the first of the velocity, else of g."""
    places, d = entries_of(group), group.dimension
    found: list[tuple[Tree, Number]] = []
    for name, x in state.items():
        i, j = places.get(name, (0, 1))
        if x != int(i == j) and name not in near:
            found.append((_named(name, group, trim), x))
    inputs = {n: u for n, u in trim.inputs.items() if n not in near}
    found += [(("par", n), u) for n, u in inputs.items() if u or n in trim.free]
    exact = (x for x in [*[*state][-d:], *state] if x not in near)
    first = next(exact)
    return found or [(_named(first, group, trim), state[first])]


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
