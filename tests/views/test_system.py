"""What the views say of a system in words, above all where no points give its Lagrangian."""

import tomllib

import pytest

from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.views.html import html
from derive.views.language import language
from derive.views.latex import latex
from derive.views.outline import ROAD, ROAD_BOTH, ROAD_GIVEN, road, system
from tests.support import walks

POINTS = "of the points is pulled back"
STATED = ("lagrange_top", "gyrostat", "charged_body", "kirchhoff", "spherical_pendulum", "manakov")
OTHER = ("euler_poisson", "zeitlin")
TIMED = """
name = "timed"
group = "SE(2)"
[lagrangian]
L = "(zeta_1^2 + zeta_2^2 + zeta_3^2)/2 - cos(t)*T_1"
[[input]]
name = "u"
kind = "covector"
"""


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
    ("name", "english", "french"),
    [
        (
            "lagrange_top",
            "The Lagrangian is given on the group SO(3), of dimension 3, and depends on the "
            "velocity and on the element of the group.",
            "Le lagrangien est donné sur le groupe SO(3), de dimension 3, et dépend de la vitesse "
            "et de l’élément du groupe.",
        ),
        (
            "manakov",
            "The Lagrangian is given on the group SO(4), of dimension 6, and depends on the "
            "velocity.",
            "Le lagrangien est donné sur le groupe SO(4), de dimension 6, et dépend de la vitesse.",
        ),
    ],
)
def test_what_it_depends_on(name, english, french):
    assert system(walks.record(name), language("en")) == english
    assert system(walks.record(name), language("fr")) == french


def test_the_time_and_inputs_are_told():
    told = system(walk(problem_of(tomllib.loads(TIMED))), language("en"))
    assert "the velocity, on the element of the group and on the time." in told
    assert told.endswith("What acts: the input u.")


def test_an_algebra_has_no_group():
    told = system(walks.record("euler_poisson"), language("en"))
    assert "on a Lie algebra of dimension 3" in told
    assert "on what the algebra carries along" in told
    assert "The group" not in told


def test_a_fluid_on_the_torus():
    told = system(walks.record("zeitlin"), language("en"))
    assert "SU(31), of dimension 960, stands for the maps of the torus" in told


def test_the_road_of_several():
    given, points = walks.record("manakov"), walks.record("so3")
    assert road([points]) == ROAD
    assert road([given]) == ROAD_GIVEN
    assert road([points, given]) == ROAD_BOTH


@pytest.mark.parametrize("name", ["dirichlet", "riemann_ellipsoid"])
def test_an_ellipsoid_is_named(name):
    assert "moves a homogeneous ellipsoid." in system(walks.record(name), language("en"))
