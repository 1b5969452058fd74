/* The plane keeps its area: one second of it, and its energy. */
#include "swing.h"

#include <math.h>
#include <stdio.h>

enum { N = swing_N_STATE };

/* One step of the classical Runge-Kutta method. */
static void step(double t, double h, double *x, const double *k)
{
    const double at[4] = {0, 0.5, 0.5, 1}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    double y[N], slope[N] = {0}, sum[N] = {0};
    for (int stage = 0; stage < 4; ++stage) {
        for (int i = 0; i < N; ++i) y[i] = x[i] + at[stage] * h * slope[i];
        swing_rhs(t + at[stage] * h, y, k, NULL, slope);
        for (int i = 0; i < N; ++i) sum[i] += weight[stage] * slope[i];
    }
    for (int i = 0; i < N; ++i) x[i] += h * sum[i];
}

int main(void)
{
    const double p[swing_N_PARAMETERS] = {2.0}; /* k */
    double x[N] = {1, 0, 0, 1, 0.3, 0.2, -0.5};
    double k[swing_SIZE_K];
    const int steps = 2000;
    const double h = 1.0 / steps;

    if (swing_constants(p, k) != 0) {
        fprintf(stderr, "the mass matrix is singular\n");
        return 1;
    }
    const double before = swing_energy(0, x, k);
    for (int i = 0; i < steps; ++i) step(i * h, h, x, k);
    const double drift = fabs(swing_energy(1, x, k) - before) / (1 + fabs(before));
    printf("swing: x[0] = %.6f, energy drift %.1e\n", x[0], drift);
    return drift < 1e-9 && fabs(x[0] - 1) > 1e-3 ? 0 : 1;
}
