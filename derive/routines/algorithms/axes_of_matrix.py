"""The axes of a symmetric matrix, as numbers one after the other: its eigenvalues, then the axes, by rows."""


def turned_rows(n: index, at: index, i: index, j: index, c: real, b: real, m: out[real[LARGEST]]):
    """Rows i and j of a matrix that begins at a place, turned by the angle of cosine c and sine b."""
    for k in range(n):
        u: real = m[at + n * i + k]
        v: real = m[at + n * j + k]
        m[at + n * i + k] = c * u + b * v
        m[at + n * j + k] = c * v - b * u


def in_order(n: index, values: out[real[LARGEST]]):
    """The smallest first; where two rows change places, one changes its sign."""
    for i in range(n):
        least: var[index] = i
        for j in range(i + 1, n):
            least = j if values[j] < values[least] else least
        if least != i:
            value: real = values[i]
            values[i] = values[least]
            values[least] = value
            turned_rows(n, n, i, least, 0.0, 1.0, values)


def equal_apart(n: index, values: out[real[LARGEST]]):
    """Rows of equal values turned until they hang on their span alone."""
    low: real = abs(values[0])
    high: real = abs(values[n - 1])
    equal: real = TOLERANCE * (low if low > high else high)
    for i in range(n):
        end: var[index] = i + 1
        first: var[index] = -1
        square: var[real] = 0.0
        while end < n and values[end] - values[end - 1] <= equal:
            end += 1
        while end - i > 1 and square * real(n) < real(end - i) * SHARE:
            square = 0.0
            first += 1
            for j in range(i, end):
                square += values[n + n * j + first] * values[n + n * j + first]
        for j in range(i + 1, end):  # row j loses its component along unit vector first
            x: real = values[n + n * i + first]
            y: real = values[n + n * j + first]
            root: real = hypot(x, y)
            if root > 0.0:
                turned_rows(n, n, i, j, x / root, y / root, values)


def axes(n: index, s: out[real[LARGEST]], values: out[real[LARGEST]]):
    """The axes of a symmetric matrix s (n x n by rows, destroyed) by Jacobi's rotations: writes its n eigenvalues,
    smallest first, then n rows, the axes, a rotation R: s = R^T diag R.  Each row but the first leans to the side
    of (1/(1+pi), 1/(2+pi), ...), and rows of equal values are unit vectors projected on what is left of their
    span, so that other languages and compilers find the same."""
    hidden: var[real] = 0.0  # not a number where an entry of s is none
    for i in range(n * n):
        hidden += s[i] - s[i]
        values[n + i] = 1.0 if i % (n + 1) == 0 else 0.0
    for sweep in range(30):
        turned: var[flag] = False
        for i in range(n):
            for j in range(i + 1, n):
                off: real = s[n * i + j]
                gap: real = s[n * j + j] - s[n * i + i]
                size: real = abs(s[n * i + i]) + abs(s[n * j + j])
                if not size + abs(off) > size:
                    continue
                turned = True
                root: real = hypot(gap, 2.0 * off)
                t: real = 2.0 * off / (gap - root if gap < 0.0 else gap + root)
                c: real = 1.0 / sqrt(1.0 + t * t)
                for k in range(n):
                    u: real = s[n * k + i]
                    v: real = s[n * k + j]
                    s[n * k + i] = c * u - t * c * v
                    s[n * k + j] = t * c * u + c * v
                turned_rows(n, 0, i, j, c, -t * c, s)
                turned_rows(n, n, i, j, c, -t * c, values)
        if not turned:
            break
    for i in range(n):
        values[i] = s[n * i + i] + hidden
    in_order(n, values)
    equal_apart(n, values)
    for i in range(1, n):
        lean: var[real] = 0.0
        for k in range(n):
            lean += values[n + n * i + k] / (real(k + 1) + PI)
        for k in range(n):  # two rows change their signs
            values[n + k] = -values[n + k] if lean < 0.0 else values[n + k]
            values[n + n * i + k] = -values[n + n * i + k] if lean < 0.0 else values[n + n * i + k]
