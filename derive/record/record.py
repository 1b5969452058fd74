"""The record: a derivation as data.

``Derivation`` = the problem, the declared symbols and the ordered steps.  A step names the rule it
used and the earlier steps it rests on; its equations are pairs of trees.  Nothing here computes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..language.limits import Refused
from ..language.tree import Tree, names
from .claims import Claim
from .contract import ANY_GROUP
from .hypotheses import Hypothesis
from .name_types import Use
from .rules import RULES
from .sentence import Prose


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
