"""Elements of a group and of its algebra as matrices, before what is made of them; turns of space as
unit quaternions, scalar first, of the factors of an element that are kept so.

A factor has its turn in three rows of its matrix, from ``row`` on.
"""

if N_ENTRIES:
    entry: table[index, N_ENTRIES, 3] = ENTRIES
origin: table[real, SIZE, SIZE] = ORIGIN
hat_at: table[index, N_HAT, 3] = HAT_PLACES
hat_by: table[real, N_HAT] = HAT_VALUES
read_at: table[index, N_READ, 3] = READ_PLACES
read_by: table[real, N_READ] = READ_VALUES
bracket_at: table[index, N_BRACKET, 3] = BRACKET_PLACES
bracket_by: table[real, N_BRACKET] = BRACKET_VALUES


def matrix_of(g: real[N_ELEMENT], G: out[real[SIZE, SIZE]]):
    """The matrix of an element as the state has it."""
    for row in range(SIZE):
        for column in range(SIZE):
            G[row][column] = origin[row][column]
    if N_ENTRIES:
        for n in range(N_ENTRIES):
            G[entry[n][0]][entry[n][1]] = g[entry[n][2]]
    if N_QUATERNIONS:
        q: real[4]
    for i in unrolled(N_QUATERNIONS):
        for m in range(4):
            q[m] = g[QUATERNIONS[i] + m]
        rotation_of(q, TURNED[i], G)


def element_of(x: real[N_STATE], G: out[real[SIZE, SIZE]]):
    """The matrix of the element in a state."""
    g: real[N_ELEMENT]
    for n in range(N_ELEMENT):
        g[n] = x[n]
    matrix_of(g, G)


def hat(eta: real[N_ALGEBRA], X: out[real[SIZE, SIZE]]):
    """The sum of eta_a E_a."""
    for row in range(SIZE):
        for column in range(SIZE):
            X[row][column] = 0.0
    for n in range(N_HAT):
        X[hat_at[n][0]][hat_at[n][1]] += hat_by[n] * eta[hat_at[n][2]]


def product(A: real[SIZE, SIZE], B: real[SIZE, SIZE], C: out[real[SIZE, SIZE]]):
    """C = A B."""
    for row in range(SIZE):
        for column in range(SIZE):
            total: var[real] = 0.0
            for m in range(SIZE):
                total = total + A[row][m] * B[m][column]
            C[row][column] = total


def rotation_of(q: real[4], row: index, G: out[real[SIZE, SIZE]]):
    """The rotation 1 + 2 p j(v) + 2 j(v)^2 of a unit quaternion q = (p, v)."""
    for m in range(3):
        u: real = q[1 + (m + 1) % 3]
        v: real = q[1 + (m + 2) % 3]
        turn: real = q[0] * q[1 + m]
        G[row + m][row + m] = 1.0 - 2.0 * (u * u + v * v)
        G[row + (m + 2) % 3][row + (m + 1) % 3] = 2.0 * (u * v + turn)
        G[row + (m + 1) % 3][row + (m + 2) % 3] = 2.0 * (u * v - turn)


def product_of(a: real[4], b: real[4], c: out[real[4]]):
    """c = a b."""
    c[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3]
    for m in range(3):
        turned: real = a[1 + (m + 1) % 3] * b[1 + (m + 2) % 3]
        back: real = a[1 + (m + 2) % 3] * b[1 + (m + 1) % 3]
        c[1 + m] = a[0] * b[1 + m] + a[1 + m] * b[0] + turned - back


def quaternion_of(eta: real[N_ALGEBRA], row: index, q: out[real[4]]):
    """q = (cos(t/2), sin(t/2) n) of the turn of exp(eta) by t about n."""
    X: real[SIZE, SIZE]
    square: var[real] = 0.0
    scale: var[real] = 0.5
    hat(eta, X)
    for m in range(3):
        q[1 + m] = X[row + (m + 2) % 3][row + (m + 1) % 3]
        square = square + q[1 + m] * q[1 + m]
    angle: real = sqrt(square)
    quarter: real = sin(angle / 4.0)
    if angle > 0.0:
        scale = sin(angle / 2.0) / angle
    q[0] = 1.0 - 2.0 * quarter * quarter
    for m in range(3):
        q[1 + m] = scale * q[1 + m]


def turn_between(a: real[4], b: real[4], row: index, W: out[real[SIZE, SIZE]]):
    """The logarithm j(t n) of the turn from a to b, or to -b where that is nearer: t is at most pi."""
    back: real[4]
    step: real[4]
    c: real[4]
    sign: var[real] = 1.0
    scale: var[real] = 2.0
    cosine: var[real] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
    if cosine < 0.0:
        sign = -1.0
    # of a^-1 b = 1 + a^-1 (b - a), where what is near has all its digits
    for m in range(4):
        step[m] = sign * b[m] - a[m]
        back[m] = a[m] if m == 0 else -a[m]
    product_of(back, step, c)
    sine: real = sqrt(c[1] * c[1] + c[2] * c[2] + c[3] * c[3])
    if sine > 0.0:
        scale = 2.0 * atan2(sine, sign * cosine) / sine
    for m in range(3):
        W[row + m][row + m] = 0.0
        W[row + (m + 2) % 3][row + (m + 1) % 3] = scale * c[1 + m]
        W[row + (m + 1) % 3][row + (m + 2) % 3] = -scale * c[1 + m]
