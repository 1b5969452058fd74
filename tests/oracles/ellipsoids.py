"""Gravity of homogeneous ellipsoids by plain sums, and the published figures of equilibrium.

The figures: S. Chandrasekhar, Ellipsoidal Figures of Equilibrium (1969), chapters 5 to 7.
"""

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq


def directions(count=48):
    """Directions (N, 3) and weights (N,), of sum 1, exact for polynomials of a high degree."""
    z, weights = np.polynomial.legendre.leggauss(count)
    around = np.pi * np.arange(2 * count) / count
    across = np.sqrt(1 - z**2)[:, None]
    n = np.stack([across * np.cos(around), across * np.sin(around), z[:, None] + 0 * around], -1)
    return n.reshape(-1, 3), np.repeat(weights / (4 * count), 2 * count)


N, WEIGHTS = directions()


U = np.exp(np.arange(-45, 95, 0.4))


def energy(S, mass, G):
    """-(3/10) G m^2 of the integral of det(S + u)^(-1/2) over u > 0, by the trapezoidal rule in log
    u; the ellipsoid is {<x, S^-1 x> <= 1}.  Analytic in S."""
    shifted = S + U[:, None, None] * np.eye(3)
    return -0.3 * G * mass**2 * 0.4 * (U / np.sqrt(np.linalg.det(shifted))).sum()


def energy_by_rays(axes, mass, G):
    """U from Newton's law: half the integral of the potential, and that along rays."""
    axes = np.asarray(axes)
    density = mass / (4 / 3 * np.pi * np.prod(axes))
    s, w = np.polynomial.legendre.leggauss(6)
    n, weights = directions(6)
    radius, w = (s + 1) / 2, w / 2
    total = 0
    inverse = np.sum(N**2 / axes**2, axis=1)
    for r, wr in zip(radius, w, strict=True):
        for x, wx in zip(axes * (r * n), weights, strict=True):
            b = N @ (x / axes**2)
            far = (-b + np.sqrt(b**2 + inverse * (1 - np.sum(x**2 / axes**2)))) / inverse
            inside = -G * density * 4 * np.pi * (WEIGHTS * far**2 / 2).sum()
            total += 4 * np.pi * r**2 * wr * wx * inside
    return density * np.prod(axes) * total / 2


def attractions(axes):
    """A_i of Chandrasekhar: the gravity at x is -2 pi G rho A_i x_i."""
    a = np.asarray(axes, float)

    def one(i):
        # u = a_1^2 (1/s^2 - 1), which makes the integrand smooth on [0, 1]
        big = a.max() ** 2

        def integrand(s):
            u = big * (1 / s**2 - 1)
            return 2 * big / s**3 / ((a[i] ** 2 + u) * np.sqrt(np.prod(a**2 + u)))

        return np.prod(a) * quad(integrand, 0, 1, epsabs=1e-14, epsrel=1e-13, limit=400)[0]

    return np.array([one(i) for i in range(3)])


def maclaurin(e):
    """Omega^2/(pi G rho) of the spheroid of eccentricity e."""
    root = np.sqrt(1 - e**2)
    return 2 * root / e**3 * (3 - 2 * e**2) * np.arcsin(e) - 6 * (1 - e**2) / e**2


def jacobi(ratio):
    """The axes (1, ratio, c) of Jacobi's ellipsoid, and its Omega^2/(pi G rho)."""

    def unbalanced(c):
        a = np.array([1, ratio, c])
        A = attractions(a)
        mixed = -(A[0] - A[1]) / (a[0] ** 2 - a[1] ** 2)
        return a[0] ** 2 * a[1] ** 2 * mixed - a[2] ** 2 * A[2]

    c = brentq(unbalanced, 0.05, 0.99 * ratio, xtol=1e-15, rtol=1e-14)
    A = attractions((1, ratio, c))
    return np.array([1, ratio, c]), 2 * (A[0] - A[2] * c**2)
