"""Trims, as trims.toml has them: found, beside laws by hand and the emitted code; or refused in a
line.  What a checker must refuse of them."""

import re
from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive import ProblemError
from derive import compile as compiled
from derive.check.checker import ClaimChecker
from derive.language.tree import add
from derive.record.prose import message
from derive.record.sentence import Claim, english
from tests.check.test_record_claims import said
from tests.support.coadjoint_orbits import match
from tests.support.trims import FOUND, REFUSED, asked, holds, made, stated, trim
from tests.support.walks import SEED

VELOCITY = re.compile(r"(zeta|w)\d?_\d")
FUNCTIONS = {x: getattr(np, x) for x in ("sqrt", "exp", "hypot", "abs", "cos")}


def numbers(found):
    """What is found, by name."""
    told = {**found.found.state, **found.found.inputs}
    return {x: float(y) for x, y in told.items()}


@pytest.mark.parametrize("name", FOUND)
def test_a_trim_is_held_and_obeys_laws_by_hand(name):
    row, found = FOUND[name], trim(name)
    known = numbers(found)
    for law in row["laws"].split("; "):
        assert abs(eval(law.replace("^", "**"), FUNCTIONS | known)) < 1e-8, law
    moving = any(y for x, y in known.items() if VELOCITY.fullmatch(x))
    assert (found.found.resting, found.found.corner) == (not moving, row.get("corner", False))
    assert getattr(found.found, "radius", None) is None or found.found.radius < 1e-8
    assert hasattr(found.found, "radius") == row.get("enclosed", False)
    assert holds(found)


@pytest.mark.parametrize("name", FOUND)
def test_the_emitted_code_stays_there_and_has_its_eigenvalues(name):
    """Four eigenvalues of one value are found to the fourth root of rounding."""
    row, found = FOUND[name], trim(name)
    f = compiled(stated(row), jacobian=["state"])
    if "given" in row:
        f.use([row["given"][x] for x in f.PARAMETERS])
    run = solve_ivp(f.rhs, (0, 1), found.x, args=(found.u,), rtol=1e-10, atol=1e-10)
    own = slice(-f._names.algebra, None)
    assert np.allclose(run.y[own].T, np.array(found.x)[own], rtol=0, atol=1e-7)
    eigenvalues = np.linalg.eigvals(f.jacobian(0.0, found.x, found.u)[1])
    assert match(found.eigenvalues, eigenvalues, 1e-3)
    most = max(eigenvalues.real)
    assert found.verdict == ("open" if abs(most) < 1e-3 else "stable" if most < 0 else "unstable")


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_trim_is_said_in_one_line(name):
    row = REFUSED[name]
    words = ".*".join(map(re.escape, row["says"].split(" … ")))
    with pytest.raises(ValueError, match=words) as error:
        made(row).trim(**asked(row))
    assert "\n" not in str(error.value)


def told(name):
    """The sentence of a trim."""
    return english(trim(name).record.steps[-1].prose).replace("$", "")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("drifting aside", "A steady motion"),
        ("leaning into a wind", "no others of ξ₁, ‘u’, ‘v’ do so"),
        ("the other angle by bounds", "Elsewhere there may be others"),
        ("the speed of a tilt", "Near these numbers no others of w₁, w₂ do so"),
        ("a fall with the wind", "w₁ = 4, w₂ = −2 √(5)"),
        ("roots that cancel", "w₂ = −4"),
        ("at rest in air", "A root that is 0 there has no derivative"),
        ("leaning into a turn", "that is Y, ζ₃ = 1, seen from the element of the group"),
        ("a helix", "The velocity is then ζ₂ ≈"),
        ("axes that point along others", "Axis 3 of the body points along axis 1 of space."),
        ("a solid that rests", "stays 0 with ζ₁ = 0, ζ₂ = 0, ζ₃ = 0, and"),
    ],
)
def test_what_a_trim_says_of_itself(name, words):
    assert words in told(name)


def test_a_motion_begins_at_the_doubles_that_are_handed_out():
    """They are the nearest ones: of the thrust, beside another source of its digits, and on the
    group to rounding, so that a motion from there, without --project, stays."""
    name = "in a wind of three components"
    found = trim(name)
    with mpmath.workdps(40):
        drag = mpmath.sqrt(14) / 2
        thrust = mpmath.norm([-3 * drag, -2 * drag, 20 - drag])
    assert found.u == [float(thrust)]
    A = np.reshape(found.x[:9], (3, 3))
    assert np.allclose(A @ A.T, np.eye(3), rtol=0, atol=1e-15)
    assert "f = 19.34" in repr(found)
    names = dict(zip(found.found.state, found.x, strict=True))
    run = made(FOUND[name]).simulate(2.0, start=names | {"f": found.u[0]})
    assert max(abs(run[f"w_{k}"]).max() for k in (1, 2, 3)) < 1e-12


def test_of_a_family_another_is_told_which_is_one():
    """Of 25 − ζ₁² − ζ₂² and 0: a circle."""
    circle = made({"of": "plane", "covector": "25 - zeta_1^2 - zeta_2^2; 0*zeta_1"})
    with pytest.raises(ProblemError, match=r"many trims: near .* a family of dimension 1") as error:
        circle.trim({"zeta_1": 3, "zeta_2": 4}, ["zeta_1", "zeta_2"])
    words = re.findall(r"zeta_\d = ([-.\d]+)", str(error.value))
    a, b, c, d = map(float, words)
    assert (a, b) != pytest.approx((c, d), abs=0.5)
    assert np.allclose([np.hypot(a, b), np.hypot(c, d)], 5, atol=1e-4)


@pytest.mark.parametrize(
    ("name", "along"),
    [
        ("axes that point along others", [{"axis": 3, "space": 1}]),
        ("one arm that stands", [{"axis": k, "space": k, "body": 2} for k in (1, 2)]),
        ("a solid that rests", []),
        ("a solid that rests, turned", [{"axis": k, "space": k % 3 + 1} for k in (1, 2, 3)]),
    ],
)
def test_where_bodies_point(name, along):
    """Where it rests, of all axes, unless they are as drawn; else of that about which it turns."""
    claims = trim(name).record.steps[-1].claims
    found = [dict(x.values) for x in claims if x.kind.startswith("position.")]
    assert sorted(found, key=lambda x: x["axis"]) == along


# -- the checker ----------------------------------------------------------------------------------


def row(*entries):
    return ("row", *entries)


def entry(x, *at):
    return ("entry", x, *at)


def matrix(*rows):
    return ("matrix", *rows)


U, V, W = ("par", "u"), ("par", "v"), [entry("w", k) for k in (1, 2)]
DISPLACED = row(entry("ξ", 1), 1)
NEAR = "trim.near_rest"
FORGED = [
    ("one of a family", "trim.unique", "inputs", lambda x: (*x, ("par", "z")), "others do so as"),
    ("leaning about a horizontal axis", "trim.isolated_with_turns", "numbers",
     lambda _: row(*(entry("ξ", a) for a in (1, 2, 3)), ("par", "f")), "others may do so"),
    # with the thrust free it climbs, at another speed
    ("the speed of a tilt", "trim.isolated", "numbers", lambda _: row(*W, U, V),
     "others may do so near there"),
    ("a fall at a root", "trim.steady", "point", lambda _: matrix(row(W[1], -5)),
     "a rate does not vanish there"),
    ("a fall at a root", "trim.steady", "point",
     lambda _: matrix(row(W[1], ("mul", Fraction(-9, 3), ("fun", "sqrt", 3)))),
     "a rate does not vanish there"),
    ("a fall at a root", "trim.open", "polynomial", lambda x: add(x, 1), "is another"),
    *(("a fall at a root", "trim.open", "polynomial", lambda _, n=n: ("pow", "λ", n), "")
      for n in (10**9, -1, Fraction(1, 2))),
    ("axes that point along others", "position.along", "space", lambda _: 2, "elsewhere"),
    ("axes that point along others", "position.along", "axis", lambda _: 1, "the axis moves"),
    ("axes that point along others", "position.along", "axis", lambda _: 4, "no such"),
    # the checker computes what g sees
    ("a helix", "trim.near_along", "along", lambda _: matrix(row(entry("ζ", 3), 1)),
     "that one solution is within"),
    ("a helix", "trim.near_along", "along", lambda _: matrix(row(("par", "front"), 1)),
     "velocities alone are told"),
    ("a helix", "trim.near_velocity", "entries",
     lambda x: matrix(row(entry("ζ", 1), 1), *x[1:]), "the velocity is another"),
    ("a root of a cubic", NEAR, "near", lambda x: matrix(row(U, x[1][2] + Fraction(1, 10**6))),
     "that one solution is within the bounds is not proved"),
    ("a root of a cubic", NEAR, "near", lambda x: (*x, row(entry("ξ", 1), 0)),
     "2 numbers are free in loads of 1 dimensions"),
    ("a root of a cubic", NEAR, "near", lambda x: (*x, row(entry("A", 3, 3), 1)),
     "are told to be near"),
    ("a root of a cubic", NEAR, "point", lambda x: (*x, DISPLACED), "as an exact number"),
    ("kept aside by a torque", "trim.rest", "point", lambda x: (*x, DISPLACED),
     "and no bounds of it"),
    # (u³ − 2)(u − 3/2) has two roots within
    ("beside another root", NEAR, "radius", lambda _: Fraction(99, 100), ""),
]  # fmt: skip
"""Of a trim a claim, a value of it, which other is claimed, and what is wrong."""


@pytest.mark.parametrize(("name", "kind", "key", "other", "why"), FORGED)
def test_another_claim_is_refused(name, kind, key, other, why):
    record = trim(name).record
    step, judge = record.steps[-1], ClaimChecker(record, SEED).fault
    old = next(x for x in step.claims if x.kind == kind)
    values = dict(old.values)
    fault = judge(said(step, old, Claim(kind, (*(values | {key: other(values[key])}).items(),))))
    assert fault
    assert why in fault


def test_a_claim_of_another_kind_is_refused():
    """Where Ω² = 2 the pendulum in the cone hangs twice: (I₁ − I₃)Ω² = 4.  A thrust that holds a
    body on a circle, while the air beside it rests, does not a moment later."""
    hanging = {"A_22": -1, "A_33": -1, "zeta_3": "-sqrt(2)"}
    cone, flying = made({"of": "cone"}).trim(hanging), trim("ahead against its drag")
    free = ("numbers", row(entry("ξ", 1)))
    along = ("along", matrix(row(entry("ζ", 3), ("fun", "sqrt", 2))))
    circling = made(REFUSED["a turn in a wind"])
    now = matrix(row(W[0], 4), row(entry("ζ", 1), 1), row(U, 4), row(V, 4))
    for record, claim, why in (
        (cone.record, Claim("trim.isolated_with_turns", (free,)), None),
        (cone.record, Claim("trim.isolated_along", (free, along)), "others may do so"),
        (flying.record, Claim("trim.corner"), "no root is 0 there"),
        (circling.record, Claim("trim.steady", (("point", now),)), "where the motion takes g"),
    ):
        fault = ClaimChecker(record, SEED)._fault(record.steps[-1], claim)
        assert bool(fault) == bool(why)
        assert (why or "") in (fault or "")


def test_what_turns_g_tells_its_entries():
    record = trim("nearly upside down").record
    step = record.steps[-1]
    left = tuple(x for x in step.claims if not x.kind.startswith("trim.near_turned"))
    prose = tuple(x for x in step.prose if x.message != message("trim.near_turned"))
    silent = replace(step, claims=left, prose=prose)
    assert "the entries of g are not told" in ClaimChecker(record, SEED).fault(silent)


@pytest.mark.parametrize(
    ("name", "bent", "why"),
    [
        # r|r| has the slope 0 at r = 0, where |r| has none
        ("a drag of the speed at rest", "a size at 0", "the rates have no derivative"),
        ("a corner that is a factor of 0", "a corner of a moment", "1 numbers are free in loads"),
    ],
)
def test_a_corner_that_is_no_factor_of_0_is_none_of_another(name, bent, why):
    """The step of one in the record of the other, of which the rates vanish there as well."""
    record = made(REFUSED[bent]).record
    forged = replace(record, steps=(*record.steps, trim(name).record.steps[-1]))
    assert why in ClaimChecker(forged, SEED).fault(forged.steps[-1])
