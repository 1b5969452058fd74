"""Sentences as data: written beside their English, and what is refused on reading."""

import json

import pytest

from derive.language.limits import SENTENCE
from derive.record.as_json import from_json, to_data, to_json
from derive.record.record import RecordError
from derive.record.sentence import english, say
from derive.views.language import language
from derive.views.text import text
from tests.support import walks


def data():
    return json.loads(to_json(walks.record("so3")))


def test_old_records_are_one_sentence_a_step():
    old = data()
    for item in (*old["steps"], *old["symbols"]):
        item.pop("sentences", None)
    read = from_json(json.dumps(old))
    assert all(step.prose == say(english(step.prose)) for step in read.steps)
    assert text(read) == text(walks.record("so3"))


def test_sentences_with_places_are_written():
    d = to_data(walks.record("ellipsoid"))
    steps = {s["label"]: s for s in d["steps"]}
    told = steps["ellipsoid.input"]["sentences"][-1]
    assert told["message"] == "Inputs: {forces}."
    assert told["places"]["forces"]["places"]["name"] == "‘thrust’"
    assert not [s for s in d["symbols"] if s["name"] == "m" and "sentences" in s]


def nested(depth):
    sentence = {"message": "x", "places": {}}
    for _ in range(depth):
        sentence = {"message": "{a}", "places": {"a": sentence}}
    return sentence


X = {"message": "x", "places": {}}
HOSTILE = {
    "another English": [{"message": "y", "places": {}}],
    "two for one": [X, X],
    "none": [],
    "no list": {"message": "x", "places": {}},
    "a string": ["x"],
    "no message": [{"places": {}}],
    "no places": [{"message": "x"}],
    "a key more": [X | {"z": 1}],
    "a number for a message": [{"message": 1, "places": {}}],
    "places that are a list": [{"message": "x", "places": ["a"]}],
    "a place that is not there": [{"message": "x", "places": {"a": "x"}}],
    "a place not filled": [{"message": "{a}{b}", "places": {"a": "x"}}],
    "a place twice": [{"message": "{a}{a}", "places": {"a": ""}}],
    "a number in a place": [{"message": "{a}", "places": {"a": 1}}],
    "an attribute": [{"message": "{a.__class__}", "places": {"a": "x"}}],
    "a width": [{"message": "{a:>9999999999}", "places": {"a": "x"}}],
    "too deep": [nested(SENTENCE + 1)],
    "far too deep": [nested(400)],
}


@pytest.mark.parametrize("case", HOSTILE)
@pytest.mark.parametrize(("kind", "words"), [("steps", "prose"), ("symbols", "meaning")])
def test_hostile_sentences_are_refused(case, kind, words):
    record = data()
    record[kind][0] |= {words: "x", "sentences": HOSTILE[case]}
    with pytest.raises(RecordError, match=rf"^{kind[:-1]} 1") as caught:
        from_json(json.dumps(record))
    assert "\n" not in str(caught.value)


def test_sentences_as_deep_as_they_may_be():
    record = data()
    record["steps"][0] |= {"prose": "x", "sentences": [nested(SENTENCE)]}
    read = from_json(json.dumps(record))
    assert language("fr").of(read.steps[0].prose) == "x"


def test_braces_without_places_are_letters():
    record = data()
    del record["steps"][0]["sentences"]
    record["steps"][0] |= {"prose": "{a.b} {c!r:>99}"}
    read = from_json(json.dumps(record))
    assert english(read.steps[0].prose) == "{a.b} {c!r:>99}"
    assert from_json(to_json(read)) == read
