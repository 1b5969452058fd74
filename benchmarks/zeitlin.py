"""A fluid on the torus: the time of one rhs against N, and the convergence to Euler's equation.

python -m benchmarks.zeitlin

The emitted C beside C written by hand in three roads, a table of the terms, matrices, and matrices
with their transforms by FFT, and the emitted Python; then the vorticity for N = 31 and 45 beside
that of Fourier's method.
"""

from __future__ import annotations

import ctypes
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from derive import derive
from derive.problem.toml import problem_of

SIZES = (3, 5, 7, 9, 11, 21, 31, 45, 63, 101)
FLAGS = ("-O2", "-std=c99", "-D_POSIX_C_SOURCE=199309L", "-shared", "-fPIC")
WORST, SLOWEST, ORDER = 1.1, 10e-3, 1.9
"""The largest ratio to the best of the roads by hand, seconds for N = 101, the order for N → ∞."""
TABLE = 13
"""The largest N of the table by hand."""
DRIVER = """
#include <time.h>
{head}
double seconds(double *x, double *dx, int count, int road)
{{
    struct timespec a, b;
    clock_gettime(CLOCK_MONOTONIC, &a);
    for (int i = 0; i < count; ++i) {{
        {call}
        x[0] += 1e-12*dx[0];
    }}
    clock_gettime(CLOCK_MONOTONIC, &b);
    return ((double)(b.tv_sec - a.tv_sec) + 1e-9*(double)(b.tv_nsec - a.tv_nsec))/count;
}}
"""
WAVES = ((1, 0), (0, 1), (1, 1), (-1, 1), (2, 0), (0, 2), (2, 1), (-1, 2))
"""The waves of the vorticity at the start."""
GRID, UNTIL, STEPS, LOW = 96, 0.5, 50, 6


def files(N: int, folder: Path) -> Any:
    """The emitted module of an N, whose C is beside it."""
    algebra = {"of": "torus", "N": N}
    inertia = {"operator": "laplacian"}
    problem = problem_of({"name": f"fluid{N}", "algebra": algebra, "inertia": inertia})
    derive(problem).emit(folder, ("c", "python"))
    sys.path.insert(0, str(folder))
    module = __import__(f"fluid{N}")
    sys.path.pop(0)
    return module


def compiled(folder: Path, name: str, head: str, call: str, *sources: str) -> ctypes.CDLL:
    """A library with the function ``seconds``."""
    (folder / f"{name}.c").write_text(DRIVER.format(head=head, call=call), encoding="utf-8")
    out = folder / f"lib{name}.so"
    cc = shutil.which("cc") or "gcc"
    words = [cc, *FLAGS, f"{name}.c", *sources, "-o", str(out), "-lm"]
    subprocess.run(words, cwd=folder, check=True)
    library = ctypes.CDLL(str(out))
    library.seconds.restype = ctypes.c_double
    return library


def timed(library: ctypes.CDLL, N: int, road: int = 0) -> tuple[float, np.ndarray[Any, Any]]:
    """Seconds of one rhs, the best of some, and the rates of a state."""
    x = np.random.default_rng(0).normal(size=N * N - 1) / N
    dx, count = np.zeros_like(x), 1 + 2_000_000 // N**3
    pointers = [ctypes.c_void_p(y.ctypes.data) for y in (x, dx)]
    best = min(library.seconds(*pointers, count, road) for _ in range(40))
    return best, dx


def row(N: int, folder: Path, by_hand: str) -> tuple[float, float]:
    """Print the times of an N; the ratio to the best by hand, and the time of the emitted C."""
    module, name = files(N, folder), f"fluid{N}"
    constants = f'#include "{name}.h"\nstatic double k[{name}_SIZE_K];'
    call = f"(void)road; if (!i) {name}_constants(0, k); {name}_rhs(0, x, k, 0, dx);"
    ours, rates = timed(compiled(folder, f"ours{N}", constants, call, f"{name}.c"), N)
    hand = compiled(
        folder,
        f"hand{N}",
        f"#define N {N}\n{by_hand}",
        "if (!terms) prepare(); (road == 0 ? by_matrices : road == 1 ? by_fft : by_table)(x, dx);",
    )
    found = [timed(hand, N, road) for road in ((0, 1, 2) if N <= TABLE else (0, 1))]
    for _, other in found:
        assert np.abs(other - rates).max() < 1e-12 * np.abs(rates).max()
    x, k = np.random.default_rng(0).normal(size=(N * N - 1)), module.constants([])
    module.rhs(0.0, x, k)
    start = time.perf_counter()
    for _ in range(20):
        module.rhs(0.0, x, k)
    python = (time.perf_counter() - start) / 20
    times = [t for t, _ in found]
    shown = "".join(f"{x * 1e6:12.3f}" for x in (ours, *times)) + " " * 12 * (3 - len(times))
    ratio = ours / min(times)
    print(f"{N:4}{shown}{ratio:8.2f}{python * 1e6:12.1f}")
    return ratio, ours


def waves() -> dict[tuple[int, int], complex]:
    """The coefficients of the vorticity at the start, with their conjugates."""
    rng = np.random.default_rng(3)
    found = {n: 0.5 * complex(*rng.normal(size=2)) for n in WAVES}
    return found | {(-a, -b): z.conjugate() for (a, b), z in found.items()}


def stepped(field: Callable[[Any], Any], x: Any) -> Any:
    """The classical method of Runge and Kutta."""
    h = UNTIL / STEPS
    for _ in range(STEPS):
        a = field(x)
        b = field(x + h / 2 * a)
        c = field(x + h / 2 * b)
        x = x + h / 6 * (a + 2 * b + 2 * c + field(x + h * c))
    return x


def by_matrices(N: int, folder: Path) -> np.ndarray[Any, Any]:
    """The coefficients of the vorticity at the end, modulo N."""
    module = files(N, folder)
    k, start, half = module.constants([]), waves(), module.LATTICE
    x = np.array([y for n in half for z in (start.get((*n,), 0j),) for y in (z.real, z.imag)])
    x = stepped(lambda x: module.rhs(0.0, x, k), x)
    grid = np.zeros((N, N), complex)
    for j, (a, b) in enumerate(half):
        grid[a, b] = x[2 * j] + 1j * x[2 * j + 1]
        grid[-a, -b] = np.conj(grid[a, b])
    return grid


def by_fourier() -> np.ndarray[Any, Any]:
    """The same by Euler's equation, ∂ω/∂t = −u·∇ω, u = (−∂ψ/∂y, ∂ψ/∂x), Δψ = ω, dealiased."""
    k = np.fft.fftfreq(GRID, 1 / GRID)
    kx, ky = np.meshgrid(k, k, indexing="ij")
    square = np.where(kx**2 + ky**2 == 0, 1, kx**2 + ky**2)
    kept = (np.abs(kx) < GRID / 3) & (np.abs(ky) < GRID / 3)
    omega = np.zeros((GRID, GRID), complex)
    for n, z in waves().items():
        omega[n] = z * GRID**2

    def field(w: Any) -> Any:
        psi = -w / square
        slopes = (
            np.fft.ifft2(z).real for z in (-1j * ky * psi, 1j * kx * w, 1j * kx * psi, 1j * ky * w)
        )
        u, w_x, v, w_y = slopes
        return np.where(kept, -np.fft.fft2(u * w_x + v * w_y), 0)

    return stepped(field, omega) / GRID**2


def main() -> int:
    """Print the table and the order; 1 where one is worse than it should be."""
    folder = Path(__file__).parent
    roads = (folder / f"zeitlin_by_{x}.c" for x in ("hand", "fft"))
    by_hand = "\n".join(x.read_text(encoding="utf-8") for x in roads)
    right = True
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print("one rhs on the torus, in µs; the ratio is to the best of the roads by hand")
        heads = ("emitted C", "matrices", "by FFT", "table")
        print(f"{'N':>4}{''.join(f'{x:>12}' for x in heads)}{'ratio':>8}{'Python':>12}")
        for N in SIZES:
            ratio, seconds = row(N, folder, by_hand)
            right = right and ratio <= WORST and seconds <= SLOWEST
        exact, span = by_fourier(), range(-LOW, LOW + 1)
        errors = {}
        for N in (31, 45):
            found = by_matrices(N, folder)
            errors[N] = max(abs(found[a, b] - exact[a, b]) for a in span for b in span)
        order = math.log(errors[31] / errors[45]) / math.log(45 / 31)
        print(
            f"error of the vorticity at t = {UNTIL}: {errors[31]:.2e} for N = 31, {errors[45]:.2e}",
            end="",
        )
        print(f" for N = 45: order {order:.2f}")
    return 0 if right and order >= ORDER else 1


if __name__ == "__main__":
    sys.exit(main())
