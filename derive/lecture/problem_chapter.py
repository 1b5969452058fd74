"""A chapter on a problem of the reader's own, written from its records: what moves, its equations
of motion, what the motion keeps, its reduction, its steady motions, a motion."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby

from ..language.show import show
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Sentence
from ..views.answer import definitions, equations_of_motion, steps_of_answer
from ..views.language import LANGUAGES, Language, language
from ..views.outline import system, title
from ..views.printing.sentences import prose
from .lecture_text import Block, Chapter, Entry, Formula, Given, Tie, Words, words_of
from .ran_figure import DESCRIBED, Ran, label_of

SEARCHES = {
    "symmetries": "What the motion keeps.",
    "integrals": "First integrals.",
    "reduction": "Reduction.",
    "equilibria": "Steady motions.",
    "families": "Steady motions, in letters.",
    "trim": "At rest, by its inputs.",
}
"""What is told of a problem after its equations, under which heading."""
TOLD = {
    "symmetries": {"conserved_": True},
    "integrals": {"casimirs": True, "first_integrals": True},
    "reduction": {"momentum_": False, "locked": True, "effective": True, "quadrature": True},
    "equilibria": {"equilibrium_": False, "energy_casimir_": False},
    "families": {"equilibrium_": False, "energy_casimir_": False},
    "trim": {"trim": False},
}
"""Search → how the labels of the steps begin that a text for people tells, and whether with their
equations; the record has all."""

NONE = dict.fromkeys(
    ("equilibria", "families"), "None was found among the points with one momentum that were tried."
)
"""Search → what is said where it found nothing and there may be more."""


@dataclass(frozen=True)
class Found:
    """What a search made of a problem: the steps that tell it, or, where it was refused, why."""

    steps: tuple[Step, ...] = ()
    refused: str = ""


def chapter_of(
    d: Derivation,
    found: Mapping[str, Found],
    records: tuple[str, ...],
    place: Sentence | None = None,
    ran: Ran | Sentence | None = None,
) -> Chapter:
    """The chapter of a problem, by its record and what searches found of it, those that were made;
    ``records``: the names of those that its ties speak of; ``place``: whether its body has that of
    the racket, or why not; ``ran``: its motion, or why there is none.  Searches that were refused
    for one reason stand together."""
    blocks = [*_motion(d)]
    if place:
        blocks.append(Block("text", "", "", (_sentence(lambda x: x.sentence(place)),), 0))
    asked = (x for x in SEARCHES if x in found)
    for _, alike in groupby(asked, lambda x: found[x].refused or x):
        searches = (*alike,)
        blocks += [
            _section(*(SEARCHES[x] for x in searches)),
            _told(d.name, searches[0], found[searches[0]]),
        ]
    if ran:
        blocks += [_section("A motion."), *_pictured(d.name, ran)]
    titles = tuple(Given(title(d, x)) for x in _languages())
    figures = {label_of(d.name): ran.picture} if isinstance(ran, Ran) else {}
    whole = f"the chapter of {d.name}"
    return Chapter(d.name, titles, records, tuple(blocks), whole, figures)


def _languages() -> tuple[Language, ...]:
    return tuple(map(language, LANGUAGES))


def _sentence(said: Callable[[Language], str], labels: Sequence[str] = ()) -> Entry:
    """A sentence in each language, whose formulas are as true as the sentence of its step."""
    texts = tuple(_words(said(x)) for x in _languages())
    return Entry(texts, (Tie(tuple(labels)),) if labels else (), display=False, line=0)


def _words(text: str) -> Words:
    return tuple(
        Formula(x.text, condition=True) if isinstance(x, Formula) else x
        for x in words_of(prose(text, escape=str, formula="`{}`".format))
    )


def _display(equations: Sequence[Equation], labels: Sequence[str]) -> Entry:
    """Equations of steps, one below the other."""
    text = ",  ".join(f"{show(e.lhs)} = {show(e.rhs)}" for e in equations)
    formula: Words = (Formula(text, recorded=tuple(equations)),)
    return Entry((formula,) * len(LANGUAGES), (Tie(tuple(labels)),), display=True, line=0)


def _section(*headings: str) -> Block:
    heading = _sentence(lambda x: " ".join(map(x.word, headings)))
    return Block("section", "", "", (heading,), 0)


def _motion(d: Derivation) -> Iterator[Block]:
    """What moves, and by which equations; each letter in them that the problem defines."""
    home = {e: step.label for step in d.steps for e in step.equations}
    entries = [_sentence(lambda x: system(d, x))] if system(d, language("en")) else []
    motion = equations_of_motion(d)
    entries.append(_sentence(lambda x: x.word("Its equations of motion are")))
    entries.append(_display(motion, [s.label for s in steps_of_answer(d)]))
    if defined := definitions(d, motion):
        entries.append(_sentence(lambda x: x.word("where")))
        entries.append(_display(defined, [*dict.fromkeys(home[e] for e in defined)]))
    yield Block("text", "", "", tuple(entries), 0)


def _told(problem: str, search: str, found: Found) -> Block:
    """The steps that a search tells, or one sentence: why it was refused, or that it found none."""
    if found.refused:
        reason = found.refused.removeprefix(f"{problem}: ")
        refused = _sentence(lambda x: x.word("This was not found: {reason}.", reason=reason))
        return Block("text", "", "", (refused,), 0)
    entries: list[Entry] = []
    for step in found.steps:
        name = step.label.removeprefix(f"{problem}.")
        for begin, with_equations in TOLD[search].items():
            if name.startswith(begin):
                labels = () if with_equations else (step.label,)
                entries.append(_sentence(partial(_prose, step), labels))
                if with_equations:
                    entries.append(_display(step.equations, (step.label,)))
    if not entries:
        entries = [_sentence(lambda x: x.word(NONE.get(search, "There is none.")))]
    return Block("text", "", "", tuple(entries), 0)


def _pictured(problem: str, ran: Ran | Sentence) -> Iterator[Block]:
    """The figure of a motion with what is said of it, or one sentence: why there is none."""
    if isinstance(ran, Sentence):
        yield Block("text", "", "", (_sentence(lambda x: x.sentence(ran)),), 0)
        return
    label = label_of(problem)
    texts = tuple(
        (*_words(ran.told(x)), f" ({x.word('Fig.').lower()} @{label})") for x in _languages()
    )
    yield Block("text", "", "", (Entry(texts, (), display=False, line=0),), 0)
    described = _sentence(lambda x: x.word(DESCRIBED))
    yield Block("figure", label, "", (described, _sentence(ran.caption)), 0)


def _prose(step: Step, words: Language) -> str:
    return words.of(step.prose)
