"""A Lie algebra by its structure constants, [E_a, E_b] = Σ c_ab^k E_k; that of the torus."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations, pairwise
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from .samplers import block_diagonal

# Matrices of which most entries are 0, as place → entry: those of a basis of a Lie algebra.

Sparse = Mapping[tuple[int, int], Any]


def sparse(m: Matrix) -> Sparse:
    """The entries that are not 0."""
    return {(i, j): x for i, row in enumerate(m) for j, x in enumerate(row) if x}


def commutator(a: Sparse, b: Sparse) -> Sparse:
    """ab − ba."""
    return q.summed([*_product(a, b), *((at, -x) for at, x in _product(b, a))])


def combined(weights: Sequence[Any], basis: Sequence[Sparse]) -> Sparse:
    """Σ w_a E_a."""
    pairs = zip(weights, basis, strict=True)
    return q.summed((at, w * x) for w, e in pairs if w for at, x in e.items())


def _product(a: Sparse, b: Sparse) -> Iterable[tuple[tuple[int, int], Any]]:
    rows: dict[int, list[tuple[int, Any]]] = {}
    for (i, j), x in b.items():
        rows.setdefault(i, []).append((j, x))
    for (i, k), x in a.items():
        for j, y in rows.get(k, ()):
            yield (i, j), x * y


Combination = Mapping[int, Fraction]
Brackets = Mapping[tuple[int, int], Combination]
"""Σ x_k E_k as k → x, where x is not 0; and the brackets of pairs, where they are not 0."""


@dataclass(frozen=True)
class Algebra:
    """A Lie algebra of this ``dimension``; ``standard``: the matrices by which it is given, none
    where it is by brackets."""

    name: str
    dimension: int
    brackets: Brackets
    standard: Sequence[Matrix] = ()

    def representation(self, name: str) -> tuple[Matrix, ...]:
        """One by its name: ``standard``, ``adjoint``, or their duals, ``dual`` and ``coadjoint``;
        ``ValueError`` for the standard one and its dual where there are no matrices."""
        if name in ("adjoint", "coadjoint"):
            found = adjoint(self.brackets, self.dimension)
        elif not self.standard:
            raise ValueError(f"an algebra by brackets has no {name!r}: list matrices, or 'adjoint'")
        else:
            found = tuple(self.standard)
        return dual(found) if name in ("dual", "coadjoint") else found


def brackets_of(rows: Iterable[tuple[int, int, int, Fraction]]) -> Brackets:
    """The table of rows (a, b, k, c), counted from 1; each says [E_b, E_a] as well.

    ``ValueError`` where two rows say different things, or one a bracket of E_a with itself.
    """
    found: dict[tuple[int, int], dict[int, Fraction]] = {}
    for a, b, k, c in rows:
        if a == b:
            if c:
                raise ValueError(f"not antisymmetric: [E_{a}, E_{a}] must be 0, not {c} E_{k}")
            continue
        for pair, x in (((a, b), c), ((b, a), -c)):
            own = found.setdefault((pair[0] - 1, pair[1] - 1), {})
            if own.setdefault(k - 1, x) != x:
                raise ValueError(
                    f"not antisymmetric: [E_{a}, E_{b}] has {c} E_{k}, and by another row "
                    f"{own[k - 1] if pair == (a, b) else -own[k - 1]} E_{k}"
                )
    kept = {pair: {k: x for k, x in own.items() if x} for pair, own in found.items()}
    return {pair: own for pair, own in kept.items() if own}


def require_jacobi(brackets: Brackets, dimension: int) -> None:
    """``ValueError`` that names the triple, and what is left, where Jacobi's identity fails."""
    for triple in combinations(range(dimension), 3):
        a, b, c = triple
        left = q.summed(
            term
            for pair, last in (((a, b), c), ((b, c), a), ((c, a), b))
            for term in _with(brackets, brackets.get(pair, {}), last).items()
        )
        if left:
            names = ", ".join(f"E_{x + 1}" for x in triple)
            raise ValueError(
                f"Jacobi's identity fails for {names}: the sum of [[E_{a + 1}, E_{b + 1}], "
                f"E_{c + 1}] and its cyclic permutations is {as_text(left)}, not 0"
            )


def _with(brackets: Brackets, x: Combination, b: int) -> Combination:
    """[x, E_b]."""
    terms = ((k, c) for k, c in x.items())
    return q.summed((j, c * y) for k, c in terms for j, y in brackets.get((k, b), {}).items())


def as_text(x: Combination) -> str:
    """2 E_1 − E_3, for a message."""
    terms = [
        f"{'−' if c < 0 else '+'} {'' if abs(c) == 1 else f'{abs(c)} '}E_{k + 1}"
        for k, c in sorted(x.items())
    ]
    text = " ".join(terms)
    return text[2:] if text.startswith("+") else text.replace("− ", "−", 1)


def table_of(brackets: Brackets, dimension: int) -> tuple[Matrix, ...]:
    """The coordinates c[a][b] of [E_a, E_b], d × d × d."""
    span = range(dimension)
    none: Combination = {}
    return tuple(
        tuple(tuple(brackets.get((a, b), none).get(k, Fraction(0)) for k in span) for b in span)
        for a in span
    )


def adjoint(brackets: Brackets, dimension: int) -> tuple[Matrix, ...]:
    """ad E_a, x ↦ [E_a, x], for each a."""
    return tuple(q.transposed(rows) for rows in table_of(brackets, dimension))


def dual(matrices: Sequence[Matrix]) -> tuple[Matrix, ...]:
    """The representation −ρ̄ on the dual space."""
    return tuple(q.scaled(Fraction(-1), q.transposed(x)) for x in matrices)


def require_representation(matrices: Sequence[Matrix], brackets: Brackets) -> None:
    """``ValueError`` where [ρ(E_a), ρ(E_b)] is not ρ([E_a, E_b])."""
    for a, b in combinations(range(len(matrices)), 2):
        wanted = q.scaled(Fraction(0), matrices[0])
        for k, c in brackets.get((a, b), {}).items():
            wanted = q.plus(wanted, q.scaled(c, matrices[k]))
        if q.bracket(matrices[a], matrices[b]) != wanted:
            raise ValueError(
                f"no representation: the commutator of the matrices of E_{a + 1} and E_{b + 1} is "
                f"not that of [E_{a + 1}, E_{b + 1}]"
            )


def faithful(brackets: Brackets, dimension: int) -> tuple[Matrix, ...]:
    """Matrices that stand for the algebra and are independent; ``ValueError`` where none of these
    are: the adjoint representation, on 𝔤 with some of 𝔤/[𝔤, 𝔤] and of the derivations of 𝔤."""
    found = adjoint(brackets, dimension)
    seen = rank(found)
    for more in (_translations, _derived):
        if seen == dimension:
            break
        for part in more(brackets, dimension):
            larger = direct_sum(found, part)
            if rank(larger) > seen:
                found, seen = larger, rank(larger)
    if seen < dimension:
        raise ValueError(
            "no matrices were found that stand for this algebra: its centre is seen neither by "
            "brackets nor by derivations; give it by a basis of matrices"
        )
    return found


def direct_sum(*several: Sequence[Matrix]) -> tuple[Matrix, ...]:
    """The block diagonal matrices of representations."""
    return tuple(map(block_diagonal, zip(*several, strict=True)))


class Span:
    """A linear space of vectors that grows; ``rows``: a basis in echelon form, sparse, by the place
    of the first entry, which is 1."""

    def __init__(self) -> None:
        self.rows: dict[int, dict[int, Fraction]] = {}

    def rest(self, v: Iterable[Fraction]) -> dict[int, Fraction]:
        """What is left of a vector, sparse, when its first entries are eliminated."""
        rest = {i: x for i, x in enumerate(v) if x}
        while rest and (first := min(rest)) in self.rows:
            lead = rest[first]
            for i, x in self.rows[first].items():
                rest[i] = rest.get(i, Fraction(0)) - lead * x
                if not rest[i]:
                    del rest[i]
        return rest

    def add(self, v: Iterable[Fraction]) -> bool:
        """Add a vector to the space; true if it was not in it."""
        rest = self.rest(v)
        if rest:
            first = min(rest)
            self.rows[first] = {i: x / rest[first] for i, x in rest.items()}
        return bool(rest)


def rank(matrices: Sequence[Matrix]) -> int:
    """How many of the matrices are independent."""
    span = Span()
    return sum(span.add(q.flatten(m)) for m in matrices)


def _translations(brackets: Brackets, dimension: int) -> Iterator[tuple[Matrix, ...]]:
    """E_a as a translation of a line, by a number that vanishes on all brackets."""
    span = range(dimension)
    rows = [tuple(x.get(k, Fraction(0)) for k in span) for x in brackets.values()]
    for f in q.nullspace(tuple(rows or [(Fraction(0),) * dimension])):
        yield tuple(q.matrix([[Fraction(0), f[a]], [Fraction(0)] * 2]) for a in span)


def _derived(brackets: Brackets, dimension: int) -> Iterator[tuple[Matrix, ...]]:
    """E_a on 𝔤 and one derivation D, as they are in an algebra: [E_a, D] = −D E_a."""
    span, adjoined = range(dimension), adjoint(brackets, dimension)
    for D in derivations(brackets, dimension):
        yield tuple(
            q.matrix(
                [
                    *((*adjoined[a][k], -D[k][a]) for k in span),
                    (Fraction(0),) * (dimension + 1),
                ]
            )
            for a in span
        )


def derivations(brackets: Brackets, dimension: int) -> list[Matrix]:
    """A basis of the maps D with D[x, y] = [Dx, y] + [x, Dy], d × d."""
    span, table = range(dimension), table_of(brackets, dimension)
    rows = []
    for a, b in combinations(span, 2):
        for k in span:
            row = [Fraction(0)] * dimension**2  # the entries D_ij, row after row
            for i in span:
                row[k * dimension + i] += table[a][b][i]
                row[i * dimension + a] -= table[i][b][k]
                row[i * dimension + b] -= table[a][i][k]
            if any(row):
                rows.append(tuple(row))
    ends, none = range(0, dimension**2 + 1, dimension), (Fraction(0),) * dimension**2
    return [
        q.matrix([x[i:j] for i, j in pairwise(ends)]) for x in q.nullspace(tuple(rows or [none]))
    ]


# The algebra su(N) in the basis T_n of the torus, N odd, n a point of a square lattice.
#
# T_n = ω^(n₁n₂) g^n₁ h^n₂,  ω = e^(2πi/N),  g = diag(ω^2j),  h_(j,j+1) = 1  (indices modulo N)
#
# T_n depends on n modulo N alone, and T_m T_n = ω^(−m∧n) T_(m+n), m∧n = m₁n₂ − m₂n₁; T_0 = 1. In
# row a and column b, T_n has ω^(n₁(a+b)) where b − a = n₂ modulo N, and 0 elsewhere.

Place = tuple[int, int]


@dataclass(frozen=True)
class TorusLattice:
    """The lattice of one odd N; ``half``: the largest size of a coordinate of a representative."""

    N: int

    @property
    def name(self) -> str:
        """That of the group."""
        return f"SU({self.N})"

    @property
    def half(self) -> int:
        """(N − 1)/2."""
        return self.N // 2

    @cached_property
    def places(self) -> tuple[Place, ...]:
        """The representatives |n_i| ≤ (N − 1)/2 but 0, row by row: n₁, then n₂."""
        span = range(-self.half, self.half + 1)
        return tuple((a, b) for a in span for b in span if a or b)

    @cached_property
    def half_plane(self) -> tuple[Place, ...]:
        """One of n and −n: n₂ > 0, or n₂ = 0 and n₁ > 0; by n₂, then n₁."""
        found = (n for n in self.places if n[1] > 0 or (n[1] == 0 and n[0] > 0))
        return tuple(sorted(found, key=lambda n: (n[1], n[0])))

    @cached_property
    def coefficients(self) -> tuple[str, ...]:
        """The names of Re and Im of ω̂(n) in this order: re_1_0, im_1_0, …; m for a minus sign."""
        found = ("_".join(str(x).replace("-", "m") for x in n) for n in self.half_plane)
        return tuple(f"{part}_{x}" for x in found for part in ("re", "im"))

    def position(self, n: Place) -> tuple[int, bool]:
        """Where Re ω̂(n) stands among these, Im being next to it; and is ω̂(n) the conjugate?"""
        first, second = self.representative(n)
        turned = second < 0 or (second == 0 and first < 0)
        a, b = (-first, -second) if turned else (first, second)
        place = a - 1 if b == 0 else self.half + (b - 1) * self.N + a + self.half
        return 2 * place, turned

    def representative(self, n: Place) -> Place:
        """The representative of n modulo N."""
        a, b = ((x + self.half) % self.N - self.half for x in n)
        return a, b
