"""The neutral program: what every language prints.

A value here is one real number with a name: lowering works on whole matrices (``dense.py``), where
what is zero, symmetric, skew, constant or equal to another entry is one node of the graph or none,
and only what is left comes here.  Not supported: branches (a potential with if, min, abs),
loops, complex numbers, tables, implicit equations, matrices whose size is not a number.

An expression is a tuple ``(operator, operand, …)``: ``num``, ``var``, ``add`` (signed terms),
``mul``, ``div``, ``abs``, ``none``, ``fun``.  A function loads inputs, computes sections of
named values and stores outputs.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from ..language.refused import Refused


class LoweringError(Refused, ValueError):
    """The record does not say how to compute something: the message names it."""


OPERATIONS = ("mul", "add", "div", "call")

Expression = tuple[Any, ...]
"""("num", q), ("var", name), ("add", ((sign, e), …)), ("mul", (e, …)), ("div", e, f), ("abs", e),
("none", e): 1 where e is 0, else 0; ("fun", name, e)"""


@dataclass(frozen=True)
class Load:
    """``name`` = ``array[index]``."""

    name: str
    array: str
    index: int


@dataclass(frozen=True)
class Assignment:
    """``name`` = ``expression``."""

    name: str
    expression: Expression


@dataclass(frozen=True)
class Section:
    """Consecutive values that come from one equation of the record."""

    label: str
    equation: str
    values: tuple[Assignment, ...]


@dataclass(frozen=True)
class Check:
    """``value`` must exceed ``TOLERANCE · scale``, else the body is singular or no body."""

    value: Expression
    scale: Expression | None


TOLERANCE = {"double": 1e-13, "float": 1e-6}
"""Relative to what rounding can make of a singular matrix; float leaves room for slender bodies."""


@dataclass(frozen=True)
class Function:
    """One emitted function."""

    loads: tuple[Load, ...]
    sections: tuple[Section, ...]
    outputs: tuple[Expression, ...]
    checks: tuple[Check, ...] = ()
    titles: Mapping[int, str] = field(default_factory=dict)
    """Number of an output → the equation whose left side begins there."""

    def calls(self) -> set[str]:
        """The elementary functions that it calls."""
        found: set[str] = set()
        expressions = [v.expression for s in self.sections for v in s.values]
        checked = [x for c in self.checks for x in (c.value, c.scale)]
        for e in (*expressions, *self.outputs, *checked):
            _collect(e, found)
        return found

    def operations(self) -> dict[str, int]:
        """Counts of mul, add, div and calls of functions in sections and outputs."""
        total = dict.fromkeys(OPERATIONS, 0)
        for section in self.sections:
            for v in section.values:
                _count(v.expression, total)
        for e in self.outputs:
            _count(e, total)
        return total


@dataclass(frozen=True)
class Turning:
    """How parameters turn with the axes of the body: their indices.

    ``vectors``: three for each vector; ``matrix``: six for the symmetric J, or none.
    """

    vectors: tuple[tuple[int, ...], ...]
    matrix: tuple[int, ...] = ()


@dataclass(frozen=True)
class Framing:
    """How ``constants`` finds the principal frame.

    ``matrices``: (n, function) for each symmetric matrix whose axes are wanted, in order; the
    n eigenvalues, smallest first, then the n rows of a rotation, are appended to the array
    ``axes``, which later functions read.  ``numbers``: the array ``frame``, which constants reads.
    """

    matrices: tuple[tuple[int, Function], ...]
    numbers: Function


@dataclass(frozen=True)
class Program:
    """All that is emitted for one problem, without a word of any language.

    ``functions``: constants, rhs, energy; inertia for a body turned in space; and what is asked for
    of jacobian, jacobian_inputs, jacobian_parameters; into_frame, out_of_frame, inputs_into_frame.
    """

    name: str
    title: str
    group: str
    dimension: int
    conventions: tuple[str, ...]
    state: tuple[str, ...]
    parameters: tuple[tuple[str, float | None, str, str], ...]
    inputs: tuple[str, ...]
    constants: tuple[str, ...]
    basis: tuple[tuple[tuple[Fraction, ...], ...], ...]
    functions: Mapping[str, Function]
    translates: bool = False
    turning: Turning | None = None
    framing: Framing | None = None

    def all_functions(self) -> tuple[Function, ...]:
        """Those that are called, and those that find the frame."""
        found = self.framing
        own = (*(f for _, f in found.matrices), found.numbers) if found else ()
        return (*self.functions.values(), *own)

    def numbers(self) -> set[Fraction]:
        """The exact numbers that its expressions contain, which a language writes as decimals."""
        return {x for x in self._parts() if isinstance(x, Fraction)}

    @property
    def asks_for_zero(self) -> bool:
        """Is there an expression ("none", e)?"""
        return any(isinstance(x, tuple) and x[:1] == ("none",) for x in self._parts())

    def _parts(self) -> Iterator[Any]:
        """All that its expressions are made of."""
        for f in self.all_functions():
            checked = [x for c in f.checks for x in (c.value, c.scale)]
            values = [v.expression for s in f.sections for v in s.values]
            stack: list[Any] = [*checked, *values, *f.outputs]
            while stack:
                e = stack.pop()
                yield e
                stack.extend(e if isinstance(e, tuple) else ())


def _collect(e: Any, found: set[str]) -> None:
    if isinstance(e, tuple):
        if e and e[0] == "fun":
            found.add(e[1])
        for part in e:
            _collect(part, found)


def _count(e: Expression, total: dict[str, int]) -> None:
    if e[0] in ("abs", "none", "fun"):
        total["call"] += e[0] == "fun"
        _count(e[-1], total)
    elif e[0] == "add":
        total["add"] += len(e[1]) - 1
        for _, x in e[1]:
            _count(x, total)
    elif e[0] == "mul":
        total["mul"] += len(e[1]) - 1
        for x in e[1]:
            _count(x, total)
    elif e[0] == "div":
        total["div"] += 1
        _count(e[1], total)
        _count(e[2], total)
