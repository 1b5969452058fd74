"""U = −(3/10) G m² ∫₀^∞ du / √det(S + u), S = (5/m) Σ m_i x_i x̄_i, x_i from the centre of mass.

The integral is put to the test as a sum Σ w_k f(u_k) at two random u_k, with random w_k: what holds
for all of these, and is linear in one integral or in products of two, holds for the integral.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import prod
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ..trials.model import Model
from ..trials.point_masses import AppliedForces, Vector, outer_sum, scaled_each
from ..values.arithmetic import ETA, Nilpotent, determinant, inverse, nilpotent, part
from ..values.evaluate import Environment, evaluate

KIND = "self_gravity"
Data = Mapping[str, Any]
NODES = 2


def energy(at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]) -> Any:
    """By the moments of the masses at their places."""
    m, S = _ellipsoid(r, masses)
    n = range(len(S))
    total: Any = Fraction(0)
    for w, u in _nodes(at):
        shifted = tuple(tuple(S[i][j] + (u if i == j else 0) for j in n) for i in n)
        total = total + w / at.root(determinant(shifted))
    return -at.number(p["G"]) * m * m * Fraction(3, 10) * total


def _ellipsoid(r: Sequence[Vector], masses: Sequence[Any]) -> tuple[Any, Matrix]:
    """The mass, and the matrix of the homogeneous ellipsoid with the same moments."""
    m = sum(masses, Fraction(0))
    weighted = scaled_each(masses, r)
    centre = tuple(sum(x, Fraction(0)) * (1 / m) for x in zip(*weighted, strict=True))
    arms = [tuple(x - y for x, y in zip(place, centre, strict=True)) for place in r]
    return m, q.scaled(5 / m, outer_sum(scaled_each(masses, arms), arms))


def _nodes(at: AppliedForces) -> Iterator[tuple[Any, Any]]:
    """The pairs w_k, u_k."""
    return nodes(at.env.elementary.value)  # type: ignore[union-attr]


def nodes(drawn: Callable[[str, int], Any]) -> Iterator[tuple[Any, Any]]:
    """The pairs w_k, u_k, from numbers that are drawn by a name and k."""
    return ((drawn("weight", k), drawn("node", k)) for k in range(NODES))


def power(x: Any, n: int) -> Any:
    """xⁿ, a product of n factors."""
    return prod([x] * n, start=Fraction(1))


def at_invariants(
    pairs: Iterable[tuple[Any, Any]],
    invariants: Sequence[Any],
    k: int,
    halves: int,
    root: Callable[[Any], Any],
) -> Any:
    """∫ u^k P^(−s) du for s = ``halves``/2, at I_1, I_2, I_3."""
    first, second, third = invariants
    total: Any = Fraction(0)
    for w, u in pairs:
        y = root(u * u * u + u * u * first + u * second + third)
        total = total + w * power(u, k) / power(y, halves)
    return total


def functions(model: Model) -> dict[str, Callable[..., Any]]:
    """Ψ and Ψ_k at three numbers."""
    at = model.applied

    def integral(k: int, halves: int) -> Callable[..., Any]:
        def of(_: Tree, arguments: tuple[Tree, ...], env: Environment) -> Any:
            invariants = [evaluate(x, env) for x in arguments]
            return at_invariants(_nodes(at), invariants, k, halves, at.root)

        return of

    return {"Ψ": integral(0, 1)} | {f"Ψ_{k}": integral(k, 3) for k in range(3)}


def values(model: Model, members: Sequence[Data]) -> dict[str, Any]:
    """U_G; B_G by the work of U, Tr B_G C ξ for any ξ; the invariants in space."""
    at, p, n = model.applied, members[0], range(3)
    A = model.group.linear_part(model.g)
    K = _ellipsoid(model.points, model.masses)[1]

    def moved(matrix: Matrix) -> Any:
        places = q.transposed(q.times(matrix, q.transposed(tuple(model.points))))
        return energy(at, p, places, model.masses)

    def work(i: int, j: int) -> Any:
        xi = q.scaled(nilpotent(ETA), q.unit(3, i, j))
        return part(Nilpotent.of(moved(q.plus(A, q.times(A, xi)))), ETA)

    C = q.times(q.transposed(A), A)
    paired = tuple(tuple(work(j, i) for j in n) for i in n)
    S = q.times(q.times(A, K), q.transposed(A))
    traced, squared = q.trace(S), q.trace(q.times(S, S))
    return {
        "K_G": K,
        "K_a": _adjugate(K),
        "X_G": q.times(K, C),
        "A_a": _adjugate(A),
        "C_a": _adjugate(C),
        "I_1": traced,
        "I_2": (traced * traced - squared) * Fraction(1, 2),
        "I_3": determinant(S),
        "U_G": moved(A),
        "B_G": q.times(paired, inverse(C)),
    }


def _adjugate(x: Matrix) -> Matrix:
    """By Cayley and Hamilton: x² − x Tr x + I₂."""
    traced, square = q.trace(x), q.times(x, x)
    second = (traced * traced - q.trace(square)) * Fraction(1, 2)
    return q.plus(q.minus(square, q.scaled(traced, x)), q.scaled(second, q.identity(len(x))))
