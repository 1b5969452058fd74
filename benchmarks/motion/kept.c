/* What a long run by steps of one size leaves of the group and of the integrals. */
#include "names.h"
#include TEXT(STEPS)

enum { SAMPLES = 1000 };

static void integrals(const OWN(motion) *m, const double *k, double *out)
{
#ifdef CONSERVED
    OWN(conserved)(m->t, m->x, k, out);
#else
    out[0] = OWN(energy)(m->t, m->x, k);
#endif
}

/* Largest over n steps of size h: how far off the group; the change of the energy, relative; that of
 * the momenta, relative to the largest of them.  What the step returned. */
int kept(const double *x, const double *k, double h, double n, double *out)
{
    double first[16] = {0}, now[16] = {0}, size = 0;
    OWN(motion) m;
    OWN(begin)(&m, 0, x);
    integrals(&m, k, first);
    for (int i = 1; i < 16; ++i) {
        size = fmax(size, fabs(first[i]));
    }
    out[0] = out[1] = out[2] = 0;
    for (int sample = 0; sample < SAMPLES; ++sample) {
        const int code = OWN(gauss)(&m, k, 0, h, (size_t)(n/SAMPLES));
        if (code) {
            return code;
        }
        integrals(&m, k, now);
        out[0] = fmax(out[0], OWN(defect)(m.x));
        out[1] = fmax(out[1], fabs(now[0]/first[0] - 1));
        for (int i = 1; i < 16 && size > 0; ++i) {
            out[2] = fmax(out[2], fabs(now[i] - first[i])/size);
        }
    }
    return 0;
}
