"""Geodesics of SL(n) in R^(n x n) that are known explicitly: |dA/dt|^2 = Tr dA/dt dA/dt^T is kept.

The submanifold det A = 1 has the normal A^-T there, so that a geodesic is ``A'' = l A^-T``; as
Tr A^-1 A' = 0 gives Tr A^-1 A'' = Tr Z^2 for Z = A^-1 A', the multiplier is

    l = Tr Z^2 / Tr (A^T A)^-1.

A -> U A V with rotations U, V keeps the metric.  These are the affine motions of an incompressible
fluid: Sideris, Arch. Rational Mech. Anal. 225 (2017) 141; n = 2: Roberts, Shkoller, Sideris,
Comm. Math. Phys. 375 (2020) 1003; all n: Rosevear, Sottile, Wong, La Matematica 1 (2022).

* ``line``: A (1 + t N), N nilpotent.  det = 1 for all t and A'' = 0: a straight line, l = 0.
* ``plane`` (n = 2): on complex numbers let A x = z x + w x~; det A = |z|^2 - |w|^2 = 1 and
  |A'|^2 = 2 (|z'|^2 + |w'|^2).  With y = |z|^2, z = sqrt(y) e^(i f), w = sqrt(y - 1) e^(i g):
  y f' = P and (y - 1) g' = Q are constant, |z'|^2 + |w'|^2 = h also, which makes
  y'^2 (2 y - 1) = 4 h (y - y_0) (y - y_1), where y_0 >= 1 and y_1 are the roots of
  h y^2 - (h + P^2 + Q^2) y + P^2.  With y = y_0 + s^2: s'^2 = h (y - y_1) / (2 y - 1).
* ``stretch`` (n = 2): P = Q = 0 there, A = diag(e^s, e^-s): h t^2 = (integral of sqrt(cosh 2s))^2,
  which is Legendre's E: sqrt(h) t = -i E(i s | 2).
* ``swirl`` (n = 3): A = diag(a R(f), a^-2), R a rotation of the plane: a^2 f' = P and
  a'^2 (2 + 4 a^-6) + 2 P^2 / a^2 = h.  With a^2 = 2 P^2 / h + s^2: s'^2 = h / (2 + 4 a^-6).
* ``strain`` (n = 3): diag(e^2s, e^-s, e^-s): s'^2 (4 e^4s + 2 e^-2s) = h.

All but the first are given at a parameter s, the time being an integral over it.
"""

import numpy as np
from mpmath import mp

DIGITS = 25


def line(t, A, N):
    """A (1 + t N) and its velocity."""
    return A @ (np.eye(len(A)) + t * N), A @ N


def _integral(function, end):
    """The integral of a smooth function from 0 to ``end``."""
    with mp.workdps(DIGITS):
        return float(mp.quad(function, mp.linspace(0, end, 5)))


def plane(s, h, P, Q):
    """The time, A and A' of a geodesic of SL(2) where y = y_0 + s^2; z and w are real at s = 0.

    Q = 0 is allowed where P^2 < h: then y_0 = 1, and w = s.
    """
    sum_, root = h + P**2 + Q**2, np.sqrt((h - P**2 + Q**2) ** 2 + 4 * P**2 * Q**2)
    high = (sum_ + root) / (2 * h)
    low = P**2 / (h * high)

    def rate(x):
        """ds/dt."""
        return mp.sqrt(h * (high - low + x * x) / (2 * high - 1 + 2 * x * x))

    def real(x):
        """|w|, with a sign where it goes through zero."""
        return mp.sqrt(high - 1 + x * x) if Q else x

    time = _integral(lambda x: 1 / rate(x), s)
    f = _integral(lambda x: P / (high + x * x) / rate(x), s)
    g = _integral(lambda x: Q / (high - 1 + x * x) / rate(x), s) if Q else 0.0
    speed, a, b = float(rate(s)), np.sqrt(high + s * s), float(real(s))
    z, w = a * np.exp(1j * f), b * np.exp(1j * g)
    dz = (speed * s / a + 1j * P / a) * np.exp(1j * f)
    dw = ((speed * s / b + 1j * Q / b) if Q else speed) * np.exp(1j * g)
    return time, _real(z, w), _real(dz, dw)


def _real(z, w):
    """The matrix (2, 2) of x -> z x + w x~ on x = (Re x, Im x)."""
    return np.array([[z.real + w.real, w.imag - z.imag], [w.imag + z.imag, z.real - w.real]])


def stretch(s, h):
    """The time, A and A' of diag(e^s, e^-s)."""
    with mp.workdps(DIGITS):
        time = float((-1j * mp.ellipe(1j * mp.mpf(s), 2) / mp.sqrt(h)).real)
    A = np.diag([np.exp(s), np.exp(-s)])
    return time, A, A @ np.diag([1.0, -1.0]) * np.sqrt(h / np.cosh(2 * s))


def swirl(s, h, P):
    """The time, A and A' of diag(a R(f), a^-2), where a^2 = 2 P^2 / h + s^2."""
    least = 2 * P**2 / h

    def slowness(x):
        """dt/ds."""
        return mp.sqrt((2 + 4 / (least + x * x) ** 3) / h)

    time = _integral(slowness, s)
    f = _integral(lambda x: P / (least + x * x) * slowness(x), s)
    a = np.sqrt(least + s * s)
    speed = s / a / float(slowness(s))
    R, J = np.array([[np.cos(f), -np.sin(f)], [np.sin(f), np.cos(f)]]), np.array([[0, -1], [1, 0]])
    A, V = np.zeros((3, 3)), np.zeros((3, 3))
    A[:2, :2], A[2, 2] = a * R, a**-2
    V[:2, :2], V[2, 2] = R @ (speed * np.eye(2) + P / a * J), -2 * speed / a**3
    return time, A, V


def strain(s, h):
    """The time, A and A' of diag(e^2s, e^-s, e^-s)."""
    time = _integral(lambda x: mp.sqrt((4 * mp.exp(4 * x) + 2 * mp.exp(-2 * x)) / h), s)
    speed = np.sqrt(h / (4 * np.exp(4 * s) + 2 * np.exp(-2 * s)))
    A = np.diag(np.exp([2 * s, -s, -s]))
    return time, A, A @ np.diag([2.0, -1.0, -1.0]) * speed
