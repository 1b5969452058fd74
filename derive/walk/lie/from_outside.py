"""What acts from outside dϖ on a body whose Lagrangian no points give, and its power.

The work of forces and torques at places on the displacements along the basis of the Lie algebra,
and what is read off a motion; the rate of the energy.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import count

from ...algebra.calculus import substitute
from ...algebra.groups import Group
from ...algebra.word_trees import tree_of
from ...algebra.words import Expr, inner, number, trace, word
from ...language.derivatives import rate
from ...language.expression import hypot
from ...language.rational import Matrix, transposed
from ...language.reserved import UNNAMED_FORCE, rate_of_mass
from ...language.tree import Tree, add, mul, names, neg, nodes, plain, replaced
from ...problem.entries_on_orbit import element, rational
from ...problem.fields import coordinates, velocity_at_place
from ...problem.lagrangian_tables import quotient_of
from ...problem.problem import Problem, ProblemError
from ...record.record import Equation, Step
from ...schema import motion_kinds
from ...schema.force_kinds import TorqueInput
from ..chapter import Chapter, Steps, say
from ..given.body_and_potentials import Potentials
from ..given.inputs import External, Push, couple_of, covectors, entries_of, pushes
from ..given.outputs import equation_of, prose_of, read_off
from ..matrices.isomorphism import ZETA, vector_sum
from ..spine.alphabet import Alphabet
from ..spine.cartan import Cartan
from .any_lagrangian import AnyLagrangian

Trees = list[Tree]


def from_outside(problem: Problem, group: Group) -> list[tuple[Tree, ...]]:
    """What acts along each element of the basis from outside dϖ, term by term: covectors, and the
    work of forces and torques at places."""
    works = [x for _, x in works_by_name(problem, group)]
    span = range(group.dimension)
    return [tuple(work[a] for work in works if work[a] != 0) for a in span]


def works_by_name(problem: Problem, group: Group) -> list[tuple[str, Sequence[Tree]]]:
    """The same apart, by the names of what acts."""
    found: list[tuple[str, Sequence[Tree]]] = [*covectors(problem, group)]
    acting = pushes(problem)
    places = Places(problem, group) if acting else None
    return found + [(x.name or UNNAMED_FORCE, places.works(e, x)) for e, x in acting if places]


def named_forces(problem: Problem, group: Group) -> list[Equation]:
    """What the numbers are of the forces of the state that have a name, by the state."""
    named = problem.named_numbers
    known = Places(problem, group).known if problem.places else {}
    return [Equation(("par", name), _with(t, known)) for name, t in named.items()]


def with_numbers(problem: Problem, t: Tree) -> Tree:
    """A tree with what the numbers of named forces are in the place of their names."""
    known = Places(problem, problem.group).known if problem.group and problem.places else {}
    return _with(t, {("par", x): _with(y, known) for x, y in problem.named_numbers.items()})


def outputs(
    problem: Problem, group: Group, balance: Sequence[Step], power: Sequence[Step], c: Chapter
) -> tuple[Step, ...]:
    """The step of what is read off a motion, none where nothing is; ``balance``: the steps up to
    the equations of motion; ``power``: the one that says what acts by it."""
    if not problem.outputs:
        return ()
    places, draft = Places(problem, group), c.draft("outputs", "output")
    quotient = quotient_of(problem)
    given = []
    for x in problem.outputs:
        if isinstance(x, motion_kinds.PowerOutput):
            draft.depends_on(*power)
        found = (
            [read_off(power, x.of)] if isinstance(x, motion_kinds.PowerOutput) else places.read(x)
        )
        if quotient and not all(quotient.keeps(with_numbers(problem, y)) for y in found):
            raise ProblemError(
                f"output {x.name!r}: it depends on the velocity along, or the place on, symmetries "
                "of L without kinetic energy, which the motion leaves open; read what they keep, "
                "in space, or add their kinetic energy"
            )
        given.append(equation_of(problem, x, found))
    named = {t for e in given for t in nodes(e.rhs)}
    if not named.isdisjoint(places.rates):
        draft.depends_on(next(x for x in balance if x.label == c.label("motion")))
    return (draft.step(given, prose_of(problem)),)


class Places:
    """The places at which forces act, and what is read, moved by A, a matrix that acts on (r, 1):
    with an element of the basis a force f at r has the work ⟨f, A E_a r⟩, on the right
    ⟨f, E_a A r⟩."""

    def __init__(self, problem: Problem, group: Group) -> None:
        self.problem, self.group = problem, group
        self.left = problem.own_lagrangian.trivialisation == "left"
        self.A: list[Trees] = [[*row] for row in element(group)]
        self.body: list[Trees] = [[*group.in_block(x.block, x.at, 1)] for x in problem.places]
        self.zeta = coordinates(group)
        self.rates: Trees = [("entry", "ζ̇", a + 1) for a in range(group.dimension)]
        self.known = dict(self._moving())

    def works(self, e: int, x: Push) -> Trees:
        """The work of a force, with its moment, or of a torque along each element."""
        block, factor = self.problem.acted_on(x)
        force = () if isinstance(x, TorqueInput) else entries_of(self.problem, e, x)
        work: Trees = [0] * len(self.group.basis)
        if force and not isinstance(x, TorqueInput):
            pulled = self._seen(self.group.in_block(block, force), x.frame, factor)
            moved = self._displacements(self.body[x.on - 1])
            work = [_dot(y, pulled) for y in moved]
        if couple := couple_of(self.problem, e, x):
            turned = self._seen_in_block(couple, x.frame, block)
            turns = [_axial(_block(y, self.group.of_block(block))) for y in self.group.basis]
            work = [add(y, _dot(z, turned)) for y, z in zip(work, turns, strict=True)]
        return [_with(y, self.known) for y in work]

    def _displacements(self, r: Trees) -> list[Trees]:
        """E_a r in the body, on the right E_a A r in space."""
        place = r if self.left else _times(self.A, r)
        return [_times(rational(e), place) for e in self.group.basis]

    def _seen(self, f: Sequence[Tree], frame: str, factor: Group) -> Trees:
        """A force by what its work is a product with: Āf in the body, on the right f in space."""
        if self.left and frame == "body" and "orthogonal" in factor.relations:
            return [*f]
        in_space = _times(self.A, f) if frame == "body" else [*f]
        return _times(transposed(self.A), in_space) if self.left else in_space

    def _seen_in_block(self, torque: Sequence[Tree], frame: str, block: int) -> Trees:
        """A torque by its components in the body, on the right in space; in the plane they are
        one."""
        if len(torque) == 1 or frame == ("body" if self.left else "space"):
            return [*torque]
        R = self._rotation(block)
        return _times(transposed(R) if self.left else R, torque)

    def _rotation(self, block: int) -> list[Trees]:
        """The entries of A that turn a block."""
        at = self.group.of_block(block)
        return [row[at] for row in self.A[at]]

    def _along(self, speeds: Sequence[Tree], r: Trees) -> Trees:
        """The velocity of a place with these coordinates of Z: Zr in the body, ZAr in space."""
        return [_dot(row, speeds) for row in transposed(self._displacements(r))]

    def _moving(self) -> Iterable[tuple[Tree, Tree]]:
        """The coordinates of the places in space, and of their velocities, by A and ζ."""
        for i, r in enumerate(self.body, 1):
            place = _times(self.A, r)
            rates = self._along(self.zeta, r)
            v = _times(self.A, rates) if self.left else rates
            for k in range(1, self.group.n + 1):
                yield ("entry", ("call", ("at", "r", i), "t"), k), place[k - 1]
                yield ("entry", ("at", "v", i), k), v[k - 1]
            first, factor = self.group.places[self.problem.places[i - 1].block - 1]
            if self.left and "orthogonal" in factor.relations:  # Āv is Zr without A
                still = (0,) * factor.n
                turned = velocity_at_place(factor.n, first, i, still, turned=True).values()
                yield from zip(turned, rates[first : first + factor.n], strict=True)

    # -- what is read off --------------------------------------------------------------------------

    def read(self, x: motion_kinds.Output) -> Trees:
        """The numbers of an output."""
        match x:
            case motion_kinds.ExpressionOutput():
                return [_with(y, self.known) for y in x.y]
            case motion_kinds.RateOutput():
                turns = [_axial(_block(e, self.group.of_block(x.block))) for e in self.group.basis]
                whole = [_dot(row, self.zeta) for row in transposed(turns)]
                return whole if self.left else self._turned_back(whole, x.block)
            case motion_kinds.DirectionOutput():
                d = self.group.in_block(x.block, x.direction)
                turned = _times(self.A if x.frame == "space" else transposed(self.A), d)
                return turned[self.group.of_block(x.block)]
            case motion_kinds.DistanceOutput(anchor=anchor) if anchor is not None:
                at = self.group.of_block(self.problem.block(x.on))
                place = _times(self.A, self.body[x.on - 1])[at]
                return [hypot(*(add(y, neg(z)) for y, z in zip(place, anchor, strict=True)))]
            case motion_kinds.SpecificForceOutput(g=g) if g is not None:
                there = motion_kinds.AccelerationOutput(name=x.name, on=x.on, frame="body")
                block = self.problem.block(x.on)
                falling = [*g] if not any(g) else self._turned_back(g, block)
                pairs = zip(self._of_place(there), falling, strict=True)
                return [add(y, neg(z)) for y, z in pairs]
            case motion_kinds.PlaceOutput():  # velocities and accelerations are such, too
                return self._of_place(x)
        raise ProblemError(f"output {x.name!r}: beside a Lagrangian no points have it")

    def _of_place(self, x: motion_kinds.PlaceOutput) -> Trees:
        """The place, the velocity or the acceleration of one, in a frame: Ä is A(Ż + Z²), on the
        right (Ż + Z²)A."""
        r, block = self.body[x.on - 1], self.problem.block(x.on)
        moving = isinstance(x, motion_kinds.VelocityOutput | motion_kinds.AccelerationOutput)
        vector = self._along(self.zeta, r) if moving else _times(self.A, r)
        if isinstance(x, motion_kinds.AccelerationOutput):
            again = _times(combined(self.group.basis, self.zeta, self.group.n), vector)
            rated = zip(self._along(self.rates, r), again, strict=True)
            vector = [add(*y) for y in rated]
        at = self.group.of_block(block)
        in_space = _times(self.A, vector) if moving and self.left else vector
        if x.frame == "space":
            return in_space[at]
        _, factor = self.group.places[block - 1]
        if moving and self.left and "orthogonal" in factor.relations:
            return vector[at]
        return self._turned_back(in_space[at], block)

    def _turned_back(self, vector: Sequence[Tree], block: int) -> Trees:
        """Ā on a vector of a block; a rate in the plane is the same in both frames."""
        R = self._rotation(block)
        return [*vector] if len(vector) < len(R) else _times(transposed(R), vector)


def _block(e: Matrix, at: slice) -> Matrix:
    return tuple(row[at] for row in e[at])


def _axial(W: Matrix) -> Trees:
    """The angular velocity of a skew matrix of R³, or of the plane."""
    planes = [(1, 0)] if len(W) == 2 else [(2, 1), (0, 2), (1, 0)]
    return [plain(W[i][j]) for i, j in planes]


def _dot(a: Iterable[Tree], b: Iterable[Tree]) -> Tree:
    pairs = zip(a, b, strict=True)
    return add(*(mul(x, y) for x, y in pairs if 0 not in (x, y)))


def _times(a: Sequence[Sequence[Tree]], b: Sequence[Tree]) -> Trees:
    return [_dot(row, b) for row in a]


def combined(basis: Sequence[Matrix], zeta: Sequence[Tree], n: int) -> list[Trees]:
    """Σ ζ_a E_a, the first n rows and columns."""
    span = range(n)
    return [[_dot([plain(e[i][j]) for e in basis], zeta) for j in span] for i in span]


def _with(t: Tree, known: Mapping[Tree, Tree]) -> Tree:
    """A tree with the values of entries in their places."""
    if t in known or not isinstance(t, tuple):
        return known.get(t, t)
    return (t[0], *(_with(x, known) for x in t[1:]))


# With the work u(ξ) of the forces beside it, dϖ(X, δy) = u(ξ − Z δt) for every δ. Along the motion
# the coefficient of δt says ḣ + ∂ₜL̃ = u(Z): the work in a displacement, with Z in its place.


def of_points(
    problem: Problem,
    external: External | None,
    b: Alphabet,
    C: Expr,
    trivial: Cartan,
    body: Steps,
    moments: Steps,
    found: Potentials,
    kept: Steps | None,
    motion: Step,
    c: Chapter,
) -> tuple[Step, ...]:
    """ḣ = ⟨μ_u, ζ⟩ + ⟨F_u, w⟩ + ∂ₜŨ, on matrices Tr(Z N̄_u) for the first; no step where nothing
    acts and Ũ leaves the time alone; ``kept``: what is without forces.  Where mass flows the
    energy changes with the moments, too: ``trivial`` has h̃, ``body`` and ``moments`` say m, c, J, C
    what ĀA is."""
    draft = c.draft("power", "power", motion, *(kept or found.steps))
    terms: list[Tree] = []
    apart: dict[str, Tree] = {}
    if external:
        turning = _power_of_moments(external, b)
        pulling = inner(external.resultant, word(b.w.velocity)) if b.affine else number(0)
        draft.depends_on(whole := turning + pulling)
        terms.append(vector_sum(whole))
        apart = _apart(problem, external, vector_sum(turning), vector_sum(pulling))
    sums = [s for s in moments if any(e.lhs == b.J.name for e in s.equations)]
    stored: dict[Tree, Tree] = {("par", x): ("par", rate_of_mass(x)) for x in problem.stored}
    known = _rates([*body, *sums], stored) if problem.flows else {}
    in_time = _rates([found.steps[0]], known).get(b.U.name, 0)  # ∂ₜŨ
    timed: list[Tree] = [b.dU_dt.name] if problem.timed or in_time != 0 else []
    own = [Equation(b.dU_dt.name, in_time)] if timed else []
    if problem.flows:
        kinetic = substitute(trivial.energy + word(b.U), {b.U: number(0), b.C: C})
        draft.depends_on(kinetic, *body, *sums)
        timed.append(rate(tree_of(kinetic), known))
    if not terms and not timed:
        return ()
    prose = say("power.acting" if external else "power.none")
    prose += say("power.apart") if apart else ()
    prose += say("power.timed", rate=b.dU_dt.name) if own else ()
    prose += say("power.flow") if problem.flows else ()
    prose += say("power.stored") if problem.stored else ()
    return (draft.step([*own, *_balance(terms, timed, apart)], prose),)


def _power_of_moments(external: External, b: Alphabet) -> Expr:
    """⟨μ_u, ζ⟩ of vectors of R³; Tr(Z N̄_u) of matrices, as the work of N_u is Tr(ξ′N̄_u)."""
    moments = external.moments
    if (moments.rows, moments.cols) == (3, 1):
        return inner(moments, word(ZETA))
    return trace(word(b.Z.velocity) * moments.bar)


def _rates(steps: Sequence[Step], known: Mapping[Tree, Tree] | None = None) -> dict[Tree, Tree]:
    """The rates of what equations say by the time, and by what is known."""
    found: dict[Tree, Tree] = {"t": 1, **(known or {})}
    for e in (e for s in steps for e in s.equations):
        found |= {e.lhs: x} if e.lhs != "U" and (x := rate(e.rhs, found)) != 0 else {}
    return found


def _apart(problem: Problem, external: External, turning: Tree, pulling: Tree) -> dict[str, Tree]:
    """The power of what acts by each name, the whole with its part in the place of each sum."""
    sums = tree_of(external.moments), tree_of(external.resultant)
    found: dict[str, list[Tree]] = {}
    for x in external.parts:
        both = zip((turning, pulling), sums, (x.moment, x.pull), strict=True)
        powers = (replaced(t, whole, part) for t, whole, part in both if part != 0)
        found.setdefault(x.name, []).extend(powers)
    return _named(problem, {name: add(*powers) for name, powers in found.items()})


def _named(problem: Problem, powers: Mapping[str, Tree]) -> dict[str, Tree]:
    """Powers by their names, P_drag of ``drag``, with more underscores where a number of the
    problem has this name; none where one thing acts alone, and all of ḣ is its power."""
    taken = {*problem.parameters, *problem.named_numbers}
    taken |= {name for x in problem.inputs for name in problem.numbers_of(x)}
    taken |= {name for x in problem.outputs for name in problem.numbers_of_output(x)}
    found: dict[str, Tree] = {}
    for name, power in powers.items() if len(powers) > 1 or problem.flows else ():
        free = (f"P{'_' * k}{name}" for k in count(1))
        found[next(x for x in free if x not in taken)] = power
    return found


def _balance(whole: list[Tree], timed: list[Tree], apart: Mapping[str, Tree]) -> list[Equation]:
    """ḣ as a whole, the powers apart and ḣ as their sum."""
    named: list[Tree] = [("par", name) for name in apart]
    return [
        Equation("ḣ", add(*whole, *timed)),
        *(Equation(name, x) for name, x in zip(named, apart.values(), strict=True)),
        *([Equation("ḣ", add(*named, *timed))] if named else []),
    ]


def of_lagrangian(
    problem: Problem, group: Group, general: AnyLagrangian, balance: Steps, c: Chapter
) -> tuple[Step, ...]:
    """ḣ = Σ u_a ζ_a − ∂ₜL̃; no step where nothing acts and L̃ leaves the time alone."""
    zeta = coordinates(group)
    power = _dot([add(*terms) for terms in from_outside(problem, group)], zeta)
    timed = [neg("∂ₜL̃")] if "t" in names(problem.own_lagrangian.L) else []
    if power == 0 and not timed:
        return ()
    draft = c.draft("power", "power")
    motion = next(x for x in balance if x.label == c.label("motion"))
    draft.depends_on(general["moment_map"], motion)
    found: dict[str, list[Tree]] = {}
    for name, work in works_by_name(problem, group):
        found.setdefault(name, []).append(_dot(work, zeta))
    apart = _named(problem, {name: add(*powers) for name, powers in found.items()})
    prose = say("power.none" if power == 0 else "power.acting")
    prose += say("power.apart") if apart else ()
    prose += say("power.timed", rate="∂ₜL̃") if timed else ()
    return (draft.step(_balance([power], timed, apart), prose),)
