"""The prose of the steps: every sentence stands under the label of the step that says it."""

import ast
import re
from pathlib import Path

import pytest

import derive
from derive.record import prose
from derive.record.sentence import Sentence
from tests.support.lagrangians import every_record
from tests.support.walks import FLUIDS, NAMES, OTHERS, record

ROOT = Path(derive.__file__).parent
ROOMS = [ROOT / room for room in ("walk", "search")]
SIGNED = "_signed"
ALSO = {
    "coadjoint": {"kernel"},
    "energy_casimir": {"equilibrium"},
    "equilibrium": {"position"},
}
"""In vectors the kernel is told where the coefficients vanish."""


def keys():
    return [*prose.sentences()]


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
    for key, (english, _) in prose.sentences().items():
        own.setdefault(prose.unmarked(english), set()).add(key.split(".")[0])
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
    files = ("general", "rotations", "matrices", "material", "first_integrals")
    parts = [prose.read([ROOT / "record" / "prose" / f"{x}.txt"]) for x in files]
    labels = [label for part in parts for label in {x.split(".")[0] for x in part}]
    assert sorted({*labels}) == sorted(labels)


def test_a_sentence_is_called_by_its_step():
    assert [x for x in keys() if not re.fullmatch(r"[a-z0-9_]+\.[a-z0-9_]+", x)] == []


MESSAGES = "# two\n\na.b\n  One.\n  Un.\n\na.c\n  Two: # 2.\n  Deux : # 2.\n"


def read(folder, *texts):
    """The messages of files 0.txt, 1.txt, … in a folder."""
    files = [folder / f"{k}.txt" for k in range(len(texts))]
    for file, text in zip(files, texts, strict=True):
        file.write_text(text, encoding="utf-8")
    return prose.read(files)


def test_messages_of_a_file(tmp_path):
    assert read(tmp_path, MESSAGES) == {"a.b": ("One.", "Un."), "a.c": ("Two: # 2.", "Deux : # 2.")}


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("a.c", "a.b", "line 7: 'a.b' stands twice"),
        ("  Un.\n", "", "line 3: 'a.b' has 1, not an indented line in each of en, fr"),
        ("  Un.\n", "  Un.\n  Uno.\n", "line 3: 'a.b' has 3, not"),
        ("  Un.\n", "Un.\n", "line 3: 'a.b' has 1, not"),
        ("  Un.\n", "   Un.\n", "line 5: no label, and no text"),
        ("  Un.\n", "  Un. \n", "line 5: no label, and no text"),
        ("  Un.\n", "  \n", "line 5: no label, and no text"),
        ("\n\na.b", "\n\n  a.b", "line 3: no label, and no text"),
        ("\n\na.b", "\n\na.b ", "line 3: no label, and no text"),
    ],
)
def test_a_line_that_is_no_message_is_refused(old, new, why, tmp_path):
    with pytest.raises(ValueError, match=re.escape(f"0.txt, {why}")):
        read(tmp_path, MESSAGES.replace(old, new, 1))


def test_no_label_stands_in_two_files(tmp_path):
    with pytest.raises(ValueError, match=r"1.txt, line 1: 'a\.b' stands twice; rename one"):
        read(tmp_path, MESSAGES, "a.b\n  One.\n  Un.\n")
