"""Lecture notes: LaTeX, PDF, fragments; the web page, which in a browser fits, shows every formula
and says nothing on the console."""

import re
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from unicodedata import normalize

import pytest

from derive.command.cli import main
from derive.record.record import AMENDED
from derive.views.html import html
from derive.views.language import language
from derive.views.paper.findings import amendments
from derive.views.printing.letters import DEFINED
from derive.views.printing.sentences import spelt
from derive.views.printing.signs import Notation
from derive.views.printing.tex import formula
from tests.problems import READY
from tests.support import lectures
from tests.support.needs import need, needs
from tests.support.playground_site import chromium
from tests.support.processes import typeset
from tests.support.walks import record

GROUPS = ("so3", "se3", "sl3")


@pytest.fixture
def said(capsys):
    def run(*arguments, code=0):
        assert main(list(map(str, arguments))) == code
        return capsys.readouterr()

    return run


@pytest.mark.parametrize(
    "options", [[], ["--lang", "fr"], ["--notation", "top", "--hat", "wedge"]], ids=str
)
def test_notes_of_three_groups(options, said, tmp_path):
    said("notes", *GROUPS, "--out", tmp_path / "notes.tex", *options)
    log = typeset((tmp_path / "notes.tex").read_text(encoding="utf-8"), tmp_path, runs=3)
    assert "Overfull" not in log
    assert "undefined" not in log
    assert "multiply defined" not in log


@needs("pdflatex", "pdftoppm")
def test_the_pdf_is_not_blank(said, tmp_path):
    said("notes", "so3", "--out", tmp_path / "notes.pdf")
    subprocess.run(["pdftoppm", "-r", "40", "-gray", "notes.pdf", "page"], cwd=tmp_path, check=True)
    pages = sorted(tmp_path.glob("page*.pgm"))
    assert len(pages) > 5
    for page in pages:
        pixels = page.read_bytes()[20:]
        assert sum(x < 200 for x in pixels) > 20


def test_without_tex_the_source_is_written(said, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", "")
    (tmp_path / "notes.tex").write_text("of my own", encoding="utf-8")
    err = said("notes", "so3", "--out", tmp_path / "notes.pdf", code=2).err
    assert "no pdflatex" in err
    assert err.count("\n") == 1
    assert str(tmp_path / "notes.pdf.tex") in err
    assert sorted(x.name for x in tmp_path.iterdir()) == ["notes.pdf.tex", "notes.tex"]
    assert (tmp_path / "notes.tex").read_text(encoding="utf-8") == "of my own"
    assert "\\documentclass" in (tmp_path / "notes.pdf.tex").read_text(encoding="utf-8")


def test_two_problems_of_one_name(said, tmp_path):
    """Their equations would have the same labels."""
    source = (READY / "top.toml").read_text(encoding="utf-8")
    (tmp_path / "mine.toml").write_text(source.replace("800.0", "900.0"), encoding="utf-8")
    for ending in (".tex", ".html"):
        out = tmp_path / f"notes{ending}"
        err = said("notes", "top", tmp_path / "mine.toml", "--out", out, code=2).err
        assert "2 problems have the name 'top'" in err
        assert not out.exists()
    said("notes", "screw", "screw", "--out", tmp_path / "notes.tex")


def test_letters_of_titles_and_units(said, tmp_path):
    """What LaTeX has is printed, also where the PDF has its title; the rest is told."""
    source = (READY / "screw.toml").read_text(encoding="utf-8")
    for k, more in enumerate(["½⅓¼⅔¾µ∞√±≈⋅∑∫∆ħ⊥⋉↦⊗€†‰", "力 x"]):
        text = re.sub('(?m)^title *= *"', f"\\g<0>{more} ", source)
        assert text != source
        (tmp_path / "screw.toml").write_text(text, encoding="utf-8")
        err = said("notes", tmp_path / "screw.toml", "--out", tmp_path / "notes.tex").err
        assert ("LaTeX has no 力 here" in err) == bool(k)
        assert bool(err) == bool(k)
        typeset((tmp_path / "notes.tex").read_text(encoding="utf-8"), tmp_path)


def test_a_fragment_stands_in_a_lecturers_text(said, tmp_path):
    """Under the macros of a preamble of their own, with references to its labels."""
    fragment = said("walk", "so3", "--format", "latex", "--fragment").out
    assert "documentclass" not in fragment
    (tmp_path / "so3.tex").write_text(fragment)
    own = {"transpose": r"{#1#2}^{t}", "Tr": r"\mathrm{trace}"}
    takes = {name: f"[{count}]" if count else "" for name, (_, count, *_) in DEFINED.items()}
    bodies = {name: own.get(name, "#1" if x else "x") for name, x in takes.items()}
    lines = [rf"\newcommand{{\{name}}}{x}{{{bodies[name]}}}" for name, x in takes.items()]
    lecture = (
        "\\documentclass{article}\n\\usepackage{amsmath,amssymb}\n"
        + "\n".join(lines)
        + "\n\\newcommand{\\walkstep}[4]{\\subsection*{#2}}\n\\newcommand{\\walkfrom}[1]{}\n"
        + "\\newcommand{\\walkheading}[1]{\\section{#1}}\n"
        + "\\begin{document}\nBy \\eqref{so3.kernel}:\n\\input{so3}\n\\end{document}\n"
    )
    log = typeset(lecture, tmp_path, runs=2)
    assert "undefined" not in log


def test_every_symbol_goes_through_a_macro(said):
    fragment = said("walk", "se3", "--format", "latex", "--fragment").out
    raw = r"\\(?:bar|overline|tilde|dot|delta|varpi|mathsf|mathfrak)(?![A-Za-z])"
    assert not re.findall(raw, fragment)
    used = set(re.findall(r"\\([A-Za-z]+)", fragment))
    assert set(DEFINED) - {"Liealgebra"} <= used


def test_a_greek_letter_that_the_walk_does_not_have_is_a_parameters(said, tmp_path):
    """The density of a cone is ρ in sentences and equations; α, a velocity of the walk, is not that
    of a parameter."""
    out = tmp_path / "notes.tex"
    said("notes", "top", "--out", out)
    text = out.read_text(encoding="utf-8")
    assert r"\pi\,\rho\,\parameter{R}" in text
    assert r"\parameter{rho}" not in text
    (tmp_path / "spun.toml").write_text(
        'name = "spun"\ngroup = "SO(3)"\n[parameters]\nalpha = {}\n[[point]]\nmass = "alpha"\n'
        "at = [1, 0, 0]\n[[point]]\nmass = 1\nat = [0, 1, 0]\n",
        encoding="utf-8",
    )
    said("notes", tmp_path / "spun.toml", "--out", out)
    assert r"\parameter{alpha}" in out.read_text(encoding="utf-8")


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


FOLDED = """what => Array.from(document.querySelectorAll(what), (fold) => {
    const words = document.createTreeWalker(fold, NodeFilter.SHOW_TEXT), found = [""];
    for (let node; node = words.nextNode();) {
        if (!node.parentElement.closest("summary, math")) found.push(node.data);
    }
    return found.reduce((a, b) => a.length < b.length ? b : a);
})"""
"""The longest run of words in each of what is folded."""


@needs("pdftoppm")
@pytest.mark.parametrize("kind", ["lecture", "notes"])
def test_what_is_folded_is_on_paper(kind, browser, tmp_path):
    """Proofs, calculations and solutions of a lecture, the meanings of the letters of notes."""
    file, printed = tmp_path / "page.html", tmp_path / "page.pdf"
    shown = lectures.shown("page", "fr") if kind == "lecture" else html([record("so3")])
    file.write_text(shown, encoding="utf-8")
    page = browser.new_page()
    page.goto(file.as_uri())
    what = "details:not(#checks *)" if kind == "lecture" else "details.names"
    folded = page.evaluate(FOLDED, what)
    page.pdf(path=printed)
    page.close()
    text = subprocess.run(["pdftotext", "-raw", printed, "-"], stdout=-1, text=True).stdout
    paper = "".join(normalize("NFKC", text).split())
    assert len(folded) > (80 if kind == "lecture" else 0)
    lines = [x for x in folded if "".join(normalize("NFKC", x).split()) not in paper]
    assert lines == []


def test_anchors_are_there_and_single():
    page = html([record(x) for x in SOME])
    ids = Structure(page).ids
    assert len(ids) == len(set(ids))
    assert set(re.findall(r'href="#([^"]*)"', page)) <= set(ids)


def test_it_stands_alone():
    page = html([record("so3")]).replace("http://www.w3.org/2000/svg", "")
    assert not re.search(r"https?://|@import|url\(|src=|<link", page)


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
