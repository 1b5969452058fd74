"""The requirements of a proof at random points: one rational function, of a degree that is known.

Emitted functions must be straight-line programs: a branch could be one thing at the points that are
tried and another elsewhere.  A size |x| or a comparison may serve the checks of ``constants``,
``defect`` is a sum of sizes, and ``from_matrix`` asks for signs.  Numbers carry a bound on the
degree of the rational function whose value they are, which a Schwartz–Zippel bound asks for.
Denominators are multiplied, never brought to a common one: the degrees are too large, which is
safe.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from ..language.rational import RingElement
from .terms import Body, CodeError, CodeFunction

REFUSED = (1, 2)
"""What ``constants`` returns of a body with a singular mass matrix, or with numbers that are not
finite."""
SIGNED = "from_matrix"
"""The function that may ask for signs: it is tried with each choice of them."""
SLACK = Fraction(1, 10**20)
"""The largest number that may be added where something of the state is 0."""
UNSMOOTH = ("abs", "gt", "lt", "le", "eq", "not")


def require_straight_line(f: CodeFunction) -> None:
    """``CodeError`` unless what a function gives depends on no size and no condition."""
    tainted: set[str] = set()
    body = f.body
    if f.name == SIGNED:
        if any(s[0] in ("if", "for") for s in body):
            raise CodeError(f"{f.name}: what it computes is under a condition")
        return
    if f.name == "defect":
        body = summands(f).body
    if f.name == "project":
        stored = [s[0] == "store" for s in body]
        if stored != sorted(stored) or any(_read(s[3]) for s in body if s[0] == "store"):
            raise CodeError("project: it reads after it has written, so it cannot work in place")
    _body(f, body, tainted, [])


def _read(e: Any) -> bool:
    """Does an expression read an array?"""
    return isinstance(e, tuple) and (e[:1] == ("at",) or any(map(_read, e)))


def tested_parameters(f: CodeFunction) -> set[int]:
    """The places in p of the parameters that a function tests for being 0, a branch that is tried
    separately.

    ``CodeError`` where it tests anything else, but for a divisor, x + (x == 0), which stands for x
    wherever x divides, and for a slack.
    """
    if f.name == SIGNED:
        return set()
    places: dict[str, int] = {}
    found: set[int] = set()

    def visit(e: Any) -> None:
        if isinstance(e, tuple) and e:
            if e[0] == "div" and _kept_off_zero(e[2]):
                visit(e[1])
                return
            if e[0] == "mul" and _is_slack(e, places):
                return
            if e[0] == "none":
                if e[1][0] != "var" or e[1][1] not in places:
                    raise CodeError(f"{f.name}: it asks whether something is 0, and no parameter")
                found.add(places[e[1][1]])
            for x in e:
                visit(x)

    for s in f.body:
        if s[0] == "set" and s[2][:2] == ("at", "p") and s[2][2][0] == "int":
            places[s[1]] = s[2][2][1]
        elif s[0] == "unpack" and s[2] == "p":
            places |= {name: i for i, name in enumerate(s[1])}
        visit(s)
    return found


def _kept_off_zero(e: Any) -> bool:
    """Is it x + (x == 0), of a name?"""
    return isinstance(e, tuple) and e[0] == "add" and e[1][0] == "var" and e[2] == ("none", e[1])


def _is_slack(e: tuple[Any, ...], parameters: Mapping[str, int]) -> bool:
    """Is it less than any rounding where something, and no parameter, is 0, and 0 elsewhere?"""
    small = any(x[0] == "lit" and Fraction(x[1]) <= SLACK for x in e[1:])
    asked = [x[1] for x in e[1:] if x[0] == "none"]
    return small and bool(asked) and all(x[0] != "var" or x[1] not in parameters for x in asked)


def with_roots(f: CodeFunction) -> CodeFunction:
    """The function with √(a²) for |a|, as records have it: a function at an argument as any other.
    Not where sizes are those of tests and of ``defect``, or signs are asked for."""
    if f.name in ("constants", "defect", SIGNED):
        return f

    def rooted(e: Any) -> Any:
        if not isinstance(e, tuple):
            return e
        e = tuple(map(rooted, e))
        return ("fun", "sqrt", ("mul", e[1], e[1])) if e[:1] == ("abs",) else e

    return replace(f, body=rooted(f.body))


def summands(f: CodeFunction) -> CodeFunction:
    """The function that returns a, b, … in the place of |a| + |b| + …, so that none can hide
    another; ``CodeError`` where it returns no such sum."""
    body, last = f.body[:-1], f.body[-1:]
    if not last or last[0][0] != "return":
        raise CodeError(f"{f.name}: it does not end with a sum of sizes")
    return replace(f, body=(*body, ("return", ("list", *_sizes(f, last[0][1])))))


def _sizes(f: CodeFunction, e: Any) -> list[Any]:
    """The operands a, b, … of a sum |a| + |b| + …."""
    if e[0] == "list" and len(e) == 2:
        return _sizes(f, e[1])
    if e[0] == "add":
        return [x for y in e[1:] for x in _sizes(f, y)]
    if e[0] != "abs":
        raise CodeError(f"{f.name}: it is no sum of sizes")
    return [e[1]]


def error_checks(f: CodeFunction) -> Body:
    """What in a function serves its checks alone: conditions, what depends on sizes, and what is
    named when all results are stored."""
    tainted: set[str] = set()
    results = [i for i, s in enumerate(f.body) if s[0] == "store" or s[1][0] == "list"]
    found = []
    for i, s in enumerate(f.body):
        if s[0] == "set" and _unsmooth(s[2], tainted):
            tainted.add(s[1])
        named = s[0] == "set" and (s[1] in tainted or i > max(results, default=-1))
        if named or (s[0] in ("if", "for", "return") and i not in results):
            found.append(s)
    return tuple(found)


def _body(f: CodeFunction, body: Body, tainted: set[str], checks: list[str]) -> None:
    """Check statements; ``tainted``: the names that depend on a size or a condition, ``checks``:
    the conditions met so far."""
    for s in body:
        if s[0] == "if":
            refused = [(("return", ("int", code)),) for code in REFUSED]
            if f.name != "constants" or s[2] not in refused:
                raise CodeError(f"{f.name}: what it computes is under a condition")
            checks.append(s[0])
        elif s[0] == "for":
            _body(f, s[3], tainted, checks)
        elif s[0] == "set" and _unsmooth(s[2], tainted):
            tainted.add(s[1])
        elif s[0] == "store" and (checks or _unsmooth(s[2:], tainted)):
            raise CodeError(f"{f.name}: {s[1]} depends on a size or on a condition")
        elif s[0] == "return" and _unsmooth(s[1:], tainted):
            raise CodeError(f"{f.name}: what it returns depends on a size or on a condition")


def _unsmooth(e: Any, tainted: set[str]) -> bool:
    """Does an expression depend on a size or on a condition?"""
    if not isinstance(e, tuple) or not e:
        return False
    if e[0] in UNSMOOTH or (e[0] == "var" and e[1] in tainted):
        return True
    return any(_unsmooth(x, tainted) for x in e)


class Measured(RingElement):
    """A value, with bounds on the degrees of numerator and denominator in the random integers."""

    __slots__ = ("den", "num", "value")

    def __init__(self, value: Any, num: int = 0, den: int = 0):
        self.value, self.num, self.den = value, num, den

    @staticmethod
    def of(x: Any) -> Measured:
        """The number x as a constant function, unless it is measured already."""
        return x if isinstance(x, Measured) else Measured(x)

    @property
    def degree(self) -> int:
        """The bound on the degree of numerator and denominator together."""
        return self.num + self.den

    def __add__(self, other: Any) -> Measured:
        b = Measured.of(other)
        num = max(self.num + b.den, b.num + self.den)
        return Measured(self.value + b.value, num, self.den + b.den)

    def __mul__(self, other: Any) -> Measured:
        b = Measured.of(other)
        return Measured(self.value * b.value, self.num + b.num, self.den + b.den)

    def __truediv__(self, other: Any) -> Measured:
        b = Measured.of(other)
        return self * Measured(1 / Fraction(b.value), b.den, b.num)

    def __rtruediv__(self, other: Any) -> Measured:
        return Measured.of(other) / self

    def __mod__(self, p: int) -> Measured:
        return Measured(self.value % p, self.num, self.den)

    def inverse(self, p: int) -> Measured:
        """The inverse modulo a prime p."""
        return Measured(pow(self.value, -1, p), self.den, self.num)

    def __eq__(self, other: object) -> bool:
        return bool(self.value == Measured.of(other).value)

    __hash__ = None  # type: ignore[assignment]


class MeasuredElementary:
    """The elementary functions of measured numbers: at each argument a number drawn for itself.

    ``calls``: how often they were called; ``largest``: the largest degree of an argument;
    ``degrees``: (name, argument) → the degrees of a value that is not drawn, as that of an angle of
    the state.
    """

    def __init__(self, values: Any, degrees: Mapping[tuple[str, Any], tuple[int, int]]):
        self.values, self.degrees = values, degrees
        self.calls, self.largest = 0, 0

    def __call__(self, name: str, x: Any) -> Measured:
        """The value of a function; where it is drawn, of degree 1 whatever the argument."""
        x = Measured.of(x)
        self.calls, self.largest = self.calls + 1, max(self.largest, x.degree)
        at = Fraction(x.value)
        return Measured(self.values(name, at), *self.degrees.get((name, at), (1, 0)))
