"""A record of a product of groups as it is read: the entries of g by the blocks of the factors, as
problem files type them; A₃₃ of two rotations of the plane, A2_11 in a file, is (A₂)₁₁."""

from __future__ import annotations

import re
from dataclasses import replace

from ..algebra.families import group
from ..algebra.groups import Group
from ..language.show import show
from ..language.tree import Tree
from ..record.record import Derivation, Equation, Step, Symbol
from ..record.sentence import Prose, Sentence, phrase

OF_G = ("A", "Ȧ")
"""The letters of matrices that have a block for each factor."""
MEANING = "{meaning}; its blocks are {blocks}"


class Blocks:
    """The entries of g in a product of groups, by the blocks of its factors."""

    def __init__(self, product: str):
        g = group(product)
        self.count = len(g.factors)
        self.named = _entries(g) if self.count > 1 else {}
        self.texts = {show(old): show(new) for old, new in self.named.items()}
        self.found = re.compile("|".join(rf"{re.escape(x)}(?![₀-₉,])" for x in self.texts))

    def tree(self, t: Tree) -> Tree:
        """A tree with its entries so."""
        if not isinstance(t, tuple):
            return t
        return self.named[t] if t in self.named else (t[0], *map(self.tree, t[1:]))

    def equation(self, e: Equation) -> Equation:
        """An equation with its entries so."""
        return replace(e, lhs=self.tree(e.lhs), rhs=self.tree(e.rhs))

    def text(self, text: str) -> str:
        """A text with its entries so."""
        return self.found.sub(lambda x: self.texts[x[0]], text)

    def _prose(self, said: Prose) -> Prose:
        return tuple(
            Sentence(x.message, tuple((place, self._filled(y)) for place, y in x.places))
            for x in said
        )

    def _filled(self, x: Sentence | str) -> Sentence | str:
        return self.text(x) if isinstance(x, str) else self._prose((x,))[0]

    def step(self, s: Step) -> Step:
        """A step with its entries so."""
        equations = tuple(map(self.equation, s.equations))
        return replace(s, equations=equations, prose=self._prose(s.prose))

    def symbol(self, x: Symbol) -> Symbol:
        """A symbol; that of g with its blocks."""
        if x.name != "A":
            return x
        blocks = ", ".join(show(("at", "A", k + 1)) for k in range(self.count))
        return replace(x, meaning=(phrase(MEANING, meaning=x.meaning[0], blocks=blocks),))


def blocks_of(d: Derivation) -> Blocks | None:
    """The blocks of the group of a record; ``None`` where it is no product."""
    name = str(d.problem["group"])
    return Blocks(name) if " x " in name else None


def by_block(d: Derivation) -> Derivation:
    """The record with each entry of g by its block, where its group is a product; to be read."""
    if (blocks := blocks_of(d)) is None:
        return d
    steps, symbols = map(blocks.step, d.steps), map(blocks.symbol, d.symbols)
    return replace(d, steps=tuple(steps), symbols=tuple(symbols))


def _entries(g: Group) -> dict[Tree, Tree]:
    """Each entry of g by the rows and columns of the whole → by those of its block."""
    spans = [(k, at, range(1, x.size + 1)) for k, (at, x) in enumerate(g.places, 1)]
    return {
        ("entry", letter, at + i, at + j): ("entry", ("at", letter, k), i, j)
        for letter in OF_G
        for k, at, span in spans
        for i in span
        for j in span
    }
