"""What is printed is read back, by readers that know no printer, and is what the record says."""

import random

import pytest

from derive.language.show import show
from derive.printing.macros import styled
from derive.printing.mathml import mathml as printed_mathml
from derive.printing.tex import latex_tree
from tests.readers import latex, mathml, text
from tests.readers.formula import Letters, UnreadableError, canonical
from tests.readers.told import PAGES, faults
from tests.support import random_trees
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
