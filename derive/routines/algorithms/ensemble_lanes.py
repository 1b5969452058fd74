"""Explicit Runge–Kutta steps of eight motions at once, one in each lane; METHOD stands for the name of one."""


class Eight:
    """Eight motions under way: lane j of every number is that of motion j."""

    t: lanes
    h: lanes
    x: lanes[N_STATE]
    low: lanes[N_STATE]
    k: lanes[SIZE_K]
    u: lanes[SIZE_U]
    size: lanes[N_PARTS]
    before: lanes[N_PARTS]
    f: lanes[MOST_ROWS, N_STATE]
    sum: lanes[N_STATE]
    next: lanes[N_STATE]
    rest: lanes[N_STATE]


def larger(a: lanes, b: lanes) -> lanes: ...


def rhs_each(
    t: lanes, x: lanes[N_STATE], k: lanes[SIZE_K], u: lanes[SIZE_U], f: out[lanes[N_STATE]]
): ...


def projected_each(x: lanes[N_STATE], on: out[lanes[N_STATE]]): ...


def entered(
    m: out[Eight], j: index, x: real[N_STATE], k: real[N_CONSTANTS], u: real[N_INPUTS], t: real
):
    """Put a motion into lane j."""
    m.t[j] = t
    m.h[j] = 0.0
    for i in range(N_STATE):
        m.x[i][j] = x[i]
        m.low[i][j] = 0.0
    for i in range(N_CONSTANTS):
        m.k[i][j] = k[i]
    for i in range(N_INPUTS):
        m.u[i][j] = u[i]
    for p in range(N_PARTS):
        m.size[p][j] = 0.0


def METHOD_rates_each(m: out[Eight]):
    """The rates f at the stages of a step of all eight."""
    X: lanes[N_STATE]
    times: lanes
    for j in unrolled(STAGES):
        if A[j]:
            times = m.t + C[j] * m.h
            for i in range(N_STATE):
                if PAIR:
                    X[i] = m.x[i] + (m.low[i] + m.h * (weighted(A[j], m.f, i)))
                else:
                    X[i] = m.x[i] + m.h * (weighted(A[j], m.f, i))
            rhs_each(times, X, m.k, m.u, m.f[j])
        else:
            rhs_each(m.t, m.x, m.k, m.u, m.f[j])


if PAIR:

    def added_each(m: out[Eight]):
        """next + rest = x + low + sum, taken to the group."""
        for i in range(N_STATE):
            m.rest[i] = m.low[i] + m.sum[i]
            m.next[i] = m.x[i] + m.rest[i]
        if PROJECTS:
            on: lanes[N_STATE]
            projected_each(m.next, on)
            for i in range(N_STATE):
                m.rest[i] += on[i] - m.next[i]
                m.next[i] = m.x[i] + m.rest[i]
        for i in range(N_STATE):
            m.rest[i] -= m.next[i] - m.x[i]

    def sizes_each(m: out[Eight], x: lanes[N_STATE]):
        """The size of each part of the states x, as large as it ever was; a part that is zero but for
        rounding has that of the others in small."""
        whole: lanes
        whole = 0.0
        for j in unrolled(N_PARTS):
            for i in range(PARTS[j], ENDS[j]):
                own: lanes = larger(x[i], -x[i])
                whole = larger(own, whole)
                m.size[j] = larger(own, m.size[j])
        for p in range(N_PARTS):
            m.size[p] = larger(m.size[p], 1e-8 * whole + 1e-300)

    def METHOD_each(m: out[Eight], worst: out[lanes]):
        """A step for all eight; worst, the error of each relative to the sizes."""
        scale: lanes
        METHOD_rates_each(m)
        for i in range(N_STATE):
            m.sum[i] = m.h * (weighted(B, m.f, i))
            m.next[i] = m.x[i] + m.sum[i]
        m.before[:] = m.size
        sizes_each(m, m.next)  # of what is not yet on the group, lest an error looks small
        added_each(m)
        worst = 1e-30
        for j in unrolled(N_PARTS):
            scale = m.h / m.size[j]
            for i in range(PARTS[j], ENDS[j]):
                error: lanes = scale * (weighted(E, m.f, i))
                worst = larger(worst, larger(error, -error))

else:

    def METHOD_each(m: out[Eight]):
        """A step for all eight, taken to the group."""
        METHOD_rates_each(m)
        if PROJECTS:
            X: lanes[N_STATE]
            for i in range(N_STATE):
                X[i] = m.x[i] + m.h * (weighted(B, m.f, i))
            projected_each(X, m.x)
        else:
            for i in range(N_STATE):
                m.x[i] = m.x[i] + m.h * (weighted(B, m.f, i))
