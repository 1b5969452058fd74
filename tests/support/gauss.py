"""Emitted code of a problem beside Gauss's principle, at random times, states and inputs."""

import numpy as np

from tests.oracles import general, relative_error


def cloud(n, rng, count=6):
    """Masses (count,) and places (count, n)."""
    return rng.uniform(0.5, 1.5, count), rng.normal(size=(count, n))


def moments(masses, r):
    """m, c_i and J_ij, as a body with symbolic moments names them."""
    n = r.shape[1]
    values = {"m": masses.sum()} | {f"c_{i + 1}": masses @ r[:, i] for i in range(n)}
    J = r.T @ (masses[:, None] * r)
    return values | {f"J_{i + 1}{j + 1}": J[i, j] for i in range(n) for j in range(i, n)}


def agrees(m, c, data, values, *, states=5, tolerance=1e-12, apart=None):
    """Python ``m`` and, where it is not None, C ``c`` against the oracle for ``data``.

    ``values``: of the parameters that have no default in ``data``; ``apart``: where T is to be.
    """
    rng, basis = np.random.default_rng(5), np.array(m.BASIS, float)
    own, d = general.parameters(data), len(m.BASIS)
    p = [{**own, **values}[x] for x in m.PARAMETERS]
    k = m.constants(p)
    status, in_c = (0, None) if c is None else c.constants(p)
    assert status == 0
    for _ in range(states):
        x = general.random_state(data, basis, rng)
        if apart is not None:
            x[-d - len(apart) : -d] += apart
        t, u = rng.normal(), rng.normal(size=len(m.INPUTS))
        found, energy = m.rhs(t, x, k, u), m.energy(t, x, k)
        total = general.energy(data, basis, own, t, x)
        assert relative_error(found, general.rhs(data, basis, own, t, x, u)) < tolerance
        assert abs(energy - total) < tolerance * max(1, abs(total))
        if c is not None:
            assert relative_error(c.rhs(t, x, in_c, u), found) < tolerance
            assert abs(c.energy(t, x, in_c) - energy) < tolerance * max(1, abs(total))
