"""L̃ of any problem as one scalar expression of t, the entries of g, ζ and the parameters."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import count

from ...algebra.exact_kernel import PRIMES, ResidueVector, ResidueVectorSource, primes_from
from ...algebra.families import on_homogeneous
from ...algebra.groups import Group
from ...code.ellipsoid import is_item
from ...code.graph import Node
from ...code.lower import Lowering
from ...code.options import Options
from ...code.reader import Value
from ...language.derivatives import product
from ...language.laurent import OverlongError, grouped, polynomial
from ...language.rational import transposed
from ...language.show import show
from ...language.tree import Tree, add, mul, neg, nodes, operands, plain
from ...problem.entries_on_orbit import Entries, Rows, element, times
from ...problem.fields import coordinates
from ...problem.problem import Problem, ProblemError
from ...record.record import Derivation
from ...schema.kind import Lagrangian, Parameter
from .gradient import FunctionsAtPoints, Tape

# The entries of g that a Lagrangian may name, and those that vary in the group.


def entries(group: Group) -> dict[Tree, tuple[int, int]]:
    """The entries of g that a Lagrangian may name, with their places from 0."""
    found: dict[Tree, tuple[int, int]] = {}
    for offset, factor in group.places:
        for i in range(offset, offset + factor.n):
            for j in range(offset, offset + factor.size):
                found["entry", "A", i + 1, j + 1] = i, j
    return found


def varying(group: Group) -> dict[Tree, tuple[int, int]]:
    """Those that are not the same number in all of the group."""
    g = element(group)
    return {x: (i, j) for x, (i, j) in entries(group).items() if isinstance(g[i][j], tuple)}


# Matrices of expressions: g, its conjugates of other matrices, sums and products.


def conjugated(m: Rows, group: Group, *, inward: bool) -> Rows | None:
    """The entries of g⁻¹mg (``inward``) or gmg⁻¹, factor by factor, where the linear parts are
    rotations; ``None`` elsewhere."""
    g = element(group)
    rows: list[list[Tree]] = [[0] * group.size for _ in range(group.size)]
    seen = 0
    for offset, factor in group.places:
        if "orthogonal" not in factor.relations:
            return None
        span, last = range(offset, offset + factor.n), offset + factor.n
        linear, A = ([[x[i][j] for j in span] for i in span] for x in (m, g))
        turned = _turned(linear, transposed(A) if inward else A)
        T, b = ([[x[i][last]] for i in span] if factor.affine else [] for x in (g, m))
        if factor.affine and inward:  # Ā(mT + b)
            shift = times(transposed(A), plus(times(linear, T), b))
        elif factor.affine:  # Ab − A m Ā T
            shift = plus(times(A, b), negative(times(turned, T)))
        for i, row in zip(span, turned, strict=True):
            rows[i][offset : offset + factor.n] = row
            if factor.affine:
                rows[i][last] = shift[i - offset][0]
        here = range(offset, offset + factor.size)
        seen += sum(m[i][j] != 0 for i in here for j in here)
    return tuple(map(tuple, rows)) if seen == sum(x != 0 for row in m for x in row) else None


def _turned(m: Entries, by: Entries) -> Entries:
    """R m R̄ for a rotation R; of R³ by R j(x) R̄ = j(Rx)."""
    n = len(m)
    if n != 3:
        return times(times(by, m), transposed(by))
    half = Fraction(1, 2)
    skew = [[mul(half, add(m[i][j], neg(m[j][i]))) for j in range(n)] for i in range(n)]
    even = [[mul(half, add(m[i][j], m[j][i])) for j in range(n)] for i in range(n)]
    axis = [[by_state(skew[2][1])], [by_state(skew[0][2])], [by_state(skew[1][0])]]
    (x,), (y,), (z,) = times(by, axis)
    hat: Entries = [[0, neg(z), y], [z, 0, neg(x)], [neg(y), x, 0]]
    rest = [[by_state(x) for x in row] for row in even]
    return plus(hat, times(times(by, rest), transposed(by))) if full(rest) else hat


def plus(a: Entries, b: Entries) -> Rows:
    """The sum of matrices of expressions."""
    pairs = zip(a, b, strict=True)
    return tuple(tuple(add(x, y) for x, y in zip(*rows, strict=True)) for rows in pairs)


def negative(a: Entries) -> Rows:
    """The opposite of a matrix of expressions."""
    return tuple(tuple(map(neg, row)) for row in a)


def full(m: Entries) -> bool:
    """Has a matrix an entry that is not 0?"""
    return any(x != 0 for row in m for x in row)


# What of L̃ depends on no state: π, parameters, and functions of these and of numbers alone.
#
# A root of a number, √2, is true modulo primes of which it is a square: by others nothing is
# tried, and so the field of these roots is kept with all its relations (x^((p + 1)/4) is the root
# that is a square itself, so that √2·√3 = √6).

MOST_PRIMES = 2000
"""So many primes are tried, of which half have each root."""


def is_root(t: Tree) -> bool:
    """Is it a square root?"""
    return isinstance(t, tuple) and t[:2] == ("fun", "sqrt")


class ParameterValues:
    """Random values of what an expression has of parameters alone."""

    def __init__(self, tree: Tree):
        seen = [*dict.fromkeys(nodes(tree))]
        self.letters: tuple[Tree, ...] = (
            "π",
            *(x for x in seen if isinstance(x, tuple) and x and x[0] == "par"),
        )
        self.functions: tuple[Tree, ...] = tuple(
            x for x in seen if isinstance(x, tuple) and x[:1] == ("fun",) and of_parameters(x)
        )
        self.roots = tuple(x for x in self.functions if is_root(x))
        self.roots_of_numbers = tuple(x for x in self.roots if not {*self.letters} & {*nodes(x)})

    @cached_property
    def primes(self) -> tuple[int, ...]:
        """As many as ``PRIMES``, modulo which the roots of numbers are true ones."""
        found = [p for p, _ in zip(self._good(), PRIMES, strict=False)]
        if len(found) < len(PRIMES):
            roots = ", ".join(show(x)[:60] for x in self.roots_of_numbers)
            raise ProblemError(
                f"symmetries are sought modulo primes, of which none has {roots}, in its Lagrangian"
            )
        return tuple(found)

    def _good(self) -> Iterator[int]:
        for p, _ in zip(primes_from(PRIMES[0]), range(MOST_PRIMES), strict=False):
            source = ResidueVectorSource(p, 1, 0)
            found = FunctionsAtPoints(source)
            for x in self.roots_of_numbers:
                Tape(x).at({}, source, found)
            if all(found.valid):
                yield p

    def drawn(self, count: int, p: int, seed: int) -> dict[Tree, list[int]]:
        """Up to so many values of each at which its roots are true: residues."""
        many = count << (len(self.roots) - len(self.roots_of_numbers))
        source = ResidueVectorSource(p, many, seed)
        found = FunctionsAtPoints(source)
        values: dict[Tree, ResidueVector] = {x: source.randint(1, 1) for x in self.letters}
        for x in self.functions:
            values[x] = Tape(x).at(values, source, found).value
        valid = [k for k, holds in enumerate(found.valid) if holds][:count]
        return {x: v.at(valid).values for x, v in values.items()}

    def at(self, t: Tree, values: Mapping[Tree, int], p: int) -> int:
        """The residue of an expression in parameters, by values of what it is made of."""
        source = ResidueVectorSource(p, 1, 0)
        leaves = {x: source.constant(v) for x, v in values.items()}
        found: ResidueVector = (
            Tape(t, self.functions).at(leaves, source, FunctionsAtPoints(source)).value
        )
        return found.values[0]


@dataclass(frozen=True)
class Integrand:
    """What stands for Ψ in L̃: its integrand at one place u, times a weight; two new parameters.

    L̃ is linear in Ψ, so that a field, the same for all of these, which changes L̃ by dF/dt for each
    of them does so for the integral.
    """

    place: str
    weight: str

    @classmethod
    def with_free_names(cls, taken: Collection[str]) -> Integrand:
        """With names that are not taken: ``node``, ``weight``, with as many _ as it takes."""
        end = next(x for k in count() if not {"node" + (x := "_" * k), "weight" + x} & {*taken})
        return cls("node" + end, "weight" + end)

    @property
    def letters(self) -> dict[str, Parameter]:
        """What the two are."""
        return {
            self.place: Parameter(meaning="where the integrand of self-gravity is taken"),
            self.weight: Parameter(meaning="weight of the integrand"),
        }

    def require_unused(self, found: Iterable[Tree]) -> None:
        """``ProblemError`` where what was found depends on the integrand: it is none of all."""
        own: set[Tree] = {("par", x) for x in self.letters}
        if any(own & {*nodes(t)} for t in found):
            raise ProblemError("a symmetry of the integrand is not the same at all places of it")

    def of(self, first: Tree, second: Tree, third: Tree) -> Tree:
        """It at I₁, I₂, I₃."""
        u: Tree = ("par", self.place)
        cubic = add(("pow", u, 3), mul(first, ("pow", u, 2)), mul(second, u), third)
        return ("div", ("par", self.weight), ("fun", "sqrt", cubic))


def require_no_forces(problem: Problem) -> None:
    """``ProblemError`` where a force of the state acts, or mass flows, which are outside L̃."""
    if problem.flows:
        raise ProblemError(
            f"{problem.name}: mass flows in a [[flow]], which is no part of L̃, and this is of L̃ "
            "alone; leave it out"
        )
    if problem.forces:
        raise ProblemError(
            f"{problem.name}: a [[force]], or damping that is quadratic or rotational, is no part "
            "of L̃, and this is of L̃ alone; leave it out"
        )


def with_scalar_lagrangian(
    problem: Problem, record: Derivation, integrand: Integrand | None = None
) -> Problem:
    """The problem of the same motions that has L̃ as an expression on the matrices of its group,
    which act on (r, 1) where it is affine; without inputs.  ``ProblemError`` where there is none.

    ``integrand``: what stands there for an integral, if anything may.
    """
    if problem.group is None or problem.kinematics:
        raise ProblemError(problem.unsearched)
    if problem.advected is not None:
        raise ProblemError(
            f"{problem.name}: symmetries are fields on a group, and the state of an [algebra] has "
            "no element of one; derive integrals finds what its motion keeps"
        )
    if not problem.group.has_inner_samples:
        raise ProblemError(
            f"{problem.name}: no exact elements of {problem.group.name} are known, by which "
            "symmetries are sought: a matrix of its basis has eigenvalues other than rational ones "
            "and one pair ±√q"
        )
    if problem.damping:
        raise ProblemError(
            f"{problem.name}: damping is no part of L̃, and this is of L̃ alone: damping changes the "
            "energy at the rate −Σ κ |v|², and keeps momenta whose symmetry moves no damped point, "
            "and those of translations with Σ κ r"
        )
    require_no_forces(problem)
    if problem.lagrangian is not None:
        return replace(problem, inputs=())
    group = problem.group.in_user_basis
    letters = integrand.letters if integrand else {}
    return replace(
        problem,
        parameters={**problem.parameters, **letters},
        group=on_homogeneous(group) if group.affine else group,
        action="linear",
        body=None,
        potentials=(),
        inputs=(),
        outputs=(),
        places=(),
        lagrangian=Lagrangian(L=scalar_lagrangian(problem, record, integrand)),
    )


def scalar_lagrangian(
    problem: Problem, record: Derivation, integrand: Integrand | None = None
) -> Tree:
    """L̃(t, g, ζ), in t, the entries of g as a matrix that acts on (r, 1), those of ζ in the basis
    of the emitted code, and the parameters."""
    if problem.lagrangian is not None:
        return problem.lagrangian.L
    lowering = _KeepingPi(record, problem.own_group, Options())
    energy, space = lowering.reader.number("h̃"), lowering.reader.space
    leaves: dict[Node, Tree] = dict(
        zip(space.coordinates, coordinates(problem.own_group.in_user_basis), strict=True)
    )
    for i, row in enumerate(space.element, 1):
        for j, x in enumerate(row, 1):
            if x.op == "leaf":
                leaves[x] = ("entry", "A", i, j)
    moving = _Trees(leaves, integrand)
    at_rest = _Trees(leaves | dict.fromkeys(space.coordinates, 0), integrand)
    return by_state(add(moving.of(energy), mul(-2, at_rest.of(energy))))


def by_state(t: Tree) -> Tree:
    """A scalar expression as a sum over products of the time, entries of g and ζ, each with all of
    its coefficient, where that is not too long."""
    try:
        return grouped(polynomial(t), of_parameters, _of_velocity)
    except OverlongError:
        return t


def _of_velocity(t: Tree) -> bool:
    return isinstance(t, tuple) and t[:2] == ("entry", "ζ")


def of_parameters(t: Tree) -> bool:
    """Does an expression depend on parameters alone?"""
    leaves = (x for x in nodes(t) if not operands(x))
    return all(
        x[0] == "par" if isinstance(x, tuple) else not isinstance(x, str) or x == "π"
        for x in leaves
    )


class _KeepingPi(Lowering):
    """The lowering of a record, with π as it is."""

    def tree(self, t: Tree) -> Value:
        return self.graph.leaf("π", "parameter") if t == "π" else super().tree(t)


class _Trees:
    """The trees of the nodes of a graph; ``leaves``: those of the numbers of the state."""

    def __init__(self, leaves: dict[Node, Tree], integrand: Integrand | None):
        self.known, self.integrand = dict(leaves), integrand

    def of(self, x: Node) -> Tree:
        """The tree of a node."""
        if x not in self.known:
            self.known[x] = self._made(x)
        return self.known[x]

    def _made(self, x: Node) -> Tree:
        if x.op == "num":
            return plain(x.data)
        if x.op == "leaf":
            kind, name = x.data
            return ("par", name) if kind == "parameter" and name != "π" else name
        parts = [*map(self.of, x.args)]
        if x.op == "add":
            return add(*(mul(plain(c), y) for c, y in zip(x.data, parts, strict=True)))
        if x.op == "mul":
            return product(*parts)
        if x.op == "recip":
            return ("div", 1, parts[0])
        if x.op == "fun" and is_item(x.data):
            if self.integrand is None:
                raise ProblemError(
                    "the Lagrangian is no expression where self_gravity acts, whose energy is an "
                    "integral: derive symmetries seeks in its integrand, and nothing else is sought"
                )
            return self.integrand.of(*map(self.of, x.args[0].args[0].args))
        if x.op == "fun" and x.data == "abs":  # as the record has it
            return ("fun", "sqrt", ("pow", parts[0], 2))
        if x.op == "fun":
            return ("fun", x.data, parts[0])
        if x.op == "value":
            return parts[0]
        raise ProblemError(f"no expression of the energy: it has the operation {x.op!r}")
