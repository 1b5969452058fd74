"""The gravity of a far centre beside Gauss's principle, and beside the sum over the points."""

from itertools import pairwise

import numpy as np
import pytest

import derive
from derive import Moments, Points, Problem
from derive.problem.problem import ProblemError
from tests.support.kinds import agrees, cloud, moments

GROUPS = ("SE(3)", "SAff(3)", "Aff(3)", "Sim(3)")


def expanded(mass, c, J, strength, centre):
    """U(t, A, T) by the moments of the body."""

    def U(t, A, T):
        T = T - centre
        R = np.sqrt(T @ T)
        n, moved = T / R, A @ J @ A.T
        second = (3 * n @ moved @ n - np.trace(moved)) / (2 * R**3)
        return -strength * (mass / R - n @ A @ c / R**2 + second)

    return U


@pytest.mark.parametrize("group", GROUPS)
@pytest.mark.parametrize("centre", [None, ["h", -1, 2]])
def test_of_any_moments(group, centre, tmp_path):
    """c ≠ 0 and J general, near enough for all terms to count."""
    at = np.zeros(3) if centre is None else np.array([0.5, -1.0, 2.0])
    given = {"mu": 3.0} | ({} if centre is None else {"h": 0.5})
    forces = [derive.FarCentre("mu", centre), derive.Gravity(0, 0, -1)]
    problem = Problem("far", group, Moments(), forces, parameters=given)
    masses, r = cloud(3, np.random.default_rng(5))
    J = r.T @ (masses[:, None] * r)
    far = expanded(masses.sum(), masses @ r, J, 3.0, at)

    def U(t, A, T):
        return far(t, A, T) + masses @ (r @ A[2] + T[2])

    values = given | moments(masses, r)
    agrees(problem, values, masses, r, U, tmp_path, lambda T: np.add(T, [4, 3, 5]))


def test_what_is_dropped_is_of_the_fourth_order():
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

    errors = [off(100 * 2**k) for k in range(4)]
    for far, farther in pairwise(errors):
        assert 15 < far / farther < 17


def test_the_angular_momentum_is_kept_about_a_centre_at_the_origin():
    def kept(*centre):
        problem = Problem("far", "SE(3)", Moments(), [derive.FarCentre(1, *centre)])
        steps = {s.label: s for s in derive.derive(problem).record.steps}
        return {e.lhs for e in steps["far.conserved"].equations}

    assert {"ḣ", "ℓ̇"} <= kept()
    assert "ℓ̇" not in kept([1, 0, 0])
    assert "ṗ" not in kept()


@pytest.mark.parametrize("group", ["SO(3)", "SE(2)", "SL(3)"])
def test_where_there_is_no_T_in_space(group):
    n = int(group[3])
    body = Points(*((1, at) for at in (*np.eye(n).tolist(), [0] * n)))
    with pytest.raises(ProblemError, match="far_centre needs a group with all translations of R"):
        Problem("b", group, body, [derive.FarCentre(1)])


def test_there_is_one():
    with pytest.raises(ProblemError, match="potential 2: a second far_centre"):
        Problem("b", "SE(3)", Moments(), [derive.FarCentre(1), derive.FarCentre(2, [1, 0, 0])])
