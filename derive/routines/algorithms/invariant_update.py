"""The update of an estimate and its covariance by an observation, beside the functions of the group.

The covariance P of the error xi is the upper triangle, by rows, that follows the element in a state.
An observation is linear in xi to the first order; S = H P H^T + N has a triangle L with L L^T = S,
and W = P H^T L^-T gives the gain W L^-1 and the covariance P - W W^T.
"""

observed: table[index, N_OBSERVED] = OBSERVED


def applied(A: real[SIZE, SIZE], o: real[SIZE], z: out[real[SIZE]]):
    """z = A o."""
    for row in range(SIZE):
        z[row] = 0.0
        for column in range(SIZE):
            z[row] = z[row] + A[row][column] * o[column]


def place_of(a: index, b: index) -> index:
    """Where the entry a <= b of the covariance is in a state."""
    return N_ELEMENT + a * N_ALGEBRA - a * (a + 1) // 2 + b


def slopes(
    A: real[SIZE, SIZE],
    o: real[SIZE],
    sign: real,
    before: flag,
    H: out[real[N_OBSERVED, N_ALGEBRA]],
):
    """H, in whose column a is what xi = e_a changes of A o: sign A E_a o, or sign E_a A o, before."""
    e: real[N_ALGEBRA]
    moved: real[SIZE]
    change: real[SIZE]
    E: real[SIZE, SIZE]
    for a in range(N_ALGEBRA):
        for b in range(N_ALGEBRA):
            e[b] = 1.0 if a == b else 0.0
        hat(e, E)
        if before:
            applied(A, o, moved)
            applied(E, moved, change)
        else:
            applied(E, o, moved)
            applied(A, moved, change)
        for r in range(N_OBSERVED):
            H[r][a] = sign * change[observed[r]]


def innovation(A: real[SIZE, SIZE], o: real[SIZE], Y: real[N_OBSERVED], z: out[real[N_OBSERVED]]):
    """z = Y - A o, of what varies."""
    seen: real[SIZE]
    applied(A, o, seen)
    for r in range(N_OBSERVED):
        z[r] = Y[r] - seen[observed[r]]


def corrected(
    x: real[N_STATE],
    z: out[real[N_OBSERVED]],
    H: real[N_OBSERVED, N_ALGEBRA],
    N: real[N_NOISE],
    y: out[real[N_STATE]],
):
    """y = x after an observation that is z from what x says, which changes by H xi; its noise has the covariance N."""
    P: real[N_ALGEBRA, N_ALGEBRA]
    W: real[N_ALGEBRA, N_OBSERVED]
    L: real[N_OBSERVED, N_OBSERVED]
    xi: real[N_ALGEBRA]
    E: real[SIZE, SIZE]
    X: real[SIZE, SIZE]
    G: real[SIZE, SIZE]
    for a in range(N_ALGEBRA):
        for b in range(a, N_ALGEBRA):
            P[a][b] = x[place_of(a, b)]
            P[b][a] = P[a][b]
    for r in range(N_OBSERVED):
        for a in range(N_ALGEBRA):
            W[a][r] = 0.0
            for b in range(N_ALGEBRA):
                W[a][r] = W[a][r] + P[a][b] * H[r][b]
    for r in range(N_OBSERVED):
        for c in range(r + 1):
            total: var[real] = N[N_OBSERVED * r + c]
            for a in range(N_ALGEBRA):
                total = total + H[r][a] * W[a][c]
            for m in range(c):
                total = total - L[r][m] * L[c][m]
            if r == c:
                L[r][r] = sqrt(total)
            else:
                L[r][c] = total / L[c][c]
    # both by the triangle, number after number
    for r in range(N_OBSERVED):
        for m in range(r):
            z[r] = z[r] - L[r][m] * z[m]
        z[r] = z[r] / L[r][r]
        for a in range(N_ALGEBRA):
            for m in range(r):
                W[a][r] = W[a][r] - L[r][m] * W[a][m]
            W[a][r] = W[a][r] / L[r][r]
    for a in range(N_ALGEBRA):
        xi[a] = 0.0
        for r in range(N_OBSERVED):
            xi[a] = xi[a] + W[a][r] * z[r]
    element_of(x, X)
    exp_of(xi, E)
    if RIGHT:
        product(E, X, G)
    else:
        product(X, E, G)
    for n in range(N_ELEMENT):
        y[n] = G[entry[n][0]][entry[n][1]]
    for a in range(N_ALGEBRA):
        for b in range(a, N_ALGEBRA):
            left: var[real] = P[a][b]
            for r in range(N_OBSERVED):
                left = left - W[a][r] * W[b][r]
            y[place_of(a, b)] = left


def update_left(
    x: real[N_STATE],
    o: real[SIZE],
    Y: real[N_OBSERVED],
    N: real[N_NOISE],
    y: out[real[N_STATE]],
):
    """y = the state x after an observation Y = A o + V of N_OBSERVED numbers, V a noise of the covariance N, positive
    definite, by rows."""
    G: real[SIZE, SIZE]
    H: real[N_OBSERVED, N_ALGEBRA]
    z: real[N_OBSERVED]
    element_of(x, G)
    slopes(G, o, 1.0, RIGHT, H)
    innovation(G, o, Y, z)
    corrected(x, z, H, N, y)


def update_right(
    x: real[N_STATE],
    o: real[SIZE],
    Y: real[N_OBSERVED],
    N: real[N_NOISE],
    y: out[real[N_STATE]],
):
    """y = the state x after an observation Y = A^-1 o + V of N_OBSERVED numbers, V a noise of the covariance N,
    positive definite, by rows."""
    G: real[SIZE, SIZE]
    B: real[SIZE, SIZE]
    H: real[N_OBSERVED, N_ALGEBRA]
    z: real[N_OBSERVED]
    element_of(x, G)
    inverse_of(G, B)
    slopes(B, o, -1.0, LEFT, H)
    innovation(B, o, Y, z)
    corrected(x, z, H, N, y)


def update(
    x: real[N_STATE],
    z: real[N_OBSERVED],
    H: real[N_JACOBIAN_OBSERVED],
    N: real[N_NOISE],
    y: out[real[N_STATE]],
):
    """y = the state x after any observation h of at most N_OBSERVED numbers: z = what is observed - h(g), H by rows with
    h(PRODUCT) = h(g) + H eta to the first order, N the covariance of its noise; of fewer numbers, rows of H and entries
    of z that are 0, 1 on the diagonal of N."""
    slope: real[N_OBSERVED, N_ALGEBRA]
    seen: real[N_OBSERVED]
    for r in range(N_OBSERVED):
        seen[r] = z[r]
        for a in range(N_ALGEBRA):
            slope[r][a] = H[N_ALGEBRA * r + a]
    corrected(x, seen, slope, N, y)
