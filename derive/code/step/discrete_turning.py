"""A discrete step of a solid: the unit quaternion (q, x) of what it turns by, as the record has it.

hM in (q, x) is the momentum before the step, in (q, −x) that after it; q² + |x|² = 1.  Newton's
method finds x, three numbers.
"""

from __future__ import annotations

from fractions import Fraction

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from .. import dense
from ..graph import Node, replaced
from ..schedule import Directional
from .discrete_ends import Centre, Ends, Given, column, entries_of
from .discrete_newton import newton

HALF = Fraction(1, 2)


def turning(e: Ends, momentum: list[Node], unknowns: list[Node]) -> dict[str, list[Node]]:
    """The functions of a step on SO(3), and on SE(3) about the centre of mass."""
    centre, A = Centre(e), e.space.values["A"]
    p, x, drawn = column(momentum[:3]), column(unknowns), column(momentum[3:])
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
            *entries_of(_at_rest(e, zeta)),
            *entries_of(centre.varied(q.times(A, e.matrix(("hat", "ζ"))), q.times(A, drift))),
        ],
        "step_force": [*entries_of(_torque(e)), *entries_of(centre.push())],
        "step_guess": [y * HALF for y in entries_of(spin)],
        "step_newton": newton(e.graph, entries_of(left), unknowns, solved),
        "step_end": [
            *e.entries(moved, centre.shift(drawn, moved)),
            *(-y for y in entries_of(after)),
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
    found = entries_of(_momentum(e, e.one, column(leaves)))
    seeds = {y: z * HALF for y, (z,) in zip(leaves, zeta, strict=True)}
    along, still = Directional(e.graph, seeds, "zeta"), dict.fromkeys(leaves, e.graph.num(0))
    return column([replaced(along.of(y), still) for y in found])


def _torque(e: Ends) -> Matrix:
    """μ, as the axis of what is j(μ); 0 without forces."""
    own = [x for x in e.record["turning"].equations if x.lhs == ("hat", "μ_1")]
    if not own:
        return column([e.graph.num(0)] * 3)
    m = e.matrix(e.equation("turning", ("hat", "μ_1")))
    return column([m[2][1], m[0][2], m[1][0]])
