"""A chapter on a problem of the reader's own, written from its records: what moves, its equations
of motion, what the motion keeps, its reduction, its steady motions, a motion."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby

from ..language.show import show
from ..language.tree import names
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Sentence
from ..views.answer import definitions, equations_of_motion, steps_of_answer
from ..views.language import LANGUAGES, Language, language
from ..views.outline import system, title
from ..views.printing.sentences import prose
from ..views.text import formula as aligned
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
    ("equilibria", "families"),
    "Only points with one momentum were tried, and none was found; there may be others.",
)
"""Search → what is said where it found nothing and there may be more."""


REASONS = (
    "the Lagrangian couples {velocities} velocities by terms with {letters} letters in all: the "
    "inverse of its metric is too long; give numbers, or --at-defaults",
    "there is no symmetry of L but of the time, so that nothing is reduced",
    "its symmetries move the time as well, so that nothing is reduced",
    "its symmetries change L by dF/dt, or depend on the time, so that nothing is reduced",
    "what acts depends on the time: nothing is steady",
)
"""Why a search is refused, with places, where the text says it in its language."""
LONGEST = 6
"""The most lines of an equation that is shown."""


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
        refused = _sentence(
            lambda x: x.word("This was not found: {reason}.", reason=_reason(reason, x))
        )
        return Block("text", "", "", (refused,), 0)
    entries: list[Entry] = []
    for step in found.steps:
        name = step.label.removeprefix(f"{problem}.")
        for begin, with_equations in TOLD[search].items():
            if name.startswith(begin):
                labels = () if with_equations else (step.label,)
                entries.append(_sentence(partial(_prose, step), labels))
                if with_equations:
                    entries += _displays(step)
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


def _displays(step: Step) -> Iterator[Entry]:
    """What a step says, of a conservation what is kept alone; of what is too long, where it is."""
    kept = [e for e in step.equations if e.rhs != 0 and {"ϖ", "dϖ"} & {*names(e.lhs)}]
    told = kept if kept and step.label.rpartition(".")[2].startswith("conserved_") else None
    for long, run in groupby(told or step.equations, lambda e: _rows(e) > LONGEST):
        if not long:
            yield _display((*run,), (step.label,))
        else:
            yield _sentence(partial(_left_out, [*run]), (step.label,))


def _rows(e: Equation) -> int:
    """Over how many lines an equation is set."""
    return aligned([e], ()).count("\\\\\n") + 1


def _left_out(equations: Sequence[Equation], words: Language) -> str:
    what, rows = ", ".join(show(e.lhs) for e in equations), sum(map(_rows, equations))
    message = "The step beside this has {what} in full; that takes {rows} lines."
    return words.word(message, what=what, rows=str(rows))


def _reason(told: str, words: Language) -> str:
    """Why a search was refused, in a language, where ``REASONS`` has it."""
    for reason in REASONS:
        pattern = re.sub(r"\\{(\w+)\\}", r"(?P<\1>.+)", re.escape(reason))
        if match := re.fullmatch(pattern, told):
            return words.word(reason, **match.groupdict())
    return told


def _prose(step: Step, words: Language) -> str:
    return words.of(step.prose)
