"""The letters of the walk."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from ...algebra.calculus import PairRule, map_terms, substitute
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation
from ...algebra.words import Dim, Expr, Factor, Letter, Traces, Word, one, word
from ...language.tree import Tree


@dataclass(frozen=True)
class SpacePart:
    """The letters of one part x of g, in space: x, ẋ, δx, δ′x, δẋ, δ′ẋ, ẍ and the second variations
    δδ′x, δδ′ẋ.

    ``rate`` is the name of dx/dt along the motion.
    """

    rate: str
    position: Letter
    velocity: Letter
    d_position: Letter
    dp_position: Letter
    d_velocity: Letter
    dp_velocity: Letter
    acceleration: Letter
    second: Letter
    second_velocity: Letter


@dataclass(frozen=True)
class AlgebraPart:
    """The letters of a part carried to the identity by g⁻¹: Z, ξ, ξ′, δZ, δ′Z, Ż, δδ′ξ, δδ′Z (of T:
    w, η, …)."""

    velocity: Letter
    xi: Letter
    xi_prime: Letter
    d_velocity: Letter
    dp_velocity: Letter
    acceleration: Letter
    second: Letter
    second_velocity: Letter


@dataclass(frozen=True)
class Dual:
    """The letters in 𝔤* that pair with those of a part carried to the identity: a momentum P, δP,
    δ′P, Ṗ, and F, the derivative of L̃ along g."""

    momentum: Letter
    d_momentum: Letter
    dp_momentum: Letter
    rate: Letter
    force: Letter

    @property
    def letters(self) -> tuple[Letter, ...]:
        """P, δP, δ′P, Ṗ and F, in this order."""
        return self.momentum, self.d_momentum, self.dp_momentum, self.rate, self.force


class Alphabet:
    """The letters of one group that moves points of Rⁿ, linearly or affinely.

    ``n``: a number, or a name where n is any. ``skew``: Z and its kin are skew, as in so(n);
    ``traceless``: their trace vanishes, as in sl(n). ``signed``: masses may be negative.
    """

    def __init__(
        self,
        n: Dim,
        *,
        affine: bool,
        skew: bool = False,
        traceless: bool = False,
        signed: bool = False,
    ):
        self.n = n
        self.affine = affine
        self.signed = signed
        self.t, self.dt, self.dpt = (Letter(x) for x in ("t", "δt", "δ′t"))
        self.m, self.c, self.J = Letter("m"), Letter("c", n), Letter("J", n, n, 1)
        self.m_i, self.r_i, self.F_i = Letter("m_i"), Letter("r_i", n), Letter("F_i", n)
        self.difference = Letter("r_i − r_j", n)
        self.U, self.dU_dt = Letter("Ũ"), Letter("∂ₜŨ")
        self.F_group, self.f = Letter("F̃", n, n), self._algebra("f", skew, traceless)
        self.N, self.F = Letter("N", n, n), Letter("F", n)
        self.N_body, self.F_body = Letter("N_b", n, n), Letter("F_b", n)
        self.C = Letter("C", n, n, 1)
        self.bracket = self._algebra("[ξ′, ξ]", skew, True)
        self.bracket_w = Letter("ξ′η − ξη′", n)
        linear = (Letter(x, n, n) for x in self._part("A", "α"))
        vector = (Letter(x, n) for x in self._part("T", "τ"))
        self.A, self.T = SpacePart("Ȧ", *linear), SpacePart("Ṫ", *vector)
        names = ("Z", "ξ", "ξ′", "δZ", "δ′Z", "Ż", "δδ′ξ", "δδ′Z")
        self.Z = AlgebraPart(*(self._algebra(x, skew, traceless) for x in names))
        names = ("w", "η", "η′", "δw", "δ′w", "ẇ", "δδ′η", "δδ′w")
        self.w = AlgebraPart(*(Letter(x, n) for x in names))
        self.Pi = Dual(*(Letter(x, n, n) for x in ("Π", "δΠ", "δ′Π", "Π̇", "Φ")))
        self.p_b = Dual(*(Letter(x, n) for x in ("p_b", "δp_b", "δ′p_b", "ṗ_b", "F_b")))
        spin = [Letter(x, n, n, -1) for x in ("ℓ_b", "δℓ_b", "δ′ℓ_b", "ℓ̇_b")]
        self.spin = Dual(*[*spin, self.N_body])

    @staticmethod
    def _part(x: str, v: str) -> tuple[str, ...]:
        return x, v, "δ" + x, "δ′" + x, "δ" + v, "δ′" + v, v + "\u0307", "δδ′" + x, "δδ′" + v

    def _algebra(self, name: str, skew: bool, traceless: bool) -> Letter:
        return Letter(name, self.n, self.n, -1 if skew else 0, traceless)

    @property
    def chapter(self) -> str:
        """The name of the chapter about any group with this action: ``linear`` or ``affine``."""
        return "affine" if self.affine else "linear"

    @property
    def body_forces(self) -> tuple[tuple[Letter, Letter], ...]:
        """(N, N_b) and (F, F_b): moments and resultant of the forces, in space and in the body."""
        return (self.N, self.N_body), (self.F, self.F_body)

    @property
    def parts(self) -> tuple[SpacePart, ...]:
        """The letters of A, and of T for an affine action."""
        return (self.A, self.T) if self.affine else (self.A,)

    @property
    def algebra_parts(self) -> tuple[AlgebraPart, ...]:
        """The letters of Z, and of w for an affine action, in the order of :attr:`parts`."""
        return (self.Z, self.w) if self.affine else (self.Z,)

    @property
    def duals(self) -> tuple[Dual, ...]:
        """The letters of Π, and of p_b for an affine action, which pair with those of
        :attr:`algebra_parts`."""
        return (self.Pi, self.p_b) if self.affine else (self.Pi,)

    def with_free_displacement(self) -> Alphabet:
        """The same alphabet with ξ′ any matrix, so that what pairs with it is a whole matrix."""
        copy = Alphabet(self.n, affine=self.affine)
        vars(copy).update(vars(self))
        copy.Z = replace(self.Z, xi_prime=Letter(self.Z.xi_prime.name, self.n, self.n))
        return copy

    def acted_on(self, linear: Expr, translation: Expr) -> Expr:
        """``A r_i + T`` with the given A and T."""
        image = linear * word(self.r_i)
        return image + translation if self.affine else image

    def letters(self) -> dict[str, Letter]:
        """Every letter of the alphabet by its name."""
        found: dict[str, Letter] = {}
        for value in vars(self).values():
            own = members(value) if isinstance(value, (SpacePart, AlgebraPart, Dual)) else [value]
            found |= {x.name: x for x in own if isinstance(x, Letter)}
        return found

    def respell(self, e: Expr, C: Expr | None = None) -> Expr:
        """An expression of another alphabet in the letters of the same names here, which know more,
        and with ``C`` for C, if that is said."""
        mine = self.letters()
        images = {x: word(mine[x.name]) for x in e.letters() if x.name in mine}
        if C is not None:
            images |= {x: C for x in e.letters() if x.name == self.C.name}
        return of_size(e, images, self.n)

    @property
    def unit(self) -> Expr:
        """The n × n identity matrix."""
        return one(self.n)


def members(value: SpacePart | AlgebraPart | Dual) -> list[object]:
    """The values of all the fields of a part, in space or in 𝔤, or of a dual."""
    return [getattr(value, name) for name in value.__dataclass_fields__]


def of_matrices(group: Group) -> Alphabet:
    """The alphabet of all matrices of the size of a group's, neither skew nor traceless."""
    return Alphabet(group.n, affine=group.affine)


def of_size(e: Expr, images: Mapping[Letter, Expr], n: Dim) -> Expr:
    """An expression about any n with ``images`` of its letters, those of this ``n``."""
    rows, cols = (n if isinstance(x, str) else x for x in (e.rows, e.cols))
    return substitute(Expr(rows, cols, e.terms, e.lineage), images)


# Inverse letters: x⁻¹ as a letter with the relation x⁻¹x = xx⁻¹ = 1.


def inverse_letter(x: Letter) -> Letter:
    """The letter x⁻¹, with the symmetry of x."""
    return Letter(f"{x.name}⁻¹", x.rows, x.cols, x.symmetry)


def inverse_tree(x: Letter) -> Tree:
    """The tree of x⁻¹."""
    return ("inv", x.name)


def inverses(*letters: Letter) -> WordNotation:
    """The notation that writes the letters x⁻¹ of these as inverses."""
    return WordNotation(display={inverse_letter(x): inverse_tree(x) for x in letters})


def cancelling(*letters: Letter) -> PairRule:
    """The relations x⁻¹x = 1 and xx⁻¹ = 1 for these matrix letters."""
    inverses = {inverse_letter(x): x for x in letters}

    def rule(left: Factor, right: Factor) -> Expr | None:
        pair = (left[0], right[0])
        inverse = any(inverses.get(x) == y for x, y in (pair, pair[::-1]))
        return one(left[0].rows) if inverse and left[1] == right[1] else None

    return rule


def cancel_scalar(e: Expr, x: Letter) -> Expr:
    """An expression with x x⁻¹ = 1 for the scalar letter x, as m."""
    up, down = ((x, False),), ((inverse_letter(x), False),)

    def cancelled(traces: Traces, w: Word, c: Fraction) -> Expr:
        kept = list(traces)
        while up in kept and down in kept:
            kept.remove(up)
            kept.remove(down)
        return e.like({(tuple(kept), w): c})

    return map_terms(e, cancelled)
