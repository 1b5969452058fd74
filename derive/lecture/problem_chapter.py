"""A chapter on a problem of the reader's own, written from its records: what moves, its equations
of motion, what the motion keeps, its reduction, its steady motions, a motion."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby

from ..language.show import SUPERSCRIPTS, show
from ..language.tree import names
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Prose, Sentence
from ..views.answer import definitions, equations_of_motion, steps_of_answer
from ..views.figure.scene import scene
from ..views.language import Language, language
from ..views.outline import declared, system, title
from ..views.text import formula as aligned
from .figures import Figure
from .lecture_text import Block, Chapter, Entry, Formula, Given, Words
from .problem_exercises import exercises
from .ran_figure import DESCRIBED, Ran, label_of
from .recorded_text import SPOKEN, display, in_each, sentence, words

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


OVER = "it takes more than {seconds} seconds (--seconds)"
REASONS = (
    OVER,
    "the Lagrangian couples {velocities} velocities by terms with {letters} letters in all: the "
    "inverse of its metric is too long; give numbers, or --at-defaults",
    "there is no symmetry of L but of the time, so that nothing is reduced",
    "its symmetries move the time as well, so that nothing is reduced",
    "its symmetries change L by dF/dt, or depend on the time, so that nothing is reduced",
    "what acts depends on the time: nothing is steady",
    "equilibria are told for numbers, and π is none: of a density that is a mass over a volume, it "
    "cancels",
)
"""Why a search is refused, with places, where the text says it in its language."""
TITLE = "{title}: equations, what is kept, steady motions"
BODY = "The body of the problem, with the axes of its frame."
LISTED = {"en": ", ", "fr": "\u202f; "}
"""What is between two parameters with their numbers."""
LONGEST, SHORT = 6, 2
"""The most lines of an equation that is shown, and of one in an exercise."""


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
    command: str = "",
) -> Chapter:
    """The chapter of a problem, by its record and what searches found of it, those that were made;
    ``records``: the names of those that its ties speak of; ``place``: whether its body has that of
    the racket, or why not; ``ran``: its motion, or why there is none, which ``command`` shows.
    Searches that were refused for one reason stand together."""
    blocks = [*_motion(d), *_body(d), *_parameters(d)]
    if place:
        blocks.append(Block("text", "", "", (sentence(lambda x: x.sentence(place)),), 0))
    asked = (x for x in SEARCHES if x in found)
    for _, alike in groupby(asked, lambda x: found[x].refused or x):
        searches = (*alike,)
        blocks += [
            _section(*(SEARCHES[x] for x in searches)),
            _told(d.name, searches[0], found[searches[0]]),
        ]
    if ran:
        blocks += [_section("A motion."), *_pictured(d.name, ran)]
    home = {e: step.label for step in d.steps for e in step.equations}
    kept = [x for x in found.get("symmetries", Found()).steps if ".conserved_" in x.label]
    blocks += exercises(
        [(e, home[e]) for e in equations_of_motion(d)],
        kept,
        ran if isinstance(ran, Ran) else None,
        command,
        lambda e: _rows(e) <= SHORT,
    )
    titles = tuple(Given(x.word(TITLE, title=title(d, x))) for x in SPOKEN)
    figures: dict[str, Figure] = {}
    if isinstance(ran, Ran):
        figures[label_of(d.name)] = ran.picture
    if drawn := scene(d):
        figures[label_of(d.name, "body")] = lambda _: drawn
    whole = f"the chapter of {d.name}"
    return Chapter(d.name, titles, records, tuple(blocks), whole, figures)


def _section(*headings: str) -> Block:
    heading = sentence(lambda x: " ".join(map(x.word, headings)))
    return Block("section", "", "", (heading,), 0)


def _motion(d: Derivation) -> Iterator[Block]:
    """What moves, and by which equations; each letter in them that the problem defines."""
    home = {e: step.label for step in d.steps for e in step.equations}
    entries = [sentence(lambda x: system(d, x))] if system(d, language("en")) else []
    motion = equations_of_motion(d)
    entries.append(sentence(lambda x: x.word("Its equations of motion are")))
    entries.append(display(motion, [s.label for s in steps_of_answer(d)]))
    if defined := definitions(d, motion):
        entries.append(sentence(lambda x: x.word("where")))
        entries.append(display(defined, [*dict.fromkeys(home[e] for e in defined)]))
    yield Block("text", "", "", tuple(entries), 0)


def _body(d: Derivation) -> Iterator[Block]:
    """The figure of its body, where it has one."""
    if drawn := scene(d):
        described = sentence(lambda x: x.word(BODY))
        caption = sentence(lambda x: x.of(drawn.caption))
        yield Block("figure", label_of(d.name, "body"), "", (described, caption), 0)


def _parameters(d: Derivation) -> Iterator[Block]:
    """The table of its parameters, three cells a row: those of one meaning and unit with their
    numbers, the unit, the meaning."""
    cells: list[Entry] = []
    told = [*zip(*(declared(d, x) for x in SPOKEN), strict=True)]
    for (unit, *_), run in groupby(told, lambda row: (row[0][2], *(x[1] for x in row))):
        rows = [*run]
        valued = (_valued([row[k] for row in rows], x) for k, x in enumerate(SPOKEN))
        meanings = ((Given(x[1]),) for x in rows[0])
        shown = re.sub(r"\^(-?\d+)", lambda x: x[1].translate(SUPERSCRIPTS), unit)
        cells += [in_each(*valued), in_each(*((Given(shown),) for _ in SPOKEN))]
        cells.append(in_each(*meanings))
    if cells:
        yield Block("table", "", "", tuple(cells), 0)


def _valued(rows: Sequence[tuple[str, str, str, str]], spoken: Language) -> Words:
    """Parameters with their numbers, where they have one."""
    found: list[str | Formula] = []
    for name, _, _, default in rows:
        value = f" = {default.replace('-', '−')}" if default else ""
        found += [Formula(f"‘{name}’", condition=True, value=value), LISTED[spoken.name]]
    return tuple(found[:-1])


def _told(problem: str, search: str, found: Found) -> Block:
    """The steps that a search tells, or one sentence: why it was refused, or that it found none."""
    if found.refused:
        reason = found.refused.removeprefix(f"{problem}: ")
        refused = sentence(
            lambda x: x.word("This was not found: {reason}.", reason=_reason(reason, x))
        )
        return Block("text", "", "", (refused,), 0)
    entries: list[Entry] = []
    begins = {x: f"{problem}.{x}" for x in TOLD[search]}
    told = [(s, x) for s in found.steps for x, y in begins.items() if s.label.startswith(y)]
    for (prose, begin), run in groupby(told, lambda x: (x[0].prose, x[1])):
        steps = [step for step, _ in run]
        with_equations = TOLD[search][begin]
        labels = () if with_equations else [x.label for x in steps]
        entries.append(sentence(partial(_prose, prose), labels))
        if with_equations:
            entries += _displays(steps)
    if not entries:
        entries = [sentence(lambda x: x.word(NONE.get(search, "There is none.")))]
    return Block("text", "", "", tuple(entries), 0)


def _pictured(problem: str, ran: Ran | Sentence) -> Iterator[Block]:
    """The figure of a motion with what is said of it, or one sentence: why there is none."""
    if isinstance(ran, Sentence):
        yield Block("text", "", "", (sentence(lambda x: x.sentence(ran)),), 0)
        return
    label = label_of(problem)
    texts = (
        (*words(ran.told(x).removesuffix(".")), f" ({x.word('Fig.').lower()} @{label}).")
        for x in SPOKEN
    )
    yield Block("text", "", "", (in_each(*texts),), 0)
    described = sentence(lambda x: x.word(DESCRIBED))
    yield Block("figure", label, "", (described, sentence(ran.caption)), 0)


def _displays(steps: Sequence[Step]) -> Iterator[Entry]:
    """What steps say, of a conservation what is kept alone; of what is too long, where it is."""
    told: list[tuple[Equation, str]] = []
    for step in steps:
        kept = [e for e in step.equations if e.rhs != 0 and {"ϖ", "dϖ"} & {*names(e.lhs)}]
        alone = kept and step.label.rpartition(".")[2].startswith("conserved_")
        told += [(e, step.label) for e in (kept if alone else step.equations)]
    for long, run in groupby(told, lambda x: _rows(x[0]) > LONGEST):
        equations, labels = zip(*run, strict=True)
        places = [*dict.fromkeys(labels)]
        if not long:
            yield display(equations, places)
        else:
            yield sentence(partial(_left_out, equations), places)


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


def _prose(told: Prose, words: Language) -> str:
    return words.of(told)
