"""Exponential, logarithm, their derivatives, and steps from state to state, of any group."""


def exp(eta: real[N_ALGEBRA], g: out[real[N_ELEMENT]]):
    """g = exp of the sum of eta_a E_a."""
    if N_ENTRIES:
        G: real[SIZE, SIZE]
        exp_of(eta, G)
        for n in range(N_ENTRIES):
            g[entry[n][2]] = G[entry[n][0]][entry[n][1]]
    if N_QUATERNIONS:
        q: real[4]
    for i in unrolled(N_QUATERNIONS):
        quaternion_of(eta, TURNED[i], q)
        for m in range(4):
            g[QUATERNIONS[i] + m] = q[m]


def log(g: real[N_ELEMENT], eta: out[real[N_ALGEBRA]]):
    """The eta with g = exp of the sum of eta_a E_a, DOMAIN."""
    G: real[SIZE, SIZE]
    matrix_of(g, G)
    if N_LOGARITHMS:
        q: real[4]
        one: real[4]
        for m in range(4):
            one[m] = 1.0 if m == 0 else 0.0
    for i in unrolled(N_LOGARITHMS):
        for m in range(4):
            q[m] = g[QUATERNIONS[i] + m]
        turn_between(one, q, TURNED[i], G)
    log_of(G, eta)


def exp_jacobian(eta: real[N_ALGEBRA], J: out[real[N_JACOBIAN]]):
    """J by rows: JACOBIAN for small d."""
    derivative(eta, False, J)


def log_jacobian(g: real[N_ELEMENT], J: out[real[N_JACOBIAN]]):
    """J by rows: INVERSE for small d, the inverse of exp_jacobian there."""
    eta: real[N_ALGEBRA]
    log(g, eta)
    derivative(eta, True, J)


def retract(x: real[N_STATE], eta: real[N_TANGENT], y: out[real[N_STATE]]):
    """y = the state x moved by eta: PRODUCT of the first N_ALGEBRA numbers of eta, and the others added to the
    velocity."""
    by: real[N_ALGEBRA]
    for a in range(N_ALGEBRA):
        by[a] = eta[a]
    if N_ENTRIES:
        X: real[SIZE, SIZE]
        E: real[SIZE, SIZE]
        G: real[SIZE, SIZE]
        element_of(x, X)
        exp_of(by, E)
        if RIGHT:
            product(E, X, G)
        else:
            product(X, E, G)
        for n in range(N_ENTRIES):
            y[entry[n][2]] = G[entry[n][0]][entry[n][1]]
    if N_QUATERNIONS:
        q: real[4]
        r: real[4]
        s: real[4]
    for i in unrolled(N_QUATERNIONS):
        quaternion_of(by, TURNED[i], q)
        for m in range(4):
            r[m] = x[QUATERNIONS[i] + m]
        product_of(r, q, s)
        for m in range(4):
            y[QUATERNIONS[i] + m] = s[m]
    for a in range(N_ADDED):
        y[N_ELEMENT + a] = x[N_ELEMENT + a] + eta[N_ALGEBRA + a]


def local(x: real[N_STATE], y: real[N_STATE], eta: out[real[N_TANGENT]]):
    """The eta that retract takes x to y by, DOMAIN."""
    by: real[N_ALGEBRA]
    X: real[SIZE, SIZE]
    D: real[SIZE, SIZE]
    N: real[SIZE, SIZE]
    G: real[SIZE, SIZE]
    element_of(x, X)
    element_of(y, D)
    # X^-1 Y = 1 + X^-1 (Y - X), where what is near has all its digits
    for row in range(SIZE):
        for column in range(SIZE):
            D[row][column] = D[row][column] - X[row][column]
    inverse_of(X, N)
    if RIGHT:
        product(D, N, G)
    else:
        product(N, D, G)
    for row in range(SIZE):
        G[row][row] += 1.0
    if N_LOGARITHMS:
        q: real[4]
        r: real[4]
    for i in unrolled(N_LOGARITHMS):
        for m in range(4):
            q[m] = x[QUATERNIONS[i] + m]
            r[m] = y[QUATERNIONS[i] + m]
        turn_between(q, r, TURNED[i], G)
    log_of(G, by)
    for a in range(N_ALGEBRA):
        eta[a] = by[a]
        eta[N_ALGEBRA + a] = y[N_ELEMENT + a] - x[N_ELEMENT + a]
    if N_MASSES:
        for a in range(N_ALGEBRA, N_ADDED):
            eta[N_ALGEBRA + a] = y[N_ELEMENT + a] - x[N_ELEMENT + a]
