"""What acts from outside on a fluid on the torus, as its program reads it."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

from ..algebra.structure import TorusLattice
from ..language.derivatives import derivative
from ..language.expression import names
from ..language.show import show
from ..language.tree import Tree
from ..language.values import value
from ..record.as_json import decode
from ..record.record import Derivation
from .graph import Graph
from .naming import ClaimedNames, plain_text
from .program import EmittedFunction
from .schedule import Scheduler, leaf_places


@dataclass(frozen=True)
class EmittedForcing:
    """What acts from outside in a record: the names of the numbers of its input; ``damping``: a
    coefficient for each power of |n|², 0 where there is none; ``parameters``: those in these."""

    inputs: tuple[str, ...]
    damping: tuple[Tree, ...]
    parameters: tuple[str, ...]

    @staticmethod
    def of(d: Derivation, torus: TorusLattice) -> EmittedForcing:
        """That of a record."""
        told = {x["power"]: decode(x["coefficient"], "damping") for x in d.problem["damping"]}
        inputs = (f"{x['name']}_{y}" for x in d.problem["inputs"] for y in torus.coefficients)
        used = {name for t in told.values() for name in names(t)}
        return EmittedForcing(
            tuple(inputs),
            tuple(told.get(p, 0) for p in range(max(told, default=-1) + 1)),
            tuple(x for x in d.problem["parameters"] if x in used),
        )

    @property
    def damping_slopes(self) -> tuple[Tree, ...]:
        """The derivatives of the coefficients of damping by the parameters, power by power."""
        leaves = [("par", x) for x in self.parameters]
        return tuple(derivative(t, x) for t in self.damping for x in leaves)

    def function(self, wanted: Sequence[Tree], claimed: ClaimedNames) -> EmittedFunction:
        """A function of the parameters alone."""
        graph = Graph()
        known = {x: graph.leaf(x, "parameter") for x in self.parameters}
        given = leaf_places(claimed, known.values(), "p")
        found = [value(t, {}, known, graph.function, graph.num) for t in wanted]
        return Scheduler(claimed, {}).function(found, given)

    def described(self) -> tuple[str, ...]:
        """In words, for the head of a file."""
        found = ["and F = sum f(n) T_n is what acts from outside, where f(n) has"]
        if self.inputs:
            name = self.inputs[0].removesuffix("_re_1_0")
            found.append(
                f"the input {name}: Re and Im of its coefficients, in the order of the state;"
            )
        if self.damping:
            size = {0: ""} | {p: f" |n|^{2 * p}" for p in range(1, len(self.damping))}
            coefficients = ((p, plain_text(show(t))) for p, t in enumerate(self.damping) if t != 0)
            told = [f"({t if t.isascii() else 'a number'}){size[p]}" for p, t in coefficients]
            found += textwrap.wrap(f"the damping -({' + '.join(told)}) omega(n);", 88)
        return tuple(found) if self.inputs or self.damping else ()
