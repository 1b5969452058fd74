"""What the record says of random states, in 50 digits: the rates of the state and the energy.

What is measured is rounding alone, so a state is its doubles, on the group or beside it by their
rounding: the record's last equations, those that ``--validate`` proves the code equal to, have a
value there too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from derive.algebra.groups import Group
from derive.python.derived import Derived
from derive.validate.chart import Chart, StateChart

from . import draws, terms
from .equations import Equations
from .terms import EXACT, ONE, ZERO, Array, Matrix, Terms


@dataclass(frozen=True)
class Sample:
    """``parameters`` (B,) by name, ``states`` (B, S, N), ``inputs`` (B, S, M)."""

    parameters: dict[str, Array]
    states: Array
    inputs: Array

    def body(self, b: int) -> dict[str, float]:
        """The parameters of one body."""
        return {name: float(v[b]) for name, v in self.parameters.items()}


@dataclass(frozen=True)
class Carried:
    """The linear maps ``state`` (B, N, N) and ``inputs`` (B, M, M) out of the frame of a body."""

    state: Array
    inputs: Array


class Case:
    """A problem in a chart of its state."""

    def __init__(self, derived: Derived, chart: Chart):
        assert derived.problem.group is not None
        self.derived, self.record, self.chart = derived, derived.record, chart
        self.group: Group = derived.problem.group
        self.state = StateChart(self.group, chart)

    @cached_property
    def entries(self) -> list[tuple[int, int]]:
        """Where the numbers of A, then those of T, are in g."""
        return [(i, j) for _, i, j in self.state.entries]

    @cached_property
    def inputs(self) -> list[int]:
        """The sizes of the inputs."""
        listed = self.record.problem.get("inputs", [])
        return [self.group.dimension if x["kind"] == "covector" else self.group.n for x in listed]

    @cached_property
    def rows(self) -> dict[str, list[int]]:
        """Output → its places in dx."""
        place = [*range(len(self.state.names))]
        if self.chart.velocity == "tangent":
            return {"dg": place[: len(place) // 2], "dv": place[len(place) // 2 :]}
        first = len(place) - self.group.dimension
        turns = len(place) - (self.group.n if self.group.affine else 0)
        found = {"dg": place[:first], "dζ": place[first:turns], "dw": place[turns:]}
        return {x: y for x, y in found.items() if y}

    def numbers(self, g: Array) -> Array:
        """The numbers (B, S, …) of group elements (B, S, n, n) that are in a state."""
        rows, columns = ([x[k] for x in self.entries] for k in (0, 1))
        return g[..., rows, columns] if rows else g[..., 0, :0]

    def sample(self, random: draws.Random, bodies: int, states: int) -> Sample:
        """Random bodies, with so many states each."""
        known = self.record.problem["parameters"]
        defaults = {x: 1.0 if y["default"] is None else y["default"] for x, y in known.items()}
        p = draws.bodies(random, defaults, bodies)
        shape, group, n = (bodies, states), self.group, self.group.n
        A = draws.elements(random, group, shape)
        g = np.zeros((*shape, group.size, group.size))
        g[..., :n, :n] = A
        if group.affine:
            g[..., :n, n] = draws.scaled(random, *shape, n)
        speeds = draws.scaled(random, *shape, group.dimension)
        place = self.numbers(g)
        if self.chart.attitude == "quaternion":
            q = random.normal(size=(*shape, 4))
            q /= np.linalg.norm(q, axis=-1, keepdims=True)
            place = np.concatenate([q, place], axis=-1)
        if self.chart.velocity == "tangent":
            Z = np.einsum("bsa,aij->bsij", speeds, np.array(group.basis, dtype=float))
            moved = g @ Z
            speeds = self.numbers(moved)
        u = draws.scaled(random, *shape, sum(self.inputs))
        return Sample(p, np.concatenate([place, speeds], axis=-1), u)


class Reference:
    """The rates and the energy of a sample, each a ``Terms`` of shape (B, S).

    ``carried``: out of the frame in which the states of the sample are, if not that of the record.
    """

    def __init__(self, case: Case, sample: Sample, carried: Carried | None = None):
        self.case, self.group = case, case.group
        x, u = columns(sample.states), columns(sample.inputs)
        if carried:
            x, u = applied(carried.state, x), applied(carried.inputs, u)
        p = {name: Terms(EXACT(y[:, None])) for name, y in sample.parameters.items()}
        given: dict[Any, Any] = {**self._placed(x), **self._pushed(u)}
        self.equations = Equations(case.record, case.group, given, p)
        self.energy: Terms = self.equations.value("h̃")
        self.rates = self._rates()

    def _pushed(self, u: list[Terms]) -> dict[Any, Matrix]:
        found: dict[Any, Matrix] = {}
        first, pushes, group = 0, 0, self.group
        listed = self.case.record.problem.get("inputs", [])
        for data, size in zip(listed, self.case.inputs, strict=True):
            column = tuple((v,) for v in u[first : first + size])
            first += size
            if data["kind"] == "force":
                pushes += 1
                found["at", "f_u", pushes] = column
            elif group.turns_space and group.affine:
                found |= {"u": column[:3], "f_u": column[3:]}
            else:
                found["u"] = column
        return found

    def _placed(self, x: list[Terms]) -> dict[str, Any]:
        """A, T, ζ and w from the numbers of the state."""
        case, group, n = self.case, self.group, self.group.n
        found: dict[str, Any] = {}
        place = x
        if case.chart.attitude == "quaternion":
            found["A"], self.q, place = turned(x[:4]), x[:4], x[4:]
        g = self._matrix(place)
        found = {"A": _linear(g, n)} | found
        if group.affine:
            found["T"] = _shift(g, n)
        rest = place[len(case.entries) :]
        if case.chart.velocity == "tangent":
            return found | self._speeds(found["A"], self._matrix(rest))
        turns = len(rest) - (n if group.affine else 0)
        found["ζ"] = tuple((y,) for y in rest[:turns])
        if group.affine:
            found["w"] = tuple((y,) for y in rest[turns:])
        return found

    def _speeds(self, A: Matrix, speed: Matrix) -> dict[str, Any]:
        """ζ and w, as the basis reads them off A⁻¹ġ."""
        group, n, bar = self.group, self.group.n, terms.transposed(A)
        orthogonal = "orthogonal" in group.relations
        back = bar if orthogonal else terms.inverted(A, positive=False)
        alpha = _linear(speed, n)
        Z = terms.times(back, alpha)
        turns = group.dimension - (n if group.affine else 0)
        readings = [group.coordinate_terms(a) for a in range(turns)]
        zeta = [
            terms.total([Terms.number(c) * Z[i][j] for c, i, j in reading]) for reading in readings
        ]
        found: dict[str, Any] = {"α": alpha, "ζ": tuple((y,) for y in zeta)}
        if group.affine:
            found |= {"τ": _shift(speed, n), "w": terms.times(back, _shift(speed, n))}
        return found

    def _matrix(self, numbers: Sequence[Terms]) -> Matrix:
        rows = [[ZERO] * self.group.size for _ in range(self.group.size)]
        for (i, j), y in zip(self.case.entries, numbers, strict=False):
            rows[i][j] = y
        return tuple(map(tuple, rows))

    def _rates(self) -> list[Terms]:
        group, e, n = self.group, self.equations, self.group.n
        d = group.dimension - (n if group.affine else 0)
        if self.case.chart.velocity == "tangent":
            speed = self._whole(e.value("α"), e.value("τ") if group.affine else ())
            return self._read(speed) + self._read(self._second(d))
        rates = [e.component("ζ̇", a + 1) for a in range(d)]
        rates += [x for (x,) in e.value("ẇ")] if group.affine else []
        moved = self._whole(e.value("Ȧ"), e.value("Ṫ") if group.affine else ())
        place = self._read(moved)
        if self.case.chart.attitude == "quaternion":
            place = half_product(self.q, [x for (x,) in e.value("ζ")]) + place
        return place + rates

    def _second(self, d: int) -> Matrix:
        """g̈: α̇ and τ̇ where the record has them, else g (Ż + Z²)."""
        e, group = self.equations, self.group
        if e.knows("α̇") and e.record.definition("α̇") is not None:
            return self._whole(e.value("α̇"), e.value("τ̇") if group.affine else ())
        basis = [group.linear_part(x) for x in group.basis[:d]]
        rate = [e.component("ζ̇", a + 1) for a in range(d)]
        Z, Z_dot = (_combined(basis, y) for y in ([x for (x,) in e.value("ζ")], rate))
        A, square = e.value("A"), terms.times(Z, Z)
        linear = terms.times(A, _sum(Z_dot, square))
        if not group.affine:
            return linear
        shift = _sum(e.value("ẇ"), terms.times(Z, e.value("w")))
        return self._whole(linear, terms.times(A, shift))

    def _whole(self, linear: Matrix, shift: Any) -> Matrix:
        if not self.group.affine:
            return linear
        rows = ((*row, x) for row, (x,) in zip(linear, shift, strict=True))
        return (*rows, (ZERO,) * self.group.size)

    def _read(self, g: Matrix) -> list[Terms]:
        return [g[i][j] for i, j in self.case.entries]


def columns(x: Array) -> list[Terms]:
    """The numbers of many states (B, S, N), each with all its values."""
    return [Terms(EXACT(x[..., i])) for i in range(x.shape[-1])]


def applied(maps: Array, x: Sequence[Terms]) -> list[Terms]:
    """What the linear maps (B, N, N) of the bodies make of numbers (B, S)."""
    return [
        terms.total(
            [Terms(EXACT(maps[:, i, j, None])) * y for j, y in enumerate(x) if maps[:, i, j].any()]
        )
        for i in range(maps.shape[1])
    ]


def turned(p: Sequence[Terms]) -> Matrix:
    """A of a unit quaternion, 1 − 2(y² + z²) and its like on the diagonal."""
    s, x, y, z = p
    two = Terms.number(2)
    return (
        (ONE - two * (y * y + z * z), two * (x * y - s * z), two * (x * z + s * y)),
        (two * (x * y + s * z), ONE - two * (x * x + z * z), two * (y * z - s * x)),
        (two * (x * z - s * y), two * (y * z + s * x), ONE - two * (x * x + y * y)),
    )


def half_product(p: Sequence[Terms], zeta: Sequence[Terms]) -> list[Terms]:
    """½ p ζ."""
    (s, x, y, z), (a, b, c) = p, zeta
    half = Terms(terms.mpmath.mpf("0.5"))
    rates = (-(x * a) - y * b - z * c, s * a + y * c - z * b, s * b + z * a - x * c)
    return [half * r for r in (*rates, s * c + x * b - y * a)]


def _linear(g: Matrix, n: int) -> Matrix:
    return tuple(row[:n] for row in g[:n])


def _shift(g: Matrix, n: int) -> Matrix:
    return tuple((row[n],) for row in g[:n])


def _sum(a: Matrix, b: Matrix) -> Matrix:
    return tuple(tuple(x + y for x, y in zip(r, s, strict=True)) for r, s in zip(a, b, strict=True))


def _combined(basis: Sequence[Any], coordinates: Sequence[Terms]) -> Matrix:
    span = range(len(basis[0]))
    return tuple(
        tuple(
            terms.total(
                [Terms.number(e[i][j]) * x for e, x in zip(basis, coordinates, strict=True)]
            )
            for j in span
        )
        for i in span
    )
