"""Lie–Poisson equations ẋ_i = {x_i, H}, polynomials on a level, kernels of sparse systems."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from math import lcm
from typing import Any

from ...algebra.exact_kernel import kernel, pivots
from ...algebra.groups import Group
from ...language.rational import summed
from ...language.tree import Tree, add, coefficient, mul
from ...language.values import value

Exponents = tuple[int, ...]
Polynomial = dict[Exponents, Any]
"""Exponents of x_1 …, x_n → a coefficient that is not 0."""
Linear = Mapping[int, Fraction]
"""A linear form Σ c_k x_k, by k from 0; −1 stands for the constant."""
ONE = -1


def multiplied(f: Polynomial, g: Polynomial) -> Iterator[tuple[Exponents, Any]]:
    """The terms of the product of two polynomials, not yet collected."""
    for e, x in f.items():
        for m, y in g.items():
            yield tuple(map(int.__add__, e, m)), x * y


def slope(f: Polynomial, i: int) -> Polynomial:
    """∂f/∂x_i."""
    return {(*e[:i], e[i] - 1, *e[i + 1 :]): c * e[i] for e, c in f.items() if e[i]}


@dataclass(frozen=True)
class LiePoisson:
    """Lie–Poisson equations as data.

    ``variables``: the names x_1 …, as trees.  ``brackets``: {x_i, x_j} for i < j from 0, those
    that are not 0.  ``hamiltonian``: the exponents of x → the coefficient, a tree of numbers and
    ``parameters``.  ``momenta``: so many of the variables, the first ones, count as of degree 1.
    ``names``: those of the variables at the command line; ``group``: whose brackets they are.
    """

    variables: tuple[Tree, ...]
    brackets: Mapping[tuple[int, int], Linear]
    hamiltonian: Mapping[Exponents, Tree]
    parameters: tuple[str, ...]
    momenta: int
    names: tuple[str, ...]
    group: Group

    def bracket(self, i: int, j: int) -> Linear:
        """The linear form {x_i, x_j}."""
        if i < j:
            return self.brackets.get((i, j), {})
        return {k: -c for k, c in self.brackets.get((j, i), {}).items()}

    @cached_property
    def algebra(self) -> PoissonPolynomials:
        """The ring in which brackets are computed."""
        return PoissonPolynomials(self)


class PoissonPolynomials:
    """The polynomials of Lie–Poisson equations: of integrals in the ring Z[x, parameters]; of H and
    of its flow, exponents of x → coefficients in the field Q(parameters).

    ``energy``: H without its constant term.
    """

    def __init__(self, system: LiePoisson):
        from sympy import QQ, ZZ, ring

        self.system, self.size = system, len(system.variables)
        letters = [f"p{k}" for k, _ in enumerate(system.parameters)]
        self.ring: Any = ring([*(f"x{i}" for i in range(self.size)), *letters], ZZ)[0]
        self.x: Sequence[Any] = self.ring.gens[: self.size]
        self.field: Any = QQ.frac_field(*letters) if letters else QQ
        gens = self.field.gens if letters else ()
        self.letters = dict(zip(system.parameters, gens, strict=True))
        self.hamiltonian = {e: self.number(t) for e, t in system.hamiltonian.items()}
        self.energy = {e: c for e, c in self.hamiltonian.items() if any(e)}
        self.scale = lcm(*(c.denominator for t in system.brackets.values() for c in t.values()))

    # -- brackets ------------------------------------------------------------------------------

    def bracket(self, f: Any, g: Any) -> Any:
        """{F, G} in the ring, up to the common denominator of the structure constants."""
        total = self.ring.zero
        df, dg = ([y.diff(x) for x in self.x] for y in (f, g))
        for (i, j), c in self.table.items():
            if (df[i] and dg[j]) or (df[j] and dg[i]):
                total = total + c * (df[i] * dg[j] - df[j] * dg[i])
        return total

    @cached_property
    def table(self) -> dict[tuple[int, int], Any]:
        """{x_i, x_j} in the ring, for i < j, times the common denominator."""
        found = {}
        for ij, form in self.system.brackets.items():
            terms = (int(c * self.scale) * (1 if k == ONE else self.x[k]) for k, c in form.items())
            found[ij] = sum(terms, self.ring.zero)
        return found

    def along(self, j: int) -> dict[int, Polynomial]:
        """The derivation {·, x_j}: i → {x_i, x_j} over the field."""
        forms = {i: self.system.bracket(i, j) for i in range(self.size)}
        return {
            i: {_unit(self.size, k): self.rational(c) for k, c in form.items()}
            for i, form in forms.items()
            if form
        }

    @cached_property
    def flow(self) -> dict[int, Polynomial]:
        """The derivation {·, H}: i → ẋ_i over the field."""
        found: dict[int, list[tuple[Exponents, Any]]] = {}
        for j in range(self.size):
            for i, image in self.along(j).items():
                found.setdefault(i, []).extend(multiplied(slope(self.hamiltonian, j), image))
        return {i: summed(terms) for i, terms in found.items()}

    def derivative(self, f: Polynomial) -> Polynomial:
        """{F, H} over the field."""
        images = self.flow.items()
        return summed(x for i, image in images for x in multiplied(slope(f, i), image))

    # -- coefficients --------------------------------------------------------------------------

    def number(self, t: Tree) -> Any:
        """A tree of numbers and parameters in the field."""
        names = {x: y for x, y in self.letters.items() if x == "π"}
        return self.field.convert(value(t, names, self.letters, number=self.rational))

    def rational(self, x: int | Fraction) -> Any:
        """A rational number in the field."""
        return self.field.convert(x.numerator) / self.field.convert(x.denominator)

    def cleared(self, terms: Mapping[Exponents, Any]) -> Any:
        """Σ c x^e with coefficients in the field, times what makes it a polynomial of the ring
        without a common factor in its coefficients, the first of them positive."""
        found: dict[Exponents, int] = {}
        if self.letters:
            small = self.field.field.ring
            common = small.one
            for c in terms.values():
                common = common.lcm(c.denom)
            lifted = {e: c.numer * common.exquo(c.denom) for e, c in terms.items()}
            pairs = {(*e, *m): y for e, f in lifted.items() for m, y in f.items()}
        else:
            pairs = {**terms}
        below = lcm(*(int(y.denominator) for y in pairs.values()))
        found = {m: int(y * below) for m, y in pairs.items()}
        f = self.ring.from_dict({m: self.ring.domain(c) for m, c in found.items() if c})
        factor = self.ring.zero
        for c in self.coefficients(f).values():
            factor = factor.gcd(c)
        f = f.exquo(factor)
        return f if f.LC > 0 else -f

    def coefficients(self, f: Any) -> dict[Exponents, Any]:
        """The coefficients of a polynomial of the ring, in the ring, by the exponents of x."""
        found: dict[Exponents, dict[Exponents, Any]] = {}
        for m, c in f.items():
            own = (0,) * self.size + m[self.size :]
            found.setdefault(m[: self.size], {})[own] = c
        return {e: self.ring.from_dict(t) for e, t in found.items()}

    def over_the_field(self, f: Any) -> Polynomial:
        """A polynomial of the ring by the exponents of x, its coefficients in the field."""
        if not self.letters:
            return {m: self.field.convert(c) for m, c in f.items()}
        small, found = self.field.field.ring, {}
        for e, c in self.coefficients(f).items():
            own = {m[self.size :]: small.domain.convert(int(x)) for m, x in c.items()}
            found[e] = self.field.field.new(small.from_dict(own))
        return found

    # -- trees ---------------------------------------------------------------------------------

    def tree(self, f: Any) -> Tree:
        """A polynomial of the ring as a tree: each monomial in x with its coefficient, factored."""
        return self._summed({e: self._factored(c) for e, c in self.coefficients(f).items()})

    def field_tree(self, f: Polynomial) -> Tree:
        """A polynomial over the field as a tree."""
        return self._summed({e: self.number_tree(c) for e, c in f.items()})

    def _summed(self, coefficients: Mapping[Exponents, Tree]) -> Tree:
        order = sorted(coefficients, key=monomial_order)
        factors = {e: powers(self.system.variables, e) for e in order}
        return add(*(scaled(coefficients[e], *factors[e]) for e in order))

    def _factored(self, c: Any) -> Tree:
        """A coefficient in the ring, as a product."""
        number, factors = c.factor_list()
        return mul(plain(number), *self._product(factors, self.size))

    def _product(self, factors: Iterable[tuple[Any, int]], start: int) -> list[Tree]:
        """The trees of powers of polynomials in the letters, which come after ``start`` others."""
        found: list[Tree] = []
        for f, k in factors:
            tree = self.letters_tree({m[start:]: y for m, y in f.items()})
            found.append(tree if k == 1 else ("pow", tree, k))
        return found

    def letters_tree(self, f: Mapping[Exponents, Any]) -> Tree:
        """A polynomial in the letters as a tree."""
        return in_letters(self.letters, f)

    def number_tree(self, c: Any) -> Tree:
        """An element of the field as a tree, a quotient of products."""
        if not self.letters or isinstance(c, Fraction):
            return plain(c)
        (first, above), (second, below) = (f.factor_list() for f in (c.numer, c.denom))
        number = Fraction(plain(first)) / plain(second)
        numerator = mul(number.numerator, *self._product(above, 0))
        denominator = mul(number.denominator, *self._product(below, 0))
        return numerator if denominator == 1 else ("div", numerator, denominator)


def plain(y: Any) -> int | Fraction:
    """A rational number of SymPy."""
    q = Fraction(int(y.numerator), int(y.denominator))
    return int(q) if q.denominator == 1 else q


def scaled(c: Tree, *factors: Tree) -> Tree:
    """A coefficient times a monomial, in one numerator; a sign stands in front."""
    if not isinstance(c, tuple) or c[0] != "div":
        return mul(c, *factors)
    number, rest = coefficient(c[1])
    return mul(-1 if number < 0 else 1, ("div", mul(abs(number), rest, *factors), c[2]))


def _unit(size: int, k: int) -> Exponents:
    """The exponents of x_k, or of 1."""
    return tuple(int(i == k) for i in range(size))


def monomial_order(e: Exponents) -> tuple[int, list[int]]:
    """High degrees first, then early variables."""
    return -sum(e), [-k for k in e]


def in_letters(letters: Iterable[str], f: Mapping[Exponents, Any]) -> Tree:
    """A polynomial in letters, π and parameters, as a tree: what is added before what is taken
    away."""
    names: list[Tree] = [x if x == "π" else ("par", x) for x in letters]
    terms = sorted(f.items(), key=lambda x: (x[1] < 0, monomial_order(x[0])))
    return add(*(mul(plain(y), *powers(names, m)) for m, y in terms))


def powers(names: Sequence[Tree], exponents: Exponents) -> list[Tree]:
    """The factors of a monomial."""
    pairs = zip(names, exponents, strict=True)
    return [x if k == 1 else ("pow", x, k) for x, k in pairs if k]


# Polynomials on the level C = 0 of a Casimir: normal forms modulo C.
#
# The multiples of a Casimir are a Poisson ideal: {F, H} on the level is told by F on the level.


class Level:
    """The polynomials modulo a Casimir over Z with leading coefficient 1 or −1."""

    def __init__(self, algebra: PoissonPolynomials, casimir: Any):
        size = algebra.size
        terms = {m[:size]: int(c) for m, c in casimir.items()}
        self.casimir, self.lead = casimir, max(terms)
        self.sign = terms.pop(self.lead)
        self.rest = {e: -c * self.sign for e, c in terms.items()}
        self.normal = cache(self._normal)

    @staticmethod
    def possible(algebra: PoissonPolynomials, casimir: Any) -> bool:
        """Is it without parameters, of leading coefficient 1 or −1, with a linear factor in that
        term, and can it vanish: has every term a momentum?  Casimirs of the entries of g alone
        have the values that the group gives them."""
        size, momenta = algebra.size, algebra.system.momenta
        return (
            not any(any(m[size:]) for m in casimir)
            and abs(casimir.LC) == 1
            and 1 in max(casimir)
            and all(any(m[:momenta]) for m in casimir)
        )

    def leads(self, e: Exponents) -> bool:
        """Is a monomial a multiple of the leading one?"""
        return all(x >= y for x, y in zip(e, self.lead, strict=True))

    def _normal(self, e: Exponents) -> Polynomial:
        """The normal form of a monomial."""
        if not self.leads(e):
            return {e: 1}
        left = tuple(x - y for x, y in zip(e, self.lead, strict=True))
        return self.reduced(multiplied({left: 1}, self.rest))

    def reduced(self, terms: Iterable[tuple[Exponents, Any]]) -> Polynomial:
        """The normal form of a sum of terms."""
        return summed((k, c * x) for e, c in terms for k, x in self.normal(e).items())

    def quotient(self, f: Polynomial) -> Polynomial:
        """What the Casimir is multiplied by in a polynomial over the field that is a multiple."""
        left, found = {**f}, Polynomial()
        while left:
            e = max(left)
            c = left.pop(e)
            own = tuple(x - y for x, y in zip(e, self.lead, strict=True))
            found[own] = c * self.sign
            left = summed([*left.items(), *multiplied({own: c}, self.rest)])
        return found

    def contains(self, f: Any) -> bool:
        """Is a polynomial of the ring a multiple of the Casimir?"""
        return bool(f.rem(self.casimir) == 0)


# Exact kernels of sparse systems: modulo a prime, and over a field, of few unknowns.
#
# The prime finds what there may be; the field proves it. A kernel modulo p is at least as large
# as the true one, so what is found modulo p and proved over the field is all there is.

PRIMES = (2**31 - 1, 2**31 - 19, 2**31 - 61)
"""Primes below 2³¹: a product of two residues fits into 63 bits."""

Row = Mapping[int, Any]
"""A sparse row, column → entry."""


def kernel_modulo(rows: Iterable[Row], width: int, p: int) -> list[list[int]]:
    """A basis of {x : Σ_j a_j x_j = 0 for every row} modulo p, vectors of ``width`` residues."""
    return kernel(_distinct(rows, width, p), width, p)[0]


def _distinct(rows: Iterable[Row], width: int, p: int) -> Iterator[list[int]]:
    """The rows that are not the same, in order, with their zeros."""
    for row in sorted({tuple(sorted((j, x % p) for j, x in row.items() if x % p)) for row in rows}):
        found = [0] * width
        for j, x in row:
            found[j] = int(x)
        yield found


def rank_modulo(rows: Sequence[Sequence[int]], p: int) -> int:
    """The rank of a dense matrix modulo p."""
    width = len(rows[0]) if rows else 0
    return len(pivots(([int(x % p) for x in row] for row in rows), width, p))


def kernel_vector(rows: Sequence[Row], width: int, field: Any) -> list[Any] | None:
    """The vector that spans {x : Σ_j a_j x_j = 0 for every row} over a field of SymPy; ``None``
    where that is not of dimension 1."""
    from sympy.polys.matrices import DomainMatrix

    entries = {i: {j: x for j, x in row.items() if x} for i, row in enumerate(rows)}
    found = DomainMatrix({i: r for i, r in entries.items() if r}, (len(rows), width), field)
    basis = found.nullspace().to_sdm() if rows else None
    if basis is None or basis.shape[0] != 1:
        return None
    (vector,) = basis.values()
    return [vector.get(j, field.zero) for j in range(width)]
