"""Gauss's collocation of order 16, its eight stages at once.

A statement whose left side is of lanes is one for each stage."""

nodes: table[eight] = NODES
weights: table[eight] = WEIGHTS
mu: table[eight, 8] = MU
legendre: table[eight, 8] = LEGENDRE
extrapolation: table[eight] = CONTINUED


def rhs_lanes(
    t: lanes, x: lanes[N_STATE], k: real[N_CONSTANTS], u: lanes[SIZE_U], f: out[lanes[N_STATE]]
): ...


def first_rhs_lanes(
    t: lanes, x: lanes[N_STATE], k: real[N_CONSTANTS], u: lanes[SIZE_U], f: out[lanes[N_STATE]]
): ...


def combination(a: eight[8], l: eight) -> lanes:
    """sum_j a_j l_j."""
    even: var[lanes] = 0.0
    odd: var[lanes] = 0.0
    for j in range(0, 8, 2):
        even = fused(a[j], l[j], even)
        odd = fused(a[j + 1], l[j + 1], odd)
    return even + odd


def constant_predictor(
    m: Motion, k: real[N_CONSTANTS], u: real[N_INPUTS], h: real, L: out[lanes[N_STATE]]
):
    """L of a step h for rates that are those of its begin."""
    dx: real[N_STATE]
    rate(m, m.t, m.x, k, u, dx)
    for i in range(N_STATE):
        L[i] = h * dx[i] * weights


def extrapolate(m: out[Motion], h: real, L: out[lanes[N_STATE]]):
    """L of a step h by the polynomial of the last step, extrapolation: sum_j ahead_j L_j, where ahead is kept for
    steps of one ratio."""
    ratio: real = h / m.h
    if ratio != m.ratio:
        m.ratio = ratio
        for i in range(8):
            gap: real[8]
            below: var[real] = 1.0
            above: var[real] = ratio * weights[i]
            for j in range(8):
                gap[j] = 1.0 + ratio * nodes[i] - nodes[j]
                m.ahead[j][i] = below * extrapolation[j]
                below *= gap[j]
            for j in reversed(range(8)):
                m.ahead[j][i] *= above
                above *= gap[j]
    for i in range(N_STATE):
        L[i] = combination(m.ahead, m.L[i])


def summed(a: eight) -> real:
    """The sum of the lanes of a number."""
    return a[0] + a[1] + (a[2] + a[3]) + (a[4] + a[5] + (a[6] + a[7]))


def stages(m: Motion, begin: index, end: index, L: lanes[N_STATE], X: out[lanes[N_STATE]]):
    """The stages of the numbers from begin to before end: X_i = x + sum_j mu_ij L_j."""
    in_memory(L)
    for i in range(begin, end):
        X[i] = m.x[i] + (m.low[i] + combination(mu, L[i]))


def swept(
    begin: index,
    end: index,
    hb: lanes,
    size: real[N_PARTS],
    seen: flag,
    F: lanes[N_STATE],
    L: out[lanes[N_STATE]],
) -> real:
    """L_j = h b_j f_j of the parts of the state from begin to before end; by how much they change, relative and
    squared, if that is seen."""
    change: var[real] = 0.0
    if not seen:
        for i in range(part(begin), part(end)):
            L[i] = hb * F[i]
        return 0.0
    for p in range(begin, end):
        changes: lanes
        changes = 0.0
        for i in range(part(p), part(p + 1)):
            found: lanes = hb * F[i]
            differs: lanes = found - L[i]
            changes += differs * differs
            L[i] = found
        change += summed(changes) / (size[p] * size[p])
    return change


def fixed_point(
    m: out[Motion],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    h: real,
    tol: real,
    L: out[lanes[N_STATE]],
) -> flag:
    """Solve X_i = x + sum_j mu_ij L_j, L_j = h b_j f(t + c_j h, X_j) from a first L, until no more than rounding
    or a part of tol is left; is it solved?"""
    times: lanes
    hb: lanes
    X: lanes[N_STATE]
    F: lanes[N_STATE]
    U: lanes[SIZE_U]
    size: real[N_PARTS]
    before: var[real] = INFINITY
    left: real = ENOUGH * tol
    enough: real = left if left > ROUNDING else ROUNDING
    unseen: index = 3 * m.sweeps // 4  # so many but one do not end it, as the last step took more
    times = m.t + (m.t_low + h * nodes)
    hb = h * weights
    if INPUT_FUNCTIONS:
        held: flag = is_held(m, u)
        if held:
            for i in range(N_INPUTS):
                U[i] = u[i]
    elif INPUTS:
        for i in range(N_INPUTS):
            U[i] = u[i]
    size[:] = m.size
    if m.h == 0.0:  # what is at rest moves now
        next: real[N_STATE]
        for i in range(N_STATE):
            next[i] = m.x[i] + summed(L[i])
        sizes(m, next, size)
    for sweep in range(SWEEPS):
        seen: flag = sweep + 1 >= unseen
        change: var[real] = 0.0
        if SPLIT:
            if sweep == 0:
                stages(m, 0, SPLIT, L, X)
            stages(m, SPLIT, N_STATE, L, X)
            first_rhs_lanes(times, X, k, U, F)
            change = swept(0, HALF, hb, size, seen, F, L)
            stages(m, 0, SPLIT, L, X)
        else:
            stages(m, 0, N_STATE, L, X)
        if INPUT_FUNCTIONS:
            if not held:
                for stage in range(8):
                    now: real[SIZE_U]
                    at: real[N_STATE]
                    for i in range(N_STATE):
                        at[i] = X[i][stage]
                    inputs_at(m, times[stage], at, u, now)
                    for i in range(N_INPUTS):
                        U[i][stage] = now[i]
        rhs_lanes(times, X, k, U, F)
        m.evaluations += 8
        change += swept(HALF, N_PARTS, hb, size, seen, F, L)
        if not seen:
            continue
        change = sqrt(change)
        if not change < INFINITY:
            return False
        # what is left of a geometric series; or nothing but rounding is
        series: flag = (
            before < INFINITY and change < before and change * change <= enough * (before - change)
        )
        if change <= enough or series or change >= before and change <= STILL:
            m.sweeps = sweep + 1
            return True
        before = change
    return False


def error_of(L: eight[N_STATE], size: real[N_PARTS], tol: real) -> real:
    """The error of a step of stages L relative to a tolerance, as it is like the last coefficient of f in
    Legendre's polynomials, squared."""
    worst: var[real] = 0.0
    last: real[N_STATE]
    for i in range(N_STATE):
        last[i] = 0.0
    for j in range(8):
        for i in range(N_STATE):
            last[i] += legendre[7][j] * L[i][j]
    for p in range(N_PARTS):
        for i in range(part(p), part(p + 1)):
            worst = abs(last[i] / size[p]) if abs(last[i] / size[p]) > worst else worst
    worst *= ERROR * worst
    return (worst if worst > 1e-30 else 1e-30) / tol


def gauss_step(m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], h: real, tol: real) -> flag:
    """One step h, whose error must be below tol if that is not 0; is it made?  Then m.h_next is a size for the
    next step; else it is a smaller h."""
    L: lanes[N_STATE]
    kept: eight[N_STATE]
    sum: real[N_STATE]
    found: var[flag] = False
    tried: var[flag] = True
    if MODES:
        tried = abs(h) < m.coarse
    if tried:
        follows: var[flag] = abs(m.h) * CONTINUES > abs(h)
        if METHODS:
            follows = follows and m.method == 0
        if follows:
            extrapolate(m, h, L)
        else:
            constant_predictor(m, k, u, h, L)
        found = fixed_point(m, k, u, h, tol, L)
        if found:
            kept[:] = L
        if MODES:
            m.coarse = m.coarse if found else abs(h) / 2.0
    if MODES:
        if not found:
            found = newton_stages(m, k, u, h, kept)
            m.sweeps = 0
            m.coarse *= 1.05  # the iteration is tried again after some steps
    if not found:
        m.h_next = h / 2.0
        return False
    for i in range(N_STATE):
        sum[i] = summed(kept[i])
    if tol > 0.0:
        end: real[N_STATE]
        size: real[N_PARTS]
        for i in range(N_STATE):
            end[i] = m.x[i] + sum[i]
        sizes(m, end, size)
        error: real = error_of(kept, size, tol)
        change: var[real] = SAFETY / sqrt(sqrt(sqrt(sqrt(error))))
        change = GROWTH if change > GROWTH else change if change > 0.2 else 0.2
        change = 1.0 if change > 1.0 and change < KEPT else change
        if change * real(m.sweeps) > MANY:  # a coarser step would not be cheaper
            change = MANY / real(m.sweeps)
        m.h_next = h * change
        if error > 1.0:
            return False
    if not moved(m, h, sum):
        m.h_next = h / 2.0
        return False
    m.L[:] = kept
    if METHODS:
        m.method = 0
    return True


def gauss(m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], h: real, n: count = 1) -> status:
    """Gauss's collocation of order 16: n steps of size h, which may be negative.  It is symmetric in time,
    and keeps every quadratic integral of the state x to rounding, the better the smaller h: as its equations
    are solved by iteration, h times the fastest rate should stay below 3 or so.  A step that is too coarse
    for that is COARSE.  KEEPS"""
    made: var[count] = 0
    while made < n:
        left: var[real] = h
        size: var[real] = h
        while left != 0.0:
            if abs(size) * (1.0 + 1e-9) > abs(left):  # no sliver is left
                size = left
            if gauss_step(m, k, u, size, 0.0):
                left -= size
            else:
                size /= 2.0
                if not abs(size) > LEAST * abs(h):
                    return fault_here(m, k, u)
        made += 1
    return OK


def gauss_to(
    m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], t1: real, tol: real = 1e-9
) -> status:
    """Steps of their own size up to the time t1, before or after m.t; tol: the error relative to the size of each
    part of the state."""
    if EVENTS:
        return up_to_event(gauss_step, gauss, m, k, u, t1, tol)
    else:
        return up_to(gauss_step, m, k, u, t1, tol)


def collocated(m: Motion, t: real, to: out[real[N_STATE]]):
    """The state at a time within the last step, by the polynomial that it is of."""
    p: real[9]
    integral: real[8]
    weight: real[8]
    theta: real = 1.0 + ((t - m.t - m.t_low) / m.h if m.h != 0.0 else 0.0)
    z: real = 2.0 * theta - 1.0
    p[0] = 1.0
    p[1] = z
    for n in range(1, 8):
        p[n + 1] = (real(2 * n + 1) * z * p[n] - real(n) * p[n - 1]) / real(n + 1)
        integral[n] = (p[n + 1] - p[n - 1]) / real(2 * (2 * n + 1))
    integral[0] = theta
    for j in range(8):
        weight[j] = 0.0
    for n in reversed(range(8)):
        for j in range(8):
            weight[j] += integral[n] * legendre[n][j]
    for i in range(N_STATE):
        to[i] = 0.0
    for j in range(8):
        for i in range(N_STATE):
            to[i] += weight[j] * m.L[i][j]
    for i in range(N_STATE):
        to[i] = m.start[i] + (to[i] if m.h != 0.0 else 0.0)
