"""Steps in one header, for host and device: read as CUDA's compiler would take them, run as C++.

The words of CUDA are those of tests/support/card.h, whose threads come one after the other; where
there is a compiler of CUDA, it compiles ensembles.
"""

import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import derive
from derive.motion.native import nvcc
from tests.problems.line import FALLING
from tests.support.needs import need, needs

STRICT = ["-std=c++17", "-O2", "-pedantic", "-Wall", "-Wextra", "-Werror"]
FALL = "line"
CARD = Path(__file__).parents[1] / "support" / "card.h"
AS_DEVICE = ["-include", str(CARD), "-Wno-unknown-pragmas"]
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
    flags = [*STRICT, "-march=native", *AS_DEVICE, "-Dso3_LAUNCH=launched"]
    command = ["g++", *flags, "main.cpp", "-o", "main", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    subprocess.run(tmp_path / "main", check=True)


ENSEMBLES = """
#define NAME_LAUNCH launched
#include "NAME_steps.h"
#include <cstdio>
/* for each motion the status on the host and on the card, the next step, and each number of the
 * state at the start, by rk4 on the host and on the card, and by vern9 */
enum { N = 300, K = NAME_N_CONSTANTS, U = NAME_N_INPUTS };
static double p[NAME_SIZE_P], k[N*NAME_SIZE_K], u[N*NAME_SIZE_U], all[5][N*NAME_N_STATE], h[N];
static int status[N], told[N];
int main()
{
    for (int j = 0; j < NAME_N_PARAMETERS; ++j) if (scanf("%lf", p + j) != 1) return 1;
    for (double &value : all[0]) if (scanf("%lf", &value) != 1) return 1;
    for (int i = 0; i < N; ++i) {
        p[0] *= 1.001;
        if (NAME_constants(p, k + i*K)) return 1;
        u[i*U] = 0.01*i;
    }
    for (double *one : all) if (one != all[0]) memcpy(one, all[0], sizeof all[0]);
    NAME_ensemble_rk4(N, all[1], k, 0, u, U, 0.5, -0.001, 100);
    int wrong = NAME_ensemble_rk4_device(N, all[2], k, 0, u, U, 0.5, -0.001, 100, told);
    NAME_ensemble(N, all[3], k, K, u, 0, 0.5, 0.1, 1e-12, 0, status);
    wrong += NAME_ensemble_device(N, all[4], k, K, u, 0, 0.5, 0.1, 1e-12, h, told);
    wrong += NAME_ensemble_device(0, 0, 0, 0, 0, 0, 0, 1, 1e-12, 0, 0);
    if (wrong) return 2;
    for (int i = 0; i < N; ++i) {
        printf("%d %d %g\\n", status[i], told[i], h[i]);
        for (int j = 0; j < NAME_N_STATE; ++j) {
            for (double *one : all) printf("%.17g ", one[i*NAME_N_STATE + j]);
        }
    }
}
"""


@pytest.mark.parametrize(
    ("name", "options"),
    [("so3", {}), ("top", {"attitude": "quaternion"}), ("se3", {"frame": "principal"}), (FALL, {})],
)
def test_an_ensemble_of_threads_ends_where_that_of_the_host_does(name, options, tmp_path):
    """Backwards, each with constants or inputs of its own, in more blocks than one; of points some
    fall into a centre, and one is nowhere."""
    need("g++")
    problem = tmp_path / "line.toml" if name == FALL else name
    (tmp_path / "line.toml").write_text(FALLING)
    derive.derive(problem).emit(tmp_path, ("c",), form="header", ensemble=True, **options)
    (tmp_path / "main.cpp").write_text(ENSEMBLES.replace("NAME", name))
    command = ["g++", *STRICT, *AS_DEVICE, "main.cpp", "-o", "main", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    f = derive.compile(problem, **options)
    x = 0.5 * np.random.default_rng(2).normal(size=(300, len(f.STATE)))
    for i, name_of in enumerate(f.STATE):
        if re.match(r"A_|q_", name_of):
            x[:, i] = name_of in ("A_11", "A_22", "A_33", "q_0")
    bad = []
    if name == FALL:
        bad = [3, *range(0, 300, 7)]
        x[:, f.STATE.index("T_1")] = 100
        x[bad, f.STATE.index("T_1")] = [np.nan, *[0.01] * 43]
    given = " ".join(repr(float(v)) for v in (*f.p, *x.ravel()))
    done = subprocess.run(
        tmp_path / "main", input=given, capture_output=True, text=True, check=True
    )
    rows = np.array(done.stdout.split(), float).reshape(300, -1)
    assert np.array_equal(rows[:, 0], rows[:, 1])
    assert [*np.flatnonzero(rows[:, 0])] == sorted(bad)
    good = rows[:, 0] == 0
    assert (rows[good, 2] > 0).all()
    ends = np.moveaxis(rows[good, 3:].reshape(good.sum(), -1, 5), -1, 0)
    assert np.array_equal(ends[0], x[good])
    assert (np.abs(ends[1:] - ends[0]).max(axis=(1, 2)) > 1e-2).all()
    assert np.abs(ends[2] - ends[1]).max() < 1e-13 * np.abs(ends).max()
    assert np.abs(ends[4] - ends[3]).max() < 1e-10 * np.abs(ends).max()


@needs("nvcc")
@pytest.mark.parametrize(("name", "most"), [("so3", 2000), ("top", 1000), ("se3", 4000)])
def test_the_compiler_of_cuda_keeps_motions_in_registers(name, most, tmp_path):
    """Without a warning; a motion that is in memory would take some ten thousand bytes there."""
    derive.derive(name).emit(tmp_path, ("c",), form="header", ensemble=True)
    (tmp_path / "main.cu").write_text(f'#include "{name}_steps.h"\nint main() {{ return 0; }}\n')
    command = [nvcc(), "-O3", "-arch=sm_90", "-Xptxas", "-v", "-c", "main.cu", "-o", "main.o"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "warning" not in done.stderr
    frames = [int(n) for n in re.findall(r"(\d+) bytes stack frame", done.stderr)]
    assert len(frames) >= 2
    assert max(frames) < most
