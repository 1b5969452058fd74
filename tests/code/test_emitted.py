"""The emitted C and Python of so3, se3 and sl3 beside two oracles (other programs for mechanics are
in tests/compare/right); bodies that are refused."""

import numpy as np
import pytest

from tests.oracles import general, multipliers, relative_error, sampling
from tests.support.library import arrange, library, module_of
from tests.support.needs import present

NAMES = ("so3", "se3", "sl3")
STATES = 200
by_name = pytest.mark.parametrize("name", NAMES)


def cases(name, seed, count):
    """Yield random bodies, their arranged parameters, states and inputs (zeros for sl3)."""
    rng, d = np.random.default_rng([seed, NAMES.index(name)]), sampling.DIMENSION[name]
    for _ in range(count):
        body, x = sampling.random_body(name, rng), sampling.random_state(name, rng)
        p = arrange(module_of(name), sampling.parameters(name, body))
        yield body, p, x, rng.normal(size=d) * (name != "sl3")


def by_gauss(name, x, body, u=None):
    """dx/dt by Gauss's principle."""
    return general.rhs(body.listed(name), sampling.basis(name), {}, 0.0, x, u)


def worst(name, found, expected):
    """The larger relative error of the velocities of the group element and of the coordinates."""
    d = sampling.DIMENSION[name]
    blocks = zip((found[:-d], found[-d:]), (expected[:-d], expected[-d:]), strict=True)
    return max(relative_error(*pair) for pair in blocks)


# ---------------------------------------------------------------- equations of motion


@by_name
def test_rates_and_energy_are_those_of_the_points(name):
    """By Gauss's principle and by multipliers; of Python, and of the C of every compiler."""
    module, basis = module_of(name), sampling.basis(name)
    builds = {"c": "cc", "c of clang": "clang", "c as c++": "g++"}
    known = [library(build, name) for build, program in builds.items() if present(program)]
    for c in known:
        assert c.sizes["ALGEBRA"] == len(module.BASIS)
    for body, p, x, u in cases(name, 2, STATES):
        k, own = module.constants(p), u[: len(module.INPUTS)]
        dx, energy = module.rhs(0.0, x, k, own), module.energy(0.0, x, k)
        assert worst(name, dx, by_gauss(name, x, body, u)) < 1e-12
        assert worst(name, dx, multipliers.rhs(name, x, body, u)) < 1e-12
        expected = general.energy(body.listed(name), basis, {}, 0.0, x)
        kinetic = general.energy(body.listed(name) | {"potential": []}, basis, {}, 0.0, x)
        assert abs(energy - expected) < 1e-12 * (2 * kinetic + abs(expected))
        for c in known:
            status, kc = c.constants(p)
            assert status == 0
            assert worst(name, c.rhs(0.0, x, kc, own), dx) < 1e-13
            assert relative_error(c.energy(0.0, x, kc), energy) < 1e-13


@by_name
def test_batches_are_the_states_one_by_one(name):
    """rhs and energy on states (5, 4, N), with one input for all and with one input for each."""
    module, rng = module_of(name), np.random.default_rng([6, NAMES.index(name)])
    _, p, _, _ = next(cases(name, 6, 1))
    k, size = module.constants(p), len(module.INPUTS)
    x = np.array([[sampling.random_state(name, rng) for _ in range(4)] for _ in range(5)])
    energy = module.energy(0.0, x, k)
    assert energy.shape == (5, 4)
    each = rng.normal(size=(5, 4, size))
    for u in (None, each[0, 0], each):
        found = module.rhs(0.0, x, k, u)
        assert found.shape == x.shape
        for at in np.ndindex(5, 4):
            own = each[at] if u is each else u
            assert worst(name, found[at], module.rhs(0.0, x[at], k, own)) < 1e-14
            assert relative_error(energy[at], module.energy(0.0, x[at], k)) < 1e-14


# ---------------------------------------------------------------- bodies without an inverse


LINES = {
    "axis": (1, 0, 0),
    "integers": (1, -2, 2),
    "irrational": (0.3, np.sqrt(2), -np.pi),
    "tilted": (1, 1e-4, 0),
}
LINE = np.outer([1.0, -2.0, 0.5, 3.0], [1, -2, 2])
FLAT = np.array([[1, 0, 0], [-1, 2, 0], [0, -1, 0], [2, 1, 0]])
AWAY = np.array([0.5, 1.5, -1.0])


def body_at(name, points):
    """A body with masses 1, 1.1, 1.2, ... at these points, with gravity or springs."""
    count = len(points)
    springs = 1.0 - np.eye(count) if name == "sl3" else np.zeros((count, count))
    gravity = np.zeros(3) if name == "sl3" else np.array([0.0, 0.0, -9.81])
    return sampling.Body(1 + 0.1 * np.arange(count), np.asarray(points, float), gravity, springs)


def parameters_at(name, points):
    return arrange(module_of(name), sampling.parameters(name, body_at(name, points)))


def refused(name, p):
    """Is there no such body, as Python says and C?"""
    status = library("c", name).constants(p)[0]
    if status:
        with pytest.raises(ValueError, match=name):
            module_of(name).constants(p)
    else:
        module_of(name).constants(p)
    return status != 0


def degenerate(name, direction):
    """Points that leave a motion of the algebra without inertia.

    so3: on a line through 0; se3: on any line; sl3: in a plane through 0.
    """
    direction = np.array(direction, float)
    if name == "sl3":
        flat = np.random.default_rng(1).integers(-4, 5, size=(4, 3))
        return flat - np.outer(flat @ direction, direction) / (direction @ direction)
    points = np.outer([1.0, -2.0, 0.5, 3.0], direction)
    return points + AWAY if name == "se3" else points


@pytest.mark.parametrize("direction", LINES.values(), ids=LINES.keys())
@by_name
def test_a_degenerate_body_is_refused(direction, name):
    assert refused(name, parameters_at(name, degenerate(name, direction)))


@by_name
def test_a_body_that_only_looks_degenerate_is_accepted(name):
    """so3: a line off the origin; se3: a plane; sl3: a plane off the origin."""
    points = {"so3": LINE + AWAY, "se3": FLAT, "sl3": FLAT + np.array([0, 0, 1])}[name]
    p, x = parameters_at(name, points), sampling.random_state(name, np.random.default_rng(2))
    assert not refused(name, p)
    dx = module_of(name).rhs(0.0, x, module_of(name).constants(p))
    assert worst(name, dx, by_gauss(name, x, body_at(name, points))) < 1e-12


@pytest.mark.parametrize("far", [30, 1000])
def test_far_from_its_origin_a_line_is_refused_and_a_plane_accepted(far):
    bodies = [parameters_at("se3", points + far * AWAY) for points in (LINE, FLAT)]
    assert [refused("se3", p) for p in bodies] == [True, False]


@pytest.mark.parametrize("name", ["so3", "se3"])
def test_a_thin_rod_along_an_axis_keeps_its_digits(name):
    """The smallest moment of inertia is 1e-6 of the largest: it is a sum, not a difference."""
    module, h = module_of(name), 1e-3
    points = [[h, 0, 1], [-h, 0, -1], [0, h, 0.5], [0, -h, -0.7]]
    k = module.constants(parameters_at(name, points))
    x, u = sampling.random_state(name, np.random.default_rng(4)), np.ones(len(module.INPUTS))
    expected = by_gauss(name, x, body_at(name, points), u)
    assert worst(name, module.rhs(0.0, x, k, u), expected) < 1e-12


@pytest.mark.parametrize("bad", [np.nan, np.inf])
@by_name
def test_c_and_python_refuse_a_parameter_that_is_not_finite(bad, name):
    _, p, _, _ = next(cases(name, 10, 1))
    for i in range(len(p)):
        spoilt = np.where(np.arange(len(p)) == i, bad, p)
        assert refused(name, spoilt), module_of(name).PARAMETERS[i]
