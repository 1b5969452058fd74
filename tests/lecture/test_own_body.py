"""A reader's body in the place of the racket: its moments, its flip and its figures by other roads;
for any other body a sentence says why the racket stays."""

import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from derive.command.lecture_chapters import about, motion
from derive.command.showing import derive
from derive.lecture import document
from derive.lecture.lecture_text import Given, parsed
from derive.lecture.own_body import BodyOfLecture, RacketStaysError, body_of, marks, theory
from derive.lecture.ran_figure import Ran, label_of
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.views.language import LANGUAGES, language
from tests.lecture.test_problem_chapter import alone, chapter_on
from tests.support.lectures import CHAPTERS, records, shown
from tests.support.library import module_of

CLAIMS = document.claims_of(CHAPTERS)
BOX = {"name": "brick", "title": "A brick @x, its _own_", "group": "SE(3)"}
BOX["body"] = {"solid": "box", "density": 2, "sides": [1, 2, 3], "shift": [5, 0, 1]}
POINTS = {
    "name": "three",
    "group": "SO(3)",
    "point": [{"mass": m, "at": at} for m, at in ((1, [1, 0, 0]), (2, [0, 1, 1]), (3, [-1, 0, 2]))],
}


def made(data):
    return body_of(walk(problem_of(data)))


def test_the_moments_are_those_of_the_body():
    """Of a box about its centre, m (b² + c²)/12; of points by r ∧ (ζ ∧ r); of a Lagrangian."""
    mass, sides = 12.0, np.array([1, 2, 3]) ** 2
    box = sorted(mass * (sides.sum() - sides) / 12)
    assert made(BOX).moments == pytest.approx(box, rel=1e-12)
    inertia = np.zeros((3, 3))
    for x in POINTS["point"]:
        r = np.array(x["at"], float)
        columns = [x["mass"] * np.cross(r, np.cross(e, r)) for e in np.eye(3)]
        inertia += np.array(columns).T
    body = made(POINTS)
    assert body.moments == pytest.approx(np.linalg.eigvalsh(inertia), rel=1e-12)
    turned = body.axes.T @ inertia @ body.axes
    assert np.allclose(turned, np.diag(body.moments), rtol=0, atol=1e-12)
    assert np.linalg.det(body.axes) == pytest.approx(1)
    assert body_of(derive("euler_top")[1]).moments == pytest.approx([1, 1.6, 2.2], rel=1e-12)


STAYING = {
    "two_tops": "its group is SO(3) × SO(3)",
    "sl3": "its group is SL(3)",
    "lagrange_top": "its Lagrangian is not half a quadratic form",
    "kirchhoff": "its Lagrangian is stated",
    "so3": "it is heavy",
    "comet": "more than its weight acts on it",
    "rod": "its Lagrangian is stated",
    "linear": "it has no body of its own",
}


@pytest.mark.parametrize("name", STAYING)
def test_the_racket_stays_where_a_body_is_none(name):
    with pytest.raises(RacketStaysError) as stays:
        body_of(derive(name)[1])
    for lang in LANGUAGES:
        assert language(lang).sentence(stays.value.reason)
    assert str(stays.value.reason).startswith(STAYING[name])


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"body": {"solid": "ball", "density": 1, "radius": 1}}, "two of its principal moments"),
        ({"damping": [{"at": [1, 0, 0], "coefficient": 1}]}, "more than its weight acts on it"),
        (
            {"body": BOX["body"] | {"density": "rho"}, "parameters": {"rho": {}}},
            "some of its param",
        ),
    ],
)
def test_nor_one_that_is_round_damped_or_without_numbers(change, reason):
    with pytest.raises(RacketStaysError, match=reason):
        made(BOX | change)


def test_a_heavy_body_held_at_its_centre_is_one():
    heavy = {"potential": [{"kind": "gravity", "g": [0, 0, -10]}], "group": "SO(3)"}
    centred = BOX["body"] | {"shift": [0, 0, 0]}
    assert made(BOX | heavy | {"body": centred}).group == "SO(3)"
    with pytest.raises(RacketStaysError, match="it is heavy"):
        made(BOX | heavy)


@pytest.mark.parametrize("name", ["hammer", "euler_top"])
def test_it_turns_over_when_the_elliptic_integral_says(name):
    """From ζ₃ = 0 a quarter of the period of ζ₂, K(m)/rate, as in Landau and Lifshitz, § 37."""
    problem, record = derive(name)
    own = BodyOfLecture(body_of(record, motion(problem, record)[1]), CLAIMS)
    i1, i2, i3 = own.body.moments
    w = np.array(own.start)
    twice, square = (own.body.moments * w**2).sum(), ((own.body.moments * w) ** 2).sum()
    # between the moments the square of ℓ is near 2 I₂ E; which side decides the formula
    if square < twice * i2:
        i1, i3 = i3, i1
    rate = np.sqrt((i3 - i2) * (square - twice * i1) / (i1 * i2 * i3))
    m = (i2 - i1) * (twice * i3 - square) / ((i3 - i2) * (square - twice * i1))
    assert own.turned == pytest.approx(ellipk(m) / rate, rel=1e-3)
    words = own.words(language("fr"))
    assert words["period"] == f"{2 * own.turned:.3g}".replace(".", ",")


def test_the_picture_of_a_motion_is_what_the_emitted_code_does():
    problem, record = derive("euler_top")
    ran, speed = motion(problem, record)
    assert isinstance(ran, Ran)
    assert [x for x, _ in ran.curves] == ["zeta_1", "zeta_2", "zeta_3"]
    start = np.array([0.01, 3, 0.01])
    assert speed == pytest.approx(np.linalg.norm(start))
    code = module_of("euler_top")
    x = [*np.eye(3).ravel(), *start]
    run = solve_ivp(
        code.rhs,
        (0, ran.times[-1]),
        x,
        t_eval=ran.times,
        args=(code.constants([1, 1.6, 2.2]),),
        rtol=1e-11,
        atol=1e-12,
    )
    assert np.allclose([y for _, y in ran.curves], run.y[-3:], rtol=0, atol=1e-4)
    assert "gardent leur valeur, à 10⁻" in ran.told(language("fr"))


def test_labels_of_figures_are_of_small_letters_and_differ():
    names = ["so3", "SO3", "so_3", "so", "so_dd"]
    labels = [*map(label_of, names)]
    assert len({*labels}) == len(names)
    assert all(re.fullmatch("[a-z_]+", x) for x in labels)


@pytest.mark.parametrize(("low", "high"), [(0, 4.56), (-8.8, 8.8), (-0.7, 8), (-3, 0), (0, 1e-3)])
def test_marks_are_few_and_round(low, high):
    found = marks(low, high)
    assert 0.0 in found
    assert 2 <= len(found) <= 10
    assert all(low <= x <= high for x in found)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_first_chapter_is_about_the_body(lang):
    """Its numbers and figures; of the racket nothing is said but where it is not the body's."""
    own = about(made(BOX), CHAPTERS)
    mine = document.Lecture(own, language(lang), records())
    plain, page = shown("page", lang), document.page(mine)
    assert "A brick @x, its _own_" in page
    assert len(re.findall(r"\b(racket|raquette)", plain)) > 6
    assert not re.search(r"\b(racket|raquette)", page)
    assert page.count("<figure") == plain.count("<figure")
    filled_later = r'(?s)<(style|script)\b.*?</\1>|data-place="[^"]*"'
    assert "{" not in re.sub(filled_later, "", page)
    latex = document.latex(mine)
    assert "5" in latex
    assert not re.search(r"\b(racket|raquette)", latex)


def test_both_drawings_are_of_one_size_and_turned():
    scene = theory(made(BOX))
    assert scene == theory(made(BOX))
    assert {x.base for x in scene.labels} >= {"e", "Ae", "A"}
    assert scene.width <= 127
    reach = np.array([p for s in scene.strokes for p in s.points])
    assert (reach >= 0).all()
    assert (reach <= [scene.width, scene.height]).all()


def test_its_chapter_says_that_it_has_the_place():
    chapter, records, body = chapter_on("euler_top")
    assert body is not None
    page = alone(chapter, records, "en")
    assert "In chapter 1 this body has the place of a racket; its flip is drawn there." in page
    assert page.count("<figure") == 2
    assert isinstance(chapter.title[0], Given)
    other = chapter_on("euler_top", taken=True).chapter
    page = alone(other, records, "en")
    assert "another body has the place of the racket already" in page


def test_a_motion_that_is_refused_is_a_sentence():
    problem, record = derive("ideal_fluid")
    reason, speed = motion(problem, record)
    assert not isinstance(reason, Ran)
    assert str(reason).startswith("No motion is shown: ")
    assert speed == 0


def test_a_variant_in_one_language_alone_is_refused():
    text = "chapter c\n  A\n  B\nrecords so3\ntext\n  One.\n  Un.\n  ~ Two.\n"
    with pytest.raises(ValueError, match="after ~ a sentence in each language"):
        parsed(text, "c.txt")
