"""The emitted code of a problem as a run uses it, and what symmetries leave of its motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from ctypes import CDLL
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType
from typing import Any

import numpy as np

from ..code.emit import emit, problem_hash
from ..code.options import Options
from ..code.program import Program
from ..code.step.step_numbers import FIXED
from ..language.tree import Tree, replaced
from ..language.values import value
from ..problem.problem import Problem
from ..record.record import Derivation
from ..schema.body_kinds import GivenBody
from ..schema.motion_kinds import Event
from ..views.figure.drawn_body import ExpressionValues, parts
from ..views.figure.shapes import Curve, Shape
from .c_binding import binding, binding_on_card, binding_to_events
from .emitted_code import EmittedCode
from .first_numbers import MotionError
from .native import (
    CARD_FLAGS,
    FLAGS,
    CSource,
    Motion,
    compiler_of_cards,
    loaded,
    over_cores,
)
from .run import Array, symmetry_axis
from .start import central_inertia, inertia_of
from .trajectory import MotionInPython, MotionUnderWay


def python_of(program: Program, record: Derivation, prefix: str, options: Options) -> ModuleType:
    """The emitted module of Python, whose iterations end at rounding."""
    module = ModuleType(program.name)
    (text,) = emit(program, record, ("python",), prefix, options).values()
    exec(compile(text, f"{program.name}.py", "exec"), module.__dict__)  # our own templates
    if "ENOUGH" in module.__dict__:
        module.__dict__["ENOUGH"] = 0.0
    return module


@dataclass(frozen=True)
class Emitted(EmittedCode):
    """A step in time that is emitted with a program, of an ``order`` if it is the discrete one,
    which stops at the events of the problem.

    ``facts``: what a run says of the problem.
    """

    step: str
    facts: Mapping[str, Any]
    left: OneDegree | None = None
    order: str = ""

    @classmethod
    def of(
        cls,
        program: Program,
        problem: Problem,
        record: Derivation,
        step: str,
        left: OneDegree | None = None,
        unsought: str = "",
        order: str = "",
    ) -> Emitted:
        """That of the program of a problem; ``left``: what its symmetries leave, if it is one
        degree of freedom; ``unsought``: why it has none of what the motion keeps but the energy.
        """
        facts = {
            "problem": problem.name,
            "title": problem.title,
            "group": program.group,
            "hash": problem_hash(record),
            "unsought": unsought,
            "filled": isinstance(problem.body, GivenBody) and bool(problem.body.solids),
        }
        if program.state_by_block:
            facts["by_block"] = program.by_block
        return cls(program, record, problem, step, facts, left, order)

    @property
    def events(self) -> tuple[Event, ...]:
        """Those that are looked for."""
        return self.problem.events

    @property
    def options(self) -> Options:
        """Those of its step."""
        return Options(step=(self.step,), order=self.order)

    @cached_property
    def python(self) -> ModuleType:
        """The emitted module of Python, whose iterations end at rounding."""
        return python_of(self.program, self.record, self.prefix, self.options)

    @cached_property
    def compiled(self) -> CDLL:
        """The emitted C as a library, whose iterations end at rounding, as those of the Python;
        ``CompileError`` where there is no compiler."""
        name = self.prefix
        files = emit(self.program, self.record, ("c",), name, self.options)
        events, driven = bool(self.events), bool(self.program.inputs)
        files["steps.c"] = binding(name, (self.step,), FIXED, events=events, driven=driven)
        to_rounding = f"-D{name}_ENOUGH=0"
        return loaded(CSource(name, tuple(files.items()), None, (*FLAGS, to_rounding)))

    @cached_property
    def compiled_ensemble(self) -> CDLL:
        """The emitted C of many motions at once, over all cores where the compiler can; as
        ``compiled``.  Eight in lanes at a time or, to end at events, each by the step."""
        name, step = self.prefix, self.step
        options = Options(ensemble=True, step=(step,) * bool(self.events))
        files = emit(self.program, self.record, ("c",), name, options)
        if self.events:
            files["steps.c"] = binding_to_events(name, step)
        else:
            files["steps.c"] = binding(name, (), ensemble=True)
        return loaded(over_cores(CSource(self.name, tuple(files.items()), None, FLAGS)))

    @cached_property
    def ensemble_on_card(self) -> CDLL:
        """The same on a graphics card, by CUDA; ``CompileError`` where there is no nvcc or no
        card."""
        name, compiler = self.prefix, compiler_of_cards()
        options = Options(ensemble=True, form="header")
        files = emit(self.program, self.record, ("c",), name, options)
        files["steps.c"] = binding_on_card(name)
        return loaded(CSource(self.name, tuple(files.items()), compiler, CARD_FLAGS))

    def motion(self, k: Array, u: Array, x: Array, *, compiled: bool) -> MotionUnderWay:
        """The motion that is in the state x at time 0, in C or in Python."""
        if compiled:
            names = tuple(x.name for x in self.events)
            return Motion(self.compiled, (self.step,), names, lambda: (k, u), x, 0.0)
        return MotionInPython(self.python, self.step, k, u, x)

    def constants(self, p: Array) -> Array:
        """k of some parameters; ``MotionError`` where no body has them."""
        try:
            return np.asarray(self.python.constants(p), dtype=float)
        except ValueError as error:
            raise MotionError(str(error)) from None

    def body(self, p: Array) -> dict[str, Any]:
        """What pictures need of a body: its tensor of inertia, if it is turned in space, of its
        points or of ℓ, about its centre where that is free, and its :func:`outline`; where mass
        flows, and the tensor with it, the ``axis`` of its symmetry at first, if there is one."""
        numbers = dict(zip(self.python.PARAMETERS, p.tolist(), strict=True))
        stated, solid = self.record.problem, self.problem.body
        found: dict[str, Any] = outline(stated, numbers) if stated else {}
        of_state = {x: self.problem.parameters[x].default for x in self.program.masses}
        known = numbers | {x: y for x, y in of_state.items() if y is not None}
        central = central_inertia(self.record, solid, known) if solid else None
        if self.program.masses and central is not None:
            found["axis"] = symmetry_axis(central)
        if "inertia" in self.program.functions:
            about_origin = np.asarray(self.python.inertia(p), dtype=float)
            found["inertia"] = (about_origin if central is None else central).tolist()
        elif self.problem.lagrangian and self.program.group in ("SO(3)", "SE(3)"):
            tensor = inertia_of(self.problem.lagrangian, numbers)
            found["inertia"] = [] if tensor is None else tensor.tolist()
        return {name: x for name, x in found.items() if x}

    def potential(self, table: Array, numbers: Mapping[str, float]) -> dict[str, Any]:
        """The effective potential about where the energy of a run, by its ``table``, lets it go."""
        if self.left is None:
            return {}
        run = dict(zip((c.name for c in self.columns()), table.T, strict=True))
        return self.left.along(run, numbers)

    def vanishing(self, k: Array) -> list[str]:
        """What the motion keeps that is 0 or no number in every state for these constants, by name,
        as what gravity gives where there is none: in a state without any symmetry."""
        if not self.conserved_columns:
            return []
        x = np.cos(1.0 + np.arange(len(self.program.state)))
        with np.errstate(all="ignore"):
            found = self.python.conserved(1.0, x, k)[self.conserved_columns]
        pairs = zip(self.conserved_columns, found, strict=True)
        return [self.program.conserved[j] for j, v in pairs if v == 0 or np.isnan(v)]

    def table(self, t: Array, x: Array, k: Array, u: Array) -> Array:
        """The rows of a run at some times and states, (instants, columns)."""
        code, has = self.python, self.program.functions
        parts = [t[:, None], x, code.energy(t, x, k)[:, None]]
        with np.errstate(all="ignore"):
            if self.conserved_columns:
                parts.append(code.conserved(t, x, k)[:, self.conserved_columns])
            if "defect" in has:
                parts.append(code.defect(x)[:, None])
            if "multiplier" in has:
                parts.append(code.multiplier(t, x, k, u)[:, None])
            if "outputs" in has:
                parts.append(code.outputs(t, x, k, u))
        return np.concatenate(parts, axis=1)


# What pictures of a run need of its body, in numbers, in its own frame.

ROUND_KINDS = ("ball", "ellipsoid", "hollow_ball")
SIGHT = (0.75, 0.5, 0.43)


def outline(problem: Mapping[str, Any], parameters: Mapping[str, float]) -> dict[str, list[Any]]:
    """What there is of a body in R³, or in the plane of its first two axes, that one group moves:
    its ``points``; its ``ellipsoids``, each the rows of a map of the unit ball and a shift; its
    other ``solids``, convex, each the lines of its edges and rims.  A mesh is left out."""
    declared = {
        name: {**dict(about), "default": parameters.get(name, about["default"])}
        for name, about in problem["parameters"].items()
    }
    found = parts(
        {**problem, "parameters": declared}, ExpressionValues({**problem, "parameters": declared})
    )
    if len(found) != 1 or found[0].size not in (2, 3):
        return {}
    (body,) = found
    shapes = [Shape(x, SIGHT) for x in body.solids if x.kind != "mesh"]
    ellipsoids = [
        [[list(row) for row in zip(*x.columns, strict=True)], list(x.shift)]
        for x in shapes
        if x.kind in ROUND_KINDS
    ]
    solids = [
        [[list(p) for p in _short(c.points)] for c in _edges(x)]
        for x in shapes
        if x.kind not in ROUND_KINDS
    ]
    points = [list(r) for _, r in body.points.values()]
    return {"points": points, "ellipsoids": ellipsoids, "solids": solids}


def _edges(shape: Shape) -> list[Curve]:
    """The edges and rims of a solid, without contours, which turn with the body; the apex of a cone
    as one of no length."""
    curves = [*shape.curves()]
    if shape.kind == "cylinder":
        return curves[:2]
    if shape.kind == "cone":
        apex = shape.to_body((0.0, 0.0, 1.0))
        return [curves[0], Curve((apex, apex, apex))]
    return curves


def _short(points: tuple[Any, ...]) -> list[Any]:
    """A straight line by its ends, a curve by every other of its points."""
    first, middle, last = points[0], points[len(points) // 2], points[-1]
    bend = max(abs(x + z - 2 * y) for x, y, z in zip(first, middle, last, strict=True))
    return [first, last] if bend < 1e-9 else [*points[::2]]


# The effective potential that symmetries leave of a motion, about where its energy lets it go.

FIRST = 32
"""In so many parts the window is cut before V is known to bend."""
PIXEL = 5e-4
"""The part of a picture's width, and of its height, by which what is drawn may be off."""

EDGE = 1 - 1e-9
"""An entry of a rotation lies between −1 and 1, where V may have poles."""

Bounds = tuple[float, float]
ROTATION: Bounds = (-EDGE, EDGE)

SHOWN = 2.0
"""So many depths of the well a picture is high."""

BEYOND, STEADY = 0.4, 0.05
"""So much of the well is shown on each side of it; and so far about a motion that stays where it
is, to rounding, which has no well."""


@dataclass(frozen=True)
class OneDegree:
    """What symmetries leave of a problem where it is one degree of freedom: ``V``, the effective
    potential, a tree in the ``entry`` of g, the momenta 𝒥_1, 𝒥_2, … and the parameters; what the
    ``momenta`` are called among what the motion keeps, and the entry among the state, its ``name``;
    is the entry that of a rotation: it ``turns``?"""

    entry: Tree
    V: Tree
    momenta: tuple[str, ...]
    name: str
    turns: bool = True

    def along(self, run: Mapping[str, Array], numbers: Mapping[str, float]) -> dict[str, Any]:
        """V at some u, an entry of g, for the momenta of the first row of a run, given by
        its columns: between the turning points of its energy, and a little beyond; empty where
        there is none."""
        if not {*self.momenta, self.name} <= {*run}:
            return {}
        first = {**numbers, **{x: float(run[x][0]) for x in self.momenta}}
        at, energy = run[self.name], float(run["energy"][0])
        try:
            low, high = float(at.min()), float(at.max())
            bounds = ROTATION if self.turns else widened(low, high)
            well = turning_points(lambda u: self._value(u, first), energy, low, high, bounds)
            u, V = curve(lambda u: self._value(u, first), energy, *window(*well, bounds))
        except (ArithmeticError, ValueError):
            return {}
        return {"entry": self.name, "u": u.tolist(), "V": V.tolist()}

    def _value(self, u: Any, numbers: Mapping[str, float]) -> Any:
        known: dict[Tree, Any] = {self.entry: u}
        known |= {("at", "𝒥", k): numbers[x] for k, x in enumerate(self.momenta, 1)}
        tree = self.V
        for k, x in enumerate(known):
            tree = replaced(tree, x, ("par", f"_{k}"))
        values = {**numbers, **{f"_{k}": x for k, x in enumerate(known.values())}}
        return value(tree, {"π": math.pi}, values, None, float)


def widened(low: float, high: float) -> Bounds:
    """As far beyond a motion as it went: an entry of no rotation has no bounds of its own."""
    wide = max(high - low, STEADY)
    return low - wide, high + wide


def turning_points(
    V: Callable[[float], float], energy: float, low: float, high: float, bounds: Bounds = ROTATION
) -> tuple[float, float]:
    """The ends of the well {V ≤ energy}, within bounds, in which a motion was between ``low`` and
    ``high``."""
    step = max(1e-3 * (high - low), 1e-9)
    low, high = (min(max(x, bounds[0]), bounds[1]) for x in (low, high))
    return _end(V, energy, low, -step, bounds), _end(V, energy, high, step, bounds)


def _end(
    V: Callable[[float], float], energy: float, u: float, step: float, bounds: Bounds
) -> float:
    """The end of the well on one side of u: steps, each twice the last, then halves."""
    inside, outside = u, u + step
    while bounds[0] < outside < bounds[1] and V(outside) <= energy:
        inside, outside, step = outside, outside + 2 * step, 2 * step
    outside = min(max(outside, bounds[0]), bounds[1])
    if V(outside) <= energy:
        return outside
    for _ in range(60):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if V(middle) <= energy else (inside, middle)
    return inside


def window(low: float, high: float, bounds: Bounds = ROTATION) -> Bounds:
    """From a little below a well to a little above it."""
    wide = high - low
    more = BEYOND * wide if wide > 1e-7 else STEADY
    return max(bounds[0], low - more), min(bounds[1], high + more)


def curve(V: Callable[[Any], Any], energy: float, low: float, high: float) -> tuple[Array, Array]:
    """Places and the values of V there, the nearer to one another the more it bends: intervals are
    halved until the middle of the curve is within a pixel of the chord, or their ends are;
    ``ArithmeticError`` where V has no value."""

    def at(u: Array) -> Array:
        found = np.array(np.broadcast_to(V(u), u.shape), float)
        if not np.isfinite(found).all():
            raise ArithmeticError
        return found

    u = np.linspace(low, high, FIRST + 1)
    values = at(u)
    left = np.arange(FIRST)  # the places where intervals begin that are to be halved
    while left.size:
        middles = (u[left] + u[left + 1]) / 2
        found = at(middles)
        least = float(values.min())
        deep = (energy - least) or float(np.ptp(values)) or 1.0

        def scaled(u: Array, V: Array, least: float = least, deep: float = deep) -> Array:
            """Places in a picture of width and height 1; what is far above it ends there."""
            return np.array([u / (high - low), np.minimum((V - least) / deep, SHOWN) / SHOWN])

        start, end = scaled(u[left], values[left]), scaled(u[left + 1], values[left + 1])
        chord, bent = end - start, scaled(middles, found) - start
        long = np.hypot(*chord)
        away = np.abs(chord[0] * bent[1] - chord[1] * bent[0]) / long
        halved = (away > PIXEL) & (long > PIXEL)
        places = np.searchsorted(u, middles)
        u, values = np.insert(u, places, middles), np.insert(values, places, found)
        new = np.searchsorted(u, middles[halved])
        left = np.sort(np.concatenate([new - 1, new]))
    return u, values
