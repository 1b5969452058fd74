"""The right-hand side in lanes: each of its numbers for several stages of a step at once, in C.

A number that comes from the state, the time or the inputs is a lane, one from the constants alone a
double; an operation of both is one of lanes.  Elementary functions have a form of their own for
lanes.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ...language.tree import nodes
from ..ellipsoid import INTEGRALS, is_integral
from ..languages import SectionValues, SourcePrinter, Statements, blocks, names
from ..program import EmittedFunction, Expression, Load

OF_ONE, OF_EACH = ("t", "x", "u"), ("t", "x", "u", "k")
"""The arrays whose numbers are lanes: of the stages of one motion, and of a motion in each lane."""


def moving(f: EmittedFunction, arrays: Collection[str]) -> frozenset[str]:
    """The names of a function that are lanes, where the numbers of some arrays are."""
    found = {x.name for x in f.loads if x.array in arrays}
    for section in f.sections:
        for v in section.values:
            if reads(v.expression, found):
                found.add(v.name)
    return frozenset(found)


def part_of(f: EmittedFunction, start: int, end: int) -> EmittedFunction:
    """What the outputs from ``start`` to before ``end`` need of a function."""
    outputs = f.outputs[start:end]
    read, sections = names(outputs), []
    for section in reversed(f.sections):
        values = []
        for v in reversed(section.values):
            if v.name in read:
                values.append(v)
                read |= names([v.expression])
        sections.append(replace(section, values=tuple(reversed(values))))
    return EmittedFunction(
        tuple(x for x in f.loads if x.name in read),
        tuple(x for x in reversed(sections) if x.values),
        outputs,
        titles={i - start: x for i, x in f.titles.items() if start <= i < end},
    )


def reads(e: Expression, names: Iterable[str]) -> bool:
    """Does an expression read one of the names?"""
    return any(isinstance(x, str) and x in names for x in nodes(e))


@dataclass(frozen=True)
class LaneStatements(Statements):
    """How the statements of a function are written whose names ``lanes`` are lanes."""

    lanes: frozenset[str] = frozenset()
    moving: Collection[str] = OF_ONE

    @property
    def printer(self) -> SourcePrinter:
        """What writes expressions, with functions of lanes."""
        own = super().printer
        return replace(
            own,
            function=lambda x: f"{self.prefix}_{x}" if x.endswith("_lanes") else own.function(x),
            integrals=f"{self.prefix}_{INTEGRALS}_lanes(",
        )

    def blocks(self, f: EmittedFunction) -> list[dict[str, Any]]:
        """The blocks of a function: lines of loads and statements, (index, text) of outputs."""
        return [self._lane_block(b, f) for b in blocks(f)]

    def _lane_block(self, b: SectionValues, f: EmittedFunction) -> dict[str, Any]:
        own = [(v.name, self.in_lanes(v.expression)) for v in b.section.values]
        outputs = [(i, self.in_lanes(self._lane(f.outputs[i]))) for i in b.outputs]
        return {
            "comment": self._comment(b.section.label),
            "loads": [self._loaded(x) for x in b.loads],
            "statements": [self._statement(name, e) for name, e in own],
            "output_loads": [self._loaded(x) for x in b.output_loads],
            "outputs": [(i, self._wrapped(self.printer(e), 80)) for i, e in outputs],
        }

    def _loaded(self, x: Load) -> str:
        index = f"[{x.index}]" if x.array != "t" else ""
        array = {"t": "times"}.get(x.array, x.array)
        return self._declared(x.name, f"{array}{index}" + "[s]" * (x.array in self.moving))

    def _declared(self, name: str, text: str) -> str:
        return f"const {f'{self.prefix}_lane' if name in self.lanes else 'double'} {name} = {text};"

    def _lane(self, e: Expression) -> Expression:
        """An expression that is a lane: one of doubles is added to lanes of 0."""
        return e if reads(e, self.lanes) else ("add", f"{self.prefix}_zero_lanes()", e)

    def in_lanes(self, e: Expression) -> Expression:
        """An expression with the functions of lanes, where they are called on lanes."""
        if not isinstance(e, tuple) or not reads(e, self.lanes):
            return e
        if e[0] == "fun" and e[1] == INTEGRALS:
            return ("fun", e[1], *(self.in_lanes(self._lane(x)) for x in e[2:]))
        if e[0] == "fun" and not is_integral(e[1]):
            return ("fun", f"{e[1]}_lanes", self.in_lanes(e[2]))
        if e[0] in ("abs", "none"):
            name = {"abs": "fabs"}.get(e[0], e[0])
            return ("fun", f"{name}_lanes", self.in_lanes(e[1]))
        return (e[0], *(self.in_lanes(x) for x in e[1:]))


def in_lanes(
    f: EmittedFunction, written: Statements, arrays: Collection[str] = OF_ONE
) -> Mapping[str, Any]:
    """The template fields of a function in lanes: its blocks, the functions it calls on lanes, the
    arrays it reads; ``arrays``: those whose numbers are lanes."""
    language = replace(written.language, bundle="const {prefix}_lane_integrals {name} = {text};")
    own = LaneStatements(
        language, written.real, written.sizes, written.prefix, moving(f, arrays), arrays
    )
    called = [x for e in f.expressions for x in nodes(own.in_lanes(e))]
    functions = {x[1] for x in called if isinstance(x, tuple) and x[0] == "fun"}
    return {
        "blocks": own.blocks(f),
        "calls": sorted(x.removesuffix("_lanes") for x in functions if x.endswith("_lanes")),
        "integrals": INTEGRALS in functions,
        "arrays": sorted({x.array for x in f.loads}),
    }
