"""What searches find of a problem, in sentences of a text for people.

Of first integrals and of its reduction: what is sought and where, its equations, what follows.
Steady motions, told of each in one sentence: what moves, and its stability, in letters and with the
numbers of the problem.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby, permutations
from typing import Any
from unicodedata import normalize

import numpy as np

from ..check.checker import checker_of
from ..language.laurent import OverlongError, vanishes
from ..language.show import in_sentence, show
from ..language.tree import Tree, add, neg, nodes, replaced
from ..language.values import elementary, value
from ..record.as_json import decode
from ..record.prose import message
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Prose, Sentence, enumerated, phrase
from ..views.figure.drawn_body import ExpressionValues
from ..views.figure.scene import quadratic
from ..views.language import labelled, told
from .common_factors import positive
from .lecture_text import Entry, chapters
from .ran_figure import Ran, value_at_start, value_of, written
from .recorded_text import axis_letter, display, kind_of, lecture, sentence, stated, symmetry_kind

LECTURE = "lecture."
RETOLD = [x.removeprefix(LECTURE) for x in labelled() if x.startswith(LECTURE)]
"""Labels of sentences of the record instead of which the lecture has one of the same places."""
SAID_AGAIN = {message(x): told(f"{LECTURE}{x}") for x in RETOLD}
FREE, DIVIDED = message("reduction.free"), message("reduction.divided")
NAMED = message("reduction.named")
WORDS = {"2": "two", "3": "three", "4": "four"}
BOTH = "{first} and {second}"


def space(steps: Sequence[Step]) -> Iterator[Entry]:
    """Of which variables the integrals are, in which bracket, and how degrees are counted."""
    for step in (s for s in steps if s.label.endswith(".poisson")):
        first, *others = step.prose
        where = "space_of_group" if first.message == message("poisson.group") else "space"
        told_first = lecture(where, variables=", ".join(variables_of(step)))
        yield sentence((told_first, *map(retold, others)), [step.label])


def momenta(d: Derivation, steps: Sequence[Step]) -> Iterator[Entry]:
    """The symmetries by which a problem is reduced, and their momenta."""
    found = [(s, e) for s in steps for e in s.equations if of_momentum(e.lhs)]
    if not found:
        return
    used = [s for s, _ in found]
    kinds = enumerated([kind_of(d, [*run]) for _, run in groupby(used, symmetry_kind)])
    yield stated("along" if used[1:] else "by_one", kinds=kinds)
    yield display([e for _, e in found], [s.label for s in used])


def of_momentum(t: Tree) -> bool:
    """Is it one of the momenta of a reduction?"""
    return isinstance(t, tuple) and t[:2] == ("at", "𝒥")


def around(step: Step) -> tuple[Prose, Prose]:
    """What is said of a step before its equations, and what behind them."""
    said = {x.message for x in step.prose}
    left_out = {NAMED, *({DIVIDED} if FREE in said else ())}
    first, *others = [retold(x, step.equations) for x in step.prose if x.message not in left_out]
    return (first,), (*others,)


def retold(x: Sentence, equations: Sequence[Equation] = ()) -> Sentence:
    """A sentence as the lecture says it; integrals, which the record numbers, by themselves."""
    places = [(name, _named(name, y, equations)) for name, y in x.places]
    return replace(x, message=SAID_AGAIN.get(x.message, x.message), places=tuple(places))


def _named(name: str, value: Sentence | str, equations: Sequence[Equation]) -> Sentence | str:
    """The integrals of some numbers, how many they are in a word; any other value as it is."""
    if not isinstance(value, str):
        return value
    if name == "half":
        return phrase(WORDS[value]) if value in WORDS else value
    if name not in ("number", "numbers"):
        return value
    *first, last = (_constant(equations, int(x)) for x in value.split(", "))
    return phrase(BOTH, first=", ".join(first), second=last) if first else last


def _constant(equations: Sequence[Equation], number: int) -> str:
    """An integral, by the equation that its rate is 0; of the first one, the energy, its name."""
    lhs = equations[number - 1].lhs
    assert isinstance(lhs, tuple)
    return in_sentence(lhs[-1] if number > 1 else "h̃")


ALWAYS, WHERE, SOLIDS = "always", " where {cases}", ("SO(3)", "SE(3)")
HEIGHTS = (message("position.lowest"), message("position.highest"))
FLAT = 1e-6
"""What is less, beside the greatest eigenvalue, is a real part that is 0: that of a double root is
known to the square root of the rounding."""
FACTORS = [1.1**k for k in range(-48, 49)]
"""By what a momentum is multiplied in search of that from which no eigenvalue grows."""
LONG = 90
"""The most letters of conditions that are told in letters."""
TOP = ("I_1", "I_3", "mgl")
"""The parameters of the top in its chapter."""
POSITIVE = "The kinetic energy is taken to be positive definite: {positive}."
LETTERS = "Any values but 0: {letters}."
AT = "At {point} the motion is {verdict}."
WHEN = "{when} ({point}), the motion is {verdict}."
STABLE, UNSTABLE = "stable", "unstable"
OPEN = "perhaps stable, which these steps do not decide"
LONG_ONES, HERE_ONLY = "stable or not by the inequalities of these steps", "here {verdict}"
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
        **dict.fromkeys(("stable", "stable_beyond"), "stable where {cases}"),
        **dict.fromkeys(("stable_always", "stable_beyond_always"), STABLE),
        "on_the_leaf": "stable for motions with the same Casimirs where {cases}",
        "on_the_leaf_always": ON_LEAF,
        **dict.fromkeys(("unstable", "unstable_large"), "unstable where {cases}"),
        "unstable_always": UNSTABLE,
        **dict.fromkeys(("roots_large", "minors_large"), OPEN),
    },
}
"""What sentences of the record say of stability, in a few words."""
SAID = {message(f"{x}.{y}"): told for x, all_ in VERDICTS.items() for y, told in all_.items()}


TURNS, ALONG, REST = "When it turns about {axis}", "When it moves along {axis}", "At rest"
POINTING = {
    0: "{when}, its axis {axis} along {fixed} of space, or opposite to it",
    1: "{when}, its axis {axis} along {fixed} of space",
    -1: "{when}, its axis {axis} opposite to {fixed} of space",
}
ALIKE = {TURNS: "motions about an axis", ALONG: "motions along an axis"}
Point = Sequence[Any]
"""The coordinates that are not 0 at a steady motion, with their values."""
RANKS = "the least of the three", "between those of the others", "the greatest of the three"


def steady(
    d: Derivation,
    steps: Sequence[Step],
    ran: Ran | None = None,
    *,
    elsewhere: bool = False,
    in_numbers: Sequence[Step] = (),
) -> Iterator[Entry]:
    """What is supposed, then a sentence for each steady motion, and one of three that are alike;
    ``steps``: of one search; ``ran``: the motion whose momenta the numbers are of; ``elsewhere``:
    are others told, too? ``in_numbers``: steps that know which positions are the lowest."""
    at = [s for s in steps if ".equilibrium_" in s.label]
    if not at:
        return
    both = [
        [x for x in steps if x.label.rpartition("_")[2] == s.label.rpartition("_")[2]] for s in at
    ]
    points = [*map(_point, both)]
    heights = {
        _position(_point([s])): x for s in in_numbers for x in s.prose if x.message in HEIGHTS
    }
    said = [x for s in steps for x in s.prose]
    supposed = [x for x in said if x.message == message("family.positive")][:1]
    letters = [y for point in points for y in point if isinstance(y[1], tuple)]
    numbers, start = _numbers(d, letters, ran)
    first = [lecture("tried", variables=", ".join(variables_of(at[0])))]
    first += [] if elsewhere else [lecture("elsewhere")]
    first += [replace(x, message=POSITIVE) for x in supposed]
    if named := dict.fromkeys(in_sentence(y) for _, y in letters):
        first.append(phrase(LETTERS, letters=", ".join(named)))
    if numbers and supposed:
        first.append(lecture("here_first" if start else "here_numbers", letters=start))
    if any(len(_cases(x)) > LONG for x in said):
        first.append(lecture("long_cases"))
    yield sentence((*first,))
    verdicts = [_verdict(run, numbers) for run in both]
    alike: dict[str, list[str]] = {}
    # two that differ in a sign alone are told as one
    told: dict[Prose, tuple[Prose, list[str]]] = {}
    for run, point, verdict in zip(both, points, verdicts, strict=True):
        motion = _kind(d, point)
        besides = [retold(heights[x]) for x in (_position(point),) if x in heights]
        besides += _to_first_order(run, point, verdict[0], numbers)
        one, pair = (
            (*_of_one(run, motion, verdict, also=x), *besides) for x in (False, len(motion[2]) == 1)
        )
        told.setdefault(pair, (one, []))[1].extend(x.label for x in run)
        proved = STABLE if verdict[0] == ON_LEAF else verdict[0]
        alike.setdefault(motion[0] if len(point) == 1 else "", []).append(proved)
    for pair, (one, labels) in told.items():
        yield sentence(pair if sum(".equilibrium_" in x for x in labels) > 1 else one, labels)
    for kind in ALIKE:
        yield from _odd_one(d, kind, alike.get(kind, []))


def _point(steps: Sequence[Step]) -> list[Any]:
    """The coordinates that are not 0 at the steady motion of these steps, with their values."""
    return [y[1:] for s in steps for x in placed(s, "point") for y in rows(x)]


def _position(point: Point) -> tuple[Any, ...]:
    """Those of the position."""
    return tuple((x, y) for x, y in point if x[0] == "entry")


def _to_first_order(
    steps: Sequence[Step], point: Point, proved: str, numbers: Mapping[str, float]
) -> Iterator[Sentence]:
    """Where the record has no short inequality, or none decides: the eigenvalues with the numbers,
    by its characteristic polynomial, and the momentum from which none has a positive real part."""
    polynomial = next((t for s in steps for t in placed(s, "polynomial")), 0)
    letters = [y[1] for _, y in point if isinstance(y, tuple)]
    brief = any(0 < len(_cases(x)) <= LONG for s in steps for x in s.prose)
    if not polynomial or not numbers or {*letters} - {*numbers} or (brief and proved != OPEN):
        return

    def roots(factor: float = 1) -> Any:
        scaled = {**numbers, **{x: factor * numbers[x] for x in letters}}
        about = value(polynomial, {"λ": np.poly1d([1.0, 0.0])}, scaled, elementary).roots
        return about.real * (abs(about.real) > FLAT * abs(about).max()) + 1j * about.imag

    told = {(written(abs(x.real), 3), written(abs(x.imag), 3)) for x in roots()}
    pairs = ([f"± {x}{i}" for x, i in zip(y, ("", "i"), strict=True) if x != "0"] for y in told)
    yield lecture("eigenvalues", eigenvalues=", ".join(sorted(" ".join(x) or "0" for x in pairs)))
    if proved in (OPEN, "") and not roots().real.any():
        yield lecture("first_order")
    grown = [x for x in FACTORS if letters and roots(x).real.any()]
    if grown and grown[-1] < FACTORS[-1]:
        low, high = grown[-1], grown[-1] * FACTORS[1] / FACTORS[0]
        while high - low > FLAT * high:
            middle = (low + high) / 2
            low, high = (middle, high) if roots(middle).real.any() else (low, middle)
        (letter,), places = letters, {"value": high * numbers[letters[0]], "factor": high}
        told_so = {x: written(y, 3) for x, y in places.items()}
        yield lecture("threshold", letter=in_sentence(("par", letter)), **told_so)


def _numbers(d: Derivation, letters: Point, ran: Ran | None) -> tuple[dict[str, float], str]:
    """The numbers of the parameters, where all have one, and of the momenta of families at the
    start, where these are not 0; the latter as a text."""
    given = {x: y["default"] for x, y in d.problem["parameters"].items()}
    if None in given.values():
        return {}, ""
    momenta = {y: value_at_start(d, x, ran) for x, y in letters} if ran else {}
    momenta = {y: x for y, x in momenta.items() if math.isfinite(x) and x}
    told = ", ".join(f"{in_sentence(y)} = {written(x)}" for y, x in momenta.items())
    return {**given, **{y[1]: x for y, x in momenta.items()}}, told


def _kind(d: Derivation, point: Point) -> tuple[str, int, Sequence[tuple[int, int, int]]]:
    """How a solid moves at a point, about or along which axis, and the entries of A that say where
    its own axes point; empty where it is no solid."""
    kind, axis, entries = REST, 0, []
    for x, y in point:
        if x[0] == "at":
            kind, axis = (TURNS, x[2]) if x[2] <= 3 else (ALONG, x[2] - 3)
        elif y in POINTING and max(x[2:]) <= 3:
            entries.append((*x[2:], y))
        else:
            return "", 0, []
    told = d.problem["group"] in SOLIDS and _even(d.problem)
    return (kind, axis, entries) if told else ("", 0, [])


def _even(problem: Mapping[str, Any]) -> bool:
    """Is a Lagrangian the same for the opposite velocity?  With a wheel that spins inside, or a
    magnetic field, it is not, and the momentum of a body at rest is not 0; of a long one it is not
    asked."""
    told = (problem.get("lagrangian") or {}).get("L")
    if told is None:
        return True
    energy = opposite = decode(told, "lecture")
    for x in {x for x in nodes(energy) if isinstance(x, tuple) and x[:2] == ("entry", "ζ")}:
        opposite = replaced(opposite, x, neg(x))
    try:
        return vanishes(add(energy, neg(opposite)))
    except OverlongError:
        return False


def _of_one(
    steps: Sequence[Step],
    motion: tuple[str, int, Sequence[tuple[int, int, int]]],
    proved: tuple[str, str],
    *,
    also: bool,
) -> Prose:
    """What a steady motion is, and what is proved of its stability; ``also``: of the one with its
    axis the other way, too."""
    said = [x for s in steps for x in s.prose]
    at = next((dict(x.places)["point"] for x in said if "point" in dict(x.places)), "")
    verdicts = [_in_few_words(x) for x in said if x.message in SAID and len(_cases(x)) <= LONG]
    here, numbers = proved
    unsaid = phrase(LONG_ONES if any(map(_cases, said)) else OPEN)
    if here:
        unsaid = phrase(HERE_ONLY, verdict=phrase(here))
    first, *others = dict.fromkeys(verdicts or [unsaid])
    for other in others:
        first = phrase("{first}; {second}", first=first, second=other)
    kind, axis, entries = motion
    when = phrase(kind, axis=axis_letter(axis))
    for i, j, sign in entries:
        axes = {"axis": axis_letter(j), "fixed": axis_letter(i)}
        when = phrase(POINTING[0 if also else sign], when=when, **axes)
    where = re.sub("−?1$", "±1", str(at)) if also else at or phrase("all variables 0")
    whole = phrase(WHEN if kind and at else AT, when=when, point=where, verdict=first)
    if not here or not verdicts:
        return (whole,)
    said_so = {"": "here", ALWAYS: "always"}.get(numbers, "here_by")
    return whole, lecture(said_so, verdict=phrase(here), numbers=numbers)


def _in_few_words(x: Sentence) -> Sentence:
    """What a sentence of the record says of stability."""
    told = SAID[x.message]
    return phrase(told, **{k: y for k, y in x.places if f"{{{k}}}" in told})


def _cases(x: Sentence) -> str:
    return str(dict(x.places).get("cases", ""))


def _verdict(steps: Sequence[Step], numbers: Mapping[str, float]) -> tuple[str, str]:
    """What is proved with the numbers, and by which of these, if one inequality decides; empty
    where no number tells it."""
    undecided = ""
    for claim in (c for s in steps for c in s.claims):
        verdict = VERDICTS["family"].get(claim.kind.removeprefix("family."), "").removesuffix(WHERE)
        cases = [[y[1:] for y in rows(x)] for k, t in claim.values if k == "cases" for x in rows(t)]
        if not verdict or not cases or not numbers:
            continue
        pairs = [pair for case in cases for pair in case]
        (a, b) = pairs[0]
        if len(pairs) == 1 and b == 0 and a[0] == "add" and positive(a, numbers):
            return verdict, ALWAYS
        values = [[[value_of(t, numbers) for t in pair] for pair in x] for x in cases]
        if math.isnan(sum(y for case in values for x in case for y in x)):
            return "", ""
        if any(all(x > y for x, y in case) for case in values):
            x, y = map(written, values[0][0])
            return verdict, f"{x} > {y}" if len(pairs) == 1 else ""
        undecided = OPEN
    return undecided, ""


def placed(step: Step, place: str) -> list[Tree]:
    """What the claims of a step have in a place."""
    return [y for claim in step.claims for x, y in claim.values if x == place]


def rows(t: Tree) -> list[Any]:
    """The parts of a matrix, of a row, of a sum; none of a number or a letter."""
    return [*t[1:]] if isinstance(t, tuple) and t[0] != "par" else []


def _odd_one(d: Derivation, kind: str, verdicts: Sequence[str]) -> Iterator[Entry]:
    """Of three motions about an axis, or along one, the only one that is stable, or unstable, and
    where its inertia stands among theirs."""
    lagrangian = d.problem.get("lagrangian") or {}
    if {*verdicts} != {STABLE, UNSTABLE} or len(verdicts) != 3 or "L" not in lagrangian:
        return
    first = 3 * (kind == ALONG)
    value, energy = ExpressionValues(d.problem), decode(lagrangian["L"], "lecture")
    form = quadratic(energy, range(6 if d.problem["group"] == "SE(3)" else 3), value)
    odd = next(k for k, x in enumerate(verdicts) if verdicts.count(x) == 1)
    # momentum over velocity, where that momentum alone is not 0
    inertia = [*(1 / np.linalg.inv(form).diagonal()[first : first + 3])] if form else []
    if len({*inertia}) == 3:
        rank = RANKS[sorted(inertia).index(inertia[odd])]
        told = {"those": ALIKE[kind], "verdict": verdicts[odd], "rank": rank}
        yield stated("only", axis=axis_letter(odd + 1), **{k: phrase(y) for k, y in told.items()})


def asleep(d: Derivation) -> Iterator[Entry]:
    """Of the heavy top of the lecture, by what its chapter proves: the case of equality, which no
    search decides."""
    names = as_top(d)
    if names:
        across, _, weight = (f"‘{x}’" for x in names)
        places = {"momentum": f"ℓ₃² = 4 {across} {weight}", "weight": f"{weight} > 0"}
        yield stated("asleep", [f"{d.name}.lagrangian"], **places)


def same_top(d: Derivation) -> Iterator[Entry]:
    """That a problem is the heavy top of the lecture, where it is."""
    if as_top(d):
        yield stated("same_top", [f"{d.name}.lagrangian"])


def as_top(d: Derivation) -> tuple[str, ...]:
    """The parameters of a problem in the place of those of the heavy top, where the Lagrangian of
    the lecture's chapter on it is that of the problem; else empty."""
    given, group = d.problem["parameters"], d.problem["group"]
    steps = [s for s in d.steps if s.label == f"{d.name}.lagrangian"]
    if not steps or group != "SO(3)" or len(given) != len(TOP):
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
        if checker.check(replace(steps[0], equations=(Equation("L̃", t),))).holds:
            return names
    return ()


def variables_of(step: Step) -> Iterator[str]:
    """The letters of what a step gives the rates of."""
    for e in step.equations:
        if isinstance(e.lhs, tuple) and e.lhs[0] in ("at", "entry"):
            yield normalize("NFC", normalize("NFD", show(e.lhs)).replace("\u0307", ""))
