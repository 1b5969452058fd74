"""The named groups: SO, SE, R, SL, SAff, GL, Aff, Sp, Sim, UT, U and SU, and their products.

A family is a basis and a sampler for each n; brackets, relations and the rest are computed.  The
parameter of Sp is the size of its matrices; U(n) and SU(n) act on R²ⁿ by [[X, −Y], [Y, X]].
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import did_you_mean, near_name
from . import samplers as draw
from .groups import Group
from .samplers import RandomSource, Sampler

Basis = tuple[Matrix, ...]

LARGEST = 8
"""The largest size of the matrices of a named group, without the last row of an affine one."""
LARGEST_PRODUCT = 12
"""The largest size of the matrices of a product."""


def so_basis(n: int) -> Basis:
    """The basis of so(n): skew, ordered and signed so that n = 3 has j(e₁), j(e₂), j(e₃)."""
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)][::-1]
    return tuple(
        q.scaled((-1) ** (i + j), q.minus(q.unit(n, i, j), q.unit(n, j, i))) for i, j in pairs
    )


def sl_basis(n: int) -> Basis:
    """The basis of sl(n): E_ij and E_ii − E_nn; ζ is Z row by row, less its last entry."""
    return tuple(
        q.unit(n, i, j) if i != j else q.minus(q.unit(n, i, i), q.unit(n, n - 1, n - 1))
        for i in range(n)
        for j in range(n)
        if (i, j) != (n - 1, n - 1)
    )


def gl_basis(n: int) -> Basis:
    """The basis of gl(n): all E_ij, row by row."""
    return tuple(q.unit(n, i, j) for i in range(n) for j in range(n))


def ut_basis(n: int) -> Basis:
    """The basis of ut(n): E_ij above the diagonal, row by row."""
    return tuple(q.unit(n, i, j) for i in range(n) for j in range(i + 1, n))


def sim_basis(n: int) -> Basis:
    """The basis of the linear parts of sim(n): that of so(n), then the dilation 1."""
    return (*so_basis(n), q.identity(n))


def symmetric_pairs(n: int) -> list[tuple[int, int]]:
    """The pairs (i, j) with i ≤ j < n, row by row."""
    return [(i, j) for i in range(n) for j in range(i, n)]


def _symmetric(n: int, i: int, j: int) -> Matrix:
    """The symmetric matrix E_ij + E_ji, or E_ii."""
    unit = q.unit(n, i, j)
    return unit if i == j else q.plus(unit, q.unit(n, j, i))


def in_blocks(
    n: int, a: Matrix | None, b: Matrix | None, c: Matrix | None, d: Matrix | None
) -> Matrix:
    """The matrix [[a, b], [c, d]] with n × n blocks, ``None`` for zero."""
    zero = q.scaled(0, q.identity(n))
    top, bottom = (a or zero, b or zero), (c or zero, d or zero)
    return tuple(
        (*x, *y) for left, right in (top, bottom) for x, y in zip(left, right, strict=True)
    )


def sp_basis(size: int) -> Basis:
    """The basis of sp of matrices of an even size: [[a, b], [c, −ā]] with b and c symmetric, so
    that X̄Ω + ΩX = 0 for Ω = [[0, 1], [−1, 0]]."""
    n = size // 2
    linear = [
        in_blocks(n, q.unit(n, i, j), None, None, q.scaled(-1, q.unit(n, j, i)))
        for i in range(n)
        for j in range(n)
    ]
    pairs = symmetric_pairs(n)
    upper = [in_blocks(n, None, _symmetric(n, i, j), None, None) for i, j in pairs]
    lower = [in_blocks(n, None, None, _symmetric(n, i, j), None) for i, j in pairs]
    return (*linear, *upper, *lower)


def _complex(n: int, x: Matrix | None, y: Matrix | None) -> Matrix:
    """The complex matrix X + iY as the real one [[X, −Y], [Y, X]]."""
    return in_blocks(n, x, q.scaled(-1, y) if y else None, y, x)


def u_basis(n: int) -> Basis:
    """The basis of u(n), X + iY: skew X, then symmetric Y off and on the diagonal."""
    skew = [_complex(n, e, None) for e in so_basis(n)]
    off = [_complex(n, None, _symmetric(n, i, j)) for i, j in symmetric_pairs(n) if i != j]
    return (*skew, *off, *(_complex(n, None, q.unit(n, i, i)) for i in range(n)))


def su_basis(n: int) -> Basis:
    """The basis of su(n): that of u(n) with Tr Y = 0."""
    skew_and_off = u_basis(n)[:-n]
    last = q.unit(n, n - 1, n - 1)
    diagonal = (q.minus(q.unit(n, i, i), last) for i in range(n - 1))
    return (*skew_and_off, *(_complex(n, None, y) for y in diagonal))


def sp_sampler(size: int) -> Sampler:
    """A sampler of Sp: products lower · upper · lower · upper of symplectic shears."""
    n = size // 2
    basis = sp_basis(size)
    count = len(symmetric_pairs(n))
    upper, lower = draw.shears(basis[-2 * count : -count]), draw.shears(basis[-count:])
    return draw.product([lower, upper, lower, upper])


def su_sampler(n: int) -> Sampler:
    """A sampler of SU(n), by the SU(2) of pairs of axes, where Cayley's transform keeps det 1."""
    factors = []
    for i in range(n):
        for j in range(i + 1, n):
            skew = _complex(n, q.minus(q.unit(n, i, j), q.unit(n, j, i)), None)
            off = _complex(n, None, _symmetric(n, i, j))
            diagonal = _complex(n, None, q.minus(q.unit(n, i, i), q.unit(n, j, j)))
            factors.append(draw.by_cayley((skew, off, diagonal)))
    return draw.product(factors)


def affine_basis(linear: Sequence[Matrix], n: int) -> Basis:
    """The basis of 𝔥 ⋉ Rⁿ: that of 𝔥 bordered by zeros, then the n translations."""
    last = (Fraction(0),) * (n + 1)
    bordered = [(*((*row, Fraction(0)) for row in e), last) for e in linear]
    return (*bordered, *(q.unit(n + 1, i, n) for i in range(n)))


@dataclass(frozen=True)
class GroupFamily:
    """A family of groups with a parameter n, by a basis and a sampler of their linear parts;
    ``affine``: with all translations.

    ``least``: the smallest n; ``step``: n is a multiple of it; ``doubled``: are the
    matrices of size 2n?
    """

    basis: Callable[[int], Basis]
    sampler: Callable[[int], Sampler]
    least: int
    meaning: str
    affine: bool = False
    step: int = 1
    doubled: bool = False

    @property
    def most(self) -> int:
        """The largest n of a group of the family."""
        return LARGEST // 2 if self.doubled else LARGEST

    def make(self, name: str, n: int) -> Group:
        """The group of this family with the parameter n, called ``name``."""
        size = 2 * n if self.doubled else n
        if self.affine:
            sampler = draw.affine(self.sampler(n), n)
            basis = affine_basis(self.basis(n), n)
            return Group(name, n, "affine", basis, sampler, vectors=len(basis) == n)
        return Group(name, size, "linear", self.basis(n), self.sampler(n))


def _so(n: int) -> Sampler:
    return draw.by_cayley(so_basis(n))


def _sim(n: int) -> Sampler:
    return draw.product([_so(n), draw.dilations(n)])


FAMILIES: dict[str, GroupFamily] = {
    "SO": GroupFamily(so_basis, _so, 2, "rotations, ĀA = 1"),
    "SE": GroupFamily(so_basis, _so, 2, "displacements, r ↦ A r + T with ĀA = 1", affine=True),
    "R": GroupFamily(
        lambda n: (),
        lambda n: lambda random, size: q.identity(n),
        1,
        "translations, r ↦ r + T",
        affine=True,
    ),
    "SL": GroupFamily(sl_basis, draw.special_linear, 2, "volume-preserving linear maps, det A = 1"),
    "SAff": GroupFamily(
        sl_basis, draw.special_linear, 2, "volume-preserving affine maps, SL(n) ⋉ Rⁿ", affine=True
    ),
    "GL": GroupFamily(gl_basis, draw.general_linear, 2, "invertible linear maps"),
    "Aff": GroupFamily(gl_basis, draw.general_linear, 2, "invertible affine maps", affine=True),
    "Sp": GroupFamily(sp_basis, sp_sampler, 2, "symplectic maps of Rⁿ, n even", step=2),
    "Sim": GroupFamily(
        sim_basis, _sim, 2, "similarities: rotations, dilations, translations", affine=True
    ),
    "UT": GroupFamily(
        ut_basis, draw.unitriangular, 2, "upper unitriangular maps; UT(3) is Heisenberg's"
    ),
    "U": GroupFamily(
        u_basis, lambda n: draw.by_cayley(u_basis(n)), 1, "unitary maps of Cⁿ = R²ⁿ", doubled=True
    ),
    "SU": GroupFamily(su_basis, su_sampler, 2, "unitary maps of Cⁿ = R²ⁿ, det = 1", doubled=True),
}
"""Name of a family → the family."""


def group(name: str) -> Group:
    """The group called ``"SO(3)"``, ``"SL(4)"`` or ``"SO(3) x SE(3)"``; ``ValueError`` for any
    other name, with the nearest."""
    parts = re.split(r"(?<=\))\s*[x×]\s*(?=\S)", name.strip()) if len(name) < 200 else [name]
    if len(parts) > 1:
        return product(tuple(_named(x) for x in parts))
    found = _named(parts[0])
    return on_homogeneous(found) if found.vectors else found


def _named(name: str) -> Group:
    """The group of a family that is called so; ``ValueError`` for any other name."""
    match = re.fullmatch(r"([A-Za-z]+)\(\s*([0-9]{1,3})\s*\)", name)
    if match is None or match[1] not in FAMILIES:
        known = ", ".join(f"{family}(n)" for family in FAMILIES)
        hint = did_you_mean(_group_meant(name[:40]), after=" ")
        raise ValueError(
            f"unknown group {name[:40]!r}; {hint}known: {known}, with a number for n, and products "
            "such as 'SO(3) x SO(3)'"
        )
    family, n = FAMILIES[match[1]], int(match[2])
    if not family.least <= n <= family.most or n % family.step:
        even = "even and " if family.step == 2 else ""
        raise ValueError(f"{match[1]}({n}): n must be {even}from {family.least} to {family.most}")
    return family.make(f"{match[1]}({n})", n)


def _group_meant(name: str) -> str:
    """The group that is meant by a name in other letters or without parentheses; "" if none."""
    families, parts = {x.casefold(): x for x in FAMILIES}, []
    for part in re.split(r"\s*[x×*]\s*", name.strip()):
        match = re.fullmatch(r"([A-Za-z]+)[\s_(\[]*([0-9]{1,3})[\s)\]]*", part)
        near = near_name(match[1].casefold() if match else "", families, 0.7)
        if not near or not match:
            return ""
        parts.append(f"{families[near]}({match[2]})")
    return " x ".join(parts)


def product(factors: tuple[Group, ...]) -> Group:
    """The product of groups, of block diagonal matrices; ``ValueError`` where they are too
    large."""
    size = sum(g.size for g in factors)
    name = " x ".join(g.name for g in factors)
    if size > LARGEST_PRODUCT:
        raise ValueError(f"{name[:60]}: matrices of size {size}; at most {LARGEST_PRODUCT}")
    basis, offset = [], 0
    for g in factors:
        before = q.scaled(0, q.identity(offset))
        after = q.scaled(0, q.identity(size - offset - g.size))
        basis += [draw.block_diagonal((before, e, after)) for e in g.basis]
        offset += g.size
    sampler = draw.blocks([g.sampler for g in factors])
    return Group(name, size, "linear", tuple(basis), sampler, factors)


def on_homogeneous(g: Group) -> Group:
    """An affine group as the linear group of its matrices on (r, 1): a product of one factor."""
    return Group(g.name, g.n + 1, "linear", g.basis, g.sampler, (g,), g.larger)


def turning_about_a_point() -> Group:
    """The rotations of R³ about (1, 2, 3): affine maps whose translations are not free."""
    place: Matrix = ((Fraction(1),), (Fraction(2),), (Fraction(3),))
    shift: Matrix = (*((*row, x) for row, (x,) in zip(q.identity(3), place, strict=True)), _LAST)
    back: Matrix = (
        *((*row, -x) for row, (x,) in zip(q.identity(3), place, strict=True)),
        _LAST,
    )

    def conjugated(e: Matrix) -> Matrix:
        return q.times(q.times(shift, e), back)

    turn = _so(3)
    basis = tuple(conjugated(draw.block_diagonal((e, ((Fraction(0),),)))) for e in so_basis(3))

    def sampler(random: RandomSource, size: int) -> Matrix:
        return conjugated(draw.block_diagonal((turn(random, size), ((Fraction(1),),))))

    return Group("SO(3) about a point", 3, "affine", basis, sampler)


_LAST = (Fraction(0), Fraction(0), Fraction(0), Fraction(1))
