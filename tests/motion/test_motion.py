"""Motions of derive simulate: known solutions, order, what is kept, what is refused."""

import re
import tomllib

import numpy as np
import pytest

import derive
from derive.code.step.tableaux import Collocation
from derive.command.cli import main
from derive.command.simulating import negative
from derive.motion.first_numbers import MotionError, drives
from derive.motion.run import read
from derive.motion.start import inertia_of
from derive.motion.trajectory import Method, instants, taken_to_group
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.programs import motion_of
from tests.oracles import free_top
from tests.support.library import derived

MOMENTS = (1.25, 2.0, 2.75)
FREE = """
name = "free"
group = "SO(3)"
[body]
given = { m = 1, c = [0, 0, 0], J = [["7/4", 0, 0], [0, 1, 0], [0, 0, "1/4"]] }
"""


@pytest.fixture(scope="module")
def free():
    """A free top with the MOMENTS."""
    return derived(FREE)


def free_state(t):
    A, W = free_top.motion(t, MOMENTS, 1.0, 2.2)
    return np.concatenate([A.ravel(), W])


def start(d, x):
    return dict(zip(d.simulate(1e-3, points=1).names[1 : 1 + len(x)], x, strict=True))


# ---------------------------------------------------------------- the method


def test_the_nodes_are_gauss_and_mu_is_symplectic():
    method = Collocation()
    nodes, weights = np.polynomial.legendre.leggauss(8)
    assert np.allclose(method.c, (nodes + 1) / 2, rtol=0, atol=2e-16)
    assert np.allclose(method.b, weights / 2, rtol=0, atol=5e-16)
    mu, b, c = np.array(method.mu), np.array(method.b), np.array(method.c)
    assert np.array_equal(mu + mu.T, np.ones((8, 8)))
    for k in range(8):  # collocation: exact on polynomials
        assert np.allclose(mu @ (b * c**k), c ** (k + 1) / (k + 1), atol=1e-15)
    for k in range(16):
        assert np.isclose(b @ c**k, 1 / (k + 1), atol=1e-15)
    later = 1 + 0.7 * c  # the polynomial of a step, continued
    gaps = later[:, None] - c
    on = gaps.prod(axis=1, keepdims=True) / gaps * np.array(method.continued) * b
    assert np.allclose(on @ c**7, later**7, rtol=1e-10)
    series = np.array(method.dense)
    legendre = np.polynomial.legendre.legvander(2 * c - 1, 7)
    assert np.allclose((series * b) @ legendre, np.eye(8), atol=1e-14)


# ---------------------------------------------------------------- known solutions


def test_a_free_top(free):
    run = free.simulate(50.0, start=start(free, free_state(0)), points=10)
    exact = np.array([free_state(t) for t in run.t])
    assert np.abs(run.states - exact).max() < 1e-9
    assert np.ptp(run["energy"]) < 1e-14
    assert run["defect"].max() < 5e-15
    assert run.ended == ""


# ---------------------------------------------------------------- starts, instants


@pytest.mark.parametrize(
    ("dt", "duration", "points", "last"),
    [(0.1, 1.0, 5, 0.8), (0.3, 1.0, 100, 0.9), (2.0, 1.0, 5, 0)],
)
def test_the_instants_of_fixed_steps_are_ends_of_steps(dt, duration, points, last, free):
    """The last step may be shorter, and its end is the state of that time."""
    times = instants(Method(dt=dt), duration, points)
    assert times[0] == 0
    assert times[-1] == duration
    assert np.allclose(times[-2], last)
    assert np.allclose(times[:-1] / dt, np.round(times[:-1] / dt))
    run = free.simulate(duration, start=start(free, free_state(0)), dt=dt, points=points)
    assert np.abs(run.states[-1] - free_state(duration)).max() < 1e-6


# ---------------------------------------------------------------- the command


def told(capsys, *arguments):
    code = main(["simulate", *arguments])
    return code, *capsys.readouterr()


def test_a_collision_keeps_what_is_done(tmp_path, capsys):
    """Also where that is before what is kept."""
    out = tmp_path / "run.npz"
    fall = [x for name in ("T_1", "w_2", "zeta_3") for x in ("--set", f"{name}=0")]
    code, _, err = told(capsys, "comet", "--t", "1", *fall, "--points", "1", "--out", str(out))
    assert (code, err.count("\n")) == (1, 1)
    assert "the steps become too short at t = 0.06471" in err
    first, last = read(out).t
    assert first == 0 < 0.06 < last < 0.0648


@pytest.mark.filterwarnings("error")
def test_a_start_in_a_collision_is_one_line(capsys):
    code, out, err = told(capsys, "comet", "--t", "1", "--set", "T_1=0.1")  # s: a mass is at 0
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "the equations have no finite value at the start" in err


@pytest.mark.parametrize("g", [(0.0, 0.0, -9.81), (0.0, 3.0, 4.0), (1.0, -2.0, 0.5)])
def test_components_are_along_unit_vectors_and_have_their_units(g):
    """Of the parameters of so3, and of numbers in a problem: Σ m r ∧ v along g/|g|."""
    m, r = [1.0, 2.0, 0.5], np.array([[1.0, 0.0, 0.5], [0.0, 1.0, 1.0], [0.5, -1.0, 0.0]])
    J, c = (np.einsum("p,pi,pj->ij", m, r, r), np.einsum("p,pi->i", m, r))
    symbolic = {f"g_{k}": x for k, x in enumerate(g, 1)} | {f"c_{k}": x for k, x in enumerate(c, 1)}
    symbolic |= {f"J_{i + 1}{j + 1}": J[i, j] for i in range(3) for j in range(i, 3)}
    points = derive.Points(*zip(m, r.tolist(), strict=True))
    numbers = derive.Problem("by_numbers", "SO(3)", points, [derive.Gravity(*g)])
    for problem, given in (("so3", symbolic), (numbers, {})):
        begin = given | {"zeta_1": 1.0, "zeta_3": 2.0}
        run = derive.derive(problem).simulate(0.3, points=3, start=begin)
        A, zeta = run.states[:, :9].reshape(-1, 3, 3), run.states[:, 9:]
        v = np.cross(zeta[:, None], r[None])
        momentum = np.einsum("tij,p,tpj->ti", A, m, np.cross(r[None], v))
        column = next(x for x in run.columns if x.name.startswith("angular_momentum"))
        unit = np.array(g) / np.linalg.norm(g)
        unit = abs(unit) if column.name[-1].isdigit() else unit  # about an axis of space
        assert np.allclose(abs(run[column.name]), abs(momentum @ unit), rtol=0, atol=1e-12)
        assert column.unit == ("kg m^2/s" if given else "")


def test_without_gravity_there_is_no_component_along_it():
    """There are those along the axes of space, which are kept then, in their unit."""
    for name, start in (("so3", {"g_3": 0.0}), ("se3", {"g_3": 0.0}), ("top", {"g": 0.0})):
        d = derive.derive(name)
        run = d.simulate(0.5, points=3, start={"zeta_1": 1.0, "zeta_3": 2.0} | start)
        columns = {x.name: x.unit for x in run.columns if x.kind == "conserved"}
        assert "angular_momentum" not in columns
        for k in (1, 2, 3):
            assert columns[f"angular_momentum_{k}"] == "kg m^2/s"
            column = run[f"angular_momentum_{k}"]
            assert np.ptp(column) < 1e-9 * max(abs(run["energy"][0]), 1)
        assert np.isfinite(run.table).all()
        known = {x.name for x in d.simulate(0.1, points=1).columns}
        assert not {"angular_momentum_1", "angular_momentum_2"} & known


def test_what_is_amiss_is_told(capsys, tmp_path):
    still = ("--set", "zeta_5=0", "--set", "zeta_9=0")
    assert "nothing moves" in told(capsys, "jelly", "--t", "1", *still)[2]
    file = tmp_path / "own.toml"
    points = "".join(f"[[point]]\nmass = 1\nat = {x}\n" for x in ([1, 0, 0], [0, 1, 0], [0, 0, 1]))
    file.write_text(f'name = "own"\ngroup = "SO(3)"\n{points}[[damping]]\ncoefficient = 1\n')
    err = told(capsys, str(file), "--t", "1")[2]
    assert "note: own: damping changes the energy at the rate −Σ κ |v|², and no momentum" in err
    turning = [
        x for name in ("zeta_1=0", "zeta_5=0", "zeta_2=1", "zeta_4=-1") for x in ("--set", name)
    ]
    assert "a fluid would tear" in told(capsys, "dirichlet", "--t", "1", *turning)[2]
    assert told(capsys, "sl3", "--t", "1", *turning)[2] == ""  # points: nothing that could tear


@pytest.mark.parametrize(
    ("about", "given", "why"),
    [
        ('L = "zeta_1^4 + zeta_2^2 + zeta_3^2"', "zeta_2=1", "second derivative of L in the vel"),
        ('L = "-sqrt(1 - zeta_1^2 - zeta_2^2 - zeta_3^2)"', "zeta_1=3", "the root of a negative"),
        ('L = "zeta_1^2 + zeta_2^2 + zeta_3^2"', "zeta_1=1e200", "too large, as 1e+200"),
    ],
)
@pytest.mark.filterwarnings("error")
def test_why_equations_have_no_finite_value(about, given, why, tmp_path, capsys):
    file = tmp_path / "own.toml"
    file.write_text(f'name = "own"\ngroup = "SO(3)"\n[lagrangian]\n{about}\n')
    code, out, err = told(capsys, str(file), "--t", "1", "--set", given)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert why in err
    assert "spring" not in err


def test_a_fluid_of_irrational_axes_keeps_its_circulation(tmp_path, capsys):
    path = tmp_path / "drop.toml"
    path.write_text(
        'name = "drop"\ngroup = "SL(3)"\n[body]\nsolid = "ellipsoid"\ndensity = 1\n'
        'quadric = [[1, "1/4", 0], ["1/4", 2, 0], [0, 0, 3]]\n[initial]\nzeta_2 = 1\n'
    )
    code, text, err = told(capsys, str(path), "--t", "1")
    assert (code, err) == (0, "")
    assert "circulation_3: " in text


def test_states_without_an_element_have_no_exponential():
    with pytest.raises(MotionError, match="no element of a group"):
        derive.derive("euler_poisson").simulate(1.0, exp=(1, 0, 0))


def test_motions_of_other_states():
    """Reduced states, the torus, a quotient."""
    kept = derive.derive("euler_poisson").simulate(
        2.0, start={"zeta_1": 1.0, "gamma_1": 1.0, "gamma_2": 0.5}, points=4
    )
    for column in kept.of_kind("conserved").values():
        assert np.ptp(column) < 1e-13
    waves = {"re_1_0": 1.0, "re_2_1": 0.5, "im_0_1": 0.25}
    torus = derive.derive("zeitlin").simulate(1.0, start=waves, points=2)
    assert np.ptp(torus["energy"]) < 1e-13
    rod = derive.derive("rod").simulate(1.0, start={"zeta_1": 1.0}, points=2)
    assert np.ptp(rod["energy"]) < 1e-13


# ---------------------------------------------------------------- an ℓ of no points


@pytest.mark.parametrize(
    ("m", "length", "g", "units"),
    [
        ("kg", "m", "m/s^2", {"t": "s", "zeta_1": "rad/s", "energy": "J"}),
        ("kg", "m", "N kg⁻¹", {"t": "s", "zeta_1": "rad/s", "energy": "J"}),
        ("g", "mm", "mm/s^2", {"t": "s", "zeta_1": "rad/s", "energy": ""}),
        ("slug", "ft", "ft/s^2", {"t": "s", "zeta_1": "rad/s", "energy": ""}),
        ("kg", "mm", "m/s^2", {"t": "s", "zeta_1": "rad/s", "energy": ""}),
        ("kg", "m", "m/ms^2", {"t": "", "zeta_1": "", "energy": ""}),
        ("kg", "m", "km/h/s", {"t": "", "zeta_1": "", "energy": ""}),
        ("kg", "m", "1000 m/s^2", {"t": "", "zeta_1": "", "energy": ""}),
        ("kg", "m", "some", {"t": "", "zeta_1": "", "energy": ""}),
        ("", "", "", {"t": "", "zeta_1": "", "energy": ""}),
    ],
)
def test_no_unit_is_told_that_those_of_the_parameters_do_not_give(m, length, g, units):
    text = f'''name = "hung"\ngroup = "SO(2)"\n[parameters]
m = {{ default = 50, unit = "{m}" }}
l = {{ default = 120, unit = "{length}" }}
g = {{ default = 9810, unit = "{g}" }}
[[point]]\nmass = "m"\nat = [0, "-l"]\n[[potential]]\nkind = "gravity"\ng = [0, "-g"]\n'''
    problem = problem_of(tomllib.loads(text))
    columns = motion_of(problem, walk(problem), "gauss").columns()
    assert units == {x.name: x.unit for x in columns if x.name in units}


IN = {"m": "kg", "l": "m", "J": "kg m^2", "c": "V"}
CART = "m*zeta_1^2/2 + m*l*cos(T_2)*zeta_1*zeta_2 + m*l^2*zeta_2^2/2 + 9.81*m*l*cos(T_2)"


@pytest.mark.parametrize(
    ("group", "L", "units"),
    [
        (
            "R(3)",
            CART + " + c*zeta_3^2",
            "T_1 [m], T_2 [rad], T_3, zeta_1 [m/s], zeta_2 [rad/s], zeta_3, "
            "momentum_1 [kg m/s], momentum_3, centre_3",
        ),
        ("R(1)", "J*zeta_1^2", "T_1 [rad], zeta_1 [rad/s], momentum_1 [kg m^2/s]"),
        ("R(1)", "m*zeta_1^2", "T_1 [m], zeta_1 [m/s], centre_1 [kg m]"),
        ("R(1)", "J*zeta_1^2 + m*zeta_1^2", "T_1, zeta_1"),
        ("R(1)", "zeta_1^2 + cos(3*T_1)", "T_1 [rad], zeta_1"),
        ("R(1)", "zeta_1^2 + cos(T_1/l)", "T_1 [m], zeta_1 [m/s]"),
        (
            "SO(3) x R(1)",
            "J*(zeta_1^2 + zeta_2^2 + 2*zeta_3^2) + J*(zeta_1 + zeta_4)^2",
            "A1_11, T2_1 [rad], zeta_3 [rad/s], zeta_4 [rad/s]",
        ),
        ("SE(2)", "J*zeta_1^2 + m*(zeta_2^2 + zeta_3^2)", "T_1 [m], zeta_1 [rad/s], zeta_2 [m/s]"),
    ],
)
def test_a_coordinate_is_a_length_or_an_angle_where_the_lagrangian_says_so(group, L, units):
    names = re.findall(r"\w+", L)
    units_of = {x: {"default": 0.5, "unit": unit} for x, unit in IN.items() if x in names}
    told = {"name": "told", "group": group, "parameters": units_of, "lagrangian": {"L": L}}
    problem = problem_of(told)
    columns = motion_of(problem, walk(problem), "gauss").columns()
    heads = {f"{x.name} [{x.unit}]" if x.unit else x.name for x in columns}
    assert {*units.split(", ")} <= heads


AWAY = """
name = "away"
group = "SE(3)"
[body]
given = { m = 10, centre = [0.5, 0.3, 0.4], I_centre = [[1, 0, 0], [0, 2, 0], [0, 0, 2.5]] }
[initial]
zeta_1 = 0.01
zeta_2 = 2
zeta_3 = 0.02
w_1 = -0.8
w_3 = 1.0
"""


def test_the_inertia_of_a_free_body_is_that_about_its_centre():
    """By what its motion keeps: the energy of turning and the length of the momentum, about the
    centre alone."""
    run = derived(AWAY).simulate(30.0, points=100)
    zeta = np.stack([run[f"zeta_{k}"] for k in (1, 2, 3)], axis=-1)
    momentum = zeta @ np.array(run.facts["body"]["inertia"])
    for kept in (np.sum(zeta * momentum, axis=1), np.linalg.norm(momentum, axis=1)):
        assert np.ptp(kept) < 1e-8 * kept[0]
    assert np.ptp(zeta[:, 1]) > 3  # it flips


def test_what_acts_at_the_numbers_of_the_parameters_changes_the_energy():
    product = ["mul", ["par", "a"], ["fun", "cos", ["mul", ["par", "w"], "t"]]]
    problem = {"potentials": [{"E": [product, 0]}], "damping": [{"coefficient": ["par", "c"]}]}
    all_of_them = {"a": 1.0, "w": 1.0, "c": 1.0}
    assert drives(problem, {}) == drives(problem, {}, all_of_them) == ["damping", "the time"]
    assert drives(problem, {}, all_of_them | {"c": 0.0}) == ["the time"]
    for name in "aw":
        assert drives(problem, {}, all_of_them | {name: 0.0}) == ["damping"]


TURNED = """
name = "turned"
group = "SO(3)"
[parameters]
a = 2.0
[lagrangian]
L = "{}"
"""
TENSOR = [[4, 1, 0], [1, 2, 0], [0, 0, 2]]


@pytest.mark.parametrize(
    ("L", "inertia"),
    [
        ("a*zeta_1^2 + zeta_1*zeta_2 + zeta_2^2 + zeta_3^2 - A_33", TENSOR),
        ("a*zeta_1^2 + zeta_2^2 + zeta_3^2 + a*zeta_3", None),
        ("a*zeta_1^2 + zeta_2^2 + (2 + A_33)*zeta_3^2", None),
        ("a*zeta_1^2 + zeta_2^2 + zeta_3^2 + zeta_3^4", None),
        ("a*zeta_1^2 + zeta_2^2 - zeta_3^2", None),
    ],
)
def test_a_quadratic_lagrangian_has_a_tensor_of_inertia(L, inertia):
    problem = problem_of(tomllib.loads(TURNED.format(L)))
    found = inertia_of(problem.lagrangian, {"a": 2.0})
    assert (found is None) == (inertia is None)
    assert found is None or found.tolist() == inertia


@pytest.mark.parametrize("name", ["so3", "se3", "two_tops", "sim3", "manakov"])
def test_far_starts_are_taken_to_the_nearest_rotation(name):
    """R of A = RP, P positive, whatever P is: with A = 1.8 a step of Newton's method overshoots."""
    d, rng = derive.derive(name), np.random.default_rng(7)
    code = motion_of(d.problem, d.record)
    for size in (1.8, 0.03, 1.0, 40.0):
        x, nearest = np.zeros((20, len(code.program.state))), []
        for block in code.program.blocks:
            n = round(len(block.places) ** 0.5)
            A = size * (np.eye(n) + 0.9 * (size != 1.8) * rng.normal(size=(20, n, n)))
            A[np.linalg.det(A) < 0, :, 0] *= -1
            x[:, list(block.places)] = A.reshape(20, -1)
            U, _, V = np.linalg.svd(A)
            nearest.append((block.places, n, U @ V))
        taken = taken_to_group(code.python.project, code.program.blocks, x)
        assert (code.python.defect(taken) < 1e-12).all()
        for places, n, R in nearest:
            A = taken[:, list(places)].reshape(20, n, n)
            scale = np.linalg.det(A)[:, None, None] ** (1 / n)
            assert np.allclose(A / scale, R, rtol=0, atol=1e-12)


def test_a_start_of_a_run_and_of_an_ensemble_is_the_nearest_rotation(free):
    start = {"A_11": 1.8, "A_22": 1.8, "zeta_1": 1.0}
    run = free.simulate(1.0, start=start, project=True, points=1)
    assert np.allclose(run.states[0, :9], np.eye(3).ravel(), rtol=0, atol=1e-15)
    fixed = {"A_22": 2.0, "zeta_1": 1.0}
    many = free.simulate(
        1e-9, start=fixed, ensemble=3, vary={"A_11": (1.7, 9)}, project=True, points=2
    )
    assert np.allclose(many.states[:, 0, :9], np.eye(3).ravel(), rtol=0, atol=1e-15)


def test_a_reflection_is_no_rotation():
    """Where its relations hold as well: in any block, with scale, and by the compiled code."""
    for name, entry, group in (("two_tops", "A2_33", "SO(3)"), ("sim3", "A_33", "Sim(3)")):
        with pytest.raises(MotionError, match=rf"a reflection is no element of {group[:-3]}"):
            derive.derive(name).simulate(1.0, start={entry: -1.0}, exp=())
    compiled = derive.compile("top", step="gauss", attitude="quaternion")
    with pytest.raises(ValueError, match="a reflection"):
        compiled.from_matrix([1, 0, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1.0])
    with pytest.raises(ValueError, match="a reflection"):
        derive.compile("top", step="gauss").begin([-1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 1.0])


def test_when_a_multiplier_is_negative():
    t = np.linspace(0, 5, 501)
    assert negative(t, t - 0.875) == "at t = 0 … 0.87, at 88 of 501 instants"
    assert negative(t, np.cos(t)) == "at t = 1.58 … 4.71, at 314 of 501 instants"
    assert negative(t, -np.sin(3 * t)).startswith("at t = 0.01 … 1.04 and later, at ")
    assert negative(t, t) == negative(t, 0 * t) == negative(t, t - 1e-15) == ""
