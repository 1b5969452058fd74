"""The charts of the factors of a group: which numbers tell a block, where they are not its entries.

A factor that turns R³ has a unit quaternion for its rotation.  A block in which the group acts by
exp(Σ x_a E_a) has the coordinates x_a: one parameter, E nilpotent or with E⁴ = −w²E² (a turn, a
screw), or diagonal with rational eigenvalues (a scaling, a boost), or several whose products
E_a E_b vanish.  What an affine factor translates by, T, is beside the chart of its linear part.
What has no chart is told by its entries.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import gcd
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from .groups import Group
from .samplers import one_parameter

QUATERNION, COORDINATES = "quaternion", "coordinates"

KINDS: dict[str, tuple[str, ...]] = {
    "matrix": (),
    "quaternion": (QUATERNION,),
    "angle": (COORDINATES,),
    "shortest": (QUATERNION, COORDINATES),
}
"""Value of ``--attitude`` → the kinds of charts that factors have, where they can."""


@dataclass(frozen=True)
class CoordinateBlock:
    """A block exp(Σ x_a E_a) of the group's matrices, in some ``rows`` from 0: ``basis``, the E_a
    in these rows; ``members``, the numbers a from 1; ``turn``: w where E⁴ = −w²E², 0 where
    products of the E_a vanish from some power on; ``growth``: l where the eigenvalues of E, which
    is diagonal in some basis, are integers times l, ±1 among these, else 0."""

    rows: tuple[int, ...]
    basis: tuple[Matrix, ...]
    members: tuple[int, ...]
    turn: Fraction
    growth: Fraction = Fraction(0)

    @property
    def names(self) -> tuple[str, ...]:
        """Those of the x_a: an angle where the block turns."""
        return tuple(suffixed("theta" if self.turn else "s", a) for a in self.members)

    @cached_property
    def powers(self) -> tuple[Matrix, ...]:
        """1, E, E², … of one parameter: up to E³ of a turn, else those that do not vanish."""
        found, zero = [q.identity(len(self.rows))], q.scaled(0, q.identity(len(self.rows)))
        while (power := q.times(found[-1], self.basis[0])) != zero:
            found.append(power)
            if self.turn and len(found) == 4:
                break
        return tuple(found)

    def terms(self, k: int) -> list[tuple[Fraction, int, int]]:
        """The terms (coefficient, i, j), in the group's matrices, of the k-th coordinate of an
        element of the algebra."""
        terms = _spanned(self.basis).coordinate_terms(k)
        return [(c, self.rows[i], self.rows[j]) for c, i, j in terms]

    def inside(self, g: Matrix) -> Matrix:
        """The block of an element of the group, over any field."""
        return tuple(tuple(g[i][j] for j in self.rows) for i in self.rows)

    def logarithm(self, g: Matrix) -> tuple[Any, ...]:
        """The coordinates of g where products vanish from some power on: Mercator's series."""
        N = q.minus(self.inside(g), q.identity(len(self.rows)))
        power, total = N, q.scaled(Fraction(0), N)
        for n in range(1, len(N) + 1):
            total = q.plus(total, q.scaled(Fraction((-1) ** (n + 1), n), power))
            power = q.times(power, N)
        return _spanned(self.basis).nearest(total)

    @cached_property
    def parts_of_turn(self) -> tuple[Matrix, ...]:
        """The four matrices P with exp xE = P₀ + x P₁ + cos(wx) P₂ + sin(wx) P₃: 1 + E²/w²,
        E + E³/w², −E²/w² and −E³/w³."""
        w, (one, E, square, cube) = self.turn, self.powers
        return (
            q.plus(one, q.scaled(1 / w**2, square)),
            q.plus(E, q.scaled(1 / w**2, cube)),
            q.scaled(-1 / w**2, square),
            q.scaled(-1 / w**3, cube),
        )

    def turned(self, g: Matrix) -> tuple[Any, Any, Any]:
        """The x, cos wx and sin wx of a block that turns; ``None`` for an x that it does not tell,
        where nothing is shifted."""
        known, slide, *circle = self.parts_of_turn
        found = q.minus(self.inside(g), known)
        if not any(map(any, slide)):
            return (None, *_spanned(circle).nearest(found))
        return _spanned([slide, *circle]).nearest(found)

    @cached_property
    def scalings(self) -> tuple[tuple[int, Matrix], ...]:
        """The n and projections P with exp xE = Σ eⁿˡˣ P, l the growth."""
        known = one_parameter(self.basis[0])
        assert known is not None
        shared = gcd(*(n for n, _ in known.powers))
        return tuple((n // shared, P) for n, P in known.powers)

    def scaled(self, g: Matrix) -> Any:
        """The eˡˣ of a block that is scaled, over any field."""
        found = _spanned([P for _, P in self.scalings]).nearest(self.inside(g))
        n, y = next((n, y) for (n, _), y in zip(self.scalings, found, strict=True) if n**2 == 1)
        return y if n == 1 else 1 / y


@dataclass(frozen=True)
class FactorChart:
    """That of a factor, of ``size`` rows of the group's matrices from ``offset`` on; ``mark``: its
    number among several.

    ``blocks``: of a chart by coordinates, all that vary in the factor; ``shifted``: but for T,
    whose entries are told beside the chart.
    """

    kind: str
    offset: int
    size: int
    mark: str
    blocks: tuple[CoordinateBlock, ...]
    shifted: bool

    @property
    def names(self) -> tuple[str, ...]:
        """Those of its numbers, in the order of the state."""
        if self.kind == QUATERNION:
            return tuple(suffixed(f"q{self.mark}", i) for i in range(4))
        return tuple(name for block in self.blocks for name in block.names)


def _spanned(basis: Sequence[Matrix]) -> Group:
    """A space of matrices, for what reads the coordinates of its elements."""
    return Group("", len(basis[0]), "linear", tuple(basis), lambda *_: ())


def factor_charts(group: Group, attitude: str) -> dict[int, FactorChart]:
    """Place of a factor, from 0, → its chart, of those that have one."""
    found = {}
    for k, (offset, factor) in enumerate(group.places):
        mark = str(k + 1) if len(group.places) > 1 else ""
        if QUATERNION in KINDS[attitude] and turns_space(factor):
            found[k] = FactorChart(QUATERNION, offset, factor.n, mark, (), factor.affine)
        elif COORDINATES in KINDS[attitude] and not factor.vectors:
            apart = _translates(factor)
            size = factor.n if apart else factor.size
            if blocks := _blocks(group, range(offset, offset + size)):
                found[k] = FactorChart(COORDINATES, offset, size, mark, blocks, apart)
    return found


def turns_space(factor: Group) -> bool:
    """Is it SO(3) or SE(3), in any basis?"""
    linear = [factor.linear_part(e) for e in factor.basis]
    skew = all(q.plus(e, q.transposed(e)) == q.scaled(0, q.identity(factor.n)) for e in linear)
    return skew and factor.n == 3 and len(linear) == 3 + 3 * factor.affine and _whole(factor)


def _whole(factor: Group) -> bool:
    """Are all translations in it, where there are some, and so all of its linear parts?"""
    return not factor.affine or _translates(factor)


def _translates(factor: Group) -> bool:
    """Are the translations alone a part Rⁿ of an affine group?"""
    if not factor.affine:
        return False
    return len(factor.linear_basis) == factor.dimension - factor.n


def _blocks(group: Group, rows: Sequence[int]) -> tuple[CoordinateBlock, ...]:
    """The blocks that elements of the basis move apart from one another in some rows; none where
    one of them has no coordinates."""
    found: list[tuple[set[int], list[tuple[int, Matrix]]]] = []
    for a, e in enumerate(group.basis, 1):
        moved = {x for i in rows for j in rows if e[i][j] for x in (i, j)}
        joined = [x for x in found if x[0] & moved]
        if moved:
            found = [x for x in found if x not in joined]
            members = [y for x in joined for y in x[1]]
            found.append((moved.union(*(x[0] for x in joined)), [*members, (a, e)]))
    blocks = [_block(sorted(places), members) for places, members in found]
    known = [x for x in blocks if x is not None]
    return tuple(known) if len(known) == len(blocks) else ()


def _block(rows: Sequence[int], members: Sequence[tuple[int, Matrix]]) -> CoordinateBlock | None:
    """The block of these members, where it has coordinates."""
    basis = tuple(tuple(tuple(e[i][j] for j in rows) for i in rows) for _, e in members)
    numbers, zero = tuple(a for a, _ in members), q.scaled(0, q.identity(len(rows)))
    if len(basis) > 1:
        flat = all(q.times(x, y) == zero for x in basis for y in basis)
        flat = flat and q.rank(tuple(map(q.flatten, basis))) == len(basis)
        return CoordinateBlock(tuple(rows), basis, numbers, Fraction(0)) if flat else None
    turn = _turn(basis[0])
    growth = Fraction(0) if turn is not None else _growth(basis[0])
    known = turn is not None or growth
    return (
        CoordinateBlock(tuple(rows), basis, numbers, turn or Fraction(0), growth) if known else None
    )


def _growth(e: Matrix) -> Fraction:
    """The l of which eigenvalues of E are integer multiples, ±1 among these; 0 for none, or where E
    is not diagonal in a basis over Q."""
    known = one_parameter(e)
    if known is None or any(map(any, (*known.plane, *known.nilpotent))):
        return Fraction(0)
    values = [x for n, P in known.powers for x in [_eigenvalue(e, P)] if n]
    least = min(map(abs, values))
    return least if all((x / least).denominator == 1 for x in values) else Fraction(0)


def _eigenvalue(e: Matrix, projection: Matrix) -> Fraction:
    """That of E on the image of a projection."""
    image = q.times(e, projection)
    i, j = next((i, j) for i, row in enumerate(projection) for j, x in enumerate(row) if x)
    return Fraction(image[i][j] / projection[i][j])


def _turn(e: Matrix) -> Fraction | None:
    """The w of E⁴ = −w²E², 0 where E is nilpotent; ``None`` for no or an irrational one."""
    square = q.times(e, e)
    fourth = q.times(square, square)
    power, zero = e, q.scaled(0, e)
    for _ in e:
        power = q.times(power, e)
    if power == zero:
        return Fraction(0)
    i, j = next((i, j) for i, row in enumerate(square) for j, x in enumerate(row) if x)
    ratio = -fourth[i][j] / square[i][j]
    return q.root(ratio) or None if fourth == q.scaled(-ratio, square) else None


def chart_names(group: Group) -> Iterable[str]:
    """Those of all charts that the factors of a group can have."""
    return (
        name for x in KINDS for chart in factor_charts(group, x).values() for name in chart.names
    )
