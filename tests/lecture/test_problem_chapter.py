"""A chapter on a problem of the reader's: what it claims is what records prove; a search that finds
nothing, or is refused, is a sentence."""

import re
import unicodedata
from dataclasses import replace
from pathlib import Path

import pytest

from derive.command.cli import main
from derive.command.lecturing import chapter_on
from derive.language.show import show
from derive.lecture import document
from derive.lecture.lecture_text import Formula, LectureError
from derive.lecture.problem_chapter import (
    LONGEST,
    REASONS,
    SEARCHES,
    Found,
    _reason,
    _rows,
    chapter_of,
)
from derive.lecture.trials import tied, tried
from derive.record.record import Equation
from derive.views.answer import equations_of_motion
from derive.views.language import LANGUAGES, language
from derive.views.printing.signs import tex_text
from tests.support.walks import SEED

NAMES = ("lagrange_top", "hung_bar", "sl3")


@pytest.fixture(scope="module", params=NAMES)
def made(request):
    return request.param, *chapter_on(request.param)[:2]


def test_every_equation_holds_and_is_of_a_record(made):
    name, chapter, records = made
    tied(chapter, records)
    claims = [*tried(chapter, records, SEED)]
    motion = equations_of_motion(records[name])
    assert [x.equation for x in claims][: len(motion)] == [*motion]


def test_a_changed_equation_is_refused(made):
    name, chapter, records = made
    first = equations_of_motion(records[name])[0]
    wrong = Equation(first.lhs, ("mul", 2, first.rhs))
    (text, *others) = chapter.blocks
    entries = [
        replace(e, texts=((replace(e.formulas[0], recorded=(wrong,)),),) * len(LANGUAGES))
        if e.display and e.formulas[0].recorded[0] == first
        else e
        for e in text.entries
    ]
    changed = replace(chapter, blocks=(replace(text, entries=tuple(entries)), *others))
    with pytest.raises(LectureError, match="does not hold"):
        list(tried(changed, records, SEED))


@pytest.mark.parametrize("lang", LANGUAGES)
def test_each_search_has_a_heading_and_something_to_say(made, lang):
    _, chapter, records = made
    words = language(lang)
    assert all(b.entries for b in chapter.blocks)
    page = document.page(document.Lecture([chapter], words, records))
    headings = [x for search, x in SEARCHES.items() if search != "trim"]
    for heading in (*headings, "A motion."):
        assert words.word(heading) in page
    assert "‘" not in re.sub("<[^>]*>", "", page)  # parameters are set, not quoted
    said = tex_text(words.word("Its equations of motion are"))
    assert said in document.latex(document.Lecture([chapter], words, records))


def test_a_search_that_is_refused_says_why():
    chapter, records, _ = chapter_on("comet")
    page = document.page(document.Lecture([chapter], language("en"), records))
    refused = [
        x
        for x in ("symmetries", "reduction", "integrals", "equilibria", "families")
        if f"comet:{x}" not in records
    ]
    assert refused
    assert 0 < page.count("This was not found:") <= len(refused)  # one for one reason


def test_a_search_that_takes_too_long_is_a_sentence():
    """Each search has its own seconds, and the lecture goes on."""
    chapter, records, _ = chapter_on("lagrange_top", 0.01)
    page = document.page(document.Lecture([chapter], language("fr"), records))
    assert "la recherche dépasse 0,01 secondes (--seconds)" in unicodedata.normalize("NFKC", page)
    assert "Ses équations du mouvement sont" in page


def test_of_what_is_kept_the_value_alone_is_shown_and_nothing_too_long(made):
    _, chapter, _ = made
    told = [e for b in chapter.blocks if b.kind != "solution" for e in b.entries if e.display]
    shown = [(e.labels[0], x) for e in told for x in e.equations]
    told = [x for label, x in shown if ".conserved_" in label]
    assert all(show(x.lhs).startswith(("ϖ(δy)", "dϖ(δy, δ′y)")) and x.rhs != 0 for x in told)
    assert all(_rows(x) <= LONGEST for label, x in shown if "motion" not in label)


def test_two_exercises_at_least_whose_copies_are_wrong(made):
    """The copy of an equation with a mistake does not hold where the solution does."""
    _, chapter, records = made
    asked = [b for b in chapter.blocks if b.kind == "exercise"]
    solved = [b for b in chapter.blocks if b.kind == "solution"]
    assert len(asked) == len(solved) >= 2
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


def test_parameters_have_a_table_and_the_body_a_figure():
    chapter, records, _ = chapter_on("lagrange_top")
    (table,) = [b for b in chapter.blocks if b.kind == "table"]
    given = records["lagrange_top"].problem["parameters"]
    assert len(table.entries) == 3 * len(given)
    page = document.page(document.Lecture([chapter], language("fr"), records))
    for about in given.values():
        assert language("fr").word(about["meaning"]) in page
    assert len(chapter.figures) == page.count("<svg") == 2


@pytest.mark.parametrize("reason", REASONS)
def test_a_reason_is_told_in_french_with_its_numbers(reason):
    told = reason.format(velocities=6, letters=27, seconds=9)
    assert _reason(told, language("en")) == told
    french = _reason(told, language("fr"))
    assert french != told
    assert re.findall("[0-9]+", french) == re.findall("[0-9]+", told)
    assert _reason("no reason of these", language("fr")) == "no reason of these"


def test_searches_refused_for_one_reason_stand_together(made):
    records = made[2]
    d = records[made[0]]
    reason = f"{d.name}: its forces are no part of L̃"
    found = dict.fromkeys(("symmetries", "integrals", "reduction"), Found(refused=reason))
    found["equilibria"] = Found()
    chapter = chapter_of(d, found, tuple(records))
    page = document.page(document.Lecture([chapter], language("en"), records))
    assert "What the motion keeps. First integrals. Reduction." in page
    assert page.count("This was not found: its forces are no part of") == 1
    assert "Only points with one momentum were tried" in page


def test_inputs_that_hold_a_body_are_told(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("hung.toml").write_text(HUNG, encoding="utf-8")
    chapter, records, _ = chapter_on("hung.toml")
    assert "hung:trim" in records
    page = document.page(document.Lecture([chapter], language("fr"), records))
    assert "Au repos, par ses commandes." in page
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
