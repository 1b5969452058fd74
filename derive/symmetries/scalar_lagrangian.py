"""L̃ of any problem as one scalar expression of t, the entries of g, ζ and the parameters.

Where a problem has points, its record gives the energy h̃ = K + U, with K a square in the velocity:
U is h̃ at rest, and L̃ = h̃ − 2U.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from itertools import count

from ..algebra.families import on_homogeneous
from ..code.ellipsoid import is_item
from ..code.graph import Node
from ..code.lower import Lowering
from ..code.options import Options
from ..code.reader import Value
from ..language.derivatives import product
from ..language.laurent import OverlongError, grouped, polynomial
from ..language.tree import Tree, add, mul, nodes, operands, plain
from ..problem.problem import Problem, ProblemError
from ..problem.state_names import coordinates
from ..record.record import Derivation
from ..schema.declared import Parameter
from ..schema.lagrangian_kinds import Lagrangian


@dataclass(frozen=True)
class Integrand:
    """What stands for Ψ in L̃: its integrand at one place u, times a weight; two new parameters.

    L̃ is linear in Ψ, so that a field, the same for all of these, which changes L̃ by dF/dt for each
    of them does so for the integral.
    """

    place: str
    weight: str

    @classmethod
    def beside(cls, taken: Collection[str]) -> Integrand:
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


def with_scalar_lagrangian(
    problem: Problem, record: Derivation, integrand: Integrand | None = None
) -> Problem:
    """The problem of the same motions that has L̃ as an expression on the matrices of its group,
    which act on (r, 1) where it is affine; without inputs.  ``ProblemError`` where there is none.

    ``integrand``: what stands there for an integral, if anything may.
    """
    if problem.group is None:
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
    if problem.lagrangian is not None:
        return replace(problem, inputs=())
    group = problem.group.stated
    letters = integrand.letters if integrand else {}
    return replace(
        problem,
        parameters={**problem.parameters, **letters},
        group=on_homogeneous(group) if group.affine else group,
        action="linear",
        body=None,
        potentials=(),
        inputs=(),
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
    assert problem.group is not None
    lowering = _KeepingPi(record, problem.group, Options())
    energy, space = lowering.reader.number("h̃"), lowering.reader.space
    leaves: dict[Node, Tree] = dict(
        zip(space.coordinates, coordinates(problem.group.stated), strict=True)
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
        if x.op == "fun":
            return ("fun", x.data, parts[0])
        if x.op == "value":
            return parts[0]
        raise ProblemError(f"no expression of the energy: it has the operation {x.op!r}")
