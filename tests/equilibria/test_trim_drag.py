"""Trims with roots of the state, as of a quadratic drag, and velocities that are found: beside
closed forms, and eigenvalues by finite differences of equations written by hand."""

import re
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from derive import ProblemError, derive
from derive.check.checker import ClaimChecker
from derive.language.tree import add
from derive.problem.toml import problem_of
from derive.record.sentence import Claim, english
from tests.check.test_record_claims import said
from tests.support.coadjoint_orbits import match
from tests.support.trims import ASIDE, DRAG, PENDULUM, TURNED, balanced, drone, flying, holds
from tests.support.walks import SEED


def falling(*damping, **more):
    return flying(*damping, input=[], **more)


def told(found):
    return english(found.record.steps[-1].prose)


def rates(y, u, c):
    """θ̈ and v̇ in space of the drone, by Newton: y is θ, v_1, v_2, θ̇."""
    theta, v, turning = y[0], y[1:3], y[3]
    push = sum(u) * np.array([-np.sin(theta), np.cos(theta)])
    force = push - c * np.hypot(*v) * v - [0, 20]
    return np.array([turning, *(force / 2), (u[0] - u[1]) / 3])


def eigenvalues_of(y, u, c):
    """By central differences."""
    h = 1e-5
    columns = [(rates(y + e, u, c) - rates(y - e, u, c)) / (2 * h) for e in h * np.eye(4)]
    return np.linalg.eigvals(np.array(columns).T)


def ahead(**more):
    """At the speed 5 it leans so that drag is balanced: tan θ = −c v²/mg = −3/4."""
    return flying(**more).trim(ASIDE | {"w_1": 4, "w_2": 3})


def test_a_drone_flies_ahead_against_its_drag():
    found = ahead()
    assert found.found.inputs == {"u": Fraction(25, 2), "v": Fraction(25, 2)}
    assert (found.found.resting, found.found.corner, holds(found)) == (False, False, True)
    y = np.array([np.arctan2(-3, 4), 5, 0, 0])
    assert np.allclose(rates(y, (12.5, 12.5), 0.6), 0, atol=1e-12)
    # the place adds two eigenvalues 0; four of one value 0 are found to the fourth root of rounding
    assert match(found.eigenvalues, [*eigenvalues_of(y, (12.5, 12.5), 0.6), 0, 0], 1e-3)


def test_the_speed_is_found_at_which_a_tilt_is_balanced():
    found = balanced()
    assert {x: found.found.state[x] for x in ("w_1", "w_2")} == {"w_1": 4, "w_2": 3}
    assert found.found.characteristic == ahead().found.characteristic
    assert "Near these numbers no others of w₁, w₂ do so" in told(found)
    assert holds(found)


def test_of_the_thrust_alone_the_drag_determines_both_velocity_and_rotors():
    """A body that climbs straight, 1/3 √30: c v² = u + v − mg with u = v = 11."""
    found = flying().trim({"u": 11}, ["w_2", "v"])
    assert found.found.inputs == {"u": 11, "v": 11}
    assert float(found.found.state["w_2"]) == pytest.approx(np.sqrt(2 / 0.6), rel=1e-14)
    assert holds(found)


@pytest.mark.parametrize(
    ("damping", "c", "speed"),
    [
        ([DRAG], 0.8, 5.0),
        ([DRAG], 0.6, np.sqrt(20 / 0.6)),
        ([DRAG, {"coefficient": 1, "at": [0, 0]}], 0.5, np.sqrt(41) - 1),
    ],
)
def test_a_body_falls_at_its_terminal_speed(damping, c, speed):
    """√(mg/c); c v² + v = mg with a friction beside."""
    found = falling(*damping, c=c).trim({}, ["w_2"])
    assert float(found.found.state["w_2"]) == pytest.approx(-speed, rel=1e-14)
    assert holds(found)
    linear = 1 if len(damping) > 1 else 0
    slopes = -np.array([2 * c * speed + linear, c * speed + linear]) / 2  # along v, and across
    assert match([x for x in found.eigenvalues if abs(x) > 1e-3], slopes, 1e-9)


def blown(along, **more):
    """A body that falls in a wind that blows ahead, with a drag −‖v‖v on the air."""
    law = {"relative_to": along, "at": [0, 0], "frame": "space"}
    law["force"] = [f"-hypot(v_1, v_2)*v_{k}" for k in (1, 2)]
    return drone(force=[law], **more)


def test_in_a_wind_it_falls_at_the_speed_that_it_has_without():
    """It goes with the wind, and at √20 down, where the drag on the air is its weight."""
    found = blown([4, 0], input=[]).trim({"w_1": 4}, ["w_2"])
    assert "w₁ = 4, w₂ = −2 √(5)" in told(found)
    assert holds(found)


def test_constants_may_have_a_root_where_a_velocity_is_found():
    """Drag and weight have the factor √2 alike: ‖v‖v = 16, with m = 2 and g = 8√2."""
    law = {"at": [0, 0], "frame": "space"}
    law["force"] = [f"-sqrt(k)*hypot(v_1, v_2)*v_{i}" for i in (1, 2)]
    more = {"parameters": {"k": 2}, "force": [law], "input": []}
    found = drone(potential=[{"kind": "gravity", "g": [0, "-8*sqrt(k)"]}], **more).trim({}, ["w_2"])
    assert "w₂ = −4" in told(found)
    assert holds(found)


def test_a_turn_in_a_wind_is_no_steady_motion():
    """Thrust holds it on a circle, and now the air beside it is at rest: a moment later it is not;
    the checker says so, too, of one who claims it."""
    found = blown([4, 0], potential=[])
    with pytest.raises(ProblemError, match=r"no steady motion is proved: dw_\d/dt is 0 now"):
        found.trim({"w_1": 4, "zeta_1": 1})
    now = ((("entry", "w", 1), 4), (("entry", "ζ", 1), 1), (("par", "u"), 4), (("par", "v"), 4))
    claim = Claim("trim.steady", (("point", ("matrix", *(("row", *x) for x in now))),))
    judge = ClaimChecker(found.record, SEED)._fault
    assert "may be other where the motion takes g" in judge(found.record.steps[-1], claim)


def test_at_rest_a_drag_changes_nothing_of_the_first_order():
    with_drag, without = flying().trim(), flying({"coefficient": 0, "at": [0, 0]}).trim()
    assert with_drag.found.inputs == without.found.inputs == {"u": 10, "v": 10}
    assert with_drag.found.characteristic == without.found.characteristic
    assert (with_drag.found.corner, without.found.corner) == (True, False)
    assert "A root that is 0 there has no derivative" in told(with_drag)
    assert holds(with_drag)


def test_an_absolute_value_is_that_of_an_expression_of_the_state():
    """2 θ̈ = −20 sin θ − ζ|ζ| + u: at rest as without, of the same eigenvalues."""
    bent = PENDULUM | {"force": [{"covector": ["-zeta_1*abs(zeta_1)"]}]}
    found = derive(problem_of(bent)).trim(TURNED)
    assert (found.found.inputs, found.found.characteristic) == ({"u": 12}, (1, 3, 8))
    assert (found.verdict, found.found.corner, holds(found)) == ("stable", True, True)


def test_a_spring_with_a_length_and_a_tilt_by_60_degrees():
    """Of the length 5/2 from (√3/2, 1/2)·1 m: roots of one field."""
    spring = {"kind": "spring", "at": [0, -1], "anchor": [0, 0], "stiffness": 7, "length": "1/3"}
    tilted = {"A_11": "1/2", "A_12": "-sqrt(3)/2", "A_21": "sqrt(3)/2", "A_22": "1/2"}
    problem = PENDULUM | {"potential": [*PENDULUM["potential"], spring]}
    found = derive(problem_of(problem)).trim(tilted)
    assert float(found.found.inputs["u"]) == pytest.approx(20 * np.sqrt(3) / 2)
    assert found.found.characteristic == (1, 3, 5)
    assert (found.verdict, holds(found)) == ("stable", True)


@pytest.mark.parametrize(
    ("torque", "why"),
    [
        ("-abs(zeta_1)", "dzeta_1/dt has no derivative there: a root is 0"),
        ("-zeta_1/abs(zeta_1)", "no value in this state: it divides by 0"),
    ],
)
def test_roots_without_a_derivative_are_refused(torque, why):
    problem = PENDULUM | {"force": [{"covector": [torque]}]}
    with pytest.raises(ProblemError, match=why):
        derive(problem_of(problem)).trim(TURNED)


@pytest.mark.parametrize(
    ("angle", "why"),
    [((1, 0), "the mass matrix is singular in this state"), ((0, 1), "no trim: dzeta_1/dt")],
)
def test_a_singular_mass_matrix_is_no_force_without_value(angle, why):
    """A bob on a rail without mass: where it hangs, the rail and the bob go along one line."""
    energy = "zeta_1^2/2 + A2_11*zeta_1*zeta_2 + zeta_2^2/2 + A2_11 - T1_1"
    cart = {"name": "cart", "group": "R(1) x SO(2)", "lagrangian": {"L": energy}}
    c, s = angle
    at = {"A2_11": c, "A2_12": -s, "A2_21": s, "A2_22": c}
    with pytest.raises(ProblemError, match=why):
        derive(problem_of(cart)).trim(at)


def test_velocities_that_are_not_found_are_refused_in_one_line():
    kept = falling({"coefficient": 0, "at": [0, 0]}, potential=[])
    for made, at, free, why in (
        (flying(), {}, ["A_11"], "--free A_11: of g, which --at gives"),
        (flying(), {"w_1": 1}, ["w_1", "w_2"], "--at gives some of the velocities that are free"),
        (falling({"coefficient": 0, "at": [0, 0]}), {}, ["w_2"], "no trim is found"),
        (kept, {}, ["w_1"], "many trims: no rate changes with w_1, of which any will do"),
        (flying(), {"w_1": 1, "w_2": 1} | ASIDE, ["w_1", "w_2", "u", "v"], "many trims: near w_1"),
    ):
        with pytest.raises(ProblemError, match=why):
            made.trim(at, free)


def test_several_velocities_are_told_and_one_is_chosen():
    """A rotor of which the torque is 2 − ζ²/2: ζ = ±2."""
    problem = {"name": "spun", "group": "SO(2)", "point": [{"mass": 1, "at": [1, 0]}]}
    problem["force"] = [{"covector": ["2 - zeta_1^2/2"]}]
    made = derive(problem_of(problem))
    with pytest.raises(ProblemError, match=r"several trims: zeta_1 = 2; zeta_1 = -2; say near"):
        made.trim({}, ["zeta_1"])
    found = made.trim({"zeta_1": "-3"}, ["zeta_1"])
    assert (found.found.state["zeta_1"], found.verdict, holds(found)) == (-2, "unstable", True)


def test_at_a_double_root_it_is_said_what_is_proved():
    """−4 + 4ζ − ζ|ζ| = −(ζ − 2)² for ζ > 0: the rate is 0 at 2, exactly, and so is its slope."""
    problem = {"name": "spun", "group": "SO(2)", "point": [{"mass": 1, "at": [1, 0]}]}
    problem["force"] = [{"covector": ["4*zeta_1 - abs(zeta_1)*zeta_1 - 4"]}]
    made = derive(problem_of(problem))
    with pytest.raises(ProblemError, match=r"at zeta_1 = 2 all rates are 0, and their derivatives"):
        made.trim({"zeta_1": "1.9"}, ["zeta_1"])
    assert holds(made.trim({"zeta_1": 2}))
    other = made.trim({"zeta_1": -5}, ["zeta_1"]).found.state["zeta_1"]
    assert float(other) == pytest.approx(-2 - 2 * np.sqrt(2), rel=1e-14)


DOUBLE = "-(zeta_1 - 3)^2*(zeta_1 + 1)"


def moved(*covector):
    """A body on a line, or in a space, of mass 1, with these forces along its axes."""
    n = len(covector)
    point = [{"mass": 1, "at": [0] * n}]
    problem = {"name": "moved", "group": f"R({n})", "point": point}
    return derive(problem_of(problem | {"force": [{"covector": [*covector]}]}))


@pytest.mark.parametrize(
    ("made", "at", "free", "where"),
    [
        (lambda: falling(potential=[]), {}, ["w_2"], "w_2 = 0"),
        (lambda: falling(potential=[]), {}, ["w_1", "w_2"], "w_1 = 0, w_2 = 0"),
        (lambda: moved(DOUBLE), {"zeta_1": 3}, ["zeta_1"], "zeta_1 = 3"),
        (lambda: moved("(zeta_1^2 - 1)^2"), {"zeta_1": 2}, ["zeta_1"], "zeta_1 = 1"),
        # Newton’s step leaves out 10⁻¹³ζ₂² beside 1: it is not 0 for that
        (
            lambda: moved("zeta_1 - 1", "zeta_2^2/10^13"),
            {"zeta_1": 1, "zeta_2": 0},
            ["zeta_1", "zeta_2"],
            "zeta_1 = 1, zeta_2 = 0",
        ),
    ],
)
def test_a_double_root_is_no_family(made, at, free, where):
    with pytest.raises(ProblemError, match=f"at {where} all rates are 0, and") as error:
        made().trim(at, free)
    assert "that there are no others near is not proved" in str(error.value)


def test_of_a_family_another_is_told_which_is_one():
    """Of 25 − ζ₁² − ζ₂² and 0: a circle."""
    circle = moved("25 - zeta_1^2 - zeta_2^2", "0*zeta_1")
    with pytest.raises(ProblemError, match=r"many trims: near .* a family of dimension 1") as error:
        circle.trim({"zeta_1": 3, "zeta_2": 4}, ["zeta_1", "zeta_2"])
    words = re.findall(r"zeta_\d = ([-.\d]+)", str(error.value))
    a, b, c, d = map(float, words)
    assert (a, b) != pytest.approx((c, d), abs=0.5)
    assert np.allclose([np.hypot(a, b), np.hypot(c, d)], 5, atol=1e-4)


def test_numbers_in_functions_are_enclosed():
    problem = PENDULUM | {"force": [{"covector": ["-exp(-2)"]}]}
    found = derive(problem_of(problem)).trim(TURNED)
    assert abs(float(found.found.inputs["u"]) - 12 - np.exp(-2)) <= found.found.radius < 1e-8
    assert holds(found)


def test_functions_of_an_angle_that_is_0_are_exact():
    """Beside a drag, whose root is 0 at rest; of another angle they are not."""
    problem = PENDULUM | {
        "parameters": {**PENDULUM.get("parameters", {}), "beta": 0},
        "force": [{"covector": ["3*cos(beta) - exp(beta) + sin(beta)"]}],
    }
    found = derive(problem_of(problem)).trim(TURNED)
    assert found.found.inputs["u"] == 10
    assert holds(found)


@pytest.mark.parametrize(
    ("torque", "u"),
    [
        ("-sqrt(2 + zeta_1) - sqrt(3 + zeta_1)", 12 + np.sqrt(2) + np.sqrt(3)),
        ("-sqrt(1 + sqrt(2 + zeta_1))", 12 + np.sqrt(1 + np.sqrt(2))),
    ],
)
def test_roots_of_two_fields_are_enclosed(torque, u):
    problem = PENDULUM | {"force": [{"covector": [torque]}]}
    found = derive(problem_of(problem)).trim(TURNED)
    assert abs(float(found.found.inputs["u"]) - u) <= found.found.radius < 1e-8
    assert holds(found)


# -- the checker ----------------------------------------------------------------------------------


def faults(found, kind, claim):
    """What is wrong with another claim in the place of one of a kind."""
    judge, step = ClaimChecker(found.record, SEED).fault, found.record.steps[-1]
    (old,) = (x for x in step.claims if x.kind == kind)
    assert not judge(step)
    return judge(said(step, old, claim))


def test_another_speed_is_refused():
    found = falling().trim({}, ["w_2"])
    for w in (-5, ("mul", Fraction(-9, 3), ("fun", "sqrt", 3))):
        point = ("matrix", ("row", ("entry", "w", 2), w))
        assert "a rate does not vanish there" in faults(
            found, "trim.steady", Claim("trim.steady", (("point", point),))
        )


def test_another_polynomial_is_refused_and_one_of_any_degree():
    found = falling().trim({}, ["w_2"])
    (claim,) = (x for x in found.record.steps[-1].claims if x.kind == "trim.open")
    more = add(claim["polynomial"], 1)
    kind = claim.kind
    assert "is another" in faults(found, kind, Claim(kind, (("polynomial", more),)))
    for degree in (10**9, -1, Fraction(1, 2)):
        high = Claim(kind, (("polynomial", ("pow", "λ", degree)),))
        assert faults(found, kind, high)


def test_numbers_that_others_may_replace_are_not_isolated():
    """With the thrust free it climbs, at another speed."""
    w, push = [("entry", "w", k) for k in (1, 2)], [("par", x) for x in ("u", "v")]
    more = Claim("trim.isolated", (("numbers", ("row", *w, *push)),))
    assert "others may do so near there" in faults(balanced(), "trim.isolated", more)


def test_no_corner_is_told_where_no_root_is_0():
    found = ahead()
    step = found.record.steps[-1]
    judge = ClaimChecker(found.record, SEED)._fault
    assert "no root is 0 there" in judge(step, Claim("trim.corner"))


def test_rates_without_a_derivative_are_refused():
    """The step of a drag ζ|ζ| in the record of one of |ζ|: at rest both rates vanish alike."""

    def record(torque):
        problem = PENDULUM | {"force": [{"covector": [torque]}]}
        return derive(problem_of(problem))

    good, bad = record("-zeta_1*abs(zeta_1)").trim(TURNED).record, record("-abs(zeta_1)").record
    step = good.steps[-1]
    false = replace(bad, steps=(*bad.steps, step))
    assert "the rates have no derivative" in ClaimChecker(false, SEED).fault(step)
