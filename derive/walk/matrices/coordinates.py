"""Coordinates ζ on 𝔤: what its brackets have in them, and M ζ̇ = β solved with short entries."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations
from typing import Any

from ...algebra.calculus import substitute
from ...algebra.groups import Group, affine_entries
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, Traces, Word, number
from ...language import rational as q
from ...language.laurent import Laurent, grouped, polynomial, written
from ...language.rational import Matrix
from ...language.tree import Tree, add, mul, nodes, operands, terms
from ...problem.entries_on_orbit import element as entries_of
from ...record.record import Equation, Step, stated
from ...record.sentence import Prose
from ..chapter import Chapter, Draft, say
from ..spine.alphabet import Alphabet

# Coordinates ζ on 𝔤: Z = Σ ζ_a E_a, in the basis of the group or in one that the problem states.


def coordinates_step(group: Group, b: Alphabet, c: Chapter, *, with_rates: bool) -> Step:
    """The step Z = Σ ζ_a E_a, also entry by entry; ``with_rates``: and how ζ̇ is read off Ż."""
    span = range(len(group.linear_basis))
    equations = basis_equations(group)
    if with_rates:
        equations += [Equation(("entry", "ζ̇", a + 1), _rate(group, a)) for a in span]
    prose = say("coordinates.linear_parts" if b.affine else "coordinates.basis")
    return c.draft("coordinates", "coordinates").step(equations, prose)


def basis_equations(group: Group) -> list[Equation]:
    """Z = Σ ζ_a E_a, and entry by entry."""
    span = range(group.n)
    rows = (("row", *(add(*_terms(group, i, j)) for j in span)) for i in span)
    return [*stated("Z = Σ_a ζ_a E_a"), Equation("Z", ("matrix", *rows))]


def _terms(group: Group, i: int, j: int) -> list[Tree]:
    found = []
    for a, e in enumerate(group.linear_basis, 1):
        x = e[i][j]
        if x:
            found.append(mul(x, ("entry", "ζ", a)))
    return found


def _rate(group: Group, a: int) -> Tree:
    terms: list[Tree] = []
    for x, i, j in group.coordinate_terms(a):
        entry: Tree = ("entry", "Ż", i + 1, j + 1)
        terms.append(mul(x, entry))
    return add(*terms)


def user_basis_step(group: Group, b: Alphabet, c: Chapter) -> tuple[Step, ...]:
    """The step that gives Z (and w) by coordinates in the basis that the problem states, where the
    equations are in that of j; none where there is one basis."""
    if not group.user_basis:
        return ()
    span, size = range(group.n), group.dimension
    own = group.in_user_basis.basis

    def entry(i: int, j: int) -> Tree:
        terms = ((own[a][i][j], ("entry", "z", a + 1)) for a in range(size) if own[a][i][j])
        return add(*(mul(x, z) for x, z in terms))

    turned = ("matrix", *(("row", *(entry(i, j) for j in span)) for i in span))
    equations: list[Equation] = [Equation("Z", turned)]
    if b.affine:
        equations.append(Equation("w", ("matrix", *(("row", entry(i, group.n)) for i in span))))
    return (c.draft("coordinates", "coordinates").step(equations, say("coordinates.stated")),)


def element(group: Group) -> Matrix:
    """The matrix of g, s × s, by the entries that tell the others, as Laurent polynomials: those of
    A, and of T in the last column of an affine group."""
    if not group.has_inner_samples:  # what tells the others could be tried on no exact element
        return tuple(tuple(map(polynomial, row)) for row in entries_of(group))

    def name(i: int, j: int) -> Laurent:
        shift = group.affine and j == group.n
        return Laurent.symbol(("entry", "T", i + 1) if shift else ("entry", "A", i + 1, j + 1))

    def entry(number: Fraction, weights: Mapping[tuple[int, int], Fraction]) -> Laurent:
        return sum((x * name(*place) for place, x in weights.items()), Laurent.of(number))

    return tuple(tuple(entry(*x) for x in row) for row in affine_entries(group))


# What is particular in the products and brackets of a Lie algebra, read off its basis.

Row = tuple[Any, ...]


def bracket_step(group: Group, c: Chapter) -> tuple[Step, ...]:
    """The step that says whether 𝔤 is commutative, its brackets central, its matrices nilpotent;
    none where nothing of this holds."""
    basis, equations = group.basis, list[Equation]()
    prose: Prose = ()
    if not any(map(_nonzero, group.linear_basis)):
        return ()
    if not any(_nonzero(q.bracket(*pair)) for pair in combinations(basis, 2)):
        equations += stated("[ξ′, ξ] = 0")
        if group.affine:
            equations += stated("ξ′η − ξη′ = 0")
        prose += say("brackets.commutative")
    elif not group.affine and not any(
        _nonzero(q.bracket(q.bracket(*pair), z)) for pair in combinations(basis, 2) for z in basis
    ):
        equations += stated("[[ξ′, ξ], Z] = 0")
        prose += say("brackets.central")
    if not group.affine and (k := vanishing_power(basis)):
        equations.append(Equation(("pow", "Z", k), 0))
        prose += say("brackets.nilpotent")
    return (c.draft("brackets", "relation").step(equations, prose),) if equations else ()


def vanishing_power(basis: Sequence[Matrix]) -> int:
    """The least k for which all products of k matrices of 𝔤 vanish; 0 where there is none."""
    if any(q.trace(q.times(e, e)) != 0 for e in basis):
        return 0
    k, image = 0, list[Row](q.identity(len(basis[0])))
    while image:
        moved = (q.times(e, tuple((x,) for x in v)) for v in image for e in basis)
        found = _independent(q.flatten(x) for x in moved)
        if len(found) == len(image):
            return 0
        k, image = k + 1, found
    return k


def _independent(rows: Iterable[Row]) -> list[Row]:
    found: list[Row] = []
    for x in rows:
        if q.rank((*found, x)) > len(found):
            found.append(x)
    return found


def _nonzero(x: Matrix) -> bool:
    return any(y != 0 for row in x for y in row)


# Reading a factored form off an expanded one.
#
# dϖ vanishes on its kernel X, so it only sees variations with X δt taken away: the expanded sum is
# its part at constant time with  δx − X δt  in place of each δx.  Here such a form is built and
# compared with the expansion; what it does not account for is kept as further terms, so the result
# is always equal to what was derived.


def solve_for(e: Expr, x: Letter) -> Expr | None:
    """The y for which ``e = 0`` says x = y, by the terms between the same factors as x; ``None``
    where x does not occur alone."""
    for (traces, w), c in e.terms.items():
        places = [k for k, factor in enumerate(w) if factor == (x, False)]
        if len(places) == 1 and not traces:
            head, tail = w[: places[0]], w[places[0] + 1 :]
            return _same_place(e, head, tail, x, -1 / c)
    return None


def _same_place(e: Expr, head: Word, tail: Word, x: Letter, factor: object) -> Expr:
    """What stands in the place of x, times ``factor``, in the terms that begin with ``head`` and
    end with ``tail``."""
    terms: dict[tuple[Traces, Word], object] = {}
    size = len(head) + len(tail)
    for (traces, w), c in e.terms.items():
        middle = w[len(head) : len(w) - len(tail)]
        fits = len(w) > size and w[: len(head)] == head and w[len(w) - len(tail) :] == tail
        shape = middle and _shape(middle) == (x.rows, x.cols)
        if fits and shape and not any(y == x for y, _ in middle):
            terms[traces, middle] = c * factor  # type: ignore[operator]
    return Expr(x.rows, x.cols, terms, e.lineage)  # type: ignore[arg-type]


def _shape(w: Word) -> tuple[object, object]:
    (first, first_bar), (last, last_bar) = w[0], w[-1]
    return (first.cols if first_bar else first.rows, last.rows if last_bar else last.cols)


def factored_tree(
    d: Draft, e: Expr, core: Expr, images: Mapping[Letter, Expr], notation: WordNotation
) -> Tree:
    """The tree of ``e``: ``core`` with letters replaced by parenthesised sums, and whatever of
    ``e`` that leaves."""
    d.depends_on(e, *(images[x] for x in core.letters() if x in images))
    display = {**notation.display, **{x: tree_of(y) for x, y in images.items()}}
    remainder = e - substitute(core, images)
    shown = tree_of(core, replace(notation, display=display))
    return add(shown, tree_of(remainder, notation))


def at_constant_time(e: Expr, *times: Letter) -> Expr:
    """An expression with δt = δ′t = 0."""
    return substitute(e, {t: number(0) for t in times})


# M ζ̇ = β with short entries, solved where that stays short: by the blocks of M.

LONGEST = 14
"""An equation with more terms than this is not written out."""
MOST = 60
"""As many terms has an entry at most while rows are solved."""
RATES = ("ζ", "w", "ζ̇", "ẇ")
STATE = (*RATES, "A", "T", "C", "Γ", "u", "f_u")


@dataclass(frozen=True)
class LinearSystem:
    """Σ M_ab x_b = β_a for unknowns x_b, entries of ζ̇ (and ẇ)."""

    mass: tuple[tuple[Laurent, ...], ...]
    load: tuple[Laurent, ...]
    unknowns: tuple[Tree, ...]


def solved(stage: LinearSystem) -> tuple[Equation, ...] | None:
    """The equations of the unknowns, in order; ``None`` where one would be too long."""
    found: dict[int, Equation] = {}
    for block in _blocks(stage.mass):
        tried = _alone(stage, block)
        if tried is None or _too_long(tried):
            tried = _block_rows(stage, block)
        if _too_long(tried):
            return None
        found |= zip(block, tried, strict=True)
    return tuple(found[a] for a in sorted(found))


def short_rates(rows: Sequence[tuple[Tree, Laurent]]) -> tuple[Equation, ...] | None:
    """Rates as they are; ``None`` where one is too long."""
    found = tuple(Equation(x, tree(p)) for x, p in rows)
    return None if _too_long(found) else found


def by_relations(p: Laurent, relations: Iterable[tuple[Laurent, int]]) -> Laurent:
    """A polynomial; where a sum that is a number on the group stands in it whole, times a factor
    with a velocity, as of a drag, that number times the factor in its place."""
    for whole, value in relations:
        first = next(iter(whole.terms))
        for m in [m for m in p.terms if any(_is_rate(x) for x, _ in m)]:
            factor = Laurent({m: p.terms.get(m, Fraction(0))})
            factor /= Laurent({first: whole.terms[first]})
            there = whole * factor
            if all(p.terms.get(x) == y for x, y in there.terms.items()):
                p = p - there + factor * value
    return p


def _too_long(equations: Sequence[Equation]) -> bool:
    return any(_length(e.lhs) + _length(e.rhs) > LONGEST for e in equations)


def _length(t: Tree) -> int:
    """How many terms a tree has, those of its quotients and sums in brackets among them."""
    if not isinstance(t, tuple):
        return 1
    if t[0] == "add":
        return sum(map(_length, t[1:]))
    return max([1, *map(_length, operands(t))]) if t[0] in ("mul", "div", "pow", "fun") else 1


def _blocks(mass: tuple[tuple[Laurent, ...], ...]) -> list[list[int]]:
    """The rows of M by what they share: those of one block are joined by entries that are not 0."""
    left, found = [*range(len(mass))], []
    while left:
        block = [left.pop(0)]
        for a in block:
            near = [b for b in left if mass[a][b] or mass[b][a]]
            block += near
            left = [b for b in left if b not in near]
        found.append(sorted(block))
    return found


def _alone(stage: LinearSystem, block: list[int]) -> list[Equation] | None:
    """The rows of a block solved; ``None`` where that takes divisors of several terms, but for a
    single row, or of the state."""
    mass = [[stage.mass[a][b] for b in block] for a in block]
    load = [stage.load[a] for a in block]
    if not any(load):
        values: list[Tree] | None = [0 for _ in block]
    elif len(block) == 1 and len(mass[0][0].terms) > 1:
        values = [("div", tree(load[0]), written(mass[0][0]))]
    else:
        found = _eliminated(mass, load)
        values = None if found is None else [*map(tree, found)]
    if values is None:
        return None
    return [Equation(stage.unknowns[a], x) for a, x in zip(block, values, strict=True)]


def _eliminated(mass: list[list[Laurent]], load: list[Laurent]) -> list[Laurent] | None:
    """The x of M x = β by Gauss and Jordan, every pivot one constant term; ``None`` where there is
    no such pivot, or an entry is long."""
    rows = [[*row, x] for row, x in zip(mass, load, strict=True)]
    left = {*range(len(rows))}
    while left:
        k = next((k for k in sorted(left) if _is_pivot(rows[k][k])), None)
        if k is None:
            return None
        left.remove(k)
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i, row in enumerate(rows):
            if i != k and row[k]:
                rows[i] = [x - row[k] * y for x, y in zip(row, rows[k], strict=True)]
        if any(len(x.terms) > MOST for row in rows for x in row):
            return None
    return [row[-1] for row in rows]


def _is_pivot(p: Laurent) -> bool:
    return len(p.terms) == 1 and not any(depends(s) for m in p.terms for s, _ in m)


def _block_rows(stage: LinearSystem, block: list[int]) -> list[Equation]:
    """The rows of a block as they are."""
    sides = [
        add(*(_times(stage.mass[a][b], stage.unknowns[b]) for b in block if stage.mass[a][b]))
        for a in block
    ]
    return [Equation(x, tree(stage.load[a])) for a, x in zip(block, sides, strict=True)]


def _times(p: Laurent, name: Tree) -> Tree:
    factor = tree(p)
    return mul(factor, name) if len(terms(factor)) == 1 else ("mul", factor, name)


def tree(p: Laurent) -> Tree:
    """The tree of a polynomial: what depends on parameters together, velocities last."""
    return grouped(p, lambda x: not depends(x), _is_rate)


def _is_rate(x: Tree) -> bool:
    return isinstance(x, tuple) and x[0] == "entry" and x[1] in RATES


def depends(x: Tree) -> bool:
    """Does a symbol depend on the state, the time or inputs, or stand for a force that may?"""
    return any(
        y == "t"
        or (isinstance(y, tuple) and y[0] == "at")
        or (isinstance(y, tuple) and y[0] == "entry" and y[1] in STATE)
        for y in nodes(x)
    )
