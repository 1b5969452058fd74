"""A product of groups H ⋉ Rⁿ with skew H: each factor is seen from its centre of mass.

On (r, 1) that is the material frame 1 + S, with the centres of mass in the columns of S that are
those of the translations.  SY = 0 and YS is in 𝔤 for every Y in 𝔤, and the moments lose what ties
turning to translating:

    J = (1 + S)J_c(1 + S̄),    Z_c = Z(1 + S),    Ż = Ż_c(1 − S).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..algebra.calculus import PairRule, gradient, reduce, substitute
from ..algebra.groups import Group
from ..algebra.words import Expr, Factor, Letter, inner, one, word, zero
from ..language.tree import Tree, add, mul, neg
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .chapter import Chapter
from .point_potentials import column
from .wording import say


@dataclass(frozen=True)
class CentralEquations:
    """The equations of motion seen from the centres of mass: ``inertial`` and ``force`` in ξ′ and
    Ż_c; ``shift``: S."""

    inertial: Expr
    force: Expr
    shift: Expr
    steps: tuple[Step, ...]


def seen_from_centres(
    inertial: Expr, force: Expr, group: Group, b: Alphabet, c: Chapter
) -> CentralEquations | None:
    """The equations of motion with ξ′(1 − S) in the place of ξ′, and their step; ``None`` for a
    group without a factor H ⋉ Rⁿ."""
    if not group.centred:
        return None
    draft, n = c.draft("elimination", "elimination"), b.n
    S, J_c, Z_c = Letter("S", n, n), Letter("J_c", n, n, 1), Letter("Z_c", n, n)
    first, Z, Y, xi = Letter("c_c", n), b.Z.velocity, b.Z.acceleration, b.Z.xi_prime
    there, back = one(n) + word(S), one(n) - word(S)
    images = {
        b.J: there * word(J_c) * there.bar,
        b.c: there * word(first),
        Z: word(Z_c) * back,
        Y: word(Y) * back,
        xi: word(xi) * back,
    }
    left, right = (
        reduce(substitute(e, images), annulled(S, {Z_c, Y, xi}))
        for e in (inertial, inner(force, word(xi)))
    )
    step = draft.step(
        (
            Equation("S", _shift(group)),
            Equation("Z_c", draft.tree(word(Z) + word(Z) * word(S))),
            Equation("J_c", _central(group)),
            Equation(draft.tree(reduce(images[b.J], annulled(S, set()))), "J"),
            *([_first(group)] if b.c in force.letters() else []),
        ),
        say("elimination.centres"),
    )
    return CentralEquations(
        draft.mark(left), gradient(draft.mark(right), xi), draft.mark(word(S)), (step,)
    )


def annulled(S: Letter, algebra: set[Letter]) -> PairRule:
    """The relations SS = 0 and SY = 0, for Y one of the letters ``algebra`` of 𝔤, and their
    bars."""
    after = {S, *algebra}

    def rule(x: Factor, y: Factor) -> Expr | None:
        plain = x == (S, False) and y[0] in after and not y[1]
        barred = y == (S, True) and x[0] in after and x[1]
        return zero(S.rows, S.cols) if plain or barred else None

    return rule


def _columns(group: Group) -> dict[int, int]:
    """Row → column of the centre of mass, counted from 0, for the rows of each factor that
    has one."""
    return {o + i: o + f.n for o, f in group.centred for i in range(f.n)}


def _shift(group: Group) -> Tree:
    """The matrix S: m⁻¹c of each factor, read off the last column of its block of J."""
    last = _columns(group)

    def entry(i: int, j: int) -> Tree:
        return mul(("inv", _J(j, j)), _J(i, j)) if last.get(i) == j else 0

    return _square(group.n, entry)


def _central(group: Group) -> Tree:
    """The matrix J_c: J − m⁻¹cc̄ in each block, and the mass of the factor in its corner."""
    last = _columns(group)
    block = [k for k, (_, factor) in enumerate(group.places) for _ in range(factor.size)]

    def entry(i: int, j: int) -> Tree:
        i, j = min(i, j), max(i, j)  # symmetric in what it is made of, too
        k = last.get(i)
        if block[i] != block[j] or k == j or last.get(j) == i:
            return 0
        if k is None:
            return _J(i, j)
        return add(_J(i, j), neg(mul(("entry", "S", i + 1, k + 1), _J(j, k))))

    return _square(group.n, entry)


def _first(group: Group) -> Equation:
    """The equation of c_c, which is c with 0 for the first moments of factors that have a
    centre."""
    last = _columns(group)
    rows: list[Tree] = [0 if i in last else ("entry", "c", i + 1) for i in range(group.n)]
    return Equation("c_c", column(tuple(rows)))


def _J(i: int, j: int) -> Tree:
    return ("entry", "J", i + 1, j + 1)


def _square(n: int, entry: Callable[[int, int], Tree]) -> Tree:
    return ("matrix", *(("row", *(entry(i, j) for j in range(n))) for i in range(n)))
