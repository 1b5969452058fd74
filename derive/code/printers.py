"""Expressions as text: precedence and numbers, nothing else."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from .ellipsoid import BUNDLES, is_item
from .program import Expression, LoweringError, is_negated

SUM, PRODUCT, ATOM = 1, 2, 3


@dataclass(frozen=True)
class SourcePrinter:
    """How a language writes a number, |x|, and 1 where x is 0, else 0.

    ``integrals``: how a call of a function of integrals over an ellipsoid begins, of ``{prefix}``
    and ``{function}``; ``item``: one of them, counted from ``first``.  The rest is common to all
    that have + − * /.
    """

    number: Callable[[Fraction], str]
    absolute: str = "abs"
    function: Callable[[str], str] = str
    none: str = "({} == 0)"
    integrals: str = "{function}("
    item: str = "{}[{}]"
    first: int = 0
    prefix: str = ""

    def __call__(self, e: Expression) -> str:
        """An expression as source text."""
        return self._print(e)[0]

    def _print(self, e: Expression) -> tuple[str, int]:
        if isinstance(e, (int, Fraction)):
            text = self.number(Fraction(e))
            return text, ATOM if e >= 0 and "/" not in text else SUM
        if isinstance(e, str):
            return e, ATOM
        op, *operands = e
        if op == "fun" and is_item(e[1]):
            return self.item.format(self(e[2]), int(e[1][-1]) + self.first), ATOM
        if op == "fun" and e[1] in BUNDLES:
            given = ", ".join(self(x) for x in e[2:])
            return f"{self.integrals.format(prefix=self.prefix, function=e[1])}{given})", ATOM
        if op == "fun":
            return f"{self.function(e[1])}({self(e[2])})", ATOM
        if op == "abs":
            return f"{self.absolute}({self(e[1])})", ATOM
        if op == "none":
            return self.none.format(self(e[1])), ATOM
        if op == "add" or is_negated(e):
            return self._sum(operands if op == "add" else [e]), SUM
        if op == "mul":
            return "*".join(self._at(x, PRODUCT) for x in operands), PRODUCT
        return f"{self._at(e[1], PRODUCT)}/{self._at(e[2], ATOM)}", PRODUCT

    def _at(self, e: Expression, level: int) -> str:
        text, own = self._print(e)
        return text if own >= level else f"({text})"

    def _sum(self, terms: Sequence[Any]) -> str:
        text = ""
        for term in terms:
            sign, size = ("-", term[2]) if is_negated(term) else ("+", term)
            shown = self._at(size, PRODUCT)
            text += f" {sign} {shown}" if text else shown if sign == "+" else f"-{shown}"
        return text


def decimal(q: Fraction, suffix: str = "") -> str:
    """The decimal literal nearest to q; a quotient of small integers stays one.

    ``LoweringError`` for a number larger than 1e308.
    """
    try:
        value = float(q)
    except OverflowError:
        raise LoweringError("a number of the equations is larger than 1e308; scale it") from None
    short = Fraction(repr(value)) == q  # a decimal number such as 9.81
    if short or max(abs(q.numerator), q.denominator) >= 10**6:
        return f"{value!r}{suffix}"
    return f"{float(q.numerator)!r}{suffix}/{float(q.denominator)!r}{suffix}"


def wrapped(text: str, width: int, indent: str) -> str:
    """The text broken before + and -, every line at most ``width`` wide where it can be."""
    line, *terms = re.split(r" (?=[+-] )", text)
    lines = []
    for term in terms:
        if len(line) + 1 + len(term) > width:
            lines.append(line)
            line = indent + term
        else:
            line = f"{line} {term}"
    return "\n".join([*lines, line])
