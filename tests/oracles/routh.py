"""Effective potentials by other ways: Euler's angles in SymPy, and the least energy on a level.

Nothing of derive is used.  With velocities v, metric M, linear terms b and fields η_i the energy
½⟨v, Mv⟩ + U is the effective potential where it is least among the v with ⟨Mv + b, η_i⟩ = μ_i.
"""

from functools import cache

import numpy as np
import sympy


def lagrange_top(u, one, two, I1, I3, mgl, h):
    """(effective potential, u̇²) of a heavy symmetric top at u = cos θ, by Euler's angles: momenta
    of the precession and of the spin, and the energy."""
    metric, potential = _in_angles()
    M, U = metric(np.arccos(u), I1, I3), potential(np.arccos(u), mgl)
    turning, mixed = M[np.ix_([0, 2], [0, 2])], M[np.ix_([0, 2], [1])]
    mu = np.array([one, two])
    V = U + mu @ np.linalg.solve(turning, mu) / 2
    left = (M[1, 1] - mixed.T @ np.linalg.solve(turning, mixed)).item()
    return V, (1 - u**2) * 2 * (h - V) / left  # u̇² = sin²θ θ̇²


@cache
def _in_angles():
    """The metric of the angles φ, θ, ψ of A = R₃(φ)R₁(θ)R₃(ψ), and the potential."""
    angles = phi, theta, psi = sympy.symbols("phi theta psi")
    rates = sympy.symbols("dphi dtheta dpsi")
    I1, I3, mgl = sympy.symbols("I1 I3 mgl")

    def turn(axis, angle):
        c, s = sympy.cos(angle), sympy.sin(angle)
        about = {3: [[c, -s, 0], [s, c, 0], [0, 0, 1]], 1: [[1, 0, 0], [0, c, -s], [0, s, c]]}
        return sympy.Matrix(about[axis])

    A = turn(3, phi) * turn(1, theta) * turn(3, psi)
    rate = sum((A.diff(x) * v for x, v in zip(angles, rates, strict=True)), start=0 * A)
    spin = A.T * rate
    kinetic = (I1 * (spin[2, 1] ** 2 + spin[0, 2] ** 2) + I3 * spin[1, 0] ** 2) / 2
    metric = sympy.hessian(kinetic, rates).subs({phi: 0.3, psi: 0.7})
    return sympy.lambdify((theta, I1, I3), metric), sympy.lambdify((theta, mgl), mgl * A[2, 2])


def least_energy(M, b, U, fields, mu):
    """½⟨v, Mv⟩ + U at its least among the v with these momenta on the fields (rows)."""
    M, b, fields = (np.asarray(x, float) for x in (M, b, fields))
    k = len(fields)
    whole = np.block([[M, -(fields @ M).T], [fields @ M, np.zeros((k, k))]])
    right = np.concatenate([np.zeros(len(M)), np.asarray(mu) - fields @ b])
    v = np.linalg.lstsq(whole, right, rcond=None)[0][: len(M)]
    return v @ M @ v / 2 + U


def turned(g, Y):
    """The vector of g⁻¹Yg, g a rotation of R³."""
    m = g.T @ Y @ g
    return np.array([m[2, 1], m[0, 2], m[1, 0]])
