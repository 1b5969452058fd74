"""The page of the lecture: its ticks lead to the steps, its figures move, and anyone reads it."""

import re
from dataclasses import replace

import pytest

from derive.command.lecturing import MOVING, frames_of, named_by
from derive.lecture import document
from derive.lecture.lecture_text import LectureError
from derive.lecture.ticked_steps import judged
from derive.record.record import Equation
from derive.views.language import LANGUAGES, language
from tests.support import lectures
from tests.support.lectures import CHAPTERS, by_itself, shown
from tests.support.needs import needs
from tests.support.playground_site import chromium, violations
from tests.support.walks import SEED

TOP, STEPS = CHAPTERS[1], CHAPTERS[-1]
LABELS = [*dict.fromkeys(x for c in CHAPTERS for e in c.entries for x in e.labels)]


def page_of(chapter, lang, **given):
    """The page of a chapter alone."""
    records = named_by(chapter, lectures.records())
    return document.page(document.Lecture([by_itself(chapter)], language(lang), records, **given))


@pytest.mark.parametrize("lang", LANGUAGES)
def test_each_step_of_a_tick_stands_once_with_its_equations(lang):
    """And what is no step has no link."""
    page = shown("page", lang)
    text, _, behind = page.partition('<div class="checks">')
    ticks = re.findall(r'<a class="tick[^"]*" href="#([^"]+)">✓ <code>([^<]+)</code></a>', text)
    assert len(ticks) == text.count("✓")
    assert {*ticks} == {(x, x) for x in LABELS}
    articles = re.findall(r'<article id="([^"]+)">(.*?)</article>', behind, re.S)
    assert [x for x, _ in articles] == LABELS
    assert all('class="equation' in x and "<code>derive " in x for _, x in articles)
    lines = {*re.findall(r'<a href="#(calculation-\d+)">', behind)}
    assert lines == {*re.findall(r'id="(calculation-\d+)"', text)}


def test_a_page_that_was_checked_says_how_surely_and_one_that_is_false_is_not_made():
    records = named_by(STEPS, lectures.records())
    found = judged([STEPS], records, SEED)
    page = page_of(STEPS, "fr", judgements=found)
    assert page.count("probabilité inférieure à 10⁻") == len(found) > 9
    assert "<code>derive check" not in page
    label = [*found][-1]
    (name, record) = next((x, d) for x, d in records.items() if label in {s.label for s in d.steps})
    at = next(k for k, s in enumerate(record.steps) if s.label == label)
    first, *others = record.steps[at].equations
    false = replace(
        record.steps[at], equations=(Equation(first.lhs, ("mul", 2, first.rhs)), *others)
    )
    steps = (*record.steps[:at], false, *record.steps[at + 1 :])
    with pytest.raises(LectureError, match=f"{label} does not hold"):
        judged([STEPS], records | {name: replace(record, steps=steps)}, SEED)


def test_the_figures_of_free_body_and_top_move_on_the_page_in_its_language(tmp_path):
    frames = frames_of(CHAPTERS, MOVING, "fr")
    assert {*frames} == {"polhodes", "paths"}
    page = page_of(TOP, "fr", frames=frames)
    (frame,) = re.findall(r'<iframe title="([^"]+)" loading="lazy" srcdoc="([^"]+)">', page)
    assert frame[0] == "Un cône qui tourne sur sa pointe"
    assert "Mettre en mouvement\u00a0: Un cône" in page
    assert "lang=&#34;fr&#34;" in frame[1]
    still = tmp_path / "still.toml"
    still.write_text('name = "still"\ngroup = "SO(3)"\n[body]\nmoments = "symbolic"\n')
    assert frames_of([TOP], {"paths": str(still)}, "en") == {}


def following(page, label):
    """The step behind one of the page."""
    labels = page.locator("article").evaluate_all("(all) => all.map((x) => x.id)")
    return labels[labels.index(label) + 1]


@needs("node", "the module playwright", "chromium")
@pytest.mark.parametrize(("width", "colours"), [(1440, "light"), (390, "dark")])
def test_a_tick_opens_its_step_p_projects_it_and_axe_finds_nothing(width, colours, tmp_path):
    """With all that is folded open; the page itself does not move sideways."""
    for lang in LANGUAGES:
        file = tmp_path / f"{lang}.html"
        file.write_text(page_of(TOP, lang), encoding="utf-8")
        with chromium() as browser:
            page = browser.new_page(viewport={"width": width, "height": 844}, color_scheme=colours)
            page.goto(file.as_uri())
            page.click("a.tick:visible >> nth=3")
            page.wait_for_selector("article:target .equations", state="visible")
            page.evaluate("document.querySelectorAll('details').forEach((x) => { x.open = true; })")
            page.wait_for_timeout(300)  # until what is wide was seen
            assert violations(page) == []
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
            at = page.evaluate("document.querySelector('article:target').id")
            page.keyboard.press("p")
            assert page.inner_text("#projector .from") == at
            page.keyboard.press("PageDown")
            assert page.inner_text("#projector .from") == following(page, at)
            assert page.locator("#projector .now math").first.is_visible()
            assert violations(page) == []
            page.keyboard.press("Escape")
            assert page.locator(f"[id='{following(page, at)}']").is_visible()
            assert not page.is_visible("#projector")
