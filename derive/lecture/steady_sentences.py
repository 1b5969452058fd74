"""Steady motions of a problem, told of each in one sentence: where it is, and its stability."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import permutations
from unicodedata import normalize

from ..check.checker import checker_of
from ..language.show import show
from ..language.tree import replaced
from ..record.prose import message
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Sentence
from ..views.language import Language, told
from .lecture_text import Entry, chapters
from .recorded_text import sentence

TRIED, SAME_TOP = told("lecture:tried"), told("lecture:same_top")
TOP = ("I_1", "I_3", "mgl")
"""The parameters of the top in its chapter."""
POSITIVE = "The kinetic energy is taken to be positive definite: {positive}."
LETTERS = "Any values but 0: {letters}."
AT = "{point}: {verdict}."
STABLE, UNSTABLE, OPEN = "stable", "unstable", "stability is not decided here"
ON_LEAF = "stable for motions with the same Casimirs"
VERDICTS = {
    "equilibrium": {
        **dict.fromkeys(("stable", "stable_beyond", "stable_compact"), STABLE),
        **dict.fromkeys(("unstable", "unstable_beyond"), UNSTABLE),
        **dict.fromkeys(("open", "point", "undecided"), OPEN),
        "on_the_leaf": ON_LEAF,
        "eigenvalues": "the eigenvalues are about {eigenvalues}",
    },
    "enclosure": {"stable": STABLE, "unstable": UNSTABLE, "open": OPEN},
    "family": {
        "stable": "stable where {cases}",
        "stable_always": STABLE,
        "on_the_leaf": "stable for motions with the same Casimirs where {cases}",
        "on_the_leaf_always": ON_LEAF,
        **dict.fromkeys(("unstable", "unstable_large"), "unstable where {cases}"),
        "unstable_always": UNSTABLE,
        **dict.fromkeys(("roots_large", "minors_large"), OPEN),
    },
}
"""What sentences of the record say of stability, in a few words."""
SAID = {message(f"{x}.{y}"): told for x, all_ in VERDICTS.items() for y, told in all_.items()}


def steady(steps: Sequence[Step]) -> Iterator[Entry]:
    """What is supposed, then a sentence for each steady motion; ``steps``: of one search."""
    at = [s for s in steps if ".equilibrium_" in s.label]
    if not at:
        return
    variables = ", ".join(variables_of(at[0]))
    supposed = {x.message: x for s in steps for x in s.prose}
    positive = supposed.get(message("family.positive"))
    letters = dict.fromkeys(y for s in steps for y in _letters(s.prose))

    def said_first(spoken: Language) -> str:
        found = [spoken.word(TRIED, variables=spoken.formula(variables))]
        if positive:
            found.append(spoken.word(POSITIVE, **_places(positive, spoken)))
        if letters:
            found.append(spoken.word(LETTERS, letters=spoken.formula(", ".join(letters))))
        return " ".join(found)

    yield sentence(said_first)
    for s in at:
        number = s.label.rpartition("_")[2]
        both = [x for x in steps if x.label.rpartition("_")[2] == number]
        said = [x for step in both for x in step.prose]
        yield sentence(partial(_of_one, said), [x.label for x in both])


def asleep(d: Derivation) -> Iterator[Entry]:
    """Of the heavy top of the lecture, by what its chapter proves: the case of equality, which no
    search decides."""
    names = as_top(d)
    if names:
        across, _, weight = (f"‘{x}’" for x in names)
        bound, heavy = f"ℓ₃² = 4 {across} {weight}", f"{weight} > 0"
        yield sentence(
            lambda x: x.word(SAME_TOP, momentum=x.formula(bound), weight=x.formula(heavy)),
            [f"{d.name}.lagrangian"],
        )


def as_top(d: Derivation) -> tuple[str, ...]:
    """The parameters of a problem in the place of those of the heavy top, where the Lagrangian of
    the lecture's chapter on it is that of the problem; else empty."""
    step = next((s for s in d.steps if s.label == f"{d.name}.lagrangian"), None)
    given = d.problem["parameters"]
    if step is None or d.problem["group"] != "SO(3)" or len(given) != len(TOP):
        return ()
    claimed = (x for c in chapters() if c.name == "top" for e in c.entries for x in e.equations)
    lagrangian = next(x.rhs for x in claimed if x.lhs == "L̃")
    for k, name in enumerate(TOP):
        lagrangian = replaced(lagrangian, ("par", name), ("at", "par", k))
    checker = checker_of(d.problem)
    for names in permutations(given):
        t = lagrangian
        for k, name in enumerate(names):
            t = replaced(t, ("at", "par", k), ("par", name))
        if checker.check(replace(step, equations=(Equation("L̃", t),))).holds:
            return names
    return ()


def variables_of(step: Step) -> Iterator[str]:
    """The letters of what a step gives the rates of."""
    for e in step.equations:
        if isinstance(e.lhs, tuple) and e.lhs[0] in ("at", "entry"):
            yield normalize("NFC", normalize("NFD", show(e.lhs)).replace("\u0307", ""))


def _letters(prose: Sequence[Sentence]) -> Iterator[str]:
    for x in prose:
        if x.message == message("family.letter"):
            yield str(dict(x.places)["letter"])


def _places(x: Sentence, spoken: Language) -> Mapping[str, str]:
    return {
        name: spoken.formula(y) if isinstance(y, str) else spoken.sentence(y)
        for name, y in x.places
    }


def _of_one(said: Sequence[Sentence], spoken: Language) -> str:
    """Where a steady motion is, and what is proved of its stability."""
    at = next((dict(x.places)["point"] for x in said if "point" in dict(x.places)), "")
    verdicts: list[str] = []
    for x in said:
        if x.message in SAID:
            places = {k: y for k, y in _places(x, spoken).items() if f"{{{k}}}" in SAID[x.message]}
            verdicts.append(spoken.word(SAID[x.message], **places))
    first, *others = dict.fromkeys(verdicts or [spoken.word(OPEN)])
    for other in others:
        first = spoken.word("{first}; {second}", first=first, second=other)
    where = spoken.formula(str(at)) or spoken.word("all variables 0")
    return spoken.word(AT, point=where, verdict=first)
