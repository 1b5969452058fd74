"""Load emitted code: compile NAME.c and call it, import NAME.py."""

import ctypes
import importlib.util
import subprocess
from pathlib import Path

import numpy as np

from tests.support.needs import CC, need

GENERATED = Path(__file__).resolve().parents[2] / "generated"
STRICT = ["-Wall", "-Wextra", "-Werror", "-O2", "-shared", "-fPIC"]
C99 = ["-std=c99", "-pedantic", *STRICT]
BUILDS = {
    "cc": [CC, *C99],
    "clang": ["clang", *C99],
    "g++": ["g++", "-std=c++11", *STRICT, "-x", "c++"],
}
SIZES = ("STATE", "ALGEBRA", "PARAMETERS", "CONSTANTS", "INPUTS")

# The sizes are an enum, which no library exports: a second file hands them out, and shows that
# the header stands alone, may be included twice, and declares its functions for C from C++.
PROBE = """\
#include "{name}.h"
#include "{name}.h"
#ifdef __cplusplus
extern "C"
#endif
void probe_sizes(int *sizes);
void probe_sizes(int *sizes)
{{
{lines}
}}
"""


def vector(values):
    """A contiguous array of doubles."""
    return np.ascontiguousarray(values, dtype=np.float64)


class CLibrary:
    """The functions of a compiled ``NAME.c`` on NumPy vectors; ``sizes`` holds its enum."""

    def __init__(self, path, name):
        self.library, self.name = ctypes.CDLL(str(path)), name
        array = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
        numbers = np.ctypeslib.ndpointer(np.intc, flags="C_CONTIGUOUS")
        real = ctypes.c_double
        self._probe = self._function("probe_sizes", None, [numbers])
        self._constants = self._function(f"{name}_constants", ctypes.c_int, [array, array])
        self._rhs = self._function(f"{name}_rhs", None, [real, array, array, array, array])
        self._energy = self._function(f"{name}_energy", real, [real, array, array])
        values = np.zeros(len(SIZES), np.intc)
        self._probe(values)
        self.sizes = {key: int(value) for key, value in zip(SIZES, values, strict=True)}

    def _function(self, symbol, result, arguments):
        function = getattr(self.library, symbol)
        function.restype, function.argtypes = result, arguments
        return function

    def constants(self, p):
        """The status and the constants made of the parameters ``p``."""
        k = np.full(self.sizes["CONSTANTS"], np.nan)
        return self._constants(vector(p), k), k

    def rhs(self, t, x, k, u=None):
        """dx/dt; without ``u`` the inputs are zeros."""
        dx = np.full(self.sizes["STATE"], np.nan)
        u = np.zeros(self.sizes["INPUTS"]) if u is None else vector(u)
        self._rhs(t, vector(x), k, u, dx)
        return dx

    def energy(self, t, x, k):
        """The energy in the state ``x``."""
        return self._energy(t, vector(x), k)

    def rhs_batch(self, t, x, k, u):
        """dx/dt for the columns of x (N, n), with inputs (M, n)."""
        array = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
        arguments = [ctypes.c_size_t, ctypes.c_double, array, array, array, array]
        batch = self._function(f"{self.name}_rhs_batch", None, arguments)
        dx = np.full(x.shape, np.nan)
        batch(x.shape[1], t, vector(x), k, vector(u), dx)
        return dx

    def carried(self, what, k, x):
        """A state or inputs ``x`` taken elsewhere; by the constants ``k``, if there are any."""
        array = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
        given = [vector(x), *([] if k is None else [k]), np.full(len(x), np.nan)]
        self._function(f"{self.name}_{what}", None, [array] * len(given))(*given)
        return given[-1]

    def project(self, x):
        """A state taken back to the group."""
        return self.carried("project", None, x)

    def defect(self, x):
        """How far a state is off the group, in an array."""
        array = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
        function = self._function(f"{self.name}_defect", ctypes.c_double, [array])
        return np.array([function(vector(x))])

    def jacobian(self, t, x, k, u):
        """dx/dt and D."""
        array = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
        arguments = [ctypes.c_double, array, array, array, array, array]
        jacobian = self._function(f"{self.name}_jacobian", None, arguments)
        dx, size = np.full(self.sizes["STATE"], np.nan), 2 * self.sizes["ALGEBRA"]
        D = np.full((size, size), np.nan)
        jacobian(t, vector(x), k, vector(u), dx, D)
        return dx, D


def compile_c(build, name, folder, source=None):
    """Compile NAME.c of ``source`` (generated/NAME) into ``folder`` and load it, or fail loudly.

    Where there is no such compiler, the test that asks is left out.
    """
    need(build)
    source = source or GENERATED / name
    lines = [f"    sizes[{i}] = {name}_N_{key};" for i, key in enumerate(SIZES)]
    probe = Path(folder) / "probe.c"
    probe.write_text(PROBE.format(name=name, lines="\n".join(lines)))
    library = Path(folder) / f"{name}-{build}.so"
    command = [*BUILDS[build], f"-I{source}", str(source / f"{name}.c"), str(probe)]
    done = subprocess.run([*command, "-o", str(library), "-lm"], capture_output=True, text=True)
    if done.returncode or done.stderr:
        raise AssertionError(f"{' '.join(command)}\n{done.stderr}")
    return CLibrary(library, name)


def import_python(name, source=None):
    """The module NAME.py of ``source`` (generated/NAME), imported from its path."""
    path = (source or GENERATED / name) / f"{name}.py"
    spec = importlib.util.spec_from_file_location(f"emitted_{name}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def arrange(module, values):
    """The parameters, named in ``values``, in the order that the module states."""
    return np.array([values[key] for key in module.PARAMETERS], float)


def some_body(names, seed=1):
    """Moments of six masses in R³ for the parameters that are moments: m, c_i, J_ij → value."""
    random = np.random.default_rng(seed)
    mass, r = random.uniform(0.5, 1.5, 6), random.normal(size=(6, 3))
    values = {"m": mass.sum()} | {f"c_{i + 1}": mass @ r[:, i] for i in range(3)}
    values |= {
        f"J_{i + 1}{j + 1}": mass @ (r[:, i] * r[:, j]) for i in range(3) for j in range(i, 3)
    }
    return {name: values[name] for name in names if name in values} if "J_33" in names else {}
