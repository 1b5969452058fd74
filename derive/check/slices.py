"""The moments of solids by slices, shells, exact quadratures and the divergence theorem.

These are other ways than the integrals of the derivation, which they check. Everything is a
fraction; π has a given value.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from itertools import permutations, product
from math import lcm
from typing import Any

from ..language import rational as q
from .arithmetic import EvaluationError

Sizes = Mapping[str, Any]
Row = Sequence[Fraction]
SolidMoments = tuple[Fraction, tuple[Fraction, ...], q.Matrix]

ZERO, ONE, SPAN = Fraction(0), Fraction(1), range(3)
SIMPSON = ((-ONE / 2, ONE / 6), (ZERO, ONE * 4 / 6), (ONE / 2, ONE / 6))
NODES = tuple(
    (corner, weight)
    for base, weight in (((6, 0, 0), 3), ((3, 3, 0), 8), ((2, 2, 2), 27))
    for corner in sorted(set(permutations(base)))
)
"""A quadrature on a triangle, exact for cubics: coordinates of the nodes in sixths of the corners,
weights in sixtieths."""


def slice_moments(kind: str, sizes: Sizes, pi: Fraction) -> SolidMoments:
    """V, ∫ r dV (3 entries) and ∫ r r̄ dV (3 × 3) of a solid in its own frame.

    The sizes are fractions, in tuples as the kind has them; a mesh has ``vertices``, and ``faces``
    of three indices each from 0.  ``EvaluationError`` for an unknown kind or sizes that do not fit.
    """
    try:
        exact = {k: x if k == "faces" else _fractions(x) for k, x in sizes.items()}
        return MOMENTS[kind](exact, _fractions(pi))
    except (LookupError, TypeError, ValueError, ArithmeticError) as error:
        raise EvaluationError(f"no moments of {kind[:40]!r} of such sizes: {error}") from error


def _fractions(x: Any) -> Any:
    if isinstance(x, (tuple, list)):
        return tuple(map(_fractions, x))
    return Fraction(x) if isinstance(x, int) else x


def _integral(p: Row, ends: Row) -> Fraction:
    """∫ p dz between two ends, of a polynomial by its coefficients, the constant one first."""
    low, high = ends
    return sum((x * (high**k - low**k) / k for k, x in enumerate(p, 1)), ZERO)


def _ellipses(a: Fraction, b: Fraction, square: Row, ends: Row, pi: Fraction) -> SolidMoments:
    """The moments of a solid whose slice at z is an ellipse of semi-axes a s and b s; ``square``:
    s² as a polynomial in z.

    The areas of the slices are π a b s², their ∫ x² dA are π a³ b s⁴/4.
    """
    area = tuple(pi * a * b * x for x in square)
    along = [_integral((ZERO,) * k + area, ends) for k in SPAN]
    fourth = [ZERO] * (2 * len(area) - 1)
    for (i, x), (j, y) in product(enumerate(area), enumerate(square)):
        fourth[i + j] += x * y / 4
    across = _integral(fourth, ends)
    second = ((a * a * across, ZERO, ZERO), (ZERO, b * b * across, ZERO), (ZERO, ZERO, along[2]))
    return along[0], (ZERO, ZERO, along[1]), second


def _ellipsoid(axes: Row, pi: Fraction) -> SolidMoments:
    a, b, c = axes
    return _ellipses(a, b, (ONE, ZERO, -1 / c**2), (-c, c), pi)


def quadric_moments(Q: q.Matrix, root: Any, pi: Fraction) -> SolidMoments:
    """The moments of ⟨r, Q r⟩ ≤ 1, ``root`` = √det Q, an image of the unit ball.

    Slices of that at z are balls of one dimension less, of volume ωₙ₋₁(1 − z²)^((n − 1)/2): so ωₙ =
    2π/n ωₙ₋₂, and the mean of z² is 1/(n + 2).
    """
    n, back = len(Q), q.inverse(Q)
    if back is None:
        raise EvaluationError("a quadric that is singular")
    ball = Fraction(2 if n % 2 else 1)
    for k in range(2 + n % 2, n + 1, 2):
        ball *= 2 * pi / k
    volume = ball / root
    return volume, (ZERO,) * n, q.scaled(volume / (n + 2), back)


def _cylinder(radius: Fraction, height: Fraction, pi: Fraction) -> SolidMoments:
    return _ellipses(radius, radius, (ONE,), (-height / 2, height / 2), pi)


def _cone(radius: Fraction, height: Fraction, pi: Fraction) -> SolidMoments:
    return _ellipses(radius, radius, (ONE, -2 / height, 1 / height**2), (ZERO, height), pi)


def _hollow_ball(ends: Row, pi: Fraction) -> SolidMoments:
    """The moments of a hollow ball, by shells of area 4π r² with r²/3 as the mean of x²."""
    volume, square = (_integral((ZERO,) * k + (4 * pi,), ends) for k in (2, 4))
    return volume, (ZERO,) * 3, q.scaled(square / 3, q.identity(3))


def _box(sides: Row) -> SolidMoments:
    """The moments of a box, by Simpson's rule in each direction."""
    a, b, c = sides
    cube = product(SIMPSON, repeat=3)
    nodes = (((i * a, j * b, k * c), u * v * w) for (i, u), (j, v), (k, w) in cube)
    return _quadrature([(a * b * c * weight, r) for r, weight in nodes])


def _tetrahedron(corners: Sequence[Row]) -> SolidMoments:
    """The moments of a tetrahedron, by weights V/20 at the vertices and 16 V/20 at their mean,
    exact for quadratics."""
    a, b, c = ([v[i] - corners[0][i] for i in SPAN] for v in corners[1:])
    volume = abs(sum(x * y for x, y in zip(a, _cross(b, c), strict=True))) / 6
    mean = tuple(sum(x, ZERO) / 4 for x in zip(*corners, strict=True))
    return _quadrature([*((volume / 20, v) for v in corners), (volume * 16 / 20, mean)])


def _quadrature(points: Sequence[tuple[Fraction, Row]]) -> SolidMoments:
    """The moments Σ w, Σ w r, Σ w r r̄ of weighted nodes."""
    first = (sum((w * r[i] for w, r in points), ZERO) for i in SPAN)
    second = ((sum((w * r[i] * r[j] for w, r in points), ZERO) for j in SPAN) for i in SPAN)
    return sum((w for w, _ in points), ZERO), tuple(first), tuple(map(tuple, second))


def _cross(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in SPAN]


def _mesh(points: Sequence[Row], faces: Sequence[Sequence[int]]) -> SolidMoments:
    """The moments of a closed mesh, as the flux through its faces of fields of divergence 1, r_i
    and r_i r_j, in whole numbers.

    The fields are x along the first axis, and r_i²/2 and r_i² r_j/2 along axis i, r_i³/3 for i = j.
    """
    numbers = [x for v in points for x in v if isinstance(x, Fraction)]
    unit = lcm(*(x.denominator for x in numbers))
    vertices = [
        tuple(int(x * unit) if isinstance(x, Fraction) else x * unit for x in v) for v in points
    ]
    volume, first, second = 0, [0] * 3, [[0] * 3 for _ in SPAN]
    for a, b, c in ((vertices[k] for k in face) for face in faces):
        normal = _cross([b[i] - a[i] for i in SPAN], [c[i] - a[i] for i in SPAN])
        for (u, v, w), weight in NODES:
            r = [u * a[i] + v * b[i] + w * c[i] for i in SPAN]
            volume += weight * normal[0] * r[0]
            for i in SPAN:
                flux = weight * normal[i] * r[i] * r[i]
                first[i] += flux
                for j in SPAN:
                    second[i][j] += (2 if i == j else 3) * flux * r[j]
    scale = [120 * unit**2 * (6 * unit) ** k for k in range(4)]
    square = q.scaled(Fraction(1, 6 * scale[3]), q.matrix(second))
    center = tuple(Fraction(1, 2 * scale[2]) * x for x in first)
    return Fraction(1, scale[1]) * volume, center, square


MOMENTS: dict[str, Callable[[Sizes, Fraction], SolidMoments]] = {
    "ball": lambda s, pi: _ellipsoid((s["radius"],) * 3, pi),
    "ellipsoid": lambda s, pi: _ellipsoid(s["semi_axes"], pi),
    "box": lambda s, _: _box(s["sides"]),
    "cylinder": lambda s, pi: _cylinder(s["radius"], s["height"], pi),
    "cone": lambda s, pi: _cone(s["radius"], s["height"], pi),
    "hollow_ball": lambda s, pi: _hollow_ball((s["inner"], s["outer"]), pi),
    "tetrahedron": lambda s, _: _tetrahedron(s["vertices"]),
    "mesh": lambda s, _: _mesh(s["vertices"], s["faces"]),
}
