"""The algebra su(N) in the basis T_n of the torus, N odd, n a point of a square lattice.

    T_n = ω^(n₁n₂) g^n₁ h^n₂,  ω = e^(2πi/N),  g = diag(ω^2j),  h_(j,j+1) = 1  (indices modulo N)

T_n depends on n modulo N alone, and T_m T_n = ω^(−m∧n) T_(m+n), m∧n = m₁n₂ − m₂n₁; T_0 = 1.  In row
a and column b, T_n has ω^(n₁(a+b)) where b − a = n₂ modulo N, and 0 elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

Place = tuple[int, int]


@dataclass(frozen=True)
class Torus:
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

    def representative(self, n: Place) -> Place:
        """The representative of n modulo N."""
        a, b = ((x + self.half) % self.N - self.half for x in n)
        return a, b
