"""The emitted C of a problem, compiled and loaded: a right-hand side for ``solve_ivp``.

>>> import derive, numpy
>>> f = derive.compile("so3")
>>> f(0.0, numpy.concatenate([numpy.eye(3).ravel(), [0.1, 0, 9]])).shape
(12,)
"""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .code.emit import emit
from .code.options import CHOICES, Options
from .code.program import Program
from .derived import Derived, derive
from .mechanics.problem import Problem, ProblemError
from .pipeline import program
from .writing import write

FLAGS = ("-std=c99", "-O3", "-march=native", "-fPIC", "-shared")
Array = np.ndarray[Any, np.dtype[np.float64]]


class CompileError(RuntimeError):
    """No compiler, or one that refused: the message says which and why."""


BUFFERS = ("t", "x", "k", "u", "dx")
BINDING = """\
#include "{name}.h"
double derive_t[1], derive_x[{name}_N_STATE], derive_k[{name}_N_CONSTANTS + 1];
double derive_u[{name}_N_INPUTS + 1], derive_dx[{name}_N_STATE];
void derive_rhs(void);
void derive_rhs(void)
{{
    {name}_rhs(derive_t[0], derive_x, derive_k, derive_u, derive_dx);
}}
"""
"""What is compiled beside the emitted C: buffers that a call from Python need not pass."""


class Compiled:
    """The functions of one problem in compiled C, for one body; itself dx/dt = f(t, x).

    ``STATE``, ``PARAMETERS``, ``INPUTS``: names; ``p`` and ``k``: parameters and constants in use;
    ``u``: the inputs in use, zero at first.  Each call fills buffers of
    this object and returns a copy: give each thread its own.
    """

    def __init__(self, program: Program, library: ctypes.CDLL, name: str):
        self.STATE, self.INPUTS = program.state, program.inputs
        self.PARAMETERS = tuple(x[0] for x in program.parameters)
        self._library, self._name = library, name
        self._defaults = {x[0]: x[1] for x in program.parameters}
        self._algebra = program.dimension
        sizes = (1, len(self.STATE), len(program.constants), len(self.INPUTS), len(self.STATE))
        views = (self._view(x, n) for x, n in zip(BUFFERS, sizes, strict=True))
        self._t, self._x, self.k, self._u, self._dx = views
        self.p = np.zeros(len(self.PARAMETERS))
        self.rhs: Callable[[float, Any], Array] = self._unready

    def __call__(self, t: float, x: Any) -> Array:
        """dx/dt."""
        return self.rhs(t, x)

    @property
    def u(self) -> Array:
        """The inputs: write into it, or assign to it, between calls."""
        return self._u

    @u.setter
    def u(self, values: Any) -> None:
        self._u[:] = values

    def _unready(self, t: float, x: Any) -> Array:
        missing = [name for name, value in self._defaults.items() if value is None]
        raise ValueError(f"no value for the parameters {', '.join(missing)}: call use() first")

    def use(self, parameters: Mapping[str, float] | Sequence[float] = ()) -> Compiled:
        """Take these parameters, the defaults for the others; ``ValueError`` says what is wrong."""
        if isinstance(parameters, Mapping):
            named = dict(parameters)
        else:
            if len(parameters) not in (0, len(self.PARAMETERS)):
                raise ValueError(f"expected {len(self.PARAMETERS)} parameters in order, or names")
            named = dict(zip(self.PARAMETERS, parameters, strict=False))
        unknown = [x for x in named if x not in self._defaults]
        values = {**self._defaults, **named}
        missing = [x for x, value in values.items() if value is None]
        if unknown or missing:
            what = "unknown" if unknown else "no value for the"
            raise ValueError(f"{what} parameters {', '.join(unknown or missing)}")
        p, k = np.array([values[x] for x in self.PARAMETERS], dtype=float), np.zeros_like(self.k)
        if self._function("constants", ctypes.c_int)(*map(_pointer, (p, k))):
            raise ValueError(
                "no body has these parameters: its mass matrix is not positive, or a number is "
                "not finite"
            )
        self.p[:], self.k[:] = p, k
        self.rhs = self._bound_rhs()
        return self

    def energy(self, t: float, x: Any) -> float:
        """Kinetic plus potential energy."""
        return float(self._called("energy", ctypes.c_double, t, x, self.k))

    def jacobian(self, t: float, x: Any) -> tuple[Array, Array]:
        """dx/dt and D (2N, 2N); see the emitted header."""
        D = np.zeros((2 * self._algebra, 2 * self._algebra))
        self._called("jacobian", None, t, x, self.k, self.u, self._dx, D)
        return self._dx.copy(), D

    def jacobian_inputs(self, t: float, x: Any) -> Array:
        """D (2N, inputs)."""
        D = np.zeros((2 * self._algebra, len(self.INPUTS)))
        self._called("jacobian_inputs", None, t, x, self.k, self.u, D)
        return D

    def jacobian_parameters(self, t: float, x: Any) -> Array:
        """D (2N, parameters)."""
        D = np.zeros((2 * self._algebra, len(self.PARAMETERS)))
        self._called("jacobian_parameters", None, t, x, self.p, self.u, D)
        return D

    def into_frame(self, x: Any) -> Array:
        """The state x taken to the principal frame; needs ``frame="principal"``."""
        return self._carried("into_frame", x, len(self.STATE))

    def out_of_frame(self, x: Any) -> Array:
        """The state x taken back from the principal frame."""
        return self._carried("out_of_frame", x, len(self.STATE))

    def inputs_into_frame(self, u: Any) -> Array:
        """The inputs u taken to the principal frame."""
        return self._carried("inputs_into_frame", u, len(self.INPUTS))

    def inputs_out_of_frame(self, u: Any) -> Array:
        """The inputs u taken back from the principal frame."""
        return self._carried("inputs_out_of_frame", u, len(self.INPUTS))

    def _carried(self, what: str, x: Any, size: int) -> Array:
        if self.rhs == self._unready:
            self._unready(0.0, x)
        given, out = np.zeros(size), np.zeros(size)
        given[:] = x
        self._function(what, None)(*map(_pointer, (given, self.k, out)))
        return out

    def _called(self, what: str, result: Any, t: float, x: Any, *arrays: Array) -> Any:
        """A function of the time, the state and more arrays."""
        if self.rhs == self._unready:
            self._unready(t, x)
        self._x[:] = x
        function = self._function(what, result)
        return function(ctypes.c_double(t), *map(_pointer, (self._x, *arrays)))

    def _view(self, name: str, size: int) -> Array:
        return np.ctypeslib.as_array(
            (ctypes.c_double * size).in_dll(self._library, f"derive_{name}")
        )

    def _function(self, what: str, result: Any) -> Any:
        function = getattr(self._library, f"{self._name}_{what}", None)
        if function is None and what.endswith("_frame"):
            raise ValueError("not compiled: ask for it by compile(..., frame='principal')")
        if function is None:
            kind = what.removeprefix("jacobian").removeprefix("_") or "state"
            raise ValueError(f"not compiled: ask for it by compile(..., jacobian=[{kind!r}])")
        function.restype = result
        return function

    def _bound_rhs(self) -> Callable[[float, Any], Array]:
        """rhs on the buffers: a call copies the state in and the rates out."""
        run = self._library.derive_rhs
        run.restype = None
        now, here, copy = self._t, self._x, self._dx.copy

        def rhs(t: float, x: Any) -> Array:
            """dx/dt."""
            now[0] = t
            here[:] = x
            run()
            return copy()

        return rhs


def _pointer(a: Array) -> ctypes.c_void_p:
    return ctypes.c_void_p(a.ctypes.data)


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
    try:
        options = Options(**choices)
    except TypeError:
        known = (*CHOICES, "jacobian")
        wrong = ", ".join(x for x in choices if x not in known)
        raise ProblemError(f"compile: no choice {wrong}; there are {', '.join(known)}") from None
    except ValueError as error:
        raise ProblemError(f"compile: {error}") from None
    if options.real != "double" or options.form != "source":
        raise ProblemError("compile: the library is of double from sources; leave out real, form")
    made_of = program(derived.problem, derived.record, options)
    name = derived.problem.name
    with tempfile.TemporaryDirectory(prefix="derive-") as folder:
        files = emit(made_of, derived.record, ("c",), name, options)
        write(files | {"binding.c": BINDING.format(name=name)}, Path(folder))
        library = _built(Path(folder), name, compiler, flags)
    made = Compiled(made_of, library, name)
    ready = all(x[1] is not None for x in made_of.parameters)
    return made.use(parameters or ()) if parameters is not None or ready else made


def _built(folder: Path, name: str, compiler: str | None, flags: Sequence[str]) -> ctypes.CDLL:
    """The shared library; once it is loaded, its file may go."""
    chosen = compiler or os.environ.get("CC", "")
    wanted = [chosen] if chosen else ["cc", "gcc", "clang"]
    found = next((path for path in map(shutil.which, wanted) if path), None)
    if found is None:
        what = f"{chosen!r} is not on the path" if chosen else "no C compiler"
        raise CompileError(f"{what}: install gcc or clang, or name one in CC")
    target = folder / f"{name}.so"
    sources = map(str, sorted(folder.glob("*.c")))
    command = [found, *flags, *sources, "-o", str(target), "-lm"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise CompileError(f"{found} refused the emitted C: {done.stderr.strip()[:500]}")
    return ctypes.CDLL(str(target))
