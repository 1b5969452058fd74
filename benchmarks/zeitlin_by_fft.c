/* The road by matrices with its three transforms by FFT, behind zeitlin_by_hand.c: as many at once
 * as there are n2, number after number beside each other.  Stockham's passes over the factors of N,
 * each butterfly with half of the products, as sums and differences have cosines or sines alone;
 * for a prime N Rader's convolution of length N - 1. */
enum { B = M };
typedef double Batch[N][B];
static int factors[16], factor_count, length, root[N];
static double kernel[N][2], turn_re[N], turn_im[N];

/* z at k: sum over n of z e^(-2 pi i nk/length) */
static void fft(Batch zr, Batch zi)
{
    static Batch yr, yi;
    double (*ar)[B] = zr, (*ai)[B] = zi, (*br)[B] = yr, (*bi)[B] = yi;
    for (int f = 0, l = 1; f < factor_count; ++f) {
        const int r = factors[f], m = length / l / r;
        for (int p = 0; p < m; ++p) {
            for (int q = 0; q < l; ++q) {
                for (int k = 0; k <= r / 2; ++k) {
                    double (*restrict x)[B] = ar + q + l * p, (*restrict y)[B] = ai + q + l * p;
                    double er[B], ei[B], or[B], oi[B];
                    memcpy(er, x, sizeof er);
                    memcpy(ei, y, sizeof ei);
                    memset(or, 0, sizeof or);
                    memset(oi, 0, sizeof oi);
                    for (int j = 1; j <= (r - 1) / 2; ++j) {
                        const double *u = x[l * m * j], *v = y[l * m * j];
                        const double *s = x[l * m * (r - j)], *t = y[l * m * (r - j)];
                        const int at = j * k % r * (length / r);
                        const double c = turn_re[at], b = turn_im[at];
                        for (int d = 0; d < B; ++d) {
                            er[d] += c * (u[d] + s[d]);
                            ei[d] += c * (v[d] + t[d]);
                            or[d] += b * (u[d] - s[d]);
                            oi[d] += b * (v[d] - t[d]);
                        }
                    }
                    if (r == 2) {
                        for (int d = 0; d < B; ++d) {
                            or[d] = -x[l * m][d];
                            oi[d] = -y[l * m][d];
                            er[d] += k ? or[d] : -or[d];
                            ei[d] += k ? oi[d] : -oi[d];
                            or[d] = oi[d] = 0;
                        }
                    }
                    /* of k and of r - k: e + i o and e - i o, turned */
                    for (int side = 0; side < (k && r > 2 ? 2 : 1); ++side) {
                        const int there = side ? r - k : k, at = p * there % (length / l) * l;
                        const double g = side ? -1 : 1, c = turn_re[at], b = turn_im[at];
                        double *u = br[q + l * (r * p + there)], *v = bi[q + l * (r * p + there)];
                        for (int d = 0; d < B; ++d) {
                            const double re = er[d] - g * oi[d], im = ei[d] + g * or[d];
                            u[d] = c * re - b * im;
                            v[d] = c * im + b * re;
                        }
                    }
                }
            }
        }
        l *= r;
        double (*t)[B] = ar;
        ar = br;
        br = t;
        t = ai;
        ai = bi;
        bi = t;
    }
    if (ar != zr) {
        memcpy(zr, ar, sizeof(double[B]) * (size_t)length);
        memcpy(zi, ai, sizeof(double[B]) * (size_t)length);
    }
}

static void prepare_fft(void)
{
    const double two_pi = 8 * atan(1);
    int prime = 1;
    for (int r = 2; r < N; ++r) {
        prime = prime && N % r;
    }
    length = prime ? N - 1 : N;
    for (int left = length, r = 2; left > 1; r += left % r ? 1 : 0) {
        if (left % r == 0) {
            factors[factor_count++] = r;
            left /= r;
        }
    }
    for (int k = 0; k < length; ++k) {
        turn_re[k] = cos(two_pi * k / length);
        turn_im[k] = -sin(two_pi * k / length);
    }
    if (prime) { /* a generator of the residues: root[q] = g^q */
        for (int g = 2, order = 0; order < N - 1; ++g) {
            root[0] = 1;
            for (order = 1; (root[order % N] = root[order - 1] * g % N) != 1; ++order) {
            }
        }
        static Batch zr, zi;
        for (int q = 0; q < length; ++q) {
            const double angle = two_pi * root[(length - q) % length] / N;
            zr[q][0] = cos(angle) / length;
            zi[q][0] = -sin(angle) / length;
        }
        fft(zr, zi);
        for (int q = 0; q < length; ++q) {
            kernel[q][0] = zr[q][0];
            kernel[q][1] = zi[q][0];
        }
    }
}

/* out at k: sum over n of in e^(-2 pi i nk/N) */
static void dft(Batch re, Batch im)
{
    static Batch ar, ai;
    double all_re[B], all_im[B];
    if (length == N) {
        fft(re, im);
        return;
    }
    memcpy(all_re, re[0], sizeof all_re);
    memcpy(all_im, im[0], sizeof all_im);
    for (int q = 0; q < length; ++q) {
        memcpy(ar[q], re[root[q]], sizeof *ar);
        memcpy(ai[q], im[root[q]], sizeof *ai);
        for (int d = 0; d < B; ++d) {
            all_re[d] += ar[q][d];
            all_im[d] += ai[q][d];
        }
    }
    fft(ar, ai);
    for (int q = 0; q < length; ++q) { /* conjugates, for the way back */
        const double c = kernel[q][0], b = kernel[q][1];
        for (int d = 0; d < B; ++d) {
            const double u = ar[q][d], v = ai[q][d];
            ar[q][d] = c * u - b * v;
            ai[q][d] = -(c * v + b * u);
        }
    }
    fft(ar, ai);
    for (int q = 0; q < length; ++q) {
        double *u = re[root[(length - q) % length]], *v = im[root[(length - q) % length]];
        for (int d = 0; d < B; ++d) {
            u[d] = re[0][d] + ar[q][d];
            v[d] = im[0][d] - ai[q][d];
        }
    }
    memcpy(re[0], all_re, sizeof all_re);
    memcpy(im[0], all_im, sizeof all_im);
}

static void matrix_by_fft(const double *x, int stream, double (*re)[L], double (*im)[L])
{
    static Batch zr, zi;
    memset(zr, 0, sizeof zr);
    memset(zi, 0, sizeof zi);
    for (int d = 0; d <= H; ++d) {
        for (int k = d ? -H : 1; k <= H; ++k) {
            const int i = d ? H + (d - 1) * N + k + H : k - 1;
            const double w = stream ? -1. / (d * d + k * k) : 1;
            const int at = k > 0 ? N - k : -k; /* e^(+2 pi i ks/N) */
            zr[at][d] = w * x[2 * i];
            zi[at][d] = w * x[2 * i + 1];
            if (!d) {
                zr[k][0] = w * x[2 * i];
                zi[k][0] = -w * x[2 * i + 1];
            }
        }
    }
    dft(zr, zi);
    for (int a = 0; a < N; ++a) {
        for (int d = 0; d <= H; ++d) {
            const int b = a + d < N ? a + d : a + d - N, s = a + b < N ? a + b : a + b - N;
            re[a][b] = re[b][a] = zr[s][d];
            im[b][a] = -zi[s][d];
            im[a][b] = zi[s][d];
        }
    }
}

void by_fft(const double *restrict x, double *restrict dx)
{
    static double wr[N][L], wi[N][L], pr[N][L], pi[N][L], sum[H + 1][N][2];
    static Batch zr, zi;
    const double scale = 1 / (16 * atan(1));
    if (!length) {
        prepare_fft();
    }
    matrix_by_fft(x, 0, wr, wi);
    matrix_by_fft(x, 1, pr, pi);
    bracket(wr, wi, pr, pi, sum);
    for (int d = 0; d <= H; ++d) {
        for (int s = 0; s < N; ++s) {
            zr[s][d] = sum[d][s][0];
            zi[s][d] = sum[d][s][1];
        }
    }
    dft(zr, zi);
    for (int d = 0; d <= H; ++d) {
        for (int k = d ? -H : 1; k <= H; ++k) {
            const int i = d ? H + (d - 1) * N + k + H : k - 1, at = k < 0 ? k + N : k;
            dx[2 * i] = scale * zi[at][d];
            dx[2 * i + 1] = -scale * zr[at][d];
        }
    }
}
