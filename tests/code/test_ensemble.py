"""Many motions at once: the same as one by one, each with a step and an end of its own."""

import subprocess

import numpy as np
import pytest

import derive
from tests.problems.line import FALLING
from tests.support.needs import CC, need

AT_ONE = [1.0, 0, 0, 0, 1, 0, 0, 0, 1]


def many(f, n, seed=4):
    """States at the identity, of velocities up to 9."""
    rng = np.random.default_rng(seed)
    rest = len(f.STATE) - 9
    return np.array([[*AT_ONE, *(9 * rng.uniform(-1, 1, rest))] for _ in range(n)])


@pytest.mark.parametrize("flags", [(), ("-DWIDTH_LANES=4",), ("-DWIDTH_LANES=1",), ("-O0",)])
@pytest.mark.parametrize("problem", ["so3", "sl3"])
def test_each_is_that_of_one_by_one(problem, flags):
    width = [x.replace("WIDTH", problem) for x in flags]
    common = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared")
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


def test_parameters_of_their_own():
    f = derive.compile("so3", step="gauss", ensemble=True)
    p = np.tile(f.p, (10, 1)) * np.linspace(0.9, 1.1, 10)[:, None]
    x, steps = many(f, 10), np.zeros(10)
    found, _ = f.ensemble(x, 0, 1, 1e-12, parameters=p, h=steps)
    assert (steps > 0).all()
    for own, one, end in zip(p, x, found, strict=True):
        assert np.abs(f.use(own).begin(one).move_to(1, 1e-14).x - end).max() < 1e-10
    f.use()


FIXED = """\
#include "{name}_steps.h"
#include <stdio.h>
#define N {n}
static double given(void) {{ double x = 0; return scanf("%lf", &x) == 1 ? x : 0; }}
int main(void)
{{
    static double x[N][{name}_N_STATE], k[N][{name}_SIZE_K], u[N][{name}_SIZE_U];
    for (int i = 0; i < N; ++i) {{
        double p[{name}_SIZE_P];
        for (int j = 0; j < {name}_N_PARAMETERS; ++j) p[j] = given();
        for (int j = 0; j < {name}_N_INPUTS; ++j) u[i][j] = given();
        for (int j = 0; j < {name}_N_STATE; ++j) x[i][j] = given();
        if ({name}_constants(p, k[i])) return 1;
    }}
    static int status[N];
    double off = 0;
    for (int each = 0; each < 2; ++each) {{
        static double many[N][{name}_N_STATE];
        memcpy(many, x, sizeof x);
        {name}_ensemble_rk4(N, many[0], k[0], each*{name}_SIZE_K, u[0], each*{name}_SIZE_U, 0.5,
            -0.01, 40);
        for (int i = 0; i < N; ++i) {{
            {name}_motion m;
            {name}_begin(&m, 0.5, x[i]);
            if ({name}_rk4(&m, k[i*each], u[i*each], -0.01, 40)) return 2;
            for (int j = 0; j < {name}_N_STATE; ++j) {{
                printf("%.17g %.17g %.17g\\n", x[i][j], m.x[j], many[i][j]);
            }}
        }}
        memcpy(many, x, sizeof x);
        if ({name}_ensemble(N, many[0], k[0], each*{name}_SIZE_K, u[0], each*{name}_SIZE_U, 0.5,
            0.1, 1e-13, 0, status)) return 3;
        for (int i = 0; i < N; ++i) {{
            {name}_motion m;
            {name}_begin(&m, 0.5, x[i]);
            if ({name}_vern9_to(&m, k[i*each], u[i*each], 0.1, 1e-14)) return 4;
            for (int j = 0; j < {name}_N_STATE; ++j) {{
                off = fmax(off, fabs(m.x[j] - many[i][j]));
            }}
        }}
    }}
    printf("%.17g\\n", off);
    return 0;
}}
"""


@pytest.mark.parametrize("problem", ["so3", "se3", "sl3"])
def test_all_are_those_of_one_by_one(problem, tmp_path):
    """Backwards, of one body under one force, then each of its own: by Kutta's steps of one size,
    and by Verner's of their own size, one by one with another tolerance."""
    need("cc")
    derive.derive(problem).emit(tmp_path, ("c",), step=("rk4", "vern9"), ensemble=True)
    f, rng, n = derive.compile(problem), np.random.default_rng(7), 21
    p = f.p * rng.uniform(0.95, 1.05, size=(n, len(f.p)))
    x = many(f, n) * np.array([1.0] * 9 + [0.1] * (len(f.STATE) - 9))
    rows = np.hstack([p, rng.normal(size=(n, len(f.INPUTS))), x])
    (tmp_path / "main.c").write_text(FIXED.format(name=problem, n=n))
    strict = [CC, "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-o", "main"]
    subprocess.run([*strict, "main.c", f"{problem}.c", "-lm"], cwd=tmp_path, check=True)
    given = " ".join(repr(float(v)) for v in rows.flat)
    done = subprocess.run(
        [str(tmp_path / "main")], input=given, capture_output=True, text=True, check=True
    )
    *printed, off = np.array(done.stdout.split(), float)
    start, one, found = np.array(printed).reshape(2, n, len(f.STATE), 3).T
    assert off < 1e-10 * np.abs(one).max()
    assert np.abs(found - one).max() < 1e-13 * np.abs(one).max()
    assert (np.abs(one - start).max(0) > 1e-2).all()
    assert np.abs(one[..., 0] - one[..., 1])[:, 1:].max(0).min() > 1e-4


def test_a_motion_that_ends_leaves_the_others(tmp_path):
    """Points that fall into a centre from 1 and from 100, one of no number, and more than lanes."""
    (tmp_path / "line.toml").write_text(FALLING)
    f = derive.compile(tmp_path / "line.toml", ensemble=True)
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
