"""Entries of a chapter that are made of records: sentences in each language, equations of steps;
what symmetries keep, told of each, and why a search on a reader's problem was refused.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from ..language.show import SUBSCRIPTS, in_sentence, show
from ..language.tree import Tree, names
from ..record.prose import message
from ..record.record import Derivation, Equation, Step
from ..views.as_read import Reading
from ..views.language import LANGUAGES, Language, language
from ..views.printing.sentences import FORMULA, QUOTED
from .lecture_text import Block, Entry, Formula, Tie, Words

SPOKEN: tuple[Language, ...] = tuple(map(language, LANGUAGES))


def words(text: str) -> Words:
    """A sentence of a record with marks, whose formulas are as true as it; with them parameters in
    ‘quotes’."""
    parts = text.split(FORMULA)
    parts[::2] = (QUOTED.sub(rf"{FORMULA}\g<0>{FORMULA}", x) for x in parts[::2])
    found = enumerate(FORMULA.join(parts).split(FORMULA))
    return tuple(Formula(x, condition=True) if k % 2 else x for k, x in found if x)


def in_each(*texts: Words, labels: Sequence[str] = ()) -> Entry:
    """An entry of a text in each language."""
    return Entry(texts, (Tie(tuple(labels)),) if labels else (), display=False, line=0)


def sentence(said: Callable[[Language], str], labels: Sequence[str] = ()) -> Entry:
    """A sentence in each language, by what it is in one."""
    return in_each(*(words(said(x.marked)) for x in SPOKEN), labels=labels)


def alone(t: Tree) -> Entry:
    """The display of an expression of a step."""
    return Entry(((Formula(in_sentence(t), condition=True),),) * len(LANGUAGES), (), True, 0)


def display(
    equations: Sequence[Equation], labels: Sequence[str] = (), *, condition: bool = False
) -> Entry:
    """Equations of steps, one below the other; ``condition``: they are not tried."""
    text = ",  ".join(f"{show(e.lhs)} = {show(e.rhs)}" for e in equations)
    formula: Words = (Formula(text, condition, tuple(equations)),)
    ties = (Tie(tuple(labels)),) if labels else ()
    return Entry((formula,) * len(LANGUAGES), ties, display=True, line=0)


def as_read(block: Block, reading: Reading) -> Block:
    """A block of a chapter as it is read."""

    def part(x: str | Formula) -> str | Formula:
        if not isinstance(x, Formula):
            return x
        shown = tuple(map(reading.equation, x.recorded))
        return replace(x, text=reading.text(x.text), shown=shown)

    entries = (replace(x, texts=tuple(tuple(map(part, y)) for y in x.texts)) for x in block.entries)
    return replace(block, entries=tuple(entries))


ENERGY = "L̃ is invariant under {kind}: the energy {kept} is constant."
EXACT = "L̃ is invariant under {kind}: {kept} is constant."
UP_TO = "Under {kind}, L̃ changes by the derivative of a function alone: {kept} is constant."
REDUCED = "It is reduced by {kind}, whose momentum is {kept}."
AXIS = {2: "{kind} about {axis}", 1: "{kind} along {axis}"}
"""How many entries of the matrix of a field are not 0 → the field with its axis."""


def reduced_by(d: Derivation, steps: Sequence[Step]) -> Iterator[Entry]:
    """A sentence of each symmetry by which a problem is reduced."""
    for step in steps:
        for e in step.equations:
            if isinstance(e.lhs, tuple) and e.lhs[:2] == ("at", "𝒥"):
                momentum = f"{show(e.lhs)} = {in_sentence(e.rhs)}"
                marked = [x.marked for x in SPOKEN]
                texts = (_sentence(REDUCED, momentum, kind_of(d, step, x), x) for x in marked)
                yield in_each(*texts, labels=(step.label,))


def kept_by(step: Step) -> Tree:
    """What a step of a symmetry proves to be constant; 0 of any other step."""
    if ".conserved_" not in step.label or not any("d/dt" in names(e.lhs) for e in step.equations):
        return 0
    return next((e.rhs for e in step.equations if "ϖ" in names(e.lhs) and e.rhs != 0), 0)


def conserved(d: Derivation, steps: Sequence[Step]) -> Iterator[Entry]:
    """A sentence of each step of a symmetry, ``d``: the record of the walk."""
    for step in steps:
        kept = kept_by(step)
        exact = step.prose[0].message == message("symmetries.exact")
        told = (ENERGY if kept == "h̃" else EXACT) if exact else UP_TO
        marked = [x.marked for x in SPOKEN]
        texts = (_sentence(told, in_sentence(kept), kind_of(d, step, x), x) for x in marked)
        yield in_each(*texts, labels=(step.label,))


def _sentence(told: str, kept: str, kind: str, spoken: Language) -> Words:
    before, _, after = spoken.word(told, kind=kind, kept="\0").partition("\0")
    apart = () if after.startswith(".") else (" ",)
    return (*words(before), " ", Formula(kept, condition=True), *apart, *words(after))


def kind_of(d: Derivation, step: Step, spoken: Language) -> str:
    """What the symmetry of a step is, in a language, with its axis in space."""
    kind = next(y for x in step.prose for place, y in x.places if place == "kind")
    told = kind if isinstance(kind, str) else spoken.sentence(kind)
    field = next(e.rhs for e in step.equations if e.lhs == "δA")
    matrix = [x for x in field[1:] if x[0] == "matrix"] if isinstance(field, tuple) else []
    places = [*_places(matrix[0])] if len(matrix) == 1 and _in_space(d) else []
    if len(places) == 1 and places[0][1] == 3:
        axis = places[0][0]
    elif len(places) == 2 and places[0] == places[1][::-1] and max(places[0]) < 3:
        (axis,) = {0, 1, 2} - {*places[0]}
    else:
        return told
    letter = f"e{axis + 1}".translate(SUBSCRIPTS).replace("ₑ", "e")
    return spoken.word(AXIS[len(places)], kind=told, axis=spoken.formula(letter))


def _places(matrix: Tree) -> Iterator[tuple[int, int]]:
    """Where the entries of a matrix are not 0."""
    assert isinstance(matrix, tuple)
    for i, row in enumerate(matrix[1:]):
        yield from ((i, j) for j, x in enumerate(row[1:]) if x != 0)


def _in_space(d: Derivation) -> bool:
    """Does the group of a record move space, by matrices on r or on (r, 1)?"""
    basis = d.problem.get("basis")
    if not isinstance(basis, list) or not basis:
        return False
    size = len(basis[0])
    return size == (4 if all(not any(map(_number, E[-1])) for E in basis) else 3)


def _number(x: object) -> bool:
    return str(x) not in ("0", "0.0")


UNSHOWN = "No motion is shown: {reason}."
OVER = "the search takes more than {seconds} seconds (--seconds)"
REASONS = (
    OVER,
    "the Lagrangian couples {velocities} velocities by terms with {letters} letters in all: the "
    "inverse of its metric is too long; give numbers, or --at-defaults",
    "the Lagrangian depends on the time, so that H is no integral",
    "the Lagrangian is not quadratic in the velocity: ∂²L/∂Z² depends on it",
    "the Lagrangian is not quadratic in the velocity, so that its momenta are not solved for "
    "velocities",
    "the Lagrangian has a metric ∂²L/∂Z² that depends on g",
    "the Lagrangian has a singular metric ∂²L/∂Z²",
    "the Lagrangian has {function} of π or parameters, and integrals are sought in fractions of "
    "them; give the body by its moments, [body] given, with letters for such numbers",
    "the Lagrangian has a function, {function}, of which no polynomial is one",
    "the Lagrangian is no polynomial in the entries of g and in ζ",
    "{size} variables in the reduced equations; at most {most}",
    "there is no symmetry of L but of the time, so that nothing is reduced",
    "its symmetries move the time as well, so that nothing is reduced",
    "its symmetries change L by the derivative of a function F, or depend on the time, so that "
    "nothing is reduced",
    "to reduce it takes inverses of matrices of {group}, whose blocks have more than {rows} rows; "
    "choose a smaller group, or one of rotations and translations",
    "the locked inertia of its symmetries has no inverse anywhere: their fields depend on one "
    "another, or the metric is not definite",
    "what acts depends on the time: nothing is steady",
    "equilibria are told for numbers, and π is none: of a density that is a mass over a volume, it "
    "cancels",
    "equilibria are told for numbers, and {names} has no default",
    "the energy has an integral, of which L̃ here has the integrand; derive emit --conserved writes "
    "what is kept",
    "there are not as many symmetries for all parameters; give numbers for them",
    "a coefficient of a symmetry is no simple function of the parameters; give numbers for them",
    "no values are found at which {roots} of its Lagrangian can be tried: is a root of what is "
    "never positive among them?",
    "symmetries are sought modulo primes, of which none has {roots}, in its Lagrangian",
    "a symmetry of the integrand is not the same at all places of it",
    "mass flows in a [[flow]], which is no part of L̃, and this is of L̃ alone; leave it out",
    "a [[force]], or damping that is quadratic or rotational, is no part of L̃, and this is of L̃ "
    "alone; leave it out",
    "symmetries are fields on a group, and the state of an [algebra] has no element of one; derive "
    "integrals finds what its motion keeps",
    "no exact elements of {group} are known, by which symmetries are sought: a matrix of its basis "
    "has eigenvalues other than rational ones and one pair ±√q",
    "damping is no part of L̃, and this is of L̃ alone: damping changes the energy at the rate "
    "−Σ κ |v|², and keeps momenta whose symmetry moves no damped point, and those of translations "
    "with Σ κ r",
    "the Lagrangian is no expression where self_gravity acts, whose energy is an integral: derive "
    "symmetries seeks in its integrand, and nothing else is sought",
    "no expression of the energy: it has the operation {operation}",
    "symmetries, integrals, equilibria and reductions are not written for the torus, which keeps "
    "the energy and Tr Wᵏ: step {step}",
    "kinematics of first order have no Lagrangian, in which symmetries, integrals, equilibria and "
    "reductions are sought",
    "kinematics of first order are a filter, which is not simulated: emit its code, with --step "
    "and --exponential",
    "the group of a fluid has no matrices; choose zeitlin (a fluid on a torus) or dirichlet (an "
    "ellipsoid of fluid)",
    "the group of a fluid has no matrices, so it has no numeric code; choose zeitlin (a fluid on a "
    "torus) or dirichlet (an ellipsoid of fluid)",
    "this text is about any group; choose a problem with a group and a body",
    "this text is about any group, so it has no numeric code; choose a problem with a group and a "
    "body",
    "a trim is of numbers, and {name} has no default",
    "no trim: {terms} is {rate}, whatever {free} are",
    "no trim: {terms} is {rate}, whatever {free} is",
    "many trims: a family of dimension {size}, for multiples of {along} of {free} change "
    "nothing; give {many} of these by --at",
    "many trims: near {place} there are others, as {other}, to the first order a family of "
    "dimension {size}; free {many} fewer of these",
    "at {place} all rates are 0, and their derivatives by these are dependent, as at a double "
    "root: that there are no others near is not proved; give these numbers by --at, or free fewer",
    "no trim is found: from no start does Newton's method lead to one; give numbers near it by "
    "--at for {names}, or free others",
    "several trims: {places}; say near which by --at, too",
)
"""Why a search is refused, or a motion, with places, where the text says it in its language."""


def reason(told: str, words: Language) -> str:
    """Why a search was refused, in a language, where ``REASONS`` has it."""
    for one in REASONS:
        pattern = re.sub(r"\\{(\w+)\\}", r"(?P<\1>.+)", re.escape(one))
        if match := re.fullmatch(pattern, told):
            return words.word(one, **match.groupdict())
    return told


def without_advice(told: str) -> str:
    """A reason without what is to be typed instead, behind a semicolon: that is for the command."""
    return re.split(r"\s*; ", told)[0]
