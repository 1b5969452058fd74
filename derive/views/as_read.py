"""A record as it is read: common factors of parameters before their sum, l²(m₁ + m₂); in a product
of groups the entries of g by the blocks of the factors, as problem files type them: A₃₃ of two
rotations of the plane, A2_11 in a file, is (A₂)₁₁."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace

from ..algebra.families import group
from ..algebra.groups import Group
from ..language.show import show
from ..language.tree import Tree, add, mul
from ..record.record import Derivation, Equation, Step, Symbol
from ..record.sentence import Prose, Sentence, phrase

OF_G = ("A", "Ȧ")
"""The letters of matrices that have a block for each factor."""
MEANING = "{meaning}; its blocks are {blocks}"


class Reading:
    """How equations and sentences of a record are read, by the name of its group."""

    def __init__(self, name: str):
        factors = group(name).factors if " x " in name else ()
        self.count = len(factors)
        self.named = _entries(group(name)) if factors else {}
        self.texts = {show(old): show(new) for old, new in self.named.items()}
        self.found = re.compile("|".join(rf"{re.escape(x)}(?!,?[₀-₉])" for x in self.texts))

    def tree(self, t: Tree) -> Tree:
        """A tree as it is read."""
        if not isinstance(t, tuple) or t[0] == "par":
            return t
        if t in self.named:
            return self.named[t]
        return factored((t[0], *map(self.tree, t[1:])))

    def equation(self, e: Equation) -> Equation:
        """An equation as it is read."""
        return replace(e, lhs=self.tree(e.lhs), rhs=self.tree(e.rhs))

    def text(self, text: str) -> str:
        """A text with its entries of g by their blocks."""
        return self.found.sub(lambda x: self.texts[x[0]], text) if self.texts else text

    def _prose(self, said: Prose) -> Prose:
        return tuple(
            Sentence(x.message, tuple((place, self._filled(y)) for place, y in x.places))
            for x in said
        )

    def _filled(self, x: Sentence | str) -> Sentence | str:
        return self.text(x) if isinstance(x, str) else self._prose((x,))[0]

    def step(self, s: Step) -> Step:
        """A step as it is read."""
        equations = tuple(map(self.equation, s.equations))
        return replace(s, equations=equations, prose=self._prose(s.prose))

    def symbol(self, x: Symbol) -> Symbol:
        """A symbol; that of g with its blocks."""
        if x.name != "A" or not self.count:
            return x
        blocks = ", ".join(show(("at", "A", k + 1)) for k in range(self.count))
        return replace(x, meaning=(phrase(MEANING, meaning=x.meaning[0], blocks=blocks),))


def as_read(d: Derivation) -> Derivation:
    """The record as it is read; to be shown, not to be checked."""
    reading = Reading(str(d.problem["group"]))
    steps, symbols = map(reading.step, d.steps), map(reading.symbol, d.symbols)
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


def factored(t: Tree) -> Tree:
    """A sum of products of parameters with the factors of all of them before it; any other tree as
    it is."""
    if not isinstance(t, tuple) or t[0] != "add":
        return t
    terms = [_powers(x) for x in t[1:]]
    if not all(terms):
        return t
    common = terms[0].copy()
    for x in terms[1:]:
        common &= x
    if not common:
        return t
    return mul(*_product(common), add(*(mul(*_product(x - common)) for x in terms)))


def _powers(t: Tree) -> Counter[Tree]:
    """How often each parameter is a factor of a product of them and of a number; empty for another
    tree."""
    found: Counter[Tree] = Counter()
    for x in t[1:] if isinstance(t, tuple) and t[0] == "mul" else (t,):
        base, power = x[1:] if isinstance(x, tuple) and x[0] == "pow" else (x, 1)
        if not (isinstance(base, tuple) and base[0] == "par" and isinstance(power, int)):
            return Counter()
        found[base] += power
    return found


def _product(powers: Counter[Tree]) -> list[Tree]:
    return [("pow", x, k) if k > 1 else x for x, k in powers.items()] or [1]
