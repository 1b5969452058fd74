"""The derivatives of steps: by the variations of the state where they begin, and by the inputs.

What goes along with the state is a matrix by rows: what its numbers change by, a column for each variation
V of the state, then for each input.  METHOD stands for the name of a step.
"""


def jacobian_raw_inputs(
    t: real,
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    D: out[real[N_STATE * N_INPUTS]],
): ...


def jacobian_project(x: real[N_STATE], J: out[real[N_STATE * N_STATE]]): ...


def variations(x: real[N_STATE], V: out[real[N_STATE * N_MOVES]]): ...


def multiplied(J: real[N_STATE * N_STATE], S: real[N_ENTRIES], F: out[real[N_ENTRIES]]):
    """F = J S, where many entries of J are 0."""
    for e in range(N_ENTRIES):
        F[e] = 0.0
    for i in range(N_STATE):
        for s in range(N_STATE):
            if J[i * N_STATE + s] != 0.0:
                for c in range(N_COLUMNS):
                    F[i * N_COLUMNS + c] += J[i * N_STATE + s] * S[s * N_COLUMNS + c]


def solved(rows: index, n: index, M: out[real[SYSTEM_ROWS, SYSTEM_COLUMNS]]) -> flag:
    """So many linear equations for n unknowns, the matrix, where many entries are 0, and beside it the right sides,
    whose solutions are in the first n rows then; False where there is none."""
    for c in range(n):
        best: var[index] = c
        for i in range(c + 1, rows):
            if abs(M[i][c]) > abs(M[best][c]):
                best = i
        if not abs(M[best][c]) > 0.0:
            return False
        for j in range(c, n + N_COLUMNS):
            other: real = M[c][j]
            M[c][j] = M[best][j]
            M[best][j] = other
        for i in range(rows):
            if i != c and M[i][c] != 0.0:
                times: real = M[i][c] / M[c][c]
                for j in range(c + 1, n + N_COLUMNS):
                    M[i][j] -= times * M[c][j]
    for i in range(n):
        for j in range(n, n + N_COLUMNS):
            M[i][j] = M[i][j] / M[i][i]
    return True


def begun(x: real[N_STATE], S: out[real[N_ENTRIES]]):
    """What the numbers of a state change by, where nothing has moved."""
    V: real[N_STATE * N_MOVES]
    variations(x, V)
    for i in range(N_STATE):
        for c in range(N_COLUMNS):
            S[i * N_COLUMNS + c] = 0.0
        for c in range(N_VARIATIONS):
            S[i * N_COLUMNS + c] = V[i * N_MOVES + c]


def ended(
    x: real[N_STATE],
    S: real[N_ENTRIES],
    phi: out[real[N_VARIATIONS * N_VARIATIONS]],
    gamma: out[real[N_VARIATIONS * N_INPUTS]],
) -> flag:
    """The variations of a state of which its numbers change by S, without what they have along symmetries."""
    M: real[SYSTEM_ROWS, SYSTEM_COLUMNS]
    V: real[N_STATE * N_MOVES]
    variations(x, V)
    for i in range(N_STATE):
        for c in range(N_MOVES):
            M[i][c] = V[i * N_MOVES + c]
        for c in range(N_COLUMNS):
            M[i][N_MOVES + c] = S[i * N_COLUMNS + c]
    if not solved(N_STATE, N_MOVES, M):
        return False
    for i in range(N_VARIATIONS):
        for c in range(N_VARIATIONS):
            phi[i * N_VARIATIONS + c] = M[i][N_MOVES + c]
        if INPUTS:
            for c in range(N_INPUTS):
                gamma[i * N_INPUTS + c] = M[i][N_MOVES + N_VARIATIONS + c]
    return True


def slopes_at(
    m: Motion,
    t: real,
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    S: real[N_ENTRIES],
    J: out[real[N_STATE * N_STATE]],
    F: out[real[N_ENTRIES]],
):
    """J, the derivative of the rates by the state, and F, what they change by where the state changes by S."""
    if INPUT_FUNCTIONS:
        held: real[SIZE_U]
        inputs_at(m, t, x, u, held)
        jacobian_raw(t, x, k, held, J)
    else:
        jacobian_raw(t, x, k, u, J)
    multiplied(J, S, F)
    if INPUTS:
        D: real[N_STATE * N_INPUTS]
        if INPUT_FUNCTIONS:
            jacobian_raw_inputs(t, x, k, held, D)
        else:
            jacobian_raw_inputs(t, x, k, u, D)
        for i in range(N_STATE):
            for c in range(N_INPUTS):
                F[i * N_COLUMNS + N_VARIATIONS + c] += D[i * N_INPUTS + c]


def landed(near: real[N_STATE], V: real[N_ENTRIES], S: out[real[N_ENTRIES]]):
    """S, what a state changes by that is taken to the group from one that changes by V."""
    if PROJECTS:
        J: real[N_STATE * N_STATE]
        jacobian_project(near, J)
        multiplied(J, V, S)
    else:
        S[:] = V


if OF_STAGES:

    def METHOD_along(
        m: Motion, k: real[N_CONSTANTS], u: real[N_INPUTS], S: out[real[N_ENTRIES]]
    ) -> flag:
        """What the state changes by after the last step, from that before it."""
        t: real = m.t + (m.t_low - m.h)
        X: real[N_STATE]
        V: real[N_ENTRIES]
        J: real[N_STATE * N_STATE]
        F: real[STAGES, N_ENTRIES]
        for i in unrolled(STAGES):
            if A[i]:
                for s in range(N_STATE):
                    X[s] = m.start[s] + m.h * (weighted(A[i], m.f, s))
                for e in range(N_ENTRIES):
                    V[e] = S[e] + m.h * (weighted(A[i], F, e))
                slopes_at(m, t + C[i] * m.h, X, k, u, V, J, F[i])
            else:
                slopes_at(m, t, m.start, k, u, S, J, F[i])
        for s in range(N_STATE):
            X[s] = m.start[s] + m.h * (weighted(B, m.f, s))
        for e in range(N_ENTRIES):
            V[e] = S[e] + m.h * (weighted(B, F, e))
        landed(X, V, S)
        return True

else:

    def METHOD_along(
        m: Motion, k: real[N_CONSTANTS], u: real[N_INPUTS], S: out[real[N_ENTRIES]]
    ) -> flag:
        """What the state changes by after the last step, from that before it: what its stages add changes by the
        solution of their equations, linearised."""
        t: real = m.t + (m.t_low - m.h)
        X: real[N_STATE]
        V: real[N_ENTRIES]
        F: real[N_ENTRIES]
        J: real[N_STATE * N_STATE]
        M: real[SYSTEM_ROWS, SYSTEM_COLUMNS]
        for s in range(8):
            for i in range(N_STATE):
                X[i] = m.start[i]
            for j in range(8):
                for i in range(N_STATE):
                    X[i] += mu[j][s] * m.L[i][j]
            slopes_at(m, t + m.h * nodes[s], X, k, u, S, J, F)
            hb: real = m.h * weights[s]
            for i in range(N_STATE):
                for j in range(8):
                    for c in range(N_STATE):
                        M[s * N_STATE + i][j * N_STATE + c] = -hb * mu[j][s] * J[i * N_STATE + c]
                M[s * N_STATE + i][s * N_STATE + i] += 1.0
                for c in range(N_COLUMNS):
                    M[s * N_STATE + i][N_EQUATIONS + c] = hb * F[i * N_COLUMNS + c]
        if not solved(N_EQUATIONS, N_EQUATIONS, M):
            return False
        V[:] = S
        for i in range(N_STATE):
            X[i] = m.start[i]
        for j in range(8):
            for i in range(N_STATE):
                X[i] += m.L[i][j]
                for c in range(N_COLUMNS):
                    V[i * N_COLUMNS + c] += M[j * N_STATE + i][N_EQUATIONS + c]
        landed(X, V, S)
        return True


def METHOD_jacobian(
    m: out[Motion],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    h: real,
    n: count,
    phi: out[real[N_VARIATIONS * N_VARIATIONS]],
    gamma: out[real[N_VARIATIONS * N_INPUTS]],
) -> status:
    """n steps of size h, with what their end changes by, V there, by rows: phi by V where they begin, gamma by what
    is added to the inputs.  A step that is too coarse is not made in halves.
    KINKS"""
    S: real[N_ENTRIES]
    if HELD:
        hold(m, k, u)
    begun(m.x, S)
    made: var[count] = 0
    while made < n:
        if not OF_STAGES:
            if not METHOD_step(m, k, u, h, 0.0):
                return fault_here(m, k, u)
        elif PAIR:
            if not METHOD_step(m, k, u, h, 0.0):
                return NOT_FINITE
        else:
            if not METHOD_step(m, k, u, h):
                return NOT_FINITE
        if not METHOD_along(m, k, u, S):
            return NOT_CONVERGED
        made += 1
    if not ended(m.x, S, phi, gamma):
        return NOT_CONVERGED
    return OK
