"""A problem in the principal frame of its body: the same mechanics, with fewer numbers.

Relabelling the points, r′ = H(r − s) with the map in the normaliser of G, and turning space,
S, takes (g, Z, J) to (S g h⁻¹, h Z h⁻¹, h J h̄) and leaves the form of the equations alone.  Where G
translates, s is the centre of mass, so c = 0.  For SO(n), SE(n) H turns the body onto its principal
axes, so J is diagonal; for SL(n), GL(n) and their affine kin H is a root of J, so J = μ1, turned so
that the matrix K of the springs inside the body is diagonal; with μ the unit of mass, J = 1.
S puts gravity along the last axis.

What the new parameters stand for is plain data, ``Problem.frame``: ``kind``, H is a rotation or a
root of J; ``turned``, is S not 1; ``moments``, the diagonal of J; ``stiffness``, that of K;
``first``, c; ``gravity``, |g|; ``per_unit``, 1/μ where J = μ1, for then masses, stiffnesses and
forces are in units of μ, and so is the energy; ``places``, new names of a place in the body with
its old coordinates; ``vectors``, the same of a vector of space.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from ..algebra.groups import Group
from ..language.tree import Tree, mul
from ..schema.body_kinds import GivenBody, Moments, Place, Point
from ..schema.force_kinds import Damping, ForceInput, Input
from ..schema.kind import Parameter
from ..schema.potential_kinds import Gravity, Potential, Spring, gravity, quadratic
from ..schema.table import Key
from .problem import Problem, ProblemError

Vector = tuple[Tree, ...]
ROTATION, ROOT = "rotation", "root"
MANY = 100
"""Above so many points only those are kept on which something acts, numbered anew."""


def principal(problem: Problem) -> Problem:
    """The problem in its principal frame; ``ProblemError`` says why it has none."""
    if problem.body is None:
        raise ProblemError(f"{problem.name}: no body, so no principal frame")
    group = problem.group
    kind = frame_of(group) if group else ""
    if group is None or not kind:
        what = group.name if group else "any group"
        raise ProblemError(
            f"{problem.name}: no principal frame is known for {what}; it is for "
            "SO(n), SE(n), SL(n), SAff(n), GL(n) and Aff(n)"
        )
    vectors = (x for x in problem.inputs if x.kind == "torque" or "direction" in x.plain())
    unturned = [p.unturned for p in problem.potentials if p.unturned]
    unturned += [f"the input {x.name}" for x in vectors]
    unturned += ["a potential of the time"] * problem.timed
    unturned += ["a [[flow]]"] * bool(problem.flows)
    unturned += ["a [[force]]"] * bool(problem.forces) + ["an [[output]]"] * bool(problem.outputs)
    if unturned:
        raise ProblemError(
            f"{problem.name}: {unturned[0]} cannot be turned into the principal frame; leave "
            "out --frame"
        )
    return _Framing(problem, group, kind).framed()


def frame_of(group: Group) -> str:
    """The kind of principal frame of a group.

    ``rotation`` for SO(n) and SE(n), ``root`` for SL(n), GL(n), SAff(n), Aff(n), else empty.
    """
    if group.factors or (group.affine and not group.free_translations):
        return ""
    n, d = group.n, len(group.linear_basis)
    if "orthogonal" in group.relations:
        return ROTATION if 2 * d == n * (n - 1) and n > 1 else ""
    return ROOT if d == n * n - ("unimodular" in group.relations) else ""


class _Framing:
    """The change of one problem to its principal frame, with the parameters it introduces."""

    def __init__(self, problem: Problem, group: Group, kind: str):
        self.problem, self.group, self.kind, self.n = problem, group, kind, group.n
        self.new: dict[str, Parameter] = {}
        self.places: dict[tuple[str, ...], Vector] = {}
        self.vectors: dict[tuple[str, ...], Vector] = {}

    def framed(self) -> Problem:
        """The problem in the frame; what its new parameters stand for is in ``frame``."""
        unimodular = "unimodular" in self.group.relations
        root = self.kind == ROOT
        diagonal = () if root else self._names("moment", "second moment along axis {}")
        self.per_unit = (
            self._name("per_unit", "one over the unit of mass") if root and unimodular else ""
        )
        affine, falling = self.group.affine, self._gravity()
        first = () if affine else self._names("first", "first moment, component {}")
        inside = _inside(self.problem) if root else ()
        stiffness = self._names("stiffness", "springs along axis {}") if inside else ()
        places, numbers = self._points()
        potentials = [
            self._potential(p, numbers)
            for p in self.problem.potentials
            if not isinstance(p, Gravity) and p not in inside
        ]
        ends, along = self._along(len(places) + 1, stiffness)
        assert self.problem.body is not None
        moments = Moments(
            m=self._scaled(self.problem.body.moments().m),
            c=_pars(first) or (0,) * self.n,
            J=self._second(diagonal),
        )
        frame = {
            "kind": self.kind,
            "turned": bool(falling),
            "moments": list(diagonal),
            "stiffness": list(stiffness),
            "first": list(first),
            "gravity": falling,
            "per_unit": self.per_unit,
            "places": [[list(names), list(at)] for names, at in self.places.items()],
            "vectors": [[list(names), list(v)] for names, v in self.vectors.items()],
        }
        return replace(
            self.problem,
            frame=frame,
            parameters={**self.problem.parameters, **self.new},
            body=GivenBody(given=moments),
            potentials=(*potentials, *self._pull(falling), *along),
            inputs=tuple(_pushed(x, numbers) for x in self.problem.inputs),
            places=(*places, *ends),
            damping=tuple(
                Damping(coefficient=self._scaled(x.coefficient), on=tuple(numbers[i] for i in x.on))
                for x in self.problem.damping
                if isinstance(x, Damping)
            ),
        )

    # -- new parameters ----------------------------------------------------------------------

    def _name(self, wanted: str, meaning: str) -> str:
        """The name of a new parameter: as wanted, with _ while it is taken."""
        name = wanted
        while name in self.problem.parameters or name in self.new:
            name += "_"
        self.new[name] = Parameter(meaning=meaning)
        return name

    def _names(self, wanted: str, meaning: str) -> tuple[str, ...]:
        """The names of n new parameters, one for each coordinate."""
        span = range(1, self.n + 1)
        return tuple(self._name(f"{wanted}_{i}", meaning.format(i)) for i in span)

    def _place(self, at: Vector, k: int) -> Vector:
        """The new coordinates, parameters, of a place ``at`` in the body."""
        names = self._names(f"place_{k}", f"point {k} in the frame, component {{}}")
        self.places[names] = at
        return _pars(names)

    def _vector(self, v: Vector, what: str) -> Vector:
        """The new coordinates, parameters, of a vector of space; itself where space stays."""
        if not self._turns or not any(x != 0 for x in v):
            return v
        names = self._names(what, f"{what.replace('_', ' ')} in the frame, component {{}}")
        self.vectors[names] = v
        return _pars(names)

    # -- body and forces ---------------------------------------------------------------------

    @property
    def _turns(self) -> bool:
        g = gravity(self.problem.potentials)
        return g is not None and sum(x != 0 for x in g) > 1

    def _gravity(self) -> str:
        """The name of |g| where space is turned to have gravity along its last axis; else empty."""
        return self._name("gravity", "gravity along the last axis") if self._turns else ""

    def _pull(self, name: str) -> tuple[Potential, ...]:
        """Gravity in the frame, if there is any."""
        g = gravity(self.problem.potentials)
        if g is None:
            return ()
        return (Gravity(g=(*(0,) * (self.n - 1), ("par", name)) if name else g),)

    def _scaled(self, t: Tree) -> Tree:
        """A mass, stiffness or damping in the unit of mass."""
        return mul(t, ("par", self.per_unit)) if self.per_unit else t

    def _second(self, moments: tuple[str, ...]) -> tuple[Vector, ...]:
        """The matrix J in the frame: diagonal, or 1."""
        span = range(self.n)
        diagonal = _pars(moments) or (1,) * self.n
        return tuple(tuple(diagonal[i] if i == j else 0 for j in span) for i in span)

    def _points(self) -> tuple[tuple[Place, ...], dict[int, int]]:
        """The points as places, under their old numbers if few are left out, and the numbers."""
        listed: tuple[Point | Place, ...] = (*self.problem.points, *self.problem.places)
        old = [p.at for p in listed]
        needed = {*_needed(self.problem, root=self.kind == ROOT)}
        if needed and len(old) <= MANY:
            needed = {*range(1, len(old) + 1)}
        places = tuple(Place(at=self._place(old[i - 1], i)) for i in sorted(needed))
        return places, {i: k for k, i in enumerate(sorted(needed), 1)}

    def _potential(self, p: Potential, numbers: Mapping[int, int]) -> Potential:
        """A potential in the frame, key by key."""
        on = getattr(p, "on", None)
        mark = f"_{on}" if isinstance(on, int) else ""
        keys = p.keys().items()
        values = {x: self._value(getattr(p, x), about, x + mark, numbers) for x, about in keys}
        return replace(p, **values)

    def _value(self, value: Any, about: Key, name: str, numbers: Mapping[int, int]) -> Any:
        """The value of a key in the frame: points by new numbers, vectors turned, masses scaled."""
        if about.type == "masses":
            masses = enumerate((p.mass for p in self.problem.points), 1)
            return tuple((numbers[i], self._scaled(m)) for i, m in masses if m != 0)
        if value is None:
            return None
        if about.type == "vector":
            return self._vector(value, name)
        if about.type in ("pair", "end"):
            return tuple(numbers[i] for i in value) if about.type == "pair" else numbers[value]
        return self._scaled(value) if about.mass else value

    def _along(
        self, origin: int, stiffness: tuple[str, ...]
    ) -> tuple[tuple[Place, ...], tuple[Spring, ...]]:
        """The springs along the axes, with places for their ends: from the origin to e_1, e_2, …"""
        if not stiffness:
            return (), ()
        span = range(self.n)
        axes = (Place(at=tuple(int(i == j) for j in span)) for i in span)
        springs = (
            Spring(between=(origin + i, origin), stiffness=("par", k))
            for i, k in enumerate(stiffness, 1)
        )
        return (Place(at=(0,) * self.n), *axes), tuple(springs)


def _inside(problem: Problem) -> tuple[Spring, ...]:
    """The springs whose matrix K the root of J makes diagonal."""
    return quadratic(problem.potentials, problem.block)


def _needed(problem: Problem, *, root: bool) -> Iterable[int]:
    """The numbers of the points on which something acts, with repetitions.

    With a root, springs inside the body are left out: they go into K.
    """
    inside = _inside(problem) if root else ()
    for p in problem.potentials:
        if p.summed:
            yield from range(1, problem.masses + 1)
        if p not in inside:
            yield from p.points()
    yield from (x.on for x in problem.inputs if isinstance(x, ForceInput))
    yield from (i for _, i in problem.damped_points)


def _pars(names: Iterable[str]) -> Vector:
    """The parameters of these names as trees."""
    return tuple(("par", x) for x in names)


def _pushed(x: Input, numbers: Mapping[int, int]) -> Input:
    """An input with its point's new number."""
    return replace(x, on=numbers[x.on]) if isinstance(x, ForceInput) else x
