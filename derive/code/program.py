"""The neutral program: what every language prints.

A value here is one real number with a name: lowering works on whole matrices (``dense.py``), where
what is zero, symmetric, skew, constant or equal to another entry is one node of the graph or none,
and only what is left comes here.  Not supported: branches (a potential with if, min, abs),
loops, complex numbers, tables, implicit equations, matrices whose size is not a number.

An expression is a tree of names and fractions; a term of a sum that is taken away is a product by
−1, and a sum of one term is in parentheses.  A function loads inputs, computes sections of named
values and stores outputs.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import groupby
from typing import Any, TypeVar

from ..algebra.factor_charts import FactorChart
from ..language.limits import Refused
from ..language.tree import Tree, nodes
from ..language.values import arithmetic

V = TypeVar("V")


class LoweringError(Refused, ValueError):
    """The record does not say how to compute something: the message names it."""


def refuse_first(name: str, *reasons: tuple[object, str]) -> None:
    """``LoweringError`` for the first option that a problem of this name has a reason to refuse."""
    for on, why in reasons:
        if on:
            raise LoweringError(f"{name}: {why}: leave it out")


OPERATIONS = ("mul", "add", "div", "call")

Expression = Tree
"""A fraction, a name, ("add", e, …), ("mul", e, …), ("mul", −1, e), ("div", e, f),
("fun", name, e), ("abs", e), and ("none", e): 1 where e is 0, else 0.  Of the integrals of
:mod:`derive.code.ellipsoid`, ("fun", "ellipsoid", e, f, g) is all of a bundle and ("fun",
"ellipsoid_k", name) one of them."""


def negated(e: Expression) -> Expression:
    """The product −1 · e: −e as a term of a sum or by itself."""
    return ("mul", -1, e)


def is_negated(e: Expression) -> bool:
    """Is it a product by −1?"""
    return isinstance(e, tuple) and e[:2] == ("mul", -1)


@dataclass(frozen=True)
class Load:
    """A local name read from an array: ``name`` = ``array[index]``."""

    name: str
    array: str
    index: int


@dataclass(frozen=True)
class Assignment:
    """A named value: ``name`` = ``expression``."""

    name: str
    expression: Expression


@dataclass(frozen=True)
class Section:
    """Consecutive values that come from one equation of the record, its label and text."""

    label: str
    equation: str
    values: tuple[Assignment, ...]


@dataclass(frozen=True)
class Check:
    """``value`` must exceed ``TOLERANCE · scale``, else the body is singular or no body."""

    value: Expression
    scale: Expression | None


TOLERANCE = {"double": 1e-13, "float": 1e-6}
"""Least ratio of a checked value to its scale, by the type of numbers.

Relative to what rounding can make of a singular matrix; float leaves room for slender bodies.
"""


@dataclass(frozen=True)
class EmittedFunction:
    """One emitted function: inputs loaded, sections of values, outputs, and checks before them."""

    loads: tuple[Load, ...]
    sections: tuple[Section, ...]
    outputs: tuple[Expression, ...]
    checks: tuple[Check, ...] = ()
    titles: Mapping[int, str] = field(default_factory=dict)
    """Number of an output → the equation whose left side begins there."""

    @property
    def computed(self) -> list[Expression]:
        """The expressions of all values and outputs."""
        return [*(v.expression for s in self.sections for v in s.values), *self.outputs]

    @property
    def expressions(self) -> list[Expression]:
        """The expressions of all values, outputs and checks."""
        checked = (x for c in self.checks for x in (c.value, c.scale))
        return [*self.computed, *(x for x in checked if x is not None)]

    def values(
        self, arrays: Mapping[str, Sequence[Any]], call: Callable[[str, Any], Any]
    ) -> list[Any]:
        """The outputs in any ring, by the numbers of its arrays; ``call(name, x)``: the value of an
        elementary function, of "abs" and of "none"."""
        known: dict[Any, Any] = {x.name: arrays[x.array][x.index] for x in self.loads}

        def of(e: Expression) -> Any:
            if not isinstance(e, tuple):
                return known[e] if isinstance(e, str) else Fraction(e)
            if e[0] in ("fun", "abs", "none"):
                return call(str(e[-2]), of(e[-1]))
            return arithmetic(e, of)

        for section in self.sections:
            for v in section.values:
                known[v.name] = of(v.expression)
        return [of(e) for e in self.outputs]

    def calls(self) -> set[str]:
        """The names of the elementary functions that it calls."""
        inside = (x for e in self.expressions for x in nodes(e))
        return {x[1] for x in inside if isinstance(x, tuple) and x[0] == "fun"}

    def operations(self) -> dict[str, int]:
        """Counts of mul, add, div and call in values and outputs."""
        total = dict.fromkeys(OPERATIONS, 0)
        for e in self.computed:
            for x in nodes(e):
                if isinstance(x, tuple) and not is_negated(x):
                    own = {"fun": "call"}.get(x[0], x[0])
                    if x[0] == "fun" and x[1].startswith("ellipsoid_") and len(x) == 3:
                        continue
                    if own in total:
                        total[own] += 1 if own in ("div", "call") else len(x) - 2
        return total


@dataclass(frozen=True)
class Watched:
    """An event: its name; 1 where it is reached from below alone, −1 from above, 0 from either;
    does it end a motion?"""

    name: str
    direction: int
    terminal: bool


@dataclass(frozen=True)
class Block:
    """The matrix A of one factor in the state: the name of its group, the places of its n² entries;
    does the group turn space, up to scale, so that det A > 0 is not told by its relations?"""

    group: str
    places: tuple[int, ...]
    turns: bool


@dataclass(frozen=True)
class KeptByGauss:
    """What ``step.gauss_invariants`` finds: the names of what is kept to rounding, and of what the
    motion keeps beside; is the group kept so?"""

    exact: tuple[str, ...]
    others: tuple[str, ...]
    group: bool


@dataclass(frozen=True)
class AxesTurning:
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

    matrices: tuple[tuple[int, EmittedFunction], ...]
    numbers: EmittedFunction


@dataclass(frozen=True)
class Program:
    """All that is emitted for one problem, without a word of any language.

    ``functions``: constants, rhs, energy; inertia for a body turned in space; outputs where there
    are some; and what is asked for of conserved, multiplier, mass_matrix, bias, inverse, events; of
    jacobian, jacobian_inputs, jacobian_parameters; momentum, velocity, momentum_rhs and poisson;
    into_frame, out_of_frame, inputs_into_frame; to_matrix and from_matrix of a state with
    quaternions, to_matrix of one with angles.
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
    functions: Mapping[str, EmittedFunction]
    translates: bool = False
    turning: AxesTurning | None = None
    framing: Framing | None = None
    variation: str = "g eta"
    """What δg is by η, in comments."""
    conserved: tuple[str, ...] = ()
    """The names of what ``conserved`` gives."""
    events: tuple[Watched, ...] = ()
    """Those that ``events`` gives."""
    keeps: KeptByGauss | None = None
    """What Gauss's collocation keeps, where that was asked for and is found."""
    momenta: tuple[str, ...] = ()
    """The names of the state with momenta, where there is one."""
    reduced: int = 0
    """The variables of the Poisson tensor."""
    loops: Any = None
    """On the torus the tables of its loops (``torus_loops.Loops``), where it has them."""
    masses: tuple[str, ...] = ()
    """Those that are numbers of the state, its last."""
    on_torus: bool = False
    mass_fault: str = "singular or not positive"
    """What ``constants`` says that the mass matrix is."""
    discrete: Any = None
    """What the step of the discrete motion is written by (``step.discrete_step.DiscreteStep``)."""
    blocks: tuple[Block, ...] = ()
    """The matrices in the state of the factors whose ``project`` there is."""
    matrix_state: tuple[str, ...] = ()
    """The names of the state with matrices in place of quaternions and angles, where there are
    some."""
    matrix_blocks: tuple[Block, ...] = ()
    """As ``blocks``, of that state."""
    charts: tuple[FactorChart, ...] = ()
    """Those of the factors that the state has in other numbers than their entries."""
    weightless: tuple[str, ...] = ()
    """The names of what is conserved where gravity is 0, and not elsewhere."""
    outputs: tuple[str, ...] = ()
    """The names of what ``outputs`` gives, what is read off a motion."""
    start: tuple[tuple[float, ...], ...] = ((), (), ())
    """State, parameters and inputs at the start, where a language asks for these."""
    state_by_block: tuple[str, ...] = ()
    """The names of the state, where several blocks move those of the velocity by their blocks."""
    kinks: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """What comments say of where rates and outputs have no derivative."""
    bends: bool = False
    """May the derivatives of a force jump?"""
    group_functions: Any = None
    """What the functions of the group know (``group_functions.GroupFunctions``), if asked for."""
    varied: int = 0
    """How many numbers a variation of the state has."""
    symmetries: int = 0
    """Those of a quotient, modulo which that is one."""

    @property
    def literal(self) -> dict[str, int]:
        """Sizes that files have as numbers: of a variation, and with symmetries beside it."""
        return {"VARIATIONS": self.varied, "MOVES": self.varied + self.symmetries}

    @property
    def sizes(self) -> dict[str, int]:
        """How many numbers arrays have, by the names of their sizes."""
        return {
            "STATE": len(self.state),
            "CONSTANTS": len(self.constants),
            "PARAMETERS": len(self.parameters),
            "INPUTS": len(self.inputs),
            "CONSERVED": len(self.conserved),
            "EVENTS": len(self.events),
            "OUTPUTS": len(self.outputs),
            "ALGEBRA": self.dimension,
            "REDUCED": self.reduced,
            "MATRIX": len(self.matrix_state),
            **(self.discrete.sizes if self.discrete else {}),
            **self.literal,
        }

    @property
    def by_block(self) -> dict[str, str]:
        """Names by blocks → those of the state that are others."""
        pairs = zip(self.state_by_block, self.state, strict=False)
        return {own: name for own, name in pairs if own != name}

    def by_state(self, given: Mapping[str, V], fault: type[Refused]) -> dict[str, V]:
        """What is given by names, with those of the state for those by blocks; ``fault`` where one
        number has both."""
        own = self.by_block
        if both := next((x for x in given if own.get(x) in given), ""):
            raise fault(f"{both}: the same number as {own[both]}; leave out one")
        return {own.get(name, name): x for name, x in given.items()}

    @property
    def momentum_range(self) -> tuple[int, int]:
        """The index of the first momentum in the state that has them, and that after the last."""
        pairs = enumerate(zip(self.state, self.momenta, strict=False))
        other = [i for i, (x, y) in pairs if x != y]
        return (other[0], other[-1] + 1) if other else (0, 0)

    def all_functions(self) -> tuple[EmittedFunction, ...]:
        """The functions of the program, and those that find its frame."""
        found = self.framing
        own = (*(f for _, f in found.matrices), found.numbers) if found else ()
        return (*self.functions.values(), *own)

    def numbers(self) -> set[Fraction]:
        """The exact numbers that its expressions contain, which a language writes as decimals."""
        return {x for x in self._parts() if isinstance(x, Fraction)}

    @property
    def asks_for_zero(self) -> bool:
        """Is there an expression ("none", e), 1 where e is 0?"""
        return any(isinstance(x, tuple) and x[0] == "none" for x in self._parts())

    def _parts(self) -> Iterator[Expression]:
        """All subexpressions of all functions."""
        return (x for f in self.all_functions() for e in f.expressions for x in nodes(e))


# A function in an order that suits a processor: numbers loaded late, outputs computed early.
#
# Compilers keep the order of a source, more or less. A number loaded long before it is used takes
# a register from others; an output left for the end keeps alive, or has read again, what it
# reads. So each section loads what it is the first to use, and the outputs of an equation stand
# as soon as half of what they read has been read: behind the values that the rest waits for,
# whose latency they fill.


@dataclass(frozen=True)
class SectionValues:
    """Values of one section, then the outputs (by index) behind them, each with its loads."""

    loads: tuple[Load, ...]
    section: Section
    output_loads: tuple[Load, ...]
    outputs: tuple[int, ...]


def blocks(f: EmittedFunction) -> list[SectionValues]:
    """The blocks of a function: every load, value and output once, after what it reads."""
    left = list(f.loads)

    def loads(read: set[str]) -> tuple[Load, ...]:
        found = tuple(x for x in left if x.name in read)
        left[:] = [x for x in left if x.name not in read]
        return found

    return [
        SectionValues(
            loads(names([v.expression for v in section.values])),
            section,
            loads(names([f.outputs[i] for i in outputs])),
            tuple(outputs),
        )
        for section, outputs in _placed(f)
    ]


def names(expressions: Iterable[Expression]) -> set[str]:
    """The names that expressions read."""
    return {x for e in expressions for x in nodes(e) if isinstance(x, str)}


def _placed(f: EmittedFunction) -> list[tuple[Section, list[int]]]:
    """The sections, cut where outputs are stored, each with the indices of these outputs."""
    loaded = {x.name for x in f.loads}
    read = [names([x]) for x in f.outputs]
    starts = sorted({0, *f.titles})
    pending = [
        list(range(a, b)) for a, b in zip(starts, [*starts[1:], len(f.outputs)], strict=True)
    ]
    known = {*loaded}
    seen: set[str] = set()
    found = []
    for section in f.sections:
        values: list[Assignment] = []
        for vector in _vectors(section.values):
            values += vector
            known |= {v.name for v in vector}
            seen |= names([v.expression for v in vector]) & loaded
            outputs = []
            for equation in pending:
                reads = loaded & {x for i in equation for x in read[i]}
                if 2 * len(reads & seen) >= len(reads):
                    ready = [i for i in equation if read[i] <= known]
                    outputs += ready
                    equation[:] = [i for i in equation if i not in ready]
            if outputs:
                found.append((Section(section.label, section.equation, tuple(values)), outputs))
                values = []
        if values:
            found.append((Section(section.label, section.equation, tuple(values)), []))
    rest = [i for equation in pending for i in equation]
    return [*found, (Section("", "", ()), rest)] if rest else found


def _vectors(values: Iterable[Assignment]) -> list[Sequence[Assignment]]:
    """Consecutive values grouped by name stem: the entries of one vector or matrix each."""
    stems = groupby(values, lambda v: re.sub(r"(_\d+)+$", "", v.name))
    return [list(vector) for _, vector in stems]
