"""Trims whose attitude is found: beside what Newton's laws say by hand, and what is refused."""

import tomllib
from fractions import Fraction

import numpy as np
import pytest

from derive import ProblemError, derive
from derive.check.claims.claim_checker import ClaimChecker
from derive.problem.toml import problem_of
from derive.record.sentence import Claim, english
from tests.check.test_record_claims import said
from tests.support.lagrangians import lagrangian
from tests.support.trims import PENDULUM, in_a_wind
from tests.support.walks import SEED

WIND = """
name = "hovering"
group = "SE(3)"
[parameters]
c = { default = 0.5 }
[body]
given = { m = 2, centre = [0, 0, 0], I_centre = [[1, 0, 0], [0, 2, 0], [0, 0, 3]] }
[[potential]]
kind = "gravity"
g = [0, 0, -10]
[[input]]
name = "f"
kind = "force"
at = [0, 0, 0]
frame = "body"
direction = [0, 0, 1]
[[force]]
name = "drag"
frame = "space"
at = [0, 0, 0]
relative_to = ["3", "4", "0"]
force = ["-c*SPEED*v_1", "-c*SPEED*v_2", "-c*SPEED*v_3"]
""".replace("SPEED", "sqrt(v_1^2+v_2^2+v_3^2)")
"""A rotor alone holds a body of mass 2 in a wind (3, 4, 0) with the drag −c‖v‖v, g = 10."""


def holds(found):
    return all(v.holds for v in found.check(SEED))


def attitude(found, n):
    state = found.found.state
    return np.array([[float(state[f"A_{i}{j}"]) for j in range(1, n + 1)] for i in range(1, n + 1)])


def test_a_drone_leans_into_the_wind():
    """In the plane: thrust (−sin θ, cos θ) f, drag c·5 along the wind, weight 20."""
    found = in_a_wind()
    theta = np.arctan2(2 * 5, 20)
    turned = [[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]]
    assert np.allclose(attitude(found, 2), turned, atol=1e-15)
    thrust = [float(found.found.inputs[x]) for x in "uv"]
    assert np.allclose(thrust, [np.hypot(10, 20) / 2] * 2, rtol=1e-15)
    assert (found.found.resting, holds(found)) == (True, True)
    assert "no others of ξ₁, ‘u’, ‘v’ do so" in english(found.record.steps[-1].prose)


def test_in_space_it_leans_about_a_horizontal_axis():
    """The third axis is along the sum of what acts, and the axis of the turn is horizontal."""
    found = derive(problem_of(tomllib.loads(WIND))).trim({}, ["eta_1", "eta_2", "f"])
    A, force = attitude(found, 3), 0.5 * 5 * np.array([3, 4, 0]) + [0, 0, -20]
    assert np.allclose(A @ A.T, np.eye(3), atol=1e-14)
    assert np.allclose(A[:, 2] * float(found.found.inputs["f"]), -force, atol=1e-13)
    assert np.allclose(A @ [4, -3, 0], [4, -3, 0], atol=1e-14)
    assert holds(found)


def test_an_angle_is_that_of_a_torque():
    """20 sin θ = 12."""
    found = derive(problem_of(PENDULUM)).trim({"u": 12}, ["eta_1"])
    assert found.found.state["A_21"] == Fraction(3, 5)
    assert (found.found.characteristic, found.verdict) == ((1, 3, 8), "stable")
    assert holds(found)


def test_it_turns_on_from_the_attitude_that_is_given():
    """The other angle of this torque: the pendulum stands aside."""
    upside_down = {"A_11": -1, "A_22": -1}
    found = derive(problem_of(PENDULUM)).trim(upside_down | {"u": 12}, ["eta_1"])
    assert found.found.state["A_11"] == Fraction(-4, 5)
    assert found.verdict == "unstable"
    assert holds(found)


@pytest.mark.parametrize("side", ["left", "right"])
def test_on_both_sides(side):
    """3 A₁₁ + 4 A₂₁ is largest along (3, 4), by the turn about axis 3 of the body or of space."""
    L = "(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2 + 3*A_11 + 4*A_21"
    found = derive(lagrangian(L, "SO(3)", side=side)).trim({}, ["eta_3"])
    assert (found.found.state["A_11"], found.found.state["A_21"]) == (
        Fraction(3, 5),
        Fraction(4, 5),
    )
    assert holds(found)


def test_that_others_turn_as_well_is_refused():
    """About the direction of the thrust it may turn as it likes."""
    several = ["eta_1", "eta_2", "eta_3", "f"]
    problem = problem_of(tomllib.loads(WIND))
    with pytest.raises(ProblemError, match="many trims"):
        derive(problem).trim({}, several)
    found = derive(problem).trim({}, ["eta_1", "eta_2", "f"])
    step, judge = found.record.steps[-1], ClaimChecker(found.record, SEED).fault
    (old,) = (x for x in step.claims if x.kind == "trim.isolated_with_turns")
    numbers = ("row", *(("entry", "ξ", a) for a in (1, 2, 3)), ("par", "f"))
    assert not judge(step)
    assert "others may do so" in judge(said(step, old, Claim(old.kind, (("numbers", numbers),))))


@pytest.mark.parametrize(
    ("free", "message"),
    [
        (["A_11"], "turns from there, as eta_1, are found"),
        (["eta_9"], "did you mean 'eta_3'"),
        (["eta_1", "f"], "no trim is found: .* for f, g, or free others"),
    ],
)
def test_what_is_not_found_is_said(free, message):
    with pytest.raises(ProblemError, match=message):
        derive(problem_of(tomllib.loads(WIND))).trim({}, free)


def test_an_attitude_that_is_no_element_is_refused():
    """Of SL(2) Cayley's transforms are elements: exp would be, for all groups; of SL(3) not all."""
    L = "(" + " + ".join(f"{k + 1}*zeta_{k + 1}^2" for k in range(8)) + ")/2 - (A_11 - 2)^2"
    with pytest.raises(ProblemError):
        derive(lagrangian(L, "SL(3)")).trim({}, ["eta_1"])
