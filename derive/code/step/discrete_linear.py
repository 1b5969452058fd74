"""A discrete step of matrices of which all, or all of trace 0, are tangent to the group.

Without the relation the next element is H; what keeps the volume is a multiple θ of the dual of the
element, a root of a cubic.  What a step carries on is the velocity in space, modulo that dual.
"""

from __future__ import annotations

from fractions import Fraction

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ..graph import Node, replaced
from ..schedule import Directional
from .discrete_ends import Centre, Ends, entries_of

Functions = dict[str, list[Node]]


class Linear:
    """The linear parts x of a group, or of H ⋉ Rⁿ about the centre of mass."""

    def __init__(self, e: Ends, momentum: list[Node]):
        self.e, self.n = e, e.group.n
        self.centre, self.A = Centre(e), e.space.values["A"]
        self.letter = "A" if self.centre.size else "g"
        n = self.n
        self.alpha: Matrix = tuple(tuple(momentum[n * i : n * i + n]) for i in range(n))
        self.drawn: Matrix = tuple((x,) for x in momentum[n * n :])
        e.invert("J_c" if self.centre.size else "J")

    @property
    def next(self) -> str:
        """The element after the step."""
        return f"{self.letter}_2"

    def push(self, next_free: str) -> list[Node]:
        """The acceleration of A by the forces, without a multiplier, and that of R: what h² has in
        the next element."""
        e, none = self.e, self.e.zero(self.A)
        t = e.equation("motion", next_free)
        before = f"{self.letter}_0"
        moved, still = (e.matrix(t, {before: none, "h": e.graph.num(h)}) for h in (1, 0))
        return entries_of(q.minus(moved, still)) + entries_of(self.centre.push())

    def momentum(self) -> list[Node]:
        """The velocity of A, and of R."""
        e = self.e
        Z = e.space.hat(e.space.coordinates)
        alpha = q.times(self.A, e.group.linear_part(Z))
        tau = q.times(self.A, e.group.translation_part(Z)) if self.centre.size else ()
        return entries_of(alpha) + entries_of(self.centre.varied(alpha, tau))

    def end(self, moved: Matrix) -> list[Node]:
        """What a step that moves A so adds to g; and itself."""
        shift = self.centre.shift(self.drawn, moved)
        return [*self.e.entries(moved, shift), *entries_of(moved), *entries_of(self.drawn)]

    def velocity(self, alpha: Matrix) -> list[Node]:
        """The coordinates of Z with this velocity of A, which is of the group."""
        e, back = self.e, self.e.space.inverse
        shift: Matrix = ()
        if self.centre.size:
            rate = self.centre.shift(self.drawn, alpha)
            shift = q.times(back, e.named(rate, "rate_T"))
        return e.coordinates(q.times(back, alpha), shift)


def whole(e: Ends, momentum: list[Node]) -> Functions:
    """The functions of a step on GL(n): there is nothing to be solved for."""
    linear = Linear(e, momentum)
    return {
        "step_momentum": linear.momentum(),
        "step_force": linear.push(linear.next),
        "step_end": linear.end(linear.alpha),
        "step_velocity": linear.velocity(linear.alpha),
    }


def volume(
    e: Ends, momentum: list[Node], begun: list[Node], unknowns: list[Node]
) -> dict[str, list[Node]]:
    """The functions of a step on SL(3); ``begun``: leaves of the coefficients of the cubic."""
    linear, (theta,), g = Linear(e, momentum), unknowns, e.graph
    onward = e.equation("motion", linear.next)
    dual: Tree = ("inv", ("T", f"{linear.letter}_1"))
    given = {dual: q.transposed(e.space.inverse), "H": e.zero(linear.A), "θ": e.one}
    along = e.named(e.matrix(onward, given), "dual")
    H = e.named(q.plus(linear.A, linear.alpha), "H")
    cubic = _cubic(e, linear, H, along, theta)
    coefficients = _coefficients(e, cubic, theta)
    left = g.num(0)
    for c in reversed(begun):
        left = left * theta + c
    slope = Directional(g, {theta: e.one}, "theta").of(left)
    alpha = linear.alpha
    det: Tree = ("det", f"{linear.letter}_1")
    off, by = (_along(e, det, linear.A, m) for m in (alpha, along))
    multiple = g.value(off * g.recip(by), "multiple")
    inside = q.minus(alpha, q.scaled(multiple, along))
    return {
        "step_momentum": linear.momentum(),
        "step_force": linear.push("H"),
        "step_guess": [g.num(0)],
        "step_begin": coefficients,
        "step_newton": [left * g.recip(slope), slope],
        "step_end": linear.end(e.named(q.plus(alpha, q.scaled(theta, along)), "moved")),
        "step_velocity": linear.velocity(e.named(inside, "alpha")),
    }


def _cubic(e: Ends, linear: Linear, H: Matrix, dual: Matrix, theta: Node) -> Node:
    """det of the next element, less what it is to be: 0 for the θ that is wanted.

    The record has det(g₂)det(J) as well, by the traces of powers of HJḡ₁: of fewer operations, but
    it loses the condition of J.
    """
    t: Tree = ("det", linear.next)
    there = q.plus(H, q.scaled(theta, dual))
    return e.number(t, {linear.next: there}) - e.number(e.equation("relation", t))


def _coefficients(e: Ends, p: Node, x: Node) -> list[Node]:
    """Those of a polynomial of degree 3 in x, by its derivatives at 0."""
    found, factorial, still = [], 1, {x: e.graph.num(0)}
    for k in range(4):
        factorial *= max(k, 1)
        found.append(replaced(p, still) * Fraction(1, factorial))
        p = Directional(e.graph, {x: e.one}, f"{k}").of(p)
    return found


def _along(e: Ends, det: Tree, at: Matrix, change: Matrix) -> Node:
    """The derivative of det at an element along a change of it."""
    pairs = zip(entries_of(at), entries_of(change), strict=True)
    seeds = {x: y for x, y in pairs if x.op == "leaf"}
    return Directional(e.graph, seeds, "along").of(e.number(det))
