"""The claims about relative equilibria of reduced equations, and about their stability."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from decimal import Context, localcontext
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

from ...language import rational as q
from ...language.tree import Tree, add, neg, nodes, replaced, terms
from ...language.univariate import Number, coefficients_of, square_free, tree, value_of
from ...record.record import RecordError, Step
from ...record.sentence import Claim
from ..values.residue import Residue
from .entries_checked import Decision, decided
from .integral_claims import Judge, listed
from .reduced_system import ReducedSystem, ResiduePoint
from .spectra_and_residues import (
    DIGITS,
    about,
    are_roots_rounded,
    characteristic,
    decimal,
    distinct_roots,
    expansion,
    gradient,
    grows,
    hermite,
    real_and_not_positive,
    roots_near,
    second_derivatives,
    signature,
    value_there,
)

Coordinates = tuple[tuple[Tree, Number], ...]
POINTS = ("equilibrium.at", "equilibrium.origin")
"""The claims that say a point."""


def coordinates(claim: Claim, name: str = "point") -> Coordinates:
    """The coordinates that a claim tells under a name, rows of a matrix; none where it tells none;
    ``RecordError`` where one is told twice."""
    rows = dict(claim.values).get(name, ("matrix",))
    assert isinstance(rows, tuple)
    found = [(x, value_of(y)) for _, x, y in rows[1:]]
    if len(dict(found)) < len(found):
        raise RecordError("a coordinate is told twice")
    return (*found,)


def point_of(system: ReducedSystem, step: Step) -> ClaimedEquilibrium:
    """The point that a step speaks of; ``RecordError`` for none or several."""
    steps = (step, *(system.record[x] for x in step.uses))
    for s in steps[:1], steps[1:]:
        found = [x for y in s for x in y.claims if x.kind in POINTS]
        if len(found) == 1:
            return equilibrium(system, coordinates(found[0]))
        if found:
            break
    raise RecordError("no one point is told")


def _at(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """Nothing moves at the point, which an element may have, the equations are in powers of the
    distance from it, and what is proved of its stability is said."""
    point, stated = point_of(system, step), coordinates(claim)
    if unknown := [x for x, _ in stated if x not in point.variables]:
        raise RecordError(f"{unknown[0]} is no variable")
    if any(value_there(x) != 0 for x in point.rates):
        return "something moves there"
    using = (s for s in system.record.steps if step.label in s.uses)
    if not any(x.kind in PROVED for s in (step, *using) for x in s.claims):
        return "no step says what is proved of its stability"
    if point.entries == "no":
        return "no element of the group has these entries"
    return not_from(step, stated)


def not_from(step: Step, point: Coordinates, *, constants: bool = False) -> str:
    """Why the equations of a step are not in powers of the distance from a point, without constant
    terms but where there may be ``constants``; "" where they are."""
    distances = [terms(add(x, neg(tree(y)))) for x, y in point]
    if any(_strays(e.rhs, distances, constants=constants) for e in step.equations):
        return "the equations are not in powers of the distance from it"
    return ""


def _strays(t: Tree, distances: Sequence[Sequence[Tree]], *, constants: bool) -> bool:
    """Is a variable that has a distance in a tree, or a number in a sum, elsewhere than in sums
    with all terms of a distance?"""
    if not isinstance(t, tuple) or t[0] in ("at", "entry"):
        return any(t == x for x, *_ in distances)
    parts = [*t[1:]]
    if t[0] == "add":
        for distance in distances:
            if all(y in parts for y in distance):
                for y in distance:
                    parts.remove(y)
        if not constants and any(map(_is_number, parts)):
            return True
    return any(_strays(y, distances, constants=False) for y in parts)


def _is_number(t: Tree) -> bool:
    return not any(isinstance(x, tuple) and x[0] in ("at", "entry") for x in nodes(t))


# -- forms ----------------------------------------------------------------------------------------


def kept(system: ReducedSystem, step: Step) -> Tree:
    """The left side of a step: h̃ and what is kept beside it; ``RecordError`` for another one."""
    (equation,) = step.equations
    h, *others = terms(equation.lhs)
    if h != "h̃" or any("h̃" in nodes(x) for x in others):
        raise RecordError("the left side is not the energy and what is kept beside it")
    point = system.anywhere
    roots = {x for t in others for x in nodes(t) if isinstance(x, tuple) and x[0] == "fun"}
    # it has rational coefficients in place of roots: kept for any of them, if for a random one
    at = {**point.at} | {
        x: Residue(system.random.randrange(system.prime), system.prime) for x in roots
    }
    if others and ResiduePoint(system, at).bracket(add(*others), system.energy):
        raise RecordError("the left side is not kept")
    return equation.lhs


def form_of(system: ReducedSystem, step: Step) -> q.Matrix | None:
    """The second derivatives of what a step takes for the form; ``None`` where it has none."""
    if all(x.kind != "equilibrium.form" for x in step.claims):
        return None
    return point_of(system, step).form_of(kept(system, step))


def _form(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The squares on the leaf are as many as are claimed, and are those that are written; what
    follows from them is said."""
    point, form = point_of(system, step), form_of(system, step)
    if fault := silent(step, PROVED, point.verdict(form)):
        return fault
    found = point.squares(form)
    if reason := others_squared(found, claim):
        return reason
    signs = [_square(point, point.expansion(t)) for t in terms(step.equations[0].rhs)]
    written = signs.count(1), signs.count(-1)
    return "" if written == found else f"{written[0]} and {written[1]} are written"


def _square(point: ClaimedEquilibrium, term: Any) -> int:
    """The sign of a term that is a square on the leaf; 0 for what vanishes there to the second
    order; ``RecordError`` for any other."""
    if any(gradient(term, point.n)):
        raise RecordError("a term is not of the second order in the distance")
    second = second_derivatives(term, point.n)
    on_the_leaf = point.on_the_leaf(second) if point.dimension else ()
    if not any(map(any, on_the_leaf)):
        return 0
    if q.rank(on_the_leaf) > 1:
        raise RecordError("a term is no square on the leaf")
    return 1 if q.trace(on_the_leaf) > 0 else -1


def others_squared(found: tuple[int, int], claim: Claim) -> str:
    """That there are not as many squares of each sign as a claim says; "" where there are."""
    if found == (claim["positive"], claim["negative"]):
        return ""
    return f"it has {found[0]} positive and {found[1]} negative squares"


def has_multiples(point: ClaimedEquilibrium) -> str:
    """That the derivative of the energy is a combination of those of what is kept; "" where it is
    none."""
    known = (*point.system.casimirs, *point.system.integrals[1:])
    rows = [gradient(point.expansion(f), point.n) for f in known]
    extended = [*rows, gradient(point.energy, point.n)]
    more, fewer = (q.rank(q.matrix(x)) if x else 0 for x in (extended, rows))
    return "" if more > fewer else "there are such multiples"


def _orbit(system: ReducedSystem, step: Step, claim: Claim) -> str:
    return others_squared(point_of(system, step).squares(None), claim)


# -- verdicts -------------------------------------------------------------------------------------


def _verdict(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """It is what the form, the ranks and the roots imply."""
    point, form = point_of(system, step), form_of(system, step)
    found, claimed = point.verdict(form), claim.kind.partition(".")[2]
    if claimed != found and (claimed != "indefinite" or found not in ("unstable", "open")):
        return f"what follows is: {found}"
    told = dict(claim.values).get("polynomial")
    known = point.characteristic_of_all if claimed == "unstable_beyond" else point.characteristic
    if told is not None and [*map(value_of, coefficients_of(told, "λ"))] != known:
        return "the characteristic polynomial is another"
    return ""


def _exact_squares(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """They are all roots of q, for the characteristic polynomial q(λ²)."""
    f = point_of(system, step).characteristic[::2]
    claimed = [_complex(t) for t in listed(claim["squares"])]
    if any(any(at_complex(f, s)) for s in claimed):
        return "one is no square of an eigenvalue"
    each_once = len({*claimed}) == len(claimed) == distinct_roots(f)
    return "" if each_once else "they are not all, each once"


def _eigenvalues(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """Their squares are all roots of q, for the characteristic polynomial q(λ²), as many of each
    kind, and they are rounded to the nearest decimals."""
    f, eigenvalues = point_of(system, step).characteristic[::2], claim["eigenvalues"]
    assert isinstance(eigenvalues, tuple)
    squares = [(re * re - im * im, 2 * re * im) for _, re, im in eigenvalues[1:]]
    reals = [s for s, im in squares if not im]
    found = (
        sum(2 if im else 1 for _, im in squares),
        len(reals),
        sum((s > 0) - (s < 0) for s in reals),
    )
    (more, fewer), (positive, negative) = (signature(hermite(f, k)) for k in (0, 1))
    known = (more + fewer, more - fewer, positive - negative)
    if found != known or len({*squares}) < len(squares):
        return "they are not all"
    with localcontext(Context(prec=DIGITS)):
        near = [(decimal(re), decimal(im)) for re, im in squares]
        others = [(re, -im) for re, im in near if im]
        simple = square_free((*f[::-1],))[::-1]
        roots = roots_near([decimal(x / simple[0]) for x in simple], [*near, *others])
        numbers = [(decimal(re), decimal(im)) for _, re, im in eigenvalues[1:]]
        rounded = are_roots_rounded(numbers, roots[: len(near)])
    return "" if rounded else "one is not rounded to the nearest decimal"


def silent(step: Step, verdicts: Collection[str], found: str) -> str:
    """That a step has none of the verdicts, of which one is found; "" where it has."""
    said = any(x.kind in verdicts for x in step.claims)
    return "" if said else f"the step does not say what follows of the stability: {found}"


def at_complex(f: Sequence[Number], s: tuple[Any, Any]) -> tuple[Any, Any]:
    """The value of a polynomial, given from the highest power, at a complex number."""
    re, im = Fraction(0), Fraction(0)
    for x in f:
        re, im = re * s[0] - im * s[1] + x, re * s[1] + im * s[0]
    return re, im


def _complex(t: Tree) -> tuple[Number, Number]:
    """The real and the imaginary part of a number that is linear in i."""
    zero, one, two = (value_of(replaced(t, "i", k)) for k in (0, 1, 2))
    if two - one != one - zero:
        raise RecordError("a power of i")
    return zero, one - zero


VERDICTS = (
    *("stable", "stable_beyond", "stable_compact", "on_the_leaf", "point", "indefinite"),
    *("unstable", "unstable_beyond", "open", "undecided"),
)
PROVED = {f"equilibrium.{x}" for x in VERDICTS} - {"equilibrium.indefinite"}
"""The claims of which each equilibrium has one."""

JUDGES: dict[str, Judge] = {
    "equilibrium.at": _at,
    "equilibrium.origin": _at,
    "equilibrium.none": lambda system, step, claim: has_multiples(point_of(system, step)),
    "equilibrium.orbit": _orbit,
    "equilibrium.form": _form,
    "equilibrium.squares": _exact_squares,
    "equilibrium.eigenvalues": _eigenvalues,
    **dict.fromkeys((f"equilibrium.{x}" for x in VERDICTS), _verdict),
}
"""How claims about equilibria are judged, of equations that are Hamiltonian."""


# What is true of an equilibrium of reduced equations, in exact numbers.
#
# With Λ the Poisson tensor at the point, M the derivatives of the rates and Q those, the second
# ones, of a function that is kept and critical there, ΛᵀQΛ has the squares of the function on the
# tangent space of the leaf, the image of Λ; −MΛ those of ω(Mv, v), since ω(Λξ, Λη) = ⟨Λξ, η⟩.


class ClaimedEquilibrium:
    """A point of a system, by its coordinates that are not 0."""

    def __init__(self, system: ReducedSystem, point: Mapping[Tree, Number]):
        self.system, self.n = system, len(system.variables)
        self.at = tuple(point.get(x, Fraction(0)) for x in system.variables)
        self.variables = about(system.variables, self.at)

    def expansion(self, t: Tree) -> Any:
        """A polynomial about the point."""
        return expansion(t, {**self.variables, "h̃": self.energy})

    @cached_property
    def energy(self) -> Any:
        """h̃ about the point."""
        return expansion(self.system.energy, self.variables)

    @cached_property
    def rates(self) -> list[Any]:
        """The rates about the point."""
        return [expansion(x, self.variables) for x in self.system.rates]

    @cached_property
    def tensor(self) -> q.Matrix:
        """Λ at the point."""
        found, span = self.system.tensor.at(self.at), range(self.n)
        return tuple(tuple(found.get((i, j), Fraction(0)) for j in span) for i in span)

    @cached_property
    def tangent(self) -> q.Matrix:
        """Columns that span the tangent space of the leaf."""
        pivots = q.echelon(self.tensor)[1]
        return tuple(tuple(row[j] for j in pivots) for row in self.tensor)

    @property
    def dimension(self) -> int:
        """The dimension of the leaf."""
        return len(self.tangent[0])

    @cached_property
    def linear(self) -> q.Matrix:
        """M, the derivatives of the rates."""
        return tuple(tuple(gradient(x, self.n)) for x in self.rates)

    @cached_property
    def characteristic(self) -> list[Number]:
        """det(μ − M) on the leaf, from the highest power of μ; ``ValueError`` where M leaves it."""
        if not self.dimension:
            return [Fraction(1)]
        on_the_leaf = q.solve(self.tangent, q.times(self.linear, self.tangent))
        if on_the_leaf is None:
            raise ValueError("the linearised rates leave the tangent space of the leaf")
        return characteristic(on_the_leaf)

    @cached_property
    def characteristic_of_all(self) -> list[Number]:
        """det(μ − M), not on the leaf alone."""
        return characteristic(self.linear)

    @cached_property
    def grows(self) -> bool:
        """Has an eigenvalue on the leaf a positive real part?"""
        if any(self.characteristic[1::2]):
            raise ValueError("the characteristic polynomial is not even")
        return not real_and_not_positive(self.characteristic[::2])

    # -- what is known of the point ----------------------------------------------------------------

    @cached_property
    def entries(self) -> Decision:
        """Has an element of the group the entries of g at the point?"""
        pairs = zip(self.system.variables, self.at, strict=True)
        at = {x: y for x, y in pairs if isinstance(x, tuple) and x[1] == "A"}
        one: dict[Tree, Any] = {x: Fraction(x[2] == x[3]) for x in at if isinstance(x, tuple)}
        alone = (f for f in self.system.casimirs if {*nodes(f)} & {*self.variables} <= {*one})
        if any(expansion(f, one) != value_there(self.expansion(f)) for f in alone):
            return "no"
        return decided(self.system.group, {(x[2] - 1, x[3] - 1): y for x, y in at.items()})

    @cached_property
    def regular(self) -> bool:
        """Has Λ its largest rank there, as the Casimirs prove?  Ranks of skew matrices are even."""
        there = self.system.anywhere
        most = (self.n - there.rank(self.system.casimirs)) // 2 * 2
        return there.poisson_rank == self.dimension == most

    @cached_property
    def compact(self) -> bool:
        """Are there momenta alone, of a group that is compact by its Killing form?"""
        c, d = self.system.group.structure_constants, self.system.group.dimension
        if d < self.n:
            return False
        span = range(d)
        killing = [
            [sum((c[a][i][j] * c[b][j][i] for i in span for j in span), Fraction(0)) for b in span]
            for a in span
        ]
        return signature(killing) == (0, d)

    # -- forms ------------------------------------------------------------------------------------

    def form_of(self, kept: Tree) -> q.Matrix:
        """The second derivatives of what is kept; ``RecordError`` where it is not critical."""
        found = self.expansion(kept)
        if any(gradient(found, self.n)):
            raise RecordError("the derivative does not vanish at the equilibrium")
        return second_derivatives(found, self.n)

    def on_the_leaf(self, form: q.Matrix) -> q.Matrix:
        """P̄QP for columns P that span the tangent space."""
        return q.times(q.times(q.transposed(self.tangent), form), self.tangent)

    def squares(self, form: q.Matrix | None) -> tuple[int, int]:
        """How many positive and how many negative squares a form has on the leaf, ω(Mv, v) where
        none is given."""
        if form is not None:
            return signature(self.on_the_leaf(form)) if self.dimension else (0, 0)
        return signature(q.scaled(-1, q.times(self.linear, self.tensor)))

    @property
    def _anywhere(self) -> bool:
        """May motions start with any values of the variables?  Entries of g may not."""
        return not any(isinstance(x, tuple) and x[1] == "A" for x in self.system.variables)

    def verdict(self, form: q.Matrix | None) -> str:
        """What is proved of its stability, by a form that is kept, or else by ω(Mv, v): the name
        of the sentence."""
        if self.entries != "yes":
            return "undecided"
        if form is not None and self.n in signature(form):
            return "stable_beyond"
        if self.dimension in self.squares(form):
            if self.regular:
                return "stable"
            if self.compact:
                return "stable_compact"
            if self.dimension:
                return "on_the_leaf"
        elif self.grows:
            return "unstable"
        if self._anywhere and grows(self.characteristic_of_all):
            return "unstable_beyond"
        return "open" if self.dimension else "point"


@lru_cache(maxsize=8)
def equilibrium(
    system: ReducedSystem, point: tuple[tuple[Tree, Number], ...]
) -> ClaimedEquilibrium:
    """The point of a system, computed once for all that is said of it."""
    return ClaimedEquilibrium(system, dict(point))
