/* P2 by hand: a free solid, c != 0, gravity, a zero-length spring from b to a.  94 mul, 74 add.
 *
 * State as in p2.h: A row by row, T, the angular velocity w and the velocity v of the body's
 * origin, both in the body frame.
 * Parameters p as in p2.h: m, c (3), J (11 12 13 22 23 33), g (3), k, b (3), a (3).
 */
#include <stddef.h>

#define X(i) x[(i)*n]
#define DX(i) dx[(i)*n]

void expert_p2_constants(const double *restrict p, double *restrict k)
{
    const double m = p[0], s1 = p[1]/m, s2 = p[2]/m, s3 = p[3]/m; /* centre of mass */
    /* inertia about the centre of mass, by the theorem of Huygens and Steiner */
    const double i11 = p[7] + p[9] - m*(s2*s2 + s3*s3);
    const double i22 = p[4] + p[9] - m*(s1*s1 + s3*s3);
    const double i33 = p[4] + p[7] - m*(s1*s1 + s2*s2);
    const double i12 = m*s1*s2 - p[5], i13 = m*s1*s3 - p[6], i23 = m*s2*s3 - p[8];
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
    k[10] = s1;
    k[11] = s2;
    k[12] = s3;
    k[13] = p[14];
    k[14] = p[15];
    k[15] = p[16];
    k[16] = p[17];
    k[17] = p[18];
    k[18] = p[19];
    k[19] = p[10];
    k[20] = p[11];
    k[21] = p[12];
    /* lever of the spring about the centre of mass, with its stiffness: moment = h x e */
    k[22] = s*p[13]*(s1 - p[14]);
    k[23] = s*p[13]*(s2 - p[15]);
    k[24] = s*p[13]*(s3 - p[16]);
    k[25] = p[13]/m;
}

static inline __attribute__((always_inline)) void core(size_t n, const double *restrict x, const double *restrict k,
    double *restrict dx)
{
    const double A11 = X(0), A12 = X(1), A13 = X(2);
    const double A21 = X(3), A22 = X(4), A23 = X(5);
    const double A31 = X(6), A32 = X(7), A33 = X(8);
    const double T1 = X(9), T2 = X(10), T3 = X(11);
    const double w1 = X(12), w2 = X(13), w3 = X(14);
    const double v1 = X(15), v2 = X(16), v3 = X(17);

    /* dA/dt = A j(w), dT/dt = A v */
    DX(0) = A12*w3 - A13*w2;
    DX(1) = A13*w1 - A11*w3;
    DX(2) = A11*w2 - A12*w1;
    DX(3) = A22*w3 - A23*w2;
    DX(4) = A23*w1 - A21*w3;
    DX(5) = A21*w2 - A22*w1;
    DX(6) = A32*w3 - A33*w2;
    DX(7) = A33*w1 - A31*w3;
    DX(8) = A31*w2 - A32*w1;
    DX(9) = A11*v1 + A12*v2 + A13*v3;
    DX(10) = A21*v1 + A22*v2 + A23*v3;
    DX(11) = A31*v1 + A32*v2 + A33*v3;

    /* extension of the spring, in the body frame: e = b + A^T (T - a) */
    const double d1 = T1 - k[16], d2 = T2 - k[17], d3 = T3 - k[18];
    const double e1 = k[13] + A11*d1 + A21*d2 + A31*d3;
    const double e2 = k[14] + A12*d1 + A22*d2 + A32*d3;
    const double e3 = k[15] + A13*d1 + A23*d2 + A33*d3;

    /* force by unit of mass, in the body frame: A^T g - (k/m) e */
    const double f1 = k[19]*A11 + k[20]*A21 + k[21]*A31 - k[25]*e1;
    const double f2 = k[19]*A12 + k[20]*A22 + k[21]*A32 - k[25]*e2;
    const double f3 = k[19]*A13 + k[20]*A23 + k[21]*A33 - k[25]*e3;

    /* the shifted, scaled inertia on w; balance of moments about the centre of mass */
    const double L1 = k[0]*w1 + k[1]*w2 + k[2]*w3;
    const double L2 = k[1]*w1 + k[3]*w2 + k[4]*w3;
    const double L3 = k[2]*w1 + k[4]*w2;
    const double N1 = k[23]*e3 - k[24]*e2 + L2*w3 - L3*w2;
    const double N2 = k[24]*e1 - k[22]*e3 + L3*w1 - L1*w3;
    const double N3 = k[22]*e2 - k[23]*e1 + L1*w2 - L2*w1;
    const double W1 = k[5]*N1 + k[6]*N2 + k[7]*N3;
    const double W2 = k[6]*N1 + k[8]*N2 + k[9]*N3;
    const double W3 = k[7]*N1 + k[9]*N2 + N3;

    /* velocity of the centre of mass, u = v + w x s */
    const double u1 = v1 + w2*k[12] - w3*k[11];
    const double u2 = v2 + w3*k[10] - w1*k[12];
    const double u3 = v3 + w1*k[11] - w2*k[10];

    /* du/dt = f + u x w, brought back to the origin: dv/dt = du/dt + s x dw/dt */
    DX(12) = W1;
    DX(13) = W2;
    DX(14) = W3;
    DX(15) = f1 + u2*w3 - u3*w2 + k[11]*W3 - k[12]*W2;
    DX(16) = f2 + u3*w1 - u1*w3 + k[12]*W1 - k[10]*W3;
    DX(17) = f3 + u1*w2 - u2*w1 + k[10]*W2 - k[11]*W1;
}

void expert_p2(const double *restrict x, const double *restrict k, double *restrict dx)
{
    core(1, x, k, dx);
}

void expert_p2_batch(size_t n, const double *restrict x, const double *restrict k,
    double *restrict dx)
{
#pragma GCC ivdep /* the rows of dx do not overlap: gcc cannot know, n is not a constant */
    for (size_t s = 0; s < n; ++s) {
        core(n, x + s, k, dx + s);
    }
}
