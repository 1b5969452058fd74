"""The state of a program: which numbers it holds in which order, their rates, their variations.

First the group element: A row by row (or column by column), for an affine group then T; for a
product factor after factor, the blocks of one matrix whose other entries are 0, or 1 where an
affine factor has its last row; or the numbers of the chart of a factor, and its T.  Then the
velocity: the coordinates ζ of Z = g⁻¹ġ (and w), or the entries of ġ.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from fractions import Fraction
from functools import cached_property

from ..algebra.factor_charts import FactorChart, factor_charts
from ..algebra.groups import Group
from ..algebra.relations import skew
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from . import dense, slots
from .graph import Graph, Node
from .options import Options
from .slots import OfElement, StateSlot, fixed_entries, order, still_slots

Seeds = dict[Node, Node]
"""A variation of the state: leaf → its derivative."""

Named = Callable[[str], Matrix]
Component = Callable[[str, int], Node]


class StateSpace:
    """The numbers of a state: ``names`` in order; ``values``: A, T, ζ, w as nodes in them.

    ``right``: is Z = ġg⁻¹, and a variation δg = η g? ``held``: coordinates ζ_a, from 1, that are 0
    and no numbers of the state; ``null``: of each the direction in 𝔤 that is a symmetry.
    """

    null: Sequence[Sequence[Fraction]] = ()

    def __init__(
        self,
        graph: Graph,
        group: Group,
        options: Options,
        *,
        right: bool = False,
        held: Collection[int] = (),
    ):
        self.right, self.held = right, held
        self.graph, self.group, self.n = graph, group.in_user_basis, group.n
        self.standard = group
        self.still = still_slots(group) if options.state == "moving" else {}
        self.charts = factor_charts(self.group, options.attitude)
        ordered = order(group, options.layout == "col", self.charts)
        self.held_of_g = [x for x in ordered if x not in self.still]
        self.tangent = options.velocity == "tangent"
        self.names: list[str] = []
        self.values: dict[str, Matrix] = {}
        self.numbers: dict[OfElement, list[Node]] = {}
        self.stored: dict[str, Node] = {}
        self._element()
        self._velocity()

    def store(self, masses: Sequence[str]) -> None:
        """Add masses to the state, by their names."""
        self.stored = {name: self._leaf(name) for name in masses}

    # -- the group element -------------------------------------------------------------------

    def _leaf(self, name: str) -> Node:
        """A new number of the state."""
        self.names.append(name)
        return self.graph.leaf(name, "state")

    @property
    def has_element(self) -> bool:
        """Does the state hold an element of the group?"""
        return True

    @property
    def slots(self) -> list[StateSlot]:
        """Those of the entries of A and T that the state holds, beside charts those of T."""
        return [x for x in self.held_of_g if isinstance(x, StateSlot)]

    def _element(self) -> None:
        """Add the numbers of the group element; set A and T."""
        for x in self.held_of_g:
            own = x.names if isinstance(x, FactorChart) else (x.name,)
            self.numbers[x] = [self._leaf(name) for name in own]
        placed = self._placed({x: self.numbers[x][0] for x in self.slots})
        self.values["A"] = placed["A"]
        if self.group.affine:
            self.values["T"] = placed["T"]

    def _placed(self, leaves: Mapping[StateSlot, Node], *, rate: bool = False) -> dict[str, Matrix]:
        """The leaves in their places of A and T, with what else is known of g; or of ġ."""
        span, num = range(self.n), self.graph.num
        known = {(x.letter, x.row, x.column): y for x, y in leaves.items()}
        if not rate:
            known |= {("A", *place): num(x) for place, x in fixed_entries(self.group).items()}
            known |= {(x.letter, x.row, x.column): num(y) for x, y in self.still.items()}
            for chart in self.charts.values():
                own = slots.entries(self.graph, chart, self.numbers[chart])
                known |= {("A", *place): y for place, y in own.items()}
        return {
            "A": tuple(tuple(known.get(("A", i, j), num(0)) for j in span) for i in span),
            "T": tuple((known.get(("T", i, 0), num(0)),) for i in span),
        }

    @property
    def free(self) -> list[int]:
        """The coordinates of variations η and δζ, from 0: those that are not held."""
        return [a for a in range(self.group.dimension) if a + 1 not in self.held]

    def variations(self) -> dict[str, Seeds]:
        """Those of a basis, by what they are along: η, then δζ, then masses; on a quotient modulo
        its symmetries."""
        turned = {f"eta_{a + 1}": self.along(a) for a in self.free}
        moved = {f"zeta_{a + 1}": self.faster(a) for a in self.free}
        return turned | moved | {x: {y: self.graph.num(1)} for x, y in self.stored.items()}

    def along(self, a: int) -> Seeds:
        """The variation δg = g E_a, or E_a g, at constant ζ; a from 0."""
        e = self.member(a)
        if self.right:
            changes = q.times(e, self.values["A"])
            pairs = zip(q.flatten(self.values["A"]), q.flatten(changes), strict=True)
            seeds = {leaf: x for leaf, x in pairs if leaf.op == "leaf"}
        else:
            seeds = self._changed(e, "A", "T")
        for chart in self.charts.values():
            x = self.numbers[chart]
            seeds |= dict(zip(x, slots.rates(self.graph, chart, x, e), strict=True))
        if self.tangent:  # δġ = g E_a Z
            seeds |= self._changed(q.times(e, self.hat(self.coordinates)), "α", "τ")
        return seeds

    def faster(self, a: int) -> Seeds:
        """The variation of ζ_a alone; a from 0."""
        if self.tangent:
            return self._changed(self.member(a), "α", "τ")
        return {self.coordinates[a]: self.graph.num(1)}

    def member(self, a: int) -> Matrix:
        """E_a as a matrix of nodes; a from 0."""
        return dense.numbers(self.graph, self.group.basis[a])

    def _changed(self, e: Matrix, linear: str, shift: str) -> Seeds:
        """The leaves of these letters, where they have a value, for a change g e of g or of ġ."""
        parts = {linear: self.group.linear_part(e)} if linear else {}
        if self.group.affine:
            parts[shift] = self.group.translation_part(e)
        changes = (
            zip(q.flatten(self.values[x]), q.flatten(q.times(self.values["A"], part)), strict=True)
            for x, part in parts.items()
        )
        return {leaf: x for change in changes for leaf, x in change if leaf.op == "leaf"}

    # -- the velocity ------------------------------------------------------------------------

    def _velocity(self) -> None:
        """Add the numbers of the velocity; set ζ, w, and with ġ in the state α, τ."""
        turns = self._turns
        if not self.tangent:
            # all come before w, unless a stated basis mixes them
            stated = turns if self.group.free_translations else self.group.dimension
            zeta = [
                self.graph.num(0) if a in self.held else self._leaf(suffixed("zeta", a))
                for a in self._span(stated)
            ]
            moved = self._span(self.group.dimension - len(zeta))
            self.coordinates = [*zeta, *(self._leaf(suffixed("w", i)) for i in moved)]
            values = self.coordinates
            if self.standard is not self.group:
                values = self.read(self.hat(values), self.standard)
            self.values["ζ"] = tuple((x,) for x in values[:turns])
            if self.group.affine:
                self.values["w"] = tuple((x,) for x in values[turns:])
            return
        placed = self._placed({x: self._leaf(f"{x.name}_dot") for x in self.slots}, rate=True)
        inverse = self.inverse
        Z = q.times(inverse, placed["A"])
        self.values |= {"α": placed["A"], "τ": placed["T"]}
        if self.group.affine:
            w = q.times(inverse, placed["T"])
            self.values["w"] = self._named("w", w, column=True)
            Z = q.bordered(Z, w, self.graph.num(0))
        turning = tuple((x,) for x in self.read(Z, self.standard)[:turns])
        self.values["ζ"] = self._named("zeta", turning, column=True)
        found = [*self.values["ζ"], *self.values.get("w", ())]
        self.coordinates = self._in_user_basis([x for (x,) in found])

    def _back(self) -> Matrix:
        """The inverse [[Ā, −ĀT], [0, 1]] of every block, if all factors have skew linear parts."""
        A, ones, span = self.values["A"], fixed_entries(self.group), range(self.n)
        corners = tuple(tuple(Fraction(ones.get((i, j), 0)) for j in span) for i in span)
        last = dense.numbers(self.graph, corners)
        linear = dense.numbers(self.graph, q.minus(q.identity(self.n), corners))
        bar = q.times(q.times(linear, q.transposed(A)), linear)
        return q.minus(q.plus(bar, last), q.times(bar, q.times(A, last)))

    @property
    def _turns(self) -> int:
        """The dimension of the linear parts: how many numbers ζ has."""
        return self.group.dimension - (self.n if self.group.affine else 0)

    def read(self, z: Matrix, group: Group | None = None) -> list[Node]:
        """The coordinates of a matrix of 𝔤 in the stated basis, or in that of a group."""
        group = group or self.group
        places = map(group.coordinate_terms, range(group.dimension))
        return [self.graph.linear((c, z[i][j]) for c, i, j in place) for place in places]

    def _in_user_basis(self, coordinates: list[Node]) -> list[Node]:
        """The coordinates ζ and w of the standard basis, in the stated one."""
        if self.standard is self.group:
            return coordinates
        return self.read(self._matrix(self.standard, coordinates))

    @staticmethod
    def _span(count: int) -> range:
        return range(1, count + 1)

    def _named(self, name: str, m: Matrix, *, column: bool = False) -> Matrix:
        """The matrix, or the column, with its entries named."""
        return dense.entrywise(m, name, self.graph.value, column)

    @cached_property
    def inverse(self) -> Matrix:
        """A⁻¹, its entries named."""
        return self._named("inv_A", self._inverse())

    def _inverse(self) -> Matrix:
        """A⁻¹: the transpose of a rotation, else the adjugate, or (ĀA)⁻¹Ā for a large A."""
        A, g = self.values["A"], self.graph
        if "orthogonal" in self.group.relations:
            return q.transposed(A)
        if self.group.factors and all(skew(factor) for factor in self.group.factors):
            return self._back()
        if self.n > 3:
            bar = q.transposed(A)
            inverse_square, _ = dense.symmetric_inverse(
                g, q.times(bar, A), lambda name, x: g.value(x, f"gram_{name}")
            )
            return q.times(inverse_square, bar)
        adjugate = dense.adjugate(g, A)
        if "unimodular" in self.group.relations:
            return adjugate
        return q.scaled(g.value(g.recip(dense.determinant(A)), "inv_det_A"), adjugate)

    # -- rates and variations ----------------------------------------------------------------

    def velocity(self, component: Component) -> list[Node]:
        """The accelerations ζ̇, and ẇ where there is w, in the stated basis."""
        found = [component("ζ̇", a) for a in self._span(self._turns) if a not in self.held]
        found += [component("ẇ", i) for i in self._span(self.n)] if self.group.affine else []
        return self._in_user_basis(found)

    def rates(self, name: Named, component: Component, *, in_space: bool = False) -> list[Node]:
        """The time derivative of each number, from the names and components of the record.

        ``in_space``: the record has the accelerations α̇ and τ̇.
        """
        affine, velocity = self.group.affine, [] if in_space else self.velocity(component)
        if self.tangent:
            speeds = self._entries(self.values["α"], self.values["τ"])
            if not in_space:
                return speeds + self._second(velocity)
            return speeds + self._entries(name("α̇"), name("τ̇") if affine else ())
        Ȧ, Ṫ = name("Ȧ"), name("Ṫ") if affine else ()
        moved = [x for name in ("ζ", "w") for (x,) in self.values.get(name, ())]
        Z = self._matrix(self.standard, moved) if self.charts else ()
        speeds = []
        for x in self.held_of_g:
            if isinstance(x, FactorChart):
                speeds += slots.rates(self.graph, x, self.numbers[x], Z)
            else:
                speeds += self._entries(Ȧ, Ṫ, [x])
        return speeds + velocity

    def _entries(
        self, A: Matrix, T: Matrix, slots: Sequence[StateSlot] | None = None
    ) -> list[Node]:
        """The entries of A and T that are numbers of the state, in its order, or those of some
        slots."""
        listed = self.slots if slots is None else slots
        return [{"A": A, "T": T}[x.letter][x.row][x.column] for x in listed]

    def entries(self, g: Matrix, slots: Sequence[StateSlot] | None = None) -> list[Node]:
        """The state's entries of A or [[A, T], [0, 1]], or those of some slots; beside a chart
        those of T alone."""
        listed = self.slots if slots is None else slots
        return [g[x.row][self.n if x.letter == "T" else x.column] for x in listed]

    @property
    def element(self) -> Matrix:
        """The group element g as nodes, of the size of the group's matrices."""
        return self.homogeneous(self.values["A"], self.values.get("T", ()), 1)

    @property
    def velocity_names(self) -> tuple[str, str]:
        """What the linear part of ġ and its shift are called: numbers of the state, or by ζ."""
        return ("α", "τ") if self.tangent else ("Ȧ", "Ṫ")

    @property
    def rate(self) -> Matrix:
        """ġ as nodes, of the size of the group's matrices, where the state holds it."""
        return self.homogeneous(self.values["α"], self.values.get("τ", ()))

    def homogeneous(self, linear: Matrix, shift: Matrix, corner: int = 0) -> Matrix:
        """The matrix [[linear, shift], [0, corner]] of an affine group; ``linear`` of a linear
        one."""
        return q.bordered(linear, shift, self.graph.num(corner)) if self.group.affine else linear

    def hat(self, coordinates: Sequence[Node]) -> Matrix:
        """The matrix Σ x_a E_a of coordinates in the stated basis."""
        return self._matrix(self.group, coordinates)

    def _matrix(self, group: Group, coordinates: Sequence[Node]) -> Matrix:
        basis, span = group.basis, range(group.size)
        return tuple(
            tuple(
                self.graph.linear(
                    (e[i][j], x) for e, x in zip(basis, coordinates, strict=True) if e[i][j]
                )
                for j in span
            )
            for i in span
        )

    def _second(self, rate: list[Node]) -> list[Node]:
        """The numbers of g̈ = g(Ż + Z²), its linear part and its shift; ``rate``: ζ̇ and ẇ."""
        Z = self.hat(self.coordinates)
        total = q.plus(self.hat(rate), q.times(Z, Z))
        named, A = self._named("Y", total), self.values["A"]
        linear = q.times(A, self.group.linear_part(named))
        shift = q.times(A, self.group.translation_part(named)) if self.group.affine else ()
        return self._entries(linear, shift)
