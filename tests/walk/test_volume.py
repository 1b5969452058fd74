"""Energies of the volume, U(det A), beside Gauss's principle; and what is known of Dyson's gas."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive import Moments, Problem, Volume
from derive.problem.problem import ProblemError
from tests.support.emitted import arrange, import_python
from tests.support.kinds import agrees, cloud, moments

GAS = {"J_1": 0.7, "J_2": 0.4, "J_3": 0.9, "K": 0.6, "gamma": 5 / 3}


@pytest.mark.parametrize("group", ["GL(2)", "GL(3)", "Aff(2)", "Sim(3)", "GL(4)"])
def test_on_groups(group, tmp_path):
    """Two energies, one of the time as well, on groups with and without a multiplier."""
    forces = [Volume("k/2*(det_A - 1)^2"), Volume("a*sin(t)*exp(det_A)/(2 + det_A^2)")]
    problem = Problem("gas", group, Moments(), forces, parameters={"k": 2, "a": 0.3})
    masses, r = cloud(int(group[-2]), np.random.default_rng(1))

    def U(t, A, T):
        D = np.linalg.det(A)
        return (D - 1) ** 2 + 0.3 * np.sin(t) * np.exp(D) / (2 + D**2)

    agrees(problem, {"k": 2, "a": 0.3} | moments(masses, r), masses, r, U, tmp_path)


@pytest.fixture(scope="module")
def gas(tmp_path_factory):
    """The emitted module of gas_cloud, with the constants of GAS."""
    folder = tmp_path_factory.mktemp("gas")
    derive.derive("gas_cloud").emit(folder, ["python"])
    m = import_python("gas_cloud", folder)
    return m, m.constants(arrange(m, GAS))


def flight(gas, A, Z, times):
    """The states of gas_cloud at the times."""
    m, k = gas
    x0 = np.concatenate([np.ravel(A), np.ravel(Z)])
    found = solve_ivp(m.rhs, (0, times[-1]), x0, "DOP853", times, args=(k,), rtol=1e-13, atol=1e-14)
    return found.y.T


def test_a_round_cloud_obeys_its_own_equation(gas):
    """A = a 1 with J a multiple of 1: j a'' = K a^(2 - 3 gamma), and a second order ODE is all."""
    m, _ = gas
    values = GAS | {"J_1": 0.5, "J_2": 0.5, "J_3": 0.5, "gamma": 1.4}
    times = np.linspace(0, 3, 7)
    x = flight((m, m.constants(arrange(m, values))), np.eye(3), -0.4 * np.eye(3), times)
    radius = solve_ivp(
        lambda t, y: [y[1], values["K"] / 0.5 * y[0] ** (2 - 3 * 1.4)],
        (0, 3), [1, -0.4], "DOP853", times, rtol=1e-13, atol=1e-14,
    ).y[0]  # fmt: skip
    for a, row in zip(radius, x[:, :9], strict=True):
        assert row == pytest.approx(np.ravel(a * np.eye(3)), abs=1e-9 * a)


def test_a_monatomic_gas_grows_as_a_quadratic(gas):
    """Dyson; Anisimov and Lysikov: Tr AJA' = q + 2st + 2ht^2 for gamma = 5/3, whatever the spin."""
    m, k = gas
    rng = np.random.default_rng(5)
    A, Z = np.eye(3) + 0.2 * rng.normal(size=(3, 3)), rng.normal(size=(3, 3))
    J, times = np.diag([0.7, 0.4, 0.9]), np.linspace(0, 4, 9)
    x = flight(gas, A, Z, times)
    h, start = m.energy(0, x[0], k), x[0, :9].reshape(3, 3)
    grown = 2 * np.trace(start @ J @ (start @ Z).T)
    wanted = np.trace(start @ J @ start.T) + grown * times + 2 * h * times**2
    found = [np.trace(a.reshape(3, 3) @ J @ a.reshape(3, 3).T) for a in x[:, :9]]
    assert found == pytest.approx(wanted, rel=1e-9)


def test_circulation_and_angular_momentum_are_kept(gas):
    """CZ - Z'C, which the pressure does not move, whatever J; and the angular momentum in space."""
    J = np.diag([0.7, 0.4, 0.9])
    rng = np.random.default_rng(6)
    x = flight(gas, np.eye(3) + 0.2 * rng.normal(size=(3, 3)), rng.normal(size=(3, 3)), [0, 1, 2])
    kept = []
    for row in x:
        A, Z = row.reshape(2, 3, 3)
        B = A.T @ A @ Z
        spin = A @ Z @ J @ A.T
        kept.append(np.concatenate([B - B.T, spin - spin.T]))
    assert kept[1] == pytest.approx(kept[0], abs=1e-9)
    assert kept[2] == pytest.approx(kept[0], abs=1e-9)


@pytest.mark.parametrize(
    ("group", "U", "told"),
    [
        ("SL(3)", "det_A", r"volume needs one group that changes volumes.*det A = 1 on SL\(3\)"),
        ("SO(3)", "det_A", "det A = 1 on SO"),
        ("GL(2)", "2*t", "potential 1, U: no det_A"),
        ("GL(2)", "q*det_A", "'q' is not declared"),
        ("GL(2)", "det_A + r1_x", "'r1_x'"),
    ],
)
def test_refused(group, U, told):
    with pytest.raises(ProblemError, match=told):
        Problem("b", group, Moments(), [Volume(U)])


def test_no_product():
    points = derive.Points(*((1, e, 1) for e in np.eye(2).tolist()))
    points += derive.Points(*((1, e, 2) for e in np.eye(2).tolist()))
    with pytest.raises(ProblemError, match="is a product"):
        Problem("b", "GL(2) x GL(2)", points, [Volume("det_A")])
