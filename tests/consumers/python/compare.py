"""The emitted C through ctypes beside the emitted Python: one second of motion, and its energy.

    python compare.py

A second run emits and compiles only what has changed.
"""

import ctypes
import importlib
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
BUILD = HERE / "build"
REAL, VECTOR = ctypes.c_double, np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")


def emit():
    """sheet.h, sheet.c and sheet.py from sheet.toml, unless they are current."""
    command = [sys.executable, "-m", "derive", "emit", "sheet.toml", "--out", "build"]
    current = subprocess.run([*command, "--check"], cwd=HERE, stdout=subprocess.DEVNULL)
    if current.returncode == 1:
        subprocess.run(command, cwd=HERE, check=True)
    elif current.returncode:
        sys.exit(current.returncode)


def compiled():
    """The shared library of sheet.c, its functions with their types."""
    source, library = BUILD / "sheet.c", BUILD / "libsheet.so"
    if not library.exists() or library.stat().st_mtime <= source.stat().st_mtime:
        options = ["-std=c99", "-O2", "-Wall", "-Wextra", "-shared", "-fPIC"]
        subprocess.run(["cc", *options, source, "-o", library, "-lm"], check=True)
        print("compiled", library.name)
    c = ctypes.CDLL(str(library))
    c.sheet_constants.restype, c.sheet_constants.argtypes = ctypes.c_int, [VECTOR, VECTOR]
    c.sheet_rhs.restype = None
    c.sheet_rhs.argtypes = [REAL, VECTOR, VECTOR, ctypes.c_void_p, VECTOR]  # no inputs: NULL
    c.sheet_energy.restype, c.sheet_energy.argtypes = REAL, [REAL, VECTOR, VECTOR]
    return c


def rk4(field, t, x, h):
    """One step of the classical Runge-Kutta method."""
    k1 = field(t, x)
    k2 = field(t + h / 2, x + h / 2 * k1)
    k3 = field(t + h / 2, x + h / 2 * k2)
    k4 = field(t + h, x + h * k3)
    return x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def main():
    """0 when both agree and keep the energy."""
    emit()
    c = compiled()
    sys.path.insert(0, str(BUILD))
    sheet = importlib.import_module("sheet")

    p = np.array([sheet.DEFAULTS[name] for name in sheet.PARAMETERS])
    k = np.empty(len(sheet.CONSTANTS))
    if c.sheet_constants(p, k):
        sys.exit("the mass matrix is singular")
    of_python = sheet.constants(p)

    def field(t, x):
        dx = np.empty_like(x)
        c.sheet_rhs(t, np.ascontiguousarray(x), k, None, dx)
        return dx

    x = np.concatenate([np.eye(2).ravel(), [0.2, -0.3, 0.4, 0.1]])
    y, before, steps = x, c.sheet_energy(0.0, x, k), 500
    for i in range(steps):
        x = rk4(field, i / steps, x, 1 / steps)
        y = rk4(lambda t, s: sheet.rhs(t, s, of_python), i / steps, y, 1 / steps)
    apart = np.abs(x - y).max()
    drift = abs(c.sheet_energy(1.0, x, k) - before) / (1 + abs(before))
    print(f"sheet: C and Python {apart:.1e} apart, energy drift {drift:.1e}")
    return 0 if apart < 1e-12 and drift < 1e-9 and np.isfinite(x).all() else 1


if __name__ == "__main__":
    sys.exit(main())
