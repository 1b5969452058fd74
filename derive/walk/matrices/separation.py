"""Where a motion separates into those of the linear parts and of the centre of mass."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ...algebra.calculus import PairRule, gradient, reduce, substitute, terms_with, without
from ...algebra.groups import Group
from ...algebra.words import Expr, Factor, Letter, inner, one, word, zero
from ...language.laurent import Laurent
from ...language.tree import Tree, add, mul, neg
from ...problem.problem import Problem
from ...record.record import Equation, Step, stated
from ...record.sentence import Prose, listed
from ..chapter import Chapter, phrase, say, say_signed
from ..given.body_and_potentials import U_Q, Potentials
from ..given.potential_terms import column
from ..spine.alphabet import Alphabet, cancel_scalar, cancelling, inverse_letter, inverses
from ..spine.principle import AND
from .coordinates import LinearSystem, depends
from .specialisation import KernelOnGroup

# When a motion separates into those of the linear parts and of the centre of mass (Exercise 2).
#
# With  R = T + A c / m  in place of T the kinetic energy is always a sum of the two; the motion
# separates where the potential is one as well.


def _barycentric(e: Expr, a: Alphabet, mark: str = "") -> Expr:
    """An expression with T and τ by the centre of mass R, Ṙ, and J by J_c; ``mark``: the step that
    says so."""
    moment, value = central_moments(a)
    lighter, first = word(inverse_letter(a.m)), word(a.c)
    place, rate = Letter("R", a.n), Letter("Ṙ", a.n)
    images = {
        a.T.position: word(place) - lighter * word(a.A.position) * first,
        a.T.velocity: word(rate) - lighter * word(a.A.velocity) * first,
        a.J: word(moment) + word(a.J) - value,
    }
    if mark:
        images = {x: y.marked(mark) for x, y in images.items()}
    return cancel_scalar(substitute(e, images), a.m)


def kinetic_separation(kinetic: Expr, a: Alphabet, c: Chapter) -> Step:
    """The step that writes L̃ by the centre of mass: no term has both α and Ṙ."""
    draft = c.draft("separation", "identification")
    equations = (
        *stated("R = T + m⁻¹Ac,  Ṙ = τ + m⁻¹αc"),
        Equation("J_c", draft.tree(central_moments(a)[1], inverses(a.m))),
        Equation("L̃", draft.tree(_barycentric(kinetic, a) - word(a.U), inverses(a.m))),
    )
    return draft.step(equations, say("separation.kinetic") + say("separation.condition"))


def potential_separation(
    problem: Problem, v: Potentials, b: Alphabet, c: Chapter
) -> tuple[Step, ...]:
    """The step that writes Ũ by the centre of mass, and says whether the motion of this problem
    separates; none where Ũ is no sum of such terms."""
    if any(b.T.position in x.value.letters() for x in v.own):
        return ()  # a function of T that is no sum
    draft = c.draft("separation", "identification")
    energy = _barycentric(v.energy, b, Chapter(b.chapter).label("separation"))
    place = Letter("R", b.n)
    inside = v.pointwise.shifts
    both = bool(terms_with(terms_with(energy, place), b.A.position))
    rest = bool(without(energy, U_Q)) and not both
    prose = _prose(
        problem, decided=inside and not both, rest=rest, pointwise=bool(v.pointwise.energies)
    )
    return (draft.step((Equation("Ũ", draft.tree(energy, inverses(b.m))),), prose),)


def _prose(problem: Problem, *, decided: bool, rest: bool, pointwise: bool) -> Prose:
    damping = [phrase("separation.damping")] if problem.damping else []
    outside = damping + ([phrase("separation.inputs")] if problem.inputs else [])
    outside += [phrase("separation.stated")] if problem.forces else []
    if not decided:
        prose = say("separation.pointwise")
        if rest:
            prose += say("separation.rest")
        if outside:
            prose += say("separation.outside_too", forces=listed(AND, outside))
        return prose
    if outside:
        prose = say("separation.outside", forces=listed(AND, outside))
    else:
        prose = say("separation.separates")
    if pointwise:
        prose += say("separation.differences")
    return prose


# H ⋉ Rⁿ: the translation is eliminated on words, and the central moments J_c take the place of J.
#
# The coefficient of η′ is solved for ẇ and put into that of ξ′. What remains is the problem of
# the linear parts H about the centre of mass.


@dataclass(frozen=True)
class Barycentric:
    """The linear problem that is left: ``inertial`` in ξ′ with ``metric`` J_c, and its ``force``.

    ``acceleration``: ẇ, as the record has it; ``rate``: the same on words in r_c and w.
    """

    inertial: Expr
    force: Expr
    metric: Letter
    acceleration: Tree
    rate: Expr
    steps: tuple[Step, ...]


def central_moments(b: Alphabet) -> tuple[Letter, Expr]:
    """The letter J_c and its value J − m⁻¹ c c̄."""
    first = word(b.c)
    return Letter("J_c", b.n, b.n, 1), word(b.J) - word(inverse_letter(b.m)) * first * first.bar


def eliminate_translation(stage: KernelOnGroup, c: Chapter) -> Barycentric:
    """The equations of the linear parts about the centre of mass, with ẇ solved for; and their
    step."""
    b, draft = stage.letters, c.draft("elimination", "elimination")
    xi, eta, w_dot = b.Z.xi_prime, b.w.xi_prime, b.w.acceleration
    cancel = cancelling(b.C)
    notation = inverses(b.C, b.m)

    centre, drift = Letter("r_c", b.n), Letter("w_c", b.n)
    velocity = word(b.w.velocity) + word(b.Z.velocity) * word(centre)
    from_centre = {
        b.c: word(b.m) * word(centre),
        b.w.velocity: word(b.w.velocity) + word(drift) - velocity,
    }

    def tidy(e: Expr) -> Expr:
        return cancel_scalar(reduce(e, cancel), b.m)

    left = word(inverse_letter(b.C)) if b.unit != stage.C else b.unit
    balance = gradient(stage.inertial, eta) - stage.forces[eta]
    free = tidy(word(inverse_letter(b.m)) * (left * without(balance, w_dot)))
    metric, value = central_moments(b)
    by_centre = {b.J: word(metric) + word(b.J) - value}  # not in the forces, which may have a J
    remaining = substitute(substitute(without(stage.inertial, eta), by_centre), {w_dot: -free})
    remaining = tidy(remaining - inner(stage.forces[xi], word(xi)))
    inertial = terms_with(remaining, metric)
    force = gradient(inertial - remaining, xi)
    force = tidy(substitute(force, {b.c: word(b.m) * word(centre)}))
    solved = draft.tree(tidy(substitute(-free, from_centre)), notation)
    pairing = inner(word(Letter("N_c", b.n, b.n)), word(xi))
    step = draft.step(
        (
            Equation("r_c", draft.tree(word(inverse_letter(b.m)) * word(b.c), notation)),
            Equation("w_c", draft.tree(velocity, notation)),
            Equation("ẇ", solved),
            Equation("J_c", draft.tree(value, notation)),
            Equation("N_c", draft.tree(force, notation)),
            Equation(draft.tree(inertial), draft.tree(pairing), (xi.name,)),
        ),
        say_signed("elimination.linear_parts", b.signed),
    )
    rate = tidy(substitute(-free, {b.c: from_centre[b.c]}))
    inertial, force, rate = (draft.mark(e) for e in (inertial, force, rate))
    return Barycentric(inertial, force, metric, solved, rate, (step,))


# A product of groups H ⋉ Rⁿ with skew H: each factor is seen from its centre of mass.
#
# On (r, 1) that is the material frame 1 + S, with the centres of mass in the columns of S that
# are those of the translations. SY = 0 and YS is in 𝔤 for every Y in 𝔤, and the moments lose what
# ties turning to translating:
#
# J = (1 + S)J_c(1 + S̄), Z_c = Z(1 + S), Ż = Ż_c(1 − S).


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
    if not group.barycentric_blocks:
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
    return {o + i: o + f.n for o, f in group.barycentric_blocks for i in range(f.n)}


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


# Are equations linear with constant coefficients, with those of the entries of g in them?

KNOWN = ("ζ", "w", "A", "T", "Γ")
GIVEN = ("u", "f_u")
"""Inputs: they do not count as state."""


def linear(stage: LinearSystem, rate: Callable[[Tree], Laurent | None]) -> bool:
    """Is M constant, and β a sum of constants times entries whose rates are such sums again?

    ``rate``: that of an entry of g, or of what is carried along; ``None`` for an entry of ζ or w.
    """
    if any(_symbols(x) for row in stage.mass for x in row):
        return False
    waiting, seen = [*stage.load], set[Tree]()
    while waiting:
        found = _linear_symbols(waiting.pop())
        if found is None:
            return False
        new = found - seen
        seen |= new
        waiting += [x for x in map(rate, new) if x is not None]
    return True


def constant(stage: LinearSystem) -> bool:
    """Do M and β not depend on the state?"""
    return not any(_symbols(x) for x in (*stage.load, *(y for row in stage.mass for y in row)))


def _symbols(p: Laurent) -> set[Tree]:
    return {s for m in p.terms for s, _ in m if depends(s)}


def _linear_symbols(p: Laurent) -> set[Tree] | None:
    """The state's entries in a sum of constants times one of these; ``None`` of any other."""
    found = set[Tree]()
    for m in p.terms:
        moving = [(s, e) for s, e in m if depends(s)]
        if not moving:
            continue
        (s, e), *more = moving
        if more or e != 1 or not isinstance(s, tuple) or s[0] != "entry":
            return None
        if s[1] in KNOWN:
            found.add(s)
        elif s[1] not in GIVEN and s[1][:2] != ("at", "f_u"):
            return None
    return found
