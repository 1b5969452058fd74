"""A part of a record, and a step in the making.

What a step uses is noted, not listed by hand: an expression bears the labels of the steps it was
made from (``Expr.lineage``; where a function says again what a step said, it marks it with that
label), and a draft notes those of all that it writes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from ..algebra.word_trees import PLAIN, WordNotation, tree_of
from ..algebra.words import Expr
from ..language.tree import Tree
from ..record.record import ANY_GROUP, Equation, Hypothesis, Step
from ..record.sentence import Claim, Prose, Sentence, rendered
from .failure import begin, end


@dataclass(frozen=True)
class Chapter:
    """A part of a record: ``name`` prefixes the labels of its steps, whose equations hold on
    ``scope``; ``driven``: does an input or damping act in them?"""

    name: str
    scope: str = ANY_GROUP
    driven: bool = False

    def with_input(self) -> Chapter:
        """The same chapter for steps in which an input or damping acts."""
        return replace(self, driven=True)

    def label(self, short: str) -> str:
        """The label of a step of this chapter: ``so3.kernel`` for ``kernel``."""
        return f"{self.name}.{short}"

    def draft(self, label: str, rule: str) -> Draft:
        """A step of this chapter in the making, by its label without the chapter and its rule."""
        return Draft(self, self.label(label), rule)


class Draft:
    """A step in the making: it notes what each expression that it writes was made from."""

    def __init__(self, chapter: Chapter, label: str, rule: str):
        self.chapter, self.label, self.rule = chapter, label, rule
        self.uses: dict[str, None] = {}
        self.claims: list[Claim] = []
        begin(label, rule)

    def depends_on(self, *made: Expr | Step) -> None:
        """Note among the uses of this step what an expression was made from, or another step."""
        for x in made:
            marks = (x.label,) if isinstance(x, Step) else sorted(x.lineage)
            self.uses |= dict.fromkeys(marks)

    def tree(self, e: Expr, notation: WordNotation = PLAIN) -> Tree:
        """The tree of an expression, whose origin is noted among the uses of this step."""
        self.depends_on(e)
        return tree_of(e, notation)

    def claim(self, key: str, **places: Tree | Sentence) -> Prose:
        """A sentence of this step that says more than its equations, by its key, and the values or
        phrases in its places; it is noted among the claims of the step."""
        phrases = {name: x for name, x in places.items() if isinstance(x, Sentence)}
        values = ((name, x) for name, x in places.items() if not isinstance(x, Sentence))
        self.claims.append(Claim(key, tuple(values)))
        return (rendered(self.claims[-1], **phrases),)

    def step(
        self,
        equations: Iterable[Equation],
        prose: Prose,
        paper: Sequence[int] = (),
        where: Iterable[Equation] = (),
        hypotheses: Iterable[Hypothesis] = (),
    ) -> Step:
        """The step, finished: its equations hold where those of ``where`` and its ``hypotheses``
        do."""
        written = tuple(equations)  # before the uses are read off, for it may be a generator
        c = self.chapter
        end(self.label, self.rule)
        return Step(
            self.label,
            self.rule,
            tuple(self.uses),
            written,
            prose,
            tuple(paper),
            c.scope,
            tuple(where),
            c.driven,
            tuple(hypotheses),
            tuple(self.claims),
        )

    def mark(self, e: Expr) -> Expr:
        """The same expression, marked as made by this step: who uses it uses this step."""
        return e.marked(self.label)
