"""Lagrangians without kinetic energy along their symmetries: motions on a quotient of the group."""

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive.check.checker import check
from derive.problem.toml import problem_of
from derive.record.as_json import from_json, to_json
from tests.support.corpus import LAGRANGIANS
from tests.support.library import module_of
from tests.support.walks import SEED, record

TURN = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
DIRECT = {"rtol": 1e-12, "atol": 1e-12, "method": "DOP853"}


def run(found, x, end):
    k = found.constants(found.DEFAULTS)
    return solve_ivp(found.rhs, (0, end), x, args=(k,), **DIRECT).y[:, -1]


def test_the_pendulum_is_a_point_on_a_sphere():
    """ë = (g/l)(γ − ⟨γ, e⟩e) − |ė|²e in R³, γ downwards, has no group."""
    found = module_of("spherical_pendulum")
    assert found.STATE[9:] == ("zeta_1", "zeta_2")
    zeta = np.array([1.3, -0.7])
    end = run(found, np.array([*TURN.reshape(-1), *zeta]), 3.0)
    pull, rate = np.array([0, 0, -9.81 / 0.8]), TURN @ np.array([zeta[1], -zeta[0], 0])

    def on_sphere(t, y):
        e, v = y[:3], y[3:]
        return np.array([*v, *(pull - (pull @ e) * e - (v @ v) * e)])

    wanted = solve_ivp(on_sphere, (0, 3.0), np.array([*TURN[:, 2], *rate]), **DIRECT).y[:3, -1]
    assert np.abs(end[[2, 5, 8]] - wanted).max() < 1e-9


def test_the_quaternion_moves_as_the_matrix():
    found = module_of("spherical_pendulum", attitude="quaternion")
    q = np.array([0.5, -0.5, 0.1, 0.7])
    q /= np.linalg.norm(q)
    s, x, y, z = q
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    A = np.eye(3) + 2 * s * skew + 2 * skew @ skew
    end = run(found, np.array([*q, 0.4, -1.1]), 2.0)
    whole = run(module_of("spherical_pendulum"), np.array([*A.reshape(-1), 0.4, -1.1]), 2.0)
    s, x, y, z = end[:4]
    assert np.allclose([2 * (x * z + s * y), 2 * (y * z - s * x)], whole[[2, 5]], atol=1e-9)
    assert np.allclose(end[4:], whole[9:], atol=1e-9)


def test_the_rod_turns_and_falls():
    """Its axis goes round a great circle at a constant rate, its middle along a parabola."""
    found, zeta = module_of("rod"), np.array([0.9, -0.4])
    start = np.array([*TURN.reshape(-1), 1, 2, 3, *zeta, 0.3, 0.1, -0.5])
    end, t = run(found, start, 1.4), 1.4
    speed = np.linalg.norm(zeta)
    across = TURN @ np.array([zeta[1], -zeta[0], 0]) / speed
    axis = np.cos(speed * t) * TURN[:, 2] + np.sin(speed * t) * across
    assert np.abs(end[[2, 5, 8]] - axis).max() < 1e-9
    fallen = np.array([1, 2, 3]) + t * TURN @ np.array([0.3, 0.1, -0.5])
    assert np.abs(end[9:12] - fallen - np.array([0, 0, -9.81 * t**2 / 2])).max() < 1e-9


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_direction_that_is_no_element_of_the_basis(side):
    """Of a pendulum about another axis, (1, 0, 1)."""
    p = LAGRANGIANS[f"slanted {side}"]()
    assert p.lagrangian.held == (3,)
    found, half = module_of(p), np.sqrt(0.5)
    R = np.array([[half, 0, half], [0, 1, 0], [-half, 0, half]])  # takes e_3 to the axis
    zeta = np.array([0.5, 0.8])
    g = TURN if side == "left" else TURN.T
    end = run(found, np.array([*g.reshape(-1), *zeta]), 1.7)
    turned = end[:9].reshape(3, 3) if side == "left" else end[:9].reshape(3, 3).T
    straight = problem_of(
        {
            "name": "straight",
            "group": "SO(3)",
            "parameters": {"w": float(np.sqrt(2))},
            "lagrangian": {"L": "3*(zeta_1^2 + zeta_2^2)/2 - w*A_33"},
        }
    )
    sign = 1 if side == "left" else -1
    body = R.T @ np.array([sign * zeta[0], sign * zeta[1], 0])
    start = np.array([*(TURN @ R).reshape(-1), *body[:2]])
    wanted = run(module_of(straight), start, 1.7)[:9].reshape(3, 3)
    assert np.abs(turned @ R[:, 2] - wanted[:, 2]).max() < 1e-9


def test_what_is_held_must_be_null():
    """Forged: a coordinate is held that has kinetic energy, or that moves something."""
    data = json.loads(to_json(record("gyrostat")))
    data["problem"]["lagrangian"]["held"] = [3]
    refused = [v.label for v in check(from_json(json.dumps(data)), SEED) if not v.holds]
    assert {"gyrostat.mass", "gyrostat.motion"} <= {*refused}
    data = json.loads(to_json(record("spherical_pendulum")))
    data["problem"]["lagrangian"]["held"] = [2]
    refused = [v.label for v in check(from_json(json.dumps(data)), SEED) if not v.holds]
    assert "spherical_pendulum.mass" in refused
