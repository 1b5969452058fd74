"""Code with loops, as it was read, run in a prime field; arrays with which Python runs there.

What is a number of the language is a residue modulo p here; what it has as a whole number, on which
alone places and conditions may depend, is an integer.  So a function that is read is one rational
function of what it is given.  An array has no value outside of it, nor, in C, where nothing was
written.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from ...check.values.evaluate import ELEMENTARY
from ...language.rational import RingElement
from ..straight_line import Measured
from ..terms import CodeError, Expression, Interpreter, Statement
from .loop_reader import WHOLE, Kind, LoopReader, Routine

Names = dict[str, Any]


class Cells(dict[int, Any]):
    """An array of these sizes, of one number, or where nothing is there before it is written."""

    def __init__(self, sizes: Sequence[int], number: Any = None):
        super().__init__()
        self.size, self.inner = sizes[0], tuple(sizes[1:])
        if self.inner:
            self.update((i, Cells(self.inner, number)) for i in range(self.size))
        elif number is not None:
            self.update(dict.fromkeys(range(self.size), number))

    def __setitem__(self, i: int, value: Any) -> None:
        if self.inner or not 0 <= i < self.size:
            raise CodeError("it writes outside of an array")
        super().__setitem__(i, value)


class Shifted:
    """A pointer into an array, to read from."""

    inner = ()

    def __init__(self, array: Any, place: int):
        self.array, self.place = array, place

    def __getitem__(self, i: int) -> Any:
        return self.array[self.place + i]


class LoopInterpreter(Interpreter):
    """The functions of a file; ``literal``: the residue of a decimal, ``elementary``: of a function
    at one, ``p``: the modulus."""

    def __init__(
        self,
        reader: LoopReader,
        p: int,
        literal: Callable[[str], int],
        elementary: Callable[[str, int], Any],
    ):
        def measured(name: str, x: Any) -> Any:
            return Measured.of(elementary(name, Measured.of(x).value % p))

        super().__init__(measured, lambda text: Measured(literal(text)))
        self.spelt, self.routines, self.p = reader.spelt, reader.routines, p
        self.exact = reader.language == "javascript"  # are there no integers?
        self.stands_in: dict[str, Callable[..., Any]] = {}
        self.largest = 0  # the largest degree of a number that was given out
        self.declared, self.running = tuple(reader.tables), ""
        self.tables: Names = {}

    def call(self, name: str, *arguments: Any) -> Any:
        """What a function returns; ``CodeError`` where it has no value, or writes outside of an
        array."""
        self.tables = {}
        try:
            self.body(self.declared, self.tables)
            return self._called(self.spelt(name), arguments)
        except (LookupError, TypeError, AttributeError) as error:
            raise CodeError(f"{name}: no value: {error}") from None
        except CodeError as error:
            raise CodeError(f"{name}: {error}") from None

    def numbers(self, values: Sequence[Any]) -> list[int]:
        """What a function gave, without the degrees, which are noted."""
        found = [Measured.of(x) for x in values]
        self.largest = max([self.largest, *(x.degree for x in found)])
        return [x.value % self.p for x in found]

    def written(self, array: Mapping[int, Any], size: int, name: str) -> list[int]:
        """The numbers of an array that a function has written."""
        if set(array) != set(range(size)):
            raise CodeError(f"{name} is not written, or not all of it and nothing else")
        return self.numbers([array[i] for i in range(size)])

    @contextmanager
    def replaced(self, name: str, caller: str, f: Callable[..., Any]) -> Iterator[None]:
        """Another function in the place of one, if ``caller`` calls it."""
        if self.spelt(name) in self.routines[self.spelt(caller)].calls:
            self.stands_in = {self.spelt(name): f}
        try:
            yield
        finally:
            self.stands_in = {}

    def _called(self, name: str, given: Sequence[Any]) -> Any:
        if name in self.stands_in:
            return self.stands_in[name](*given)
        r: Routine = self.routines[name]
        names, self.running = dict(self.tables), name
        for (argument, kind), x in zip(r.arguments, given, strict=True):
            names[argument] = self._as(kind, x)
        done, value = self.body(r.body, names)
        return self._as(r.returns, value) if done else None

    def _as(self, kind: Kind, x: Any) -> Any:
        """A value as one of a kind, where that is known."""
        if kind is None:
            return x
        if kind == "real" and isinstance(x, (int, Measured)):
            return Measured.of(x) % self.p
        if kind in WHOLE and isinstance(x, int):
            return x
        if isinstance(kind, tuple) and getattr(x, "inner", None) == kind:
            return x
        raise CodeError("a value of another kind")

    # -- statements --------------------------------------------------------------------------

    def _statement(self, s: Statement, names: Names) -> tuple[bool, Any]:
        """Run one statement: (did it return, what it returned)."""
        if s[0] == "declare":
            names[s[2]] = self._as(s[1], self.value(s[3], names))
        elif s[0] == "array":
            names[s[1]] = Cells(s[2], s[3])
        elif s[0] == "table":
            names[s[1]] = dict(enumerate(map(self._row, s[2])))
        elif s[0] == "assign":
            self._assign(s[1], s[2], s[3], names)
        elif s[0] == "if":
            return self.body(s[2] if self._test(s[1], names) else s[3], names)
        elif s[0] == "loop":
            return self._loop(s, names)
        elif s[0] == "do":
            self.value(s[1], names)
        else:
            return super()._statement(s, names)
        return False, None

    @staticmethod
    def _array(name: str, names: Mapping[str, Any]) -> Any:
        return names[name]

    def _row(self, row: Any) -> Any:
        if isinstance(row, dict):
            return {field: self._row(x) for field, x in row.items()}
        kind, e = row
        return self._as(kind, self.value(e, {}))

    def _assign(
        self, sign: str, targets: Sequence[Expression], e: Expression, names: Names
    ) -> None:
        if sign != "=":
            e = ({"+=": "add", "-=": "sub", "*=": "mul"}[sign], targets[0], e)
        x = self._as("real", self.value(e, names))
        for target in targets:
            if target[0] == "var":
                names[target[1]] = x
            else:
                self.value(target[1], names)[self.value(target[2], names)] = x

    def _loop(self, s: Statement, names: Names) -> tuple[bool, Any]:
        _, first, name, bound, steps, body = s
        self.body(first, names)
        while names[name] < self._as("int", self.value(bound, names)):
            before = names[name]
            done, value = self.body(body, names)
            if done:
                return True, value
            for x, more in steps:
                names[x] += self._as("int", self.value(more, names))
            if names[name] <= before:
                raise CodeError("a loop that may not end")
        return False, None

    # -- expressions -------------------------------------------------------------------------

    def _test(self, e: Expression, names: Names) -> int:
        """A condition, which depends on whole numbers alone."""
        return int(self._as("int", self.value(e, names)))

    def value(self, e: Expression, names: Names) -> Any:
        """The value of an expression, with these values of names."""
        op, rest = e[0], e[1:]
        if op == "var":
            return names[rest[0]]
        if op == "field":
            return self.value(rest[0], names)[rest[1]]
        if op == "call":
            outer = self.running
            found = self._called(rest[0], [self.value(x, names) for x in rest[1:]])
            self.running = outer
            return found
        if op == "cond":
            return self.value(rest[1] if self._test(rest[0], names) else rest[2], names)
        if op in ("and", "or"):
            first = self._test(rest[0], names)
            return self._test(rest[1], names) if bool(first) == (op == "and") else first
        if op in ("int", "lit", "fun", "at"):
            return super().value(e, names)
        values = [self.value(x, names) for x in rest]
        if op == "eq" and self.running == self.spelt("constants"):
            return int((Measured.of(values[0]) - values[1]).value % self.p == 0)
        if op == "real":
            return self._as(op, *values)
        if op == "div":
            return self._quotient(*values)
        return OPERATIONS[op](*values)

    def _quotient(self, a: Any, b: Any) -> Measured:
        if isinstance(a, int) and isinstance(b, int) and not self.exact:
            raise CodeError("C cuts off a quotient of integers")
        if not Measured.of(b).value % self.p:
            raise CodeError("a division by zero")
        return Measured.of(a) * Measured.of(b).inverse(self.p)


def _of_integers(f: Callable[..., Any]) -> Callable[..., Any]:
    """An operation of whole numbers alone."""

    def operation(*given: Any) -> int:
        if not all(isinstance(x, int) for x in given):
            raise CodeError("a place or a condition that depends on numbers is not known here")
        return int(f(*given))

    return operation


def _sum(a: Any, b: Any) -> Any:
    """The sum of numbers, or a pointer that is moved on."""
    return Shifted(a, b) if isinstance(a, (Cells, Shifted)) else a + b


def _remainder(a: int, b: int) -> int:
    """a % b in C, of numbers that are not negative."""
    if a < 0 or b <= 0:
        raise CodeError("a remainder of a negative number")
    return a % b


OPERATIONS: dict[str, Callable[..., Any]] = {
    "neg": lambda a: -a,
    "add": _sum,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "item": lambda array, i: array[i],
    "mod": _of_integers(_remainder),
    "not": _of_integers(lambda a: not a),
    "lt": _of_integers(lambda a, b: a < b),
    "le": _of_integers(lambda a, b: a <= b),
    "gt": _of_integers(lambda a, b: a > b),
    "ge": _of_integers(lambda a, b: a >= b),
    "eq": _of_integers(lambda a, b: a == b),
    "ne": _of_integers(lambda a, b: a != b),
}


# Arrays of exact complex numbers, with the functions of an array library.
#
# A number is a pair of residues modulo p, Re and Im; a decimal of the code that meets an array is
# the residue for which it stands. NumPy has the arrays, of objects, and most of the functions, so
# that emitted Python computes without rounding.


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
