"""The verdict on a step, and its hypotheses: those that its equations need, and where they hold."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...language.show import show
from ...language.tree import Tree, names, nodes, replaced
from ...language.values import approximate
from ...record import mass_signs
from ...record.record import ANY_GROUP, OF_MASSES, Equation, Hypothesis, RecordError, Step
from ..lagrangian.lagrangian_values import concludes_velocity, unforced_velocity
from ..trials.meaning import parts_of
from ..trials.phase_point import PhasePoint
from ..trials.point_masses import axial
from ..trials.trial_points import inverted
from ..values.arithmetic import EvaluationError, is_matrix, scalar
from ..values.draws import index_bindings
from ..values.evaluate import Environment, evaluate
from .function_signatures import FORMS, LATTICE

# The verdict on a step: that it holds, or how it fails, in words.

SHOWN = 120
"""The most letters of a failing equation that a message shows."""

IMPOSSIBLE = (
    *(ArithmeticError, AssertionError, LookupError, TypeError, ValueError),
    *(AttributeError, RecursionError),
)
"""The exceptions that evaluating a record raises only if no walk has written it."""

MOST_BITS = 10**6
"""The most bits of all numbers written in a claim together, its powers multiplied out."""


@dataclass(frozen=True)
class Verdict:
    """The result of checking one step, or the symbols: ``holds``, else ``reason`` says why not.

    ``bound``: on the probability that a false claim passes. ``tried``: how many claims, and the
    names of the groups on which they were tried; ``of``: what these claims are, "equation" or
    "symbol". ``note``: what is to be known of one that holds.
    """

    label: str
    holds: bool
    reason: str
    bound: float
    tried: tuple[int, tuple[str, ...]] = (0, ())
    of: str = "equation"
    note: str = ""


def in_a_line(verdicts: Sequence[Verdict]) -> str:
    """What verdicts come to: how many steps hold, and how likely a false one is to pass."""
    bad, steps = sum(not v.holds for v in verdicts), [v for v in verdicts if v.of == "equation"]
    holding, bound = sum(v.holds for v in steps), max(v.bound for v in verdicts)
    return (
        f"{holding} of {len(steps)} steps hold exactly"
        + (", but the symbols are not as declared" if bad + holding > len(steps) else "")
        + ("" if bad else f"; a false one passes with probability below {bound:.0e}")
    )


def no_sense(error: Exception) -> str:
    """What is said of a record that cannot be evaluated, by no message of Python's."""
    return f"the problem or a step makes no sense where it is evaluated ({type(error).__name__})"


class RefusedError(Exception):
    """Ends the check of a step that does not hold; carries its :class:`Verdict`."""

    def __init__(self, verdict: Verdict):
        super().__init__(verdict.reason)
        self.verdict = verdict


def refusal(step: Step, equation: Equation, reason: str, where: str = "") -> Verdict:
    """The verdict on a step that fails by one of its equations, which its reason quotes."""
    text = f"{show(equation.lhs)} = {show(equation.rhs)}"
    text = text if len(text) <= SHOWN else f"{text[:SHOWN]} …"
    place = f"{step.key(equation)}{where}, {text}"
    return Verdict(step.label, False, f"{place}: {reason}", 1.0)


def bit_count(t: Tree) -> int:
    """About how many bits the numbers written in a tree have, its powers multiplied out."""
    if isinstance(t, (int, Fraction)):
        return abs(t.numerator).bit_length() + t.denominator.bit_length()
    if not isinstance(t, tuple):
        return 0
    if t[0] == "pow":
        return bit_count(t[1]) * abs(int(t[2]))
    return sum(bit_count(x) for x in t[1:])


# The hypotheses of a step: those that its equations need, and whether each holds at a point.
#
# An inverse needs its matrix or number to be invertible; a velocity or a force that the kinetic
# energy determines needs its metric not to be degenerate; the Lagrangian on the group needs the
# masses that the problem has.

EXACT = 10**5
"""The most bits of a number that is found in fractions, else in floats."""
HYPOTHESES_SHOWN = 80
"""The most letters of a hypothesis that a message shows."""
WORDS = {"positive": "positive", "semidefinite": "not negative"}
"""What a property says of a number; of any other one that it is not 0."""
INVERSE = ("invertible", "nonzero", "positive")
"""The properties that let one divide."""
REGULAR = "the metric of the kinetic energy is not degenerate"
MASSES = Hypothesis("positive", ("at", "m", "i"))
CENTRAL: Tree = ("add", "J", ("mul", -1, ("inv", "m"), "c", ("T", "c")))
MOMENTS = (Hypothesis("positive", "m"), Hypothesis("semidefinite", CENTRAL))
_OF_GROUP = ("A", "Â", "g_1", "A_1")
INVERTIBLE = (
    *("C", *_OF_GROUP, *(("T", x) for x in _OF_GROUP)),
    *(("norm2", x) for x in LATTICE),
)
"""The element of the group and what is made of it, and the length of points of the lattice, which
are not 0: they need no hypothesis to have inverses."""


def denominators(t: Tree) -> Iterator[Tree]:
    """What a tree divides by, or inverts, but for numbers and the element of the group."""
    found = (x for at in nodes(t) if isinstance(at, tuple) for x in inverted(at))
    return (x for x in found if x not in INVERTIBLE and not _number(x))


def _number(t: Tree) -> bool:
    """Is the tree an expression in numbers, π and i alone?"""
    if isinstance(t, tuple):
        known = t[0] in ("add", "mul", "div", "pow", "fun")
        return known and all(map(_number, t[2:] if t[0] == "fun" else t[1:]))
    return not isinstance(t, str) or t in ("π", "i")


def needs_metric(step: Step) -> bool:
    """Does a step conclude the velocity of X, or introduce F̃ by its pairing with all δA?"""
    if concludes_velocity(step):
        return True
    return any("δA" in e.for_all and "F̃" in {*names(e.lhs)} for e in step.equations)


def needs_moments(step: Step, problem: Mapping[str, Any]) -> bool:
    """Does a step introduce m, c, J as parameters, the moments of some positive masses?"""
    free = problem.get("body", {}).get("kind") == "moments" and step.scope != ANY_GROUP
    introduced = free and any(e.lhs == "J" for e in step.equations)
    return introduced and not mass_signs.any_sign(problem)


def missing_mass_hypotheses(steps: Iterable[Step], problem: Mapping[str, Any]) -> Iterator[str]:
    """For each step the hypothesis on the masses that it lacks where the record first introduces
    L̃, in words; "" if none."""
    known = not {"lagrangian", "fluid"}.isdisjoint(problem)  # which says all of L̃, and no masses
    for step in steps:
        here = not known and any(e.lhs == "L̃" for e in step.equations)
        known = known or here
        yield _missing_mass_hypothesis(step, problem) if here else ""


def _missing_mass_hypothesis(step: Step, problem: Mapping[str, Any]) -> str:
    """The hypothesis on the masses that a step introducing L̃ lacks, in words; "" if none."""
    with suppress(RecordError):  # its own verdict says so
        if MASSES not in step.hypotheses and not mass_signs.any_sign(problem):
            return "it introduces L̃, and does not suppose that the masses are positive"
    if not any(x.property == "nondegenerate" for x in step.hypotheses):
        return f"it introduces L̃, and does not suppose that {REGULAR}"
    return ""


def false_hypothesis(
    step: Step,
    problem: Mapping[str, Any],
    env: Environment,
    model: PhasePoint,
    ordered: Iterable[Environment],
) -> str:
    """The first hypothesis of a step that does not hold, at a point or of the problem, in words; ""
    if none.

    ``ordered``: points in rational numbers, at which inequalities are tried.
    """
    if any(x.property in OF_MASSES for x in step.hypotheses) and mass_signs.any_sign(problem):
        return mass_signs.SUPPOSED
    for x in step.hypotheses:
        places = ordered if x.property in ORDER else [env]
        if why := next(filter(None, (_failure(x, at, model) for at in places)), ""):
            return f"the hypothesis that {_shortened(x.of)} is {x.property} is {why}"
    return ""


def false_by_default(step: Step, problem: Mapping[str, Any]) -> str:
    """The first hypothesis of a step that is false for the defaults of the parameters, in words; ""
    if none is that has a value there."""
    values = mass_signs.defaults(problem)
    for x in step.hypotheses:
        if x in (MASSES, MOMENTS[1]) and mass_signs.of_no_masses(problem, values):
            return "for the defaults of the parameters no positive masses have these moments"
        number = _by_default(x.of, values)
        if number is not None and not HOLDS[x.property](((number,),)):
            said = WORDS.get(x.property, "not 0")
            where = f"{_shortened(x.of)}, which is {number:.6g} for the defaults of the parameters"
            return f"it supposes that {where}, is {said}"
    return ""


def _by_default(t: Tree, values: Mapping[str, float]) -> float | None:
    """The value of a tree for the defaults of parameters, as they are written; ``None`` if it has
    none there."""
    for name, x in values.items():
        t = replaced(t, ("par", name), Fraction(str(x)))
    return approximate(t, {}, Fraction if bit_count(t) < EXACT else float)


def missing_hypothesis(
    step: Step, problem: Mapping[str, Any], env: Environment, model: PhasePoint
) -> str:
    """A hypothesis that the equations of a step need and it does not make, in words, or why the
    velocity of X that it concludes is not forced; "" if none."""
    inverted = {x.of for x in step.hypotheses if x.property in INVERSE}
    for e in step.equations:
        for t in (*denominators(e.lhs), *denominators(e.rhs)):
            if t not in inverted:
                return (
                    f"it divides by {_shortened(t)}, and does not suppose that this has an inverse"
                )
    for x in MOMENTS if needs_moments(step, problem) else ():
        if x not in step.hypotheses:
            return f"it does not suppose that {_shortened(x.of)} is {x.property}"
    if needs_metric(step) and not any(_is_metric(x, env, model) for x in step.hypotheses):
        return f"it does not suppose that {REGULAR}"
    return unforced_velocity(model) if concludes_velocity(step) else ""


def _shortened(t: Tree) -> str:
    """A tree as text, cut to a length that fits a message."""
    return show(t)[:HYPOTHESES_SHOWN]


# -- at a point ----------------------------------------------------------------------------------


def _failure(x: Hypothesis, env: Environment, model: PhasePoint) -> str:
    """Why a hypothesis does not hold at a point, in words; "" where it does. Tried once for a
    model: many steps make the same."""
    if x not in model.hypothesis_failures:
        model.hypothesis_failures[x] = _find_failure(x, env, model)
    return model.hypothesis_failures[x]


def _find_failure(x: Hypothesis, env: Environment, model: PhasePoint) -> str:
    """Why a hypothesis does not hold at a point, in words; "" where it does."""
    if x.property == "nondegenerate":
        chosen = slice(0, 1) if x.space == "T_g G" else slice(1, None)
        told = ({y for form in forms[chosen] for y in form} for forms in FORMS)  # of δ, and of δ′
        if not all(letters & {*names(x.of)} for letters in told):
            return f"of no form in two variations on {x.space}"
        if form_matrix(x.of, env, model) != model.metric:
            return "of another form than the metric of the kinetic energy"
        return "" if q.rank(model.metric) == model.group.dimension else "false"
    for value in values(x.of, env):
        found = scalar(value)
        if is_matrix(found) and x.property in ("positive", "nonzero"):
            return "of a matrix"
        if not HOLDS[x.property](found if is_matrix(found) else ((found,),)):
            return "false"
    return ""


ORDER = ("positive", "semidefinite")

HOLDS: dict[str, Callable[[Matrix], bool]] = {
    "positive": lambda x: bool(x[0][0] > 0),
    "nonzero": lambda x: bool(x[0][0] != 0),
    "invertible": lambda x: len(x) == len(x[0]) and q.inverse(x) is not None,
    "semidefinite": lambda x: x == q.transposed(x) and q.semidefinite(x),
}
"""Property → whether a matrix has it, or a number as a 1 × 1 matrix."""


def values(t: Tree, env: Environment) -> Iterator[Any]:
    """The value of a tree for each value of its free indices."""
    return (evaluate(t, there) for there in index_bindings(t, env))


def form_matrix(form: Tree, env: Environment, model: PhasePoint) -> Matrix:
    """The d × d matrix of a bilinear form in two variations on the basis, ``form``(E_a, E_b);
    ``EvaluationError`` where its values are no numbers."""
    first, second = ([_variation_values(e, model, k) for e in model.group.basis] for k in (0, 1))

    def value(a: Mapping[str, Any], b: Mapping[str, Any]) -> Any:
        there = replace(env, names=ChainMap({**a, **b}, env.names))  # type: ignore[arg-type]
        return scalar(evaluate(form, there))

    rows = tuple(tuple(value(a, b) for b in second) for a in first)
    if any(is_matrix(x) for row in rows for x in row):
        raise EvaluationError("a form has numbers as values")
    return rows


def _variation_values(e: Matrix, model: PhasePoint, which: int) -> dict[str, Matrix]:
    """The values of the names of the first (``which`` 0) or the second variation along e in 𝔤."""
    space, *algebra = FORMS[which]
    found: dict[str, Matrix] = {}
    for x, letters in ((q.times(model.g, e), [space]), (e, algebra)):
        for linear, shift in letters:
            turned = linear[0] == "Ω"
            if turned and not model.group.turns_space:
                continue
            found |= parts_of(model, linear, shift, x) | ({linear: axial(x)} if turned else {})
    return found


def _is_metric(x: Hypothesis, env: Environment, model: PhasePoint) -> bool:
    """Does the hypothesis say that the kinetic metric, or its matrix, is not degenerate?"""
    if x.property == "invertible":
        return all(value == model.metric for value in values(x.of, env))
    return x.property == "nondegenerate"
