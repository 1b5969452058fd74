"""A chapter on a problem of the reader's: what it claims is what records prove; a search that finds
nothing, or is refused, is a sentence."""

import ast
import math
import re
import unicodedata
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import derive
from derive.command import lecture_chapters, lecturing
from derive.command.cli import main
from derive.command.showing import derive as derived
from derive.language.limits import Refused
from derive.language.read import FormulaError
from derive.language.show import show
from derive.lecture import document
from derive.lecture.back_matter import homes
from derive.lecture.displays import blocks, tall
from derive.lecture.lecture_text import Block, Chapter, Entry, Formula, LectureError, tree
from derive.lecture.problem_chapter import (
    LONGEST,
    SEARCHES,
    Found,
    _rows,
    chapter_of,
    in_order,
)
from derive.lecture.problem_exercises import _on_motion
from derive.lecture.ran_figure import FLAT, Ran
from derive.lecture.recorded_text import REASONS, claimed, kept_by
from derive.lecture.recorded_text import reason as told_reason
from derive.lecture.recorded_text import words as words_of_record
from derive.lecture.search_sentences import SAID, TURNS, _odd_one, as_top
from derive.lecture.trials import tied, tried
from derive.motion.simulate import run
from derive.motion.trajectory import Method
from derive.programs import motion_of
from derive.record import prose as texts
from derive.record.prose import message
from derive.record.record import Equation, Step
from derive.record.sentence import Claim, phrase
from derive.views.answer import definitions, equations_of_motion
from derive.views.language import LANGUAGES, language
from derive.views.outline import title
from derive.views.printing.signs import tex_text
from tests.support import corpus
from tests.support.lectures import by_itself
from tests.support.walks import SEED

RECORDS = lecturing.RECORDS
chapter_on = partial(lecture_chapters.chapter_on, searches=lecturing.SEARCHES)
NAMES = ("lagrange_top", "hung_bar", "sl3")


@pytest.fixture(scope="module", params=NAMES)
def made(request):
    return request.param, *chapter_on(request.param)[:2]


def test_every_equation_holds_and_is_of_a_record(made):
    name, chapter, records = made
    tied(chapter, records)
    claims = [*tried(chapter, records, SEED)]
    motion = equations_of_motion(records[name])
    told = [x.equation for x in claims]
    first = told.index(motion[0])
    assert told[first : first + len(motion)] == [*motion]


def test_a_changed_equation_is_refused(made):
    name, chapter, records = made
    first = equations_of_motion(records[name])[0]
    wrong = Equation(first.lhs, ("mul", 2, first.rhs))

    def with_wrong(e):
        (recorded,) = (x.recorded for x in e.formulas) if e.display else [()]
        return (
            replace(e, texts=((replace(e.formulas[0], recorded=(wrong,)),),) * len(LANGUAGES))
            if recorded[:1] == (first,)
            else e
        )

    blocks = tuple(replace(b, entries=tuple(map(with_wrong, b.entries))) for b in chapter.blocks)
    changed = replace(chapter, blocks=blocks)
    with pytest.raises(LectureError, match="does not hold"):
        list(tried(changed, records, SEED))


def alone(chapter, records, lang, shown=document.page):
    """A chapter without what it refers to in others."""
    return shown(document.Lecture([by_itself(chapter)], language(lang), records))


@pytest.mark.parametrize("lang", LANGUAGES)
def test_each_search_has_a_heading_and_something_to_say(made, lang):
    _, chapter, records = made
    words = language(lang)
    assert all(b.entries for b in chapter.blocks)
    page = alone(chapter, records, lang)
    headings = [x for search, x in SEARCHES.items() if search not in ("trim", "families")]
    for heading in (*headings, "A motion."):
        assert page.count(words.word(heading)) == 1
    assert "‘" not in re.sub("<[^>]*>", "", page)  # parameters are set, not quoted
    said = tex_text(words.word("Its equations of motion are"))
    assert said in alone(chapter, records, lang, document.latex)


def test_a_search_that_is_refused_says_why():
    chapter, records, _ = chapter_on("comet")
    page = alone(chapter, records, "en")
    refused = [
        x
        for x in ("symmetries", "reduction", "integrals", "equilibria", "families")
        if f"comet:{x}" not in records
    ]
    assert refused
    assert 0 < page.count("Not sought:") <= len(refused)  # one for one reason


def test_a_search_that_takes_too_long_is_a_sentence():
    """Each search has its own seconds, and the lecture goes on."""
    chapter, records, _ = chapter_on("lagrange_top", 0.01)
    page = alone(chapter, records, "fr")
    assert "la recherche dépasse 0,01 secondes" in unicodedata.normalize("NFKC", page)
    assert "Ses équations du mouvement sont" in page


def test_of_what_is_kept_the_value_alone_is_said_to_be_constant_and_nothing_is_too_long(made):
    """Of no variation δy is it said that ϖ(δy) is a number."""
    name, chapter, records = made
    shown = [x for b in chapter.blocks for e in b.entries for x in e.formulas]
    assert not any(re.search("ϖ\\(δ", x.text) for x in shown)
    searched = records.get(f"{name}:symmetries")
    kept = [kept_by(s) for s in searched.steps if kept_by(s) != 0] if searched else []
    assert [x for x in shown if x.text == "h̃"]
    for quantity in kept:
        assert any(x.condition and _read(x.text) == quantity for x in shown), show(quantity)
    displays = [e for b in chapter.blocks if b.kind != "solution" for e in b.entries if e.display]
    told = [(e.labels[0], x) for e in displays if e.labels for x in e.equations]
    assert all(_rows(x) <= LONGEST for label, x in told if "motion" not in label)


def _read(text):
    """A formula as a tree, or nothing for what is none."""
    try:
        return tree(text)
    except FormulaError:
        return None


def test_exercises_have_solutions_and_copies_are_wrong(made):
    """The copy of an equation with a mistake does not hold where the solution does."""
    _, chapter, records = made
    asked = [b for b in chapter.blocks if b.kind == "exercise"]
    solved = [b for b in chapter.blocks if b.kind == "solution"]
    assert len(asked) == len(solved) >= 1
    copies = [
        (a, s)
        for a, s in zip(asked, solved, strict=True)
        if "mistake" in str(a.entries[0].texts[0])
    ]
    assert copies
    for exercise, solution in copies:
        (copied,) = exercise.entries[1].formulas[0].recorded
        right = solution.entries[1]
        assert copied.lhs == right.equations[0].lhs
        wrong = replace(right, texts=((Formula("", recorded=(copied,)),),) * len(LANGUAGES))
        changed = replace(chapter, blocks=(replace(solution, entries=(wrong,)),))
        with pytest.raises(LectureError, match="does not hold"):
            list(tried(changed, records, SEED))


def test_steady_motions_that_are_not_sought_have_one_heading():
    """And the title tells of none."""
    chapter, records, _ = chapter_on("comet")
    page = alone(chapter, records, "fr")
    assert page.count("Mouvements stationnaires") == 1
    plain = [title(records["comet"], language(x)) for x in LANGUAGES]
    assert [str(x) for x in chapter.title] == plain
    assert "Lagrange's top: equations, what is kept" in str(chapter_on("lagrange_top")[0].title)


def test_each_steady_motion_is_a_sentence_with_its_conditions():
    """In letters, where they are found so; what is supposed, and the variables, are said once."""
    chapter, records, _ = chapter_on("lagrange_top")
    found = records["lagrange_top:families"].steps
    told = [e for e in chapter.entries if any(".equilibrium_" in x for x in e.labels)]
    at = [s for s in found if ".equilibrium_" in s.label]
    assert [e.labels[0] for e in told] == [s.label for s in at]
    for e in told:
        said = {x.text for x in e.formulas}
        prose = [x for s in found if s.label in e.labels for x in s.prose]
        for x in prose:
            for place in ("point", "cases"):
                told_so = str(dict(x.places).get(place, ""))
                assert {y for y in told_so.split(", ") if y} <= said
    whole = " ".join(str(x) for e in chapter.entries for x in e.texts[0])
    assert whole.count("The kinetic energy is taken to be positive definite") == 1
    variables = next(e for e in chapter.entries if "The variables are" in str(e.texts[0]))
    assert [*["Π₁", "Π₂", "Π₃", "A₃₁", "A₃₂", "A₃₃"]] == [x.text for x in variables.formulas][:6]


def test_it_begins_with_a_question_and_the_lagrangian(made):
    name, chapter, _ = made
    question, lagrangian, *_ = chapter.blocks
    assert str(question.entries[0].texts[0][0]).count("?") >= 1
    (shown,) = lagrangian.entries[1].equations
    assert shown.lhs == "L̃"
    assert lagrangian.entries[1].labels[0] in (
        f"{name}.lagrangian",
        "linear.pullback",
        "affine.pullback",
    )


def test_the_names_in_its_margins_are_listed_with_commands(made):
    name, chapter, records = made
    listed = homes([chapter], records)
    assert {*listed} == {x.partition(".")[0] for e in chapter.entries for x in e.labels}
    assert listed[name][0] == f"derive walk {name}"
    called = homes([replace(chapter, file="my body.toml")], records)[name]
    assert called[0] == "derive walk 'my body.toml'"


def test_why_the_racket_stays_is_said_in_the_language_of_the_lecture(capsys):
    chapter_on("hung_bar", lang="fr")
    assert "hung_bar: Dans le premier chapitre, la raquette reste" in capsys.readouterr().err


def told_of_steady(name):
    chapter, _, _ = chapter_on(name)
    told = [e.texts[0] for e in chapter.entries if any(".equilibrium_" in x for x in e.labels)]
    whole = ["".join(x.text if isinstance(x, Formula) else x for x in text) for text in told]
    alone = [str(e.texts[0]) for e in chapter.entries if "Of the three" in str(e.texts[0])]
    return whole, alone


def test_conditions_are_evaluated_with_the_numbers_of_the_problem(tmp_path, monkeypatch):
    """Upright: 4 I_1 mgl = 6 and ℓ₃ = 0.4 ζ₃; always so where each term is positive."""
    source = (Path(derive.__file__).parent / "problems" / "lagrange_top.toml").read_text()
    monkeypatch.chdir(tmp_path)
    for spin, verdict in (("8", "10.24 > 6: it is stable."), ("5", "6 > 4: it is unstable.")):
        Path("spun.toml").write_text(source.replace("zeta_3 = 8", f"zeta_3 = {spin}"))
        told, _ = told_of_steady("spun.toml")
        assert told[1].startswith("When it turns about e₃, its axis e₃ along e₃ of space")
        assert f"Here {verdict} Its potential energy is then the greatest" in told[1]
        assert "of the left side is positive: it is always stable. Its" in told[3]


POINT = '[[point]]\nmass = "m"\nat = {}\n'
UNEVEN = f"""name = "uneven"
group = "SO(3)"
[parameters]
m = {{ default = 1.0 }}
g = {{ default = 10.0 }}
h = {{ default = 0.1 }}
a = {{ default = 0.3 }}
b = {{ default = 0.2 }}
{"".join(map(POINT.format, (["a", 0, "h"], ["-a", 0, "h"], [0, "b", "h"], [0, "-b", "h"])))}
[[potential]]
kind = "gravity"
g = [0, 0, "-g"]
[initial]
zeta_3 = 9
"""
"""A cross that stands on its middle: I = (0.12, 0.22, 0.26), weight times height 4."""


def growth_of_uneven(spin, upright):
    """The eigenvalues of a spin about e₃, upright or not, by the rates of e₃ and the velocity."""
    a, b, c = 0.12, 0.22, 0.26
    weight = 4 * upright
    rates = [  # of ζ₁, ζ₂ and the first two components of the vertical, seen from the body
        [0, (b - c) / a * spin, 0, weight * upright / a],
        [(c - a) / b * spin, 0, -weight * upright / b, 0],
        [0, -upright, 0, spin],
        [upright, 0, -spin, 0],
    ]
    return np.linalg.eigvals(np.array(rates))


def test_where_inequalities_are_long_the_eigenvalues_are_told(tmp_path, monkeypatch):
    """With the numbers of the problem, and the momentum from which none grows."""
    monkeypatch.chdir(tmp_path)
    Path("uneven.toml").write_text(UNEVEN)
    told, _ = told_of_steady("uneven.toml")
    for upright, words in ((1, told[1]), (-1, told[3])):
        found = re.search(r"rates are about (.*?)\.(?: |$)", words)[1]
        for x in growth_of_uneven(9, upright):
            parts = (
                f"± {abs(y):.3g}{i}" for y, i in ((x.real, ""), (x.imag, "i")) if abs(y) > 1e-6
            )
            assert " ".join(parts) in found
    assert "least, as of a pendulum that hangs down" in told[3]
    start = float(re.search(r"([\d.]+) times that of the start", told[1])[1])
    assert np.abs(growth_of_uneven(0.99 * 9 * start, 1).real).max() > 1e-3
    assert np.abs(growth_of_uneven(1.01 * 9 * start, 1).real).max() < 1e-6


def test_two_steady_motions_that_differ_in_a_sign_are_told_as_one(tmp_path, monkeypatch):
    """With A₃₃ squared in the potential, upright and upside down are alike; else they differ."""
    source = (Path(derive.__file__).parent / "problems" / "lagrange_top.toml").read_text()
    monkeypatch.chdir(tmp_path)
    Path("even.toml").write_text(source.replace("mgl*A_33", "mgl*A_33^2"))
    told, _ = told_of_steady("even.toml")
    both = [x for x in told if "along e₃ of space, or opposite to it (" in x]
    assert len([x for x in both if "A₃₃ = ±1" in x]) == 2
    assert not any("A₃₃ = 1" in x or "A₃₃ = −1" in x for x in told)


def test_of_three_motions_the_odd_one_is_told_with_its_inertia(tmp_path, monkeypatch):
    """Euler's top: that about the middle axis, whatever its number is."""
    source = (Path(derive.__file__).parent / "problems" / "euler_top.toml").read_text()
    monkeypatch.chdir(tmp_path)
    for middle, axis in (("I2", "e₂"), ("I3", "e₃")):
        swapped = source.replace("I2 = {", "I0 = {").replace(f"{middle} = {{", "I2 = {")
        Path("turned.toml").write_text(swapped.replace("I0 = {", f"{middle} = {{"))
        _, (alone,) = told_of_steady("turned.toml")
        assert axis in alone
        assert "unstable for motions with the same Casimirs: its inertia, the quotient" in alone
        assert "by its velocity, is between those" in alone


def test_where_couplings_act_the_inertia_is_momentum_over_velocity(tmp_path, monkeypatch):
    """a₁ = 1.6 is more than a₂ = 1.5, and a₁ − b₁²/c₁ = 1.195 less."""
    source = (Path(derive.__file__).parent / "problems" / "kirchhoff.toml").read_text()
    monkeypatch.chdir(tmp_path)
    coupled = source.replace("a1 = { default = 1.0", "a1 = { default = 1.6")
    Path("screw.toml").write_text(coupled.replace("b1 = { default = 0.2", "b1 = { default = 0.9"))
    told = [*_odd_one(derived("screw.toml")[1], TURNS, ["stable", "unstable", "stable"])]
    assert str(told[0].texts[0]).endswith("is between those of the others.')")


def test_cases_are_told_with_or_between_them_and_with_and_inside():
    lettered = [("par", x) for x in "abc"]
    cases = (
        ("matrix", ("row", lettered[0], 0), ("row", lettered[1], 0)),
        ("matrix", ("row", lettered[2], 0)),
    )
    claim = Claim("family.stable", (("cases", ("row", *cases)),))
    said = phrase(message("family.stable"), cases="")
    step = Step("x.equilibrium_1", "solution", (), (), (said,), claims=(claim,))
    told = dict(claimed(derived("euler_top")[1], step).prose[0].places)["cases"]
    assert str(told) == "‘a’ > 0 and ‘b’ > 0; or ‘c’ > 0"
    assert language("fr").sentence(told) == "‘a’ > 0 et ‘b’ > 0\u202f; ou ‘c’ > 0"


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("‘I1’²", ""),
        ("(‘I1’² + 4 ‘I2’²)²", ""),
        ("‘I1’ ‘I2’", "‘I1’ ‘I2’ > 0"),
        ("(‘I1’ − ‘I2’)²", "(‘I1’ − ‘I2’)² > 0"),
        ("‘I3’²", "‘I3’² > 0"),
    ],
)
def test_a_condition_that_every_sign_fulfils_is_left_out(asked, told):
    """Of a parameter that has a number other than 0; I3 has none here."""
    record = derived("euler_top")[1]
    given = record.problem["parameters"]
    given = {**given, "I3": {**given["I3"], "default": None}}
    asked = [("row", tree(x), 0) for x in (asked, "‘a’")]
    claim = Claim("family.positive", (("positive", ("matrix", *asked)),))
    said = phrase(message("family.positive"), positive="")
    step = Step("x.positive_1", "solution", (), (), (said,), claims=(claim,))
    changed = replace(record, problem={**record.problem, "parameters": given})
    found = dict(claimed(changed, step).prose[0].places)["positive"]
    assert str(found) == ", ".join(x for x in (told, "‘a’ > 0") if x)


def test_a_top_that_keeps_its_tilt_is_told_with_the_momenta_of_the_start():
    """There 𝒱′ = 0: I₁ u ψ̇² − 𝒥₂ ψ̇ + mgl = 0 for ψ̇ = (𝒥₁ − u 𝒥₂)/(I₁(1 − u²)), and u is the only
    such tilt; the numbers are those of the problem: I₁ = 1, mgl = 3/2, I₃ = 2/5, ζ₃ = 8."""
    chapter, _, _ = chapter_on("lagrange_top")
    told = [e.texts[0] for e in chapter.entries if str(e.texts[0]).startswith("('Off the axes")]
    (whole,) = ("".join(x if isinstance(x, str) else x.text for x in text) for text in told)
    found = re.search(r"𝒥₁ = ([\d.]+), 𝒥₂ = ([\d.]+), at A₃₃ = ([\d.]+), where 𝒱 has a min", whole)
    upright, own, u = map(float, found.groups())
    turning = (upright - u * own) / (1 - u * u)
    assert u * turning**2 - own * turning + 1.5 == pytest.approx(0, abs=2e-2)
    assert own == pytest.approx(0.4 * 8)
    assert not any("were not sought" in str(e.texts[0]) for e in chapter.entries)


def test_an_energy_that_begins_at_zero_is_kept_to_within_rounding():
    """As that of a body that falls from rest, which has no scale of its own."""
    falls = Ran([0.0, 1.0], [("zeta_6", [0.0, -9.81])], [0.0, 1e-14])
    assert "keep their values" in falls.told(language("en"))
    assert "goes from 0 to 1" in replace(falls, energy=[0.0, 1.0]).told(language("en"))


def test_what_the_run_shows_is_read_off_it():
    """A rotation at one turn a second, seen in the energy, the extremes and the maxima."""
    times = [k / 100 for k in range(301)]
    wave = [2 + math.sin(2 * math.pi * t) for t in times]
    kept = {("angular momentum", 3, "angular_momentum_3"): [5.0] * len(times)}
    units = {"t": "s", "energy": "J", "angular_momentum_3": "kg m^2/s"}
    energy = [7.0] * len(times)
    ran = Ran(times, [("zeta_1", wave)], energy, units=units, kept=kept, turned=3.0)
    told = ran.told(language("en"))
    assert "at 3 s" in told
    assert "energy = 7 J and angular momentum about e₃ = 5 kg m²/s" in told
    assert "goes up and down between 1 and 3, once in 1 s on the average" in told
    assert "add up to 3 turns" in told
    assert "goes from 7 to 8" in replace(ran, energy=[7.0, 8.0]).told(language("en"))


def test_axes_are_named_in_a_product_and_columns_stand_side_by_side():
    chapter, _, _ = chapter_on("two_tops", 20)
    (told,) = [e for e in chapter.entries if "two_tops.conserved_3" in e.labels]
    assert [x.text for x in told.formulas] == ["e₁", "e₂", "e₃"]
    columns = [Equation(("at", "r", k), ("matrix", *[k] * 6)) for k in (1, 2, 3)]
    assert blocks(columns).count("qquad") == 2


def test_what_the_record_says_of_stability_is_said():
    """But that a form is indefinite and roots imaginary, which proves nothing."""
    kinds = ("equilibrium", "family", "enclosure")
    told = {k: texts.unmarked(x[0]) for k, x in texts.sentences().items()}
    listed = {k: x for k, x in told.items() if k.partition(".")[0] in kinds}
    telling = {k for k, x in listed.items() if re.search("stab(?:le|ility)|on the leaf is", x)}
    silent = {"family.open", "family.imaginary"}  # said of all at once, or of no use alone
    assert len(telling) > 15
    assert {listed[k] for k in telling - silent} <= {*SAID}


def test_a_number_in_brackets_before_a_parameter_is_of_the_formula():
    """Or the bracket is closed in the formula, and no line of it breaks."""
    cases = language("en").marked.formula("(1) (30 ‘M’³ + 8 ‘m’) ‘R’ < 0; (2) 3 ‘m’ > ‘M’")
    told = words_of_record(f"unstable where {cases}")
    formulas = [x.text for x in told if isinstance(x, Formula)]
    assert formulas == ["(30 ‘M’³ + 8 ‘m’) ‘R’ < 0", "3 ‘m’ > ‘M’"]


def test_definitions_stand_behind_those_of_their_letters():
    defined = definitions(derived("hammer")[1], equations_of_motion(derived("hammer")[1]))
    letters = [e.lhs for e in in_order(defined)]
    assert {*letters} == {e.lhs for e in defined}
    for before, after in (("c", "r_c"), ("m", "r_c"), ("J", "J_c"), ("J_c", "I_c")):
        assert letters.index(before) < letters.index(after)


def test_a_coordinate_without_energy_is_said_to_be_held_by_choice():
    chapter = chapter_on("spherical_pendulum", 0.01)[0]
    (held,) = [e for e in chapter.entries if e.labels == ("spherical_pendulum.mass",)]
    assert held.texts[0][0].startswith("One coordinate for each direction")
    (said,) = [e for e in chapter.entries if "keep their values" in str(e.texts[0])]
    assert "energy = −4.269" in str(said.texts[0])
    assert "-" not in "".join(x for x in said.texts[0] if isinstance(x, str))


def test_an_exercise_on_a_motion_says_its_start_and_asks_what_can_be_foretold():
    """The ends are those that the run comes to; the bound is of the cubic, not of the run."""
    chapter, records, _ = chapter_on("lagrange_top")
    (asked,) = [b for b in chapter.blocks if "Predict" in str(b.entries[0].texts[0])]
    told = [x.text for x in chapter.blocks[0].entries[0].formulas]
    assert {"A₃₃ = 0.8776", "ζ₃ = 8"} <= {*", ".join(told).split(", ")}
    assert "A₃₃" in [x.text for x in asked.entries[0].formulas]
    assert not any(x.startswith("A₁₁") or x.endswith("= 0") for x in told)
    answer = chapter.blocks[chapter.blocks.index(asked) + 1].entries[0]
    assert answer.labels == ("lagrange_top.quadrature",)
    problem, record = derived("lagrange_top")
    tilts = run(motion_of(problem, record), problem, Method(), None, 400, given={}, compiled=False)
    heights = tilts.of_kind("state")["A_33"]
    said = "".join(map(str, answer.texts[0]))
    ends = [float(x) for x in re.findall(r"0\.[0-9]{3}\b", said)[:2]]
    assert ends == pytest.approx([min(heights), max(heights)], abs=2e-3)
    start = {**dict.fromkeys(("curves", "times"), ()), "energy": (1.0,)}
    assert [*_on_motion(record, records["lagrange_top:integrals"].steps, Ran(**start))] == []


def test_the_heavy_top_of_the_lecture_is_known_by_its_lagrangian(tmp_path):
    """Under other names, and in another form; a body that is like it is not."""
    form = """name = "mine"
group = "SO(3)"
parameters = {{ k = {{ default = 1 }}, a = {{ default = 2 }}, b = {{ default = 3 }} }}
[lagrangian]
L = "a*zeta_1^2/2 + {other}*zeta_2^2/2 + b*zeta_3^2/2 - k*A_33"
"""
    for other, names in (("a", ("a", "b", "k")), ("b", ())):
        file = tmp_path / "mine.toml"
        file.write_text(form.format(other=other), encoding="utf-8")
        assert as_top(derived(str(file))[1]) == names


def test_a_motion_that_stays_has_no_figure():
    record = derived("lagrange_top")[1]
    still = Ran((0.0, 1.0), [("zeta_3", (8.0, 8.0))])
    chapter = chapter_of(record, {}, ("lagrange_top",), ran=still)
    assert [b.label for b in chapter.blocks if b.kind == "figure"] == ["body_lagrange_lftop"]
    said = [str(x) for e in chapter.entries for x in e.texts[0]]
    assert any(FLAT in x for x in said)


def test_the_letters_of_curves_stand_at_their_ends_apart_from_one_another():
    ran = Ran((0.0, 1.0), [(f"zeta_{k}", (0.0, y)) for k, y in ((1, 2.0), (2, 2.01), (3, -1.0))])
    ends = {x.index: x.at for x in ran.picture({}).labels if x.base == "ζ"}
    assert ends["3"][1] < ends["1"][1] < ends["2"][1]
    assert ends["2"][1] - ends["1"][1] > 4
    assert min(x for x, _ in ends.values()) > 106
    both = replace(ran, state={"A₃₃": (0.5, 0.9)}).picture({}, ["A₃₃"])
    assert [x.base for x in both.labels if x.index == "33"] == ["A"]
    assert both.width <= ran.picture({}).width


def test_a_long_formula_of_a_sentence_stands_apart_with_the_sign_behind_it():
    long = Formula("a = " + " + ".join("bcdefghijk"), condition=True)
    entry = Entry((("For all, ", long, "; and more."),) * 2, (), display=False, line=0)
    chapter = Chapter("c", ("A", "B"), (), (Block("text", "", "", (entry,), 0),))
    assert len(long.text) <= document.AMONG
    assert "\\[" not in _body(chapter)
    wider = replace(long, text=long.text.replace("b", "b + b + b + b + b + b"))
    entry = Entry((("For all, ", wider, "; and more."),) * 2, (), display=False, line=0)
    chapter = replace(chapter, blocks=(Block("text", "", "", (entry,), 0),))
    assert re.search(r"For all,\s+\\\[[^]]*;\\\]\s+and more", _body(chapter))


def _body(chapter):
    """The LaTeX of its only text."""
    tex = document.latex(document.Lecture([chapter], language("en"), {}))
    return tex[tex.index("For all") : tex.index("and more") + 8]


def test_brackets_about_fractions_are_as_tall():
    assert tall(r"2(a)(b(\frac{c}{d} - e))^2") == (
        r"2(a)\biggl(b\biggl(\frac{c}{d} - e\biggr)\biggr)^2"
    )


def test_parameters_have_a_table_and_the_body_a_figure():
    chapter, records, _ = chapter_on("lagrange_top")
    (table,) = [b for b in chapter.blocks if b.kind == "table"]
    given = records["lagrange_top"].problem["parameters"]
    assert len(table.entries) == 3 * len(given)
    page = alone(chapter, records, "fr")
    for about in given.values():
        assert language("fr").word(about["meaning"]) in page
    assert len(chapter.figures) == page.count("<svg") == 2


@pytest.mark.parametrize("reason", REASONS)
def test_a_reason_is_told_in_french_with_its_numbers(reason):
    told = re.sub(r"\{\w+\}", "7", reason)
    assert told_reason(told, language("en")) == told
    french = told_reason(told, language("fr"))
    assert french != told
    assert sorted(re.findall("[0-9]+", french)) == sorted(re.findall("[0-9]+", told))
    assert told_reason("no reason of these", language("fr")) == "no reason of these"


REFUSING = (
    *("integrals/reduced.py", "symmetries/scalar_lagrangian.py", "symmetries/search.py"),
    *("symmetries/found_symmetries.py", "symmetries/conditions.py", "symmetries/routhian.py"),
)
"""What refuses a whole search of a lecture, in derive/search."""
ELSEWHERE = ("damping changes the energy",)
"""Of what the lecture does not seek."""


def refusals():
    """The texts of what is raised in these, with 7 in each place and without a problem's name."""
    for name in REFUSING:
        source = Path(derive.__file__).parent / "search" / name
        for node in ast.walk(ast.parse(source.read_text(encoding="utf-8"))):
            called = getattr(getattr(node, "func", None), "id", getattr(node, "func", None))
            own = getattr(called, "attr", "") == "refuse"
            if isinstance(node, ast.Call) and (own or str(called).endswith("Error")):
                text = "".join(map(_literal, getattr(node.args[0], "values", node.args)))
                if " " in text and text != "7: the Lagrangian 7":
                    yield f"the Lagrangian {text}" if own else text.removeprefix("7: ")


def _literal(x):
    """The text of a part of an argument; 7 in the place of a value."""
    return str(x.value) if isinstance(x, ast.Constant) else "7"


def test_each_refusal_of_a_search_has_its_french():
    found = [x for x in refusals() if not x.startswith(ELSEWHERE)]
    assert len(found) > 15
    assert [x for x in found if told_reason(x, language("fr")) == x] == []


@pytest.mark.parametrize("name", ["imu", "linear", "ideal_fluid", "zeitlin", "pendulum", "screw"])
def test_what_ready_made_problems_are_refused_for_is_in_french(name):
    problem, record = derived(name)
    for search in ("integrals", "reduction", "equilibria"):
        with suppress(Refused):
            RECORDS[search](problem, record)
            continue
        with pytest.raises(Refused) as refused:
            RECORDS[search](problem, record)
        told = str(refused.value).removeprefix(f"{name}: ")
        assert told_reason(told, language("fr")) != told


def test_what_a_driven_fluid_is_refused_for_is_in_french():
    driven = corpus.stirred_torus(3)
    assert told_reason(driven.unsearched.removeprefix("fluid: "), language("fr")).startswith("sym")


def test_searches_refused_for_one_reason_stand_together(made):
    records = made[2]
    d = records[made[0]]
    reason = f"{d.name}: its forces are no part of L̃"
    found = dict.fromkeys(("symmetries", "integrals", "reduction"), Found(refused=reason))
    found["equilibria"] = Found()
    chapter = chapter_of(d, found, tuple(records))
    page = alone(chapter, records, "en")
    assert "What the motion keeps. First integrals. Reduction." in page
    assert page.count("Not sought: its forces are no part of") == 1
    assert "None with at most one momentum" in page


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("", "pour le reste dans la position de référence et sans commande"),
        (
            'force = [{ covector = ["lift^3"] }]',
            "le corps est dans la position de référence, et sans commande",
        ),
    ],
)
def test_inputs_that_hold_a_body_are_told(more, said, tmp_path, monkeypatch):
    """Exact, and within bounds; never g = 1, beside a weight by g."""
    monkeypatch.chdir(tmp_path)
    Path("hung.toml").write_text(HUNG + more, encoding="utf-8")
    chapter, records, _ = chapter_on("hung.toml")
    assert "hung:trim" in records
    page = alone(chapter, records, "fr")
    assert "Au repos, grâce à ses commandes." in page
    assert said in page
    assert not re.search(r"g\$? *= *1\b", page)
    assert len([*tried(chapter, records, SEED)]) >= 2


HUNG = """
name = "hung"
group = "R(1)"
point = [{ mass = 2, at = [0] }]
potential = [{ kind = "gravity", g = [-10] }]
input = [{ name = "lift", kind = "force", on = 1, frame = "space", direction = [1] }]
"""


def test_by_the_command(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["lecture", "pendulum", "--out", "l.html"]) == 0
    assert "A pendulum in the plane" in (tmp_path / "l.html").read_text(encoding="utf-8")
    (tmp_path / "so3.toml").write_text(
        'name = "so3"\ngroup = "SO(3)"\n[body]\nsolid = "ball"\ndensity = 1\nradius = 1\n',
        encoding="utf-8",
    )
    capsys.readouterr()
    assert main(["lecture", "so3.toml", "--out", "m.html"]) == 2
    assert "the lecture has another 'so3'" in capsys.readouterr().err
    assert not (tmp_path / "m.html").exists()
