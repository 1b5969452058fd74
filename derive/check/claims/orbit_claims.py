"""The claims about the orbit of a body's configurations: its dimension, and that of the group."""

from __future__ import annotations

from collections.abc import Iterable

from ...language import rational as q
from ...language.rational import Matrix
from ...record.record import Step
from ...record.sentence import Claim
from .claimed_record import ClaimedRecord

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


JUDGES = {"tetrahedron.affine": _tetrahedron, "tetrahedron.linear": _tetrahedron}
