"""Random trees of every operator that make sense: numbers, vectors and matrices."""

from fractions import Fraction

from derive.language.tree import add, mul, neg

MATRICES = ("A", "J", "C", "α", "Z", "ξ", "ξ′", "δA", "δ′A", "Ż", "J_c", "N_b", "F̃", "δΠ")
VECTORS = ("c", "w", "η", "τ", "ζ", "Ω", "Ω′", "ζ̇", "δζ", "p_b", "ℓ̇_b")
SCALARS = ("m", "t", "δt", "δ′t", "L̃", "h̃", "θ")
PARAMETERS = ("k", "ab", "x_1", "l0", "rho", "mass", "k_12", "y2", "s_max", "omega_3")
FUNCTIONS = ("sin", "cos", "exp", "log", "atan", "sqrt", "tanh")
OWN = {*MATRICES, *VECTORS, *SCALARS, "r", "m", "v", "d", "E", "dŨ", "p̃", "X", "I", "σ", "g", "dϖ",
       "δy", "δ′y"}  # fmt: skip


def scalar(draw, depth):
    """A number."""
    if depth < 1:
        return draw.choice((
            lambda: draw.choice(SCALARS),
            lambda: ("par", draw.choice(PARAMETERS)),
            lambda: ("par", draw.choice(PARAMETERS)),
            lambda: draw.randint(1, 20),
            lambda: Fraction(draw.randint(1, 9), draw.randint(2, 12)),
            lambda: ("entry", draw.choice(VECTORS), draw.randint(1, 3)),
            lambda: ("entry", draw.choice(("A", "J", "Z", "Ż", "I")), draw.randint(1, 3), 2),
            lambda: ("at", "m", draw.choice(("i", "j", 1, 12))),
            lambda: ("entry", ("at", "d", draw.randint(1, 12)), draw.randint(1, 3)),
            lambda: ("entry", ("call", ("at", "r", draw.randint(1, 3)), "t"), 2),
        ))()  # fmt: skip
    d = depth - 1
    return draw.choice((
        lambda: add(*(signed(draw, scalar(draw, d)) for _ in range(draw.randint(2, 3)))),
        lambda: mul(*(scalar(draw, d) for _ in range(draw.randint(2, 3)))),
        lambda: ("div", scalar(draw, d), scalar(draw, d)),
        lambda: ("pow", scalar(draw, d), draw.choice((2, 3, -2))),
        lambda: ("fun", draw.choice(FUNCTIONS), scalar(draw, d)),
        lambda: ("tr", matrix(draw, d)),
        lambda: ("det", matrix(draw, d)),
        lambda: ("inv", scalar(draw, d)),
        lambda: ("inner", vector(draw, d), vector(draw, d)),
        lambda: ("metric", matrix(draw, d), vector(draw, d), vector(draw, d)),
        lambda: ("norm2", vector(draw, d)),
        lambda: ("norm2", matrix(draw, 0), vector(draw, d)),
        lambda: ("fun", "sqrt", ("norm2", vector(draw, d))),
        lambda: ("fun", "sqrt", ("pow", scalar(draw, d), 2)),
        lambda: ("sum", "i", mul(("at", "m", "i"), scalar(draw, d))),
        lambda: ("sum", "j", add(("at", "m", "j"), scalar(draw, d))),
        lambda: ("call", "dŨ", matrix(draw, d)),
        lambda: ("call", "p̃", matrix(draw, d), vector(draw, d)),
        lambda: ("call", "dϖ", "δy", "δ′y"),
        lambda: ("call", "∫", scalar(draw, d)),
        lambda: ("entry", matrix(draw, d), 1, draw.choice((2, 11))),
        lambda: ("entry", vector(draw, d), 3),
    ))()  # fmt: skip


def signed(draw, t):
    """It or its opposite."""
    return neg(t) if draw.random() < 0.4 else t


def vector(draw, depth):
    """Three numbers."""
    if depth < 1:
        return draw.choice((
            lambda: draw.choice(VECTORS),
            lambda: draw.choice(VECTORS),
            lambda: ("at", "r", draw.choice(("i", "j", 1, 11))),
            lambda: ("at", "d", draw.randint(1, 12)),
            lambda: ("call", ("at", "r", draw.choice(("i", 1))), "t"),
            lambda: ("call", "Ω", "X"),
        ))()  # fmt: skip
    d = depth - 1
    return draw.choice((
        lambda: add(*(signed(draw, vector(draw, d)) for _ in range(2))),
        lambda: mul(scalar(draw, d), vector(draw, d)),
        lambda: mul(matrix(draw, d), vector(draw, d)),
        lambda: ("wedge", vector(draw, d), vector(draw, d)),
        lambda: ("div", vector(draw, d), scalar(draw, d)),
        lambda: ("sum", "i", ("wedge", ("at", "r", "i"), vector(draw, d))),
        lambda: ("sum", "i", mul(("at", "m", "i"), vector(draw, d))),
        lambda: ("matrix", *(("row", scalar(draw, d)) for _ in range(3))),
        lambda: ("call", "δ", ("at", "r", "i")),
    ))()  # fmt: skip


def matrix(draw, depth):
    """A square one."""
    if depth < 1:
        return draw.choice((
            lambda: draw.choice(MATRICES),
            lambda: draw.choice(MATRICES),
            lambda: ("T", draw.choice(MATRICES)),
            lambda: ("one",),
            lambda: ("at", "E", draw.choice(("a", "b", 2))),
            lambda: ("T", ("at", "E", draw.choice(("a", 3)))),
            lambda: ("inv", draw.choice(MATRICES)),
        ))()  # fmt: skip
    d = depth - 1
    return draw.choice((
        lambda: add(*(signed(draw, matrix(draw, d)) for _ in range(2))),
        lambda: mul(*(matrix(draw, d) for _ in range(draw.randint(2, 3)))),
        lambda: mul(scalar(draw, d), matrix(draw, d)),
        lambda: mul(vector(draw, d), ("T", vector(draw, d))),
        lambda: ("T", matrix(draw, d)),
        lambda: ("inv", matrix(draw, d)),
        lambda: ("pow", matrix(draw, d), 2),
        lambda: ("bracket", matrix(draw, d), matrix(draw, d)),
        lambda: ("hat", vector(draw, d)),
        lambda: ("sum", "a", mul(("entry", "ζ", "a"), ("at", "E", "a"))),
        lambda: ("matrix", *(("row", *(scalar(draw, d) for _ in "xy")) for _ in "xy")),
        lambda: ("matrix", ("row", scalar(draw, d), scalar(draw, d))),
    ))()  # fmt: skip


def tree(draw, depth=3):
    """Any of them."""
    return draw.choice((scalar, scalar, vector, matrix))(draw, depth)
