"""Gauss's principle of least constraint, over the Lie algebra.

The points move with accelerations ``a_i = G (dZ/dt + Z^2) r_i``.  Among all dZ/dt in the algebra
the true one makes ``sum m_i |a_i - F_i / m_i|^2 - 2 <u, dzeta/dt>`` least, ``u`` being a covector
on the algebra.
"""

import numpy as np

from tests.oracles import sampling


def design(name, G, points, basis):
    """The accelerations, (N * 3, d), that unit coordinates of dZ/dt give to the points."""
    columns = np.einsum("jk,akl,il->ija", G, basis, sampling.homogeneous(name, points))
    return columns[:, :3].reshape(-1, len(basis))


def convective(name, G, Z, points):
    """The accelerations ``G Z^2 r_i``, (N * 3,), that remain when dZ/dt = 0."""
    return (sampling.homogeneous(name, points) @ (G @ Z @ Z).T)[:, :3].ravel()


def rhs(name, x, body, u=None, basis=None):
    """dx/dt in the state ``x``, with the covector ``u`` (d,) added to the forces of the body.

    The least squares problem is solved by its QR factors: ``R zd = Q^T y + R^-T u``.
    Raises numpy.linalg.LinAlgError where it has no unique solution.
    """
    basis = sampling.basis(name) if basis is None else basis
    G, Z = sampling.split(name, x)
    q, _ = sampling.motion(name, x, body)
    root = np.sqrt(np.repeat(body.masses, 3))
    Q, R = np.linalg.qr(root[:, None] * design(name, G, body.points, basis))
    target = body.forces(q).ravel() / root - root * convective(name, G, Z, body.points)
    covector = np.zeros(len(basis)) if u is None else np.asarray(u, float)
    coordinates = np.linalg.solve(R, Q.T @ target + np.linalg.solve(R.T, covector))
    return sampling.join(name, G @ Z, coordinates)
