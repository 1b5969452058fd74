"""The numbers of a state in the order of the contract, from a group element and its velocity.

Computed here from the matrices alone: A row by row or column by column, then T, factor after
factor; or for A the numbers of a chart; then the coordinates of Z = g⁻¹ġ, or the entries of ġ.
Without an element of the group, ζ, then what is carried along.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ..algebra.factor_charts import QUATERNION, CoordinateBlock, FactorChart, factor_charts
from ..algebra.groups import Group
from ..check.values.arithmetic import EPS, nilpotent
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import stored_masses

Numbers = tuple[Any, ...]
EPSILON = nilpotent(EPS)
LARGE = 2**20
"""Of the random integers of two elements in which an entry is the same where it never varies."""
ANGLES = 2**128
"""The random integers in the place of angles are at most this."""
Entry = tuple[str, int, int]
"""The name of a number of the state, and the row and column where it is in a matrix of the
group."""


@dataclass(frozen=True)
class Chart:
    """What an emission chose about the state, in the words of its options: order of entries, which
    factors have charts, ζ or ġ, all entries or those that vary."""

    layout: str = "row"
    attitude: str = "matrix"
    velocity: str = "body"
    state: str = "whole"


@dataclass(frozen=True)
class StateChart:
    """The coordinates of the states (g, ġ) of a group in a chart; ``right``: Z = ġg⁻¹, δg = η g;
    ``held``: coordinates, from 1, that are 0 and no numbers of the state; ``stored``: masses that
    are, after the velocity."""

    group: Group
    chart: Chart
    right: bool = False
    held: tuple[int, ...] = ()
    stored: tuple[str, ...] = ()

    def _moving(self, values: Sequence[Any]) -> Numbers:
        """Those of the coordinates of 𝔤 that the state holds."""
        return tuple(x for a, x in enumerate(values, 1) if a not in self.held)

    @cached_property
    def charts(self) -> dict[int, FactorChart]:
        """Those of the factors that have one, by their places from 0."""
        return factor_charts(self.group, self.chart.attitude)

    @property
    def on_the_group(self) -> bool:
        """Are all its states elements of the group, as charts tell no others?"""
        return bool(self.charts)

    def displaced(self, g: Matrix, eta: Matrix) -> Matrix:
        """The tangent vector at g that η stands for."""
        return q.times(eta, g) if self.right else q.times(g, eta)

    @cached_property
    def held_of_g(self) -> list[Entry | FactorChart]:
        """What the state holds of g, in order: entries; charts, and beside them entries of T
        alone."""
        found: list[Entry | FactorChart] = []
        for k, (offset, factor) in enumerate(self.group.places, 1):
            mark, span = str(k) if len(self.group.places) > 1 else "", range(factor.n)
            pairs = [(i, j) for i in span for j in span]
            if self.chart.layout == "col":
                pairs = [(j, i) for i, j in pairs]
            chart = self.charts.get(k - 1)
            if chart:
                found.append(chart)
            elif not factor.vectors:
                found += [(named(f"A{mark}", i, j), offset + i, offset + j) for i, j in pairs]
            if factor.affine and (chart is None or chart.shifted):
                last = offset + factor.n
                found += [(named(f"T{mark}", i), offset + i, last) for i in span]
        if self.chart.state == "moving" and self.group.has_inner_samples:
            one, two = (self.group.sample_inside(Random(k), LARGE) for k in (1, 2))
            found = [
                x for x in found if isinstance(x, FactorChart) or one[x[1]][x[2]] != two[x[1]][x[2]]
            ]
        return found

    @cached_property
    def entries(self) -> list[Entry]:
        """The entries of g that the state holds, in order."""
        return [x for x in self.held_of_g if not isinstance(x, FactorChart)]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the numbers of the state, in order."""
        place = [
            y for x in self.held_of_g for y in (x.names if isinstance(x, FactorChart) else x[:1])
        ]
        if self.chart.velocity == "tangent":
            return (*place, *(f"{name}_dot" for name in place), *self.stored)
        moved = self.group.n if self.group.free_translations else 0
        turns = self._moving([named("zeta", a) for a in range(self.group.dimension - moved)])
        return (*place, *turns, *(named("w", i) for i in range(moved)), *self.stored)

    def _read(self, x: Matrix, told: Callable[[FactorChart], Numbers]) -> Numbers:
        """What the state holds, entries read off a matrix of the group's size, the numbers of
        charts as ``told``."""
        held = (told(y) if isinstance(y, FactorChart) else (x[y[1]][y[2]],) for y in self.held_of_g)
        return tuple(z for numbers in held for z in numbers)

    def values(self, g: Matrix, Z: Matrix, masses: Numbers = ()) -> Numbers:
        """The numbers of the state at g with velocity g Z, masses 1 where they are not given."""
        place = self._read(g, lambda chart: numbers_of(chart, g))
        masses = masses or (Fraction(1),) * len(self.stored)
        if self.chart.velocity == "tangent":
            return (*place, *self._read(q.times(g, Z), no_chart), *masses)
        return (*place, *self._moving(self.group.nearest(Z)), *masses)

    def varied(self, g: Matrix, Z: Matrix, eta: Matrix, change: Matrix) -> Numbers:
        """The numbers of the state at g + ε δg with Z + ε δZ, in nilpotent numbers."""
        moved = q.plus(g, q.scaled(EPSILON, self.displaced(g, eta)))
        Z = q.plus(Z, q.scaled(EPSILON, change))
        if not self.charts:
            return self.values(moved, Z)

        def told(chart: FactorChart) -> Numbers:
            pairs = zip(numbers_of(chart, g), rates_of(chart, g, eta), strict=True)
            return tuple(x + EPSILON * y for x, y in pairs)

        return (*self._read(moved, told), *self._moving(self.group.nearest(Z)))

    def tangent(self, g: Matrix, Z: Matrix, change: Sequence[Any]) -> bool:
        """Is a change of the numbers of the state (g, Z) tangent to the group's states?"""
        back = q.inverted(g)
        count, of_entries, start = len(self.entries), list[Any](), 0
        for x in self.held_of_g:
            size = len(x.names) if isinstance(x, FactorChart) else 1
            own, start = change[start : start + size], start + size
            if not isinstance(x, FactorChart):
                of_entries += own
            elif x.kind == QUATERNION and q.dot(numbers_of(x, g), own) != 0:
                return False
        if not self._tangent_entries(back, of_entries):
            return False
        if self.chart.velocity == "body":
            return True
        eta = q.times(back, self._matrix(of_entries, len(g)))
        rate = q.times(back, self._matrix(change[count : 2 * count], len(g)))
        return self.group.vee(q.minus(rate, q.times(eta, Z))) is not None

    def _tangent_entries(self, back: Matrix, change: Sequence[Any]) -> bool:
        """Are changes of the entries those of an element of the group, in every factor without a
        chart?"""
        eta = q.times(back, self._matrix(change, len(back)))
        if not self.charts:
            return self.group.vee(eta) is not None
        for k, (offset, factor) in enumerate(self.group.places):
            rows = slice(offset, offset + factor.size)
            if k not in self.charts and factor.vee(tuple(x[rows] for x in eta[rows])) is None:
                return False
        return True

    def _matrix(self, values: Sequence[Any], size: int) -> Matrix:
        """The matrix with these entries of the state, and 0 elsewhere."""
        found = [[Fraction(0)] * size for _ in range(size)]
        for (_, i, j), x in zip(self.entries, values, strict=True):
            found[i][j] = x
        return q.matrix(found)

    def acceleration(self, Z: Matrix, back: Matrix, rates: Numbers) -> Numbers:
        """The d coordinates of Ż = g⁻¹g̈ − Z² from the rates of the state; ``back``: g⁻¹."""
        rates = rates[: len(rates) - len(self.stored)]
        if self.chart.velocity == "body":
            return rates[len(self.held) - self.group.dimension :]
        second = self._matrix(rates[len(self.entries) :], len(Z))  # no chart beside ġ
        return self.group.nearest(q.minus(q.times(back, second), q.times(Z, Z)))

    def rates(
        self, g: Matrix, Z: Matrix, g_dot: Matrix, Z_dot: Matrix, masses: Numbers = ()
    ) -> Numbers:
        """The rates of the state for these ġ and Ż, with g̈ = ġZ + gŻ, and those of masses."""
        place = self._read(g_dot, lambda chart: rates_of(chart, g, Z))
        if self.chart.velocity == "tangent":
            second = q.plus(q.times(g_dot, Z), q.times(g, Z_dot))
            return (*place, *self._read(second, no_chart), *masses)
        return (*place, *self._moving(self.group.nearest(Z_dot)), *masses)


def named(name: str, *index: int) -> str:
    """The name of an entry whose indices are counted from 0: A_12."""
    apart = "_" if max(index) > 8 else ""
    return f"{name}_{apart.join(str(i + 1) for i in index)}"


# The numbers of charts.


def no_chart(chart: FactorChart) -> Numbers:
    """A state with dg/dt has none."""
    raise ValueError(f"dg/dt of a chart by {chart.kind}")


def numbers_of(chart: FactorChart, g: Matrix) -> Numbers:
    """Those that tell the block of g; of an angle, which no rational number is, one that is drawn
    for this g."""
    if chart.kind == QUATERNION:
        return quaternion(_block(chart, g))
    return tuple(x for block in chart.blocks for x in coordinates(block, g))


def rates_of(chart: FactorChart, g: Matrix, Z: Matrix) -> Numbers:
    """Their rates along g Z."""
    if chart.kind == QUATERNION:
        return half_product(quaternion(_block(chart, g)), axis(_block(chart, Z)))
    return tuple(
        sum((c * Z[i][j] for c, i, j in block.terms(k)), Fraction(0))
        for block in chart.blocks
        for k in range(len(block.members))
    )


def _block(chart: FactorChart, x: Matrix) -> Matrix:
    span = slice(chart.offset, chart.offset + chart.size)
    return tuple(row[span] for row in x[span])


def coordinates(block: CoordinateBlock, g: Matrix) -> Numbers:
    """Those of a block of g; where it turns or is scaled, a number drawn for it in the place of the
    angle, to which :func:`circles` gives its cosine and sine, or its exponential."""
    if not block.turn and not block.growth:
        return block.logarithm(g)
    shift = block.turned(g)[0] if block.turn else None
    drawn = Random(str(block.inside(g))).randint(1, ANGLES)
    return (Fraction(drawn) if shift is None else shift,)


def circles(charts: Iterable[FactorChart], g: Matrix) -> dict[tuple[str, Fraction], Any]:
    """(cos, sin or exp, argument) → the value that it has in the state of g."""
    found: dict[tuple[str, Fraction], Any] = {}
    for chart in charts:
        for block in chart.blocks:
            if block.turn:
                _, cosine, sine = block.turned(g)
                at = block.turn * coordinates(block, g)[0]
                found |= {("cos", at): cosine, ("sin", at): sine}
            if block.growth:
                found["exp", block.growth * coordinates(block, g)[0]] = block.scaled(g)
    return found


def quaternion(g: Matrix) -> Numbers:
    """The unit quaternion of a rotation that has one in rational numbers, its scalar positive.

    4 s² = 1 + Tr A and 4 s v = the axial vector of A − Ā.
    """
    scalar = q.root((1 + g[0][0] + g[1][1] + g[2][2]) / 4)
    if not scalar:
        raise ValueError("the quaternion of this rotation is not rational, or is a half turn")
    pairs = ((2, 1), (0, 2), (1, 0))
    return (scalar, *((g[i][j] - g[j][i]) / (4 * scalar) for i, j in pairs))


def axis(x: Matrix) -> Numbers:
    """The three entries of ζ, for a matrix with the linear part j(ζ)."""
    return (x[2][1], x[0][2], x[1][0])


def half_product(p: Numbers, zeta: Numbers) -> Numbers:
    """The quaternion ½ p ζ, Hamilton's product with ζ as a quaternion without scalar."""
    s, x, y, z = p
    a, b, c = zeta
    rates = (
        -x * a - y * b - z * c,
        s * a + y * c - z * b,
        s * b + z * a - x * c,
        s * c + x * b - y * a,
    )
    return tuple(r / 2 for r in rates)


@dataclass(frozen=True)
class ReducedChart(StateChart):
    """The chart of a problem with the key ``advected``: names and sizes of what it says."""

    advected: tuple[tuple[str, int], ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """ζ, then the entries of each quantity in order."""
        turns = (named("zeta", a) for a in range(self.group.dimension))
        return (*turns, *(named(x, i) for x, size in self.advected for i in range(size)))

    def with_advected(self, Z: Matrix, carried: Any) -> Numbers:
        """The numbers of the state at Z and Γ; or the rates, from Ż and Γ̇."""
        return (*self.group.nearest(Z), *(q.flatten(carried) if self.advected else ()))


def chart_of(group: Group, chart: Chart, problem: Mapping[str, Any]) -> StateChart:
    """The chart of a record's problem."""
    if "advected" not in problem:
        own = problem.get("lagrangian", {})
        held = tuple(own.get("held", ()))
        right, stored = own.get("trivialisation") == "right", tuple(stored_masses(problem))
        return StateChart(group, chart, right, held, stored)
    carried = tuple((x["name"], x["size"]) for x in problem["advected"])
    return ReducedChart(group, chart, advected=carried)
