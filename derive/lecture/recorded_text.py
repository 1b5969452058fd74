"""Entries of a chapter that are made of records: sentences in each language, equations of steps;
what symmetries keep, told of each, and why a search on a reader's problem was refused.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import groupby

from ..language.show import SUBSCRIPTS, in_sentence, show
from ..language.tree import Tree, names
from ..record.prose import message
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Sentence
from ..views.language import LANGUAGES, Language, labelled, language, told
from ..views.layout import Reading
from ..views.printing.sentences import FORMULA, QUOTED
from .lecture_text import Block, Entry, Formula, Tie, Words
from .named_sums import NamedSums

SPOKEN: tuple[Language, ...] = tuple(map(language, LANGUAGES))


def words(text: str) -> Words:
    """A sentence of a record with marks, whose formulas are as true as it; with them parameters in
    ‘quotes’."""
    parts = text.split(FORMULA)
    parts[::2] = (QUOTED.sub(rf"{FORMULA}\g<0>{FORMULA}", x) for x in parts[::2])
    found = enumerate(FORMULA.join(parts).split(FORMULA))
    return tuple(Formula(x, condition=True) if k % 2 else x for k, x in found if x)


def in_each(*texts: Words, labels: Sequence[str] = ()) -> Entry:
    """An entry of a text in each language."""
    return Entry(texts, (Tie(tuple(labels)),) if labels else (), display=False, line=0)


def sentence(said: Callable[[Language], str], labels: Sequence[str] = ()) -> Entry:
    """A sentence in each language, by what it is in one."""
    return in_each(*(words(said(x.marked)) for x in SPOKEN), labels=labels)


def alone(t: Tree) -> Entry:
    """The display of an expression of a step."""
    return Entry(((Formula(in_sentence(t), condition=True),),) * len(LANGUAGES), (), True, 0)


def display(
    equations: Sequence[Equation], labels: Sequence[str] = (), *, condition: bool = False
) -> Entry:
    """Equations of steps, one below the other; ``condition``: they are not tried."""
    text = ",  ".join(f"{show(e.lhs)} = {show(e.rhs)}" for e in equations)
    formula: Words = (Formula(text, condition, tuple(equations)),)
    ties = (Tie(tuple(labels)),) if labels else ()
    return Entry((formula,) * len(LANGUAGES), ties, display=True, line=0)


def as_read(block: Block, reading: Reading, sums: NamedSums) -> Block:
    """A block of a chapter as it is read, with letters for sums where it would be too wide."""

    def part(x: str | Formula) -> str | Formula:
        if not isinstance(x, Formula):
            return x
        shown = sums.equations([*map(reading.equation, x.recorded)])
        return replace(x, text=reading.text(x.text), shown=shown)

    entries = (replace(x, texts=tuple(tuple(map(part, y)) for y in x.texts)) for x in block.entries)
    return replace(block, entries=tuple(entries))


NOETHER, ENERGY, UP_TO = (told(f"lecture:{x}") for x in ("noether", "energy", "up_to"))
ONE, SEVERAL = told("lecture:constant"), told("lecture:constants")
AXIS = {2: "{kind} about {axis}", 1: "{kind} along {axis}"}
"""How many entries of the matrix of a field are not 0 → the field with its axis."""


def kept_by(step: Step) -> Tree:
    """What a step of a symmetry proves to be constant; 0 of any other step."""
    if ".conserved_" not in step.label or not any("d/dt" in names(e.lhs) for e in step.equations):
        return 0
    return next((e.rhs for e in step.equations if "ϖ" in names(e.lhs) and e.rhs != 0), 0)


def conserved(d: Derivation, steps: Sequence[Step]) -> Iterator[Entry]:
    """What symmetries keep, those of one kind along or about several axes in one sentence; ``d``:
    the record of the walk."""
    if steps:
        yield sentence(lambda x: x.word(NOETHER))
    for (_, exact, energy), alike in groupby(steps, _alike):
        run = [*alike]
        said = (ENERGY if energy else SEVERAL if run[1:] else ONE) if exact else UP_TO
        yield sentence(partial(_kept_under, said, d, run), [x.label for x in run])
        yield from () if energy else (alone(kept_by(x)) for x in run)


def _alike(step: Step) -> tuple[Sentence | str, bool, bool]:
    """By what the sentences of symmetries differ, but for an axis."""
    return (
        symmetry_kind(step),
        step.prose[0].message == message("symmetries.exact"),
        kept_by(step) == "h̃",
    )


def _kept_under(said: str, d: Derivation, steps: Sequence[Step], spoken: Language) -> str:
    return spoken.word(said, kind=kind_of(d, steps, spoken))


def symmetry_kind(step: Step) -> Sentence | str:
    """What the symmetry of a step is, but for its axis."""
    return next(y for x in step.prose for place, y in x.places if place == "kind")


def kind_of(d: Derivation, steps: Sequence[Step], spoken: Language) -> str:
    """What the symmetry of steps is, in a language, with its axes in space."""
    kind = symmetry_kind(steps[0])
    told = kind if isinstance(kind, str) else spoken.sentence(kind)
    axes = [x for x in (_axis(d, s) for s in steps) if x]
    if len(axes) < len(steps):
        return told
    letters = ", ".join(axis_letter(k) for _, k in axes)
    return spoken.word(AXIS[axes[0][0]], kind=told, axis=spoken.formula(letters))


def _axis(d: Derivation, step: Step) -> tuple[int, int] | None:
    """How many entries the matrix of a field has, in one block of a product, and its axis."""
    field = next(e.rhs for e in step.equations if e.lhs == "δA")
    matrix = [x for x in field[1:] if x[0] == "matrix"] if isinstance(field, tuple) else []
    if len(matrix) != 1 or not _in_space(d):
        return None
    places = [*_places(matrix[0])]
    if SPACES in str(d.problem["group"]):  # the blocks of a product turn alike, or it has no axis
        blocks = [{(i % 3, j % 3) for i, j in places if i // 3 == j // 3 == k} for k in (0, 1)]
        places = sorted(blocks[0]) if blocks[0] == blocks[1] else []
    if len(places) == 1 and places[0][1] == 3:
        return 1, places[0][0] + 1
    if len(places) == 2 and places[0] == places[1][::-1] and max(places[0]) < 3:
        return 2, 4 - sum(places[0])
    return None


def axis_letter(k: int) -> str:
    """The letter of an axis, by its number from 1."""
    return "e" + str(k).translate(SUBSCRIPTS)


def _places(matrix: Tree) -> Iterator[tuple[int, int]]:
    """Where the entries of a matrix are not 0."""
    assert isinstance(matrix, tuple)
    for i, row in enumerate(matrix[1:]):
        yield from ((i, j) for j, x in enumerate(row[1:]) if x != 0)


def _in_space(d: Derivation) -> bool:
    """Does the group of a record move space, by matrices on r or on (r, 1)?"""
    basis = d.problem.get("basis")
    if not isinstance(basis, list) or not basis:
        return False
    size = len(basis[0])
    if SPACES in str(d.problem["group"]):
        return str(d.problem["group"]) == f"SO(3){SPACES}SO(3)"
    return size == (4 if all(not any(map(_number, E[-1])) for E in basis) else 3)


def _number(x: object) -> bool:
    return str(x) not in ("0", "0.0")


UNSHOWN = "No motion is shown: {reason}."
REASONS = [told(x) for x in labelled() if x.startswith("refused.")]
"""Why a search is refused, or a motion, with places, where the text says it in its language."""
OVER = told("refused.search_takes")
SPACES = " x "
"""Between the factors of a product of groups."""
FUNCTIONS = {"sqrt": "the square root"}
"""What functions are called in a sentence."""


def reason(told: str, words: Language) -> str:
    """Why a search was refused, in a language, where ``REASONS`` has it."""
    for one in REASONS:
        pattern = re.sub(r"\\{(\w+)\\}", r"(?P<\1>.+)", re.escape(one))
        if match := re.fullmatch(pattern, told):
            return words.word(
                one, **{x: words.word(FUNCTIONS.get(y, y)) for x, y in match.groupdict().items()}
            )
    return told


def without_advice(told: str) -> str:
    """A reason without what is to be typed instead, behind a semicolon: that is for the command."""
    return re.split(r"\s*; ", told)[0]
