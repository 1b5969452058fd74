"""Steps in one header, for host and device: read as CUDA's compiler would take them, run as C++.

No compiler of CUDA is asked for: its words are defined as nothing.
"""

import re
import subprocess

import numpy as np
import pytest

import derive
from tests.support.needs import need

STRICT = ["-std=c++17", "-O2", "-pedantic", "-Wall", "-Wextra", "-Werror"]
AS_DEVICE = ["-D__CUDACC__", "-D__host__=", "-D__device__=", "-D__global__="]
MAIN = """
#include "NAME_steps.h"
#include <cstdio>
/* a motion for each thread */
__global__ void moved(int i, double *x, const double *k, double t1, int *status)
{
    NAME_motion m;
    double inside[NAME_N_STATE], u[NAME_SIZE_U] = {0};
    NAME_begin(&m, 0, x + i*NAME_N_STATE);
    status[i] = NAME_rk4(&m, k, u, 0.001, 100);
    status[i] += NAME_vern9_to(&m, k, u, t1, 1e-10);
    NAME_dense(&m, t1 - m.h/2, inside);
    for (int j = 0; j < NAME_N_STATE; ++j) {
        x[i*NAME_N_STATE + j] = m.x[j];
    }
}
int main()
{
    double p[NAME_SIZE_P], k[NAME_SIZE_K], x[3*NAME_N_STATE];
    int status[3];
    for (double &value : p) if (scanf("%lf", &value) != 1) return 1;
    for (double &value : x) if (scanf("%lf", &value) != 1) return 1;
    if (NAME_constants(p, k)) return 1;
    for (int i = 0; i < 3; ++i) moved(i, x, k, 2.0, status);
    for (int s : status) printf("%d ", s);
    for (double value : x) printf("%.17g ", value);
}
"""


def headers(folder, name, *steps, **options):
    """Both headers of a problem as one text."""
    derive.derive(name).emit(folder, ("c",), step=steps, form="header", **options)
    return "".join((folder / f"{name}{end}.h").read_text() for end in ("", "_steps"))


@pytest.mark.parametrize("flags", [["-D__global__="], AS_DEVICE], ids=["host", "device"])
@pytest.mark.parametrize("name", ["so3", "sl3"])
def test_a_motion_of_each_thread(name, flags, tmp_path):
    """As the compiled C moves it."""
    need("g++")
    headers(tmp_path, name, "rk4", "vern9")
    (tmp_path / "main.cpp").write_text(MAIN.replace("NAME", name))
    command = ["g++", *STRICT, *flags, "main.cpp", "-o", "main", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    f = derive.compile(name, step=("rk4", "vern9"))
    x = np.zeros((3, len(f.STATE)))
    x[:, [0, 4, 8]] = 1
    x[:, 9:] = 0.3 * np.random.default_rng(1).normal(size=(3, len(f.STATE) - 9))
    given = " ".join(repr(float(v)) for v in (*f.p, *x.ravel()))
    done = subprocess.run(tmp_path / "main", input=given, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    words = done.stdout.split()
    assert words[:3] == ["0", "0", "0"]
    found = np.array(words[3:], float).reshape(x.shape)
    for own, end in zip(x, found, strict=True):
        m = f.begin(own)
        m.move(0.001, 100, step="rk4")
        assert np.abs(m.move_to(2.0, 1e-10, step="vern9").x - end).max() < 1e-13


@pytest.mark.parametrize(
    ("name", "options"),
    [("so3", {}), ("se3", {"frame": "principal"}), ("top", {"real": "float"}), ("jelly", {})],
)
def test_what_a_device_calls_is_for_it(name, options, tmp_path):
    """Functions for host and device call functions of that kind alone, and read no table that
    stands outside of a function; ``gauss``, in lanes, is for the host."""
    steps = ("rk4",) if options.get("real") == "float" else ("rk4", "vern9")
    text = headers(tmp_path, name, *steps, **options)
    definitions = rf"^{name}_FUNCTION \w[\w ]*?\**({name}_\w+)\([^;{{]*\)\n{{\n(.*?)^}}$"
    bodies = dict(re.findall(definitions, text, re.M | re.S))
    assert {f"{name}_{x}" for x in ("rhs", "begin", "rk4", "dense")} <= {*bodies}
    for function, body in bodies.items():
        called = {*re.findall(rf"\b({name}_\w+)\(", body)}
        assert called <= {*bodies}, (function, called - {*bodies})
    assert not re.search(r"^static (?!inline|__host__)", text, re.M)
    assert "static inline" not in text.replace(f"define {name}_FUNCTION static inline", "")


def test_lanes_are_for_the_host(tmp_path):
    """With what is in lanes the header is still C++ where CUDA's compiler reads it."""
    need("g++")
    headers(tmp_path, "so3", "gauss", "rk4", ensemble=True)
    (tmp_path / "main.cpp").write_text(
        '#include "so3_steps.h"\nint main() { return so3_LANES - 1; }\n'
    )
    command = ["g++", *STRICT, "-march=native", *AS_DEVICE, "main.cpp", "-o", "main", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    subprocess.run(tmp_path / "main", check=True)
