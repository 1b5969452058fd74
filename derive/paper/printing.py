"""How a numbered equation of the paper is stated as data, exactly as it is printed.

Each entry is the number, what kind of statement it is, where it holds, the printed equations as
trees, how they read in print, and a remark where the print needs one.  Nothing here was corrected.
A *claim* has a truth value and is compared with the derivation; a *definition* introduces a name.
``missing``: names that the print has lost, and a counterexample needs.
``seed``: from where a counterexample is sought; nearby is one with few numbers.
``answers``: left sides of the record that answer the print where its own are false.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..language.tree import Tree, add, mul, neg
from ..record.record import Equation

DOMEGA: Tree = ("call", "dϖ", "δy", "δ′y")
VARPI: Tree = ("call", "ϖ", "δy")
R_I: Tree = ("at", "r", "i")
M_I: Tree = ("at", "m", "i")
V_I: Tree = ("at", "v", "i")
MOVED: Tree = ("call", R_I, "t")
DMOVED: Tree = ("call", "δ", MOVED)


@dataclass(frozen=True)
class Printed:
    """One numbered equation of the paper."""

    number: int
    claim: bool
    group: str
    reads: str
    equations: tuple[Equation, ...] = ()
    remark: str = ""
    principal: bool = False
    answers: tuple[Tree, ...] = ()
    missing: tuple[str, ...] = ()
    seed: int = 0


def bar(x: Tree) -> Tree:
    """A barred factor."""
    return ("T", x)


def metric(m: str, a: Tree, b: Tree) -> Tree:
    """⟨a, b⟩_m."""
    return ("metric", m, a, b)


def minus(a: Tree, b: Tree, dt: str) -> Tree:
    """a − b dt."""
    return add(a, neg(mul(b, dt)))


def tr(*factors: Tree) -> Tree:
    """The trace of a product."""
    return ("tr", mul(*factors))
