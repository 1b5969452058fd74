"""What a record refuses to read, and what of it is refused though nothing is false."""

import json
import tomllib
from dataclasses import replace

import pytest

from derive.check.checker import check
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.as_json import from_json, to_data, to_json
from derive.record.record import COMMENTARY, RecordError
from derive.record.vocabulary import RULES
from tests.support import steps
from tests.support.engine_mutations.jobs import MIXED
from tests.support.walks import own_verdicts, record


def damaged(change):
    data = to_data(record("so3"))
    data = json.loads(json.dumps(data))
    change(data)
    return json.dumps(data)


def delete(key):
    def change(data):
        del data[key]

    return change


def set_step(key, value):
    def change(data):
        data["steps"][3][key] = value

    return change


BROKEN = {
    "not JSON": "{",
    "a list": "[]",
    "key twice": to_json(record("sl3")).replace('"steps":', '"steps": [], "steps":', 1),
    "deep": "[" * 100_000,
    "no problem": damaged(delete("problem")),
    "no steps": damaged(delete("steps")),
    "empty steps": damaged(lambda d: d.update(steps=[])),
    "unknown rule": damaged(set_step("rule", "magic")),
    "later use": damaged(set_step("uses", ["so3.motion"])),
    "label twice": damaged(set_step("label", "linear.action")),
    "no equation": damaged(set_step("equations", [])),
    "unknown operator": damaged(set_step("equations", [{"lhs": ["eval", "x"], "rhs": 1}])),
    "wrong arity": damaged(set_step("equations", [{"lhs": ["inv", "x", "y"], "rhs": 1}])),
    "a ragged matrix": damaged(
        set_step("equations", [{"lhs": "x", "rhs": ["matrix", ["row", 1, 2], ["row", 3]]}])
    ),
    "a line in a name": damaged(set_step("equations", [{"lhs": "x\nholds", "rhs": 1}])),
    "not a tree": damaged(set_step("equations", [{"lhs": {"a": 1}, "rhs": 1}])),
    "a number with a point": damaged(set_step("equations", [{"lhs": "L", "rhs": 1.5}])),
}


def test_nothing_is_left_out():
    """What a rule leaves out makes nothing false: `tests.support.steps` has what there is."""
    assert steps.table() == json.loads(steps.TABLE.read_text(encoding="utf-8"))


@pytest.mark.parametrize("case", BROKEN)
def test_broken_records_are_refused(case):
    with pytest.raises(RecordError) as caught:
        from_json(BROKEN[case])
    assert "\n" not in str(caught.value)


def problem_with(**changes):
    """A record that was not read, so that no one looked at the shape of its problem."""
    return replace(record("sl3"), problem={**record("sl3").problem, **changes})


def claim(lhs, rhs):
    data = json.loads(json.dumps(to_data(record("sl3"))))
    data["steps"] = data["steps"][:1]
    data["steps"][0]["equations"] = [{"lhs": lhs, "rhs": rhs}]
    return from_json(json.dumps(data))


def nested(operator, depth):
    tree = "t"
    for _ in range(depth):
        tree = (
            ["pow", tree, 64]
            if operator == "pow"
            else ["sum", "i", ["mul", ["at", "m", "i"], tree]]
        )
    return tree


HOSTILE = {
    "action": problem_with(action=[]),
    "parameters": problem_with(parameters=5),
    "body": problem_with(body="x"),
    "no points": problem_with(body={"kind": "points"}),
    "no place": problem_with(body={"kind": "points", "points": [{"mass": 1, "at": 5}]}),
    "potentials": problem_with(potentials=[{}]),
    "spring": problem_with(potentials=[{"kind": "spring", "between": [1, 9], "stiffness": 1}]),
    "mass": problem_with(
        body={"kind": "points", "points": [{"mass": ["pow", 2, 10**8], "at": [1, 2, 3]}] * 4}
    ),
    "group": problem_with(group=5),
    "powers": claim(nested("pow", 4), 0),
    "sums": claim(nested("sum", 31), 0),
    "a long product": claim(["mul", *["Z"] * 5000], 0),
    "a row": claim(["row", 1, 2], 0),
    "a call": claim(["call", ["mul", "r", "q"], "t"], 0),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_records_fail_in_one_line(case):
    verdicts = own_verdicts(HOSTILE[case])
    if all(v.holds for v in verdicts):
        verdicts = check(HOSTILE[case])
    assert not all(v.holds for v in verdicts)
    assert all("\n" not in v.reason for v in verdicts)


NO_SHAPE = (
    "action",
    "parameters",
    "body",
    "no points",
    "no place",
    "potentials",
    "spring",
    "group",
)


@pytest.mark.parametrize("case", NO_SHAPE)
def test_a_problem_of_another_shape_is_not_read(case):
    with pytest.raises(RecordError, match="record, problem: ") as caught:
        from_json(to_json(HOSTILE[case]))
    assert "\n" not in str(caught.value)


MOMENTS = {
    "m": lambda given: given.update(m=["par", "l"]),
    "c": lambda given: given.update(c=[0, 0, 1]),
    "J": lambda given: given["J"][0].__setitem__(0, ["par", "l"]),
}


@pytest.mark.parametrize("moment", MOMENTS)
def test_moments_that_are_not_those_of_the_solids_are_found(moment):
    data = json.loads(json.dumps(to_data(record("hammer"))))
    MOMENTS[moment](data["problem"]["body"]["given"])
    wrong = [v for v in check(from_json(json.dumps(data))) if not v.holds]
    assert "hammer.motion" in {v.label for v in wrong}
    assert all("not those of its solids" in v.reason for v in wrong)


def test_solids_and_points_together():
    """The given moments are those of both."""
    d = walk(problem_of(tomllib.loads(MIXED)))
    assert all(v.holds for v in check(d))
    data = json.loads(json.dumps(to_data(d)))
    data["problem"]["body"]["points"][0]["mass"] = 3
    assert any("not those of its solids" in v.reason for v in check(from_json(json.dumps(data))))


@pytest.mark.parametrize("rule", RULES)
def test_a_rule_of_another_kind_is_not_read(rule):
    """One of the same kind would be: that an equation holds is checked, not how it was found."""

    def change(data):
        next(s for s in data["steps"] if s["label"] == "so3.kernel")["rule"] = rule

    if RULES[rule].kind == "kernel":
        assert from_json(damaged(change))["so3.kernel"].rule == rule
    else:
        with pytest.raises(RecordError, match=f"key 'kind' must be \"{RULES[rule].kind}\""):
            from_json(damaged(change))


def test_commentary_is_as_it_is_said_to_be():
    """Another list would let a reader skip what equations need."""
    assert to_data(record("so3"))["commentary"] == [*COMMENTARY]
    with pytest.raises(RecordError, match="key 'commentary' must be"):
        from_json(damaged(lambda data: data.update(commentary=["equations"])))
