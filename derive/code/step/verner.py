"""Verner's 'most efficient' pair of orders 9 and 8 with its interpolant of order 8, from its
definition: J. H. Verner, *Numerically optimal Runge–Kutta pairs with interpolants*, Numerical
Algorithms 53 (2010), 383–396.

He chose the nodes ``FREE``, the zeros of A and two numbers of it; the order conditions do the rest.
With the residuals of a stage q_i^(k) = Σ_j a_ij c_j^(k−1) − c_i^k/k, rows 4, 5 have q^(k) = 0 for
k ≤ 3, rows 6, 7 for k ≤ 4, rows 8 … 16 for k ≤ 5, those after them for k ≤ 8.  The weights are
those of quadrature on their nodes, and for order 9

    Σ_i b_i a_ij = b_j (1 − c_j);    with d_j = Σ_i b_i c_i a_ij, e_j = Σ_i b_i c_i² a_ij,
    d_6 = d_7 = e_6 = e_7 = 0,    Σ_j d_j a_j6 = Σ_j d_j a_j7 = 0,    Σ_j d_j q_j^(6) = 0,
    Σ_i b_i c_i q_i^(6) = Σ_i b_i c_i² q_i^(6) = Σ_i b_i c_i q_i^(7) = 0.

All this is linear, row by row and column by column, but for one number, c_12; so is what follows of
it for the embedded method and the interpolant, but for c_18.  Rows and nodes are counted from 1.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from decimal import Decimal, localcontext

from ...language import rational as q

FREE = {2: "0.03462", 5: "0.561", 8: "0.645", 10: "0.06757", 11: "0.25", 13: "0.8206"}
FREE |= {14: "0.9012", 15: "1", 16: "1", 17: "1", 19: "0.888", 20: "0.696", 21: "0.487"}
"""The nodes that Verner chose; node 1 is 0."""

A_11_6 = (1, 30)
"""a_11,6, chosen, as a fraction."""

A_21_20 = "-0.1150750712958503934434410263732282100773"
"""a_21,20, chosen so that the interpolant has a small error."""

NEAR_12, NEAR_18 = ("0.659", "0.6591"), ("0.74", "0.741")
"""Between which numbers c_12 and c_18 are looked for."""

ZERO, ONE, DIGITS = Decimal(0), Decimal(1), 60

Row = dict[int, Decimal]
Function = Callable[..., Decimal]
Condition = tuple[Function, Decimal]
"""Σ_j f(j) x_j = value: what a row x of unknown numbers satisfies."""


def verner() -> Pair:
    """The pair, every number to ``DIGITS``."""
    with localcontext() as context:
        context.prec = DIGITS + 15
        found = Pair()
        found.first_stages()
        found.c[12] = root(found.with_node_12, NEAR_12)
        found.embedded_method()
        found.extra_stages()
        found.interpolant()
    return found


@dataclass
class Pair:
    """Nodes c, rows of a, weights b and b̂, and for each power of θ, from the first, the weights of
    the interpolant; zeros of a row are left out."""

    c: Row = field(default_factory=lambda: {1: ZERO} | {i: Decimal(x) for i, x in FREE.items()})
    a: dict[int, Row] = field(default_factory=lambda: {1: {}})
    b: Row = field(default_factory=dict)
    embedded: Row = field(default_factory=dict)
    dense: list[Row] = field(default_factory=list)

    def at(self, i: int, j: int) -> Decimal:
        """a_ij."""
        return self.a[i].get(j, ZERO)

    def power(self, j: int, k: int) -> Decimal:
        """c_j^k, 1 for k = 0."""
        return self.c[j] ** k if k else ONE

    def residual(self, i: int, k: int) -> Decimal:
        """q_i^(k)."""
        return summed(self.a[i], lambda j: self.power(j, k - 1)) - self.c[i] ** k / k

    def moments(self, orders: int, value: Function) -> list[Condition]:
        """Σ_j x_j c_j^(k−1) = value of k, for k = 1 … orders."""

        def nodes(k: int) -> Function:
            return lambda j: self.power(j, k)

        return [(nodes(k - 1), value(k)) for k in range(1, orders + 1)]

    def vanishing_residuals(self, i: int, orders: int) -> list[Condition]:
        """q_i^(k) = 0 for k ≤ orders."""
        return self.moments(orders, lambda k: self.c[i] ** k / k)

    def set_row(self, i: int, unknown: Sequence[int], known: Row | None = None) -> None:
        """Row i: q_i^(k) = 0 for as many k as there are unknown numbers."""
        self.a[i] = row_of(unknown, self.vanishing_residuals(i, len(unknown)), known)

    def first_stages(self) -> None:
        """Rows 2 … 11, and the nodes that their residuals ask for."""
        c, root_6 = self.c, Decimal(6).sqrt()
        c[6], c[7], c[9] = (6 - root_6) / 10 * c[8], (6 + root_6) / 10 * c[8], 3 * c[8] / 4
        c[4] = c[6] * (4 * c[5] - 3 * c[6]) / (2 * (3 * c[5] - 2 * c[6]))
        c[3] = 2 * c[4] / 3
        rows = {2: [1], 3: [1, 2], 4: [1, 3], 5: [1, 3, 4], 6: [1, 4, 5], 7: [1, 4, 5, 6]}
        rows |= {8: [1, 6, 7], 9: [1, 6, 7, 8], 10: [1, 6, 7, 8, 9]}
        for i, unknown in rows.items():
            self.set_row(i, unknown)
        self.set_row(11, [1, 7, 8, 9, 10], {6: Decimal(A_11_6[0]) / A_11_6[1]})

    def with_node_12(self, c_12: Decimal) -> Decimal:
        """Rows 12 … 15 and the weights for a c_12; what Σ_j d_j q_j^(6) then is."""
        self.c[12] = c_12
        self.b = row_of([1, *range(8, 16)], self.moments(9, lambda k: 1 / Decimal(k)))
        b, c = self.b, self.c
        d = {14: b[14] * (1 - c[14])}  # of a_15,14 alone, as c_15 = 1
        e = dict(d)
        d = row_of([1, *range(8, 14)], self.moments(7, lambda k: 1 / Decimal(k * (k + 2))), d)
        self.a |= {13: {}, 14: {}, 15: {14: d[14] / b[15]}}
        self.set_column(13, (14, 15), (b[13] * (1 - c[13]), d[13]))
        e[13] = sum((b[i] * c[i] ** 2 * self.a[i][13] for i in (14, 15)), ZERO)
        e = row_of([1, *range(8, 13)], self.moments(6, lambda k: 1 / Decimal(k * (k + 3))), e)
        last: dict[str, Function] = {
            "a_6": lambda j: self.at(j, 6),
            "a_7": lambda j: self.at(j, 7),
            "q": lambda j: self.residual(j, 6),
        }

        def left(a_6: Decimal, a_7: Decimal) -> list[Decimal]:
            """Σ_j d_j a_j6, Σ_j d_j a_j7 and Σ_j d_j q_j^(6), linear in a_12,6 and a_12,7."""
            self.set_row(12, [1, 8, 9, 10, 11], {6: a_6, 7: a_7})
            for j in range(6, 13):
                sums = (b.get(j, ZERO) * (1 - c[j]), d.get(j, ZERO), e.get(j, ZERO))
                self.set_column(j, (13, 14, 15), sums)
            for i in (13, 14, 15):
                self.a[i][1] = c[i] - sum((x for j, x in self.a[i].items() if j > 1), ZERO)
            return [sum((d[j] * f(j) for j in range(8, 15)), ZERO) for f in last.values()]

        none, six, seven = left(ZERO, ZERO), left(ONE, ZERO), left(ZERO, ONE)
        matrix = [[six[m] - none[m], seven[m] - none[m]] for m in (0, 1)]
        a_6, a_7 = solved(matrix, [-none[0], -none[1]])
        return left(a_6, a_7)[2]

    def set_column(self, j: int, rows: Sequence[int], sums: Sequence[Decimal]) -> None:
        """a_ij of the rows, the last ones, by Σ_i b_i c_i^m a_ij for m = 0, 1, …"""

        def weight(i: int, m: int) -> Decimal:
            return self.b[i] * self.power(i, m)

        before = [i for i in range(8, rows[0]) if i in self.a]
        matrix = [[weight(i, m) for i in rows] for m in range(len(sums))]
        right = [
            value - sum((weight(i, m) * self.at(i, j) for i in before), ZERO)
            for m, value in enumerate(sums)
        ]
        for i, x in zip(rows, solved(matrix, right), strict=True):
            self.a[i][j] = x

    def embedded_method(self) -> None:
        """b̂ without stages 14, 15, and row 16, by Σ_i b̂_i a_ij = b̂_j (1 − c_j)."""
        own = row_of([1, *range(8, 14), 16], self.moments(8, lambda k: 1 / Decimal(k)))
        self.embedded, row = own, {}
        for j in range(6, 14):
            others = sum((own[i] * self.at(i, j) for i in range(8, 14)), ZERO)
            row[j] = (own.get(j, ZERO) * (1 - self.c[j]) - others) / own[16]
        self.a[16] = {1: self.c[16] - sum(row.values())} | row

    def order_8(self) -> list[Condition]:
        """What a combination x of good stages must satisfy for order 8 besides its moments, by the
        residuals of stages 6, 7 and by those of stages 8 … 15 after k = 5: Σ_j x_j f(j) = 0."""
        functions: tuple[Function, ...] = (
            lambda j: self.at(j, 6),
            lambda j: self.at(j, 7),
            lambda j: self.residual(j, 6),
            lambda j: self.c[j] * self.residual(j, 6),
            lambda j: self.residual(j, 7),
            lambda j: sum((self.at(j, m) * self.residual(m, 6) for m in range(8, j)), ZERO),
        )
        return [(of_stages_8_to_15(f), ZERO) for f in functions]

    def extra_stages(self) -> None:
        """Rows 17 … 21: the end of the step, and four within it."""
        self.a[17] = dict(self.b)
        stages, conditions = [1, *range(8, 16), 17], self.order_8()

        def with_node_18(c_18: Decimal) -> Decimal:
            self.c[18] = c_18
            self.a[18] = row_of(stages, self.vanishing_residuals(18, 8) + conditions[:2])
            return summed(self.a[18], conditions[2][0])

        self.c[18] = root(with_node_18, NEAR_18)
        known = {20: Decimal(A_21_20)}
        for i, also, count in ((19, [18], 3), (20, [18, 19], 4), (21, [18, 19], 4)):
            all_conditions = self.vanishing_residuals(i, 8) + conditions[:count]
            self.a[i] = row_of([*stages, *also], all_conditions, known if i == 21 else None)

    def interpolant(self) -> None:
        """The weights b_j(θ) = Σ_k d_jk θ^k, of which Σ_j b_j(θ) c_j^(k−1) = θ^k/k."""
        stages = [1, *range(8, 16), *range(17, 22)]
        whole, others = self.moments(8, lambda k: 1 / Decimal(k)), self.order_8()
        for power in range(1, 9):
            own = [(f, x if k == power else ZERO) for k, (f, x) in enumerate(whole, 1)]
            self.dense.append(row_of(stages, own + others))


def of_stages_8_to_15(f: Function) -> Function:
    """f of these stages, 0 of others."""
    return lambda j: f(j) if 8 <= j <= 15 else ZERO


def summed(row: Row, f: Function) -> Decimal:
    """Σ_j x_j f(j)."""
    return sum((x * f(j) for j, x in row.items()), ZERO)


def row_of(
    unknown: Sequence[int], conditions: Iterable[Condition], known: Row | None = None
) -> Row:
    """The row of which the conditions hold, with what is known of it."""
    given = known or {}
    pairs = [(f, value - summed(given, f)) for f, value in conditions]
    found = solved([[f(j) for j in unknown] for f, _ in pairs], [x for _, x in pairs])
    return given | dict(zip(unknown, found, strict=True))


def solved(matrix: Sequence[Sequence[Decimal]], right: Sequence[Decimal]) -> list[Decimal]:
    """The solution of a square system."""
    found = q.solve(q.matrix(matrix), q.column(right))
    assert found is not None
    return [x for (x,) in found]


def root(f: Function, near: tuple[str, str]) -> Decimal:
    """A zero of f by the secant method, from two numbers near it; f is last called there."""
    before, x = map(Decimal, near)
    old, new = f(before), f(x)
    while abs(x - before) > Decimal(10) ** -(DIGITS + 5) and new != old:
        before, old, x = x, new, x - new * (x - before) / (new - old)
        new = f(x)
    return x
