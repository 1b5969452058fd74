"""Gauss's principle for points in any potential U(t, A, T) of the matrix that moves them.

Among all dZ/dt in the algebra the true one makes ``sum m_i |a_i|^2 / 2 + dU(G dZ/dt)`` least, with
``a_i = G (dZ/dt + Z^2) r_i``; dU by complex steps.  ``basis`` is (d, s, s), a state G (A row-major,
then T where s = n + 1) and zeta.
"""

import numpy as np
from scipy.linalg import expm

STEP = 1e-30


def split(x, n, basis):
    """G (s, s), A (n, n), T (n,) and Z (s, s) of a state; A and T complex where the state is."""
    s = basis.shape[1]
    A = x[: n * n].reshape(n, n)
    T = x[n * n : n * s] if s > n else np.zeros(n)
    G = np.eye(s, dtype=x.dtype)
    G[:n, :n] = A
    G[:n, n:] = T[:, None][:, : s - n]
    return G, A, T, np.tensordot(x[n * s :], basis, 1)


def joined(G, n, last):
    """The state, or its derivative, of a matrix and what follows."""
    A, T = G[:n, :n], G[:n, n:]
    return np.concatenate([A.ravel(), T.ravel(), last])


def rhs(t, x, n, basis, masses, points, U):
    """dx/dt; ``points`` (N, n), ``U(t, A, T)`` a number, complex where A and T are."""
    G, _, _, Z = split(x, n, basis)
    r = np.hstack([points, np.ones((len(points), basis.shape[1] - n))])
    frames = np.array([(r @ (G @ E).T)[:, :n].ravel() for E in basis])
    weights = np.repeat(masses, n)
    slopes = []
    for E in basis:
        H = G + 1j * STEP * (G @ E)
        moved = H[:n, n] if H.shape[0] > n else np.zeros(n)
        slopes.append(np.imag(U(t, H[:n, :n], moved)) / STEP)
    bent = (r @ (G @ Z @ Z).T)[:, :n].ravel()
    mass = (frames * weights) @ frames.T
    rates = np.linalg.solve(mass, -np.array(slopes) - (frames * weights) @ bent)
    return joined(G @ Z, n, rates)


def energy(t, x, n, basis, masses, points, U):
    """Kinetic energy and U."""
    G, A, T, Z = split(x, n, basis)
    r = np.hstack([points, np.ones((len(points), basis.shape[1] - n))])
    v = (r @ (G @ Z).T)[:, :n]
    return masses @ np.sum(v * v, axis=1) / 2 + U(t, A, T)


def state(n, basis, rng):
    """A random element of the group, a product of exponentials, and a random zeta."""
    G = np.eye(basis.shape[1])
    for E in basis:
        G = G @ expm(rng.normal() / 2 * E)
    return joined(G, n, rng.normal(size=len(basis)))
