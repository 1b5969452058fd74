"""Equilibria under inputs, also of which the attitude is found: beside what is known by hand, and
what is refused."""

from fractions import Fraction

import numpy as np
import pytest

from derive import ProblemError, derive
from derive import compile as compiled
from derive.check.checker import ClaimChecker
from derive.problem.toml import problem_of
from derive.record.sentence import Claim, english
from tests.check.test_record_claims import said
from tests.support.lagrangians import LINE, heavy, lagrangian, squares
from tests.support.trims import (
    DRONE,
    PENDULUM,
    TURNED,
    drifting,
    drone,
    holds,
    in_a_wind,
    leaning,
    upside_down,
)
from tests.support.walks import SEED


def test_a_torque_keeps_a_damped_pendulum_aside():
    """2 θ̈ = −20 sin θ − 6 θ̇ + u: u = 12, λ² + 3λ + 8, where cos θ = 4/5."""
    found = leaning()
    assert found.found.inputs == {"u": 12}
    assert found.found.characteristic == (1, 3, 8)
    assert (found.verdict, found.found.resting) == ("stable", True)
    assert max(x.real for x in found.eigenvalues) == pytest.approx(-1.5)
    assert holds(found)


def test_energy_claims_nothing():
    """A pendulum that hangs is stable, which its eigenvalues do not prove."""
    found = derive("pendulum").trim()
    assert found.found.characteristic == (1, 0, Fraction(981, 80))
    assert found.verdict == "open"
    assert holds(found)


def test_a_pendulum_stands_unstably():
    found = upside_down()
    assert found.found.characteristic == (1, 0, Fraction(-981, 80))
    assert (found.verdict, holds(found)) == ("unstable", True)


def test_a_steady_motion_is_no_rest():
    found = drifting()
    assert found.found.inputs == {"u": 10, "v": 10}
    assert "A steady motion" in english(found.record.steps[-1].prose)
    assert (found.found.resting, found.verdict, holds(found)) == (False, "open", True)


def test_the_rates_vanish_in_the_emitted_code():
    for found, problem in ((leaning(), PENDULUM), (drifting(), DRONE)):
        f = compiled(problem_of(problem))
        assert np.allclose(f(0.0, found.x, found.u)[-f._names.algebra :], 0, atol=1e-15)


def test_a_sleeping_top_has_the_frequencies_of_its_tilts():
    """Of moments 1, 1, 2 and weight ½, turning at 2: a small tilt τ, a complex number in space, has
    τ̈ = 4i τ̇ + τ/2, so the frequencies 2 ± √(7/2), and seen from the body these less 2."""
    found = derive(heavy("112", "A_33/2", "")).trim({"zeta_3": 2})
    assert found.found.characteristic == (1, 0, 7, 0, Fraction(49, 4), 0, 0)
    assert (found.verdict, holds(found)) == ("open", True)


def test_other_groups_and_sides():
    solid = squares(1, 2, 3, 1, 1, 1)
    for problem, at in (
        (lagrangian(squares(1, 2), LINE), {}),
        (lagrangian(solid, "SE(3)"), {"zeta_4": 1}),
        (lagrangian(solid, "SE(3)", side="right"), {"zeta_1": 1}),
        (lagrangian(solid, "SE(3)", side="right"), {"A_11": -1, "A_22": -1, "zeta_3": 1}),
    ):
        found = derive(problem).trim(at)
        assert (found.found.resting, holds(found)) == (not at, True)


def test_no_trim_says_which_rate_is_left():
    with pytest.raises(ProblemError, match=r"no trim: dzeta_1/dt is -6; no input is free$"):
        derive(problem_of(PENDULUM)).trim({**TURNED, "u": 0})
    with pytest.raises(ProblemError, match=r"dw_1/dt is -6, whatever u, v are"):
        drone().trim(TURNED)


def test_of_a_given_state_all_rates_are_told():
    """Forces 3 and 5 with arms of 1, against I = 3 and a weight of 20 on a mass of 2."""
    with pytest.raises(ProblemError, match=r"trim: dzeta_1/dt is -2/3, dw_2/dt is -6, all other"):
        drone().trim({"u": 3, "v": 5})
    assert drone().trim({"u": 10, "v": 10}).found.free == ()


def test_a_trim_out_of_bounds_is_refused():
    with pytest.raises(ProblemError, match=r"u is 10, and --bounds allows 0 to 8$"):
        drone().trim(bounds={"u": (0, 8), "v": (0, "21/2")})
    assert drone().trim(bounds={"u": (0, 10)}).found.inputs["u"] == 10
    with pytest.raises(ProblemError, match="uu is no number of the state"):
        drone().trim(bounds={"uu": (0, 1)})
    falling = heavy("112", "A_33/2", "")
    with pytest.raises(ProblemError, match="zeta_3 is 2, and --bounds allows -1 to 1"):
        derive(falling).trim({"zeta_3": 2}, bounds={"zeta_3": (-1, 1)})


def test_at_rest_all_of_the_velocity_is_told():
    said = english(derive("euler_top").trim().record.steps[-1].prose)
    assert "stays 0 with ζ₁ = 0, ζ₂ = 0, ζ₃ = 0, and" in said


def test_of_a_family_its_dimension_is_said():
    third = {"name": "z", "kind": "torque"}
    many = drone(input=[*DRONE["input"], third])
    with pytest.raises(ProblemError, match=r"a family of dimension 1, .* \(u, v, z\)"):
        many.trim()
    assert many.trim({"z": 2}).found.inputs == {"u": 9, "v": 11, "z": 2}


def test_a_velocity_that_stays_for_an_instant_is_refused():
    """Turning, it leans the next moment; a torque that is given changes nothing of that."""
    with pytest.raises(ProblemError, match="no steady motion is proved: dw_1/dt is 0 now"):
        drone().trim({"zeta_1": 1})


def test_a_parameter_is_given():
    """A pendulum of weight m g l sin θ: u = 3/5 · 10 m."""
    heavier = PENDULUM | {"parameters": {"m": 2}, "point": [{"mass": "m", "at": [0, -1]}]}
    made = derive(problem_of(heavier))
    assert made.trim(TURNED).found.inputs == {"u": 12}
    found = made.trim(TURNED, given={"m": 4})
    assert (found.found.inputs, found.found.characteristic) == ({"u": 24}, (1, Fraction(3, 2), 8))
    assert holds(found)


def test_what_acts_must_be_steady_smooth_and_linear():
    def acting(torque, **more):
        return PENDULUM | {"force": [{"covector": [torque]}]} | more

    parameter = {"parameters": {"k": {}}}
    for problem, why in (
        (acting("t"), "depends on the time"),
        (acting("abs(zeta_1)"), "has no derivative there"),
        (acting("k*zeta_1", **parameter), "k has no default"),
        (acting("u^2"), "several trims: u = 3; u = -4"),
    ):
        with pytest.raises(ProblemError, match=why):
            derive(problem_of(problem)).trim(TURNED)
    squared = derive(problem_of(acting("u^2"))).trim({**TURNED, "u": 3})
    assert squared.found.free == ()
    assert holds(squared)


def test_inputs_that_may_take_each_other_s_place_are_not_the_only_ones():
    third = {"name": "z", "kind": "torque"}
    record = drone(input=[*DRONE["input"], third]).trim({"z": 2}).record
    judge, step = ClaimChecker(record, SEED).fault, record.steps[-1]
    (told,) = (x for x in step.claims if x.kind == "trim.unique")
    more = Claim(told.kind, (("inputs", (*told["inputs"], ("par", "z"))),))
    assert not judge(step)
    assert "others do so as well" in judge(said(step, told, more))


ROTOR = {"name": "f", "kind": "force", "at": [0, 0, 0], "frame": "body", "direction": [0, 0, 1]}
MOMENTS = {"m": 2, "centre": [0, 0, 0], "I_centre": [[1, 0, 0], [0, 2, 0], [0, 0, 3]]}


def blown(*wind):
    """A rotor alone holds a body of mass 2 in a wind with the drag −c‖v‖v, g = 10."""
    drag = {"name": "drag", "frame": "space", "at": [0, 0, 0], "relative_to": [*wind]}
    drag["force"] = [f"-c*sqrt(v_1^2+v_2^2+v_3^2)*v_{k}" for k in (1, 2, 3)]
    gravity = {"kind": "gravity", "g": [0, 0, -10]}
    data = {"name": "hovering", "group": "SE(3)", "parameters": {"c": 0.5}}
    data |= {"body": {"given": MOMENTS}, "potential": [gravity], "input": [ROTOR], "force": [drag]}
    return problem_of(data)


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
    found = derive(blown(3, 4, 0)).trim({}, ["eta_1", "eta_2", "f"])
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


def test_bounds_choose_the_other_angle():
    """Both are told to be one near there; a body that hangs from its rotor is that in a wind."""
    made = derive(problem_of(PENDULUM))
    found = made.trim({"u": 12}, ["eta_1"], bounds={"A_11": (-1, 0)})
    assert [found.found.state[x] for x in ("A_11", "A_21")] == [Fraction(-4, 5), Fraction(3, 5)]
    assert "Elsewhere there may be others" in english(found.record.steps[-1].prose)
    assert holds(found)
    hanging = derive(blown(3, 4, 0)).trim({}, ["eta_1", "eta_2", "f"], bounds={"f": (-90, 0)})
    assert attitude(hanging, 3)[2, 2] < 0
    with pytest.raises(ProblemError, match="the trim that is found is out of bounds: A_11 is 4/5"):
        made.trim({"u": 12}, ["eta_1"], bounds={"A_11": (0, "1/2")})


def test_where_two_angles_meet_it_is_not_the_only_one():
    """20 sin θ = 20."""
    with pytest.raises(ProblemError, match=r"at eta_1 = 2 all rates are 0, and .* dependent"):
        derive(problem_of(PENDULUM)).trim({"u": 20}, ["eta_1"])


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
    problem = blown(3, 4, 0)
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
        (["eta_9"], "did you mean 'eta_6'"),
        (["eta_1", "f"], "no trim is found: .* for f, g, or free others"),
    ],
)
def test_what_is_not_found_is_said(free, message):
    with pytest.raises(ProblemError, match=message):
        derive(blown(3, 4, 0)).trim({}, free)


def test_a_velocity_by_its_other_name_says_which_it_is():
    """Of points translations are w, beside a Lagrangian the last of zeta."""
    with pytest.raises(ProblemError, match="no input; zeta_2 is w_1 here"):
        drone().trim({"zeta_2": 1})
    hull = derive(lagrangian(squares(1, 2, 3, 1, 1, 1), "SE(3)"))
    with pytest.raises(ProblemError, match="no input; w_3 is zeta_6 here"):
        hull.trim({}, ["w_3"])
    with pytest.raises(ValueError, match="has no 'w_3'; w_3 is zeta_6 here; its numbers"):
        hull.simulate(1, start={"w_3": 1})


def test_an_attitude_that_is_no_element_is_refused():
    """Of SL(2) Cayley's transforms are elements: exp would be, for all groups; of SL(3) diag(x, 1,
    1/x) is one, and others are none."""
    L = "(" + " + ".join(f"{k + 1}*zeta_{k + 1}^2" for k in range(8)) + ")/2 - (A_11 - 2)^2"
    made = derive(lagrangian(L, "SL(3)"))
    found = made.trim({}, ["eta_1"])
    assert [found.found.state[f"A_{k}{k}"] for k in (1, 2, 3)] == [2, 1, Fraction(1, 2)]
    assert holds(found)
    with pytest.raises(ProblemError, match="no element is Cayley's transform of a turn"):
        made.trim({}, ["eta_1", "eta_5"])


FREE = lagrangian("(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2")
TWO_ARMS = lagrangian("(zeta_1^2 + zeta_2^2)/2 + A1_11 + 2*A2_11", "SO(2) x SO(2)")


def axes(step):
    return [x for x in step.claims if x.kind.startswith("position.")]


def test_where_bodies_point():
    """A solid with axes e_1 ↦ e_2 ↦ e_3 ↦ e_1 turns about its third one; of two arms one stands."""
    found = derive(FREE).trim({"A_11": 0, "A_22": 0, "A_33": 0, "A_21": 1, "A_32": 1, "A_13": 1})
    assert len(axes(found.record.steps[-1])) == 3
    turned = {"A_11": 0, "A_22": 0, "A_33": 0, "A_21": 1, "A_32": 1, "A_13": 1, "zeta_3": 2}
    found = derive(FREE).trim(turned)
    step = found.record.steps[-1]
    (own,) = axes(step)
    assert own == Claim("position.along", (("axis", 3), ("space", 1)))
    assert "Axis 3 of the body points along axis 1 of space." in english(step.prose)
    checker = ClaimChecker(found.record, SEED)
    assert not checker.fault(step)
    for axis, space, why in ((1, 2, "the axis moves"), (3, 2, "elsewhere"), (4, 1, "no such")):
        wrong = Claim(own.kind, (("axis", axis), ("space", space)))
        assert why in checker.fault(said(step, own, wrong))
    found = derive(TWO_ARMS).trim({"A2_11": -1, "A2_22": -1})
    of_one = [dict(x.values) for x in axes(found.record.steps[-1])]
    assert of_one == [{"axis": k, "space": k, "body": 2} for k in (1, 2)]
    assert all(v.holds for v in found.check(1))
    assert not axes(derive(FREE).trim({}).record.steps[-1])
