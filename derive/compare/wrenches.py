"""What may be otherwise in a force with its moment: the axes of its numbers, its arm, the velocity
that it is made of, the sizes |x| in it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from ..code.naming import plain_text, typed
from ..language.show import show
from ..language.tree import Tree, add, mul, nodes, replaced, sized
from ..language.values import approximate
from ..problem.fields import velocity_at_place
from ..schema.force_kinds import StatedForce
from ..schema.kind import Parameter
from .balance import EXACT, Balance, Term
from .cross_products import cross, through, turning
from .opened import called
from .told import NEAR, Hypothesis
from .users_code import Array

View = tuple[str, Array]


def of_wrenches(b: Balance, terms: list[Term]) -> Iterator[Hypothesis]:
    """All of these, of the terms by themselves and of all inputs together."""
    for term in terms:
        yield from of_wrench(b, term)
    yield from of_all_wrenches(b, terms)


def of_wrench(b: Balance, term: Term) -> Iterator[Hypothesis]:
    """Those of one term: but for what it leaves, they are made of the term, of the centre of mass
    and of the states alone."""
    yield from of_attitude(b, [term])
    yield from of_arms(b, [term])
    if b.is_frame:
        yield from of_frames(b, [term], term.name)
        yield from of_speeds(b, term)


def of_all_wrenches(b: Balance, terms: list[Term]) -> Iterator[Hypothesis]:
    """Those of all inputs, or of all that acts at a place, together."""
    yield from of_arms(b, terms, together=True)
    inputs = [x for x in terms if x.is_input]
    for both in b.together() if inputs and b.is_frame else ():
        yield from of_frames(b, inputs, both.name)


def of_axes(b: Balance, term: Term, view: View) -> Iterator[Hypothesis]:
    """The numbers of a force or a moment are taken along the axes of the other frame."""
    (about, to), A = view, b.turns()
    here, values, back = through(to, b.unexplained), through(to, term.values), np.linalg.inv(to)
    for rows in b.rows.values():
        if len(rows) != A.shape[1]:
            continue
        own, kind = values[:, rows], b.kind(rows)
        called = term.name(kind) + about * (kind == "moment")
        inverse = A.transpose(0, 2, 1)
        turns = {
            "has its numbers along the axes of space instead": inverse,
            "has its numbers along the axes of the body instead": A,
            "is turned by Ā, the transpose of the attitude, and not by A": inverse @ inverse,
        }
        for words, R in turns.items():
            left = here.copy()
            left[:, rows] -= turned(R)(own) - own
            yield Hypothesis(f"{called} {words}", 0, through(back, left))


def of_attitude(b: Balance, terms: list[Term]) -> Iterator[Hypothesis]:
    """A vector of space is turned by A, not by its transpose, in a force or an input."""
    here, there = b.unexplained, b.transposed()
    for term in terms:
        if there is not None and term.at is not None:
            left = here - (term.at(there) - term.values)
            yield Hypothesis(f"{term.name('')} {BY_A}", 0, left)


BY_A = "is turned by A and not by Ā, the transpose of the attitude"


Turn = Callable[[Array], Array]


def couple_and_force(values: Array, arm: Array) -> tuple[Array, Array]:
    """The couple, which no arm makes, and the force of a force with its moment, (N, d)."""
    n = arm.shape[-1]
    return values[:, :-n] - cross(arm, values[:, -n:]), values[:, -n:]


def changed_force(own: Array, other: Array, arm: Array, kind: str, to: Turn) -> Array:
    """A force with its moment whose force at an arm, or couple, or both are those of an ``other``,
    turned in space."""
    (couple, force), (moment, there) = (couple_and_force(x, arm) for x in (own, other))
    if kind != "moment":
        force = to(there)
    if kind != "force":
        couple = to(moment) if moment.shape[1] == 3 else moment
    return np.hstack([couple + cross(arm, force), force])


def turned(R: Array) -> Turn:
    """What turns vectors at each state."""
    return lambda vectors: np.einsum("nij,nj->ni", R, vectors)


def of_frames(b: Balance, terms: list[Term], name: Callable[[str], str]) -> Iterator[Hypothesis]:
    """The numbers of a force, with its moment by the arm, or of its own moment, or both, or the
    velocity that they are made of, or all this are along the axes of the other frame; a covector,
    as a damping by a tensor of 𝔤, is at the origin."""
    A, own = b.turns(), [x.values for x in terms]
    back, origin = A.transpose(0, 2, 1), np.zeros(A.shape[-1])
    arms = [origin if x.arm is None else x.arm for x in terms]
    placed = [(x.at, arm) for x, arm in zip(terms, arms, strict=True) if x.at is not None]
    if len(placed) < len(terms):
        return
    least = EXACT * np.abs(own).max()
    said: list[tuple[str, list[Array], Turn]] = [(f"{{}} {BY_A}", own, turned(A @ A))]
    for frame, R, out in (("space", A, turned(back)), ("the body", back, turned(A))):
        axes = f"along the axes of {frame} instead"
        said.append((f"{{1}} has its numbers {axes}", own, out))
        taken = [at(moving(b, arm, R)) for at, arm in placed]
        if np.abs(np.subtract(taken, own)).max() > least:
            said.append((f"the velocity in {{}} is {axes}", taken, np.asarray))
            said.append((f"the velocity and the numbers of {{}} are {axes}", taken, out))
    moments, forces = zip(*map(couple_and_force, own, arms), strict=True)
    parts = (("moment", moments), ("force", forces))
    kinds = [kind for kind, x in parts if np.abs(x).max() > least]
    for kind, (words, values, to) in product(("", *(kinds if len(kinds) > 1 else ())), said):
        numbers = kinds[0] if len(kinds) == 1 else kind
        by_arm = ", with its moment by the arm," * (numbers == "force")
        told = words.format(name(kind), name(numbers) + by_arm)
        each = zip(own, values, arms, strict=True)
        others = [changed_force(x, y, arm, kind, to) for x, y, arm in each]
        yield Hypothesis(told, 0, b.unexplained - np.subtract(others, own).sum(axis=0))
    for frame, R in (("space", A), ("the body", back)):
        more = sum(
            (cross(arm, turned(R)(x) - x) for x, arm in zip(forces, arms, strict=True)),
            0 * moments[0],
        )
        told = (
            f"the force of {name('')} is along the axes of {frame} in its moment by the arm alone"
        )
        yield Hypothesis(told, 0, b.unexplained - np.hstack([more, 0 * forces[0]]))
    if all(x.arm is None for x in terms) and b.turns().shape[-1] == len(b.rows["moment"]) == 3:
        yield from of_coupled(b, [at for at, _ in placed], np.sum(own, axis=0), name(""))


def of_coupled(
    b: Balance, acting: Sequence[Callable[[Array], Array]], own: Array, name: str
) -> Iterator[Hypothesis]:
    """Of a covector, as that of a tensor that couples ω and v, one of the two velocities alone is
    along the axes of the other frame, or with it the moment or the force, as of a tensor that is
    turned in its part of v alone."""
    A, (w, v) = b.turns(), b.velocities()
    back, first, last = A.transpose(0, 2, 1), slice(0, 3), slice(3, 6)
    for frame, R, out in (("space", A, turned(back)), ("the body", back, turned(A))):
        to = turned(R)
        for letter, kind, state, rows, beside in (
            ("ω", "moment", (to(w), v), first, last),
            ("v", "force", (w, to(v)), last, first),
        ):
            x = b.with_velocities(*state)
            taken = np.sum([at(x) for at in acting], axis=0)
            if np.abs((taken - own)[:, beside]).max() <= EXACT * np.abs(own).max():
                continue  # no coupling: what is said of the moment or the force alone
            both = taken.copy()
            both[:, rows] = out(taken[:, rows])
            axes = f"along the axes of {frame} instead"
            yield Hypothesis(f"{letter} in {name} is {axes}", 0, b.unexplained - (taken - own))
            told = f"{letter} and the {kind} in {name} are {axes}"
            yield Hypothesis(told, 0, b.unexplained - (both - own))


def moving(b: Balance, arm: Array, R: Array) -> Array:
    """The states in which the velocities of a place, and of turning, are turned by R."""
    w, v = b.velocities()
    n = arm.shape[-1]
    of_place = turned(R)(v + turning(w, arm))
    w = turned(R)(w) if n == 3 else w
    return b.with_velocities(w, of_place - turning(w, arm))


def of_speeds(b: Balance, term: Term) -> Iterator[Hypothesis]:
    """A force of the velocity of the body's origin, or of its centre of mass; one by the speed
    along each axis for one by the whole speed, or the other way round."""
    if term.arm is None or term.at is None or term.is_input:
        return
    (w, v), name, r = b.velocities(), term.name(""), b.centre()
    taken = {"the body's origin": v}
    if r is not None and r.any():
        taken["the centre of mass"] = v + turning(w, r)
        for sign in (1, -1):
            told = f"its place {'−+'[sign > 0]} r, r the centre of mass"
            taken[told] = v + turning(w, term.arm + sign * r)
    for place, velocity in taken.items():
        values = term.at(b.with_velocities(w, velocity - turning(w, term.arm)))
        words = f"{name} is made of the velocity of {place}, not of its place"
        yield Hypothesis(words, 0, b.unexplained - (values - term.values))
    n = term.arm.shape[-1]
    couple, own = couple_and_force(term.values, term.arm)
    if np.abs(couple).max() > EXACT * np.abs(term.values).max():
        # with no moment of its own the whole moment is missing, which is a factor of it
        left = b.unexplained + np.hstack([cross(term.arm, own), 0 * own])
        yield Hypothesis(f"the moment of {name} by its arm is missing", 0, left)
    axes = {"the body": np.broadcast_to(np.eye(n), b.turns().shape), "space": b.turns()}
    for (frame, A), (words, to) in product(axes.items(), BY_AXES.items()):
        more = turned(A.transpose(0, 2, 1))(to(turned(A)(own))) - own
        said = f"{name} has {words}, in the axes of {frame}"
        yield Hypothesis(said, 1, b.unexplained - np.hstack([cross(term.arm, more), more]))


def of_sizes(b: Balance) -> Iterator[Hypothesis]:
    """In a force each |x| is x, or 1: c x² for c x|x|, or what is linear for what is quadratic."""
    problem = b.opened.given
    forces, sizes = list(problem.forces), list[tuple[int, Tree, Tree]]()
    for i, table in enumerate(forces):
        trees = {key: getattr(table, key) for key in table.expressed}
        inside = dict.fromkeys(y for own in trees.values() for t in own for y in nodes(t))
        # what is inside another |x| is less deep
        for y in sorted(inside, key=lambda y: -len(str(y))):
            if (x := sized(y)) is not None:
                own, of_x, of_one = (("par", f"{w}_{len(sizes)}_") for w in ("own", "x", "one"))
                other = add(mul(own, y), mul(of_x, x), of_one)
                trees = {k: tuple(replaced(t, y, other) for t in own) for k, own in trees.items()}
                sizes.append((i, y, x))
        forces[i] = replace(table, **trees)
    letters = [f"{w}_{k}_" for k in range(len(sizes)) for w in ("own", "x", "one")]
    parameters = {**problem.parameters, **{x: Parameter() for x in letters}}
    fewer = {"forces": tuple(forces), "parameters": parameters}
    code = b.without(fewer, problem) if sizes else None
    if code is None:
        return
    for i in dict.fromkeys(i for i, *_ in sizes):
        here = [k for k, x in enumerate(sizes) if x[0] == i]
        for these in ([k] for k in here) if len(here) < 2 else (*([k] for k in here), here):
            for one in (False, True):
                values = {**b.values(), **{x: float(x.startswith("own")) for x in letters}}
                values |= {f"own_{k}_": 0.0 for k in these}
                values |= {f"{'one' if one else 'x'}_{k}_": 1.0 for k in these}
                names = [_as_asked(b, problem.forces[i], sizes[k][2]) for k in these]
                said = ", ".join(f"{1 if one else x} stands for |{x}|" for x in names)
                other = code.bias(b.t, b.x, b.k(values, code), b.u)[:, b.part]
                left = b.unexplained + other - b.bias(b.x, b.u)
                yield Hypothesis(f"in {called(problem, problem.forces[i])} {said}", 0, left)


def _as_asked(b: Balance, table: Any, x: Tree) -> str:
    """A tree of a force by the names of the problem file."""
    group = b.opened.given.own_group
    if isinstance(table, StatedForce):
        block, factor = b.opened.given.acted_on(table)
        place = factor.n, group.places[block - 1][0], table.on
        wind = table.relative_to or (0,) * factor.n
        for name, v in velocity_at_place(*place, wind, turned=table.frame == "body").items():
            x = replaced(x, v, ("par", name))
    return plain_text(show(typed(x, group)))


def _apart(force: Array) -> Array:
    return np.asarray(force * np.abs(force) / np.linalg.norm(force, axis=1)[:, None])


def _whole(force: Array) -> Array:
    roots = np.sqrt(np.abs(force))
    return np.asarray(np.sign(force) * roots * np.linalg.norm(roots, axis=1)[:, None])


BY_AXES = {
    "|vᵢ| vᵢ along each axis where ‖v‖ v is meant": _apart,
    "‖v‖ v where |vᵢ| vᵢ along each axis is meant": _whole,
}


def of_own_arms(b: Balance, terms: list[Term]) -> Iterator[Hypothesis]:
    """The arm of a force is another vector in its moment alone, as that of another place."""
    problem, own = b.opened.problem, b.values()
    places = {f"that of point {k}": x.at for k, x in enumerate(problem.points, 1)}
    for x in terms:
        if x.arm is None or x.arm.ndim > 1:
            continue
        force = x.values[:, -len(x.arm) :]
        each = [np.hstack([cross(e + 0 * force, force), 0 * force]) for e in np.eye(len(x.arm))]
        D = np.stack([y.ravel() for y in each], axis=1)
        more = np.linalg.lstsq(D, b.unexplained.ravel(), rcond=1e-9)[0]
        arm, left = x.arm + more, b.unexplained - np.tensordot(more, each, 1)
        said, rank = f"({', '.join(f'{y:.6g}' for y in arm)})", 3
        for words, at in places.items():
            there = [approximate(y, own, float) for y in at]
            if None not in there and np.allclose(arm, np.array(there, float), rtol=0, atol=NEAR):
                said, rank = words, 1
        yield Hypothesis(f"the lever arm of {x.name('')} in its moment is {said}", rank, left)


def of_arms(b: Balance, terms: list[Term], together: bool = False) -> Iterator[Hypothesis]:
    """An arm, or all arms ``together``, are taken from the centre of mass; or moments are about
    it."""
    r = b.centre()
    if r is None or not r.any():
        return
    placed = [x for x in terms if x.arm is not None and x.at]
    listed = [(f"the lever arm of {x.name('')} is", [x]) for x in placed if not together]
    of_places = [x for x in placed if x.arm is not None and x.arm.ndim == 1]
    of_inputs = [x for x in of_places if x.is_input]
    for words, several in (
        ("all lever arms", of_places),
        ("the lever arms of all inputs", of_inputs),
    ):
        listed += [(f"{words} are", several)] * (together and len(several) > 1)
    for (words, own), (sign, told) in product(listed, TAKEN.items()):
        moved = sum((_at_arm(b, x, sign * r) - x.values for x in own), 0 * b.a)
        yield Hypothesis(f"{words} {told}", 0, b.unexplained - moved)
        more = cross(sign * r, sum((x.values[:, -r.shape[1] :] for x in own), 0 * r))
        left = b.unexplained - np.hstack([more, 0 * r])
        yield Hypothesis(f"{words} {told}, in the moment alone", 2, left)


TAKEN = {
    1: "taken from the centre of mass instead of the body's origin",
    -1: "of moments about the centre of mass instead of the body's origin",
    2: "p + r and not p − r, of the place p, where moments are about the centre of mass r",
}


def _at_arm(b: Balance, term: Term, further: Array) -> Array:
    """A force with its moment that acts further along the axes of the body, made of the velocity of
    its place there."""
    assert term.at is not None
    assert term.arm is not None
    w, v = b.velocities()
    own, n = term.at(b.with_velocities(w, v + turning(w, further))), term.arm.shape[-1]
    return np.hstack([own[:, :-n] + cross(further, own[:, -n:]), own[:, -n:]])
