"""Zeitlin's equations as plain sums, and Euler's equation of the vorticity by Fourier's method."""

import numpy as np


def half_plane(N):
    """The points of the state of an emitted file, in order."""
    h = N // 2
    return [(a, 0) for a in range(1, h + 1)] + [
        (a, b) for b in range(1, h + 1) for a in range(-h, h + 1)
    ]


def coefficients(N, x):
    """omega(n) on the lattice modulo N, of a state."""
    grid = np.zeros((N, N), complex)
    for j, (a, b) in enumerate(half_plane(N)):
        grid[a, b] = x[2 * j] + 1j * x[2 * j + 1]
        grid[-a, -b] = np.conj(grid[a, b])
    return grid


def rates(N, x):
    """dx/dt, by a double sum over the lattice."""
    h, omega = N // 2, coefficients(N, x)
    m = np.array([(a, b) for a in range(-h, h + 1) for b in range(-h, h + 1) if (a, b) != (0, 0)])
    weights = omega[m[:, 0], m[:, 1]] / (m**2).sum(axis=1)
    found = []
    for a, b in half_plane(N):
        sines = np.sin(2 * np.pi * (m[:, 0] * b - m[:, 1] * a) / N)
        others = omega[(a - m[:, 0]) % N, (b - m[:, 1]) % N]
        found.append(-N / (2 * np.pi) * np.sum(sines * weights * others))
    return np.array([y for z in found for y in (z.real, z.imag)])


def energy(N, x):
    """½ Σ |omega(n)|²/|n|²."""
    h, omega = N // 2, coefficients(N, x)
    span = [(a, b) for a in range(-h, h + 1) for b in range(-h, h + 1) if (a, b) != (0, 0)]
    return sum(abs(omega[n]) ** 2 / (2 * (n[0] ** 2 + n[1] ** 2)) for n in span)


def traces(N, x):
    """Tr W^k/N for k = 2, 3, 4, W = Σ omega(n) T_n made of powers of the clock and of the shift."""
    h, omega = N // 2, coefficients(N, x)
    root = np.exp(2j * np.pi / N)
    clock, shift = np.diag(root ** (2 * np.arange(N))), np.roll(np.eye(N), 1, axis=1)
    power = np.linalg.matrix_power
    W = sum(
        omega[a, b] * root ** (a * b) * power(clock, a % N) @ power(shift, b % N)
        for a in range(-h, h + 1)
        for b in range(-h, h + 1)
    )
    return np.array([np.trace(power(W, k)).real / N for k in (2, 3, 4)])
