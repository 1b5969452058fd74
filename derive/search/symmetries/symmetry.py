"""One symmetry of a Lagrangian: its field, F, what the motion keeps by it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from ...algebra.groups import Group
from ...language.derivatives import product
from ...language.tree import Tree, add, coefficient, mul, neg, nodes, plain, terms
from ...problem.entries_on_orbit import Entries, Rows, matrix
from .conditions import Monomial, Unknowns
from .scalar_lagrangian import by_state, conjugated, full, negative, plus
from .search import SymmetrySolution

ON_FORM: Tree = ("call", "ϖ", "δy")


def momenta_on(group: Group) -> list[Tree]:
    """Π_a, on the basis of 𝔤."""
    return [("at", "Π", a) for a in range(1, group.dimension + 1)]


@dataclass(frozen=True)
class Symmetry:
    """δt = τ, δg = (S₀ + tS₁)g − g(B₀ + tB₁) with δL̃ = dF/dt, F by its terms.

    ``still`` and ``moving``: (S₀, B₀) and (S₁, B₁).
    """

    group: Group
    side: str
    still: tuple[Rows, Rows]
    moving: tuple[Rows, Rows]
    tau: Tree
    terms: tuple[tuple[Tree, Monomial], ...]

    @property
    def exact(self) -> bool:
        """Does it leave L̃ alone, not only up to dF?"""
        return not self.terms

    @property
    def kind(self) -> str:
        """What it is called: a key of the prose."""
        (Y, X), turning = self.still, self.moving
        if any(map(full, turning)):
            alone = not (full(Y) or full(X) or full(turning[1]) or self.tau != 0)
            return "boost" if alone and self._shifts(turning[0]) else "moving"
        if not full(Y) and not full(X):
            return "time"
        if self.tau == 0 and full(Y) and full(X):
            apart = plus(Y, negative(X))
            return (
                "rotation_alone" if self._shifts(apart) and self._map(X) == "rotation" else "both"
            )
        if self.tau != 0:
            return "both"
        where = "space" if full(Y) else "body"
        return f"{self._map(Y if full(Y) else X)}_{where}"

    def _map(self, m: Entries) -> str:
        """Whether a matrix translates, turns, does both (a displacement), or deforms."""
        if self._shifts(m):
            return "translation"
        linear = {
            (i, j): x for i, row in enumerate(m) for j, x in enumerate(row) if self._linear(j)
        }
        skew = all(
            x == neg(linear.get((j, i), 0)) or (x == 0 == linear.get((j, i), 0))
            for (i, j), x in linear.items()
            if self._linear(i)
        )
        if not skew:
            return "deformation"
        return (
            "displacement"
            if any(x != 0 for row in m for j, x in enumerate(row) if not self._linear(j))
            else "rotation"
        )

    def _shifts(self, m: Entries) -> bool:
        """Is it 0 outside the columns of translations?"""
        return not any(by_state(x) != 0 and self._linear(j) for row in m for j, x in enumerate(row))

    def _linear(self, j: int) -> bool:
        """Is it a column of a linear part?"""
        return all(j != k + f.n for k, f in self.group.places if f.affine)

    @property
    def opposite(self) -> Symmetry:
        """The same symmetry with the other sign."""
        still, moving = ((negative(Y), negative(X)) for Y, X in (self.still, self.moving))
        terms = tuple((neg(c), m) for c, m in self.terms)
        return Symmetry(self.group, self.side, still, moving, neg(self.tau), terms)

    @property
    def turned_back(self) -> bool:
        """Has it the sign that is not wanted: of h̃ in what is kept, of a turn from e_2 to e_1, of
        gX = gE?"""
        if self.tau != 0:
            return coefficient(terms(self.tau)[0])[0] > 0
        (Y, X), (Y1, X1) = self.still, self.moving
        shown = next((m for m in (Y, Y1) if full(m)), None)
        if shown is not None:
            return _leading_sign(shown) < 0
        return _leading_sign(X if full(X) else X1) > 0

    # -- its expressions -----------------------------------------------------------------------

    def conserved(self, momenta: Sequence[Tree] = ()) -> Tree:
        """⟨Π, η⟩ − τh̃ − F, which the motion keeps; ``momenta``: the values of Π_a, if they have
        some."""
        whole = add(self.paired(momenta or momenta_on(self.group)), neg(self.F))
        paired = any(isinstance(x, tuple) and x[0] == "inner" for x in nodes(whole))
        return whole if paired else by_state(whole)

    @property
    def F(self) -> Tree:
        """F, an expression in the time, the entries of g and the parameters."""
        return add(*(mul(c, product(1, *m)) for c, m in self.terms))

    @property
    def rate(self) -> Tree:
        """dF/dt, with the entries of Ȧ."""
        found = []
        for c, m in self.terms:
            for k, x in enumerate(m):
                speed: Tree = ("entry", "Ȧ", *x[2:]) if isinstance(x, tuple) else 1
                found.append(mul(c, product(1, *m[:k], *m[k + 1 :]), speed))
        return by_state(add(*found))

    @property
    def matrices(self) -> tuple[Rows, Rows]:
        """S₀ + tS₁ and B₀ + tB₁."""
        Y, X = (
            plus(m, tuple(tuple(mul("t", x) for x in row) for row in later))
            for m, later in zip(self.still, self.moving, strict=True)
        )
        return Y, X

    @property
    def displacement(self) -> Tree:
        """δA = YA − AX."""
        Y, X = self.matrices
        if not full(Y) and full(X):
            return mul("A", matrix(negative(X)))
        right: Tree = mul(-1, "A", matrix(X)) if full(X) else 0
        return add(mul(matrix(Y), "A") if full(Y) else 0, right)

    @property
    def carried(self) -> Tree:
        """A⁻¹δA = A⁻¹YA − X, or δAA⁻¹ = Y − AXA⁻¹."""
        Y, X = self.matrices
        back: Tree = ("inv", "A")
        if self.side == "left":
            left = mul(back, matrix(Y), "A") if full(Y) else 0
            return add(left, mul(-1, matrix(X)) if full(X) else 0)
        right = mul(-1, "A", matrix(X), back) if full(X) else 0
        return add(matrix(Y) if full(Y) else 0, right)

    def paired(self, momenta: Sequence[Tree]) -> Tree:
        """⟨Π, η⟩ − τh̃, with the values Π_a on the basis where A⁻¹ is no more than a transpose."""
        kept, eta = neg(mul(self.tau, "h̃")), self.entries
        if eta is None:
            return add(("inner", "Π", self.carried), kept)
        group, found = self.group, []
        for a, momentum in enumerate(momenta):
            coordinate = add(*(mul(plain(c), eta[i][j]) for c, i, j in group.coordinate_terms(a)))
            found += [mul(x, momentum) for x in terms(by_state(coordinate)) if x != 0]
        return add(*found, kept)

    @property
    def entries(self) -> Rows | None:
        """The entries of η, polynomials in those of g; ``None`` where they are not found so."""
        Y, X = self.matrices
        left: Rows | None = Y
        right: Rows | None = X
        if self.side == "left" and full(Y):
            left = conjugated(Y, self.group, inward=True)
        if self.side == "right" and full(X):
            right = conjugated(X, self.group, inward=False)
        return plus(left, negative(right)) if left and right else None


def of_solution(
    solution: SymmetrySolution, unknowns: Unknowns, group: Group, side: str
) -> Symmetry:
    """The symmetry with these coefficients."""
    first, count = unknowns.first_field, len(unknowns.fields)
    parts: list[list[tuple[Tree, int]]] = [[], []]
    tau: Tree = 0
    terms = []
    for k, c in solution.coefficients.items():
        if k < first:
            terms.append((c, unknowns.monomials[k]))
        elif k < first + 2 * count:
            place, index = divmod(k - first, count)
            parts[place].append((c, index))
        else:
            tau = c
    moving, still = (
        tuple(
            _combined(group.size, [(c, getattr(unknowns.fields[k], x)) for c, k in part])
            for x in ("Y", "X")
        )
        for part in parts
    )
    found = Symmetry(group, side, still, moving, tau, tuple(terms))  # type: ignore[arg-type]
    return found.opposite if found.turned_back else found


def _combined(size: int, weighted: Iterable[tuple[Tree, Sequence[Sequence[Fraction]]]]) -> Rows:
    rows = [[[] for _ in range(size)] for _ in range(size)]  # type: list[list[list[Tree]]]
    for c, m in weighted:
        for i, row in enumerate(m):
            for j, x in enumerate(row):
                if x:
                    rows[i][j].append(mul(plain(Fraction(x)), c))
    return tuple(tuple(_sum(x) for x in row) for row in rows)


def _sum(parts: Sequence[Tree]) -> Tree:
    """The sum of the coefficients in an entry: 0 where they cancel."""
    whole = add(*parts)
    return 0 if len(parts) > 1 and by_state(whole) == 0 else whole


def _leading_sign(m: Entries) -> int:
    """The sign of the first entry that is not 0; of a skew matrix, or of WM with a turn W of a
    plane and a positive M, that of the turn, which is positive from e_1 to e_2, e_2 to e_3, e_3 to
    e_1 and so on."""
    places = [(i, j) for i, row in enumerate(m) for j, x in enumerate(row) if by_state(x) != 0]
    rows = sorted({i for i, _ in places})
    if len(rows) == 2 and _sign(m, *rows) == -_sign(m, *rows[::-1]) != 0:
        i, j = rows
        return -_sign(m, i, j) if (i + j) % 2 else _sign(m, i, j)
    i, j = places[0]
    skew = j < len(m) and by_state(add(m[i][j], m[j][i])) == 0
    return -_sign(m, i, j) if skew and (i + j) % 2 else _sign(m, i, j)


def _sign(m: Entries, i: int, j: int) -> int:
    """That of an entry: of the first of its terms."""
    x = by_state(m[i][j])
    return 0 if x == 0 else -1 if coefficient(terms(x)[0])[0] < 0 else 1
