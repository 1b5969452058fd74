"""Records that say what is false of most groups, bodies or forces, and true of special ones."""

import json
import re

import pytest

from derive.check.checker import Checker, check
from derive.language.read import read
from derive.record.as_json import encode, from_json, to_data
from tests.support.walks import SEED, record


def replaced(tree, old, new):
    """A tree in the form of JSON with a name put in the place of another."""
    if tree == old:
        return new
    return [replaced(x, old, new) for x in tree] if isinstance(tree, list) else tree


def step_of(data, label):
    return next(s for s in data["steps"] if s["label"] == label)


def verdict(name, label, change, seed=SEED):
    """Of one step of a record that is changed."""
    data = json.loads(json.dumps(to_data(record(name))))
    change(data, step_of(data, label))
    d = from_json(json.dumps(data))
    return Checker(d.problem, seed).check(d[label])


def put(old, new):
    """A name put in the place of another in the equations."""

    def change(data, step):
        for e in step["equations"]:
            e["lhs"], e["rhs"] = (replaced(e[side], old, new) for side in ("lhs", "rhs"))

    return change


def of_forces(change):
    """Of the equations in which the work of the potential is that of the forces on the points."""

    def changed(data, step):
        A = [["mul", "A", "ξ′"], ["mul", "A", "η′"]]
        linear, affine = (["inner", name, x] for name, x in zip(("N", "F"), A, strict=True))
        for arguments, work in ((A[:1], linear), (A, ["add", linear, affine])):
            put(["call", "dŨ", *arguments], ["mul", -1, work])(data, step)
        for e in step["equations"]:
            e["for_all"] = [x for x in e.get("for_all", ()) if x in ("ζ̇", "ẇ", "ℓ̇_b", "ṗ_b")]
        change(data, step)

    return changed


def claims(lhs, rhs):
    """Another equation in the place of those of the step."""

    def change(data, step):
        step["equations"] = [{"lhs": lhs, "rhs": rhs, "for_all": []}]

    return change


def says(text):
    """The equation that a text says."""
    return claims(*(encode(read(x)) for x in text.split(" = ")))


def basis_in_another_order(data, step):
    data["problem"]["basis"] = data["problem"]["basis"][::-1]


RATIOS = [
    ["mul", ["pow", ["entry", "c", i], 2], ["pow", ["entry", "J", i, i], -1]] for i in (1, 2, 3)
]
MEAN = ["add", ["at", "r", "i"], ["mul", -1, ["pow", "m", -1], "c"]]
"""r_i − c/m."""
COUNT = ["sum", "i", ["mul", ["at", "m", "i"], ["pow", ["at", "m", "i"], -1]]]
"""The number of points."""
ONE_OF = ["mul", *(["add", COUNT, -k] for k in range(2, 12))]
SUMMED = ["sum", "a", ["mul", ["at", "m", "a"], ["at", "E", "a"]]]
FALSE = {
    "transposes": ("linear", "linear.equations", of_forces(put("ξ′", ["T", "ξ′"]))),
    "a cube": ("linear", "linear.equations", of_forces(put("ξ′", ["pow", "Z", 3]))),
    "affine transposes": ("affine", "affine.equations", of_forces(put("ξ′", ["T", "ξ′"]))),
    "as many points as axes": ("so3", "so3.principal", claims("m", ["add", *RATIOS])),
    "not principal": ("so3", "so3.euler", says("λ₁ = I₁₁")),
    "no point": ("linear", "linear.action", says("δ(vᵢ(t)) = δA rᵢ")),
    "no time": ("linear", "linear.symplectic", says("ω(δy, δ′y) = dϖ(δy, δ′y)")),
    "another basis": ("so3", "so3.relation", basis_in_another_order),
    "no value of an index": ("jelly", "jelly.input", says("ζᵢ = 7 κᵢ ζᵢ")),
    "few values of an index": ("so3", "so3.torque", says("rᵢ = r₁ + 0 Jᵢ₁ mᵢ")),
    "an input of any group": (
        "so3",
        "linear.equations",
        lambda data, step: step.update(driven=True),
    ),
    "four points": ("so3", "so3.cartan", says("m = m₁ + m₂ + m₃ + m₄")),
    "the point before the first": ("so3", "linear.action", says("r₀(t) = A r₀")),
    "equal masses of a solid": ("top", "top.cartan", says("m₂ = m₃")),
    "a symmetric solid": (
        "top",
        "top.cartan",
        claims(["sum", "i", ["mul", ["at", "m", "i"], ["norm2", MEAN], MEAN]], 0),
    ),
    "points in principal axes": ("so3", "so3.principal", says("r₁ + r₂ = r₃ + r₄")),
    "damped points alone": ("jelly", "jelly.input", says("Σᵢ κᵢ = Σᵢ (κᵢ + 0 ζᵢ)")),
    "fewer members of a basis": ("so3", "so3.cartan", claims(SUMMED, ["mul", 2, SUMMED])),
    "four points of any body": ("linear", "linear.moments", claims(COUNT, 4)),
    "six points of a solid": ("top", "top.cartan", claims(COUNT, 6)),
    "from two to eleven points": ("so3", "so3.cartan", claims(ONE_OF, 0)),
    "five points, times a mass": (
        "linear",
        "linear.moments",
        claims(["mul", ["add", COUNT, -5], "m"], 0),
    ),
    "an index that is a statement": (
        "linear",
        "linear.moments",
        claims("m", ["sum", "0 = 1", ["at", "m", "0 = 1"]]),
    ),
    "an index of points and axes": ("comet", "comet.cartan", says("Σᵢ mᵢ ζᵢ = Σᵢ ζᵢ mᵢ")),
    "numbers in a metric": ("so3", "so3.cartan", says("⟨t, t⟩_J = t²")),
    "a number and a metric": ("so3", "so3.cartan", says("‖t‖²_J = t²")),
    "a row of a matrix": ("so3", "so3.cartan", says("J₁ = [J₁₁, J₁₂, J₁₃]")),
    "a row alone": ("so3", "so3.cartan", claims(["row", "t", 2], ["row", "t", ["add", 1, 1]])),
    "large powers": (
        "so3",
        "so3.energy",
        claims("h̃", ["add", "h̃", ["mul", 0, ["pow", ["pow", ["pow", 777, 64], 64], 64]]]),
    ),
}


WHY = {
    "not principal": "no value for 'λ'",
    "no point": "δ is of r_i(t), g(r), ξ′, η′, L̃, L_d, U_0, U_1, ϖ(X), 𝒥_i or 𝒜_i(ξ′), "
    "not of vᵢ(t)",
    "no time": "ω is of a variation δx or δ′x, at constant time, not of δy",
    "another basis": "the basis is not that of SO(3)",
    "no value of an index": "not that of the same members",
    "few values of an index": "not that of the same members",
    "an input of any group": "an input is of a problem",
    "the point before the first": "lists no point 0",
    "four points": "lists no point 1",
    "equal masses of a solid": "lists no point 2",
    "points in principal axes": "lists no point 1",
    "damped points alone": "not that of the same members",
    "fewer members of a basis": "not that of the same members",
    "large powers": "too large",
    "an index that is a statement": "0 = 1 is no index",
    "an index of points and axes": "not that of the same members",
    "numbers in a metric": "no inner product of a matrix",
    "a number and a metric": "no inner product of a matrix",
    "a row of a matrix": "a matrix of two",
    "a row alone": "a row is part of a matrix",
}


@pytest.mark.parametrize("case", FALSE)
def test_what_is_not_true_of_all_is_refused(case):
    found = verdict(*FALSE[case])
    assert not found.holds
    assert WHY.get(case, "the sides differ") in found.reason
    assert "\n" not in found.reason


@pytest.mark.parametrize("name", ["linear", "affine"])
def test_the_work_of_the_forces_is_that_of_the_potential(name):
    """What the forgeries of equations of motion are made of is true."""
    assert verdict(name, f"{name}.equations", of_forces(lambda data, step: None)).holds


@pytest.mark.no_cover
@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("case", [x for x in FALSE if "points" in x])
def test_no_seed_lets_a_number_of_points_through(case, seed):
    name, label, change = FALSE[case]
    assert not verdict(name, label, change, seed).holds


def test_no_title_lets_a_number_of_points_through():
    """The draw is not the forger's: it is new at each check."""
    data = json.loads(json.dumps(to_data(record("so3"))))
    claims(COUNT, 4)(data, data["steps"][0])
    del data["steps"][1:]
    for title in "abcdefgh":
        data["problem"]["title"] = title
        assert not any(v.holds for v in check(from_json(json.dumps(data))))


def for_all(lhs, rhs, *names, **more):
    """An equation that is said to hold for all values of names."""

    def change(data, step):
        step["equations"] = [{"lhs": lhs, "rhs": rhs, "for_all": [*names]}]
        step.update(more)

    return change


WORK = ["mul", -1, ["call", "dŨ", ["mul", "A", "ξ′"]]]
QUANTIFIERS = {
    "of a function": ("linear", for_all(["call", "ξ", "X"], "Z", "ξ")),
    "of a function of A": ("linear", for_all(["call", "δA", "X"], "α", "δA")),
    "of a vector's": ("so3", for_all(["call", "Ω", "X"], "ζ", "Ω")),
    "tied": ("linear", for_all("ξ", ["mul", ["inv", "A"], "δA"], "ξ", "δA")),
    "tied to one": ("linear", for_all("δ′A", ["mul", "A", "ξ′"], "ξ′")),
    "tied to a vector": ("so3", for_all("ξ", ["hat", "Ω"], "ξ", "Ω")),
    "tied in a pairing": ("linear", for_all(["metric", "J", "δ′A", "F̃"], WORK, "δ′A", "ξ′")),
    "fixed": ("linear", for_all("δ′A", 0, "δ′A", given=[{"lhs": "δ′A", "rhs": 0}])),
    "that of X": ("linear", for_all(["call", "ξ", "X"], "ξ", "ξ", given=[{"lhs": "δt", "rhs": 1}])),
    "twice": ("linear", for_all(["T", ["T", "δA"]], "δA", "δA", "δA")),
}


@pytest.mark.parametrize("case", QUANTIFIERS)
def test_quantifiers_of_what_is_not_free(case):
    name, change = QUANTIFIERS[case]
    found = verdict(name, "so3.cartan" if name == "so3" else "linear.cartan", change)
    assert re.search("tied to|for all", found.reason)


def test_the_vector_of_a_turn_is_of_rotations_of_space():
    change = claims(["entry", ["call", "Ω", "X"], 1], ["entry", "Z", 3, 2])
    assert "rotations of space" in verdict("sl3", "sl3.cartan", change).reason
