"""Lagrangians without kinetic energy along their symmetries: motions on a quotient of the group,
their forces and outputs; entries of g that are one number in all of a group, and are numbers."""

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import derive
from derive.check.checker import check
from derive.problem.entries_on_orbit import element
from derive.problem.toml import problem_of
from derive.record.as_json import from_json, to_json
from tests.support.corpus import LAGRANGIANS
from tests.support.library import derived, module_of
from tests.support.walks import SEED, record

TURN = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
DIRECT = {"rtol": 1e-12, "atol": 1e-12, "method": "DOP853"}


def run(found, x, end):
    k = found.constants(found.DEFAULTS)
    return solve_ivp(found.rhs, (0, end), x, args=(k,), **DIRECT).y[:, -1]


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


def bob_on(side, **more):
    """A pendulum on a sphere."""
    L = {"L": "(zeta_1^2 + zeta_2^2)/2 - 9.81*A_33", "trivialisation": side}
    return problem_of({"name": "bob", "group": "SO(3)", "lagrangian": L, **more})


WIND = {"name": "F", "kind": "force", "at": [0, 0, 1]}
READ = [
    {"kind": kind, "name": kind[0], "at": [0, 0, 1], "frame": "space"}
    for kind in ("place", "velocity", "acceleration")
]
READ += [{"name": "s", "kind": "expression", "y": ["zeta_1^2 + zeta_2^2"]}]
PULL = np.array([0.4, -1.1, 0.7])


def bob(_, y):
    """q̈ of a point on the unit sphere with weight, friction and a wind."""
    q, v = y[:3], y[3:]
    force = PULL - [0, 0, 9.81] - 0.3 * v
    return np.r_[v, force - (force @ q + v @ v) * q]


def test_a_damped_bob_in_a_wind():
    friction = {"covector": ["-0.3*zeta_1", "-0.3*zeta_2", 0]}
    d = derived(bob_on("left", force=[friction], input=[WIND], output=READ))
    assert d.check()
    f = derive.compile(d, step="gauss")
    A, zeta = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0], [1.2, -0.7]
    A *= np.linalg.det(A)
    x = np.r_[A.flat, zeta]
    q, v = A[:, 2], A @ [zeta[1], -zeta[0], 0]
    known = bob(0, np.r_[q, v])
    assert np.allclose(f.outputs(0, x, PULL), [*q, *v, *known[3:], v @ v], atol=1e-13)
    found = solve_ivp(bob, (0, 2), np.r_[q, v], rtol=1e-12, atol=1e-12).y[:, -1]
    f.u = PULL
    end = f.begin(x).move_to(2.0, 1e-13).x
    assert np.allclose(f.outputs(2, end, PULL)[:6], found, atol=1e-9)


def test_a_force_of_the_quotient_on_the_right():
    friction = {"covector": ["-zeta_1*A_33", "-zeta_2*A_33", 0]}
    assert derived(bob_on("right", force=[friction])).check()


ENGEL = [
    [[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
    [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]],
    [[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0]],
    [[0, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
]
TURN_AND_GROW = [[[0, -1, 0], [1, 0, 0], [0, 0, 0]], [[0, 0, 0], [0, 0, 0], [0, 0, 2]]]
SCREW = [[[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 2], [0, 0, 0, 0]]]
GROUPS = {
    "Engel": ({"name": "Engel", "basis": ENGEL}, 4),
    "Turn": ({"name": "Turn", "basis": TURN_AND_GROW}, 2),
    "Screw": ({"name": "Screw", "basis": SCREW, "action": "affine"}, 1),
    "UT(3)": ("UT(3)", 3),
    "SE(2)": ("SE(2)", 3),
    "SL(2) x UT(3)": ("SL(2) x UT(3)", 6),
}


def stated(name, L="{}"):
    """The record of a Lagrangian with the square of the velocity in the place of {}."""
    group, d = GROUPS[name]
    square = "(" + " + ".join(f"zeta_{a}^2" for a in range(1, d + 1)) + ")/2"
    table = {"name": "test", "group": group, "lagrangian": {"L": L.format(square)}}
    return derive.derive(problem_of(table))


def drawn(group, count=8):
    """Elements of a group, (count, size, size)."""
    rng, basis = np.random.default_rng(1), np.array(group.basis, float)
    coordinates = rng.normal(size=(count, 2, len(basis)))
    factors = expm(np.tensordot(coordinates, basis, 1))
    return factors[:, 0] @ factors[:, 1]


@pytest.mark.parametrize("name", GROUPS)
def test_entries_are_numbers_where_they_never_vary(name):
    group = stated(name).problem.group
    g = drawn(group)
    still = np.ptp(g, axis=0) < 1e-9
    for i, row in enumerate(element(group)):
        for j, x in enumerate(row):
            assert isinstance(x, tuple) != still[i, j]
            assert isinstance(x, tuple) or abs(float(x) - g[0, i, j]) < 1e-9


def test_what_does_not_change_is_no_force():
    """Π_o is kept where L̃ has no entry of g that varies, and E_2 is a symmetry of A_23 on UT(3)."""
    d = stated("UT(3)", "{} - A_33 - 2*A_21^2")
    kept = next(s for s in d.record.steps if s.label == "test.conserved")
    assert "Π̇_o" in [e.lhs for e in kept.equations]
    still = {"name": "test", "group": "UT(3)"}
    still |= {"lagrangian": {"L": "(zeta_1^2 + zeta_3^2)/2 - A_23"}}
    assert problem_of(still).lagrangian.held == (2,)
    assert all(v.holds for v in derive.derive(problem_of(still)).check(seed=1))


TWICE = {"name": "Twice", "basis": [np.diag([1, 0, 1]).tolist(), np.diag([0, 1, 0]).tolist()]}
RELATED = {
    "the same factor twice": (TWICE, "zeta_2^2/2 + sin(A_33) - sin(A_11) - A_22", (1,)),
    "a turn": ("SE(2)", "(zeta_2^2 + zeta_3^2)/2 - (A_11 - A_22)", (1,)),
    "a column": ("SO(3)", "(zeta_2^2 + zeta_3^2)/2 - A_11^2 - A_21^2 - A_31^2", (1,)),
}


@pytest.mark.parametrize("name", RELATED)
def test_what_the_group_relates_is_no_force(name):
    """A symmetry where entries tell each other: A_33 = A_11, A_22 = A_11, or a column is a unit."""
    group, L, held = RELATED[name]
    d = derive.derive(problem_of({"name": "test", "group": group, "lagrangian": {"L": L}}))
    assert d.problem.lagrangian.held == held
    assert all(v.holds for v in d.check(seed=1))


def test_the_other_momentum_is_kept_by_what_the_group_relates():
    for group, L, kept in (
        ("SE(2)", "(zeta_1^2 + zeta_2^2 + 2*zeta_3^2)/2 - (A_11 - A_22)", True),
        ("SE(2)", "(zeta_1^2 + zeta_2^2 + 2*zeta_3^2)/2 - (A_11 + A_22)", False),
        ("SO(3)", "(zeta_1^2 + zeta_2^2 + 2*zeta_3^2)/2 - A_11^2 - A_21^2 - A_31^2", True),
    ):
        d = derive.derive(problem_of({"name": "test", "group": group, "lagrangian": {"L": L}}))
        step = next(s for s in d.record.steps if s.label == "test.conserved")
        assert ("Π̇_o" in [e.lhs for e in step.equations]) is kept
        assert all(v.holds for v in d.check(seed=1))
