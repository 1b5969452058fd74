"""Arrays of exact complex numbers, with the functions of an array library.

A number is a pair of residues modulo p, Re and Im; a decimal of the code that meets an array is
the residue for which it stands.  NumPy has the arrays, of objects, and most of the functions, so
that emitted Python computes without rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...check.values.evaluate import ELEMENTARY
from ...language.rational import RingElement
from ..terms import CodeError


class ExactNumber(RingElement):
    """A complex number, by the residues of Re and Im."""

    __slots__ = ("im", "library", "re")

    def __init__(self, re: int, im: int, library: ExactLibrary):
        self.re, self.im, self.library = re % library.p, im % library.p, library

    def __add__(self, other: Any) -> Any:
        if isinstance(other, np.ndarray):
            return NotImplemented
        x = self.library.number(other)
        return ExactNumber(self.re + x.re, self.im + x.im, self.library)

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, np.ndarray):
            return NotImplemented
        x = self.library.number(other)
        re, im = self.re * x.re - self.im * x.im, self.re * x.im + self.im * x.re
        return ExactNumber(re, im, self.library)

    def __truediv__(self, other: Any) -> Any:
        if isinstance(other, np.ndarray):
            return NotImplemented
        x = self.library.number(other)
        if x.im or not x.re:
            raise CodeError("a division by 0, or by what is not real")
        return self * pow(x.re, -1, self.library.p)

    def __rtruediv__(self, other: Any) -> Any:
        return self.library.number(other) / self

    def __pow__(self, n: int) -> Any:
        if n != 2:
            raise CodeError(f"the power {n}")
        return self * self

    def conjugate(self) -> ExactNumber:
        """The conjugate, as NumPy asks for it."""
        return ExactNumber(self.re, -self.im, self.library)


class ExactArray(np.ndarray[Any, Any]):
    """An array of exact numbers."""

    __array_priority__ = 1.0
    library: Any = None

    def __array_finalize__(self, other: Any) -> None:
        self.library = getattr(other, "library", None)

    def __array_namespace__(self, *, api_version: str | None = None) -> Any:
        return self.library


class ExactLibrary:
    """The functions that emitted Python calls, NumPy's but for some; ``literal``: the residue of a
    decimal, ``elementary``: of a function at one, ``p``: the modulus."""

    def __init__(
        self, p: int, literal: Callable[[str], int], elementary: Callable[[str, int], int]
    ):
        self.p, self.literal, self.value_of = p, literal, elementary
        self.known: dict[complex, ExactNumber] = {}

    def number(self, x: Any) -> ExactNumber:
        """A plain number as an exact one."""
        if isinstance(x, ExactNumber):
            return x
        if x not in self.known:
            self.known[x] = ExactNumber(self._residue(x.real), self._residue(x.imag), self)
        return self.known[x]

    def _residue(self, x: float) -> int:
        if isinstance(x, int):
            return x
        size = self.literal(repr(float(abs(x))))
        return size if x >= 0 else -size

    def asarray(self, x: Any, dtype: Any = None) -> Any:
        """An array, of exact numbers but for those that are whole."""
        found = np.asarray(x)
        whole = dtype is None and found.dtype.kind in "iub"
        return found if whole else self.each(self.number, found)

    def each(self, f: Callable[[Any], Any], x: Any) -> ExactArray:
        """A function of each number of an array."""
        found = np.asarray(np.frompyfunc(f, 1, 1)(np.asarray(x, dtype=object)), dtype=object)
        exact = found.view(ExactArray)
        exact.library = self
        return exact

    def real(self, x: Any) -> ExactArray:
        """Re x."""
        return self.each(lambda z: ExactNumber(self.number(z).re, 0, self), x)

    def imag(self, x: Any) -> ExactArray:
        """Im x."""
        return self.each(lambda z: ExactNumber(self.number(z).im, 0, self), x)

    def isfinite(self, x: Any) -> Any:
        """True: no number here is infinite."""
        return np.full(np.shape(x), True)

    def __getattr__(self, name: str) -> Any:
        """An elementary function of real numbers, or one of NumPy's."""
        if name not in ELEMENTARY:
            return getattr(np, name)
        return lambda x: self.each(lambda z: self.number(self.value_of(name, self.number(z).re)), x)
