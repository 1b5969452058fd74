"""A chapter on a problem of the reader's own, written from its records: what moves, its equations
of motion, what the motion keeps, its reduction, its steady motions, a motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations_with_replacement, groupby

from ..language.show import show
from ..language.tree import Tree, nodes
from ..record.prose import message
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Sentence
from ..views.answer import definitions, equations_of_motion, steps_of_answer
from ..views.as_read import Reading
from ..views.figure.scene import scene
from ..views.language import Language, language
from ..views.outline import declared, system, title
from ..views.text import formula
from .figures import Figure
from .lecture_text import Block, Chapter, Entry, Formula, Given, Words
from .named_sums import NamedSums
from .problem_exercises import exercises
from .ran_figure import DESCRIBED, FLAT, Ran, label_of, raised
from .recorded_text import (
    OVER,
    SPOKEN,
    as_read,
    conserved,
    display,
    in_each,
    kept_by,
    reason,
    sentence,
    without_advice,
    words,
)
from .search_sentences import around, momenta, space
from .steady_sentences import asleep, steady

SEARCHES = {
    "symmetries": "What the motion keeps.",
    "integrals": "First integrals.",
    "reduction": "Reduction.",
    "equilibria": "Steady motions.",
    "families": "Steady motions.",
    "trim": "At rest, by its inputs.",
}
"""What is told of a problem after its equations, under which heading."""
TOLD = {
    "symmetries": ("conserved_",),
    "integrals": ("casimirs", "first_integrals"),
    "reduction": ("locked", "effective", "quadrature"),
    "trim": ("trim",),
}
"""Search → how the labels of the steps begin that a text for people tells; the record has all."""

STEADY = ("equilibria", "families")
NONE = dict.fromkeys(
    STEADY,
    "Only points with one momentum were tried, and none was found; there may be others.",
)
"""Search → what is said where it found nothing and there may be more."""
HELD = "mass.held"
TITLE = "{title}: equations, what is kept, steady motions"
BODY = "The body of the problem, with the axes of its frame."
LEFT_OUT = "The expression of {what} is too long for this page: the step in the margin has it."
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
    told = {x: _told(d, x, found[x]) for x in SEARCHES if x in found}
    if {*STEADY} <= {*told}:  # in letters, where they are found so: it says more
        del told[STEADY[0] if told[STEADY[1]] else STEADY[1]]
    for _, alike in groupby(told, lambda x: found[x].refused or (told[x] and x) or NONE.get(x, x)):
        searches = (*alike,)
        entries = told[searches[0]] or [_nothing(d.name, searches[0], found[searches[0]])]
        apart = [[x] for x in entries] if {*STEADY} & {*searches} else [entries]
        blocks.append(_section(*(SEARCHES[x] for x in searches)))
        blocks += (Block("text", "", "", tuple(x), 0) for x in apart)
    if ran:
        blocks += [_section("A motion."), *_pictured(d.name, ran)]
    home = {e: step.label for step in d.steps for e in step.equations}
    kept = [x for x in found.get("symmetries", Found()).steps if kept_by(x)]
    blocks += exercises(
        d,
        [(e, home[e]) for e in equations_of_motion(d)],
        kept,
        [s for x in ("integrals", "reduction") for s in found.get(x, Found()).steps],
        ran if isinstance(ran, Ran) else None,
        command,
        lambda e: _rows(e) <= SHORT,
    )
    reading = Reading(str(d.problem["group"]))
    steps = (*d.steps, *(s for x in found.values() for s in x.steps))
    sums = NamedSums((*d.problem["parameters"], *(x for s in steps for x in s.names)))
    blocks = [as_read(x, reading, sums) for x in blocks]
    whole = kept and any(told.get(x) for x in STEADY)
    titles = tuple(
        Given(x.word(TITLE, title=title(d, x)) if whole else title(d, x)) for x in SPOKEN
    )
    figures: dict[str, Figure] = {}
    if isinstance(ran, Ran) and not ran.flat:
        figures[label_of(d.name)] = ran.picture
    if drawn := scene(d):
        figures[label_of(d.name, "body")] = lambda _: drawn
    file = f"the chapter of {d.name}"
    return Chapter(d.name, titles, records, tuple(blocks), file, figures)


def _section(*headings: str) -> Block:
    heading = sentence(lambda x: " ".join(map(x.word, headings)))
    return Block("section", "", "", (heading,), 0)


def _motion(d: Derivation) -> Iterator[Block]:
    """What moves, and by which equations; each letter in them that the problem defines."""
    home = {e: step.label for step in d.steps for e in step.equations}
    entries = [sentence(lambda x: system(d, x))] if system(d, language("en")) else []
    for s in d.steps:
        if s.label == f"{d.name}.lagrangian":
            entries.append(sentence(lambda x: x.word("It reads")))
            entries += _displays([s])
    motion = equations_of_motion(d)
    entries.append(sentence(lambda x: x.word("Its equations of motion are")))
    steps = steps_of_answer(d)
    entries.append(display(motion, [s.label for s in steps]))
    if defined := in_order(definitions(d, motion)):
        entries.append(sentence(lambda x: x.word("where")))
        entries.append(display(defined, [*dict.fromkeys(home[e] for e in defined)]))
    held = [s.label for s in d.steps for x in s.prose if x.message == message(HELD)]
    if held:
        entries.append(sentence(lambda x: x.word(message(HELD)), held))
    yield Block("text", "", "", tuple(entries), 0)


def in_order(defined: Sequence[Equation]) -> list[Equation]:
    """Definitions, each behind those of the letters that it is made of, as far as they can be."""
    left, found = [*defined], list[Equation]()
    while left:
        open_ = {y for e in left for y in (e.lhs, _family(e.lhs))}
        free = [e for e in left if not open_ - {e.lhs, _family(e.lhs)} & {*nodes(e.rhs)}]
        found += (chosen := free or left[:1])
        left = [e for e in left if e not in chosen]
    return found


def _family(t: Tree) -> Tree:
    return t[1] if isinstance(t, tuple) and t[0] in ("at", "entry") else t


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
        cells += [in_each(*valued), in_each(*((Given(raised(unit)),) for _ in SPOKEN))]
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


def _told(d: Derivation, search: str, found: Found) -> list[Entry]:
    """The steps that a search tells; nothing where it was refused, or found none."""
    if search in STEADY:
        told_of = [*steady(found.steps)]
        return [*told_of, *(asleep(d) if told_of else ())]
    begins = tuple(f"{d.name}.{x}" for x in TOLD[search])
    told = [s for s in found.steps if s.label.startswith(begins)]
    if search == "symmetries":
        kept = [s for s in told if kept_by(s)]
        return [*(_momenta(d) if any("Π" in s.names for s in kept) else ()), *conserved(d, kept)]
    if search == "trim":
        alike = groupby(told, lambda s: s.prose)
        return [sentence(partial(_prose, x), _labels([*run])) for x, run in alike]
    entries = [*momenta(d, found.steps)] if search == "reduction" else [*space(found.steps)]
    for step in told:
        before, after = around(step)
        entries.append(sentence(partial(_prose, before)))
        entries += _displays([step])
        if after:
            entries.append(sentence(partial(_prose, after), [step.label]))
    return entries


def _labels(steps: Sequence[Step]) -> list[str]:
    return [x.label for x in steps]


def _momenta(d: Derivation) -> Iterator[Entry]:
    """What the momenta Π_a are, where the record tells each by the velocity, in short equations."""
    for s in d.steps:
        told = [e for e in s.equations if isinstance(e.lhs, tuple) and e.lhs[:2] == ("at", "Π")]
        told = [e for e in told if not e.for_all and e.rhs != ("inner", "Π", ("at", "E", "a"))]
        if s.label == f"{d.name}.momenta" and told and all(_rows(e) <= SHORT for e in told):
            yield sentence(lambda x: x.word("The momenta are"))
            yield display(told, [s.label])


def _nothing(problem: str, search: str, found: Found) -> Entry:
    """One sentence: why a search was refused, or that it found nothing."""
    if not found.refused:
        return sentence(lambda x: x.word(NONE.get(search, "None was found.")))
    told = found.refused.removeprefix(f"{problem}: ")
    tried = search == "trim" or told.startswith(OVER.partition("{")[0]) or "nothing is" in told
    message = "None was found: {reason}." if tried else "Not sought: {reason}."
    return sentence(lambda x: x.word(message, reason=without_advice(reason(told, x))))


def _pictured(problem: str, ran: Ran | Sentence) -> Iterator[Block]:
    """The figure of a motion with what is said of it, or one sentence: why there is none."""
    if isinstance(ran, Sentence):
        yield Block("text", "", "", (sentence(lambda x: x.sentence(ran)),), 0)
        return
    label = label_of(problem)
    if ran.flat:
        yield Block("text", "", "", (sentence(lambda x: f"{ran.told(x)} {x.word(FLAT)}"),), 0)
        return
    texts = (
        (*words(ran.told(x.marked).removesuffix(".")), f" ({x.word('Fig.').lower()} @{label}).")
        for x in SPOKEN
    )
    yield Block("text", "", "", (in_each(*texts),), 0)
    described = sentence(lambda x: x.word(DESCRIBED))
    yield Block("figure", label, "", (described, sentence(ran.caption)), 0)


def _displays(steps: Sequence[Step]) -> Iterator[Entry]:
    """What steps say; of what is too long, where it is."""
    told = [(x, step.label) for step in steps for e in step.equations for x in _entries(e)]
    for long, run in groupby(told, lambda x: _rows(x[0]) > LONGEST):
        equations, labels = zip(*run, strict=True)
        places = [*dict.fromkeys(labels)]
        if not long:
            yield display(equations, places)
        else:
            yield sentence(partial(_left_out, equations), places)


def _entries(e: Equation) -> list[Equation]:
    """An equation; of a symmetric matrix that is too long, those of its entries."""
    t = e.rhs
    if _rows(e) <= LONGEST or not isinstance(t, tuple) or t[0] != "matrix":
        return [e]
    rows = [row[1:] for row in t[1:] if isinstance(row, tuple)]
    if any(row != column for row, column in zip(rows, zip(*rows, strict=True), strict=True)):
        return [e]
    places = combinations_with_replacement(range(len(rows)), 2)
    return [Equation(("entry", e.lhs, i + 1, j + 1), rows[i][j]) for i, j in places]


def _rows(e: Equation) -> int:
    """Over how many lines an equation is set."""
    return formula([e], ()).count("\\\\\n") + 1


def _left_out(equations: Sequence[Equation], words: Language) -> str:
    what = words.formula(", ".join(show(e.lhs) for e in equations))
    return words.word(LEFT_OUT, what=what)


def _prose(told: Sequence[Sentence], words: Language) -> str:
    return words.of((*told,))
