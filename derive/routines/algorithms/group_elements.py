"""Elements of a group and of its algebra as matrices, before what is made of them."""

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
