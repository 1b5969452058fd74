"""An equilibrium under inputs whose numbers are no exact ones: that there is one, within bounds.

Newton's step, with what the derivatives may be within the bounds, leads from there to inside of
them: then one solution is there, and no other (Krawczyk).  As many rates are taken as numbers are
free; the others vanish with these where all rates together, of any such numbers, are of no more
dimensions, which is tried at random ones, in floats; the checker is exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from random import Random
from typing import Any

from ...language.intervals import Interval, UnknownSignError, function, krawczyk
from .question import Question
from .steady_velocity import FLOATS, Arithmetic, NoTrimError, Rates, approximately, describe
from .trim import EnclosedTrim

INTERVALS = Arithmetic(Interval.of, function)
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

    numbers = INTERVALS

    def answered(self, why: str) -> EnclosedTrim:
        """The trim; ``NoTrimError`` where none is proved, with ``why`` it is not exact."""
        f = self.unknown()
        if not f.names:
            raise NoTrimError(
                f"{why}: such a trim is found within bounds; say by --free what may change"
            )
        try:
            self.require_element()
            y = approximately(f, self.near)
            radius = _radius(y)
            near = [_decimal(x, radius / 10) for x in y]
            box = self.enclosed(f, near, radius)
            x, u = self.at(box)
            matrix = self.linear(x, u)
        except (UnknownSignError, ZeroDivisionError) as error:
            raise NoTrimError(f"{why}; and within bounds {error}") from None
        velocity = x[-self.d :]
        if moving := any(velocity):
            random = Random(1)
            self.require_steady(*self.at([a + random.gauss(0, 1 + abs(a)) for a in y]))
        return EnclosedTrim(
            dict(zip(self.program.state, (_told(a, radius) for a in x), strict=True)),
            dict(zip(self.program.inputs, (_told(a, radius) for a in u), strict=True)),
            self.free,
            self.sought,
            tuple(tuple(map(Interval.of, row)) for row in matrix),
            not moving,
            corner=False,
            near=dict(zip(f.names, near, strict=True)),
            start=dict(zip(self.program.state, self.x, strict=True)),
            changed=tuple(
                name
                for name, a, b in zip(self.program.state, x, self.x, strict=True)
                if name in self.places and isinstance(a, Interval) and a != b
            ),
            radius=radius,
            right=self.right,
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
                raise NoTrimError(f"near {told} rates are small; that they vanish is not proved")
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
        raise NoTrimError("many trims: others may be near this one; free fewer")
    return found


def _radius(y: Sequence[float]) -> Fraction:
    """A power of ten, small beside the largest of these."""
    largest, power = max(1.0, *map(abs, y)), 0
    while 10**power < largest:
        power += 1
    return Fraction(10) ** (power - DIGITS)


def _decimal(x: Any, unit: Fraction) -> Fraction:
    """The multiple of a unit that is nearest."""
    return round(Fraction(x) / unit) * unit


def _told(x: Any, radius: Fraction) -> Any:
    """A number as it is told: an exact one, or decimals."""
    return _decimal(x.middle, radius / 10) if isinstance(x, Interval) else x
