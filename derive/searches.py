"""What is searched for in the equations of a problem, each found thing with its record: the walk of
the problem first, then the steps of the search.  SymPy is imported by the searches that need it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from .language.limits import Refused
from .pipeline import lagrangian_road, walk
from .problem.problem import Problem, ProblemError
from .record.record import Derivation, Step
from .walk.chapter import Chapter
from .walk.spine.head import recorded
from .walk.spine.lagrangian import completed

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from .language.tree import Tree
    from .language.univariate import Number
    from .search.equilibria.enclosed_points import Enclosed
    from .search.equilibria.entries_of_elements import EntryConditions
    from .search.equilibria.stability import Equilibrium
    from .search.equilibria.stability_in_letters import Family
    from .search.integrals.all_integrals import IntegralsFound
    from .search.symmetries.symmetry_steps import Reduction, Symmetries


def integrals(
    problem: Problem, degree: int = 4, *, at_defaults: bool = False, conditions: bool = False
) -> tuple[IntegralsFound, Derivation]:
    """The polynomial integrals of the reduced equations of a problem up to a degree, and its record
    with the steps that tell them; of points by their Lagrangian as one expression.

    Without the inputs of the problem; ``at_defaults``: with numbers for its parameters;
    ``conditions``: with those on the parameters under which there are more.
    """
    whole, own, steps = _searched(problem, degree, at_defaults=at_defaults, conditions=conditions)
    return whole, recorded(own, steps)


def _searched(
    problem: Problem, degree: int, *, at_defaults: bool = False, conditions: bool = False
) -> tuple[IntegralsFound, Problem, tuple[Step, ...]]:
    """The same, with the problem whose record it is and the steps of that."""
    from .search.integrals.all_integrals import found
    from .search.integrals.integral_steps import told
    from .search.integrals.reduced import reduced, require_group, with_defaults
    from .search.symmetries.scalar_lagrangian import require_no_forces, with_scalar_lagrangian

    require_group(problem)
    require_no_forces(problem)
    driven, problem = bool(problem.inputs), replace(problem, inputs=())
    if problem.lagrangian is None:
        problem = with_scalar_lagrangian(problem, walk(problem))
    problem = with_defaults(problem) if at_defaults else problem
    whole = found(reduced(problem), degree)
    if conditions:
        from .search.integrals.special_parameters import conditions as conditions_of

        whole = replace(whole, conditions=conditions_of(whole))
    steps = walk(problem).steps
    chapter = Chapter(problem.name, problem.group_name)
    return whole, problem, (*steps, *told(whole, steps, chapter, driven=driven))


def equilibrium_near(
    problem: Problem, values: Mapping[str, Number], degree: int = 4
) -> tuple[Enclosed, Derivation]:
    """The equilibrium of a problem near a point, enclosed, and the record of its integrals up to a
    degree with the steps that tell it; parameters have their defaults."""
    from .search.equilibria.enclosed_points import enclosed
    from .search.equilibria.equilibrium_steps import told_enclosed

    return _at_points(problem, values, degree, enclosed, told_enclosed)


def equilibria(
    problem: Problem, values: Mapping[str, Number], degree: int = 4
) -> tuple[tuple[Equilibrium, ...], Derivation]:
    """The relative equilibrium of a problem at a point, or those among some points where no values
    are given, and the record of its integrals up to a degree with the steps that tell them;
    parameters have their defaults."""
    from .search.equilibria.equilibrium_steps import told
    from .search.equilibria.stability import equilibria_of

    return _at_points(problem, values, degree, equilibria_of, partial(told, tried=not values))


def families(
    problem: Problem, degree: int = 4, *, at_defaults: bool = False
) -> tuple[tuple[Family, ...], Derivation]:
    """The families of relative equilibria through some points, with inequalities in the parameters
    and in the momentum of each under which they are stable, and under which they are not; and the
    record of the integrals up to a degree with the steps that tell them.  ``at_defaults``: with
    numbers for parameters, so that of the problem's own letters π alone may be left."""
    from .schema.kind import Parameter
    from .search.equilibria import stability_in_letters as letters
    from .search.equilibria.equilibrium_steps import told_families

    whole, own, steps = _searched(problem, degree, at_defaults=at_defaults)
    names = letters.letters(whole.system, own.parameters)
    whole = letters.with_letters(whole, names)
    found = tuple(letters.families(whole, names, _elements(problem, whole)))
    used = {x: Parameter(meaning="the momentum of a family") for y in found for x in y.names}
    own = replace(own, parameters={**own.parameters, **used})
    told = told_families(whole, found, steps, Chapter(problem.name, problem.group_name))
    return found, recorded(own, (*steps, *told))


def _at_points(
    problem: Problem,
    values: Mapping[str, Number],
    degree: int,
    find: Callable[..., Any],
    tell: Callable[..., Iterable[Step]],
) -> tuple[Any, Derivation]:
    """What is found at a point of the equations with integrals, and their record with its steps."""
    from .search.equilibria.stability import PiError, require_numbers

    whole, record = integrals(problem, degree, at_defaults=True)
    try:
        require_numbers(whole)
        found = find(whole, _of_variables(problem, values), _elements(problem, whole))
    except PiError as error:
        raise PiError(f"{problem.name}: {error}") from None
    except Refused as error:
        raise ProblemError(f"{problem.name}: {error}") from None
    steps = tell(whole, found, record.steps, Chapter(problem.name, problem.group_name))
    return found, replace(record, steps=completed((*record.steps, *steps)))


def _of_variables(problem: Problem, values: Mapping[str, Number]) -> dict[str, Number]:
    """The coordinates of a point by the names of the reduced variables: A_44 is A2_11 in the
    problem, where its group is a product, and Gamma_1 is what an algebra advects first."""
    from .problem.fields import known_in_lagrangian
    from .search.integrals.reduced import coordinate

    own = known_in_lagrangian(problem.own_group, problem.advected)
    entries = {x: t for x, t in own.items() if isinstance(t, tuple) and t[1] in ("A", "Γ")}
    known = {x: coordinate(t) for x, t in entries.items()}
    if problem.advected:
        known = {y: x for x, y in known.items()}
    return {known.get(x, x): v for x, v in values.items()}


def _elements(problem: Problem, whole: IntegralsFound) -> tuple[EntryConditions, ...]:
    """What the entries of g satisfy that are among the variables of the reduced equations."""
    from .search.equilibria.entries_of_elements import conditions

    left = problem.lagrangian is None or problem.lagrangian.trivialisation == "left"
    return conditions(whole.system, problem.own_group, left=left)


def symmetries(problem: Problem, record: Derivation) -> Symmetries:
    """All symmetries of the Lagrangian of a problem, by its record, and a record of them;
    ``ProblemError`` where there is no Lagrangian of its own."""
    from .search.symmetries.found_symmetries import symmetries_of
    from .search.symmetries.symmetry_steps import Symmetries, symmetries_record

    found = symmetries_of(problem, record, of_integrand=True)
    general = lagrangian_road(found.lagrangian.trivialisation)
    return Symmetries(found, symmetries_record(found, general))


def reduction(problem: Problem, record: Derivation) -> Reduction:
    """Routh's reduction of a problem by symmetries that commute, by its record, and a record of it;
    ``ProblemError`` where there is nothing to reduce by."""
    from .search.symmetries.found_symmetries import symmetries_of
    from .search.symmetries.symmetry_steps import reduction_record

    found = symmetries_of(problem, record)
    return reduction_record(found, lagrangian_road(found.lagrangian.trivialisation))


def conserved_quantities(problem: Problem, record: Derivation) -> dict[str, Tree]:
    """Name → what the motion keeps: by each symmetry, else by Casimirs and integrals up to degree
    4 of the reduced equations; of these what no symmetry gives stands beside symmetries, too."""
    from .search.integrals.integral_steps import first_integrals
    from .search.symmetries.found_symmetries import conserved_with_damping, named, symmetries_of

    if problem.damping:
        return named(conserved_with_damping(problem, record))
    if problem.advected is not None:
        return first_integrals(problem)
    found = symmetries_of(problem, record, of_integrand=True)
    if found.integrand:
        return named(found)
    return named(found) | first_integrals(found.problem, beside_symmetries=True)


def conserved_without_gravity(problem: Problem) -> dict[str, Tree]:
    """Name → what the motion keeps where gravity is 0; nothing of a problem without gravity."""
    from .schema.potential_kinds import Gravity

    left = tuple(x for x in problem.potentials if not isinstance(x, Gravity))
    if len(left) == len(problem.potentials):
        return {}
    bare = replace(problem, potentials=left, outputs=())
    try:
        return conserved_quantities(bare, walk(bare))
    except Refused:  # damping leaves nothing
        return {}
