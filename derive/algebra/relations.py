"""The polynomial relations that keep the matrices of a group, and metrics invariant by them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import combinations_with_replacement

from ..language import rational as q
from ..language.rational import Matrix
from .groups import Group
from .structure import Span

Vector = tuple[Fraction, ...]
"""The entries of a matrix row by row, and of a map r ↦ A r + T those of T after them."""

Linear = Callable[[Matrix], Sequence[Fraction]]
"""A linear function of n × n matrices."""


@dataclass(frozen=True)
class Relations:
    """The polynomial relations of the elements A, or (A, T), of a group that is no product.

    ``hull``: the matrix H of the projection with v = H v for the entries v of A − 1, then of T;
    empty where they are free. ``form``: S with ĀSA = S, or empty; ``conformal``: ĀSA = μS for some
    factor μ. ``determinant``: is it 1? ``complex_basis``: where that determinant is complex, P with
    P⁻¹AP = [[X, −Y], [Y, X]] for the complex matrix X + iY. ``dimension``: of what they leave, at
    least that of the group.
    """

    hull: Matrix
    form: Matrix
    conformal: bool
    determinant: bool
    complex_basis: Matrix
    dimension: int

    @property
    def none(self) -> bool:
        """Are there no relations, the group being open among all maps?"""
        return not (self.hull or self.form or self.determinant)


@cache
def relations(g: Group) -> Relations:
    """The relations of one group; for a product, ask for those of its factors."""
    n, linear = g.n, [e for e in map(g.linear_part, g.basis) if any(map(any, e))]
    conformal = any(q.trace(e) for e in linear)
    hull = space = _associative_hull(g)
    form: Matrix = ()
    complex_basis: Matrix = ()
    determinant = False

    def kept(value: Linear) -> list[Vector]:
        return _kernel(space, lambda v: value(_matrix_of(v, n)))

    S = _form(linear, n)
    if S and len(fewer := kept(lambda e: _variation(S, e, conformal))) < len(space):
        form, space = S, fewer
    if not conformal and len(fewer := kept(lambda e: (q.trace(e),))) < len(space):
        determinant, space = True, fewer
    K = _complex_structure(linear, hull, n) if len(space) > g.dimension and not conformal else ()
    if K and not any(q.trace(q.times(K, e)) for e in linear):
        determinant, complex_basis = True, _complex_basis(K)
        space = kept(lambda e: (q.trace(q.times(K, e)),))
    free = len(hull) == n * (n + g.affine)
    projector = () if free else _projector(hull, n)
    return Relations(projector, form, conformal, determinant, complex_basis, len(space))


# -- spaces of vectors ---------------------------------------------------------------------------


def _kernel(space: Sequence[Vector], value: Callable[[Vector], Sequence[Fraction]]) -> list[Vector]:
    """A basis of the vectors of a space where a linear function vanishes."""
    span, found = Span(), []
    for v in space:
        image = tuple(value(v))
        rest = span.rest((*image, *v))
        if min(rest) < len(image):
            span.rows[min(rest)] = {i: x / rest[min(rest)] for i, x in rest.items()}
        else:
            found.append(tuple(rest.get(len(image) + i, Fraction(0)) for i in range(len(v))))
    return found


def _matrix_of(v: Vector, n: int) -> Matrix:
    """The n × n matrix whose entries are a vector's first n²."""
    return tuple(v[n * i : n * i + n] for i in range(n))


# -- the hull ------------------------------------------------------------------------------------


def _associative_hull(g: Group) -> list[Vector]:
    """A basis, in echelon form, of E₀, which products of matrices of 𝔤 span."""
    n, most, span = g.n, g.n * (g.n + g.affine), Span()
    found: list[Matrix] = []

    def take(e: Matrix) -> None:
        shift = [row[n] for row in e[:n]] if g.affine else []
        if len(found) < most and span.add((*q.flatten(g.linear_part(e)), *shift)):
            found.append(e)

    for e in g.basis:
        take(e)
    for e in found:
        for x in g.basis if len(found) < most else ():
            take(_product(e, x))
    rows = [tuple(row.get(i, Fraction(0)) for i in range(most)) for row in span.rows.values()]
    return [row for row in q.echelon(tuple(rows))[0] if any(row)]


def _product(a: Matrix, b: Matrix) -> Matrix:
    """The matrix product a b, fast for matrices with few entries."""
    rows = []
    for row in a:
        total = [Fraction(0)] * len(b)
        for x, other in zip(row, b, strict=True):
            if x:
                total = [t + x * y if y else t for t, y in zip(total, other, strict=True)]
        rows.append(tuple(total))
    return tuple(rows)


def _projector(hull: Sequence[Vector], n: int) -> Matrix:
    """The matrix H of the projection onto the hull: orthogonal in A, then in T among what A leaves
    to it."""
    size, width = n * n, len(hull[0]) - n * n
    moving = [v for v in hull if any(v[:size])]
    a, t = (tuple(v[part] for v in moving) for part in (slice(size), slice(size, None)))
    shifts = tuple(v[size:] for v in hull if not any(v[:size]))
    onto_translations = _combination(shifts, _dual(shifts), width, width)
    dual = _dual(a)
    shift_of_linear = _combination(t, dual, width, size)
    if width:
        shift_of_linear = q.times(q.minus(q.identity(width), onto_translations), shift_of_linear)
    upper = _combination(a, dual, size, size)
    return (
        *((*row, *(Fraction(0),) * width) for row in upper),
        *((*x, *y) for x, y in zip(shift_of_linear, onto_translations, strict=True)),
    )


def _combination(rows: Matrix, dual: Matrix, height: int, width: int) -> Matrix:
    """The matrix that takes a vector to the combination of the rows with the coefficients that
    ``dual`` gives it."""
    if rows:
        return q.times(q.transposed(rows), dual)
    return ((Fraction(0),) * width,) * height


def _dual(rows: Matrix) -> Matrix:
    """The matrix (bb̄)⁻¹b, which gives the coefficients of the orthogonal projection onto the
    independent rows b."""
    if not rows:
        return ()
    inverse = q.inverted(q.times(rows, q.transposed(rows)))
    return q.times(inverse, rows)


# -- the form ------------------------------------------------------------------------------------


def _traceless(e: Matrix) -> Matrix:
    """The matrix less its trace times 1/n."""
    return q.minus(e, q.scaled(q.trace(e) / len(e), q.identity(len(e))))


def _variation(S: Matrix, e: Matrix, conformal: bool) -> Vector:
    """The n² entries of ēS + Se, the change of the form S along e, or along its traceless part
    (``conformal``)."""
    e = _traceless(e) if conformal else e
    return q.flatten(q.plus(_product(q.transposed(e), S), _product(S, e)))


def _form(linear: Sequence[Matrix], n: int) -> Matrix:
    """A non-degenerate form S that the traceless parts of all matrices keep: 1, else a symmetric
    one, else a skew one; () if none.

    In the plane a skew form is the determinant.
    """
    for sign in (1, -1) if n > 2 else (1,):
        pairs = combinations_with_replacement(range(n), 2)
        space = [_unit(n, i, j, sign) for i, j in pairs if sign == 1 or i != j]
        for e in linear:
            space = _kernel(space, lambda S, e=e: _variation(_matrix_of(S, n), e, True))  # type: ignore[misc]
        for S in _candidates(space, n):
            if linear and q.inverse(S) is not None:
                return S
    return ()


def _unit(n: int, i: int, j: int, sign: int) -> Vector:
    """The entries of E_ij + sign E_ji, or of E_ii."""
    unit = q.unit(n, i, j)
    return q.flatten(unit if i == j else q.plus(unit, q.scaled(sign, q.unit(n, j, i))))


def _candidates(space: Sequence[Vector], n: int) -> Iterable[Matrix]:
    """Matrices of a linear space of forms, one of which is likely to be invertible, simple ones
    first: 1, the basis, combinations."""
    if not space:
        return
    one = q.identity(n)
    if q.rank((*space, q.flatten(one))) == len(space):
        yield one
    matrices = [_matrix_of(S, n) for S in space]
    yield from matrices
    for k in range(1, n + 2):
        yield q.combine([Fraction(k) ** i for i in range(len(space))], matrices)


# -- the complex determinant ---------------------------------------------------------------------


def _complex_structure(linear: Sequence[Matrix], hull: Sequence[Vector], n: int) -> Matrix:
    """The matrix K with K² = −1, where the centre of the hull is spanned by 1 and K; () if there is
    none."""
    centre = [v[: n * n] for v in hull if any(v[: n * n])]
    for e in linear:
        centre = _kernel(
            centre,
            lambda S, e=e: q.flatten(
                q.minus(_product(_matrix_of(S, n), e), _product(e, _matrix_of(S, n)))
            ),  # type: ignore[misc]
        )
    span = Span()
    moving = [K for K in (_traceless(_matrix_of(v, n)) for v in centre) if span.add(q.flatten(K))]
    if len(moving) != 1:
        return ()
    square = _product(moving[0], moving[0])
    size = -square[0][0]
    if size <= 0 or square != q.scaled(-size, q.identity(n)):
        return ()
    root = q.root(size)
    return q.scaled(1 / root, moving[0]) if root else ()


def _complex_basis(K: Matrix) -> Matrix:
    """The matrix P with the columns v₁ … v_m, Kv₁ … Kv_m, a complex basis and its images."""
    n, chosen = len(K), Span()
    first: list[Vector] = []
    for v in q.identity(n):
        if chosen.add(v):
            first.append(v)
            chosen.add(_image(K, v))
    return q.transposed((*first, *(_image(K, v) for v in first)))


def _image(K: Matrix, v: Vector) -> Vector:
    """The vector K v."""
    return tuple(sum((x * y for x, y in zip(row, v, strict=True)), Fraction(0)) for row in K)


# Where ⟨Y, Y′⟩ = Tr Y J Ȳ′ C is the same at every element of a group, although C = ĀA is not 1.
#
# Along ξ in 𝔤 a form S becomes ξ̄S + Sξ. What C − 1 reaches on the connected group spans the
# least space that holds the changes of 1 and those of its own members; the metric of a body is
# left-invariant if and only if it vanishes for each member of that space in the place of C.


def changes(g: Group) -> Iterator[Matrix]:
    """A basis of the span of C − 1, for a connected group of linear maps."""
    rows: list[tuple[object, ...]] = []
    forms = [q.identity(g.n)]
    for S in forms:
        for e in g.basis:
            moved = q.times(S, e)
            change = q.plus(moved, q.transposed(moved))
            if any(map(any, change)) and q.rank((*rows, q.flatten(change))) > len(rows):
                rows.append(q.flatten(change))
                forms.append(change)
                yield change


def pairings(g: Group) -> Iterator[Matrix]:
    """The matrices Ē_b S E_a, each once: a metric is left-invariant where J pairs with each of them
    to 0."""
    for S in changes(g):
        for a, x in enumerate(g.basis):
            for y in g.basis[: a + 1]:
                yield q.times(q.transposed(y), q.times(S, x))


def for_every_body(g: Group) -> bool:
    """Is Ȳ C Y′ = ȲY′ for all Y, Y′ of 𝔤, so that the metric of every body is left-invariant?

    So it is where all factors have skew linear parts, on their matrices on (r, 1): their last rows
    are those of 0, and C is 1 but for the last rows and columns of its blocks.
    """
    if g.affine:
        return False
    if all(skew(factor) for factor in g.factors or (g,)):
        return True
    return not g.larger and not any(any(map(any, k)) for k in pairings(g))


def skew(g: Group) -> bool:
    """Are the linear parts of 𝔤 skew?"""
    return "orthogonal" in g.relations
