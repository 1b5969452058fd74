"""Each kind of potential, by the problems of its page in docs/potentials: walked, checked, read."""

import json
import tomllib

import pytest

from derive import derive
from derive.pipeline import walk
from derive.problem.principal import frame_of, principal
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.python import api
from derive.python.api import SE, Moments, Problem, Table
from derive.record.as_json import from_json, to_data
from derive.record.record import RecordError
from derive.record.vocabulary import (
    DISPLACEMENTS,
    OF_POTENTIALS,
    PRODUCTS,
    ROTATIONS,
    VOCABULARY,
    add_letters,
)
from derive.schema.kinds import kinds
from derive.schema.python_words import words
from derive.views.language import language
from derive.views.outline import system
from tests.support.kinds import PAGES, examples, pages
from tests.support.walks import own_verdicts


def test_each_kind_has_a_page_and_an_example():
    pages = {p.stem for p in PAGES.glob("*.md")}
    assert pages == {*kinds()}
    used = {(name.split()[0], p.kind) for name, x in examples().items() for p in x.potentials}
    assert {(kind, kind) for kind in kinds()} <= used


@pytest.mark.parametrize("kind", kinds())
def test_the_page_names_every_key(kind):
    text = (PAGES / f"{kind}.md").read_text(encoding="utf-8")
    assert all(f"`{key}`" in text for key in kinds()[kind].names())


@pytest.mark.parametrize("name", examples())
def test_an_example_holds(name):
    d = derive(examples()[name])
    assert [v.label for v in own_verdicts(d.record) if not v.holds] == []
    assert from_json(json.dumps(to_data(d.record))) == d.record
    files = d.emit()
    assert len(files) == 3
    for tongue in ("en", "fr"):
        assert "{" not in system(d.record, language(tongue))


@pytest.mark.parametrize("name", examples())
def test_a_record_of_another_form_is_refused(name):
    """Each key of each potential left out, of another type, or another name."""
    data = to_data(walk(examples()[name]))
    refused = 0
    for k, p in enumerate(data["problem"]["potentials"]):
        for key in p:
            rest = {x: y for x, y in p.items() if x != key}
            for other in (rest, rest | {key: {"no": 1}}, rest | {key + "_": p[key]}):
                changed = json.loads(json.dumps(data))
                changed["problem"]["potentials"][k] = other
                with pytest.raises(RecordError, match=rf"potential {k + 1}"):
                    from_json(json.dumps(changed))
                refused += 1
    assert refused


@pytest.mark.parametrize("kind", kinds())
def test_a_key_that_is_almost_right_is_named(kind):
    key = kinds()[kind].names()[0]
    wrong = Table("potential", kind=kind, **{key + "s": 1})
    with pytest.raises(ProblemError, match=rf"potential 1: unknown key '{key}s'; did you mean"):
        Problem("b", SE(3), Moments(), [wrong])


@pytest.mark.parametrize("name", examples())
def test_in_the_principal_frame_or_refused(name):
    problem = examples()[name]
    refused = [p.unturned for p in problem.potentials if p.unturned]
    if refused or not frame_of(problem.group):
        with pytest.raises(
            ProblemError, match=refused[0] if frame_of(problem.group) else "no prin"
        ):
            principal(problem)
    else:
        record = walk(principal(problem))
        assert all(v.holds for v in own_verdicts(record))


@pytest.mark.parametrize("kind", [x for x, own in kinds().items() if own.alone])
def test_one_alone(kind):
    problem = examples()[f"{kind} 1"]
    text = pages()[f"{kind} 1"]
    second = text[text.index("[[potential]]") :]
    assert len(problem.potentials) == 1
    with pytest.raises(ProblemError, match=f"potential 2: a second {kind}"):
        problem_of(tomllib.loads(text + second))


@pytest.mark.parametrize("word", sorted({*words()} - {"Moments", "Solid"}))
def test_the_keys_of_a_file_are_keywords_of_a_word(word):
    """Each alone builds a table with that key: what else it needs, its reader says."""
    for key in words()[word].names():
        built = getattr(api, word)(**{key: [1]})
        (table,) = built if isinstance(built, list) else [built]
        assert [1] in table.fields.values()
    with pytest.raises(ProblemError, match=f"{word}: unknown 'nonsense'.*; it takes"):
        getattr(api, word)(nonsense=1)
    with pytest.raises(ProblemError, match=f"{word}: (it takes|.* goes with)"):
        getattr(api, word)(*range(20), **{words()[word].names()[0]: 1})


LETTERS = [x for kind in kinds() for x in OF_POTENTIALS.get(kind, ())]


def test_no_kind_takes_a_letter_that_has_a_meaning():
    """Neither one of the paper, nor one of another kind, nor one of a kind of group."""
    own = VOCABULARY["m"]
    for taken in ("Z", LETTERS[0]):
        with pytest.raises(ValueError, match=f"the letter {taken} has a meaning: "):
            add_letters(dict(VOCABULARY), {taken: own})
    known = dict(VOCABULARY)
    add_letters(known, {"Q_A": own})
    with pytest.raises(ValueError, match=f"the letter Q_A has a meaning: {own.meaning}"):
        add_letters(known, {"Q_A": own})
    assert {*OF_POTENTIALS} <= {*kinds()}
    assert not {*LETTERS} & {*ROTATIONS, *DISPLACEMENTS, *PRODUCTS}
