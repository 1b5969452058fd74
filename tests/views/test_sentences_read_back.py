"""Every sentence says the same in text, LaTeX, Markdown and MathML: each letter, number, sign."""

import re
from functools import cache

import pytest

from derive.language.show import show_name
from derive.record.sentence import Sentence
from derive.views.html import html
from derive.views.language import language
from derive.views.latex import latex
from derive.views.printing.sentences import QUOTED
from derive.views.text import markdown, text
from tests.readers.formula import letters_of
from tests.readers.read import misread_sentences
from tests.support import corpus, reduced, symmetric
from tests.support.lagrangians import every_record
from tests.support.walks import ESTIMATES, FLUIDS, NAMES, OTHERS, record, repeated

LANGUAGES = ("en", "fr")
D = r"\mathrm{d}"
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


def test_they_are_as_many():
    assert {*found()} == {*range(COUNT), *BESIDE}


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


def test_a_condition_on_every_page():
    """The radius R, the moment I1 and mgl are parameters, in the letters of the equations."""
    top, lagrange = (corpus.record(f"reduced {x}") for x in ("top", "lagrange_top"))
    assert r"\parameter{R}^{2}\parameter{h}\cdot\rho\cdot(" in latex(top)
    assert r"\neq 0$: elsewhere" in latex(top)
    assert r"where $\mathsf{I}_{\mathsf{1}}(1 - A_{33}^{2}) \neq 0$: elsewhere" in markdown(
        lagrange
    )
    assert "<mo>≠</mo>" in html([lagrange])
    assert "πR²h·rho·(R² + 4h²)(1 − A₃₃²) ≠ 0" in " ".join(text(top).split())


def test_an_integral_of_a_sentence_is_set_as_in_an_equation():
    """Limits, fraction and root of self-gravity's integrals; the words around them stay words."""
    d = record("riemann_ellipsoid")
    root, power = r"\frac{\mathrm{d}u}{\sqrt{P(u)}}", r"\frac{u^{2}\,\mathrm{d}u}{P(u)^{3/2}}"
    for integrand in (root, power):
        assert rf"$\int_{{0}}^{{\infty}}{integrand}$, with $P(u)" in latex(d).replace(r"\dd ", D)
    assert r"by $\hat r$ : $(t, g, \nu) \mapsto (t," in latex(d)
    assert "</msubsup><mfrac>" in html([d])
    assert "∫₀^∞ du / √P(u), with" in " ".join(text(d).split())
