"""Classical Runge-Kutta steps of emitted code: order four in state, energy and momenta.

And Exercise 2 in space: the centre of mass separates from the motion under SL(3).
"""

from functools import cache
from math import log2
from pathlib import Path

import numpy as np
import pytest

import derive
from tests.oracles import general, relative_error, sampling
from tests.support.emitted import arrange, import_python, rk4
from tests.support.flows import emitted, flow

GROUPS = {"so3": "SO(3)", "se3": "SE(3)", "sl3": "SL(3)", "saff3": "SAff(3)", "gl3": "GL(3)"}
GRAVITY = np.array([0.0, 0.0, -9.81])
STEPS = 300, 600


@cache
def case(name):
    """The module, its constants, the points' masses and places, and a state to start from."""
    rng = np.random.default_rng([1, len(name), ord(name[0])])
    if name in ("saff3", "gl3"):
        code = emitted(name)
        masses = np.ones(4) if name == "saff3" else np.array([1.0, 2.0, 3.0])
        places, k = np.eye(4)[: len(masses), :3], code.constants({})
    else:
        code, body = import_python(name), sampling.random_body(name, rng)
        body = sampling.Body(body.masses, body.points, GRAVITY, body.springs)
        masses, places = body.masses, body.points
        k = code.constants(arrange(code, sampling.parameters(name, body)))
    x = general.random_state({"group": GROUPS[name]}, code.BASIS, rng)
    if name == "gl3":
        x[9:] *= 0.2  # within the second det A stays away from 0, where A leaves the group
    return code, k, masses, places, x


def momenta(name, t, x):
    """What is kept: angular momentum, and where there is gravity and a centre of mass the rest.

    so3: about the vertical.  se3, saff3: about the centre of mass, and its momentum less m g t.
    """
    code, _, masses, places, _ = case(name)
    G, zeta = general.split({"group": GROUPS[name]}, x, len(code.BASIS))
    r = np.column_stack([places, np.ones(len(places))])[:, : len(G)]
    q, v = ((r @ M.T)[:, :3] for M in (G, G @ np.tensordot(zeta, code.BASIS, 1)))
    if name == "so3":
        return masses @ np.cross(q, v)[:, 2:]
    if name not in ("se3", "saff3"):
        return masses @ np.cross(q, v)
    centre, momentum = masses @ q / masses.sum(), masses @ v
    return np.concatenate([masses @ np.cross(q - centre, v), momentum - masses.sum() * GRAVITY * t])


@cache
def errors(name):
    """Largest errors of state, energy and momenta over one second, for each number of steps."""
    code, k, _, _, x = case(name)
    times = np.linspace(0, 1, 11)
    exact = flow(code, k, x, times)
    found = []
    for steps in STEPS:
        states = rk4(lambda t, y: code.rhs(t, y, k), x, 1.0, steps)
        energies = code.energy(0.0, states, k)
        kept = np.array([momenta(name, i / steps, y) for i, y in enumerate(states)])
        gaps = states[:: steps // 10] - exact, energies - energies[0], kept - kept[0]
        found.append([np.max(np.abs(gap)) for gap in gaps])
    return np.array(found)


@pytest.mark.parametrize("name", GROUPS)
def test_fourth_order(name):
    """Half the step, a sixteenth of the error: in the state, in the energy and in the momenta.

    Errors are largest along the motion: what grows at its end may be of the next order.
    """
    coarse, fine = errors(name)
    assert np.min(fine) > 1e-12  # rounding is far away
    for before, after in zip(coarse, fine, strict=True):
        assert abs(log2(before / after) - 4) < 0.2


@pytest.mark.parametrize("name", GROUPS)
def test_energy_and_momenta_are_kept(name):
    """To the accuracy of the integrator."""
    code, k, _, _, x = case(name)
    times = np.linspace(0, 1, 11)
    states = flow(code, k, x, times)
    energies = code.energy(0.0, states, k)
    kept = np.array([momenta(name, t, y) for t, y in zip(times, states, strict=True)])
    # 2e-14 is found
    assert np.max(np.abs(energies / energies[0] - 1)) < 2e-13
    assert np.max(np.abs(kept - kept[0])) < 2e-13 * np.max(np.abs(kept[0]))


# ---------------------------------------------------------------- Exercise 2 in space

READY = Path(derive.__file__).parent / "problems" / "saff3.toml"
CORNERS = np.vstack([np.eye(3), np.zeros(3)])


def in_space(centre):
    """saff3, its tetrahedron moved so that ``centre`` (3,) is its centre of mass."""
    text = READY.read_text(encoding="utf-8")
    for row in CORNERS:
        at = [*map(float, row - CORNERS.mean(axis=0) + centre)]
        text = text.replace(f"at = {[*map(int, row)]}", f"at = {at}")
    return emitted(text)


@pytest.mark.parametrize("where", [(0, 0, 0), (0.25, 0.25, 0.25), (-0.5, 2.0, 1.0)], ids=str)
def test_the_centre_of_mass_separates(where):
    """A moves as under SL(3) for the body about its centre of mass, which falls on a parabola."""
    s, linear = np.array(where), import_python("sl3")
    whole = in_space(s)
    m, stiffness, times = 0.7, 1.9, np.linspace(0, 4, 9)
    springs = np.diag([stiffness] * 3, 1) + np.diag([stiffness] * 3, -1)
    body = sampling.Body(np.full(4, m), CORNERS - CORNERS.mean(axis=0), np.zeros(3), springs)
    x = sampling.random_state("sl3", np.random.default_rng(6))
    A, Z = sampling.split("sl3", x)
    q, v = np.array([1.0, -2.0, 3.0]), np.array([0.3, 0.2, 5.0])
    w = np.linalg.solve(A, v) - Z @ s
    start = np.concatenate([x[:9], q - A @ s, x[9:], w])
    p = arrange(linear, sampling.parameters("sl3", body))
    expected = flow(linear, linear.constants(p), x, times)
    found = flow(whole, whole.constants({"m": m, "k": stiffness, "g": 9.81}), start, times)
    parts = np.split(found, [9, 12, 20], axis=1)
    A, Z = parts[0].reshape(-1, 3, 3), np.tensordot(parts[2], linear.BASIS, 1)
    centre = parts[1] + A @ s, np.einsum("tij,tj->ti", A, parts[3] + Z @ s)
    # 1e-13 is found for velocities, 4e-14 otherwise
    assert relative_error(parts[0], expected[:, :9]) < 1e-12
    assert relative_error(parts[2], expected[:, 9:]) < 1e-12
    t = times[:, None]
    assert relative_error(centre[0], q + t * v + t**2 / 2 * GRAVITY) < 1e-12
    assert relative_error(centre[1], v + t * GRAVITY) < 1e-12


def test_the_tetrahedron_is_that_of_the_ready_made_problem():
    code, same = emitted("saff3"), in_space(CORNERS.mean(axis=0))
    x = general.random_state({"group": "SAff(3)"}, code.BASIS, np.random.default_rng(8))
    dx = (each.rhs(0.0, x, each.constants({})) for each in (code, same))
    np.testing.assert_array_equal(*dx)
