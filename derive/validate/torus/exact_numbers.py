"""The decimals of a file on the torus as residues: cosines, sines and what they are multiplied by.

A decimal that is the double next to one of these irrational numbers stands for it; any other for
itself.  The numbers are computed here in whole numbers of SCALE, by Machin's formula and by
Taylor's series.
"""

from __future__ import annotations

from fractions import Fraction

from ...algebra.structure import Torus
from ...check.torus.torus_model import TorusModel

SCALE = 1 << 200
TABLE = 9
"""The largest N of which a file may have a table of the terms, with products as decimals."""


def arctan_of_inverse(n: int) -> int:
    """arctan 1/n."""
    total, power, k = 0, SCALE // n, 1
    while power:
        total += power // k if k % 4 == 1 else -(power // k)
        power, k = power // n**2, k + 2
    return total


PI = 4 * (4 * arctan_of_inverse(5) - arctan_of_inverse(239))


def cosine(turns: Fraction) -> Fraction:
    """cos 2π·turns, within 1e-50."""
    turns = (turns + Fraction(1, 2)) % 1 - Fraction(1, 2)
    square = (2 * PI * turns.numerator // turns.denominator) ** 2 // SCALE
    total = term = SCALE
    k = 0
    while term:
        k += 2
        term = -term * square // SCALE // (k * (k - 1)) if abs(term) > 1 else 0
        total += term
    return Fraction(total, SCALE)


class ExactNumbers:
    """The values of decimals at one point; ``rounded``: the texts that stood for another number.

    ``given``: the fractions that decimals may stand for.
    """

    def __init__(self, model: TorusModel, given: tuple[Fraction, ...] = ()):
        self.p, self.rounded = model.roots.p, set[str]()
        self.nearest: dict[float, int] = {}
        self.twofold: set[float] = set()
        for x in given:
            self._add(x, self.residue(x))
        waves = model.elementary.waves
        N, pi = model.torus.N, Fraction(PI, SCALE)
        by_pi = self.residue(Fraction(1)) * pow(model.pi.n, -1, self.p)
        for k in range(N):
            self._add(cosine(Fraction(k, N)), int(waves["cos"][k]))
            self._add(cosine(Fraction(k, N) - Fraction(1, 4)), int(waves["sin"][k]))
        self._add(1 / (4 * pi), by_pi * pow(4, -1, self.p))
        for weight in weights(model.torus) if N <= TABLE else ():
            for k in range(1, N):
                size = weight * Fraction(N, 2)
                sine = cosine(Fraction(k, N) - Fraction(1, 4))
                self._add(size * sine / pi, self.residue(size) * int(waves["sin"][k]) * by_pi)

    def residue(self, x: Fraction) -> int:
        """Of a fraction."""
        return x.numerator * pow(x.denominator, -1, self.p) % self.p

    def _add(self, x: Fraction, value: int) -> None:
        """Let the double next to x, without sign, stand for a value."""
        size, value = abs(float(x)), (value if x > 0 else -value) % self.p
        if size < 2.0**-60:
            return
        if self.nearest.setdefault(size, value) != value:
            self.twofold.add(size)

    def __call__(self, text: str) -> int:
        """The value of a decimal without sign."""
        value = Fraction(text)
        size = float(value)
        if size not in self.nearest or size in self.twofold:
            return self.residue(value)
        found = self.nearest[size]
        if found != self.residue(value):
            self.rounded.add(text)
        return found


def weights(torus: Torus) -> set[Fraction]:
    """1/|m|² − 1/|k|² for all m and k."""
    squares = {a * a + b * b for a, b in torus.places}
    return {Fraction(1, x) - Fraction(1, y) for x in squares for y in squares if x < y}
