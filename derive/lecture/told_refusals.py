"""Why a search on a reader's problem was refused, in the language of the text."""

from __future__ import annotations

import re

from ..views.language import Language

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
    "many trims: near {place} there are others, to the first order a family of dimension {size}; "
    "free {many} fewer of these",
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
