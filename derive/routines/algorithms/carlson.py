"""The integrals over u > 0 of powers of P(u) = u^3 + first u^2 + second u + third; METHOD stands for
the name of a function that gives some, whose head and straight lines the file has."""


def METHOD(first: var[real], second: var[real], third: real):
    """Carlson's duplication."""
    kept: real[DUPLICATIONS, 4]
    product: var[real] = sqrt(third)
    mean: var[real] = 0.0
    ratio: var[real] = 0.0
    y: var[real] = 0.0
    z: var[real] = 0.0
    steps: var[index] = 0
    for i in range(DUPLICATIONS + 1):
        steps = i
        mean = first / 3.0
        ratio = second / (mean * mean)
        y = ratio - 3.0
        z = ratio - 2.0 - product * product / (mean * mean * mean)
        if i == DUPLICATIONS or y > SMALL_Y:  # y <= 0
            break
        # e = sqrt x + sqrt y + sqrt z: e^2 = first + 2 pairs, pairs^2 = second + 2 e product
        e: var[real] = sqrt(mean) * (3.0 + y / 4.0 - 3.0 * z / 16.0 - 5.0 * y * y / 64.0)
        for j in range(NEWTON_STEPS):
            pairs: real = sqrt(second + 2.0 * e * product)
            next: real = sqrt(first + 2.0 * pairs)
            change: real = (e - next) / (1.0 - product / (pairs * next))
            e -= change
            if change * change <= CONVERGED * e * e:
                break
        pairs: real = sqrt(second + 2.0 * e * product)
        kept[i][0] = first
        kept[i][1] = e
        kept[i][2] = pairs
        kept[i][3] = product
        second = (second + 2.0 * pairs * first + 3.0 * pairs * pairs) / 16.0
        first = (first + 3.0 * pairs) / 4.0
        product = (e * pairs - product) / 8.0
    # g, h: derivatives by first, second, product
    written("end")
    for i in reversed(range(steps)):
        first = kept[i][0]
        e: real = kept[i][1]
        pairs: real = kept[i][2]
        product = kept[i][3]
        written("back")
    written("whole")
