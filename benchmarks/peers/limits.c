/* What the machine can do: multiplications in registers, and memory moved as in STREAM. */
#include <stddef.h>

typedef double narrow __attribute__((vector_size(32)));
typedef double wide __attribute__((vector_size(64)));

enum { CHAINS = 12 }; /* enough independent chains to hide the latency of a multiplication */

/* n rounds of CHAINS vector multiplications; the sum keeps them from being left out */
#define MULTIPLY(name, vector)                                  \
    double name(size_t n, double factor)                        \
    {                                                           \
        vector chain[CHAINS], f = {0};                          \
        double sum = 0;                                         \
        f += factor;                                            \
        for (int i = 0; i < CHAINS; ++i) {                      \
            chain[i] = f + i;                                   \
        }                                                       \
        for (size_t round = 0; round < n; ++round) {            \
            for (int i = 0; i < CHAINS; ++i) {                  \
                chain[i] *= f;                                  \
            }                                                   \
        }                                                       \
        for (int i = 0; i < CHAINS; ++i) {                      \
            sum += chain[i][0];                                 \
        }                                                       \
        return sum;                                             \
    }

MULTIPLY(multiply_narrow, narrow)
MULTIPLY(multiply_wide, wide)

/* the same arrays again and again, so that the cost of a call from Python does not count */
#define AGAIN for (size_t round = 0; round < rounds; ++round, keep(a))

static void keep(double *a)
{
    __asm__ volatile("" : : "r"(a) : "memory");
}

void stream_scale(size_t rounds, size_t n, double s, const double *restrict b, double *restrict a)
{
    AGAIN for (size_t i = 0; i < n; ++i) {
        a[i] = s*b[i];
    }
}

/* the same in as many streams as a batch has: row after row for each state */
void stream_rows(size_t rounds, size_t rows, size_t n, double s, const double *restrict b,
    double *restrict a)
{
    AGAIN for (size_t i = 0; i < n; ++i) {
        for (size_t row = 0; row < rows; ++row) {
            a[row*n + i] = s*b[row*n + i];
        }
    }
}

/* a += s b: as many reads again as stream_scale, and no line is written without being read */
void stream_add(size_t rounds, size_t n, double s, const double *restrict b, double *restrict a)
{
    AGAIN for (size_t i = 0; i < n; ++i) {
        a[i] += s*b[i];
    }
}
