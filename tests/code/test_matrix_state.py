"""to_matrix and from_matrix: a state with a quaternion, and the same with its matrix."""

from itertools import product

import numpy as np
import pytest

import derive
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.oracles.sampling import quaternion
from tests.support.library import library, module_of

AXES = [v for v in product((-1.0, 0.0, 1.0), repeat=3) if any(v)]
CARRIED = ("from_matrix", "to_matrix")
ANGLES = (0.0, 1e-9, 0.1, 1.0, 2.0, 3.0, np.pi - 1e-7, np.pi)


def rotation(axis, angle):
    """Rodrigues' formula."""
    e = np.array(axis) / np.linalg.norm(axis)
    K = np.cross(np.eye(3), e).T
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def turns():
    """Rotations about axes in all directions, also by half a turn, exact and nearly so, and some
    at random."""
    for axis in AXES:
        for angle in ANGLES:
            yield rotation(axis, angle)
    for signs in ((1, -1, -1), (-1, 1, -1), (-1, -1, 1)):
        yield np.diag(signs).astype(float)
    yield np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])
    rng = np.random.default_rng(2)
    for _ in range(200):
        yield rotation(rng.normal(size=3), rng.uniform(0, np.pi))


@pytest.fixture(scope="module")
def states():
    """The states of SE(3) at all these turns, with matrices, (n, 18)."""
    rng = np.random.default_rng(1)
    return np.array([[*A.ravel(), *rng.normal(size=9)] for A in turns()])


@pytest.fixture(scope="module")
def compiled():
    return derive.compile("se3", attitude="quaternion")


def test_there_and_back_at_every_turn(states, compiled):
    found = np.array([compiled.from_matrix(z) for z in states])
    assert (found[:, 0] >= 0).all()
    assert np.abs(np.linalg.norm(found[:, :4], axis=1) - 1).max() < 4e-16
    back = np.array([compiled.to_matrix(x) for x in found])
    assert np.abs(back - states)[:, :9].max() < 2e-15
    assert np.array_equal(back[:, 9:], states[:, 9:])


def test_it_is_the_quaternion_of_the_rotation(states, compiled):
    """Beside that of an oracle; of half a turn, where both signs are, up to it."""
    for z in states:
        found, expected = compiled.from_matrix(z)[:4], quaternion(z[:9].reshape(3, 3))
        assert min(np.abs(found - s * expected).max() for s in (1, -1)) < 1e-7


def test_a_matrix_that_is_off_gives_a_unit_quaternion_near_it(states, compiled):
    rng = np.random.default_rng(5)
    for z in states[::7]:
        off = z + 1e-6 * rng.normal(size=z.shape)
        x = compiled.from_matrix(off)
        assert abs(np.linalg.norm(x[:4]) - 1) < 4e-16
        assert np.abs(compiled.to_matrix(x) - off)[:9].max() < 2e-5


def test_python_does_as_c_also_with_many(states, compiled):
    m = module_of("se3", attitude="quaternion")
    plain = derive.compile("se3")
    assert plain.STATE == m.MATRIX_STATE
    many = m.from_matrix(states)
    assert many.shape == (len(states), 13)
    in_c = np.array([compiled.from_matrix(z) for z in states])
    # at half a turn a rounding more or less is another sign
    same = np.abs(np.abs(many) - np.abs(in_c))
    assert same.max() < 1e-15
    clear = in_c[:, 0] > 1e-12
    assert np.abs(many - in_c)[clear].max() < 1e-15
    assert np.abs(m.to_matrix(many) - states).max() < 2e-15
    assert np.array_equal(m.from_matrix(states[40]), many[40])
    with pytest.raises(ValueError, match="z has 13 numbers, not 18"):
        m.from_matrix(many)


@pytest.mark.parametrize("build", ["javascript", "rust2021", "g++17"])
def test_other_languages_do_as_c(build, states, compiled):
    made = library(build, "se3", attitude="quaternion")
    there, back = (next(x for x in made.calls if x.name == y) for y in CARRIED)
    for z in states[::5]:
        values = {"t": 0.0, "z": z, **dict.fromkeys("pkxyu", np.zeros(18))}
        (x,) = made.shown(there, values, False)
        assert np.abs(np.abs(x) - np.abs(compiled.from_matrix(z))).max() < 1e-15
        (found,) = made.shown(back, values | {"x": x}, False)
        assert np.abs(found - z).max() < 2e-15


def test_without_a_quaternion_there_are_none():
    f = derive.compile("so3")
    with pytest.raises(ValueError, match="attitude='quaternion'"):
        f.to_matrix(np.zeros(12))


MIXED = [
    [[0, 0, 0, 1], [0] * 4, [0] * 4, [0] * 4],
    [[0] * 4, [0, 0, -2, 0], [0, 2, 0, 0], [0] * 4],
    [[0, 0, 1, 0], [0] * 4, [-1, 0, 0, 0], [0] * 4],
    [[0] * 4, [0, 0, 0, 1], [0] * 4, [0] * 4],
    [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 1], [0] * 4],
    [[0] * 4, [0] * 4, [0, 0, 0, 1], [0] * 4],
]
"""A basis of se(3) of one's own, a screw in it."""
OPERATOR = np.diag([2.0, 3, 2.5, 1, 2, 3]) + 0.4 * np.eye(6, k=4)
L = "zeta_1^2 + 2*zeta_2^2 + 3/2*zeta_3^2 + zeta_4^2 + zeta_5^2/2 + 3*zeta_6^2 + zeta_1*zeta_5/3"
STATED = {
    "expression": ("SE(3)", derive.Lagrangian(f"{L} - 2*T_3 - A_33*T_1")),
    "operator": ("SE(3)", derive.Inertia((OPERATOR + OPERATOR.T) / 2)),
    "basis": (derive.Group("Own", MIXED, "affine"), derive.Lagrangian(f"{L} - T_3 - A_33*T_1")),
}


@pytest.mark.parametrize("name", STATED)
def test_a_lagrangian_of_ones_own_equals_the_record(name):
    group, lagrangian = STATED[name]
    d = derive.derive(derive.Problem("own", group, lagrangian, [derive.Covector("u")]))
    options = {"attitude": "quaternion", "momenta": True, "jacobian": ("state", "inputs")}
    files = d.emit(languages=("python",), **options)
    reports = [*EmittedFiles(files, "own", Chart("row", "quaternion", "body")).reports(d.record)]
    assert all(report.holds for report in reports)
    assert "to_matrix, from_matrix, momentum, velocity, momentum_rhs" in reports[0].text
