"""The conditions under which sentences say that a tensor or matrix has an inverse, and what they
suppose of masses and of the Lie algebra, tried at places that just satisfy them or just do not."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ...language.laurent import is_layered
from ...language.rational import Matrix
from ...language.tree import Tree, add, nodes, terms
from ...record.as_json import decode
from ...record.mass_signs import any_sign
from ...record.record import Step
from ...record.sentence import CONDITIONS, SIGNED, Claim
from .modular_values import about, expansion, second_derivatives
from .reduced_system import ClaimedRecord

Judge = Callable[[ClaimedRecord, Step, Claim], str]

DIVISORS = {
    "body.symbolic": "",
    "pullback.metric": "",
    "kernel.line": "",
    "unique.span": "J",
    "unique.affine_span": "J_c",
    "elimination.mass": "m",
    "elimination.linear_parts": "m",
    "euler.solved": "I",
    "motion.rotation": "I",
    "motion.displacement": "I_c",
    "motion.maps": "J",
    "motion.maps_of_a_volume": "J",
    "motion.affine_maps": "J_c",
    "motion.affine_maps_of_a_volume": "J_c",
    "motion.mass_matrix": "M",
    "motion.lagrangian": "M",
}
"""What is said, of positive masses or of any → what the equations of the step divide by."""
ALSO = {"C", "m"}
"""What they may divide by besides: C = ĀA has an inverse, and so has a mass that is not 0."""
ANY_SIZE = 3
"""The dimension of the space where the group is any."""
NEEDED = {"J": 0, "J_c": 0, "I": 2, "I_c": 2}
"""What each of these needs: so many independent places, seen from the origin or the centre of mass;
0 stands for as many as the space has dimensions."""


def _divisor(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """Masses have the signs of the problem, and the equations divide by what is said to have an
    inverse alone: it has one at places that satisfy the condition, at others not."""
    kind = claim.kind.removesuffix(SIGNED)
    if any_sign(c.record.problem) is (kind == claim.kind):
        return "masses of this problem may be negative, or none is"
    divisor = DIVISORS[kind]
    if dict(claim.values).get("metric", divisor) != divisor:
        return f"the condition is that of {divisor}"
    sides = (t for e in step.equations for side in (e.lhs, e.rhs) for t in nodes(side))
    found = {str(t[1]) for t in sides if isinstance(t, tuple) and t[0] == "inv"}
    if divisor and found - ALSO - {divisor}:
        return f"the equations do not divide by {divisor} alone"
    if kind == "elimination.linear_parts" and not _translates(c):
        return "the group has not every translation"
    return _tried(c, divisor) if divisor in NEEDED else ""


def _translates(c: ClaimedRecord) -> bool:
    """Has the Lie algebra all elements without a linear part?"""
    whole, linear = (
        q.rank(q.matrix([q.flatten(e) for e in basis]))
        for basis in (c.group.basis, c.group.linear_basis)
    )
    return whole - linear == c.group.n


def _tried(c: ClaimedRecord, divisor: str) -> str:
    """Is a tensor of places invertible where so many of these are independent, and of one less is
    it not?"""
    told = c.record.problem.get("n")
    n = told if isinstance(told, int) else ANY_SIZE
    rank = NEEDED[divisor] or n
    for size in (rank, rank - 1):
        basis = q.matrix([_drawn(c, n) for _ in range(size)])
        weights = q.matrix([_drawn(c, size) for _ in range(n + 2)])
        shift = _drawn(c, n) if divisor.endswith("_c") else [0] * n
        moved = ([*map(sum, zip(r, shift, strict=True))] for r in q.times(weights, basis))
        if (q.determinant(_tensor(divisor, q.matrix([*moved]))) != 0) is (size < rank):
            return f"{divisor} has an inverse under another condition"
    return ""


def _drawn(c: ClaimedRecord, count: int) -> list[int]:
    return [c.random.randint(1, 9999) for _ in range(count)]


def _tensor(name: str, places: Matrix) -> Matrix:
    """J, or the tensor of inertia I, of unit masses at places; about their centre with an index."""
    if name.endswith("_c"):
        centre = [sum(x, Fraction(0)) / len(places) for x in zip(*places, strict=True)]
        places = tuple(tuple(x - y for x, y in zip(r, centre, strict=True)) for r in places)
    J = q.times(q.transposed(places), places)
    if name[0] == "J":
        return J
    return q.minus(q.scaled(q.trace(J), q.identity(len(J))), J)


# What is said of the Lie algebra.


def _more(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The dimension, which is less than that of all matrices with the relations."""
    group, n = c.group, c.group.n
    whole = n * (n - 1) // 2 if "orthogonal" in group.relations else n * n - 1
    if group.dimension >= whole + n * group.affine:
        return "there are no more relations"
    return _equal(claim["dimension"], group.dimension)


def _equal(told: Tree, own: int) -> str:
    return "" if told == own else f"the dimension is {own}"


def _null(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The kernel has one dimension, and two for each direction along which the second derivative
    of L̃ by the velocity vanishes."""
    d = c.group.dimension
    velocity: list[Tree] = [("entry", "ζ", a) for a in range(1, d + 1)]
    L = decode(c.record.problem["lagrangian"]["L"], "problem")
    moving = add(*(x for x in terms(L) if not {*velocity}.isdisjoint(nodes(x))))
    at: dict[Tree, Any] = {x: Fraction(*_drawn(c, 2)) for x in nodes(moving) if _letter(x)}
    at |= about(velocity, [*map(Fraction, _drawn(c, d))])
    return _equal(claim["size"], 1 + 2 * (d - q.rank(second_derivatives(expansion(moving, at), d))))


def _letter(t: Tree) -> bool:
    return isinstance(t, str) or (isinstance(t, tuple) and t[0] in ("entry", "par"))


def _so3(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The linear parts of the Lie algebra are all skew matrices with three rows, of dimension 3."""
    found = c.group.linear_basis
    skew = all(q.transposed(e) == q.scaled(-1, e) for e in found)
    rank = q.rank(q.matrix([q.flatten(e) for e in found]))
    return "" if (c.group.n, rank) == (3, 3) and skew else "the linear parts are not those of so(3)"


def _ellipsoid(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The body is one ellipsoid about the origin, of a density that depends on the level, or not,
    and its volume is kept."""
    solids = c.record.problem["body"].get("solids") or ()
    centred = [x for x in solids if x["kind"] in ROUND and not x["shift"]]
    if len(solids) != 1 or centred != [*solids]:
        return "the body is no ellipsoid about the origin"
    layered = is_layered(decode(centred[0]["density"], "problem"))
    if claim.kind != "total.sign" and layered is (claim.kind == "quadric.stokes"):
        return "the density depends on the level, or does not"
    return "" if "unimodular" in c.group.relations else "the volume is not kept"


ROUND = ("ball", "ellipsoid")
OF_ROTATIONS = (
    *("isomorphism.onto", "hat.rotations", "hat.displacements"),
    *("unaligned.turned", "unaligned.displaced"),
)
JUDGES: dict[str, Judge] = {
    **{kind: _divisor for kind in CONDITIONS if kind.removesuffix(SIGNED) in DIVISORS},
    "relation.more": _more,
    "null.symmetries": _null,
    **dict.fromkeys(OF_ROTATIONS, _so3),
    **dict.fromkeys(("quadric.stokes", "quadric.layers", "total.sign"), _ellipsoid),
}
