/* Runs of the steps that are emitted for NAME, by METHOD, timed. */
#include "names.h"
#include <time.h>
#include TEXT(STEPS)

enum { GAUSS, GAUSS_TO, VERN9, VERN9_TO };

/* The least seconds of some runs from x at time 0 to t1, to out; by steps whose number, or whose
 * tolerance is given.  Negative: what the step returned. */
double run(int method, const double *x, const double *k, double t1, double n, double tol, int repeats, double *out)
{
    double best = 1e300;
    for (int i = 0; i < repeats; ++i) {
        struct timespec a, b;
        double seconds;
        int code = 0;
        OWN(motion) m;
        clock_gettime(CLOCK_MONOTONIC, &a);
        OWN(begin)(&m, 0, x);
        switch (method) {
        case GAUSS:
            code = OWN(gauss)(&m, k, 0, t1/n, (size_t)n);
            break;
        case GAUSS_TO:
            code = OWN(gauss_to)(&m, k, 0, t1, tol);
            break;
        case VERN9:
            code = OWN(vern9)(&m, k, 0, t1/n, (size_t)n);
            break;
        case VERN9_TO:
            code = OWN(vern9_to)(&m, k, 0, t1, tol);
            break;
        }
        clock_gettime(CLOCK_MONOTONIC, &b);
        if (code) {
            return -code;
        }
        memcpy(out, m.x, sizeof m.x);
        seconds = (double)(b.tv_sec - a.tv_sec) + 1e-9*(double)(b.tv_nsec - a.tv_nsec);
        best = seconds < best ? seconds : best;
    }
    return best;
}

/* The right-hand side with the arguments of LSODA in numbalsoda. */
void rhs(double t, double *x, double *dx, double *k)
{
    OWN(rhs)(t, x, k, 0, dx);
}
