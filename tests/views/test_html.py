"""The web page: in a browser it fits, shows every formula and says nothing on the console."""

import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from derive.record.record import AMENDED
from derive.views.html import html
from derive.views.language import language
from derive.views.paper.findings import amendments
from derive.views.printing.sentences import spelt
from derive.views.printing.signs import Notation
from derive.views.printing.tex import formula
from tests.support.needs import need
from tests.support.playground_site import chromium
from tests.support.walks import record

NAMES = ("so3", "se3", "sl3", "saff3", "hammer", "two_tops", "jelly", "comet", "so4")
SOME = ("so3", "se3", "two_tops", "comet")
VOID = {"meta", "link", "br", "circle", "line", "path", "ellipse", "rect", "polyline", "polygon"}
FITTED = """() => {
    const width = document.documentElement.clientWidth;
    const box = (e) => e.getBoundingClientRect();
    const open = (e) => e.closest("details") === null;
    const formulas = [...document.querySelectorAll("math")].filter(open);
    return {
        scrolls: document.documentElement.scrollWidth > width,
        empty: formulas.filter((e) => box(e).width < 1 || box(e).height < 1).length,
        outside: formulas.filter((e) => !e.closest(".wide") && box(e).right > width + 1).length,
        count: formulas.length,
        figures: [...document.querySelectorAll("figure svg")].map((e) => box(e).height),
    };
}"""


class Structure(HTMLParser):
    """Open and close tags match, and which tags and attributes there are."""

    def __init__(self, page):
        super().__init__()
        self.open, self.tags, self.ids = [], set(), []
        self.feed(page)
        assert not self.open

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.ids += [value for name, value in attrs if name == "id"]
        assert not [name for name, _ in attrs if name.startswith("on")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.add(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def browser():
    need("the module playwright", "chromium")
    with chromium() as running:
        yield running


@pytest.mark.parametrize("lang", ["en", "fr"])
@pytest.mark.parametrize("width", [390, 1280])
def test_in_a_browser(width, lang, browser, tmp_path):
    file = tmp_path / "page.html"
    shown = html([record(x) for x in NAMES], language=language(lang), findings=amendments(AMENDED))
    file.write_text(shown, encoding="utf-8")
    page = browser.new_page(viewport={"width": width, "height": 900})
    said = []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.goto(file.as_uri())
    found = page.evaluate(FITTED)
    assert not said
    assert not found["scrolls"]
    assert found["empty"] == found["outside"] == 0
    assert found["count"] > 1000
    assert len(found["figures"]) == len(NAMES)
    assert min(found["figures"]) > 50
    page.close()


def test_anchors_are_there_and_single():
    page = html([record(x) for x in SOME])
    ids = Structure(page).ids
    assert len(ids) == len(set(ids))
    assert set(re.findall(r'href="#([^"]*)"', page)) <= set(ids)
    for name in SOME:
        assert {step.label for step in record(name).steps} <= set(ids)


def test_it_stands_alone():
    page = html([record("so3")]).replace("http://www.w3.org/2000/svg", "")
    assert not re.search(r"https?://|@import|url\(|src=|<link", page)


def test_what_holds_for_any_group_comes_once():
    page = html([record("so3"), record("sl3"), record("so4")])
    assert page.count('id="linear.kernel"') == 1


@pytest.mark.parametrize("bad", ["<script>alert(1)</script>", '"><img src=x onerror=alert(1)>'])
def test_nothing_of_a_stranger_is_markup(bad):
    d = record("so3")
    hostile = {**d.problem, "title": bad, "name": bad}
    hostile["parameters"] = {bad: {"default": 1.0, "unit": bad, "meaning": bad}}
    symbols = tuple(replace(s, latex=bad) for s in d.symbols)
    steps = tuple(replace(s, label=f"x{k}{bad}", uses=()) for k, s in enumerate(d.steps))
    clean = Structure(html([d])).tags
    assert Structure(
        html([replace(d, problem=hostile, symbols=symbols, steps=steps)])
    ).tags <= clean | {"mtext"}


def test_other_notations():
    top = Notation("top", "wedge")
    assert '<mi mathvariant="normal">d</mi><mi>ϖ</mi>' in formula("dϖ").mathml()
    assert "⊤" in formula(("T", "A"), None, top).mathml()
    assert "⊤" in formula(("T", ("mul", "A", "Z")), None, top).mathml()
    assert "<mo>∧</mo></msup>" in formula(("hat", "ζ"), None, top).mathml()
    assert "⊤" in spelt("Ā", top).mathml()
    with pytest.raises(ValueError, match="bar, top"):
        Notation("dagger")
