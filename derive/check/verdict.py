"""The verdict on a step: that it holds, or how it fails, in words."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..language.show import show
from ..language.tree import Tree
from ..record.record import Equation, Step

SHOWN = 120
"""The most letters of a failing equation that a message shows."""

IMPOSSIBLE = (
    *(ArithmeticError, AssertionError, LookupError, TypeError, ValueError),
    *(AttributeError, RecursionError),
)
"""The exceptions that evaluating a record raises only if no walk has written it."""

MOST_BITS = 10**6
"""The most bits of all numbers written in a claim together, its powers multiplied out."""


@dataclass(frozen=True)
class Verdict:
    """The result of checking one step, or the symbols: ``holds``, else ``reason`` says why not.

    ``bound``: on the probability that a false claim passes. ``tried``: how many claims, and the
    names of the groups on which they were tried; ``of``: what these claims are, "equation" or
    "symbol". ``note``: what is to be known of one that holds.
    """

    label: str
    holds: bool
    reason: str
    bound: float
    tried: tuple[int, tuple[str, ...]] = (0, ())
    of: str = "equation"
    note: str = ""


def no_sense(error: Exception) -> str:
    """What is said of a record that cannot be evaluated, by no message of Python's."""
    return f"the problem or a step makes no sense where it is evaluated ({type(error).__name__})"


class RefusedError(Exception):
    """Ends the check of a step that does not hold; carries its :class:`Verdict`."""

    def __init__(self, verdict: Verdict):
        super().__init__(verdict.reason)
        self.verdict = verdict


def refusal(step: Step, equation: Equation, reason: str, where: str = "") -> Verdict:
    """The verdict on a step that fails by one of its equations, which its reason quotes."""
    text = f"{show(equation.lhs)} = {show(equation.rhs)}"
    text = text if len(text) <= SHOWN else f"{text[:SHOWN]} …"
    place = f"{step.key(equation)}{where}, {text}"
    return Verdict(step.label, False, f"{place}: {reason}", 1.0)


def bit_count(t: Tree) -> int:
    """About how many bits the numbers written in a tree have, its powers multiplied out."""
    if isinstance(t, (int, Fraction)):
        return abs(t.numerator).bit_length() + t.denominator.bit_length()
    if not isinstance(t, tuple):
        return 0
    if t[0] == "pow":
        return bit_count(t[1]) * abs(int(t[2]))
    return sum(bit_count(x) for x in t[1:])
