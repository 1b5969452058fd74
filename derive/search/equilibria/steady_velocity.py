"""Velocities that stay as they are, by Newton's method, and as exact numbers.

In floats from a few starts, then in fractions to many digits; a number is read off these digits, as
a fraction or a root of a quadratic equation.  Nothing of this is proved: whoever asks puts the
exact numbers in.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import isqrt
from random import Random
from typing import Any

from ...language import rational as q
from ...language.limits import Refused
from ...language.univariate import Number, Quadratic, RootError, root

BITS = 400
"""Digits after the point, in fractions."""
STEPS, LAST = 60, 5
"""The most steps in floats; steps in fractions, each of which doubles the digits."""
STARTS = (1.0, 10.0)
"""The sizes of velocities from which it begins, with all signs where these are few."""
SIGNED = 4
INPUTS = (1.0, -1.0, 10.0)
"""Those of inputs beside 0, where they act other than linearly, as by their squares."""
SAME, SMALL, ROUNDING = 1e-6, 1e-10, 1e-12
"""Two solutions so near are one; a step of this part of a number is none; sums are so exact."""
LARGEST = 10**15
"""Of fractions and coefficients."""
SIMPLE = 1000
"""Fractions with a divisor of at most this are tried where digits are few."""
BETWEEN, TURN = 8, 4.0
"""From so many numbers between the bounds it begins, the middle and random ones; and, where nothing
within these is found, from random turns, of Cayley's transform, of this size."""
AWAY = (0.25, 0.5, -0.25, -0.5)
"""How far others of a family are looked for, beside 1 and the numbers; two are taken for one."""

DEPENDENT = (
    ", and their derivatives by these are dependent, as at a double root: that there are no others "
    "near is not proved; give these numbers by --at, or free fewer"
)


@dataclass(frozen=True)
class Arithmetic:
    """Numbers in which emitted equations are evaluated: ``of`` makes one of an exact number, and
    ``call`` are the functions of these."""

    of: Callable[[Any], Any]
    call: Callable[[str, Any], Any]


class NoTrimError(Refused, ValueError):
    """There is none, or there are many, or the question is none: the message says which."""


@dataclass(frozen=True)
class Rates:
    """Functions of what is unknown, ``names``, first the ``velocities``, then the ``turns`` of g,
    which first begin at 0, then inputs: ``values(y, numbers)``, all 0 where it is found, and
    ``slopes(y, numbers)``, a row of derivatives for each of them.  ``bounds``: the least and the
    largest of some names; ``allowed``: is a solution within all bounds that are given?"""

    names: tuple[str, ...]
    velocities: int
    turns: int
    values: Callable[[Sequence[Any], Arithmetic], list[Any]]
    slopes: Callable[[Sequence[Any], Arithmetic], list[list[Any]]]
    bounds: Mapping[str, tuple[float, float]]
    allowed: Callable[[Sequence[float]], bool]


class NotExactError(NoTrimError):
    """There are no exact numbers for it, or it is not known which."""


def solutions(f: Rates, near: Mapping[str, float]) -> list[Fraction]:
    """The one solution, as :func:`approximately` has it, to many digits."""
    return _in_fractions(f, approximately(f, near, DIGITS))


def approximately(f: Rates, near: Mapping[str, float], numbers: Arithmetic) -> list[float]:
    """The one solution within bounds ``near`` some numbers, or that to which some starts lead, else
    one out of bounds; ``NoTrimError`` for none or several.  ``numbers``: with many digits."""
    found = _reached(f, near, inputs=(0.0,) if _linear_in_inputs(f, near) else (0.0, *INPUTS))
    allowed = [y for y in found if f.allowed(y)]
    random = Random(3)
    turns = () if allowed else f.names[f.velocities : f.velocities + f.turns]
    for k in range(BETWEEN if turns or (f.bounds and not (near and allowed)) else 0):
        parts = ((x, random.random() if k else 0.5, *f.bounds[x]) for x in f.bounds)
        begin = {x: random.gauss(0, TURN) for x in turns}
        begin |= {x: low + part * (high - low) for x, part, low, high in parts}
        more = _reached(f, {**near, **begin}, inputs=((0.0, *INPUTS)[k % 4],))
        allowed += [y for y in more if f.allowed(y) and not any(_same(x, y) for x in allowed)]
    isolated = [y for y in allowed or found if _rank(f, y) == len(y)]
    if found and not allowed and len(isolated) != 1:
        several = "; ".join(describe(f, y) for y in isolated or found)
        raise NoTrimError(f"all trims that are found are out of bounds: {several}")
    if allowed and not isolated:
        raise NoTrimError(_dependent(f, allowed[0], numbers))
    if not isolated:
        started = [*f.names[: f.velocities], *f.names[f.velocities + f.turns :]]
        what = ", ".join([*started, *["g"] * bool(f.turns)])
        raise NoTrimError(
            "no trim is found: from no start does Newton's method lead to one; give numbers near "
            f"it by --at for {what}, or free others"
        )
    if len(isolated) > 1:
        several = "; ".join(describe(f, y) for y in isolated)
        raise NoTrimError(f"several trims: {several}; say near which by --at, too")
    return isolated[0]


def _dependent(f: Rates, y: Sequence[float], numbers: Arithmetic) -> str:
    """What is said of a solution where derivatives are dependent: that there are others, where they
    are found; of a double root that it is one, and what is not proved."""
    if others := _others(f, y, numbers):
        slopes = [row for at in (y, *others) for row in f.slopes(at, FLOATS)]
        columns = zip(f.names, zip(*slopes, strict=True), strict=True)
        largest = max(abs(x) for row in slopes for x in row)
        idle = [name for name, x in columns if max(map(abs, x)) <= SMALL * largest]
        if idle:
            return (
                f"many trims: no rate changes with {', '.join(idle)}, of which any will do; "
                "leave that out of --free"
            )
        free = len(y) - _rank(f, y)
        return (
            f"many trims: near {describe(f, y)} there are others, as {describe(f, others[0])}, to "
            f"the first order a family of dimension {free}; free {free} fewer of these"
        )
    simple = [Fraction(x).limit_denominator(SIMPLE) for x in y]
    near = all(abs(a - b) < 1 / SIMPLE**2 for a, b in zip(simple, y, strict=True))
    if near and not any(f.values(simple, numbers)):
        told = f"at {describe(f, [*map(float, simple)])} all rates are 0"
    else:
        told = f"near {describe(f, y)} all rates are 0 to rounding"
    return told + DEPENDENT


def _others(f: Rates, y: Sequence[float], numbers: Arithmetic) -> list[list[float]]:
    """Solutions well away from one, along which derivatives are dependent, too; none where fewer
    than two are found.  To a double root Newton's method leads back."""
    import numpy as np

    slopes = np.array(f.slopes(y, FLOATS), dtype=float)
    size, along = 1 + max(map(abs, y)), np.linalg.svd(slopes)[2][_rank(f, y) :]
    found: list[list[float]] = []
    for v, part in product(along, AWAY):
        other = _newton(f, [*map(float, np.array(y) + size * part * v)])
        if not other or np.linalg.norm(np.array(other) - y) < size * abs(part) / 2:
            continue
        dependent = _rank(f, other) < len(y) and _is_zero(f, other, numbers)
        if dependent and not any(_same(x, other) for x in found):
            found.append(other)
    return found if len(found) > 1 else []


def _is_zero(f: Rates, y: Sequence[float], numbers: Arithmetic) -> bool:
    """Is each rate 0 beside what a small step changes of it, in numbers with many digits?  A rate
    that is itself small there is not."""
    exactly, size = [*map(Fraction, y)], 1 + max(map(abs, y))
    pairs = zip(f.values(exactly, numbers), f.slopes(y, FLOATS), strict=True)
    return all(abs(float(x)) <= SMALL * size * sum(map(abs, row)) for x, row in pairs)


def _reached(f: Rates, near: Mapping[str, float], inputs: Sequence[float]) -> list[list[float]]:
    """Solutions, each once, from the numbers that are given, else from velocities of some sizes and
    signs, and inputs of these values."""
    own, m = f.names[: f.velocities], f.velocities
    signs = product((1.0, -1.0), repeat=m) if m <= SIGNED else [(1.0,) * m, (-1.0,) * m]
    starts = [[a * x for x in s] for s in signs for a in STARTS]
    if all(x in near for x in own):
        starts = [[0.0] * m]
    found: list[list[float]] = []
    for start, value in product(starts, inputs):
        first = [*start, *[0.0] * f.turns, *[value] * (len(f.names) - m - f.turns)]
        y = _newton(f, [near.get(x, v) for x, v in zip(f.names, first, strict=True)])
        if y and not any(_same(x, y) for x in found):
            found.append(y)
    return found


def _linear_in_inputs(f: Rates, near: Mapping[str, float]) -> bool:
    """Are the derivatives the same whatever the free inputs are?"""
    free = len(f.names) - f.velocities - f.turns
    first = [near.get(x, 1.0) for x in f.names[: f.velocities]] + [0.0] * f.turns
    try:
        none, *others = (f.slopes([*first, *[u] * free], FLOATS) for u in (0.0, *INPUTS))
    except (ValueError, ArithmeticError):
        return False
    return all(x == none for x in others)


def _same(x: Sequence[float], y: Sequence[float]) -> bool:
    return max(abs(a - b) for a, b in zip(x, y, strict=True)) <= SAME * (1 + max(map(abs, y)))


def describe(f: Rates, y: Sequence[float]) -> str:
    """Numbers by their names; what is small beside the others is 0."""
    size = max(map(abs, y), default=0.0)
    pairs = zip(f.names, (0.0 if abs(v) <= ROUNDING * size else v for v in y), strict=True)
    return ", ".join(f"{x} = {v:.6g}" for x, v in pairs)


def _of_float(name: str, x: float) -> float:
    if name == "none":
        return float(x == 0)
    if name == "sqrt" and x < 0:
        raise RootError("the root of a negative number")
    return float(abs(x) if name == "abs" else getattr(math, name)(x))


FLOATS = Arithmetic(float, _of_float)


def _newton(f: Rates, y: list[float]) -> list[float] | None:
    """A solution from a start, or none."""
    import numpy as np

    for _ in range(STEPS):
        try:
            rates, slopes = (np.array(g(y, FLOATS), dtype=float) for g in (f.values, f.slopes))
            step = np.linalg.lstsq(slopes, -rates, rcond=1e-12)[0]
        except (ValueError, ArithmeticError, np.linalg.LinAlgError):
            return None
        y = [*map(float, np.array(y) + step)]
        if not all(abs(x) < LARGEST for x in y):
            return None
        if max(abs(step)) <= SMALL * (1 + max(map(abs, y))):
            return y if _vanishes(f, y) else None
    return None


def _vanishes(f: Rates, y: Sequence[float]) -> bool:
    """Are all rates 0 beside what the numbers make of them?  A step is also small where one of
    these tends to 0 and another grows."""
    pairs = [*zip(f.values(y, FLOATS), f.slopes(y, FLOATS), strict=True)]
    sizes = [sum(abs(a * b) for a, b in zip(row, y, strict=True)) for _, row in pairs]
    least = ROUNDING * max(1.0, *sizes)
    return all(abs(x) <= SMALL * s + least for (x, _), s in zip(pairs, sizes, strict=True))


def _rank(f: Rates, y: Sequence[float]) -> int:
    import numpy as np

    return int(np.linalg.matrix_rank(np.array(f.slopes(y, FLOATS), dtype=float), tol=SMALL))


# -- exact numbers -------------------------------------------------------------------------------


def _rounded(x: Any) -> Fraction:
    return Fraction(round(Fraction(x) * 2**BITS), 2**BITS)


def _of_fraction(name: str, x: Any) -> Any:
    if name == "none":
        return Fraction(int(x == 0))
    return Fraction(isqrt(int(x * 4**BITS)), 2**BITS) if name == "sqrt" else abs(x)


def _digits(x: Any) -> Any:
    """A number to many digits, as a fraction; of g turned there are more."""
    return x.a + x.b * _of_fraction("sqrt", x.d) if isinstance(x, Quadratic) else _rounded(x)


DIGITS = Arithmetic(_digits, _of_fraction)


def _in_fractions(f: Rates, start: Sequence[float]) -> list[Fraction]:
    """The solution near floats, to about :data:`BITS` bits, by least squares."""
    y = [Fraction(x) for x in start]
    for _ in range(LAST):
        slopes = q.matrix([[_rounded(x) for x in row] for row in f.slopes(y, DIGITS)])
        rates, turned = f.values(y, DIGITS), q.transposed(slopes)
        down = q.times(turned, q.column(-_rounded(x) for x in rates))
        step = q.solve(q.times(turned, slopes), down)
        if step is None:
            break
        y = [_rounded(x + s) for x, (s,) in zip(y, step, strict=True)]
    return y


def exact(names: Sequence[str], y: Sequence[Fraction]) -> list[Number]:
    """The numbers of which these are the digits; ``NoTrimError`` where one is not of a square
    root."""
    found = [_read_off(x) for x in y]
    if None in found:
        k = found.index(None)
        raise NotExactError(
            f"{names[k]} is about {float(y[k]):.12g}, and no number with one square root"
        )
    return [x for x in found if x is not None]


def _read_off(x: Fraction) -> Number | None:
    """The fraction, or the root of a quadratic equation, to whose digits a number is equal."""
    small = Fraction(1, 2 ** (BITS // 2))
    near = x.limit_denominator(LARGEST)
    if abs(near - x) < small:
        return near
    from mpmath import mp, mpf, pslq

    with mp.workprec(BITS - 50):
        y = mpf(x.numerator) / x.denominator
        relation = pslq([1, y, y * y], maxcoeff=LARGEST, maxsteps=10**4)
    if relation is None or not relation[2]:
        return None
    c, b, a = map(Fraction, relation)
    long = root(b * b - 4 * a * c) if b * b >= 4 * a * c else Fraction(0)
    both = [(-b + sign * long) / (2 * a) for sign in (1, -1)]
    return min(both, key=lambda z: abs(float(z) - float(x)))


# -- exact numbers --------------------------------------------------------------------------------

AT_ZERO = {"cos": 1, "sin": 0, "tan": 0, "exp": 1, "sinh": 0, "cosh": 1, "tanh": 0}
"""The values of functions at 0, which are exact, as of an angle that is a parameter."""


def _of_exact(name: str, x: Any) -> Any:
    """The functions of exact numbers, roots and absolute values, and the tests for 0 of
    constants."""
    if name == "none":
        return Fraction(int(x == 0))
    if name in ("sqrt", "abs"):
        return root(x) if name == "sqrt" else x if x > 0 else -x
    if x != 0 or name not in AT_ZERO:
        raise NotExactError(f"{name} is in the equations")
    return Fraction(AT_ZERO[name])


EXACTLY = Arithmetic(lambda x: x, _of_exact)
"""In fractions, and in numbers with one square root."""
