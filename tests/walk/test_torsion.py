"""Torsion springs, ½ k Tr(1 − R̄A), beside Gauss's principle; in R³ U = k(1 − cos θ)."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import derive
from derive import SE, SO, Gravity, Moments, Problem, Solid
from derive.problem.problem import ProblemError
from tests.support.emitted import arrange, import_python
from tests.support.kinds import agrees, cloud, moments

ANGLE = {"axis": [1, 2, 2], "angle": "b"}
VALUES = {"k": 2.0, "b": 0.7, "g": 9.0}
TURNED = Rotation.from_rotvec(0.7 / 3 * np.array([1, 2, 2])).as_matrix()
BENT = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0.6, 0.8], [0, 0, -0.8, 0.6]]


@pytest.mark.parametrize("group", ["SO(3)", "SE(3)"])
def test_in_vectors(group, tmp_path):
    """Two springs, one at rest at a rotation of a parameter, and gravity beside them."""
    forces = [derive.Torsion("k", ANGLE), derive.Torsion(0.5), Gravity(0, "-g", 0)]
    problem = Problem("pivot", group, Moments(), forces, parameters=VALUES)
    masses, r = cloud(3, np.random.default_rng(1))

    def U(t, A, T):
        weight = masses @ (r @ A[1] + T[1]) * VALUES["g"]
        return np.trace(np.eye(3) - TURNED.T @ A) + np.trace(np.eye(3) - A) / 4 + weight

    agrees(problem, VALUES | moments(masses, r), masses, r, U, tmp_path)


@pytest.mark.parametrize(("group", "rest"), [("SO(4)", BENT), ("SE(2)", [[0, 1], [-1, 0]])])
def test_on_matrices(group, rest, tmp_path):
    n = len(rest)
    forces = [derive.Torsion("k", rest), derive.Torsion(0.5)]
    problem = Problem("turned", group, Moments(), forces, parameters={"k": 2})
    masses, r = cloud(n, np.random.default_rng(1))

    def U(t, A, T):
        return np.trace(np.eye(n) - np.array(rest).T @ A) + np.trace(np.eye(n) - A) / 4

    agrees(problem, VALUES | moments(masses, r), masses, r, U, tmp_path)


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


@pytest.mark.parametrize("group", ["SL(3)", "Sim(3)", "SO(3) x SO(3)"])
def test_where_linear_parts_are_no_rotations(group):
    body = derive.Points(*((1, list(e), k) for k in (1,) for e in np.eye(3).tolist()))
    if "x" in group:
        body += derive.Points(*((1, list(e), 2) for e in np.eye(3).tolist()))
    with pytest.raises(ProblemError, match="torsion needs one group whose linear parts are rot"):
        Problem("b", group, body, [derive.Torsion(1)])


@pytest.mark.parametrize(
    ("rest", "told"),
    [
        ([[1, 0, 0], [0, 1, 0], [0, 0, 2]], "not orthogonal"),
        ([[1, 0, 0], [0, 1, 0], [0, 0, -1]], "a reflection"),
        ([[1, 0], [0, 1]], "a list of 3 rows"),
        ({"axis": [0, 0, 0], "angle": 1}, "rest: "),
    ],
)
def test_a_rest_that_is_no_rotation(rest, told):
    with pytest.raises(ProblemError, match=f"potential 1, rest: .*{told}|potential 1, {told}"):
        Problem("b", SE(3), Moments(), [derive.Torsion(1, rest)])
