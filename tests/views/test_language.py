"""The views in French: every message is in the catalogue, every entry is used, formulas stay."""

import ast
import re
import tomllib
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from derive.command.showing import ready_made
from derive.pipeline import walk
from derive.problem.toml import load, problem_of
from derive.python.api import Aff, Damping, Force, Group, Moments, Points, Problem, Solid, Spring
from derive.record import prose as texts
from derive.record import vocabulary
from derive.record.as_json import from_json, to_json
from derive.record.sentence import PLACE
from derive.record.vocabulary import DISPLACEMENTS, PRODUCTS, ROTATIONS, RULES, VOCABULARY, meanings
from derive.schema.body_kinds import SOLIDS, MomentBody
from derive.schema.potential_kinds import kinds
from derive.searches import families, symmetries
from derive.views import outline
from derive.views.language import (
    LANGUAGES,
    THIN,
    WIDE,
    catalogue_entries,
    labelled,
    language,
)
from derive.views.paper.findings import PAPER
from derive.views.printing.sentences import FORMULA
from derive.views.text import markdown, step_markdown, step_text, text
from tests.support import corpus, symmetric, walks
from tests.support.cached import on_disk
from tests.support.kinds import examples
from tests.support.lagrangians import every_record, heisenberg, two_algebras
from tests.support.trims import trim

ROOT = Path(__file__).parents[2] / "derive"
ENTRIES = [{k: texts.unmarked(v) for k, v in x.items()} for x in catalogue_entries()]
FRENCH = language("fr")
THREE = Points((1, [1, 0]), (2, [0, 1]), (3, [0, 0]))
LIFTS = Group("Lifts", [[[0, 0, 0], [0, 0, 1], [0, 0, 0]]], "affine")
UPPER = Group("Upper", [[[1, 0], [0, 0]], [[0, 1], [0, 0]], [[0, 0], [0, 1]]])
TURN = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
ON_TURNED = (
    Solid("tetrahedron", 2, vertices=CORNERS, rotation=TURN),
    Solid("hollow_ball", 1, outer=2, inner=1),
    Solid("ball", 3, radius=1),
)
GIVEN = Moments(m=2, c=[0, 0, 0], J=[[1, 0, 0], [0, 1, 0], [0, 0, 1]])
CORNER = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
MESH = """
name = "corner"
group = "SO(3)"
[[solid]]
kind = "mesh"
density = 1
file = "corner.off"
"""
BOX = """
name = "box"
group = "SL(3)"
[body]
solid = "box"
density = 1
sides = [1, 2, 3]
[[potential]]
kind = "spring"
at = [1, 0, 0]
anchor = [0, 1, 0]
stiffness = 1
"""
CHOSEN = (
    *("SL(3) forces", "SE(3) forces", "Sim(3) forces", "SO(3) x SO(3)", "SO(3) forces"),
    *("a cylinder", "SL(4)", "Aff(2)", "SAff(2)", "weighted"),
    *("SE(3) x SE(3)", "a flat body", "so(3) skewed", "SE(3) torques", "SE(2) torques"),
    *("SE(3) of the state", "Aff(3) of the state", "SE(3) outputs", "SE(2) outputs"),
    "SL(2) outputs",
    "SL(3) covector of the state",
)


def own_problems(folder):
    """Problems that reach what no other does."""
    (folder / "corner.off").write_text(CORNER, encoding="utf-8")
    (folder / "corner.toml").write_text(MESH, encoding="utf-8")
    pushed = [Damping(1), Force("f", on=1), Force("b", on=2, frame="body", direction=[1, 2])]
    return [
        Problem("upper", UPPER, THREE, [Spring(1, 2, 1)]),
        Problem("given", "SO(3)", GIVEN),
        Problem("solids", "SE(3)", [*ON_TURNED]),
        load(folder / "corner.toml"),
        problem_of(tomllib.loads(BOX)),
        Problem("tied", Aff(2), THREE, [Spring(1, 2, 1, length=1)]),
        Problem("anchored", Aff(2), THREE, [Spring(1, [0, 1], 1)]),
        Problem("pushed", Aff(2), THREE, [Spring(1, 2, 1), *pushed]),
        Problem("moments", "SE(3)", Moments(), parameters={}),
        Problem("lifted", LIFTS, Points((1, [0, 0])), [Spring(1, [0, 1], 1)]),
    ]


TWO = " + ".join(f"zeta_{k}^2" for k in range(1, 7))
ON_THE_RIGHT = {"L": "zeta_1^2 + zeta_2^2 + zeta_3^2", "trivialisation": "right"}


def of(L, group="SO(3)", *letters):
    own = {"name": "own", "group": group, "parameters": {x: {} for x in letters}}
    return problem_of(own | {"lagrangian": {"L": L}})


MASSES = "zeta_4^2 + zeta_5^2 + zeta_6^2"
IN_LETTERS = [
    of("(zeta_1^2 + zeta_2^2 + zeta_3^2)/2 - A_33"),
    of(f"(a*zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2 + {MASSES})/2", "SE(3)", "a"),
    of(f"(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2 + {MASSES})/2", "SE(3)"),
    heisenberg(),
    two_algebras("k", k={}),
    two_algebras("1"),
    walks.problem("lagrange_top"),
]
"""Of these the stability is told in letters."""
OF_THE_CORPUS = [
    *(f"{'forces' if x.endswith('forces') else 'points'} {x}" for x in CHOSEN),
    *(f"symmetries {x}" for x in symmetric.FILES),
    *(f"symmetries {x}" for x in ("heisenberg", "riemann_ellipsoid", "screw")),
    *("symmetries spherical_pendulum", "torus stirred"),
    *(f"reduced {x}" for x in ("lagrange_top", "charged_body", "flat", "steep", "rod", "so3")),
    *(f"discrete {x}" for x in ("so3", "se3", "sl3", "gl3", "sp4", "GL(3)", "SE(3)")),
    *("torus 3", "fluid well", "fluid wind"),
]
"""Records that together have all sentences with the ready-made ones and these:"""
QUOTIENT = {
    "group": "SO(3)",
    "lagrangian": {"L": "(zeta_1^2 + zeta_2^2)/2 - A_33"},
    "force": [{"covector": ["-zeta_1", "-zeta_2", 0]}],
}
WHOLE = {"group": "SL(3)", "body": {"solid": "ellipsoid", "density": 1, "semi_axes": [3, 2, 1]}}
WEIGHT = {"kind": "gravity", "g": [0, 0, "-9.81"]}


def kinematics(*rate, inputs=("u",)):
    """Of first order, on the group of the plane that moves (r, 1)."""
    table = {"inputs": [*inputs], "rate": [*rate, [0] * 3]}
    return {"group": "SE(2)", "kinematics": table}


OWN = [
    kinematics(["-A_21*u", "-A_11*u", 0], ["A_11*u", "-A_21*u", "A_11"]),
    kinematics([0, 0, "u"], [0, 0, 0]),
    kinematics(["-A_21*w", "-A_11*w", "u"], ["A_11*w", "-A_21*w", 0], inputs=("u", "w")),
    {"group": "SO(3)", "lagrangian": ON_THE_RIGHT},
    {"group": "SO(3)", "lagrangian": ON_THE_RIGHT, "force": [{"covector": ["-zeta_1", 0, "t"]}]},
    {
        "group": "SO(2) x SO(2)",
        "point": [{"mass": "2 - t", "at": [1, 0]}, {"mass": 1, "at": [0, 1], "block": 2}],
        "flow": [{"at": [2, 0], "rate": -1, "velocity": [0, 1]}],
    },
    {
        "group": "SO(2)",
        "parameters": {"fuel": {}},
        "point": [{"mass": "fuel", "at": [1, 0]}, {"mass": 1, "at": [0, 1]}],
        "input": [{"name": "gas", "kind": "scalar"}],
        "flow": [{"on": 1, "mass": "fuel", "rate": "-gas", "velocity": [0, 1]}],
    },
    {
        "group": "SE(2)",
        "point": [{"mass": "2 - t", "at": [1, 0]}, {"mass": 1, "at": [0, 1]}],
        "flow": [{"at": [2, 0], "rate": -1, "velocity": [0, 1], "steady": True}],
    },
    {
        "group": "SO(2)",
        "point": [{"mass": 2, "at": [1, 0]}],
        "input": [{"name": "gas", "kind": "scalar"}],
        "force": [{"covector": ["-gas*zeta_1"]}],
    },
    {"group": "SO(3)", "lagrangian": ON_THE_RIGHT, "input": [{"name": "u", "kind": "torque"}]},
    {
        "group": "SO(3)",
        "body": {"solid": "ellipsoid", "density": 1, "semi_axes": [3, 2, 1]},
        "force": [
            {"moment": ["-zeta_1", 0, 0], "frame": "space"},
            {"at": [0, 0, 1], "force": ["-v_1", 0, 0], "frame": "body"},
        ],
    },
    {"algebra": {"of": "SO(3)"}, "advected": [{"name": "x"}], "lagrangian": ON_THE_RIGHT},
    {"group": "SO(3) x SE(2)", "lagrangian": {"L": TWO}},
    QUOTIENT,
    WHOLE | {"potential": [WEIGHT]},
    WHOLE | {"potential": [WEIGHT, {"kind": "self_gravity", "G": 1}]},
    WHOLE | {"body": WHOLE["body"] | {"density": "2 - s"}},
]


TRIMS = (
    *("kept aside by a torque", "what stands", "drifting aside", "at rest in air"),
    *("the speed of a tilt", "leaning into a wind", "a root of a cubic", "nearly upside down"),
    *("bent in space", "cubic friction", "leaning into a turn", "a helix"),
)


@on_disk
def all_records():
    """The ready-made problems, some with all kinds of forces, and the own ones."""
    with TemporaryDirectory() as folder:
        problems = [*examples().values(), *own_problems(Path(folder))]
    problems += [problem_of({"name": "own"} | x) for x in OWN]
    told = [*map(walks.record, ready_made()), *map(corpus.record, OF_THE_CORPUS)]
    told.append(symmetries(walks.problem("gl3"), walks.record("gl3")).record)
    told += [trim(x).record for x in TRIMS]
    told += [families(x)[1] for x in IN_LETTERS]
    return [*told, *every_record(), *map(walk, problems)]


@pytest.fixture(scope="module")
def records():
    return all_records()


def messages(sentence):
    """The message of a sentence and of those in its places."""
    yield sentence.message
    for _, x in sentence.places:
        if not isinstance(x, str):
            yield from messages(x)


def said(record):
    """The messages of all steps and symbols."""
    words = [step.prose for step in record.steps] + [s.meaning for s in record.symbols]
    return {m for prose in words for sentence in prose for m in messages(sentence)}


@cache
def tree(path):
    """A source as it is parsed."""
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def strings(*folders):
    """Every string that stands in the sources."""
    paths = (p for folder in folders for p in sorted(ROOT.glob(folder)))
    constants = (x for p in paths for x in ast.walk(tree(p)) if isinstance(x, ast.Constant))
    return {x.value for x in constants if isinstance(x.value, str)}


@cache
def titles_and_meanings():
    """The words of the ready-made problems, and of moments that are parameters."""
    problems = [walks.problem(name) for name in ready_made()]
    given = [*(p for x in problems for p in x.parameters.values())]
    given += MomentBody(n=3).parameters().values()
    return {x.title for x in problems} | {p.meaning for p in given if p.meaning}


def test_the_english_of_an_entry_stands_once():
    assert len({x["en"] for x in ENTRIES}) == len(ENTRIES)
    assert all(set(x) == set(LANGUAGES) and all(x.values()) for x in ENTRIES)


def test_every_sentence_is_in_the_catalogue(records):
    used = set().union(*map(said, records))
    assert used <= set(FRENCH.messages)
    steps = {x for d in records for step in d.steps for y in step.prose for x in messages(y)}
    assert steps <= texts.messages()  # no others are accepted in a record


def test_every_message_of_the_walk_is_reached(records):
    """The problems above go through every branch that says something, but for what is said of
    masses of any sign (tests/walk/test_signed_masses.py), and of searches that are too large to be
    checked and quadratures with a square factor (tests/check/test_record_claims.py)."""
    steps = texts.sentences().items()
    written = strings("walk/*.py", "walk/given/potential*.py") & set(FRENCH.messages) - set(RULES)
    written |= {
        texts.unmarked(x[0])
        for key, x in steps
        if not key.endswith(("_signed", "_large", "_squared"))
    }
    meanings = titles_and_meanings()
    assert written - meanings <= set().union(*map(said, records))


def test_every_word_of_the_tables_is_in_the_catalogue():
    tables = (VOCABULARY, ROTATIONS, PRODUCTS, DISPLACEMENTS)
    words = {x.meaning for table in tables for x in table.values()}
    words |= {x for k in kinds().values() for x in (k.phrase, k.several, k.legend) if x}
    words |= {*RULES, *(words for _, words in outline.ASSUMPTIONS)}
    words |= {p.remark for p in PAPER if p.remark}
    words |= {outline.CONVENTIONS, outline.FORMULAS_CONVENTIONS, outline.PAPER}
    assert {*map(texts.unmarked, words)} | titles_and_meanings() <= set(FRENCH.messages)
    assert {texts.message(f"integrals.{x}") for x in SOLIDS} <= set(FRENCH.messages)


ROOMS = ("walk", "views/figure", "views/plot", "views/page")
SPEAKING = sorted([*ROOT.glob("views/*.py"), *(p for x in ROOMS for p in (ROOT / x).rglob("*.py"))])


def calls():
    """The paths of what speaks, and its calls."""
    for path in SPEAKING:
        yield from ((path, x) for x in ast.walk(tree(path)) if isinstance(x, ast.Call))


def test_every_word_said_is_in_the_catalogue():
    for path, node in calls():
        called = getattr(node, "func", None)
        name = getattr(called, "attr", getattr(called, "id", ""))
        if name in ("say", "phrase", "word") and node.args:
            message = node.args[0]
            if isinstance(message, ast.Constant):
                text = message.value
                of_walk = "walk" in path.parts[-3:] and isinstance(called, ast.Name)
                assert (texts.message(text) if of_walk else text) in FRENCH.messages, path
            else:
                in_walk = "walk" in path.parts[-3:]
                assert in_walk or not isinstance(message, ast.JoinedStr), path


def test_every_entry_is_used():
    sources = strings("walk/*.py", "walk/*/*.py", "record/record.py") | {*texts.LISTS}
    sources |= {x for pair in (*vocabulary.names(), *labelled().values()) for x in pair}
    sources |= strings(
        *("views/*.py", "views/*/*.py", "schema/potential_kinds.py", "motion/emitted_code.py"),
        "lecture/*.py",
    )
    sources |= {p.remark for p in PAPER if p.remark}
    used = sources | strings("pipeline.py") | strings("code/options.py") | titles_and_meanings()
    used |= {meaning for meaning, _ in meanings()}  # of which some are made of parts
    used |= {x["en"] for x in texts.entries()}  # tests/prose
    used = {*map(texts.unmarked, used)}
    assert [x["en"] for x in ENTRIES if x["en"] not in used] == []


TYPOGRAPHY = {
    "no straight quote": r"['\"`“”]",
    "no ordinary space before": rf"[^{THIN}][;!?]|[^{WIDE}]:| »|« ",
    "quotation marks have their space": rf"«[^{WIDE}]|[^{WIDE}]»",
    "no space twice": rf"[\s{THIN}{WIDE}]{{2}}",
    "no space before": r"\s[,.)]|\( ",
    "accents on capitals": r"\b(?:A (?!r_i|=)|E[tc]at|Equa|Elem|Eqa|Energ|Ecri|Elle-meme)",
    "ligatures": r"\b[Oo]eu|[cn]oeu",
}


def in_words(french):
    """Without formulas, which stand between marks, and without places."""
    return PLACE.sub("…", re.sub(f"{FORMULA}[^{FORMULA}]*{FORMULA}", "…", french))


@pytest.mark.parametrize("rule", TYPOGRAPHY)
def test_french_typography(rule):
    said = FRENCH.marked.messages.values()
    wrong = [x for x in said if re.search(TYPOGRAPHY[rule], in_words(x))]
    assert wrong == []


def test_the_two_sides_begin_and_end_alike():
    for english_text, french in FRENCH.messages.items():
        ends = [x[-1] if x[-1] in ".:;?!" else "" for x in (english_text, french)]
        assert ends[0] == ends[1], french
        if ends[0] == ".":
            first = [x[0] for x in (english_text, french)]
            assert first[0].isupper() == first[1].isupper(), french


def test_what_the_user_said_stays():
    d = walk(Problem("kernel", "SO(3)", GIVEN, title="{x} Ma toupie"))
    assert text(d, language=FRENCH).startswith("{x} Ma toupie — SO(3)\n")
    d = walk(Problem("kernel", "SO(3)", GIVEN))
    assert text(d, language=FRENCH).startswith("kernel — SO(3)\n")


@pytest.mark.parametrize("name", ready_made())
def test_no_english_is_left(name):
    """Nor in Markdown: the little words of English are nowhere."""
    for view in (text, markdown):
        shown = view(walks.record(name), language=FRENCH)
        found = re.findall(r"\b(?:the|of|with|is|are|for|from|and)\b", shown)
        assert found == [], view


@pytest.mark.parametrize("name", ready_made())
def test_records_read_back_say_the_same(name):
    """As they are equal, of any record, by tests/record/test_every_record.py."""
    d = walks.record(name)
    assert text(from_json(to_json(d)), language=FRENCH) == text(d, language=FRENCH)


def test_a_step_alone_in_french():
    d = walks.record("so3")
    assert "D’après so3.momenta, so3.coadjoint." in step_text(d["kernel"], language=FRENCH)
    assert "(d’après `so3.momenta`, `so3.coadjoint`)" in step_markdown(
        d["kernel"], d.symbols, language=FRENCH
    )
