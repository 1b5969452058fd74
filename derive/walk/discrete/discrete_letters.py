"""The letters of the discrete road: g₀, g₁, g₂, their variations, the step h."""

from __future__ import annotations

from collections.abc import Iterable

from ...algebra.calculus import substitute
from ...algebra.word_trees import WordNotation
from ...algebra.words import Dim, Expr, Letter, word
from ...language.tree import Tree
from ..inverse import inverse_letter, inverse_tree


class DiscreteAlphabet:
    """The letters of three elements of a group that moves points by n × n matrices; affine maps
    are those of r̂ = (r, 1), of size ``n`` = "size" where any, with a hat on what has that size."""

    def __init__(self, n: Dim, *, affine: bool = False):
        self.n, self.affine = n, affine
        hat = "\u0302" if affine else ""
        self.m_i, self.r_i = Letter("m_i"), Letter(f"r{hat}_i", n)
        self.h = Letter("h")
        self.J = Letter("Ĵ" if affine else "J", n, n, 1)
        self.g = tuple(Letter(f"g_{k}", n, n) for k in range(3))
        self.d_g = tuple(Letter(f"δg_{k}", n, n) for k in range(2))
        self.dp_g = tuple(Letter(f"δ′g_{k}", n, n) for k in range(2))
        self.second = tuple(Letter(f"δδ′g_{k}", n, n) for k in range(2))
        self.U = tuple(Letter(f"U_{k}") for k in range(2))
        self.d_U = tuple(Letter(f"δU_{k}") for k in range(2))
        self.dp_U = tuple(Letter(f"δ′U_{k}") for k in range(2))
        self.second_U = tuple(Letter(f"δδ′U_{k}") for k in range(2))
        self.N = tuple(Letter(f"N{hat}_{k}", n, n) for k in range(2))
        self.xi = Letter(f"ξ{hat}", n, n)
        self.difference = across(self.g)

    @property
    def chapter(self) -> str:
        """The name of the chapter about any group with this action."""
        return "discrete_affine" if self.affine else "discrete"

    @property
    def letters(self) -> tuple[Letter, ...]:
        """The letters of the motion."""
        return (*self.g, *self.N, *self.d_g, bend(self.g), self.J, self.xi, self.h)

    @property
    def place(self) -> Tree:
        """The tree of r_i."""
        return ("at", self.r_i.name.removesuffix("_i"), "i")

    @property
    def notation(self) -> WordNotation:
        """How words are written, without metrics."""
        return stepped(self.g, self.h)

    @property
    def step(self) -> Expr:
        """g₁ − g₀ on words."""
        return word(self.g[1]) - word(self.g[0])


def stepped(x: tuple[Letter, ...], h: Letter) -> WordNotation:
    """How words in x₀, x₁, x₂ are written: h⁻¹, x₁ − x₀ and x₂ − 2x₁ + x₀ as they are."""
    first, second, third = (y.name for y in x)
    display: dict[Letter, Tree] = {
        inverse_letter(h): inverse_tree(h),
        across(x): ("add", second, ("mul", -1, first)),
        bend(x): ("add", third, ("mul", -2, second), first),
    }
    return WordNotation(display=display)


def across(x: tuple[Letter, ...]) -> Letter:
    """The letter that stands for x₁ − x₀."""
    return Letter(f"{x[1].name} − {x[0].name}", x[0].rows, x[0].cols)


def bend(x: tuple[Letter, ...]) -> Letter:
    """The letter that stands for x₂ − 2x₁ + x₀."""
    first, second, third = (y.name for y in x)
    return Letter(f"{third} − 2{second} + {first}", x[0].rows, x[0].cols)


def opened(x: tuple[Letter, ...]) -> dict[Letter, Expr]:
    """x₂ − 2x₁ + x₀ for the letter that stands for it."""
    first, second, third = map(word, x)
    return {bend(x): third - 2 * second + first}


def respelled(e: Expr, letters: Iterable[Letter], n: Dim) -> Expr:
    """An expression about any n in ``letters``, which have the same names."""
    mine = {x.name: word(x) for x in letters}
    images = {x: mine[x.name] for x in e.letters() if x.name in mine}
    rows, cols = (n if isinstance(x, str) else x for x in (e.rows, e.cols))
    return substitute(Expr(rows, cols, e.terms, e.lineage), images)
