"""The groups on which claims are tried, and the exact points at which the steps of a record are."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from functools import cache, cached_property, partial
from random import Random
from typing import Any

from ...algebra.families import LARGEST, group, on_homogeneous, turning_about_a_point
from ...algebra.groups import Group
from ...algebra.samplers import RandomSource
from ...algebra.structure import rank
from ...algebra.user_groups import blocks_apart, group_of_basis, of_matrices
from ...language import rational as q
from ...language.show import show
from ...language.tree import Tree, nodes
from ...record.record import ANY_GROUP, Equation, RecordError, Step
from ...record.shape import IDENTIFIER
from ..fluid import torus_model
from ..fluid.lattice_values import WEIGHTS
from ..fluid.torus_model import group_of_torus, torus_of
from ..lagrangian import kinematics_model, lagrangian_values
from ..lagrangian.lagrangian_model import LagrangianModel
from ..values.draws import Locus, claim_grade, locus_of
from ..values.evaluate import Environment
from ..values.residue import DegreeSource, Grade, ResidueSource, random_prime
from . import discrete_model
from .discrete_model import DiscreteModel
from .meaning import environment
from .model import Model

# The group of a record's problem, rebuilt from its name or basis, as the record must state it.


def group_of(problem: Mapping[str, Any]) -> Group | None:
    """The group of a record's problem, by its name or its basis; ``None`` for the text on any
    group.

    ``RecordError`` where the name, the action, the basis, 'n' or 'homogeneous' do not agree.
    """
    name, rows = str(problem.get("group")), problem.get("basis", [])
    basis = tuple(tuple(tuple(Fraction(x) for x in row) for row in e) for e in rows)
    if name == ANY_GROUP:
        if basis or problem.get("homogeneous"):
            raise RecordError(f"{ANY_GROUP} has no basis and is not homogeneous")
        if problem.get("n") != "any":
            raise RecordError(f"key 'n': {ANY_GROUP} moves the points of a space of any dimension")
        return None
    if "torus" in problem:
        return _of_torus(problem, name, basis)
    if "advected" in problem:
        return _carrying(problem, name, basis)
    found = _user_group(problem, name, basis) if IDENTIFIER.fullmatch(name) else _named(name, basis)
    if "lagrangian" in problem or "kinematics" in problem:
        found = (on_homogeneous(found) if found.affine else found).in_user_basis
    homogeneous = len(found.factors) == 1
    if homogeneous != problem.get("homogeneous"):
        kept = "an affine group kept as a linear one on (r, 1)"
        raise RecordError(f"key 'homogeneous': {name} is {'' if homogeneous else 'not '}{kept}")
    if found.n != problem.get("n"):
        raise RecordError(f"key 'n': {name} moves the points of a space of dimension {found.n}")
    if found.action != problem.get("action"):
        raise RecordError(f"key 'action': {name} acts by {found.action} maps")
    return found


def _of_torus(problem: Mapping[str, Any], name: str, basis: tuple[Any, ...]) -> Group:
    """SU(N) in the basis of the torus, which no table has."""
    torus = torus_of(problem)
    if (name, basis) != (torus.name, ()) or problem.get("homogeneous"):
        raise RecordError(f"the torus of N = {torus.N} is of {torus.name}, and has no basis")
    if (problem.get("n"), problem.get("action")) != (torus.N, "linear"):
        raise RecordError(f"key 'n': the matrices of {torus.name} have {torus.N} rows")
    return group_of_torus(torus)


def _carrying(problem: Mapping[str, Any], name: str, basis: tuple[Any, ...]) -> Group:
    """The group of an algebra without an element in the state; ``RecordError`` where its matrices
    are not independent, not closed or not in blocks, or a known name is that of another algebra."""
    sizes = [x["size"] for x in problem["advected"]]
    if not basis or sum(sizes) > len(basis[0]) or rank(basis) < len(basis):
        raise RecordError("the basis is not one, or too small for what it carries along")
    found = of_matrices(name, basis)
    if not blocks_apart(found, sizes):
        raise RecordError("the basis has no blocks for what it carries along")
    try:
        constants = found.structure_constants
        known = (
            None if IDENTIFIER.fullmatch(name) else group(name).in_user_basis.structure_constants
        )
    except ValueError as error:
        raise RecordError(str(error)) from None
    if known not in (None, constants):
        raise RecordError(f"the brackets are not those of {name}")
    if (problem.get("n"), problem.get("homogeneous")) != (found.n, False):
        raise RecordError(f"key 'n': the matrices have {found.n} rows")
    return found


def _named(name: str, basis: tuple[Any, ...]) -> Group:
    """The group of a known name; ``RecordError`` for another spelling or another basis."""
    try:
        named = group(name)
    except ValueError as error:
        raise RecordError(str(error)) from None
    if named.name != name:
        raise RecordError(f"key 'group': {named.name} is written {ascii(name)[:60]}")
    if named.basis != basis:
        raise RecordError(f"the basis is not that of {name}, in its order")
    return named


def _user_group(problem: Mapping[str, Any], name: str, basis: tuple[Any, ...]) -> Group:
    """The group of the basis that the problem states; ``RecordError`` where there is none."""
    affine = bool(problem.get("homogeneous")) or problem.get("action") == "affine"
    try:
        found = group_of_basis(name, "affine" if affine else "linear", basis)
    except ValueError as error:
        raise RecordError(f"the basis of {name}: {error}") from None
    return found if not affine or found.free_translations else on_homogeneous(found)


# The groups on which a claim about any group is tried, and how many n are enough.
#
# Both sides of such a claim are sums of contractions: traces of words, pairings. On GL(n), where
# the letters are free, those with 2m indices are perfect matchings of these, which are
# independent for n ≥ m (second fundamental theorem of the invariants of O(n)): a relation that
# holds for one such n has no coefficient that is not 0, so that it holds for each. Traces of 1
# make the coefficients polynomials in n of degree e at most: 0 if they vanish for e + 1 of these
# n. The inverse of a letter is a letter: the words are reduced. Some small groups in which
# letters are tied to one another come first.


def triangular() -> Group:
    """B(2), the upper triangular maps of the plane."""
    return group_of_basis("B(2)", "linear", [q.unit(2, *at) for at in ((0, 0), (0, 1), (1, 1))])


def triangular_affine() -> Group:
    """B(2) ⋉ R: upper triangular maps of the plane, and translations along its first axis."""
    basis = [q.unit(3, *at) for at in ((0, 0), (0, 1), (1, 1), (0, 2))]
    return group_of_basis("B(2) ⋉ R", "affine", basis)


TRIED: dict[str, tuple[Callable[[], Group], ...]] = {
    "linear": (triangular, *(partial(group, x) for x in ("SO(3)", "SL(3)"))),
    "affine": (triangular_affine, partial(group, "SE(2)"), turning_about_a_point),
}
"""By the action, small groups with relations: also one whose translations are not free, and one
whose Lie algebra has neither transposes nor odd powers. GL(n) or Aff(n), without relations, is
tried besides for as large an n as is needed."""

FREE = {"linear": "GL", "affine": "Aff"}
LEAST = 6
"""The least n of a free group that is tried, as large as the words of the walk need: one point
serves them all."""
LEAST_BY_MOMENTA = 3
"""The same where the longest word is a momentum paired with a bracket."""


@cache
def groups_with_relations(action: str) -> tuple[Group, ...]:
    """The groups with relations on which a claim for an action, "linear" or "affine", is tried."""
    return tuple(make() for make in TRIED[action])


@cache
def free(action: str, n: int) -> Group:
    """The group without relations of an action, GL(n) or Aff(n)."""
    return group(f"{FREE[action]}({n})")


def sizes(grade: Grade, least: int = LEAST) -> range:
    """As many n, from ``least`` on, as prove a claim of this grade for all n, each large enough;
    ``RecordError`` where the largest would be too large."""
    if not grade.degree:
        raise RecordError("it says nothing of any group, but of n alone")
    first = max(least, -(-grade.slots // 2))
    if first + grade.loops > LARGEST:
        raise RecordError(
            f"traces of words of degree {-(-grade.slots // 2)}, with {grade.loops} of 1, are not "
            f"independent for the n that are tried, up to {LARGEST}"
        )
    return range(first, first + grade.loops + 1)


LETTERS = ("A", "C", "J", "J_c", "g_1", "h", "m", "t", "δt", "δ′t", ("at", "m", "i"))
"""The names whose inverse is a letter again, or a number; of J and J_c one is free, and only
one."""
OF_ONE_SPACE = ("det", "hat", "wedge", "matrix", "row", "par", "fun")


def fault_for_any_group(t: Tree) -> str:
    """Why a tree is no word in the letters of any group, for any n, in words; "" if it is one."""
    foreign = (x for x in nodes(t) if isinstance(x, tuple) and _foreign(x))
    return next((f"{show(x)[:80]} is of no group but a given one" for x in foreign), "")


def _foreign(t: tuple[Any, ...]) -> bool:
    """Is the operator of a tree, or what it inverts, not of the letters of any group?"""
    numbered = t[0] == "entry" and any(isinstance(i, int) for i in t[2:])
    return t[0] in OF_ONE_SPACE or numbered or not all(map(_word, inverted(t)))


def inverted(t: tuple[Any, ...]) -> tuple[Tree, ...]:
    """The operands that an operator inverts or divides by."""
    if t[0] == "div":
        return t[2:]
    return t[1:2] if t[0] == "inv" or (t[0] == "pow" and int(t[2]) < 0) else ()


def _word(t: Tree) -> bool:
    """Is the tree a product of letters that have inverses, and of numbers?"""
    if isinstance(t, tuple) and t[0] in ("mul", "T", "pow", "inv"):
        return all(map(_word, t[1:]))
    return t in LETTERS or not isinstance(t, (str, tuple))


# The exact points at which the steps of a record are tried: made once, and shared by its steps.

SIZE = 2**128
"""The random integers of a point are of at most this absolute value."""

AnyModel = Model | LagrangianModel
Place = tuple[AnyModel, Environment]


def action_of(problem: Mapping[str, Any]) -> str:
    """The action of a record's problem, "linear" or "affine"; ``RecordError`` for anything else."""
    action = problem.get("action")
    if action not in TRIED:
        raise RecordError("record, problem: key 'action' must be linear or affine")
    return str(action)


def model_at(
    problem: Mapping[str, Any], g: Group, source: RandomSource, size: int, at: Locus, **chosen: Any
) -> AnyModel:
    """A random model at a locus; ``chosen``: what is drawn otherwise (:class:`Model`)."""
    for name, value in at.elements:
        raise RecordError(f"the element {name} = {show(value)[:60]} is of another kind of problem")
    if "lagrangian" in problem:
        return LagrangianModel(problem, g, source, size, at, **chosen)
    for name, value in (*at.field, *at.field_prime):
        text = f"{show(name)} = {show(value)}"
        raise RecordError(
            f"the hypothesis {text[:80]} is not one that can be tried: a field on the group is "
            "given where no points give the Lagrangian"
        )
    if "discrete" in problem:
        own = {} if chosen.get("generic") else problem
        return DiscreteModel(own, g, source, size, at, **chosen)
    return Model({} if chosen.get("generic") else problem, g, source, size, at, **chosen)


def names_at(model: AnyModel) -> Environment:
    """The environment of the names at a model."""
    if isinstance(model, LagrangianModel):
        return lagrangian_values.environment(model)
    if isinstance(model, DiscreteModel):
        return discrete_model.environment(model)
    return environment(model)


def side_of(problem: Mapping[str, Any]) -> str:
    """The trivialisation of a Lagrangian that no points give; "" for any other problem."""
    return str(problem.get("lagrangian", {}).get("trivialisation", ""))


class TrialPoints:
    """The points of one record: exact ones, and beside each one in degrees alone."""

    def __init__(self, problem: Mapping[str, Any], seed: int | str):
        self.problem, self.seed = problem, seed
        self._places: dict[tuple[str, Locus, int], Place] = {}
        self._graded_points: dict[tuple[str, Locus], Place] = {}

    def groups(self, scope: str, *, driven: bool = False) -> tuple[Group, ...]:
        """The groups on which a step of this scope, with inputs (``driven``) or without, is tried;
        ``RecordError`` for a scope that is neither any group nor the problem's."""
        own = self._problem_group
        if scope == ANY_GROUP:
            if driven:
                raise RecordError("an input is of a problem, not of any group")
            return groups_with_relations(action_of(self.problem))
        if own is None or scope != own.name:
            raise RecordError(f"scope {scope!r} is neither {ANY_GROUP!r} nor the problem's group")
        return (own,)

    @cached_property
    def _problem_group(self) -> Group | None:
        return group_of(self.problem)

    @cached_property
    def _kind(self) -> str:
        """What kind of point is drawn, for those that records share."""
        return "discrete" if "discrete" in self.problem else side_of(self.problem)

    @cached_property
    def _prime(self) -> int:
        return random_prime(Random(f"{self.seed} prime"))

    def environment(
        self, g: Group, step: Step, size: int = SIZE, equation: Equation | None = None
    ) -> Environment:
        """The names at the point of :meth:`point`."""
        return self.point(g, step, size, equation)[1]

    def environments(self, step: Step) -> Iterator[tuple[Group, Environment]]:
        """Each group of a step, with the names at the point where the step is tried on it."""
        for g in self.groups(step.scope, driven=step.driven):
            yield g, self.environment(g, step)

    def point(
        self, g: Group, step: Step, size: int = SIZE, equation: Equation | None = None
    ) -> Place:
        """A random exact point, its model and its names, the same for all steps with the same
        hypotheses.

        ``equation``: one that may hold for all accelerations. About any group the numbers are
        residues, unless they are small.
        """
        at, generic = locus_of(step, equation), step.scope == ANY_GROUP
        key = g.name + step.scope, at, size
        if key not in self._places:
            random = Random(f"{self.seed} {g.name} {step.scope} {at.as_text} {size}")
            source = ResidueSource(random, self._prime) if generic and size == SIZE else random
            self._places[key] = self._place(g, source, size, at, generic=generic)
        return self._places[key]

    def graded_point(self, g: Group, step: Step, equation: Equation | None = None) -> Place:
        """A point like :meth:`point` of which the degrees alone are known."""
        at = locus_of(step, equation)
        generic = step.scope == ANY_GROUP
        known = _GRADED_POINTS if generic else self._graded_points
        key = g.name + self._kind, at
        if key not in known:
            known[key] = self._place(g, DegreeSource(), SIZE, at, generic=generic)
        return known[key]

    def _place(
        self, g: Group, source: RandomSource, size: int, at: Locus, *, generic: bool
    ) -> Place:
        """A random model at which the hypotheses of a step hold, and its names."""
        if "torus" in self.problem and not generic:
            fluid: Any = torus_model.TorusModel(
                torus_of(self.problem),
                source,
                size,
                free=at.free_acceleration,
                problem=self.problem,
                driven=at.driven,
            )
            return fluid, torus_model.environment(fluid)
        if "kinematics" in self.problem:
            errors: Any = kinematics_model.KinematicsModel(self.problem, g, source, size, at)
            return errors, kinematics_model.environment(errors)
        model = model_at(self.problem, g, source, size, at, generic=generic)
        return model, names_at(model)

    def grade(self, g: Group, step: Step, equation: Equation) -> tuple[int, Grade]:
        """The degree of an equation on a group, and the grade of its numerators."""
        key = g.name + self._kind, locus_of(step, equation), equation
        known = _GRADES if step.scope == ANY_GROUP else {}
        if key not in known:
            if len(known) > MOST_GRADES:
                known.clear()
            known[key] = claim_grade(equation, self.graded_point(g, step, equation)[1])
        return known[key]

    def coincidence(self, scope: str) -> int:
        """The degree of two different arguments of elementary functions being equal by chance; of
        what is compared at all points of a lattice. About any group there are neither."""
        if scope == ANY_GROUP:
            return 0
        if "torus" in self.problem:
            return WEIGHTS
        largest = max((m.elementary.largest for m, _ in self._graded_points.values()), default=0)
        distinct = max((len(m.elementary.values) for m, _ in self._places.values()), default=0)
        return distinct**2 * largest


MOST_GRADES = 10_000
_GRADED_POINTS: dict[tuple[str, Locus], Place] = {}
_GRADES: dict[tuple[str, Locus, Equation], tuple[int, Grade]] = {}
"""Points and degrees for any group, the same for all records."""
