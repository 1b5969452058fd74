"""What rounding may do to emitted C: the same text, compiled with numbers that carry the size of
their terms.

A ``Sized`` is a value and the sum of the magnitudes of the terms that it was made of: the sums of
the terms of sums, the products of those of products, and in proportion through a function.
"""

import ctypes
import re

import numpy as np

from tests.support.library import built, emission

SIZED = """\
#include <math.h>
#include <stddef.h>
struct Sized {
    double v, size;
    Sized() = default;
    constexpr Sized(double x) : v(x), size(x < 0 ? -x : x) {}
    constexpr Sized(double x, double s) : v(x), size(s) {}
};
inline Sized operator+(Sized a, Sized b) { return {a.v + b.v, a.size + b.size}; }
inline Sized operator-(Sized a, Sized b) { return {a.v - b.v, a.size + b.size}; }
inline Sized operator-(Sized a) { return {-a.v, a.size}; }
inline Sized operator*(Sized a, Sized b) { return {a.v * b.v, a.size * b.size}; }
inline Sized operator/(Sized a, Sized b)
{
    return {a.v / b.v, a.size / fabs(b.v) * (b.size / fabs(b.v))};
}
inline bool operator==(Sized a, Sized b) { return a.v == b.v; }
inline bool operator<(Sized a, Sized b) { return a.v < b.v; }
inline bool operator<=(Sized a, Sized b) { return a.v <= b.v; }
inline bool operator>(Sized a, Sized b) { return a.v > b.v; }
inline Sized fabs(Sized a) { return {fabs(a.v), a.size}; }
inline Sized sqrt(Sized a) { return {sqrt(a.v), a.size / sqrt(a.v)}; }
#define double Sized
"""


class Pair(ctypes.Structure):
    """A Sized by value."""

    _fields_ = (("v", ctypes.c_double), ("size", ctypes.c_double))


class Functions:
    """constants, rhs and energy of one problem on such numbers, as a library of
    tests/support/library.py has them; each number of an array is a pair."""

    def __init__(self, path, name, header):
        self.library, self.name = ctypes.CDLL(str(path)), name
        self.sizes = dict(re.findall(r"_N_(\w+) = (\d+)", header))

    def _call(self, what, *arguments, result=None):
        function = getattr(self.library, f"{self.name}_{what}")
        function.restype = result
        at = (ctypes.c_void_p(a.ctypes.data) if isinstance(a, np.ndarray) else a for a in arguments)
        return function(*at)

    def constants(self, p):
        """The status and k."""
        k = pairs(np.zeros(int(self.sizes["CONSTANTS"])))
        return self._call("constants", pairs(p), k, result=ctypes.c_int), k

    def rhs(self, t, x, k, u):
        """dx/dt."""
        dx = pairs(np.zeros(len(x)))
        self._call("rhs", Pair(t, t), pairs(x), pairs(k), pairs(u), dx)
        return dx

    def rhs_batch(self, t, x, k, u):
        """dx/dt of many columns."""
        dx, count = pairs(np.zeros(x.shape)), ctypes.c_size_t(x.shape[1])
        self._call("rhs_batch", count, Pair(t, t), pairs(x), pairs(k), pairs(u), dx)
        return dx

    def energy(self, t, x, k):
        """The energy."""
        found = self._call("energy", Pair(t, t), pairs(x), pairs(k), result=Pair)
        return np.array([found.v, found.size])


def pairs(values):
    """Numbers with their sizes."""
    a = np.asarray(values, dtype=float)
    return np.ascontiguousarray(np.stack([a, np.abs(a)], axis=-1))


def sized(given, **options):
    """The functions of a problem on numbers that carry the size of their terms."""
    name, texts = emission(given, ("c",), **options)
    # functions with a C name that return a class: what clang warns of is what is wanted
    words = ("g++", "-std=c++11", "-O1", "-include", "sized.h", "-xc++", "-fmax-errors=3")
    command = (*words, "-shared", "-fPIC", f"{name}.c", "-o", "out", "-lm")
    return Functions(built([command], texts | {"sized.h": SIZED}), name, texts[f"{name}.h"])
