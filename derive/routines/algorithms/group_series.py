"""Exponential and logarithm of any group of matrices.

exp by scaling and squaring; log by square roots, each by the iteration of Denman and Beavers, and the series of
2 artanh.  The derivative of exp is (exp A - 1)/A of A = ad or -ad.  Matrices have n rows of WIDE.
"""


def times(n: index, A: real[WIDE, WIDE], B: real[WIDE, WIDE], C: out[real[WIDE, WIDE]]):
    """C = A B."""
    for row in range(n):
        for column in range(n):
            total: var[real] = 0.0
            for m in range(n):
                total = total + A[row][m] * B[m][column]
            C[row][column] = total


def squared_size(n: index, A: real[WIDE, WIDE], c: real) -> real:
    """The sum of the squares of the entries of A - c."""
    total: var[real] = 0.0
    for row in range(n):
        for column in range(n):
            entry_of: real = A[row][column] - c if row == column else A[row][column]
            total = total + entry_of * entry_of
    return total


def inverted(n: index, A: out[real[WIDE, WIDE]]) -> flag:
    """A^-1 in the place of A, by Gauss and Jordan; False where A is singular."""
    pivots: index[WIDE]
    for c in range(n):
        best: var[index] = c
        for i in range(c, n):
            if A[i][c] * A[i][c] > A[best][c] * A[best][c]:
                best = i
        pivots[c] = best
        for j in range(n):
            other: real = A[c][j]
            A[c][j] = A[best][j]
            A[best][j] = other
        pivot: real = A[c][c]
        if not pivot * pivot > 0.0:
            return False
        A[c][c] = 1.0
        for j in range(n):
            A[c][j] = A[c][j] / pivot
        for i in range(n):
            if i != c:
                by: real = A[i][c]
                A[i][c] = 0.0
                for j in range(n):
                    A[i][j] = A[i][j] - by * A[c][j]
    for c in reversed(range(n)):
        for i in range(n):
            other: real = A[i][c]
            A[i][c] = A[i][pivots[c]]
            A[i][pivots[c]] = other
    return True


def grown(n: index, A: real[WIDE, WIDE], E: out[real[WIDE, WIDE]], F: out[real[WIDE, WIDE]]):
    """E = exp A - 1, and F = E/A: those of A/2^s, of a size of at most 1/2, by their series, then of its doubles."""
    B: real[WIDE, WIDE]
    W: real[WIDE, WIDE]
    size: var[real] = sqrt(squared_size(n, A, 0.0))
    scale: var[real] = 1.0
    doublings: var[index] = 0
    for m in range(MOST):
        if size * scale > 0.5:
            scale = scale / 2.0
            doublings = doublings + 1
    for row in range(n):
        for column in range(n):
            B[row][column] = scale * A[row][column]
            F[row][column] = 1.0 if row == column else 0.0
    over: var[real] = 15.0
    for m in range(14):
        times(n, B, F, W)
        for row in range(n):
            for column in range(n):
                F[row][column] = W[row][column] / over
            F[row][row] += 1.0
        over = over - 1.0
    times(n, B, F, E)
    for m in range(doublings):
        times(n, E, F, W)
        for row in range(n):
            for column in range(n):
                F[row][column] = F[row][column] + W[row][column] / 2.0
        times(n, E, E, W)
        for row in range(n):
            for column in range(n):
                E[row][column] = 2.0 * E[row][column] + W[row][column]


def rooted(n: index, X: out[real[WIDE, WIDE]]) -> flag:
    """The square root of X with eigenvalues of positive real parts in the place of X; False where there is none."""
    M: real[WIDE, WIDE]
    N: real[WIDE, WIDE]
    W: real[WIDE, WIDE]
    for row in range(n):
        for column in range(n):
            M[row][column] = X[row][column]
    for m in range(MOST):
        left: real = squared_size(n, M, 1.0)
        for row in range(n):
            for column in range(n):
                N[row][column] = M[row][column]
        if not inverted(n, N):
            return False
        times(n, X, N, W)
        for row in range(n):
            for column in range(n):
                X[row][column] = (X[row][column] + W[row][column]) / 2.0
                M[row][column] = (M[row][column] + N[row][column]) / 4.0
            M[row][row] += 0.5
        if left < SMALL:
            return True
    return False


def exp_of(eta: real[N_ALGEBRA], G: out[real[SIZE, SIZE]]):
    """The matrix exp X of X, the sum of eta_a E_a."""
    X: real[SIZE, SIZE]
    A: real[WIDE, WIDE]
    E: real[WIDE, WIDE]
    F: real[WIDE, WIDE]
    hat(eta, X)
    for row in range(SIZE):
        for column in range(SIZE):
            A[row][column] = X[row][column]
    grown(SIZE, A, E, F)
    for row in range(SIZE):
        for column in range(SIZE):
            G[row][column] = E[row][column]
        G[row][row] += 1.0


def log_by_roots(G: real[SIZE, SIZE], eta: out[real[N_ALGEBRA]]):
    """The coordinates of the logarithm of a matrix: 2^(s + 1) artanh Z, Z = (R - 1)/(R + 1) of its root R of degree
    2^s, which is within 1/4 of 1."""
    R: real[WIDE, WIDE]
    N: real[WIDE, WIDE]
    Z: real[WIDE, WIDE]
    S: real[WIDE, WIDE]
    W: real[WIDE, WIDE]
    scale: var[real] = 2.0
    known: var[flag] = True
    for row in range(SIZE):
        for column in range(SIZE):
            R[row][column] = G[row][column]
    for m in range(MOST):
        if known and not squared_size(SIZE, R, 1.0) < 0.0625:
            known = rooted(SIZE, R)
            scale = scale * 2.0
    for row in range(SIZE):
        for column in range(SIZE):
            N[row][column] = R[row][column]
        R[row][row] -= 1.0
        N[row][row] += 1.0
    known = known and inverted(SIZE, N)
    times(SIZE, R, N, Z)
    times(SIZE, Z, Z, S)
    # 1 + S/3 + S^2/5 + ..., from the last term
    over: var[real] = 19.0
    for row in range(SIZE):
        for column in range(SIZE):
            N[row][column] = 0.0
    for m in range(10):
        times(SIZE, S, N, W)
        for row in range(SIZE):
            for column in range(SIZE):
                N[row][column] = W[row][column]
            N[row][row] += 1.0 / over
        over = over - 2.0
    times(SIZE, Z, N, W)
    none: real = INFINITY - INFINITY
    for a in range(N_ALGEBRA):
        eta[a] = 0.0 if known else none
    for n in range(N_READ):
        eta[read_at[n][2]] += read_by[n] * scale * W[read_at[n][0]][read_at[n][1]]


def inverse_of(G: real[SIZE, SIZE], N: out[real[SIZE, SIZE]]):
    """The inverse of the matrix of an element."""
    A: real[WIDE, WIDE]
    for row in range(SIZE):
        for column in range(SIZE):
            A[row][column] = G[row][column]
    regular: flag = inverted(SIZE, A)
    none: real = INFINITY - INFINITY
    for row in range(SIZE):
        for column in range(SIZE):
            N[row][column] = A[row][column] if regular else none


def derivative(eta: real[N_ALGEBRA], inverse: flag, J: out[real[N_JACOBIAN]]):
    """That of exp, or its inverse, by the matrix of ad b = [eta, b]."""
    A: real[WIDE, WIDE]
    E: real[WIDE, WIDE]
    F: real[WIDE, WIDE]
    regular: var[flag] = True
    for a in range(N_ALGEBRA):
        for b in range(N_ALGEBRA):
            A[a][b] = 0.0
    for m in range(N_BRACKET):
        A[bracket_at[m][0]][bracket_at[m][1]] += SIGN * bracket_by[m] * eta[bracket_at[m][2]]
    grown(N_ALGEBRA, A, E, F)
    none: real = INFINITY - INFINITY
    if inverse:
        regular = inverted(N_ALGEBRA, F)
    for a in range(N_ALGEBRA):
        for b in range(N_ALGEBRA):
            J[N_ALGEBRA * a + b] = F[a][b] if regular else none


def largest_entry(G: real[SIZE, SIZE]) -> real:
    """The size of the largest entry."""
    found: var[real] = 0.0
    for row in range(SIZE):
        for column in range(SIZE):
            if abs(G[row][column]) > found:
                found = abs(G[row][column])
    return found


def log_of(G: real[SIZE, SIZE], eta: out[real[N_ALGEBRA]]):
    """The same, after two steps of Newton's method: roots lose digits where an eigenvalue is nearly negative.  Of G
    or its inverse that with the smaller entries is taken, as small numbers of the other's exponential are lost."""
    back: real[N_ALGEBRA]
    left: real[N_ALGEBRA]
    S: real[SIZE, SIZE]
    N: real[SIZE, SIZE]
    W: real[SIZE, SIZE]
    J: real[N_JACOBIAN]
    inverse_of(G, S)
    sign: real = -1.0 if largest_entry(S) < largest_entry(G) else 1.0
    for row in range(SIZE):
        for column in range(SIZE):
            S[row][column] = S[row][column] if sign < 0.0 else G[row][column]
    log_by_roots(S, eta)
    steps: index = 2 if largest_entry(S) < 1e4 else 0
    for m in range(steps):
        for a in range(N_ALGEBRA):
            back[a] = -eta[a]
        exp_of(back, N)
        if RIGHT:
            product(S, N, W)
        else:
            product(N, S, W)
        log_by_roots(W, left)
        derivative(eta, True, J)
        for a in range(N_ALGEBRA):
            for b in range(N_ALGEBRA):
                eta[a] += J[N_ALGEBRA * a + b] * left[b]
    for a in range(N_ALGEBRA):
        eta[a] = sign * eta[a]
