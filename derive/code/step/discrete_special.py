"""A discrete step on the groups that have a road of their own, and Newton's method for it.

Of a solid: the unit quaternion (q, x) of what it turns by, as the record has it.  hM in (q, x) is
the momentum before the step, in (q, −x) that after it; q² + |x|² = 1.  Newton's method, as
straight-line code, finds x, three numbers: elimination without a search for pivots, as the matrix
is near the metric, which is positive; where it is not, the determinant tells.

Of matrices of which all, or all of trace 0, are tangent to the group: without the relation the next
element is H; what keeps the volume is a multiple θ of the dual of the element, a root of a cubic.
What a step carries on is the velocity in space, modulo that dual.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from .. import dense
from ..graph import Graph, Node, replaced
from ..schedule import Directional
from .discrete_ends import Centre, Ends, Given

SMALL = 3
"""Up to this size by the adjugate."""


def newton(g: Graph, left: Sequence[Node], unknowns: Sequence[Node], label: str) -> list[Node]:
    """By what the unknowns of equations ``left`` = 0 are too large, and the determinant of the
    derivative, after that; ``label``: the key of what is solved."""
    varied = [Directional(g, {x: g.num(1)}, str(x.data[1])) for x in unknowns]
    return change(g, [[v.of(y) for v in varied] for y in left], left, label)


def change(g: Graph, K: Sequence[Sequence[Node]], left: Sequence[Node], label: str) -> list[Node]:
    """K⁻¹ left, and det K."""
    n = len(left)
    named = [
        [g.value(y, f"K_{i}{j}", label) for j, y in enumerate(row, 1)] for i, row in enumerate(K, 1)
    ]
    r = [g.value(y, f"left_{i}", label) for i, y in enumerate(left, 1)]
    if n > SMALL:
        return _eliminated(g, named, r)
    whole = tuple(map(tuple, named))
    back = dense.entrywise(dense.adjugate(g, whole), "cofactor", g.value, False)
    det = g.value(g.sum(x * row[0] for x, row in zip(whole[0], back, strict=True)), "det")
    over = g.value(g.recip(det), "over")
    return [
        g.product((over, g.sum(x * y for x, y in zip(row, r, strict=True)))) for row in back
    ] + [det]


def _eliminated(g: Graph, K: Sequence[Sequence[Node]], left: Sequence[Node]) -> list[Node]:
    """The same by Gauss's elimination, row by row."""
    n = len(left)
    rows, right, over = [[*row] for row in K], [*left], list[Node]()
    for c in range(n):
        over.append(g.value(g.recip(rows[c][c]), f"over_{c + 1}"))
        for i in range(c + 1, n):
            if rows[i][c].is_zero:
                continue
            by = g.value(rows[i][c] * over[c], f"by_{i + 1}_{c + 1}")
            for j in range(c + 1, n):
                rows[i][j] = g.value(rows[i][j] - by * rows[c][j], f"K_{i + 1}_{j + 1}_{c + 1}")
            right[i] = g.value(right[i] - by * right[c], f"left_{i + 1}_{c + 1}")
    found = [*right]
    for i in reversed(range(n)):
        rest = g.sum(rows[i][j] * found[j] for j in range(i + 1, n))
        found[i] = g.value((right[i] - rest) * over[i], f"change_{i + 1}")
    return [*found, g.product(rows[i][i] for i in range(n))]


HALF = Fraction(1, 2)


def turning(e: Ends, momentum: list[Node], unknowns: list[Node]) -> dict[str, list[Node]]:
    """The functions of a step on SO(3), and on SE(3) about the centre of mass."""
    centre, A = Centre(e), e.space.values["A"]
    p, x, drawn = q.column(momentum[:3]), q.column(unknowns), q.column(momentum[3:])
    zeta, drift = e.space.values["ζ"], e.space.values.get("w", ())
    inertia = "I_c" if centre.size else "I"
    e.invert(inertia)
    spin = e.matrix(("mul", ("inv", inertia), "y"), {"y": p})
    spun = e.matrix(("hat", "y"), {"y": e.named(spin, "spin")})
    real = _real(e, x)
    turn = q.minus(_rotation(e, real, x), dense.numbers(e.graph, q.identity(3)))
    moved = q.times(A, e.named(turn, "turn"))
    left = q.minus(_momentum(e, real, x), p)
    solved = e.label
    after = _momentum(e, real, q.scaled(-1, x))
    rate = centre.shift(drawn, q.times(A, spun))
    return {
        "step_momentum": [
            *q.flatten(_at_rest(e, zeta)),
            *q.flatten(centre.varied(q.times(A, e.matrix(("hat", "ζ"))), q.times(A, drift))),
        ],
        "step_force": [*q.flatten(_torque(e)), *q.flatten(centre.push())],
        "step_guess": [y * HALF for y in q.flatten(spin)],
        "step_newton": newton(e.graph, q.flatten(left), unknowns, solved),
        "step_end": [
            *e.entries(moved, centre.shift(drawn, moved)),
            *(-y for y in q.flatten(after)),
            *momentum[3:],
        ],
        "step_velocity": e.coordinates(
            spun, q.times(q.transposed(A), e.named(rate, "rate_T")) if centre.size else ()
        ),
    }


def _real(e: Ends, x: Matrix) -> Node:
    """q, from q² + |x|² = 1."""
    unit: Tree = ("add", ("pow", "q_1", 2), rest := ("norm2", "x_1"))
    one = e.equation("quaternion", unit)
    found = e.graph.function("sqrt", e.number(one) - e.number(rest, {"x_1": x}))
    return e.graph.value(found, "real", e.label)


def _rotation(e: Ends, real: Node, x: Matrix) -> Matrix:
    """W in (q, x)."""
    return e.matrix(e.equation("quaternion", "W_1"), {"q_1": real, "x_1": x})


def _momentum(e: Ends, real: Node, x: Matrix) -> Matrix:
    """The axis of hM in (q, x)."""
    given: Given = {"q_1": real, "x_1": x, "h": e.one}
    return e.matrix(e.axis("quaternion", "M_1"), given)


def _at_rest(e: Ends, zeta: Matrix) -> Matrix:
    """The momentum of a velocity: that of a short step, h = 1, of half of it, to first order."""
    leaves = e.leaves("short", 3)
    found = q.flatten(_momentum(e, e.one, q.column(leaves)))
    seeds = {y: z * HALF for y, (z,) in zip(leaves, zeta, strict=True)}
    along, still = Directional(e.graph, seeds, "zeta"), dict.fromkeys(leaves, e.graph.num(0))
    return q.column([replaced(along.of(y), still) for y in found])


def _torque(e: Ends) -> Matrix:
    """μ, as the axis of what is j(μ); 0 without forces."""
    own = [x for x in e.record["turning"].equations if x.lhs == ("hat", "μ_1")]
    if not own:
        return q.column([e.graph.num(0)] * 3)
    m = e.matrix(e.equation("turning", ("hat", "μ_1")))
    return q.column([m[2][1], m[0][2], m[1][0]])


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
        return [*q.flatten(q.minus(moved, still)), *q.flatten(self.centre.push())]

    def momentum(self) -> list[Node]:
        """The velocity of A, and of R."""
        e = self.e
        Z = e.space.hat(e.space.coordinates)
        alpha = q.times(self.A, e.group.linear_part(Z))
        tau = q.times(self.A, e.group.translation_part(Z)) if self.centre.size else ()
        return [*q.flatten(alpha), *q.flatten(self.centre.varied(alpha, tau))]

    def end(self, moved: Matrix) -> list[Node]:
        """What a step that moves A so adds to g; and itself."""
        shift = self.centre.shift(self.drawn, moved)
        return [*self.e.entries(moved, shift), *q.flatten(moved), *q.flatten(self.drawn)]

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
    pairs = zip(q.flatten(at), q.flatten(change), strict=True)
    seeds = {x: y for x, y in pairs if x.op == "leaf"}
    return Directional(e.graph, seeds, "along").of(e.number(det))
