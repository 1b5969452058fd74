"""The steps of kinematics of first order: the velocity, the errors of an estimate, their rates.

Whether a velocity on a group is tangent to it, and group-affine; elements at which it is not.
f_u(ab) = f_u(a)b + a f_u(b) − a f_u(1)b for all a and b: A. Barrau, S. Bonnabel, The invariant
extended Kalman filter as a stable observer, IEEE Transactions on Automatic Control 62 (4), 2017.
What is said to hold is so modulo primes of ten digits at random elements, for letters in place of
the inputs (Schwartz, Zippel); the checker has it once more in its own way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from random import Random
from typing import Any

from ...algebra.exact_kernel import PRIMES, ResidueVectorSource
from ...algebra.groups import Group
from ...algebra.samplers import simple_elements
from ...language import rational as q
from ...language.derivatives import derivative, residue
from ...language.laurent import shortened
from ...language.rational import Matrix
from ...language.tree import Tree, add, mul, neg, plain
from ...problem.entries_on_orbit import (
    EntriesOfElement,
    Rows,
    element,
    matrix,
    rational,
    times,
    vanishes,
    with_entries,
)
from ...problem.problem import Problem, ProblemError
from ...record.record import Equation, Step
from ..chapter import Chapter, say
from ..matrices.coordinates import basis_equations

Pair = tuple[Matrix, Matrix]
"""Two elements of the group."""


@dataclass(frozen=True)
class Velocity:
    """f, a matrix of expressions in the entries of A and in other names, on a group."""

    group: Group
    rate: Rows

    def at(self, g: Rows) -> Rows:
        """f at another matrix."""
        return tuple(tuple(shortened(with_entries(t, g)) for t in row) for row in self.rate)

    @property
    def at_one(self) -> Rows:
        """f(1)."""
        return self.at(rational(q.identity(self.group.size)))

    @property
    def at_estimate(self) -> Rows:
        """f(Â)."""
        return self.at(
            tuple(
                tuple(("entry", "Â", *x[2:]) if isinstance(x, tuple) else x for x in row)
                for row in element(self.group)
            )
        )

    def slope(self, a: int) -> Rows:
        """The derivative of f at 1 in the direction of E_a; a from 0."""
        moved = EntriesOfElement(self.group, "left")
        along = tuple(tuple(moved.along(t, a) for t in row) for row in self.rate)
        return Velocity(self.group, along).at_one

    def by_inputs(self, inputs: tuple[str, ...]) -> Velocity:
        """The derivative of f by the inputs along ς."""
        weights = [(("par", x), ("entry", "ς", j)) for j, x in enumerate(inputs, 1)]
        rate = tuple(
            tuple(add(*(mul(derivative(t, u), e) for u, e in weights)) for t in row)
            for row in self.rate
        )
        return Velocity(self.group, rate)

    # -- exact tests ---------------------------------------------------------------------------

    @property
    def tangent(self) -> bool:
        """Is A⁻¹f(A) in the Lie algebra?"""

        def outside(x: Residues) -> Matrix:
            back = q.inverted(x.a)
            z = q.times(back, x.value(self, x.a))
            return q.minus(z, self.group.hat(self.group.nearest(z)))

        return self._vanishes(outside)

    @property
    def group_affine(self) -> bool:
        """Is f(ab) = f(a)b + a f(b) − a f(1)b?"""

        def defect(x: Residues) -> Matrix:
            whole = x.value(self, q.times(x.a, x.b))
            one = x.value(self, q.identity(self.group.size))
            parts = q.plus(q.times(x.value(self, x.a), x.b), q.times(x.a, x.value(self, x.b)))
            return q.plus(q.minus(whole, parts), q.times(q.times(x.a, one), x.b))

        return self._vanishes(defect)

    @property
    def invariant(self) -> str:
        """ "left" where f(A) = A f(1), "right" where it is f(1) A; "" where it is neither."""

        def defect(x: Residues, *, left: bool) -> Matrix:
            one = x.value(self, q.identity(self.group.size))
            moved = q.times(x.a, one) if left else q.times(one, x.a)
            return q.minus(x.value(self, x.a), moved)

        sides = {"left": True, "right": False}
        found = (k for k, v in sides.items() if self._vanishes(lambda x: defect(x, left=v)))  # noqa: B023
        return next(found, "")

    def _vanishes(self, defect: Callable[[Residues], Matrix]) -> bool:
        """Is a matrix 0 at random elements, modulo each prime?"""
        tried = (Residues(self.group, p, k) for k, p in enumerate(PRIMES))
        return not any(x.number(y) for x in tried for row in defect(x) for y in row)

    # -- elements at which it is not so --------------------------------------------------------

    def defect(self, a: Matrix, b: Matrix) -> Rows:
        """f(ab) − f(a)b − a f(b) + a f(1)b, at numbers."""
        A, B = rational(a), rational(b)
        whole, one = self.at(rational(q.times(a, b))), times(times(A, self.at_one), B)
        parts = times(self.at(A), B), times(A, self.at(B))
        return tuple(
            tuple(
                shortened(add(whole[i][j], neg(parts[0][i][j]), neg(parts[1][i][j]), one[i][j]))
                for j in range(len(A))
            )
            for i in range(len(A))
        )

    def counterexample(self) -> Pair:
        """Two elements with small numbers at which f is not group-affine, where it is not."""
        for pair in _pairs(self.group):
            if not all(vanishes(t) for row in self.defect(*pair) for t in row):
                return pair
        raise ValueError("no simple elements at which the velocity is not group-affine")


class Residues:
    """Two random elements a and b of a group modulo a prime, and values there."""

    def __init__(self, group: Group, p: int, seed: int):
        self.p, self.source = p, ResidueVectorSource(p, 1, seed)
        self.a, self.b = (group.sample_inside(self.source, 1) for _ in range(2))

    def number(self, x: Any) -> int:
        """A residue as a number."""
        return int((self.source.constant(0) + x).values[0])

    def value(self, f: Velocity, m: Matrix) -> Matrix:
        """f at a matrix."""
        rows = tuple(tuple(self.number(x) for x in row) for row in m)
        return tuple(
            tuple(self.source.constant(residue(with_entries(t, rows), self.p)) for t in row)
            for row in f.rate
        )


def _pairs(group: Group) -> Iterator[Pair]:
    """Pairs of simple elements of a group, then some of products of two of these."""
    simple = simple_elements(group.basis)
    yield from product(simple, repeat=2)
    twice = [q.times(a, b) for a, b in product(simple, repeat=2)]
    Random(0).shuffle(twice)  # the same each time
    yield from zip(twice, twice[::-1], strict=True)


SIDES = ("L", "R")
"""Left and right, as the names of a record have them."""
BACK: Tree = ("inv", "Â")


def f(t: Tree) -> Tree:
    """The velocity at an element."""
    return ("call", "ℱ", t)


def in_time(t: Tree) -> Tree:
    """The derivative in time."""
    return ("call", "d/dt", t)


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
    first = acting.draft("kinematics", "definition").step(
        [Equation(f("A"), matrix(velocity.rate)), Equation("Ȧ", f("A"))], say("kinematics.stated")
    )
    tangent, errors = _tangent(group, first, acting), _errors(first, acting)
    told = [first, tangent, errors]
    if not velocity.group_affine:
        return (*told, _counterexample(velocity, first, acting))
    affine = _affine(first, acting)
    rates = _error_rates((errors, affine), acting)
    linear = _log_linear(velocity, (rates, tangent), acting)
    noise = _noise(velocity.by_inputs(given.inputs), (first, errors, linear), acting)
    return (*told, affine, rates, linear, noise, _observation(errors, c))


def _tangent(group: Group, first: Step, c: Chapter) -> Step:
    draft = c.draft("tangent", "trivialisation", first)
    carried = Equation("Z", mul(("inv", "A"), f("A")))
    return draft.step([carried, *basis_equations(group)], say("tangent.algebra"))


def _errors(first: Step, c: Chapter) -> Step:
    draft = c.draft("errors", "definition", first)
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
    draft = c.draft("affine", "group-affine", first)
    return draft.step([Equation(f(mul("A", "Â")), _parts())], say("affine.holds"))


def _counterexample(velocity: Velocity, first: Step, c: Chapter) -> Step:
    """The difference at two elements, for all inputs."""
    draft = c.draft("counterexample", "group-affine", first)
    pair = velocity.counterexample()
    where = [Equation(x, matrix(rational(m))) for x, m in zip(("A", "Â"), pair, strict=True)]
    difference = add(f(mul("A", "Â")), neg(_parts()))
    return draft.step(
        [Equation(difference, matrix(velocity.defect(*pair)))], say("affine.fails"), where=where
    )


def _error_rates(made_from: tuple[Step, ...], c: Chapter) -> Step:
    draft = c.draft("error_rates", "error equation", *made_from)
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
        E = rational(e)
        slope, turned = velocity.slope(a), times(one, E) if left else times(E, one)
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
    draft = c.draft("log_linear", "error equation", *made_from)
    moved = [Equation(f"𝒜_{x}", matrix(generator(velocity, left=x == "L"))) for x in SIDES]
    moved += [Equation(in_time(f"ξ_{x}"), mul(f"𝒜_{x}", f"ξ_{x}")) for x in SIDES]
    return draft.step(moved, say("log_linear.both"))


def _noise(slope: Velocity, made_from: tuple[Step, ...], c: Chapter) -> Step:
    """W_L and W_R; that which does not depend on the estimate as it is."""
    draft = c.draft("noise", "error equation", *made_from)
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
    draft = c.draft("observation", "error equation", errors)
    equations = [
        Equation("z_L", add(mul(BACK, "A", "o"), neg("o"))),
        Equation("z_L", add(mul("η_L", "o"), neg("o"))),
        Equation("z_R", add(mul("Â", ("inv", "A"), "o"), neg("o"))),
        Equation(mul("η_R", "z_R"), add("o", neg(mul("η_R", "o")))),
    ]
    return draft.step(equations, say("observation.both"))
