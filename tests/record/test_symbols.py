"""The symbols of a record by hand, and one meaning for each name."""

import copy
import json

import pytest

from derive.check.checker import Checker
from derive.record.as_json import from_json
from derive.record.record import RecordError
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
from tests.support.refusals import data, read
from tests.support.walks import SEED


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
