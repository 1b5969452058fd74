"""A user's function: how it is called, and its values, which a process of its own finds."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..language.limits import Refused
from ..motion.native import CompileError, CSource, compiled_into

Array = np.ndarray[Any, np.dtype[np.float64]]

SECONDS, BYTES = 60, 4 << 30
"""The time and the memory that a user's code may take."""
ARGUMENTS = ("t", "x", "k", "u", "p", "dx")
"""The time, the state, the constants of our own code, inputs, parameters, and what is written."""
FLAGS = ("-O1", "-fPIC", "-shared")


class CompareError(Refused, ValueError):
    """What cannot be compared: the message says why, and what to do."""


@dataclass(frozen=True)
class Call:
    """A function by its ``name``, the names of its ``arguments``; does it give its result back?"""

    name: str
    arguments: tuple[str, ...]
    returns: bool

    @classmethod
    def read(cls, words: str) -> Call:
        """That of ``f(t, x, u, dx)`` or ``f(x) -> dx``; ``CompareError`` for other words."""
        form = re.fullmatch(r"\s*(\w+)\s*\(([\w\s,]*)\)\s*(->\s*\w+)?\s*", words, re.ASCII)
        given = tuple(x.strip() for x in form[2].split(",")) if form else ()
        if not form or {*given} - {*ARGUMENTS} or len({*given}) < len(given) or "x" not in given:
            listed = ", ".join(ARGUMENTS)
            raise CompareError(
                f"call {words[:60]!r}: expected f(t, x, u, dx) or f(x, u) -> dx; arguments are "
                f"{listed}, x among them"
            )
        return cls(form[1], given, "dx" not in given)


def values(path: Path, calls: Mapping[Call, int], given: Mapping[str, Array]) -> list[Array]:
    """For each call what it gives, (states, size), at what is ``given``, (states, …) for each
    argument; ``CompareError`` for code that is none, crashes, hangs or gives other numbers."""
    if path.suffix not in (".c", ".so", ".py"):
        raise CompareError(f"{path}: expected a file .c, .so or .py")
    if not path.is_file():
        raise CompareError(f"{path}: there is no such file")
    if path.suffix != ".py" and any(x.returns for x in calls):
        raise CompareError(f"{path}: functions of C write their result: let dx be an argument")
    with tempfile.TemporaryDirectory(prefix="derive-") as name:
        folder = Path(name)
        asked = [
            {"name": x.name, "arguments": x.arguments, "returns": x.returns, "size": size}
            for x, size in calls.items()
        ]
        request: dict[str, Any] = {"path": str(_library(path, folder)), "calls": asked}
        request |= {"seconds": SECONDS, "bytes": BYTES}
        (folder / "request.json").write_text(json.dumps(request), encoding="utf-8")
        np.savez(folder / "given.npz", **given)  # type: ignore[arg-type]
        _run(path, folder)
        with np.load(folder / "found.npz") as found:
            return [found[x.name] for x in calls]


def _library(path: Path, folder: Path) -> Path:
    """The file that the child opens: of C a library that is compiled here."""
    if path.suffix != ".c":
        return path.resolve()
    text = path.read_text(encoding="utf-8", errors="replace")
    flags = (*FLAGS, "-I", str(path.resolve().parent))
    source = CSource("users", ((path.name, text),), None, flags)
    try:
        return compiled_into(folder, source, str(path))
    except CompileError as error:
        raise CompareError(str(error)) from None


def _run(path: Path, folder: Path) -> None:
    """The child, within its limits; what it prints is dropped."""
    child = Path(__file__).with_name("child.py")
    command = [sys.executable, str(child), str(folder)]
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=SECONDS,
        )
    except subprocess.TimeoutExpired:
        raise CompareError(f"{path}: it takes more than {SECONDS} seconds") from None
    fault = folder / "fault.txt"
    if fault.exists():
        raise CompareError(f"{path}: {fault.read_text(encoding='utf-8')[:300]}")
    if done.returncode or not (folder / "found.npz").exists():
        how = f"ends with exit code {done.returncode}"
        if done.returncode < 0:
            how = f"crashes ({signal.Signals(-done.returncode).name})"
        raise CompareError(f"{path}: it {how}")
