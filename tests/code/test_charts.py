"""Charts of factors: quaternions, angles and coordinates in the place of their matrices."""

import re

import numpy as np
import pytest

import derive
from derive.algebra.factor_charts import factor_charts
from derive.algebra.families import FAMILIES, group
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.code.test_step_jacobian import close, derivative
from tests.support.languages import Case, built
from tests.support.library import derived

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


def compiled(name):
    """The program with charts, and that with matrices."""
    given, attitude, *_ = FORMS[name]
    return [derive.compile(derived(given), attitude=x, step="vern9") for x in (attitude, "matrix")]


def start(f, seed=3):
    """A state on the group: quaternions of length 1, the matrices of other factors 1."""
    x = np.random.default_rng(seed).normal(size=len(f.STATE)) / 2
    for k, name in enumerate(f.STATE):
        if name.startswith("q") and name.endswith("_0"):
            x[k : k + 4] /= np.linalg.norm(x[k : k + 4])
        if name.startswith("A"):
            x[k] = name[-1] == name[-2]
    return x


@pytest.mark.parametrize("name", FORMS)
def test_the_numbers_of_the_state(name):
    chart, plain = compiled(name)
    _, _, some, count = FORMS[name]
    assert len(chart.STATE) == len({*chart.STATE}) == count
    assert {*some} <= {*chart.STATE}
    assert len(chart.to_matrix(start(chart))) == len(plain.STATE) > count


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
def test_accelerations_and_energy_are_those_of_matrices(name):
    chart, plain = compiled(name)
    for seed in range(5):
        x = start(chart, seed)
        z = chart.to_matrix(x)
        d = sum(y.startswith(("zeta", "w")) for y in chart.STATE)
        found, wanted = chart(0.3, x)[-d:], plain(0.3, z)[-d:]
        assert np.abs(found - wanted).max() <= 1e-13 * (1 + np.abs(wanted).max())
        assert abs(chart.energy(0.3, x) - plain.energy(0.3, z)) <= 1e-13 * (1 + abs(z).max() ** 2)
        # what the numbers of a chart do, their matrices do
        h = 1e-6
        ahead, behind = (chart.to_matrix(x + s * h * chart(0.3, x)) for s in (1, -1))
        assert np.abs((ahead - behind) / (2 * h) - plain(0.3, z)).max() < 1e-8 * (1 + abs(z).max())


@pytest.mark.parametrize("name", FORMS)
def test_motions_are_those_of_matrices(name):
    chart, plain = compiled(name)
    x = start(chart)
    there = chart.begin(x).move_to(2.0, 1e-13).x
    wanted = plain.begin(chart.to_matrix(x)).move_to(2.0, 1e-13).x
    assert np.abs(chart.to_matrix(there) - wanted).max() < 1e-10 * (1 + np.abs(wanted).max())
    if name != "screw":
        assert np.abs(wanted - chart.to_matrix(x)).max() > 0.1


@pytest.mark.parametrize("name", FORMS)
def test_it_equals_the_record(name):
    given, attitude, *_ = FORMS[name]
    d = derived(given)
    small = FORMS[name][-1] < 20
    more = {"jacobian": ("state", "raw"), "momenta": name != "by a basis"} if small else {}
    files = d.emit(languages=("c",), attitude=attitude, **more)
    (report,) = EmittedFiles(files, d.problem.name, Chart(attitude=attitude)).reports(d.record)
    assert report.holds
    assert all(x in report.text for x in ("to_matrix", *(["jacobian_raw"] * small)))


@pytest.mark.parametrize("build", built())
@pytest.mark.parametrize("name", ["four factors", "and matrices", "by a basis"])
def test_every_language_says_the_same(name, build):
    given, attitude, *_ = FORMS[name]
    steps = ("rk4", "gauss")
    options = {"attitude": attitude, "jacobian": ("state", "step"), "step": steps}
    options["conserved"] = True
    Case(given, options, tolerance=1e-13).agrees(build)


def test_jacobians_are_differences_of_the_code():
    f = derive.compile(derived(PLAIN), attitude="angle", jacobian=("state", "raw"))
    x, h = start(f), 1e-6
    columns = [(f(0.0, x + h * e) - f(0.0, x - h * e)) / (2 * h) for e in np.eye(4)]
    assert np.abs(np.transpose(columns) - f.jacobian_raw(0.0, x)).max() < 1e-7
    # where coordinates commute, (eta, δζ) are changes of the numbers themselves
    rates, D = f.jacobian(0.0, x)
    assert np.array_equal(rates, f(0.0, x))
    assert np.abs(D - f.jacobian_raw(0.0, x)).max() < 1e-13


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
    """To 1e-9, and those of gauss, which differ by rounding, are those of matrices; of many
    factors, of which C takes long to compile, those of rk4 alone."""
    given, attitude, _, count = FORMS[name]
    sizes = SIZES if count < 20 else {"rk4": SIZES["rk4"]}
    options = {"step": (*sizes,), "jacobian": "step"}
    chart = derive.compile(derived(given), attitude=attitude, **options)
    x, u = start(chart), np.random.default_rng(4).normal(size=len(chart.INPUTS))
    V = variations(chart, x)
    for step, h in sizes.items():

        def end(x, u, step=step, h=h):
            if chart.STATE[0] == "q1_0":
                x = chart.project(chart.project(x))
            return chart.step_jacobian(0.3, x, h, u, n=2, step=step)[0]

        there, phi, gamma = chart.step_jacobian(0.3, x, h, u, n=2, step=step)
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
        x = start(f, seed)
        for k in (0, 4):
            x[k : k + 4] *= 1 if x[k] >= 0 else -1
        assert np.abs(f.from_matrix(f.to_matrix(x)) - x).max() < 1e-15
    z = f.to_matrix(x)
    z[9:12] *= -1
    with pytest.raises(ValueError, match="reflection"):
        f.from_matrix(z)


def test_project_takes_every_quaternion_back():
    f = derive.compile(derived(FOUR), attitude="shortest")
    x = start(f)
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
