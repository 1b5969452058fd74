/* A run by CVODE, Adams's method with a fixed-point iteration. */
#include "names.h"
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <time.h>
#include TEXT(HEADER)

static int field(realtype t, N_Vector x, N_Vector dx, void *k)
{
    OWN(rhs)(t, N_VGetArrayPointer(x), (const double *)k, 0, N_VGetArrayPointer(dx));
    return 0;
}

/* Seconds from x at time 0 to t1, to out; negative: what CVODE returned. */
double run(const double *x, const double *k, double t1, double tol, double *out)
{
    struct timespec a, b;
    SUNContext context;
    N_Vector y;
    SUNNonlinearSolver solver;
    void *memory;
    int code;
    realtype t;
    SUNContext_Create(NULL, &context);
    y = N_VNew_Serial(OWN(N_STATE), context);
    memory = CVodeCreate(CV_ADAMS, context);
    for (int i = 0; i < OWN(N_STATE); ++i) {
        N_VGetArrayPointer(y)[i] = x[i];
    }
    CVodeInit(memory, field, 0, y);
    CVodeSStolerances(memory, tol, tol);
    solver = SUNNonlinSol_FixedPoint(y, 0, context);
    CVodeSetNonlinearSolver(memory, solver);
    CVodeSetUserData(memory, (void *)k);
    CVodeSetMaxNumSteps(memory, 1000000000);
    clock_gettime(CLOCK_MONOTONIC, &a);
    code = CVode(memory, t1, y, &t, CV_NORMAL);
    clock_gettime(CLOCK_MONOTONIC, &b);
    for (int i = 0; i < OWN(N_STATE); ++i) {
        out[i] = N_VGetArrayPointer(y)[i];
    }
    CVodeFree(&memory);
    SUNNonlinSolFree(solver);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return code < 0 ? code : (double)(b.tv_sec - a.tv_sec) + 1e-9*(double)(b.tv_nsec - a.tv_nsec);
}
