"""The symbols of a record say what they are, and nothing else of them is held."""

import copy
import json
from contextlib import suppress
from functools import cache

import pytest

from derive.check import symbols
from derive.check.checker import Checker
from derive.check.function_signatures import HEADS
from derive.record.json_reader import from_json
from derive.record.json_writer import to_data
from derive.record.name_types import ROLES
from derive.record.record import RecordError
from derive.record.uses import position_of
from derive.record.vocabulary import DISPLACEMENTS, PRODUCTS, ROTATIONS, VOCABULARY
from tests.support.walks import NAMES, OTHERS, SEED, SPECIAL, record, repeated

EVERY = (*NAMES, *OTHERS)
TYPES = (
    "scalar",
    "variation",
    "variation at one time",
    ["vector", "n"],
    ["vector", 3],
    ["vector", 8],
    ["matrix", "n", "n"],
    ["matrix", 3, 3],
    ["matrix", 3, 1],
    ["algebra"],
    ["family", "points", "scalar"],
    ["family", "springs", ["vector", 3]],
    ["family", "basis", ["matrix", 3, 3]],
    ["function", "variation", "scalar"],
    ["function", ["matrix", "n", "n"], "scalar"],
    ["function", ["matrix", "n", "n"], ["vector", "n"], "scalar"],
    ["function", ["algebra"], ["matrix", "n", "n"]],
    ["function"],
    "",
    ["family"],
    ["nothing", 3],
)


@cache
def data(name):
    return json.loads(json.dumps(to_data(record(name))))


@cache
def checker(name):
    return Checker(record(name).problem, SEED)


@cache
def judge(name):
    return symbols.judge(record(name).steps, checker(name).environments)


def read(data):
    """A record, or nothing for what is not one."""
    with suppress(RecordError):
        return from_json(json.dumps(data))
    return None


def refused(name, changed):
    """Is one symbol of a record not read, or what it says not held?"""
    d = read({**data(name), "symbols": [changed], "steps": data(name)["steps"][:1]})
    reason = judge(name).fault_of(d.symbols[0]) if d else "not read"
    assert "\n" not in reason
    return bool(reason)


def wrong_uses(use, keys):
    """Every change of one field of what is said of a use."""
    for other in TYPES:
        if other != use["type"]:
            yield {**use, "type": other}
    for role in (*ROLES, "hero"):
        if role != use["role"]:
            yield {**use, "role": role}
    for key in ("", keys[0], keys[-1], "so3", 1):
        if key != use.get("defined", ""):
            yield {**use, "defined": key}
    for key in use:
        yield {k: x for k, x in use.items() if k != key}


@pytest.mark.parametrize("name", repeated(EVERY, 5))
def test_the_symbols_of_every_record_hold(name):
    verdict = checker(name).symbols(from_json(json.dumps(data(name))))
    assert (verdict.label, verdict.reason) == (f"{name}.symbols", "")
    assert verdict.tried[0] == len(record(name).symbols)


@pytest.mark.parametrize("name", repeated(SPECIAL))
def test_every_change_of_a_symbol_is_refused(name):
    keys = [key for step in record(name).steps for key in step.keys]
    fields = ("type", "role", "defined")
    for symbol in data(name)["symbols"]:
        changes = []
        own = {x: symbol[x] for x in fields if x in symbol}
        rest = {x: symbol[x] for x in symbol if x not in fields}
        changes += [{**rest, **x} for x in wrong_uses(own, keys)]
        also = symbol.get("also", [])
        for i, use in enumerate(also):
            others = ([*also[:i], x, *also[i + 1 :]] for x in wrong_uses(use, keys))
            changes += [{**symbol, "also": x} for x in others]
            changes.append({**symbol, "also": also[:i] + also[i + 1 :]})
        changes.append({**symbol, "also": [*also, own]})
        for changed in changes:
            assert refused(name, changed), changed


@pytest.mark.parametrize("name", repeated(SPECIAL))
def test_another_name_is_refused(name):
    for k, symbol in enumerate(listed := data(name)["symbols"]):
        for other in {"A", "Λ", "0", ""} - {symbol["name"]}:
            changed = [*listed[:k], {**symbol, "name": other}, *listed[k + 1 :]]
            assert read({**data(name), "symbols": changed}) is None
            latex = VOCABULARY[other].latex if other in VOCABULARY else ""
            changed[k] = {**changed[k], "latex": latex}
            d = read({**data(name), "symbols": changed})
            assert d is None or not checker(name).symbols(d).holds


@pytest.mark.parametrize("name", repeated(SPECIAL))
def test_a_symbol_too_few_too_many_or_twice_is_refused(name):
    listed, known = data(name)["symbols"], {s.name for s in record(name).symbols}
    for k, symbol in enumerate(listed):
        for other in (listed[:k] + listed[k + 1 :], [*listed, symbol]):
            verdict = checker(name).symbols(read({**data(name), "symbols": other}))
            assert verdict.reason.startswith(f"{symbol['name']} is ")
    spare = next(x for x in ("Λ", "I_D", "κ") if x not in known)
    more = {**listed[0], "name": spare, "latex": VOCABULARY[spare].latex}
    verdict = checker(name).symbols(read({**data(name), "symbols": [*listed, more]}))
    assert verdict.reason == f"{spare} is declared, and no step uses it"


@pytest.mark.parametrize("name", repeated(SPECIAL))
def test_the_keys_of_definitions_are_keys(name):
    """A definition is known by its key and no letter has one."""
    keys = {key for step in record(name).steps for key in step.keys}
    for symbol in record(name).symbols:
        for use in symbol.uses:
            assert use.defined in keys | {""}
            assert (use.role != "definition") or use.defined
            assert (use.role != "letter") or not use.defined


def test_a_few_symbols():
    """By hand, from the text of the walk."""
    found = {s["name"]: s for s in data("so3")["symbols"]}
    of = {
        "A": (["matrix", "n", "n"], "letter", None),
        "Z": (["algebra"], "definition", "linear.trivialisation.1"),
        "ζ": (["vector", 3], "definition", "so3.hat.1"),
        "I": (["matrix", 3, 3], "definition", "so3.inertia.1"),
        "m": ("scalar", "definition", "linear.moments.1"),
        "ζ̇": (["vector", 3], "value on X", "so3.euler.1"),
        "λ": (["vector", 3], "letter", None),
        "dϖ": (["function", "variation", "variation", "scalar"], "function", "linear.exterior.1"),
    }
    for name, (kind, role, key) in of.items():
        said = tuple(found[name].get(x) for x in ("type", "role", "defined"))
        assert said == (kind, role, key), name
    assert found["m"]["also"] == [{"type": ["family", "points", "scalar"], "role": "letter"}]
    multiplier = next(s for s in data("sl3")["symbols"] if s["name"] == "θ")
    assert (multiplier["type"], multiplier["role"]) == ("scalar", "unknown")


@pytest.mark.parametrize("name", EVERY)
def test_functions_have_the_arguments_of_their_heads(name):
    """One for each kind of the checker's own table; a translation is of affine groups alone."""
    affine = record(name).problem["action"] == "affine"
    for symbol in record(name).symbols:
        for use in symbol.uses:
            if position_of(use.type) == "function":
                count = len(HEADS[symbol.name]) - (symbol.name in ("p̃", "dŨ") and not affine)
                assert len(use.type) - 2 == count


@pytest.mark.parametrize(("key", "value"), [("n", 4), ("n", "any"), ("n", "n"), ("n", None)])
def test_another_dimension_is_refused(key, value):
    wrong = copy.deepcopy(data("so3"))
    wrong["problem"][key] = value
    if value in ("n", None):
        with pytest.raises(RecordError, match="problem: n: "):
            from_json(json.dumps(wrong))
        return
    d = read(wrong)
    own = Checker(d.problem, SEED)
    assert "key 'n': SO(3) moves the points of a space of dimension 3" in own.symbols(d).reason
    assert not any(own.check(step).holds for step in d.steps)


@pytest.mark.parametrize("own", [ROTATIONS, DISPLACEMENTS, PRODUCTS])
def test_no_letter_has_two_meanings(own):
    """A kind of group says more precisely what a name is; its role stays, and its LaTeX."""
    for name, about in own.items():
        general = VOCABULARY[name]
        assert about.latex == general.latex, name
        assert {use.role for use in about.uses} == {use.role for use in general.uses}, name


def test_no_name_is_a_scalar_here_and_a_vector_there():
    """But for what an index counts, m_i beside m, and for functions of several kinds of things."""
    for name, about in VOCABULARY.items():
        plain = {x.type for x in about.uses if x.type[0] not in ("family", "function")}
        assert len(plain) <= 1, name
