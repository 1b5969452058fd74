"""The step of a record that tells a trim, exact or enclosed."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from ...algebra.groups import Group
from ...language.tree import Tree
from ...language.univariate import Number, polynomial_tree, tree
from ...problem.fields import element, entry_places
from ...record.record import Step
from ...record.sentence import Prose
from ...walk.chapter import Chapter, Draft
from .equilibrium_steps import decimal, scientific
from .positions import axes_that_stay
from .stability import eigenvalues_within
from .trim import EnclosedTrim, Numbers, Trim


def told(trim: Trim, group: Group, steps: Iterable[Step], c: Chapter) -> Step:
    """The equations of motion once more, and what vanishes in them; ``steps``: of the record."""
    by_label = {s.label: s for s in steps}
    motion = next(s for x in ("explicit", "motion") if (s := by_label.get(c.label(x))))
    draft = (c.with_input() if motion.driven else c).draft("trim", "trim", motion)
    if isinstance(trim, EnclosedTrim):
        return draft.step(motion.equations, _says_enclosed(trim, group, draft))
    return draft.step(motion.equations, _says_exact(trim, group, draft))


def _says_exact(trim: Trim, group: Group, draft: Draft) -> Prose:
    point = _equations(_rows(trim.state, trim, group, ()))
    Z = group.in_user_basis.hat([*_velocity(trim, group).values()])
    prose = axes_that_stay(element(group, trim.state), Z, group, draft)
    prose += draft.claim("trim.rest" if trim.resting else "trim.steady", point=point)
    if trim.corner:
        prose += draft.claim("trim.corner")
    if trim.sought:
        names = (*(_named(x, group, trim) for x in (*trim.sought, *trim.free)),)
        turns = any(x not in trim.state for x in trim.sought)
        kind, more = "trim.isolated_with_turns" if turns else "trim.isolated", {}
        if turns and trim.along:
            kind, more = "trim.isolated_along", {"along": _along(trim, group)}
        prose += draft.claim(kind, numbers=("row", *names), **more)
    elif trim.free:
        inputs: Tree = ("row", *(("par", x) for x in trim.free))
        prose += draft.claim("trim.unique", inputs=inputs)
    polynomial = polynomial_tree(trim.characteristic, "λ")
    return prose + draft.claim(f"trim.{trim.verdict}", polynomial=polynomial)


def _says_enclosed(trim: EnclosedTrim, group: Group, draft: Draft) -> Prose:
    near = _equations((_named(x, group, trim), y) for x, y in trim.near.items())
    point, radius = _equations(_rows(trim.start, trim, group, trim.near)), scientific(trim.radius)
    kind, more = "trim.near_rest" if trim.resting else "trim.near_steady", {}
    if trim.along:
        kind, more = "trim.near_along", {"along": _along(trim, group)}
    prose = draft.claim(kind, near=near, point=point, radius=radius, **more)
    told = {x: decimal(y, trim.radius) for x, y in trim.state.items()}
    if trim.changed:
        entries = _equations((_named(x, group, trim), told[x]) for x in trim.changed)
        side = "trim.near_turned_on_the_left" if trim.right else "trim.near_turned"
        prose += draft.claim(side, entries=entries, radius=radius)
    if trim.along:
        moving = [(_named(x, group, trim), told[x]) for x in _velocity(trim, group) if told[x]]
        prose += draft.claim("trim.near_velocity", entries=_equations(moving), radius=radius)
    prose += draft.claim(f"trim.near_{trim.verdict}")
    return prose + _says_eigenvalues(trim, draft)


def _says_eigenvalues(trim: EnclosedTrim, draft: Draft) -> Prose:
    radius, values = eigenvalues_within(trim.matrix)
    if not values:
        return Prose()
    rows = tuple(("row", tree(re), tree(im)) for re, im in values)
    others = len(trim.matrix) - sum(1 + bool(im) for _, im in values)
    told: dict[str, Tree] = {"eigenvalues": ("matrix", *rows), "radius": scientific(radius)}
    return draft.claim("trim.near_eigenvalues", **told, others=others)


def _velocity(trim: Trim, group: Group) -> dict[str, Number]:
    return dict([*trim.state.items()][-group.dimension :])


def _along(trim: Trim, group: Group) -> Tree:
    return _equations((_named(x, group, trim), y) for x, y in trim.along.items())


def _equations(rows: Iterable[tuple[Tree, Number]]) -> Tree:
    return ("matrix", *(("row", x, tree(y)) for x, y in rows))


def _rows(
    state: Numbers, trim: Trim, group: Group, near: Collection[str]
) -> list[tuple[Tree, Number]]:
    """The exact numbers that are not those of g = 1, and 0, and all inputs that were found; where
    there are none, those of the velocity, else the first of g."""
    places = entry_places(group)
    found: list[tuple[Tree, Number]] = []
    for name, x in state.items():
        i, j = places.get(name, (0, 1))
        if x != int(i == j) and name not in near:
            found.append((_named(name, group, trim), x))
    inputs = {n: u for n, u in trim.inputs.items() if n not in near}
    found += [(("par", n), u) for n, u in inputs.items() if u or n in trim.free]
    still = [x for x in _velocity(trim, group) if x not in near] or [*state][:1]
    return found or [(_named(x, group, trim), state[x]) for x in still]


def _named(name: str, group: Group, trim: Trim) -> Tree:
    """A number of the state as a tree: an entry of A, T, ζ or w; of ξ for a turn of g; an input."""
    places, velocity = entry_places(group), [*_velocity(trim, group)]
    if name in trim.inputs:
        return ("par", name)
    if name in places:
        i, j = places[name]
        return ("entry", "T", i + 1) if name.startswith("T_") else ("entry", "A", i + 1, j + 1)
    if name not in velocity:
        return ("entry", "ξ", int(name.removeprefix("eta_")))
    a = velocity.index(name) + 1
    if name.startswith("w"):
        return ("entry", "w", a - len(velocity) + group.n)
    return ("entry", "ζ", a)
