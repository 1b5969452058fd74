"""L̃ of any problem as one scalar expression of t, the entries of g, ζ and the parameters.

Where a problem has points, its record gives the energy h̃ = K + U, with K a square in the velocity:
U is h̃ at rest, and L̃ = h̃ − 2U.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from ..algebra.families import on_homogeneous
from ..code.ellipsoid import is_integral
from ..code.graph import Node
from ..code.lower import Lowering
from ..code.options import Options
from ..code.reader import Value
from ..language.derivatives import product
from ..language.laurent import OverlongError, grouped, polynomial
from ..language.tree import Tree, add, mul, nodes, operands
from ..problem.problem import Problem, ProblemError
from ..problem.state_names import coordinates
from ..record.record import Derivation
from ..schema.lagrangian_kinds import Lagrangian


def with_scalar_lagrangian(problem: Problem, record: Derivation) -> Problem:
    """The problem of the same motions that has L̃ as an expression on the matrices of its group,
    which act on (r, 1) where it is affine; without inputs.  ``ProblemError`` where there is none.
    """
    if problem.group is None:
        if problem.torus:
            raise ProblemError(
                f"{problem.name}: on the torus the energy and Tr Wᵏ are kept: derive walk NAME says"
            )
        raise ProblemError(
            f"{problem.name}: {problem.without_matrices}; choose a problem with a group and a "
            "Lagrangian"
        )
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
            f"{problem.name}: damping is no part of a Lagrangian; take [[damping]] away"
        )
    if problem.lagrangian is not None:
        return replace(problem, inputs=())
    group = problem.group.stated
    return replace(
        problem,
        group=on_homogeneous(group) if group.affine else group,
        action="linear",
        body=None,
        potentials=(),
        inputs=(),
        places=(),
        lagrangian=Lagrangian(L=scalar_lagrangian(problem, record)),
    )


def scalar_lagrangian(problem: Problem, record: Derivation) -> Tree:
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
    moving = _Trees(leaves)
    at_rest = _Trees(leaves | dict.fromkeys(space.coordinates, 0))
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

    def __init__(self, leaves: dict[Node, Tree]):
        self.known = dict(leaves)

    def of(self, x: Node) -> Tree:
        """The tree of a node."""
        if x not in self.known:
            self.known[x] = self._made(x)
        return self.known[x]

    def _made(self, x: Node) -> Tree:
        if x.op == "num":
            return _plain(x.data)
        if x.op == "leaf":
            kind, name = x.data
            return ("par", name) if kind == "parameter" and name != "π" else name
        parts = [*map(self.of, x.args)]
        if x.op == "add":
            return add(*(mul(_plain(c), y) for c, y in zip(x.data, parts, strict=True)))
        if x.op == "mul":
            return product(*parts)
        if x.op == "recip":
            return ("div", 1, parts[0])
        if x.op == "fun" and is_integral(x.data):
            raise ProblemError(
                "the Lagrangian is no expression where self_gravity acts, whose energy is an "
                "integral: nothing is sought in it; the walk says what is kept"
            )
        if x.op == "fun":
            return ("fun", x.data, parts[0])
        if x.op == "value":
            return parts[0]
        raise ProblemError(f"no expression of the energy: it has the operation {x.op!r}")


def _plain(x: Fraction) -> Tree:
    return int(x) if x.denominator == 1 else x
