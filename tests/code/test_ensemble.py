"""Many motions at once, on the host and on a device: each is that of one by one, with a step and an
end of its own.

The header with steps is read as CUDA's compiler would take it, run as C++.  The words of CUDA are
those of tests/support/card.h, whose threads come one after the other; where there is a compiler of
CUDA, it compiles ensembles.
"""

import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import derive
from derive.motion.native import nvcc
from tests.problems.moving import FALLING
from tests.support.library import STRICT, built, derived, emission, module_of
from tests.support.needs import CC, need, needs

AT_ONE = [1.0, 0, 0, 0, 1, 0, 0, 0, 1]
CARD = Path(__file__).parents[1] / "support" / "card.h"
AS_DEVICE = ("g++", "-std=c++17", "-O2", "-include", str(CARD), "-Wno-unknown-pragmas")


def many(f, n, seed=4):
    """States at the identity, of velocities up to 9."""
    rng = np.random.default_rng(seed)
    rest = len(f.STATE) - 9
    return np.array([[*AT_ONE, *(9 * rng.uniform(-1, 1, rest))] for _ in range(n)])


@pytest.mark.parametrize("flags", [(), ("-DWIDTH_LANES=4",), ("-DWIDTH_LANES=1",), ("-O0",)])
@pytest.mark.parametrize("problem", ["so3", "sl3"])
def test_each_is_that_of_one_by_one(problem, flags):
    width = [x.replace("WIDTH", problem) for x in flags]
    common = ("-std=c99", *STRICT, "-fPIC", "-shared")
    f = derive.compile(
        problem, step="gauss", ensemble=True, flags=(*common, "-O2", "-march=native", *width)
    )
    x = many(f, 21) * np.array([1.0] * 9 + [0.1] * (len(f.STATE) - 9))
    found, status = f.ensemble(x, 0.5, 1.5, 1e-12)
    assert not status.any()
    exact = np.array([f.begin(one, t=0.5).move_to(1.5, 1e-14).x for one in x])
    assert np.abs(found - exact).max() < 1e-10
    assert max(map(f.defect, found)) < 1e-14
    back, _ = f.ensemble(found, 1.5, 0.5, 1e-12)
    assert np.abs(back - x).max() < 1e-9


ENSEMBLES = """\
#ifdef __cplusplus
#define NAME_LAUNCH launched
#endif
#include "NAME_steps.h"
#include <stdio.h>
/* for each motion the status on the host and on the card, the next step, and each number of the
 * state at the start, one by one, on the host and on the card: by rk4, then by vern9 */
enum { N = 300 };
static double k[N][NAME_SIZE_K], u[N][NAME_SIZE_U], all[7][N][NAME_N_STATE], h[N];
static int status[N], told[N];
static double given(void) { double x = 0; return scanf("%lf", &x) == 1 ? x : 0; }
static int follow(int each)
{
    const size_t K = each ? NAME_SIZE_K : 0, U = each ? NAME_SIZE_U : 0;
    int wrong = 0;
    for (int j = 1; j < 7; ++j) memcpy(all[j], all[0], sizeof all[0]);
    for (int i = 0; i < N; ++i) {
        NAME_motion m;
        NAME_begin(&m, 0.5, all[0][i]);
        NAME_rk4(&m, k[i*each], u[i*each], -0.01, 40);
        memcpy(all[1][i], m.x, sizeof all[1][i]);
        NAME_begin(&m, 0.5, all[0][i]);
        NAME_vern9_to(&m, k[i*each], u[i*each], 0.1, 1e-14);
        memcpy(all[4][i], m.x, sizeof all[4][i]);
    }
    NAME_ensemble_rk4(N, all[2][0], k[0], K, u[0], U, 0.5, -0.01, 40);
    NAME_ensemble(N, all[5][0], k[0], K, u[0], U, 0.5, 0.1, 1e-13, h, status);
#ifdef __cplusplus
    wrong += NAME_ensemble_rk4_device(N, all[3][0], k[0], K, u[0], U, 0.5, -0.01, 40, told);
    wrong += NAME_ensemble_device(N, all[6][0], k[0], K, u[0], U, 0.5, 0.1, 1e-13, h, told);
    wrong += NAME_ensemble_device(0, 0, 0, 0, 0, 0, 0, 1, 1e-12, 0, 0);
#else
    memcpy(all[3], all[2], sizeof all[0]);
    memcpy(all[6], all[5], sizeof all[0]);
    memcpy(told, status, sizeof told);
#endif
    for (int i = 0; i < N; ++i) {
        printf("%d %d %g\\n", status[i], told[i], h[i]);
        for (int j = 0; j < NAME_N_STATE; ++j)
            for (int n = 0; n < 7; ++n) printf("%.17g ", all[n][i][j]);
    }
    return wrong;
}
int main(void)
{
    for (int i = 0; i < N; ++i) {
        double p[NAME_SIZE_P];
        for (int j = 0; j < NAME_N_PARAMETERS; ++j) p[j] = given();
        for (int j = 0; j < NAME_N_INPUTS; ++j) u[i][j] = given();
        for (int j = 0; j < NAME_N_STATE; ++j) all[0][i][j] = given();
        if (NAME_constants(p, k[i])) return 1;
    }
    return follow(0) + follow(1);
}
"""
CASES = {
    "c so3": ("so3", {}),
    "c se3": ("se3", {}),
    "c sl3": ("sl3", {}),
    "device so3": ("so3", {}),
    "device quaternion top": ("top", {"attitude": "quaternion"}),
    "device principal se3": ("se3", {"frame": "principal"}),
    "device line": (FALLING, {}),
}


@pytest.mark.parametrize("case", CASES)
def test_all_are_those_of_one_by_one(case):
    """Backwards, of one body under one force, then each of its own, in more blocks than one: by
    Kutta's steps of one size, and by Verner's of their own size, one by one with another tolerance;
    of points some fall into a centre, and one is nowhere."""
    (problem, options), device = CASES[case], "device" in case
    need("g++" if device else "cc")
    chosen = {"step": ("rk4", "vern9"), "ensemble": True, **options}
    name, texts = emission(problem, ("c",), form="header" if device else "source", **chosen)
    main = "main.cpp" if device else "main.c"
    texts[main] = ENSEMBLES.replace("NAME", name)
    words = AS_DEVICE if device else (CC, "-std=c99", "-O2", f"{name}.c")
    program = built([(*words, *STRICT, main, "-o", "out", "-lm")], texts)
    m, rng, n = module_of(problem, **options), np.random.default_rng(7), 300
    x = 0.5 * rng.normal(size=(n, len(m.STATE)))
    for i, entry in enumerate(m.STATE):
        if re.match(r"A_|q_", entry):
            x[:, i] = entry in ("A_11", "A_22", "A_33", "q_0")
    bad = []
    if name == "line":
        bad = [3, *range(0, n, 7)]
        x[:, m.STATE.index("T_1")] = 100
        x[bad, m.STATE.index("T_1")] = [np.nan, *[0.01] * 43]
    p = np.array([m.DEFAULTS[y] for y in m.PARAMETERS])
    p = p * rng.uniform(0.95, 1.05, (n, len(p)))
    rows = np.hstack([p, rng.normal(size=(n, len(m.INPUTS))), x])
    given = " ".join(repr(float(v)) for v in rows.flat)
    done = subprocess.run([program], input=given, capture_output=True, text=True, check=True)
    found = np.array(done.stdout.split(), float).reshape(2, n, -1)
    ends = []
    for told in found:
        assert np.array_equal(told[:, 0], told[:, 1])
        assert [*np.flatnonzero(told[:, 0])] == sorted(bad)
        good = told[:, 0] == 0
        assert (told[good, 2] > 0).all()
        start, *six = np.moveaxis(told[good, 3:].reshape(good.sum(), -1, 7), -1, 0)
        assert np.array_equal(start, x[good])
        assert all((np.abs(y - start).max(axis=1) > 1e-2).all() for y in six)
        for one, others, close in ((six[0], six[1:3], 1e-13), (six[3], six[4:], 1e-10)):
            assert np.abs(others - one).max() < close * np.abs(one).max()
        ends.append(six[0])
    if m.PARAMETERS or m.INPUTS:  # each has its own
        assert np.abs(ends[1] - ends[0])[1:].max(axis=1).min() > 1e-5


def test_a_motion_that_ends_leaves_the_others():
    """Points that fall into a centre from 1 and from 100, one of no number, and more than lanes."""
    f = derive.compile(derived(FALLING), ensemble=True)
    x = np.zeros((30, len(f.STATE)))
    x[:, f.STATE.index("A_11")] = x[:, f.STATE.index("A_22")] = 1
    x[:, f.STATE.index("T_1")] = 100
    x[::7, f.STATE.index("T_1")] = 1
    x[3, f.STATE.index("T_1")] = np.nan
    found, status = f.ensemble(x, 0, 5, 1e-9)
    assert [*np.flatnonzero(status)] == [0, 3, 7, 14, 21, 28]
    assert status[3] == 2
    assert np.isfinite(np.delete(found, 3, axis=0)).all()
    there = found[status == 0, f.STATE.index("T_1")]
    assert np.ptp(there) == 0
    assert abs(there[0] - (100 - 12.5e-4)) < 1e-7  # -t²/2r² at first


def test_what_is_refused():
    f = derive.compile("so3", ensemble=True)
    with pytest.raises(ValueError, match="rows of 12 numbers"):
        f.ensemble([1.0], 0, 1)
    with pytest.raises(ValueError, match="2 rows of 12 parameters"):
        f.ensemble(many(f, 2), 0, 1, parameters=[[1.0]])
    with pytest.raises(ValueError, match="row 1 of the parameters: no body"):
        f.ensemble(many(f, 2), 0, 1, parameters=[f.p, f.p * np.nan])
    with pytest.raises(ValueError, match="ensemble=True"):
        derive.compile("so3").ensemble(many(f, 2), 0, 1)


def test_a_first_step_that_is_much_too_long():
    """Of 8 rad, far off the group: what is not taken says nothing of the size of a state."""
    f = derive.compile("top", step="gauss", ensemble=True)
    x = np.zeros((9, len(f.STATE)))
    x[:, [0, 4, 8]], x[:, 9], x[:, 11] = 1, 0.5, np.linspace(80, 120, 9)
    found, status = f.ensemble(x, 0, 0.5, 1e-9, h=np.full(9, 0.1))
    assert not status.any()
    exact = np.array([f.begin(one).move_to(0.5, 1e-13).x for one in x])
    assert np.abs(found - exact).max() < 1e-5


# ---------------------------------------------------------------- headers for a device


def headers(name, *steps, **options):
    """Both headers of a problem, by file."""
    return emission(name, ("c",), step=steps, form="header", **options)[1]


@pytest.mark.parametrize(
    ("name", "options"),
    [("so3", {}), ("se3", {"frame": "principal"}), ("top", {"real": "float"}), ("jelly", {})],
)
def test_what_a_device_calls_is_for_it(name, options):
    """Functions for host and device call functions of that kind alone, and read no table that
    stands outside of a function; ``gauss``, in lanes, is for the host."""
    steps = ("rk4",) if options.get("real") == "float" else ("rk4", "vern9")
    text = "".join(headers(name, *steps, **options).values())
    definitions = rf"^{name}_FUNCTION \w[\w ]*?\**({name}_\w+)\([^;{{]*\)\n{{\n(.*?)^}}$"
    bodies = dict(re.findall(definitions, text, re.M | re.S))
    assert {f"{name}_{x}" for x in ("rhs", "begin", "rk4", "dense")} <= {*bodies}
    for function, body in bodies.items():
        called = {*re.findall(rf"\b({name}_\w+)\(", body)}
        assert called <= {*bodies}, (function, called - {*bodies})
    assert not re.search(r"^static (?!inline|__host__)", text, re.M)
    assert "static inline" not in text.replace(f"define {name}_FUNCTION static inline", "")


def test_lanes_are_for_the_host():
    """With what is in lanes the header is still C++ where CUDA's compiler reads it."""
    need("g++")
    texts = headers("so3", "gauss", "rk4", ensemble=True)
    texts["main.cpp"] = '#include "so3_steps.h"\nint main() { return so3_LANES - 1; }\n'
    flags = ("-march=native", "-Dso3_LAUNCH=launched")
    program = built([(*AS_DEVICE, *STRICT, *flags, "main.cpp", "-o", "out", "-lm")], texts)
    subprocess.run([program], check=True)


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
