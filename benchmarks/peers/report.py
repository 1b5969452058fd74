"""Tables in plain text, and what they were measured on."""

from __future__ import annotations

import os
import platform
import shutil
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path

from .cases import command
from .native import FLAGS, NATIVE

PACKAGES = [
    "casadi",
    "symforce",
    "wrenfold",
    "pin",
    "cmeel-eigen",
    "sympy",
    "pydy",
    "numpy",
    "numba",
    "jax",
    "jaxlib",
    "scipy",
]


def table(title: str, head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Columns as wide as they need, the first one and the last to the left."""
    lines = [head, *rows]
    width = [max(len(line[i]) for line in lines) for i in range(len(head))]
    last = len(head) - 1

    def line(cells: Sequence[str]) -> str:
        made = [
            cell.ljust(width[i]) if i in (0, last) else cell.rjust(width[i])
            for i, cell in enumerate(cells)
        ]
        return "  ".join(made).rstrip()

    rule = "─" * (sum(width) + 2 * last)
    return "\n".join([title, rule, line(head), rule, *map(line, rows), rule, ""])


def version(compiler: str) -> str:
    """What a compiler says that it is."""
    if shutil.which(compiler) is None:
        return f"no {compiler}"
    return command(compiler, "--version").splitlines()[0]


def machine(cpu: int) -> str:
    """Processor, compilers, versions."""
    model = platform.processor()
    info = Path("/proc/cpuinfo")
    if info.exists():
        for line in info.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    versions = []
    for name in PACKAGES:
        try:
            versions.append(f"{name} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            versions.append(f"{name} not installed")
    lines = [
        f"processor  {model}, {os.cpu_count()} cores, on core {cpu}",
        f"compilers  {', '.join(map(version, ('gcc', 'g++', 'clang')))}",
        f"flags      {' '.join([*NATIVE.level, *FLAGS])}, where no others are said",
        f"python     {platform.python_version()}; {', '.join(versions[:6])},",
        f"           {', '.join(versions[6:])}",
    ]
    return "\n".join(lines) + "\n"
