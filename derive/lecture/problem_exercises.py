"""Exercises on a problem of the reader's, made of its records: what is kept, by hand; a sign to
find; a motion to predict."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import pairwise
from zlib import crc32

import numpy as np

from ..language.show import in_sentence, show
from ..language.tree import Tree, names, neg, nodes, replaced
from ..language.values import approximate
from ..record.record import Derivation, Equation, Step
from ..record.sentence import phrase
from ..views.language import ENGLISH, Language
from .lecture_text import Block, Entry, Formula, Typed, Words, words_of
from .ran_figure import Ran, letter_of, written
from .recorded_text import SPOKEN, alone, display, in_each, kept_by, kind_of, sentence, words

HAND, MISTAKE, WATCH = "By hand.", "Find the mistake.", "Predict, then watch."
KEPT = "Show that this is constant along every motion:"
NOETHER = "It is what a symmetry of the Lagrangian leaves, {kind} (Noether)."
SIGN = "This equation of motion was copied with one sign changed. Which?"
TERM = "That of this term: {term}. The equation is"
START = "The problem starts with {start}, at the identity and at rest but for these."
NUMBERS = "Its parameters have the numbers of the table."
BETWEEN_WHICH = "Between which values does {letter} stay?"
BETWEEN = (
    "Between {low} and {high}: the square of its rate is not negative, and with {constants} the "
    "polynomial that the energy gives for it is so between these two of its roots."
)
AT_MOST = "What does the energy say that {letter} does not exceed?"
BOUND = (
    "{bound}: the energy, {energy}, is a positive definite quadratic form of the momenta, and "
    "{rate} its derivative by {momentum}; by the inequality of Cauchy and Schwarz {square} is at "
    "most twice the energy times {second}, the second derivative of the energy by {momentum}. In "
    "the figure it comes to {seen}."
)
SHOWN = "shows it."
MOST, CLOSE = 9, 1e-6
"""The most numbers of a start that an exercise says; what is 0 but for rounding."""


def exercises(
    d: Derivation,
    motion: Sequence[tuple[Equation, str]],
    kept: Sequence[Step],
    found: Sequence[Step],
    ran: Ran | None,
    command: str,
    short: Callable[[Equation], bool],
) -> Iterator[Block]:
    """Exercises on a problem by its record, each with its solution: on what the motion keeps, by
    the steps ``kept`` and by those that are ``found``, of integrals and of a reduction; on the
    equations of ``motion``, with the labels of their steps; on the motion that ran, which
    ``command`` shows; of equations that are ``short``."""
    fit = [x for x in kept if kept_by(x) != "h̃" and short(Equation("ϖ", kept_by(x)))]
    if fit:
        yield from _on_kept(d, max(fit, key=lambda x: len(in_sentence(kept_by(x)))), found)
    copied = [x for x in motion if short(x[0]) and len(_terms(x[0].rhs)) > 1]
    if copied:
        drawn = crc32(d.name.encode())
        yield from _on_sign(*copied[drawn % len(copied)], drawn // len(copied))
    if ran:
        yield from _on_motion(d, found, ran, command)


def _of(asked: Sequence[Entry], solved: Sequence[Entry]) -> list[Block]:
    return [Block("exercise", "", "", (*asked,), 0), Block("solution", "", "", (*solved,), 0)]


def _said(message: str, kind: str = "") -> Entry:
    """A sentence, after the kind of the exercise."""
    kinds = (f"_{x.word(kind)}_ " if kind else "" for x in SPOKEN)
    return in_each(*(words_of(y + x.word(message)) for x, y in zip(SPOKEN, kinds, strict=True)))


def _on_kept(d: Derivation, step: Step, integrals: Sequence[Step]) -> list[Block]:
    """What a step says to be kept, and that its rate is zero, where one of ``integrals`` has it."""
    kept = kept_by(step)
    solved = [sentence(lambda x: x.word(NOETHER, kind=kind_of(d, step, x)), (step.label,))]
    rate = Equation(("call", "d/dt", kept), 0)
    proved = [x.label for x in integrals for e in x.equations if (e.lhs, e.rhs) == (rate.lhs, 0)]
    solved += [display([rate], proved[:1])] if proved else []
    return _of([_said(KEPT, HAND), alone(kept)], solved)


def _terms(t: Tree) -> tuple[Tree, ...]:
    return t[1:] if isinstance(t, tuple) and t[0] == "add" else (t,)


def _on_sign(e: Equation, label: str, drawn: int) -> list[Block]:
    """An equation with the sign of one of its terms changed, the one that is ``drawn``."""
    terms = [*_terms(e.rhs)]
    k = drawn % len(terms)
    copied = Equation(e.lhs, ("add", *terms[:k], neg(terms[k]), *terms[k + 1 :]))
    asked = [_said(SIGN, MISTAKE), display([copied], condition=True)]
    told = (_with(x.word(TERM, term="\0"), terms[k]) for x in SPOKEN)
    return _of(asked, [in_each(*told), display([e], (label,))])


def _with(told: str, t: Tree) -> Words:
    before, _, after = told.partition("\0")
    return (before, Formula(in_sentence(t), condition=True), after)


def _on_motion(d: Derivation, steps: Sequence[Step], ran: Ran, command: str) -> Iterator[Block]:
    """What the constants of the motion that ran say of it: between which values a coordinate stays
    that moves by a quadrature, or which the energy lets a velocity not exceed; nothing where they
    say neither, or the start is long to say. ``steps``: of its integrals and its reduction."""
    foretold = between(d, steps, ran) or bounded(d, steps, ran)
    if not foretold or not 0 < len(ran.start) <= MOST:
        return
    question, answer, places, label = foretold
    start = ", ".join(f"{x} = {written(y)}" for x, y in ran.start)
    told = [START, *([NUMBERS] if d.problem.get("parameters") else []), question]
    asked = (
        (
            *words_of(f"_{x.word(WATCH)}_ "),
            *words(" ".join(_placed(y, {**places, "start": start}, x.marked) for y in told)),
            " ",
            Typed(command if x is ENGLISH else f"{command} --lang {x.name}"),
            f" {x.word(SHOWN)}",
        )
        for x in SPOKEN
    )
    yield from _of([in_each(*asked)], [sentence(partial(_placed, answer, places), [label])])


Foretold = tuple[str, str, dict[str, str], str]
"""A question, its answer, what fills their places, and the step that it rests on."""


def between(d: Derivation, steps: Sequence[Step], ran: Ran) -> Foretold | None:
    """The roots of the polynomial of a quadrature about the first value of its coordinate."""
    step = next((s for s in steps if s.label == f"{d.name}.quadrature"), None)
    degree = [int(str(y)) for s in step.prose for x, y in s.places if x == "degree"] if step else []
    if step is None or not degree or not ran.energy:
        return None
    e = step.equations[0]
    (u,) = {x for x in nodes(e.rhs) if isinstance(x, tuple) and x[0] == "entry"}
    kept: dict[Tree, float] = {"h̃": ran.energy[0]}
    for x in (x for s in steps for x in s.equations if (*x.lhs,)[:2] == ("at", "𝒥")):
        kept[x.lhs] = _value(d, x.rhs, ran)
    t = e.rhs
    for letter, number in kept.items():
        t = replaced(t, letter, Fraction(number))
    places = np.linspace(-1, 1, degree[0] + 1)
    values = [_value(d, replaced(t, u, Fraction(x)), ran) for x in places]
    if not np.isfinite(values).all():
        return None
    roots = np.roots(np.polyfit(places, values, degree[0]))
    real = sorted(float(x.real) for x in roots if abs(x.imag) < CLOSE)
    first = _value(d, u, ran)
    for low, high in pairwise(real):
        inside = _value(d, replaced(t, u, Fraction((low + high) / 2)), ran)
        if low - CLOSE < first < high + CLOSE and inside > 0:
            told = ", ".join(f"{show(x)} = {written(y)}" for x, y in kept.items())
            ends = {x: f"{y:.3f}".replace("-", "−") for x, y in (("low", low), ("high", high))}
            return (
                BETWEEN_WHICH,
                BETWEEN,
                {**ends, "letter": show(u), "constants": told},
                step.label,
            )
    return None


def bounded(d: Derivation, steps: Sequence[Step], ran: Ran) -> Foretold | None:
    """What the energy lets the velocity that varies most not exceed, where it is a positive
    definite quadratic form of the momenta: v² ≤ 2 h ∂²h/∂Π² for v = ∂h/∂Π."""
    step = next((s for s in steps if s.label == f"{d.name}.poisson"), None)
    name, curve = max(ran.curves, key=lambda x: max(x[1]) - min(x[1]))
    index = name.removeprefix("zeta_")
    energy = step.equations[0].rhs if step else 0
    if step is None or not index.isdigit() or "A" in names(energy) or not ran.energy:
        return None
    size = len(step.equations) - 1

    def at(v: Sequence[int]) -> float:
        t = energy
        for k, x in enumerate(v, 1):
            t = replaced(t, ("at", "Π", k), Fraction(int(x)))
        return _value(d, t, ran)

    axes = np.eye(size, dtype=int).tolist()
    form = np.array([[at(np.add(x, y)) - at(x) - at(y) for y in axes] for x in axes])
    odd = max(abs(at(x) - at(np.negative(x))) for x in axes)
    if not abs(at([0] * size)) + odd < CLOSE or not np.linalg.eigvalsh(form).min() > CLOSE:
        return None
    second = float(form[int(index) - 1, int(index) - 1])
    letter, momentum = letter_of(name), letter_of(name).replace("ζ", "Π")
    numbers = {"bound": (2 * ran.energy[0] * second) ** 0.5, "energy": ran.energy[0]}
    numbers |= {"second": second, "seen": max(map(abs, curve))}
    told = {"letter": f"|{letter}|", "momentum": momentum, "square": f"{letter}²"}
    told["rate"] = letter
    return AT_MOST, BOUND, told | {x: written(y) for x, y in numbers.items()}, step.label


def _value(d: Derivation, t: Tree, ran: Ran) -> float:
    """The value of an expression at the start of a motion; not a number where it has none."""
    momenta = (s for s in d.steps if s.label == f"{d.name}.momenta")
    for e in (e for s in momenta for e in s.equations if isinstance(e.lhs, tuple)):
        if e.lhs[:2] == ("at", "Π") and isinstance(e.lhs[2], int):
            t = replaced(t, e.lhs, e.rhs)
    start = dict(ran.start)
    for x in {x for x in nodes(t) if isinstance(x, tuple) and x[0] == "entry"}:
        unmoved = float(x[1] == "A" and x[2] == x[-1])
        t = replaced(t, x, Fraction(start.get(show(x), unmoved)))
    given = {x: y["default"] for x, y in d.problem["parameters"].items()}
    found = approximate(t, {x: float(y) for x, y in given.items() if y is not None})
    return math.nan if found is None else found


def _placed(message: str, places: dict[str, str], spoken: Language) -> str:
    """A message with formulas in its places."""
    return spoken.sentence(phrase(message, **places))
