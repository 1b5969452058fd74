"""An equilibrium under inputs, solved exactly, in the emitted equations.

Where inputs act linearly, which is tried at other ones, ζ̇ = a + Bu.  At rest, Z = 0, nothing moves
then.  Else g moves on by exp(tY), Y = gZg⁻¹ (on the right g⁻¹Zg), and keeps ζ̇ = 0 where ζ̇ at this
velocity and with these inputs is the same at g and at exp(tY)g for every g; which is tried at a
random exact one.

Numbers are of one quadratic field, so that a speed ‖v‖ = √(v·v) is exact.  Where s = √q is 0 it has
no derivative: F(x, s) has then that of F(x, 0) where ∂F/∂s = 0 in the point, as ‖v‖v, and what is
left is small with its differences, which is all that Lyapunov's theorems need.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...language.univariate import Number, Quadratic
from .question import EXACTLY, Question, function_with_corner
from .steady_velocity import NotExactError, NoTrimError, exact, solutions
from .trim import Trim

EXACT = 2**40
"""A number of a program with a larger power of two below is one that has no fraction, as π."""
PRIME = 2**61 - 1
"""p, in the place of a root that is 0: F(x, p) − F(x, 0) is 0 modulo p² where ∂F/∂s is 0."""


class ExactQuestion(Question):
    """The same, in fractions and numbers of one square root."""

    numbers = EXACTLY

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
            self.has_corner(u),
        )

    def require_exact(self) -> None:
        """``NotExactError`` where the equations have no exact numbers."""
        below = [x.denominator for x in self.program.numbers()]
        fractions = all(x < EXACT or x & (x - 1) for x in below)
        both = (self.program.functions[x].calls() for x in ("rhs", "constants"))
        if (functions := set[str]().union(*both) - {"sqrt", "abs"}) or not fractions:
            what = ", ".join(sorted(functions)) or "π, or a root,"
            verb = "are" if len(functions) > 1 else "is"
            raise NotExactError(f"{what} {verb} in the equations")

    def find_state(self) -> None:
        """Put those velocities, and turns of g, in the state with which, and with free inputs, its
        rates vanish."""
        f = self.unknown()
        y = exact(f.names, solutions(f, self.near))
        self.x, self.u = self.at(y)
        if any(self.rates({})):
            told = ", ".join(f"{x} = {float(v):.8g}" for x, v in zip(f.names, y, strict=True))
            raise NotExactError(f"near {told} a rate is small, and not 0 in numbers of a root")
        if q.rank(q.matrix(f.slopes(y, EXACTLY))) < len(y):
            raise NoTrimError("many trims: others are near this one; free fewer")
        for name in self.free:  # they are found once more, linearly
            self.u[self.program.inputs.index(name)] = Fraction(0)

    def has_corner(self, u: Sequence[Number]) -> bool:
        """Is a root 0 in the state?  ``NoTrimError`` where the rates have no derivative then."""
        met: list[str] = []

        def call(name: str, x: Any) -> Any:
            if x == 0 and name in ("sqrt", "abs"):
                met.append(name)
            return function_with_corner(PRIME)(name, x)

        bending = replace(EXACTLY, call=call)
        held, bent = (self.evaluated("rhs", self.x, u, f) for f in (EXACTLY, bending))
        triples = zip(self.program.state, held, bent, strict=True)
        for name, x, y in [*triples][-self.d :]:
            by = (y - x) / PRIME
            parts = (by.a, by.b) if isinstance(by, Quadratic) else (by,)
            if any(part.numerator % PRIME for part in parts):
                raise NoTrimError(
                    f"d{name}/dt has no derivative there: a root is 0, and not a factor of what is"
                )
        return bool(met)

    def solved(self, columns: Matrix, held: Sequence[Number]) -> dict[str, Number]:
        """The free inputs by name, of which each moves ζ̇ by a row of ``columns``."""
        velocity = self.program.state[-self.d :]
        for row in q.nullspace(columns) if columns else q.identity(self.d):
            if left := q.dot(row, held):
                scale = next(x for x in row if x)
                terms = " + ".join(
                    (f"({x / scale}) " if x != scale else "") + f"d{n}/dt"
                    for x, n in zip(row, velocity, strict=True)
                    if x
                )
                free = ", ".join(self.free)
                verb = "are" if len(self.free) > 1 else "is"
                whatever = f"whatever {free} {verb}" if free else "no input is free"
                raise NoTrimError(f"no trim: {terms} is {left / scale}, {whatever}")
        if not columns:
            return {}
        if many := q.nullspace(q.transposed(columns)):
            along = "; ".join(f"({', '.join(map(str, x))})" for x in many)
            raise NoTrimError(
                f"many trims: a family of dimension {len(many)}, for multiples of {along} of "
                f"({', '.join(self.free)}) change nothing; give {len(many)} of these by --at"
            )
        u = q.solve(q.transposed(columns), q.column([-x for x in held]))
        assert u
        return dict(zip(self.free, (x for (x,) in u), strict=True))
