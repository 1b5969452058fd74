"""Every sentence says the same in text, LaTeX, Markdown and MathML: each letter, number, sign."""

import re
from functools import cache

import pytest

from derive.language.show import show_name
from derive.record.sentence import PLACE, Sentence
from derive.views.language import catalogue_entries, language
from derive.views.printing.sentences import QUOTED
from derive.views.printing.signs import LOWERED, RAISED, SYMBOLS
from tests.readers.formula import letters_of
from tests.readers.read import misread_sentences
from tests.support import corpus, reduced, symmetric
from tests.support.lagrangians import every_record
from tests.support.walks import ESTIMATES, FLUIDS, NAMES, OTHERS, record, repeated

LANGUAGES = ("en", "fr")
WALKS = tuple(dict.fromkeys((*NAMES, *FLUIDS, *OTHERS, *ESTIMATES)))


BESIDE = [
    *(f"reduced {x}" for x in reduced.FILES),
    *(f"symmetries {x}" for x in symmetric.FILES),
    *("discrete so3", "discrete se3", "discrete top"),
]
COUNT = 33
"""Integrals and equilibria of :func:`.every_record`."""


@cache
def found():
    """What is told of problems beside their walks."""
    return dict(enumerate(every_record())) | {x: corpus.record(x) for x in BESIDE}


@pytest.mark.parametrize("name", repeated(WALKS))
@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_sentence_of_a_walk_is_read_back(name, lang):
    assert [*misread_sentences(record(name), language(lang))] == []


@pytest.mark.parametrize("name", [*range(COUNT), *BESIDE])
@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_sentence_of_what_is_found_is_read_back(name, lang):
    assert [*misread_sentences(found()[name], language(lang))] == []


def places(x):
    """What fills the places of a sentence, in any depth."""
    for _, y in x.places:
        yield from places(y) if isinstance(y, Sentence) else (y,)


def unmarked(d):
    """The places with a parameter that stands in no quotes."""
    known = letters_of(d)
    own = {show_name(x) for x in known.parameters - known.letters} - {"i"}
    filled = (y for step in d.steps for x in step.prose for y in places(x))
    bare = re.compile(rf"(?<![^\W\d])(?:{'|'.join(map(re.escape, sorted(own)))})(?![\w(])")
    return [x for x in filled if own and bare.search(QUOTED.sub("", x))]


def test_parameters_of_a_sentence_are_told_from_its_letters():
    assert [x for d in (*map(record, WALKS), *found().values()) for x in unmarked(d)] == []


def test_they_are_as_many():
    assert {*found()} == {*range(COUNT), *BESIDE}


MATHEMATICAL = rf"[{re.escape(''.join(SYMBOLS))}{''.join(RAISED)}{''.join(LOWERED)}_=^<>]"
ALONE = r"(?<![\w’'-])[^\W\da_](?![\w’'-])|[^\W\d]\("
OTHER = {*"AyàÀ", "→", "_"}
"""Words of one letter; a key between arrows; a key of a problem."""


@pytest.mark.parametrize("lang", LANGUAGES)
def test_no_formula_stands_outside_marks(lang):
    """Nothing there is a sign of mathematics, a letter by itself or a function."""
    found = []
    for x in catalogue_entries():
        words = PLACE.sub("", " ".join(x[lang].split("$")[::2]))
        found += [(m[0], x[lang]) for m in re.finditer(f"{MATHEMATICAL}|{ALONE}", words)]
    assert [x for x in found if x[0] not in OTHER] == []
