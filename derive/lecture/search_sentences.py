"""What searches find of first integrals and of the reduction of a problem, in sentences of a text
for people: what is sought and where, its equations, what follows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

from ..language.show import in_sentence, show
from ..language.tree import Tree
from ..record.prose import message
from ..record.record import Derivation, Equation, Step
from ..record.sentence import Sentence
from ..views.language import Language
from .lecture_text import Entry
from .recorded_text import SPOKEN, in_each, kind_of, sentence, with_kept
from .steady_sentences import variables_of

SPACE = (
    "The rates of {variables} are functions of these variables alone. In their space, from which "
    "the rest of the position is left out, a function changes along the motion at the rate of its "
    "Poisson bracket with the energy, and the bracket of two of the variables is linear in them "
    "(Lie and Poisson)."
)
SPACE_OF_GROUP = (
    "The rates of {variables} are functions of these momenta alone (theorem @coadjoint). In their "
    "space, from which the position is left out, a function changes along the motion at the rate "
    "of its Poisson bracket with the energy, and the bracket of two momenta is linear in them "
    "(Lie and Poisson)."
)
ALONG = "Symmetries that commute, taken together, leave a motion with as many coordinates fewer."
MOMENTUM = "To {kind} belongs the momentum {kept}."
RETOLD = {
    "poisson.weighted": "Degrees are counted so: 1 for momenta, {weight} for the other variables.",
    "poisson.weights": (
        "Degrees are counted so: 1 for momenta, and for the other variables, in order, {weights}."
    ),
    "poisson.undriven": "The inputs are taken to be 0.",
    "casimirs.kept": (
        "Some functions have the bracket 0 with every function: they are called _Casimirs_, and "
        "the motion keeps them whatever the energy is."
    ),
    "first_integrals.energy": "The energy is constant, too.",
    "first_integrals.several": (
        "The energy is constant, too, and so is each of the functions below it: they are the first "
        "integrals."
    ),
    "first_integrals.dependent": (
        "Of them {number} is a function of those above it and of the Casimirs, though no "
        "polynomial in them."
    ),
    "first_integrals.complete": (
        "The bracket has the rank {rank}, in dimension {dimension}. It thus takes {half} integrals "
        "in involution, independent of each other and of the Casimirs, to make the motion in this "
        "space completely integrable, in the sense of Liouville: {numbers} are such."
    ),
    "first_integrals.complete_by_one": (
        "The bracket has the rank 2, in dimension {dimension}. It thus takes one integral that is "
        "independent of the Casimirs to make the motion in this space completely integrable, in "
        "the sense of Liouville: {number} is such."
    ),
    "first_integrals.complete_by_energy": (
        "The bracket has the rank 2, in dimension {dimension}. It thus takes one integral that is "
        "independent of the Casimirs to make the motion in this space completely integrable, in "
        "the sense of Liouville: the energy is such."
    ),
    "first_integrals.undecided": (
        "The bracket has the rank {rank}, in dimension {dimension}. It takes {half} integrals in "
        "involution, independent of each other and of the Casimirs, to make the motion in this "
        "space completely integrable, in the sense of Liouville. So many were not found, and the "
        "question stays open."
    ),
    "reduction.locked": (
        "The kinetic energy of what moves along the symmetries alone is half a quadratic form of "
        "its velocities along them; the matrix of this form is called the _locked inertia_."
    ),
    "reduction.effective": (
        "The velocity is the sum of what the symmetries give, at some velocities, 𝒜₁(Z) along the "
        "first, and of a rest, ζ_h, which is orthogonal to it for the kinetic energy. On a level "
        "of the momenta the energy is therefore the sum of the kinetic energy of this rest and of "
        "a function of the configuration, the _effective potential_ 𝒱; the Routhian ℛ is L̃ less "
        "the momenta times the velocities along the symmetries."
    ),
    "reduction.isotropy": (
        "All this holds where {conditions}. Elsewhere, where the kinetic energy is positive "
        "definite, some motion along the symmetries leaves the configuration as it is, and the "
        "locked inertia has no inverse."
    ),
    "reduction.divided": "All this holds where {conditions}.",
    "reduction.free": (
        "All this holds everywhere where the kinetic energy is positive definite: no motion along "
        "the symmetries leaves a configuration as it is, and the locked inertia has an inverse."
    ),
}
"""Sentence of the record → what the lecture says instead, of the same places."""
SAID_AGAIN = {message(x): told for x, told in RETOLD.items()}
FREE, DIVIDED = message("reduction.free"), message("reduction.divided")
NAMED = message("reduction.named")


def space(steps: Sequence[Step]) -> Iterator[Entry]:
    """Of which variables the integrals are, in which bracket, and how degrees are counted."""
    for step in (s for s in steps if s.label.endswith(".poisson")):
        yield sentence(partial(_space, step), [step.label])


def _space(step: Step, spoken: Language) -> str:
    first, *others = step.prose
    told = SPACE_OF_GROUP if first.message == message("poisson.group") else SPACE
    variables = spoken.formula(", ".join(variables_of(step)))
    return " ".join(
        (spoken.word(told, variables=variables), *map(spoken.sentence, map(retold, others)))
    )


def momenta(d: Derivation, steps: Sequence[Step]) -> Iterator[Entry]:
    """A sentence of each symmetry by which a problem is reduced, with its momentum."""
    found = [(s, e) for s in steps for e in s.equations if _of_momentum(e.lhs)]
    if len(found) > 1:
        yield sentence(lambda x: x.word(ALONG), [s.label for s, _ in found])
    for step, e in found:
        kept = f"{show(e.lhs)} = {in_sentence(e.rhs)}"
        texts = (with_kept(MOMENTUM, kept, kind_of(d, step, x.marked), x.marked) for x in SPOKEN)
        yield in_each(*texts, labels=(step.label,))


def _of_momentum(t: Tree) -> bool:
    return isinstance(t, tuple) and t[:2] == ("at", "𝒥")


def around(step: Step) -> tuple[list[Sentence], list[Sentence]]:
    """What is said of a step before its equations, and what behind them."""
    said = {x.message for x in step.prose}
    left_out = {NAMED, *({DIVIDED} if FREE in said else ())}
    first, *others = [retold(x, step.equations) for x in step.prose if x.message not in left_out]
    return [first], others


def retold(x: Sentence, equations: Sequence[Equation] = ()) -> Sentence:
    """A sentence as the lecture says it; integrals, which the record numbers, by themselves."""
    places = [(name, _named(name, y, equations)) for name, y in x.places]
    return replace(x, message=SAID_AGAIN.get(x.message, x.message), places=tuple(places))


def _named(name: str, value: Sentence | str, equations: Sequence[Equation]) -> Sentence | str:
    """The integrals of some numbers; any other value as it is."""
    if name not in ("number", "numbers") or not isinstance(value, str):
        return value
    return ", ".join(_constant(equations, int(x)) for x in value.split(", "))


def _constant(equations: Sequence[Equation], number: int) -> str:
    """An integral, by the equation that its rate is 0; of the first one, the energy, its name."""
    lhs = equations[number - 1].lhs
    assert isinstance(lhs, tuple)
    return in_sentence(lhs[-1] if number > 1 else "h̃")
