"""Trims within bounds: beside numbers of another source, and what a checker must refuse of them."""

from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from derive import ProblemError, derive
from derive.check.checker import ClaimChecker
from derive.problem.toml import problem_of
from derive.record.prose import message
from derive.record.sentence import Claim
from tests.check.test_record_claims import said
from tests.equilibria.test_steady_turns import NAMES, falling
from tests.equilibria.test_trim import attitude, blown
from tests.support.trims import (
    ASIDE,
    DRONE,
    PENDULUM,
    TURNED,
    cubed,
    holds,
    leaning,
    nearly_upside_down,
    spun,
    turned_in_space,
)
from tests.support.walks import SEED


def is_near(found, name, value):
    """Within the radius that is claimed, which is small."""
    radius = found.found.radius
    return radius < 1e-8 and abs(float(found.found.near[name]) - value) <= radius


def test_a_root_of_a_cubic_is_enclosed():
    """u + u³ = 12."""
    found = cubed()
    assert is_near(found, "u", float(mpmath.findroot(lambda u: u + u**3 - 12, 2)))
    assert found.verdict == "stable"
    assert holds(found)


def test_a_standing_pendulum_leans_a_little():
    """20 s + s³ = 1 for s = A₂₁."""
    found = nearly_upside_down()
    s = float(mpmath.findroot(lambda s: 20 * s + s**3 - 1, 0.05))
    assert abs(float(found.found.state["A_21"]) - s) <= found.found.radius
    assert found.verdict == "unstable"
    assert holds(found)


def test_on_the_right_the_displacement_stands_before_g():
    found = turned_in_space()

    def slope(a):
        return (4 + 3 * mpmath.sin(a) ** 2) * mpmath.cos(a) - 3 * mpmath.sin(a)

    angle = float(mpmath.findroot(slope, 1))
    assert abs(float(found.found.state["A_11"]) - np.cos(angle)) <= found.found.radius
    assert found.found.right
    assert holds(found)


def test_a_steady_speed_of_the_third_degree():
    found = spun()
    assert is_near(found, "zeta_1", float(mpmath.findroot(lambda w: w + w**3 - 1, 1)))
    assert (found.found.resting, found.verdict) == (False, "open")
    assert holds(found)


def test_a_parameter_may_be_an_angle():
    """The cosine of 0.3 in what acts: 12 + 5 cos 0.3."""
    bent = {"parameters": {"a": 0.3}, "force": [{"covector": ["-5*cos(a)"]}]}
    found = derive(problem_of(PENDULUM | bent)).trim(TURNED)
    assert is_near(found, "u", 12 + 5 * np.cos(0.3))
    assert holds(found)


def test_a_drone_leans_into_a_wind_of_three_components():
    """The axis of the thrust is along what it must hold; the turn is about a horizontal axis."""
    wind = np.array([3.0, 2.0, 1.0])
    found = derive(blown(3, 2, 1)).trim({}, ["eta_1", "eta_2", "f"])
    force = 20 * np.array([0, 0, 1]) - 0.5 * np.linalg.norm(wind) * wind
    A = attitude(found, 3)
    assert is_near(found, "f", np.linalg.norm(force))
    assert np.allclose(A[:, 2], force / np.linalg.norm(force), atol=2 * float(found.found.radius))
    assert abs(A[0, 1] - A[1, 0]) <= 2 * found.found.radius
    assert holds(found)


def test_a_motion_begins_at_the_doubles_that_are_handed_out():
    """They are the nearest ones: of the thrust, beside another source of its digits, and on the
    group to rounding, so that a motion from there, without --project, stays."""
    made = derive(blown(3, 2, 1))
    found = made.trim({}, ["eta_1", "eta_2", "f"])
    with mpmath.workdps(40):
        drag = mpmath.sqrt(14) / 2
        thrust = mpmath.norm([-3 * drag, -2 * drag, 20 - drag])
    assert found.u == [float(thrust)]
    A = np.reshape(found.x[:9], (3, 3))
    assert np.allclose(A @ A.T, np.eye(3), rtol=0, atol=1e-15)
    assert "f = 19.34" in repr(found)
    names = dict(zip(found.found.state, found.x, strict=True))
    run = made.simulate(2.0, start=names | {"f": found.u[0]})
    assert max(abs(run[f"w_{k}"]).max() for k in (1, 2, 3)) < 1e-12


def test_the_speed_of_a_tilt_against_a_cubic_drag():
    force = ["-0.1*v_1 - 0.05*v_1^3", "-0.1*v_2 - 0.05*v_2^3"]
    drag = {"name": "drag", "frame": "space", "at": [0, 0], "force": force}
    thrust = {"u": "25/2", "v": "25/2"}
    made = derive(problem_of(DRONE | {"force": [drag]}))
    found = made.trim(ASIDE | thrust, ["w_1", "w_2"])
    v1, v2 = (float(mpmath.findroot(lambda v, F=F: 0.1 * v + 0.05 * v**3 - F, F)) for F in (15, 0))
    body = np.array([[4, -3], [3, 4]]) @ [v1, v2] / 5
    assert is_near(found, "w_1", body[0])
    assert is_near(found, "w_2", body[1])


@pytest.mark.parametrize(
    ("more", "at", "free", "why"),
    [
        ({"force": [{"covector": ["sin(t)"]}]}, TURNED, None, "depends on the time"),
        (
            {"force": [{"covector": ["sin(u)"]}]},
            TURNED | {"u": 1},
            [],
            r"dzeta_1/dt is about -5\.0792645; no",
        ),
        ({"force": [{"covector": ["sqrt(u - 13)"]}]}, TURNED, ["u"], "no trim is found"),
    ],
)
def test_what_is_not_enclosed_is_refused_in_one_line(more, at, free, why):
    with pytest.raises(ProblemError, match=why) as error:
        derive(problem_of(PENDULUM | more)).trim(at, free)
    assert "\n" not in str(error.value)


def test_rates_that_only_seem_to_vanish_are_refused():
    """cosh u = 1 has a double root, of which no bounds are proved."""
    flat = PENDULUM | {"force": [{"covector": ["12 + cosh(u - 1) - 1 - u"]}]}
    with pytest.raises(ProblemError, match="that they vanish is not proved"):
        derive(problem_of(flat)).trim(TURNED, ["u"])


# -- the checker ----------------------------------------------------------------------------------


def changed(found, kind, **values):
    """What is wrong with a claim of other values."""
    step = found.record.steps[-1]
    (old,) = (x for x in step.claims if x.kind == kind)
    new = Claim(kind, tuple((dict(old.values) | values).items()))
    return ClaimChecker(found.record, SEED).fault(said(step, old, new))


def test_bounds_without_the_solution_are_refused():
    found = cubed()
    beside = ("row", ("par", "u"), found.found.near["u"] + 3 * found.found.radius)
    why = changed(found, "trim.near_rest", near=("matrix", beside))
    assert "that one solution is within the bounds is not proved" in why


def test_bounds_with_several_are_refused():
    """(u³ − 2)(u − 3/2) = 0 has two solutions within 99/100 of either."""
    bent = PENDULUM | {"force": [{"covector": ["12 + (u^3 - 2)*(u - 3/2) - u"]}]}
    found = derive(problem_of(bent)).trim(TURNED | {"u": 1}, ["u"])
    assert holds(found)
    assert changed(found, "trim.near_rest", radius=Fraction(99, 100))


def test_more_numbers_than_rates_are_refused():
    near = found_near(cubed())
    why = changed(cubed(), "trim.near_rest", near=("matrix", *near, ("row", ("entry", "ξ", 1), 0)))
    assert "2 numbers are free in loads of 1 dimensions" in why


def found_near(found):
    return [("row", ("par", x), y) for x, y in found.found.near.items()]


def test_an_entry_is_no_displacement():
    near = ("matrix", *found_near(cubed()), ("row", ("entry", "A", 3, 3), 1))
    assert "are told to be near" in changed(cubed(), "trim.near_rest", near=near)


def test_a_displacement_is_told_within_bounds_alone():
    displaced = ("row", ("entry", "ξ", 1), 1)
    claim = dict(cubed().record.steps[-1].claims[0].values)
    point = ("matrix", *claim["point"][1:], displaced)
    assert "as an exact number" in changed(cubed(), "trim.near_rest", point=point)
    found = leaning()
    (told,) = (x for x in found.record.steps[-1].claims if x.kind == "trim.rest")
    point = ("matrix", *dict(told.values)["point"][1:], displaced)
    assert "and no bounds of it" in changed(found, "trim.rest", point=point)


def test_what_turns_g_tells_its_entries():
    found = nearly_upside_down()
    step = found.record.steps[-1]
    left = tuple(x for x in step.claims if not x.kind.startswith("trim.near_turned"))
    prose = tuple(x for x in step.prose if x.message != message("trim.near_turned"))
    silent = replace(step, claims=left, prose=prose)
    assert "the entries of g are not told" in ClaimChecker(found.record, SEED).fault(silent)


# -- where it begins to look ----------------------------------------------------------------------

ROTOR = {
    "name": "rotor",
    "group": "SE(2)",
    "body": {"given": {"m": 2, "centre": [0, 0], "I": 1}},
    "potential": [{"kind": "gravity", "g": [0, -10]}],
    "input": [{"name": "n", "kind": "scalar"}],
    "force": [{"at": [0, 0], "frame": "body", "force": [0, "n^2/20"]}],
}
"""A thrust n²/20 carries 20 where n is 20 or −20."""


def test_an_input_whose_square_acts_is_found_on_either_side():
    made = derive(problem_of(ROTOR))
    with pytest.raises(ProblemError, match=r"several trims: n = 20; n = -20; say near which"):
        made.trim()
    for near, wanted in ((15, 20), (-15, -20)):
        found = made.trim({"n": near}, ["n"])
        assert is_near(found, "n", wanted)
        assert holds(found)


def test_bounds_choose_a_solution():
    made = derive(problem_of(ROTOR))
    found = made.trim(bounds={"n": (0, 100)})
    assert is_near(found, "n", 20)
    assert holds(found)
    assert is_near(made.trim(bounds={"n": (-100, 0)}), "n", -20)
    with pytest.raises(ProblemError, match="several trims: n = 20; n = -20"):
        made.trim(bounds={"n": (-100, 100)})
    with pytest.raises(ProblemError, match="all trims that are found are out of bounds: n = 20; n"):
        made.trim(bounds={"n": (30, 100)})


def test_within_bounds_it_begins():
    """(u + 1)(u − 5) = 0 has two, which are told; −1 is nearer to 0.  −(ζ − 3)²(ζ + 1) has a double
    root within."""
    pushed = PENDULUM | {"force": [{"covector": ["12 + (u + 1)*(u - 5) - u"]}]}
    made = derive(problem_of(pushed))
    with pytest.raises(ProblemError, match="several trims: u = -1; u = 5; say near which"):
        made.trim(TURNED)
    assert is_near(made.trim(TURNED | {"u": 0}, ["u"]), "u", -1)
    assert is_near(made.trim(TURNED, bounds={"u": (0, 10)}), "u", 5)
    assert is_near(made.trim(TURNED | {"u": 0}, ["u"], bounds={"u": (0, 10)}), "u", 5)
    with pytest.raises(ProblemError, match="u is about 5, and --bounds allows 6 to 9"):
        made.trim(TURNED | {"u": 7}, ["u"], bounds={"u": (6, 9)})
    slowed = {"name": "s", "group": "R(1)", "point": [{"mass": 1, "at": [0]}]}
    slowed["force"] = [{"covector": ["-(zeta_1 - 3)^2*(zeta_1 + 1)"]}]
    with pytest.raises(ProblemError, match="at zeta_1 = 3 all rates are 0"):
        derive(problem_of(slowed)).trim({}, ["zeta_1"], bounds={"zeta_1": (2, 4)})


BOAT = {
    "name": "boat",
    "group": "SE(2)",
    "body": {"given": {"m": 20, "centre": [0, 0], "I_centre": 5}},
    "input": [
        {"name": "thrust", "kind": "force", "at": [-1, 0], "frame": "body", "direction": [1, 0]},
        {"name": "rudder", "kind": "force", "at": [-1, 0], "frame": "body", "direction": [0, 1]},
    ],
    "force": [
        {
            "at": [0, 0],
            "frame": "body",
            "force": ["-2*abs(v_1)*v_1", "-40*v_2"],
            "moment": ["-6*zeta_1"],
        }
    ],
}


def test_a_boat_that_turns_has_its_trim_within_bounds():
    """At a rate r: 20 r s = 2|v|v − T, −20 r v = 40 s − R along its axes, and R = −6 r; of its two
    speeds the one that is ahead."""
    made, r = derive(problem_of(BOAT)), Fraction(1, 2)
    asked = {"zeta_1": r, "thrust": Fraction(12)}, ["w_1", "w_2", "rudder"]
    bounds = {"w_1": (0, 9), "rudder": (-4, 4)}
    found = made.trim(*asked, bounds=bounds)
    assert holds(found)
    at = {**found.found.state, **found.found.inputs}
    v, s, R = (float(at[x]) for x in ("w_1", "w_2", "rudder"))
    assert R + 6 * float(r) == 0
    assert v > 0
    assert 40 * s == pytest.approx(R - 20 * float(r) * v, rel=1e-9)
    assert 2 * v * v - 20 * float(r) * s == pytest.approx(12, rel=1e-9)
    with pytest.raises(ProblemError, match="out of bounds"):
        made.trim(*asked, bounds=bounds | {"rudder": (-2, 2)})


def ahead(moment):
    """The boat with this moment and no simple number in its drag, straight ahead with a thrust."""
    drag = BOAT["force"][0] | {"force": ["-exp(v_1)*v_1", "-40*v_2"], "moment": [moment]}
    made = derive(problem_of(BOAT | {"force": [drag]}))
    return made, ({"thrust": Fraction(12)}, ["w_1"])


def test_a_corner_that_is_a_factor_of_what_is_0_has_bounds():
    """r|r| has the slope 0 at r = 0, where |r| has none: a step that is of the one is not of the
    other."""
    made, asked = ahead("-6*zeta_1 - zeta_1*abs(zeta_1)")
    found = made.trim(*asked)
    assert holds(found)
    v = found.found.state["w_1"]
    assert float(v) * np.exp(float(v)) == pytest.approx(12, rel=1e-9)
    bent, _ = ahead("-6*zeta_1 - abs(zeta_1)")
    with pytest.raises(ProblemError, match="has no derivative there"):
        bent.trim(*asked)
    step = found.record.steps[-1]
    forged = replace(bent.record, steps=(*bent.record.steps, step))
    assert "1 numbers are free in loads of 2 dimensions" in ClaimChecker(forged, SEED).fault(step)


TILTED = {"A_22": "4/5", "A_23": "-3/5", "A_32": "3/5", "A_33": "4/5"}


def test_a_quadrotor_that_turns_has_its_trim_within_bounds():
    """It flies a circle, tilted by φ, sin φ = 3/5: w₁ Ω = −g tan φ, and the thrusts are mg/cos φ in
    all; out of what a rotor can do it is refused, with its number."""
    made = derive(falling(10))
    turning = {x: Fraction(y) for x, y in TILTED.items()}
    turning |= {"zeta_2": Fraction(3, 5), "zeta_3": Fraction(4, 5)}
    found = made.trim(turning, ["w_1", *NAMES], bounds=dict.fromkeys(NAMES, (0, 7)))
    assert holds(found)
    assert found.found.state["w_1"] == Fraction(-15, 2)
    assert sum(found.found.inputs.values()) == 25
    with pytest.raises(ProblemError, match=r"out of bounds: .* and --bounds allows 0 to 6"):
        made.trim(turning, ["w_1", *NAMES], bounds=dict.fromkeys(NAMES, (0, 6)))


def test_without_gravity_a_rotor_has_one_trim_and_it_is_double():
    made = derive(problem_of(ROTOR | {"potential": []}))
    with pytest.raises(ProblemError, match=r"at n = 0 all rates are 0, and .* is not proved"):
        made.trim()


def test_numbers_at_which_rates_only_tend_to_0_are_no_trim():
    """v₁² and v₁v₂ + 10 vanish together nowhere: small where v₁ tends to 0 and v₂ grows."""
    falling = {
        "name": "falling",
        "group": "R(2)",
        "point": [{"mass": 1, "at": [0, 0]}],
        "potential": [{"kind": "gravity", "g": [0, -10]}],
        "force": [{"at": [0, 0], "force": ["-v_1^2", "-v_1*v_2"]}],
    }
    with pytest.raises(ProblemError, match="no trim is found"):
        derive(problem_of(falling)).trim({}, ["zeta_1", "zeta_2"])


def test_what_is_free_is_named_once():
    with pytest.raises(ProblemError, match="--free u: named more than once"):
        derive(problem_of(PENDULUM)).trim(TURNED, ["u", "u"])
