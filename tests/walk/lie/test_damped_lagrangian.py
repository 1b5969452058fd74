"""Damping beside a Lagrangian: Gauss's principle, the power, the same as on points; what is not
damped there."""

import numpy as np
import pytest

import derive
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from tests.support.library import module_of
from tests.support.walks import own_verdicts
from tests.walk.lie.test_at_places import kinetic, of_points, turned

KAPPA = {"parameters": {"k": 0.3, "b": 0.4}}
DAMPED = [
    {"coefficient": "k", "at": [1, 0, "b"]},
    {"kind": "quadratic", "coefficient": "b", "at": [0, 2, 0], "name": "drag"},
    {"kind": "rotational", "coefficient": 0.7},
]
OF_TWO = [
    {"coefficient": "k", "at": [1, 0, "b"], "block": 2},
    {"kind": "quadratic", "coefficient": "b", "at": [0, 2], "block": 1},
    {"kind": "rotational", "coefficient": 0.7, "block": 1},
    {"kind": "rotational", "coefficient": 0.2, "block": 2},
]
MASSES = np.arange(1, 10)


def two(side, damping):
    """SE(2) x SE(3) with the energy of a diagonal inertia and of a place."""
    zeta = "+".join(f"{m}*zeta_{a}^2" for a, m in enumerate(MASSES, 1))
    L = {"L": f"({zeta})/2 - T2_3 - A1_12", "trivialisation": side}
    return {"name": "two", "group": "SE(2) x SE(3)", "lagrangian": L, "damping": damping} | (
        KAPPA if damping else {}
    )


def element(rng):
    """A random one as a matrix on both, with its numbers in the order of the state."""
    plane, space = np.eye(3), np.eye(4)
    angle = rng.normal()
    plane[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    plane[:2, 2], space[:3, :3], space[:3, 3] = rng.normal(size=2), turned(rng), rng.normal(size=3)
    g = np.block([[plane, np.zeros((3, 4))], [np.zeros((4, 3)), space]])
    parts = (plane[:2, :2].ravel(), plane[:2, 2], space[:3, :3].ravel(), space[:3, 3])
    return g, np.concatenate(parts)


def of_velocity(g, basis, side):
    """What ζ makes of the velocities that are damped: 3 of a place of space, 2 of one of the plane,
    and both angular velocities, rows of a matrix each."""
    moved = [g @ e if side == "left" else e @ g for e in basis]  # dg by each coordinate
    space = [x @ [0, 0, 0, 1, 0, 0.4, 1] for x in moved]
    plane = [x @ [0, 2, 1, 0, 0, 0, 0] for x in moved]
    turns = [x @ np.linalg.inv(g) for x in moved]
    return (
        np.array([x[3:6] for x in space]).T,
        np.array([x[:2] for x in plane]).T,
        np.array([[x[1, 0]] for x in turns]).T,
        np.array([[x[5, 4], x[3, 5], x[4, 3]] for x in turns]).T,
    )


@pytest.mark.parametrize("side", ["left", "right"])
def test_by_gauss_and_the_power(side):
    """M Δζ̇ = Σ Jᵀf, least squares over 𝔤; the energy falls by Σ⟨f, v⟩."""
    damped, free = (module_of(problem_of(two(side, x))) for x in (OF_TWO, []))
    rng = np.random.default_rng(3)
    k = damped.constants([{"k": 0.3, "b": 0.4}[x] for x in damped.PARAMETERS])
    for _ in range(4):
        (g, numbers), zeta = element(rng), rng.normal(size=9)
        x = np.concatenate([numbers, zeta])
        maps = of_velocity(g, np.array(damped.BASIS), side)
        v = [J @ zeta for J in maps]
        f = [-0.3 * v[0], -0.4 * np.linalg.norm(v[1]) * v[1], -0.7 * v[2], -0.2 * v[3]]
        found = damped.rhs(0.0, x, k) - free.rhs(0.0, x, free.constants([]))
        pushed = sum(J.T @ y for J, y in zip(maps, f, strict=True)) / MASSES
        assert np.abs(found[-9:] - pushed).max() < 1e-13 * np.abs(pushed).max()
        rate, h = damped.rhs(0.0, x, k), 1e-6
        above, below = (damped.energy(0.0, x + s * h * rate, k) for s in (1, -1))
        power = sum(y @ z for y, z in zip(f, v, strict=True))
        assert power < 0
        assert abs((above - below) / (2 * h) - power) < 1e-7 * abs(power)


@pytest.mark.parametrize("side", ["left", "right"])
def test_every_step_is_checked(side):
    own = [{x: y for x, y in d.items() if x != "block"} | {"at": [0, 2]} for d in OF_TWO[:3]]
    del own[2]["at"]
    L = {"L": "(2*zeta_1^2 + zeta_2^2 + zeta_3^2)/2 - T_2", "trivialisation": side}
    data = {"name": "one", "group": "SE(2)", "lagrangian": L, "damping": own, **KAPPA}
    record = derive.derive(problem_of(data)).record
    assert all(v.holds for v in own_verdicts(record))
    assert any(s.label == "one.power" for s in record.steps)


@pytest.mark.parametrize(
    ("group", "side"), [("SE(3)", "left"), ("SO(3)", "left"), ("SO(3)", "right")]
)
def test_as_on_points(group, side):
    data = {"name": "test", "group": group, "damping": DAMPED, **KAPPA}
    points, own = (
        module_of(problem_of(data | x)) for x in (of_points(group), kinetic(group, side))
    )
    rng = np.random.default_rng(5)
    R, place = turned(rng), rng.normal(size=3 if group == "SE(3)" else 0)
    zeta = rng.normal(size=len(place) + 3)
    values = {"k": 0.3, "b": 0.4}
    k = [m.constants([values[x] for x in m.PARAMETERS]) for m in (points, own)]
    x = np.array([*R.ravel(), *place, *zeta])
    expected, y = points.rhs(0.0, x, k[0])[-len(zeta) :], x.copy()
    if side == "right":
        y[-3:], expected = R @ zeta, R @ expected
    found = own.rhs(0.0, y, k[1])[-len(zeta) :]
    assert np.abs(found - expected).max() < 1e-12 * np.abs(expected).max()


@pytest.mark.parametrize(
    ("table", "told"),
    [
        ({"coefficient": 1}, "damping 1: give a place of the body under 'at'$"),
        ({"coefficient": 1, "on": 1, "at": [0, 0, 1]}, "damping 1: give either 'on' or 'at'"),
        ({"coefficient": -1, "at": [0, 0, 1]}, "damping 1: key 'coefficient' is negative"),
    ],
)
def test_what_is_refused(table, told):
    with pytest.raises(ProblemError, match=told):
        problem_of(
            {"name": "test", "group": "SO(3)", "damping": [table], **kinetic("SO(3)", "left")}
        )
