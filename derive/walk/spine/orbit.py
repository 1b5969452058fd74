"""The body on an orbit of the group, and its motions as a whole."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ...algebra import calculus
from ...algebra.calculus import (
    derivation,
    determinant,
    determinant_letter,
    gradient,
    reduce,
    substitute,
    terms_with,
    without,
)
from ...algebra.groups import Group
from ...algebra.word_trees import PLAIN, WordNotation, metrics, tree_of
from ...algebra.words import Expr, Letter, inner, number, trace, word
from ...language.read import read
from ...language.tree import Tree, add, mul, neg
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import Prose
from ..chapter import Chapter, Draft, say, say_signed
from ..matrices.coordinates import at_constant_time, factored_tree
from .alphabet import Alphabet, cancelling, inverse_letter
from .cartan import DOMEGA, Cartan, body_rule, cauchy_green, natural_variations, primed, primes
from .kernel import Kernel
from .lagrangian import Moments, PointLagrangian, sum_over

# The body on an orbit of the group: what tells g_t (8), and what becomes of distances (1)(6).
#
# The points of the body are where they are by one element of the group. Sums over them, at an
# instant, tell which; and the distance of two of them changes through C = ĀA alone.


def unique(points: PointLagrangian, moments: Moments, a: Alphabet, c: Chapter) -> Step:
    """The step that tells A, and for an affine action T, by sums over the points where they are."""
    draft = c.draft("unique", "pull-back")
    centre = Letter("m⁻¹c", a.n)
    arm = word(a.r_i) - word(centre) if a.affine else word(a.r_i)
    turned = _summed(points, arm, moments, a)
    inertia = calculus.strip(terms_with(turned, a.A.position), a.A.position)
    # what is left of T, nothing as m m⁻¹c = c
    rest = substitute(without(turned, a.A.position), {a.c: word(a.m) * word(centre)})
    notation = WordNotation(display={centre: read("m⁻¹c")})
    second = read("Σᵢ mᵢ rᵢ(t)(rᵢ − m⁻¹c)‾" if a.affine else "Σᵢ mᵢ rᵢ(t) r̄ᵢ")
    turning = add(second, neg(draft.tree(rest, notation)))
    named: list[Equation] = []
    second_moment = draft.tree(inertia, notation)
    if a.affine:
        named, second_moment = [Equation("J_c", second_moment)], "J_c"
    equations = [*named, Equation(("mul", turning, ("inv", second_moment)), "A")]
    if a.affine:
        mass = moments[a.m_i,]
        others = _summed(points, number(1), moments, a) - mass * word(a.T.position)
        left = add(read("Σᵢ mᵢ rᵢ(t)"), neg(draft.tree(others)))
        equations.append(Equation(("mul", ("inv", draft.tree(mass)), left), "T"))
    return draft.step(equations, _prose(a), (8,))


def _summed(points: PointLagrangian, arm: Expr, moments: Moments, a: Alphabet) -> Expr:
    """The sum over the points Σ m_i r_i(t) x̄ for a vector x = ``arm`` of each, or Σ m_i r_i(t) for
    x = 1."""
    tested = Letter("Y", a.n, arm.rows)
    summand = inner(word(a.m_i) * points.position * arm.bar, word(tested))
    return gradient(sum_over(summand, {a.m_i, a.r_i}, moments), tested)


def _prose(a: Alphabet) -> Prose:
    where = say_signed("unique.affine_span" if a.affine else "unique.span", a.signed)
    return where + say("unique.elsewhere")


@dataclass(frozen=True)
class Distances:
    """The words for ‖r_i(t) − r_j(t)‖² and half its variation, by r_i − r_j."""

    square: Expr
    varied: Expr
    steps: tuple[Step, ...]


def _equations(d: Draft, square: Expr, varied: Expr, a: Alphabet) -> tuple[Equation, ...]:
    notation = metrics("C", display={a.difference: read("rᵢ − rⱼ")})
    return (
        Equation(read("‖rᵢ(t) − rⱼ(t)‖²"), d.tree(square, notation)),
        Equation(read("⟨rᵢ(t) − rⱼ(t), δ(rᵢ(t)) − δ(rⱼ(t))⟩"), d.tree(varied, notation)),
    )


def distances(points: PointLagrangian, a: Alphabet, c: Chapter) -> Distances:
    """‖r_i(t) − r_j(t)‖² by C, and half its variation, with their step."""
    draft = c.draft("distances", "trivialisation")
    other = Letter("r_j", a.n)
    beside = substitute(points.position, {a.r_i: word(other)})
    between = substitute(points.position, {a.r_i: word(other) + word(a.difference)}) - beside
    square, rule = inner(between, between), body_rule(a, cauchy_green(a))
    turned = {a.A.position: word(a.A.position) * word(a.Z.xi)}
    varied = reduce(derivation(square, turned.get), rule) * Fraction(1, 2)
    square = reduce(square, rule)
    step = draft.step(_equations(draft, square, varied, a), say("distances.cauchy_green"))
    return Distances(draft.mark(square), draft.mark(varied), (step,))


def rigid(general: Distances, unit: Expr, a: Alphabet, c: Chapter) -> Step:
    """The step that says that C = 1 keeps the distances of the points, and that their variations
    vanish (6)."""
    draft = c.draft("rigid", "relation")
    square, varied = (a.respell(e, unit).of(unit) for e in (general.square, general.varied))
    return draft.step(_equations(draft, square, varied, a), say("rigid.orbit"), (1, 6))


def unaligned(points: PointLagrangian, unit: Expr, b: Alphabet, c: Chapter) -> Step:
    """The step that tells g where the points are not all on one line: A(x ∧ y) = Ax ∧ Ay, of places
    or of their differences, for a matrix of determinant 1 with ĀA = 1.
    """
    draft, columns = c.draft("unaligned", "relation"), word(Letter("Y", 3, 3))
    unimodular = {determinant_letter(b.A.position): number(1)}
    if substitute(determinant(word(b.A.position) * columns), unimodular) != determinant(columns):
        raise ValueError("the map does not keep the triple product")
    draft.depends_on(unit, points.position)

    centre = mul(("inv", b.m.name), b.c.name)
    middle = (add("T", mul("A", centre)), centre) if b.affine else (0, 0)
    moved, still = (
        [add(place, neg(at)) for place in map(read, pair)]
        for pair, at in zip((["rᵢ(t)", "rⱼ(t)"], ["rᵢ", "rⱼ"]), middle, strict=True)
    )
    told = Equation(("wedge", *moved), ("mul", "A", ("wedge", *still)))
    return draft.step([told], say(f"unaligned.{'displaced' if b.affine else 'turned'}"), (8,))


def volumes(a: Alphabet, c: Chapter) -> Step:
    """The step that says how a volume varies, as that of which the moments tell: by Tr ξ."""
    draft, J = c.draft("volumes", "trivialisation"), "J_c" if a.affine else "J"
    metric, g = Letter(J, a.n, a.n, 1), word(a.A.position)
    moved = (g * word(metric)).marked(c.label("unique"))
    xi = word(a.Z.xi).marked(c.label("trivialisation"))
    varied = calculus.strip(derivation(moved, {a.A.position: g * xi}.get), a.A.position)
    turned = draft.tree(trace(reduce(varied * word(inverse_letter(metric)), cancelling(metric))))
    changed = read("Σᵢ mᵢ δ(rᵢ(t))(rᵢ − m⁻¹c)‾" if a.affine else "Σᵢ mᵢ δ(rᵢ(t)) r̄ᵢ")
    ratio: Tree = ("tr", mul(changed, ("inv", J), ("inv", "A")))
    return draft.step([Equation(ratio, turned)], say("volumes.trace"))


def tetrahedron(problem: Problem, group: Group, c: Chapter) -> tuple[Step, ...]:
    """The step that says that the volume of four points of R³ is kept, ⟨x, y ∧ z⟩ with the edges
    from the first, where all maps that keep volumes move them (Exercise 2)."""
    kept = "unimodular" in group.relations and group.keeps_no_more_than_volume
    if group.n != 3 or group.factors or not kept or len(problem.points) != 4:
        return ()
    draft, road = c.draft("tetrahedron", "relation"), "affine" if group.affine else "linear"
    draft.depends_on(*(number(1).marked(x) for x in (f"{road}.volumes", c.label("relation"))))
    at_origin = [k for k, p in enumerate(problem.points, 1) if not any(p.at)]
    first = at_origin[0] if at_origin else 1
    moved, varied, still = (
        [add(f(k), neg(f(first))) for k in range(1, 5) if k != first]
        for f in (
            _in_space,
            lambda k: ("call", "δ", _in_space(k)),
            lambda k: 0 if k in at_origin else ("at", "r", k),
        )
    )
    changes = (
        _triple_product(*(varied[j] if j == k else x for j, x in enumerate(moved)))
        for k in range(3)
    )
    equations = (
        Equation(_triple_product(*moved), _triple_product(*still)),
        Equation(add(*changes), 0),
    )
    told: dict[str, Tree] = {"orbit": 3 * len(problem.points) - 1}
    if not group.affine:
        told["linear"] = group.dimension
    orbit = draft.claim(f"tetrahedron.{road}", **told)
    return (draft.step(equations, say("tetrahedron.kept") + orbit),)


def _in_space(k: int) -> Tree:
    return ("call", ("at", "r", k), "t")


def _triple_product(x: Tree, y: Tree, z: Tree) -> Tree:
    """⟨x, y ∧ z⟩."""
    return ("inner", x, ("wedge", y, z))


# The motions as a whole: a symplectic manifold (26); curves in the space of all matrices.
#
# dϖ vanishes on the tangent X of a motion, so of a variation it sees only what crosses the
# motions.


def motions(form: Cartan, law: Kernel, a: Alphabet, c: Chapter) -> Step:
    """The step that writes dϖ by what crosses the motions: there the forces do the work of the
    acceleration."""
    draft = c.draft("motions", "kernel")
    along = {p.dp_position: word(p.d_position) for p in a.parts}
    work = substitute(law.balance, along) + form.work
    derivative = calculus.exterior(form.form, primes(a), *natural_variations(work, a))
    images = {}
    for p in a.parts:
        images[p.d_position] = word(p.d_position) - word(p.velocity) * word(a.dt)
        images[p.d_velocity] = word(p.d_velocity) - word(p.acceleration) * word(a.dt)
    images |= {primes(a)[x]: primed(e, a) for x, e in images.items()}
    core = at_constant_time(derivative, a.dt, a.dpt)
    notation = metrics() if a.affine else metrics("J")
    return draft.step(
        (Equation(DOMEGA, factored_tree(draft, derivative, core, images, notation)),),
        say("motions.manifold") + say("motions.complete"),
        (26,),
    )


def held(law: Kernel, C: Expr, n: int, c: Chapter) -> Step:
    """The step about SO(n) in the space of all matrices: what the constraint adds is orthogonal to
    the group."""
    draft, b = c.draft("geodesics", "multiplier"), Alphabet(n, affine=False, skew=True)
    any_matrix, rate = b.with_free_displacement().Z.xi_prime, b.A.acceleration
    along = {b.A.dp_position: word(b.A.position) * word(any_matrix)}
    added = gradient(substitute(b.respell(law.balance), along), any_matrix).of(C)
    core = {rate: word(rate) - word(b.F_group)}
    left, right = (
        factored_tree(draft, e, without(e, b.F_group), core, PLAIN) for e in (added, added.bar)
    )
    Z, tested = word(b.Z.velocity), word(b.Z.xi_prime)
    seen = inner(tested, word(b.A.position).bar * word(rate))
    carried = inner(tested, Z * Z + word(b.Z.acceleration))
    return draft.step(
        (
            Equation(left, right),
            Equation(tree_of(seen), tree_of(carried)),
        ),
        say("geodesics.held") + say("geodesics.free"),
    )
