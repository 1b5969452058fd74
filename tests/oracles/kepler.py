"""Kepler's orbits, and masses on springs: motions of points that are known in closed form.

The orbit with the half axis a and the eccentricity e about a centre of strength mu, from the
pericentre on: E - e sin E = n t, n^2 a^3 = mu, q = a (cos E - e, sqrt(1 - e^2) sin E).
"""

import numpy as np


def anomaly(mean, e):
    """E with E - e sin E = ``mean``, by Newton's method from a bound above (or below) the root."""
    turn = 2 * np.pi * np.round(mean / (2 * np.pi))
    mean = mean - turn
    E = mean + e * np.sign(mean)
    for _ in range(50):
        E = E - (E - e * np.sin(E) - mean) / (1 - e * np.cos(E))
    return E + turn


def orbit(t, mu, a, e, axes=None):
    """Position and velocity (3,); ``axes`` (3, 2): to the pericentre, along the motion there."""
    axes = np.eye(3)[:, :2] if axes is None else axes
    n, b = np.sqrt(mu / a**3), a * np.sqrt(1 - e**2)
    E = anomaly(n * t, e)
    rate = n / (1 - e * np.cos(E))
    q, v = [a * (np.cos(E) - e), b * np.sin(E)], [-a * rate * np.sin(E), b * rate * np.cos(E)]
    return axes @ q, axes @ v


def pair_on_a_spring(t, masses, stiffness, q, v):
    """Positions and velocities (2, 3) at t of two masses tied by a spring of no length.

    The centre goes straight on and the difference d is d_0 cos wt + d_0' sin wt / w, with
    w^2 = k (1 / m_1 + 1 / m_2).
    """
    masses = np.asarray(masses, float)
    shares, w = masses / masses.sum(), np.sqrt(stiffness * np.sum(1 / masses))
    drift, d, speed = shares @ v, q[1] - q[0], v[1] - v[0]
    gap = d * np.cos(w * t) + speed * np.sin(w * t) / w
    change = speed * np.cos(w * t) - d * w * np.sin(w * t)
    sides = np.array([-shares[1], shares[0]])[:, None]
    return shares @ q + drift * t + sides * gap, drift + sides * change
