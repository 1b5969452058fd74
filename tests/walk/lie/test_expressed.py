"""Lagrangians ℓ(t, g, Z): the emitted code beside Euler and Lagrange, who have no brackets."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from tests.oracles.euler_lagrange import acceleration
from tests.support.library import module_of
from tests.support.walks import problem


def gyrostat(t, g, z):
    return (
        (z[0] ** 2 + 1.6 * z[1] ** 2 + 2.2 * z[2] ** 2) / 2
        + 0.3 * z[0]
        + 0.8 * z[2]
        - 1.5 * g[2, 2]
    )


def kirchhoff(t, g, z):
    turn, move = z[:3], z[3:]
    own = turn @ (jnp.array([1.0, 1.5, 2.0]) * turn) + move @ (jnp.array([2.0, 2.6, 3.5]) * move)
    return own / 2 + 0.2 * z[0] * z[3] - 0.1 * z[2] * z[5]


def charged_body(t, g, z):
    field = 0.7 * g.T @ jnp.array([0.0, 0.0, 1.0])
    return (z @ (jnp.array([1.0, 1.4, 1.9]) * z) + field @ (jnp.array([0.5, 0.2, 0.6]) * z)) / 2


def coupled(t, g, z):
    own = z @ (jnp.array([1.0, 1.0, 0.6, 1.3, 1.3, 0.9]) * z) / 2
    return own + (g[:3, 2] @ g[3:, 5]) * (0.25 * z[2] * z[5] + 2.0)


def euler_top(t, g, z):
    return z @ (jnp.array([1.0, 1.6, 2.2]) * z) / 2


def lagrange_top(t, g, z):
    return z @ (jnp.array([1.0, 1.0, 0.4]) * z) / 2 - 1.5 * g[2, 2]


def kovalevskaya_top(t, g, z):
    return z @ (jnp.array([2.0, 2.0, 1.0]) * z) / 2 - 1.5 * g[2, 0]


def manakov(t, g, z):
    """(b_i − b_j)/(a_i − a_j) in the planes 34, 24, 23, 14, 13, 12."""
    moments = jnp.array([10 / 3, 15 / 5, 5 / 2, 17 / 6, 7 / 3, 2.0])
    return z @ (moments * z) / 2


READY_MADE = {x.__name__: x for x in (gyrostat, kirchhoff, charged_body, coupled)}
READY_MADE |= {x.__name__: x for x in (euler_top, lagrange_top, kovalevskaya_top, manakov)}


def states(group, basis, rng, several):
    """Random elements of a group, and coordinates of velocities."""
    for _ in range(several):
        g = np.array(group.sample(Integers(rng), 9), float)
        yield g, rng.normal(size=len(basis))


class Integers:
    def __init__(self, rng):
        self.rng = rng

    def randint(self, low, high):
        return int(self.rng.integers(low, high + 1))


def held(found, group, lagrangian, t, g, zeta, u=(), *, right=False):
    """What a module makes of one state, beside ℓ."""
    basis = np.array(found.BASIS, float)
    k = found.constants(found.DEFAULTS)
    place = [g[x] for x in places(group)]
    dx = found.rhs(t, np.array([*place, *zeta]), k, np.array(u) if len(u) else None)
    expected = acceleration(
        lagrangian, basis, t, g, zeta, np.array(u) if len(u) else 0.0, right=right
    )
    scale = max(1, np.abs(expected).max())
    assert np.abs(dx[len(place) :] - expected).max() < 1e-12 * scale
    Z = np.tensordot(zeta, basis, 1)
    moved = Z @ g if right else g @ Z
    assert np.abs(dx[: len(place)] - [moved[x] for x in places(group)]).max() < 1e-13 * scale
    with jax.enable_x64(True):
        point = t, jnp.asarray(g), jnp.asarray(zeta)
        energy = jax.grad(lagrangian, 2)(*point) @ point[2] - lagrangian(*point)
    assert found.energy(t, np.array([*place, *zeta]), k) == pytest.approx(float(energy), abs=1e-12)


def places(group):
    """The entries of g that the state has, factor after factor."""
    for offset, factor in group.places:
        span = range(offset, offset + factor.n)
        yield from ((i, j) for i in span for j in span)
        if factor.affine:
            yield from ((i, offset + factor.n) for i in span)


@pytest.mark.parametrize("name", READY_MADE)
def test_ready_made(name):
    group, found = problem(name).group, module_of(name)
    rng = np.random.default_rng(1)
    for g, zeta in states(group, found.BASIS, rng, 2):
        held(found, group, READY_MADE[name], 0.0, g, zeta)
