"""The steps of kinematics of first order: the velocity, the errors of an estimate, their rates."""

from __future__ import annotations

from ...algebra.groups import Group
from ...language.laurent import shortened
from ...language.tree import Tree, add, mul, neg, plain
from ...problem.entries_on_orbit import Rows
from ...problem.problem import Problem, ProblemError
from ...record.record import Equation, Step
from ..chapter import Chapter, say
from ..matrices.coordinates import basis_equations
from .condition import Velocity, multiplied, numbers

SIDES = ("L", "R")
"""Left and right, as the names of a record have them."""
BACK: Tree = ("inv", "Â")


def f(t: Tree) -> Tree:
    """The velocity at an element."""
    return ("call", "ℱ", t)


def in_time(t: Tree) -> Tree:
    """The derivative in time."""
    return ("call", "d/dt", t)


def matrix(rows: Rows) -> Tree:
    """A matrix as a tree."""
    return ("matrix", *(("row", *row) for row in rows))


def kinematics_steps(problem: Problem, group: Group, c: Chapter) -> tuple[Step, ...]:
    """From the velocity to what an observation says of the errors; ``ProblemError`` where the
    velocity is not tangent to the group."""
    given, acting = problem.kinematics, c.with_input()
    assert given is not None
    velocity = Velocity(group, given.rate)
    if not velocity.tangent:
        raise ProblemError(
            f"{problem.name}: kinematics, rate: A⁻¹ times it is not in the Lie algebra of "
            f"{group.name} everywhere, so that it leaves the group; correct it"
        )
    first = _stated(velocity, acting)
    tangent, errors = _tangent(group, first, acting), _errors(first, acting)
    told = [first, tangent, errors]
    if not velocity.group_affine:
        return (*told, _counterexample(velocity, first, acting))
    affine = _affine(first, acting)
    rates = _error_rates((errors, affine), acting)
    linear = _log_linear(velocity, (rates, tangent), acting)
    noise = _noise(velocity.by_inputs(given.inputs), (first, errors, linear), acting)
    return (*told, affine, rates, linear, noise, _observation(errors, c))


def _stated(velocity: Velocity, c: Chapter) -> Step:
    return c.draft("kinematics", "definition").step(
        [Equation(f("A"), matrix(velocity.rate)), Equation("Ȧ", f("A"))], say("kinematics.stated")
    )


def _tangent(group: Group, first: Step, c: Chapter) -> Step:
    draft = c.draft("tangent", "trivialisation")
    draft.depends_on(first)
    carried = Equation("Z", mul(("inv", "A"), f("A")))
    return draft.step([carried, *basis_equations(group)], say("tangent.algebra"))


def _errors(first: Step, c: Chapter) -> Step:
    draft = c.draft("errors", "definition")
    draft.depends_on(first)
    equations = [
        Equation(in_time("Â"), f("Â")),
        Equation("η_L", mul(BACK, "A")),
        Equation("η_R", mul("A", BACK)),
    ]
    return draft.step(equations, say("errors.both"))


def _parts() -> Tree:
    """f(A)Â + A f(Â) − A f(1)Â."""
    return add(mul(f("A"), "Â"), mul("A", f("Â")), neg(mul("A", f(1), "Â")))


def _affine(first: Step, c: Chapter) -> Step:
    draft = c.draft("affine", "group-affine")
    draft.depends_on(first)
    return draft.step([Equation(f(mul("A", "Â")), _parts())], say("affine.holds"))


def _counterexample(velocity: Velocity, first: Step, c: Chapter) -> Step:
    """The difference at two elements, for all inputs."""
    draft = c.draft("counterexample", "group-affine")
    draft.depends_on(first)
    pair = velocity.counterexample()
    where = [Equation(x, matrix(numbers(m))) for x, m in zip(("A", "Â"), pair, strict=True)]
    difference = add(f(mul("A", "Â")), neg(_parts()))
    return draft.step(
        [Equation(difference, matrix(velocity.defect(*pair)))], say("affine.fails"), where=where
    )


def _error_rates(made_from: tuple[Step, ...], c: Chapter) -> Step:
    draft = c.draft("error_rates", "error equation")
    draft.depends_on(*made_from)
    left = add(f("η_L"), neg(mul(f(1), "η_L")))
    right = add(f("η_R"), neg(mul("η_R", f(1))))
    return draft.step(
        [Equation(in_time("η_L"), left), Equation(in_time("η_R"), right)], say("error_rates.both")
    )


def generator(velocity: Velocity, *, left: bool) -> Rows:
    """𝒜: column a has the coordinates of the derivative of an error's rate at 1 along E_a."""
    group, one = velocity.group, velocity.at_one
    columns = []
    for a, e in enumerate(group.basis):
        E = numbers(e)
        slope, turned = velocity.slope(a), multiplied(one, E) if left else multiplied(E, one)
        columns.append(
            [
                shortened(
                    add(
                        *(
                            mul(plain(x), add(slope[i][j], neg(turned[i][j])))
                            for x, i, j in group.coordinate_terms(b)
                        )
                    )
                )
                for b in range(group.dimension)
            ]
        )
    return tuple(zip(*columns, strict=True))


def _log_linear(velocity: Velocity, made_from: tuple[Step, ...], c: Chapter) -> Step:
    draft = c.draft("log_linear", "error equation")
    draft.depends_on(*made_from)
    moved = [Equation(f"𝒜_{x}", matrix(generator(velocity, left=x == "L"))) for x in SIDES]
    moved += [Equation(in_time(f"ξ_{x}"), mul(f"𝒜_{x}", f"ξ_{x}")) for x in SIDES]
    return draft.step(moved, say("log_linear.both"))


def _noise(slope: Velocity, made_from: tuple[Step, ...], c: Chapter) -> Step:
    """W_L and W_R; that which does not depend on the estimate as it is."""
    draft = c.draft("noise", "error equation")
    draft.depends_on(*made_from)
    side = slope.invariant
    if side == "right":
        equations = [
            Equation("W_R", matrix(slope.at_one)),
            Equation("W_L", mul(BACK, "W_R", "Â")),
        ]
    else:
        first = matrix(slope.at_one) if side else mul(BACK, matrix(slope.at_estimate))
        equations = [Equation("W_L", first), Equation("W_R", mul("Â", "W_L", BACK))]
    told = say("noise.inputs") + (say(f"noise.{side}") if side else ())
    return draft.step(equations, told)


def _observation(errors: Step, c: Chapter) -> Step:
    draft = c.draft("observation", "error equation")
    draft.depends_on(errors)
    equations = [
        Equation("z_L", add(mul(BACK, "A", "o"), neg("o"))),
        Equation("z_L", add(mul("η_L", "o"), neg("o"))),
        Equation("z_R", add(mul("Â", ("inv", "A"), "o"), neg("o"))),
        Equation(mul("η_R", "z_R"), add("o", neg(mul("η_R", "o")))),
    ]
    return draft.step(equations, say("observation.both"))
