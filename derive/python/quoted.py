"""SymPy expressions as a problem file says them, and what is doubtful of it as warnings."""

from __future__ import annotations

import sys
import warnings
from fractions import Fraction
from functools import reduce
from pathlib import Path
from typing import Any

from ..language.derivatives import DERIVATIVES
from ..language.expression import WRITTEN_OUT
from ..language.limits import DEPTH
from ..language.reserved import CONSTANTS
from ..problem.problem import Problem
from ..schema.table_reader import NAME

SUM, PRODUCT, POWER, ATOM = range(4)
"""How tightly a text binds, as the grammar has it."""
Text = tuple[str, int]
SHOWN = 60
ROOTS = {2**k: k for k in range(4)}  # of the denominator of an exponent: how many square roots
NOT_EVALUATED = ("Derivative", "Integral", "Limit", "Product", "Subs", "Sum")


class NoExpressionError(ValueError):
    """A SymPy object that problem files have no words for: the message says which, and what to
    do."""


def is_sympy(x: Any) -> bool:
    """Is it an object of SymPy, a matrix among them?"""
    sympy = sys.modules.get("sympy")
    return sympy is not None and isinstance(x, (sympy.Basic, sympy.MatrixBase))


def quoted(x: Any) -> Any:
    """What a problem file says for an object of SymPy: a number, a text, or lists of these.

    A column or a row is a list, another matrix its rows.  A fraction stays one, and a Float is the
    float that it is.  ``NoExpressionError`` for what has no meaning there.
    """
    sympy = sys.modules["sympy"]  # from which x is

    if isinstance(x, sympy.MatrixBase):
        rows = [[quoted(y) for y in row] for row in x.tolist()]
        one = len(rows) != 1 if x.cols == 1 else x.rows == 1
        return [y for row in rows for y in row] if one else rows
    if isinstance(x, sympy.NDimArray):
        return _listed(x.tolist())
    if isinstance(x, sympy.Integer):
        return int(x)
    if isinstance(x, sympy.Float) and float(x) == x:
        return float(x)
    return _text(x, 0)[0]


def value(x: Any) -> int | float:
    """The value of a SymPy number, as √2 or 1/3; ``NoExpressionError`` for what has none."""
    if getattr(x, "is_Integer", False):
        return int(x)
    if getattr(x, "free_symbols", True) or not getattr(x, "is_real", False):
        raise NoExpressionError(f"{_shown(x)} is no number; a parameter has a number, or none")
    return float(x)


def name(x: Any) -> str:
    """The name of a Symbol, if it is one in an expression."""
    called = str(getattr(x, "name", x))
    if type(x).__name__ == "Dummy":
        raise NoExpressionError(f"{_shown(x)} is a Dummy, which has no name of its own")
    if called in CONSTANTS and called != "t":
        raise NoExpressionError(f"the symbol {called} has the name of {CONSTANTS[called]}")
    if not NAME.fullmatch(called):
        raise NoExpressionError(
            f"the symbol {called[:SHOWN]!r} is no name here: a letter, then letters, digits and _"
        )
    return called


def _listed(x: Any) -> Any:
    return [_listed(y) for y in x] if isinstance(x, list) else quoted(x)


def _shown(x: Any) -> str:
    text = " ".join(str(x).split())
    return text if len(text) <= SHOWN else text[: SHOWN - 1] + "…"


def _text(x: Any, depth: int) -> Text:
    """The text of an expression, and how tightly it binds."""
    if depth > DEPTH:
        raise NoExpressionError(f"operations nested deeper than {DEPTH}; gather factors")
    if x.is_Symbol:
        return name(x), ATOM
    if x.is_Number or x.is_NumberSymbol or x.is_infinite:
        return _number(x)
    parts = x.args
    if x.is_Add:
        return "+".join(_text(y, depth + 1)[0] for y in parts), SUM
    if x.is_Mul:
        return _product(parts, depth), PRODUCT
    if x.is_Pow:
        return _power(x, depth)
    called = type(x).__name__
    if called.lower() in WRITTEN_OUT and parts:  # of real numbers
        first, *rest = (_text(y, depth + 1)[0] for y in parts)
        whole = reduce(lambda a, b: f"{called.lower()}({a}, {b})", rest, first)
        return whole if rest else f"{called.lower()}({first})", ATOM
    if called in DERIVATIVES and len(parts) == 1:
        return f"{called}({_text(parts[0], depth + 1)[0]})", ATOM
    raise NoExpressionError(_refusal(x))


def _number(x: Any) -> Text:
    if x.is_Float and x.is_finite:
        text = repr(float(x)) if float(x) == x else str(x)
    elif x.is_Rational:
        text = str(Fraction(int(x.p), int(x.q)))
    elif str(x) in ("pi", "E"):
        return {"pi": "pi", "E": "exp(1)"}[str(x)], ATOM
    elif x.is_finite:
        raise NoExpressionError(f"the constant {x} is not known; give it as a parameter")
    else:
        raise NoExpressionError(f"{_shown(x)} is no finite number")
    return text, ATOM if text.replace(".", "").isdigit() else PRODUCT


def _product(factors: Any, depth: int) -> str:
    """a*b/c, with the negative powers below."""
    below = [y for y in factors if _is_below(y)]
    above = [_within(y, PRODUCT, depth) for y in factors if not _is_below(y)]
    dividing = [_within(1 / y, POWER, depth) for y in below]
    return "/".join(["*".join(above) or "1", *dividing])


def _is_below(x: Any) -> bool:
    return bool(x.is_Pow and x.exp.is_Rational and x.exp.is_negative)


def _power(x: Any, depth: int) -> Text:
    """xⁿ, and the same of a root, or of a root of a root: the exponent is an integer / 2ᵏ."""
    if _is_below(x):
        return _product([x], depth), PRODUCT
    if not (x.exp.is_Rational and x.exp.q in ROOTS):
        raise NoExpressionError(
            f"the power {_shown(x)}: an exponent must be an integer, or half of one; "
            "write exp(y*log(x)) for x**y"
        )
    if x.exp.q == 1:
        return f"{_within(x.base, ATOM, depth)}^{x.exp}", POWER
    roots = ROOTS[x.exp.q]
    root = "sqrt(" * roots + _text(x.base, depth + roots)[0] + ")" * roots
    return (root, ATOM) if x.exp.p == 1 else (f"{root}^{x.exp.p}", POWER)


def _within(x: Any, tight: int, depth: int) -> str:
    """The text of a part, in parentheses where it binds less tightly than its place."""
    text, own = _text(x, depth + 1)
    return text if own >= tight else f"({text})"


def _refusal(x: Any) -> str:
    """Why an object has no meaning, in words."""
    called = type(x).__name__
    if str(x) == "I":
        return "complex numbers have no meaning here"
    if called in NOT_EVALUATED:
        return f"{_shown(x)} is not evaluated; hand in what its .doit() gives"
    if getattr(x, "is_Relational", False) or getattr(x, "is_Boolean", False):
        return f"{_shown(x)} is no expression, it is true or false"
    if getattr(x, "is_Matrix", False):
        return f"{_shown(x)} stands for a matrix; expected a number, or its entries"
    if getattr(x, "is_Function", False):
        known = ", ".join(DERIVATIVES)
        return f"unknown function {_shown(x)}; known: {known}"
    return f"{_shown(x)}, a {called}, has no meaning in an expression"


# A problem with what may be meant otherwise in it, as warnings of Python.


def warned(problem: Problem, *, frames: int = 1) -> Problem:
    """A problem, with a warning for each of its doubts, at the line so many ``frames`` above."""
    from ..problem.toml import doubts

    for doubt in doubts(problem, {}):
        warnings.warn(f"{problem.name}: {doubt}", stacklevel=frames + 2)
    return problem


def loaded(problem: Problem | str | Path) -> Problem:
    """A problem, one of a file or a ready-made one, of which doubts are told."""
    from ..command.showing import load_problem

    if isinstance(problem, Problem):
        return problem
    return warned(load_problem(str(problem)), frames=2)
