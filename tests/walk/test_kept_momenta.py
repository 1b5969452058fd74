"""The momenta that a walk says are kept, beside the rotations and translations that leave U alone,
counted by a kernel of finite differences."""

import numpy as np
import pytest

import derive
from derive import Points, Problem
from derive.record.sentence import english

VALUES = {"k": 1.3, "h": 0.7, "s": 2.1}
PLACES = [[1, 0, 0], [0, 2, 0], [0, 0, 3], [1, 1, 1]]
GIVEN = ["k", "h", "s", 1]
MASSES = [*VALUES.values(), 1]
TIME = {"t": 0.0}


def gravity(*g):
    return derive.Gravity(
        *g
    ), lambda r: -sum(m * np.dot(number(g), x) for m, x in zip(MASSES, r, strict=True))


def spring(i, anchor, length=0):
    def U(r):
        return VALUES["k"] / 2 * (np.linalg.norm(r[i - 1] - number(anchor)) - length) ** 2

    return derive.Spring(i, anchor, "k", length), U


def between(i, j, length):
    def U(r):
        return VALUES["k"] / 2 * (np.linalg.norm(r[i - 1] - r[j - 1]) - length) ** 2

    return derive.Spring(i, j, "k", length), U


def attraction(centre):
    def U(r):
        return -sum(m / np.linalg.norm(x - number(centre)) for m, x in zip(MASSES, r, strict=True))

    return derive.Attraction(1, centre), U


def harmonic(W):
    def U(r):
        return (
            sum(
                m * x @ np.array([number(y) for y in W]) @ x for m, x in zip(MASSES, r, strict=True)
            )
            / 2
        )

    return derive.Harmonic(W), U


def number(entries):
    """Entries in the parameters and the time by their values."""
    known = {"cos": np.cos, **TIME, **VALUES}
    return np.array([eval(str(x).replace("^", "**"), {}, known) for x in entries], float)


def counted(U, fields):
    """The dimension of the combinations of fields along which U does not change, anywhere
    and at any time."""
    rng, rows = np.random.default_rng(3), []
    for _ in range(12):
        r, TIME["t"] = rng.normal(size=(4, 3)) * 2, rng.normal()
        ahead, back = (
            np.array([U(r + e * np.array([f(x) for x in r])) for f in fields])
            for e in (1e-5, -1e-5)
        )
        rows.append((ahead - back) / 2e-5)
    return len(fields) - np.linalg.matrix_rank(np.array(rows), tol=1e-6)


TURNS = [lambda x, e=e: np.cross(e, x) for e in np.eye(3)]
SHIFTS = [lambda x, e=e: e for e in np.eye(3)]

UP, LINE = [0, 0, 1], ["2*s", "-s", "h*s"]
CASES = {
    "free": [between(1, 2, 1)],
    "weight": [gravity(0, 0, "-h"), between(1, 2, 1)],
    "no weight": [gravity("h-h", 0, "s*k-k*s")],
    "above": [gravity(0, 0, "-h"), spring(1, UP)],
    "above by h": [gravity(0, 0, "-h"), spring(1, [0, 0, "h"]), spring(2, [0, 0, "-k/(h+s)"], 1)],
    "aslant": [gravity("2*k", "-k", "h*k"), spring(1, LINE)],
    "beside": [gravity(0, 0, "-h"), spring(1, [0, "h", 1])],
    "at the origin": [spring(1, [0, 0, 0]), spring(2, ["h-h", 0, 0], 1)],
    "one line": [spring(1, LINE), spring(2, [-2, 1, "-h"], 1), attraction([2, -1, "h"])],
    "two lines": [spring(1, LINE), spring(2, [-2, 1, "h"], 1)],
    "centre above": [gravity(0, 0, "-h"), attraction([0, 0, "s"])],
    "shaken": [gravity(0, 0, "-h*cos(t)"), spring(1, [0, 0, "h + t^2"])],
    "shaken aslant": [gravity("t", "2*t", "-k*t"), spring(1, ["2*t", "4*t", "-2*k*t"])],
    "shaken aside": [gravity(0, 0, "-h*cos(t)"), spring(1, [0, "t", 0])],
    "shaken weight": [gravity("2*cos(t)", "-s*cos(t)", "h*cos(t)")],
    "turned weight": [gravity("cos(t)", "t", "h")],
    "centre": [attraction(["s", 0, "h"])],
}
OSCILLATORS = {
    "all round": [harmonic([["k", 0, 0], [0, "k", 0], [0, 0, "k"]])],
    "about the third": [harmonic([["k", 0, 0], [0, "k", 0], [0, 0, "h"]])],
    "about none": [harmonic([["k", 0, 0], [0, "s", 0], [0, 0, "h"]])],
    "in a plane": [harmonic([["h+k*s^2", "k*s", 0], ["k*s", "h+k", 0], [0, 0, "h"]])],
    "anywhere": [
        harmonic(
            [["h+4*k", "2*k", "2*k*s"], ["2*k", "h+k", "k*s"], ["2*k*s", "k*s", "h+k*s^2"]],
        )
    ],
    "other axes": [harmonic([["h", "k", 0], ["k", "h", 0], [0, 0, "s"]])],
    "driven": [harmonic([["k*t", 0, 0], [0, "k*t", 0], [0, 0, "h"]])],
    "turned": [harmonic([["h+t^2", "k*t", 0], ["k*t", "h+k^2", 0], [0, 0, "h"]])],
    "weighed": [
        harmonic([["k", 0, 0], [0, "k", 0], [0, 0, "h"]]),
        gravity(0, 0, "-h"),
    ],
    "weighed aslant": [
        harmonic([["k", 0, 0], [0, "k", 0], [0, 0, "h"]]),
        gravity(0, "-h", "-h"),
    ],
}


def told(group, forces):
    """The dimensions of the rotations and of the translations whose momenta are said to be kept."""
    body = Points(*zip(GIVEN, PLACES, strict=True))
    derived = derive.derive(Problem("b", group, body, forces, parameters=VALUES))
    if "b.conserved" not in {s.label for s in derived.record.steps}:
        return 0, 0
    (verdict,) = (v for v in derived.check(seed=1) if v.label == "b.conserved")
    assert verdict.holds
    step = next(s for s in derived.record.steps if s.label == "b.conserved")
    laws = [str(e.lhs) for e in step.equations if e.rhs == 0]
    turned, shifted = ([x for x in laws if rate in x] for rate in ("ℓ̇", "ṗ"))
    across = "the momentum p across gravity" in english(step.prose)
    assert across == any(x != "ṗ" for x in shifted)
    return (
        sum(3 if x == "ℓ̇" else 1 for x in turned),
        sum(3 if x == "ṗ" else 2 for x in shifted),
    )


def agrees(group, potentials):
    forces, energies = zip(*potentials, strict=True)

    def U(r):
        return sum(f(r) for f in energies)

    turned, shifted = told(group, list(forces))
    assert turned == counted(U, TURNS)
    if group.startswith("S") and group != "SL(3)" and group != "SO(3)":
        assert shifted == counted(U, SHIFTS)


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("group", ["SE(3)", "SL(3)"])
def test_all_that_leave_the_potential_alone(name, group):
    agrees(group, CASES[name])


@pytest.mark.parametrize("name", OSCILLATORS)
def test_harmonic_forces(name):
    agrees("SL(3)", OSCILLATORS[name])


@pytest.mark.parametrize("group", ["SO(3)", "SE(3)", "UT(3)"])
def test_without_weight_nothing_is_across_it(group):
    body = Points(*zip(GIVEN, PLACES, strict=True))
    record = derive.derive(Problem("b", group, body, [], parameters=VALUES)).record
    (said,) = (s.prose for s in record.steps if s.label == "b.conserved")
    assert "the momentum p across gravity" not in english(said)
