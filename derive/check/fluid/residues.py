"""Numbers at all points of the lattice at once, in a prime field that has roots of unity."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import repeat
from operator import add, mul, neg
from random import Random
from typing import Any

from ...language.rings import FieldElement
from ..values.arithmetic import EvaluationError
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
        p, each = self.p, self._each(other)
        return (
            NotImplemented
            if each is None
            else LatticeResidues([x % p for x in map(mul, self.a, each)], p)
        )

    def __add__(self, other: Any) -> Any:
        each = self._each(other)
        return (
            NotImplemented if each is None else LatticeResidues([*map(add, self.a, each)], self.p)
        )

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
    factors = [q for q in range(2, order + 1) if order % q == 0 and _is_prime(q)]
    while True:
        root = pow(random.randrange(2, p), (p - 1) // order, p)
        if all(pow(root, order // q, p) != 1 for q in factors):
            return p, root


def _is_prime(q: int) -> bool:
    return all(q % k for k in range(2, q))


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
