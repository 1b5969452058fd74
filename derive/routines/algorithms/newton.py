"""Newton's method for the stages of a coarse step of Gauss's collocation."""

mode_values: table[real, 4, 2] = MODE_VALUES
mode_into: table[real, 4, 8, 2] = MODE_INTO
mode_back: table[real, 4, 8, 2] = MODE_BACK


def factored(m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], h: real) -> flag:
    """1 - h v J for each eigenvalue v, J the derivative of dx/dt where the step begins, as triangles of complex
    numbers; False where one is singular."""
    J: real[N_STATE * N_STATE]
    if INPUT_FUNCTIONS:
        held: real[SIZE_U]
        inputs_at(m, m.t, m.x, u, held)
        jacobian_raw(m.t, m.x, k, held, J)
    else:
        jacobian_raw(m.t, m.x, k, u, J)
    for mode in range(4):
        for i in range(N_STATE):
            for j in range(N_STATE):
                unit: real = 1.0 if i == j else 0.0
                m.lu[mode][i][j][0] = unit - h * mode_values[mode][0] * J[i * N_STATE + j]
                m.lu[mode][i][j][1] = -h * mode_values[mode][1] * J[i * N_STATE + j]
        for c in range(N_STATE):
            best: var[index] = c
            size: var[real] = 0.0
            for i in range(c, N_STATE):
                own: real = (
                    m.lu[mode][i][c][0] * m.lu[mode][i][c][0]
                    + m.lu[mode][i][c][1] * m.lu[mode][i][c][1]
                )
                if own > size:
                    best = i
                    size = own
            if not (size > 0.0 and size < INFINITY):
                return False
            m.pivots[mode][c] = best
            if best != c:
                for j in range(N_STATE):
                    for z in range(2):
                        other: real = m.lu[mode][c][j][z]
                        m.lu[mode][c][j][z] = m.lu[mode][best][j][z]
                        m.lu[mode][best][j][z] = other
            re: real = m.lu[mode][c][c][0] / size
            im: real = -m.lu[mode][c][c][1] / size
            for i in range(c + 1, N_STATE):
                a: real = m.lu[mode][i][c][0] * re - m.lu[mode][i][c][1] * im
                b: real = m.lu[mode][i][c][0] * im + m.lu[mode][i][c][1] * re
                m.lu[mode][i][c][0] = a
                m.lu[mode][i][c][1] = b
                for j in range(c + 1, N_STATE):
                    m.lu[mode][i][j][0] -= a * m.lu[mode][c][j][0] - b * m.lu[mode][c][j][1]
                    m.lu[mode][i][j][1] -= a * m.lu[mode][c][j][1] + b * m.lu[mode][c][j][0]
    return True


def less(m: Motion, mode: index, w: out[real[N_STATE, 2]], i: index, j: index):
    """Take what number j has in row i away."""
    w[i][0] -= m.lu[mode][i][j][0] * w[j][0] - m.lu[mode][i][j][1] * w[j][1]
    w[i][1] -= m.lu[mode][i][j][0] * w[j][1] + m.lu[mode][i][j][1] * w[j][0]


def lu_solve(m: Motion, mode: index, w: out[real[N_STATE, 2]]):
    """The solution of one of these systems, in the place of its right side."""
    for i in range(N_STATE):
        best: index = m.pivots[mode][i]
        re: real = w[best][0]
        im: real = w[best][1]
        w[best][0] = w[i][0]
        w[best][1] = w[i][1]
        w[i][0] = re
        w[i][1] = im
    for i in range(N_STATE):
        for j in range(i):
            less(m, mode, w, i, j)
    for i in reversed(range(N_STATE)):
        x: real = m.lu[mode][i][i][0]
        y: real = m.lu[mode][i][i][1]
        size: real = x * x + y * y
        for j in range(i + 1, N_STATE):
            less(m, mode, w, i, j)
        re: real = (w[i][0] * x + w[i][1] * y) / size
        w[i][1] = (w[i][1] * x - w[i][0] * y) / size
        w[i][0] = re


def newton_stages(
    m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], h: real, L: out[eight[N_STATE]]
) -> flag:
    """The stages of a step that is too coarse for the iteration, by Newton's method; is it solved?"""
    size: real[N_PARTS]
    R: eight[N_STATE]
    X: real[N_STATE]
    f: real[N_STATE]
    w: real[N_STATE, 2]
    before: var[real] = 0.0
    if not factored(m, k, u, h):
        return False
    sizes(m, m.x, size)
    for i in range(N_STATE):
        for s in range(8):
            L[i][s] = 0.0
    for sweep in range(NEWTON_STEPS):
        change: var[real] = 0.0
        for s in range(8):
            for i in range(N_STATE):
                X[i] = 0.0
            for j in range(8):
                for i in range(N_STATE):
                    X[i] += mu[j][s] * L[i][j]
            for i in range(N_STATE):
                X[i] = m.x[i] + (m.low[i] + X[i])
            rate(m, m.t + (m.t_low + h * nodes[s]), X, k, u, f)
            m.evaluations += 1
            for i in range(N_STATE):
                R[i][s] = h * weights[s] * f[i] - L[i][s]
        for mode in range(4):
            for i in range(N_STATE):
                w[i][0] = 0.0
                w[i][1] = 0.0
            for s in range(8):
                for i in range(N_STATE):
                    w[i][0] += mode_into[mode][s][0] * R[i][s]
                    w[i][1] += mode_into[mode][s][1] * R[i][s]
            lu_solve(m, mode, w)
            for p in range(N_PARTS):
                for i in range(part(p), part(p + 1)):
                    for s in range(8):
                        L[i][s] += mode_back[mode][s][0] * w[i][0] - mode_back[mode][s][1] * w[i][1]
                    change += (w[i][0] * w[i][0] + w[i][1] * w[i][1]) / (size[p] * size[p])
        change = sqrt(change)
        if not change < INFINITY:
            return False
        settled: flag = change < before and change * change <= ROUNDING * (before - change)
        stalled: flag = change >= before and change <= STALLED_NEWTON
        if change <= ROUNDING or sweep > 0 and (settled or stalled):
            return True
        if sweep > 2 and change >= before:
            return False
        before = change
    return before <= STALLED_NEWTON
