"""A body of given moments as exact point masses, so that it can be moved like any other.

Moments m, c, J are those of the points s ± l_k with the masses d_k / 2 and of s with the rest of m,
where s = c / m and J − m s s̄ = Σ d_k l_k l̄_k (Gauss's elimination). The moments of solids are
computed by slices, not by the integrals of the derivation.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from ..language.tree import OPERATORS
from ..record.as_json import decode
from ..record.record import RecordError
from .draws import Draws
from .evaluate import evaluate
from .shells import Layers
from .slices import quadric_moments, slice_moments

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
    density, outer = Layers.of(model, data).means
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
    Q = quadric_matrix(model, told)
    written = all(isinstance(decode(x, "body"), (int, Fraction)) for row in told for x in row)
    take = model.elementary.written if written else model.elementary
    root = take("sqrt", q.determinant(Q))
    V, f, S = quadric_moments(Q, root, model.pi)
    density, outer = Layers.of(model, data).means
    return density * V, f, q.scaled(outer, S)


def quadric_matrix(model: Draws, told: Any) -> Matrix:
    """The matrix of a quadric, by its expressions."""
    return tuple(tuple(_value(model, x) for x in row) for row in told)
