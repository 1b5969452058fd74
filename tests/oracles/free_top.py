"""The free asymmetric top in closed form: Jacobi's functions and one integral of Legendre.

Euler's equations ``I_i dW_i/dt = (I_j - I_k) W_j W_k`` in principal axes keep the energy E and the
length M of the momentum.  Landau and Lifshitz, Mechanics, section 37: with a and c the two ends of
the moments, c being the axis that the momentum goes round (I_c = I_3, the largest, where
M^2 > 2 E I_2, and I_1 otherwise), b the middle one and u = p t,

    W_a^2 = (2 E I_c - M^2) / (I_a (I_c - I_a)) cn^2 u
    W_b^2 = (2 E I_c - M^2) / (I_b (I_c - I_b)) sn^2 u
    W_c^2 = (M^2 - 2 E I_a) / (I_c (I_c - I_a)) dn^2 u
    p^2 = (I_c - I_b) (M^2 - 2 E I_a) / (I_a I_b I_c)
    m = k^2 = (I_b - I_a) (2 E I_c - M^2) / ((I_c - I_b) (M^2 - 2 E I_a))

The roots with W_a, W_c > 0 and dW_b/dt > 0 at first satisfy all three equations in both cases.

The attitude: in space the momentum stands on the third axis; the body axis e_c goes round it at

    rate = M (2 E - I_c W_c^2) / (M^2 - I_c^2 W_c^2) = M / I_c + M (1/I_a - 1/I_c) / (1 - n sn^2 u)
    n = -I_c (I_b - I_a) / (I_a (I_c - I_b))

whose integral is M t / I_c + M (1/I_a - 1/I_c) Pi(n; am u | m) / p (Whittaker, Analytical Dynamics,
section 69, has it by theta functions).  Where M^2 = 2 E I_2 (m = 1) all this is the separatrix.
"""

import numpy as np
from mpmath import mp, mpf

DIGITS = 30


def _constants(moments, energy, momentum):
    """The ends and middle (a, b, c) as places in ``moments``, then p, m, n and amplitudes."""
    L, E, M = [mpf(float(x)) for x in moments], mpf(float(energy)), mpf(float(momentum))
    a, b, c = (0, 1, 2) if 2 * E * L[1] <= M**2 else (2, 1, 0)
    low, high = 2 * E * L[c] - M**2, M**2 - 2 * E * L[a]
    p = mp.sqrt((L[c] - L[b]) * high / (L[a] * L[b] * L[c]))
    m = (L[b] - L[a]) * low / ((L[c] - L[b]) * high)
    n = -L[c] * (L[b] - L[a]) / (L[a] * (L[c] - L[b]))
    sizes = [0, 0, 0]
    for i, value, end in ((a, low, a), (b, low, b), (c, high, a)):
        sizes[i] = mp.sqrt(value / (L[i] * (L[c] - L[end])))
    return L, M, (a, b, c), p, m, n, sizes


def period(moments, energy, momentum):
    """The period 4 K / p of the angular velocity in the body."""
    with mp.workdps(DIGITS):
        _, _, _, p, m, _, _ = _constants(moments, energy, momentum)
        return float(4 * mp.ellipk(m) / p)


def amplitude(u, m):
    """sn, cn, dn at u, and am u, which grows by 2 pi when u does by 4 K."""
    sn, cn, dn = (mp.ellipfun(name, u, m=m) for name in ("sn", "cn", "dn"))
    turns = 0 if m == 1 else mp.nint(u / (4 * mp.ellipk(m)))
    return sn, cn, dn, mp.atan2(sn, cn) + 2 * mp.pi * turns


def _frame(first, second):
    """The columns of an orthonormal frame: ``first``, ``second`` made normal to it, and so on."""
    first = first / np.linalg.norm(first)
    second = second - first * (first @ second)
    second = second / np.linalg.norm(second)
    return np.column_stack([first, second, np.cross(first, second)])


def motion(t, moments, energy, momentum):
    """The attitude A (3, 3) and the angular velocity W (3,) in the body at the time ``t``.

    ``moments``: I_1 < I_2 < I_3.  At t = 0 sn vanishes, and e_c stands over the first axis.
    """
    with mp.workdps(DIGITS):
        L, M, (a, b, c), p, m, n, sizes = _constants(moments, energy, momentum)
        u = p * mpf(float(t))
        sn, cn, dn, am = amplitude(u, m)
        W = [0, 0, 0]
        W[a], W[b], W[c] = sizes[a] * cn, sizes[b] * sn, sizes[c] * dn
        angle = M * mpf(float(t)) / L[c] + M * (1 / L[a] - 1 / L[c]) * mp.ellippi(n, am, m) / p
        around = np.array([mp.cos(angle), mp.sin(angle), 0], float)
        W = np.array(W, float)
    body = _frame(np.asarray(moments) * W, np.eye(3)[c])
    return _frame(np.array([0.0, 0.0, 1.0]), around) @ body.T, W
