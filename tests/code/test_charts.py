"""Charts of factors: quaternions, angles and coordinates in the place of their matrices; to_matrix
and from_matrix: a state with a quaternion, and the same with its matrix."""

from itertools import product

import numpy as np
import pytest

import derive
from tests.oracles.sampling import quaternion
from tests.problems import MIXED
from tests.support.emitted_files import Emission
from tests.support.library import derived, module_of
from tests.support.states import charted

PLAIN = """
name = "cart"
group = "R(1) x SO(2)"
[parameters]
M = 2.0
m = 1.0
l = 0.7
k = 5.0
g = 9.81
[lagrangian]
trivialisation = "left"
L = "M*zeta_1^2/2 + m*(zeta_1^2 + 2*l*A2_11*zeta_1*zeta_2 + l^2*zeta_2^2)/2 \
  - k*T1_1^2/2 + m*g*l*A2_11"
[[input]]
name = "F"
kind = "covector"
"""
"""A block on a spring, and a pendulum that hangs from it, pushed and turned."""
OWN = """
[group]
name = "Cart"
action = "linear"
basis = [
  [[0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
  [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, -1], [0, 0, 1, 0]],
]
"""
BY_BASIS = PLAIN.replace('group = "R(1) x SO(2)"\n', "").replace("A2_11", "A_33") + OWN
BY_BASIS = BY_BASIS.replace("T1_1", "A_12")
POINTS = [(1, "1, 2, 0"), (1, "0, 2, 1"), (1, "0, 2, 7"), (2, "0, 2"), (3, "1, 2")]
POINTS += [(4, "1, 2, 3"), (4, "0, 2, 3"), (4, "1, 0, 3")]
FOUR = """
name = "four"
group = "SO(3) x SO(2) x R(2) x SE(3)"
[parameters]
k = 2.0
""" + "".join(
    f"[[point]]\nmass = {k}\nblock = {block}\nat = [{at}]\n"
    for k, (block, at) in enumerate(POINTS, 1)
)
FOUR += "".join(
    f'[[potential]]\nkind = "spring"\nbetween = [{i}, {j}]\nstiffness = "k"\n'
    for i, j in ((1, 6), (4, 5), (3, 8))
)
FOUR += '[[input]]\nname = "F"\nkind = "force"\non = 6\nframe = "body"\n'
OWN_BASIS = f"""
name = "own"
[group]
name = "Own"
action = "affine"
basis = [{MIXED}]
[lagrangian]
L = "zeta_1^2 + 2*zeta_2^2 + 3/2*zeta_3^2 + zeta_4^2 + zeta_5^2/2 + 3*zeta_6^2 \
  + zeta_1*zeta_5/3 - T_3 - A_33*T_1"
[[input]]
name = "u"
kind = "covector"
"""
"""In a basis of se(3) with a screw in it."""
FORMS = {
    "two tops": ("two_tops", "quaternion", 14),
    "bar in the plane": ("hung_bar", "angle", 6),
    "screw": ("screw", "angle", 2),
    "R(1) x SO(2)": (PLAIN, "angle", 4),
    "by a basis": (BY_BASIS, "angle", 4),
    "own basis": (OWN_BASIS, "quaternion", 13),
    "four factors": (FOUR, "shortest", 26),
    "and matrices": (FOUR, "quaternion", 29),
}
"""Problem, attitude, and how many numbers its state has."""


@pytest.mark.parametrize("name", FORMS)
def test_it_equals_the_record(name):
    given, attitude, count = FORMS[name]
    small = count < 20
    more = {"jacobian": ("state", "raw"), "momenta": name != "by a basis"} if small else {}
    (report,) = Emission(given, ("c",), attitude=attitude, **more).reports()
    assert report.holds
    assert all(x in report.text for x in ("to_matrix", *(["jacobian_raw"] * small)))


def test_an_angle_counts_turns():
    f = derive.compile(derived(PLAIN), attitude="angle", step="gauss")
    over = f.begin([0.0, 0.0, 0.0, 20.0]).move_to(3.0, 1e-10)
    assert over.x[f.STATE.index("theta_2")] > 4 * np.pi
    assert f.to_matrix(over.x).shape == (7,)
    with pytest.raises(ValueError, match="counts turns"):
        f.from_matrix(f.to_matrix(over.x))


def test_quaternions_of_several_factors_there_and_back():
    f = derive.compile("two_tops", attitude="quaternion")
    for seed in range(20):
        x = charted(f, seed)
        for k in (0, 4):
            x[k : k + 4] *= 1 if x[k] >= 0 else -1
        assert np.abs(f.from_matrix(f.to_matrix(x)) - x).max() < 1e-15
    z = f.to_matrix(x)
    z[9:12] *= -1
    with pytest.raises(ValueError, match="reflection"):
        f.from_matrix(z)


def test_project_takes_every_quaternion_back():
    f = derive.compile(derived(FOUR), attitude="shortest")
    x = charted(f)
    off = x + 1e-5 * np.random.default_rng(1).normal(size=len(x))
    assert f.defect(x) < 1e-15
    assert f.defect(off) > 1e-6
    assert f.defect(f.project(off)) < 1e-9
    kept = [k for k, name in enumerate(f.STATE) if name[0] != "q"]
    assert np.array_equal(f.project(off)[kept], off[kept])


# ---------------------------------------------------------------- there and back

AXES = [v for v in product((-1.0, 0.0, 1.0), repeat=3) if any(v)]
BY = (0.0, 1e-9, 0.1, 1.0, 2.0, 3.0, np.pi - 1e-7, np.pi)


def rotation(axis, angle):
    """Rodrigues' formula."""
    e = np.array(axis) / np.linalg.norm(axis)
    K = np.cross(np.eye(3), e).T
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def turns():
    """Rotations about axes in all directions, also by half a turn, exact and nearly so, and some
    at random."""
    for axis in AXES:
        for angle in BY:
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
def se3():
    return derive.compile("se3", attitude="quaternion")


def test_there_and_back_at_every_turn(states, se3):
    """Beside the quaternion of an oracle; of half a turn, where both signs are, up to it.  Python
    does as C, of many at once, too."""
    m, known = (
        module_of("se3", attitude="quaternion"),
        [quaternion(z[:9].reshape(3, 3)) for z in states],
    )
    assert derive.compile("se3").STATE == m.MATRIX_STATE
    found, many = np.array([se3.from_matrix(z) for z in states]), m.from_matrix(states)
    assert (found[:, 0] >= 0).all()
    assert np.abs(np.linalg.norm(found[:, :4], axis=1) - 1).max() < 4e-16
    signs = [np.abs(found[:, :4] - s * np.array(known)).max(axis=1) for s in (1, -1)]
    assert np.minimum(*signs).max() < 1e-7
    assert np.abs(np.abs(many) - np.abs(found)).max() < 1e-15
    clear = found[:, 0] > 1e-12  # at half a turn a rounding more or less is another sign
    assert np.abs(many - found)[clear].max() < 1e-15
    assert np.array_equal(m.from_matrix(states[40]), many[40])
    for back in (np.array([se3.to_matrix(x) for x in found]), m.to_matrix(many)):
        assert np.abs(back - states)[:, :9].max() < 2e-15
        assert np.array_equal(back[:, 9:], states[:, 9:])
    with pytest.raises(ValueError, match="z has 13 numbers, not 18"):
        m.from_matrix(many)


def test_a_matrix_that_is_off_gives_a_unit_quaternion_near_it(states, se3):
    rng = np.random.default_rng(5)
    for z in states[::7]:
        off = z + 1e-6 * rng.normal(size=z.shape)
        x = se3.from_matrix(off)
        assert abs(np.linalg.norm(x[:4]) - 1) < 4e-16
        assert np.abs(se3.to_matrix(x) - off)[:9].max() < 2e-5
