"""What ``--conserved`` adds is kept along motions, and is what the search found."""

from fractions import Fraction
from functools import cache, partial

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive.command.cli import main
from derive.command.showing import ready_made
from derive.language.rational import times, transposed
from derive.problem.toml import problem_of
from derive.python.derived import derive
from tests.oracles import general
from tests.support import library
from tests.support.emitted_files import Emission
from tests.support.walks import FLUIDS, record, repeated

WITHOUT = ("linear", "affine", "zeitlin", "imu", *FLUIDS)
"""About any group, or without matrices or a Lagrangian; on the torus see test_torus."""
APART = ("zeitlin", "euler_poisson", "jelly", "linear", "affine", "rod", "spherical_pendulum")
APART += ("riemann_ellipsoid", "imu", *FLUIDS)
"""Without symmetries, or with states of other numbers than the oracle has."""
NAMES = [x for x in ready_made() if x not in APART]
SHORT = dict.fromkeys(("se3", "hammer", "screw", "heisenberg", "sp4", "saff3", "sim3"), 5.0)
SHORT |= {"dirichlet": 5.0, "sl3": 10.0, "gl3": 0.2}
"""Falls and other motions without bounds, and one through a collapse of the body."""


module_of = partial(library.module_of, conserved=True)
"""The emitted Python of a problem."""


def start(name, module):
    """A random state of the group."""
    data = record(name).problem
    if "(" not in data["group"]:
        data = data | {"group": {"basis": data["basis"], "action": "affine"}}
    basis = np.array(module.BASIS, float)
    return general.random_state(data, basis, np.random.default_rng(7))


def at_rest(module):
    """The inputs where there are none."""
    return (np.zeros(len(module.INPUTS)),) if module.INPUTS else ()


def moved(module, x, last):
    """Times and states of a motion, at the defaults of the parameters."""
    k, u = module.constants(module.DEFAULTS), at_rest(module)
    found = solve_ivp(
        lambda t, x: module.rhs(t, x, k, *u), (0, last), x, method="DOP853", rtol=1e-12, atol=1e-12
    )
    assert found.success
    return k, found.t, found.y.T


def spread(values):
    """How far numbers move, in units of their size."""
    return (np.abs(values - values[0]).max(axis=0) / (1 + np.abs(values).max(axis=0))).max()


@pytest.mark.parametrize("name", repeated(NAMES, 3))
def test_every_number_is_kept_and_is_that_of_the_search(name):
    module = module_of(name)
    k, t, x = moved(module, start(name, module), SHORT.get(name, 50.0))
    kept = module.conserved(t, x, k)
    assert np.ptp(x, axis=0).max() > 0.1
    assert kept.shape == (len(t), len(module.CONSERVED))
    assert spread(kept) < 1e-9
    t, x = t[:5], x[:5]  # on the group as closely as rounding allows
    wanted = derive(name).symmetries().values(t, x)
    if "angular_momentum" in module.CONSERVED:  # by the turn about (g_1, g_2, g_3)
        along = np.linalg.norm([module.DEFAULTS[f"g_{k}"] for k in (1, 2, 3)])
        wanted[:, module.CONSERVED.index("angular_momentum")] /= along
    scale = 1 + np.abs(wanted).max(axis=0)
    assert (np.abs(kept[:5, : wanted.shape[1]] - wanted).max(axis=0) / scale).max() < 1e-12


def test_kovalevskaya_s_own_integral():
    """(p² − q² + (mgl/I) γ₁)² + (2pq + (mgl/I) γ₂)², with her signs: an oracle by hand."""
    module = module_of("kovalevskaya_top")
    rng = np.random.default_rng(2)
    x = np.concatenate([np.eye(3).ravel(), rng.normal(size=3)])
    k, t, x = moved(module, x, 20.0)
    moment, mgl = (module.DEFAULTS[x] for x in ("I", "mgl"))
    p, q = x[:, 9], x[:, 10]
    a, b = x[:, 6], x[:, 7]
    own = (p * p - q * q - mgl / moment * a) ** 2 + (2 * p * q - mgl / moment * b) ** 2
    assert spread(own[:, None]) < 1e-9
    found = module.conserved(t, x, k)[:, module.CONSERVED.index("integral_1")]
    # the same, times (2I)⁴, but for a multiple of the Casimir |γ|² = 1
    assert np.ptp(found - 16 * moment**4 * own) < 1e-8


TOP = """name = "top"
group = "GROUP"
[[point]]
mass = 1
at = [0.3, 0, 1]
[[point]]
mass = 1
at = [-0.3, 0, 1]
[[point]]
mass = 1
at = [0, 0.3, 1]
[[point]]
mass = 1
at = [0, -0.3, 1]
[[potential]]
kind = "gravity"
g = [0, 0, -9.81]
[[damping]]
coefficient = 0.2
"""


def validated(path, capsys):
    """The words that emit Python beside a file, which is equal to the record."""
    words = ["emit", str(path), "--conserved", "--lang", "python", "--out", str(path.parent)]
    assert main([*words, "--validate"]) == 0
    assert "conserved equal the record" in capsys.readouterr().err
    return words


def test_the_momentum_with_what_damping_takes(tmp_path, capsys):
    """p − m g t + Σ κ r of a free body, by hand; of two dampings, one on a place of the body."""
    path = tmp_path / "top.toml"
    text = TOP.replace("GROUP", "SE(3)") + '[[damping]]\ncoefficient = "k"\nat = [1, 0, 2]\n'
    path.write_text(text.replace("[[point]]", "[parameters]\nk = { default = 0.3 }\n[[point]]", 1))
    validated(path, capsys)
    module = library.module("top", (tmp_path / "top.py").read_text())
    assert module.CONSERVED == ("momentum_1", "momentum_2", "momentum_3")
    start = {"zeta_1": 1.0, "w_1": 2.0, "w_3": -1.0}
    run = derive(str(path)).simulate(1.0, points=4, start=start)
    A, T = run.states[:, :9].reshape(-1, 3, 3), run.states[:, 9:12]
    places = [[0.3, 0, 1], [-0.3, 0, 1], [0, 0.3, 1], [0, -0.3, 1]]
    zeta, w = run.states[:, 12:15], run.states[:, 15:18]
    speed = [np.einsum("tij,tj->ti", A, w + np.cross(zeta, r)) for r in places]
    at = [A @ r + T for r in [*places, [1, 0, 2]]]
    weight = 4 * np.outer(run.t, [0, 0, 9.81])
    expected = sum(speed) + weight + sum(k * r for k, r in zip([0.2] * 4 + [0.3], at, strict=True))
    found = np.transpose([run[f"momentum_{k}"] for k in (1, 2, 3)])
    assert np.allclose(found, expected, rtol=0, atol=1e-12)
    assert np.ptp(found, axis=0).max() < 1e-12 < 1 < np.ptp(sum(speed) + weight, axis=0).max()


@pytest.mark.parametrize("group", ["SO(3)", "SE(3)"])
def test_what_is_kept_with_damping(group, tmp_path, capsys):
    """A turn of the body about the axis that the damped point is on, and of a free body p + Σ κ r:
    where that is beside the axis, or all points are damped, nothing else."""
    path = tmp_path / "top.toml"
    head = TOP.replace("GROUP", group)
    path.write_text(head + "at = [0, 0, 1]\n")
    emit = validated(path, capsys)
    module = library.module("top", (tmp_path / "top.py").read_text())
    free = group == "SE(3)"
    momenta = ("momentum_1", "momentum_2", "momentum_3") if free else ()
    assert (*momenta, "body_angular_momentum_3") == module.CONSERVED
    start = ["--set", "zeta_1=1", "--set", "zeta_3=9"]
    assert main(["simulate", str(path), "--t", "1", *start, "--out", str(tmp_path / "r.csv")]) == 0
    assert "damping" not in capsys.readouterr().err
    kept = np.genfromtxt(tmp_path / "r.csv", delimiter=",", names=True)["body_angular_momentum_3"]
    assert np.ptp(kept) < 1e-9 < 1 < abs(kept[0])
    for at in ("at = [0, 0.1, 1]\n", ""):  # beside the axis, or all points
        path.write_text(head + at)
        assert main(emit) == (0 if free else 2)
        told = capsys.readouterr().err
        assert ("no momentum is known to be kept" in told) is not free
        assert "take" not in told


@cache
def emitted(name):
    return Emission(name, conserved=True)


def reports(name, change=lambda text: text):
    """The verdicts of the validator on emitted files, changed."""
    made = emitted(name)
    return made.reports({x: change(text) for x, text in made.files.items()})


@pytest.mark.parametrize("name", repeated([x for x in ready_made() if x not in WITHOUT], 4))
def test_proved_by_the_validator(name):
    for report in reports(name):
        assert report.holds, report.text
        assert "conserved" in report.text


def test_a_wrong_sign_is_seen():
    def change(text):
        at = text.rfind("(g_1*A_12 + g_2*A_22")  # in a header there is none
        return text[:at] + text[at:].replace("g_1*A_12 +", "g_1*A_12 -", 1)

    assert [x.holds for x in reports("so3", change)] == [False, False]
    assert all("is not kept" in x.text for x in reports("so3", change))


def test_a_number_that_says_nothing_is_seen():
    def change(text):
        at = text.rindex("out[0] = h_tilde;") if "out[0] = h_tilde;" in text else 0
        return text[:at] + text[at:].replace("out[0] = h_tilde;", "out[0] = 1.0;", 1)

    assert "says nothing" in reports("so3", change)[0].text


ANY_ENERGY = {  # of so(3), whose one Casimir is |Π|²
    "quartic": ("(zeta_1^4 + 2*zeta_2^4 + 3*zeta_3^4)/4 + zeta_1^2", ["energy", "casimir_1"]),
    "in time": ("zeta_1^2 + (2 + t^2)*zeta_2^2 + zeta_3^2", ["casimir_1"]),
    "root": ("zeta_1^2 + sqrt(2)*zeta_2^2 + zeta_3^2", ["energy", "casimir_1"]),
}


def on_algebra(text, algebra):
    return problem_of({"name": "test", "algebra": algebra, "lagrangian": {"L": text}})


@pytest.mark.parametrize("case", ANY_ENERGY)
def test_casimirs_whatever_the_energy(case):
    text, names = ANY_ENERGY[case]
    module = module_of(on_algebra(text, {"of": "SO(3)"}))
    assert list(module.CONSERVED) == names
    k, times, states = moved(module, np.array([0.3, 1.1, -0.7]), 5.0)
    kept = np.array([module.conserved(t, x, k) for t, x in zip(times, states, strict=True)])
    assert np.ptp(states, axis=0).max() > 0.1
    assert np.ptp(kept, axis=0).max() < 1e-9
    assert np.abs(kept[0]).min() > 0.1


def test_a_root_of_a_number_is_validated(tmp_path, capsys):
    file = tmp_path / "rooted.toml"
    text = 'name = "rooted"\n[algebra]\nof = "SO(3)"\n[lagrangian]\nL = "{}"\n'
    file.write_text(text.format(ANY_ENERGY["root"][0]), encoding="utf-8")
    validated(file, capsys)


def exactly(A, Z, J, Y):
    """Tr AZJĀȲ in fractions: p̃(Yg) of points with moments J."""
    A, Z, J, Y = ([[Fraction(x) for x in row] for row in m.tolist()] for m in (A, Z, J, Y))
    whole = A
    for m in (Z, J, transposed(A), transposed(Y)):
        whole = times(whole, m)
    return float(sum(whole[i][i] for i in range(3)))


def test_momenta_of_space_where_the_body_is_stretched():
    """By ν = gZ they lose the digits that (A, ζ) has lost, not those of A⁻¹ and ĀA as well."""
    module, rng = module_of("sl3"), np.random.default_rng(4)
    (left, _), (right, _) = (np.linalg.qr(rng.normal(size=(3, 3))) for _ in range(2))
    A, Z = left @ np.diag([1e4, 1.0, 1e-4]) @ right, rng.normal(size=(3, 3))
    Z[2, 2] = -Z[0, 0] - Z[1, 1]
    x, p = np.concatenate([A.ravel(), Z.ravel()[:8]]), module.DEFAULTS
    points = np.array([[p[f"{a}{i}"] for a in "xyz"] for i in range(1, 5)])
    masses = np.array([p[f"m{i}"] for i in range(1, 5)])
    J = np.einsum("i,ij,ik->jk", masses, points, points)
    kept = dict(zip(module.CONSERVED, module.conserved(0.0, x, module.constants(p)), strict=True))
    size = np.abs(A).max() ** 2 * np.abs(Z).max() * np.abs(J).max()
    for axis, (i, j) in enumerate(((1, 2), (2, 0), (0, 1)), 1):
        turn = np.zeros((3, 3))
        turn[j, i], turn[i, j] = 1.0, -1.0
        wanted = exactly(A, Z, J, turn)
        assert abs(kept[f"angular_momentum_{axis}"] - wanted) < 1e-14 * size
