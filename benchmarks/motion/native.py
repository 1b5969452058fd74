"""The emitted steps, compiled in several ways; the ends of motions in quad precision."""

from __future__ import annotations

import ctypes
import hashlib
import json
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..peers.cases import Array, command
from ..peers.native import pointer
from .cases import Form

HERE = Path(__file__).parent
ENDS = HERE / "ends.json"
CC = shutil.which("cc") or "gcc"
BUILDS = {
    "native": ("-O3", "-march=native"),
    "AVX2": ("-O3", "-march=native", "-mno-avx512f"),
    "plain": ("-O3", "-march=native", "-mno-avx512f", "-D{name}_LANES=1"),
}
"""How the steps are compiled: the last in plain loops of eight."""

METHODS = ("gauss", "gauss_to", "vern9", "vern9_to")
AGREED = 1e-23
"""How far the two references may be apart."""


@dataclass(frozen=True)
class Steps:
    """The steps of a form, compiled."""

    form: Form
    library: ctypes.CDLL

    def run(self, method: str, parameter: float, repeats: int = 1) -> tuple[float, Array]:
        """The least seconds of some runs, by a number of steps or a tolerance, and where they end.

        Infinite where the step says that it has no next state.
        """
        out = np.full_like(self.form.x, np.nan)
        number = [float(parameter), 0.0] if not method.endswith("_to") else [0.0, parameter]
        seconds = self.library.run(
            METHODS.index(method),
            pointer(self.form.x),
            pointer(self.form.k),
            ctypes.c_double(self.form.motion.until),
            *map(ctypes.c_double, number),
            repeats,
            pointer(out),
        )
        return (seconds if seconds > 0 else np.inf), out


def built(form: Form, source: str, *flags: str, end: tuple[str, ...] = ("-lm",)) -> ctypes.CDLL:
    """A library of one of our files for the emitted code of a form."""
    key = hashlib.sha256("\0".join([source, *flags]).encode()).hexdigest()[:8]
    out = form.folder / f"lib{form.name}_{key}.so"
    words = [CC, "-shared", "-fPIC", f"-DNAME={form.name}", f"-DSTEPS={form.name}_steps.h"]
    words += [f"-DHEADER={form.name}.h", f"-DSOURCE={form.name}.c", f"-I{form.folder}", *flags]
    command(*words, str(HERE / source), "-o", str(out), *end)
    return ctypes.CDLL(str(out))


def compiled(form: Form, build: str) -> Steps:
    """A library of the steps of a form."""
    flags = [x.format(name=form.name) for x in BUILDS[build]]
    library = built(form, "driver.c", *flags, str(form.folder / f"{form.name}.c"))
    library.run.restype = ctypes.c_double
    return Steps(form, library)


def reference(form: Form) -> Array:
    """Where a motion ends; what is known already is in ``ends.json``."""
    ends = json.loads(ENDS.read_text(encoding="utf-8")) if ENDS.exists() else {}
    key = hashlib.sha256((form.folder / f"{form.name}.c").read_bytes().split(b"#include", 1)[1])
    for numbers in (form.k, form.x, np.array([form.motion.until])):
        key.update(numbers.tobytes())
    known = ends.get(form.name)
    if not known or known["of"] != key.hexdigest()[:16]:
        end, apart = _in_quad(form)
        if not apart < AGREED:
            raise RuntimeError(f"{form.name}: the references are {apart:.0e} apart")
        known = {
            "of": key.hexdigest()[:16],
            "apart": float(f"{apart:.0e}"),
            "x": [float(x) for x in end],
        }
        ends[form.name] = known
        ENDS.write_text(json.dumps(ends, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    return np.array(known["x"])


def _in_quad(form: Form) -> tuple[Array, float]:
    """Where a motion ends, and how far two methods in quad precision are apart."""
    library = built(form, "quad.c", "-O2", end=("-lquadmath", "-lm"))
    motion, ends = form.motion, []
    for method, angle in enumerate((1.0, 2.0)):
        high, low = np.zeros_like(form.x), np.zeros_like(form.x)
        n = int(motion.until * motion.rate / angle) + 1
        numbers = pointer(form.x), pointer(form.k), ctypes.c_double(motion.until)
        library.quad(method, *numbers, n, pointer(high), pointer(low))
        ends.append((high, low))
    (high, low), (other, rest) = ends
    apart = float(np.abs((high - other) + (low - rest)).max() / np.abs(high).max())
    return high, apart
