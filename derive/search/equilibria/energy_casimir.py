"""The energy–Casimir form: F = H + Σ λ_i C_i with dF = 0, its second derivatives on the leaf.

The C_i are the Casimirs and the other integrals that are known.  T, the tangent space of the leaf,
is the image of Λ: its equations n_j(y) = 0 are the kernel of Λ, row-reduced with pivots p_j, so
that y = Pz + Σ_j n_j(y) e_{p_j}, z the other coordinates, and

    ½Q(y) = ½Q(Pz) + Σ_j n_j(y) m_j(y),  ½Q(Pz) = Σ_k d_k ℓ_k(z)²,

the ℓ_k independent: the signs of the d_k are the signature on T.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

from ...language.rational import summed, times, transposed
from ...language.univariate import Number, Quadratic, number
from ..integrals.lie_poisson import Polynomial
from .equilibrium_points import About, Expansion, Matrix

Vector = list[Number]


@dataclass(frozen=True)
class Leaf:
    """The tangent space T of the symplectic leaf: its ``equations`` n_j, their ``pivots``, the
    ``free`` coordinates, and P, whose columns are a ``basis`` of T."""

    equations: Matrix
    pivots: tuple[int, ...]
    free: tuple[int, ...]
    basis: Matrix


def leaf(about: About) -> Leaf:
    """The tangent space of the leaf through a point: the image of Λ."""
    n = len(about.at)
    rows, pivots = reduced_rows(kernel(about.tensor, n), n)
    free = tuple(i for i in range(n) if i not in pivots)
    basis: list[Vector] = [[Fraction(int(i == j)) for j in free] for i in range(n)]
    for p, row in zip(pivots, rows, strict=True):
        basis[p] = [-row[j] for j in free]
    return Leaf(rows, pivots, free, basis)


@dataclass(frozen=True)
class EnergyCasimirForm:
    """F about an equilibrium.  ``multipliers``: λ; ``squares``: the d_k with the ℓ_k, rows over all
    coordinates; ``mixed``: the m_j, likewise; ``whole``: is Q definite beyond T, too?"""

    multipliers: tuple[Number, ...]
    expansion: Expansion
    squares: list[tuple[Number, Vector]]
    mixed: Matrix
    whole: bool

    @property
    def signature(self) -> tuple[int, int]:
        """How many squares are positive, and how many negative."""
        return signs(self.squares)


def signs(squares: Sequence[tuple[Number, Vector]]) -> tuple[int, int]:
    """How many squares are positive, and how many negative."""
    positive = sum(d > 0 for d, _ in squares)
    return positive, len(squares) - positive


def form(about: About, on: Leaf, conserved: Sequence[Polynomial]) -> EnergyCasimirForm | None:
    """The form, its free multipliers chosen such that it is definite on T where one of them can
    make it so; ``None`` where no multipliers make dF = 0."""
    energy = about.expansion(about.algebra.hamiltonian)
    kept = [about.expansion(f) for f in conserved]
    choices = solutions([e.slope for e in kept], [-x for x in energy.slope])
    if choices is None:
        return None
    start, freedom = choices
    first: EnergyCasimirForm | None = None
    for multipliers in multipliers_tried(start, freedom, energy, kept, on, between_roots):
        found = _form(multipliers, energy, kept, on)
        first = first or found
        if definite(found, on):
            return found
    return first


def definite(found: EnergyCasimirForm, on: Leaf) -> bool:
    """Is the form definite on the tangent space of the leaf?"""
    return len(on.free) in found.signature


def multipliers_tried(
    start: Vector,
    freedom: Matrix,
    energy: Expansion,
    kept: Sequence[Expansion],
    on: Leaf,
    between: Callable[[Matrix, Matrix], Iterable[Number]],
) -> Iterator[Vector]:
    """Multipliers: the first ones, and along each freedom those ``between`` roots of det Q."""
    yield start
    at_start = restricted(second_derivatives(start, energy, kept), on)
    nothing = Expansion(energy.value, [], [[x - x for x in row] for row in energy.second], {})
    for direction in freedom:
        along = restricted(second_derivatives(direction, nothing, kept), on)
        if any(map(any, along)):
            for mu in between(at_start, along):
                yield [x + mu * y for x, y in zip(start, direction, strict=True)]


def pencil(a: Matrix, b: Matrix, own: Any) -> Any:
    """det(a + μb), in the polynomials in μ over the field that the entries are in."""
    from sympy import Symbol
    from sympy.polys.matrices import DomainMatrix

    field: Any = own[Symbol("mu")]
    pairs = [
        [field(element(x, own)) + field.gens[0] * element(y, own) for x, y in zip(*r, strict=True)]
        for r in zip(a, b, strict=True)
    ]
    return DomainMatrix(pairs, (len(a), len(a)), field).charpoly()[-1]


def between_roots(a: Matrix, b: Matrix) -> list[Fraction]:
    """Numbers μ, one in each interval between the real roots of det(a + μb)."""
    from sympy import Poly, Symbol

    mu, own = Symbol("mu"), field_of([*a, *b])
    terms = pencil(a, b, own).items()
    determinant = rational_multiple({m: number_of(c, own) for (m,), c in terms})
    determinant = Poly.from_dict(determinant, mu, domain="QQ")
    if determinant.is_zero or determinant.degree() < 1:
        return []
    ends = [
        tuple(Fraction(int(x.p), int(x.q)) for x in ends)
        for ends, _ in determinant.intervals(eps=Fraction(1, 2**20))
    ]
    if not ends:
        return []
    inner = [_simple(low[1], high[0]) for low, high in pairwise(ends)]
    return [*inner, ends[0][0] - 1, ends[-1][1] + 1]


def _simple(low: Fraction, high: Fraction) -> Fraction:
    """A number of small denominator between two."""
    middle = (low + high) / 2
    for size in (1, 2, 4, 8, 16, 64, 256, 4096):
        if low < (x := middle.limit_denominator(size)) < high:
            return x
    return middle


def second_derivatives(
    multipliers: Sequence[Number], energy: Expansion, kept: Sequence[Expansion]
) -> Matrix:
    """The second derivatives of F."""
    n = len(energy.second)
    return [
        [
            energy.second[i][j]
            + sum(c * e.second[i][j] for c, e in zip(multipliers, kept, strict=True))
            for j in range(n)
        ]
        for i in range(n)
    ]


def combined(energy: Expansion, kept: Sequence[Expansion], by: Sequence[Number]) -> Expansion:
    """A polynomial plus multiples of others."""
    pairs = [*zip(by, kept, strict=True)]
    added = ((m, y * c) for y, e in pairs for m, c in e.higher.items())
    higher = summed([*energy.higher.items(), *added])
    slope = [x + sum(y * e.slope[i] for y, e in pairs) for i, x in enumerate(energy.slope)]
    value = energy.value + sum(y * e.value for y, e in pairs)
    second = second_derivatives(by, energy, kept)
    return Expansion(value, slope, second, higher)


def restricted(second: Matrix, on: Leaf) -> Matrix:
    """P̄QP."""
    return times(transposed(on.basis), times(second, on.basis))


def _form(
    multipliers: Vector, energy: Expansion, kept: Sequence[Expansion], on: Leaf
) -> EnergyCasimirForm:
    whole = combined(energy, kept, multipliers)
    second, n = whole.second, len(whole.second)
    expansion = replace(whole, slope=[Fraction(0)] * n)
    squares = [(d / 2, _spread(row, on.free, n)) for d, row in diagonalised(restricted(second, on))]
    across = times(second, on.basis)
    mixed = []
    for p in on.pivots:
        row = _spread(across[p], on.free, n)
        for q, equation in zip(on.pivots, on.equations, strict=True):
            row = [x + second[p][q] * y / 2 for x, y in zip(row, equation, strict=True)]
        mixed.append(row)
    signs = [d for d, _ in diagonalised(second)]
    beyond = len(signs) == n and len({d > 0 for d in signs}) == 1
    return EnergyCasimirForm((*multipliers,), expansion, squares, mixed, beyond)


def along_the_orbit(about: About, on: Leaf) -> Matrix:
    """The second derivatives of H along the coadjoint orbit, modulo the stabiliser, in the basis P
    of T: ω(Mv, w) for the linearised rates M, where ω(Λξ, Λη) = ⟨Λξ, η⟩."""
    image = times([e.slope for e in about.rates], on.basis)  # MP
    columns = transposed(about.tensor)
    covectors = []
    for v in transposed(on.basis):
        found = solutions(columns, v)
        assert found  # the image of Λ
        covectors.append([-x for x in found[0]])
    return times(covectors, image)


def _spread(row: Sequence[Number], places: Sequence[int], n: int) -> Vector:
    """A linear form in some coordinates, as one in all."""
    found: Vector = [Fraction(0)] * n
    for i, x in zip(places, row, strict=True):
        found[i] = x
    return found


def diagonalised(q: Matrix) -> list[tuple[Number, Vector]]:
    """A quadratic form z̄qz as Σ d ℓ(z)², each d not 0, the ℓ independent (Lagrange)."""
    n, left = len(q), [[*row] for row in q]
    found: list[tuple[Number, Vector]] = []

    def take(d: Number, row: Vector) -> None:
        found.append((d, row))
        for i in range(n):
            for j in range(n):
                left[i][j] -= d * row[i] * row[j]

    while any(map(any, left)):
        i = next((i for i in range(n) if left[i][i]), None)
        if i is not None:
            take(left[i][i], [x / left[i][i] for x in left[i]])
        else:  # 2c z_i z_j with no squares: (z_i ± z_j)² instead
            i, j = next((i, j) for i in range(n) for j in range(n) if left[i][j])
            c, u, v = left[i][j], [*left[i]], [*left[j]]
            take(1 / (2 * c), [x + y for x, y in zip(u, v, strict=True)])
            take(-1 / (2 * c), [x - y for x, y in zip(u, v, strict=True)])
    return found


# -- linear algebra over Q or Q(√d) -------------------------------------------------------------


def field_of(rows: Matrix) -> Any:
    """The field of SymPy that some numbers are in: Q, Q(√d), or that of functions of letters."""
    from sympy import QQ, sqrt
    from sympy.polys.fields import FracElement

    own = (x.field for row in rows for x in row if isinstance(x, FracElement))
    if found := next(own, None):
        return found.to_domain()

    roots = {x.d for row in rows for x in row if isinstance(x, Quadratic)}
    return QQ.algebraic_field(sqrt(roots.pop())) if roots else QQ


def element(x: Number, field: Any) -> Any:
    """A number in a field of SymPy."""
    from sympy import QQ

    if field.is_FractionField and not isinstance(x, Fraction):
        return x
    if isinstance(x, Quadratic):
        parts = [QQ(y.numerator, y.denominator) for y in (x.b, x.a)]
        return field.dtype(parts, field.mod.to_list(), QQ)
    return field.convert(QQ(x.numerator, x.denominator))


def number_of(x: Any, field: Any) -> Number:
    """The number of an element of a field of SymPy; the element itself where it has letters."""
    if field.is_FractionField:
        return x  # type: ignore[no-any-return]
    if field.is_QQ:
        return Fraction(int(x.numerator), int(x.denominator))
    parts = [Fraction(int(y.numerator), int(y.denominator)) for y in x.to_list()]
    b, a = [Fraction(0)] * (2 - len(parts)) + parts
    return number(a, b, int(-field.mod.to_list()[-1]))


def rational_multiple(terms: Mapping[int, Number]) -> dict[tuple[int], Fraction]:
    """A polynomial, power → coefficient, times the conjugate one, which has rational
    coefficients; itself where these are rational."""
    if not any(isinstance(x, Quadratic) for x in terms.values()):
        return {(m,): Fraction(x) for m, x in terms.items()}  # type: ignore[arg-type]
    found: dict[tuple[int], Number] = {}
    for m, x in terms.items():
        for k, y in terms.items():
            other = y.conjugate if isinstance(y, Quadratic) else y
            found[m + k,] = found.get((m + k,), Fraction(0)) + x * other
    return {m: Fraction(x) for m, x in found.items() if x != 0}  # type: ignore[arg-type]


def domain_matrix(rows: Matrix, columns: int) -> Any:
    """A matrix of SymPy over the field of its entries."""
    from sympy.polys.matrices import DomainMatrix

    field = field_of(rows)
    entries = [[element(x, field) for x in row] for row in rows]
    return DomainMatrix(entries, (len(rows), columns), field)


def _plain(a: Any) -> Matrix:
    return [[number_of(x, a.domain) for x in row] for row in a.to_list()]


def kernel(rows: Matrix, columns: int) -> Matrix:
    """A basis of the solutions of rows · y = 0, as rows."""
    return _plain(domain_matrix(rows, columns).nullspace())


def reduced_rows(rows: Matrix, columns: int) -> tuple[Matrix, tuple[int, ...]]:
    """The reduced echelon form without its zero rows, and its pivots."""
    if not rows:
        return [], ()
    echelon, pivots = domain_matrix(rows, columns).rref()
    return _plain(echelon)[: len(pivots)], tuple(pivots)


def solutions(vectors: Matrix, target: Sequence[Number]) -> tuple[Vector, Matrix] | None:
    """One solution c of Σ c_j v_j = target, and a basis of those of Σ c_j v_j = 0."""
    m = len(vectors)
    rows = [[*(v[i] for v in vectors), x] for i, x in enumerate(target)]
    echelon, pivots = reduced_rows(rows, m + 1)
    if m in pivots:
        return None
    start: Vector = [Fraction(0)] * m
    for p, row in zip(pivots, echelon, strict=True):
        start[p] = row[m]
    return start, kernel([r[:m] for r in rows], m) if m else []
