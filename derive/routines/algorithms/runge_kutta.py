"""Explicit Runge–Kutta steps, their stages written out; METHOD stands for the name of one."""


def METHOD_stages(
    m: Motion,
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    h: real,
    f: out[real[ROWS, N_STATE]],
    sum: out[real[N_STATE]],
):
    """The stages f of a step h; sum, what it adds."""
    t: real = m.t + m.t_low
    X: real[N_STATE]
    for i in unrolled(STAGES):
        if A[i]:
            for s in range(N_STATE):
                X[s] = m.x[s] + (m.low[s] + h * (weighted(A[i], f, s)))
            rate(m, t + C[i] * h, X, k, u, f[i])
        else:
            rate(m, t, m.x, k, u, f[i])
    for s in range(N_STATE):
        sum[s] = h * (weighted(B, f, s))


if PAIR:

    def METHOD_error(m: Motion, h: real, f: real[ROWS, N_STATE], size: real[N_PARTS]) -> real:
        """The error of a step h of stages f, relative to the size of each part of the state."""
        worst: var[real] = 1e-30
        for p in range(N_PARTS):
            for s in range(part(p), part(p + 1)):
                error: real = h * (weighted(E, f, s))
                relative: real = abs(error) / size[p]
                worst = worst if relative <= worst else relative  # also where it is no number
        return worst

    def METHOD_step(
        m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], h: real, tol: real
    ) -> flag:
        """One step h, whose error must be below tol if that is not 0; is it made?  Then m.h_next is a size
        for the next step; else it is a smaller h."""
        f: real[ROWS, N_STATE]
        sum: real[N_STATE]
        METHOD_stages(m, k, u, h, f, sum)
        m.evaluations += STAGES
        if tol > 0.0:
            end: real[N_STATE]
            size: real[N_PARTS]
            for s in range(N_STATE):
                end[s] = m.x[s] + sum[s]
            sizes(m, end, size)
            worst: real = METHOD_error(m, h, f, size)
            change: real = EXPLICIT_SAFETY * power(tol / worst, INVERSE_ORDER)
            m.h_next = h * (
                EXPLICIT_GROWTH if change > EXPLICIT_GROWTH else change if change > 0.2 else 0.2
            )
            if not worst <= tol:
                return False
        if not moved(m, h, sum):
            m.h_next = h / 2.0
            return False
        if not DEVICE:
            for i in range(STAGES):
                m.f[i][:] = f[i]
            m.method = NUMBER
            m.dense_known = False
        return True

    def METHOD(
        m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], h: real, n: count = 1
    ) -> status:
        """n steps of size h, which may be negative."""
        if HELD:
            hold(m, k, u)
        made: var[count] = 0
        while made < n:
            if not METHOD_step(m, k, u, h, 0.0):
                return NOT_FINITE
            made += 1
        return OK

    def METHOD_to(
        m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], t1: real, tol: real = 1e-9
    ) -> status:
        """Steps of their own size up to the time t1, before or after m.t; tol: the error of a step relative
        to the size of each part of the state."""
        if HELD:
            hold(m, k, u)
        if EVENTS:
            return up_to_event(METHOD_step, METHOD, m, k, u, t1, tol)
        else:
            return up_to(METHOD_step, m, k, u, t1, tol)

else:

    def METHOD_step(m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], h: real) -> flag:
        """One step h; is it made?"""
        f: real[ROWS, N_STATE]
        sum: real[N_STATE]
        METHOD_stages(m, k, u, h, f, sum)
        m.evaluations += STAGES
        if not moved(m, h, sum):
            return False
        if not DEVICE:
            for i in range(STAGES):
                m.f[i][:] = f[i]
            m.method = NUMBER
        return True

    def METHOD(
        m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], h: real, n: count = 1
    ) -> status:
        """n steps of size h, which may be negative.  A step always costs the same."""
        if HELD:
            hold(m, k, u)
        made: var[count] = 0
        while made < n:
            if not METHOD_step(m, k, u, h):
                return NOT_FINITE
            made += 1
        return OK


if DENSE_STAGES:

    def METHOD_rest(m: Motion, f: out[real[ROWS, N_STATE]]):
        """The rates f at the stages of dense output, after those of the last step, one of METHOD."""
        t: real = m.t + (m.t_low - m.h)
        X: real[N_STATE]
        for i in unrolled(ROWS):
            if IS_EXTRA[i]:
                for s in range(N_STATE):
                    X[s] = m.start[s] + m.h * (weighted(A[i], f, s))
                rate(m, t + C[i] * m.h, X, m.k, m.u, f[i])

    def METHOD_complete(m: out[Motion]):
        """They are computed once for a step."""
        if m.method == NUMBER and not m.dense_known:
            f: real[ROWS, N_STATE]
            for i in range(STAGES):
                f[i][:] = m.f[i]
            METHOD_rest(m, f)
            for i in range(STAGES, ROWS):
                m.f[i][:] = f[i]
            m.dense_known = True


def METHOD_added(b: real[ROWS], f: real[ROWS, N_STATE], to: out[real[N_STATE]]):
    """Add sum_i b_i f_i to a state."""
    for i in range(ROWS):
        for s in range(N_STATE):
            to[s] += b[i] * f[i][s]


def METHOD_within(m: Motion, theta: real, to: out[real[N_STATE]]):
    """The state at a part theta of the last step, one of METHOD: x + h sum_i b_i(theta) f_i with
    b_i(theta) = theta sum_n d_in P_n(2 theta - 1), P_n Legendre's polynomials."""
    d: table[real, COLUMNS, ROWS] = METHOD_DENSE
    p: real[MOST_COLUMNS]
    p[0] = 1.0
    p[1] = 2.0 * theta - 1.0
    for n in range(1, LAST_COLUMN):
        p[n + 1] = (real(2 * n + 1) * p[1] * p[n] - real(n) * p[n - 1]) / real(n + 1)
    f: real[ROWS, N_STATE]
    if DENSE_STAGES:
        if m.dense_known:
            for i in range(ROWS):
                f[i][:] = m.f[i]
        else:
            for i in range(STAGES):
                f[i][:] = m.f[i]
            METHOD_rest(m, f)
    else:
        for i in range(ROWS):
            f[i][:] = m.f[i]
    b: real[ROWS]
    for i in range(ROWS):
        b[i] = 0.0
    for n in range(COLUMNS):
        for i in range(ROWS):
            b[i] += d[n][i] * p[n]
    for i in range(ROWS):
        b[i] *= m.h * theta
    to[:] = m.start
    METHOD_added(b, f, to)
