"""The checker of claims: what sentences say beside the equations, computed again from the trees."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ...language import rational as q
from ...language.rational import Matrix
from ...record.record import RecordError, Step
from ...record.sentence import Claim, fault
from ..form.hypotheses_checked import IMPOSSIBLE, MOST_BITS, bit_count, no_sense
from . import (
    condition_claims,
    enclosed_trims,
    enclosure,
    equilibrium_claims,
    family_claims,
    integral_claims,
    reduction_claims,
    symmetry_count,
    trim_claims,
)
from .reduced_system import ClaimedRecord

# The claims about the orbit of a body's configurations: its dimension, and that of the group.

POINTS = 4


def _tetrahedron(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The displacements of four random points by the algebra have this rank, those by its linear
    maps and the translations together that of the orbit."""
    n, size = c.group.n, c.group.n + 1
    linear = [_embedded(e, size) for e in c.group.basis]
    shifts = [
        q.matrix([[int((i, j) == (k, n)) for j in range(size)] for i in range(size)])
        for k in range(n)
    ]
    places = q.matrix(
        [[c.random.randint(-99, 99) for _ in range(POINTS)] for _ in range(n)] + [[1] * POINTS]
    )
    whole = _rank([*linear, *shifts], places)
    if claim["orbit"] != whole:
        return f"the orbit has the dimension {whole}"
    own = _rank(linear, places)
    told = whole if claim.kind == "tetrahedron.affine" else claim["linear"]
    return "" if told == own else f"the group moves the points in {own} dimensions"


def _embedded(e: Matrix, size: int) -> Matrix:
    """An element of 𝔤 as a matrix that acts on (r, 1)."""
    missing = size - len(e)
    return q.matrix([[*row, *[0] * missing] for row in e] + [[0] * size] * missing)


def _rank(velocities: Iterable[Matrix], places: Matrix) -> int:
    """How many of the displacements of these places are independent."""
    return q.rank(q.matrix([q.flatten(q.times(e, places)) for e in velocities]))


ORBIT_JUDGES = {"tetrahedron.affine": _tetrahedron, "tetrahedron.linear": _tetrahedron}


class ClaimChecker(ClaimedRecord):
    """The claims of one record."""

    def fault(self, step: Step) -> str:
        """What is wrong with the claims of a step, or with a sentence that is a claim and has none;
        "" if nothing is."""
        try:
            if any(bit_count(x) > MOST_BITS for c in step.claims for _, x in c.values):
                return "a claim of powers of numbers that are too large"
            reasons = (self._fault(step, claim) for claim in step.claims)
            found = fault(step.prose, step.claims) or next(filter(None, reasons), "")
            return found or silent(step) or reduction_claims.missing(step)
        except IMPOSSIBLE as error:
            return f"a claim makes no sense: {type(error).__name__}"

    def _fault(self, step: Step, claim: Claim) -> str:
        """What is wrong with one claim, in words; "" if nothing is."""
        try:
            reason = JUDGES[claim.kind](self, step, claim)
        except RecordError as error:
            reason = str(error)
        except IMPOSSIBLE as error:
            reason = no_sense(error)
        return reason and f"the claim {claim.kind}: {reason}"


OBLIGATORY = {
    "reduction": ("poisson.group", "poisson.advected", "reduction.quadrature"),
    "Poisson bracket": (
        *("casimirs.kept", "level.multiple", "condition.one", "condition.several"),
        *(f"first_integrals.all{x}" for x in ("", "_large", "_generic", "_generic_large")),
    ),
    "expansion": ("equilibrium.form", "family.form"),
    "enclosure": ("enclosure.within",),
    "trim": (*trim_claims.POINTS, *enclosed_trims.POINTS),
}
"""Rule → the claims of which each of its steps makes one: without it no claim is judged there."""


def silent(step: Step) -> str:
    """That a step makes none of the claims of its rule, or that the first momentum of a reduction
    stands without the number of these; "" where all is claimed."""
    wanted = OBLIGATORY.get(step.rule, ())
    if any(e.lhs == ("at", "𝒥", 1) for e in step.equations):
        wanted = ("reduction.taken",)
    if not wanted or any(x.kind in wanted for x in step.claims):
        return ""
    return f"the step makes no claim of its rule: {', '.join(wanted)}"


Judge = Callable[[ClaimedRecord, Step, Claim], str]
"""What is wrong with a claim of a step, in words; "" if nothing is."""


def _of_reduced(judge: integral_claims.Judge) -> Judge:
    """The judge of a claim about reduced equations, which must be Hamiltonian."""
    return lambda c, step, x: c.reduced.fault or judge(c.reduced, step, x)


def _of_symmetries(judge: symmetry_count.Judge) -> Judge:
    """The judge of a claim about the symmetries of a Lagrangian."""
    return lambda c, step, x: judge(c.symmetries, c.record, step, x)


JUDGES: dict[str, Judge] = {
    **reduction_claims.JUDGES,
    **condition_claims.JUDGES,
    **ORBIT_JUDGES,
    **trim_claims.JUDGES,
    **enclosed_trims.JUDGES,
    **{kind: _of_symmetries(judge) for kind, judge in symmetry_count.JUDGES.items()},
    **{kind: _of_reduced(judge) for kind, judge in integral_claims.JUDGES.items()},
    **{kind: _of_reduced(judge) for kind, judge in equilibrium_claims.JUDGES.items()},
    **{kind: _of_reduced(judge) for kind, judge in family_claims.JUDGES.items()},
    **{kind: _of_reduced(judge) for kind, judge in enclosure.JUDGES.items()},
}
"""How each kind of claim is judged."""
