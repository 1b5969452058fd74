"""Numbers at all points of the lattice at once, in a prime field that has roots of unity; and the
matrices T(𝐧) there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, reduce
from itertools import repeat
from operator import add, mul, neg
from random import Random
from typing import Any, Protocol

from ...algebra.structure import TorusLattice
from ...language import rational as q
from ...language.rational import FieldElement, Matrix
from ..values.arithmetic import EvaluationError, Many, Shape
from ..values.residue import (
    BITS,
    CONSTANT,
    ROUNDS,
    Graded,
    Residue,
    _inverse,
    _passes_miller_rabin,
    _residue,
)

# Numbers at all points of the lattice at once: residues, and multiples of whole numbers.

NUMBERS = (int, Fraction, Residue)


class LatticeResidues(FieldElement):
    """Residues ``a`` modulo p, one for each point, of which products alone are reduced."""

    __slots__ = ("a", "p")

    def __init__(self, a: Sequence[int], p: int):
        self.a, self.p = a, p

    def _each(self, other: Any) -> Iterable[int] | None:
        """Another number at each point."""
        if isinstance(other, Multiples):
            other = other.residues
        if isinstance(other, LatticeResidues):
            return other.a
        return repeat(_residue(other, self.p)) if isinstance(other, NUMBERS) else None

    def __mul__(self, other: Any) -> Any:
        if (each := self._each(other)) is None:
            return NotImplemented
        return LatticeResidues([x % self.p for x in map(mul, self.a, each)], self.p)

    def __add__(self, other: Any) -> Any:
        if (each := self._each(other)) is None:
            return NotImplemented
        return LatticeResidues([*map(add, self.a, each)], self.p)

    def __neg__(self) -> Any:
        return LatticeResidues([*map(neg, self.a)], self.p)

    @property
    def inverse(self) -> LatticeResidues:
        """1 over each; ``ZeroDivisionError`` where one is 0."""
        return LatticeResidues([_inverse(x, self.p) for x in self.a], self.p)

    def __eq__(self, other: object) -> bool:
        """The same at all points?"""
        rest = self - other
        return rest is not NotImplemented and not any(x % self.p for x in rest.a)

    __hash__ = None  # type: ignore[assignment]

    @staticmethod
    def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
        """Σ a_i b_i."""
        return sum(map(mul, a, b), Fraction(0))

    def total(self) -> Residue:
        """The sum of all of them."""
        return Residue(sum(self.a), self.p)


class Multiples(FieldElement):
    """Whole numbers ``k``, one for each point, times a ``unit``, modulo p."""

    __slots__ = ("k", "p", "unit")

    def __init__(self, k: Sequence[int], p: int, unit: Any = 1):
        if unit != 1 and isinstance(unit, (int, Fraction)) and unit.denominator == 1:
            n = int(unit)
            k, unit = [x * n for x in k], 1
        self.k, self.p, self.unit = k, p, unit

    @property
    def residues(self) -> LatticeResidues:
        """The same, each as one number."""
        n, p = _residue(self.unit, self.p), self.p
        return LatticeResidues([x * n % p for x in self.k], p)

    @property
    def inverse(self) -> LatticeResidues:
        """1 over each; ``ZeroDivisionError`` where one is 0."""
        return self.residues.inverse

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Multiples):
            unit = self.unit * other.unit
            return Multiples([*map(mul, self.k, other.k)], self.p, unit)
        if isinstance(other, NUMBERS):
            return Multiples(self.k, self.p, self.unit * other)
        return NotImplemented

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Multiples) and self.unit == other.unit:
            return Multiples([*map(add, self.k, other.k)], self.p, self.unit)
        if isinstance(other, (int, Fraction)) and other.denominator == self.unit == 1:
            n = int(other)
            return Multiples([x + n for x in self.k], self.p)
        return self.residues + other

    def __eq__(self, other: object) -> bool:
        """The same at all points?"""
        return self.residues == other

    __hash__ = None  # type: ignore[assignment]

    dot = LatticeResidues.dot

    def total(self) -> Any:
        """The sum of all of them."""
        return self.unit * sum(self.k)


# A prime field with a primitive 4N-th root of unity: i, e^(2πi/N), and so cos and sin of 2πk/N.
#
# The sines of the torus are irrational; modulo a prime p ≡ 1 (mod 4N) all identities between
# roots of unity hold that hold in the cyclotomic field, and π, of which no step knows more than
# its letter, is any number.


def prime_with_roots(random: Random, order: int) -> tuple[int, int]:
    """A random prime p of BITS bits with p ≡ 1 modulo ``order``, and a root of unity modulo p of
    exactly this order."""
    while True:
        p = order * random.getrandbits(BITS - order.bit_length()) + 1
        if p > order and all(_passes_miller_rabin(p, random) for _ in range(ROUNDS)):
            break
    divisors = [q for q in range(2, order + 1) if order % q == 0]
    factors = [q for q in divisors if all(q % k for k in range(2, q))]
    while True:
        root = pow(random.randrange(2, p), (p - 1) // order, p)
        if all(pow(root, order // q, p) != 1 for q in factors):
            return p, root


class RootsOfUnity:
    """e^(2πik/N) and i as residues; without a prime, numbers of which the degree alone is known."""

    def __init__(self, N: int, random: Random | None):
        self.N = N
        if random is None:
            self.p = 0
            self.i: Any = Graded(CONSTANT)
            self.powers: list[Any] = [Graded(CONSTANT)] * N
            return
        self.p, root = prime_with_roots(random, 4 * N)
        self.i = Residue(pow(root, N, self.p), self.p)
        self.powers = [Residue(pow(root, 4 * k, self.p), self.p) for k in range(N)]

    def __getitem__(self, k: int) -> Any:
        """e^(2πik/N)."""
        return self.powers[k % self.N]


class Turns:
    """The functions cos and sin at the angles 2πk/N, |k| ≤ ``most``; there is no other value.

    ``largest``, ``values``: as of the functions at any argument; nothing is drawn.
    """

    largest = 0

    def __init__(self, roots: RootsOfUnity, pi: Any, most: int):
        self.roots, self.values = roots, dict[Any, Any]()
        self.step, self.turns, self.counts = Fraction(0), dict[Any, int](), dict[Any, int]()
        if roots.p:
            self.step = 2 * pi / roots.N
            self.turns = {self.step * k: k for k in range(-most, most + 1)}
            self.counts = {roots.i * 0 + k: k for k in range(-most, most + 1)}

    def __call__(self, name: str, x: Any) -> Any:
        """The value of a function at one of these angles."""
        if name not in ("cos", "sin"):
            raise EvaluationError(f"no value of {name} on the torus")
        if not self.roots.p:
            return Graded(CONSTANT)
        if isinstance(x, Multiples) and x.unit / self.step in self.counts:
            wave, N, k = self.waves[name], self.roots.N, self.counts[x.unit / self.step]
            return LatticeResidues([wave[k * n % N] for n in x.k], self.roots.p)
        if isinstance(x, LatticeResidues) or x not in self.turns:
            raise EvaluationError("an angle on the torus is a multiple of 2π/N")
        return self.value(name, self.turns[x])

    def value(self, name: str, k: int) -> Any:
        """cos or sin of 2πk/N."""
        ahead, back = self.roots[k], self.roots[-k]
        return (ahead + back) / 2 if name == "cos" else (ahead - back) / (2 * self.roots.i)

    @cached_property
    def waves(self) -> dict[str, list[int]]:
        """cos and sin of 2πk/N for all k, as integers."""
        span = range(self.roots.N)
        return {name: [self.value(name, k).n for k in span] for name in ("cos", "sin")}


# The matrices T(𝐧) at all points of the lattice at once, between other matrices.
#
# They are held equal by one number: Σ w(𝐧) x a(𝐧) T(𝐧) y with a random row x, a column y and
# weights w, which is of degree 3 in what is drawn.

WEIGHTS = 3
"""The degree of the number by which two are compared."""
Places = list[int]
"""Points of the lattice modulo N, one after the other: n₁N + n₂."""


class Lattice(Protocol):
    """The torus, its roots of unity, and sums Σ a(𝐧) T(𝐧) over its points: a model of it."""

    torus: TorusLattice
    roots: RootsOfUnity

    @property
    def drawn(self) -> Drawn:
        """By what matrices at all points are compared."""

    def coefficients(self, m: Matrix) -> Matrix:
        """a(𝐧) of a matrix Σ a(𝐧) T(𝐧), over 𝐧 modulo N."""

    def matrix(self, grid: Matrix) -> Matrix:
        """Σ a(𝐧) T(𝐧), of a(𝐧) over 𝐧 modulo N."""


@dataclass(frozen=True)
class LatticeTerm:
    """``left`` a(𝐧) T(𝐧) ``right``, where no matrix is 1."""

    places: Places
    factor: Any = 1
    left: Matrix | None = None
    right: Matrix | None = None


class Elements(Many):
    """A sum of terms, of the basis of a ``model`` of the torus."""

    def __init__(self, model: Lattice, terms: Sequence[LatticeTerm]):
        self.model, self.terms = model, terms

    @property
    def shape(self) -> Shape:
        """N × N."""
        return (self.model.torus.N, self.model.torus.N)

    def __matmul__(self, other: Any) -> Elements:
        if isinstance(other, Elements):
            raise EvaluationError("a product of two T(𝐧) of the same 𝐧")
        return self._with(lambda t: replace(t, right=_product(t.right, other)))

    def __rmatmul__(self, other: Any) -> Elements:
        return self._with(lambda t: replace(t, left=_product(other, t.left)))

    def __mul__(self, other: Any) -> Elements:
        return self._with(lambda t: replace(t, factor=t.factor * other))

    __rmul__ = __mul__

    def __add__(self, other: Any) -> Elements:
        if not isinstance(other, Elements):
            raise EvaluationError("a sum of one matrix and of one for each point")
        return Elements(self.model, [*self.terms, *other.terms])

    __radd__ = __add__

    def _with(self, change: Any) -> Elements:
        return Elements(self.model, [*map(change, self.terms)])

    def transposed(self) -> Elements:
        """The transposes: that of T(n₁, n₂) is T(n₁, −n₂)."""
        N = self.model.torus.N

        def turned(t: LatticeTerm) -> LatticeTerm:
            places = [n - n % N + -n % N for n in t.places]
            left, right = (q.transposed(x) if x else None for x in (t.right, t.left))
            return LatticeTerm(places, t.factor, left, right)

        return self._with(turned)

    def traced(self) -> Any:
        """The traces, Tr X T(𝐧) = N a(−𝐧) for X = Σ a(𝐧) T(𝐧)."""
        N, p, total = self.model.torus.N, self.model.roots.p, Residue(0, self.model.roots.p)
        for t in self.terms:
            around = _product(t.right, t.left) or q.identity(N)
            a = [_residue(x, p) for row in self.model.coefficients(around) for x in row]
            found = LatticeResidues([N * a[-(n // N) % N * N + -n % N] % p for n in t.places], p)
            total = found * t.factor + total
        return total

    def total(self) -> Matrix:
        """The sum over all points."""
        found: Any = (_product(_product(t.left, self._summed(t)), t.right) for t in self.terms)
        return reduce(q.plus, found)

    def _summed(self, t: LatticeTerm, weights: Sequence[int] | None = None) -> Matrix:
        """Σ a(𝐧) T(𝐧) over the points, with weights or without."""
        N, p = self.model.torus.N, self.model.roots.p
        grid = [0] * (N * N)
        numbers = _numbers(t.factor, p)
        for n, a in zip(t.places, map(mul, numbers, weights) if weights else numbers, strict=False):
            grid[n] += a
        rows = (grid[N * k : N * (k + 1)] for k in range(N))
        return self.model.matrix(tuple(tuple(Residue(x, p) for x in row) for row in rows))

    def __eq__(self, other: object) -> bool:
        """The same at all points?"""
        if not isinstance(other, Elements) and other != 0:
            raise EvaluationError("one matrix, and one for each point")
        rest = self._number - (other._number if isinstance(other, Elements) else 0)
        return not rest % self.model.roots.p

    __hash__ = None  # type: ignore[assignment]

    @cached_property
    def _number(self) -> int:
        """Σ w(𝐧) x a(𝐧) T(𝐧) y."""
        return sum(map(self._number_of, self.terms))

    def _number_of(self, t: LatticeTerm) -> int:
        drawn, p = self.model.drawn, self.model.roots.p
        if isinstance(t.factor, (LatticeResidues, Multiples)):
            if t.left is None is t.right:  # x T(𝐧) y is known
                each = map(mul, _numbers(t.factor, p), map(drawn.each.__getitem__, t.places))
                return _dot(drawn.weights, each)
            inside, factor = self._summed(t, drawn.weights), 1
        else:
            inside, factor = drawn.summed(self, t.places), _residue(t.factor, p)
        row, column = _before(drawn.row, t.left, p), _after(t.right, drawn.column, p)
        if t.right is None:
            return factor * _dot(row, drawn.once(_after, inside, drawn.column))
        if t.left is None:
            return factor * _dot(drawn.once(_before, drawn.row, inside), column)
        return factor * _dot(_before(row, inside, p), column)


class Wave(tuple[tuple[Residue, ...], ...]):
    """T(𝐧) at one point: in row r the r-th of the ``phases`` in column r + ``shift``, else 0."""

    shift: int
    phases: Sequence[Residue]

    @staticmethod
    def of(phases: Sequence[Residue], shift: int) -> Wave:
        """By what is in it."""
        N = len(phases)
        none = (phases[0] * 0,) * N
        columns = ((r + shift) % N for r in range(N))
        each = zip(phases, columns, strict=True)
        found = Wave((*none[:c], x, *none[c + 1 :]) for x, c in each)
        found.shift, found.phases = shift % N, phases
        return found


class Drawn:
    """A random row, a column, a weight for each point, and what is made of them."""

    def __init__(self, model: Lattice):
        p, N = model.roots.p, model.torus.N
        random = Random(f"{p} weights")
        self.p, self.sums = p, dict[tuple[int, ...], Matrix]()
        self.made = dict[Any, tuple[list[int], Any]]()
        self.weights = [random.randrange(p) for _ in model.torus.places]
        self.row, self.column = ([random.randrange(p) for _ in range(N)] for _ in range(2))
        roots = [_residue(z, p) for z in model.roots.powers]
        self.each: list[int] = []
        """x T(𝐧) y, Σ_r x_r ω^(n₁n₂ + 2n₁r) y_(r + n₂)."""
        for n in range(N * N):
            a, b = divmod(n, N)
            turned = (roots[(a * b + 2 * a * r) % N] for r in range(N))
            along = map(mul, self.row, (self.column[(r + b) % N] for r in range(N)))
            self.each.append(_dot(turned, along) % p)

    def summed(self, of: Elements, places: Places) -> Matrix:
        """Σ w(𝐧) T(𝐧), made once."""
        key = tuple(places)
        if key not in self.sums:
            self.sums[key] = of._summed(LatticeTerm(places), self.weights)
        return self.sums[key]

    def once(self, product: Callable[..., list[int]], *of: Any) -> list[int]:
        """A product of these, found once."""
        key = product, *map(id, of)
        if key not in self.made:
            self.made[key] = product(*of, self.p), of  # which live as long as their ids are used
        return self.made[key][0]


def _before(row: list[int], m: Matrix | None, p: int) -> list[int]:
    """A row times a matrix."""
    if m is None:
        return row
    if isinstance(m, Wave):
        turned = [x * y.n % p for x, y in zip(row, m.phases, strict=True)]
        return turned[-m.shift :] + turned[: -m.shift] if m.shift else turned
    return [_dot(row, (_residue(x, p) for x in column)) % p for column in zip(*m, strict=True)]


def _after(m: Matrix | None, column: list[int], p: int) -> list[int]:
    """A matrix times a column."""
    if m is None:
        return column
    if isinstance(m, Wave):
        turned = column[m.shift :] + column[: m.shift]
        return [x * y.n % p for x, y in zip(turned, m.phases, strict=True)]
    return [_dot((_residue(x, p) for x in row), column) % p for row in m]


def _dot(a: Iterable[int], b: Iterable[int]) -> int:
    """Σ a_i b_i."""
    return sum(map(mul, a, b))


def _numbers(factor: Any, p: int) -> Any:
    """A factor at each point, as integers."""
    if isinstance(factor, Multiples):
        factor = factor.residues
    return factor.a if isinstance(factor, LatticeResidues) else repeat(_residue(factor, p))


def _product(a: Matrix | None, b: Matrix | None) -> Matrix | None:
    """a b, where no matrix is 1."""
    return (b if a is None else a) if a is None or b is None else q.times(a, b)
