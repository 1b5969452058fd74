"""The emitted C in a program that integrates it by CVODE of SUNDIALS."""

import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive import compile, derive
from tests.support.library import module_of
from tests.support.needs import CC, needs

MAIN = """\
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "top_cvode.h"

int main(void)
{
    const double p[] = {800, 0.03, 0.05, 9.81};
    double k[top_SIZE_K], t = 0;
    top_data data = {k, NULL};
    SUNContext context;
    if (top_constants(p, k) || SUNContext_Create(NULL, &context)) return 2;
    N_Vector x = N_VNew_Serial(top_N_STATE, context);
    double *at = N_VGetArrayPointer(x);
    for (int i = 0; i < top_N_STATE; ++i) at[i] = i < 9 && i % 4 == 0;
    at[top_N_STATE - 3] = 3;
    at[top_N_STATE - 1] = 100;
    const double before = top_energy(0, at, k);
    void *memory = CVodeCreate(CV_ADAMS, context);
    if (CVodeInit(memory, top_field, 0, x) || CVodeSStolerances(memory, 1e-11, 1e-12)) return 3;
    SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(x, 0, context);
    if (CVodeSetUserData(memory, &data) || CVodeSetNonlinearSolver(memory, solver)) return 4;
    if (CVodeSetMaxNumSteps(memory, 100000) || CVode(memory, 1, x, &t, CV_NORMAL) < 0) return 5;
    const double drift = fabs(top_energy(t, at, k) / before - 1);
    printf("%.3e\\n", drift);
    return drift > 1e-7;
}
"""

KEPT = """\
#include <cvode/cvode.h>
#include <cvode/cvode_proj.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "top_cvode.h"

int main(int argc, char **argv)
{
    const double p[] = {800, 0.03, 0.05, 9.81};
    double k[top_N_CONSTANTS], t = 0;
    top_data data = {k, NULL};
    SUNContext context;
    if (top_constants(p, k) || SUNContext_Create(NULL, &context)) return 2;
    N_Vector x = N_VNew_Serial(top_N_STATE, context);
    double *at = N_VGetArrayPointer(x);
    for (int i = 0; i < top_N_STATE; ++i) at[i] = i < 9 && i % 4 == 0;
    at[top_N_STATE - 3] = 3;
    at[top_N_STATE - 1] = 100;
    void *memory = CVodeCreate(CV_BDF, context);
    if (CVodeInit(memory, top_field, 0, x) || CVodeSStolerances(memory, 1e-7, 1e-8)) return 3;
    SUNMatrix A = SUNDenseMatrix(top_N_STATE, top_N_STATE, context);
    SUNLinearSolver solver = SUNLinSol_Dense(x, A, context);
    if (CVodeSetUserData(memory, &data) || CVodeSetLinearSolver(memory, solver, A)) return 4;
    if (argc > 1 && atoi(argv[1])) {
        if (CVodeSetProjFn(memory, top_projection)) return 5;
        if (CVodeSetProjErrEst(memory, SUNFALSE)) return 6;
    }
    if (CVodeSetMaxNumSteps(memory, 100000) || CVodeSetStopTime(memory, 1)) return 7;
    if (argc > 1 && argv[1][0] == 'D') { /* the Jacobian at the start, by rows */
        top_jacobian_of_field(0, x, NULL, A, &data, NULL, NULL, NULL);
        for (int i = 0; i < top_N_STATE; ++i)
            for (int j = 0; j < top_N_STATE; ++j) printf("%.17g ", SM_ELEMENT_D(A, i, j));
        return 0;
    }
    long differences = 0; /* evaluations of the field for difference quotients */
    if (argc > 2 && CVodeSetJacFn(memory, top_jacobian_of_field)) return 8;
    if (CVode(memory, 1, x, &t, CV_NORMAL) < 0) return 9; /* at the end of a step */
    if (CVodeGetNumLinRhsEvals(memory, &differences) || (argc > 2) != !differences) return 10;
    printf("%.3e\\n", argc > 2 ? at[top_N_STATE - 3] : top_defect(at));
    return 0;
}
"""


@needs("cc", "SUNDIALS")
def test_cvode_projects_each_step(tmp_path):
    made = derive("top")
    made.emit(tmp_path, ["cvode", "python"], jacobian=["raw"])
    (tmp_path / "main.c").write_text(KEPT)
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O2"]
    kinds = ("cvode", "nvecserial", "sunlinsoldense", "sunmatrixdense")
    libraries = [f"-lsundials_{x}" for x in kinds]
    command = [CC, *strict, "main.c", "top.c", "-o", "main", *libraries, "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    alone, kept = (
        float(subprocess.run(["./main", how], cwd=tmp_path, capture_output=True, check=True).stdout)
        for how in ("0", "1")
    )
    assert kept < 1e-12 < 1e-6 < alone
    solved = subprocess.run(["./main", "1", "J"], cwd=tmp_path, capture_output=True, check=True)
    start = np.concatenate([np.eye(3).ravel(), [3, 0, 100]])
    f = compile("top")
    exact = solve_ivp(f, (0, 1), start, method="DOP853", rtol=1e-11, atol=1e-11).y[9, -1]
    assert abs(float(solved.stdout) - exact) < 1e-3
    entries = subprocess.run(["./main", "D"], cwd=tmp_path, capture_output=True, check=True).stdout
    code = module_of("top", jacobian=("raw",))
    expected = code.jacobian_raw(0.0, start, code.constants([800, 0.03, 0.05, 9.81]))
    found = np.array(entries.split(), float).reshape(expected.shape)
    assert np.abs(found - expected).max() < 1e-12 * np.abs(expected).max()
    assert np.abs(found - found.T).max() > 1


@needs("cc", "SUNDIALS")
def test_cvode(tmp_path):
    derive("top").emit(tmp_path, ["cvode"])
    (tmp_path / "main.c").write_text(MAIN)
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O2"]
    libraries = ["-lsundials_cvode", "-lsundials_nvecserial", "-lm"]
    command = [CC, *strict, "main.c", "top.c", "-o", "main", *libraries]
    subprocess.run(command, cwd=tmp_path, check=True)
    done = subprocess.run(["./main"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


@needs("cc", "SUNDIALS")
@pytest.mark.parametrize(("real", "precision"), [("double", "DOUBLE"), ("float", "SINGLE")])
def test_sundials_of_another_precision_is_refused(real, precision, tmp_path):
    """Its headers say what they were built with; the numbers would be read as the other kind."""
    config = Path("/usr/include/sundials/sundials_config.h")
    built = re.search(r"(?m)^#define SUNDIALS_(\w+)_PRECISION 1", config.read_text())[1]
    derive("top").emit(tmp_path, ["cvode"], real=real)
    (tmp_path / "user.c").write_text('#include "top_cvode.h"\nint user(void) { return 0; }\n')
    strict = [CC, "-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "user.c"]
    for here in ("DOUBLE", "SINGLE"):
        # as if SUNDIALS had been built so
        as_built = f"#undef SUNDIALS_{built}_PRECISION\n#define SUNDIALS_{here}_PRECISION 1\n"
        (tmp_path / "as.h").write_text(f"#include <sundials/sundials_config.h>\n{as_built}")
        done = subprocess.run(
            [*strict, "-include", "as.h"], cwd=tmp_path, capture_output=True, text=True
        )
        assert (done.returncode == 0) == (here == precision), done.stderr
        if here != precision:
            other = {"double": "float", "float": "double"}[real]
            told = f"use SUNDIALS of {precision.lower()} precision, or derive emit --real {other}"
            assert told in done.stderr
