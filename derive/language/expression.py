"""The small grammar of expressions in problem files: numbers, names, functions, + − * / ^ and ( ).

Text is turned into a tree by this parser alone; it never reaches Python's or SymPy's.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from fractions import Fraction

from .derivatives import DERIVATIVES, depth, has_zero_divisor, weight
from .limits import BITS, DEGREE, DEPTH, DIGITS, EXPONENT, EXPRESSION, MAGNITUDE, NESTING, SLOPE
from .reserved import SPELT
from .tree import Tree, add, mul, neg, nodes, operands, plain
from .values import approximate

SMALLEST, LARGEST = Fraction(1, MAGNITUDE), Fraction(MAGNITUDE)
TOKEN = re.compile(
    r"\s*(?:([0-9]+\.?[0-9]*(?:[eE][+-]?[0-9]{1,3})?|\.[0-9]+)|([A-Za-z][A-Za-z0-9_]*)|(.))", re.S
)

LATEX = "a/b, sqrt(x), cos(x), theta, not LaTeX"
INSTEAD = {**dict.fromkeys("\\{}$\b", LATEX), "²": "x^2", "·": "a*b", "√": "sqrt(x)"}
"""Other signs that people write → what stands for them here; letters: ``SPELT``."""

EATEN = re.compile(r"(?<!\s)[\t\r](?:heta|au|imes|anh?|ho)")
"""What text between double quotes makes of the first signs of LaTeX: tab and heta of \\theta."""


class ExpressionError(ValueError):
    """A text that is no expression, or one too costly: the message says what is wrong with it."""


def parse(text: str) -> Tree:
    """The tree of an expression, whose names become parameters; ``ExpressionError`` for any other
    text."""
    if len(text) > EXPRESSION:
        raise ExpressionError(f"an expression of {len(text)} characters; at most {EXPRESSION}")
    parser = _Parser(_tokens(text))
    tree = parser.sum(0)
    parser.no_comma()
    if parser.peek():
        raise ExpressionError(
            f"unexpected {parser.peek()[:20]!r}; a product needs a *, as 2*k, and units stand in "
            "[parameters] alone"
        )
    _affordable(tree)
    return tree


def _affordable(tree: Tree) -> None:
    """Raise ``ExpressionError`` for a tree that would take long to derive, or is too deep for
    recursion."""
    if depth(tree) > DEPTH:
        raise ExpressionError(f"operations nested deeper than {DEPTH}; gather factors")
    for q in numbers(tree):
        _number(q)
    if any(approximate(x, {}) is None for x in constants(tree)):
        raise ExpressionError("a part without names has no finite value, as log(0) has none")
    if has_zero_divisor(tree):
        raise ExpressionError("division by zero, whatever the names in it; or a root or log of it")
    found = weight(tree)
    if found.degree > DEGREE:
        raise ExpressionError(f"an expression of degree {found.degree}; at most {DEGREE}")
    if found.slope > SLOPE:
        raise ExpressionError(
            f"derivatives of about {found.slope} terms; at most {SLOPE}: split it into sums"
        )


def names(tree: Tree) -> list[str]:
    """The names of the parameters in a tree, in reading order, with repetitions."""
    return [x[1] for x in nodes(tree) if isinstance(x, tuple) and x[0] == "par"]


def numbers(tree: Tree) -> Iterator[int | Fraction]:
    """The numbers in a tree, except exponents."""
    return (x for x in nodes(tree) if isinstance(x, (int, Fraction)))


def constants(tree: Tree) -> Iterator[Tree]:
    """The largest subtrees without a parameter, except numbers."""
    if isinstance(tree, tuple) and not names(tree):
        yield tree
    else:
        for part in operands(tree):
            yield from constants(part)


def _tokens(text: str) -> list[str]:
    found = []
    if eaten := EATEN.search(text):
        raise ExpressionError(f"{eaten[0]!r} is not part of an expression; write {LATEX}")
    for match in TOKEN.finditer(text.rstrip()):
        number, name, other = match.groups()
        if other is not None and other not in "+-*/^(),":
            instead = SPELT.get(other) or INSTEAD.get(other, "")
            told = f"; write {instead}" if instead else ""
            raise ExpressionError(f"character {other!r} is not part of an expression{told}")
        found.append(number or name or other)
    return found


class _Parser:
    """A parser by recursive descent, a method for each level of the grammar; ``depth``: of the
    parentheses around it, which is bounded."""

    def __init__(self, tokens: list[str]):
        self.tokens = tokens
        self.at = 0

    def peek(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self) -> str:
        token = self.peek()
        self.at += 1
        return token

    def sum(self, depth: int) -> Tree:
        if depth > NESTING:
            raise ExpressionError(f"parentheses nested deeper than {NESTING}")
        terms = [self.product(depth)]
        while self.peek() in ("+", "-") and self.peek():
            sign = self.take()
            term = self.product(depth)
            terms.append(neg(term) if sign == "-" else term)
        numbers = [t for t in terms if isinstance(t, (int, Fraction))]
        return _number(sum(map(Fraction, numbers))) if len(numbers) == len(terms) else add(*terms)

    def product(self, depth: int) -> Tree:
        result = self.signed(depth)
        while self.peek() in ("*", "/") and self.peek():
            operator = self.take()
            factor = self.signed(depth)
            if operator == "*":
                result = mul(result, factor)
            elif factor == 0:
                raise ExpressionError("division by zero")
            else:
                result = _quotient(result, factor)
        return result

    def signed(self, depth: int) -> Tree:
        sign = 1
        while self.peek() in ("+", "-") and self.peek():
            sign *= -1 if self.take() == "-" else 1
        power = self.power(depth)
        return neg(power) if sign < 0 else power

    def power(self, depth: int) -> Tree:
        base = self.atom(depth)
        if self.peek() != "^":
            return base
        self.take()
        if self.peek() == "(":
            self.take()
            n = self.exponent()
            if self.tokens[self.at : self.at + 3] != ["/", "2", ")"]:
                raise ExpressionError("an exponent in parentheses must be one half of an integer")
            self.at += 3
            return _powered(("fun", "sqrt", base), n)
        return _powered(base, self.exponent())

    def exponent(self) -> int:
        """An integer, which no other exponent follows."""
        negative = self.peek() == "-" and bool(self.take())
        exponent = self.take()
        if self.peek() == "^":
            raise ExpressionError("write parentheses in a power of a power")
        if not re.fullmatch("[0-9]{1,9}", exponent) or int(exponent) > EXPONENT:
            raise ExpressionError(f"an exponent must be an integer up to {EXPONENT}")
        return -int(exponent) if negative else int(exponent)

    def atom(self, depth: int) -> Tree:
        token = self.take()
        if token == "(":
            inside = self.sum(depth + 1)
            self.no_comma()
            if self.take() != ")":
                raise ExpressionError("a parenthesis is not closed")
            return inside
        if token[:1].isdigit() or token[:1] == ".":
            if len(token) > DIGITS:
                raise ExpressionError(f"a number of more than {DIGITS} characters")
            return _number(Fraction(token))
        if token[:1].isalpha():
            return self.name(token, depth)
        if token == "*":
            raise ExpressionError("unexpected '*'; a power is written ^")
        raise ExpressionError(f"unexpected {token!r}" if token else "unexpected end")

    def name(self, token: str, depth: int) -> Tree:
        """A function of a sum in parentheses, the constant pi, or a parameter."""
        if self.peek() != "(":
            return "π" if token == "pi" else ("par", token)
        if token in WRITTEN_OUT:
            return self.written_out(token, depth)
        if token not in DERIVATIVES:
            known = ", ".join((*DERIVATIVES, *WRITTEN_OUT))
            instead = f"write its expression itself, by {known}"
            raise ExpressionError(f"unknown function {token[:20]!r}; {instead}")
        return ("fun", token, self.atom(depth + 1))

    def written_out(self, token: str, depth: int) -> Tree:
        """A function of :data:`WRITTEN_OUT` of what stands in parentheses."""
        self.take()
        inside = [self.sum(depth + 1)]
        while self.peek() == ",":
            self.take()
            inside.append(self.sum(depth + 1))
        if self.take() != ")":
            raise ExpressionError("a parenthesis is not closed")
        count, written = WRITTEN_OUT[token]
        if len(inside) != count and not (token == "hypot" and len(inside) > count):
            told = "1 expression" if count == 1 else f"{count} expressions"
            least = " or more" if token == "hypot" else ""
            raise ExpressionError(f"{token} is of {told}{least}, not of {len(inside)}")
        return written(*inside)

    def no_comma(self) -> None:
        """Refuse a comma that parts no expressions."""
        if self.peek() == ",":
            raise ExpressionError(
                "character ',' is not part of an expression; decimals have a point, as 0.5"
            )


# Functions that are written out in others, so that derivatives, every language and the checker
# have them: |x| = √(x²).  Where their derivatives do not exist these are not a number.


def _absolute(x: Tree) -> Tree:
    return _number(abs(Fraction(x))) if isinstance(x, (int, Fraction)) else hypot(x, 0)


def _sign(x: Tree) -> Tree:
    if isinstance(x, (int, Fraction)):
        return (x > 0) - (x < 0)
    return ("div", x, _absolute(x))


def _extreme(a: Tree, b: Tree, sign: int) -> Tree:
    """b + ½(d ± |d|) with d = a − b: of the two the larger, or the smaller."""
    d = add(a, neg(b))
    if isinstance(a, (int, Fraction)) and isinstance(b, (int, Fraction)):
        return max(a, b) if sign > 0 else min(a, b)
    return add(b, mul(Fraction(1, 2), add(d, mul(sign, _absolute(d)))))


def hypot(*parts: Tree) -> Tree:
    """√(a² + b² + …), the length of a vector of expressions."""
    return ("fun", "sqrt", add(*(_powered(x, 2) for x in parts if x != 0)))


def _angle(y: Tree, x: Tree) -> Tree:
    """The angle of (x, y) by the tangent of its half, y/s with s = √(x² + y²) + x, which is
    2ry/(s² + y²), as 2rs = s² + y²: that has no difference where x < 0."""
    r = hypot(x, y)
    squares = add(_powered(add(r, x), 2), _powered(y, 2))
    return mul(2, ("fun", "atan", ("div", mul(2, r, y), squares)))


WRITTEN_OUT: dict[str, tuple[int, Callable[..., Tree]]] = {
    "abs": (1, _absolute),
    "sign": (1, _sign),
    "min": (2, lambda a, b: _extreme(a, b, -1)),
    "max": (2, lambda a, b: _extreme(a, b, 1)),
    "hypot": (2, hypot),
    "atan2": (2, _angle),
}
"""Function → of how many expressions, and how it is written in others."""


def _number(value: Fraction | int) -> Tree:
    """A number as a leaf; ``ExpressionError`` when a floating-point number cannot hold it."""
    q = Fraction(value)
    if q and not SMALLEST < abs(q) < LARGEST:
        raise ExpressionError("a number outside 1e-300 … 1e300")
    if max(q.numerator.bit_length(), q.denominator.bit_length()) > BITS:
        raise ExpressionError("a fraction of too many digits; round its numbers")
    return plain(q)


def _quotient(a: Tree, b: Tree) -> Tree:
    if isinstance(b, (int, Fraction)):
        return mul(Fraction(1) / b, a)
    return ("div", a, b)


def _powered(base: Tree, n: int) -> Tree:
    if n == 0:
        return 1
    if isinstance(base, (int, Fraction)):
        if base == 0 and n < 0:
            raise ExpressionError("division by zero")
        return _number(Fraction(base) ** n)
    return base if n == 1 else ("pow", base, n)
