"""What is printed is read back, by readers that know no printer, and is what the record says."""

import random

import pytest

import derive
from derive.language.show import unclear
from derive.problem.toml import problem_of
from derive.views.printing.letters import names_of, parameter
from derive.views.rendering import FORMATS
from tests.readers.read import PAGES, READERS, faults, misread
from tests.support import printing_mutations, random_trees
from tests.support.renamed import renamed
from tests.support.walks import ESTIMATES, FLUIDS, NAMES, OTHERS, record, repeated

SEEDS = 4
TREES = 500


def test_every_format_has_a_reader():
    assert {*FORMATS} == {*READERS, "json"}  # which the record itself reads
    assert {*READERS} <= {*PAGES}


@pytest.mark.parametrize("name", repeated(dict.fromkeys((*NAMES, *FLUIDS, *OTHERS, *ESTIMATES))))
def test_every_page_says_what_its_record_says(name):
    assert [x for kind in PAGES for x in faults(record(name), kind)] == []


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
