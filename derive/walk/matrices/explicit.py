"""The answer: the equations of motion in coordinates, a problem's own numbers put in.

The values of names in these numbers and in the parameters, as Laurent polynomials.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain, product
from math import prod
from typing import Any

from ...algebra.calculus import gradient
from ...algebra.groups import Group
from ...algebra.relations import skew
from ...language import rational as q
from ...language.laurent import Laurent, OverlongError, written
from ...language.read import read
from ...language.tree import Tree, mul, nodes, operands, replaced
from ...language.values import LARGEST_POWER, OPERATIONS, Value, hat
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import Prose
from ...schema.body_kinds import MomentBody
from ..chapter import Chapter, Draft, say
from ..given.body_and_potentials import Potentials
from ..given.inputs import External
from .coordinates import Balance, by_relations, element, short_rates, solved
from .rotation import AXES, Torque, diagonal, is_diagonal, principal, square, symbols
from .separation import constant, linear
from .specialisation import KernelOnGroup

# Names have Laurent polynomials for values, also as the entries of vectors and matrices.
# What is no such polynomial keeps its name: a function of its argument, the tension σ_e of an
# element that depends on its length, the entries of a force Q_i or P_i on a point.

MOST = 200
"""As many terms has a value at most."""
PAIRS = 60_000
"""As many products of a term with a term are formed at most, in all."""
KEPT = ("σ", "P", "Q", "r_c")
"""What keeps its name, or its members theirs, where it is no polynomial or one longer than
``SHORT``."""
ENDS = "d"
"""The family of differences of places: where the answer is long, each keeps its name."""
SHORT = 3
UNKNOWN = (ArithmeticError, IndexError, KeyError, OverlongError, TypeError, ValueError)
"""What evaluation raises where a name has no value here, or no short one."""


class PutIn:
    """Names and members of families with their values; ``size``: of the identity matrix."""

    def __init__(self, known: Mapping[str, Value], size: int, opaque: str = ""):
        self.names: dict[str, Value] = {"π": Laurent.symbol("π"), "t": Laurent.symbol("t"), **known}
        self.families: dict[str, dict[int, Value]] = {}
        self.one, self.pairs, self.opaque = q.identity(size), 0, opaque

    def member(self, family: str, k: int, value: Value) -> None:
        """Give a member of a family its value."""
        self.families.setdefault(family, {})[k] = value

    def learn(self, equations: Iterable[Equation]) -> None:
        """The values of names and members that equations define, where they have one."""
        for e in equations:
            try:
                if isinstance(e.lhs, str):
                    self.names[e.lhs] = self._value_or_name(e.lhs, e.rhs)
                elif isinstance(e.lhs, tuple) and e.lhs[0] == "at" and isinstance(e.lhs[2], int):
                    self.member(e.lhs[1], e.lhs[2], self._value_or_name(e.lhs, e.rhs))
            except UNKNOWN:
                continue

    def _value_or_name(self, whole: Tree, t: Tree) -> Value:
        """The value of a tree, or the name that it defines; of a vector 0 stays 0."""
        head = whole[1] if isinstance(whole, tuple) else whole
        named = Laurent.symbol(whole) if head == "σ" else symbols(whole, len(self.one))
        try:
            found = self.of(t)
        except UNKNOWN:
            if head not in KEPT:
                raise
            return named
        if head not in KEPT:
            return named if head == self.opaque else found
        if all(map(_is_short, _numbers_in(found))):
            return found
        if not isinstance(named, tuple):
            return named
        return tuple(y if any(x) else x for x, y in zip(found, named, strict=True))

    def of(self, t: Tree) -> Value:
        """The value of a tree; ``UNKNOWN`` where there is none."""
        found = self._of(t)
        if any(len(x.terms) > MOST for x in _numbers_in(found) if isinstance(x, Laurent)):
            raise OverlongError("too many terms")
        return found

    def _of(self, t: Tree) -> Value:
        if isinstance(t, (int, Fraction)):
            return Laurent.of(t)
        if isinstance(t, str):
            return self.names[t]
        op, *parts = t
        if op in SPECIAL:
            return SPECIAL[op](self, *parts)
        found = [*map(self.of, operands(t))]
        if op == "mul":
            return self._product(*found)
        return OPERATIONS[op](*(found if op in APART else self._bounded(op, *found)))

    def _product(self, *factors: Value) -> Value:
        """The product, factor by factor; ``OverlongError`` before one is too long to be formed."""
        total, *rest = factors
        for x in rest:
            total = OPERATIONS["mul"](*self._bounded("mul", total, x))
        return total

    def _bounded(self, op: str, *parts: Value) -> Sequence[Value]:
        """What is to be multiplied; ``OverlongError`` where the products of terms are too many."""
        self.pairs += prod(map(_length, parts)) * (_length(parts[-1]) if op == "norm2" else 1)
        if self.pairs > PAIRS:
            raise OverlongError("too many terms")
        return parts

    def _sum(self, index: str, body: Tree) -> Value:
        """The sum over the members that all families with this index have."""
        having = (x for x in nodes(body) if isinstance(x, tuple) and x[0] == "at")
        spans = [{*self.families[x[1]]} for x in having if x[2] == index]
        terms = [self.of(replaced(body, index, k)) for k in sorted(set.intersection(*spans))]
        return OPERATIONS["add"](*terms)

    def _entry(self, whole: Tree, *at: int) -> Value:
        i, j = (*at, 1)[:2]
        return self.of(whole)[i - 1][j - 1]

    def _call(self, head: Tree, *arguments: Tree) -> Value:
        """r_i(t)."""
        if not isinstance(head, tuple) or head[1] != "r" or arguments != ("t",):
            raise KeyError(head)
        moved = q.times(self.names["A"], self.of(head))
        return q.plus(moved, self.names["T"]) if "T" in self.names else moved

    def _power(self, base: Tree, n: int) -> Value:
        x = self.of(base)
        if abs(n) > LARGEST_POWER:
            raise OverlongError("too large a power")
        if n < 0:
            return self._power(("inv", base), -n)
        return self._product(*[x] * n)

    def _inverse(self, t: Tree) -> Value:
        x = self.of(t)
        if isinstance(x, tuple):
            raise KeyError(t)
        if len(x.terms) == 1:
            return x.reciprocal()
        return Laurent.symbol(("div", 1, written(x)))


SPECIAL: dict[str, Any] = {
    "par": lambda _, name: Laurent.symbol(("par", name)),
    "one": lambda known: known.one,
    "matrix": lambda known, *rows: tuple(tuple(map(known.of, row[1:])) for row in rows),
    "at": lambda known, family, k: known.families[family][k],
    "sum": PutIn._sum,
    "entry": PutIn._entry,
    "call": PutIn._call,
    "pow": PutIn._power,
    "inv": PutIn._inverse,
    "fun": lambda known, name, t: Laurent.symbol(("fun", name, written(known.of(t)))),
    "div": lambda known, a, b: known._product(known.of(a), known.of(("inv", b))),
}
APART = ("add", "row", "T", "tr", "hat")
"""Operations in which no terms are multiplied."""


def _length(x: Value) -> int:
    """The number of terms of a value, at least 1."""
    return max(1, sum(len(y.terms) if isinstance(y, Laurent) else bool(y) for y in _numbers_in(x)))


def _numbers_in(x: Value) -> Sequence[Any]:
    return [*chain.from_iterable(x)] if isinstance(x, tuple) else [x]


def _is_short(x: Any) -> bool:
    """Is a value a polynomial in names, of few terms?"""
    if not isinstance(x, Laurent):
        return True
    whole = (s for m in x.terms for s, _ in m if isinstance(s, tuple))
    return len(x.terms) <= SHORT and all(s[0] not in ("fun", "div") for s in whole)


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

    def learnt_by(self, values: PutIn, motion: Step, *inertia: Step) -> None:
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
    own: Particulars, special: KernelOnGroup, driven: KernelOnGroup, motion: Step, c: Chapter
) -> Steps:
    """From the kernel, the work of the forces on the right."""
    if not own.wanted:
        return ()
    group = own.group
    b, draft = driven.letters, c.draft("explicit", RULE, own.body[-1], motion)
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
    whole, apart = (PutIn(known, n, opaque) for opaque in ("", ENDS))
    for values in (whole, apart):
        own.learnt_by(values, motion)
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
        idle = bool(own.problem.potentials) and not any(work)
        if found := _explicit_step(draft, stage, values, idle, group):
            return found
    return ()


def _moments_of_forces(values: PutIn) -> dict[str, Value]:
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
    own: Particulars, torque: Torque, inertia: Step, motion: Step, tensor: Steps, c: Chapter
) -> Steps:
    """From the equations of motion in vectors; none where they stand in components already."""
    if not own.wanted:
        return ()
    group, draft = own.group, c.draft("explicit", RULE, own.body[-1], inertia, motion, *tensor[:1])
    vectors = ("ζ", "ζ̇", "u", *(("w", "ẇ", "f_u") if group.affine else ()))
    known = _place(group) | {x: symbols(x, 3) for x in vectors}
    values = PutIn(known | {"Z": hat(known["ζ"])}, 3)
    own.learnt_by(values, motion, inertia)
    sides = {e.lhs: e.rhs for e in motion.equations}
    try:
        name, rest = _inverted(sides["ζ̇"])
        mass = values.of(name)
        lettered = is_diagonal(mass) and any(len(x.terms) > 1 for row in mass for x in row)
        if lettered:
            mass = values.names[name] = diagonal(principal(name, mass))
        load = values.of(rest)
        work = [values.of(e.rhs) for s in torque.steps for e in s.equations]
        stage = Balance(mass, _entries(load), tuple(("entry", "ζ̇", i) for i in AXES))
        drift = values.of(sides["ẇ"]) if group.affine else ()
    except UNKNOWN:
        return ()
    idle = bool(own.problem.potentials) and not any(x for column in work for x in _entries(column))
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
    values = PutIn(known, group.size)
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
    stage = Balance(M, tuple(x for (x,) in load), tuple(("entry", "ζ̇", a) for a in span))
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


def _linear_in(rows: Sequence[Laurent], unknowns: tuple[Tree, ...]) -> Balance:
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
    return Balance(tuple(map(tuple, mass)), tuple(load), unknowns)


def _explicit_step(
    draft: Draft,
    stage: Balance,
    values: PutIn,
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


def _seen(stage: Balance, values: PutIn, side: str) -> Prose:
    """Whether the velocity or its rate is constant, or the equations are linear."""
    if not any(stage.load):
        return say(f"explicit.{side}")
    if constant(stage):
        return say("explicit.steady")
    return say("explicit.linear") if linear(stage, lambda x: _rate(values, x)) else ()


def _rate(values: PutIn, entry: Tree) -> Laurent | None:
    """The rate of an entry of g, or of what is carried along."""
    assert isinstance(entry, tuple)
    _, name, i, *j = entry
    if name not in RATE_OF:
        return None
    rate: Laurent = values.names[RATE_OF[name]][i - 1][j[0] - 1 if j else 0]
    return rate
