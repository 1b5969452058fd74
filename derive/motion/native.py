"""Emitted C at work: compiled by the compiler at hand, loaded, called step by step.

>>> import derive, numpy
>>> f = derive.compile("so3", step="gauss")
>>> m = f.begin(numpy.concatenate([numpy.eye(3).ravel(), [0.1, 0, 9]]))
>>> m.move_to(2.0, tol=1e-12).t
2.0
"""

from __future__ import annotations

import ctypes
import math
import os
import shutil
import subprocess
import sysconfig
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from .first_numbers import MotionError

# Emitted C as a shared library: compiled by the compiler at hand, loaded once.

FLAGS = ("-std=c99", "-O3", "-march=native", "-fPIC", "-shared")


class CompileError(RuntimeError):
    """There is no compiler, or it refused the code: the message says which and why."""


@dataclass(frozen=True)
class CSource:
    """What is compiled: files by name, the compiler (``None``: the one at hand), its flags."""

    name: str
    files: tuple[tuple[str, str], ...]
    compiler: str | None
    flags: tuple[str, ...]


def loaded(source: CSource) -> ctypes.CDLL:
    """The library of a source, compiled once in a process for each compiler; ``CompileError``."""
    return _built(source, _compiler(source.compiler))


def over_cores(source: CSource) -> CSource:
    """The source with OpenMP, where the compiler has that."""
    more = replace(source, flags=(*source.flags, "-fopenmp"))
    try:
        loaded(more)
    except CompileError:
        return source
    return more


@cache
def _built(source: CSource, compiler: str) -> ctypes.CDLL:
    with tempfile.TemporaryDirectory(prefix="derive-") as folder:
        made = compiled_into(Path(folder), source, "the emitted C", compiler)
        return ctypes.CDLL(str(made))  # once it is loaded, its file may go


def compiled_into(folder: Path, source: CSource, what: str, compiler: str | None = None) -> Path:
    """The shared library of a source, made in a folder and not loaded; ``CompileError`` says that
    the compiler refused ``what`` it is."""
    command = [compiler or _compiler(source.compiler), *source.flags]
    for name, text in source.files:
        (folder / name).write_text(text, encoding="utf-8")
    target = folder / f"{source.name}.so"
    command += [*map(str, sorted(folder.glob("*.c"))), "-o", str(target), "-lm"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise CompileError(f"{command[0]} refused {what}: {done.stderr.strip()[:500]}")
    return target


def _compiler(requested: str | None) -> str:
    chosen = requested or os.environ.get("CC", "")
    wanted = [chosen] if chosen else ["cc", "gcc", "clang"]
    found = next((path for path in map(shutil.which, wanted) if path), None)
    if found is None:
        what = f"{chosen!r} is not on the path" if chosen else "no C compiler"
        raise CompileError(f"{what}: install gcc or clang, or name one in CC")
    return found


# The same for a graphics card.

CARD_FLAGS = ("-x", "cu", "-O3", "-arch=native", "-shared", "-Xcompiler", "-fPIC")


def nvcc() -> str | None:
    """CUDA's compiler, on the path or in its Python package."""
    packaged = Path(sysconfig.get_path("purelib")).glob("nvidia/*/bin/nvcc")
    return shutil.which("nvcc") or next(map(str, packaged), None)


def compiler_of_cards() -> str:
    """The same; ``CompileError`` without it, or without a card."""
    found = nvcc()
    if found is None:
        packages = "nvidia-cuda-nvcc nvidia-cuda-runtime"
        raise CompileError(f"no nvcc on the path: install CUDA, or pip install {packages}")
    if not has_card():
        raise CompileError("no card of NVIDIA, or no driver of it: leave out --device")
    return found


def has_card() -> bool:
    """Does the driver of NVIDIA find a card?"""
    try:
        return int(ctypes.CDLL("libcuda.so.1").cuInit(0)) == 0
    except OSError:
        return False


# A motion of compiled C under way: the emitted steps in time, called from Python.

Array = np.ndarray[Any, np.dtype[np.float64]]
Integers = np.ndarray[Any, np.dtype[np.intc]]

INCLUDE = '#include "{name}_steps.h"\n'
HEAD = """\
size_t derive_motion_size(void);
size_t derive_motion_size(void)
{{
    return sizeof({name}_motion);
}}
void derive_begin({name}_motion *m, double t, const double *x);
void derive_begin({name}_motion *m, double t, const double *x)
{{
    {name}_begin(m, t, x);
}}
void derive_dense(const {name}_motion *m, double t, double *x);
void derive_dense(const {name}_motion *m, double t, double *x)
{{
    {name}_dense(m, t, x);
}}
void derive_now(const {name}_motion *m, double *now, double *x);
void derive_now(const {name}_motion *m, double *now, double *x)
{{
    now[0] = m->t;
    now[1] = m->t_low;
    now[2] = m->h;
    now[3] = (double)m->evaluations;
    memcpy(x, m->x, sizeof m->x);
}}
"""
EVENT = """\
int derive_event(const {name}_motion *m, int *rising);
int derive_event(const {name}_motion *m, int *rising)
{{
    *rising = m->rising;
    return m->event;
}}
"""
MOVE = """\
void derive_{step}({name}_motion *m, const double *k, const double *u, double h, size_t n,
    int *told);
void derive_{step}({name}_motion *m, const double *k, const double *u, double h, size_t n,
    int *told)
{{
    *told = {name}_{step}(m, k, u, h, n);
}}
"""
MOVE_TO_EVENT = """\
void derive_{step}_to({name}_motion *m, const double *k, const double *u, double t1, double tol,
    int *told);
void derive_{step}_to({name}_motion *m, const double *k, const double *u, double t1, double tol,
    int *told)
{{
    *told = {name}_{step}_to(m, k, u, t1, tol);
}}
"""
MOVE_TO = """\
void derive_{step}_to({name}_motion *m, const double *k, const double *u, double t1, double tol,
    size_t n, int *told);
void derive_{step}_to({name}_motion *m, const double *k, const double *u, double t1, double tol,
    size_t n, int *told)
{{
    int fault = {name}_{step}(m, k, u, 0, 0); /* dense asks for the numbers of a call */
    for (; fault == 0 && n > 0 && t1 - m->t - m->t_low != 0; --n) {{
        fault = {name}_towards({name}_{step}_step, m, k, u, t1, tol);
    }}
    *told = fault;
}}
"""
WATCH = """\
void derive_{step}_watch({name}_motion *m, const double *k, const double *u, double t1, double h,
    int *told);
void derive_{step}_watch({name}_motion *m, const double *k, const double *u, double t1, double h,
    int *told)
{{
    *told = {name}_watch({name}_{step}, m, k, u, t1, h);
}}
"""
ENSEMBLE = """\
size_t derive_ensemble(size_t n, double *x, const double *k, size_t k_each, const double *u,
    size_t u_each, double t0, double t1, double tol, double *h, int *status);
size_t derive_ensemble(size_t n, double *x, const double *k, size_t k_each, const double *u,
    size_t u_each, double t0, double t1, double tol, double *h, int *status)
{{
    return {name}_ensemble(n, x, k, k_each, u, u_each, t0, t1, tol, h, status);
}}
"""
ENDED = """\
void derive_ensemble(size_t n, double *x, const double *k, size_t k_each, const double *u,
    size_t u_each, double t0, double t1, double tol, double *h, int *status, double *ended);
void derive_ensemble(size_t n, double *x, const double *k, size_t k_each, const double *u,
    size_t u_each, double t0, double t1, double tol, double *h, int *status, double *ended)
{{
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic)
#endif
    for (long long j = 0; j < (long long)n; ++j) {{
        const size_t i = (size_t)j;
        {name}_motion m;
        {name}_begin(&m, t0, x + i*{name}_N_STATE);
        m.h_next = h[i];
        status[i] = {name}_{step}_to(&m, k + i*k_each, u + i*u_each, t1, tol);
        status[i] += status[i] == {name}_EVENT ? m.event : 0;
        memcpy(x + i*{name}_N_STATE, m.x, sizeof m.x);
        h[i] = m.h_next;
        ended[i] = m.t;
    }}
}}
"""
ON_CARD = """\
const char *derive_ensemble_on_card(size_t n, double *x, const double *k, size_t k_each,
    const double *u, size_t u_each, double t0, double t1, double tol, double *h, int *status)
{{
    const int fault = {name}_ensemble_device(n, x, k, k_each, u, u_each, t0, t1, tol, h, status);
    return fault ? cudaGetErrorString((cudaError_t)fault) : 0;
}}
"""
CONSTANTS = """\
void derive_constants(size_t n, const double *p, double *k, int *wrong);
void derive_constants(size_t n, const double *p, double *k, int *wrong)
{{
    for (size_t i = 0; i < n; ++i) {{
        wrong[i] = {name}_constants(p + i*{name}_N_PARAMETERS, k + i*{name}_N_CONSTANTS);
    }}
}}
"""


def binding(
    name: str,
    steps: Sequence[str],
    fixed: Sequence[str] = (),
    *,
    ensemble: bool = False,
    events: bool = False,
) -> str:
    """C that makes functions of a library of the inline functions of a header of steps; those that
    are ``fixed`` have no size of their own; are there ``events``?"""
    every, to = ((MOVE, WATCH), MOVE_TO_EVENT) if events else ((MOVE,), MOVE_TO)
    moves = [text.format(name=name, step=x) for x in steps for text in every]
    moves += [to.format(name=name, step=x) for x in steps if x not in fixed]
    parts = [INCLUDE, HEAD * bool(steps), EVENT * events, (ENSEMBLE + CONSTANTS) * ensemble]
    return "\n".join([*(x.format(name=name) for x in parts if x), *moves])


def binding_to_events(name: str, step: str) -> str:
    """The same of an ensemble whose motions end at their events, by one of those steps."""
    return "\n".join(x.format(name=name, step=step) for x in (INCLUDE, ENDED, CONSTANTS))


def binding_on_card(name: str) -> str:
    """The same of an ensemble on a graphics card, in CUDA."""
    parts = INCLUDE, 'extern "C" {{\n', ON_CARD, CONSTANTS, "}}\n"
    return "".join(x.format(name=name) for x in parts)


FAULTS = {
    2: "the equations have no finite value at t = {:.9g}",
    5: "there is no discrete step of this size at t = {:.9g}: take a smaller one "
    "(a turn needs h|ζ| of at most about 1 rad)",
    3: "the steps become too short at t = {:.9g}: a collision, or a motion without bound",
}
"""What a step returns → why there is no next state, at a time."""

AT_EVENT = 4
"""What a motion up to a time returns at an event before that."""


MANY = 100_000
"""The most steps of one call: Ctrl-C is heard between calls."""


class StepError(ArithmeticError):
    """There is no next state of a motion: the message says when and why."""


class Motion:
    """A motion under way: ``t``, the state ``x``, ``h``, the last step, and ``evaluations``, how
    often its stages have asked for the rates.

    ``steps``: those of the library, a motion of which this is; ``numbers``: the constants and the
    inputs of the next move.  Where there is no next state, ``StepError``, and it is as it was after
    the last good step.  ``event``: the name of that at which it stands, else ""; ``rising``: is it
    reached from below?
    """

    def __init__(
        self,
        library: ctypes.CDLL,
        steps: Sequence[str],
        events: Sequence[str],
        numbers: Callable[[], tuple[Array, Array]],
        x: Array,
        t: float,
    ):
        self._library, self._steps, self._numbers = library, steps, numbers
        self._events, self.event, self.rising = events, "", False
        self.t, self.h, self.x = float(t), 0.0, np.array(x, dtype=float)
        self._t_low, self.evaluations, self._status = 0.0, 0, ctypes.c_int()
        self._ask_for_memory()
        self._function("begin")(self._at, ctypes.c_double(t), pointer(self.x))

    def _ask_for_memory(self) -> None:
        self._size = self._function("motion_size", ctypes.c_size_t)()
        self._memory = ctypes.create_string_buffer(self._size + 64)
        self._at = ctypes.c_void_p((ctypes.addressof(self._memory) + 63) & ~63)

    def __copy__(self) -> Motion:
        """The motion as it is now, whatever becomes of this one."""
        other = object.__new__(type(self))
        other.__dict__ |= self.__dict__ | {"x": self.x.copy(), "_status": ctypes.c_int()}
        other._ask_for_memory()
        ctypes.memmove(other._at, self._at, self._size)
        return other

    def hold(self, u: Array) -> None:
        """Make the next moves with other inputs."""
        k, _ = self._numbers()
        self._numbers = lambda: (k, u)

    def left(self, t: float) -> float:
        """The time up to another, in as many digits as the motion has."""
        return t - self.t - self._t_low

    def move(self, h: float, n: int = 1, step: str = "") -> Motion:
        """Make n steps of size h, by the first of the emitted steps or the one that is named."""
        if n < 0 or not math.isfinite(h):
            raise ValueError(f"expected a number of steps and their size, not n = {n}, h = {h}")
        for first in range(0, n, MANY):
            count = ctypes.c_size_t(min(MANY, n - first))
            self._taken_to_group(self._named(step), ctypes.c_double(h), count)
        return self

    def move_to(self, t: float, tol: float = 1e-9, step: str = "") -> Motion:
        """Move up to a time, or to an event before it, in steps of their own size for a tolerance;
        the same call again goes on from an event."""
        require_tolerance(tol)
        name = self._named(step)
        if not hasattr(self._library, f"derive_{name}_to"):
            raise ValueError(f"{name} has steps of a fixed size: call move()")
        how = ctypes.c_double(t), ctypes.c_double(tol)
        if self._events:
            return self._taken_to_group(f"{name}_to", *how)
        while self.left(t):
            self._taken_to_group(f"{name}_to", *how, ctypes.c_size_t(MANY))
        return self

    def watch(self, t: float, h: float, step: str = "") -> Motion:
        """Make steps of size h, the last one shorter where that is left, up to a time or an event
        before it; the same call again goes on from an event, to where its step ends without it."""
        if not self._events:
            raise ValueError("the problem has no [[event]]: call move()")
        if not (math.isfinite(t) and 0 < h < math.inf):
            raise ValueError(f"expected a time and the size of a step, not t = {t}, h = {h}")
        return self._taken_to_group(
            f"{self._named(step)}_watch", ctypes.c_double(t), ctypes.c_double(h)
        )

    def dense(self, t: float) -> Array:
        """The state at a time within the last step, by the polynomial of its method."""
        out = np.empty_like(self.x)
        self._function("dense")(self._at, ctypes.c_double(t), pointer(out))
        return out

    def _named(self, step: str) -> str:
        steps = self._steps
        if (step or steps[0]) not in steps:
            raise ValueError(f"no step {step[:40]!r} was compiled; there is {', '.join(steps)}")
        return step or steps[0]

    def _taken_to_group(self, name: str, *how: Any) -> Motion:
        k, u = map(pointer, self._numbers())
        self._status = ctypes.c_int()
        self._function(name)(self._at, k, u, *how, ctypes.byref(self._status))
        self.settle()
        if (status := self._status.value) not in (0, AT_EVENT):
            raise StepError(FAULTS[status].format(self.t))
        return self

    def settle(self) -> None:
        """Be where the last call of C has led, also after one that Ctrl-C has cut off from here:
        it is heard when that call is over."""
        now = np.empty(4)
        self._function("now")(self._at, pointer(now), pointer(self.x))
        self.t, self._t_low, self.h, evaluations = now.tolist()
        self.evaluations = int(evaluations)
        self.event = ""
        if self._status.value == AT_EVENT:
            rising = ctypes.c_int()
            found = self._function("event", ctypes.c_int)(self._at, ctypes.byref(rising))
            self.event, self.rising = self._events[found], bool(rising.value)

    def _function(self, name: str, result: Any = None) -> Any:
        function = getattr(self._library, f"derive_{name}")
        function.restype = result
        return function


def require_tolerance(tol: float) -> None:
    """``ValueError`` for what is none."""
    if not 0 < tol < math.inf:
        raise ValueError(f"tol must be positive, the error of a step as 1e-9, not {tol}")


def pointer(a: np.ndarray[Any, Any]) -> Any:
    """Where the numbers of an array are."""
    return ctypes.c_void_p(a.ctypes.data)


def constants(library: ctypes.CDLL, p: Array, size: int) -> tuple[Array, Integers]:
    """The constants (n, size) of n bodies by their parameters, and for each whether there is no
    such body."""
    found, wrong = np.zeros((len(p), size)), np.zeros(len(p), dtype=np.intc)
    library.derive_constants.restype = None
    library.derive_constants(ctypes.c_size_t(len(p)), pointer(p), pointer(found), pointer(wrong))
    return found, wrong


def ensemble(
    library: ctypes.CDLL,
    x: Array,
    k: Array,
    u: Array,
    span: tuple[float, float],
    tol: float,
    h: Array,
    *ended: Array,
) -> Integers:
    """The status of each of n motions, which are moved from one time to another; x (n, state) and h
    (n,), their next steps, are written into, and so is, where they end at events, the time (n,)
    when they did; k and u, one row for all or for each its own.  AT_EVENT + k: at event k.
    ``MotionError`` for what a graphics card cannot do."""
    require_tolerance(tol)
    n, status = len(x), np.zeros(len(x), dtype=np.intc)
    each = [ctypes.c_size_t(a.shape[1] if len(a) == n and n > 1 else 0) for a in (k, u)]
    times = map(ctypes.c_double, (*span, tol))
    on_card = hasattr(library, "derive_ensemble_on_card")
    function = library.derive_ensemble_on_card if on_card else library.derive_ensemble
    function.restype = ctypes.c_char_p if on_card else None
    numbers = (pointer(k), each[0], pointer(u), each[1], *times)
    told = [pointer(h), pointer(status), *map(pointer, ended)]
    if fault := function(ctypes.c_size_t(n), pointer(x), *numbers, *told):
        raise MotionError(f"the graphics card: {fault.decode()}: leave out --device")
    return status
