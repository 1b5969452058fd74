"""Emitted code as terms, an emitted file as data, and the values of terms over any ring.

An expression is a tuple: ``("lit", text)`` a decimal, ``("int", n)``, ``("var", name)``, ``("at",
array, index)``, ``("neg", a)``, ``("add" | "sub" | "mul" | "div", a, b)``, ``("abs", a)``,
``("fun", name, a, …)``, ``("gt" | "lt" | "le" | "eq", a, b)``, ``("not", a)``, ``("none", a)`` 1
where a is 0, else 0, ``("list", a, …)``.

A statement is a tuple: ``("set", name, a)``, ``("unpack", names, array)``, ``("store", array,
index, a)``, ``("if", condition, body)``, ``("for", name, bound, body)`` from 0, ``("return", a)``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from ..check.values.arithmetic import part

Expression = tuple[Any, ...]
Statement = tuple[Any, ...]
Body = tuple[Statement, ...]
Elementary = Callable[..., Any]
Literal = Callable[[str], Any]

DECIMAL = re.compile(r"[0-9]{1,40}(\.[0-9]{0,40}(e[+-]?[0-9]{1,3})?|e[+-]?[0-9]{1,3})")
"""The form of a decimal number without sign or suffix."""


class CodeError(ValueError):
    """Code that cannot be read, or that has no value: the message says which."""


class DiffersError(CodeError):
    """The code is readable and says something else than the record: the message says where."""


def plain_text(text: str) -> None:
    """``CodeError`` for control characters, which not all readers take or show alike."""
    if control := next((c for c in text if ord(c) < 32 and c not in "\n\t"), ""):
        raise CodeError(f"the character {control!r} is not read")


@dataclass(frozen=True)
class CodeFunction:
    """A function: its name, the names of its arguments in order, and its statements."""

    name: str
    arguments: tuple[str, ...]
    body: Body


class Array:
    """The array of numbers that a function reads; or that it writes, where they are ``None``
    before.

    ``CodeError`` for an index outside, a number read before it is written, or written twice.
    """

    def __init__(self, values: Sequence[Any], name: str, *, written: bool = False):
        self.values, self.name, self.written = list(values), name, written
        self.read: set[int] = set()

    @staticmethod
    def empty(size: int, name: str) -> Array:
        """An array of so many numbers to be written."""
        return Array([None] * size, name, written=True)

    def _place(self, i: Any) -> int:
        if not isinstance(i, int) or not 0 <= i < len(self.values):
            raise CodeError(f"{self.name}[{i}] is outside its {len(self.values)} numbers")
        return i

    def __getitem__(self, i: Any) -> Any:
        value = self.values[self._place(i)]
        if value is None:
            raise CodeError(f"{self.name}[{i}] is read before it is written")
        self.read.add(i)
        return value

    def __setitem__(self, i: Any, value: Any) -> None:
        if not self.written or self.values[self._place(i)] is not None:
            why = "twice" if self.written else "but is an input"
            raise CodeError(f"{self.name}[{i}] is written {why}")
        self.values[i] = value

    def numbers(self) -> list[Any]:
        """All numbers of a written array; ``CodeError`` where one is missing."""
        for i, x in enumerate(self.values):
            if x is None:
                raise CodeError(f"{self.name}[{i}] is not written")
        return self.values


def run(
    f: CodeFunction, arguments: Mapping[str, Any], elementary: Elementary, literal: Literal
) -> Any:
    """What a function returns for these arguments, whose arrays it may write.

    ``elementary(name, x)`` is the value of a function, ``literal(text)`` that of a decimal.
    ``CodeError`` for what has no value, a division by zero among it.
    """
    names = {name: arguments[name] for name in f.arguments if name in arguments}
    return Interpreter(elementary, literal).body(f.body, names)[1]


class Interpreter:
    """An interpreter of statements; a name is set once, in the body where it is seen."""

    def __init__(self, elementary: Elementary, literal: Literal):
        self.elementary, self.literal = elementary, literal

    def body(self, body: Body, names: dict[str, Any]) -> tuple[bool, Any]:
        """Run statements: (did one return, what it returned)."""
        for statement in body:
            done, value = self._statement(statement, names)
            if done:
                return True, value
        return False, None

    def _statement(self, s: Statement, names: dict[str, Any]) -> tuple[bool, Any]:
        """Run one statement: (did it return, what it returned)."""
        if s[0] == "set":
            self._set(names, s[1], self.value(s[2], names))
        elif s[0] == "unpack":
            self._unpack(s[1], self._array(s[2], names), names)
        elif s[0] == "store":
            self._array(s[1], names)[self.value(s[2], names)] = self.value(s[3], names)
        elif s[0] == "if":
            if self.value(s[1], names):
                return self.body(s[2], dict(names))
        elif s[0] == "for":
            for i in range(self.value(s[2], names)):
                inner = dict(names)
                self._set(inner, s[1], i)
                done, value = self.body(s[3], inner)
                if done:
                    return True, value
        else:
            return True, self.value(s[1], names)
        return False, None

    @staticmethod
    def _set(names: dict[str, Any], name: str, value: Any) -> None:
        if name in names:
            raise CodeError(f"{name} is set twice")
        names[name] = value

    def _unpack(self, wanted: Sequence[str], array: Array, names: dict[str, Any]) -> None:
        if len(wanted) != len(array.values):
            raise CodeError(f"{len(wanted)} names for the {len(array.values)} of {array.name}")
        for i, name in enumerate(wanted):
            if name != "_":
                self._set(names, name, array[i])

    @staticmethod
    def _array(name: str, names: Mapping[str, Any]) -> Array:
        found = names.get(name)
        if not isinstance(found, Array):
            raise CodeError(f"{name} is no array here")
        return found

    def value(self, e: Expression, names: dict[str, Any]) -> Any:
        """The value of an expression, with these values of names."""
        op = e[0]
        if op == "var":
            return self._name(e[1], names)
        if op == "lit":
            return self.literal(e[1])
        if op == "int":
            return e[1]
        if op == "at":
            return self._array(e[1], names)[self.value(e[2], names)]
        if op == "fun":
            return self.elementary(e[1], *(self.value(x, names) for x in e[2:]))
        return apply_operation(op, [self.value(x, names) for x in e[1:]])

    @staticmethod
    def _name(name: str, names: Mapping[str, Any]) -> Any:
        if name not in names or isinstance(names[name], Array):
            raise CodeError(f"{name} has no value here")
        return names[name]


def base_value(x: Any) -> Any:
    """The number without its degree and its nilpotent parts."""
    return part(getattr(x, "value", x), 0)


def apply_operation(op: str, a: list[Any]) -> Any:
    """The value of an operation on values; ``CodeError`` for a division by zero."""
    if op == "div":
        try:
            return Fraction(*a) if all(isinstance(x, int) for x in a) else a[0] / a[1]
        except ZeroDivisionError:
            raise CodeError("a division by zero") from None
    return OPERATIONS[op](*a)


OPERATIONS: dict[str, Callable[..., Any]] = {
    "neg": lambda a: -a,
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "abs": lambda a: a if base_value(a) >= 0 else -a,
    "gt": lambda a, b: base_value(a) > base_value(b),
    "lt": lambda a, b: base_value(a) < base_value(b),
    "le": lambda a, b: base_value(a) <= base_value(b),
    "eq": lambda a, b: base_value(a) == base_value(b),
    "none": lambda a: int(base_value(a) == 0),
    "not": lambda a: not a,
    "list": lambda *a: list(a),
}


Names = tuple[str, ...] | None


@dataclass(frozen=True)
class Module:
    """An emitted file: the names of state, parameters, inputs and outputs, ``None`` where it has
    no such list, and its functions.

    ``sizes``: STATE, ALGEBRA, PARAMETERS, CONSTANTS, INPUTS. ``defaults`` and ``basis`` where the
    file has them; ``state_by_block``: the state with the velocity named by the blocks of a product.
    """

    state: Names
    parameters: Names
    inputs: Names
    functions: Mapping[str, CodeFunction]
    sizes: Mapping[str, int]
    defaults: Mapping[str, Any] | None = None
    basis: Any = field(default=None)
    outputs: Names = None
    state_by_block: Names = None


@dataclass(frozen=True)
class Machine:
    """An interpreter of the functions of a module; ``elementary`` and ``literal`` give the values
    of elementary functions and decimals."""

    module: Module
    elementary: Elementary
    literal: Literal

    def call(self, name: str, arguments: Mapping[str, Any], **sizes: int) -> dict[str, list[Any]]:
        """The arrays that a function computes, by their names in C; ``sizes``: how long each is.

        C writes into the arrays, Python returns all numbers in one list. ``CodeError`` where one is
        missing.
        """
        f = self.module.functions.get(name)
        if f is None:
            raise CodeError("there is no such function")
        empty = {x: Array.empty(size, x) for x, size in sizes.items() if x in f.arguments}
        value = run(f, {**arguments, **empty}, self.elementary, self.literal)
        if not empty:
            return _returned(value, sizes)
        return {x: array.numbers() for x, array in empty.items()}

    def numbers(
        self, name: str, given: Mapping[str, Any], size: int, array: str = "out"
    ) -> list[Any]:
        """The numbers of the one array that a function computes of the numbers that are given: t,
        and those of arrays."""
        arguments = {x: y if x == "t" else Array(y, x) for x, y in given.items()}
        return self.call(name, arguments, **{array: size})[array]


def _returned(value: Any, sizes: Mapping[str, int]) -> dict[str, list[Any]]:
    """The returned numbers, cut into arrays of these sizes."""
    if not isinstance(value, list):
        value = [value]
    if len(value) != sum(sizes.values()) or any(x is None or isinstance(x, list) for x in value):
        raise CodeError(f"it does not return {sum(sizes.values())} numbers")
    found, start = {}, 0
    for x, size in sizes.items():
        found[x] = value[start : start + size]
        start += size
    return found


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
