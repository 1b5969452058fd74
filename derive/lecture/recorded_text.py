"""Entries of a chapter that are made of records: sentences in each language, equations of steps;
what symmetries keep, told of each, and why a search on a reader's problem was refused.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby

from ..language.show import SUBSCRIPTS, in_sentence, show
from ..language.tree import Tree, names
from ..record.prose import message
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Claim, Prose, Sentence, phrase
from ..views.language import LANGUAGES, Language, labelled, language, told
from ..views.layout import Reading
from ..views.printing.sentences import FORMULA, QUOTED
from .common_factors import positive, tidied
from .displays import NamedSums
from .lecture_text import Block, Entry, Formula, Tie, Words

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


def sentence(said: Callable[[Language], str] | Prose, labels: Sequence[str] = ()) -> Entry:
    """Sentences in each language, by what they are in one, or as a record has them."""
    told = (said(x.marked) if callable(said) else x.marked.of(said) for x in SPOKEN)
    return in_each(*map(words, told), labels=labels)


def lecture(label: str, **places: Sentence | str) -> Sentence:
    """A sentence of the lecture, by its label, with formulas and sentences in its places."""
    return phrase(told(f"lecture:{label}"), **places)


def stated(label: str, labels: Sequence[str] = (), /, **places: Sentence | str) -> Entry:
    """The same as an entry."""
    return sentence((lecture(label, **places),), labels)


def alone(d: Derivation, t: Tree) -> Entry:
    """The display of an expression of a step."""
    text = in_sentence(as_written(d, t))
    return Entry(((Formula(text, condition=True),),) * len(LANGUAGES), (), True, 0)


def as_written(d: Derivation, t: Tree) -> Tree:
    """An expression as people write it."""
    return tidied(Equation("", t), [*d.problem["parameters"]]).rhs


def claimed(d: Derivation, step: Step) -> Step:
    """A step whose inequalities have sides as people write them; of those that make the energy
    positive, those that parameters other than 0, whatever their signs, do not fulfil anyway."""
    signs = {x: math.nan if y["default"] else 0.0 for x, y in d.problem["parameters"].items()}
    said = []
    for x in step.prose:
        claim = next((c for c in step.claims if message(c.kind) == x.message), Claim(""))
        told = {k: y for k, y in claim.values if k in ("cases", "conditions", "positive")}
        asked = [y for t in (told.get("positive"),) if isinstance(t, tuple) for y in t[1:]]
        if open_ := [y for y in asked if y[2] != 0 or not positive(y[1], signs)]:
            told["positive"] = ("matrix", *open_)
        values = tuple((k, as_written(d, y)) for k, y in told.items())
        places = dict(x.places) | replace(claim, values=values).texts
        said.append(replace(x, places=tuple(places.items())))
    return replace(step, prose=tuple(said))


def display(
    equations: Sequence[Equation], labels: Sequence[str] = (), *, condition: bool = False
) -> Entry:
    """Equations of steps, one below the other; ``condition``: they are not tried."""
    text = ",  ".join(f"{show(e.lhs)} = {show(e.rhs)}" for e in equations)
    formula: Words = (Formula(text, condition, tuple(equations)),)
    ties = (Tie(tuple(labels)),) if labels else ()
    return Entry((formula,) * len(LANGUAGES), ties, display=True, line=0)


UNDRIVEN = phrase(told("lecture.poisson.undriven"))


def as_read(block: Block, reading: Reading, sums: NamedSums) -> Block:
    """A block of a chapter as it is read, with letters for sums where it would be too wide."""

    def part(x: str | Formula) -> str | Formula:
        if not isinstance(x, Formula):
            return x
        shown = sums.equations([*map(reading.equation, x.recorded)])
        return replace(x, text=reading.text(x.text), shown=shown)

    entries = (replace(x, texts=tuple(tuple(map(part, y)) for y in x.texts)) for x in block.entries)
    return replace(block, entries=tuple(entries))


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
        undriven = [UNDRIVEN] if d.problem["inputs"] else []
        yield sentence((lecture("noether"), *undriven))
    for (_, exact, energy), alike in groupby(steps, _alike):
        run = [*alike]
        said = "energy" if energy else "constants" if run[1:] else "constant"
        labels = [x.label for x in run]
        yield stated(said if exact else "up_to", labels, kind=kind_of(d, run))
        yield from () if energy else (alone(d, kept_by(x)) for x in run)


def _alike(step: Step) -> tuple[Sentence, bool, bool]:
    """By what the sentences of symmetries differ, but for an axis."""
    return (
        symmetry_kind(step),
        step.prose[0].message == message("symmetries.exact"),
        kept_by(step) == "h̃",
    )


def symmetry_kind(step: Step) -> Sentence:
    """What the symmetry of a step is, but for its axis."""
    found = (y for x in step.prose for place, y in x.places if place == "kind")
    return next(x for x in found if isinstance(x, Sentence))


def kind_of(d: Derivation, steps: Sequence[Step]) -> Sentence:
    """What the symmetry of steps is, with its axes in space."""
    kind = symmetry_kind(steps[0])
    axes = [x for x in (_axis(d, s) for s in steps) if x]
    if len(axes) < len(steps):
        return kind
    letters = ", ".join(axis_letter(k) for _, k in axes)
    axis = phrase("each of {axes}", axes=letters) if axes[1:] else letters
    return phrase(AXIS[axes[0][0]], kind=kind, axis=axis)


def _axis(d: Derivation, step: Step) -> tuple[int, int] | None:
    """How many entries the matrix of a field has, in one block of a product, and its axis."""
    field = next(e.rhs for e in step.equations if e.lhs == "δA")
    matrix = [x for x in field[1:] if x[0] == "matrix"] if isinstance(field, tuple) else []
    if len(matrix) != 1 or not _in_space(d):
        return None
    rows = enumerate(matrix[0][1:])
    places = [(i, j) for i, row in rows for j, x in enumerate(row[1:]) if x != 0]
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


def _in_space(d: Derivation) -> bool:
    """Does the group of a record move space, by matrices on r or on (r, 1)?"""
    basis = d.problem.get("basis")
    if not isinstance(basis, list) or not basis:
        return False
    if SPACES in str(d.problem["group"]):
        return str(d.problem["group"]) == f"SO(3){SPACES}SO(3)"
    affine = all(str(x) in ("0", "0.0") for E in basis for x in E[-1])
    return len(basis[0]) == (4 if affine else 3)


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
            places = {x: words.word(FUNCTIONS.get(y, y)) for x, y in match.groupdict().items()}
            return words.word(one, **places)
    return told


def without_advice(told: str) -> str:
    """A reason without what is to be typed instead, behind a semicolon: that is for the command."""
    return re.split(r"\s*; ", told)[0]
