"""The prose of the steps: every sentence stands under the label of the step that says it."""

import ast
import re
from pathlib import Path

import pytest

from derive import prose
from derive.record.sentence import Sentence
from tests.support.lagrangians import every_record
from tests.support.walks import FLUIDS, NAMES, OTHERS, record

ROOT = Path(prose.__file__).parents[1]
ROOMS = [ROOT / room for room in ("walk", "symmetries", "reduction", "integrals", "equilibria")]
SIGNED = "_signed"
ALSO = {"coadjoint": {"kernel"}, "energy_casimir": {"equilibrium"}}
"""In vectors the kernel is told where the coefficients vanish."""


def keys():
    return [f"{label}.{name}" for label, named in prose.STEPS.items() for name in named]


def named():
    """What stands in these rooms where a key may: a name, or one with a part that is chosen
    there."""
    for path in (x for room in ROOMS for x in room.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node.value
            if isinstance(node, ast.JoinedStr) and isinstance(node.values[0], ast.Constant):
                yield node.values[0].value + "…"


def test_every_sentence_is_said_somewhere_in_the_walk():
    found = {*named()}
    open_keys = tuple(x[:-1] for x in found if x.endswith("…") and "." in x)
    unused = [k for k in keys() if k.removesuffix(SIGNED) not in found]
    assert [k for k in unused if not k.startswith(open_keys)] == []


def messages(sentence):
    yield sentence.message
    for _, x in sentence.places:
        if isinstance(x, Sentence):
            yield from messages(x)


@pytest.mark.parametrize("name", dict.fromkeys((*NAMES, *OTHERS, *FLUIDS)))
def test_a_step_says_what_stands_under_its_label(name):
    says_what_stands_under_its_label(record(name))


def test_a_step_of_integrals_says_what_stands_under_its_label():
    for found in every_record():
        says_what_stands_under_its_label(found)


def says_what_stands_under_its_label(found):
    own = {}
    for label, named in prose.STEPS.items():
        for english, _ in named.values():
            own.setdefault(english, set()).add(label)
    for step in found.steps:
        said = [m for sentence in step.prose for m in messages(sentence) if m in own]
        short = re.sub(
            r"^(equilibrium|energy_casimir|enclosure|condition)_\d+$",
            r"\1",
            step.label.split(".", 1)[1],
        )
        under = {short, *ALSO.get(short, ())}
        assert [m for m in said if own[m].isdisjoint(under)] == [], step.label


def test_no_label_is_told_in_two_files():
    parts = (prose.GENERAL, prose.ROTATIONS, prose.MATRICES, prose.MATERIAL)
    parts += (prose.FIRST_INTEGRALS,)
    labels = [label for part in parts for label in part]
    assert sorted({*labels}) == sorted(labels)
