"""What is so of every record: its steps hold, also read back from JSON, and whatever stands before
and after what is given; and whatever is made wrong in it, by rule, is not.
"""

import json
import re
from dataclasses import replace
from itertools import islice

import pytest

from derive.check.checker import SIZE, check
from derive.check.form.function_signatures import HEADS
from derive.language.tree import names
from derive.record.as_json import from_json, to_json
from derive.record.record import ANY_GROUP
from derive.record.uses import position_of
from derive.record.vocabulary import RULES
from tests.support.corpus import NAMED, checker, record
from tests.support.record_mutations import corruptions
from tests.support.refusals import (
    TABLE,
    givens,
    hypotheses,
    quantifiers,
    symbols_listed,
    uses_of_symbols,
)
from tests.support.walks import SEED


def shown(name):
    """The road is the kind of a case, of which one at least is run."""
    return name.replace(" ", ": ", 1)


CHEAP = [x for x in NAMED if x.startswith(("ready", "signed"))]


@pytest.mark.parametrize("name", NAMED, ids=shown)
def test_it_holds_and_is_read_back(name):
    """What is said of any group is tried once for all records."""
    text = to_json(record(name))
    again = from_json(text)
    assert again == record(name)
    assert to_json(again) == text
    verdicts = check(again, SEED)
    assert [f"{v.label}: {v.reason}" for v in verdicts if not v.holds] == []
    assert [v.label for v in verdicts] == [f"{again.name}.symbols", *(s.label for s in again.steps)]
    assert verdicts[0].tried[0] == len(again.symbols)
    assert max(v.bound for v in verdicts) < 1e-30
    assert min(v.bound for v in verdicts[1:]) > 1 / SIZE


@pytest.mark.parametrize("name", CHEAP, ids=shown)
def test_the_order_of_what_is_given_says_nothing(name):
    for step in record(name).steps:
        if len(step.given) > 1 and step.scope != ANY_GROUP:
            assert checker(name).check(replace(step, given=step.given[::-1])).holds


@pytest.mark.parametrize("name", NAMED, ids=shown)
def test_its_data_are_of_one_form(name):
    """No program stands in it; a step rests on those before; names and keys are declared."""
    d = record(name)
    text = to_json(d)
    assert from_json(text) == d
    data = json.loads(text)
    assert set(data) == {"commentary", "problem", "symbols", "steps"}
    assert not re.search(r"Symbol|Rational|Matrix\(|lambda |import|__[a-z]+__", text)
    seen, declared = set(), {s.name for s in d.symbols}
    for step, own in zip(data["steps"], d.steps, strict=True):
        assert {"label", "rule", "uses", "paper", "prose", "equations"} <= set(step)
        assert step["rule"] in RULES
        assert step["prose"].endswith(".")
        assert set(step["uses"]) <= seen
        seen.add(step["label"])
        supposed = [x.of for x in own.hypotheses] + [x for e in own.given for x in (e.lhs, e.rhs)]
        assert {x for t in supposed for x in names(t)} - {"i", "sqrt", "π"} <= declared
    keys = {key for step in d.steps for key in step.keys}
    affine = d.problem["action"] == "affine"
    for name, use in ((s.name, use) for s in d.symbols for use in s.uses):
        assert use.defined in keys | {""}
        assert (use.role != "definition") or use.defined
        assert (use.role != "letter") or not use.defined
        if position_of(use.type) == "function" and name in HEADS and "torus" not in d.problem:
            shift = name in ("p̃", "dŨ") and not affine
            assert len(use.type) - 2 == len(HEADS[name]) - shift


MANY = 16
SHARES = {hypotheses: 2, givens: 2, quantifiers: 1, uses_of_symbols: 1, symbols_listed: 2}
"""Of how many cases each has its share of the changes of a record: of others, of MANY."""


def of_changes(what, name, share):
    """The kind of change and the road are the kind of a case, of which one at least is run."""
    road, _, problem = name.partition(" ")
    return f"{what} of {road}: {problem} {share}"


CASES = [
    pytest.param(changes, name, share, id=of_changes(changes.__name__, name, share))
    for changes, names in TABLE.items()
    for name in names
    for share in range(SHARES.get(changes, MANY))
]


@pytest.mark.no_cover
@pytest.mark.parametrize(("changes", "name", "share"), CASES)
def test_none_is_held(changes, name, share):
    found = islice(changes(name), share, None, SHARES.get(changes, MANY))
    assert [what for what, held in found if held()] == []


@pytest.mark.no_cover
@pytest.mark.parametrize("changes", TABLE)
def test_there_is_what_is_changed(changes):
    found = {repr(what) for name in TABLE[changes] for what, _ in islice(changes(name), 40)}
    assert len(found) > 10


@pytest.mark.no_cover
def test_equations_are_changed_in_every_way():
    steps = record("ready so3").steps
    kinds = {kind for s in steps for e in s.equations for kind, _ in corruptions(e)}
    assert kinds == {"sign", "factor", "term", "bar", "zero"}
