"""Every field of a record is read: what is no commentary cannot be changed unseen."""

import copy
import json
import random
from functools import cache

import pytest

from derive.check.checker import Checker
from derive.check.definitions import unexplained
from derive.check.dependencies import unused
from derive.check.function_signatures import RATES
from derive.record.contract import ANY_GROUP, COMMENTARY
from derive.record.json_reader import from_json
from derive.record.json_writer import to_data
from derive.record.record import RecordError
from derive.record.rules import OFF_MOTION, RULES
from tests.support.walks import SEED, record, repeated

NAMES = ("so3", "sl3")
HARMLESS = {
    "default": "the equations are of the parameter, whatever its value",
    "problem.inputs.*.name": "of a force or covector whose numbers stand in no equation",
}
"""What may be changed: its equations are as true as before, and why."""

OPTIONAL = {
    "commentary": "what it lists is the same in every record",
    "steps.*.kind": "the rule says it",
    "steps.*.equations.*.key": "label and place say it",
    "steps.*.scope": "that of the chapter, by the label",
    "steps.*.remark": "what the motion uses says it",
    "steps.*.given": "an empty list",
    "steps.*.hypotheses": "an empty list",
    "steps.*.equations.*.for_all": "a claim about the variation that is drawn, for any seed",
}
"""What may be left out, and why."""


@cache
def data(name):
    return json.loads(json.dumps(to_data(record(name))))


def leaves(x, path=()):
    """Every field with its path; an operator tree is one, of which a leaf is taken."""
    if isinstance(x, dict):
        for key, value in x.items():
            yield from leaves(value, (*path, key))
    elif isinstance(x, list) and x:
        for k, value in enumerate(x):
            yield from leaves(value, (*path, k))
    else:
        yield path, x


def pattern(path):
    return ".".join("*" if isinstance(x, int) else x for x in path)


def sampled(name, count=2):
    """A few fields of each kind, the same at every run."""
    kinds = {}
    for path, value in leaves(data(name)):
        if not {*path} & {*COMMENTARY}:
            deep = next((k for k, x in enumerate(path) if x in ("lhs", "rhs", "type")), len(path))
            kinds.setdefault(pattern(path[: deep + 1]), []).append((path, value))
    chance = random.Random(SEED)
    for kind, found in kinds.items():
        yield kind, chance.sample(found, min(count, len(found)))


def others(value):
    if isinstance(value, bool):
        return (not value,)
    if isinstance(value, (int, float)):
        return (value + 1,)
    return (1.5,) if value is None else (f"{value}x", "Z")


def changed(name, path, value):
    found = copy.deepcopy(data(name))
    *inside, last = path
    there = found
    for key in inside:
        there = there[key]
    if value is None:
        del there[last]
    else:
        there[last] = value
    return found


@cache
def checker(name):
    return Checker(record(name).problem, SEED)


def refused(name, path, value):
    """Not read, or in its symbols or a step not held."""
    try:
        d = from_json(json.dumps(changed(name, path, value)))
    except RecordError:
        return True
    if path[0] == "problem":
        own = Checker(d.problem, SEED)
        return not all(own.check(step).holds for step in d.steps if step.scope != ANY_GROUP)
    if path[0] == "steps":
        names = [*unexplained(d.steps), *unused(d.steps)]
        own = checker(name)
        return any(names) or not own.check(d.steps[path[1]]).holds or not own.symbols(d).holds
    return not checker(name).symbols(d).holds


@pytest.mark.parametrize("name", repeated(NAMES))
def test_no_field_can_be_changed_unseen(name):
    kinds = set()
    for kind, found in sampled(name):
        kinds.add(kind)
        for path, value in found:
            for other in (x for x in others(value) if x != value):
                free = kind in HARMLESS or path[-1] in HARMLESS
                assert refused(name, path, other) != free, (path, other)
    assert {"problem.n", "symbols.*.role", "steps.*.kind", "steps.*.equations.*.key"} <= kinds


@pytest.mark.parametrize("name", repeated(NAMES))
def test_no_field_can_be_left_out_unseen(name):
    for _, found in sampled(name, 1):
        for path, value in found:
            end = next((k for k, x in enumerate(path) if x in ("lhs", "rhs", "type")), None)
            cut = path if end is None else path[: end + 1]
            while isinstance(cut[-1], int):
                cut = cut[:-1]
            # α̇ is that of X where an equation or its kind says so, else that of the motion
            rate = value in [*sum(RATES, ())]
            off_motion = rate and data(name)["steps"][path[1]]["kind"] in OFF_MOTION
            free = pattern(cut) in OPTIONAL and (off_motion or not rate)
            assert refused(name, cut, None) != free, cut


@pytest.mark.parametrize("rule", RULES)
def test_a_rule_of_another_kind_is_not_read(rule):
    """One of the same kind would be: that an equation holds is checked, not how it was found."""
    found = copy.deepcopy(data("so3"))
    step = next(s for s in found["steps"] if s["label"] == "so3.kernel")
    step["rule"] = rule
    if RULES[rule].kind == "kernel":
        assert from_json(json.dumps(found))["so3.kernel"].rule == rule
    else:
        with pytest.raises(RecordError, match=f"key 'kind' must be {RULES[rule].kind}"):
            from_json(json.dumps(found))


def test_commentary_is_as_it_is_said_to_be():
    """Another list would let a reader skip what equations need."""
    assert data("so3")["commentary"] == [*COMMENTARY]
    with pytest.raises(RecordError, match="key 'commentary' must be"):
        from_json(json.dumps({**data("so3"), "commentary": ["equations"]}))
