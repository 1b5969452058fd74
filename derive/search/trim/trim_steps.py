"""The step of a record that tells an equilibrium under inputs."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from ...algebra.groups import Group
from ...language.tree import Tree
from ...language.univariate import Number, polynomial_tree, tree
from ...record.record import Step
from ...walk.chapter import Chapter
from .trimmed import Trim, entries_of


def told(trim: Trim, group: Group, steps: Iterable[Step], c: Chapter) -> Step:
    """The equations of motion once more, and what vanishes in them; ``steps``: of the record."""
    by_label = {s.label: s for s in steps}
    motion = next(s for x in ("explicit", "motion") if (s := by_label.get(c.label(x))))
    draft = (c.with_input() if motion.driven else c).draft("trim", "trim")
    draft.depends_on(motion)
    point = ("matrix", *(("row", x, tree(y)) for x, y in _rows(trim, group)))
    prose = draft.claim("trim.rest" if trim.resting else "trim.steady", point=point)
    if trim.corner:
        prose += draft.claim("trim.corner")
    if trim.sought:
        places, velocity = entries_of(group), [*trim.state][-group.dimension :]
        names = (*(_named(x, places, velocity, group) for x in trim.sought),)
        names += (*(("par", x) for x in trim.free),)
        turns = any(x not in trim.state for x in trim.sought)
        kind = "trim.isolated_with_turns" if turns else "trim.isolated"
        prose += draft.claim(kind, numbers=("row", *names))
    elif trim.free:
        inputs: Tree = ("row", *(("par", x) for x in trim.free))
        prose += draft.claim("trim.unique", inputs=inputs)
    polynomial = polynomial_tree(trim.characteristic, "λ")
    prose += draft.claim(f"trim.{trim.verdict}", polynomial=polynomial)
    return draft.step(motion.equations, prose)


def _rows(trim: Trim, group: Group) -> list[tuple[Tree, Number]]:
    """The numbers that are not those of g = 1, and 0, and all inputs that were found; where there
    are none, the first of the velocity."""
    places, d = entries_of(group), group.dimension
    velocity = [*trim.state][-d:]
    found: list[tuple[Tree, Number]] = []
    for name, x in trim.state.items():
        i, j = places.get(name, (0, 1))
        if x != int(i == j):
            found.append((_named(name, places, velocity, group), x))
    found += [(("par", n), u) for n, u in trim.inputs.items() if u or n in trim.free]
    return found or [(_named(velocity[0], places, velocity, group), Fraction(0))]


def _named(
    name: str, places: dict[str, tuple[int, int]], velocity: list[str], group: Group
) -> Tree:
    """A number of the state as a tree: an entry of A, T, ζ or w; of ξ for a turn of g."""
    if name in places:
        i, j = places[name]
        return ("entry", "T", i + 1) if name.startswith("T_") else ("entry", "A", i + 1, j + 1)
    if name not in velocity:
        return ("entry", "ξ", velocity.index(name.replace("eta", "zeta")) + 1)
    a = velocity.index(name) + 1
    if name.startswith("w"):
        return ("entry", "w", a - len(velocity) + group.n)
    return ("entry", "ζ", a)
