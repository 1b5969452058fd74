"""What is printed is read back, by readers that know no printer, and is what the record says."""

import random

import pytest

from derive.language.show import show, unclear
from derive.printing.letters import names_of, parameter
from derive.printing.macros import styled
from derive.printing.mathml import mathml as printed_mathml
from derive.printing.tex import latex_tree
from tests.readers import latex, mathml, text
from tests.readers.formula import Letters, UnreadableError, canonical
from tests.readers.told import PAGES, faults
from tests.support import random_trees
from tests.support.renamed import renamed
from tests.support.walks import NAMES, OTHERS, record, repeated

FORMULAS = {
    "text": lambda t, known: text.formula(show(t), known),
    "latex": lambda t, known: latex.formula(latex_tree(t), known),
    "macros": lambda t, known: latex.formula(styled(latex_tree(t)), known),
    "mathml": lambda t, known: mathml.formula(printed_mathml(latex_tree(t)), known),
}
KNOWN = Letters(random_trees.OWN | {"δ"}, {*random_trees.PARAMETERS})
SEEDS = 4
TREES = 500


@pytest.mark.parametrize("name", repeated(dict.fromkeys((*NAMES, *OTHERS))))
def test_every_page_says_what_its_record_says(name):
    assert [x for kind in PAGES for x in faults(record(name), kind)] == []


def misread(t, known=KNOWN):
    """The formats whose reader does not find the tree again."""
    for kind, read in FORMULAS.items():
        plain = kind == "text"
        try:
            found = canonical(read(t, known), known, plain)
        except (UnreadableError, ValueError) as error:
            found = error
        if found != canonical(t, known, plain):
            yield kind, t, found


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
    names = {"a", "b", "ab", "ac", "x_1", "J_12", "J", "m", "m_rod", "d_11", "j", "Tr", "mu"}
    marked = unclear(letters, names, symbolic=True)
    assert marked == {"ab", "ac", "J", "d_11", "j", "Tr"}
    assert unclear(letters, {"ab", "a", "k"}, symbolic=False) == set()
    names = names_of((), ("x1", "x_1", "y2"))
    assert parameter("x1", names) == r"\mathsf{x1}"
    assert parameter("x_1", names) == parameter("x1") == r"\mathsf{x}_{\mathsf{1}}"
    assert parameter("y2", names) == r"\mathsf{y}_{\mathsf{2}}"
