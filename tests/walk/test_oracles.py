"""The oracles against each other and against laws that a page of mechanics proves."""

import numpy as np
import pytest

from tests.oracles import gauss, multipliers, relative_error, sampling

NAMES = ("so3", "se3", "sl3")
SAMPLES = 200


def cases(name, seed, count=SAMPLES):
    """Yield ``count`` random bodies, states and inputs of the problem ``name``."""
    rng = np.random.default_rng([seed, NAMES.index(name)])
    for _ in range(count):
        body, x = sampling.random_body(name, rng), sampling.random_state(name, rng)
        yield body, x, rng.normal(size=sampling.DIMENSION[name])


def point_accelerations(name, x, dx, body):
    """Accelerations (N, 3) of the points, from a state and its velocity."""
    (G, Z), change = sampling.split(name, x), dx[-sampling.DIMENSION[name] :]
    second = G @ (sampling.algebra(name, change) + Z @ Z)
    return (sampling.homogeneous(name, body.points) @ second.T)[:, :3]


@pytest.mark.parametrize("name", NAMES)
def test_gauss_and_multipliers_agree(name):
    d = sampling.DIMENSION[name]
    for body, x, u in cases(name, 1):
        one, (other, unexplained) = gauss.rhs(name, x, body, u), multipliers.solve(name, x, body, u)
        a = point_accelerations(name, x, one, body)
        assert relative_error(one[-d:], other[-d:]) < 1e-12
        assert relative_error(one[:-d], other[:-d]) < 1e-14
        assert unexplained < 1e-12 * np.max(np.abs(a))


@pytest.mark.parametrize("name", NAMES)
def test_power_of_the_forces(name):
    """The work of m a - F in the actual motion is the power <u, zeta> of the input."""
    d = sampling.DIMENSION[name]
    for body, x, u in cases(name, 2, 50):
        q, v = sampling.motion(name, x, body)
        a = point_accelerations(name, x, gauss.rhs(name, x, body, u), body)
        works = (body.masses[:, None] * a - body.forces(q)) * v
        assert abs(works.sum() - u @ x[-d:]) < 1e-12 * np.abs(works).sum()


@pytest.mark.parametrize("name", NAMES)
def test_forces_are_the_gradient_of_the_energy(name):
    """U is at most quadratic, so a central difference is exact but for rounding."""
    for body, x, _ in cases(name, 3, 10):
        q, v = sampling.motion(name, x, body)
        found = np.zeros_like(q)
        for index in np.ndindex(*q.shape):
            step = np.zeros_like(q)
            step[index] = 0.5
            found[index] = body.energy(q - step, v) - body.energy(q + step, v)
        assert relative_error(found, body.forces(q)) < 1e-12


def test_so3_is_eulers_equation():
    """I dzeta/dt + zeta x I zeta = c x A^T g + u."""
    for body, x, u in cases("so3", 4, 50):
        A, zeta, tensor = x[:9].reshape(3, 3), x[9:], sampling.inertia(body)
        _, c, _ = sampling.moments(body)
        torque = np.cross(c, A.T @ body.gravity) + u - np.cross(zeta, tensor @ zeta)
        assert (
            relative_error(gauss.rhs("so3", x, body, u)[9:], np.linalg.solve(tensor, torque))
            < 1e-12
        )


def test_se3_moves_the_centre_of_mass_by_newtons_law():
    """m times the acceleration of the centre of mass is m g + A f, f the last half of u."""
    for body, x, u in cases("se3", 5, 50):
        a = point_accelerations("se3", x, gauss.rhs("se3", x, body, u), body)
        force = body.masses.sum() * body.gravity + x[:9].reshape(3, 3) @ u[3:]
        assert relative_error(body.masses @ a, force) < 1e-12


def test_sl3_forces_of_constraint_are_a_pressure():
    """sum (m a - F) q^T is a multiple of 1: it works only where the volume changes."""
    for body, x, _ in cases("sl3", 6, 50):
        q, _v = sampling.motion("sl3", x, body)
        a = point_accelerations("sl3", x, gauss.rhs("sl3", x, body), body)
        pressure = (body.masses[:, None] * a - body.forces(q)).T @ q
        mean = np.trace(pressure) / 3
        assert np.max(np.abs(pressure - mean * np.eye(3))) < 1e-12 * abs(mean)


@pytest.mark.parametrize("name", NAMES)
def test_gauss_follows_its_basis(name):
    """Coordinates of dZ/dt in another basis describe the same dZ/dt."""
    rng = np.random.default_rng(7)
    d = sampling.DIMENSION[name]
    mix = np.eye(d) + 0.2 * rng.normal(size=(d, d))
    other = np.einsum("ab,bij->aij", mix, sampling.basis(name))
    for body, x, u in cases(name, 8, 20):
        usual = gauss.rhs(name, x, body, u)[-d:]
        mixed = gauss.rhs(name, x, body, mix @ u, basis=other)[-d:]
        assert relative_error(mixed @ mix, usual) < 1e-12


@pytest.mark.parametrize("name", NAMES)
def test_samples_are_group_elements_and_reproducible(name):
    rng, again = np.random.default_rng(9), np.random.default_rng(9)
    for _ in range(20):
        G = sampling.random_element(name, rng)
        np.testing.assert_array_equal(G, sampling.random_element(name, again))
        assert abs(np.linalg.det(G) - 1) < 1e-14
        if name != "sl3":
            assert np.max(np.abs(G[:3, :3].T @ G[:3, :3] - np.eye(3))) < 1e-14
        if name == "se3":
            np.testing.assert_array_equal(G[3], [0, 0, 0, 1])
