"""Trims within bounds: beside numbers of another source, and what a checker must refuse of them."""

from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from derive import ProblemError, derive
from derive.check.claims.claim_checker import ClaimChecker
from derive.problem.toml import problem_of
from derive.record.prose import message
from derive.record.sentence import Claim
from tests.check.test_record_claims import said
from tests.equilibria.test_trim import attitude, blown
from tests.support.trims import (
    PENDULUM,
    TURNED,
    cubed,
    holds,
    leaning,
    nearly_upside_down,
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
    angle = float(
        mpmath.findroot(
            lambda a: (
                (-3 + 0j).real * mpmath.sin(a)
                + 4 * mpmath.cos(a)
                + 3 * mpmath.sin(a) ** 2 * mpmath.cos(a)
            ),
            1,
        )
    )
    assert abs(float(found.found.state["A_11"]) - np.cos(angle)) <= found.found.radius
    assert found.found.right
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
    found = derive(problem_of(bent)).trim(TURNED, ["u"])
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
    """(u + 1)(u − 5) = 0: −1 is nearer to 0.  −(ζ − 3)²(ζ + 1) has a double root within."""
    pushed = PENDULUM | {"force": [{"covector": ["12 + (u + 1)*(u - 5) - u"]}]}
    made = derive(problem_of(pushed))
    assert is_near(made.trim(TURNED), "u", -1)
    assert is_near(made.trim(TURNED, bounds={"u": (0, 10)}), "u", 5)
    assert is_near(made.trim(TURNED | {"u": 0}, ["u"], bounds={"u": (0, 10)}), "u", 5)
    with pytest.raises(ProblemError, match="u is about 5, and --bounds allows 6 to 9"):
        made.trim(TURNED | {"u": 7}, ["u"], bounds={"u": (6, 9)})
    slowed = {"name": "s", "group": "R(1)", "point": [{"mass": 1, "at": [0]}]}
    slowed["force"] = [{"covector": ["-(zeta_1 - 3)^2*(zeta_1 + 1)"]}]
    with pytest.raises(ProblemError, match="at zeta_1 = 3 all rates are 0"):
        derive(problem_of(slowed)).trim({}, ["zeta_1"], bounds={"zeta_1": (2, 4)})


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
