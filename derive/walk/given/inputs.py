"""What is given from outside dϖ: covectors and forces at every call, and damping."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import NamedTuple

from ...algebra.calculus import gradient, reduce, substitute
from ...algebra.groups import Group
from ...algebra.word_trees import fold_inertia, normal_form, tree_of
from ...algebra.words import Expr, Letter, inner, number, word
from ...language.reserved import UNNAMED_DAMPING, UNNAMED_FORCE, rate_of_mass, suffixed
from ...language.tree import Tree, add, mul, neg, nodes, plain, replaced
from ...problem.entries_on_orbit import along
from ...problem.problem import Problem
from ...record.record import Equation, Step, stated
from ...record.sentence import Prose, listed
from ...schema.force_kinds import ForceInput, ScalarInput, StatedForce, TorqueInput
from ..chapter import Chapter, Draft, phrase, say
from ..matrices.isomorphism import OMEGA_P, ZETA, HatMap, anticommute, inertia_of, vector_sum
from ..spine.alphabet import Alphabet
from ..spine.cartan import body_rule
from ..spine.lagrangian import sum_over
from ..spine.principle import AND
from .body_and_potentials import Applied, applied
from .potential_terms import column, embedded

INPUTS = phrase("input.forces")
DRAG = phrase("input.damping")
Push = ForceInput | TorqueInput | StatedForce
TORQUE, FORCE = Letter("u", 3), Letter("f_u", 3)


class Wrench(NamedTuple):
    """What acts by one name, among the moments and in the resultant, 0 where it is in none."""

    name: str
    moment: Tree
    pull: Tree


@dataclass(frozen=True)
class External:
    """The forces from outside dϖ on words: their ``moments`` and ``resultant``, the step that says
    these, and the ``parts`` of which they are the sums."""

    moments: Expr
    resultant: Expr
    steps: tuple[Step, ...]
    parts: tuple[Wrench, ...] = ()


def acts(problem: Problem) -> bool:
    """Does anything act that is outside dϖ, an input or damping?"""
    return bool(problem.driven or problem.damping)


def prose(problem: Problem) -> Prose:
    """The sentences that say what acts from outside dϖ."""
    acting = [INPUTS] * problem.driven + [DRAG] * bool(problem.damping)
    outside = say("input.outside", forces=listed(AND, acting))
    return outside + say("input.moments") + where_given(problem)


def where_given(problem: Problem) -> Prose:
    """The sentence that says where each force acts, and in which frame it is given."""
    forces = [
        phrase(f"input.{x.frame}_torque", name=f"‘{x.name}’")
        if isinstance(x, TorqueInput)
        else phrase(f"input.{x.frame}_{_sort(x)}", name=f"‘{x.name}’", point=f"r_{x.on}")
        for x in problem.force_inputs
    ]
    given = say("input.given", forces=listed("{first}; {second}", forces)) if forces else ()
    scalars = [f"‘{x.name}’" for x in problem.inputs if isinstance(x, ScalarInput)]
    given += say("input.scalars", names=", ".join(scalars)) if scalars else ()
    own = [x for x in problem.stated_forces if isinstance(x, StatedForce)]
    stated = [phrase(f"input.{x.frame}_{_sort_stated(x)}", **_called(x)) for x in own]
    if stated:
        given += say("input.stated", forces=listed("{first}; {second}", stated))
    if problem.stated_covectors:
        called = [f"‘{x.name}’" for x in problem.forces if x.name and x not in own]
        names = {"name": ", ".join(called)} if called else {}
        given += say("input.named_covector" if called else "input.covector", **names)
    given += say("input.flow") if problem.flows else ()
    several = problem.group and len(problem.group.factors) > 1
    given += say("input.flow_blocks") if problem.flows and several else ()
    stored = [phrase("input.stored_mass", mass=x, rate=rate_of_mass(x)) for x in problem.stored]
    if stored:
        given += say("input.stored", masses=listed("{first}; {second}", stored))
    return given


def _sort(x: ForceInput) -> str:
    """Which sentence says a force: with all its components, or along a direction."""
    if x.direction is None:
        return "force"
    return "force_along" if x.moment is None else "force_with_moment"


def _sort_stated(x: StatedForce) -> str:
    """The same of what acts as a function of the state: a moment has no place."""
    if not x.force:
        return "torque" if x.name else "moment"
    return "named" if x.name else "stated"


def _called(x: StatedForce) -> dict[str, str]:
    """Its name, and its place, where it has these."""
    names = {"name": f"‘{x.name}’"} if x.name else {}
    return names | ({"point": f"r_{x.on}"} if x.force else {})


def by_name(problem: Problem, steps: Iterable[Step], *, discrete: bool = False) -> tuple[Step, ...]:
    """The steps with the numbers of the inputs by the names of the problem: ``thrust_3`` for an
    entry of the member of f_u that the force ``thrust`` is, or of the covector u, f_u; the whole
    force is the column of its numbers.  ``discrete``: as in numbers."""
    given = numbers(problem, discrete=discrete)
    for e, x in enumerate(problem.force_inputs, 1):
        given["at", "f_u", e] = column(tuple(("par", name) for name in problem.numbers_of(x)))

    def named(t: Tree) -> Tree:
        if t in given or not isinstance(t, tuple):
            return given.get(t, t)
        return (t[0], *map(named, t[1:]))

    def told(step: Step) -> Step:
        sides = (replace(e, lhs=named(e.lhs), rhs=named(e.rhs)) for e in step.equations)
        return replace(step, equations=tuple(sides))

    return tuple(map(told, steps) if given else steps)


def numbers(problem: Problem, *, discrete: bool = False) -> dict[Tree, Tree]:
    """Entries of f_u and u → the numbers that are given, of a covector in the basis that the
    problem states; in the ``discrete`` motion u is the whole covector of a displacement."""
    found: dict[Tree, Tree] = {}
    group = problem.own_group
    for e, x in enumerate(problem.force_inputs, 1):
        for k, name in enumerate(problem.numbers_of(x), 1):
            found["entry", ("at", "f_u", e), k] = ("par", name)
    if covector := problem.covector:
        own = [("par", suffixed(covector.name, a)) for a in range(1, group.dimension + 1)]
        apart = group.turns_space and group.affine and not discrete
        turns = group.dimension - (group.n if apart else 0)
        for a, element in enumerate(group.basis, 1):
            parts = zip(group.in_user_basis.nearest(element), own, strict=True)
            letter, k = ("u", a) if a <= turns else ("f_u", a - turns)
            found["entry", letter, k] = add(*(mul(plain(x), u) for x, u in parts if x))
    return found


def pushes(problem: Problem) -> list[tuple[int, Push]]:
    """The forces and torques that act beside a covector, those that are given with their number."""
    given: list[Push] = [*problem.force_inputs]
    return [*enumerate(given, 1), *((0, x) for x in problem.placed_forces)]


def named_forces(problem: Problem) -> list[Equation]:
    """What the numbers are of the forces of the state that have a name."""
    return [Equation(("par", name), t) for name, t in problem.named_numbers.items()]


def _velocities(
    draft: Draft, problem: Problem, b: Alphabet, images: Mapping[Letter, Expr]
) -> list[Equation]:
    """The equations of v_i, the velocity in space of each place where a force depends on it;
    ``images``: what stands for the velocities of 𝔤."""
    named = {x for f in problem.forces for t in f.trees() for x in nodes(t)}
    listed_places = sorted({f.on for f in problem.placed_forces})
    places = [i for i in listed_places if ("at", "v", i) in named]
    if not places:
        return []
    g = word(b.A.position)
    v = (g * word(b.Z.velocity) * word(b.r_i)).marked(Chapter(b.chapter).label("velocity"))
    if b.affine:
        v = v + g * word(b.w.velocity)
    general = draft.tree(substitute(v, images))
    return [Equation(("at", "v", i), replaced(general, b.r_i.name, ("at", "r", i))) for i in places]


def entries_of(problem: Problem, e: int, x: Push) -> tuple[Tree, ...]:
    """The entries of the force ``e``, or of the torque, in its own frame: the numbers of the member
    of f_u, the one number times a direction, or what is stated."""
    if isinstance(x, StatedForce):
        return x.force
    numbers = tuple(("entry", ("at", "f_u", e), k) for k, _ in enumerate(problem.numbers_of(x), 1))
    return numbers if x.direction is None else tuple(mul(y, *numbers) for y in x.direction)


def couple_of(problem: Problem, e: int, x: Push) -> tuple[Tree, ...]:
    """The entries of a torque, or of the moment that goes with a force, in the same frame; none
    where there is none."""
    if isinstance(x, TorqueInput):
        return entries_of(problem, e, x)
    if isinstance(x, StatedForce):
        return x.moment
    return tuple(mul(y, ("entry", ("at", "f_u", e), 1)) for y in x.moment or ())


def _skew(problem: Problem, x: Push, couple: tuple[Tree, ...]) -> Tree:
    """The matrix N of a torque in the body, whose work is Tr ξ′N̄: half of j(torque), that of a
    torque in space turned into the body."""
    group = problem.own_group
    block, factor = problem.acted_on(x)
    half = [mul(Fraction(1, 2), y) for y in couple]
    if factor.n == 2:
        return _in_block(group, block, [(0, neg(half[0])), (half[0], 0)])
    a, b, c = half
    skew = _in_block(group, block, [(0, neg(c), b), (c, 0, neg(a)), (neg(b), a, 0)])
    if x.frame == "body":
        return skew
    turned = mul(("T", "A"), skew, "A")
    if not (group.factors and factor.affine):
        return turned
    rotation = _in_block(group, block, [(1, 0, 0), (0, 1, 0), (0, 0, 1)])  # not what translates
    return mul(rotation, turned, rotation)


def _in_block(group: Group, block: int, rows: Sequence[tuple[Tree, ...]]) -> Tree:
    """A matrix of the space of a block as one of the group."""
    inside = [group.in_block(block, row) for row in rows]
    offset, _ = group.places[block - 1]
    after = group.n - offset - len(rows)
    empty = (0,) * group.n
    whole = (*[empty] * offset, *inside, *[empty] * after)
    return ("matrix", *(("row", *row) for row in whole))


def external_matrices(problem: Problem, b: Alphabet, C: Expr, c: Chapter) -> External | None:
    """N_u and F_u of what acts from outside dϖ, with their step; ``None`` where nothing does.

    ``C``: ĀA, as a step says it.
    """
    if not acts(problem):
        return None
    group = problem.own_group
    forces, draft = applied(b, "u", vectors=False), c.draft("input", "input")
    definitions, drag = _damping(problem, b)
    drag = reduce(drag, body_rule(b, C))
    xi, eta = Letter("ξ′", b.n, b.n), Letter("η′", b.n)
    drags = (draft.tree(gradient(drag, x)) for x in (xi, eta))
    parts = [Wrench(UNNAMED_DAMPING, *drags)]
    definitions += [*_velocities(draft, problem, b, {}), *named_forces(problem)]
    for e, given in pushes(problem):
        moments: list[Tree] = []
        force: Tree = 0
        if not isinstance(given, TorqueInput) and entries_of(problem, e, given):
            force = _in_body(draft, problem, e, given, C, b)
            moments.append(mul(force, ("T", ("at", "r", given.on))))
        if couple := couple_of(problem, e, given):
            moments.append(_skew(problem, given, couple))
        parts.append(Wrench(given.name or UNNAMED_FORCE, add(*moments), force))
    for name, x in covectors(problem, group):
        parts.append(Wrench(name, *_matrix_of_covector(group, b, x)))
    return _external(problem, b, forces, draft, definitions, parts)


def _external(
    problem: Problem,
    b: Alphabet,
    forces: Applied,
    draft: Draft,
    definitions: Sequence[Equation],
    parts: Sequence[Wrench],
) -> External:
    """The sums of the parts, with their step."""
    moments, pulls = ([x.moment for x in parts], [x.pull for x in parts])
    equations = [*definitions, Equation(forces.moments.name, add(*moments))]
    steady = [k for k, x in enumerate(problem.flows, 1) if x.steady]
    supposed = draft.claim("input.flow_steady", flows=("row", *steady)) if steady else ()
    if b.affine:
        whole = add(*pulls) or column((0,) * problem.own_group.n)  # moments alone
        equations.append(Equation(forces.resultant.name, whole))
    step, own = (
        draft.step(equations, prose(problem) + supposed),
        tuple(x for x in parts if any(x[1:])),
    )
    return External(
        draft.mark(word(forces.moments)), draft.mark(word(forces.resultant)), (step,), own
    )


def _in_body(
    d: Draft, problem: Problem, e: int, given: ForceInput | StatedForce, C: Expr, b: Alphabet
) -> Tree:
    """Force ``e`` in the body, a tree: Āf for a force in space, ĀA f for one that turns with the
    body."""
    f: Tree = ("at", "f_u", e)
    group = problem.own_group
    if group.factors or isinstance(given, StatedForce) or given.direction is not None:
        f = embedded(problem, given.on, entries_of(problem, e, given), 0)
    if given.frame == "space":
        return mul(("T", "A"), f)
    d.depends_on(C)
    return f if b.unit == C else mul("C", f)


def covectors(problem: Problem, group: Group) -> list[tuple[str, tuple[Tree, ...]]]:
    """The covectors by their names, each by its values on the basis of the record: the input by the
    entries of u, those of the state by expressions."""
    span = range(1, group.dimension + 1)
    given = [problem.covector] if problem.covector else []
    stated = problem.stated_covectors
    columns = [group.in_user_basis.nearest(e) for e in group.basis] if stated else []
    return [
        *((x.name, tuple(("entry", "u", a) for a in span)) for x in given),
        *((x.name or UNNAMED_FORCE, tuple(along(x.covector, c) for c in columns)) for x in stated),
    ]


def _matrix_of_covector(group: Group, b: Alphabet, covector: Sequence[Tree]) -> tuple[Tree, Tree]:
    """A matrix (and for an affine group a column) whose pairing with ξ′ (and η′) is that with a
    covector, by the rows that read coordinates."""
    size = group.size
    entries: list[list[list[Tree]]] = [[[] for _ in range(size)] for _ in range(size)]
    for a in range(group.dimension):
        for x, i, j in group.coordinate_terms(a):
            entries[i][j].append(mul(x, covector[a]))
    n = b.n
    assert isinstance(n, int)
    rows = tuple(("row", *(add(*entries[i][j]) for j in range(n))) for i in range(n))
    last = tuple(("row", add(*entries[i][n])) for i in range(n)) if b.affine else ()
    return ("matrix", *rows), ("matrix", *last) if last else 0


def _damping(problem: Problem, b: Alphabet) -> tuple[list[Equation], Expr]:
    """The equations of κ_i and their sums over the points; and the work −Σ κ_i ⟨v_i, v′_i⟩ on
    words, in a displacement ξ′, η′."""
    kappa, g = Letter("κ_i"), word(b.A.position)
    D, first, total = Letter("D", b.n, b.n, 1), Letter("D_c", b.n), Letter("D_m")
    xi, eta = word(Letter("ξ′", b.n, b.n)), word(Letter("η′", b.n))
    v = (g * word(b.Z.velocity) * word(b.r_i)).marked(Chapter(b.chapter).label("velocity"))
    moved = g * xi * word(b.r_i)
    if b.affine:
        v, moved = v + g * word(b.w.velocity), moved + g * eta
    if not problem.damping:
        return [], number(0)
    table = {
        (kappa, b.r_i, b.r_i): word(D),
        (kappa, b.r_i): word(first),
        (kappa,): word(total),
    }
    work = sum_over(-word(kappa) * inner(v, moved), {kappa, b.r_i}, table)
    equations = damping_coefficients(problem) + stated("D = Σᵢ κᵢ rᵢ r̄ᵢ")
    if b.affine:
        equations += stated("D_c = Σᵢ κᵢ rᵢ,  D_m = Σᵢ κᵢ")
    return equations, work


def damping_coefficients(problem: Problem) -> list[Equation]:
    """The equations of κ_i of the points that are damped."""
    terms: dict[int, list[Tree]] = {}
    for kappa, i in problem.damped_points:
        terms.setdefault(i, []).append(kappa)
    return [Equation(("at", "κ", i), add(*x)) for i, x in sorted(terms.items())]


def external_vectors(
    problem: Problem, b: Alphabet, C: Expr, hat_map: HatMap, c: Chapter
) -> External | None:
    """μ_u and F_u in R³, with their step; a covector alone keeps its own name. ``None`` where
    nothing acts from outside dϖ."""
    if not acts(problem):
        return None
    if not (problem.force_inputs or problem.forces or problem.damping):  # u alone
        return External(word(TORQUE), word(FORCE), ())
    forces, draft = applied(b, "u", vectors=True), c.draft("input", "input")
    definitions, drag = _damping(problem, b)
    turned, pulled = _in_vectors(drag, b, C, hat_map)
    draft.depends_on(turned, pulled)
    parts = [Wrench(UNNAMED_DAMPING, vector_sum(turned), vector_sum(pulled))]
    if problem.damping:
        definitions.append(Equation("I_D", tree_of(inertia_of(Letter("D", 3, 3, 1)))))
    definitions += _velocities(draft, problem, b, {b.Z.velocity: hat_map.hatted(ZETA)})
    definitions += named_forces(problem)
    for e, given in pushes(problem):
        moments: list[Tree] = []
        force: Tree = 0
        if not isinstance(given, TorqueInput) and entries_of(problem, e, given):
            force = _in_body(draft, problem, e, given, C, b)
            moments.append(("wedge", ("at", "r", given.on), force))
        if couple := couple_of(problem, e, given):
            torque = column(couple)
            moments.append(mul(("T", "A"), torque) if given.frame == "space" else torque)
        parts.append(Wrench(given.name or UNNAMED_FORCE, add(*moments), force))
    for k, (name, x) in enumerate(covectors(problem, problem.own_group)):
        whole: tuple[Tree, Tree] = (column(x[:3]), column(x[3:]))
        if problem.covector and k == 0:
            whole = (TORQUE.name, FORCE.name)
        parts.append(Wrench(name, *(whole if b.affine else (whole[0], 0))))
    return _external(problem, b, forces, draft, definitions, parts)


def _in_vectors(drag: Expr, b: Alphabet, C: Expr, hat_map: HatMap) -> tuple[Expr, Expr]:
    """The moment and the resultant of the damping, vectors: the coefficients of Ω′ and η′ in its
    work."""
    images = {b.Z.velocity: hat_map.hatted(ZETA), Letter("ξ′", 3, 3): hat_map.hatted(OMEGA_P)}
    work = substitute(reduce(drag, body_rule(b, C)), images)
    work = normal_form(fold_inertia(work, Letter("D", 3, 3, 1), word(Letter("I_D", 3, 3, 1))))
    turned = normal_form(gradient(reduce(work, anticommute(OMEGA_P)), OMEGA_P))
    eta = Letter("η′", 3)
    return turned, normal_form(gradient(reduce(work, anticommute(eta)), eta))
