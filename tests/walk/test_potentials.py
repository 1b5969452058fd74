"""Torsion, fields of charges, far centres and energies of the volume beside Gauss's principle; what
is known of each; and where they are refused."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import derive
from derive import SE, SO, Gravity, Moments, Points, Problem, Solid, Spring, Volume
from derive.problem.problem import ProblemError
from tests.support.emitted import arrange, import_python
from tests.support.kinds import agrees, cloud, moments
from tests.support.walks import own_verdicts

ANGLE = {"axis": [1, 2, 2], "angle": "b"}
ANGLES = {"k": 2.0, "b": 0.7, "g": 9.0}
TURNED = Rotation.from_rotvec(0.7 / 3 * np.array([1, 2, 2])).as_matrix()
BENT = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0.6, 0.8], [0, 0, -0.8, 0.6]]
CHARGES, E = ["q", "-q", 0, 2, 1], [1, "3*cos(w*t)", "q*t^2"]
CHARGED = {"q": 0.75, "w": 1.5}


def dimension(group):
    return int(group[-2])


def twisted(group):
    """Two torsion springs, one at rest at a rotation of a parameter, and gravity beside them."""
    forces = [derive.Torsion("k", ANGLE), derive.Torsion(0.5), Gravity(0, "-g", 0)]
    masses, r = cloud(3, np.random.default_rng(1))

    def U(t, A, T):
        weight = masses @ (r @ A[1] + T[1]) * ANGLES["g"]
        return np.trace(np.eye(3) - TURNED.T @ A) + np.trace(np.eye(3) - A) / 4 + weight

    return Problem("own", group, Moments(), forces, parameters=ANGLES), ANGLES, masses, r, U


def bent(group):
    """The same on matrices, of numbers."""
    rest = BENT if group == "SO(4)" else [[0, 1], [-1, 0]]
    n = len(rest)
    forces, masses_and_places = (
        [derive.Torsion("k", rest), derive.Torsion(0.5)],
        cloud(n, np.random.default_rng(1)),
    )

    def U(t, A, T):
        return np.trace(np.eye(n) - np.array(rest).T @ A) + np.trace(np.eye(n) - A) / 4

    problem = Problem("own", group, Moments(), forces, parameters={"k": 2})
    return problem, ANGLES, *masses_and_places, U


def charged(group):
    """Charges in a field that depends on the time, and a spring."""
    n = dimension(group)
    masses, r = cloud(n, np.random.default_rng(2), 5)
    body = Points(*((float(m), at.tolist()) for m, at in zip(masses, r, strict=True)))
    forces = [derive.Field(E[:n], CHARGES), Spring(1, 2, "q", 0.5)]
    q = np.array([0.75, -0.75, 0, 2, 1])

    def U(t, A, T):
        moved = r @ A.T + T
        apart = moved[0] - moved[1]
        spring = 0.75 * (np.sqrt(apart @ apart) - 0.5) ** 2 / 2
        return spring - q @ (moved @ np.array([1, 3 * np.cos(1.5 * t), 0.75 * t**2])[:n])

    return Problem("own", group, body, forces, parameters=CHARGED), CHARGED, masses, r, U


def expanded(mass, c, J, strength, centre):
    """U(t, A, T) of a far centre by the moments of the body."""

    def U(t, A, T):
        T = T - centre
        R = np.sqrt(T @ T)
        n, moved = T / R, A @ J @ A.T
        second = (3 * n @ moved @ n - np.trace(moved)) / (2 * R**3)
        return -strength * (mass / R - n @ A @ c / R**2 + second)

    return U


def attracted(group, centre=None):
    """c ≠ 0 and J general, near enough for all terms to count."""
    at = np.zeros(3) if centre is None else np.array([0.5, -1.0, 2.0])
    given = {"mu": 3.0} | ({} if centre is None else {"h": 0.5})
    forces = [derive.FarCentre("mu", centre), Gravity(0, 0, -1)]
    masses, r = cloud(3, np.random.default_rng(5))
    far = expanded(masses.sum(), masses @ r, r.T @ (masses[:, None] * r), 3.0, at)

    def U(t, A, T):
        return far(t, A, T) + masses @ (r @ A[2] + T[2])

    return Problem("own", group, Moments(), forces, parameters=given), given, masses, r, U


def swollen(group):
    """Two energies of the volume, one of the time as well, with a multiplier or without."""
    forces = [Volume("k/2*(det_A - 1)^2"), Volume("a*sin(t)*exp(det_A)/(2 + det_A^2)")]
    given = {"k": 2, "a": 0.3}

    def U(t, A, T):
        D = np.linalg.det(A)
        return (D - 1) ** 2 + 0.3 * np.sin(t) * np.exp(D) / (2 + D**2)

    body = cloud(dimension(group), np.random.default_rng(1))
    return Problem("own", group, Moments(), forces, parameters=given), given, *body, U


def aside(group):
    return attracted(group, ["h", -1, 2])


GROUPS = {
    twisted: ("SO(3)", "SE(3)"),
    bent: ("SO(4)", "SE(2)"),
    charged: ("SO(3)", "SE(3)", "SL(3)", "SAff(3)", "Aff(3)", "SE(2)", "GL(2)"),
    attracted: ("SE(3)", "SAff(3)", "Aff(3)", "Sim(3)"),
    aside: ("SE(3)", "SAff(3)", "Aff(3)", "Sim(3)"),
    swollen: ("GL(2)", "GL(3)", "Aff(2)", "Sim(3)", "GL(4)"),
}
CASES = [
    pytest.param(made, group, id=f"{made.__name__}: {group}")
    for made, groups in GROUPS.items()
    for group in groups
]


@pytest.mark.parametrize(("made", "group"), CASES)
def test_it_moves_as_gauss_says(made, group, tmp_path):
    problem, values, masses, r, U = made(group)
    values = values if problem.points else values | moments(masses, r)
    far = made in (attracted, aside)
    apart = (lambda T: np.add(T, [4, 3, 5])) if far else (lambda T: T)
    agrees(problem, values, masses, r, U, tmp_path, apart)


def test_the_energy_of_an_angle(tmp_path):
    """k(1 − cos θ) about any axis from R."""
    forces, values = [derive.Torsion("k", ANGLE)], {"k": 2, "b": 0.7}
    problem = Problem("ball", SO(3), Solid("ball", 1, radius=1), forces, values)
    derive.derive(problem).emit(tmp_path, ["python"])
    m = import_python("ball", tmp_path)
    theta = 1.1
    A = TURNED @ Rotation.from_rotvec(theta / 3 * np.array([2, -1, 2])).as_matrix()
    found = m.energy(0, np.append(A, np.zeros(3)), m.constants(arrange(m, values)))
    assert found == pytest.approx(2 * (1 - np.cos(theta)), rel=1e-12)


def test_what_a_far_centre_drops_is_of_the_fourth_order():
    """The formula less −GM Σ m_i/‖T + A r_i‖, at doubled distances."""
    masses, r = cloud(3, np.random.default_rng(7))
    rng = np.random.default_rng(8)
    A, direction = rng.normal(size=(3, 3)), rng.normal(size=3)
    J = r.T @ (masses[:, None] * r)
    U = expanded(masses.sum(), masses @ r, J, 2.0, np.zeros(3))

    def off(distance):
        T = distance * direction
        whole = -2.0 * np.sum(masses / np.linalg.norm(T + r @ A.T, axis=1))
        return abs(U(0, A, T) - whole)

    for far, farther in pairwise(off(100 * 2**k) for k in range(4)):
        assert 15 < far / farther < 17


# -- what is kept ---------------------------------------------------------------------------------


def test_the_angular_momentum_is_kept_about_a_centre_at_the_origin():
    def kept(*centre):
        problem = Problem("far", "SE(3)", Moments(), [derive.FarCentre(1, *centre)])
        return {e.lhs for e in derive.derive(problem).record["far.conserved"].equations}

    assert {"ḣ", "ℓ̇"} <= kept()
    assert "ℓ̇" not in kept([1, 0, 0])
    assert "ṗ" not in kept()


def in_field(*forces):
    """The labels of a solid in a field."""
    body = Points((1, [1, 0, 0]), (1, [0, 1, 0]), (1, [0, 0, 1]))
    record = derive.derive(Problem("b", "SO(3)", body, forces)).record
    assert all(v.holds for v in own_verdicts(record))
    return {s.label for s in record.steps}


def test_the_energy_is_kept_where_the_field_does_not_change():
    assert "b.conserved" in in_field(derive.Field([0, 0, 1], [1, 2, 3]))
    assert "b.conserved" not in in_field(derive.Field([0, 0, "cos(t)"], [1, 2, 3]))


GAS = {"J_1": 0.7, "J_2": 0.4, "J_3": 0.9, "K": 0.6, "gamma": 5 / 3}


@pytest.fixture(scope="module")
def gas(tmp_path_factory):
    """The emitted module of gas_cloud."""
    folder = tmp_path_factory.mktemp("gas")
    derive.derive("gas_cloud").emit(folder, ["python"])
    return import_python("gas_cloud", folder)


def flight(m, values, A, Z, times):
    """The states of gas_cloud at the times."""
    k, x0 = m.constants(arrange(m, values)), np.concatenate([np.ravel(A), np.ravel(Z)])
    found = solve_ivp(m.rhs, (0, times[-1]), x0, "DOP853", times, args=(k,), rtol=1e-13, atol=1e-14)
    return found.y.T


def test_a_round_cloud_obeys_its_own_equation(gas):
    """A = a 1 with J a multiple of 1: j a'' = K a^(2 - 3 gamma), and a second order ODE is all."""
    values = GAS | {"J_1": 0.5, "J_2": 0.5, "J_3": 0.5, "gamma": 1.4}
    times = np.linspace(0, 3, 7)
    x = flight(gas, values, np.eye(3), -0.4 * np.eye(3), times)
    radius = solve_ivp(
        lambda t, y: [y[1], values["K"] / 0.5 * y[0] ** (2 - 3 * 1.4)],
        (0, 3), [1, -0.4], "DOP853", times, rtol=1e-13, atol=1e-14,
    ).y[0]  # fmt: skip
    for a, row in zip(radius, x[:, :9], strict=True):
        assert row == pytest.approx(np.ravel(a * np.eye(3)), abs=1e-9 * a)


def test_a_monatomic_gas_grows_as_a_quadratic(gas):
    """Dyson; Anisimov and Lysikov: Tr AJA' = q + 2st + 2ht^2 for gamma = 5/3, whatever the spin."""
    rng = np.random.default_rng(5)
    A, Z = np.eye(3) + 0.2 * rng.normal(size=(3, 3)), rng.normal(size=(3, 3))
    J, times = np.diag([0.7, 0.4, 0.9]), np.linspace(0, 4, 9)
    x = flight(gas, GAS, A, Z, times)
    h, start = gas.energy(0, x[0], gas.constants(arrange(gas, GAS))), x[0, :9].reshape(3, 3)
    grown = 2 * np.trace(start @ J @ (start @ Z).T)
    wanted = np.trace(start @ J @ start.T) + grown * times + 2 * h * times**2
    found = [np.trace(a.reshape(3, 3) @ J @ a.reshape(3, 3).T) for a in x[:, :9]]
    assert found == pytest.approx(wanted, rel=1e-9)


# -- what is refused ------------------------------------------------------------------------------


def corners(n, *blocks):
    """Points on the axes, and one at the origin where there are no blocks."""
    axes = np.eye(n).tolist()
    listed = [(1, e, k) for k in blocks for e in axes] if blocks else [(1, e) for e in axes]
    return Points(*listed, *([] if blocks else [(1, [0] * n)]))


MANY = "torsion needs one group whose linear parts are rot"
SPACE = "far_centre needs a group with all translations of R"
CHANGED = "volume needs one group that changes volumes.*det A = 1 on SL\\(3\\)"
REFUSED = {  # group, body, forces, what is told
    "torsion on SL(3)": ("SL(3)", corners(3, 1), [derive.Torsion(1)], MANY),
    "torsion on Sim(3)": ("Sim(3)", corners(3, 1), [derive.Torsion(1)], MANY),
    "torsion on a product": ("SO(3) x SO(3)", corners(3, 1, 2), [derive.Torsion(1)], MANY),
    **{
        f"a rest that is {told}": (
            *(SE(3), Moments(), [derive.Torsion(1, rest)]),
            f"potential 1, rest: .*{told}|potential 1, {told}",
        )
        for rest, told in (
            ([[1, 0, 0], [0, 1, 0], [0, 0, 2]], "not orthogonal"),
            ([[1, 0, 0], [0, 1, 0], [0, 0, -1]], "a reflection"),
            ([[1, 0], [0, 1]], "a list of 3 rows"),
            ({"axis": [0, 0, 0], "angle": 1}, "rest: "),
        )
    },
    **{
        f"a field, {told}": (
            *("SO(3)", corners(3, 1), [derive.Field(field, charges)]),
            f"potential 1.*{told}",
        )
        for field, charges, told in (
            ([1, 0, 0], [1, 2], "charges: expected a list of 3 expressions"),
            ([1, 0], [1, 2, 3], "E: expected a list of 3 expressions"),
            (["r1_x", 0, 0], [1, 2, 3], "'r1_x' is known in the 'U' of an expression alone"),
            ([1, 0, 0], ["t", 2, 3], "'t'"),
        )
    },
    "a field and no points": (
        *("SE(3)", Moments(), [derive.Field([1, 0, 0], [])]),
        "'charges' is for \\[\\[point\\]\\] tables",
    ),
    **{
        f"a far centre on {x}": (x, corners(int(x[3])), [derive.FarCentre(1)], SPACE)
        for x in ("SO(3)", "SE(2)", "SL(3)")
    },
    "two far centres": (
        *("SE(3)", Moments(), [derive.FarCentre(1), derive.FarCentre(2, [1, 0, 0])]),
        "potential 2: a second far_centre",
    ),
    "a volume on SL(3)": ("SL(3)", Moments(), [Volume("det_A")], CHANGED),
    "a volume on SO(3)": ("SO(3)", Moments(), [Volume("det_A")], "det A = 1 on SO"),
    "a volume without det A": ("GL(2)", Moments(), [Volume("2*t")], "potential 1, U: no det_A"),
    "a volume of q": ("GL(2)", Moments(), [Volume("q*det_A")], "'q' is not declared"),
    "a volume and a place": ("GL(2)", Moments(), [Volume("det_A + r1_x")], "'r1_x'"),
    "a volume of a product": ("GL(2) x GL(2)", corners(2, 1, 2), [Volume("det_A")], "is a product"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case):
    group, body, forces, told = REFUSED[case]
    with pytest.raises(ProblemError, match=told):
        Problem("b", group, body, forces)
