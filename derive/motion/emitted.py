"""The emitted code of a problem as a run uses it: the Python, called on all instants at once."""

from __future__ import annotations

from collections.abc import Mapping
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
from ..native.library import FLAGS, CSource, loaded, over_cores
from ..native.motion_in_c import Motion, binding, binding_to_events
from ..problem.problem import Problem
from ..record.record import Derivation
from ..schema.body_kinds import Body, GivenBody
from ..schema.followed import Event
from ..schema.lagrangian_kinds import Lagrangian
from .body_outline import outline
from .central_inertia import central_inertia
from .effective_well import OneDegree
from .emitted_code import EmittedCode, base_units
from .motion_in_python import MotionInPython
from .run import Array
from .start import MotionError
from .stated_inertia import inertia_of
from .trajectory import Moved


@dataclass(frozen=True)
class Emitted(EmittedCode):
    """A step in time that is emitted with a program, of an ``order`` if it is the discrete one,
    which stops at the ``events``; the ``lagrangian`` of a problem without points.

    ``facts``: what a run says of the problem.
    """

    step: str
    facts: Mapping[str, Any]
    events: tuple[Event, ...] = ()
    left: OneDegree | None = None
    order: str = ""
    lagrangian: Lagrangian | None = None
    solid: Body | None = None

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
        base, events, stated = base_units(problem), problem.events, problem.lagrangian
        return cls(program, record, base, step, facts, events, left, order, stated, problem.body)

    @property
    def options(self) -> Options:
        """Those of its step."""
        return Options(step=(self.step,), order=self.order)

    @cached_property
    def python(self) -> ModuleType:
        """The emitted module of Python, whose iterations end at rounding."""
        module = ModuleType(self.name)
        (text,) = emit(self.program, self.record, ("python",), self.prefix, self.options).values()
        exec(compile(text, f"{self.name}.py", "exec"), module.__dict__)  # our own templates
        if "ENOUGH" in module.__dict__:
            module.__dict__["ENOUGH"] = 0.0
        return module

    @cached_property
    def compiled(self) -> CDLL:
        """The emitted C as a library, whose iterations end at rounding, as those of the Python;
        ``CompileError`` where there is no compiler."""
        name = self.prefix
        files = emit(self.program, self.record, ("c",), name, self.options)
        files["steps.c"] = binding(name, (self.step,), FIXED, events=bool(self.events))
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

    def motion(self, k: Array, u: Array, x: Array, *, compiled: bool) -> Moved:
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
        points or of ℓ, about its centre where that is free, and its :func:`outline`."""
        numbers = dict(zip(self.python.PARAMETERS, p.tolist(), strict=True))
        stated = self.record.problem
        found = outline(stated, numbers) if stated else {}
        if "inertia" in self.program.functions:
            central = central_inertia(self.record, self.solid, numbers) if self.solid else None
            about_origin = np.asarray(self.python.inertia(p), dtype=float)
            found["inertia"] = (about_origin if central is None else central).tolist()
        elif self.lagrangian and self.program.group in ("SO(3)", "SE(3)"):
            tensor = inertia_of(self.lagrangian, numbers)
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
        if not self.kept:
            return []
        x = np.cos(1.0 + np.arange(len(self.program.state)))
        with np.errstate(all="ignore"):
            found = self.python.conserved(1.0, x, k)[self.kept]
        pairs = zip(self.kept, found, strict=True)
        return [self.program.conserved[j] for j, v in pairs if v == 0 or np.isnan(v)]

    def table(self, t: Array, x: Array, k: Array, u: Array) -> Array:
        """The rows of a run at some times and states, (instants, columns)."""
        code, has = self.python, self.program.functions
        parts = [t[:, None], x, code.energy(t, x, k)[:, None]]
        with np.errstate(all="ignore"):
            if self.kept:
                parts.append(code.conserved(t, x, k)[:, self.kept])
            if "defect" in has:
                parts.append(code.defect(x)[:, None])
            if "multiplier" in has:
                parts.append(code.multiplier(t, x, k, u)[:, None])
        return np.concatenate(parts, axis=1)
