"""The letters of a fluid: those of an affine group, with G and ∇ in the place of matrices.

    ν = Gu,  δg = Gη,  δG = G∇_η          τ = Aw,  δT = Aη,  δA = Aξ

G is the composition with g, (Gc)(r) = c(g(r)), and ∇_c the derivative of fields along c: so the
structure equation, the trivialisation and dϖ are those of the walk of the affine groups.
"""

from __future__ import annotations

from ...algebra.vector_fields import along
from ...algebra.words import Expr, Letter, one, word
from ..alphabet import AlgebraPart, Alphabet, SpacePart, members


class FluidAlphabet(Alphabet):
    """The letters of a problem of this name; ``advected``: the density varies from place to place,
    and ḠG is the product with it, else 1; ``forced``: per unit mass, f = −grad V acts."""

    def __init__(self, name: str, *, advected: bool, forced: bool):
        super().__init__("n", affine=True)
        self.name, self.advected, self.forced = name, advected, forced
        operator = [Letter(x, self.n, self.n) for x in self._part("G", "Ġ")]
        field = [Letter(x, self.n) for x in self._part("g", "ν")]
        self.A, self.T = SpacePart("Ġ", *operator), SpacePart("ġ", *field)
        names = ("u", "η", "η′", "δu", "δ′u", "u̇", "δδ′η", "δδ′u")
        self.w = AlgebraPart(*(Letter(x, self.n) for x in names))
        self.Z = AlgebraPart(*map(along, self.w_letters))
        self.C = Letter("ρ", self.n, self.n, 1)
        self.D, self.p, self.V = Letter("D", "k", self.n), Letter("p", "k"), Letter("V", "k")
        self.force = Letter("f", self.n)
        self.moved_field, self.moved_rate = Letter("ϑ", self.n), Letter("ϑ̇", self.n)

    @property
    def chapter(self) -> str:
        """All of the record is about this group: its labels begin with the problem's name."""
        return self.name

    def label(self, short: str) -> str:
        """The label of a step, by its label without the problem's name."""
        return f"{self.name}.{short}"

    @property
    def parts(self) -> tuple[SpacePart, ...]:
        """The letters of g."""
        return (self.T,)

    @property
    def algebra_parts(self) -> tuple[AlgebraPart, ...]:
        """The letters of u."""
        return (self.w,)

    @property
    def w_letters(self) -> list[Letter]:
        """The letters of u, η, η′ and so on, in the order of their part."""
        return [x for x in members(self.w) if isinstance(x, Letter)]

    @property
    def volume(self) -> Expr:
        """ḠG: the density ρ, or 1."""
        return word(self.C) if self.advected else one(self.n)

    @property
    def metric(self) -> str:
        """The name of the letter that is written as a metric; "" for 1."""
        return self.C.name if self.advected else ""
