"""What the views say of a system in words, above all where no points give its Lagrangian."""

import pytest

from derive.views.html import html
from derive.views.language import language
from derive.views.latex import latex
from derive.views.outline import system
from tests.support import corpus, walks

POINTS = "of the points is pulled back"
STATED = ("lagrange_top", "gyrostat", "charged_body", "kirchhoff", "spherical_pendulum", "manakov")
OTHER = ("euler_poisson", "zeitlin")


@pytest.mark.parametrize("name", [*STATED, *OTHER])
def test_a_given_lagrangian_moves_no_body(name):
    d = walks.record(name)
    for text in (html([d]), latex(d)):
        assert POINTS not in text
        assert "Nothing acts" not in text
    for tongue in ("en", "fr"):
        told = system(d, language(tongue))
        assert "{" not in told
        assert not any(x in told for x in ("moves", "déplace", "Rien n’agit", "Nothing acts"))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("ready dirichlet", "moves a homogeneous ellipsoid."),
        ("lagrangian Heisenberg on the right dual False", "carries along and on the time"),
    ],
)
def test_what_it_moves_or_depends_on(name, words):
    assert words in system(corpus.record(name), language("en"))
