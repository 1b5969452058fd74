"""The checker's own account of each kind of potential.

``energy(at, p, r, masses)``: U from the places of the points, at the time of ``at``.  Where the
walk sums a kind up in words, ``values(model, members)`` says what its letters are, ``families``
those with an index, ``functions`` those with arguments, and ``summed(at, p)`` which ones these are
of, if not of all; where it has distances, ``radial(at, p, r, masses)`` gives each of them with U as
a function of its square.  ``of_body_axes``: it is of the axes of the body, whose ends are then
points (``PotentialData.body_axes``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from math import prod
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ..values.arithmetic import ETA, Nilpotent, determinant, inverse, nilpotent, part
from ..values.evaluate import Environment, evaluate
from .point_masses import Body, Distance, PotentialData, Vector, axial, outer_sum, scaled_each

Data = Mapping[str, Any]
Places = Sequence[Vector]
Masses = Sequence[Any]
NODES = 2


@dataclass(frozen=True)
class Account:
    """One kind of potential."""

    energy: Callable[[PotentialData, Data, Places, Masses], Any]
    values: Callable[[Body, Sequence[Data]], dict[str, Any]] | None = None
    families: Callable[[Body, Sequence[Data]], dict[str, dict[tuple[int, ...], Any]]] | None = None
    functions: Callable[[Body], dict[str, Callable[..., Any]]] | None = None
    summed: Callable[[PotentialData, Data], bool] = lambda *_: True
    radial: Callable[..., Iterator[Distance]] | None = None
    of_body_axes: bool = False


# Any U of the time and the places.


# U = −Σ m_i μ / ‖r_i − centre‖.


def attraction_radial(at: PotentialData, p: Data, r: Places, masses: Masses) -> Iterator[Distance]:
    """The distance of each mass."""
    for d, pull in _attracted(at, p, r, masses):
        yield d, partial(_pulled, at, pull)


def _pulled(at: PotentialData, pull: Any, square: Any) -> Any:
    return -pull / at.root(square)


def _attracted(
    at: PotentialData, p: Data, r: Places, masses: Masses
) -> Iterator[tuple[Vector, Any]]:
    """For each mass its place seen from the centre, and m · strength."""
    strength, centre = at.number(p["strength"]), at.vector(p["centre"])
    given = [(i, at.number(m)) for i, m in p.get("on", ())]
    for i, m in given or enumerate(masses, 1):
        if m:
            d = at.place(r, i)
            origin = centre or (Fraction(0),) * len(d)
            yield tuple(x - y for x, y in zip(d, origin, strict=True)), m * strength


# U = −GM Σ m_i (1/R − ⟨n, x_i⟩/R² + (3⟨n, x_i⟩² − ‖x_i‖²)/2R³), x_i from the body's origin.


def far_centre_energy(at: PotentialData, p: Data, r: Places, masses: Masses) -> Any:
    """The sum over the masses."""
    origin, _ = at.body_axes(r)
    T = _seen_from(at, p, origin)
    R = at.root(q.dot(T, T))
    n = tuple(x / R for x in T)
    total: Any = Fraction(0)
    for m, place in zip(masses, r, strict=True):
        if m:
            x = tuple(a - b for a, b in zip(place, origin, strict=True))
            along = q.dot(n, x)
            second = (3 * along * along - q.dot(x, x)) * Fraction(1, 2)
            total = total + m * (1 / R - along / (R * R) + second / (R * R * R))
    return -at.number(p["strength"]) * total


def _seen_from(at: PotentialData, p: Data, origin: Vector) -> Vector:
    centre = at.vector(p["centre"]) or (Fraction(0),) * len(origin)
    return tuple(a - b for a, b in zip(origin, centre, strict=True))


def far_centre_values(model: Body, members: Sequence[Data]) -> dict[str, Any]:
    """T in the body's frame, 1/R and GM/R."""
    at, p = model.applied, members[0]
    T = _seen_from(at, p, at.body_axes(model.images(model.g))[0])
    R = at.root(q.dot(T, T))
    back = q.transposed(model.group.linear_part(model.g))
    return {"T_b": q.times(back, q.column(T)), "W": 1 / R, "V": at.number(p["strength"]) / R}


# U = −Σ q_i ⟨E(t), r_i⟩.


def field_energy(at: PotentialData, p: Data, r: Places, _masses: Masses) -> Any:
    """Over the points that the problem lists, the first of all."""
    E = tuple(at.value(x, r) for x in p["E"])
    pairs = enumerate(at.vector(p["charges"]), 1)
    return -sum((charge * q.dot(E, at.place(r, i)) for i, charge in pairs), Fraction(0))


# U = −Σ m_i ⟨g, r_i⟩, in every block.


def gravity_energy(at: PotentialData, p: Data, r: Places, masses: Masses) -> Any:
    """The weight of the points that have one."""
    g = at.group.in_every_block(at.vector(p["g"]))
    pairs = zip(masses, r, strict=True)
    return -sum((m * q.dot(g, x) for m, x in pairs if m), Fraction(0))


def gravity_values(model: Body, members: Sequence[Data]) -> dict[str, Any]:
    """γ, the sum of all."""
    ex = model.applied
    whole = [q.column(model.group.in_every_block(ex.vector(p["g"]))) for p in members]
    total = whole[0]
    for x in whole[1:]:
        total = q.plus(total, x)
    return {"γ": total}


# U = ½ Σ m_i ⟨r_i, W r_i⟩.


def harmonic_energy(at: PotentialData, p: Data, r: Places, masses: Masses) -> Any:
    """The sum over the masses, row by row of W."""
    rows = [at.vector(row) for row in p["W"]]
    pairs = [(m, x) for m, x in zip(masses, r, strict=True) if m]
    work = (m * y * q.dot(row, x) for m, x in pairs for y, row in zip(x, rows, strict=True))
    return sum(work, Fraction(0)) * Fraction(1, 2)


def harmonic_values(model: Body, members: Sequence[Data]) -> dict[str, Any]:
    """W_r, the sum of all."""
    total = q.scaled(Fraction(0), q.identity(model.n))
    for p in members:
        total = q.plus(total, tuple(model.applied.vector(row) for row in p["W"]))
    return {"W_r": total}


# U = −(3/10) G m² ∫₀^∞ du / √det(S + u), S = (5/m) Σ m_i x_i x̄_i, x_i from the centre of mass.
#
# The integral is put to the test as a sum Σ w_k f(u_k) at two random u_k, with random w_k: what
# holds for all of these, and is linear in one integral or in products of two, holds for it.


def self_gravity_energy(at: PotentialData, p: Data, r: Places, masses: Masses) -> Any:
    """By the moments of the masses at their places."""
    m, S = _ellipsoid(r, masses)
    n = range(len(S))
    total: Any = Fraction(0)
    for w, u in _nodes(at):
        shifted = tuple(tuple(S[i][j] + (u if i == j else 0) for j in n) for i in n)
        total = total + w / at.root(determinant(shifted))
    return -at.number(p["G"]) * m * m * Fraction(3, 10) * total


def _ellipsoid(r: Places, masses: Masses) -> tuple[Any, Matrix]:
    """The mass, and the matrix of the homogeneous ellipsoid with the same moments."""
    m = sum(masses, Fraction(0))
    weighted = scaled_each(masses, r)
    centre = tuple(sum(x, Fraction(0)) * (1 / m) for x in zip(*weighted, strict=True))
    arms = [tuple(x - y for x, y in zip(place, centre, strict=True)) for place in r]
    return m, q.scaled(5 / m, outer_sum(scaled_each(masses, arms), arms))


def _nodes(at: PotentialData) -> Iterator[tuple[Any, Any]]:
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


def self_gravity_functions(model: Body) -> dict[str, Callable[..., Any]]:
    """Ψ and Ψ_k at three numbers."""
    at = model.applied

    def integral(k: int, halves: int) -> Callable[..., Any]:
        def of(_: Tree, arguments: tuple[Tree, ...], env: Environment) -> Any:
            invariants = [evaluate(x, env) for x in arguments]
            return at_invariants(_nodes(at), invariants, k, halves, at.root)

        return of

    return {"Ψ": integral(0, 1)} | {f"Ψ_{k}": integral(k, 3) for k in range(3)}


def self_gravity_values(model: Body, members: Sequence[Data]) -> dict[str, Any]:
    """U_G; B_G by the work of U, Tr B_G C ξ for any ξ; the invariants in space."""
    at, p, n = model.applied, members[0], range(3)
    A = model.group.linear_part(model.g)
    K = _ellipsoid(model.points, model.masses)[1]

    def moved(matrix: Matrix) -> Any:
        places = q.transposed(q.times(matrix, q.transposed(tuple(model.points))))
        return self_gravity_energy(at, p, places, model.masses)

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


# U = ½ k (‖d‖ − ℓ)², d from one end to the other.


def spring_summed(at: PotentialData, p: Data) -> bool:
    """Those of length 0 inside one block."""
    if "between" not in p or p["length"] != 0:
        return False
    i, j = p["between"]
    return bool(at.blocks[i - 1] == at.blocks[j - 1])


def spring_radial(at: PotentialData, p: Data, r: Places, _masses: Masses) -> Iterator[Distance]:
    """Its one distance."""
    yield _difference(at, p, r), lambda square: _stretch(at, p, square)


def _difference(at: PotentialData, p: Data, r: Places) -> Vector:
    """From the second end to the first."""
    if "between" in p:
        a, b = (at.place(r, i) for i in p["between"])
    else:
        a, b = at.place(r, p["on"]), at.vector(p["anchor"])
    return tuple(x - y for x, y in zip(a, b, strict=True))


def _stretch(at: PotentialData, p: Data, square: Any) -> Any:
    k, length = at.number(p["stiffness"]), at.number(p["length"])
    if p["length"] == 0:
        return k * square * Fraction(1, 2)
    stretched = at.root(square) - length
    return k * (stretched * stretched) * Fraction(1, 2)


def spring_values(model: Body, members: Sequence[Data]) -> dict[str, Any]:
    """K = Σ k_e s_e s̄_e."""
    strengths, ends = zip(*_spring_ends(model, members), strict=True)
    return {"K": outer_sum(scaled_each(strengths, ends), ends)}


def spring_families(model: Body, members: Sequence[Data]) -> dict[str, dict[tuple[int, ...], Any]]:
    """k_e and s_e."""
    pairs = [*enumerate(_spring_ends(model, members), 1)]
    return {"k": {(e,): k for e, (k, _) in pairs}, "s": {(e,): q.column(s) for e, (_, s) in pairs}}


def _spring_ends(model: Body, members: Sequence[Data]) -> Iterator[tuple[Fraction, Vector]]:
    for p in members:
        i, j = p["between"]
        ends = zip(model.points[i - 1], model.points[j - 1], strict=True)
        yield model.applied.number(p["stiffness"]), tuple(a - b for a, b in ends)


# U = ½ k (n − Σ ⟨R e_j, A e_j⟩), A e_j an axis of the body in space.


def torsion_energy(at: PotentialData, p: Data, r: Places, _masses: Masses) -> Any:
    """By the cosines of the axes with where they rest."""
    _, axes = at.body_axes(r)
    R = tuple(at.vector(row) for row in p["rest"]) or q.identity(at.env.size)
    cosines = [q.dot(x, y) for x, y in zip(axes, q.transposed(R), strict=True)]
    return at.number(p["stiffness"]) * (len(axes) - sum(cosines, Fraction(0))) * Fraction(1, 2)


def torsion_values(model: Body, members: Sequence[Data]) -> dict[str, Any]:
    """k_A; N_A by its work, for any matrix ξ; its vector."""
    at, n = model.applied, model.n
    A = model.group.linear_part(model.g)

    def work(i: int, j: int) -> Any:
        """−dU where the axis e_j moves towards A e_i."""
        eta = nilpotent(ETA)
        moved = q.transposed(q.plus(A, q.times(A, q.scaled(eta, q.unit(n, i, j)))))
        places = [(Fraction(0),) * n, *moved]
        total = sum((torsion_energy(at, p, places, ()) for p in members), Fraction(0))
        return -Nilpotent.of(total).part(ETA)

    N = tuple(tuple(work(i, j) for j in range(n)) for i in range(n))
    found = {"k_A": sum((at.number(p["stiffness"]) for p in members), Fraction(0)), "N_A": N}
    if n == 3:
        found["μ_A"] = axial(q.minus(N, q.transposed(N)))
    return found


# U of the volume, by the determinant of the axes of the body in space.


def volume_energy(at: PotentialData, p: Data, r: Places, _masses: Masses) -> Any:
    """U where the axes are the columns of A."""
    _, axes = at.body_axes(r)
    return at.value(p["U"], (), A=q.transposed(tuple(axes)))


def volume_values(model: Body, members: Sequence[Data]) -> dict[str, Any]:
    """V_A; U_V; p_V by the work where one axis, and with it the volume, grows."""
    at, A = model.applied, model.group.linear_part(model.g)
    grown = (tuple(x * (1 + nilpotent(ETA)) for x in A[0]), *A[1:])
    total = sum((at.value(p["U"], (), A=grown) for p in members), Fraction(0))
    whole = Nilpotent.of(total)
    return {"V_A": determinant(A), "U_V": whole.part(0), "p_V": -whole.part(ETA)}


def by_distances(radial: Callable[..., Iterator[Distance]]) -> Callable[..., Any]:
    """U as the sum of what its distances give."""
    return lambda *given: sum((energy(q.dot(d, d)) for d, energy in radial(*given)), Fraction(0))


ACCOUNTS: dict[str, Account] = {
    "expression": Account(lambda at, p, r, _: at.value(p["U"], r)),
    "attraction": Account(by_distances(attraction_radial), radial=attraction_radial),
    "far_centre": Account(far_centre_energy, values=far_centre_values, of_body_axes=True),
    "field": Account(field_energy),
    "gravity": Account(gravity_energy, values=gravity_values),
    "harmonic": Account(harmonic_energy, values=harmonic_values),
    "self_gravity": Account(
        self_gravity_energy, functions=self_gravity_functions, values=self_gravity_values
    ),
    "spring": Account(
        by_distances(spring_radial),
        summed=spring_summed,
        radial=spring_radial,
        values=spring_values,
        families=spring_families,
    ),
    "torsion": Account(torsion_energy, values=torsion_values, of_body_axes=True),
    "volume": Account(volume_energy, values=volume_values, of_body_axes=True),
}


def uses_body_axes(problem: Data) -> bool:
    """Is there a potential of the axes of the body, whose ends are points to it?"""
    kinds = [p["kind"] for p in problem.get("potentials", [])]
    return any(ACCOUNTS[kind].of_body_axes for kind in kinds if kind in ACCOUNTS)
