"""A chapter on a problem of the reader's own, written from its records: a question, what moves, its
Lagrangian, its equations of motion, what the motion keeps, its reduction, its steady motions, a
motion and what it shows."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations_with_replacement, groupby

from ..language.show import in_sentence, show
from ..language.tree import Tree, names, nodes
from ..record.as_json import decode
from ..record.prose import message
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Sentence, phrase, say
from ..views.answer import definitions, equations_of_motion, steps_of_answer
from ..views.figure.scene import scene
from ..views.language import Language, told
from ..views.layout import Reading
from ..views.outline import declared, system, title
from ..views.text import formula
from .common_factors import tidied
from .displays import NamedSums
from .figures import Figure
from .lecture_text import Block, Chapter, Entry, Formula, Given, Words
from .problem_exercises import MOST, coordinate, exercises, off_the_axes
from .ran_figure import DESCRIBED, FLAT, Ran, label_of, raised, value_at_start, written
from .recorded_text import (
    OVER,
    SPOKEN,
    UNDRIVEN,
    as_read,
    as_written,
    claimed,
    conserved,
    display,
    in_each,
    kept_by,
    lecture,
    reason,
    sentence,
    stated,
    without_advice,
)
from .search_sentences import around, asleep, momenta, placed, retold, rows, same_top, space, steady

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
    "None with at most one momentum and one other coordinate was found; there may be others.",
)
"""Search → what is said where it found nothing and there may be more."""
HELD = "mass.held"
TITLE = "{title}: equations, what is kept, steady motions"
BODY = "The body of the problem, with the axes of its frame."
LEFT_OUT = "The expression of {what} would fill this page; the step in the margin has it."
SYSTEM = {
    "The Lagrangian is given on the group {group}, of dimension {d}, and depends {what}.": "given",
    "What acts: {forces}.": "acts",
}
"""What a text for people says of what moves, by its label, instead of the heading of a record."""
DIVIDED = "reduction.isotropy"
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
) -> Chapter:
    """The chapter of a problem, by its record and what searches found of it, those that were made;
    ``records``: the names of those that its ties speak of; ``place``: whether its body has that of
    the racket, or why not; ``ran``: its motion, or why there is none.
    Searches that were refused stand last, those for one reason together."""
    found = {x: replace(y, steps=(*(claimed(d, s) for s in y.steps),)) for x, y in found.items()}
    run = ran if isinstance(ran, Ran) else None
    moving = coordinate(d, found.get("reduction", Found()).steps)
    others = [*off_the_axes(d, found.get("reduction", Found()).steps, run)]
    told = {x: _told(d, x, found, run, also=bool(others)) for x in SEARCHES if x in found}
    if {*STEADY} <= {*told}:  # in letters, where they are found so: it says more
        del told[STEADY[0] if told[STEADY[1]] else STEADY[1]]
    for search in {*STEADY} & {*told}:
        told[search] += others
    told = dict(sorted(told.items(), key=lambda x: found[x[0]].refused))
    stable = any(told.get(x) for x in STEADY)
    blocks = [_question(run, moving, stable=stable), *_motion(d, place)]
    for _, alike in groupby(told, lambda x: found[x].refused or (told[x] and x) or NONE.get(x, x)):
        searches = (*alike,)
        entries = told[searches[0]]
        if not entries or found[searches[0]].refused:
            entries += [_nothing(d.name, searches[0], found[searches[0]])]
        apart = [[x] for x in entries] if {*STEADY} & {*searches} else [entries]
        blocks.append(_section(*(SEARCHES[x] for x in searches)))
        blocks += (_text(*x) for x in apart)
    if ran:
        blocks += [_section("A motion."), *_pictured(d, ran, moving)]
    home = {e: step.label for step in d.steps for e in step.equations}
    kept = [x for x in found.get("symmetries", Found()).steps if kept_by(x)]
    blocks += exercises(
        d,
        [(tidied(e, [*d.problem["parameters"]]), home[e]) for e in equations_of_motion(d)],
        kept,
        [s for x in ("integrals", "reduction") for s in found.get(x, Found()).steps],
        run,
        lambda e: _rows(e) <= SHORT,
    )
    reading = Reading(d.problem)
    steps = (*d.steps, *(s for x in found.values() for s in x.steps))
    sums = NamedSums((x for s in steps for x in s.names), d.problem["parameters"])
    blocks = [as_read(x, reading, sums) for x in blocks]
    whole = kept and stable
    titles = tuple(
        Given(x.word(TITLE, title=title(d, x)) if whole else title(d, x)) for x in SPOKEN
    )
    figures: dict[str, Figure] = {}
    if isinstance(ran, Ran) and not ran.flat:
        figures[label_of(d.name)] = partial(ran.picture, also=_beside(ran, moving))
    if drawn := scene(d):
        figures[label_of(d.name, "body")] = lambda _: drawn
    return Chapter(d.name, titles, records, tuple(blocks), d.name, figures)


def _section(*headings: str) -> Block:
    return Block("section", "", "", (sentence(tuple(map(phrase, headings))),), 0)


def _question(ran: Ran | None, letter: Tree, *, stable: bool) -> Block:
    """What moves, from which start, if that is not long, and what is asked of it."""
    asked = [lecture("question")]
    asked += [lecture("question_stable")] if stable else []
    if ran and len(ran.start) <= MOST:
        start = ", ".join(f"{x} = {written(y)}" for x, y in ran.start)
        asked.append(lecture("start" if start else "at_rest", start=start))
    asked += [lecture("between_which", letter=show(letter))] if letter else []
    asked += [UNDRIVEN] if ran and ran.undriven else []
    return _text(sentence((*asked,)))


def _text(*entries: Entry) -> Block:
    return Block("text", "", "", entries, 0)


def _figure(label: str, description: str, caption: Entry) -> Block:
    return Block("figure", label, "", (sentence(say(description)), caption), 0)


def _moved(d: Derivation, spoken: Language) -> str:
    """What moves, by which group, and what acts."""
    own = {x: spoken.word(told(f"lecture:{y}")) for x, y in SYSTEM.items()}
    return system(d, replace(spoken, messages={**spoken.messages, **own}))


def _motion(d: Derivation, place: Sentence | None) -> Iterator[Block]:
    """The Lagrangian, the body and its parameters, what the course has of it, and the equations of
    motion; each letter in them that the problem defines."""
    given = next((s for s in d.steps if s.label == f"{d.name}.lagrangian"), None)
    pulled_back = (s for s in d.steps if s.label.endswith(".pullback") and s.given == ())
    step = given or next(pulled_back, None)
    told_of = step.equations if step else ()
    lagrangian = [e for e in told_of if e.lhs == "L̃" and "i" not in names(e.rhs)][:1]
    known: tuple[Equation, ...] = ()
    if step and lagrangian:
        known = () if given else definitions(d, lagrangian)
        of_points = "of_affine" if "τ" in names(lagrangian[0].rhs) else "of_linear"
        said = lecture("lagrangian" if given else of_points)
        heading = sentence(lambda x: f"{_moved(d, x)} {x.sentence(said)}".lstrip())
        yield _text(heading, display(lagrangian, [step.label]), *_defining(d, known))
    yield from _parameters(d)
    if drawn := scene(d):
        yield _figure(label_of(d.name, "body"), BODY, sentence(drawn.caption))
    motion = equations_of_motion(d)
    entries = [sentence(say("Its equations of motion are"))]
    entries.append(display(motion, [s.label for s in steps_of_answer(d)]))
    entries += _defining(d, [e for e in definitions(d, motion) if e not in known])
    held = [s.label for s in d.steps for x in s.prose if x.message == message(HELD)]
    entries += [sentence(say(message(HELD)), held)] if held else []
    entries += [sentence((place,))] if place else []
    entries += [stated("as_kirchhoff")] if _as_kirchhoff(d) else []
    entries += [stated("as_multiplier")] if any(e.lhs == "θ" for e in motion) else []
    yield _text(*entries, *same_top(d))


def _defining(d: Derivation, known: Sequence[Equation]) -> Iterator[Entry]:
    """Definitions, behind a word."""
    home = {e: step.label for step in d.steps for e in step.equations}
    if defined := in_order(known):
        yield sentence(say("where"))
        yield display(defined, [*dict.fromkeys(home[e] for e in defined)])


def _as_kirchhoff(d: Derivation) -> bool:
    """Does a Lagrangian of the velocity alone move a solid in space?"""
    lagrangian = d.problem.get("lagrangian") or {}
    stated = d.problem["group"] == "SE(3)" and "L" in lagrangian
    return stated and {*names(decode(lagrangian["L"], "lecture"))} == {"ζ"}


def in_order(defined: Sequence[Equation]) -> list[Equation]:
    """Definitions, each behind those of the letters that it is made of, as far as they can be."""
    families = [_family(e.lhs) for e in defined]
    left = sorted(defined, key=lambda e: (families.index(_family(e.lhs)), str(e.lhs)))
    found = list[Equation]()
    while left:
        open_ = {y for e in left for y in (e.lhs, _family(e.lhs))}
        free = [e for e in left if not open_ - {e.lhs, _family(e.lhs)} & {*nodes(e.rhs)}]
        found += (chosen := free or left[:1])
        left = [e for e in left if e not in chosen]
    return found


def _family(t: Tree) -> Tree:
    return t[1] if isinstance(t, tuple) and t[0] in ("at", "entry") else t


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


def _told(
    d: Derivation, search: str, every: Mapping[str, Found], ran: Ran | None, *, also: bool
) -> list[Entry]:
    """The steps that a search tells; nothing where it was refused, or found none; ``also``: are
    there steady motions that the reduction tells?"""
    found = every[search]
    if search in STEADY:
        known = every.get(STEADY[0], Found()).steps
        told_of = [*steady(d, found.steps, ran, elsewhere=also, in_numbers=known)]
        return [*told_of, *(asleep(d) if told_of else ())]
    begins = tuple(f"{d.name}.{x}" for x in TOLD[search])
    told = [s for s in found.steps if s.label.startswith(begins)]
    if search == "symmetries":
        kept = [s for s in told if kept_by(s)]
        return [*(_momenta(d) if any("Π" in s.names for s in kept) else ()), *conserved(d, kept)]
    if search == "trim":
        alike = groupby(told, lambda s: s.prose)
        return [sentence((*map(retold, x),), [s.label for s in run]) for x, run in alike]
    entries = [*momenta(d, found.steps)] if search == "reduction" else [*space(found.steps)]
    for step in told:
        before, after = around(step)
        entries += [sentence(before), *_displays(step)]
        entries += [sentence(after, [step.label])] if after else []
        entries += _valid(d, step, ran)
    return entries


def _valid(d: Derivation, step: Step, ran: Ran | None) -> Iterator[Entry]:
    """What must not be 0, at the start of the motion."""
    divided = placed(step, "conditions") if any(c.kind == DIVIDED for c in step.claims) else []
    told = [(y, value_at_start(d, y, ran)) for x in divided for y in rows(x) if ran]
    if told and all(math.isfinite(y) and y for _, y in told):
        values = (f"{in_sentence(as_written(d, x))} = {written(y)}" for x, y in told)
        yield stated("valid", values=", ".join(values))


def _momenta(d: Derivation) -> Iterator[Entry]:
    """What the momenta Π_a are, by the velocity where the record tells each so, in short equations;
    else in words."""
    label = f"{d.name}.momenta"
    told = [e for s in d.steps if s.label == label for e in s.equations]
    fit = [e for e in told if rows(e.lhs)[:1] == ["Π"] and isinstance(rows(e.lhs)[1], int)]
    if fit and all(_rows(e) <= SHORT for e in fit):
        yield sentence(say("The momenta are"))
        yield display(fit, [label])
    else:
        yield stated("momenta")


def _nothing(problem: str, search: str, found: Found) -> Entry:
    """One sentence: why a search was refused, or that it found nothing."""
    if not found.refused:
        return sentence(say(NONE.get(search, "None was found.")))
    told = found.refused.removeprefix(f"{problem}: ")
    tried = search == "trim" or told.startswith(OVER.partition("{")[0]) or "nothing is" in told
    message = "None was found: {reason}." if tried else "Not sought: {reason}."
    return sentence(lambda x: x.word(message, reason=without_advice(reason(told, x))))


def _pictured(d: Derivation, ran: Ran | Sentence, letter: Tree) -> Iterator[Block]:
    """The figure of a motion, and behind it what it shows; or one sentence: why there is none."""
    if isinstance(ran, Sentence):
        yield _text(sentence((ran,)))
        return
    if ran.flat:
        yield _text(sentence(lambda x: f"{x.word(FLAT)} {ran.told(x)}"))
        return
    label, also = label_of(d.name), _beside(ran, letter)
    shown = told("lecture:shown")
    yield _text(sentence(lambda x: f"{x.word(shown, figure=f'@{label}')} {ran.told(x, also)}"))
    yield _figure(label, DESCRIBED, sentence(lambda x: ran.caption(x, also)))


def _beside(ran: Ran, letter: Tree) -> list[str]:
    """The coordinate that moves by a quadrature, where the state has it."""
    return [x for x in (show(letter),) if x in ran.state]


def _displays(step: Step) -> Iterator[Entry]:
    """What a step says, but for what is too long; of that, where nothing else is."""
    told = [x for e in step.equations for x in _entries(e)]
    if shown := [x for x in told if _rows(x) <= LONGEST]:
        yield display(shown, [step.label])
    elif told:
        what = ", ".join(show(e.lhs) for e in told)
        yield sentence(say(LEFT_OUT, what=what), [step.label])


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
