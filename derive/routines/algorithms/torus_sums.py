"""The sums of a fluid on the torus, by products of matrices of N rows and columns, N = 2 HALF + 1."""

cosines: table[real, N] = COSINES
sines: table[real, N] = SINES


def waves(even: out[real[M, COLUMNS]], odd: out[real[M, COLUMNS]]):
    """cos and sin of 2 pi k s/N."""
    for k in range(M):
        for s in range(COLUMNS):
            even[k][s] = cosines[k * s % N]
            odd[k][s] = sines[k * s % N]


def transform(
    even: real[M, COLUMNS],
    odd: real[M, COLUMNS],
    given: real[M, M, 4],
    found: out[real[M, 4, COLUMNS]],
):
    """given: of n2, n1 >= 0, the sum and the difference of the coefficients of (n1, n2) and (-n1, n2), Re
    and Im.  found: of n2, the even and the odd part of their transform at s >= 0, Re and Im: the sum over k
    of the even pairs times cos(2 pi k s/N), of the odd ones times sin."""
    for d in range(M):
        for s in range(COLUMNS):
            found[d][0][s] = given[d][0][0]
            found[d][1][s] = given[d][0][1]
            found[d][2][s] = 0.0
            found[d][3][s] = 0.0
    for k in range(1, M):
        c: real[COLUMNS]
        b: real[COLUMNS]
        for s in range(COLUMNS):
            c[s] = even[k][s]
            b[s] = odd[k][s]
        for d in range(M):
            even_re: real = given[d][k][0]
            even_im: real = given[d][k][1]
            odd_re: real = given[d][k][2]
            odd_im: real = given[d][k][3]
            for s in range(COLUMNS):
                found[d][0][s] += even_re * c[s]
                found[d][1][s] += even_im * c[s]
                found[d][2][s] += odd_re * b[s]
                found[d][3][s] += odd_im * b[s]


def matrix_of(
    x: real[N_STATE],
    stream: flag,
    even: real[M, COLUMNS],
    odd: real[M, COLUMNS],
    given: out[real[M, M, 4]],
    found: out[real[M, 4, COLUMNS]],
    re: out[real[N, ROW]],
    im: out[real[N, ROW]],
):
    """re + i im = sum a(n) T_n: a(n) = omega(n), or, for the stream function, -omega(n)/|n|^2.  In row r and
    column (r + n2) % N stands the sum over n1 of a(n) e^(2 pi i n1 s/N), s = row + column; it is Hermitian.
    given and found are what it works with."""
    for d in range(M):
        for k in range(M):
            scale: real = -1.0 / real(d * d + k * k) if stream and d + k > 0 else 1.0
            here_re: var[real] = 0.0
            here_im: var[real] = 0.0
            there_re: var[real] = 0.0
            there_im: var[real] = 0.0
            if d > 0:
                at: index = 2 * (d * N - 1)  # of n1 = 0
                here_re = x[at + 2 * k]
                here_im = x[at + 2 * k + 1]
                if k > 0:
                    there_re = x[at - 2 * k]
                    there_im = x[at - 2 * k + 1]
            elif k > 0:
                here_re = x[2 * k - 2]
                here_im = x[2 * k - 1]
                there_re = here_re
                there_im = -here_im
            given[d][k][0] = scale * (here_re + there_re)
            given[d][k][1] = scale * (here_im + there_im)
            given[d][k][2] = scale * (here_re - there_re)
            given[d][k][3] = scale * (here_im - there_im)
    transform(even, odd, given, found)
    if PADDED:
        for r in range(N):
            for j in range(N, ROW):
                re[r][j] = 0.0
                im[r][j] = 0.0
    for d in range(M):
        for r in range(N):
            column: index = r + d if r + d < N else r + d - N
            s: index = r + column if r + column < N else r + column - N
            size: index = s if s < M else N - s
            sign: real = 1.0 if s < M else -1.0
            a: real = found[d][0][size] - sign * found[d][3][size]
            b: real = found[d][1][size] + sign * found[d][2][size] if d > 0 else 0.0
            re[r][column] = a
            re[column][r] = a
            im[r][column] = b
            im[column][r] = -b


def added(re: real[N, ROW], im: real[N, ROW], both: out[real[N, ROW]]):
    """The sum of Re and Im of a matrix, entry by entry."""
    for r in range(N):
        for j in range(ROW):
            both[r][j] = re[r][j] + im[r][j]


def row(
    r: index,
    a: real[N, ROW],
    b: real[N, ROW],
    p: real[N, ROW],
    q: real[N, ROW],
    sum: real[N, ROW],
    re: out[real[ROW]],
    im: out[real[ROW]],
):
    """Row r of the product of two matrices, a + ib and p + iq, of whose rows, with those of the sum of p and
    q, four are taken at once.  (a + ib)(p + iq) by three products: ap, bq and (a + b)(p + q)."""
    ap: real[ROW]
    bq: real[ROW]
    both: real[ROW]
    for j in range(ROW):
        ap[j] = 0.0
        bq[j] = 0.0
        both[j] = 0.0
    for k in range(0, FOURS, 4):
        a0: real = a[r][k]
        a1: real = a[r][k + 1]
        a2: real = a[r][k + 2]
        a3: real = a[r][k + 3]
        b0: real = b[r][k]
        b1: real = b[r][k + 1]
        b2: real = b[r][k + 2]
        b3: real = b[r][k + 3]
        c0: real = a0 + b0
        c1: real = a1 + b1
        c2: real = a2 + b2
        c3: real = a3 + b3
        for j in range(ROW):
            ap[j] += a0 * p[k][j] + a1 * p[k + 1][j] + a2 * p[k + 2][j] + a3 * p[k + 3][j]
            bq[j] += b0 * q[k][j] + b1 * q[k + 1][j] + b2 * q[k + 2][j] + b3 * q[k + 3][j]
            both[j] += c0 * sum[k][j] + c1 * sum[k + 1][j] + c2 * sum[k + 2][j] + c3 * sum[k + 3][j]
    for k in range(FOURS, N):
        c: real = a[r][k] + b[r][k]
        for j in range(ROW):
            ap[j] += a[r][k] * p[k][j]
            bq[j] += b[r][k] * q[k][j]
            both[j] += c * sum[k][j]
    for j in range(ROW):
        re[j] = ap[j] - bq[j]
        im[j] = both[j] - ap[j] - bq[j]


def rhs(t: real, x: real[N_STATE], k: real[N_CONSTANTS], u: real[N_INPUTS], dx: out[real[N_STATE]]):
    """N/(4 pi i) [W, P], and what acts from outside: damping by powers of |n|^2, and the input."""
    W_re: real[N, ROW]
    W_im: real[N, ROW]
    P_re: real[N, ROW]
    P_im: real[N, ROW]
    P_both: real[N, ROW]
    sums: real[M, N, 2]  # of [W, P], by n2 and s = row + column
    re: real[ROW]
    im: real[ROW]
    even: real[M, COLUMNS]
    odd: real[M, COLUMNS]
    given: real[M, M, 4]
    found: real[M, 4, COLUMNS]
    waves(even, odd)
    matrix_of(x, False, even, odd, given, found, W_re, W_im)
    matrix_of(x, True, even, odd, given, found, P_re, P_im)
    added(P_re, P_im, P_both)
    for d in range(M):
        for s in range(N):
            sums[d][s][0] = 0.0
            sums[d][s][1] = 0.0
    # as W and P are Hermitian, PW is the adjoint of WP
    for r in range(N):
        row(r, W_re, W_im, P_re, P_im, P_both, re, im)
        for column in range(N):
            d: index = column + N - r if column < r else column - r
            s: index = r + column if r + column < N else r + column - N
            if d < M:
                sums[d][s][0] += re[column]
                sums[d][s][1] += im[column]
            if d == 0 or d >= M:
                other: index = N - d if d > 0 else 0
                sums[other][s][0] -= re[column]
                sums[other][s][1] += im[column]
    for d in range(M):
        for s in range(M):
            there: index = N - s if s > 0 else 0
            for part in range(2):
                a: real = sums[d][s][part]
                b: real = sums[d][there][part]
                given[d][s][part] = a + b if s > 0 else a
                given[d][s][part + 2] = a - b if s > 0 else 0.0
    transform(even, odd, given, found)
    # N/(4 pi i) of the coefficient, 1/N of the sum: Re and Im change places
    for d in range(M):
        first: index = 0 if d > 0 else M
        for j in range(first, N):
            size: index = HALF - j if j < HALF else j - HALF
            sign: real = -1.0 if j < HALF else 1.0
            at: index = 2 * (d * N + j - M)
            dx[at] = SCALE * (found[d][1][size] - sign * found[d][2][size])
            dx[at + 1] = -SCALE * (found[d][0][size] + sign * found[d][3][size])
            if DAMPED:
                drag: var[real] = 0.0
                for p in range(POWERS):
                    drag = drag * real(d * d + size * size) + k[POWERS - 1 - p]
                dx[at] -= drag * x[at]
                dx[at + 1] -= drag * x[at + 1]
            if DRIVEN:
                dx[at] += u[at]
                dx[at + 1] += u[at + 1]


def jacobian(
    t: real,
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    dx: out[real[N_STATE]],
    D: out[real[N_STATE * N_STATE]],
):
    """What the rate at n changes by: c(m) omega(n - m) times a change of omega(m), for m and -m, whose changes
    are conjugates.  The bracket, a form of degree 2, is half of what its derivative takes x to."""
    re: real[N, N]  # omega by its coordinates modulo N, n2 first
    im: real[N, N]
    inverse: real[N, N]  # 1/|n|^2
    re[0][0] = 0.0
    im[0][0] = 0.0
    inverse[0][0] = 0.0
    for d in range(M):
        first: index = 0 if d > 0 else M
        for j in range(first, N):
            size: index = HALF - j if j < HALF else j - HALF
            at: index = 2 * (d * N + j - M)
            a: index = (j + M) % N
            other_d: index = (N - d) % N
            other_a: index = (N - a) % N
            re[d][a] = x[at]
            im[d][a] = x[at + 1]
            inverse[d][a] = 1.0 / real(d * d + size * size)
            re[other_d][other_a] = x[at]
            im[other_d][other_a] = -x[at + 1]
            inverse[other_d][other_a] = inverse[d][a]
    for d in range(M):
        first: index = 0 if d > 0 else M
        for j in range(first, N):
            at: index = 2 * (d * N + j - M)
            a: index = (j + M) % N
            rate_re: var[real] = 0.0
            rate_im: var[real] = 0.0
            for e in range(M):
                start: index = 0 if e > 0 else M
                for i in range(start, N):
                    to: index = 2 * (e * N + i - M)
                    b: index = (i + M) % N
                    less_d: index = (d + N - e) % N  # n - m
                    less_a: index = (a + N - b) % N
                    more_d: index = (d + e) % N  # n + m
                    more_a: index = (a + b) % N
                    # N/2 pi is 2 N of 1/4 pi
                    scaled: real = -2.0 * SIZE * SCALE * sines[(b * d + (N - a) * e) % N]
                    less: real = scaled * (inverse[e][b] - inverse[less_d][less_a])
                    more: real = scaled * (inverse[more_d][more_a] - inverse[e][b])
                    less_re: real = less * re[less_d][less_a]
                    less_im: real = less * im[less_d][less_a]
                    more_re: real = more * re[more_d][more_a]
                    more_im: real = more * im[more_d][more_a]
                    here: index = at * DOWN + to * ALONG
                    below: index = here + DOWN
                    D[here] = less_re + more_re
                    D[here + ALONG] = more_im - less_im
                    D[below] = less_im + more_im
                    D[below + ALONG] = less_re - more_re
                    rate_re += D[here] * x[to] + D[here + ALONG] * x[to + 1]
                    rate_im += D[below] * x[to] + D[below + ALONG] * x[to + 1]
            dx[at] = 0.5 * rate_re
            dx[at + 1] = 0.5 * rate_im
            if DAMPED:
                size: index = HALF - j if j < HALF else j - HALF
                drag: var[real] = 0.0
                for p in range(POWERS):
                    drag = drag * real(d * d + size * size) + k[POWERS - 1 - p]
                dx[at] -= drag * x[at]
                dx[at + 1] -= drag * x[at + 1]
                D[at * (DOWN + ALONG)] -= drag
                D[(at + 1) * (DOWN + ALONG)] -= drag
            if DRIVEN:
                dx[at] += u[at]
                dx[at + 1] += u[at + 1]


def jacobian_inputs(
    t: real,
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    D: out[real[N_STATE * N_INPUTS]],
):
    """Each input is added to the rate of its own number."""
    for row in range(WIDTH):
        for at in range(WIDTH):
            D[row * WIDTH + at] = 1.0 if at == row else 0.0


def jacobian_parameters(
    t: real,
    x: real[N_STATE],
    p: real[N_PARAMETERS],
    u: real[N_INPUTS],
    D: out[real[N_STATE * N_PARAMETERS]],
):
    """Damping takes sum c_i |n|^(2i) omega(n); slopes are the derivatives of c_i by the parameters."""
    slopes: real[SLOPES]
    written("slopes")
    for d in range(M):
        first: index = 0 if d > 0 else M
        for j in range(first, N):
            size: index = HALF - j if j < HALF else j - HALF
            at: index = 2 * (d * N + j - M)
            for q in range(PARAMETERS):
                drag: var[real] = 0.0
                for n in range(POWERS):
                    drag = (
                        drag * real(d * d + size * size) + slopes[(POWERS - 1 - n) * PARAMETERS + q]
                    )
                here: index = at * DOWN_PARAMETERS + q * ALONG
                D[here] = -drag * x[at]
                D[here + DOWN_PARAMETERS] = -drag * x[at + 1]


def energy(t: real, x: real[N_STATE], k: real[N_CONSTANTS]) -> real:
    """The sum of |omega(n)|^2/|n|^2 over half of the lattice."""
    total: var[real] = 0.0
    for d in range(M):
        first: index = 0 if d > 0 else M
        for j in range(first, N):
            size: index = HALF - j if j < HALF else j - HALF
            at: index = 2 * (d * N + j - M)
            total += (x[at] * x[at] + x[at + 1] * x[at + 1]) / real(d * d + size * size)
    return total


def conserved(t: real, x: real[N_STATE], k: real[N_CONSTANTS], out: out[real[N_CONSERVED]]):
    """Tr W^2/N, Tr W^3/N, Tr W^4/N."""
    W_re: real[N, ROW]
    W_im: real[N, ROW]
    W_both: real[N, ROW]
    re: real[ROW]
    im: real[ROW]
    even: real[M, COLUMNS]
    odd: real[M, COLUMNS]
    given: real[M, M, 4]
    found: real[M, 4, COLUMNS]
    second: var[real] = 0.0
    third: var[real] = 0.0
    fourth: var[real] = 0.0
    waves(even, odd)
    matrix_of(x, False, even, odd, given, found, W_re, W_im)
    added(W_re, W_im, W_both)
    for r in range(N):
        row(r, W_re, W_im, W_re, W_im, W_both, re, im)
        second += re[r]
        for j in range(N):
            third += re[j] * W_re[r][j] + im[j] * W_im[r][j]
            fourth += re[j] * re[j] + im[j] * im[j]
    out[0] = second / SIZE
    out[1] = third / SIZE
    out[2] = fourth / SIZE
