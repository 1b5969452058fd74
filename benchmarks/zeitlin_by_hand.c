/* Zeitlin's equations by hand, in two roads for one N: a table of the terms, and matrices.
 * The state as in the emitted files. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* L, M: rows of N and of H + 1 numbers up to a multiple of four, which compilers take at once */
enum { H = N / 2, COUNT = (N * N - 1) / 2, L = (N + 3) / 4 * 4, M = (H + 4) / 4 * 4 };

struct term {
    int i, j;
    double si, sj, c;
};
static struct term *terms;
static int first[COUNT + 1];
static double cosine[N], sine[N];

static int place(int a, int b, double *sign)
{
    a = (a + 2 * N + H) % N - H;
    b = (b + 2 * N + H) % N - H;
    *sign = b < 0 || (b == 0 && a < 0) ? -1 : 1;
    if (*sign < 0) {
        a = -a;
        b = -b;
    }
    return b == 0 ? a - 1 : H + (b - 1) * N + a + H;
}

static int square(int a, int b)
{
    a = (a + 2 * N + H) % N - H;
    b = (b + 2 * N + H) % N - H;
    return a * a + b * b;
}

void prepare(void)
{
    const double pi = 4 * atan(1);
    int used = 0;
    for (int k = 0; k < N; ++k) {
        cosine[k] = cos(2 * pi * k / N);
        sine[k] = sin(2 * pi * k / N);
    }
    terms = malloc(sizeof *terms * (N > 13 ? 1 : (size_t)COUNT * COUNT * 2));
    for (int n2 = 0; n2 <= H && N <= 13; ++n2) {
        for (int n1 = n2 ? -H : 1; n1 <= H; ++n1) {
            double sign;
            first[place(n1, n2, &sign)] = used;
            for (int a = -H; a <= H; ++a) {
                for (int b = -H; b <= H; ++b) {
                    const int l = square(n1 - a, n2 - b), m = a * a + b * b;
                    const int here = (a + H) * N + b + H;
                    const int there = ((n1 - a + 2 * N + H) % N) * N + (n2 - b + 2 * N + H) % N;
                    const double c = -N / (2 * pi) * sine[((a * n2 - b * n1) % N + N) % N];
                    if (l == 0 || m == 0 || here >= there || l == m || c == 0) {
                        continue;
                    }
                    struct term *t = &terms[used++];
                    t->i = 2 * place(a, b, &t->si);
                    t->j = 2 * place(n1 - a, n2 - b, &t->sj);
                    t->c = c * (1. / m - 1. / l);
                }
            }
            first[place(n1, n2, &sign) + 1] = used;
        }
    }
}

void by_table(const double *restrict x, double *restrict dx)
{
    for (int n = 0; n < COUNT; ++n) {
        double re = 0, im = 0;
        for (int k = first[n]; k < first[n + 1]; ++k) {
            const struct term t = terms[k];
            const double a = x[t.i], b = t.si * x[t.i + 1], c = x[t.j], d = t.sj * x[t.j + 1];
            re += t.c * (a * c - b * d);
            im += t.c * (a * d + b * c);
        }
        dx[2 * n] = re;
        dx[2 * n + 1] = im;
    }
}

/* E(s) = sum over k of (a, b) cos(2 pi k s/N), O(s) = sum of (c, d) sin(2 pi k s/N) */
static void transform(double in[H + 1][H + 1][4], double out[H + 1][4][M])
{
    for (int d = 0; d <= H; ++d) {
        for (int s = 0; s < M; ++s) {
            out[d][0][s] = in[d][0][0];
            out[d][1][s] = in[d][0][1];
            out[d][2][s] = out[d][3][s] = 0;
        }
    }
    for (int k = 1; k <= H; ++k) {
        double c[M], b[M];
        for (int s = 0, j = 0; s < M; ++s, j = j + k < N ? j + k : j + k - N) {
            c[s] = cosine[j];
            b[s] = sine[j];
        }
        for (int d = 0; d <= H; ++d) {
            const double p = in[d][k][0], q = in[d][k][1], u = in[d][k][2], v = in[d][k][3];
            for (int s = 0; s < M; ++s) {
                out[d][0][s] += p * c[s];
                out[d][1][s] += q * c[s];
                out[d][2][s] += u * b[s];
                out[d][3][s] += v * b[s];
            }
        }
    }
}

static void matrix(const double *x, int stream, double (*re)[L], double (*im)[L])
{
    double in[H + 1][H + 1][4], out[H + 1][4][M];
    for (int d = 0; d <= H; ++d) {
        for (int k = 0; k <= H; ++k) {
            const double w = stream && d + k ? -1. / (d * d + k * k) : 1;
            double p = 0, q = 0, u = 0, v = 0;
            if (d) {
                const double *row = x + 2 * (H + (d - 1) * N + H);
                p = row[2 * k];
                q = row[2 * k + 1];
                u = k ? row[-2 * k] : 0;
                v = k ? row[1 - 2 * k] : 0;
            } else if (k) {
                p = u = x[2 * k - 2];
                q = x[2 * k - 1];
                v = -q;
            }
            in[d][k][0] = w * (p + u);
            in[d][k][1] = w * (q + v);
            in[d][k][2] = w * (p - u);
            in[d][k][3] = w * (q - v);
        }
    }
    transform(in, out);
    for (int d = 0; d <= H; ++d) {
        for (int a = 0; a < N; ++a) {
            const int b = a + d < N ? a + d : a + d - N, s = a + b < N ? a + b : a + b - N;
            const int t = s <= H ? s : N - s;
            const double g = s <= H ? 1 : -1;
            re[a][b] = re[b][a] = out[d][0][t] - g * out[d][3][t];
            im[a][b] = d ? out[d][1][t] + g * out[d][2][t] : 0;
            im[b][a] = -im[a][b];
        }
    }
}

/* [W, P] by n2 and row + column.  A product of complex numbers by three of real ones: from AC, BD and
 * (A + B)(C + D); with four rows of P at once, which is the best of some variants. */
static void bracket(double (*wr)[L], double (*wi)[L], double (*pr)[L], double (*pi)[L],
    double (*sum)[N][2])
{
    static double ps[N][L];
    memset(sum, 0, sizeof(double[H + 1][N][2]));
    for (int a = 0; a < N; ++a) {
        for (int b = 0; b < L; ++b) {
            ps[a][b] = pr[a][b] + pi[a][b];
        }
    }
    for (int a = 0; a < N; ++a) {
        double mr[L] = {0}, mi[L] = {0}, ms[L] = {0};
        int c = 0;
        for (; c + 3 < N; c += 4) {
            const double *u = &wr[a][c], *v = &wi[a][c];
            const double w[4] = {u[0] + v[0], u[1] + v[1], u[2] + v[2], u[3] + v[3]};
            for (int b = 0; b < L; ++b) {
                mr[b] += u[0] * pr[c][b] + u[1] * pr[c + 1][b] + u[2] * pr[c + 2][b]
                    + u[3] * pr[c + 3][b];
                mi[b] += v[0] * pi[c][b] + v[1] * pi[c + 1][b] + v[2] * pi[c + 2][b]
                    + v[3] * pi[c + 3][b];
                ms[b] += w[0] * ps[c][b] + w[1] * ps[c + 1][b] + w[2] * ps[c + 2][b]
                    + w[3] * ps[c + 3][b];
            }
        }
        for (; c < N; ++c) {
            const double u = wr[a][c], v = wi[a][c];
            for (int b = 0; b < L; ++b) {
                mr[b] += u * pr[c][b];
                mi[b] += v * pi[c][b];
                ms[b] += (u + v) * ps[c][b];
            }
        }
        for (int b = 0; b < L; ++b) {
            const double x = mr[b], y = mi[b];
            mr[b] = x - y;
            mi[b] = ms[b] - x - y;
        }
        for (int b = 0; b < N; ++b) {
            const int d = b >= a ? b - a : b - a + N, s = a + b < N ? a + b : a + b - N;
            if (d <= H) {
                sum[d][s][0] += mr[b];
                sum[d][s][1] += mi[b];
            }
            if (d == 0 || d > H) {
                sum[d ? N - d : 0][s][0] -= mr[b];
                sum[d ? N - d : 0][s][1] += mi[b];
            }
        }
    }
}

void by_matrices(const double *restrict x, double *restrict dx)
{
    static double wr[N][L], wi[N][L], pr[N][L], pi[N][L], sum[H + 1][N][2];
    double in[H + 1][H + 1][4], out[H + 1][4][M];
    const double scale = 1 / (16 * atan(1));
    matrix(x, 0, wr, wi);
    matrix(x, 1, pr, pi);
    bracket(wr, wi, pr, pi, sum);
    for (int d = 0; d <= H; ++d) {
        for (int s = 0; s <= H; ++s) {
            const double *f = sum[d][s], *g = sum[d][s ? N - s : 0];
            in[d][s][0] = s ? f[0] + g[0] : f[0];
            in[d][s][1] = s ? f[1] + g[1] : f[1];
            in[d][s][2] = s ? f[0] - g[0] : 0;
            in[d][s][3] = s ? f[1] - g[1] : 0;
        }
    }
    transform(in, out);
    for (int d = 0; d <= H; ++d) {
        for (int k = d ? -H : 1; k <= H; ++k) {
            const int t = abs(k), i = d ? H + (d - 1) * N + k + H : k - 1;
            const double g = k < 0 ? -1 : 1;
            dx[2 * i] = scale * (out[d][1][t] - g * out[d][2][t]);
            dx[2 * i + 1] = -scale * (out[d][0][t] + g * out[d][3][t]);
        }
    }
}
