"""Exponential and logarithm of a group whose factors turn a plane or space and shift it.

A factor is a block [[R, S], [0, 1]] of the matrix of an element, R a rotation of its first rows, S
any number of columns; an element of the algebra is [[W, V], [0, 0]], W skew.  t is the angle.
"""

factor_of: table[index, N_ALGEBRA] = FACTOR_OF
series: table[real, 6, TERMS] = SERIES


def turning(square: real, f: out[real[6]]):
    """Functions of square = t^2: a = sin t/t, b = (1 - cos t)/t^2, c = (t - sin t)/t^3, -db/d(t^2), -dc/d(t^2)
    and d^2b/d(t^2)^2; for small t by their series."""
    if square < 4.0:
        for m in range(6):
            total: var[real] = 0.0
            for n in reversed(range(TERMS)):
                total = series[m][n] - square * total
            f[m] = total
    else:
        angle: real = sqrt(square)
        half: real = sin(angle / 2.0)
        f[0] = sin(angle) / angle
        f[1] = 2.0 * half * half / square
        f[2] = (1.0 - f[0]) / square
        f[3] = (2.0 * f[1] - f[0]) / (2.0 * square)
        f[4] = (3.0 * f[2] - f[1]) / (2.0 * square)
        f[5] = (4.0 * f[3] + (1.0 - square * f[1] - f[0]) / (2.0 * square)) / (2.0 * square)


def squared(X: real[SIZE, SIZE], at: index, rows: index) -> real:
    """The square of the angle that a factor of exp X turns by."""
    total: var[real] = 0.0
    for row in range(at, at + rows):
        for column in range(at, row):
            total = total + X[row][column] * X[row][column]
    return total


def exp_of(eta: real[N_ALGEBRA], G: out[real[SIZE, SIZE]]):
    """The matrix exp X: in each factor R = 1 + a W + b W^2, S = V + b W V + c W^2 V."""
    f: real[6]
    X: real[SIZE, SIZE]
    once: real[SIZE, SIZE]
    again: real[SIZE, SIZE]
    hat(eta, X)
    product(X, X, once)
    product(X, once, again)
    for i in unrolled(N_FACTORS):
        turning(squared(X, STARTS[i], ROWS[i]), f)
        for row in range(STARTS[i], ENDS[i]):
            for column in range(SIZE):
                if column < STARTS[i] + ROWS[i]:
                    G[row][column] = f[0] * X[row][column] + f[1] * once[row][column]
                else:
                    change: real = f[1] * once[row][column] + f[2] * again[row][column]
                    G[row][column] = X[row][column] + change
            G[row][row] += 1.0


def plane_log(G: real[SIZE, SIZE], at: index, X: out[real[SIZE, SIZE]]):
    """The logarithm W of a rotation of a plane."""
    angle: real = atan2(G[at + 1][at] - G[at][at + 1], G[at][at] + G[at + 1][at + 1])
    X[at + 1][at] = angle
    X[at][at + 1] = -angle


def space_log(G: real[SIZE, SIZE], at: index, X: out[real[SIZE, SIZE]]):
    """The logarithm W of a rotation of space: by its skew part, from a quarter turn on by its symmetric part,
    cos t + (1 - cos t) n n^T, n the axis, with the sign of the skew part."""
    y: real[3]
    n: real[3]
    sine: var[real] = 0.0
    cosine: var[real] = -0.5
    scale: var[real] = 1.0
    largest: var[index] = 0
    for m in range(3):
        y[m] = G[at + (m + 2) % 3][at + (m + 1) % 3] - G[at + (m + 1) % 3][at + (m + 2) % 3]
        y[m] = y[m] / 2.0
        n[m] = y[m]
        sine = sine + y[m] * y[m]
        cosine = cosine + G[at + m][at + m] / 2.0
        if G[at + m][at + m] > G[at + largest][at + largest]:
            largest = m
    sine = sqrt(sine)
    if cosine > 0.0:
        if sine > 0.0:
            scale = atan2(sine, cosine) / sine
    else:
        for m in range(3):
            n[m] = (G[at + m][at + largest] + G[at + largest][at + m]) / 2.0
        n[largest] = n[largest] - cosine
        scale = atan2(sine, cosine) / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
        along: real = n[0] * y[0] + n[1] * y[1] + n[2] * y[2]
        if along < 0.0:
            scale = -scale
    for m in range(3):
        X[at + (m + 2) % 3][at + (m + 1) % 3] = scale * n[m]
        X[at + (m + 1) % 3][at + (m + 2) % 3] = -scale * n[m]


def log_of(G: real[SIZE, SIZE], eta: out[real[N_ALGEBRA]]):
    """The coordinates of the logarithm of a matrix: in each factor V = S - W S/2 + e W^2 S, where
    e = (1 - (t/2) cot(t/2))/t^2.  A factor that is kept by a quaternion has W in the place of R."""
    f: real[6]
    X: real[SIZE, SIZE]
    once: real[SIZE, SIZE]
    again: real[SIZE, SIZE]
    for row in range(SIZE):
        for column in range(SIZE):
            X[row][column] = 0.0
    for i in unrolled(N_FACTORS):
        if IN_PLANE[i]:
            plane_log(G, STARTS[i], X)
        if IN_SPACE[i]:
            if BY_QUATERNION[i]:
                for row in range(STARTS[i], STARTS[i] + 3):
                    for column in range(STARTS[i], STARTS[i] + 3):
                        X[row][column] = G[row][column]
            else:
                space_log(G, STARTS[i], X)
    product(X, G, once)
    product(X, once, again)
    for i in unrolled(N_FACTORS):
        turning(squared(X, STARTS[i], ROWS[i]), f)
        for row in range(STARTS[i], STARTS[i] + ROWS[i]):
            for column in range(STARTS[i] + ROWS[i], ENDS[i]):
                change: real = f[3] / f[1] * again[row][column] - once[row][column] / 2.0
                X[row][column] = G[row][column] + change
    for a in range(N_ALGEBRA):
        eta[a] = 0.0
    for n in range(N_READ):
        eta[read_at[n][2]] += read_by[n] * X[read_at[n][0]][read_at[n][1]]


def factor_inverse(
    X: real[SIZE, SIZE], at: index, rows: index, end: index, N: out[real[SIZE, SIZE]]
):
    """The factor from at to end of X^-1: R^T, and -R^T S beside it."""
    for row in range(at, end):
        for column in range(SIZE):
            N[row][column] = 1.0 if row == column else 0.0
    for row in range(at, at + rows):
        for column in range(at, at + rows):
            N[row][column] = X[column][row]
        for column in range(at + rows, end):
            for m in range(at, at + rows):
                N[row][column] = N[row][column] - X[m][row] * X[m][column]


def inverse_of(G: real[SIZE, SIZE], N: out[real[SIZE, SIZE]]):
    """The inverse of the matrix of an element."""
    for i in unrolled(N_FACTORS):
        factor_inverse(G, STARTS[i], ROWS[i], ENDS[i], N)


def derivative(eta: real[N_ALGEBRA], inverse: flag, J: out[real[N_JACOBIAN]]):
    """That of exp, or its inverse, as a polynomial of ad b = [eta, b], of which (ad^2 + t^2)^2 ad is 0."""
    f: real[6]
    X: real[SIZE, SIZE]
    c: real[N_FACTORS, 5]
    now: real[N_ALGEBRA]
    moved: real[N_ALGEBRA]
    squares: real[N_FACTORS]
    hat(eta, X)
    for i in unrolled(N_FACTORS):
        squares[i] = squared(X, STARTS[i], ROWS[i])
    for k in range(N_FACTORS):
        turning(squares[k], f)
        c[k][0] = 1.0
        if inverse:
            cotangent: real = f[3] / f[1]
            c[k][1] = BACK
            c[k][3] = 0.0
            c[k][4] = (f[5] - cotangent * f[3]) / f[1]
            c[k][2] = cotangent + squares[k] * c[k][4]
        else:
            c[k][1] = SIGN * (f[1] + squares[k] * f[3])
            c[k][2] = f[2] + squares[k] * f[4]
            c[k][3] = SIGN * f[3]
            c[k][4] = f[4]
    for column in range(N_ALGEBRA):
        for a in range(N_ALGEBRA):
            now[a] = 0.0
        for n in reversed(range(5)):
            for a in range(N_ALGEBRA):
                moved[a] = 0.0
            for m in range(N_BRACKET):
                scale: real = bracket_by[m] * eta[bracket_at[m][2]]
                moved[bracket_at[m][0]] += scale * now[bracket_at[m][1]]
            moved[column] += c[factor_of[column]][n]
            for a in range(N_ALGEBRA):
                now[a] = moved[a]
        for a in range(N_ALGEBRA):
            J[N_ALGEBRA * a + column] = now[a]
