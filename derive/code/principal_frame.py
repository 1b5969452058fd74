"""The principal frame in numbers, and the change of a state to it and back."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from ..record.as_json import decode
from . import dense
from .graph import PARAMETER, Node
from .program import AxesTurning
from .reader import RecordReader, scalar
from .slots import conjugate, horn, multiplied
from .state import StateSpace

# The body's tensor of inertia, and which parameters turn with the body's axes (paper, (35)).

MOMENTS = tuple(f"J_{i}{j}" for i in (1, 2, 3) for j in range(i, 4))


def inertia(reader: RecordReader) -> list[Node]:
    """I_11, I_12, I_13, I_22, I_23, I_33 about the body's origin; empty where space is not R³, or
    they depend on the time."""
    if not reader.group.turns_space or reader.record.definition("I") is None:
        return []
    tensor = reader.vector("I")
    if dense.stage_of(tensor) != PARAMETER:
        return []
    return [tensor[i][j] for i in range(3) for j in range(i, 3)]


def turning(problem: Mapping[str, Any], parameters: Sequence[str]) -> AxesTurning | None:
    """How parameters change with the body's axes; ``None`` where they cannot express that.

    ``problem`` as in the record; ``parameters``: the emitted ones, in order.
    """
    body = problem["body"]
    at = {name: i for i, name in enumerate(parameters)}
    if body["kind"] == "moments" and {*MOMENTS} <= {*at} - {*_parameters(problem)}:
        places = [place["at"] for place in problem["places"]]
        if "c_1" in at:
            places.append([("par", f"c_{i}") for i in (1, 2, 3)])
        matrix = tuple(at[name] for name in MOMENTS)
    elif body["kind"] == "points":
        places = [p["at"] for p in (*body["points"], *problem["places"])]
        matrix = ()
    else:
        return None
    vectors = _vectors(places, Counter(_parameters([problem, places])), at)
    return None if vectors is None else AxesTurning(vectors, matrix)


def _vectors(
    places: Sequence[Sequence[Any]], uses: Mapping[str, int], at: Mapping[str, int]
) -> tuple[tuple[int, ...], ...] | None:
    """The indices of the parameters of the places that are not 0; ``None`` unless each is three
    parameters that stand nowhere else."""
    found = []
    for place in places:
        names = [x[1] for x in place if isinstance(x, (list, tuple)) and x[0] == "par"]
        if any(x != 0 for x in place):
            # once in the problem, and once more in the list of places
            if len(names) != 3 or any(uses[name] > 2 or name not in at for name in names):
                return None
            found.append(tuple(at[name] for name in names))
    return tuple(found)


def _parameters(data: Any) -> Iterator[str]:
    """The names of all parameters in the trees of plain data, with repetitions."""
    if isinstance(data, (list, tuple)):
        if len(data) == 2 and data[0] == "par" and isinstance(data[1], str):
            yield data[1]
        else:
            for x in data:
                yield from _parameters(x)
    elif isinstance(data, dict):
        for x in data.values():
            yield from _parameters(x)


FRAME = "frame"
"""The label of what comes from no equation of the record but from the choice of the frame."""

SMALL = Fraction(1, 10**30)
"""Added to the size of gravity, which may be 0."""

SPREAD = (31, 27, 16, 11, 7, 5, 3, 2)
"""A diagonal matrix, in hundredths, in which no two directions across a rational γ are alike."""


@dataclass(frozen=True)
class Axes:
    """The spectral decomposition of a symmetric ``matrix``: eigenvalues ``values``, smallest first;
    ``rows``: a rotation whose rows are the eigenvectors."""

    matrix: Matrix
    values: tuple[Node, ...]
    rows: Matrix

    @property
    def leaves(self) -> list[Node]:
        """The numbers found: eigenvalues, then rows, as the emitted code stores them."""
        return [*self.values, *q.flatten(self.rows)]


class PrincipalFrame:
    """The principal frame of a problem: H, s, S and the new parameters, as nodes.

    ``data``: what the new parameters stand for, ``Problem.frame``; ``old``: the problem as the user
    gave it, read in the graph of the framed one. ``axes``: in order, each needs those before it;
    ``numbers``: leaf → node in the parameters and axes, for each new parameter of the framed
    problem and each entry of H, H⁻¹, s, S. ``unit``, ``scale``: the leaves of μ and 1/μ, else 1.
    """

    def __init__(self, data: Mapping[str, Any], old: RecordReader, quaternion: bool):
        self.data, self.old, self.graph = data, old, old.graph
        old.label = FRAME
        self.n, self.affine = old.group.n, old.group.affine
        self.axes: list[Axes] = []
        self.numbers: dict[Node, Node] = {}
        self.unit = self.per_unit = self.scale = old.graph.num(1)
        self._material()
        self._space()
        self._parameters()
        self.quaternions = self._quaternions() if quaternion else ()

    def nodes(self) -> list[Node]:
        """All that the frame computes: the numbers, and the matrices whose axes are wanted."""
        return [*self.numbers.values(), *(x for axes in self.axes for x in q.flatten(axes.matrix))]

    # -- the frame ---------------------------------------------------------------------------

    def _principal(self, m: Matrix, value: str, axis: str) -> Axes:
        """The axes of a symmetric matrix, as leaves: the emitted code finds their numbers."""
        leaf = self.graph.leaf
        span = range(1, len(m) + 1)
        values = tuple(leaf(suffixed(value, i), "frame") for i in span)
        rows = tuple(tuple(leaf(suffixed(axis, i, j), "frame") for j in span) for i in span)
        self.axes.append(Axes(m, values, rows))
        return self.axes[-1]

    def _constants_of(self, name: str, m: Matrix) -> Matrix:
        """The matrix as leaves ``name_ij`` of the frame, which ``constants`` keeps."""
        return dense.entrywise(m, name, self._number_of, len(m[0]) == 1)

    def _number_of(self, x: Node, name: str, kind: str = "frame") -> Node:
        """The leaf for a number x that the frame computes."""
        leaf = self.graph.leaf(name, kind)
        self.numbers[leaf] = x
        return leaf

    def _material(self) -> None:
        """Set H, H⁻¹, s, and the numbers that tell a singular body."""
        g, n = self.graph, self.n
        J = self.old.vector("J")
        self.s: Matrix = ()
        if self.affine:
            inverse = g.recip(self.old.number("m"))
            c = self.old.vector("c")
            s = self._named("centre", q.scaled(inverse, c))
            shift = q.times(c, q.transposed(s))
            J = q.minus(J, shift)
            self.s, self._s = self._constants_of("centre", s), s
        span = range(n)
        J = tuple(tuple(J[min(i, j)][max(i, j)] for j in span) for i in span)
        J = self._named("J_c" if self.affine else "J", J)
        found = self._principal(J, "second", "axis")
        scale = g.magnitude(dense.diagonal(g, J))
        if self.data["kind"] == "root":
            H, back = self._root(found)
            least = found.values[0]
            self.H, self.back = (
                self._constants_of("frame", H),
                self._constants_of("frame_inverse", back),
            )
            self._H = self._named("frame", H)
        else:
            least = found.values[0] + found.values[1]
            self._set(self.data["moments"], found.values)
            self.H, self._H = self._constants_of("frame", found.rows), found.rows
            self.back = q.transposed(self.H)
        self.regular: list[tuple[Node, Node | None]] = []
        if self.affine and self.data["per_unit"]:  # without mass, nothing below is a number
            self.regular.append((self._number_of(self.old.number("m"), "mass"), None))
        moments = self._number_of(least, "least_moment"), self._number_of(scale, "size_of_J")
        self.regular.append(moments)

    def _root(self, J: Axes) -> tuple[Matrix, Matrix]:
        """H with H J H̄ = μ1, and H⁻¹; with stiffnesses also H K H̄ diagonal."""
        g = self.graph
        mu: Node = g.num(1)
        if self.data["per_unit"]:
            logarithm = g.sum(g.function("log", x) for x in J.values)
            mu = g.function("exp", g.linear([(Fraction(1, self.n), logarithm)]))
            mu = g.value(mu, "unit_of_mass", FRAME)
            self.per_unit = g.value(g.recip(mu), "per_unit", FRAME)
            self._set((self.data["per_unit"],), (self.per_unit,))
            self.scale = self.graph.leaf(self.data["per_unit"], "parameter")
            self.unit = self._number_of(mu, "unit_of_mass")
        roots = [
            g.value(g.function("sqrt", g.product((mu, g.recip(x)))), suffixed("stretch", i), FRAME)
            for i, x in enumerate(J.values, 1)
        ]
        H = tuple(
            tuple(g.product((k, x)) for x in row) for k, row in zip(roots, J.rows, strict=True)
        )
        back = tuple(
            tuple(g.product((x, g.recip(k))) for x, k in zip(row, roots, strict=True))
            for row in q.transposed(J.rows)
        )
        if not self.data["stiffness"]:
            return H, back
        H, back = self._named("root", H), self._named("root_inverse", back)
        K = q.times(q.times(H, self.old.vector("K")), q.transposed(H))
        along = self._principal(K, "spring", "turn")
        stiffness = [g.product((self.per_unit, x)) for x in along.values]
        self._set(self.data["stiffness"], stiffness)
        return q.times(along.rows, H), q.times(back, q.transposed(along.rows))

    def _space(self) -> None:
        """Set S, the rotation that puts gravity along the last axis; empty where space stays."""
        self.S: Matrix = ()
        if self.data["turned"]:
            g = self.old.vector("γ")
            found = self._principal(self._upright(g), "pull", "space")
            self.S, self._S = self._constants_of("space", found.rows), found.rows
            whole = q.times((found.rows[-1],), g)
            self._set((self.data["gravity"],), whole[0])

    def _upright(self, gamma: Matrix) -> Matrix:
        """A matrix whose last axis is γ, and whose others are definite as well: s²uū + QDQ with u
        along γ, s² = ūu, Q = s²1 − uū."""
        g, span = self.graph, range(self.n)
        total = g.sum([*(g.magnitude(x) for (x,) in gamma), g.num(SMALL)])
        scale = g.value(g.recip(total), "per_gravity", FRAME)
        u = self._named("upright", q.scaled(scale, gamma))
        square = g.value(dense.dot(u, u), "upright_2", FRAME)
        both = q.times(u, q.transposed(u))
        Q = self._named("across", q.minus(q.scaled(square, q.identity(self.n)), both))
        spread = tuple(
            tuple(g.product((g.num(Fraction(SPREAD[i], 100)), x)) for x in Q[i]) for i in span
        )
        return q.plus(q.scaled(square, both), q.times(Q, spread))

    def _parameters(self) -> None:
        """Set the new places H(r − s), vectors of space S a, and first moment Hc."""
        for names, at in self.data["places"]:
            place = q.minus(self._column(at), self._s) if self.s else self._column(at)
            self._set(names, q.flatten(q.times(self._H, place)))
        for names, v in self.data["vectors"]:
            self._set(names, q.flatten(q.times(self._S, self._column(v))))
        if self.data["first"]:
            first = q.times(self._H, self.old.vector("c"))
            self._set(self.data["first"], q.flatten(q.scaled(self.per_unit, first)))

    def _set(self, names: Sequence[str], values: Sequence[Node]) -> None:
        """Let new parameters of the framed problem stand for these values."""
        for name, x in zip(names, values, strict=True):
            self._number_of(x, name, "parameter")

    def _quaternions(self) -> tuple[tuple[Node, ...], ...]:
        """The quaternions of S and of H̄, by the axis of the largest eigenvalue (see ``horn``)."""
        found = []
        for name, R in (("space", self.S and self._S), ("frame", self._H)):
            if not R:
                found.append((self.graph.num(1), *(self.graph.num(0),) * 3))
                continue
            axes = self._principal(horn(R), f"{name}_trace", f"{name}_quaternion")
            kept = self._constants_of(f"{name}_q", tuple((x,) for x in axes.rows[-1]))
            found.append(tuple(x for (x,) in kept))
        return found[0], conjugate(found[1])

    # -- values of the given problem ---------------------------------------------------------

    def _column(self, trees: Sequence[Any]) -> Matrix:
        """A list of trees of the given problem, as a column of nodes."""
        return tuple((scalar(self.old.tree(decode(t, "frame"))),) for t in trees)

    def _named(self, name: str, m: Matrix) -> Matrix:
        return self.old.entries(m, name)


# The change of a state, and of inputs, to the principal frame and back: (S g h⁻¹, h Z h⁻¹).


def frame_changes(frame: PrincipalFrame, framed: RecordReader) -> dict[str, list[Node]]:
    """Function name → outputs: ``into_frame``, ``out_of_frame``, and the same of inputs."""
    there, x = _Map.of(frame), framed.space
    back = there.inverse
    found = {"into_frame": there.image(x), "out_of_frame": back.image(x)}
    if framed.inputs:
        found["inputs_into_frame"] = _inputs(frame, there, frame.scale)
        found["inputs_out_of_frame"] = _inputs(frame, back, frame.unit)
    return found


@dataclass(frozen=True)
class _Map:
    """A change of frame r ↦ h r in the body and S in space; ``back`` = h⁻¹.

    All are of the size of the group's matrices; ``quaternions``: those of S and of h⁻¹.
    """

    S: Matrix
    h: Matrix
    back: Matrix
    quaternions: tuple[Any, ...]

    @staticmethod
    def of(frame: PrincipalFrame) -> _Map:
        """The map into the principal frame: r ↦ H(r − s) in the body, S in space."""
        num = frame.graph.num
        S = frame.S or dense.numbers(frame.graph, q.identity(frame.n))
        if not frame.affine:
            return _Map(S, frame.H, frame.back, frame.quaternions)
        shift = tuple((-x,) for (x,) in q.times(frame.H, frame.s))
        still = ((num(0),),) * frame.n
        whole = [(S, still), (frame.H, shift), (frame.back, frame.s)]
        S, h, back = (q.bordered(m, column, num(1)) for m, column in whole)
        return _Map(S, h, back, frame.quaternions)

    @property
    def inverse(self) -> _Map:
        """The map out of the frame; S is a rotation, and where G translates it fixes the origin."""
        back = tuple(conjugate(a) for a in self.quaternions)
        return _Map(q.transposed(self.S), self.back, self.h, back)

    def image(self, x: StateSpace) -> list[Node]:
        """The numbers of the state in the other frame: S g h⁻¹, then h Z h⁻¹ (or S ġ h⁻¹)."""
        element = q.times(self.S, q.times(x.element, self.back))
        if x.tangent:
            rate = q.times(self.S, q.times(x.rate, self.back))
            return [*x.entries(element), *x.entries(rate)]
        Z = q.times(q.times(self.h, x.hat(x.coordinates)), self.back)
        velocity = x.read(Z)
        if not x.charts:
            return [*x.entries(element), *velocity]
        left, right = self.quaternions
        (chart,) = x.charts.values()
        turned = multiplied(multiplied(left, tuple(x.numbers[chart])), right)
        return [*turned, *x.entries(element), *velocity]


def _inputs(frame: PrincipalFrame, there: _Map, scale: Node) -> list[Node]:
    """The inputs in the other frame, in units of μ: forces h f (in the body) or S f (in space), and
    covectors u″ with ⟨u″, h ξ h⁻¹⟩ = ⟨u, ξ⟩."""
    old, g, n = frame.old, frame.graph, frame.n
    found: list[Node] = []
    forces = iter(old.forces)
    for entry in old.record.problem["inputs"]:
        if entry["kind"] == "covector":
            found += _coadjoint(old.space, there, old.covector)
            continue
        turn = there.h if entry["frame"] == "body" else there.S
        linear = tuple(row[:n] for row in turn[:n])
        found += q.flatten(q.times(linear, next(forces)))
    return [g.product((scale, x)) for x in found]


def _coadjoint(x: StateSpace, there: _Map, u: list[Node]) -> list[Node]:
    """The covector in the other frame: u″_a = Σ u_b (h⁻¹ E_a h)^b."""
    moved = (q.times(q.times(there.back, x.member(a)), there.h) for a in range(x.group.dimension))
    return [q.dot(u, x.read(e)) for e in moved]
