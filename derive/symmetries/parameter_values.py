"""What of L̃ depends on no state: π, parameters, and functions of these and of numbers alone.

A root of a number, √2, is true modulo primes of which it is a square: by others nothing is tried,
and so the field of these roots is kept with all its relations (x^((p + 1)/4) is the root that is a
square itself, so that √2·√3 = √6).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

from ..algebra.residue_vectors import PRIMES, Residues, ResidueSource, primes_from
from ..language.show import show
from ..language.tree import Tree, nodes
from ..problem.problem import ProblemError
from .gradient import Functions, Tape
from .scalar_lagrangian import of_parameters

MOST_PRIMES = 2000
"""So many primes are tried, of which half have each root."""


def leaves_of(t: Tree) -> frozenset[Tree]:
    """The parameters in an expression, and π."""
    return frozenset(
        x for x in nodes(t) if x == "π" or (isinstance(x, tuple) and x and x[0] == "par")
    )


def is_root(t: Tree) -> bool:
    """Is it a square root?"""
    return isinstance(t, tuple) and t[:2] == ("fun", "sqrt")


class ParameterValues:
    """Random values of what an expression has of parameters alone."""

    def __init__(self, tree: Tree):
        seen = [*dict.fromkeys(nodes(tree))]
        self.letters: tuple[Tree, ...] = (
            "π",
            *(x for x in seen if isinstance(x, tuple) and x and x[0] == "par"),
        )
        self.functions: tuple[Tree, ...] = tuple(
            x for x in seen if isinstance(x, tuple) and x[:1] == ("fun",) and of_parameters(x)
        )
        self.roots = tuple(x for x in self.functions if is_root(x))
        self.roots_of_numbers = tuple(x for x in self.roots if not leaves_of(x))

    @cached_property
    def primes(self) -> tuple[int, ...]:
        """As many as ``PRIMES``, modulo which the roots of numbers are true ones."""
        found = [p for p, _ in zip(self._good(), PRIMES, strict=False)]
        if len(found) < len(PRIMES):
            roots = ", ".join(show(x)[:60] for x in self.roots_of_numbers)
            raise ProblemError(
                f"symmetries are sought modulo primes, of which none has {roots}, in its Lagrangian"
            )
        return tuple(found)

    def _good(self) -> Iterator[int]:
        for p, _ in zip(primes_from(PRIMES[0]), range(MOST_PRIMES), strict=False):
            source = ResidueSource(p, 1, 0)
            found = Functions(source)
            for x in self.roots_of_numbers:
                Tape(x).at({}, source, found)
            if all(found.valid):
                yield p

    def drawn(self, count: int, p: int, seed: int) -> dict[Tree, list[int]]:
        """Up to so many values of each at which its roots are true: residues."""
        many = count << (len(self.roots) - len(self.roots_of_numbers))
        source = ResidueSource(p, many, seed)
        found = Functions(source)
        values: dict[Tree, Residues] = {x: source.randint(1, 1) for x in self.letters}
        for x in self.functions:
            values[x] = Tape(x).at(values, source, found).value
        valid = [k for k, holds in enumerate(found.valid) if holds][:count]
        return {x: v.at(valid).values for x, v in values.items()}

    def at(self, t: Tree, values: Mapping[Tree, int], p: int) -> int:
        """The residue of an expression in parameters, by values of what it is made of."""
        source = ResidueSource(p, 1, 0)
        leaves = {x: source.constant(v) for x, v in values.items()}
        found: Residues = Tape(t, self.functions).at(leaves, source, Functions(source)).value
        return found.values[0]
