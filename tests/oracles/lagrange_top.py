"""The Lagrange top in closed form: nutation by sn, precession and spin by Legendre's Pi.

A symmetric body, moments I_1 = I_2 and I_3 about a fixed point, centre of mass on the third axis;
A = R_3(phi) R_1(theta) R_3(psi), z = cos theta, W_3 = dpsi/dt + z dphi/dt kept, and with

    a = I_3 W_3 / I_1,    b = (vertical momentum) / I_1,    beta = 2 weight / I_1

the potential being ``weight z``, Goldstein, Classical Mechanics, section 5.7, has

    dphi/dt = (b - a z) / (1 - z^2)
    (dz/dt)^2 = f(z) = (1 - z^2) (alpha - beta z) - (b - a z)^2 = beta (z - z_1) (z - z_2) (z - z_3)

with z_1 <= z <= z_2 < z_3, so that, m being (z_2 - z_1) / (z_3 - z_1) and q^2 = beta (z_3 - z_1)/4,

    z = z_1 + (z_2 - z_1) sn^2(q t + start | m)

and by partial fractions dphi/dt = (b - a) / 2 (1 - z) + (b + a) / 2 (1 + z) and
dpsi/dt = W_3 - a - (b - a) / 2 (1 - z) + (b + a) / 2 (1 + z), where
1 -+ z = (1 -+ z_1) (1 - n sn^2) for n = +-(z_2 - z_1) / (1 -+ z_1): each is an integral Pi(n; am).
"""

import numpy as np
from mpmath import mp, mpf

from tests.oracles.free_top import DIGITS, amplitude
from tests.oracles.sampling import turn


def _roots(z, rate, a, beta):
    """z_1 <= z_2 < z_3 of f, one of the first two being ``z``, and b."""
    b = rate * (1 - z**2) + a * z
    alpha = beta * z + (b - a * z) ** 2 / (1 - z**2)
    linear = beta * z - alpha - a**2
    constant = 2 * a * b - beta + z * linear
    root = mp.sqrt(linear**2 - 4 * beta * constant)
    return sorted([z, (-linear - root) / (2 * beta), (-linear + root) / (2 * beta)]), b


def _integrals(u, m, ns):
    """The integral of 1 / (1 - n sn^2) from 0 to u for every n."""
    am = amplitude(u, m)[3]
    return [mp.ellippi(n, am, m) for n in ns]


def motion(t, moments, weight, z, rate, spin):
    """The state A (9), W (3) at the time ``t`` of a top that was released where it turns back.

    ``moments``: (I_1, I_3); at t = 0 z = cos theta is ``z``, dz/dt = 0, phi = psi = 0, dphi/dt is
    ``rate``; W_3 is ``spin``.
    """
    first, third, weight, z, rate, spin, t = map(mpf, (*moments, weight, z, rate, spin, t))
    with mp.workdps(DIGITS):
        a, beta = third * spin / first, 2 * weight / first
        (low, high, far), b = _roots(z, rate, a, beta)
        m, q = (high - low) / (far - low), mp.sqrt(beta * (far - low)) / 2
        start = 0 if z == low else mp.ellipk(m)
        sn, cn, dn, _ = amplitude(q * t + start, m)
        now = low + (high - low) * sn**2
        ns = [(high - low) / (1 - low), -(high - low) / (1 + low)]
        ends = zip(_integrals(q * t + start, m, ns), _integrals(start, m, ns), strict=True)
        down, up = (later - sooner for later, sooner in ends)
        down, up = down * (b - a) / (2 * q * (1 - low)), up * (b + a) / (2 * q * (1 + low))
        phi, psi, theta = down + up, (spin - a) * t - down + up, mp.acos(now)
        fall = -2 * (high - low) * q * sn * cn * dn / mp.sin(theta)
        swing = (b - a * now) / mp.sin(theta)
        W = [swing * mp.sin(psi) + fall * mp.cos(psi), swing * mp.cos(psi) - fall * mp.sin(psi)]
        phi, psi = (angle - 2 * mp.pi * mp.nint(angle / (2 * mp.pi)) for angle in (phi, psi))
    A = turn([0, 0, 1], float(phi)) @ turn([1, 0, 0], float(theta)) @ turn([0, 0, 1], float(psi))
    return np.concatenate([A.ravel(), np.array([*W, spin], float)])
