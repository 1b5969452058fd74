"""The lecture: every tie is a step, every equation holds, and none that is changed."""

import re
import shlex
import subprocess
from collections import Counter
from dataclasses import replace
from html import escape
from unicodedata import normalize
from xml.etree import ElementTree

import numpy as np
import pytest

from derive.command.arguments import parser
from derive.command.cli import COMMANDS, main
from derive.command.lecturing import named_by
from derive.command.showing import load_problem
from derive.language.show import show
from derive.lecture import document, figures
from derive.lecture.back_matter import NUMBERS, OWN, WORKS, homes, letters
from derive.lecture.lecture_text import PROVED, Formula, LectureError, parsed
from derive.lecture.trials import tied, tried
from derive.views.language import LANGUAGES, language
from tests.readers.latex import letters_in
from tests.support import lectures
from tests.support.lectures import CHAPTERS, FORMS, shown
from tests.support.needs import needs
from tests.support.walks import SEED

NAMES = [c.name for c in CHAPTERS]
CITED = re.compile("@([a-z_]+)")


@pytest.fixture(scope="module")
def records():
    return lectures.records()


def with_entry(chapter, entry):
    """The chapter with this entry alone."""
    return replace(chapter, blocks=(replace(chapter.blocks[0], entries=(entry,)),))


def zero(entry):
    """What an entry says to be zero, and 0 itself."""
    return {"0", *(show(e.lhs) for e in entry.equations if e.rhs == 0)}


@pytest.mark.parametrize("chapter", CHAPTERS, ids=NAMES)
def test_every_claim_holds_and_none_with_another_sign(chapter, records):
    """Of each equation the right side is turned about, where it is not said to be zero."""
    mine = named_by(chapter, records)
    tied(chapter, mine)
    claims = [*tried(chapter, mine, SEED)]
    assert len(claims) > 8
    for claim in claims:
        lhs, rhs = show(claim.equation.lhs), show(claim.equation.rhs)
        if not {lhs, rhs} & zero(claim.entry):
            words = (Formula(f"{lhs} = −({rhs})"),)
            changed = replace(claim.entry, texts=(words,) * len(LANGUAGES))
            with pytest.raises(LectureError, match="does not hold"):
                list(tried(with_entry(chapter, changed), mine, SEED))


@pytest.mark.parametrize("chapter", CHAPTERS, ids=NAMES)
def test_a_step_that_is_withdrawn_is_missed(chapter, records):
    mine = named_by(chapter, records)
    for label in dict.fromkeys(x for e in chapter.entries for x in e.labels):
        fewer = {
            name: replace(d, steps=tuple(s for s in d.steps if s.label != label))
            for name, d in mine.items()
        }
        with pytest.raises(LectureError, match=f"no step {re.escape(label)}$"):
            tied(chapter, fewer)


def test_most_claims_are_tied():
    """Of what is proved here and no step yet there is one in twelve at most."""
    ties = [tie for c in CHAPTERS for e in c.entries for tie in e.ties if not tie.said]
    assert 12 * sum(bool(x.open) for x in ties) <= len(ties)


def test_every_statement_says_what_it_rests_on():
    for chapter in CHAPTERS:
        for block in chapter.blocks:
            if block.kind in PROVED:
                assert any(e.ties for e in block.entries), (chapter.name, block.line)


def test_a_calculation_has_an_identity_for_each_of_a_few_lines():
    found = [b for c in CHAPTERS for b in c.blocks if b.kind == "calculation"]
    assert len(found) == 17
    assert all(any(b in c.blocks for b in found) for c in CHAPTERS)
    for block in found:
        assert 3 <= len(block.entries) <= 6
        for x in block.entries:
            assert len(x.equations) == 1
            assert x.labels
            assert len(x.texts[0]) > 1


@pytest.mark.parametrize(
    "said",
    [
        "ζ̇₂ = σ(ω² − ζ₂²)/ω,  ζ₂ = −ω tanh(σ t)",
        "ζ̇₂ = σ(ω² − ζ₂²)/ω,  ζ₂ = ω tanh(2 σ t)",
        "ζ̇₂ = σ(ω² + ζ₂²)/ω,  ζ₂ = ω tanh(σ t)",
        "ζ₂ = ω tanh(σ t)",
    ],
)
def test_a_function_of_the_time_has_the_rate_beside_it(said):
    right = parsed(HEAD + "text\n  = ζ̇₂ = σ(ω² − ζ₂²)/ω,  ζ₂ = ω tanh(σ t)\n  < solved\n")
    assert [*tried(right, {})] == []
    with pytest.raises(LectureError, match="line 7: its solution does not hold"):
        list(tried(parsed(HEAD + f"text\n  = {said}\n  < solved\n"), {}))


def test_the_separatrix_of_the_racket_is_tried():
    solved = [e for c in CHAPTERS for e in c.entries if e.solved]
    assert [show(e.equations[1].rhs) for e in solved] == ["ω tanh(σt)", "−r tanh(rt)"]


HEAD = "chapter c\n  A chapter\n  Un chapitre\nrecords so3\n\n"


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("", "it ends where a line is needed"),
        ("text\n", "line 1: a chapter begins with 'chapter NAME'"),
        ("chapter c\n  A\n  B\ntext\n", "line 4: after its title a chapter has 'records PROBLEM"),
        (HEAD + "paragraph\n  One.\n  Un.\n", "line 6: no block: 'paragraph'"),
        (HEAD + "text\n  One `ζ`.\n  Un.\n", "line 7: formulas of one language alone: ζ"),
        (HEAD + "text\n  `ζ = Ω`.\n  `ζ = Ω`.\n", "line 7: an equation that rests on nothing"),
        (HEAD + "text\n  = ζ = +\n  < so3.hat\n", "line 7: "),
        (HEAD + "text\n  One.\n  Un.\n  < open here\n", "line 9: what is open is said in English"),
    ],
)
def test_a_text_that_is_none_is_refused_with_its_line(text, wrong):
    with pytest.raises(LectureError, match=re.escape(wrong)):
        parsed(text, "c.txt")


COMMAND = re.compile("_(derive [^_]+ [^_]+)_")


@pytest.mark.parametrize("at", range(len(LANGUAGES)), ids=LANGUAGES)
def test_every_command_that_the_text_tells_is_one(at):
    """The command line's own parser takes it; its problem is there."""
    texts = (x for c in CHAPTERS for e in c.entries for x in e.texts[at] if isinstance(x, str))
    told = [x for text in texts for x in COMMAND.findall(text)]
    assert len(told) > 3
    for command in told:
        args = parser(COMMANDS, None).parse_args(shlex.split(command)[1:])
        assert load_problem(one_of(args)).name == command.split()[2]


def test_where_the_steps_of_the_margins_are(records, capsys):
    """Each command is one, and prints steps of the label; every label has its command."""
    found = homes(CHAPTERS, records)
    assert {*found} == {x.partition(".")[0] for c in CHAPTERS for e in c.entries for x in e.labels}
    for command in (x for commands in found.values() for x in commands):
        args = parser(COMMANDS, None).parse_args(command.split()[1:])
        assert load_problem(one_of(args)).name == command.split()[2]
    for begins in ("free", "steps"):
        (command,) = found[begins]
        assert main(command.split()[1:]) == 0
        assert f"\n{begins}." in capsys.readouterr().out


def one_of(args):
    """The only problem of a command."""
    return args.problem if isinstance(args.problem, str) else args.problem[0]


def test_a_label_is_of_one_step(records):
    """No label of the margins is that of two steps that say different things."""
    said = {}
    for chapter in CHAPTERS:
        for record in named_by(chapter, records).values():
            for step in (s for s in record.steps if s.label.partition(".")[0] == record.name):
                said.setdefault(step.label, set()).add(step.rule)
    assert [x for x, rules in said.items() if len(rules) > 1] == []


def test_a_number_of_the_note_is_that_of_a_step(records):
    text = HEAD + "text\n  = ℓ_b = Iζ\n  < so3.momenta (12)\n"
    with pytest.raises(LectureError, match=re.escape("(12) is no number of so3.momenta")):
        tied(parsed(text), records)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_page_has_every_formula_of_the_text(lang):
    page = shown("page", lang).split('<section id="symbols">')
    text, whole = (
        ElementTree.fromstring(
            re.sub("(?s)<!DOCTYPE[^>]*>|<meta[^>]*>|<script>.*?</script>", "", x)
        )
        for x in (page[0] + "</main></body></html>", '<section id="symbols">'.join(page))
    )
    at = LANGUAGES.index(lang)
    typed = sum(not isinstance(x, str) for c in CHAPTERS for e in c.entries for x in e.texts[at])
    assert len([*text.iter("math")]) == typed
    targets = {x.get("href")[1:] for x in whole.iter("a")}
    named = [x.get("id") for x in whole.iter() if x.get("id")]
    assert targets <= {*named}
    assert len({*named}) == len(named)


FIGURE = re.compile(r"^.*?\\begin\{document\}", re.S)  # the pictures stand before the text
TYPESET = re.compile(
    r"(?<!\\)\$(.*?)(?<!\\)\$|(?<!\\)\\\[(.*?)\\\]|\\begin\{equation\}(.*?)\\end\{equation\}", re.S
)
MARGIN = re.compile(r"^\\label\{.*?\}|\\ofnote\{.*?\}|\\qedhere")


def letters_of(text):
    """The letters and digits of what is typed, each with the marks over it, but bars."""
    apart = re.sub("[\u0304\u0305\u0338]", "", normalize("NFKD", text.replace("‘rho’", "ρ")))
    return tuple(sorted(re.findall("[^\\W_][\u0300-\u036f]*", apart)))


def not_printed(tex, at):
    """The formulas of the text that the LaTeX of the whole has not, or with other marks."""
    found = (a or b or c for a, b, c in TYPESET.findall(FIGURE.sub("", tex)))
    printed = Counter(letters_of(letters_in(MARGIN.sub("", x))) for x in found)
    entries = (x for c in CHAPTERS for e in c.entries for x in e.texts[at])
    typed = Counter(letters_of(x.text + x.value) for x in entries if isinstance(x, Formula))
    return {*(typed - printed)}


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_latex_has_every_formula_with_the_marks_over_its_letters(lang):
    tex, at = shown("latex", lang), LANGUAGES.index(lang)
    assert not_printed(tex, at) == set()
    for printed in (r"\ddot{\beta}", r"\ddot{S}", r"\dot\zeta"):
        base = printed.replace("{", "").replace("}", "").rpartition("dot")[2]
        assert not_printed(tex.replace(printed, base, 1), at)  # which is lost


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_display_ends_with_a_sign_and_a_product_is_broken_at_one(lang):
    """A comma where its sentence goes on, a full stop where it ends; neither before "for"."""
    tex = shown("latex", lang)
    assert r"(v_{i}) = F_{i}.\ofnote" in tex
    assert r"- \tilde U,\ofnote" in tex
    behind = r"\s*\\end{aligned}|\\ofnote|\s*\\qedhere|\s*$"
    found = (b or c for a, b, c in TYPESET.findall(FIGURE.sub("", tex)) if b or c)
    displays = [re.split(behind, MARGIN.sub("", x))[0] for x in found]
    assert sum(x[-1] not in ",." for x in displays) < 9 < 90 < len(displays)
    assert r"\quad \times (" in tex
    assert r"\quad \,(" not in tex


def test_the_equations_that_are_cited_are_numbered_in_their_order_and_no_others():
    """The same numbers in both kinds of documents; the note's stand beside, with its name."""
    entries = [e for c in CHAPTERS for e in c.entries]
    labelled = [e.label for e in entries if e.label]
    labels = [*labelled, *(b.label for c in CHAPTERS for b in c.blocks if b.label)]
    assert len({*labels}) == len(labels)
    for at in range(len(LANGUAGES)):
        cited = {x for e in entries for x in said(e, at)}
        cited |= {x for e in entries for y in e.own for z in y for x in CITED.findall(str(z))}
        assert {*labelled} <= cited <= {*labels, *NUMBERS}
    page, tex = shown("page", "en"), shown("latex", "en")
    numbered = [(str(k), label) for k, label in enumerate(labelled, 1)]
    assert re.findall(r"\\begin{equation}\\label{(\w+)}", tex) == labelled  # which TeX counts
    displays = r'<div class="display" id="(\w+)"><span class="number">\((\d+)\)'
    assert [x[::-1] for x in re.findall(displays, page)] == numbered
    assert '<span class="ofnote">note (35)</span>' in page
    solved = (e for c in CHAPTERS for b in c.blocks if b.kind == "solution" for e in b.entries)
    assert not any(e.label for e in solved)  # they may be left out


def labels_of(tex):
    """What is labelled in the LaTeX of a whole lecture, and the rows of the table of symbols that
    are first used there."""
    tex = tex.partition(r"\begin{document}")[2]
    rows = [x for run in re.findall(r"\\firstuse{([\d,]+)}", tex) for x in run.split(",")]
    figures = re.findall(r"\\begin{lecturefigure}{(\w+)}", tex)
    return [*re.findall(r"\\label{([^}\\#]+)}", tex), *figures, *(f"letter-{x}" for x in rows)]


def test_a_problem_may_be_called_as_a_theorem_is(records):
    """Its chapter does not take the number of the theorem."""
    named = [replace(c, name=c.name.replace("free_solid", "kirchhoff")) for c in CHAPTERS]
    tex = document.latex(document.Lecture(named, language("en"), records))
    labels = labels_of(tex)
    assert "kirchhoff" in labels
    assert len({*labels}) == len(labels) > 100


def test_a_problem_may_be_called_as_a_chapter_is(records):
    """Its chapter has a label of its own, and not the meanings of the letters of the course's."""
    own = replace(CHAPTERS[1], file="the chapter of top")
    told = [letters([x], records, language("en")) for x in (CHAPTERS[1], own)]
    course, its = ({x.name for x in table} for table in told)
    assert {x for of, x in OWN if of == "top"} <= course
    assert not {"ψ", "z", "u₁", "e₃"} & its
    tex = document.latex(
        document.Lecture([*CHAPTERS, replace(own, blocks=())], language("en"), records)
    )
    labels = labels_of(tex)
    assert len({*labels}) == len(labels)


def test_every_figure_is_cited_in_the_text():
    figures = {b.label for c in CHAPTERS for b in c.blocks if b.kind == "figure"}
    texts = [e for c in CHAPTERS for b in c.blocks if b.kind != "figure" for e in b.entries]
    assert figures <= {x for e in texts for x in said(e, 0)}


@pytest.mark.parametrize("lang", LANGUAGES)
def test_without_solutions(lang):
    for form, mark in (("page", '<details class="solution">'), ("latex", "Solutions")):
        assert mark in shown(form, lang)
        none = shown(form, lang, "none")
        assert mark not in none
        named = {*(re.findall('id="([^"]+)', none) or labels_of(none))}
        rows = re.findall(r"\\letterrow{.*{(\d+)}\n", none)
        used = {*re.findall(r'href="#(letter-\d+)', none), *(f"letter-{x}" for x in rows)}
        assert len(used) > 80
        assert used <= named


@pytest.mark.parametrize("lang", LANGUAGES)
def test_solutions_in_a_chapter_at_the_end(lang):
    """The very last one, behind the bibliography, with all of them, by the chapters' titles."""
    page, tex = (shown(form, lang, "end") for form in FORMS)
    before, _, behind = page.partition('<section id="solutions">')
    assert '<details class="solution">' not in before
    assert before.rfind("bibliography") > 0
    exercises = sum(b.kind == "exercise" for c in CHAPTERS for b in c.blocks)
    numbers = re.findall(r"<summary>Solution (\d+)</summary>", behind)
    assert [*map(int, numbers)] == [*range(1, exercises + 1)]
    assert tex.count(r"\lecturesection{\ref{") == len(CHAPTERS)
    assert tex.rfind(r"\behind{Solutions}") > tex.rfind(r"\behind{Bibliograph")


@needs("the TeX of the lecture")
def test_the_pdf(tmp_path, capsys):
    assert main(["lecture", "--lang", "fr", "--out", str(tmp_path / "lecture.pdf")]) == 0
    assert (tmp_path / "lecture.pdf").read_bytes().startswith(b"%PDF")
    capsys.readouterr()


@needs("the TeX of the lecture")
def test_tex_gets_through_the_english_too(tmp_path):
    """Once, and draws nothing: the first of the passes that a PDF takes finds the errors."""
    (tmp_path / "lecture.tex").write_text(shown("latex", "en"), encoding="utf-8")
    command = ["pdflatex", "-draftmode", "-halt-on-error", "-no-shell-escape", "lecture.tex"]
    done = subprocess.run(command, cwd=tmp_path, stdin=-3, stdout=-1, text=True)
    assert done.returncode == 0, done.stdout[-2000:]


def test_the_command(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("derive.lecture.trials.tried", lambda chapter, _: chapter.name)
    out = tmp_path / "lecture.tex"
    assert main(["lecture", "--check", "--out", str(out)]) == 0
    assert f"{len(''.join(NAMES))} equations hold\n" in capsys.readouterr().out
    assert r"\begin{theorem}" in out.read_text(encoding="utf-8")
    assert main(["lecture", "--out", str(tmp_path / "lecture.docx")]) == 2
    assert "must end in .tex, .pdf, .html" in capsys.readouterr().err


TITLES = ("Tops & co_1 {50 %} \\x #~^$", "A. Ünal", "M2, <spring>", "week 3")


@needs("the TeX of the lecture")
def test_what_the_user_gives_stands_at_the_head_as_it_is(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("derive.lecture.lecture_text.chapters", lambda **_: [])
    given = [
        f"--{x}={y}" for x, y in zip(("title", "author", "course", "date"), TITLES, strict=True)
    ]
    for name in ("lecture.html", "lecture.pdf"):
        assert main(["lecture", *given, "--out", str(tmp_path / name)]) == 0
    page = (tmp_path / "lecture.html").read_text(encoding="utf-8")
    assert all(escape(x) in page for x in TITLES)
    text = subprocess.run(["pdftotext", tmp_path / "lecture.pdf", "-"], stdout=-1, text=True).stdout
    assert all(x.replace(" ", "") in text.replace(" ", "") for x in TITLES[1:])
    capsys.readouterr()


def test_without_them_there_is_no_date():
    for form in FORMS:
        assert not re.search(r"\\today|\\date|author\" content", shown(form, "en"))


def test_every_work_is_referred_to():
    cited = {x for c in CHAPTERS for e in c.entries for x in said(e, 0) if x in NUMBERS}
    assert cited == {*NUMBERS}
    for entry in (e for c in CHAPTERS for e in c.entries):
        assert sorted(said(entry, 0)) == sorted(said(entry, 1))
    surnames = [authors.split(",")[0].split()[-1] for _, authors, *_ in WORKS]
    assert surnames == sorted(surnames)


def said(entry, at):
    """The labels and works that an entry refers to."""
    return [x for text in entry.texts[at] if isinstance(text, str) for x in CITED.findall(text)]


def test_the_table_of_symbols_is_of_letters_that_stand_where_it_says(records):
    for lang, meaning in (("en", "angular velocity in the body"), ("fr", "vitesse angulaire")):
        table = letters(CHAPTERS, records, language(lang))
        assert any(x.name == "ζ" and x.meaning.startswith(meaning) for x in table)
        assert len({(x.name, x.meaning) for x in table}) == len(table) > 60
        plain = str.maketrans("₀₁₂₃", "0123")
        for x in table:
            stands = " ".join(y.text for y in x.entry.formulas).translate(plain)
            name = x.name.replace("_", "").translate(plain)
            assert normalize("NFC", name) in normalize("NFC", stands.replace("_", ""))
        listed = {(CHAPTERS[x.chapter - 1].name, x.name) for x in table}
        supposed = {
            ("steps", "ω"): "frequency|pulsation",
            ("fixed_point", "g"): "gravity|pesanteur",
        }
        for x in table:
            assert re.search(supposed.get((CHAPTERS[x.chapter - 1].name, x.name), ""), x.meaning)
        assert {*OWN} <= listed
        latin = [x.name for x in table if x.name.isascii() and len(x.name) == 1]
        assert latin == sorted(latin, key=str.casefold)


def test_the_polhodes_are_levels_of_the_energy_on_the_sphere():
    curves = [*figures._curves()]
    assert len(curves) == 18
    for role, curve in curves:
        points = np.array(curve)
        assert np.allclose((points**2).sum(axis=1), 1, rtol=0, atol=1e-14)
        energy = (points**2 / figures.RACKET.moments).sum(axis=1)
        assert np.ptp(energy) < 1e-14
        least, middle, most = sorted(1 / np.array(figures.RACKET.moments))
        level = energy.mean()
        assert {"first": middle < level < most, "third": least < level < middle}.get(
            role, abs(level - middle) < 1e-14
        )
