"""One key for one equation, wherever it is named."""

import json
import re

import pytest

from derive import derive
from derive.check.checker import Checker
from derive.record.as_json import from_json, to_json
from derive.record.record import RecordError
from derive.views.html import html
from derive.views.latex import latex
from tests.support.walks import SEED, SPECIAL, record


def keys(d):
    return {key for step in d.steps for key in step.keys}


def labels(d):
    return {step.label for step in d.steps}


def named(pattern, text):
    """What a pattern finds, of one group."""
    found = set(re.findall(pattern, text))
    assert found
    return found


@pytest.mark.parametrize("name", SPECIAL)
def test_every_text_names_equations_by_their_keys(name):
    d = record(name)
    listed = json.loads(to_json(d))["steps"]
    assert [e["key"] for s in listed for e in s["equations"]] == [
        key for step in d.steps for key in step.keys
    ]
    source, page = latex(d), html([d])
    both = keys(d) | labels(d)
    assert named(r"\\label\{(?!paper)(.*?)\}", source) <= both
    also = dict(re.findall(r"\\walkalso\{(.*?)\}\{(.*?)\}", source))
    assert also == {step.keys[0]: step.label for step in d.steps}
    assert named(r"\\eqref\{(.*?)\}", source) <= both
    own = rf"(?:linear|affine|{name})\.[a-z_]+[a-z0-9_.]*"
    ids = named(rf'id="({own})"', page)
    assert labels(d) | {step.keys[0] for step in d.steps} <= ids <= both
    files = derive(name).emit()
    for end in ("c", "py"):
        assert named(rf"(?:/\*|#) ({own}):", files[f"{name}.{end}"]) <= keys(d)


def changed(change):
    data = json.loads(to_json(record("so3")))
    change(next(s for s in data["steps"] if s["label"] == "so3.kernel"))
    return json.dumps(data)


def keyed(key):
    return lambda step: step["equations"][0].update(key=key)


@pytest.mark.parametrize("key", ["so3.kernel.2", "so3.kernel", "so3.kernel#1", "", 1, None])
def test_another_key_is_not_read(key):
    with pytest.raises(RecordError) as caught:
        from_json(changed(keyed(key)))
    said = "step 27 (so3.kernel), equation 1: key 'key' must be \"so3.kernel.1\""
    assert re.sub(r"step \d+", "step 27", str(caught.value)) == said


def test_a_record_without_keys_is_read():
    """They say what labels and places say."""
    assert from_json(changed(lambda step: step["equations"][0].pop("key"))) == record("so3")


def test_a_label_that_would_be_a_key_is_not_read():
    with pytest.raises(RecordError, match="would be the key of an equation"):
        from_json(changed(lambda step: step.update(label="so3.hat.2")))


def test_the_checker_names_an_equation_by_its_key():
    d = record("so3")
    wrong = from_json(changed(lambda step: step["equations"][0].update(rhs=0)))
    reason = Checker(d.problem, SEED).check(wrong["so3.kernel"]).reason
    assert reason.startswith("so3.kernel.1 on SO(3), ")
