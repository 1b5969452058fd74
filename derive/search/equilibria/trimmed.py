"""Which inputs and velocities keep a state as it is: exact, or within bounds, in the emitted
equations.

Exact: where inputs act linearly, which is tried at other ones, ζ̇ = a + Bu.  At rest, Z = 0,
nothing moves then.  Else g moves on by exp(tY), Y = gZg⁻¹ (on the right g⁻¹Zg), and keeps ζ̇ = 0
where ζ̇ at this velocity and with these inputs is the same at g and at exp(tY)g for every g; which
is tried at a random exact one.  Numbers are of one quadratic field, so that a speed ‖v‖ = √(v·v) is
exact.  Where s = √q is 0 it has no derivative: F(x, s) has then that of F(x, 0) where ∂F/∂s = 0 in
the point, as ‖v‖v, and what is left is small with its differences, which is all that Lyapunov's
theorems need.

Enclosed, where its numbers are no exact ones: Newton's step, with what the derivatives may be
within the bounds, leads from there to inside of them: then one solution is there, and no other
(Krawczyk). As many rates are taken as numbers are free; the others vanish with these where all
rates together, of any such numbers, are of no more dimensions, which is tried at random ones, in
floats; the checker is exact.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from random import Random
from typing import Any

from ...code.program import Program
from ...language import rational as q
from ...language.intervals import Interval, UnknownSignError, function, krawczyk
from ...language.rational import Matrix
from ...language.univariate import Number, Quadratic, RootError
from ...problem.problem import Problem
from .equilibrium_steps import decimal
from .steady_velocity import (
    AT_ZERO,
    DEPENDENT,
    EXACTLY,
    FLOATS,
    SIMPLE,
    Arithmetic,
    NotExactError,
    NoTrimError,
    Rates,
    approximately,
    describe,
    exact,
    solutions,
)
from .trim import Bounds, EnclosedTrim, Question, Trim

EXACT = 2**40
"""A number of a program with a larger power of two below is one that has no fraction, as π."""
NO_PIVOT = 1e-12
"""A determinant or a difference in floats that is smaller, beside the numbers, is 0."""
PRIME = 2**61 - 1
"""p, in the place of a root that is 0: F(x, p) − F(x, 0) is 0 modulo p² where ∂F/∂s is 0."""


class ExactQuestion(Question):
    """The same, in fractions and numbers of one square root."""

    numbers, little = EXACTLY, Fraction(PRIME)

    def answered(self) -> Trim:
        """The trim; ``NoTrimError`` where there is none, or there are many."""
        self.require_element()
        self.require_exact()
        if self.sought:
            self.find_state()
            self.require_element()
        held = self.rates({})
        columns = tuple(self.changed(held, {name: Fraction(1)}) for name in self.free)
        by = {name: Fraction(k * k + 3, 7) for k, name in enumerate(self.free)}
        together = q.times((tuple(by.values()),), columns)[0] if columns else self.changed(held, by)
        if self.changed(held, by) != together:
            raise NotExactError("inputs do not act linearly: give these by --at, or leave them out")
        u = self.with_more(self.solved(columns, held))
        if moving := any(self.x[-self.d :]):
            self.require_steady(self.x, u)
        return Trim(
            dict(zip(self.program.state, self.x, strict=True)),
            dict(zip(self.program.inputs, u, strict=True)),
            self.free,
            self.sought,
            self.linear(self.x, u),
            not moving,
            self.require_slopes(self.x, u),
            self.along,
        )

    def require_exact(self) -> None:
        """``NotExactError`` where the equations have no exact numbers."""
        below = [x.denominator for x in self.program.numbers()]
        fractions = all(x < EXACT or x & (x - 1) for x in below)
        both = (self.program.functions[x].calls() for x in ("rhs", "constants"))
        if (functions := set[str]().union(*both) - {"sqrt", "abs", *AT_ZERO}) or not fractions:
            what = ", ".join(sorted(functions)) or "π, or a root,"
            verb = "are" if len(functions) > 1 else "is"
            raise NotExactError(f"{what} {verb} in the equations")

    def find_state(self) -> None:
        """Put those velocities, and turns of g, in the state with which, and with free inputs, its
        rates vanish."""
        f = self.unknown()
        found = solutions(f, self.near)
        simple = [x.limit_denominator(SIMPLE) for x in found]  # a double root has few digits
        near = all(abs(x - y) < 1 / SIMPLE**2 for x, y in zip(simple, found, strict=True))
        y = simple if near and not any(f.values(simple, EXACTLY)) else exact(f.names, found)
        dependent = q.rank(q.matrix(f.slopes(y, EXACTLY))) < len(y)
        self.x, self.u = self.at(y)  # from there on g would turn once more
        told = ", ".join(f"{x} = {float(v):.8g}" for x, v in zip(f.names, y, strict=True))
        if any(self.rates({})):
            raise NotExactError(f"near {told} a rate is small, and not 0 in numbers of a root")
        if dependent:
            raise NoTrimError(f"at {told} all rates are 0{DEPENDENT}")
        for name in self.free:  # they are found once more, linearly
            self.u[self.program.inputs.index(name)] = Fraction(0)

    @staticmethod
    def of_first_order(change: Number) -> bool:
        """Is a change with p no multiple of p²?"""
        by = change / PRIME
        parts = (by.a, by.b) if isinstance(by, Quadratic) else (by,)
        return any(part.numerator % PRIME for part in parts)

    def solved(self, columns: Matrix, held: Sequence[Number]) -> dict[str, Number]:
        """The free inputs by name, of which each moves ζ̇ by a row of ``columns``."""
        velocity = self.program.state[-self.d :]
        if not columns:
            self.require_rest([str(x) if x else "" for x in held])
            return {}
        for row in q.nullspace(columns):
            if left := q.dot(row, held):
                scale = next(x for x in row if x)
                terms = " + ".join(
                    (f"({x / scale}) " if x != scale else "") + f"d{n}/dt"
                    for x, n in zip(row, velocity, strict=True)
                    if x
                )
                verb = "are" if len(self.free) > 1 else "is"
                whatever = f"whatever {', '.join(self.free)} {verb}"
                terms = re.sub(r"\+ \(-([\d/]+)\)", r"- (\1)", terms)
                raise NoTrimError(f"no trim: {terms} is {left / scale}, {whatever}")
        if many := q.nullspace(q.transposed(columns)):
            along = "; ".join(f"({', '.join(map(str, x))})" for x in many)
            raise NoTrimError(
                f"many trims: a family of dimension {len(many)}, for multiples of {along} of "
                f"({', '.join(self.free)}) change nothing; give {len(many)} of these by --at"
            )
        u = q.solve(q.transposed(columns), q.column([-x for x in held]))
        assert u
        return dict(zip(self.free, (x for (x,) in u), strict=True))


INTERVALS = Arithmetic(Interval.of, function)
LITTLE = Fraction(1, 2**100)
DIGITS = 11
"""The radius is a power of ten, so many times smaller than the largest number."""
REFINED = 4
"""So often the bounds are made narrower, squared each time."""
TRIED, TOLERANCE = 40, 1e-9
"""At so many random numbers rates are taken; singular values that are smaller, beside the largest,
are 0."""
Box = list[Interval]


class EnclosedQuestion(Question):
    """A question whose answer is within bounds."""

    numbers, little = INTERVALS, LITTLE

    def answered(self, why: str) -> EnclosedTrim:
        """The trim; ``NoTrimError`` where none is proved, with ``why`` it is not exact."""
        f = self.unknown()
        if not f.names:
            rates = [*map(Interval.of, self.rates({}))]
            self.require_rest([f"about {float(x.middle):.8g}" if x.sign else "" for x in rates])
            rest = "the rates of the velocity are 0 there, and its stability is not told"
            if exactly := all(x.size == 0 for x in rates):
                self.require_element()
                self.require_steady(self.x, self.u)
            within = "such a trim is found within bounds; say by --free what may change"
            raise NoTrimError(f"{rest}: {why}" if exactly else f"{why}: {within}")
        try:
            self.require_element()
            y = approximately(f, self.near, INTERVALS)
            radius = _radius(y)
            near = [decimal(x, radius) for x in y]
            box = self.enclosed(f, near, radius)
            x, u = self.at(box)
            self.require_slopes(x, u)
            matrix = self.linear(x, u)
        except (UnknownSignError, ZeroDivisionError):
            told = "a root or a divisor in what acts may be 0, as the speed of what stands still is"
            raise NoTrimError(self._still() or f"{why}; and within bounds {told}") from None
        velocity = x[-self.d :]
        if moving := any(velocity):
            random = Random(1)
            self.require_steady(*self.at([a + random.gauss(0, 1 + abs(a)) for a in y]))
        return EnclosedTrim(
            dict(zip(self.program.state, x, strict=True)),
            dict(zip(self.program.inputs, u, strict=True)),
            self.free,
            self.sought,
            tuple(tuple(map(Interval.of, row)) for row in matrix),
            not moving,
            corner=False,
            along=self.along,
            near=dict(zip(f.names, near, strict=True)),
            start=dict(zip(self.program.state, self.beside, strict=True)),
            changed=tuple(
                name
                for name, a, b in zip(self.program.state, x, self.x, strict=True)
                if name in self.places and isinstance(a, Interval) and a != b
            ),
            radius=radius,
            right=self.right,
        )

    @staticmethod
    def of_first_order(change: Any) -> bool:
        """Is it beside a little more than what its square changes?"""
        return Interval.of(change).size > LITTLE / 2**40

    def _still(self) -> str:
        """That factors without a turn stand still while others turn, in words; "" where none do."""
        velocity, first, still, turns = self.program.state[-self.d :], 0, [], False
        Z = self.group.hat(self.x[-self.d :])
        for k, (offset, factor) in enumerate(self.group.places, 1):
            at = slice(offset, offset + factor.n)
            turns = turns or any(any(row[at]) for row in Z[at])
            part = slice(first, first := first + factor.dimension)
            kept = not any(self.x[-self.d :][part]) and not {*velocity[part]} & {*self.velocities}
            still += [f"{factor.name} of block {k}"] * (not factor.linear_basis and kept)
        if not still or not turns:
            return ""
        return (
            f"no trim is proved: {' and '.join(still)} has no turn, and stands still while the "
            "rest circles, so that a speed is 0 in what acts; what shall circle, too, must move by "
            "a group with turns, as SE(3)"
        )

    def enclosed(self, f: Rates, near: Sequence[Fraction], radius: Fraction) -> Box:
        """Narrow bounds of the one solution within a radius; ``NoTrimError`` where that is not
        proved."""
        rows = self.independent(f, near)
        box = [Interval.about(x, radius) for x in near]
        for k in range(REFINED):
            smaller = _newton_step(f, box, rows)
            if not k and not all(x.within(y) for x, y in zip(smaller, box, strict=True)):
                told = describe(f, [*map(float, near)])
                raise NoTrimError(
                    f"near {told} rates are small; that they vanish is not proved, as at a double "
                    "root, which the least change takes away or makes two"
                )
            box = smaller
        return box

    def independent(self, f: Rates, near: Sequence[Fraction]) -> list[int]:
        """The numbers of as many rates as there are free numbers, with which all others vanish."""
        import numpy as np

        slopes = np.array(f.slopes([*map(float, near)], FLOATS), dtype=float)
        rows: list[int] = []
        left = slopes.copy()
        for _ in f.names:
            rows.append(int(np.argmax((left * left).sum(axis=1))))
            along = left[rows[-1]] / np.linalg.norm(left[rows[-1]])
            left = left - np.outer(left @ along, along)
        random, taken = Random(2), []
        for _ in range(TRIED):
            try:
                y = [float(x) + random.gauss(0, 1 + abs(float(x))) for x in near]
                taken.append([*map(float, f.values(y, FLOATS))])
            except (ValueError, ArithmeticError):
                continue
        values = np.linalg.svd(np.array(taken).reshape(-1, self.d), compute_uv=False)
        rank = int((values > TOLERANCE * values[0]).sum()) if len(values) else self.d
        if rank > len(rows):
            raise NoTrimError(
                f"the rates are of {rank} dimensions, and {len(rows)} "
                f"{'numbers are' if len(rows) > 1 else 'number is'} free ({', '.join(f.names)}): "
                "free as many, or give exact numbers"
            )
        return sorted(rows)


def _newton_step(f: Rates, box: Box, rows: Sequence[int]) -> Box:
    """Krawczyk's operator for some of the rates."""
    there = f.values([x.middle for x in box], INTERVALS)
    slopes = f.slopes(box, INTERVALS)
    found = krawczyk(box, [there[i] for i in rows], [slopes[i] for i in rows])
    if found is None:
        raise NoTrimError("that there are no others near is not proved; free fewer")
    return found


def _radius(y: Sequence[float]) -> Fraction:
    """A power of ten, small beside the largest of these."""
    largest, power = max(1.0, *map(abs, y)), 0
    while 10**power < largest:
        power += 1
    return Fraction(10) ** (power - DIGITS)


def trimmed(
    problem: Problem,
    program: Program,
    at: Mapping[str, Number],
    free: Sequence[str] | None = None,
    bounds: Bounds | None = None,
    along: Mapping[str, Number] | None = None,
) -> Trim:
    """The inputs, velocities and turns of g ``free``, or all inputs that are not given, for a state
    and other inputs: those ``at`` has, else g = 1 and 0; ``along``: a velocity in space, Y of the
    motion exp(tY)g, on the right g exp(tY), beside which those stand; ``program``: with its
    jacobian.
    ``NoTrimError`` where there is none, or several, or one outside of ``bounds``."""
    given = problem, program, at, free, bounds or {}, along or {}
    found: Trim
    question: ExactQuestion | EnclosedQuestion
    try:
        question = ExactQuestion(*given)
        found = question.answered()
    except (NotExactError, RootError) as error:
        question = EnclosedQuestion(*given)
        found = question.answered(str(error))
    except ZeroDivisionError:
        if singular_mass(question):
            why = "the mass matrix is singular in this state: a velocity has no kinetic energy"
            raise NoTrimError(why) from None
        raise NoTrimError("what acts has no value in this state: it divides by 0") from None
    numbers = {**found.state, **found.inputs}
    radius = found.radius if isinstance(found, EnclosedTrim) else 0
    if outside := [
        f"{name} is {_as_decimals(numbers[name], found)}, and --bounds allows "
        + " to ".join(map(str, question.bounds[name]))
        for name in question.outside(numbers, radius)
    ]:
        which = "the trim that is found" if found.sought else "the trim"
        raise NoTrimError(f"{which} is out of bounds: {'; '.join(outside)}")
    return found


def singular_mass(question: Question) -> bool:
    """Is the mass matrix singular in the state?  No where it has no value either."""
    d = question.d
    try:
        found = [
            float(y) for y in question.evaluated("mass_matrix", question.x, question.u, FLOATS)
        ]
    except (ZeroDivisionError, ValueError, OverflowError):
        return False
    largest = max(map(abs, found))
    M = q.matrix([[float(y) for y in found[a * d : a * d + d]] for a in range(d)])
    return bool(abs(q.determinant(M)) <= NO_PIVOT * largest**d)


def _as_decimals(x: Number, found: Trim) -> str:
    """A number with its decimals, of an enclosed trim these alone."""
    if isinstance(found, EnclosedTrim):
        return f"about {float(x):.6g}"
    return str(x) if float(x).is_integer() else f"{x}, about {float(x):.6g}"
