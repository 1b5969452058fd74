"""A prime field with a primitive 4N-th root of unity: i, e^(2πi/N), and so cos and sin of 2πk/N.

The sines of the torus are irrational; modulo a prime p ≡ 1 (mod 4N) all identities between roots of
unity hold that hold in the cyclotomic field, and π, of which no step knows more than its letter, is
any number.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ..arithmetic import EvaluationError
from ..grades import CONSTANT, Graded
from ..residue import BITS, ROUNDS, Residue, _passes_miller_rabin
from .residues import Multiples, Residues


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
            return Residues([wave[k * n % N] for n in x.k], self.roots.p)
        if isinstance(x, Residues) or x not in self.turns:
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
