"""The record: a derivation as data.

``Derivation`` = the problem, the declared symbols and the ordered steps.  A step names the rule it
used and the earlier steps it rests on; its equations are pairs of trees; its hypotheses are the
properties that numbers, matrices or forms must have for it to hold.  Beside them stands what a
reader must know: scopes, conventions, commentary.  Nothing here computes.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..language.limits import Refused
from ..language.read import FormulaError, read
from ..language.tree import Tree, names
from .sentence import Claim, Prose
from .vocabulary import RULES, Use

ANY_GROUP = "any group"
ACTIONS = ("linear", "affine")
"""How a group moves points; the text about any group of an action is called by the same word."""
CHAPTERS = (*ACTIONS, "left", "right", "discrete", "discrete_affine")
"""What is said of any group, by what the labels begin with: for points that it moves linearly, or
by affine maps; for any Lagrangian on it, trivialised on the left, or on the
right; of the discrete motion, for each action."""
CONVENTIONS = (
    "T is the transpose, a bar in the paper; names are compared letter by letter, as written",
    "inner(a, b) and metric(M, a, b) are Tr a M b̄ for matrices and ā M b for vectors",
    "bracket(a, b) = ab − ba; hat(X) = j(X), j(X)Y = X ∧ Y; entries are counted from 1",
    "dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)] for commuting variations; ξ = g⁻¹δg, Z = g⁻¹ν; where X is the "
    "tangent of a lift, ν = ġ, δ varies it through lifts, and commutes with d/dt",
    "par(name) is a parameter; at(name, i) a member of a family, over which sum(i, x) runs",
    "an equation holds for every value of a free index and of the names in for_all, and there is a "
    "value of each name in exists, which has it from there on; ζ are the coordinates of Z in the "
    "basis of the group (Z = j(ζ) for rotations)",
    "the equations of a step hold where those that it lists as given do; X is any vector with "
    "δt(X) = 1 for which they do, and δ itself where δt = 1 is given; α̇, Ż, ζ̇ and their like are "
    "the acceleration of the motion, or of X where the equation holds for all of them",
    "where δA and δt are given, δ is a field on R × G, δA a function of t and A, and velocities go "
    "along; likewise δ′; d/dt of ϖ(δy) − F(t, A) is that along the motion",
    "a step that is not driven has neither inputs nor damping",
    "hypotheses: what the equations of a step need; A and with it C have inverses; a form on T_g G "
    "or 𝔤 is one in two variations δg and δ′g there; where masses are not of any sign, they are "
    "positive; of the velocity of X, what is given and is an equation as well, is what they tell "
    "where dϖ(X, δ′y) vanishes for every δ′y with δ′t = 0 and δ′g = 0",
)
"""The conventions of a record that another reader of its JSON must know, listed in every record."""

FIELDS = ("δt", "δA", "δ′t", "δ′A")
"""What says, where it is given in a step, that δ or δ′ is a field: it defines no name."""

COMMENTARY = ("meaning", "latex", "prose", "sentences", "paper", "title", "unit")
"""The fields of a record that no reader need understand, wherever they stand: words for people."""

AMENDED = frozenset({20, 25, 26, 29, 31, 32, 35})
"""The numbered equations whose print the derivation corrects; ``derive paper`` finds them."""


PROPERTIES: dict[str, str] = {
    "positive": "a number that is > 0",
    "semidefinite": "a symmetric matrix of which no vector has a negative square",
    "nonzero": "a number that is not 0",
    "invertible": "a matrix with an inverse",
    "nondegenerate": "a form in two variations, such that 0 alone is orthogonal to all of a space",
}
"""Property → what it says of a tree; of a tree with a free index it says that of each member."""

OF_MASSES = ("positive", "semidefinite")
"""The properties that follow from positive masses."""

SPACES: dict[str, str] = {
    "T_g G": "the tangent vectors of the group at g: δA and δ′A, or (δA, δT) and (δ′A, δ′T)",
    "𝔤": "the Lie algebra: ξ and ξ′, or (ξ, η) and (ξ′, η′), where Ω is for ξ = j(Ω)",
}
"""Name of a space → the two variations of a form that run in it."""


@dataclass(frozen=True)
class Hypothesis:
    """The tree ``of`` has the property ``property``, a key of PROPERTIES; ``space``: of a form, a
    key of SPACES, where its two variations run."""

    property: str
    of: Tree
    space: str = ""


class RecordError(Refused, ValueError):
    """A record that is not well formed: the message says where, and what is wrong."""


def equation_key(label: str, place: int) -> str:
    """The key of an equation in all outputs, by its step and place there: ``so3.kernel.2``."""
    return f"{label}.{place}"


def step_of(key: str) -> str:
    """The label of the step that an equation's key belongs to."""
    return key.rpartition(".")[0]


@dataclass(frozen=True)
class Equation:
    """lhs = rhs, for every value of the names in ``for_all`` and some of those in ``exists``."""

    lhs: Tree
    rhs: Tree
    for_all: tuple[str, ...] = ()
    exists: tuple[str, ...] = ()


@dataclass(frozen=True)
class Step:
    """One step of the walk.

    ``scope`` is ``"any group"`` or the name of the group on which the equations hold; ``given``:
    equations that are supposed to hold; ``driven``: inputs and damping act; ``hypotheses``: what
    is inverted, or tells the velocity of X, can be; ``claims``: what its sentences say beside the
    equations.
    """

    label: str
    rule: str
    uses: tuple[str, ...]
    equations: tuple[Equation, ...]
    prose: Prose
    paper: tuple[int, ...] = ()
    scope: str = ANY_GROUP
    given: tuple[Equation, ...] = ()
    driven: bool = False
    hypotheses: tuple[Hypothesis, ...] = ()
    claims: tuple[Claim, ...] = ()

    @property
    def kind(self) -> str:
        """What the step's equations are, by its rule: a definition, an identity, …"""
        return RULES[self.rule].kind

    @cached_property
    def names(self) -> frozenset[str]:
        """The names that occur in the equations."""
        sides = (x for e in self.equations for x in (e.lhs, e.rhs))
        return frozenset(x for side in sides for x in names(side))

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """The keys of the step's equations, in order."""
        return tuple(equation_key(self.label, k) for k, _ in enumerate(self.equations, 1))

    def key(self, equation: Equation) -> str:
        """The key of an equation of the step; of two equal equations, that of the first."""
        return self._keys[equation]

    @cached_property
    def _keys(self) -> dict[Equation, str]:
        return dict(reversed([*zip(self.equations, self.keys, strict=True)]))


@dataclass(frozen=True)
class Symbol:
    """A declared name: what it means, how LaTeX writes it, in which ways the steps use it."""

    name: str
    meaning: Prose
    latex: str
    uses: tuple[Use, ...] = ()


@dataclass(frozen=True)
class Derivation:
    """The record of one problem: the problem as data, the declared symbols, the steps in order."""

    problem: Mapping[str, Any]
    symbols: tuple[Symbol, ...]
    steps: tuple[Step, ...]

    def __repr__(self) -> str:
        return f"<record {self.name}: {len(self.steps)} steps>"

    @property
    def name(self) -> str:
        """The problem's name, which prefixes its labels."""
        return str(self.problem["name"])

    def __getitem__(self, label: str) -> Step:
        """A step by its label, with or without the problem's name."""
        wanted = {label, f"{self.name}.{label}"}
        for step in self.steps:
            if step.label in wanted:
                return step
        raise KeyError(label)

    def since(self, label: str) -> tuple[Step, ...]:
        """The steps from one on, by its label, with or without the problem's name."""
        return self.steps[self.steps.index(self[label]) :]

    @cached_property
    def remarks(self) -> frozenset[str]:
        """The labels of the steps that ``motion`` does not rest on; none without that step."""
        uses = {s.label: s.uses for s in self.steps}
        left = [f"{self.name}.motion"]
        if left[0] not in uses:
            return frozenset()
        found = set(left)
        while left:
            new = {*uses[left.pop()]} - found
            found |= new
            left += new
        return frozenset({*uses} - found)

    def definition(self, lhs: Tree) -> tuple[Step, Equation] | None:
        """The last equation with that left side, with its step, among steps without hypotheses in
        ``given`` that are no evaluation of others, and do not invert one; ``None`` if there is
        none."""
        return self._definitions.get(lhs)

    @cached_property
    def _definitions(self) -> dict[Tree, tuple[Step, Equation]]:
        told = ("evaluation", "inversion")
        own = (step for step in self.steps if not step.given and step.rule not in told)
        return {equation.lhs: (step, equation) for step in own for equation in step.equations}


def stated(text: str, *parameters: str, for_all: tuple[str, ...] = ()) -> list[Equation]:
    """``Z = A⁻¹α,  w = A⁻¹τ``: equations, with a comma and two spaces between them."""
    found = []
    for equation in re.split(r",\s\s+", text):
        lhs, equal, rhs = equation.partition(" = ")
        if not equal:
            raise FormulaError(f"{equation!r} is no equation")
        found.append(Equation(read(lhs, *parameters), read(rhs, *parameters), for_all))
    return found
