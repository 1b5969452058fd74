/* The end of a motion in quad precision, by two methods that share the right-hand side alone. */
#include <math.h>
#include <quadmath.h>
#include <stddef.h>
#include <string.h>
#include "names.h"
typedef double number;
#define double __float128
#define sqrt sqrtq
#define fabs fabsq
#include TEXT(SOURCE)

enum { N = OWN(N_STATE), STAGES = 16, COLUMNS = 14 };

static double constants[OWN(SIZE_K)];

static void rates(const double *x, double *dx)
{
    OWN(rhs)(0, x, constants, 0, dx);
}

/* Gragg's and Bulirsch and Stoer's extrapolation of the midpoint rule, 2, 4, … substeps. */
static void extrapolated(double *x, double h)
{
    static double table[COLUMNS][N];
    double dx[N], a[N], b[N];
    for (int j = 0; j < COLUMNS; ++j) {
        const int n = 2*(j + 1);
        const double step = h/n;
        memcpy(a, x, sizeof a);
        rates(x, dx);
        for (int i = 0; i < N; ++i) {
            b[i] = x[i] + step*dx[i];
        }
        for (int s = 1; s < n; ++s) {
            rates(b, dx);
            for (int i = 0; i < N; ++i) {
                const double next = a[i] + 2*step*dx[i];
                a[i] = b[i];
                b[i] = next;
            }
        }
        rates(b, dx);
        for (int i = 0; i < N; ++i) {
            double now = (a[i] + b[i] + step*dx[i])/2;
            for (int l = 0; l < j; ++l) { /* row j of Neville's scheme in h^2 */
                const double ratio = (double)n/(2*(j - l));
                const double next = now + (now - table[l][i])/(ratio*ratio - 1);
                table[l][i] = now;
                now = next;
            }
            table[j][i] = now;
        }
    }
    memcpy(x, table[COLUMNS - 1], sizeof dx);
}

static double nodes[STAGES], weights[STAGES], mu[STAGES][STAGES];

/* Legendre's polynomials P_0(z) … P_STAGES(z). */
static void legendre(double z, double *p)
{
    p[0] = 1;
    p[1] = z;
    for (int n = 1; n < STAGES; ++n) {
        p[n + 1] = ((2*n + 1)*z*p[n] - n*p[n - 1])/(n + 1);
    }
}

/* The nodes c_j and weights b_j of Gauss, and a_ij = b_j sum_k (2k + 1) P_k(2 c_j - 1) times the
 * integral of P_k(2 theta - 1) from 0 to c_i. */
static void prepare(void)
{
    static double p[STAGES][STAGES + 1];
    for (int j = 0; j < STAGES; ++j) {
        double z = -cosq(M_PIq*(j + 0.75Q)/(STAGES + 0.5Q));
        for (int round = 0; round < 12; ++round) {
            legendre(z, p[j]);
            z -= p[j][STAGES]*(1 - z*z)/(STAGES*(p[j][STAGES - 1] - z*p[j][STAGES]));
        }
        legendre(z, p[j]);
        nodes[j] = (1 + z)/2;
        weights[j] = 0;
        for (int k = 0; k < STAGES; ++k) {
            weights[j] += (2*k + 1)*p[j][k]*p[j][k];
        }
        weights[j] = 1/weights[j];
    }
    for (int i = 0; i < STAGES; ++i) {
        for (int j = 0; j < STAGES; ++j) {
            double sum = nodes[i];
            for (int k = 1; k < STAGES; ++k) {
                sum += p[j][k]*(p[i][k + 1] - p[i][k - 1])/2;
            }
            mu[i][j] = weights[j]*sum;
        }
    }
}

static void collocated(double *x, double h)
{
    static double F[STAGES][N];
    double X[N], change = 1;
    rates(x, F[0]);
    for (int j = 1; j < STAGES; ++j) {
        memcpy(F[j], F[0], sizeof F[0]);
    }
    for (int sweep = 0; sweep < 300 && change > 1e-33Q; ++sweep) {
        change = 0;
        for (int i = 0; i < STAGES; ++i) { /* of Gauss and Seidel */
            double dx[N];
            for (int l = 0; l < N; ++l) {
                double sum = 0;
                for (int j = 0; j < STAGES; ++j) {
                    sum += mu[i][j]*F[j][l];
                }
                X[l] = x[l] + h*sum;
            }
            rates(X, dx);
            for (int l = 0; l < N; ++l) {
                const double moved = fabs(h*(dx[l] - F[i][l]));
                change = moved > change ? moved : change;
                F[i][l] = dx[l];
            }
        }
    }
    for (int l = 0; l < N; ++l) {
        double sum = 0;
        for (int j = 0; j < STAGES; ++j) {
            sum += weights[j]*F[j][l];
        }
        x[l] += h*sum;
    }
}

/* The state after n steps to t1, its high and its low part; method: 0 extrapolated, 1 collocated. */
void quad(int method, const number *x0, const number *k, number t1, int n, number *high, number *low)
{
    double x[N];
    for (int i = 0; i < OWN(N_CONSTANTS); ++i) {
        constants[i] = k[i];
    }
    for (int i = 0; i < N; ++i) {
        x[i] = x0[i];
    }
    prepare();
    for (int s = 0; s < n; ++s) {
        if (method) {
            collocated(x, (double)t1/n);
        } else {
            extrapolated(x, (double)t1/n);
        }
    }
    for (int i = 0; i < N; ++i) {
        high[i] = (number)x[i];
        low[i] = (number)(x[i] - high[i]);
    }
}
