"""Steady turns: motions exp(tY)g of which Y is given, and g is found with its inputs."""

import tomllib
from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive import ProblemError, derive
from derive import compile as compiled
from derive.check.checker import ClaimChecker
from derive.problem.toml import problem_of
from derive.record.sentence import Claim, english, rendered
from tests.check.test_record_claims import said
from tests.equilibria.test_trim import attitude
from tests.support.lagrangians import lagrangian
from tests.support.trims import holds
from tests.support.walks import SEED

NAMES = ("front", "left", "back", "right")
ARMS = ([1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0])
DRONE = {
    "name": "drone",
    "group": "SE(3)",
    "body": {"given": {"m": 2, "centre": [0, 0, 0], "I_centre": np.diag([2, 2, 3]).tolist()}},
    "input": [
        {"name": name, "kind": "force", "at": at, "frame": "body"}
        | {"direction": [0, 0, 1], "moment": [0, 0, (-1) ** k]}
        for k, (name, at) in enumerate(zip(NAMES, ARMS, strict=True))
    ],
}
"""Its thrusts are along its own axis: of a speed v and a rate Ω it leans by tan φ = vΩ/g."""


def falling(g):
    return problem_of(DRONE | {"potential": [{"kind": "gravity", "g": [0, 0, -g]}]})


def turning(v, rate, climb=0, g=10):
    along = {"zeta_3": rate} | ({"w_3": climb} if climb else {})
    return derive(falling(g)).trim({"w_1": v}, ["eta_1", *NAMES], along=along)


def test_a_drone_leans_into_its_turn():
    """Of 3-4-5 the numbers are exact: φ = −atan(3/4), and the thrust m g/cos φ."""
    found = turning(Fraction(15, 2), 1)
    assert found.found.state["A_23"] == Fraction(3, 5)
    assert [found.found.state[f"zeta_{k}"] for k in (1, 2, 3)] == [
        *(0, -Fraction(3, 5), Fraction(4, 5))
    ]
    assert sum(found.found.inputs.values()) == 25
    words = english(found.record.steps[-1].prose).replace("$", "")
    assert "that is Y, ζ₃ = 1, seen from the element of the group" in words
    assert holds(found)


def test_on_a_helix_the_motion_is_what_is_claimed():
    """The run of the emitted equations: a circle of radius v/Ω, and a steady climb."""
    v, rate, climb, g = 5, Fraction(1, 2), 2, 9.80665
    found = turning(v, rate, climb, g)
    tilt = np.arctan2(v * float(rate), g)
    assert np.allclose(attitude(found, 3)[1:, 1:], [[np.cos(tilt), np.sin(tilt)],
                                                    [-np.sin(tilt), np.cos(tilt)]])  # fmt: skip
    assert sum(map(float, found.found.inputs.values())) == pytest.approx(2 * g / np.cos(tilt))
    f = compiled(falling(g))
    run = solve_ivp(f.rhs, (0, 3), found.x, args=(found.u,), rtol=1e-11, atol=1e-11)
    T, turned = run.y[9:12, -1], 3 * float(rate)
    circle = np.array([np.sin(turned), 1 - np.cos(turned)]) * v / float(rate)
    assert np.allclose(T, [*circle, 3 * climb], atol=1e-8)
    assert "The velocity is then ζ₂ ≈" in english(found.record.steps[-1].prose).replace("$", "")
    assert holds(found)


CONE = "(3*zeta_1^2 + 3*zeta_2^2 + zeta_3^2)/2 - 4*A_33"
"""A pendulum in the cone: (I₁ − I₃)Ω² cos θ is −4, or it hangs."""
LEANING = {"A_22": "-3/5", "A_33": "-3/5", "A_23": "-4/5", "A_32": "4/5"}


def test_a_pendulum_in_a_cone():
    found = derive(lagrangian(CONE)).trim(LEANING, ["eta_1"], along={"zeta_3": 2})
    assert found.found.state["A_33"] == -Fraction(1, 2)
    assert holds(found)


def test_of_a_rate_that_is_too_small_it_hangs():
    found = derive(lagrangian(CONE)).trim(LEANING, ["eta_1"], along={"zeta_3": 1})
    assert found.found.state["A_33"] == -1


def test_on_the_right_the_motion_turns_the_body():
    """g exp(tY): it spins about an axis that is at rest where 4 cos³ θ = 6/5."""
    terms = [f"{a}*(" + " + ".join(f"A_{j}{i}*zeta_{j}" for j in (1, 2, 3)) + ")^2"
             for i, a in ((1, 3), (2, 3), (3, 1))]  # fmt: skip
    L = f"({' + '.join(terms)})/2 - A_33^4 + 6*A_33/5"
    tilted = {"A_22": "4/5", "A_33": "4/5", "A_23": "-3/5", "A_32": "3/5"}
    made = derive(lagrangian(L, side="right"))
    found = made.trim(tilted, ["eta_1"], along={"zeta_3": 2})
    cos = float(mpmath.cbrt("0.3"))
    assert float(found.found.state["A_33"]) == pytest.approx(cos, abs=1e-10)
    assert float(found.found.state["zeta_3"]) == pytest.approx(2 * cos, abs=1e-10)
    assert holds(found)


@pytest.mark.parametrize(
    ("group", "turn", "shift"), [("SE(2)", "zeta_1", "eta_2"), ("SE(3)", "zeta_3", "eta_4")]
)
@pytest.mark.parametrize("rate", [1, Fraction(1, 2)])
def test_the_place_of_a_body_that_is_slung_round(group, turn, shift, rate):
    """On a spring of stiffness k and length 1 at the distance r where m Ω² r = k (r − 1)."""
    n = int(group[3])
    inertia = 1 if n == 2 else np.diag([2, 3, 4]).tolist()
    data = {"name": "slung", "group": group}
    data["body"] = {"given": {"m": 2, "centre": [0] * n, "I_centre": inertia}}
    spring = {"kind": "spring", "at": [0] * n, "anchor": [0] * n, "stiffness": 8, "length": 1}
    found = derive(problem_of(data | {"potential": [spring]})).trim(
        {"T_1": 2}, [shift], along={turn: rate}
    )
    r = Fraction(8) / (8 - 2 * rate**2)
    assert found.found.state["T_1"] == r
    assert found.found.state["w_2"] == rate * r
    assert holds(found)


def test_of_a_place_in_free_air_any_will_do():
    told = "many trims: no rate changes with eta_4, eta_6, of which any will do; leave that out"
    with pytest.raises(ProblemError, match=told):
        derive(falling(10)).trim({}, ["eta_4", "eta_6", *NAMES])


def test_what_acts_must_be_the_same_along_it():
    made = derive(lagrangian("(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2 - A_33"))
    with pytest.raises(ProblemError, match="no steady motion is proved"):
        made.trim({}, along={"zeta_1": 1})
    with pytest.raises(ProblemError, match="--along A_33: no velocity; these are zeta_1 … zeta_3"):
        made.trim({}, along={"A_33": 1})


def test_another_turn_is_seen():
    """The checker computes what g sees: of another rate, of another velocity, of another number."""
    record = turning(5, Fraction(1, 2), g=9.80665).record
    judge, step = ClaimChecker(record, SEED).fault, record.steps[-1]
    assert not judge(step)
    (told,) = (x for x in step.claims if x.kind == "trim.near_along")
    for along, fault in (
        (("row", ("entry", "ζ", 3), 1), "that one solution is within"),
        (("row", ("par", "front"), 1), "velocities alone are told"),
    ):
        other = {**dict(told.values), "along": ("matrix", along)}
        assert fault in judge(said(step, told, Claim(told.kind, tuple(other.items()))))
    (told,) = (x for x in step.claims if x.kind == "trim.near_velocity")
    rows = dict(told.values)["entries"]
    other = {**dict(told.values), "entries": ("matrix", ("row", ("entry", "ζ", 1), 1), *rows[1:])}
    assert "the velocity is another" in judge(said(step, told, Claim(told.kind, (*other.items(),))))


def test_that_a_turn_is_isolated_is_by_what_is_seen():
    """Where Ω² = 2 the pendulum in the cone hangs twice: (I₁ − I₃)Ω² = 4."""
    spun = {"A_22": -1, "A_33": -1, "zeta_3": "-sqrt(2)"}
    record = derive(lagrangian(CONE)).trim(spun).record
    step, numbers = record.steps[-1], ("row", ("entry", "ξ", 1))
    along = ("matrix", ("row", ("entry", "ζ", 3), ("fun", "sqrt", 2)))
    with_turns = Claim("trim.isolated_with_turns", (("numbers", numbers),))
    seen = Claim("trim.isolated_along", (("numbers", numbers), ("along", along)))
    judge = ClaimChecker(record, SEED).fault
    faults = [
        judge(replace(step, claims=(*step.claims, x), prose=(*step.prose, rendered(x))))
        for x in (with_turns, seen)
    ]
    assert not faults[0]
    assert "others may do so" in faults[1]


STANDING = """
name = "standing"
group = "SO(2) x R(2)"
[[point]]
mass = 1
at = [1, 0]
[[point]]
mass = 1
at = [0, 0]
block = 2
[[potential]]
kind = "expression"
U = "r2_x^4 - r2_x + r2_y^2"
[[force]]
on = 2
frame = "space"
force = ["-hypot(v_1, v_2)*v_1", "-hypot(v_1, v_2)*v_2"]
"""


@pytest.mark.parametrize("turns", [True, False])
def test_what_has_no_turn_does_not_circle_with_the_rest(turns):
    """Its speed is 0 then; and where nothing circles, another reason is told."""
    at = problem_of(tomllib.loads(STANDING))
    along = {"zeta_1": 0.7} if turns else None
    told = r"R\(2\) of block 2 has no turn, and stands still" if turns else "as the speed of what"
    with pytest.raises(ValueError, match=told):
        derive(at).trim(free=["eta_2", "eta_3"], along=along)
