"""Checks of a body on its group: does every direction move some mass, is its metric invariant?"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import gcd, lcm
from random import Random
from typing import Any, Literal

from ..algebra.groups import Group
from ..algebra.relations import for_every_body, pairings, skew
from ..language import rational as q
from ..language.derivatives import DIVISOR_PRIMES, residue
from ..language.expression import names
from ..language.laurent import TRIED, OverlongError, at_levels, is_layered, vanishes
from ..language.rational import Matrix
from ..language.tree import Tree, add, mul, nodes, plain, replaced
from ..language.values import approximate, elementary, value
from ..schema.body_kinds import Body, GivenBody, MomentBody, PointBody
from ..schema.kind import Parameter
from .problem import Problem, ProblemError, points_of
from .solids import fault_of_quadric

Vector = tuple[Any, ...]

ROUNDED, DIGITS, DOUBLES = 10**9, 10**3, 10**13
"""One over the relative error that is allowed: of floats, and of moments in few digits; and, as
``constants`` of the emitted code has it, of a metric."""
LARGEST_SHOWN = 3
"""The rows of the largest matrix that a message writes out."""


def still_direction(group: Group, body: Body) -> str | None:
    """The direction that moves no mass, in words; ``None`` when every one moves some."""
    if isinstance(body, MomentBody):
        return None
    if isinstance(body, PointBody) and (empty := _empty_block(group, body)):
        return empty
    used = dict.fromkeys(x for t in _trees(body) for x in names(t))
    chosen = {name: Fraction(k) for k, name in enumerate(used, 2)}
    found = _kernel(group, body, _Values(chosen))
    if found is None:
        return None
    random = Random(1)
    drawn = {name: Fraction(random.randint(1, 10**6), random.randint(1, 10**6)) for name in used}
    again = _kernel(group, body, _Values(drawn))
    if again is None:
        return None  # singular at the first choice of the parameters, not at all of them
    where = ", ".join(f"{name} = {x}" for name, x in chosen.items())
    return _words(group, found) + (f" (at {where})" if found != again else "")


def _empty_block(group: Group, body: PointBody) -> str | None:
    """The first factor of a product that has no point, in words; ``None`` for none such."""
    for block, (_, factor) in enumerate(group.places, 1):
        if all(p.block != block for p in body.points):
            return f"block {block}, {factor.name}, which has no [[point]] with block = {block},"
    return None


def _kernel(group: Group, body: Body, values: _Values) -> Vector | None:
    """The coordinates of the first direction in the metric's kernel; ``None`` if it is 0."""
    try:
        m = _moments(group, body, values)
    except ZeroDivisionError:
        return None
    if q.rank(m) == len(m) and not values.negative:
        return None
    kernel = q.nullspace(_metric(group, m))
    return kernel[0] if kernel else None


def _metric(group: Group, moments: Matrix) -> Matrix:
    """Tr E_a m Ē_b."""
    images = [q.times(e, moments) for e in group.basis]
    return tuple(tuple(_inner(image, f) for f in group.basis) for image in images)


def metric_is_positive(
    group: Group, body: Body, values: Mapping[str, float], t: float = 0.0
) -> bool:
    """Is the metric at g = 1 and a time positive, by more than rounding, for some ``values`` of
    the parameters?  Yes, where it has no value."""
    known = {name: Fraction(x) for name, x in values.items()}
    try:
        metric = _metric(group, _moments(group, body, _Numbers(known, Fraction(t))))
    except (ArithmeticError, ValueError):
        return True
    span = range(len(metric))
    rounding = [[abs(metric[i][i]) / DOUBLES * (i == j) for j in span] for i in span]
    return q.definite(q.minus(metric, q.matrix(rounding)))


def _inner(a: Matrix, b: Matrix) -> Fraction:
    pairs = zip(q.flatten(a), q.flatten(b), strict=True)
    return sum((x * y for x, y in pairs if x and y), Fraction(0))


def _moments(group: Group, body: Body, values: _Values) -> Matrix:
    """The matrix Σ m r r̄ with r as the group's matrices act on it, (r, 1) for an affine one."""
    if isinstance(body, PointBody):
        total = q.scaled(0, q.identity(group.size))
        for p in body.points:
            place = group.in_block(p.block, [values.of(x) for x in p.at], Fraction(1))
            column = tuple((x,) for x in (*place, *(Fraction(1),) * group.affine))
            weight = values.mass(p.mass)
            total = q.plus(total, q.scaled(weight, q.times(column, q.transposed(column))))
        return total
    assert isinstance(body, GivenBody)
    J = tuple(tuple(values.of(x) for x in row) for row in body.given.J)
    if group.size == len(J) and not group.factors:
        return J
    c, m = tuple(values.of(x) for x in body.given.c), values.mass(body.given.m)
    return (*((*row, x) for row, x in zip(J, c, strict=True)), (*c, m))[: len(J) + 1]


def _trees(body: PointBody | GivenBody) -> list[Tree]:
    return (body.given if isinstance(body, GivenBody) else body).trees()


class _Values:
    """Trees to fractions; each function of each argument, and π, is a random number of its own."""

    def __init__(self, parameters: Mapping[str, Fraction], t: Fraction = Fraction(0)):
        self.parameters, self.t = parameters, t
        self.negative = False
        self._own: dict[tuple[Fraction | str, ...], Fraction] = {}
        self._random = Random(2)

    def mass(self, t: Tree) -> Fraction:
        """The value of a mass; ``negative`` remembers whether one was."""
        mass = self.of(t)
        self.negative |= mass < 0
        return mass

    def of(self, t: Tree) -> Fraction:
        """The value of a tree, at its time."""
        known = {"π": self._opaque("π"), "t": self.t}
        return Fraction(value(t, known, self.parameters, self._opaque))

    def _opaque(self, *function: Fraction | str) -> Fraction:
        return self._own.setdefault(function, Fraction(self._random.randint(1, 999), 1000))


class _Numbers(_Values):
    """Trees to the fractions that their values are in floats."""

    def _opaque(self, *function: Fraction | str) -> Fraction:
        name, *at = function
        return Fraction(elementary(str(name), float(*at)) if at else math.pi)


def _words(group: Group, coordinates: Vector) -> str:
    """A direction in words: an axis for rotations of space, else the matrix Z."""
    x = _in_integers(coordinates)
    if len(group.factors) > 1:
        start = 0
        for block, factor in enumerate(group.factors, 1):
            part, start = x[start : start + factor.dimension], start + factor.dimension
            if sum(map(bool, part)) == sum(map(bool, x)):
                return f"in block {block}, {_words(factor, part)}"
    if group.turns_space:
        turn, shift = x[:3], x[3:]
        if not any(turn):
            return f"the translation along {_listed(shift)}"
        if any(shift):
            return f"turning about {_axis(turn, shift)}"
        return f"turning about the axis {_listed(turn)}"
    Z = group.hat(x)
    if len(Z) > LARGEST_SHOWN:
        entries = ((y, i, j) for i, row in enumerate(Z, 1) for j, y in enumerate(row, 1) if y)
        terms = (f"{'+-'[y < 0]} {abs(y) if abs(y) != 1 else ''}e_{i},{j}" for y, i, j in entries)
        shown = " ".join(terms).removeprefix("+ ")
        return f"the direction Z = {shown} of the Lie algebra (e_i,j: a 1 in row i, column j)"
    rows = ", ".join("[" + ", ".join(str(y) for y in row) + "]" for row in Z)
    return f"the direction Z = [{rows}] of the Lie algebra"


def _axis(turn: Vector, shift: Vector) -> str:
    """The axis where ζ ∧ r + w vanishes, in words, or the screw when it nowhere does."""
    foot = tuple(y / sum(x * x for x in turn) for y in _cross(turn, shift))
    still = all(x + y == 0 for x, y in zip(_cross(turn, foot), shift, strict=True))
    if still:
        return f"the axis through {_listed(foot)} along {_listed(turn)}"
    return f"the screw ζ = {_listed(turn)}, w = {_listed(shift)}"


def _cross(a: Vector, b: Vector) -> Vector:
    return tuple(a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1)))


def _in_integers(x: Vector) -> Vector:
    """The direction in the smallest integers, the first that is not zero positive."""
    up = [int(y * lcm(*(y.denominator for y in x))) for y in x]
    sign = next(1 if y > 0 else -1 for y in up if y)
    return tuple(Fraction(sign * y // gcd(*up)) for y in up)


def _listed(x: Vector) -> str:
    return "(" + ", ".join(map(str, x)) + ")"


def negative_mass(body: Body | None, parameters: Mapping[str, Parameter]) -> str | None:
    """Where a mass is negative, for the defaults of the parameters, at the time 0 where it flows;
    ``None`` when nowhere."""
    if isinstance(body, (GivenBody, MomentBody)) and _starts_negative(body.moments().m, parameters):
        return "body: the mass"
    if isinstance(body, MomentBody):
        squares = ((f"J_{i}{i}", row[i - 1]) for i, row in enumerate(body.moments().J, 1))
        found = (name for name, t in squares if is_negative(t, parameters))
        return next((f"body: the moment {name}" for name in found), None)
    for solid in body.solids if isinstance(body, GivenBody) else ():
        for level, density in at_levels(solid.density) if is_layered(solid.density) else ():
            if is_negative(density, parameters):
                before = f", though not at {level - Fraction(1, TRIED)}," if level else ""
                return f"body: the density of the {solid.kind} at the level s = {level}{before}"
    where = (k for k, p in enumerate(points_of(body), 1) if _starts_negative(p.mass, parameters))
    return next((f"point {k}: key 'mass'" for k in where), None)


def is_negative(t: Tree, parameters: Mapping[str, Parameter]) -> bool:
    """Is it negative for the defaults of the parameters? No, where one has none."""
    found = approximate(t, defaults(parameters))
    return found is not None and found < 0


def _starts_negative(mass: Tree, parameters: Mapping[str, Parameter]) -> bool:
    """The same at the time 0, for a mass that flows."""
    return is_negative(replaced(mass, "t", 0), parameters)


def defaults(parameters: Mapping[str, Parameter]) -> dict[str, float]:
    """Name → the default of a parameter that has one."""
    return {name: p.default for name, p in parameters.items() if p.default is not None}


def massless(body: Body) -> bool:
    """Is the mass the number 0?"""
    masses = [p.mass for p in body.points] if isinstance(body, PointBody) else [body.moments().m]
    numbers = [Fraction(x) for x in masses if isinstance(x, (int, Fraction))]
    return len(numbers) == len(masses) and sum(numbers) == 0


def fault_of_quadrics(body: Body | None, values: Mapping[str, float], whose: str) -> str:
    """What is wrong with an ellipsoid of the body for some ``values`` of the parameters, which are
    ``whose``; "" if nothing is."""
    solids = body.solids if isinstance(body, GivenBody) else ()
    quadrics = (x.sizes["quadric"] for x in solids if "quadric" in x.sizes)
    return next(filter(None, (fault_of_quadric(Q, values, whose) for Q in quadrics)), "")


def impossible(group: Group, body: Body | None, parameters: Mapping[str, Parameter]) -> str:
    """Why no masses have the moments, for the defaults of the parameters and at the time 0; ""
    where some have, or where that is not known: J_c = J − m⁻¹cc̄ is not negative but for few
    digits, nor is any kinetic energy ½ Tr Z J_c Z̄."""
    if body is None or isinstance(body, PointBody):
        return ""
    trees = body.moments().trees()
    when = " at t = 0" * any("t" in nodes(t) for t in trees)
    found = [approximate(replaced(t, "t", 0), defaults(parameters)) for t in trees]
    numbers = [Fraction(x) for x in found if x is not None]
    if len(numbers) < len(trees):
        return ""
    n = len(body.moments().c)
    m, c, J = numbers[0], numbers[1 : n + 1], [numbers[n * k + 1 :][:n] for k in range(1, n + 1)]
    if m == 0:
        why = "where the mass is 0, all are 0" * (any(c) or any(map(any, J)))
    else:
        span = range(n)
        why = _negative(group, [[J[i][j] - c[i] * c[j] / m for j in span] for i in span])
    drawn = isinstance(body, GivenBody) and n == 3 and m > 0 and not body.given.central
    drawn = drawn and not _negative(group, J)
    return f"no masses have these moments{when}: {why}{f'; {CAD}' * drawn}" if why else ""


def require_masses(problem: Problem, *, any_sign: bool) -> None:
    """``ProblemError`` for a direction without inertia, and for masses that cannot be."""
    moved, its_body = problem.group, problem.body
    values = defaults(problem.parameters)
    if fault := fault_of_quadrics(its_body, values, "the defaults"):
        raise ProblemError(f"body: {fault}")
    if moved and its_body and (still := still_direction(moved, its_body)):
        raise ProblemError(
            f"{still} has no kinetic energy together with any motion: the metric of these masses, "
            "some of them negative, is degenerate at g = 1; change them"
            if any_sign
            else f"{still} moves no mass of this body: its motion is open; add masses, or where it "
            "is a symmetry give L in a [lagrangian] instead, with forces at places beside it"
        )
    if moved and its_body and moved.free_translations and massless(its_body):
        raise ProblemError("body: its mass is 0, and it has no centre of mass; change the masses")
    if not moved or any_sign or not isinstance(its_body, GivenBody):
        return
    fault = impossible(moved, its_body, problem.parameters)
    if fault and its_body.solids:
        raise ProblemError(
            "body: no masses have the moments of these solids: what has a negative density must be "
            "a hole inside of others; or allow it with --allow-negative-mass"
        )
    if fault and not any(names(t) for t in its_body.trees()):  # of defaults it is a doubt
        raise ProblemError(f"body, given: {fault}")


def doubt_of_metric(second: Sequence[Sequence[Tree]], parameters: Mapping[str, Parameter]) -> str:
    """Is the matrix ``second`` of the second derivatives of L by the velocity not positive for the
    defaults of the parameters, and how, or singular as it is not for others; "" where it is
    positive, or where that is not known."""
    given = defaults(parameters)
    M = _evaluated(second, given)
    if M is None:
        return ""
    least = _least(M)
    if least < -sum(abs(M[k][k]) for k in range(len(M))) / ROUNDED:
        told = f"its matrix has the eigenvalue {float(least):.4g}"
        return f"the kinetic energy is negative in some direction: {told}"
    elsewhere = _evaluated(second, {x: math.sqrt(k + 1 / 3) for k, x in enumerate(given, 1)})
    if elsewhere and q.rank(q.matrix(M)) < q.rank(q.matrix(elsewhere)):
        return "the kinetic energy is 0 in some direction for the values of the parameters"
    return ""


def _evaluated(
    second: Sequence[Sequence[Tree]], values: Mapping[str, float]
) -> list[list[Fraction]] | None:
    found = [[approximate(t, values) for t in row] for row in second]
    if any(x is None for row in found for x in row):
        return None
    return [[Fraction(x) for x in row if x is not None] for row in found]


CAD = (
    "with c as the centre of mass and the moments about it, as CAD programs give them, they would "
    "be: then write centre and I_centre"
)


def _negative(group: Group, J: list[list[Fraction]]) -> str:
    """Where J, about the centre, is negative, in words; "" if it is not."""
    trace = sum((J[k][k] for k in range(len(J))), Fraction(0))
    basis, least = group.linear_basis, _least(J)
    images = [q.times(z, tuple(map(tuple, J))) for z in basis]
    kinetic = _least([[_inner(x, z) for z in basis] for x in images])
    if least >= -trace / DIGITS and kinetic >= -trace / ROUNDED:
        return ""
    if len(J) != 3:
        return f"J − c c̄/m must be positive, and has the eigenvalue {float(least):.4g}"
    return (
        "J − c c̄/m must be positive (about the centre no moment of inertia exceeds the sum of the "
        f"two others: {float(trace - least):.6g} is above {float(trace + least):.6g})"
    )


def _least(a: list[list[Fraction]]) -> Fraction:
    """The least eigenvalue of a symmetric matrix where that is negative, else 0; by bisection."""
    zero = Fraction(0)
    low, high = zero, max((sum(map(abs, row), zero) for row in a), default=zero)
    if q.semidefinite(a):
        return zero
    for _ in range(DIGITS.bit_length() * 3):
        s = (low + high) / 2
        shifted = [[x + s * (i == j) for j, x in enumerate(row)] for i, row in enumerate(a)]
        low, high = (low, s) if q.semidefinite(shifted) else (s, high)
    return -high


# Left-invariance of the metric of a body on its group, where C = ĀA is not 1.
#
# Decided exactly, in polynomials of the parameters.

Bodies = Literal["every body", "this body"]
EVERY: Bodies = "every body"
THIS: Bodies = "this body"


def invariant(problem: Problem) -> Bodies | None:
    """For which bodies, this one among them, Tr Y J Ȳ′ C = Tr Y J Ȳ′ for all Y, Y′ of 𝔤.

    ``None`` where not for this one, or where to tell would take polynomials that are too long.
    """
    group, body = problem.group, problem.body
    if group is None or body is None or group.affine or skew(group):
        return None
    if for_every_body(group):
        return EVERY
    if group.larger:
        return None
    J = _moment_trees(problem, body)
    try:
        return THIS if all(_vanishes(_paired(k, J)) for k in pairings(group)) else None
    except (OverlongError, ZeroDivisionError):
        return None


def _paired(k: Matrix, J: tuple[tuple[Tree, ...], ...]) -> Tree:
    """The tree Σ k_ij J_ij."""
    pairs = zip(k, J, strict=True)
    return add(*(mul(plain(x), t) for a, b in pairs for x, t in zip(a, b, strict=True) if x))


def _vanishes(t: Tree) -> bool:
    """Is it 0 for all parameters? A residue that is not 0 settles it without multiplying out."""
    return residue(t, DIVISOR_PRIMES[0]) == 0 and vanishes(t)


def _moment_trees(problem: Problem, body: Body) -> tuple[tuple[Tree, ...], ...]:
    """The matrix Σ m r r̄ with r as the matrices of the group act on it."""
    group = problem.own_group
    if isinstance(body, PointBody):
        masses = [(p.mass, group.in_block(p.block, p.at, 1)) for p in body.points]
        span = range(group.n)
        return tuple(
            tuple(add(*(mul(m, r[i], r[j]) for m, r in masses)) for j in span) for i in span
        )
    return body.moments().J
