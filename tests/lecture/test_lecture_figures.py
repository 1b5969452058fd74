"""The figures of the lecture: their numbers by other roads, the same bytes, words for all."""

import re
from fractions import Fraction

import numpy as np
import pytest
import sympy
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve
from scipy.spatial.transform import Rotation
from scipy.special import ellipk

from derive.lecture import document, figures, motion_figures
from derive.lecture.lecture_text import LectureError, parsed
from derive.lecture.sheets import View
from derive.problem.toml import problem_of
from derive.views.language import LANGUAGES, language
from tests.support import group_figures, lecture_figures
from tests.support.lectures import CHAPTERS, records, shown
from tests.support.library import module_of

CLAIMS = document.claims_of(CHAPTERS)
FIGURES = [b for c in CHAPTERS for b in c.blocks if b.kind == "figure"]
I1, I3, P = lecture_figures.PARAMETERS.values()


def top(kind):
    return lecture_figures.top(CLAIMS, lecture_figures.PRECESSIONS[kind])


def momenta(kind):
    """The rate of precession at the upper tilt, the momentum about the vertical, and the energy, by
    the angular velocity: ψ̇ of precession about e_z and what is left about the axis."""
    rate, spin, u = lecture_figures.PRECESSIONS[kind], lecture_figures.SPIN, lecture_figures.UPPER
    about_vertical = I1 * rate * (1 - u * u) + spin * u
    return rate, about_vertical, I1 * rate**2 * (1 - u * u) / 2 + spin**2 / (2 * I3) + P * u


def by_vectors(kind, end):
    """The axis n of the top by the law of its angular momentum, L′ = −P n × e_z."""
    rate, u, up = momenta(kind)[0], lecture_figures.UPPER, np.array([0, 0, 1.0])
    n = np.array([np.sqrt(1 - u * u), 0, u])
    momentum = I1 * np.cross(n, np.cross(rate * up, n)) + lecture_figures.SPIN * n

    def moved(_, x):
        n, about = x[:3], x[3:]
        return [*(np.cross(about, n) / I1), *(np.cross(n, -P * up))]

    run = solve_ivp(moved, (0, end), [*n, *momentum], rtol=1e-11, atol=1e-12, dense_output=True)
    return lambda t: run.sol(t)[:3]


@pytest.mark.parametrize("kind", lecture_figures.PRECESSIONS)
def test_the_axis_moves_as_its_angular_momentum_says(kind):
    motion = top(kind).motion(20.0, 1600)
    axis = by_vectors(kind, 20.0)
    for t, (u, _, angle) in motion[::50]:
        r = np.sqrt(1 - u * u)
        assert np.allclose([r * np.cos(angle), r * np.sin(angle), u], axis(t), rtol=0, atol=1e-5)


@pytest.mark.parametrize("kind", lecture_figures.PRECESSIONS)
def test_the_turning_points_are_roots_of_the_cubic(kind):
    """(1 − u²)(2h − J₂²/I₃ − 2Pu) I₁ − (J₁ − uJ₂)², by the roots of polynomials."""
    _, about_vertical, energy = momenta(kind)
    spin = lecture_figures.SPIN
    cubic = I1 * np.poly1d([-1, 0, 1]) * np.poly1d([-2 * P, 2 * energy - spin**2 / I3])
    cubic -= np.poly1d([-spin, about_vertical]) ** 2
    low, high, outside = sorted(cubic.roots.real)
    assert np.allclose([low, high], [top(kind).lower, lecture_figures.UPPER], rtol=0, atol=1e-9)
    assert outside > 1
    heights = [u for _, (u, *_) in top(kind).motion(20.0, 1600)]
    assert min(heights) == pytest.approx(low, abs=1e-3)
    assert max(heights) < high + 1e-6
    assert top(kind).potential(low) == pytest.approx(energy, abs=1e-9)


def test_waves_cusps_and_loops():
    """Along a path the angle grows, stands still with the height at cusps, or also falls."""
    backwards, slowest = {}, {}
    for kind in lecture_figures.PRECESSIONS:
        path = np.array(top(kind).path())
        steps = np.diff(np.unwrap(np.arctan2(path[:, 1], path[:, 0])))
        backwards[kind] = (steps < -1e-6).sum()
        slowest[kind] = np.linalg.norm(np.diff(path, axis=0), axis=1).min()
        assert np.allclose((path**2).sum(axis=1), 1, rtol=0, atol=1e-12)
    assert backwards["waves"] == backwards["cusps"] == 0 < 50 < backwards["loops"]
    assert 20 * slowest["cusps"] < min(slowest["waves"], slowest["loops"])


def test_the_racket_flips_as_the_emitted_code_says():
    code, motion = module_of("euler_top"), figures.racket(CLAIMS)
    k = code.constants(list(figures.RACKET.moments))
    start = [*np.eye(3).ravel(), *figures.RACKET.start]
    times = [t for t, _ in motion]
    run = solve_ivp(
        code.rhs, (0, figures.RACKET.end), start, t_eval=times, args=(k,), rtol=1e-11, atol=1e-13
    )
    zeta = np.array([x for _, x in motion])
    assert np.allclose(zeta, run.y[-3:].T, rtol=0, atol=1e-4)
    moments = np.array(figures.RACKET.moments)
    for kept in (zeta**2 @ moments, zeta**2 @ moments**2):
        assert np.ptp(kept) < 1e-8
    assert (np.diff(np.sign(zeta[:, 1])) != 0).sum() == 2


def test_the_ellipsoid_rolls_as_the_emitted_code_says():
    """The point of contact stays in one plane; its place there up to a rotation, by A in space."""
    code, end, steps = module_of("euler_top"), 20.0, 2000
    moments = np.array(motion_figures.MOMENTS)
    start = [*np.eye(3).ravel(), *motion_figures.START]
    run = solve_ivp(
        code.rhs,
        (0, end),
        start,
        t_eval=np.linspace(0, end, steps + 1)[::100],
        args=(code.constants(list(moments)),),
        rtol=1e-11,
        atol=1e-13,
    )
    wanted = np.array([x[:9].reshape(3, 3) @ x[9:] for x in run.y.T])
    momentum = moments * motion_figures.START
    down = momentum / np.linalg.norm(momentum)
    first = np.cross(momentum, [0, 0, 1])
    first /= np.linalg.norm(first)
    motion = motion_figures.rolling(CLAIMS, end, steps)[::100]
    found = np.array([motion_figures.in_space(*x)(x[0]) for x in motion])
    axes = np.array([first, np.cross(first, down), -down])
    assert np.allclose(found, wanted @ axes.T, rtol=0, atol=1e-5)
    assert np.ptp(found[:, 2]) < 1e-8
    radii = np.hypot(found[:, 0], found[:, 1])
    assert np.ptp(radii) > 0.1


def test_four_points_move_as_the_emitted_code_says():
    """The same points and springs as a problem; the volume stays, and θ is that of its walk."""
    points = lecture_figures.PLACES.tolist()
    springs = [
        {"kind": "spring", "between": [i, j], "stiffness": lecture_figures.SPRING, "length": 0}
        for i in range(1, 5)
        for j in range(1, i)
    ]
    listed = zip(lecture_figures.MASSES, points, strict=True)
    data = {"name": "four", "group": "SL(3)", "potential": springs}
    data["point"] = [{"mass": m, "at": at} for m, at in listed]
    code = module_of(problem_of(data))
    basis = np.array(code.BASIS, float)
    rows = basis.reshape(len(basis), 9).T
    zeta = np.linalg.lstsq(rows, lecture_figures.VELOCITY.ravel(), rcond=None)[0]
    motion = lecture_figures.motion(
        CLAIMS, lecture_figures.moments(), lecture_figures.VELOCITY, lecture_figures.END
    )
    times, k = [t for t, *_ in motion], code.constants([])
    start, end = [*np.eye(3).ravel(), *zeta], (0, times[-1])
    run = solve_ivp(code.rhs, end, start, t_eval=times, args=(k,), rtol=1e-11, atol=1e-13)
    found = np.array([A.ravel() for _, A, _ in motion])
    assert np.allclose(found, run.y[:9].T, rtol=0, atol=1e-6)
    assert np.allclose([np.linalg.det(A) for _, A, _ in motion], 1, rtol=0, atol=1e-8)
    assert min(y for *_, y in motion) > 0


def test_an_edge_of_the_tetrahedron_is_pale_where_a_point_just_before_it_is_inside():
    """A point of an edge is hidden if the way from it to the eye goes through the inside."""
    points = lecture_figures.PLACES
    for A in (np.eye(3), np.diag([3, 1, 1 / 3]), np.array([[1, 2, 0], [0, 1, 0], [1, 0, 1]])):
        scene = lecture_figures._placed(A, 0.0)
        view = View((12.5, 17.5), 11.0, 25, 18)
        eye = np.array([view.depth(x) for x in np.eye(3)])
        moved = points @ A.T
        pens = []
        for i in range(4):
            for j in range(i + 1, 4):
                near = (moved[i] + moved[j]) / 2 + 1e-6 * eye
                weights = np.linalg.solve(np.vstack([moved.T, np.ones(4)]), [*near, 1])
                pens.append("hidden" if min(weights) > 0 else "line")
        assert [s.pen for s in scene.strokes] == pens
        assert pens.count("hidden") in (0, 1, 3)


def test_an_ellipse_of_fluid_keeps_its_area():
    """Ä = θ cof A, where the area has no second derivative: θ ‖cof A‖² + 2 det Ȧ = 0."""

    def rate(_, x):
        A, v = x.reshape(2, 2, 2)
        cofactors = np.array([[A[1, 1], -A[1, 0]], [-A[0, 1], A[0, 0]]])
        theta = -2 * np.linalg.det(v) / (cofactors**2).sum()
        return np.concatenate([v.ravel(), theta * cofactors.ravel()])

    J, strain = {"J": np.eye(2), "K": np.zeros((2, 2))}, lecture_figures.STRAIN
    motion = lecture_figures.motion(CLAIMS, J, strain, lecture_figures.SPREAD)
    times = [t for t, *_ in motion]
    start = [*np.eye(2).ravel(), *strain.ravel()]
    run = solve_ivp(rate, (0, times[-1]), start, t_eval=times, rtol=1e-11, atol=1e-13)
    assert np.allclose([A.ravel() for _, A, _ in motion], run.y[:4].T, rtol=0, atol=1e-7)
    assert all(y > 0 for *_, y in motion)


def test_the_racket_of_the_theory_is_turned_as_a_solid():
    moved = np.array([figures.displacement(x) for x in np.eye(3)]).T
    assert np.allclose(moved.T @ moved, np.eye(3), rtol=0, atol=1e-14)
    assert np.linalg.det(moved) == pytest.approx(1)


@pytest.mark.parametrize("block", FIGURES, ids=[b.label for b in FIGURES])
def test_a_figure_is_what_the_equations_draw_and_fits_the_text(block):
    if block.label in lecture_figures.DRAWN:  # the other is a drawing
        drawn = lecture_figures.written(lecture_figures.DRAWN[block.label](CLAIMS))
        assert (figures.PICTURES / f"{block.label}.json").read_text(encoding="utf-8") == drawn
    scene = figures.FIGURES[block.label](CLAIMS)
    assert scene.width <= 127
    reach = [p for s in scene.strokes for p in s.points]
    reach += [p for x in scene.labels for p in (x.box[:2], x.box[2:])]
    assert np.all(np.array(reach) >= -0.5)
    assert np.all(np.array(reach) <= np.array([scene.width, scene.height]) + 0.5)


def test_every_figure_is_in_the_text_and_no_other():
    labels = {b.label for b in FIGURES}
    assert labels == {*figures.FIGURES} == {"theory", *lecture_figures.DRAWN}


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_pictures_in_a_language(lang):
    """Numbers with its decimal mark, the same letters in all; each is described in words."""
    page = document.page(document.Lecture(CHAPTERS, language(lang), records()))
    assert page == shown("page", lang)  # of another process
    drawn = re.findall(r"<svg.*?</svg>", page, re.S)
    labels = [re.sub(r"<[^>]+>", "", x) for s in drawn for x in re.findall("<text.*?</text>", s)]
    assert (("0,5" in labels), ("0.5" in labels)) == (lang == "fr", lang == "en")
    for picture, block in zip(drawn, FIGURES, strict=True):
        (description,) = block.entries[0].texts[LANGUAGES.index(lang)]
        assert f"<title>{description}</title>" in picture
        assert len(description) > 80
    latex = shown("latex", lang)
    assert latex.count(r"\begin{tikzpicture}") == latex.count(r"\BeginAccSupp") == len(FIGURES)


def test_a_caption_says_the_numbers_of_its_figure():
    (tilts,) = (b for b in FIGURES if b.label == "tilts")
    said = {x.text for x in tilts.entries[1].formulas}
    drawn = lecture_figures.PARAMETERS | {"𝒥₂": lecture_figures.SPIN}
    assert {f"{x} = {Fraction(str(y))}" for x, y in drawn.items()} <= said


@pytest.mark.parametrize(
    ("label", "starts"),
    [
        ("tetrahedron", lecture_figures.VELOCITY),
        ("ellipse", lecture_figures.STRAIN),
        ("carried", [group_figures.CIRCLE[:2]]),
    ],
)
def test_a_caption_says_from_where_its_figure_starts(label, starts):
    (figure,) = (b for b in FIGURES if b.label == label)
    english, french = map(str, figure.entries[1].texts)
    for row in starts:
        numbers = [f"{x:g}".replace("-", "−") for x in row]
        assert f"({', '.join(numbers)})" in english
        assert f"({' ; '.join(numbers)})".replace(".", ",") in french


def test_after_how_many_turns_the_racket_flips():
    """A quarter of the period of ζ₂, K(m)/rate, as in Landau and Lifshitz, § 37, for the deviations
    that the caption tells."""
    (caption,) = (e for b in FIGURES if b.label == "polhodes" for e in b.entries[2:])
    words = "".join(x for x in caption.texts[0] if isinstance(x, str))
    i1, i2, i3 = figures.RACKET.moments

    def turns(tilt):
        twice, square = i1 * tilt**2 + i2, (i1 * tilt) ** 2 + i2**2
        assert square < twice * i2
        rate = np.sqrt((i2 - i1) * (twice * i3 - square) / (i1 * i2 * i3))
        m = (i3 - i2) * (square - twice * i1) / ((i2 - i1) * (twice * i3 - square))
        return ellipk(m) / rate / (2 * np.pi)

    told = [*map(float, re.findall(r"(?<=after )[0-9.]+(?= turns)|(?<=every )[0-9.]+(?=;)", words))]
    assert told == [round(x, 1) for x in (turns(1 / 250), 2 * turns(1 / 250), turns(1 / 10))]


def test_the_racket_is_a_plate_and_the_captions_say_so():
    for moments in (figures.RACKET.moments, motion_figures.MOMENTS):
        assert moments[2] == moments[0] + moments[1]
        told = ", ".join(f"{x:g}" for x in moments[:2]) + f" and {moments[2]:g}"
        captions = ["".join(map(str, e.texts[0])) for b in FIGURES for e in b.entries[1:]]
        assert sum(f"of a plate, {told}" in x for x in captions) == 2


def test_a_figure_without_a_description_is_refused():
    text = "chapter c\n  A\n  B\nrecords so3\nfigure polhodes\n  Curves.\n  Courbes.\n"
    with pytest.raises(LectureError, match="line 5: a figure begins with a description"):
        parsed(text, "c.txt")


def test_the_momentum_stays_on_an_orbit_and_a_level_as_the_structure_of_its_algebra_says():
    """By Poisson's tensor of the commutators, and on surfaces that are known of each group."""
    constant = {"SO(3)": (1, 1, 1), "SE(2)": (1, 1, 0), "SL(2)": (1, 1, -1)}
    for orbit in group_figures.ORBITS:
        basis, metric = np.array(orbit.basis), np.array(orbit.metric)
        rows = basis.reshape(3, -1).T
        products = np.einsum("aij,bjk->abik", basis, basis)
        brackets = (products - products.transpose(1, 0, 2, 3)).reshape(9, -1)
        structure = np.linalg.lstsq(rows, brackets.T, rcond=None)[0].reshape(3, 3, 3)
        rate = group_figures.on_orbit(CLAIMS, orbit)
        for p in np.eye(3)[:, None] + np.array([[0.3, -1.1, 0.7]]):
            found = np.einsum("c,cab,a->b", p[0], structure, p[0] / metric)
            assert np.allclose(rate(tuple(p[0])), found, rtol=0, atol=1e-12)
        closed = 0
        for role, angle, height in orbit.starts:
            path = np.array(group_figures.path_on_orbit(CLAIMS, orbit, angle, height))
            assert np.ptp(path**2 @ constant[orbit.name]) < 1e-4
            assert np.ptp(path**2 @ (1 / metric)) < 1e-4
            closed += np.array_equal(path[0], path[-1])
            assert role == "second" or np.array_equal(path[0], path[-1])
        assert closed >= 8


def test_the_centre_of_mass_of_the_hammer_falls_as_a_point_and_its_handle_moves_as_a_solid():
    run = group_figures.flight(CLAIMS, group_figures.FLIGHT, 240)
    m, c, inertia = group_figures.hammer()
    times = np.array([t for t, *_ in run])[:, None]
    centre = np.array([A @ c / m + T for _, A, T in run])
    fall = times * group_figures.THROWN + times**2 / 2 * group_figures.GRAVITY
    assert np.allclose(centre - centre[0], fall, rtol=0, atol=1e-6)
    turned = [np.arctan2(A[1, 0], A[0, 0]) for _, A, _ in run]
    rate = group_figures.TURNING[2]
    assert np.allclose(np.unwrap(turned), rate * times[:, 0], rtol=0, atol=1e-6)
    length, sides = group_figures.HANDLE[0], group_figures.HEAD[0]
    masses = (group_figures.HANDLE[1], group_figures.HEAD[1])
    assert m == pytest.approx(sum(masses))
    about = masses[0] * length**2 / 3
    about += masses[1] * ((sides[0] ** 2 + sides[1] ** 2) / 12 + (length + sides[0] / 2) ** 2)
    assert inertia[2, 2] == pytest.approx(about)


def test_the_flow_of_the_figure_satisfies_eulers_equation_and_keeps_the_circulation():
    """By SymPy, from the stream function and the pressure that the exercise tells."""
    x, y = sympy.symbols("x y")
    (exercise,) = (b for c in CHAPTERS for b in c.blocks if b.label == "cells")
    told = exercise.entries[0].formulas[0].text.partition(" = ")[2]
    psi = sympy.sympify(re.sub(r"(?<=[)\d]) (?=[\w])", "*", told), locals={"x": x, "y": y})
    u, v = psi.diff(y), -psi.diff(x)
    p = -(u**2 + v**2) / 2 - sympy.Rational(5, 2) * psi**2
    for rate, place in ((u, x), (v, y)):
        assert sympy.simplify(u * rate.diff(x) + v * rate.diff(y) + p.diff(place)) == 0
    at = np.random.default_rng(5).uniform(0, np.pi, (2, 9))
    wanted = sympy.lambdify((x, y), (u, v))(*at)
    assert np.allclose(group_figures.velocity(*at), wanted, rtol=0, atol=1e-12)
    assert all(psi.subs(z, end) == 0 for z in (x, y) for end in (0, sympy.pi))
    told = [group_figures.along(*z) for _, *z in group_figures.carried(1.6, 160)]
    lengths, circulation = np.array(told).T
    assert np.allclose(circulation, circulation[0], rtol=1e-6, atol=0)
    assert 3 < lengths[-1] / lengths[0] < 4
    assert abs(circulation[0]) > 1


def test_the_steps_of_the_figure_are_those_of_moser_and_veselov():
    """From the momenta alone: the rotation that each step is keeps the momentum in space, and is
    what the momentum h⁻¹(W J − J W̄) belongs to."""
    moments, h = np.array(group_figures.INERTIA), group_figures.STEP
    J = np.diag(moments.sum() / 2 - moments)
    first = group_figures.ORBITS[0].surface(*group_figures.STARTED[0])
    run = group_figures.in_steps(CLAIMS, first, h, 25)
    g, spaces = np.eye(3), []
    for momentum in run[:-1]:
        M = np.array([np.cross(momentum, e) for e in np.eye(3)]).T
        spaces.append(g @ M @ g.T)

        def missing(x, M=M):
            W = Rotation.from_rotvec(x).as_matrix()
            return ((W @ J - J @ W.T) / h - M)[[2, 0, 1], [1, 2, 0]]

        turn = fsolve(missing, h * np.array(momentum) / moments, xtol=1e-13)
        g = g @ Rotation.from_rotvec(turn).as_matrix()
    assert np.allclose(spaces, spaces[0], rtol=0, atol=1e-9)
    squares = np.array(run) ** 2
    assert np.ptp(squares.sum(axis=1)) < 1e-12
    assert np.ptp(squares @ (1 / moments)) < 1e-11
