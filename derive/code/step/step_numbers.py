"""What the templates of the steps in time are filled with; the right-hand side in lanes, in C:
each of its numbers for several stages of a step at once.

A number that comes from the state, the time or the inputs is a lane, one from the constants alone a
double; an operation of both is one of lanes.  Elementary functions have a form of their own for
lanes.
"""

from __future__ import annotations

import textwrap
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any

from ...language.tree import nodes
from ..ellipsoid import INTEGRALS, is_integral
from ..languages import SourcePrinter, Statements
from ..options import Options
from ..program import (
    EmittedFunction,
    Expression,
    KeptByGauss,
    Load,
    Program,
    SectionValues,
    blocks,
    names,
)
from .tableaux import GROWTH as EXPLICIT_GROWTH
from .tableaux import METHODS, Collocation, StageModes, explicit
from .tableaux import SAFETY as EXPLICIT_SAFETY

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
            "lines": [
                *map(self._loaded, b.loads),
                *(self._comment(b.section.label) if own else ()),
                *(self._statement(name, e) for name, e in own),
                *map(self._loaded, b.output_loads),
            ],
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


def steps(p: Program, written: Statements, options: Options) -> dict[str, Any]:
    """Name of a step → its numbers; ``parts``: the first index and that after the last of each part
    of the state; ``split``: where the later half of them begins, or 0; ``lanes``: the right-hand
    side of several stages at once, in C; ``adaptive``: the steps that choose their size;
    ``explicit``: what they share; ``watch``: how events are found."""
    compiled = "c" in (written.language.name, written.language.needs)
    in_lanes_too = compiled and "gauss" in options.step and not p.loops
    kept = [sentences(p.keeps, energy_alone=not p.conserved)] if p.keeps else []
    return {
        "parts": parts(p),
        "split": split_of(p),
        "lanes": in_lanes(p.functions["rhs"], written) if in_lanes_too else None,
        "turns": turns(p, written, compiled)
        if {*COLLOCATED} & {*options.step} and not p.loops
        else [],
        "adaptive": {*options.step} - {*FIXED},
        "explicit": (told := explicit(options.step)),
        "discrete": discrete(p, options),
        "held": "discrete" in options.step or "vern9" in options.step,
        "memory": memory(p, options, told["rows"] if told else 0),
        "names": options.step,
        "statuses": [x for x in STATUSES if x[0] != "NO_SOLUTION" or p.discrete],
        "varied": varied(options),
        "least": LEAST,
        "watch": WATCH[options.real] if p.events else None,
        "ensemble": ensemble(p, written) if compiled and options.ensemble else None,
        "gauss": gauss("raw" in options.jacobian) if {*COLLOCATED} & {*options.step} else None,
        "keeps": textwrap.wrap(" ".join([*kept, *[BENDS] * p.bends]), 92),
        "kinks": p.kinks.get("rates", ()),
    }


STATUSES = (
    ("OK", 0, "The steps were made."),
    ("NOT_FINITE", 2, "The rates, or what a step leads to, have no finite value."),
    ("NOT_CONVERGED", 3, "No step is short enough: a collision, or a motion without bound."),
    ("NO_SOLUTION", 5, "There is no discrete step of this size."),
)
"""What steps return besides that they stand at an event: names, numbers, and what they say."""

BENDS = (
    "A force has a root, as in |v|, whose derivatives may jump where it is 0, or tanh or atan, "
    "which may be steep: the estimate of gauss does not see that; its error is larger than tol "
    "then, and nearer to it with vern9."
)


def sentences(found: KeptByGauss, *, energy_alone: bool) -> str:
    """What the emitted files say of it; is no other integral looked at?"""
    exact = [*["the group"] * found.group, *found.exact]
    text = f"In this form of the state it keeps {', '.join(exact) or 'no integral'} to rounding"
    if found.others:
        text += f", and to the error of its steps alone {', '.join(found.others)}"
    if energy_alone:
        text += ", but not the energy" * (not found.exact) + "; --conserved names other integrals"
    return f"{text}."


def discrete(p: Program, options: Options) -> dict[str, Any] | None:
    """The discrete step, where that is asked for, the ``counts`` of its arrays by their names, and
    its ``number`` among the steps of a motion."""
    if p.discrete is None:
        return None
    return {
        **vars(p.discrete),
        "counts": [*p.discrete.sizes.items()],
        "substeps": len(p.discrete.weights),
        "number": 1 + sum(x in METHODS for x in options.step),
    }


def memory(p: Program, options: Options, stages: int) -> dict[str, int] | None:
    """The kilobytes of a motion, and those that a step has on the stack in C besides the rates;
    ``None`` where the state is not so large that one should know."""
    implicit, size = "gauss" in options.step, len(p.state) * (4 if options.real == "float" else 8)
    if len(p.state) <= LARGE:
        return None
    motion = 3 + 8 * implicit + stages
    # as measured without optimisation, which takes most
    within = max(38 * implicit, 5 + stages)
    return {name: -(-size * x // 1024) for name, x in (("motion", motion), ("stack", within))}


LARGE = 200
"""The largest state of which the memory of a step is not said."""


def turns(p: Program, written: Statements, compiled: bool) -> list[dict[str, Any]]:
    """The parts of the state that an iteration takes one after the other, each by what is new of
    the others: the first index, that after the last, the rates in lanes, of C or as a function.

    Places, then velocities: fewer iterations, of which each waits longer, which does not pay where
    the state is small.
    """
    split, f = split_of(p), p.functions["rhs"]
    halves = len(p.state) > SMALL and split
    found = []
    for a, b in ((0, split), (split, len(p.state))) if halves else ((0, len(p.state)),):
        half = part_of(f, a, b) if halves else f
        lanes = in_lanes(half, written) if compiled else written.function(half)
        found.append({"start": a, "end": b, "lanes": lanes})
    return found


def split_of(p: Program) -> int:
    """The first number of the later half of the parts of a state, velocities mostly; 0 of one
    part."""
    found = parts(p)
    return found[len(found) // 2][0] if len(found) > 1 else 0


SMALL = 12
"""The largest state whose parts are iterated together."""


def ensemble(p: Program, written: Statements) -> dict[str, Any]:
    """The right-hand side of a motion in each lane, the way back to the group, and how steps of
    Verner's pair change."""
    found = p.functions.get("project")
    return {
        "rhs": in_lanes(p.functions["rhs"], written, OF_EACH),
        "project": in_lanes(found, written, OF_EACH) if found else None,
        "growth": EXPLICIT_GROWTH,
        "safety": EXPLICIT_SAFETY,
        "order": METHODS["vern9"][0]().order,
    }


def parts(p: Program) -> list[tuple[int, int]]:
    """The range of each part of the state, as A and zeta, or A and its rate: its errors are
    measured together.  The vorticity on the torus is one: of a smooth flow most of its coefficients
    are nothing but rounding, which no step makes smaller."""
    if p.on_torus:
        return [(0, len(p.state))]
    found, start = [], 0
    for _, members in groupby(
        p.state, lambda name: (name.partition("_")[0], name.endswith("_dot"))
    ):
        end = start + len([*members])
        found.append((start, end))
        start = end
    return found


def gauss(coarse: bool) -> dict[str, Any]:
    """The numbers of Gauss's collocation, which round-trip as decimals: see ``Collocation``;
    ``coarse``: its stages apart, too, for Newton's method where there is a Jacobian."""
    method = Collocation()
    return {
        "nodes": method.c,
        "weights": method.b,
        "mu": method.mu,
        "mu_by_columns": [[*column] for column in zip(*method.mu, strict=True)],
        "legendre": method.dense,
        "continued": method.continued,
        "error": ERROR,
        "sweeps": SWEEPS,
        "continues": CONTINUES,
        "rounding": ROUNDING,
        "stalled": STALLED,
        "enough": ENOUGH,
        "growth": GROWTH,
        "safety": SAFETY,
        "kept": KEPT,
        "many": MANY,
        "least": LEAST,
        "modes": StageModes.of(method) if coarse else None,
        "newton_steps": NEWTON_STEPS,
        "stalled_newton": STALLED_NEWTON,
    }


SWEEPS = 40
"""The most iterations of a step; one that needs more is made in halves."""

CONTINUES = 8
"""A step that is so many times the last one is not begun from the polynomial of that."""

GROWTH, SAFETY, LEAST = 4.0, 0.9, 1e-12
"""By how much a step may grow, the part taken of what an error suggests, and the least step, as a
part of the time: shorter ones would not end."""

KEPT = 1.1
"""A step that may grow by less is kept."""

MANY = 16
"""The iterations from which on a coarser step costs more of them than it saves steps."""

ERROR = 3.0
"""The error of a step over the square of the last coefficient of f in Legendre's polynomials, which
it is like: so chosen that on tops and on SL(3) the error at the end of a hundred turns is about the
tolerance; on bodies whose parts differ it is less."""

ROUNDING, STALLED = 1e-16, 1e-13
"""What an iteration may still change, relative; and below which it is rounding that it does no
more."""

ENOUGH = 1e-3
"""The part of a tolerance that an iteration may leave, as what it leaves adds up."""

NEWTON_STEPS, STALLED_NEWTON = 20, 1e-10
"""The most steps of Newton's method for the stages; and below which change it is rounding that it
does no more, of rates that are large where a problem is stiff, or the last step is enough."""

COLLOCATED = ("gauss", "gauss_jax")
"""The steps of Gauss's collocation."""

WATCH = {
    real: {"parts": 16, "halvings": 40, "newton": 8, "exact": exact, "sliver": sliver}
    for real, exact, sliver in (("double", 1e-15, 1e-9), ("float", 1e-7, 1e-4))
}
"""An event is looked for at the ends of so many parts of a step, on its polynomial; the part is
halved so often; then so many steps that end there, at most, correct the instant to an exact one,
relative.  ``sliver``: the part of a step below which nothing is left of a time."""

VARIED = ("gauss", *METHODS)
"""The steps whose derivatives are written."""


def varied(options: Options) -> list[str]:
    """The steps whose derivatives are asked for."""
    return [x for x in options.step if x in VARIED and "step" in options.jacobian]


FIXED, IN_FLOAT = ("rk4", "discrete"), ("rk4",)
"""The steps that have no size of their own, and those that are written for float, too."""
