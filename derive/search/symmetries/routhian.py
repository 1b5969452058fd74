"""Routh's reduction of a Lagrangian by symmetries that commute, for ℓ quadratic in the velocity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import combinations
from operator import truediv
from typing import Any

from ...language.derivatives import derivative
from ...language.tree import Tree, add, neg, nodes, plain, terms
from ...problem.entries_on_orbit import EntriesOfElement, element
from ...problem.fields import coordinates
from ...problem.problem import ProblemError
from .found_symmetries import SymmetriesFound
from .scalar_lagrangian import full
from .state_functions import Element, StateFunctions, entries_in, leaves
from .symmetry import Symmetry

Vector = list[Element]

INVERTED = 3
"""Blocks of g have at most so many rows where g⁻¹ is no more than a transpose."""

LONG = 14
"""Where a quotient in the elimination has more terms, entries of 𝕀 are called by their names."""

LONGEST = 40
"""A numerator of d𝒜 that has more terms, before anything divides it, is not told."""


@dataclass(frozen=True)
class Square:
    """A term ``weight`` (Σ ``factors``_i 𝒥_i − ``rest``)² of V, by the elimination of the symmetry
    ``place``, whose velocity is Σ ``velocity``_i 𝒥_i − ``shift`` − Σ ``later``_j 𝒜_j(Z)."""

    place: int
    weight: Element
    factors: Mapping[int, Element]
    rest: Element
    pivot: Element
    later: Mapping[int, Element]

    @property
    def scale(self) -> Any:
        """The common denominator of what is squared."""
        parts = (*self.factors.values(), self.rest)
        return reduce(lambda x, y: x.lcm(y), (x.denom for x in parts))


class Routhian:
    """The reduction of a problem by some of its symmetries."""

    def __init__(self, found: SymmetriesFound, chosen: Sequence[Symmetry]):
        problem = found.problem
        self.problem, self.group, self.chosen = problem, problem.own_group, tuple(chosen)
        self.zeta = coordinates(self.group)
        self.held = {a - 1 for a in problem.own_lagrangian.held}
        L = problem.own_lagrangian.L
        self.names = [[inertia(i, j) for j, _ in enumerate(chosen)] for i, _ in enumerate(chosen)]
        fields = (y for x in chosen for m in x.matrices for row in m for y in row)
        trees = (L, *self.zeta, *fields, *(x for row in self.names for x in row))
        trees += tuple(derivative(y, x) for y in leaves(L) for x in entries_in(y) if x != y)
        self.functions = StateFunctions(self.group, trees)
        of = self.functions.of
        if any(x.entries is None for x in chosen):
            self._require_small()
        self.eta = [coordinates_of_field(x, self.functions) for x in chosen]
        self.metric, self.linear, self.potential = self._parts(of(L))
        self.functions.invariant = self._invariant(of)

    def _require_small(self) -> None:
        if max(factor.n for _, factor in self.group.places) > INVERTED:
            raise ProblemError(
                f"{self.problem.name}: to reduce it takes inverses of matrices of "
                f"{self.group.name}, whose blocks have more than {INVERTED} rows; choose a smaller "
                "group, or one of rotations and translations"
            )

    def _parts(self, L: Element) -> tuple[list[Vector], Vector, Element]:
        """M, b and U of ℓ = ½⟨ζ, Mζ⟩ + ⟨b, ζ⟩ − U."""
        at = [self.functions.leaves.index(x) for x in self.zeta]
        ring, field = L.numer.ring, self.functions.field
        parts: dict[tuple[int, ...], Any] = {}
        for e, c in L.numer.items():
            key = tuple(e[k] for k in at)
            rest = tuple(0 if k in at else n for k, n in enumerate(e))
            parts[key] = parts.get(key, ring.zero) + ring.from_dict({rest: c})
        if any(sum(key) > 2 for key in parts) or self.functions.depends_on(field(L.denom)) & {*at}:
            raise ProblemError(
                f"{self.problem.name}: the Lagrangian is not quadratic in the velocity, so that "
                "its momenta are not solved for velocities"
            )
        below, d = field(L.denom), range(len(at))

        def of(*places: int) -> Element:
            key = tuple(places.count(a) for a in d)
            return field(parts.get(key, ring.zero)) / below

        metric = [[of(a, b) * (2 if a == b else 1) for b in d] for a in d]
        return metric, [of(a) for a in d], -of()

    def _invariant(self, of: Any) -> tuple[int, ...]:
        """The entries of g that all the symmetries, and what is held, leave alone."""
        side = self.problem.lagrangian.trivialisation  # type: ignore[union-attr]
        moved = EntriesOfElement(self.group, side)
        fields = [*self.eta]
        fields += [[of(int(a == k)) for a, _ in enumerate(self.zeta)] for k in self.held]
        kept = []
        for k in range(self.functions.first_entry, len(self.functions.leaves)):
            rates = self.slopes(self.functions.leaves[k], moved)
            moves = any(self.functions.simplified(_paired(eta, rates)) for eta in fields)
            if any(rates) and not moves:
                kept.append(k)
        return tuple(kept)

    def slopes(self, leaf: Tree, moved: EntriesOfElement | None = None) -> Vector:
        """The derivatives of an entry of g, or of a function of some, along the basis."""
        moved = moved or EntriesOfElement(self.group, self.problem.own_lagrangian.trivialisation)
        of = self.functions.of
        return [of(moved.along(leaf, a)) for a, _ in enumerate(self.zeta)]

    def tree(self, x: Element, *beside: Tree) -> Tree:
        """A function on the group as a tree, times what stands beside it."""
        return self.functions.tree(self.functions.simplified(x), *beside)

    # -- the locked inertia --------------------------------------------------------------------

    @cached_property
    def locked(self) -> list[Vector]:
        """𝕀."""
        pushed = [[_paired(row, eta) for row in self.metric] for eta in self.eta]
        simplified = self.functions.simplified
        return [[simplified(_paired(eta, p)) for p in pushed] for eta in self.eta]

    @property
    def leaves_none(self) -> bool:
        """Do the symmetries all act on one side of g, where no configuration is left as it is?"""
        sides = zip(*(x.still for x in self.chosen), strict=True)
        return not self.held and not all(any(map(full, side)) for side in sides)

    @cached_property
    def at_rest(self) -> Vector:
        """a_i, what 𝒥_i is at rest."""
        return [self.functions.simplified(_paired(eta, self.linear)) for eta in self.eta]

    @cached_property
    def squares(self) -> tuple[Square, ...]:
        """V − U as a sum of squares, in the order of the elimination."""
        found = self._eliminated(self.locked)
        if found is None:
            found = self._eliminated(self._by_names(), longest=0)
        assert found is not None
        return found

    @cached_property
    def named(self) -> bool:
        """Are entries of 𝕀 called by their names?"""
        pivots = (self.functions.depends_on(x.pivot) for x in self.squares)
        return any(used & self._named_entries for used in pivots)

    @property
    def _named_entries(self) -> set[int]:
        """The places of the names of entries of 𝕀 among the leaves."""
        return {self.functions.leaves.index(x) for row in self.names for x in row}

    @cached_property
    def conditions(self) -> tuple[Element, ...]:
        """What the squares divide by, as it varies with g: the numerators of the pivots, and what
        else there is."""
        found, field = dict[Any, None](), self.functions.field
        for s in reversed(self.squares):
            found[s.pivot.numer] = None
        for s in self.squares:
            rest = (s.weight / field(s.scale) ** 2).denom
            for p in (*found,):
                while self.functions.depends_on(field(common := rest.gcd(p))):
                    rest = rest.quo(common)
            found[rest] = None
        return tuple(field(p) for p in found if self._varies(field(p)))

    def _varies(self, x: Element) -> bool:
        """Does a function depend on entries of g, or of 𝕀 by their names?"""
        return bool(self.functions.depends_on(x) & (self.functions.moving | self._named_entries))

    @property
    def singular_elsewhere(self) -> bool:
        """Is det 𝕀 the product of the conditions, but for what does not vary with g?"""
        from sympy.polys.matrices import DomainMatrix

        rows = self._by_names() if self.named else self.locked
        size, field = len(rows), self.functions.field
        det = DomainMatrix(rows, (size, size), field.to_domain()).det()
        return not self._varies(reduce(truediv, self.conditions, self.functions.simplified(det)))

    def _by_names(self) -> list[Vector]:
        """𝕀 by names of its entries that are not 0."""
        of = self.functions.of
        return [
            [of(self.names[min(i, j)][max(i, j)]) if x else x for j, x in enumerate(row)]
            for i, row in enumerate(self.locked)
        ]

    def _eliminated(self, matrix: list[Vector], longest: int = LONG) -> tuple[Square, ...] | None:
        """The squares by an inertia; ``None`` where one has more terms than ``longest``, if that is
        not 0."""
        simplified, one = self.functions.simplified, self.functions.field(1)
        left, rest, found = [[*row] for row in matrix], [*self.at_rest], list[Square]()
        forms: list[dict[int, Element]] = [{i: one} for i, _ in enumerate(left)]
        open_ = [*range(len(left))]
        while open_:
            p = min(open_, key=lambda i: self.size(left[i][i]))
            open_.remove(p)
            pivot = left[p][p]
            self._require(pivot)
            later = {j: left[p][j] for j in open_ if left[p][j]}
            found.append(Square(p, 1 / (2 * pivot), forms[p], rest[p], pivot, later))
            if longest and any(_terms(x) > longest for x in (pivot, *forms[p].values())):
                return None
            ratios = {j: simplified(x / pivot) for j, x in later.items()}
            for i, ratio in ratios.items():
                for j in open_:
                    left[i][j] = simplified(left[i][j] - ratio * left[p][j])
                rest[i] = simplified(rest[i] - ratio * rest[p])
                forms[i] = {
                    k: simplified(forms[i].get(k, 0 * one) - ratio * forms[p].get(k, 0 * one))
                    for k in {**forms[i], **forms[p]}
                }
        return tuple(found)

    def _require(self, pivot: Element) -> None:
        if not pivot:
            raise ProblemError(
                f"{self.problem.name}: the locked inertia of its symmetries has no inverse "
                "anywhere: their fields depend on one another, or the metric is not definite"
            )

    def size(self, x: Element) -> tuple[bool, int, int]:
        """How simple a pivot is: without entries of g, then the shortest."""
        return not x, len(self.functions.used(x.numer)), len(x.numer)

    def locked_tree(self, i: int, j: int) -> Tree:
        """An entry of 𝕀, brought to one denominator where that is not much longer."""
        pairs = [(a, b) for a, _ in enumerate(self.zeta) for b, _ in enumerate(self.zeta)]
        apart = add(
            *(
                self.tree(self.metric[a][b], self.tree(self.eta[i][a] * self.eta[j][b]))
                for a, b in pairs
                if self.metric[a][b] and self.eta[i][a] and self.eta[j][b]
            )
        )
        whole = self.functions.tree(self.locked[i][j])
        return apart if 2 * len(nodes(apart)) < len(nodes(whole)) else whole

    # -- the connection ------------------------------------------------------------------------

    def velocities(self, values: Vector) -> Vector:
        """𝕀⁻¹ of a vector."""
        zero, found = self.functions.field(0), dict[int, Element]()
        for s in reversed(self.squares):
            whole = sum((c * values[k] for k, c in s.factors.items()), start=zero)
            aside = sum((x * found[j] for j, x in s.later.items()), start=zero)
            found[s.place] = (whole - aside) / s.pivot
        return [self.functions.simplified(found[k]) for k, _ in enumerate(values)]

    @cached_property
    def forms(self) -> list[Vector] | None:
        """𝒜(E_b) for each element of the basis; ``None`` where that is long."""
        if self.named:
            return None
        pushed = [[_paired(row, eta) for eta in self.eta] for row in self.metric]
        found = [self.velocities(x) for x in pushed]
        return None if any(_terms(x) > LONG for row in found for x in row if x) else found

    @cached_property
    def free(self) -> list[int]:
        """The coordinates of ζ_h that are not held, and are not found to be 0."""
        free = [a for a, _ in enumerate(self.zeta) if a not in self.held] if self.freedom else []
        return [a for a in free if not self.vanishes(self._unit(a))]

    def vanishes(self, form: Vector) -> bool:
        """Is a linear form on ζ_h = ζ − Σ 𝒜_i(ζ) η_i 0 for every velocity?"""
        if self.forms is None:
            return False
        along = [_paired(eta, form) for eta in self.eta]
        apart = (x - _paired(along, own) for x, own in zip(form, self.forms, strict=True))
        return not any(map(self.functions.simplified, apart))

    def _unit(self, a: int) -> Vector:
        return [self.functions.field(int(a == b)) for b, _ in enumerate(self.zeta)]

    @cached_property
    def curvature(self) -> list[dict[tuple[int, int], Element]] | None:
        """d𝒜_i on pairs E_a, E_b, a < b, those that are not 0; ``None`` where it is too long.

        d𝒜(E_a, E_b) = E_a·𝒜(E_b) − E_b·𝒜(E_a) − ε𝒜([E_a, E_b])
        """
        forms = self.forms
        if forms is None:
            return None
        of, field = self.functions, self.functions.field
        moved = {k for row in forms for x in row for k in of.depends_on(x) & of.moving}
        rates = {k: self.slopes(of.leaves[k]) for k in sorted(moved)}
        if not all(x.denom.is_ground for row in rates.values() for x in row):
            return None

        def along(p: Any, a: int) -> Any:
            slopes = (p.diff(k) * _polynomial(x[a]) for k, x in rates.items())
            return sum(slopes, start=p.ring.zero)

        sign = 1 if self.problem.own_lagrangian.trivialisation == "left" else -1
        found: list[dict[tuple[int, int], Element]] = [{} for _ in self.eta]
        for i, own in enumerate(found):
            below = reduce(lambda x, y: x.lcm(y), (row[i].denom for row in forms))
            form = [_polynomial(row[i] * below) for row in forms]
            for a, b in combinations(range(len(form)), 2):
                # of polynomials: a divisor is sought once, and where they are short
                above = along(form[b], a) * below - along(below, a) * form[b]
                above += along(below, b) * form[a] - along(form[a], b) * below
                for k, c in enumerate(self.group.structure_constants[a][b]):
                    signed = field.domain(sign * c.numerator, c.denominator)
                    above -= _polynomial(field(signed)) * form[k] * below
                if len(above) > LONGEST:
                    return None
                x = of.simplified(field(above) / field(below) ** 2)
                own |= {(a, b): x} if x else {}
        return found

    # -- one degree of freedom -----------------------------------------------------------------

    @cached_property
    def freedom(self) -> int:
        """How many degrees of freedom the reduction leaves."""
        return len(self.zeta) - len(self.held) - len(self.chosen)

    @property
    def energy_at_rest(self) -> Tree:
        """U, as the problem has it where that is a sum of its own."""
        written = terms(self.problem.own_lagrangian.L)
        still = [x for x in written if not any(z in {*nodes(x)} for z in self.zeta)]
        tree, own = self.functions.tree, add(*map(neg, still))
        found = [tree(self.functions.simplified(self.potential)), tree(self.potential)]
        found += [own] if self.functions.of(own) == self.potential else []
        return min(found, key=lambda t: (len({*entries_in(t)}), len(nodes(t))))


def inertia(i: int, j: int) -> Tree:
    """An entry of 𝕀; from 0."""
    return ("entry", "𝕀", i + 1, j + 1)


def coordinates_of_field(x: Symmetry, functions: StateFunctions) -> Vector:
    """The coordinates of η, what the field of a symmetry is in 𝔤."""
    of, group, known = functions.of, x.group, x.entries
    eta = [[of(y) for y in row] for row in known] if known else _conjugated(x, functions)
    zero = functions.field(0)
    return [
        sum((of(plain(c)) * eta[i][j] for c, i, j in group.coordinate_terms(a)), start=zero)
        for a in range(group.dimension)
    ]


def _conjugated(x: Symmetry, functions: StateFunctions) -> list[Vector]:
    """g⁻¹Yg − X, or Y − gXg⁻¹, by the inverse matrix of g; it is exact, so that what it divides by
    drops out of 𝕀."""
    from sympy.polys.matrices import DomainMatrix

    field, size = functions.field.to_domain(), x.group.size

    def matrix(rows: Sequence[Sequence[Tree]]) -> Any:
        return DomainMatrix([[functions.of(y) for y in row] for row in rows], (size, size), field)

    g, (Y, X) = matrix(element(x.group)), map(matrix, x.matrices)
    whole = g.inv() * Y * g - X if x.side == "left" else Y - g * X * g.inv()
    return whole.to_list()  # type: ignore[no-any-return]


def _terms(x: Element) -> int:
    """How many terms a function has."""
    return len(x.numer) + len(x.denom) - 1


def _polynomial(x: Element) -> Any:
    """A function whose denominator is a number."""
    return x.numer.quo_ground(x.denom.LC)


def _paired(a: Sequence[Element], b: Sequence[Element]) -> Element:
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        if x and y:
            total = total + x * y
    return total
