"""The vectors of the equations that are seen on a body: their numbers, by mechanics of points."""

from types import ModuleType

import numpy as np
import pytest

from derive.code.emit import emit
from derive.code.options import Options
from derive.programs import moving_program
from derive.views.arrows import arrows, drawn, legend, with_arrows
from derive.views.language import language
from tests.support.walks import derived

RNG = np.random.default_rng(7)


def seen(name, x, parameters=None):
    """What each arrow of a ready-made problem is there, by its meaning and what is shown of it: a
    row of three for each part, or three rows of a matrix; and the module."""
    d = derived(name)
    found = arrows(d.record)
    record = with_arrows(d.record, found)
    made, _ = moving_program(d.problem, record, sought=False)
    (source,) = emit(made, record, ("python",), name, Options()).values()
    module = ModuleType(name)
    exec(compile(source, name, "exec"), module.__dict__)
    p = [float(v if v is not None else 1) for _, v, *_ in made.parameters]
    k = module.constants(np.array(p))
    u = np.zeros(len(module.INPUTS))
    read = module.outputs(0.0, x, k, u)[len(made.outputs) - sum(len(a.entries) for a in found) :]
    cuts = np.cumsum([len(a.entries) for a in found])[:-1]
    rows = [y.reshape(-1, 3) for y in np.split(np.asarray(read), cuts)]
    numbers = dict(zip([x for x, *_ in made.parameters], p, strict=True))
    return list(zip([a.meaning for a in found], rows, strict=True)), numbers, module, (k, u)


def turned(axis, angle):
    """A rotation of space."""
    K = np.cross(np.eye(3), axis / np.linalg.norm(axis))
    return np.eye(3) - np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def test_a_pendulum_has_an_arc_for_its_weight():
    angle, rate = 0.4, 1.5
    A = [np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)]
    found, p, *_ = seen("pendulum", np.array([*A, rate]))
    assert [m for m, _ in found] == [
        "angular velocity in the body",
        "angular acceleration by the forces",
    ]
    assert np.allclose(found[0][1], [[0, 0, rate]])
    assert np.allclose(found[1][1], [[0, 0, -p["g"] / p["l"] * np.sin(angle)]])


def test_a_bar_in_the_plane_has_forces_in_it_and_a_torque_out_of_it():
    angle, T = 0.3, np.array([0.1, -0.2])
    A = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    x = np.array([*A.ravel(), *T, 0.7, 0.5, -0.4])
    found, p, *_ = seen("hung_bar", x)
    told = {m: np.ravel(rows) for m, rows in found}
    ends = [np.array([-p["a"], 0]), np.array([p["a"], 0])]
    force, torque = np.zeros(2), 0.0
    for r in ends:
        v = A @ r + T - r  # from the anchor, above the end at rest
        pull = A.T @ (-p["k"] * (1 - p["s"] / np.linalg.norm(v)) * v)
        force += pull
        torque += r[0] * pull[1] - r[1] * pull[0]
    assert np.allclose(told["whole torque"], [0, 0, torque])
    assert np.allclose(told["acceleration by the forces"], [*force / (2 * p["m"]), 0])
    assert np.allclose(told["acceleration of gravity"], [*(A.T @ [0, -p["g"]]), 0])
    assert np.allclose(told["angular velocity in the body"], [0, 0, 0.7])


def test_two_tops_have_each_its_own():
    """The torque of the spring on each, and the gyroscopic one."""
    A, B = turned(np.array([1.0, 2, 0]), 0.5), turned(np.array([0.0, 1, 1]), -0.8)
    w, v = np.array([1.0, -0.5, 2]), np.array([0.3, 0.8, -1])
    found, p, *_ = seen("two_tops", np.array([*A.ravel(), *B.ravel(), *w, *v]))
    told = dict(found)
    points = [[(1, [1, 0, 0]), (1, [0, 1, 0])], [(1, [1, 0, 0.5]), (2, [0, 1, 0])]]
    a, b = np.array([1.0, 0, 0]), np.array([1, 0, 0.5])
    line = A @ a - B @ b
    pull = -p["k"] * (1 - p["l"] / np.linalg.norm(line)) * line
    torques = [np.cross(a, A.T @ pull), np.cross(b, -B.T @ pull)]
    for k, z in enumerate((w, v)):
        L = sum(m * np.cross(r, np.cross(z, r)) for m, r in points[k])
        torques[k] = torques[k] + np.cross(L, z)
    assert np.allclose(told["angular velocity in the body"], [w, v])
    assert np.allclose(told["whole torque"], torques)
    d = derived("two_tops")
    assert [x["part"] for x in drawn(d.record, arrows(d.record), 0)] == [0, 1, 0, 1]
    assert [x["at"] for x in drawn(d.record, arrows(d.record), 5)] == [5, 8, 11, 14]


@pytest.mark.parametrize("name", ["sl3", "gl3", "gas_cloud", "jelly", "saff3"])
def test_what_the_points_do(name):
    """The velocity of each, and terms whose sum is the rate of Z."""
    d = derived(name)
    made, _ = moving_program(d.problem, d.record, sought=False)
    x = 0.2 * RNG.standard_normal(len(made.state))
    x[:9] += np.eye(3).ravel()
    if name in ("sl3", "saff3"):
        x[:9] /= np.cbrt(np.linalg.det(x[:9].reshape(3, 3)))
    found, _, module, (k, u) = seen(name, x)
    place = len(made.state) - len(module.BASIS)
    order = [i for i, s in enumerate(made.state) if s.startswith(("zeta", "w_"))]
    assert order[0] == place
    rates = module.rhs(0.0, x, k, u)
    linear = [E[:3, :3] for E in np.array(module.BASIS)]
    Z, rate = (np.tensordot(y[place:], linear, 1) for y in (x, rates))
    terms = [rows for m, rows in found if m.startswith("acceleration of the points")]
    assert all(y.shape == (3, 3) for y in terms)
    assert len(terms) >= 2
    assert np.allclose(sum(terms), rate, rtol=1e-9, atol=1e-9)
    told = dict(found)
    assert np.allclose(told["velocity of the points about the origin"], Z)
    own = [rows for m, rows in found if m == "acceleration of the points by their own motion"]
    assert np.allclose(own, [-Z @ Z])


def test_what_moves_no_points_of_space_has_none():
    for name in ("screw", "manakov", "sp4", "euler_poisson", "zeitlin", "ideal_fluid", "imu"):
        assert not arrows(derived(name).record), name


def test_every_meaning_has_its_french():
    for name in ("pendulum", "hung_bar", "two_tops", "jelly", "sl3"):
        d = derived(name).record
        for x, told in zip(arrows(d), legend(d, arrows(d), language("fr")), strict=True):
            assert told["meaning"] != x.meaning
