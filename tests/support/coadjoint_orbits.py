"""The energy of a heavy top along coadjoint orbits of SE(3), by matrices and finite differences."""

import numpy as np
from scipy.linalg import expm

from tests.oracles.sampling import cross_matrix


def match(a, b, tolerance):
    """Are two collections of numbers the same up to a tolerance?"""
    left = [*b]
    for x in a:
        near = min(left, key=lambda y: abs(x - y))
        if abs(x - near) > tolerance:
            return False
        left.remove(near)
    return not left


def orbit_signature(x, moments, weight):
    """The signs of second differences of the energy along the coadjoint orbit of SE(3)."""

    def moved(y):
        turn = expm(cross_matrix(y[:3]))
        gamma = turn @ x[3:]
        return turn @ x[:3] + np.cross(y[3:], gamma), gamma

    def energy(y):
        pi, gamma = moved(y)
        return sum(pi**2 / np.array(moments)) / 2 + gamma @ weight

    h = 1e-3
    hessian = np.zeros((6, 6))
    for i, e in enumerate(np.eye(6) * h):
        for j, f in enumerate(np.eye(6) * h):
            pairs = ((1, 1), (1, -1), (-1, 1), (-1, -1))
            hessian[i, j] = sum(s * t * energy(s * e + t * f) for s, t in pairs) / (4 * h * h)
    values = np.linalg.eigvalsh(hessian)
    return sum(values > 1e-4), sum(values < -1e-4)
