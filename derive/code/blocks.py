"""A function in an order that suits a processor: numbers loaded late, outputs computed early.

Compilers keep the order of a source, more or less.  A number loaded long before it is used takes a
register from others; an output left for the end keeps alive, or has read again, what it reads.  So
each section loads what it is the first to use, and the outputs of an equation stand as soon as half
of what they read has been read: behind the values that the rest waits for, whose latency they fill.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby

from ..language.tree import nodes
from .program import Assignment, EmittedFunction, Expression, Load, Section


@dataclass(frozen=True)
class Block:
    """Values of one section, then the outputs (by index) behind them, each with its loads."""

    loads: tuple[Load, ...]
    section: Section
    output_loads: tuple[Load, ...]
    outputs: tuple[int, ...]


def blocks(f: EmittedFunction) -> list[Block]:
    """The blocks of a function: every load, value and output once, after what it reads."""
    left = list(f.loads)

    def loads(read: set[str]) -> tuple[Load, ...]:
        found = tuple(x for x in left if x.name in read)
        left[:] = [x for x in left if x.name not in read]
        return found

    return [
        Block(
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
    pending = _equations(f)
    known: set[str] = set()
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
                    ready = [i for i in equation if read[i] <= known | loaded]
                    outputs += ready
                    equation[:] = [i for i in equation if i not in ready]
            if outputs:
                found.append((Section(section.label, section.equation, tuple(values)), outputs))
                values = []
        if values:
            found.append((Section(section.label, section.equation, tuple(values)), []))
    rest = [i for equation in pending for i in equation]
    return [*found, (Section("", "", ()), rest)] if rest else found


def _equations(f: EmittedFunction) -> list[list[int]]:
    """The indices of a function's outputs, grouped by the equation they come from."""
    starts = sorted({0, *f.titles})
    return [list(range(a, b)) for a, b in zip(starts, [*starts[1:], len(f.outputs)], strict=True)]


def _vectors(values: Iterable[Assignment]) -> list[Sequence[Assignment]]:
    """Consecutive values grouped by name stem: the entries of one vector or matrix each."""
    stems = groupby(values, lambda v: re.sub(r"(_\d+)+$", "", v.name))
    return [list(vector) for _, vector in stems]
