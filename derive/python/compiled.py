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
from typing import Any, NamedTuple

import numpy as np

from ..code.emit import emit
from ..code.group_functions import GroupFunctions
from ..code.languages import LANGUAGES
from ..code.naming import own_prefix
from ..code.options import ADDED, options_of
from ..code.program import Block, Program
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
from . import on_the_group
from .derived import Derived, derive
from .on_the_group import OnTheGroup
from .simulated import InMomenta

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


class Names(NamedTuple):
    """The names of a program's numbers, and the counts of constants and of coordinates of 𝔤."""

    state: tuple[str, ...]
    inputs: tuple[str, ...]
    conserved: tuple[str, ...]
    outputs: tuple[str, ...]
    events: tuple[str, ...]
    defaults: dict[str, float | None]
    steps: tuple[str, ...]
    constants: int
    algebra: int
    reduced: int
    unread: tuple[str, ...]
    blocks: tuple[Block, ...]
    matrix_state: tuple[str, ...]
    matrix_blocks: tuple[Block, ...]
    group: GroupFunctions | None

    @classmethod
    def of(
        cls, program: Program, steps: tuple[str, ...] = (), declared: Sequence[str] = ()
    ) -> Names:
        """The names of a program, of the steps that are emitted with it, and of the parameters
        that a problem has ``declared`` and the program does not read."""
        defaults = {x[0]: x[1] for x in program.parameters}
        sizes = len(program.constants), program.dimension, program.reduced
        events = tuple(x.name for x in program.events)
        named = program.state, program.inputs, program.conserved, program.outputs, events
        unread = tuple(x for x in declared if x not in defaults)
        matrices = program.matrix_state, program.matrix_blocks
        group = program.group_functions
        return cls(*named, defaults, steps, *sizes, unread, program.blocks, *matrices, group)


class CompiledValues(NamedTuple):
    """The numbers that stay from call to call: parameters, constants, inputs. They are replaced as
    a whole: a call under way keeps those that it has."""

    p: Array
    k: Array
    u: Array
    ready: bool


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


class Compiled(InMomenta, OnTheGroup):
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

    def _in_use(self) -> CompiledValues:
        """The numbers in use; ``ValueError`` where parameters have no value yet."""
        values = self._values
        if not values.ready:
            missing = [name for name, value in self._names.defaults.items() if value is None]
            which = ", ".join(missing)
            raise ValueError(f"no value for the parameters {which}: call use() first")
        return values

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
        u = _array(values, len(self.INPUTS))
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

    def energy(self, t: float, x: Any) -> float:
        """The energy at time t in state x: kinetic plus potential."""
        return float(self._call_at("energy", ctypes.c_double, t, x, self._in_use().k))

    def multiplier(self, t: float, x: Any, u: Any = None) -> float:
        """The multiplier θ of the volume; needs ``multiplier=True``."""
        k = self._in_use().k
        return float(self._call_at("multiplier", ctypes.c_double, t, x, k, self._inputs(u)))

    def conserved(self, t: float, x: Any) -> Array:
        """What the motion keeps where no input acts, by the names of ``CONSERVED``."""
        out = np.zeros(len(self.CONSERVED))
        self._call_at("conserved", None, t, x, self._in_use().k, out)
        return out

    def outputs(self, t: float, x: Any, u: Any = None) -> Array:
        """What is read off the motion, by the names of ``OUTPUTS``."""
        out = np.zeros(len(self.OUTPUTS))
        self._call_at("outputs", None, t, x, self._in_use().k, self._inputs(u), out)
        return out

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

    def jacobian(self, t: float, x: Any, u: Any = None) -> tuple[Array, Array]:
        """dx/dt, and the (2d, 2d) matrix D of the equations linearised in the state."""
        k, dx, D = self._in_use().k, np.zeros(len(self.STATE)), self._zeros()
        self._call_at("jacobian", None, t, x, k, self._inputs(u), dx, D)
        return dx, D

    def jacobian_inputs(self, t: float, x: Any, u: Any = None) -> Array:
        """The (2d, inputs) matrix D of the linearised equations in the inputs."""
        k, D = self._in_use().k, self._zeros(len(self.INPUTS))
        self._call_at("jacobian_inputs", None, t, x, k, self._inputs(u), D)
        return D

    def jacobian_parameters(self, t: float, x: Any, u: Any = None) -> Array:
        """The (2d, parameters) matrix D of the linearised equations in the parameters."""
        p, D = self._in_use().p, self._zeros(len(self.PARAMETERS))
        self._call_at("jacobian_parameters", None, t, x, p, self._inputs(u), D)
        return D

    def jacobian_raw(self, t: float, x: Any, u: Any = None) -> Array:
        """The derivative of dx/dt by x as it is stored, (len(STATE), len(STATE)), for the
        ``jac`` of ``solve_ivp``."""
        k, size = self._in_use().k, len(self.STATE)
        D = np.zeros((size, size))
        self._call_at("jacobian_raw", None, t, x, k, self._inputs(u), D)
        return D

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
        phi, gamma = self._zeros(), self._zeros(len(self.INPUTS))
        k, held = self._in_use().k, self._inputs(u)
        motion = self._begun(x, t, lambda: (k, held))
        return motion.move_varied(h, n, name, phi, gamma).x, phi, gamma

    def mass_matrix(self, t: float, x: Any) -> Array:
        """The mass matrix, (d, d) in the basis of the velocity; needs ``dynamics=True``."""
        d = self._names.algebra
        M = np.zeros((d, d))
        self._call_at("mass_matrix", None, t, x, self._in_use().k, M)
        return M

    def inverse(self, t: float, x: Any, rates: Any) -> Array:
        """The covector Q, (d,), that the inputs must supply for the velocity to have these rates,
        (d,); needs ``dynamics=True``."""
        Q = np.zeros(d := self._names.algebra)
        self._call_at("inverse", None, t, x, self._in_use().k, _array(rates, d), Q)
        return Q

    def jacobian_outputs(self, t: float, x: Any, u: Any = None) -> tuple[Array, Array]:
        """C and D: the derivatives of the outputs, (len(OUTPUTS), 2d) by (η, δζ), and
        (len(OUTPUTS), len(INPUTS)) by the inputs; needs ``jacobian="outputs"``."""
        k, count = self._in_use().k, len(self.OUTPUTS)
        C, D = np.zeros((count, 2 * self._names.algebra)), np.zeros((count, len(self.INPUTS)))
        self._call_at("jacobian_outputs", None, t, x, k, self._inputs(u), C)
        if self.INPUTS:
            self._call_at("jacobian_outputs_inputs", None, t, x, k, self._inputs(u), D)
        return C, D

    def _inputs(self, u: Any) -> Array:
        return self._values.u if u is None else _array(u, len(self.INPUTS))

    def _zeros(self, columns: int | None = None) -> Array:
        rows = 2 * self._names.algebra
        return np.zeros((rows, rows if columns is None else columns))

    def project(self, x: Any) -> Array:
        """The state x taken back to the group by one Newton step; see the emitted header."""
        given, out = _array(x, len(self.STATE)), np.zeros(len(self.STATE))
        self._function("project", None)(*map(pointer, (given, out)))
        return out

    def defect(self, x: Any) -> float:
        """How far the state x is off the group: 0 on it."""
        function = self._function("defect", ctypes.c_double)
        return float(function(pointer(_array(x, len(self.STATE)))))

    def to_matrix(self, x: Any) -> Array:
        """The state x with matrices, row by row, for its quaternions and angles; needs an
        ``attitude``, as ``attitude="quaternion"``."""
        return self._exchanged("to_matrix", x, len(self.STATE), len(self._names.matrix_state))

    def from_matrix(self, z: Any) -> Array:
        """The state z with the quaternions of its rotations, their scalars not negative; where x
        has an angle, how often it went round is not in z, and there is no such function."""
        size, blocks = len(self._names.matrix_state), self._names.matrix_blocks
        if self._has("from_matrix") and (fault := reflection(blocks, _array(z, size))):
            raise ValueError(fault)
        return self._exchanged("from_matrix", z, size, len(self.STATE))

    def _exchanged(self, what: str, x: Any, size: int, found: int) -> Array:
        """What the C function ``what`` makes of so many numbers, so many others."""
        function, given, out = self._function(what, None), _array(x, size), np.zeros(found)
        function(*map(pointer, (given, out)))
        return out

    def into_frame(self, x: Any) -> Array:
        """The state x taken to the principal frame; needs ``frame="principal"``."""
        return self._change_frame("into_frame", x, len(self.STATE))

    def out_of_frame(self, x: Any) -> Array:
        """The state x taken back from the principal frame."""
        return self._change_frame("out_of_frame", x, len(self.STATE))

    def inputs_into_frame(self, u: Any) -> Array:
        """The inputs u taken to the principal frame."""
        return self._change_frame("inputs_into_frame", u, len(self.INPUTS))

    def inputs_out_of_frame(self, u: Any) -> Array:
        """The inputs u taken back from the principal frame."""
        return self._change_frame("inputs_out_of_frame", u, len(self.INPUTS))

    def _in_momenta(self, what: str, t: float, x: Any, u: Any, out: Array) -> int:
        by_newton = what in ("velocity", "momentum_rhs") and self._has("velocity_step")
        driven = [self._inputs(u)] if what == "momentum_rhs" else []
        result = ctypes.c_int if by_newton else None
        return self._call_at(what, result, t, x, self._in_use().k, *driven, out) or 0

    def _on_the_group(self, what: str, *given: Any) -> Array:
        function = getattr(self._library, f"derive_{what}", None)
        known, d = self._names.group, self._names.algebra
        if known is None or function is None:
            raise ValueError("not compiled: ask for it by compile(..., exponential=True)")
        takes, writes = known.functions[what]
        out = np.zeros((d, d) if writes == "J" else known.count(what, writes))
        arrays = [_array(x, known.count(what, a)) for a, x in zip(takes, given, strict=True)]
        function(*map(pointer, (*arrays, out)))
        return out

    def _has(self, what: str) -> bool:
        return hasattr(self._library, f"{self._source.name}_{what}")

    def _change_frame(self, what: str, x: Any, size: int) -> Array:
        """A state or an input taken from one frame to another by the C function ``what``."""
        k, given, out = self._in_use().k, _array(x, size), np.zeros(size)
        self._function(what, None)(*map(pointer, (given, k, out)))
        return out

    def _call_at(self, what: str, result: Any, t: float, x: Any, *arrays: Array) -> Any:
        """The result of a C function of the time, the state and more arrays."""
        state, function = _array(x, len(self.STATE)), self._function(what, result)
        return function(ctypes.c_double(t), *map(pointer, (state, *arrays)))

    def _function(self, what: str, result: Any) -> Any:
        """A C function of the library; ``ValueError`` says how to have it compiled."""
        function = getattr(self._library, f"{self._source.name}_{what}", None)
        if function is None and what.endswith("_frame"):
            raise ValueError("not compiled: ask for it by compile(..., frame='principal')")
        if function is None and what == "inverse" and self._has("bias"):
            raise ValueError("an input is divided by: there are no rates without it to start from")
        if function is None and what in ("mass_matrix", "inverse"):
            raise ValueError("not compiled: ask for it by compile(..., dynamics=True)")
        if function is None and "outputs" in what and not self.OUTPUTS:
            raise ValueError(
                f"{self._source.name} has no [[output]] tables: nothing is read off it"
            )
        if function is None and what.startswith("jacobian_outputs"):
            raise ValueError("not compiled: ask for it by compile(..., jacobian=['outputs'])")
        if function is None and what == "from_matrix" and self._names.matrix_state:
            raise ValueError("an angle counts turns, which a matrix does not tell: give x yourself")
        if function is None and what.endswith("_matrix"):
            raise ValueError("not compiled: ask for it by compile(..., attitude='quaternion')")
        if function is None and what in ("momentum", "velocity", "momentum_rhs", "poisson"):
            raise ValueError("not compiled: ask for it by compile(..., momenta=True)")
        if function is None and what in ("project", "defect"):
            raise ValueError(f"nothing keeps the states of {self._source.name}: there is no {what}")
        if function is None and what in ADDED:
            raise ValueError(f"not compiled: ask for it by compile(..., {what}=True)")
        if function is None:
            kind = what.removeprefix("jacobian").removeprefix("_") or "state"
            raise ValueError(f"not compiled: ask for it by compile(..., jacobian=[{kind!r}])")
        function.restype = result
        return function


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
    place[...] = _array(values, len(place))


def _array(values: Any, size: int) -> Array:
    """A new array of ``size`` numbers; ``ValueError`` for others."""
    made = np.array(values, dtype=float)
    if made.shape != (size,) and (size, made.shape) != (1, ()):
        found = f"an array {made.shape}" if made.ndim > 1 else f"{made.size}"
        raise ValueError(f"expected {size} numbers, not {found}")
    return made.reshape(size)


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
        files["group.c"] = on_the_group.binding(name, made_of.group_functions)
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
