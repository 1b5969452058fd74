"""The kinds of potentials: each a table, its words, and what the others must know of it."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, ClassVar

from ..language.tree import Tree, add
from .table import (
    Charges,
    End,
    Energy,
    Masses,
    Number,
    OfVolume,
    Pair,
    Positive,
    Rotation,
    Scalar,
    Stiffness,
    Symmetric,
    Table,
    Vector,
    place,
)


class Potential(Table):
    """One potential of a problem.

    ``rank``: in which order kinds are told. ``phrase``, ``several``: what acts, in words.
    ``drawn``: is it in the figure? ``legend``: what the figure says of it. ``unturned``: what
    ``--frame principal`` cannot carry into its frame; empty where its vectors may be turned with
    space, its points put to new places, and one factor of each term of U is a key with ``mass``,
    which is scaled. ``alone``: there is one of the kind. ``linear``: is the force per mass linear
    in the place, at each point of a body?
    """

    section, timed = "potential", True
    rank: ClassVar[int] = 100
    phrase: ClassVar[str]
    several: ClassVar[str] = ""
    legend: ClassVar[str] = ""
    drawn: ClassVar[bool] = False
    unturned: ClassVar[str] = "a potential of this kind"
    alone: ClassVar[bool] = False
    linear: ClassVar[bool] = False

    @property
    def summed(self) -> bool:
        """Is this potential a sum with a term for every point?"""
        return any(about.type == "masses" for about in self.keys().values())

    def points(self) -> Iterator[int]:
        """The points and places that it names by their numbers."""
        for _, about, value in self.values():
            if about.type in ("pair", "end", "points"):
                yield from (value,) if about.type == "end" else value


class Gravity(Potential):
    """U = −Σ m_i ⟨g, r_i⟩, a uniform acceleration g of all masses; several add up."""

    kind, rank, phrase, drawn = "gravity", 0, "its weight", True
    unturned = ""
    needs = ("one space",)
    g: Vector

    @classmethod
    def word(cls, *g: Number | Sequence[Number]) -> Any:
        """Uniform gravity, U = −Σ m_i ⟨g, r_i⟩; the entries of g, or g as a list."""
        return {"g": g[0] if len(g) == 1 and isinstance(g[0], list) else g}


def gravity(potentials: Iterable[Potential]) -> tuple[Tree, ...] | None:
    """The acceleration of gravity, the sum of all that are given."""
    given = [p.g for p in potentials if isinstance(p, Gravity)]
    return tuple(add(*entries) for entries in zip(*given, strict=True)) if given else None


class Spring(Potential):
    """U = ½ k (‖s‖ − ℓ)² ``between`` two points, counted from 1; or ``on`` one and from it to an
    ``anchor`` in space."""

    kind, rank, phrase, drawn = "spring", 1, "a spring", True
    unturned = ""
    several, legend = "{n} springs", "Zigzags are springs."
    between: Pair | None = None
    on: End | None = None
    anchor: Vector | None = None
    stiffness: Stiffness
    length: Scalar = 0

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """Either ``between``, or an end with an ``anchor``."""
        if "between" in table:
            if any(x in table for x in ("at", "on", "anchor", "block")):
                return "give either 'between' or an end with an 'anchor'"
            return "between", "stiffness", "length"
        if "anchor" not in table:
            ends = "'between', or 'on' or 'at'" if last else "'at', a place of the body,"
            return f"give {ends} with an 'anchor'"
        return "on", "anchor", "stiffness", "length"

    @classmethod
    def word(
        cls,
        i: int | Sequence[Number],
        j: int | Sequence[Number],
        stiffness: Number,
        length: Number = 0,
        block: int | None = None,
    ) -> Any:
        """A spring, U = ½ k (‖s‖ − length)², between points i and j; or from point i, or a place i
        of the body, in a product of that of a block, to an anchor j in space."""
        between = {"between": [i, j], "block": block}
        ends = between if isinstance(j, int) else place(i, block) | {"anchor": j}
        return {"stiffness": stiffness, "length": length, **ends}

    @property
    def ends(self) -> tuple[int, int | None]:
        """The two points, or the one."""
        if self.between:
            return self.between
        assert self.on
        return self.on, None


def quadratic(potentials: Iterable[Potential], block: Callable[[int], int]) -> tuple[Spring, ...]:
    """Springs of natural length 0 inside one block: their energy is quadratic in A alone."""
    springs = (p for p in potentials if isinstance(p, Spring) and p.between and p.length == 0)
    return tuple(p for p in springs if p.between and len({*map(block, p.between)}) == 1)


class Attraction(Potential):
    """U = −Σ m_i μ / ‖r_i − centre‖ over the points that have a mass; or over those of ``on``
    (counted from 1) with the masses there, whatever they weigh in the body."""

    kind, rank, phrase, drawn = "attraction", 2, "the attraction of a centre", True
    unturned = ""
    legend = "Dashed lines lead to the centre of attraction."
    needs = ("points alone", "one space")
    strength: Scalar
    centre: Vector = ()
    on: Masses = ()


class Expression(Potential):
    """Any U of the time and of the places of the points in space: in entries of r_i(t), which a
    file writes r1_x, r1_y, …, and t."""

    kind, called, rank = "expression", "Potential", 3
    phrase = "a potential given as an expression"
    legend = "The potential given as an expression is not drawn."
    unturned = "a potential given as an expression of the places"
    U: Energy

    @classmethod
    def word(cls, U: str) -> Any:
        """Any potential, an expression U in r1_x, r2_y, …, t and the parameters."""
        return {"U": U}


class FarCentre(Potential):
    """The gravity of a far centre, U = −GM(m/R − ⟨n, Ac⟩/R² + (3⟨n, AJĀn⟩ − Tr AJĀ)/2R³), n = T/R.

    ``strength``: GM.  T is seen from the ``centre``, a place in space.

    These are the first terms of −GM Σ m_i/‖T + A r_i‖ in the size of the body over R = ‖T‖: those
    of order R⁻⁴ are dropped.
    """

    kind, phrase = "far_centre", "the gravity of a far centre"
    legend = "The far centre of attraction is not drawn."
    needs, alone = ("affine of R^3",), True
    unturned = "the gravity of a far centre, an expansion about the origin of the file,"
    strength: Scalar
    centre: Vector = ()


class Field(Potential):
    """U = −Σ q_i ⟨E(t), r_i⟩, a uniform field E on charged points: a vector of space; ``charges``:
    q_i, one for each point."""

    kind, phrase, several = "field", "a field on charged points", "{n} fields on charged points"
    legend = "Fields are not drawn."
    needs = ("one space",)
    unturned = "a field on charged points"
    E: Vector
    charges: Charges


class Harmonic(Potential):
    """U = ½ Σ m_i ⟨r_i, W r_i⟩, a force per mass that is linear in the place.

    ``W``: symmetric, the squares of the frequencies of a point by itself, along their axes; the
    force of a mass m at r is −m W r, so that with negative numbers it is driven away."""

    kind, phrase, several = "harmonic", "a harmonic force", "{n} harmonic forces"
    legend = "A harmonic force is not drawn."
    unturned = "a harmonic force, which has axes in space,"
    linear = True
    needs = ("no turning",)
    W: Symmetric


class SelfGravity(Potential):
    """The gravity of a homogeneous ellipsoid on itself, U = −(3/10) G m² ∫₀^∞ du / √det(S + u).

    ``G``: the constant of gravitation.  The ellipsoid {⟨r, K⁻¹r⟩ ≤ 1} of the body is carried to
    {⟨x, S⁻¹x⟩ ≤ 1}, S = AKĀ.

    Ψ and Ψ_k, of I_1, I_2 and I_3, are integrals with P(u) = u³ + I₁u² + I₂u + I₃ = det(S + u).
    """

    kind, phrase, alone = "self_gravity", "its own gravity", True
    linear = True  # in the place, inside a homogeneous ellipsoid (Newton, Maclaurin)
    legend = "The gravity of the body on itself is not drawn."
    needs = ("deformations of R^3", "one ellipsoid")
    unturned = "the gravity of a body on itself"
    G: Positive


class Torsion(Potential):
    """U = ½ k Tr(1 − R̄A), a spring that turns the body back to the rotation R = ``rest``; without
    that to A = 1.  For an angle θ from there U = k(1 − cos θ) in R³."""

    kind, phrase, several = "torsion", "a torsion spring", "{n} torsion springs"
    legend = "Torsion springs are not drawn."
    needs = ("rotations",)
    unturned = "a torsion spring, which rests at axes of the file,"
    stiffness: Stiffness
    rest: Rotation = ()


class Volume(Potential):
    """U(det A), the internal energy of what is deformed homogeneously.

    ``U``: in ``det_A``, the volume over the one at A = 1, t and the parameters."""

    kind, phrase, several = "volume", "an energy of the volume", "{n} energies of the volume"
    legend = "An energy of the volume is not drawn."
    needs = ("volumes",)
    unturned = "an energy of the volume"
    U: OfVolume


def kinds() -> dict[str, type[Potential]]:
    """Every kind by its name, in the order in which they are told."""
    found = sorted(Potential.__subclasses__(), key=lambda x: (x.rank, x.kind))
    return {x.kind: x for x in found}
