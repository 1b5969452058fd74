"""The emitted C in a program that integrates it by CVODE of SUNDIALS."""

import shutil
import subprocess
from pathlib import Path

import pytest

from derive import derive

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
    double k[top_N_CONSTANTS], t = 0;
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


def test_cvode(tmp_path):
    if shutil.which("gcc") is None or not Path("/usr/include/cvode/cvode.h").is_file():
        pytest.skip("no gcc, or no SUNDIALS")
    derive("top").emit(tmp_path, ["cvode"])
    (tmp_path / "main.c").write_text(MAIN)
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O2"]
    libraries = ["-lsundials_cvode", "-lsundials_nvecserial", "-lm"]
    command = ["gcc", *strict, "main.c", "top.c", "-o", "main", *libraries]
    subprocess.run(command, cwd=tmp_path, check=True)
    done = subprocess.run(["./main"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
