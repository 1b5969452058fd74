"""A body of given moments as exact point masses: the moments of solids, of shells, of points."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from itertools import permutations, product
from math import lcm
from typing import Any

from ...language import rational as q
from ...language.laurent import LEVEL, degree_in_level
from ...language.rational import Matrix
from ...language.tree import OPERATORS
from ...record.as_json import decode
from ...record.record import RecordError
from ..values.arithmetic import EvaluationError
from ..values.draws import Draws
from ..values.evaluate import evaluate

# The moments of solids by slices, shells, exact quadratures and the divergence theorem.
#
# These are other ways than the integrals of the derivation, which they check. Everything is a
# fraction; π has a given value.

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


# An ellipsoid in layers: its density by the level s = ⟨r, Q r⟩, and integrals over its shells.
#
# ∫ f(⟨r, Q r⟩) dx is V n ∫₀¹ f(t²) tⁿ⁻¹ dt, and with r r̄ it is V Q⁻¹ ∫₀¹ f(t²) tⁿ⁺¹ dt.
# Integrals are found by values at equal steps, with the weights that are exact for polynomials.

Function = Callable[[Any], Any]
MOST = 64
"""The degree of a polynomial at most that is integrated."""


@cache
def _weights(degree: int) -> tuple[Fraction, ...]:
    """Those w_k for which Σ w_k f(k/degree) is ∫₀¹ f dt for all polynomials of the degree."""
    if degree > MOST:
        raise EvaluationError(f"a polynomial of degree {degree} in the level")
    nodes = [Fraction(k, max(degree, 1)) for k in range(degree + 1)]
    powers = tuple(tuple(x**j for x in nodes) for j in range(degree + 1))
    found = q.solve(powers, q.column(Fraction(1, j + 1) for j in range(degree + 1)))
    assert found is not None
    return q.flatten(found)


def integrated(f: Function, low: Any, high: Any, degree: int) -> Any:
    """∫ f of a polynomial of a degree between two ends."""
    step, total = (high - low) * Fraction(1, max(degree, 1)), Fraction(0)
    for k, weight in enumerate(_weights(degree)):
        total = total + f(low + step * k) * weight
    return total * (high - low)


@dataclass(frozen=True)
class LayeredDensity:
    """The density of an ellipsoid in Rⁿ by the level."""

    density: Function
    degree: int
    n: int

    @classmethod
    def of(cls, model: Draws, solid: Mapping[str, Any]) -> LayeredDensity:
        """Those of a solid of the record."""
        tree, known = decode(solid["density"], "body"), model.expressions

        def density(level: Any) -> Any:
            return evaluate(tree, replace(known, names={**known.names, LEVEL: level}))

        degree = degree_in_level(tree)
        if degree is None:
            raise EvaluationError("a density that is no polynomial in the level")
        return cls(density, degree, model.n)

    def above(self, level: Any) -> Any:
        """∫ of the density from a level to 1."""
        return integrated(self.density, level, Fraction(1), self.degree)

    def mean(self, f: Function, degree: int) -> Any:
        """The mean of a polynomial in the level over the volume."""
        return _by_shells(f, degree, self.n)

    @property
    def means(self) -> tuple[Any, Any]:
        """The means of the density, over the volume and with the weights r r̄."""
        if not self.degree:
            return (self.density(Fraction(0)),) * 2
        inner, outer = (_by_shells(self.density, self.degree, n) for n in (self.n, self.n + 2))
        return inner, outer


def _by_shells(f: Function, degree: int, n: int) -> Any:
    """n ∫₀¹ f(t²) tⁿ⁻¹ dt, which is 1 for f = 1."""
    found = integrated(
        lambda t: f(t * t) * t ** (n - 1), Fraction(0), Fraction(1), 2 * degree + n - 1
    )
    return found * n


# A body of given moments as exact point masses, so that it can be moved like any other.
#
# Moments m, c, J are those of the points s ± l_k with the masses d_k / 2 and of s with the rest
# of m, where s = c / m and J − m s s̄ = Σ d_k l_k l̄_k (Gauss's elimination). The moments of
# solids are computed by slices, not by the integrals of the derivation.

Vector = tuple[Any, ...]


def equimomental_points(m: Fraction, c: Vector, J: Matrix) -> tuple[list[Fraction], list[Vector]]:
    """Masses and places of points with the moments m, c, J; a mass may be negative.
    ``ZeroDivisionError`` for m = 0 or a missing pivot."""
    if m == 0:
        raise ZeroDivisionError("a body without mass")
    s = tuple(x / m for x in c)
    central = q.minus(J, q.scaled(1 / m, q.times(q.column(c), (c,))))
    masses, points = [], []
    for weight, direction in ldl_terms(central):
        for sign in (1, -1):
            masses.append(weight / 2)
            points.append(tuple(x + sign * y for x, y in zip(s, direction, strict=True)))
    return [*masses, m - sum(masses, Fraction(0))], [*points, s]


def remaining_moments(
    masses: Iterable[Fraction], points: Iterable[Vector], m: Fraction, c: Vector, J: Matrix
) -> tuple[Fraction, Vector, Matrix]:
    """The moments m, c, J less those of some point masses."""
    for mass, r in zip(masses, points, strict=True):
        m, c = m - mass, tuple(x - mass * y for x, y in zip(c, r, strict=True))
        J = q.minus(J, q.scaled(mass, q.times(q.column(r), (r,))))
    return m, c, J


def ldl_terms(a: Matrix) -> list[tuple[Any, Vector]]:
    """The (d_k, l_k) of a symmetric Σ d_k l_k l̄_k; ``ZeroDivisionError`` without a pivot."""
    found = []
    n = len(a)
    for k in range(n):
        pivot = a[k][k]
        if pivot == 0:
            if any(a[k]):
                raise ZeroDivisionError("no pivot for the moments of the body")
            continue
        found.append((pivot, tuple(a[i][k] / pivot for i in range(n))))
        a = q.minus(a, q.scaled(1 / pivot, q.times(q.column(row[k] for row in a), (a[k],))))
    return found


def moments_of(model: Draws) -> tuple[Fraction, Vector, Matrix]:
    """m, c, J of the body without its listed points: those of its solids, by slices, or the given
    ones.

    ``RecordError`` where solids and listed points together do not have the given moments.
    """
    body = model.problem["body"]
    m, c, J = (_value(model, body["given"][key]) for key in ("m", "c", "J"))
    if not body["solids"]:
        return m, c, J
    solids = solid_moments(model, body["solids"])
    listed = body.get("points", [])
    own = [_value(model, p["mass"]) for p in listed]
    left = remaining_moments(own, [_value(model, p["at"]) for p in listed], m, c, J)
    if left != solids and not model.graded:
        raise RecordError("body: the given moments are not those of its solids")
    return solids


def solid_moments(
    model: Draws, solids: Iterable[Mapping[str, Any]]
) -> tuple[Fraction, Vector, Matrix]:
    """The moments m, c, J of solids in the body's frame, each by slices."""
    m, c = Fraction(0), tuple([Fraction(0)] * model.group.n)
    J = q.scaled(Fraction(0), q.identity(model.group.n))
    for solid in solids:
        mass, first, second = _moments_of_solid(model, solid)
        m, J = m + mass, q.plus(J, second)
        c = tuple(x + y for x, y in zip(c, first, strict=True))
    return m, c, J


def _value(model: Draws, x: Any) -> Any:
    """The value of an expression of the problem, or of a list of them."""
    if isinstance(x, list) and x and x[0] not in list(OPERATORS):
        return tuple(_value(model, y) for y in x)
    return evaluate(decode(x, "body"), model.expressions)


def _moments_of_solid(model: Draws, data: Mapping[str, Any]) -> tuple[Fraction, Vector, Matrix]:
    """The moments m, c, J of one solid: those of its own frame, turned and shifted."""

    def value(x: Any) -> Any:
        return _value(model, x)

    if "quadric" in data["sizes"]:
        return _moments_of_quadric(model, data)
    sizes = {k: x if k == "faces" else value(x) for k, x in data["sizes"].items()}
    V, f, S = slice_moments(data["kind"], sizes, model.pi)
    density, outer = LayeredDensity.of(model, data).means
    R = value(data["rotation"]) if data.get("rotation") else q.identity(3)
    shift = value(data["shift"]) if data.get("shift") else (Fraction(0),) * 3
    s, turned = q.column(shift), q.times(R, q.column(f))
    mixed = q.times(turned, q.transposed(s))
    second = q.times(q.times(R, S), q.transposed(R))
    shifted = q.plus(q.plus(mixed, q.transposed(mixed)), q.scaled(V, q.times(s, q.transposed(s))))
    second = q.plus(q.scaled(outer, second), q.scaled(density, shifted))
    first = q.plus(turned, q.scaled(V, s))
    return density * V, tuple(density * x for (x,) in first), second


def volume_of(model: Draws, data: Mapping[str, Any]) -> Any:
    """The volume of a solid: its mass at density 1."""
    return _moments_of_solid(model, {**data, "density": 1})[0]


def _moments_of_quadric(model: Draws, data: Mapping[str, Any]) -> tuple[Any, Vector, Matrix]:
    """The moments of ⟨r, Q r⟩ ≤ 1, with √det Q as the record writes it where Q is one of
    numbers."""
    told = data["sizes"]["quadric"]
    Q = tuple(tuple(_value(model, x) for x in row) for row in told)
    written = all(isinstance(decode(x, "body"), (int, Fraction)) for row in told for x in row)
    take = model.elementary.written if written else model.elementary
    root = take("sqrt", q.determinant(Q))
    V, f, S = quadric_moments(Q, root, model.pi)
    density, outer = LayeredDensity.of(model, data).means
    return density * V, f, q.scaled(outer, S)
