"""What is printed is read back, by readers that know no printer, and is what the record says; each
sentence says the same in text, LaTeX, Markdown and MathML.  Records as they are read: entries by
the blocks of a product, common factors of parameters before their sum."""

import random
import re
import tomllib
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest

import derive
from derive.language.reserved import advected_entries
from derive.language.show import show, show_name, unclear
from derive.language.tree import nodes
from derive.language.values import value
from derive.pipeline import walk
from derive.problem.fields import state_names
from derive.problem.toml import problem_of
from derive.record.sentence import PLACE, Sentence
from derive.searches import equilibria
from derive.views.answer import ARROW, PLANE, answer_mathml, as_written, equations_of_motion
from derive.views.arrows import arrows, marks
from derive.views.language import catalogue_entries, language
from derive.views.layout import Reading, as_read, factored
from derive.views.printing.letters import names_of, parameter
from derive.views.printing.sentences import QUOTED
from derive.views.printing.signs import LOWERED, RAISED, SYMBOLS
from derive.views.rendering import FORMATS, render
from tests.readers import mathml
from tests.readers.formula import canonical, letters_of
from tests.readers.read import PAGES, READERS, faults, misread, misread_sentences, missing
from tests.support import corpus, printing_mutations, random_trees, reduced, symmetric
from tests.support.capabilities import about_options
from tests.support.lagrangians import every_record
from tests.support.walks import ESTIMATES, FLUIDS, NAMES, OTHERS, record, repeated

SEEDS = 4
TREES = 500


def test_every_format_has_a_reader():
    assert {*FORMATS} == {*READERS, "json"}  # which the record itself reads
    assert {*READERS} <= {*PAGES}


@pytest.mark.parametrize("name", repeated(dict.fromkeys((*NAMES, *FLUIDS, *OTHERS, *ESTIMATES))))
def test_every_page_says_what_its_record_says(name):
    assert [x for kind in PAGES for x in faults(record(name), kind)] == []


@pytest.mark.parametrize("kind", ["text", "latex", "markdown"])
@pytest.mark.parametrize("name", repeated(NAMES))
def test_an_answer_as_a_person_writes_it_is_read_back(name, kind):
    d = record(name)
    told = [as_written(d, e) for e in equations_of_motion(d) if not (e.for_all or e.exists)]
    step = replace(d.steps[-1], equations=tuple(told), uses=())
    assert not told or faults(replace(d, steps=(step,)), kind) == []


@pytest.mark.parametrize("name", repeated((*NAMES, *OTHERS)))
def test_the_answer_of_a_page_is_that_of_a_terminal_with_every_mark(name):
    d, known = record(name), letters_of(record(name))
    known = replace(known, parameters=known.parameters | {*advected_entries(d.problem)})
    told, read, own = equations_of_motion(d), as_read(d), marks(arrows(d))
    shown = [x for _, x in answer_mathml(d, own)]
    there = {x for e in told for side in (e.lhs, e.rhs) for x in nodes(side)}
    assert {f'data-arrow="{own[x]}"' for x in there & {*own}} <= {*ARROW.findall("".join(shown))}
    if d.problem.get("group") not in PLANE:
        said = [mathml.equation(mathml.all_tokens(x, known), known) for x in shown]
        want = {canonical(e.lhs, known): as_written(read, e) for e in equations_of_motion(read)}
        said = [e for e in said if canonical(e[0], known) in want]  # a vector's stand beside them
        assert missing(want.values(), said, known, plain=False) == ""
        assert len(said) == len(want)


SIZES = {
    "name": "sledge",
    "group": "SE(2)",
    "parameters": {"k": 2, "b": 0.5},
    "point": [{"mass": 1, "at": [1, 0]}, {"mass": 2, "at": [0, "b"]}],
    "force": [
        {"at": [1, 1], "force": ["-k*abs(v_1)*v_1", "abs(v_1 - 2*abs(r_2))^3"]},
        {"at": [0, 1], "moment": ["-k*max(w_1, abs(zeta_1*abs(b)))"], "force": ["sign(v_1)", 0]},
    ],
}
"""Sizes alone, within sizes, raised, and as divisors."""


def test_a_size_is_shown_between_strokes_and_read_back():
    d = derive.derive(problem_of(SIZES)).record
    assert [x for kind in PAGES for x in faults(d, kind)] == []
    page = PAGES["text"](d)
    assert "|(v₃)₁|" in page
    assert "√(" not in page.partition("sledge.")[2]


@pytest.mark.parametrize("seed", repeated(range(SEEDS)))
def test_random_trees_are_read_in_one_way(seed):
    draw = random.Random(seed)
    for _ in range(TREES):
        assert [*misread(random_trees.tree(draw, draw.randint(0, 4)))] == []


OWNERS = ("hammer", "ellipsoid", "sl3", "comet", "saff3", "top", "so3", "jelly")
"""Records with parameters to rename."""


@pytest.mark.parametrize("seed", repeated(range(10)))
def test_names_that_look_like_others_are_printed_apart(seed):
    draw = random.Random(seed)
    d = renamed(record(draw.choice(OWNERS)), draw)
    assert [x for kind in PAGES for x in faults(d, kind)] == []


def test_a_name_is_marked_only_where_it_would_be_read_as_another():
    letters = {"J", "c", "m", "d", "r"}
    names = {"a", "b", "ab", "ac", "x_1", "J_12", "J", "m", "m_rod", "d_11", "j", "Tr", "mu", "G"}
    marked = unclear(letters, names, symbolic=True)
    assert marked == {"ab", "ac", "J", "d_11", "j", "Tr", "G"}
    assert unclear(letters, {"ab", "a", "k"}, symbolic=False) == set()
    names = names_of((), ("x1", "x_1", "y2"))
    assert parameter("x1", names).tex == r"\mathsf{x1}"
    assert parameter("x_1", names).tex == parameter("x1").tex == r"\mathsf{x}_{\mathsf{1}}"
    assert parameter("y2", names).tex == r"\mathsf{y}_{\mathsf{2}}"


@pytest.fixture(scope="module")
def material():
    """Trees and records that are read back as they are."""
    trees, records = printing_mutations.material()
    assert [*printing_mutations.seen(trees, records)] == []
    return trees, records


@pytest.mark.parametrize("name", repeated(printing_mutations.MUTATIONS))
def test_a_printer_that_is_wrong_is_seen(name, material):
    assert printing_mutations.caught(name, *material)


LANGUAGES = ("en", "fr")
WALKS = tuple(dict.fromkeys((*NAMES, *FLUIDS, *OTHERS, *ESTIMATES)))


BESIDE = [
    *(f"reduced {x}" for x in reduced.FILES),
    *(f"symmetries {x}" for x in symmetric.FILES),
    *("discrete so3", "discrete se3", "discrete top"),
]
COUNT = 36
"""Integrals and equilibria of :func:`.every_record`."""


@cache
def found():
    """What is told of problems beside their walks."""
    return dict(enumerate(every_record())) | {x: corpus.record(x) for x in BESIDE}


@pytest.mark.parametrize("name", repeated(WALKS))
@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_sentence_of_a_walk_is_read_back(name, lang):
    assert [*misread_sentences(record(name), language(lang))] == []


@pytest.mark.parametrize("name", [*range(COUNT), *BESIDE])
@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_sentence_of_what_is_found_is_read_back(name, lang):
    assert [*misread_sentences(found()[name], language(lang))] == []


def places(x):
    """What fills the places of a sentence, in any depth."""
    for _, y in x.places:
        yield from places(y) if isinstance(y, Sentence) else (y,)


def unmarked(d):
    """The places with a parameter that stands in no quotes."""
    known = letters_of(d)
    own = {show_name(x) for x in known.parameters - known.letters} - {"i"}
    filled = (y for step in d.steps for x in step.prose for y in places(x))
    bare = re.compile(rf"(?<![^\W\d])(?:{'|'.join(map(re.escape, sorted(own)))})(?![\w(])")
    return [x for x in filled if own and bare.search(QUOTED.sub("", x))]


def test_parameters_of_a_sentence_are_told_from_its_letters():
    assert [x for d in (*map(record, WALKS), *found().values()) for x in unmarked(d)] == []


def test_they_are_as_many():
    assert {*found()} == {*range(COUNT), *BESIDE}


LOOKING_ALIKE = """
    a b c d e h i j k l m n p q r s t_ x y z A B C E F G H J K M N P Q R S T U V X Y Z ab ba
    xy x1 x_1 x12 x_12 y1 y_1 k12 k_12 Tr det dm dt dT dd mu rho rho1 rho_1 sigma_1 d_11 d11
    d_1 J_3 J_11 c_9 m_1 m1 M_ab E_a r_1 r_i I_c U_Q p_b N_c w_c si cos_1 sn pi_2 lambda
    Lambda phi Omega omega_3 mass s_max a1_2 a12 x_123 zeta zeta_1 alpha delta delta_A Sigma
    in_ os sp An ca
""".split()  # noqa: SIM905
"""Of those that a problem may have, the ones that are hardest to print apart."""


def renamed(d, draw):
    """The record with names drawn for all parameters but its moments."""
    parameters = d.problem["parameters"]
    kept = [*parameters] if d.problem["body"]["kind"] == "moments" else []
    kept = [x for x in kept if x[0] in "mcJ"]
    free = [x for x in LOOKING_ALIKE if x not in kept]
    new = dict(
        zip([x for x in parameters if x not in kept], draw.sample(free, len(free)), strict=False)
    )
    problem = {**d.problem, "parameters": {new.get(x, x): y for x, y in parameters.items()}}

    def of(t):
        if isinstance(t, tuple) and t[0] == "par":
            return ("par", new.get(t[1], t[1]))
        return (t[0], *map(of, t[1:])) if isinstance(t, tuple) else t

    steps = tuple(
        replace(s, equations=tuple(replace(e, lhs=of(e.lhs), rhs=of(e.rhs)) for e in s.equations))
        for s in d.steps
    )
    return replace(d, problem=problem, steps=steps)


MATHEMATICAL = rf"[{re.escape(''.join(SYMBOLS))}{''.join(RAISED)}{''.join(LOWERED)}_=^<>]"
ALONE = r"(?<![\w’'-])[^\W\da_](?![\w’'-])|[^\W\d]\("
OTHER = {*"AyàÀ", "→", "_"}
"""Words of one letter; a key between arrows; a key of a problem."""


@pytest.mark.parametrize("lang", LANGUAGES)
def test_no_formula_stands_outside_marks(lang):
    """Nothing there is a sign of mathematics, a letter by itself or a function; but in the help of
    a command."""
    found = []
    for x in (x for x in catalogue_entries() if x["en"] not in about_options()):
        words = PLACE.sub("", " ".join(x[lang].split("$")[::2]))
        found += [(m[0], x[lang]) for m in re.finditer(f"{MATHEMATICAL}|{ALONE}", words)]
    assert [x for x in found if x[0] not in OTHER] == []


# -- as it is read --------------------------------------------------------------------------------

DOUBLE = {
    "name": "two_blocks",
    "group": "SO(2) x SE(2)",
    "parameters": {"l": 1.0, "m": 1.0, "n": 1.0},
    "lagrangian": {
        "L": "(m + n)*l^2*zeta_1^2/2 + zeta_2^2 + zeta_3^2 + zeta_4^2 + A2_11*A1_11 - T2_1^2/2"
    },
}
TYPED = re.compile(r"([AT])(\d)_(\d)(\d?)")


@pytest.fixture(scope="module")
def double():
    problem = problem_of(DOUBLE)
    return problem, walk(problem)


def test_each_entry_is_that_of_its_block_as_it_is_typed(double):
    problem, _ = double
    reading = Reading({"group": "SO(2) x SE(2)"})
    typed = {name: t for name, t in state_names(problem.group).items() if TYPED.fullmatch(name)}
    assert len(typed) == 4 + 4 + 2
    for name, t in typed.items():
        letter, block, *at = TYPED.fullmatch(name).groups()
        places = map(int, filter(None, at))
        assert reading.tree(t) == ("entry", ("at", letter, int(block)), *places), name


@pytest.mark.parametrize("form", ["text", "markdown", "latex", "html"])
def test_every_view_has_them_so(double, form):
    _, record = double
    shown = render(record, form)
    assert {"text": "(A₂)₁₁", "html": "A"}.get(form, "(A_{2})_{11}") in shown
    assert not re.search(r"\bA₃₃|\bA_\{33\}", shown)
    assert ("its blocks are" in shown) is (form != "markdown")  # which lists no names


def test_the_json_and_other_groups_stay(double):
    _, record = double
    assert '["entry", "A", 3, 3]' in re.sub(r"\s+", " ", render(record, "json"))
    assert Reading({"group": "SO(3)"}).tree(("entry", "A", 3, 3)) == ("entry", "A", 3, 3)
    assert Reading({"group": "SO(3)"}).text("A₃₃ = 1") == "A₃₃ = 1"
    assert Reading({"group": "SAff(2)"}).tree(("entry", "A", 1, 3)) == ("entry", "T", 1)
    assert Reading({"group": "SO(2) x SO(2)"}).text("A₃₃ = −A₄₄, J₃₃") == "(A₂)₁₁ = −(A₂)₂₂, J₃₃"


CARRYING = """
name = "carrying"
[algebra]
basis = [[[1, 0], [0, -1]], [[0, 1], [0, 0]], [[0, 0], [1, 0]]]
[[advected]]
name = "u"
[[advected]]
name = "wind"
representation = "dual"
[parameters]
k = 0.5
[lagrangian]
L = "zeta_1^2 + zeta_2^2 + 3*zeta_3^2/2 - k*u_1*wind_1"
"""
SHOWN = {
    "text": ("u₂", "wind₁", "u̇₂ =", "d/dt(wind₂) ="),
    "markdown": ("u}_", "wind}_", r"\dot{\mathsf{u}}_{\mathsf{2}} &=", r"(\mathsf{wind}_"),
    "latex": ("u}_", "wind}_", r"\rate{\parameter{u}}_{\parameter{2}} &=", r"(\parameter{wind}_"),
    "html": (">u</mi>", ">wind</mi>", "˙</mo></mover>", ">wind</mi>"),
}


@pytest.mark.parametrize("form", SHOWN)
@pytest.mark.parametrize("lang", ["en", "fr"])
def test_what_is_carried_along_has_its_own_names(form, lang):
    problem = problem_of(tomllib.loads(CARRYING))
    found, record = equilibria(problem, {"u_2": 1})
    assert found == equilibria(problem, {"Gamma_2": 1})[0]
    shown = render(record, form, lang)
    for part in SHOWN[form]:
        assert part in shown, part
    whole = "\n".join(map(show, (x for s in record.steps for e in s.equations for x in (e.lhs,))))
    assert "Γ̇₂" in whole  # in the record, which is checked
    assert not re.search(r"Γ̇?[₀-₉]|\\Gamma\}?_|Γ</mi>\s*<mn>", shown)
    asked = re.sub(r"\s+", " ", shown)
    if form == "text":
        told = {
            "en": "its components are u₁, u₂, wind₁, wind₂",
            "fr": "ses composantes sont u₁, u₂",
        }
        assert told[lang] in asked


def test_what_is_factored_has_the_same_value_and_fewer_factors(double):
    _, record = double
    draw = random.Random(3)
    values = {x: Fraction(draw.randint(1, 99), 7) for x in "lmn"}
    sums = {x for s in record.steps for e in s.equations for x in _sums(e.rhs) if factored(x) != x}
    assert "l²(m + n)" in {show(factored(x)) for x in sums}
    for x in sums:
        assert value(x, {}, values) == value(factored(x), {}, values)
    for text in (("add", ("par", "m"), ("par", "n")), ("add", 1, ("par", "m"))):
        assert factored(text) == text
    read = as_read(record)
    assert [s.label for s in read.steps] == [s.label for s in record.steps]


def _sums(t):
    if isinstance(t, tuple):
        if t[0] == "add":
            yield t
        for x in t[1:]:
            yield from _sums(x)
