"""Compiles an implementation, checks it and times it, one state after the other.

The function timed and the loop that calls it are in translation units of their own, without
optimisation across them: every evaluation is a call, as in a program that links the code.
"""

from __future__ import annotations

import ctypes
import hashlib
import shutil
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from .cases import Array, command

LEVEL = ("-O3", "-march=native")
FLAGS = ["-ffp-contract=off", "-fno-semantic-interposition", "-DNDEBUG"]
STANDARDS = {".c": "-std=c99", ".cpp": "-std=c++17"}
PLAIN = "void {0}(const double *x, const double *k, double *dx);"

LOOP = """#include <stddef.h>
#ifdef __cplusplus
extern "C" {{
#endif
{prototype}
void repeat(long rounds, size_t n, const double *x, const double *k, double *dx)
{{
    for (long round = 0; round < rounds; ++round) {{
        for (size_t i = 0; i < n; ++i) {{
            const double *xi = x + {inputs}*i;
            double *di = dx + {outputs}*i;
            {call};
        }}
    }}
}}
{many}
#ifdef __cplusplus
}}
#endif
"""
MANY = """
{prototype}
void repeat_batch(long rounds, size_t n, const double *x, const double *k, double *dx)
{{
    for (long round = 0; round < rounds; ++round) {{
        {call};
    }}
}}
"""


def pointer(array: Array) -> ctypes.c_void_p:
    """The address of the numbers."""
    return ctypes.c_void_p(array.ctypes.data)


def aligned(shape: int | tuple[int, ...]) -> Array:
    """Zeros from the start of a line of cache, of a page too where there are many."""
    size = int(np.prod(shape))
    raw = np.zeros(size + 512)
    start = (-raw.ctypes.data % 4096) // 8
    return raw[start : start + size].reshape(shape)


@dataclass(frozen=True)
class Build:
    """A compiler of C and its level of optimisation; C++ is compiled by g++."""

    compiler: str = "gcc"
    level: tuple[str, ...] = LEVEL

    def __str__(self) -> str:
        return " ".join([self.compiler, *self.level])

    def command(self, source: Path) -> list[str]:
        """What compiles a source."""
        compiler = self.compiler if source.suffix == ".c" else "g++"
        return [compiler, STANDARDS[source.suffix], *self.level, *FLAGS]


NATIVE = Build()


def compile_shared(
    sources: Sequence[Path], options: Sequence[str], folder: Path, build: Build = NATIVE
) -> ctypes.CDLL:
    """The sources, each compiled alone, as one library; what is there already is kept."""
    objects = []
    for source in sources:
        words = [*build.command(source), "-fPIC", *options, f"-I{source.parent}"]
        key = hashlib.sha256("\0".join([*words, source.read_text(encoding="utf-8")]).encode())
        for other in sorted(source.parent.glob("*.h")):
            key.update(other.read_bytes())
        target = source.parent / f"{source.stem}-{key.hexdigest()[:12]}.o"
        if not target.exists():
            command(*words, "-c", str(source), "-o", str(target))
        objects.append(target)
    name = hashlib.sha256("".join(map(str, objects)).encode()).hexdigest()[:12]
    library = folder / f"lib{name}.so"
    if not library.exists():
        command("g++", "-shared", "-o", str(library), *map(str, objects), "-lm")
    return ctypes.CDLL(str(library))


@dataclass
class Native:
    """One implementation in C or C++ of dx = f(x, k)."""

    name: str
    sources: list[Path]
    function: str
    constants: Array
    states: Array
    outputs: int
    operations: str = ""
    prototype: str = ""
    call: str = ""
    options: list[str] = field(default_factory=list)
    many: tuple[str, str] | None = None
    """Prototype and call of the function for many states, where there is one."""
    rows: list[int] | None = None
    note: str = ""
    prepare: Callable[[ctypes.CDLL], object] | None = None

    def build(self, folder: Path, build: Build = NATIVE) -> None:
        """Compile it with the loop that calls it."""
        folder.mkdir(parents=True, exist_ok=True)
        self.states, self.out = self.place(self.states), aligned((len(self.states), self.outputs))
        loop = folder / f"loop_{self.function}.c"
        loop.write_text(
            LOOP.format(
                prototype=self.prototype or PLAIN.format(self.function),
                call=self.call or f"{self.function}(xi, k, di)",
                inputs=self.states.shape[1],
                outputs=self.outputs,
                many=MANY.format(prototype=self.many[0], call=self.many[1]) if self.many else "",
            ),
            encoding="utf-8",
        )
        sources = [*self.sources, loop]
        self.library = compile_shared(sources, self.options, folder, build)
        if self.prepare is not None:
            self.prepare(self.library)

    @staticmethod
    def place(states: Array) -> Array:
        """The states where their lines of cache begin."""
        kept = aligned(states.shape)
        kept[:] = states
        return kept

    @cached_property
    def arguments(self) -> tuple[ctypes.c_void_p, ...]:
        """x, k and dx."""
        return tuple(pointer(a) for a in (self.states, self.constants, self.out))

    def run(self, rounds: int) -> None:
        """Every state, so many times."""
        count = ctypes.c_size_t(len(self.states))
        self.library.repeat(ctypes.c_long(rounds), count, *self.arguments)

    def nanoseconds(self, rounds: int) -> float:
        """The time of an evaluation."""
        start = time.perf_counter_ns()
        self.run(rounds)
        return (time.perf_counter_ns() - start) / (rounds * len(self.states))


def error(got: Array, wanted: Array) -> float:
    """The largest difference of a state over its largest number; inf where one is no number."""
    size = np.abs(wanted).max(axis=-1, keepdims=True)
    difference = np.abs(got - wanted) / size
    return float(difference.max()) if np.isfinite(difference).all() else float("inf")


def write(path: Path, text: str) -> Path:
    """Write a source; return where."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def copy(source: Path, folder: Path) -> Path:
    """A copy of a source in the folder where the others are built."""
    folder.mkdir(parents=True, exist_ok=True)
    return Path(shutil.copy(source, folder / source.name))
