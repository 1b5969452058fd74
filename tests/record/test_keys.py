"""One key for one equation, wherever it is named; one meaning for each name; sentences as data."""

import copy
import json
import re

import pytest

from derive import derive
from derive.check.checker import Checker
from derive.language.limits import SENTENCE
from derive.record.as_json import from_json, to_data, to_json
from derive.record.record import RecordError
from derive.record.sentence import english, say
from derive.record.vocabulary import (
    DISPLACEMENTS,
    PRODUCTS,
    ROTATIONS,
    SQUARE,
    VECTOR,
    VOCABULARY,
    Name,
    Use,
    defined,
    letter,
    tables,
    type_of,
)
from derive.views.html import html
from derive.views.language import language
from derive.views.latex import labels as labelled
from derive.views.latex import latex
from derive.views.text import text
from tests.support import walks
from tests.support.refusals import data, read
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
    anchors = [x for step in d.steps for x in labelled(step)]
    assert len({*anchors}) == len(anchors)
    assert re.findall(r"\\label\{(?!paper)(.*?)\}", source) == anchors
    also = re.findall(r"\\label\{(.*?)\}\\walkalso\{(.*?)\}\{(.*?)\}", source)
    assert also == [(s.label, f"{s.label}.1", s.label) for s in d.steps]
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


def test_what_a_label_says_of_a_name(tmp_path):
    file = tmp_path / "words.txt"
    label = r"p | \dot p | definition: matrix n n; function: points of algebra, vector n → scalar"
    file.write_text(f"{label}\n  a\n  b\nof.m\n  c\n  d\n", encoding="utf-8")
    known = {"m": Name("mass", "masse", "M", (letter("scalar"),))}
    found = tables(file, known)
    member = ("function", ("algebra",), VECTOR, "scalar")
    uses = defined(SQUARE), Use(("family", "points", member), "function")
    assert found == {
        "": {"p": Name("a", "b", r"\dot p", uses)},
        "of": {"m": Name("c", "d", "M", known["m"].uses)},
    }


@pytest.mark.parametrize("text", ["matrix n", "vector", "number", "algebra n", ""])
def test_what_is_no_type_is_refused(text):
    with pytest.raises(ValueError, match="is no type of a name"):
        type_of(text)


@pytest.mark.parametrize(
    ("label", "told"),
    [("p | p | given: scalar", "'given' is no role"), ("m | m", "the name m stands twice")],
)
def test_a_label_that_says_nothing_of_a_name_is_refused(tmp_path, label, told):
    file = tmp_path / "words.txt"
    file.write_text(f"m | m | letter: scalar\n  c\n  d\n{label}\n  a\n  b\n", encoding="utf-8")
    with pytest.raises(ValueError, match=told):
        tables(file, {})


@pytest.mark.parametrize(("key", "value"), [("n", 4), ("n", "any"), ("n", "n"), ("n", None)])
def test_another_dimension_is_refused(key, value):
    wrong = copy.deepcopy(data("ready so3"))
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


def so3():
    return json.loads(to_json(walks.record("so3")))


def test_old_records_are_one_sentence_a_step():
    old = so3()
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
    record = so3()
    record[kind][0] |= {words: "x", "sentences": HOSTILE[case]}
    with pytest.raises(RecordError, match=rf"^{kind[:-1]} 1") as caught:
        from_json(json.dumps(record))
    assert "\n" not in str(caught.value)


def test_sentences_as_deep_as_they_may_be():
    record = so3()
    record["steps"][0] |= {"prose": "x", "sentences": [nested(SENTENCE)]}
    read = from_json(json.dumps(record))
    assert language("fr").of(read.steps[0].prose) == "x"


def test_braces_without_places_are_letters():
    record = so3()
    del record["steps"][0]["sentences"]
    record["steps"][0] |= {"prose": "{a.b} {c!r:>99}"}
    read = from_json(json.dumps(record))
    assert english(read.steps[0].prose) == "{a.b} {c!r:>99}"
    assert from_json(to_json(read)) == read
