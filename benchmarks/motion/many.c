/* Many motions at once, timed. */
#include "names.h"
#include <stdlib.h>
#include <time.h>
#include TEXT(STEPS)

/* The least seconds of some runs of n motions from x to t1, which end in out: by the ensemble, or
 * where each is not 0 by gauss, one after the other.  Negative where one is not made. */
double many(int each, size_t n, const double *x, const double *k, double t1, double tol, int repeats, double *out)
{
    double best = 1e300;
    int *status = (int *)malloc(n*sizeof *status);
    for (int r = 0; r < repeats; ++r) {
        struct timespec a, b;
        double seconds;
        size_t failed = 0;
        memcpy(out, x, n*OWN(N_STATE)*sizeof *x);
        clock_gettime(CLOCK_MONOTONIC, &a);
        if (each) {
            for (size_t i = 0; i < n; ++i) {
                OWN(motion) m;
                OWN(begin)(&m, 0, out + i*OWN(N_STATE));
                failed += OWN(gauss_to)(&m, k, 0, t1, tol) != 0;
                memcpy(out + i*OWN(N_STATE), m.x, sizeof m.x);
            }
        } else {
            failed = OWN(ensemble)(n, out, k, 0, 0, 0, 0, t1, tol, 0, status);
        }
        clock_gettime(CLOCK_MONOTONIC, &b);
        seconds = (double)(b.tv_sec - a.tv_sec) + 1e-9*(double)(b.tv_nsec - a.tv_nsec);
        best = failed ? -1 : seconds < best ? seconds : best;
    }
    free(status);
    return best;
}
