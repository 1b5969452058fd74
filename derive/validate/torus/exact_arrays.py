"""Arrays of exact complex numbers, with the functions of an array library.

A number is a pair of residues modulo p, Re and Im; a decimal of the code that meets an array is
the residue for which it stands.  With these in the place of NumPy, emitted Python computes without
rounding.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..terms import CodeError

Numbers = np.ndarray[Any, Any]


class ExactLibrary:
    """The functions that emitted Python calls; ``literal``: the residue of a decimal,
    ``elementary``: of a function at one, ``p``: the modulus."""

    def __init__(
        self, p: int, literal: Callable[[str], int], elementary: Callable[[str, int], int]
    ):
        self.p, self.literal, self.value_of = p, literal, elementary

    def residues(self, values: Any) -> Numbers:
        """Real numbers as residues."""
        found = np.asarray(values)
        if found.dtype.kind in "iub":
            return found.astype(object)
        known: dict[float, int] = {}
        flat = found.astype(float).ravel().tolist()
        for x in {*flat}:
            size = self.literal(repr(abs(x)))
            known[x] = (size if x >= 0 else -size) % self.p
        return np.array([known[x] for x in flat], dtype=object).reshape(found.shape)

    def asarray(self, x: Any, dtype: Any = None) -> ExactArray:
        """An array, of numbers of any kind."""
        del dtype
        if isinstance(x, ExactArray):
            return x
        given = np.asarray(x)
        if given.dtype == object:
            return ExactArray(given, given * 0, self)
        return ExactArray(self.residues(given.real), self.residues(given.imag), self)

    def mapped(self, f: Callable[[Any], Any], x: Any) -> ExactArray:
        """A function of both parts."""
        a = self.asarray(x)
        return ExactArray(f(a.re), f(a.im), self)

    def joined(self, f: Callable[..., Any], arrays: Sequence[Any], **where: Any) -> ExactArray:
        """A function of the parts of several arrays."""
        found = [self.asarray(x) for x in arrays]
        return ExactArray(
            f([x.re for x in found], **where), f([x.im for x in found], **where), self
        )

    def take(self, x: ExactArray, places: ExactArray, axis: int) -> ExactArray:
        """The values at some places, whole numbers."""
        at = places.re.astype(np.int64)
        return self.mapped(lambda y: np.take(y, at, axis=axis), x)

    def reshape(self, x: ExactArray, shape: tuple[int, ...]) -> ExactArray:
        """The same numbers in another shape."""
        return self.mapped(lambda y: np.reshape(y, shape), x)

    def swapaxes(self, x: ExactArray, a: int, b: int) -> ExactArray:
        """The transpose along two axes."""
        return self.mapped(lambda y: np.swapaxes(y, a, b), x)

    def sum(self, x: ExactArray, axis: Any) -> ExactArray:
        """The sum along axes."""
        return self.mapped(lambda y: np.asarray(np.sum(y, axis=axis), dtype=object), x)

    def concat(self, arrays: Sequence[Any], axis: int) -> ExactArray:
        """One array after the other."""
        return self.joined(np.concatenate, arrays, axis=axis)

    def stack(self, arrays: Sequence[Any], axis: int) -> ExactArray:
        """Arrays beside each other."""
        return self.joined(np.stack, arrays, axis=axis)

    def broadcast_arrays(self, *arrays: Any) -> list[ExactArray]:
        """Arrays in one shape."""
        found = [self.asarray(x) for x in arrays]
        parts = (np.broadcast_arrays(*y) for y in ([x.re for x in found], [x.im for x in found]))
        return [ExactArray(re, im, self) for re, im in zip(*parts, strict=True)]

    def zeros(self, shape: Any) -> ExactArray:
        """0 in a shape."""
        return self.asarray(np.zeros(shape, dtype=np.int64))

    def zeros_like(self, x: ExactArray) -> ExactArray:
        """0 in the shape of another array."""
        return x * 0

    def conj(self, x: ExactArray) -> ExactArray:
        """The conjugate."""
        return ExactArray(x.re, -x.im, self)

    def real(self, x: ExactArray) -> ExactArray:
        """Re x."""
        return ExactArray(x.re, x.re * 0, self)

    def imag(self, x: ExactArray) -> ExactArray:
        """Im x."""
        return self.real(ExactArray(x.im, x.re, self))

    def matmul(self, a: ExactArray, b: ExactArray) -> ExactArray:
        """The product of matrices."""
        return ExactArray(a.re @ b.re - a.im @ b.im, a.re @ b.im + a.im @ b.re, self)

    def isfinite(self, x: ExactArray) -> Numbers:
        """True: no number here is infinite."""
        return np.full(x.shape, True)

    def all(self, x: Any) -> bool:
        """Are all of them true?"""
        return bool(np.all(x))

    def __getattr__(self, name: str) -> Callable[[Any], ExactArray]:
        """An elementary function of real numbers."""

        def function(x: Any) -> ExactArray:
            a = self.asarray(x)
            values = [self.value_of(name, y % self.p) for y in a.re.ravel()]
            return self.asarray(np.array(values, dtype=object).reshape(a.shape))

        return function


class ExactArray:
    """An array of complex numbers, by the residues of Re and Im."""

    __array_ufunc__ = None  # NumPy's arrays leave operations to these
    dtype = np.dtype(complex)

    def __init__(self, re: Any, im: Any, library: ExactLibrary):
        p = library.p
        whole = (np.asarray(x, dtype=object) % p for x in (re, im))
        self.re, self.im = (np.asarray(x, dtype=object) for x in whole)  # % p gives one as it is
        self.library = library

    def __array_namespace__(self) -> ExactLibrary:
        return self.library

    @property
    def shape(self) -> tuple[int, ...]:
        """As of NumPy's arrays."""
        return self.re.shape

    @property
    def ndim(self) -> int:
        """The number of axes."""
        return self.re.ndim

    def __getitem__(self, places: Any) -> ExactArray:
        return self.library.mapped(lambda y: y[places], self)

    def __add__(self, other: Any) -> ExactArray:
        x = self.library.asarray(other)
        return ExactArray(self.re + x.re, self.im + x.im, self.library)

    __radd__ = __add__

    def __neg__(self) -> ExactArray:
        return ExactArray(-self.re, -self.im, self.library)

    def __sub__(self, other: Any) -> ExactArray:
        return self + -self.library.asarray(other)

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> ExactArray:
        x = self.library.asarray(other)
        re, im = self.re * x.re - self.im * x.im, self.re * x.im + self.im * x.re
        return ExactArray(re, im, self.library)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> ExactArray:
        x, p = self.library.asarray(other), self.library.p
        if np.any(x.im) or not np.all(x.re):
            raise CodeError("a division by 0, or by what is not real")
        inverses = [pow(int(y), -1, p) for y in x.re.ravel()]
        return self * ExactArray(
            np.reshape(np.array(inverses, dtype=object), x.shape), 0, self.library
        )

    def __rtruediv__(self, other: Any) -> Any:
        return self.library.asarray(other) / self

    def __pow__(self, n: int) -> ExactArray:
        if n != 2:
            raise CodeError(f"the power {n}")
        return self * self
