"""Fresh numbers in the exercises: the same for one seed, others for another, none without; values
by NumPy and SciPy, from the numbers that are printed, by laws that share no code with the text."""

import math
import re
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive.command.cli import main
from derive.command.lecturing import named_by
from derive.lecture import document
from derive.lecture.fresh_numbers import drawn, value
from derive.lecture.lecture_text import LectureError, chapters, parsed, tree
from derive.lecture.trials import tied, tried
from derive.views.language import LANGUAGES, language
from tests.support.lectures import by_itself, records, shown
from tests.support.walks import SEED

RAW = chapters(fresh=True)
CLAIMS = document.claims_of(RAW)
SEEDS = (0, 3, 11)


def read(text):
    """A printed number, vector or matrix."""
    for sign, plain in zip("−½⅓⅔¼", ("-", "1/2", "1/3", "2/3", "1/4"), strict=True):
        text = text.replace(sign, plain)
    if text == "𝟏":
        return np.eye(3)
    if text[0] == "(":
        return np.array([float(Fraction(x)) for x in text[1:-1].split(", ")])
    if text[0] == "[":
        rows = text[1:-1].split("; ")
        return np.array([[float(Fraction(x)) for x in row.split(", ")] for row in rows])
    return float(text) if "." in text else float(Fraction(text))


def told(seed):
    """Label of an exercise → the numbers of its letters, and the values of its solution."""
    found, label = {}, ""
    for block in (b for c in drawn(RAW, seed, CLAIMS) for b in c.blocks):
        label = block.label if block.kind == "exercise" else label
        formulas = [f for e in block.entries if e.fresh for f in e.formulas if f.value]
        values = [(f.text, read(re.sub("^ [=≈] ", "", f.value))) for f in formulas]
        if block.kind == "exercise" and values:
            found[label] = dict(values), []
        elif values:
            found[label][1].extend(x for _, x in values)
    return found


@pytest.fixture(scope="module", params=SEEDS)
def exercises(request):
    return told(request.param)


def test_the_same_seed_gives_the_same_numbers_and_another_others():
    assert drawn(RAW, 3, CLAIMS) == drawn(RAW, 3, CLAIMS)
    letters = [{k: str(x) for k, (x, _) in told(seed).items()} for seed in SEEDS]
    assert len(letters[0]) == 15
    for k in range(len(SEEDS)):
        same = sum(x == y for x, y in zip(*(letters[j - k].values() for j in (0, 1)), strict=True))
        assert same < 7


def test_the_flip(exercises):
    """σ: the eigenvalue of the linearised equations; the half turn: by SciPy."""
    given, (sigma, time, half) = exercises["flip"]
    moments = np.array([given[f"λ{k}"] for k in "₁₂₃"])
    assert moments[2] < moments[0] + moments[1]  # some body has them
    w, tilt = given["ζ₂"], given["ε"]

    def rate(_, z):
        return np.cross(moments * z, z) / moments

    steps = [rate(0, (0, w, 0) + 1e-6 * e) / 1e-6 for e in np.eye(3)]
    assert sigma == pytest.approx(np.linalg.eigvals(np.array(steps).T).real.max(), rel=6e-3)
    assert time == pytest.approx(math.log(1 / tilt) / sigma, rel=2e-2)

    def turned(_, z):
        return z[1]

    turned.terminal = True
    run = solve_ivp(rate, (0, 99), [tilt * w, w, 0], events=turned, rtol=1e-10, atol=1e-12)
    assert half == pytest.approx(run.t[-1], rel=6e-3)


def test_inertia_and_energy(exercises):
    given, (inertia, energy, printed) = exercises["sign"]
    J, zeta = given["J"], given["ζ"]
    points = np.sqrt(np.diag(J))[:, None] * np.eye(3)  # points of mass 1 on the axes
    wanted = sum(np.linalg.norm(np.cross(zeta, r)) ** 2 for r in points) / 2
    assert (energy, printed) == pytest.approx((wanted, -wanted))
    assert zeta @ inertia @ zeta / 2 == pytest.approx(wanted)
    given, (right, wrong) = exercises["omission"]
    moments = [given[f"λ{k}"] for k in "₁₂₃"]
    zeta = np.array([0, given["ζ₂"], given["ζ₃"]])
    assert wrong == pytest.approx((np.cross(moments * zeta, zeta) / moments)[0])
    assert right - wrong == pytest.approx(given["φ₁"])
    given, (momentum, rate) = exercises["again"]
    assert np.allclose(momentum, given["I"] @ given["ζ"])
    assert np.allclose(rate, np.cross(momentum, given["ζ"]))


def test_tops(exercises):
    """Precession by roots of the momentum law; the fall by the law of the angular momentum."""
    given, found = exercises["steady"]
    across, weight, u, spin = (given[x] for x in ("‘I_1’", "‘mgl’", "A₃₃", "𝒥₂"))
    assert found == pytest.approx(sorted(np.roots([across * u, -spin, weight])), rel=6e-3)
    given, (rate,) = exercises["horizontal"]
    assert rate == pytest.approx(given["‘mgl’"] / given["𝒥₂"])
    given, (lower,) = exercises["cusps"]
    across, weight, u, spin = (given[x] for x in ("‘I_1’", "‘mgl’", "A₃₃", "𝒥₂"))
    n, up = np.array([math.sqrt(1 - u * u), 0, u]), np.array([0, 0, 1])

    def moved(_, x):
        return [*(np.cross(x[3:], x[:3]) / across), *np.cross(x[:3], -weight * up)]

    times = np.linspace(0, 12, 4000)
    run = solve_ivp(moved, (0, 12), [*n, *(spin * n)], t_eval=times, rtol=1e-9, atol=1e-10)
    assert run.y[2].min() == pytest.approx(lower, abs=6e-3)


def test_solids_in_space(exercises):
    given, (moment,) = exercises["arm"]
    assert np.allclose(moment, given["μ"] - np.cross(given["r_c"], given["F_b"]))
    given, (right, wrong) = exercises["exchanged"]
    moved = given["δA = j(Ω)"]
    assert np.array_equal(moved, -moved.T)  # tangent to the rotations at 1
    assert np.array_equal(moved @ given["c"], np.cross(given["Ω"], given["c"]))
    assert right == pytest.approx((moved @ given["c"]) @ given["τ"])
    assert wrong == pytest.approx((moved @ given["τ"]) @ given["c"])
    given, (turning, moving, *zeros) = exercises["casimirs"]
    ell, p, zeta, w = (given[x] for x in ("ℓ_b", "p_b", "ζ", "w"))
    assert np.allclose(turning, np.cross(ell, zeta) + np.cross(p, w))
    assert np.allclose(moving, np.cross(p, zeta))
    assert zeros == [0, 0]


def test_what_keeps_its_volume_and_the_fluid(exercises):
    """With θ, the second derivative of det A vanishes: Tr Ż = 0 for Ż = θJ⁻¹ − Z²."""
    given, (theta,) = exercises["straight"]
    J, Z = given["J"], given["Z"]
    assert np.trace(Z) == 0
    h = 1e-3
    second = theta * np.linalg.inv(J)
    dets = [np.linalg.det(np.eye(3) + s * Z + s * s / 2 * second) for s in (-h, 0, h)]
    assert abs(dets[0] - 2 * dets[1] + dets[2]) / h**2 < 1e-2
    given, (pressure,) = exercises["as_a_solid"]
    radii = np.linspace(0, given["r"], 1001)
    assert pressure == pytest.approx(np.trapezoid(given["ω"] ** 2 * radii, radii))


def test_steps_of_time(exercises):
    given, (momentum, grown) = exercises["simplest"]
    rate = np.cross(momentum, given["ζ"])
    assert np.allclose(momentum, given["I"] @ given["ζ"])
    assert grown == pytest.approx(given["h"] ** 2 * rate @ rate)
    given, (before, after, wrong) = exercises["turned"]
    J, W, h = given["J"], given["W₀"], given["h"]
    assert np.allclose(W.T @ W, np.eye(3))
    assert np.linalg.det(W) > 0
    assert np.trace(W) > 2  # the turn of a short step
    assert np.allclose(before, (W @ J - J @ W.T) / h)
    # in space the momentum stays: g₁ = W for g₀ = 1
    assert np.allclose(W @ after @ W.T, before)
    assert not np.allclose(W @ wrong @ W.T, before)
    given, (there,) = exercises["point_in_steps"]
    step = (there - 2 * given["y₁"] + given["y₀"]) / given["h"] ** 2
    assert np.allclose(given["m"] * step, given["F"])


def test_every_claim_of_a_text_with_numbers_holds():
    claims = []
    for fresh in drawn(RAW, 5, CLAIMS):
        mine = named_by(fresh, records())
        tied(fresh, mine)
        asked = [b for b in fresh.blocks if any(x.fresh for x in b.entries)]
        only = [replace(b, entries=tuple(x for x in b.entries if x.fresh)) for b in asked]
        claims += [*tried(replace(fresh, blocks=tuple(only)), mine, SEED)]
    assert len(claims) >= 6


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_pages(lang):
    """Without a seed no number is there; with one the text around them is the same."""
    words = language(lang)
    lead = words.word("In numbers:")
    assert lead not in shown("page", lang)
    page = document.page(document.Lecture(drawn(RAW, 3, CLAIMS), words, records()))
    assert page.count(lead) >= 20
    assert "#turned" not in page
    assert "$ " not in re.sub("<style>.*?</style>", "", page, flags=re.S)


def test_by_the_command(tmp_path, capsys, monkeypatch):
    """Of one chapter."""
    out = tmp_path / "l.tex"
    one = [by_itself(x) for x in RAW if x.name == "volume"]
    monkeypatch.setattr("derive.lecture.lecture_text.chapters", lambda fresh: fresh and one)
    assert main(["lecture", "--seed", "7", "--out", str(out)]) == 0
    own = document.Lecture(drawn(one, 7, document.claims_of(one)), language("en"), records())
    assert out.read_text(encoding="utf-8") == document.latex(own)
    with pytest.raises(SystemExit, match="2"):
        main(["lecture", "--seed", "-1", "--out", str(out)])
    capsys.readouterr()


@pytest.mark.parametrize("wanted", ["?ζ = Ω = #", "?ζ ≈ #", "?x = λ₁⁻¹ = #"])
def test_a_value_that_is_none_is_refused_with_its_line(wanted):
    text = (
        "chapter c\n  A\n  B\nrecords so3\nexercise e\n  One.\n  Un.\n  $ = λ₁ = 0\n"
        f"solution\n  $ So `{wanted}`.\n  $ Donc `{wanted}`.\n"
    )
    with pytest.raises(LectureError, match=r"c\.txt, line 10: "):
        drawn([parsed(text, "c.txt")], 1, CLAIMS)


def test_roots_are_exact_where_they_can_be():
    assert value(tree("√(9/4)"), {}) == Fraction(3, 2)
    assert isinstance(value(tree("√(2)"), {}), float)
