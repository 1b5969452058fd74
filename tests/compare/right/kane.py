"""Right-hand sides by Kane's method of SymPy, of so3 and se3 in our own state."""

import numpy as np

from tests.oracles import sampling, sympy_mechanics

C, J = np.array([0, 0, 0.2]), np.array([[1.3, 0.1, 0.05], [0.1, 0.9, -0.07], [0.05, -0.07, 0.4]])
CENTRAL = J - np.outer(C, C)
TENSOR = np.trace(CENTRAL) * np.eye(3) - CENTRAL
BODY = sampling.solid_body(TENSOR, 1.0, C, (0, 0, -9.81))


def turning(x, w):
    return np.stack([np.cross(row, w) for row in x[:9].reshape(3, 3)]).ravel()


def free(t, x, k, u):
    w, v = x[12:15], x[15:]
    moved = x[:9].reshape(3, 3) @ v
    return np.concatenate([turning(x, w), moved, sympy_mechanics.kane("se3", x, BODY, u)])


def fixed(t, x, k, u):
    return np.concatenate([turning(x, x[9:]), sympy_mechanics.kane("so3", x, BODY, u)])
