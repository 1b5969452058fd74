/* P1 by hand: a solid about a fixed point, all moments, gravity.  55 mul, 35 add.
 *
 * State as in p1.h: A row by row, then the angular velocity w in the body frame.
 * Parameters p as in p1.h: c (3), J (11 12 13 22 23 33), g (3).
 */
#include <stddef.h>

#define X(i) x[(i)*n]
#define DX(i) dx[(i)*n]

void expert_p1_constants(const double *restrict p, double *restrict k)
{
    const double c1 = p[0], c2 = p[1], c3 = p[2];
    /* inertia about the fixed point: I = (Tr J) 1 - J */
    const double i11 = p[6] + p[8], i22 = p[3] + p[8], i33 = p[3] + p[6];
    const double i12 = -p[4], i13 = -p[5], i23 = -p[7];
    const double a11 = i22*i33 - i23*i23, a12 = i13*i23 - i12*i33, a13 = i12*i23 - i13*i22;
    const double a22 = i11*i33 - i13*i13, a23 = i12*i13 - i11*i23, a33 = i11*i22 - i12*i12;
    const double det = i11*a11 + i12*a12 + i13*a13;
    /* Scale the balance of moments by s = (I^-1)_33 > 0: the inverse then has a 1 at 33. */
    const double s = a33/det;

    /* Iw x w does not change when I loses a multiple of 1: take I_33 off, and an entry is 0. */
    k[0] = s*(i11 - i33);
    k[1] = s*i12;
    k[2] = s*i13;
    k[3] = s*(i22 - i33);
    k[4] = s*i23;
    k[5] = a11/a33;
    k[6] = a12/a33;
    k[7] = a13/a33;
    k[8] = a22/a33;
    k[9] = a23/a33;
    k[10] = s*c1;
    k[11] = s*c2;
    k[12] = s*c3;
    k[13] = p[9];
    k[14] = p[10];
    k[15] = p[11];
}

static inline __attribute__((always_inline)) void core(size_t n, const double *restrict x, const double *restrict k,
    double *restrict dx)
{
    const double A11 = X(0), A12 = X(1), A13 = X(2);
    const double A21 = X(3), A22 = X(4), A23 = X(5);
    const double A31 = X(6), A32 = X(7), A33 = X(8);
    const double w1 = X(9), w2 = X(10), w3 = X(11);

    /* dA/dt = A j(w): each row is row x w */
    DX(0) = A12*w3 - A13*w2;
    DX(1) = A13*w1 - A11*w3;
    DX(2) = A11*w2 - A12*w1;
    DX(3) = A22*w3 - A23*w2;
    DX(4) = A23*w1 - A21*w3;
    DX(5) = A21*w2 - A22*w1;
    DX(6) = A32*w3 - A33*w2;
    DX(7) = A33*w1 - A31*w3;
    DX(8) = A31*w2 - A32*w1;

    /* gravity in the body frame */
    const double g1 = k[13]*A11 + k[14]*A21 + k[15]*A31;
    const double g2 = k[13]*A12 + k[14]*A22 + k[15]*A32;
    const double g3 = k[13]*A13 + k[14]*A23 + k[15]*A33;

    /* the shifted, scaled inertia on w */
    const double L1 = k[0]*w1 + k[1]*w2 + k[2]*w3;
    const double L2 = k[1]*w1 + k[3]*w2 + k[4]*w3;
    const double L3 = k[2]*w1 + k[4]*w2;

    /* c x g + L x w */
    const double N1 = k[11]*g3 - k[12]*g2 + L2*w3 - L3*w2;
    const double N2 = k[12]*g1 - k[10]*g3 + L3*w1 - L1*w3;
    const double N3 = k[10]*g2 - k[11]*g1 + L1*w2 - L2*w1;

    DX(9) = k[5]*N1 + k[6]*N2 + k[7]*N3;
    DX(10) = k[6]*N1 + k[8]*N2 + k[9]*N3;
    DX(11) = k[7]*N1 + k[9]*N2 + N3;
}

void expert_p1(const double *restrict x, const double *restrict k, double *restrict dx)
{
    core(1, x, k, dx);
}

void expert_p1_batch(size_t n, const double *restrict x, const double *restrict k,
    double *restrict dx)
{
#pragma GCC ivdep /* the rows of dx do not overlap: gcc cannot know, n is not a constant */
    for (size_t s = 0; s < n; ++s) {
        core(n, x + s, k, dx + s);
    }
}
