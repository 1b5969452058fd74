"""What rounding may do to emitted C: the same text, compiled with numbers that carry the size of
their terms.

A ``Sized`` is a value and the sum of the magnitudes of the terms that it was made of: the sums of
the terms of sums, the products of those of products, and in proportion through a function.
"""

import ctypes
import re
import subprocess

import numpy as np

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
    """constants, rhs and energy of some prefixes in one library; ``sized`` numbers are pairs."""

    def __init__(self, path, headers, sized=False):
        self.library, self.sized = ctypes.CDLL(str(path)), sized
        self.real = Pair if sized else ctypes.c_double
        self.sizes = {x: dict(re.findall(r"_N_(\w+) = (\d+)", text)) for x, text in headers.items()}

    def _call(self, prefix, what, *arguments, result=None):
        function = getattr(self.library, f"{prefix}_{what}")
        function.restype = result
        return function(*arguments)

    def _array(self, values):
        a = np.ascontiguousarray(values, dtype=float)
        return np.stack([a, np.abs(a)], axis=-1) if self.sized else a

    def _out(self, prefix, size):
        return self._array(np.zeros(int(self.sizes[prefix][size])))

    def constants(self, prefix, p):
        """k, which must be that of a body."""
        p, k = self._array(p), self._out(prefix, "CONSTANTS")
        assert self._call(prefix, "constants", _at(p), _at(k), result=ctypes.c_int) == 0
        return k

    def rhs(self, prefix, x, k, u):
        """dx/dt at time 0.3."""
        x, k, u, dx = map(self._array, (x, k, u, np.zeros(len(x))))
        self._call(prefix, "rhs", self._time(), _at(x), _at(k), _at(u), _at(dx))
        return dx

    def rhs_batch(self, prefix, x, k, u):
        """dx/dt at time 0.3 of many columns."""
        x, k, u, dx = map(self._array, (x, k, u, np.zeros(x.shape)))
        count = ctypes.c_size_t(x.shape[1])
        self._call(prefix, "rhs_batch", count, self._time(), _at(x), _at(k), _at(u), _at(dx))
        return dx

    def energy(self, prefix, x, k):
        """The energy, in an array of one."""
        x, k = self._array(x), self._array(k)
        found = self._call(prefix, "energy", self._time(), _at(x), _at(k), result=self.real)
        return np.array([[found.v, found.size]] if self.sized else [found])

    def _time(self):
        return Pair(0.3, 0.3) if self.sized else ctypes.c_double(0.3)


def _at(a):
    return ctypes.c_void_p(a.ctypes.data)


def built(command, prefixes, folder, name):
    """A library of the sources NAME.c of a folder, by a compiler with options."""
    sources = [f"{x}.c" for x in prefixes]
    where = ["-shared", "-fPIC", *sources, "-o", name, "-lm"]
    subprocess.run([*command, *where], cwd=folder, check=True)
    headers = {x: (folder / f"{x}.h").read_text(encoding="utf-8") for x in prefixes}
    return Functions(folder / name, headers, sized="-xc++" in command)


def sized(prefixes, folder):
    """The same library on numbers that carry the size of their terms."""
    (folder / "sized.h").write_text(SIZED, encoding="utf-8")
    # functions with a C name that return a class: what clang warns of is what is wanted
    command = ["g++", "-std=c++11", "-O1", "-include", "sized.h", "-xc++", "-fmax-errors=3"]
    return built(command, prefixes, folder, "sized.so")
