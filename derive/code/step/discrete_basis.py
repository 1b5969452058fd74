"""A discrete step on any group: dim 𝔤 equations, those of the balance on a basis E_a.

The step is V = g₀⁻¹g₁ − 1, found by Newton's method with turns 1 + V ← (1 + V)W.  In the balance
what has g₂ is Θ⁻ of the step after g₁, and what has g₀, Θ⁺ of that before: both are linear in the
step.

A turn W by X in 𝔤 is 1 + X to first order: by Cayley's transform, or the exponential. W = (1 −
½X)⁻¹(1 + ½X) is in the group where 𝔤 has the cubes of its elements, as so(n), sp(n), se(n) and
nilpotents of degree 3 have, and no traces: it is exp 2 artanh ½X, an odd series.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property

from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, add, mul, replaced, terms
from .. import dense
from ..graph import Node
from .discrete_ends import Ends, has
from .discrete_special import change

MOST = 12
"""The powers of X that the exponential has, for turns of at most 0.3.  Of those of 1e-8 and less,
1 + X is exact to rounding."""

Places = list[tuple[int, int]]


def turned(
    e: Ends, V: Matrix, U: Matrix, places: Places, turns: list[Node]
) -> dict[str, list[Node]]:
    """The functions that give V after 1 + V = U ← UW, X of coordinates ``turns``."""
    X = e.named(e.space.hat(turns), "X")
    whole = cayley(e, X) if has_cubes(e.group) else exponential(e, X, MOST)
    ways = {"step_turn": whole, "step_turn_little": X}
    ends = {name: q.plus(V, q.times(U, W)) for name, W in ways.items()}
    return {name: [m[i][j] for i, j in places] for name, m in ends.items()}


def has_cubes(group: Group) -> bool:
    """Is X³ in 𝔤 for every X of it, and Tr X = 0?  By all E_aE_bE_c with each order of them, of
    which X³ is made."""
    if "unimodular" not in group.relations:
        return False
    span = range(group.dimension)
    products = {(a, b): q.times(group.basis[a], group.basis[b]) for a in span for b in span}
    for a in span:
        for b in span[a:]:
            both = q.plus(products[a, b], products[b, a])
            for c in span[b:]:
                last, whole = group.basis[c], q.times(both, group.basis[c])
                for x, y in ((a, b), (b, a)):
                    ends = q.plus(
                        q.times(last, products[x, y]), q.times(products[x, c], group.basis[y])
                    )
                    whole = q.plus(whole, ends)
                if group.vee(whole) is None:
                    return False
    return True


def cayley(e: Ends, X: Matrix) -> Matrix:
    """W − 1, by the characteristic polynomial Σ c_i λ^(N−i) of Y = ½X, which has even i alone:

    ½(W − 1) = Y(1 − Y)⁻¹ = (Σ_k s_(N−k−1) Yᵏ − c_N) / s_N,  s_m = c_0 + … + c_m,  k = 1 … N − 1.
    """
    g, N = e.graph, len(X)
    Y = e.named(q.scaled(Fraction(1, 2), X), "Y")
    powers = [dense.numbers(g, q.identity(N)), Y]
    for k in range(2, N):
        powers.append(e.named(q.times(powers[k - 1], Y), f"power_{k}"))
    c, s = [e.one], [e.one]
    for k in range(1, N + 1):
        even = k % 2 == 0 and k <= e.group.n
        total = (
            g.sum(c[k - i] * _traced(powers, i) for i in range(2, k + 1, 2)) if even else g.num(0)
        )
        c.append(g.value(total * Fraction(-1, k), f"c_{k}"))
        s.append(g.value(g.sum(c), f"s_{k}"))
    whole = q.scaled(-c[N], powers[0])
    for k in range(1, N):
        whole = q.plus(whole, q.scaled(s[N - k - 1], powers[k]))
    over = g.value(g.recip(s[N]) * 2, "over")
    return e.named(q.scaled(over, e.named(whole, "above")), "beside")


def _traced(powers: list[Matrix], k: int) -> Node:
    """Tr Yᵏ, k even."""
    half = powers[k // 2]
    return dense.dot(half, q.transposed(half))


def exponential(e: Ends, X: Matrix, order: int) -> Matrix:
    """W − 1, W = exp X by the series up to a power that 3 divides."""
    square = e.named(q.times(X, X), "square")
    cube = e.named(q.times(square, X), "cube")
    factorial = [Fraction(1)]
    for k in range(1, order + 1):
        factorial.append(factorial[-1] / k)
    total: Matrix | None = None
    for first in range(order - 2, 0, -3):
        three = e.zero(X)
        for k, power in enumerate((X, square, cube)):
            three = q.plus(three, q.scaled(factorial[first + k], power))
        three = three if total is None else q.plus(three, q.times(cube, total))
        total = e.named(three, f"series_{first}")
    assert total is not None
    return total


def pattern(basis: tuple[Matrix, ...], size: int) -> list[tuple[int, int]]:
    """The places where a product of some E_a may have an entry that is not 0, by rows."""
    span = range(size)
    found = {(i, j) for e in basis for i in span for j in span if e[i][j]}
    while True:
        more = found | {(i, j) for i, k in found for m, j in found if k == m}
        if more == found:
            return sorted(found)
        found = more


BEND: Tree = ("add", "g_2", ("mul", -2, "g_1"), "g_0")
OF_STEP: Tree = ("mul", "g_1", "V")


class OnBasis:
    """The equations on the basis, and the letters V, U = 1 + V and C = ḡg in them."""

    def __init__(self, e: Ends, moments: Matrix, damping: Matrix | None, steps: list[Node]):
        self.e, size = e, range(e.group.size)
        self.places = pattern(e.group.basis, e.group.size)
        leaves = dict(zip(self.places, steps, strict=True))
        zero, one = e.graph.num(0), e.one
        V: Matrix = tuple(tuple(leaves.get((i, j), zero) for j in size) for i in size)
        U = q.plus(V, dense.numbers(e.graph, q.identity(e.group.size)))
        own = e.lowering.reader
        hatted = e.group.affine
        own.state |= {"V": V, "U": U, "C": self._square}
        own.state |= {"Ĵ" if hatted else "J": moments}
        if damping:
            own.state |= {"D̂" if hatted else "D": damping}
        self.V, self.U = V, U
        n = e.group.n
        if hatted:
            own.state["ι"] = tuple(
                tuple(one if i == j else zero for j in range(n)) for i in range(n + 1)
            )
            own.state["o"] = tuple((one if i == n else zero,) for i in range(n + 1))
        for a, m in enumerate(e.group.basis, 1):
            own.memo["at", "E", a] = dense.numbers(e.graph, m)

    @property
    def span(self) -> range:
        """The indices of the basis."""
        return range(1, self.e.group.dimension + 1)

    @cached_property
    def _square(self) -> Matrix:
        """C = ḡg on displacements of points: 1 where g turns."""
        e, A = self.e, self.e.space.values["A"]
        if "orthogonal" in e.group.relations:
            return dense.numbers(e.graph, q.identity(e.group.size))
        C = e.named(q.times(q.transposed(A), A), "C")
        if not e.group.affine:
            return C
        return q.bordered(C, e.zero(tuple((row[0],) for row in C)), e.graph.num(0))

    # -- the balance ---------------------------------------------------------------------------

    @cached_property
    def _balance(self) -> tuple[tuple[Tree, ...], str]:
        """The terms of what vanishes for every ξ, and the name of ξ."""
        e = self.e
        if e.has("dalembert"):
            step = e.record["dalembert"]
        else:
            step = e.record["discrete_affine.balance" if e.group.affine else "discrete.balance"]
        (found,) = step.equations
        e.label = step.key(found)
        (xi,) = found.for_all
        return terms(found.lhs), xi

    def _on(self, a: int, kept: Iterator[Tree]) -> Tree:
        _, xi = self._balance
        return replaced(add(*kept), xi, ("at", "E", a))

    def _ends(self, letter: str, moved: Tree) -> Iterator[Tree]:
        """h times the terms that are linear in the step on the side of g₂, or g₀."""
        for term in self._balance[0]:
            if has(term, "g_0", "g_2"):
                bent = replaced(term, BEND, letter)
                if has(bent, letter):
                    yield replaced(_times_h(bent), letter, moved)

    def before(self, a: int, moved: Tree = OF_STEP) -> Node:
        """h times what Θ⁻ has on E_a, of a change ``moved`` of the element."""
        return self._number(self._on(a, self._ends("g_2", moved)))

    def after(self, a: int) -> Node:
        """h times what Θ⁺ has on E_a at the end of the step: there g is g₁U."""
        there: Tree = ("mul", ("T", "U"), ("T", "g_1"))
        found = (replaced(x, ("T", "g_1"), there) for x in self._ends("g_0", "g_2"))
        return self._number(self._on(a, (replaced(x, "g_2", OF_STEP) for x in found)))

    def pushed(self, a: int) -> Node:
        """What the forces have on E_a."""
        e = self.e
        if self._with_forces:
            own = (x for x in self._with_forces if not has(x, "g_0", "g_2"))
            t = replaced(add(*own), ("at", "E", "a"), ("at", "E", a))
        else:
            t = self._on(a, (x for x in self._balance[0] if not has(x, "g_0", "g_2")))
        return -e.number(t, {"h": e.one, **self._forces})

    @cached_property
    def _with_forces(self) -> tuple[Tree, ...]:
        """The terms of the balance on E_a with the forces of the problem in it, where the record
        has that: there it is shorter."""
        found = self.e.record["motion"].equations[-1]
        return terms(found.lhs) if has(found.lhs, "E") else ()

    @cached_property
    def _forces(self) -> dict[Tree, Matrix]:
        """N̂₁, of N₁ and f₁, which may be 0; its last row is not seen."""
        e, values = self.e, self.e.space.values
        found: dict[Tree, Matrix] = {"N_1": self._shaped("N_1", values["A"])}
        if e.group.affine:
            f = self._shaped("f_1", values["T"])
            found["N̂_1"] = q.bordered(found["N_1"], f, e.graph.num(0))
        return found

    def _shaped(self, name: str, like: Matrix) -> Matrix:
        """The value of a name, which may be 0."""
        found = self.e.value(name)
        return self.e.zero(like) if isinstance(found, Node) else found

    def _number(self, t: Tree) -> Node:
        return self.e.number(_gathered(t))

    # -- what is lowered -----------------------------------------------------------------------

    def metric(self) -> list[list[Node]]:
        """M: on E_a, of the velocity g E_b, without damping."""
        return [
            [self._undamped(a, ("mul", "g_1", ("at", "E", b))) for b in self.span]
            for a in self.span
        ]

    def momentum(self) -> list[Node]:
        """M ζ."""
        e = self.e
        Z = e.named(e.space.hat(e.space.coordinates), "Z")
        e.lowering.reader.state["Z"] = Z
        return [self._undamped(a, ("mul", "g_1", "Z")) for a in self.span]

    def _undamped(self, a: int, moved: Tree) -> Node:
        found = (x for x in self._ends("g_2", moved) if not has(x, "h"))
        return self._number(self._on(a, found))

    def slopes(self) -> list[list[Node]]:
        """The derivative of what Θ⁻ has on E_a, for δg = g₁U E_b."""
        moved: list[Tree] = [("mul", "g_1", "U", ("at", "E", b)) for b in self.span]
        return [[self.before(a, x) for x in moved] for a in self.span]


def basis(
    e: Ends,
    moments: Matrix,
    damping: Matrix | None,
    momentum: list[Node],
    steps: list[Node],
    turns: list[Node],
) -> dict[str, list[Node]]:
    """The functions of a step; ``turns``: leaves of the coordinates of X."""
    own, g = OnBasis(e, moments, damping, steps), e.graph
    span = own.span
    left = [own.before(a) - p for a, p in zip(span, momentum, strict=True)]
    moved = q.times(e.space.element, own.V)
    right = tuple((p,) for p in momentum)
    M = tuple(map(tuple, own.metric()))
    factors = dense.factorised(g, M, lambda part, x: g.value(x, f"metric_{part}"))
    told = dense.solve(g, factors, right, lambda part, x: g.value(x, f"told_{part}"))
    velocity = [*q.flatten(told)]
    return {
        "step_momentum": own.momentum(),
        "step_force": [own.pushed(a) for a in span],
        "step_guess": velocity,
        "step_newton": change(g, own.slopes(), left, e.label),
        **turned(e, own.V, own.U, own.places, turns),
        "step_end": [*e.space.entries(moved), *(own.after(a) for a in span)],
        "step_velocity": velocity,
    }


def _times_h(term: Tree) -> Tree:
    """h times a term of a balance, which has 1/h, or none."""
    if has(term, "h"):
        return replaced(term, ("inv", "h"), 1)
    return mul("h", term)


def _gathered(t: Tree) -> Tree:
    """The same with traces of products begun at ξ, and C for ḡ₁g₁."""
    if not isinstance(t, tuple):
        return t
    if t[0] == "tr" and isinstance(t[1], tuple) and t[1][0] == "mul":
        factors = mul(*t[1][1:])[1:]  # type: ignore[index]
        first = next(k for k, x in enumerate(factors) if has(x, "E"))
        turned, found = [*factors[first:], *factors[:first]], list[Tree]()
        for x in turned:
            if x == "g_1" and found[-1:] == [("T", "g_1")]:
                found[-1] = "C"
            else:
                found.append(x)
        return ("tr", ("mul", *found))
    return (t[0], *(_gathered(x) for x in t[1:]))
