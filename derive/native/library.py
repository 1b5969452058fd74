"""Emitted C as a shared library: compiled by the compiler at hand, loaded once."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import tempfile
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

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
        for name, text in source.files:
            (Path(folder) / name).write_text(text, encoding="utf-8")
        target = Path(folder) / f"{source.name}.so"
        sources = map(str, sorted(Path(folder).glob("*.c")))
        command = [compiler, *source.flags, *sources, "-o", str(target), "-lm"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise CompileError(f"{compiler} refused the emitted C: {done.stderr.strip()[:500]}")
        return ctypes.CDLL(str(target))  # once it is loaded, its file may go


def _compiler(requested: str | None) -> str:
    chosen = requested or os.environ.get("CC", "")
    wanted = [chosen] if chosen else ["cc", "gcc", "clang"]
    found = next((path for path in map(shutil.which, wanted) if path), None)
    if found is None:
        what = f"{chosen!r} is not on the path" if chosen else "no C compiler"
        raise CompileError(f"{what}: install gcc or clang, or name one in CC")
    return found
