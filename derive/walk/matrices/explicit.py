"""The answer: the equations of motion in coordinates, a problem's own numbers put in."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import product

from ...algebra.calculus import gradient
from ...algebra.groups import Group
from ...algebra.relations import skew
from ...language import rational as q
from ...language.laurent import Laurent
from ...language.read import read
from ...language.tree import Tree, mul
from ...language.values import OPERATIONS, Value, hat
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import Prose
from ...schema.body_kinds import MomentBody
from ..chapter import Chapter, Draft, say
from ..given.body_and_potentials import Potentials
from ..given.inputs import External
from .coordinates import LinearSystem, by_relations, element, short_rates, solved
from .rotation import AXES, Torque, diagonal, is_diagonal, principal, square, symbols
from .separation import constant, linear
from .specialisation import KernelOnGroup
from .substitution import ENDS, UNKNOWN, Substitution

LARGEST = 6
"""The dimension of the largest group, or factor of a product, whose answer is stated."""
RULE = "evaluation"
MOMENTS = ("N_P", "N_Q")
"""Of forces on points; where these are long the answer is by their entries."""
RATE_OF = {"A": "Ȧ", "T": "Ṫ", "Γ": "Γ̇"}
Steps = tuple[Step, ...]


@dataclass(frozen=True)
class Particulars:
    """What a problem puts into its equations of motion: the steps of its body and of the moments of
    points, its potentials, and what acts from outside dϖ."""

    problem: Problem
    group: Group
    body: Steps
    points: Steps
    potentials: Potentials
    external: External | None

    @property
    def wanted(self) -> bool:
        """Is something gained? Not where the moments are all letters."""
        letters = isinstance(self.problem.body, MomentBody)
        small = all(x.dimension <= LARGEST for _, x in self.group.places)
        return bool(self.body) and small and not letters

    def learnt_by(self, values: Substitution, motion: Step, *inertia: Step) -> None:
        """Let values know the moments of the body, then what potentials and inputs are made of."""
        for k, given in enumerate(self.problem.force_inputs, 1):
            size = len(self.problem.numbers_of(given))
            values.member("f_u", k, symbols(("at", "f_u", k), size))
        values.learn(e for s in self.body for e in s.equations)
        points = (*self.points, *inertia)
        values.learn(e for s in points for e in s.equations if e.lhs not in values.names)
        A = values.names["A"]
        values.names["C"] = _metric(self.group, A)
        outside = self.external.steps if self.external else ()
        values.learn(e for s in (*self.potentials.steps, *outside) for e in s.equations)
        values.learn(e for e in motion.equations if e.lhs in RATE_OF.values())


def of_matrices(
    particulars: Particulars,
    special: KernelOnGroup,
    driven: KernelOnGroup,
    motion: Step,
    c: Chapter,
) -> Steps:
    """From the kernel, the work of the forces on the right."""
    if not particulars.wanted:
        return ()
    group = particulars.group
    b, draft = driven.letters, c.draft("explicit", RULE, particulars.body[-1], motion)
    primed = [f.xi_prime for f in b.algebra_parts]
    left = [draft.tree(gradient(driven.inertial, x)) for x in primed]
    right = [draft.tree(driven.forces[x]) for x in primed]
    pulled = [draft.tree(special.forces[x]) for x in primed]
    span, n = range(1, len(group.linear_basis) + 1), group.n
    rates: list[Tree] = [("entry", "ζ̇", a) for a in span]
    known = _place(group) | {
        x: q.combine([Laurent.symbol(("entry", y, a)) for a in span], group.linear_basis)
        for x, y in (("Z", "ζ"), ("Ż", "ζ̇"))
    }
    if group.affine:
        known |= {x: symbols(x, n) for x in ("w", "ẇ")}
        rates += [("entry", "ẇ", i) for i in range(1, n + 1)]
    known["u"] = symbols("u", group.dimension)
    whole, apart = (Substitution(known, n, opaque) for opaque in ("", ENDS))
    for values in (whole, apart):
        particulars.learnt_by(values, motion)
    metric, moments = {"C": square("C", n, symmetric=True)}, _moments_of_forces(whole)
    # by A; by what of A enters; by the differences of places; by what of the forces enters
    for values, letters in ((whole, {}), (whole, metric), (apart, {}), (whole, moments)):
        values.names.update(letters)
        try:
            inertial, load, work = (_along(group, map(values.of, x)) for x in (left, right, pulled))
            rows = [x - y for x, y in zip(inertial, load, strict=True)]
            stage = _linear_in(rows, tuple(rates))
        except UNKNOWN:
            continue
        idle = bool(particulars.problem.potentials) and not any(work)
        if found := _explicit_step(draft, stage, values, idle, group):
            return found
    return ()


def _moments_of_forces(values: Substitution) -> dict[str, Value]:
    """The moments of forces on points by their entries, those that are 0 but for 0."""
    found = {x: y for x, y in values.names.items() if x in MOMENTS and isinstance(y, tuple)}
    return {
        name: tuple(
            tuple(Laurent.symbol(("entry", name, i, j)) if x else x for j, x in enumerate(row, 1))
            for i, row in enumerate(m, 1)
        )
        for name, m in found.items()
    }


def of_vectors(
    particulars: Particulars, torque: Torque, inertia: Step, motion: Step, tensor: Steps, c: Chapter
) -> Steps:
    """From the equations of motion in vectors; none where they stand in components already."""
    if not particulars.wanted:
        return ()
    group, draft = (
        particulars.group,
        c.draft("explicit", RULE, particulars.body[-1], inertia, motion, *tensor[:1]),
    )
    vectors = ("ζ", "ζ̇", "u", *(("w", "ẇ", "f_u") if group.affine else ()))
    known = _place(group) | {x: symbols(x, 3) for x in vectors}
    values = Substitution(known | {"Z": hat(known["ζ"])}, 3)
    particulars.learnt_by(values, motion, inertia)
    sides = {e.lhs: e.rhs for e in motion.equations}
    try:
        name, rest = _inverted(sides["ζ̇"])
        mass = values.of(name)
        lettered = is_diagonal(mass) and any(len(x.terms) > 1 for row in mass for x in row)
        if lettered:
            mass = values.names[name] = diagonal(principal(name, mass))
        load = values.of(rest)
        work = [values.of(e.rhs) for s in torque.steps for e in s.equations]
        stage = LinearSystem(mass, _entries(load), tuple(("entry", "ζ̇", i) for i in AXES))
        drift = values.of(sides["ẇ"]) if group.affine else ()
    except UNKNOWN:
        return ()
    idle = bool(particulars.problem.potentials) and not any(
        x for column in work for x in _entries(column)
    )
    shifts = _entries(drift) if group.affine else ()
    rates: list[tuple[Tree, Laurent]] = [(("entry", "ẇ", i), x) for i, x in enumerate(shifts, 1)]
    found = _explicit_step(draft, stage, values, idle, group, after=rates)
    again = lettered and len(tensor) > 1 and found and len(found[0].prose) == 1
    return () if again else found


def _entries(column: Value) -> tuple[Laurent, ...]:
    """The entries of a vector of R³, or of the number 0 that stands for one."""
    return tuple(x for (x,) in column) if isinstance(column, tuple) else (column,) * 3


def _inverted(t: Tree) -> tuple[str, Tree]:
    """I, or I_c, and the vector X of ζ̇ = I⁻¹ X."""
    assert isinstance(t, tuple)
    _, (_, name), *factors = t
    return name, mul(*factors)


def of_lagrangian(
    problem: Problem, group: Group, balance: Steps, momenta: Step, c: Chapter
) -> Steps:
    """From M and β of a problem with a Lagrangian of its own; ``momenta``: the step of Π_a and
    Φ_a."""
    if group.dimension > LARGEST:
        return ()
    *_, mass, motion = balance
    draft = c.draft("explicit", RULE, momenta, mass, motion)
    known = {x: symbols(x, group.dimension) for x in ("ζ", "ζ̇", "u")}
    known |= {"A": element(group), "Z": q.combine([x for (x,) in known["ζ"]], group.basis)}
    if problem.advected is not None:
        known["Γ"] = symbols("Γ", sum(x.size for x in problem.advected))
    values = Substitution(known, group.size)
    values.learn(motion.equations)
    span = range(1, group.dimension + 1)
    for a in span:
        values.member("Φ", a, Laurent.of(0))
    values.learn(momenta.equations)
    sides = {e.lhs: e.rhs for e in mass.equations}
    try:
        M, load = values.of(sides["M"]), values.of(sides["β"])
    except UNKNOWN:
        return ()
    stage = LinearSystem(M, tuple(x for (x,) in load), tuple(("entry", "ζ̇", a) for a in span))
    side = problem.own_lagrangian.trivialisation
    return _explicit_step(draft, stage, values, False, group, side=side)


def _place(group: Group) -> dict[str, Value]:
    """A, and T of an affine group, by the entries that tell the others."""
    g, n = element(group), group.n
    found: dict[str, Value] = {"A": tuple(row[:n] for row in g[:n])}
    return found | ({"T": tuple((row[n],) for row in g[:n])} if group.affine else {})


def _along(group: Group, covector: Iterable[Value]) -> list[Laurent]:
    """Its values on the basis: of ξ′, then of η′."""
    turned, *pulled = covector
    inner = OPERATIONS["inner"]
    found = [inner(turned, e) if isinstance(turned, tuple) else 0 for e in group.linear_basis]
    for column in pulled:
        found += [x for (x,) in column] if isinstance(column, tuple) else [0] * group.n
    return [*map(Laurent.of, found)]


def _linear_in(rows: Sequence[Laurent], unknowns: tuple[Tree, ...]) -> LinearSystem:
    """What vanishes, sorted: Σ M_ab x_b − β_a; ``ValueError`` where it is not linear in the x_b."""
    place = {x: b for b, x in enumerate(unknowns)}
    mass = [[Laurent.of(0) for _ in unknowns] for _ in rows]
    load = [Laurent.of(0) for _ in rows]
    for a, row in enumerate(rows):
        for m, number in row.terms.items():
            among = [(s, e) for s, e in m if s in place]
            rest = Laurent({tuple(x for x in m if x[0] not in place): number})
            if not among:
                load[a] = load[a] - rest
            elif [e for _, e in among] == [1]:
                b = place[among[0][0]]
                mass[a][b] = mass[a][b] + rest
            else:
                raise ValueError("not linear in the accelerations")
    return LinearSystem(tuple(map(tuple, mass)), tuple(load), unknowns)


def _explicit_step(
    draft: Draft,
    stage: LinearSystem,
    values: Substitution,
    idle: bool,
    group: Group,
    *,
    side: str = "left",
    after: Sequence[tuple[Tree, Laurent]] = (),
) -> Steps:
    """The step, with what can be seen of the equations; ``after``: rates that are solved."""
    relations = _orthogonality(group, values.names["A"])
    stage = replace(stage, load=tuple(by_relations(x, relations) for x in stage.load))
    after = [(x, by_relations(rate, relations)) for x, rate in after]
    found, others = solved(stage), short_rates(after)
    if found is None or others is None:
        return ()
    work = "dŨ(Aξ′, Aη′)" if group.affine else "dŨ(Aξ′)"
    equations = [*([Equation(read(work), 0)] if idle else []), *found, *others]
    alone = all(e.lhs in stage.unknowns for e in found)
    prose = say("explicit.solved" if alone else "explicit.balance")
    prose += say("explicit.idle") if idle else ()
    loads = (*stage.load, *(x for _, x in after))
    seen = _seen(replace(stage, load=loads), values, side)
    return (draft.step(equations, prose + seen),)


def _numbers_of_metric(group: Group) -> dict[tuple[int, int], int]:
    """The entries of C = ĀA that are numbers, where a factor is orthogonal: row and column → it."""
    parts = (range(at, at + x.n) for at, x in group.places if skew(x))
    return {(i, j): int(i == j) for own in parts for i, j in product(own, repeat=2)}


def _metric(group: Group, A: Value) -> Value:
    """C, with the numbers that its entries are."""
    found = [[*row] for row in OPERATIONS["mul"](q.transposed(A), A)]
    for (i, j), number in _numbers_of_metric(group).items():
        found[i][j] = Laurent.of(number)
    return q.matrix(found)


def _orthogonality(group: Group, A: Value) -> list[tuple[Laurent, int]]:
    """The entries of C that are numbers, by those of A."""
    inner, numbers = OPERATIONS["mul"](q.transposed(A), A), _numbers_of_metric(group)
    found = [(Laurent.of(inner[i][j]), x) for (i, j), x in numbers.items() if i <= j]
    return [x for x in found if len(x[0].terms) > 1]


def _seen(stage: LinearSystem, values: Substitution, side: str) -> Prose:
    """Whether the velocity or its rate is constant, or the equations are linear."""
    if not any(stage.load):
        return say(f"explicit.{side}")
    if constant(stage):
        return say("explicit.steady")
    return say("explicit.linear") if linear(stage, lambda x: _rate(values, x)) else ()


def _rate(values: Substitution, entry: Tree) -> Laurent | None:
    """The rate of an entry of g, or of what is carried along."""
    assert isinstance(entry, tuple)
    _, name, i, *j = entry
    if name not in RATE_OF:
        return None
    rate: Laurent = values.names[RATE_OF[name]][i - 1][j[0] - 1 if j else 0]
    return rate
