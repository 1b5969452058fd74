/* P3 by hand: four points moved by SL(3), six springs.  104 mul, 88 add, 1 div.
 *
 * State as in p3.h: A row by row, then Z without its last entry, row by row.
 * Parameters p as in p3.h: (m, x, y, z) of the four points, then k12 k13 k14 k23 k24 k34.
 *
 * dZ/dt = l C^-1 J^-1 - Z^2 - K J^-1, with C = A^T A and l such that the trace stays 0.
 */
#include <stddef.h>

#define X(i) x[(i)*n]
#define DX(i) dx[(i)*n]

/* s += weight * d d^T, the entries 11 12 13 22 23 33 */
static void add_square(double weight, const double *d, double *s)
{
    s[0] += weight*d[0]*d[0];
    s[1] += weight*d[0]*d[1];
    s[2] += weight*d[0]*d[2];
    s[3] += weight*d[1]*d[1];
    s[4] += weight*d[1]*d[2];
    s[5] += weight*d[2]*d[2];
}

void expert_p3_constants(const double *restrict p, double *restrict k)
{
    static const int entry[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    double J[6] = {0}, K[6] = {0}, R[6], trace = 0;
    for (int i = 0, e = 16; i < 4; ++i) {
        const double *r = p + 4*i + 1;
        add_square(p[4*i], r, J);
        for (int j = i + 1; j < 4; ++j, ++e) {
            const double *q = p + 4*j + 1, d[3] = {r[0] - q[0], r[1] - q[1], r[2] - q[2]};
            add_square(p[e], d, K);
        }
    }
    R[0] = J[3]*J[5] - J[4]*J[4];
    R[1] = J[2]*J[4] - J[1]*J[5];
    R[2] = J[1]*J[4] - J[2]*J[3];
    R[3] = J[0]*J[5] - J[2]*J[2];
    R[4] = J[1]*J[2] - J[0]*J[4];
    R[5] = J[0]*J[3] - J[1]*J[1];
    const double det = J[0]*R[0] + J[1]*R[1] + J[2]*R[2];

    /* Only l J^-1 matters, and l follows from the trace: scale J^-1 so that its 33 is 1. */
    for (int i = 0; i < 5; ++i) {
        k[i] = R[i]/R[5];
    }
    for (int i = 0; i < 3; ++i) { /* K J^-1 row by row; of its last entry, the trace */
        for (int j = 0; j < 3; ++j) {
            double sum = 0;
            for (int l = 0; l < 3; ++l) {
                sum += K[entry[i][l]]*R[entry[l][j]];
            }
            trace += i == j ? sum/det : 0;
            k[5 + 3*i + j] = i*j == 4 ? trace : sum/det;
        }
    }
}

static inline __attribute__((always_inline)) void core(size_t n, const double *restrict x, const double *restrict k,
    double *restrict dx)
{
    const double A11 = X(0), A12 = X(1), A13 = X(2);
    const double A21 = X(3), A22 = X(4), A23 = X(5);
    const double A31 = X(6), A32 = X(7), A33 = X(8);
    const double Z11 = X(9), Z12 = X(10), Z13 = X(11);
    const double Z21 = X(12), Z22 = X(13), Z23 = X(14);
    const double Z31 = X(15), Z32 = X(16), Z33 = -(Z11 + Z22);
    const double R11 = k[0], R12 = k[1], R13 = k[2], R22 = k[3], R23 = k[4]; /* R33 = 1 */

    /* C = A^T A, and its inverse D is its adjugate, as det A = 1 */
    const double C11 = A11*A11 + A21*A21 + A31*A31;
    const double C12 = A11*A12 + A21*A22 + A31*A32;
    const double C13 = A11*A13 + A21*A23 + A31*A33;
    const double C22 = A12*A12 + A22*A22 + A32*A32;
    const double C23 = A12*A13 + A22*A23 + A32*A33;
    const double C33 = A13*A13 + A23*A23 + A33*A33;
    const double D11 = C22*C33 - C23*C23, D12 = C13*C23 - C12*C33, D13 = C12*C23 - C13*C22;
    const double D22 = C11*C33 - C13*C13, D23 = C12*C13 - C11*C23, D33 = C11*C22 - C12*C12;

    /* dA/dt = A Z */
    DX(0) = A11*Z11 + A12*Z21 + A13*Z31;
    DX(1) = A11*Z12 + A12*Z22 + A13*Z32;
    DX(2) = A11*Z13 + A12*Z23 + A13*Z33;
    DX(3) = A21*Z11 + A22*Z21 + A23*Z31;
    DX(4) = A21*Z12 + A22*Z22 + A23*Z32;
    DX(5) = A21*Z13 + A22*Z23 + A23*Z33;
    DX(6) = A31*Z11 + A32*Z21 + A33*Z31;
    DX(7) = A31*Z12 + A32*Z22 + A33*Z32;
    DX(8) = A31*Z13 + A32*Z23 + A33*Z33;

    /* the diagonals of D R and of Z^2: products of mirrored entries serve twice */
    const double p12 = D12*R12, p13 = D13*R13, p23 = D23*R23;
    const double G11 = D11*R11 + p12 + p13, G22 = D22*R22 + p12 + p23, G33 = D33 + p13 + p23;
    const double q12 = Z12*Z21, q13 = Z13*Z31, q23 = Z23*Z32;
    const double S11 = Z11*Z11 + q12 + q13, S22 = Z22*Z22 + q12 + q23, S33 = Z33*Z33 + q13 + q23;
    const double l = (k[13] + S11 + S22 + S33)/(G11 + G22 + G33);

    /* Off the diagonal (Z^2)_ij = Z_ik Z_kj - Z_ij Z_kk, k the third index, as Tr Z = 0. */
    DX(9) = l*G11 - S11 - k[5];
    DX(10) = l*(D11*R12 + D12*R22 + D13*R23) + Z12*Z33 - Z13*Z32 - k[6];
    DX(11) = l*(D11*R13 + D12*R23 + D13) + Z13*Z22 - Z12*Z23 - k[7];
    DX(12) = l*(D12*R11 + D22*R12 + D23*R13) + Z21*Z33 - Z23*Z31 - k[8];
    DX(13) = l*G22 - S22 - k[9];
    DX(14) = l*(D12*R13 + D22*R23 + D23) + Z23*Z11 - Z21*Z13 - k[10];
    DX(15) = l*(D13*R11 + D23*R12 + D33*R13) + Z31*Z22 - Z32*Z21 - k[11];
    DX(16) = l*(D13*R12 + D23*R22 + D33*R23) + Z32*Z11 - Z31*Z12 - k[12];
}

void expert_p3(const double *restrict x, const double *restrict k, double *restrict dx)
{
    core(1, x, k, dx);
}

void expert_p3_batch(size_t n, const double *restrict x, const double *restrict k,
    double *restrict dx)
{
#pragma GCC ivdep /* the rows of dx do not overlap: gcc cannot know, n is not a constant */
    for (size_t s = 0; s < n; ++s) {
        core(n, x + s, k, dx + s);
    }
}
