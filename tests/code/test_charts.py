"""Charts of factors: quaternions, angles and coordinates in the place of their matrices; to_matrix
and from_matrix: a state with a quaternion, and the same with its matrix."""

import re
from itertools import product

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.algebra.factor_charts import factor_charts
from derive.algebra.families import FAMILIES, group
from tests.code.test_step_jacobian import close, derivative
from tests.oracles.sampling import quaternion, turn
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
FORMS = {
    "two tops": ("two_tops", "quaternion", ["q1_0", "q2_3"], 14),
    "bar in the plane": ("hung_bar", "angle", ["theta_1", "T_1"], 6),
    "screw": ("screw", "angle", ["theta_1"], 2),
    "R(1) x SO(2)": (PLAIN, "angle", ["T1_1", "theta_2"], 4),
    "by a basis": (BY_BASIS, "angle", ["s_1", "theta_2"], 4),
    "four factors": (FOUR, "shortest", ["q1_0", "theta_4", "T3_2", "q4_3", "T4_3"], 26),
    "and matrices": (FOUR, "quaternion", ["q1_0", "A2_22", "q4_3", "T4_3"], 29),
}
"""Problem, attitude, some numbers of its state, and how many this has."""


@pytest.mark.parametrize("name", FORMS)
def test_the_numbers_of_the_state(name):
    """tests/code/test_forms.py has their rates, those of matrices."""
    given, attitude, some, count = FORMS[name]
    chart, plain = module_of(given, attitude=attitude), module_of(given)
    assert len(chart.STATE) == len({*chart.STATE}) == count
    assert {*some} <= {*chart.STATE}
    assert len(chart.to_matrix(charted(chart))) == len(plain.STATE) > count


@pytest.mark.parametrize("name", FORMS)
def test_the_header_has_their_places_and_what_they_are(name):
    given, attitude, *_ = FORMS[name]
    d = derived(given)
    header = d.emit(languages=("c",), attitude=attitude)[f"{d.problem.name}.h"]
    names = re.findall(rf"^    {d.problem.name}_X_(\w+) = (\d+)", header, flags=re.M)
    kept = re.search(r"\* +x = \(([^)]*)\)", header)[1]
    assert names == [(x, str(k)) for k, x in enumerate(re.findall(r"\w+", kept))]
    told = header.replace("\n * ", " ")
    for x, _ in names:
        if x[0] == "q":
            assert f"{x[:-2]} is a unit quaternion" in told
        elif x.startswith("theta"):
            assert f"whole turns are counted in {x}" in told


@pytest.mark.parametrize("name", FORMS)
def test_it_equals_the_record(name):
    given, attitude, *_, count = FORMS[name]
    small = count < 20
    more = {"jacobian": ("state", "raw"), "momenta": name != "by a basis"} if small else {}
    (report,) = Emission(given, ("c",), attitude=attitude, **more).reports()
    assert report.holds
    assert all(x in report.text for x in ("to_matrix", *(["jacobian_raw"] * small)))


SIZES = {"gauss": 0.1, "rk4": 0.02, "vern9": 0.05}
"""Steps, and how long each is."""


def variations(f, x):
    """What the numbers of a state change by along (eta, delta zeta): the rates of an element of
    the group are those along its velocity, (d) in the last numbers."""
    d = sum(name.startswith(("zeta", "w")) for name in f.STATE)
    V = np.zeros((len(x), 2 * d))
    V[-d:, d:] = np.eye(d)
    for a, speed in enumerate(np.eye(d)):
        V[:-d, a] = f(0.0, [*x[:-d], *speed])[:-d]
    return V


@pytest.mark.parametrize("name", FORMS)
def test_derivatives_of_steps_are_differences_of_steps(name):
    """To 1e-9, where the rates lead; those of gauss, which differ by rounding, are those of
    matrices; of many factors, of which C takes long to compile, those of rk4 alone."""
    given, attitude, _, count = FORMS[name]
    sizes = SIZES if count < 20 else {"rk4": SIZES["rk4"]}
    options = {"step": (*sizes,), "jacobian": "step"}
    chart = derive.compile(derived(given), attitude=attitude, **options)
    x, u = charted(chart), np.random.default_rng(4).normal(size=len(chart.INPUTS))
    V = variations(chart, x)
    for step, h in sizes.items():

        def end(x, u, step=step, h=h):
            if chart.STATE[0] == "q1_0":
                x = chart.project(chart.project(x))
            return chart.step_jacobian(0.3, x, h, u, n=2, step=step)[0]

        there, phi, gamma = chart.step_jacobian(0.3, x, h, u, n=2, step=step)
        path = solve_ivp(
            chart.rhs, (0.3, 0.3 + 2 * h), x, "DOP853", args=(u,), rtol=1e-12, atol=1e-12
        )
        assert close(there, path.y[:, -1], 1e-7)
        ahead = np.linalg.pinv(variations(chart, there))
        assert close(phi, ahead @ derivative(lambda e: end(x + V @ e, u), V.shape[1]))
        assert close(gamma, ahead @ derivative(lambda e: end(x, u + e), len(u)))
        assert phi.any()
        assert gamma.any() == bool(chart.INPUTS)
    if "gauss" not in sizes:
        return
    plain, z = derive.compile(derived(given), **options), chart.to_matrix(x)
    found, known = (
        f.step_jacobian(0.3, y, 0.05, u, step="gauss") for f, y in ((chart, x), (plain, z))
    )
    for a, b in zip(found[1:], known[1:], strict=True):
        assert close(a, b, 1e-10)


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


ANGLES = ("SO", "SE", "UT", "U")
"""Families whose least members turn a plane, or have one parameter."""


@pytest.mark.parametrize("name", FAMILIES)
def test_which_factors_have_charts(name):
    """By themselves, and in a product, where they are in other rows."""
    least = group(f"{name}({FAMILIES[name].least})")
    beside = group(f"SO(3) x {name}({FAMILIES[name].least})")
    assert [*factor_charts(least, "angle")] == [0] * (name in ANGLES)
    assert [*factor_charts(beside, "angle")] == [1] * (name in ANGLES)
    assert [*factor_charts(beside, "quaternion")] == [0]
    assert not factor_charts(beside, "matrix")


# ---------------------------------------------------------------- there and back

AXES = [v for v in product((-1.0, 0.0, 1.0), repeat=3) if any(v)]
BY = (0.0, 1e-9, 0.1, 1.0, 2.0, 3.0, np.pi - 1e-7, np.pi)


def turns():
    """Rotations about axes in all directions, also by half a turn, exact and nearly so, and some
    at random."""
    for axis in AXES:
        for angle in BY:
            yield turn(axis, angle)
    for signs in ((1, -1, -1), (-1, 1, -1), (-1, -1, 1)):
        yield np.diag(signs).astype(float)
    yield np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])
    rng = np.random.default_rng(2)
    for _ in range(200):
        yield turn(rng.normal(size=3), rng.uniform(0, np.pi))


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


def test_without_a_quaternion_there_are_none():
    f = derive.compile("so3")
    with pytest.raises(ValueError, match="attitude='quaternion'"):
        f.to_matrix(np.zeros(12))


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


def test_a_lagrangian_of_ones_own_equals_the_record():
    options = {"attitude": "quaternion", "momenta": True, "jacobian": ("state", "inputs")}
    reports = Emission(OWN_BASIS, **options).reports()
    assert all(report.holds for report in reports), [x.text for x in reports]
    assert "to_matrix, from_matrix, momentum, velocity, momentum_rhs" in reports[0].text
