"""Records that say what is false of most groups, bodies or forces, and true of special ones."""

import json

import pytest

from derive.record.check import Checker
from derive.record.record import from_json, to_data
from tests.walks import record


def replaced(tree, old, new):
    """A tree in the form of JSON with a name put in the place of another."""
    if tree == old:
        return new
    return [replaced(x, old, new) for x in tree] if isinstance(tree, list) else tree


def step_of(data, label):
    return next(s for s in data["steps"] if s["label"] == label)


def verdict(name, label, change):
    """Of one step of a record that is changed."""
    data = json.loads(json.dumps(to_data(record(name))))
    change(data, step_of(data, label))
    d = from_json(json.dumps(data))
    return Checker(d.problem).check(d[label])


def put(old, new):
    """A name put in the place of another in the equations."""

    def change(data, step):
        for e in step["equations"]:
            e["lhs"], e["rhs"] = (replaced(e[side], old, new) for side in ("lhs", "rhs"))

    return change


def claims(lhs, rhs, **more):
    """Another equation in the place of those of the step."""

    def change(data, step):
        step["equations"] = [{"lhs": lhs, "rhs": rhs, "for_all": []}]
        step.update(more)

    return change


def basis_in_another_order(data, step):
    data["problem"]["basis"] = data["problem"]["basis"][::-1]


RATIOS = [
    ["mul", ["pow", ["entry", "c", i], 2], ["pow", ["entry", "J", i, i], -1]] for i in (1, 2, 3)
]
MEAN = ["add", ["at", "r", "i"], ["mul", -1, ["pow", "m", -1], "c"]]
"""r_i − c/m."""
FALSE = {
    "transposes": ("linear", "linear.equations", put("ξ′", ["T", "ξ′"])),
    "a cube": ("linear", "linear.equations", put("ξ′", ["pow", "Z", 3])),
    "affine transposes": ("affine", "affine.equations", put("ξ′", ["T", "ξ′"])),
    "as many points as axes": ("so3", "so3.principal", claims("m", ["add", *RATIOS])),
    "not principal": (
        "so3",
        "so3.euler",
        claims(["entry", "λ", 1], ["entry", "I", 1, 1]),
    ),
    "no point": (
        "linear",
        "linear.action",
        claims(
            ["call", "δ", ["call", ["at", "v", "i"], "t"]], ["mul", "δA", ["at", "r", "i"]]
        ),
    ),
    "no time": (
        "linear",
        "linear.symplectic",
        claims(["call", "ω", "δy", "δ′y"], ["call", "dϖ", "δy", "δ′y"]),
    ),
    "another basis": ("so3", "so3.relation", basis_in_another_order),
    "no value of an index": (
        "jelly",
        "jelly.input",
        claims(["entry", "ζ", "i"], ["mul", 7, ["at", "κ", "i"], ["entry", "ζ", "i"]]),
    ),
    "few values of an index": (
        "so3",
        "so3.torque",
        claims(
            ["at", "r", "i"],
            ["add", ["at", "r", 1], ["mul", 0, ["entry", "J", "i", 1], ["at", "m", "i"]]],
        ),
    ),
    "an input of any group": (
        "so3",
        "linear.equations",
        lambda data, step: step.update(given=["input"]),
    ),
    "four points": (
        "so3",
        "so3.cartan",
        claims("m", ["add", *(["at", "m", i] for i in (1, 2, 3, 4))]),
    ),
    "the point before the first": (
        "so3",
        "linear.action",
        claims(["call", ["at", "r", 0], "t"], ["mul", "A", ["at", "r", 0]]),
    ),
    "equal masses of a solid": ("top", "top.cartan", claims(["at", "m", 2], ["at", "m", 3])),
    "a symmetric solid": (
        "top",
        "top.cartan",
        claims(["sum", "i", ["mul", ["at", "m", "i"], ["norm2", MEAN], MEAN]], 0),
    ),
    "points in principal axes": (
        "so3",
        "so3.principal",
        claims(
            ["add", ["at", "r", 1], ["at", "r", 2]], ["add", ["at", "r", 3], ["at", "r", 4]]
        ),
    ),
    "damped points alone": (
        "jelly",
        "jelly.input",
        claims(
            ["sum", "i", ["at", "κ", "i"]],
            ["sum", "i", ["add", ["at", "κ", "i"], ["mul", 0, ["entry", "ζ", "i"]]]],
        ),
    ),
    "fewer members of a basis": (
        "so3",
        "so3.cartan",
        claims(
            ["sum", "a", ["mul", ["at", "m", "a"], ["at", "E", "a"]]],
            ["mul", 2, ["sum", "a", ["mul", ["at", "m", "a"], ["at", "E", "a"]]]],
        ),
    ),
    "large powers": (
        "so3",
        "so3.energy",
        claims("h̃", ["add", "h̃", ["mul", 0, ["pow", ["pow", ["pow", 777, 64], 64], 64]]]),
    ),
}  # fmt: skip


WHY = {
    "not principal": "no value for 'λ'",
    "no point": "no variation of",
    "no time": "ω takes δx and δ′x",
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
}


@pytest.mark.parametrize("case", FALSE)
def test_what_is_not_true_of_all_is_refused(case):
    found = verdict(*FALSE[case])
    assert not found.holds
    assert WHY.get(case, "the sides differ") in found.reason
    assert "\n" not in found.reason


def test_unchanged_steps_hold():
    for name, label in {(name, label) for name, label, _ in FALSE.values()}:
        assert verdict(name, label, lambda data, step: None).holds
