"""The emitted C of a problem, compiled and loaded: a right-hand side for ``solve_ivp``.

>>> import derive, numpy
>>> f = derive.compile("so3")
>>> f(0.0, numpy.concatenate([numpy.eye(3).ravel(), [0.1, 0, 9]])).shape
(12,)
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np

from ..code.emit import emit
from ..code.languages import LANGUAGES
from ..code.naming import own_prefix
from ..code.options import options_of
from ..code.step.step_numbers import FIXED, VARIED, varied
from ..language.reserved import did_you_mean, near_name
from ..motion.c_binding import binding
from ..motion.native import (
    FLAGS,
    Array,
    CompileError,
    CSource,
    Motion,
    constants,
    ensemble,
    loaded,
    over_cores,
    pointer,
)
from ..motion.start import OFF_THE_GROUP
from ..motion.trajectory import reflection
from ..problem.problem import Problem, ProblemError
from ..programs import program
from .compiled_functions import CompiledFunctions, CompiledValues, Names, as_array
from .compiled_functions import binding as group_binding
from .derived import Derived, derive

__all__ = ["CompileError", "Compiled", "compile"]

BINDING = """\
#include "{name}.h"
void derive_rhs(double *b);
void derive_rhs(double *b)
{{
    double *x = b + 1, *u = x + {name}_N_STATE, *k = u + {name}_N_INPUTS;
    {name}_rhs(b[0], x, k, u, k + {name}_N_CONSTANTS);
}}
"""
"""C that is compiled beside the emitted one: rhs on one array of t, x, u, k and dx, as to convert
five arguments takes ctypes longer than rhs takes."""


class Buffers:
    """The memory of one call of rhs at a time: views of t, x, u, k and dx in one array."""

    __slots__ = ("copy", "k", "now", "run", "u", "values", "x")

    def __init__(self, names: Names, run: Callable[[Any], None]):
        ends = np.cumsum([1, len(names.state), len(names.inputs), names.constants])
        whole = np.zeros(int(ends[-1]) + len(names.state))
        self.now, self.x, self.u, self.k, dx = np.split(whole, ends)
        self.copy = dx.copy
        self.values: CompiledValues | None = None  # those that u and k hold
        in_c = (ctypes.c_double * len(whole)).from_buffer(whole)  # type: ignore[arg-type]
        self.run = partial(run, ctypes.byref(in_c))


class Compiled(CompiledFunctions):
    """The functions of one problem in compiled C, for one body; called, it is dx/dt = f(t, x, u).

    ``STATE``, ``PARAMETERS``, ``INPUTS``, ``CONSERVED``, ``OUTPUTS``, ``STEPS``: names; ``p``,
    ``k``: parameters and constants in use; ``u``: the inputs of calls that are given none, zero at
    first. These three are not to be written into: :meth:`use` and ``f.u = …`` replace them. Threads
    may share it, each call has buffers of its own; pickled, it takes its C along, which is compiled
    where it is loaded.
    """

    def __init__(self, names: Names, source: CSource, values: CompiledValues | None = None):
        self.STATE, self.INPUTS, self.PARAMETERS = names.state, names.inputs, tuple(names.defaults)
        self.CONSERVED, self.OUTPUTS = names.conserved, names.outputs
        self.REDUCED = names.reduced
        self.STEPS = names.steps
        self._names, self._source, self._library = names, source, loaded(source)
        p, k, u = map(np.zeros, (len(self.PARAMETERS), names.constants, len(self.INPUTS)))
        self._values = values or CompiledValues(p, k, u, ready=False)
        self._replacing = Lock()
        # rhs takes less time than to let go of the interpreter's lock and to take it again
        self._run = ctypes.PyDLL(None, handle=self._library._handle).derive_rhs
        self._run.restype = None
        self._idle: list[Buffers] = []  # its pop and append are atomic

    def __repr__(self) -> str:
        return f"<compiled {self._source.name}: a state of {len(self.STATE)} numbers>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Compiled, (self._names, self._source, self._values)

    def __call__(self, t: float, x: Any, u: Any = None) -> Array:
        """dx/dt, an array of len(STATE), with the inputs u or else those of this object."""
        try:
            mine = self._idle.pop()
        except IndexError:
            mine = Buffers(self._names, self._run)
        if u is not None or mine.values is not self._values:
            self._refill(mine, u)
        _fill(mine.x, x)
        mine.now[0] = t
        mine.run()
        dx = mine.copy()
        self._idle.append(mine)
        return dx

    rhs = __call__

    def _refill(self, mine: Buffers, u: Any) -> None:
        """Put the constants and the inputs of the next call into its buffers."""
        values = self._in_use()
        mine.k[:] = values.k
        _fill(mine.u, values.u if u is None else u)
        mine.values = values if u is None else None

    @property
    def p(self) -> Array:
        """The parameters in use, in the order of PARAMETERS, read only."""
        return _read_only(self._values.p)

    @property
    def k(self) -> Array:
        """The constants in use, in the order of the emitted code, read only."""
        return _read_only(self._values.k)

    @property
    def u(self) -> Array:
        """The inputs of a call that is given none, read only; assign an array to replace them."""
        return _read_only(self._values.u)

    @u.setter
    def u(self, values: Any) -> None:
        u = as_array(values, len(self.INPUTS))
        with self._replacing:
            self._values = self._values._replace(u=u)

    def use(self, parameters: Mapping[str, float] | Sequence[float] = ()) -> Compiled:
        """Use these parameters, by name or in order, and defaults for the others; ``ValueError``
        says what is wrong."""
        defaults = self._names.defaults
        if isinstance(parameters, Mapping):
            named = dict(parameters)
        else:
            if len(parameters) not in (0, len(self.PARAMETERS)):
                raise ValueError(f"expected {len(self.PARAMETERS)} parameters in order, or names")
            named = dict(zip(self.PARAMETERS, parameters, strict=False))
        self._require_known([x for x in named if x not in defaults])
        values = {**defaults, **named}
        missing = [x for x, value in values.items() if value is None]
        if missing:
            raise ValueError(f"no value for the parameters {', '.join(missing)}")
        p = np.array([values[x] for x in self.PARAMETERS], dtype=float)
        k = np.zeros(self._names.constants)
        if self._function("constants", ctypes.c_int)(*map(pointer, (p, k))):
            raise ValueError(
                "no body has these parameters: its mass matrix is not positive, or a number is "
                "not finite"
            )
        with self._replacing:
            self._values = self._values._replace(p=p, k=k, ready=True)
        return self

    def _require_known(self, others: Sequence[str]) -> None:
        """``ValueError`` for what is no parameter of the equations, with what it may be."""
        if unread := [x for x in others if x in self._names.unread]:
            raise ValueError(
                f"the equations do not have {', '.join(unread)}, which the problem declares for "
                "other uses, as [initial]: leave it out"
            )
        if others:
            near = did_you_mean(near_name(others[0], self.PARAMETERS), "; ")
            raise ValueError(f"unknown parameters {', '.join(others)}{near}")

    def begin(self, x: Any, t: float = 0.0) -> Motion:
        """The motion in state x, on the group, at time t; needs ``step="gauss"`` or others."""
        return self._begun(x, t, lambda: self._in_use()[1:3])

    def _begun(self, x: Any, t: float, numbers: Callable[[], tuple[Array, Array]]) -> Motion:
        """The same, with what gives the constants and the inputs of its moves."""
        if not self.STEPS:
            raise ValueError('not compiled: ask for it by compile(..., step="gauss")')
        state = np.array(x, dtype=float)
        if state.shape != (len(self.STATE),):
            raise ValueError(f"expected a state of {len(self.STATE)} numbers")
        if fault := reflection(self._names.blocks, state):
            raise ValueError(f"the state is not on the group: {fault}")
        off = self.defect(state) if self._has("defect") else 0.0
        if not off <= OFF_THE_GROUP:
            raise ValueError(
                f"the state is not on the group, its defect is {off:.3g}: project(x) takes one "
                "that is near it there"
            )
        events = self._names.events
        return Motion(self._library, self.STEPS, events, numbers, state, t)

    def ensemble(
        self,
        x: Any,
        t0: float,
        t1: float,
        tol: float = 1e-9,
        parameters: Any = None,
        h: Any = None,
    ) -> tuple[Array, np.ndarray[Any, np.dtype[np.intc]]]:
        """Many motions at once, from the time t0 to t1; needs ``ensemble=True``.

        ``x`` (n, len(STATE)): where they begin. ``parameters``: for each its own, (n,
        len(PARAMETERS)), or those in use. ``h``: an array (n,) of first steps, 0 for steps of their
        own, which becomes that of the next ones. Returns the states at the end, and for each 0, or
        2 where the equations had no finite value and 3 where the steps became too short, its state
        being the last good one then.
        """
        if not hasattr(self._library, "derive_ensemble"):
            raise ValueError("not compiled: ask for it by compile(..., ensemble=True)")
        states = np.array(x, dtype=float, order="C")
        if states.ndim != 2 or states.shape[1] != len(self.STATE):
            raise ValueError(f"expected rows of {len(self.STATE)} numbers, the states")
        values = self._in_use() if parameters is None else self._values
        k = values.k[None] if parameters is None else self._constants_of(parameters, len(states))
        steps = np.zeros(len(states)) if h is None else h
        status = ensemble(self._library, states, k, values.u[None], (t0, t1), tol, steps)
        return states, status

    def _constants_of(self, parameters: Any, n: int) -> Array:
        """The constants of n bodies, (n, constants); ``ValueError`` for what is no body."""
        rows = np.array(parameters, dtype=float)
        if rows.shape != (n, len(self.PARAMETERS)):
            raise ValueError(f"expected {n} rows of {len(self.PARAMETERS)} parameters")
        found, wrong = constants(self._library, rows, self._names.constants)
        if wrong.any():
            raise ValueError(f"row {wrong.argmax()} of the parameters: no body has these")
        return found

    def step_jacobian(
        self, t: float, x: Any, h: float, u: Any = None, *, n: int = 1, step: str = ""
    ) -> tuple[Array, Array, Array]:
        """The state after n steps of size h from x, on the group, with the inputs held; Φ (2d, 2d)
        and Γ (2d, inputs), what (η, δζ) is there by (η, δζ) at x and by the inputs: derivatives of
        the step itself.

        ``step``: the first of those that are compiled when left out; ``jacobian="step"`` is needed.
        ``StepError`` where there is no such step.
        """
        name = step or next(iter(self.STEPS), "")
        if not hasattr(self._library, f"derive_{name}_jacobian"):
            raise ValueError(
                "not compiled: ask for it by compile(..., step='rk4', jacobian='step'); there are "
                f"derivatives of {', '.join(VARIED)}"
            )
        if n < 1 or not np.isfinite(h):
            raise ValueError(f"expected a number of steps and their size, not n = {n}, h = {h}")
        phi, gamma = np.zeros(self._linear()), np.zeros(self._linear(len(self.INPUTS)))
        k, held = self._in_use().k, self._inputs(u)
        motion = self._begun(x, t, lambda: (k, held))
        return motion.move_varied(h, n, name, phi, gamma).x, phi, gamma


def _read_only(a: Array) -> Array:
    """A view of an array that cannot be written into."""
    view = a.view()
    view.flags.writeable = False
    return view


def _fill(place: Array, values: Any) -> None:
    """Put so many numbers into an array, at once where they fit; ``ValueError`` for others."""
    try:
        place[...] = values
        if len(values) == len(place):
            return
    except (TypeError, ValueError):
        pass  # which is told:
    place[...] = as_array(values, len(place))


def compile(
    problem: Problem | Derived | str | Path,
    parameters: Mapping[str, float] | Sequence[float] | None = None,
    *,
    compiler: str | None = None,
    flags: Sequence[str] = FLAGS,
    **choices: Any,
) -> Compiled:
    """Emit, compile and load the C of a problem.

    ``parameters``: by name or in order; the defaults of the problem where none are given, and
    without a default :meth:`Compiled.use` must be called first.  ``compiler``: else the environment
    variable CC, else cc, gcc or clang.  ``choices``: as ``attitude="quaternion"``, see
    :class:`derive.code.options.Options`.  :class:`CompileError`, ``ProblemError``.
    """
    derived = problem if isinstance(problem, Derived) else derive(problem)
    steps, written = choices.get("step", ()), LANGUAGES["c"].steps
    if not {*((steps,) if isinstance(steps, str) else steps)} <= {*written}:
        raise ProblemError(f"compile: step must be among {', '.join(written)}")
    try:
        options = options_of(choices)
    except ValueError as error:
        raise ProblemError(f"compile: {error}") from None
    if options.real != "double" or options.form != "source":
        raise ProblemError("compile: the library is of double from sources; leave out real, form")
    made_of = program(derived.problem, derived.record, options)
    name = own_prefix(derived.problem.name)
    files = emit(made_of, derived.record, ("c",), name, options)
    files["binding.c"] = BINDING.format(name=name)
    if options.exponential:
        files["group.c"] = group_binding(name, made_of.group_functions)
    if options.moves:
        files["steps.c"] = binding(
            name,
            options.step,
            FIXED,
            ensemble=options.ensemble,
            events=bool(made_of.events),
            varied=varied(options),
        )
    names = Names.of(made_of, options.step, [*derived.problem.parameters])
    source = CSource(name, tuple(files.items()), compiler, tuple(flags))
    if options.ensemble and flags is FLAGS:
        source = over_cores(source)
    made = Compiled(names, source)
    ready = all(x[1] is not None for x in made_of.parameters)
    return made.use(parameters or ()) if parameters is not None or ready else made
