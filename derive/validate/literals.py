"""The values of the decimals in emitted code."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction


class Literals:
    """The values of decimals, as a function of their text.

    A decimal is read as it stands, unless it is the double next to one of the numbers ``exact``,
    which has no shorter decimal, as 0.8377580409572781 to 4π/15: then it stands for that number,
    and is listed in ``rounded``.
    """

    def __init__(self, exact: Iterable[Fraction]):
        self.nearest: dict[float, set[Fraction]] = {}
        for x in exact:
            self.nearest.setdefault(abs(float(x)), set()).add(abs(x))
        self.rounded: set[str] = set()

    def __call__(self, text: str) -> Fraction:
        """The value of a decimal without sign, as a fraction."""
        value = Fraction(text)
        try:
            found = self.nearest.get(float(value), set())
        except OverflowError:
            found = set()
        if value in found or len(found) != 1:
            return value
        self.rounded.add(text)
        return next(iter(found))
