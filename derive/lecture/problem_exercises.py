"""Exercises on a problem of the reader's, made of its records: what is kept, by hand; a sign to
find; a motion to predict."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from zlib import crc32

import numpy as np

from ..language.derivatives import derivative
from ..language.show import in_sentence, show
from ..language.tree import Tree, names, neg, nodes, replaced, terms
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Sentence, enumerated, phrase
from .lecture_text import Block, Entry, Formula, rate_of
from .ran_figure import Ran, value_at_start, written
from .recorded_text import SPOKEN, alone, display, in_each, kept_by, kind_of, lecture, stated, words
from .search_sentences import SOLIDS, of_momentum, rows

HAND, MISTAKE, WATCH = "By hand.", "Find the mistake.", "Predict, then watch."
KEPT = phrase("Show that this is constant along every motion:")
FREE_OF = {"θ", "Z", "Ż", "ζ", "w", "w_c"}
"""What the terms of a matrix or vector do not have whose power is not zero of itself."""
MOST, CLOSE = 9, 1e-6
"""The most numbers of a start that an exercise says; what is 0 but for rounding."""


def exercises(
    d: Derivation,
    motion: Sequence[tuple[Equation, str]],
    kept: Sequence[Step],
    found: Sequence[Step],
    ran: Ran | None,
    short: Callable[[Equation], bool],
) -> Iterator[Block]:
    """Exercises on a problem by its record, each with its solution: on what the motion keeps, by
    the steps ``kept`` and by those that are ``found``, of integrals and of a reduction; on the
    equations of ``motion``, with the labels of their steps; on the motion that ran; of equations
    that are ``short``."""
    fit = [x for x in kept if kept_by(x) != "h̃" and short(Equation("ϖ", kept_by(x)))]
    by_hand = [*_by_rates(d, found, short)]
    if by_hand:
        yield from _of(*by_hand)
    elif fit:
        yield from _by_noether(d, min(fit, key=lambda x: len(in_sentence(kept_by(x)))))
    told_of = [e for e, _ in motion]
    copied = [(*x, t) for x in motion if short(x[0]) and len(terms(x[0].rhs)) > 1
              for t in _seen_by_energy(x[0], told_of)]  # fmt: skip
    if copied and any(kept_by(x) == "h̃" for x in kept):
        yield from _on_sign(*copied[crc32(d.name.encode()) % len(copied)])
    if ran:
        yield from _on_motion(d, found, ran)


def _of(asked: Sequence[Entry], solved: Sequence[Entry]) -> list[Block]:
    return [Block("exercise", "", "", (*asked,), 0), Block("solution", "", "", (*solved,), 0)]


def _asked(kind: str, said: Sentence) -> Entry:
    """What is asked, after the kind of the exercise."""
    return in_each(*((f"_{x.word(kind)}_ ", *words(x.marked.sentence(said))) for x in SPOKEN))


def _by_rates(
    d: Derivation, steps: Sequence[Step], short: Callable[[Equation], bool]
) -> Iterator[Sequence[Entry]]:
    """The shortest sum that an integral or a Casimir is, but for the energy, asked; and its proof
    by the rates of its letters, where these are short."""
    rates = {
        e.lhs: (e, s.label) for s in steps if s.label.endswith(".poisson") for e in s.equations
    }
    constants = [
        (rows(e.lhs)[1], e, s.label) for s in steps for e in s.equations
        if rows(e.lhs)[:1] == ["d/dt"] and "Π" in names(e.lhs)
    ]  # fmt: skip
    energies = [e.rhs for s in steps for e in s.equations if e.lhs == "h̃"]
    found = [x for x in constants if len(terms(x[0])) > 1 and x[0] not in energies]
    for kept, e, label in sorted(found, key=lambda x: len(in_sentence(x[0])))[:1]:
        used = [*dict.fromkeys(rates[y] for x in nodes(kept) if (y := rate_of(x)) in rates)]
        if used and all(short(x) for x, _ in used):
            yield [_asked(HAND, KEPT), alone(d, kept)]
            rules = display([x for x, _ in used], [used[0][1]])
            yield [stated("by_rates"), rules, stated("cancel"), display([e], [label])]


def _by_noether(d: Derivation, step: Step) -> list[Block]:
    """What a step says to be kept, with the field of the symmetry that keeps it."""
    field = [e for e in step.equations if e.lhs in ("δA", "δT") and e.rhs != 0]
    by_field = stated("by_field", kind=kind_of(d, [step]))
    solved = [by_field, display(field, (step.label,)), stated("by_noether")]
    return _of([_asked(HAND, KEPT), alone(d, kept_by(step))], solved)


def _seen_by_energy(e: Equation, motion: Sequence[Equation]) -> Iterator[int]:
    """Which terms of the equation of a rate, changed, change the energy: each, where it is a number
    and no other equation has the rate; of a matrix or a vector those of forces."""
    if isinstance(e.lhs, tuple) and e.lhs[0] not in ("at", "entry"):
        return
    if any(e.lhs in nodes(x.rhs) for x in motion):
        return
    for k, term in enumerate(terms(e.rhs)):
        if isinstance(e.lhs, tuple) or not FREE_OF & {*names(term)}:
            yield k


def _on_sign(e: Equation, label: str, k: int) -> list[Block]:
    """An equation with the sign of one of its terms changed."""
    parts = [*terms(e.rhs)]
    copied = Equation(e.lhs, ("add", *parts[:k], neg(parts[k]), *parts[k + 1 :]))
    asked = [_asked(MISTAKE, lecture("sign")), display([copied], condition=True)]
    term = Formula(in_sentence(parts[k]), condition=True)
    told = (x.sentence(lecture("term", term="\0")).partition("\0") for x in SPOKEN)
    solved = in_each(*((before, term, after) for before, _, after in told))
    return _of(asked, [solved, display([e], (label,))])


def coordinate(d: Derivation, steps: Sequence[Step]) -> Tree:
    """The coordinate that moves by the quadrature of a reduction; 0 where there is none."""
    told = [e.rhs for s in steps if s.label == f"{d.name}.quadrature" for e in s.equations][:1]
    return next((x for t in told for x in nodes(t) if isinstance(x, tuple) and x[0] == "entry"), 0)


def _on_motion(d: Derivation, steps: Sequence[Step], ran: Ran) -> Iterator[Block]:
    """Between which values a coordinate stays that moves by a quadrature, in the motion that ran;
    nothing where there is none, or the start is long to say. ``steps``: of the reduction."""
    step = next((s for s in steps if s.label == f"{d.name}.quadrature"), None)
    if step is None or not ran.energy or not 0 < len(ran.start) <= MOST:
        return
    places = between(d, step, constants(d, steps, ran), ran)
    if not places:
        return
    solved = [stated("between", [step.label], **places)]
    solved += [stated("touched", **places)] if places["touched"] else []
    yield from _of([_asked(WATCH, lecture("predict", **places))], solved)


def constants(d: Derivation, steps: Sequence[Step], ran: Ran) -> dict[Tree, float]:
    """The energy and the momenta of a reduction at the start."""
    momenta = (e for s in steps for e in s.equations if of_momentum(e.lhs))
    return {"h̃": ran.energy[0]} | {e.lhs: value_at_start(d, e.rhs, ran) for e in momenta}


def off_the_axes(d: Derivation, steps: Sequence[Step], ran: Ran | None) -> Iterator[Entry]:
    """The steady motions of a reduction to one entry of a rotation, with the momenta of the start:
    where the derivative of the effective potential vanishes; nothing where no number is known."""
    u = coordinate(d, steps)
    effective = [e.rhs for s in steps for e in s.equations if e.lhs == "𝒱"]
    if not u or not ran or not ran.energy or not effective or d.problem["group"] not in SOLIDS:
        return
    given = constants(d, steps, ran)
    del given["h̃"]
    slope = derivative(effective[0], u)
    entries = {x for x in nodes(slope) if isinstance(x, tuple) and x[0] == "entry"}
    if entries - {u} or not all(map(math.isfinite, given.values())):
        return
    at = _function(d, slope, u, given, ran)
    grid = [(x, at(x)) for x in np.linspace(-1, 1, 102)[1:-1].tolist()]
    found = []
    for (low, first), (high, last) in pairwise(grid):
        if first * last < 0:
            for _ in range(40):
                middle = (low + high) / 2
                low, high = (middle, high) if at(middle) * first > 0 else (low, middle)
            kind = "least" if first < 0 else "greatest"
            found.append(lecture(kind, point=f"{show(u)} = {_thousandths(low)}"))
    labels = [s.label for s in steps if s.label.endswith(".effective")]
    places = enumerated(found or [lecture("no_value")])
    yield stated("off_the_axes", labels, letter=show(u), given=_told(given), places=places)


def _function(
    d: Derivation, t: Tree, u: Tree, constants: Mapping[Tree, float], ran: Ran
) -> Callable[[float], float]:
    """An expression as a function of a coordinate, with the numbers of constants."""
    for letter, number in constants.items():
        t = replaced(t, letter, Fraction(number))
    return lambda x: value_at_start(d, replaced(t, u, Fraction(x)), ran)


def _told(constants: Mapping[Tree, float]) -> str:
    return ", ".join(f"{show(x)} = {written(y)}" for x, y in constants.items())


def between(d: Derivation, step: Step, constants: Mapping[Tree, float], ran: Ran) -> dict[str, str]:
    """The roots of the polynomial of a quadrature on both sides of the first value of its
    coordinate, with what else the sentences on them say; empty where there are none, or where no
    number is known of a constant."""
    if not all(map(math.isfinite, constants.values())):
        return {}
    degree = [int(str(y)) for x in step.prose for name, y in x.places if name == "degree"]
    u = coordinate(d, [step])
    at = _function(d, step.equations[0].rhs, u, constants, ran)
    places = np.linspace(-1, 1, degree[0] + 1 if degree else 0)
    values = [*map(at, places)]
    if not degree or not np.isfinite(values).all():
        return {}
    roots = np.roots(np.polyfit(places, values, degree[0]))
    first = value_at_start(d, u, ran)
    for low, high in pairwise(sorted(x.real for x in roots if abs(x.imag) < CLOSE)):
        if low - CLOSE < first < high + CLOSE and at((low + high) / 2) > 0:
            ends = {x: _thousandths(y) for x, y in (("low", low), ("high", high))}
            simple = [_thousandths(x.real) for x in roots if abs(x.imag) < CLOSE]
            touched = [x for x in ends.values() if x == _thousandths(first)]
            all_ = {"roots": ", ".join(simple), "touched": "".join(touched[:1])}
            return {**ends, **all_, "letter": show(u), "given": _told(constants)}
    return {}


def _thousandths(x: float) -> str:
    return f"{x:.3f}".replace("-", "−")
