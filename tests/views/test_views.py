"""The views: width, labels, LaTeX that compiles, escaping, and a few formulas letter by letter."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from derive.language.show import show
from derive.record.record import Derivation, Equation, Step, Symbol
from derive.record.sentence import say
from derive.views.language import language
from derive.views.latex import breakable, latex
from derive.views.outline import printed
from derive.views.printing.letters import names_of
from derive.views.printing.signs import tex_text
from derive.views.printing.tex import FormulaPrinter, latex_tree
from derive.views.printing.typeset import Piece, display_width, fill
from derive.views.rendering import FORMATS, NOTES, RenderError, notes, render
from derive.views.text import markdown, text
from tests.support.processes import typeset
from tests.support.walks import record

NAMES = ("so3", "se3", "sl3", "linear", "affine")
HOSTILE = (
    r"\input{/etc/passwd}",
    "$%&_#{}~^",
    "{{ x }} << x >> <% x %> <# x #>",
    "a\n\n\\end{document}\x1b[31m",
    "<script>alert(1)</script> `x` **y** [z](w)",
    "D’où “élève” œuvre ï – 中 ζ̇₁⁻¹ ?` !` -- ''",
)


def titled(title: str) -> Derivation:
    d = record("linear")
    return replace(d, problem={**d.problem, "title": title})


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("width", [100, 72])
def test_text_keeps_to_its_width(name: str, width: int) -> None:
    lines = text(record(name), width).split("\n")
    assert max(map(display_width, lines)) <= width
    assert all(line == line.rstrip() for line in lines)


@pytest.mark.parametrize("form", ["txt", "", "TEXT", "html "])
def test_a_format_that_is_none(form: str) -> None:
    with pytest.raises(RenderError, match=f"no format '{form}'; there are {', '.join(FORMATS)}"):
        render(record("so3"), form)
    with pytest.raises(RenderError, match=f"no notes end in '{form}'; .*{', '.join(NOTES)}"):
        notes([record("so3")], form)


@pytest.mark.parametrize("name", NAMES)
def test_every_step_is_in_every_view(name: str) -> None:
    d = record(name)
    plain, marked, source = text(d), markdown(d), latex(d)
    for step in d.steps:
        assert f"\n{step.label}  ·  {step.rule}" in plain
        assert f"— `{step.label}`\n" in marked
        assert f"{{{breakable(step.label)}}}" in source
        heading = re.search(rf"^{re.escape(step.label)}  ·.*", plain, re.M)
        assert heading
        assert numbers(heading[0]) == set(step.paper)
        assert rf"\walkstep{{{tex_text(printed(step))}}}" in source


def numbers(heading: str) -> set[int]:
    """The numbers of the paper in it, where (1)–(3) is three of them."""
    runs = re.findall(r"\((\d+)\)\*?(?:–\((\d+)\))?", heading)
    return {n for a, b in runs for n in range(int(a), int(b or a) + 1)}


@pytest.mark.parametrize("packages", ["", r"\usepackage{cleveref}"])
def test_an_equation_is_found_by_its_key_and_the_first_by_its_step(
    packages: str, tmp_path: Path
) -> None:
    names = ("so3.hat", "so3.hat.1", "so3.hat.2", "so3.kernel", "so3.kernel.1")
    said = "".join(rf"\typeout{{<{x}: \getrefnumber{{{x}}}>}}\eqref{{{x}}}" for x in names)
    if packages:
        said += r"\cref{so3.hat}, \cref{so3.hat.1}"
    source = latex(record("so3")).replace(
        r"\begin{document}", rf"{packages}\usepackage{{refcount}}\begin{{document}}{said}"
    )
    log = typeset(source, tmp_path, runs=3)
    numbers = dict(re.findall(r"<(so3[a-z0-9.]*): ([0-9.]+)>", log))
    assert numbers["so3.hat"] == numbers["so3.hat.1"] != numbers["so3.hat.2"]
    assert numbers["so3.kernel"] == numbers["so3.kernel.1"]
    assert set(numbers) == set(names)
    assert not re.search(r"undefined|multiply defined|may have changed", log)


@pytest.mark.parametrize("lang", ["en", "fr"])
@pytest.mark.parametrize("name", [*NAMES, "saff3", "two_tops", "ellipsoid", "jelly"])
def test_latex_compiles_within_its_margins(name: str, lang: str, tmp_path: Path) -> None:
    source = latex(record(name), language=language(lang))
    assert source.isascii()
    log = typeset(source, tmp_path, runs=2)
    assert "Overfull" not in log
    assert "undefined" not in log
    assert "multiply defined" not in log


@pytest.mark.parametrize("title", HOSTILE)
def test_hostile_titles_are_printed_not_obeyed(title: str, tmp_path: Path) -> None:
    d = titled(title)
    source = latex(d)
    assert source.isascii()
    assert r"\input" not in source
    assert source.count(r"\end{document}") == 1
    log = typeset(source, tmp_path)
    assert "passwd" not in log
    shown = text(d)
    assert max(map(display_width, shown.split("\n"))) <= 100
    assert all(c == "\n" or c.isprintable() for c in shown)
    first = markdown(d).split("\n", 1)[0]
    assert first.startswith("# ")
    assert "<" not in first
    assert not re.search(r"(?<!\\)[$`*]", first)


def test_hostile_names_and_labels_compile(tmp_path: Path) -> None:
    tree = ("add", ("par", r"\input{x}"), ("mul", "a_b_c", "{$"), ("inv", ("par", "a_b")))
    equation = Equation(tree, ("pow", ("at", "ξ′", 1), 2), ("ξ′", "#^_"))
    hard = say("a_b_c $ δ′y = \\x (^")
    step = Step("a}b\\_$.x", "definition", (), (equation, equation), hard, (1,))
    symbols = (Symbol("ξ′", say("x_ {$"), r"\input{/etc/passwd}"),)
    d = Derivation({"name": "n", "title": "", "parameters": {"x_$": 3}}, symbols, (step,))
    source = latex(d)
    assert r"\input" not in source
    typeset(source, tmp_path)
    assert max(map(display_width, text(d).split("\n"))) <= 100
    assert r"\input" not in markdown(d)


def test_a_record_may_not_bring_its_own_commands() -> None:
    own = {"A": r"\input{x}", "B": r"\tilde B_0", "C": "x^y^z"}
    names = names_of(Symbol(name, say(""), latex) for name, latex in own.items())
    assert names["A"] == "A"
    assert names["B"] == r"\tilde B_0"
    assert names["C"] == "C"


def test_a_term_longer_than_a_line_is_broken_inside() -> None:
    sides = [("add", *[f"{letter}_{k}" for k in range(40)]) for letter in "xy"]
    long = ("inner", *sides)
    step = Step("n.long", "definition", (), (Equation("U", long),), say("Long."))
    d = Derivation({"name": "n"}, (), (step,))
    lines = text(d).split("\n")
    assert max(map(display_width, lines)) <= 100
    assert "".join(show(long).split()) in "".join("".join(lines).split())


def test_long_formulas_keep_inside_the_margins(tmp_path: Path) -> None:
    terms = [("inner", ("add", f"x_{k}", "A"), ("mul", "Z", "c")) for k in range(30)]
    long = ("mul", "m", ("add", *terms))
    entries = ("matrix", ("row", ("add", *[("par", f"x_{k}") for k in range(60)])))
    pages = ("add", *(("mul", x, ("par", f"k_{k}")) for k in range(20) for x in terms))
    equations = (Equation(("add", *terms), long, ("ξ′",)), Equation("r", entries))
    equations += (Equation("U", pages),)
    d = Derivation({"name": "n"}, (), (Step("n.long", "definition", (), equations, say("Long.")),))
    assert "Overfull" not in typeset(latex(d), tmp_path)


NESTED = {
    "quotient": lambda t, k: ("div", ("add", 1, t), ("add", ("par", f"k_{k}"), 2)),
    "below": lambda t, k: ("div", ("mul", 3, ("par", f"k_{k}")), ("add", 1, t)),
    "power": lambda t, k: ("pow", ("add", ("par", f"k_{k}"), t), 2),
    "root": lambda t, k: ("fun", "sqrt", ("add", ("par", f"k_{k}"), t)),
    "scalar product": lambda t, _: ("inner", ("mul", t, "c"), "w"),
    "norm": lambda t, _: ("norm2", ("mul", t, "c")),
    "trace": lambda t, _: ("tr", ("mul", t, "Z")),
    "determinant": lambda t, _: ("det", ("mul", t, "Z")),
    "inverse": lambda t, _: ("inv", ("add", 1, t)),
    "transpose": lambda t, _: ("T", ("mul", t, "Z")),
    "sum": lambda t, _: ("sum", "i", ("mul", ("at", "m", "i"), ("add", 1, t))),
}


@pytest.mark.parametrize("operator", NESTED)
def test_what_is_nested_is_printed_once(operator, monkeypatch):
    """Thirty deep; a printer that printed an operand twice would take 2³⁰ times as long."""
    shown = []
    once = FormulaPrinter.show
    monkeypatch.setattr(
        FormulaPrinter, "show", lambda self, t: shown.append(t) or budget(shown) or once(self, t)
    )
    tree = "t"
    for k in range(30):
        tree = NESTED[operator](tree, k)
    show(tree)
    latex_tree(tree, {})


def budget(shown):
    assert len(shown) < 30 * 20, "printed again and again"


def test_an_inner_line_has_room_for_its_indent() -> None:
    pieces = [Piece("a", 0), Piece(" + ⟨bbbbb", 0.25), Piece(" cccc", 1.0), Piece(" dddd⟩", 1.0)]
    lines = fill(pieces, 10, display_width, 2)
    assert [display_width(x.text) + 2 * x.inside for x in lines if x.inside] == [6, 7]


def test_three_numbers_of_the_paper_are_a_run_and_two_are_not():
    step = Step("a.b", "definition", (), (), (), ())
    for paper, shown in {
        (11, 12, 13): "(11)–(13)",
        (11, 12): "(11), (12)",
        (11, 13): "(11), (13)",
    }.items():
        assert printed(replace(step, paper=paper)) == shown


def test_long_formulas_break_at_shallow_operators_first() -> None:
    pieces = [Piece("aaaa", 0), Piece(" + ⟨bb,", 0.25), Piece(" cccc⟩", 1.0), Piece(" + dd", 0.25)]
    assert [x.text for x in fill(pieces, 17, display_width)] == ["aaaa + ⟨bb, cccc⟩", "+ dd"]
    deep = fill(pieces, 10, display_width, 2)
    assert [(x.text, x.inside) for x in deep] == [
        ("aaaa", 0), ("+ ⟨bb,", 0), ("cccc⟩", 1), ("+ dd", 0),
    ]  # fmt: skip
