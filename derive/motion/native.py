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
from .signals import InputFunction, LinearSignal

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


InputsInC = ctypes.CFUNCTYPE(
    None, ctypes.c_double, *(ctypes.POINTER(ctypes.c_double),) * 2, ctypes.c_void_p
)
"""A C function of a time, a state, the inputs, which it writes, and data."""


class AskedInputs:
    """A function of Python that C asks for the inputs, of states of a ``size``; ``fault``: what it
    has raised, after which it gives no numbers, so that steps end."""

    def __init__(self, inputs: InputFunction, size: int):
        self.fault: BaseException | None = None

        def write(t: float, x: Any, u: Any, _: Any) -> None:
            try:
                found = [] if self.fault else inputs(t, np.array(x[:size])).tolist()
            except BaseException as fault:  # Ctrl-C as well: it is raised again behind the step
                self.fault, found = fault, []
            if not found:
                u[0] = math.nan
            for i, number in enumerate(found):
                u[i] = number

        self.function = InputsInC(write)


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
        self._asked: AskedInputs | None = None
        self._line: Array | None = None
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

    def hold(self, u: Array | InputFunction) -> None:
        """Make the next moves with other inputs, which may be a function of t and x."""
        k, _ = self._numbers()
        self._line, self._asked = None, None
        if isinstance(u, LinearSignal):
            self._line = np.concatenate([[u.begin], u.values, u.rates])
        elif callable(u):
            self._asked = AskedInputs(u, len(self.x))
        else:
            self._numbers = lambda: (k, u)
        function = self._asked.function if self._asked else InputsInC()
        line = None if self._line is None else pointer(self._line)
        self._function("drive")(self._at, function, line)

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

    def move_varied(self, h: float, n: int, step: str, phi: Array, gamma: Array) -> Motion:
        """The same by a step with derivatives, which are written to phi and gamma, by rows."""
        name, count = f"{self._named(step)}_jacobian", ctypes.c_size_t(n)
        how = ctypes.c_double(h), count, pointer(phi), pointer(gamma)
        return self._taken_to_group(name, *how)

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
        if self._asked and self._asked.fault:
            raise self._asked.fault
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
