"""The motion of the linear parts of a group: of the group itself, or about the centre of mass."""

from __future__ import annotations

from dataclasses import dataclass

from ...algebra.word_trees import WordNotation
from ...algebra.words import Expr, Letter, word, zero
from ...record.record import Step
from ..inverse import inverse_letter, inverse_tree
from .discrete_letters import stepped
from .discrete_outside import HALF


@dataclass(frozen=True)
class LinearMotion:
    """The motion of the linear parts ``x`` = (x₀, x₁, x₂) of a group: ``balance`` vanishes paired
    with x₁ξ; ``metric``: J, or J_c about the centre of mass; ``damping``: D, by which
    ½(x₂ − x₀)D is added."""

    x: tuple[Letter, ...]
    metric: Letter
    balance: Expr
    damping: Letter | None = None
    steps: tuple[Step, ...] = ()

    @property
    def n(self) -> int:
        """The size of the matrices."""
        assert isinstance(self.metric.rows, int)
        return self.metric.rows

    @property
    def drag(self) -> Expr:
        """What damping adds to the balance, ½(x₂ − x₀)D."""
        if self.damping is None:
            return zero(self.n, self.n)
        return HALF * (word(self.x[2]) - word(self.x[0])) * word(self.damping)

    @property
    def notation(self) -> WordNotation:
        """How words in x are written, with m⁻¹."""
        m = Letter("m")
        display = stepped(self.x, Letter("h")).display
        return WordNotation(display={**display, inverse_letter(m): inverse_tree(m)})
