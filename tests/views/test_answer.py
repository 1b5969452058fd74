"""The answer of a record, with what its letters are; what the views say of a system in words, of a
fluid, and of both trivialisations."""

import re
from dataclasses import replace
from fractions import Fraction
from unicodedata import normalize

import numpy as np
import pytest
import sympy

import derive
from derive.check.checker import checker_of
from derive.check.form.hypotheses_checked import denominators
from derive.command.cli import main
from derive.command.showing import ready_made
from derive.language.show import show
from derive.language.tree import neg, nodes
from derive.pipeline import both_trivialisations, walk
from derive.problem.toml import problem_of
from derive.record.record import Hypothesis
from derive.views.answer import (
    answer_mathml,
    answer_text,
    as_written,
    definitions,
    equations_of_motion,
    rounded,
    steps_of_answer,
    summary,
)
from derive.views.html import html
from derive.views.language import ENGLISH, LANGUAGES, language
from derive.views.latex import latex
from derive.views.layout import Reading
from derive.views.outline import assumed, moving, system
from derive.views.printing.signs import tex_text
from derive.views.printing.typeset import display_width
from derive.views.rendering import FORMATS, pdf, render
from derive.views.stations import told as stations
from tests.support import walks
from tests.support.needs import needs
from tests.support.walks import FLUIDS, record
from tests.support.walks import record as walk_of


@pytest.mark.parametrize("name", ready_made())
def test_it_is_of_the_record_and_as_wide_as_is_asked_for(name):
    """Its equations stand in the walk, each once; in every language it is of the width."""
    record = walk_of(name)
    motion = equations_of_motion(record)
    defined = definitions(record, motion)
    assert motion
    assert {*motion, *defined} <= {e for step in record.steps for e in step.equations}
    assert len({e.lhs for e in (*motion, *defined)}) == len({*motion, *defined})
    for words in map(language, LANGUAGES):
        shown = answer_text(summary(record, words), 72)
        assert all(display_width(line) <= 72 for line in shown.split("\n"))
        assert words.word("where") in shown or not defined
        assert steps_of_answer(record)[0].label in shown


@pytest.mark.parametrize("name", ready_made())
def test_what_is_gathered_holds(name):
    """The checker, which knows no views, tries the answer and its definitions as they are written,
    where what they divide by is not 0."""
    d = walk_of(name)
    motion, checker = equations_of_motion(d), checker_of(d.problem, 1)
    checker.symbols(d)
    for step in d.steps:
        if {*motion, *definitions(d, motion)} & {*step.equations}:
            told = tuple(as_written(d, e) for e in step.equations)
            divisors = {t for e in told for t in denominators(e.rhs)}
            supposed = {x.of for x in step.hypotheses}
            more = tuple(Hypothesis("nonzero", t) for t in divisors - supposed)
            written = replace(step, equations=told, hypotheses=(*step.hypotheses, *more))
            verdict = checker.check(written)
            assert verdict.holds, (step.label, verdict.reason)


CONSTANTS = {"π", "d/dt"}


@pytest.mark.parametrize("name", ready_made())
def test_every_letter_is_explained(name):
    """Each name on a right side is explained in the list, or has an equation there for itself or
    for the members of its family; each parameter is in the list, or its vector is."""
    told = summary(walk_of(name))
    equations = [e for _, step in told.blocks for e in step.equations]
    sides = [(t, {y for x in nodes(t) for y in bound(x)}) for e in equations for t in (e.rhs,)]
    listed = {y for x in told.letters for y in x.names}
    equated = {e.lhs for e in equations} | {
        e.lhs[1] for e in equations if isinstance(e.lhs, tuple) and e.lhs[0] in ("at", "entry")
    }
    for side, indices in sides:
        for x in nodes(side):
            if isinstance(x, tuple) and x[0] == "par":
                assert {x, ("par", x[1].rpartition("_")[0])} & (listed | equated), x
        used = {x for x in plain_names(side) if not x[0].isdigit()} - indices - CONSTANTS
        assert used <= listed | equated, used - listed - equated


def bound(t):
    """The index that a sum, or a member of any number, binds."""
    if isinstance(t, tuple) and t[0] in ("sum", "at", "entry"):
        yield from (x for x in (t[1:2] if t[0] == "sum" else t[2:]) if isinstance(x, str))


def plain_names(t):
    """The names of a tree, but the names of parameters."""
    if isinstance(t, str):
        yield t
    elif isinstance(t, tuple) and t[0] != "par":
        parts = t[2:] if t[0] in ("fun", "sum") else t[1:]
        yield from (x for part in parts for x in plain_names(part))


def defined_in(name):
    """What the answer of a problem defines."""
    _, (_, where) = summary(walk_of(name)).blocks
    return {e.lhs for e in where.equations}


@pytest.mark.parametrize("name", ["sp4", "coupled"])
def test_mass_matrix_and_load_have_formulas(name):
    heads = defined_in(name)
    assert {"M", "β"} <= heads | {x[1] for x in heads if isinstance(x, tuple)}


def test_a_spring_stands_by_the_difference_of_its_ends():
    """The rates of two bodies that it ties, each in the entries of d₁, of which the answer says
    what they are, of no other points than these ends."""
    told = {e.lhs: e.rhs for e in equations_of_motion(walk_of("two_tops"))}
    ends = {("entry", ("at", "d", 1), i) for i in (1, 2, 3)}
    assert all(ends <= {*nodes(told["entry", "ζ̇", a])} for a in (2, 3, 4, 5, 6))
    defined = defined_in("two_tops")
    assert {("at", "d", 1), ("at", "r", 1), ("at", "r", 3)} <= defined
    assert not {"N_Q", ("at", "r", 2), ("at", "r", 4)} & defined


def test_a_place_on_r3_is_t_and_a_sum_has_no_brackets_in_it():
    """−(−a − b) is read as a + b; in the record the same trees stay."""
    ell = "1/2*m*(zeta_1^2 + zeta_2^2*cos(T_1)) - k*T_2^2"
    own = {"name": "arm", "group": "R(3)", "lagrangian": {"L": ell + " + 1/2*m*zeta_3^2"}}
    d = walk(problem_of(own | {"parameters": {"m": 1.0, "k": 2.0}}))
    text = render(d, "text", answer=True)
    assert "cos(T₁)" in text
    assert "T: last column" in text
    assert "A₁₄" not in text
    assert ("entry", "A", 1, 4) in {x for s in d.steps for e in s.equations for x in nodes(e.rhs)}
    summed = ("add", "a", ("mul", -1, ("add", ("mul", -1, "b"), ("mul", -2, "c"))))
    assert show(Reading(d.problem).tree(summed)) == "a + b + 2c"


def test_a_letter_is_defined_where_it_is_used_alone():
    """The semi-axis c does not bring the first moment c, nor is m = m said of a parameter."""
    for name, unused in (("ellipsoid", "c"), ("riemann_ellipsoid", "c"), ("se3", "m")):
        assert unused not in defined_in(name)


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("form", ["text", "markdown", "latex", "html"])
def test_every_format_has_the_same(form, lang, capsys):
    """Title, where, a meaning, a default, the steps: in each format, and no step of the walk."""
    assert main(["walk", "pendulum", "--answer", "--format", form, "--lang", lang]) == 0
    shown = capsys.readouterr().out.replace(r"\allowbreak{}", "")
    words = language(lang)
    for x in ("A pendulum in the plane", "where", "length of the rod"):
        said = words.word(x)
        assert (tex_text(said) if form == "latex" else said) in shown
    assert words.word("default {value}", value=words.decimal(0.8)) in shown
    assert shown.count("pendulum.explicit") == 1
    assert "pendulum.cartan" not in shown


@needs("pdflatex")
def test_pdflatex_takes_it():
    for lang in LANGUAGES:
        assert pdf(render(walk_of("hung_bar"), "latex", lang, answer=True)).startswith(b"%PDF")


def test_python_has_it():
    d = derive.derive("euler_top")
    rate = d.answer.sympy()[1].rhs
    (zeta,) = rate.atoms(sympy.MatrixSymbol)
    moments = {"I1": 1, "I2": 1.6, "I3": 2.2}
    values = {x: moments[x.name] for x in rate.free_symbols - {zeta}}
    found = rate.subs(values).subs(zeta, sympy.Matrix([0.3, -0.7, 0.2])).doit()
    assert np.isclose(float(found), (1.6 - 2.2) / 1.0 * -0.7 * 0.2)
    assert str(d.answer) == answer_text(summary(d.record))
    assert d._repr_markdown_().startswith(d.answer.markdown())
    assert "<details>" in d._repr_markdown_()


@pytest.fixture(scope="module", params=["gyrostat", "so3", "kirchhoff"])
def walked(request):
    return derive.derive(request.param).record


def test_each_step_beside_its_like(walked):
    labels = [s.label for s in both_trivialisations(walked).steps]
    on_left = [x for x in labels if x.startswith("left.")]
    assert len(on_left) > 8
    beside = [y for x in on_left for y in (x, x.replace("left.", "right."))]
    assert labels[: len(beside)] == beside
    assert {s.label for s in walked.steps} <= {*labels}
    assert len({*labels}) == len(labels)


@pytest.mark.parametrize("form", [x for x in FORMATS if x != "json"])
@pytest.mark.parametrize("lang", ["en", "fr"])
def test_every_format(walked, form, lang):
    shown = render(both_trivialisations(walked), form, lang)
    assert shown.index("left.structure") < shown.index("right.structure")
    if form == "html":
        assert ("beside the right" if lang == "en" else "à gauche et à droite") in shown


ON_MOTIONS = {"energy_kept": 1, "circulation": 1, "kelvin": 2}
"""Of the equations that say something of the acceleration, how many hold on motions alone."""


@pytest.mark.parametrize("name", FLUIDS)
def test_which_equations_hold_along_the_motion_alone(name):
    for step in record(name).steps:
        short = step.label.removeprefix(f"{name}.")
        found = moving(step.equations)
        assert len(found) == ON_MOTIONS.get(short, 0), step.label
        assert not any(e.for_all for e in found)
        free = any("u̇" in e.for_all or "ν̇" in e.for_all for e in step.equations)
        assert ("for any acceleration" in assumed(step)) == (free and not found), step.label


POINTS = "of the points is pulled back"
STATED = ("lagrange_top", "gyrostat", "charged_body", "kirchhoff", "spherical_pendulum", "manakov")
OTHER = ("euler_poisson", "zeitlin")


@pytest.mark.parametrize("name", [*STATED, *OTHER])
def test_a_given_lagrangian_moves_no_body(name):
    d = walks.record(name)
    for text in (html([d]), latex(d)):
        assert POINTS not in text
        assert "Nothing acts" not in text
    for tongue in ("en", "fr"):
        told = system(d, language(tongue))
        assert "{" not in told
        assert not any(x in told for x in ("moves", "déplace", "Rien n’agit", "Nothing acts"))


EVERY = {"en": "for every", "fr": "pour tout"}
ALONG = {"en": "along the motion", "fr": "le long du mouvement"}
CLAUSES = {
    "text": re.compile(r"(?m)^ {6}.*\S  (\w.*)$"),
    "latex": re.compile(r"\\text\{([^}]*)\}"),
    "markdown": re.compile(r"\\text\{([^}]*)\}"),
    "html": re.compile("<mtext>([^<]*)</mtext>"),
}
"""Format → what stands at the end of an equation."""


@pytest.mark.parametrize("lang", EVERY)
@pytest.mark.parametrize("form", [x for x in FORMATS if x != "json"])
def test_every_view_says_it_beside_the_equation(form, lang):
    d = record("inhomogeneous_fluid")
    for short, others in ON_MOTIONS.items():
        shown = render(d, form, lang, steps=[d[short]])
        clauses = [x.replace("\u00a0", " ").strip() for x in CLAUSES[form].findall(shown)]
        free = sum(bool(e.for_all) for e in d[short].equations)
        assert sum(x.startswith(EVERY[lang]) for x in clauses) == free
        assert clauses.count(ALONG[lang]) == others
        assert "any acceleration" not in shown
        assert "accélération quelconque" not in shown


@pytest.mark.parametrize(("group", "at"), [("SO(2)", "-l"), ("SE(2)", "-l")])
def test_the_step_of_an_answer_in_the_plane_has_its_form(group, at):
    """Its right sides by the angle stand at the step, and at the station, as in the answer; the
    entries that the angle tells are told beside them."""
    points = [{"mass": 1, "at": [0, at]}, {"mass": 2, "at": [0, 0]}][: 1 + (group == "SE(2)")]
    gravity = {"kind": "gravity", "g": [0, "-g"]}
    told = {"name": "bob", "group": group, "parameters": {"l": 2.0, "g": 9.81}}
    d = walk(problem_of({**told, "point": points, "potential": [gravity]}))
    page = html([d])
    shown = [x for label, x in answer_mathml(d) if label == "bob.explicit"]
    turned = [x for x in shown if "<mi>θ</mi>" in x]
    assert turned
    step = page.partition('<article id="bob.explicit">')[2].partition("<details>")[0]
    for x in turned:
        _, right = "".join(re.findall(">([^<]+)<", x)).split("=")
        assert f"={right}" in "".join(re.findall(">([^<]+)<", step)).replace("\n", "")
    assert "A12=−sin(θ)" in "".join(re.findall(">([^<]+)<", step))
    (body,) = [x["shown"] for x in stations(d, str) if x["name"] == "body"]
    assert ("<mi>θ</mi>" in body) == (group == "SO(2)")


@pytest.mark.parametrize("unit", [1e-7, 1.0, 1e7])
@pytest.mark.parametrize("lang", LANGUAGES)
def test_long_numbers_are_rounded_where_an_answer_is_seen(unit, lang):
    """Of measured moments the rates are Euler's to five digits, behind ≈, with the decimal mark of
    the language; what the record has is exact, and so is a short number."""
    inertia = [unit * x for x in (1.23456789123, 2.34567891231, 3.45678912345)]
    tensor = [[repr(x) if i == j else 0 for j in range(3)] for i, x in enumerate(inertia)]
    told = {"name": "r", "group": "SO(3)", "body": {"given": {"m": 1, "c": [0, 0, 0], "I": tensor}}}
    d = walk(problem_of({**told, "input": [{"name": "N", "kind": "torque"}]}))
    texts = [
        "".join(re.findall(">([^<]+)<", x)) for _, x in answer_mathml(d, language=language(lang))
    ]
    assert texts[0] == "A˙=Aj(ζ)"
    for i, text in enumerate(texts[1:]):
        j, k = (i + 1) % 3, (i + 2) % 3
        first, second = sorted((j, k))
        spelt = {f"A{x + 1}{i + 1}N{x + 1}": 1 / inertia[i] for x in range(3)}
        spelt[f"ζ{first + 1}ζ{second + 1}"] = (inertia[j] - inertia[k]) / inertia[i]
        left, right = text.replace(",", ".").split("≈")
        assert left == f"ζ˙{i + 1}"
        assert ("," in text) == (lang == "fr")
        for name, exact in spelt.items():
            shown = re.search(rf"([+−]?)([0-9.]+)(?:·10([⁻⁰¹²³⁴-⁹]+))?{name}", right)
            sign, size, power = shown.groups("")
            scale = 10.0 ** int(normalize("NFKC", power).replace("−", "-") or 0)
            factor = float(size) * scale * (-1 if sign == "−" else 1)
            assert factor == pytest.approx(exact, rel=5.1e-5)


def test_a_number_beyond_floats_is_rounded_too():
    assert rounded(-Fraction(12_345_678 * 10**400, 3), ENGLISH) == neg("4.1152·10⁴⁰⁶")
