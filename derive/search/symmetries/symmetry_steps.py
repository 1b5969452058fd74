"""The symmetries of a problem as a record: L̃ and its momenta, then a step for each symmetry; and
the record of a reduction by them: momenta, locked inertia, connection, Routhian.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, add, mul, neg, nodes, plain, terms
from ...problem.problem import Problem
from ...record.as_json import encode
from ...record.record import Derivation, Equation, Hypothesis, Step, stated
from ...walk.chapter import Chapter, Values, say
from ...walk.lie import expressed
from ...walk.lie.expressed import of_element
from ...walk.spine.head import recorded
from .found_symmetries import Central, SymmetriesFound
from .quadrature import Quadrature, reduced
from .routhian import Routhian, Square
from .state_functions import Element
from .symmetry import ON_FORM, Symmetry


@dataclass(frozen=True)
class Symmetries:
    """The symmetries of a problem, and their record."""

    found: SymmetriesFound
    record: Derivation


def symmetries_record(found: SymmetriesFound, general: Values) -> Derivation:
    """The record of the symmetries of a problem; ``general``: the road of any Lagrangian."""
    c, before, (*_, basis) = expressed_on_basis(found.problem, general)
    whole = _summary(found, c)
    steps = [*before, whole]
    for k, x in enumerate(found.symmetries, 1):
        steps.append(_symmetry(x, f"conserved_{k}", (whole, basis), c))
    steps += [_central(found, x, whole, c) for x in found.central]
    return recorded(found.problem, steps)


def expressed_on_basis(
    problem: Problem, general: Values
) -> tuple[Chapter, tuple[Step, ...], tuple[Step, ...]]:
    """The chapter of a problem, the steps up to its L̃ on a basis, and the last of these: of L̃, of
    its momenta, of its energy and of the basis."""
    group, road = problem.own_group, general["lagrangian"]
    c = Chapter(problem.name, group.name)
    basis = of_element(problem, group, road, c)
    own = expressed.expressed(problem, group, road, basis, c).steps
    return c, (*general["steps"], *basis.steps, *own), (*own, basis.last)


def _summary(found: SymmetriesFound, c: Chapter) -> Step:
    """How many symmetries there are, of which kind; and why the motion keeps something by each."""
    draft = c.draft("symmetries", "kernel")
    modulo = bool(found.lagrangian.held)
    if not found.dimension:
        (count,) = draft.claim("symmetries.none")
    else:
        key = f"symmetries.algebra{'_modulo' if modulo else ''}"
        (count,) = draft.claim(key, dimension=found.dimension)
    prose = say("symmetries.all", count=count) + (say("symmetries.modulo") if modulo else ())
    if found.integrand:
        prose += say("symmetries.integrand", **vars(found.integrand))
    if found.functions:
        prose += draft.claim("symmetries.open", functions=("row", *found.functions))
    return draft.step(stated("dϖ(δy, X) = 0"), prose + say("symmetries.kernel"))


def _field(x: Symmetry, prime: str = "") -> list[Equation]:
    return [Equation(f"δ{prime}t", x.tau), Equation(f"δ{prime}A", x.displacement)]


def _symmetry(x: Symmetry, label: str, made_from: tuple[Step, ...], c: Chapter) -> Step:
    """A symmetry: its field, what it does to L̃, ϖ of it, and what the motion keeps."""
    draft = c.draft(label, "conservation", *made_from[: 2 if x.terms else 1])
    field = _field(x)
    equations = [*field, Equation(("call", "δ", "L̃"), x.rate)]
    equations.append(Equation(add(ON_FORM, neg(x.F)), x.conserved()))
    equations.append(Equation(("call", "d/dt", add(ON_FORM, neg(x.F))), 0))
    (name,) = draft.claim(f"symmetries.{x.kind}")
    prose = say("symmetries.exact" if x.exact else "symmetries.up_to", kind=name)
    return draft.step(equations, prose, where=field)


def _central(found: SymmetriesFound, pair: Central, whole: Step, c: Chapter) -> Step:
    """Two symmetries that commute, and the number that dϖ of them is."""
    names = [f"conserved_{k + 1}" for k in (pair.first, pair.second)]
    draft = c.draft("_and_".join(names), "exterior derivative", whole)
    one, two = (found.symmetries[k] for k in (pair.first, pair.second))
    fields = [*_field(one), *_field(two, "′")]
    equation = Equation(stated("dϖ(δy, δ′y) = 0")[0].lhs, pair.number)
    (first,), (second,) = (draft.claim(f"symmetries.{x.kind}") for x in (one, two))
    return draft.step(
        [*fields, equation], say("symmetries.central", first=first, second=second), where=fields
    )


BOTH: tuple[Tree, Tree] = ("δy", "δ′y")


def momentum(i: int) -> Tree:
    """𝒥_i, i from 0."""
    return ("at", "𝒥", i + 1)


def connection(i: int, xi: Tree) -> Tree:
    """𝒜_i(ξ), i from 0."""
    return ("call", ("at", "𝒜", i + 1), xi)


def told(
    r: Routhian, left: Quadrature | None, made_from: Sequence[Step], c: Chapter
) -> tuple[Step, ...]:
    """The steps of a reduction, with the quadrature that is ``left``; ``made_from``: those of L̃, of
    its momenta, of its energy and of the basis."""
    lagrangian, momenta, energy, basis = made_from
    told_momenta = [_momentum(x, i, r, (lagrangian, momenta), c) for i, x in enumerate(r.chosen)]
    pairs = [
        _commuting(i, j, r, (told_momenta[i], told_momenta[j]), c)
        for j, _ in enumerate(r.chosen)
        for i in range(j)
    ]
    locked = _locked(r, (*told_momenta, lagrangian), c)
    velocities = _connection(r, (locked, *told_momenta, basis), c)
    form = _form(r, (*told_momenta, velocities), c)
    effective = _effective(r, (*told_momenta, velocities, locked, lagrangian, energy), c)
    bent = _curvature(r, (form, velocities, basis), c)
    steps = (*told_momenta, *pairs, locked, velocities, form, *bent, effective)
    last = [_quadrature(r, left, (effective, basis), c)] if left else []
    return (*steps, *last)


# -- the momenta --------------------------------------------------------------------------------


def _momentum(x: Symmetry, i: int, r: Routhian, made_from: Iterable[Step], c: Chapter) -> Step:
    """A symmetry, its momentum, and what dϖ has of its field: nothing on a level."""
    draft = c.draft(f"momentum_{i + 1}", "conservation", *made_from)
    field, own = _field(x), momentum(i)
    equations = [
        *field,
        Equation(("call", "δ", "L̃"), 0),
        Equation(own, x.conserved()),
        Equation(ON_FORM, own),
        Equation(("call", "dϖ", *BOTH), neg(("call", "δ′", own))),
        Equation(("call", "d/dt", ON_FORM), 0),
    ]
    prose = () if i else draft.claim("reduction.taken", count=len(r.chosen))
    (kind,) = draft.claim(f"symmetries.{x.kind}")
    prose += say("reduction.momentum", kind=kind)
    return draft.step(equations, prose, where=field)


def _commuting(i: int, j: int, r: Routhian, made_from: Iterable[Step], c: Chapter) -> Step:
    """dϖ of two of the fields vanishes."""
    draft = c.draft(f"momentum_{i + 1}_and_{j + 1}", "exterior derivative", *made_from)
    fields = [*_field(r.chosen[i]), *_field(r.chosen[j], "′")]
    return draft.step(
        [*fields, Equation(("call", "dϖ", *BOTH), 0)], say("reduction.commute"), where=fields
    )


# -- the locked inertia and the connection -------------------------------------------------------


def _locked(r: Routhian, made_from: Iterable[Step], c: Chapter) -> Step:
    draft = c.draft("locked", "definition", *made_from)
    span = range(len(r.chosen))
    rows = (("row", *(r.locked_tree(i, j) for j in span)) for i in span)
    return draft.step([Equation("𝕀", ("matrix", *rows))], say("reduction.locked"))


def _cleared(square: Square, r: Routhian) -> tuple[Element, Tree]:
    """What a square of V is of, times its common denominator, and that."""
    times, tree = r.functions.field(square.scale), r.functions.tree
    factors = (tree(square.factors[i] * times, momentum(i)) for i in sorted(square.factors))
    return times, add(*factors, neg_all(terms(tree(square.rest * times))))


def _connection(r: Routhian, made_from: Iterable[Step], c: Chapter) -> Step:
    """The velocities along the symmetries, and what is left of ζ."""
    draft = c.draft("connection", "inversion", *made_from)
    equations = [_velocity(x, r) for x in reversed(r.squares)]
    for a in r.free:
        moved = (
            mul(-1, r.tree(eta[a], connection(i, "Z"))) for i, eta in enumerate(r.eta) if eta[a]
        )
        equations.append(Equation(horizontal(a), add(r.zeta[a], *moved)))
    still = [a for a, _ in enumerate(r.zeta) if r.freedom and a not in {*r.free, *r.held}]
    equations += [Equation(horizontal(a), 0) for a in still]
    return draft.step(equations, say("reduction.connection"))


def horizontal(a: int) -> Tree:
    """A coordinate of ζ_h, a from 0."""
    return ("entry", "ζ_h", a + 1)


def _velocity(square: Square, r: Routhian) -> Equation:
    """The velocity along a symmetry, by its momentum and the velocities along later ones."""
    scale, linear = _cleared(square, r)
    tree = r.functions.tree
    later = (mul(-1, tree(x / square.pivot, connection(j, "Z"))) for j, x in square.later.items())
    return Equation(
        connection(square.place, "Z"), add(tree(2 * square.weight / scale, linear), *later)
    )


# -- the forms ----------------------------------------------------------------------------------


def _form(r: Routhian, made_from: Iterable[Step], c: Chapter) -> Step:
    """ϖ_h = ϖ − Σ 𝒥_i 𝒜_i, and dϖ_h by d(f𝒜)(δ, δ′) = f d𝒜(δ, δ′) + δf 𝒜(ξ′) − δ′f 𝒜(ξ)."""
    draft = c.draft("routh", "exterior derivative", *made_from)
    span = range(len(r.chosen))
    paired = (mul(momentum(i), connection(i, "ξ")) for i in span)
    equations = [Equation(("call", "ϖ_h", "δy"), add(ON_FORM, neg_all(paired)))]
    for i in span:
        varied: list[Tree] = [
            ("call", "δ", connection(i, "ξ′")),
            neg(("call", "δ′", connection(i, "ξ"))),
        ]
        equations.append(Equation(curvature(i), add(*varied)))
    derived = (x for i in span for x in _derivative(i))
    equations.append(
        Equation(("call", "dϖ_h", *BOTH), add(("call", "dϖ", *BOTH), neg_all(derived)))
    )
    return draft.step(equations, say("reduction.form") + say("reduction.curvature"))


def neg_all(summed: Iterable[Tree]) -> Tree:
    """The opposite of a sum, term by term."""
    return add(*map(neg, summed))


def curvature(i: int) -> Tree:
    """d𝒜_i(δy, δ′y), i from 0."""
    return ("call", ("at", "d𝒜", i + 1), *BOTH)


def _derivative(i: int) -> tuple[Tree, ...]:
    """The terms of d(𝒥_i 𝒜_i)(δ, δ′)."""
    own = momentum(i)
    return (
        mul(own, curvature(i)),
        mul(("call", "δ", own), connection(i, "ξ′")),
        neg(mul(("call", "δ′", own), connection(i, "ξ"))),
    )


def _curvature(r: Routhian, made_from: Iterable[Step], c: Chapter) -> tuple[Step, ...]:
    """d𝒜_i in coordinates of ξ and ξ′, where that is short."""
    if r.curvature is None:
        return ()
    draft = c.draft("curvature", "structure equation", *made_from)
    equations = [
        Equation(curvature(i), _two_form(values, r)) for i, values in enumerate(r.curvature)
    ]
    flat = not any(r.curvature)
    return (draft.step(equations, draft.claim("reduction.flat" if flat else "reduction.curved")),)


def _two_form(values: Mapping[tuple[int, int], Element], r: Routhian) -> Tree:
    """Σ B_ab (ξ_a ξ′_b − ξ_b ξ′_a), what divides all B_ab taken out."""
    if not values:
        return 0
    listed, field = [*values.values()], r.functions.field
    over, under = listed[0].numer, listed[0].denom
    for x in listed[1:]:
        over, under = over.gcd(x.numer), under.lcm(x.denom)
    common = field(over) / field(under)

    def coordinate(name: str, a: int) -> Tree:
        found = r.group.coordinate_terms(a)
        if len(found) == 1 and found[0][0] < 0 and _skew(r.group.basis[a]):
            ((x, i, j),) = found
            found = [(-x, j, i)]
        return add(*(mul(plain(x), ("entry", name, i + 1, j + 1)) for x, i, j in found))

    pairs = []
    for (a, b), x in values.items():
        crossed = mul(coordinate("ξ", b), coordinate("ξ′", a))
        wedge = add(mul(coordinate("ξ", a), coordinate("ξ′", b)), neg(crossed))
        pairs.append(r.functions.tree(x / common, wedge))
    return r.functions.tree(common, add(*pairs))


def _skew(e: Matrix) -> bool:
    return e == q.scaled(-1, q.transposed(e))


# -- the effective potential --------------------------------------------------------------------


def _effective(r: Routhian, made_from: Iterable[Step], c: Chapter) -> Step:
    """V, h̃ = ½⟨ζ_h, Mζ_h⟩ + V, and the Routhian."""
    draft = c.draft("effective", "Legendre transform", *made_from)
    kinetic, linear = _kinetic(r), _linear(r)
    spent = (mul(momentum(i), connection(i, "Z")) for i, _ in enumerate(r.chosen))
    equations = [
        Equation("𝒱", add(r.energy_at_rest, *(_square(x, r) for x in reversed(r.squares)))),
        Equation("h̃", add(kinetic, "𝒱")),
        Equation("ℛ", add("L̃", neg_all(spent))),
        Equation("ℛ", add(kinetic, linear, neg("𝒱"))),
    ]
    prose = say("reduction.effective")
    prose += say("reduction.named") if r.named else ()
    if r.conditions:
        kind = "isotropy" if r.singular_elsewhere and not r.leaves_none else "divided"
        trees: dict[Tree, None] = {}
        for t in map(r.functions.tree, r.conditions):  # without the minus that they begin with
            trees[mul(-1, t) if isinstance(t, tuple) and t[:2] == ("mul", -1) else t] = None
        prose += draft.claim(f"reduction.{kind}", conditions=("row", *trees))
        prose += draft.claim("reduction.free") if r.leaves_none else ()
    return draft.step(equations, prose)


def _square(square: Square, r: Routhian) -> Tree:
    scale, linear = _cleared(square, r)
    return r.functions.tree(square.weight / scale**2, ("pow", linear, 2))


def _kinetic(r: Routhian) -> Tree:
    """½⟨ζ_h, Mζ_h⟩."""
    free, tree = r.free, r.tree
    found = []
    for a in free:
        for b in free:
            if a == b:
                found.append(tree(r.metric[a][a] / 2, ("pow", horizontal(a), 2)))
            elif a < b:
                found.append(tree(r.metric[a][b], horizontal(a), horizontal(b)))
    return add(*found)


def _linear(r: Routhian) -> Tree:
    """⟨b, ζ_h⟩, which is 0 where b is a combination of the Mη_i."""
    if r.vanishes(r.linear):
        return 0
    return add(*(r.tree(r.linear[a], horizontal(a)) for a in r.free))


def _quadrature(r: Routhian, found: Quadrature, made_from: Iterable[Step], c: Chapter) -> Step:
    """u̇² by the energy and the momenta."""
    draft = c.draft("quadrature", "reduction", *made_from)
    assert isinstance(found.entry, tuple)
    rate: Tree = ("entry", "Ȧ", *found.entry[2:])
    tree, simplified = r.functions.tree, r.functions.simplified
    inside: list[Tree] = ["h̃", neg_all([r.energy_at_rest])]
    aside = []
    for square in reversed(r.squares):
        scale, linear = _cleared(square, r)
        weight = 2 * simplified(found.slope * square.weight) / scale**2
        if r.functions.used(square.weight.denom) and not r.functions.used(weight.denom):
            aside.append(neg(tree(weight, ("pow", linear, 2))))
        else:
            inside.append(neg(_square(square, r)))
    whole = add(tree(2 * found.slope, add(*inside)), *aside)
    prose = draft.claim("reduction.quadrature", entry=found.entry)
    if found.degree:
        kind, degrees = _integral(found.left), {"degree": found.degree}
        if found.left < found.degree:
            kind, degrees = f"{kind}_squared", degrees | {"left": found.left}
        prose += draft.claim(f"reduction.{kind}", **degrees)
    letters = (("h̃",) if x is None else map(momentum, x) for x in found.leading)
    pairs = zip(found.leading.values(), letters, strict=True)
    leading = add(*(r.tree(x, *y) for x, y in pairs))
    supposed = [Hypothesis("nonzero", leading)] if any(map(_open, nodes(leading))) else []
    return draft.step([Equation(("pow", rate, 2), whole)], prose, hypotheses=supposed)


def _open(t: Tree) -> bool:
    """Is it a number that may be 0: a parameter, a momentum, the energy?"""
    return t == "h̃" or (isinstance(t, tuple) and t[0] in ("par", "at"))


def _integral(degree: int) -> str:
    """What the integral of 1/√f is, f of this degree but for squares: a key of the prose."""
    return "elementary" if degree < 3 else "elliptic" if degree < 5 else "hyperelliptic"


# Routh's reduction of a problem as a record: L̃, its momenta, then the steps of the reduction.


@dataclass(frozen=True)
class Reduction:
    """The reduction of a problem, the quadrature that is left, if one is, and its record."""

    routhian: Routhian
    quadrature: Quadrature | None
    record: Derivation


def reduction_record(found: SymmetriesFound, general: Values) -> Reduction:
    """The record of a reduction; ``general``: the road of any Lagrangian.  ``ProblemError`` where
    there is nothing to reduce by."""
    routhian, left = reduced(found)
    c, before, made_from = expressed_on_basis(found.problem, general)
    steps = (*before, *told(routhian, left, made_from, c))
    fields = [encode(x.displacement) for x in routhian.chosen]
    return Reduction(routhian, left, recorded(found.problem, steps, symmetries=fields))
