"""Groups as data: a basis of 𝔤 over Q, an action, an exact sampler.  The rest is computed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property
from typing import Any, Literal

from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from .samplers import RandomSource, Sampler, inner_sampler
from .structure import combined, commutator, sparse

Relation = Literal["orthogonal", "unimodular"]


@dataclass(frozen=True)
class Group:
    """A matrix group moving points of Rⁿ.

    ``basis``: d matrices of size n (linear) or n + 1 with last row zero (affine), over Q.
    ``sampler``: random exact elements; ``larger``: are they those of a larger group that has the
    same relations? ``factors``: of a product, in order; its n is the size of its block diagonal
    matrices. ``user_basis``: that of the user, where ``basis`` is another one of the same 𝔤.
    ``vectors``: is it R(n), whose elements are told by T alone?
    """

    name: str
    n: int
    action: Literal["linear", "affine"]
    basis: tuple[Matrix, ...]
    sampler: Sampler
    factors: tuple[Group, ...] = ()
    larger: bool = False
    user_basis: tuple[Matrix, ...] = ()
    vectors: bool = False

    def __repr__(self) -> str:
        return f"<group {self.name}: dimension {self.dimension}>"

    def __hash__(self) -> int:
        """Of what is short: a group is a key of many caches."""
        return hash((self.name, self.n, self.dimension))

    @cached_property
    def in_user_basis(self) -> Group:
        """The same group in the basis that the user states, whose coordinates are those of the
        state."""
        own = self.user_basis
        return replace(self, basis=own, user_basis=()) if own else self

    @property
    def dimension(self) -> int:
        """The dimension d of 𝔤."""
        return len(self.basis)

    @property
    def affine(self) -> bool:
        """Does the group also translate points?"""
        return self.action == "affine"

    @property
    def size(self) -> int:
        """The size s of the group's matrices: n, or n + 1 for an affine action."""
        return self.n + self.affine

    @cached_property
    def relations(self) -> frozenset[Relation]:
        """The relations that the linear parts of the connected group satisfy, read off the basis.

        ``orthogonal``: d(ĀA) = Ā(Z + Z̄)A vanishes, so ĀA = 1; ``unimodular``: d(det A) = det A Tr
        Z vanishes, so det A = 1.
        """
        linear = [self.linear_part(e) for e in self.basis]
        zero = q.scaled(0, q.identity(self.n))
        found: set[Relation] = set()
        if all(q.plus(e, q.transposed(e)) == zero for e in linear):
            found.add("orthogonal")
        if all(q.trace(e) == 0 for e in linear):
            found.add("unimodular")
        return frozenset(found)

    @cached_property
    def conformal(self) -> bool:
        """Is ĀA a multiple of 1 in the connected group?"""
        stretched = (q.plus(e, q.transposed(e)) for e in self.linear_basis)
        return all(s == q.scaled(s[0][0], q.identity(self.n)) for s in stretched)

    def linear_part(self, e: Matrix) -> Matrix:
        """The n × n block of a matrix of the group or of its algebra."""
        return tuple(row[: self.n] for row in e[: self.n])

    def translation_part(self, e: Matrix) -> Matrix:
        """The last column of such a matrix of an affine group, of n rows."""
        return tuple((row[self.n],) for row in e[: self.n])

    @cached_property
    def linear_basis(self) -> tuple[Matrix, ...]:
        """A basis of the linear parts of 𝔤: the linear parts of the basis, without those that
        depend on earlier ones."""
        parts = [self.linear_part(e) for e in self.basis]
        entries = dict.fromkeys(zip(*map(q.flatten, parts), strict=True))
        return tuple(parts[k] for k in q.echelon(tuple(entries))[1])

    @cached_property
    def free_translations(self) -> bool:
        """Is it H ⋉ Rⁿ, H not trivial, with the basis of 𝔥 first and then e_1, …, e_n of Rⁿ?"""
        n = self.n
        if not self.affine or self.dimension <= n:
            return False
        last = tuple(q.unit(n + 1, i, n) for i in range(n))
        no_shift = all(row[n] == 0 for e in self.basis[:-n] for row in e)
        return self.basis[-n:] == last and no_shift

    @cached_property
    def turns_space(self) -> bool:
        """Is 𝔤 so(3) in the basis j(e₁), j(e₂), j(e₃), alone or with all translations of R³?"""
        if self.n != 3 or self.factors:
            return False
        turns = ((2, 1), (0, 2), (1, 0))
        hats = tuple(q.minus(q.unit(3, i, j), q.unit(3, j, i)) for i, j in turns)
        whole = self.free_translations if self.affine else self.dimension == 3
        return whole and self.linear_basis == hats

    @property
    def rotates(self) -> bool:
        """Does it turn R³ by all rotations, as maps of r or as matrices on (r, 1)?"""
        return self.turns_space or (len(self.factors) == 1 and self.factors[0].turns_space)

    @cached_property
    def places(self) -> tuple[tuple[int, Group], ...]:
        """The blocks of a product as (first row, factor), rows counted from 0; one block for any
        other group."""
        found, offset = [], 0
        for factor in self.factors or (self,):
            found.append((offset, factor))
            offset += factor.size
        return tuple(found)

    @property
    def barycentric_blocks(self) -> tuple[tuple[int, Group], ...]:
        """The blocks H ⋉ Rⁿ, as (first row, factor), of a product of groups with skew linear parts;
        none for other groups."""
        skew = all("orthogonal" in factor.relations for factor in self.factors)
        return tuple(x for x in self.places if skew and self.factors and x[1].free_translations)

    def in_block(self, block: int, entries: Sequence[Any], corner: Any = 0) -> tuple[Any, ...]:
        """A vector of the space of a block (from 1) as one of the product, 0 in other blocks;
        ``corner``: the last entry in the block of an affine factor."""
        if not self.factors:
            return tuple(entries)
        offset, factor = self.places[block - 1]
        inside = (*entries, corner) if factor.affine else tuple(entries)
        return (*(0,) * offset, *inside, *(0,) * (self.n - offset - len(inside)))

    def of_block(self, block: int) -> slice:
        """The slice of a product's vector in which the coordinates of a block (from 1) are."""
        offset, factor = self.places[block - 1]
        return slice(offset, offset + factor.n)

    def in_every_block(self, entries: Sequence[Any]) -> tuple[Any, ...]:
        """A vector of space repeated in every block of a product: each point sees its own copy."""
        if not self.factors:
            return tuple(entries)
        corners = ((0,) if factor.affine else () for factor in self.factors)
        return tuple(x for corner in corners for x in (*entries, *corner))

    def hat(self, coordinates: Sequence[Any]) -> Matrix:
        """The element Z = Σ ζᵃ E_a of 𝔤 with the d coordinates ζ."""
        return q.combine(coordinates, self.basis)

    @cached_property
    def _coordinate_rows(self) -> Matrix:
        """The d × s² rows that read ζ off the entries of Z: a left inverse of the basis."""
        columns = q.transposed(tuple(q.flatten(e) for e in self.basis))
        _, pivots = q.echelon(q.transposed(columns))
        square = q.inverted(tuple(columns[p] for p in pivots))
        rows = [[Fraction(0)] * (self.size**2) for _ in self.basis]
        for a, row in enumerate(square):
            for k, p in enumerate(pivots):
                rows[a][p] = row[k]
        return q.matrix(rows)

    def coordinate_terms(self, a: int) -> list[tuple[Fraction, int, int]]:
        """The terms (coefficient, i, j) of ζᵃ = Σ coefficient · Z_ij, a, i and j counted from 0."""
        s = self.size
        return [(c, k // s, k % s) for k, c in enumerate(self._coordinate_rows[a]) if c]

    def covector_matrix(self, values: Iterable[Any]) -> Matrix:
        """The matrix N of the group's size with Tr N Ē_a = the a-th value, by the rows of
        :meth:`coordinate_terms`."""
        total = q.scaled(Fraction(0), q.identity(self.size))
        for a, p in enumerate(values):
            for x, i, j in self.coordinate_terms(a):
                total = q.plus(total, q.scaled(p * x, q.unit(self.size, i, j)))
        return total

    def nearest(self, z: Matrix) -> tuple[Any, ...]:
        """The d coordinates that :meth:`coordinate_terms` takes of any matrix of the size: those of
        Z where it is in 𝔤."""
        flat = q.flatten(z)
        return tuple(
            sum((c * x for c, x in zip(row, flat, strict=True) if c), Fraction(0))
            for row in self._coordinate_rows
        )

    def vee(self, z: Matrix) -> tuple[Any, ...] | None:
        """The coordinates ζ of Z, or ``None`` when Z is not in 𝔤."""
        coordinates = self.nearest(z)
        return coordinates if self.hat(coordinates) == q.matrix(z) else None

    @cached_property
    def structure_constants(self) -> tuple[Matrix, ...]:
        """The coordinates ``c[a][b]`` of [E_a, E_b], d × d × d; ``ValueError`` if 𝔤 is not
        closed."""
        span, listed = range(self.dimension), [sparse(e) for e in self.basis]
        readers = [self.coordinate_terms(a) for a in span]
        table = [[(Fraction(0),) * self.dimension for _ in span] for _ in span]
        for a in span:
            for b in range(a):
                found = commutator(listed[b], listed[a])
                own = [
                    sum((c * found.get((i, j), 0) for c, i, j in x), Fraction(0)) for x in readers
                ]
                if combined(own, listed) != found:
                    raise ValueError(f"{self.name}: the basis is not closed under the bracket")
                table[b][a], table[a][b] = tuple(own), tuple(-x for x in own)
        return tuple(map(tuple, table))

    @cached_property
    def normal_space(self) -> tuple[Matrix, ...]:
        """A basis of {Λ : Tr Λ̄ξ = 0 for every ξ in 𝔤}: the multipliers of the constraint."""
        s = self.size
        vectors = q.nullspace(tuple(q.flatten(e) for e in self.basis))
        return tuple(tuple(v[i * s : (i + 1) * s] for i in range(s)) for v in vectors)

    @cached_property
    def normal_space_of_linear_parts(self) -> tuple[Matrix, ...]:
        """A basis of {Λ in gl(n) : Tr Λ̄ξ = 0 for every linear part ξ of 𝔤}."""
        linear = replace(self, action="linear", basis=self.linear_basis, factors=())
        return linear.normal_space

    @cached_property
    def keeps_no_more_than_volume(self) -> bool:
        """Are all linear maps of trace 0 among the linear parts of 𝔤?"""
        normal = self.normal_space_of_linear_parts
        return all(x == q.scaled(x[0][0], q.identity(self.n)) for x in normal)

    @property
    def normal_direction(self) -> Matrix:
        """The matrix that spans the normal space of the linear parts, which must have dimension 1;
        the identity where it is a multiple of that."""
        (normal,) = self.normal_space_of_linear_parts
        one = q.identity(self.n)
        return one if normal == q.scaled(normal[0][0], one) else normal

    def sample(self, random: RandomSource, size: int = 9) -> Matrix:
        """A random exact rational element of the group, from integers within ±size."""
        return self.sampler(random, size)

    @cached_property
    def _inner_sampler(self) -> Sampler | None:
        if self.larger and not self.rotates:  # all rotations, and displacements: they are known
            return inner_sampler(self.basis)
        return self.sampler

    @property
    def has_inner_samples(self) -> bool:
        """Are exact elements of the least algebraic group that contains it known?"""
        return self._inner_sampler is not None

    def sample_inside(self, random: RandomSource, size: int = 9) -> Matrix:
        """A random exact element of the least algebraic group that contains this one, on which the
        same polynomials vanish; ``ValueError`` where none are known."""
        if self._inner_sampler is None:
            raise ValueError(f"{self.name}: no exact elements are known")
        return self._inner_sampler(random, size)


def names_by_block(group: Group) -> dict[str, str]:
    """The coordinates of the velocity of a product, each by the name that it has where its block is
    alone, with the number of the block: ``zeta_4`` → ``zeta2_1``, ``zeta_7`` → ``w2_1``; none
    without several blocks."""
    own = []
    for k, (_, factor) in enumerate(group.places, 1):
        turns = factor.dimension - factor.n * factor.free_translations
        own += [suffixed(f"zeta{k}", i + 1) for i in range(turns)]
        own += [suffixed(f"w{k}", i + 1) for i in range(factor.dimension - turns)]
    several = len(group.places) > 1
    return {suffixed("zeta", a): x for a, x in enumerate(own, 1)} if several else {}


# The entries of an element of a group, by those that tell them: the affine hull of the group.
#
# Every g in the connected group is 1 + a sum of products of elements of 𝔤, and such products span
# the linear parts of that hull: what is linear among entries of these holds among those of g.

Combination = tuple[Fraction, dict[tuple[int, int], Fraction]]
"""A number, and the weights of entries by their places from 0."""


@cache
def affine_entries(group: Group) -> tuple[tuple[Combination, ...], ...]:
    """Every entry of g, size × size, as number + Σ weight · entry of the free ones."""
    size = group.size
    start = (Fraction(1), *q.flatten(q.identity(size)))
    rows, pivots = q.echelon((start, *((Fraction(0), *q.flatten(p)) for p in _products(group))))
    places = [divmod(p - 1, size) for p in pivots[1:]]
    return tuple(
        tuple(
            (
                rows[0][1 + size * i + j],
                {
                    place: row[1 + size * i + j]
                    for place, row in zip(places, rows[1:], strict=False)
                    if row[1 + size * i + j]
                },
            )
            for j in range(size)
        )
        for i in range(size)
    )


@cache
def constant_entries(group: Group) -> dict[tuple[int, int], Fraction]:
    """Place, from 0, → the number that an entry of g is in all of the group; of a group of which no
    exact elements are known, the places between blocks and in the last rows of affine ones."""
    span = range(group.size)
    if group.has_inner_samples:
        entries = affine_entries(group)
        return {(i, j): entries[i][j][0] for i in span for j in span if not entries[i][j][1]}
    block = {k: offset for offset, f in group.places for k in range(offset, offset + f.size)}
    last = {offset + f.n for offset, f in group.places if f.affine}
    return {
        (i, j): Fraction(int(i == j))
        for i in span
        for j in span
        if i in last or block[i] != block[j]
    }


def _products(group: Group) -> list[Matrix]:
    """Products of elements of the basis, as many as are independent."""
    kept: list[Matrix] = []
    reduced: dict[int, tuple[Fraction, ...]] = {}
    waiting = [*group.basis]
    while waiting:
        e = waiting.pop()
        rest = q.flatten(e)
        for k, row in reduced.items():
            if rest[k]:
                rest = tuple(x - rest[k] * y for x, y in zip(rest, row, strict=True))
        lead = next((k for k, x in enumerate(rest) if x), None)
        if lead is None:
            continue
        reduced[lead] = tuple(x / rest[lead] for x in rest)
        kept.append(e)
        waiting += [q.times(x, e) for x in group.basis]
    return kept
