"""Sums over the lattice of the torus: an element Σ a(n) T(n) by its coefficient a, a function of n.

    T(m) T(n) = (cos x − i sin x) T(m + n),  x = 2π m∧n/N

The bracket keeps twice the odd part of the phase:  [T(m), T(n)] = −2i sin x T(m + n).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from ...language.tree import Tree, add, mul

FREE, BOUND = "𝐧", "𝐦"
"""A free index, and one that a sum binds."""
Index = tuple[int, int]
"""An index p𝐦 + q𝐧 by its numbers (p, q)."""
M, N = (1, 0), (0, 1)


def shown(k: Index) -> Tree:
    """The tree of an index."""
    parts = [(x, name) for x, name in zip(k, (BOUND, FREE), strict=True) if x]
    return add(*(mul(x, name) for x, name in sorted(parts, key=lambda part: part[0] < 0)))


def minus(k: Index, other: Index = (0, 0)) -> Index:
    """other − k."""
    return other[0] - k[0], other[1] - k[1]


def of(name: str, k: Index) -> Tree:
    """The value of a function of the lattice."""
    return ("call", name, shown(k))


def crossed(k: Index, other: Index) -> int:
    """k ∧ other, as a multiple of m ∧ n."""
    return k[0] * other[1] - k[1] * other[0]


@dataclass(frozen=True)
class Unit:
    """q iᵃ πᵇ, a = 0 or 1: the numbers of the torus."""

    q: Fraction
    i: int = 0
    pi: int = 0

    def __mul__(self, other: Unit | int | Fraction) -> Unit:
        if not isinstance(other, Unit):
            return Unit(self.q * other, self.i, self.pi)
        turns, i = divmod(self.i + other.i, 2)
        return Unit((-1) ** turns * self.q * other.q, i, self.pi + other.pi)

    def __add__(self, other: Unit) -> Unit:
        if (self.i, self.pi) != (other.i, other.pi):
            raise ValueError("a sum of numbers with other powers of i and π")
        return Unit(self.q + other.q, self.i, self.pi)

    def __sub__(self, other: Unit) -> Unit:
        return self + other * -1

    @property
    def inverse(self) -> Unit:
        """1/x; that of i is −i."""
        return Unit((-1) ** self.i / self.q, self.i, -self.pi)

    def times(self, *factors: Tree) -> Tree:
        """The tree of a product, i on that side of the line where π is."""
        if not self.i and not self.pi:
            return mul(self.q, *factors)
        q, i = (-self.q if self.pi < 0 and self.i else self.q), ("i",) * self.i
        above = ("π",) * (self.pi > 0) + i * (self.pi >= 0)
        below = ("π",) * (self.pi < 0) + i * (self.pi < 0)
        top, bottom = mul(abs(q.numerator), *above), mul(q.denominator, *below)
        return mul(1 if q > 0 else -1, top if bottom == 1 else ("div", top, bottom), *factors)


ONE = Unit(Fraction(1))
SINE = Unit(Fraction(-1), 1)
"""What the sine has in the phase of T(m) T(n), the cosine having 1."""


@dataclass(frozen=True)
class Phase:
    """The two parts of the phase of T(m) T(n) for an N: the even one cos, the odd one −i sin."""

    N: int

    def angle(self) -> Tree:
        """2π m∧n/N."""
        return ("div", mul(2, "π", ("wedge", BOUND, FREE)), self.N)

    def sine(self, k: int) -> Tree:
        """sin 2πk/N."""
        return ("fun", "sin", ("div", mul(2 * k, "π"), self.N))

    def product(self) -> Tree:
        """The phase itself."""
        cos, sin = (("fun", name, self.angle()) for name in ("cos", "sin"))
        return add(cos, SINE.times(sin))

    def bracket(self, k: Index, other: Index) -> tuple[Unit, Tree]:
        """That of [T(k), T(other)], where k ∧ other is ± m ∧ n: of the product less the one in the
        other order the odd part is left, twice."""
        odd = SINE * crossed(k, other) - SINE * crossed(other, k)
        return odd, ("fun", "sin", self.angle())


Coefficient = Callable[[Index], Tree]


def summed(coefficient: Coefficient, factor: Tree | None = None) -> Tree:
    """Σ a(n) T(n), or Σ a(n) times another factor."""
    last = of("T", N) if factor is None else factor
    return ("sum", FREE, mul(coefficient(N), last))


def bracket_at(phase: Phase, a: Coefficient, b: Coefficient) -> tuple[Unit, Tree]:
    """The coefficient at n of the bracket of Σ a T and Σ b T: the sum over m of a(n − m) b(m)."""
    unit, sine = phase.bracket(minus(M, N), M)
    return unit, ("sum", BOUND, mul(sine, b(M), a(minus(M, N))))
