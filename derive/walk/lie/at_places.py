"""Forces and torques at places of a body whose Lagrangian no points give: their work on the
displacements along the basis of the Lie algebra."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ...algebra.groups import Group
from ...language.rational import Matrix
from ...language.tree import Tree, add, mul, plain
from ...problem.fields import coordinates, velocity_at_place
from ...problem.problem import Problem
from ...schema.kind import TorqueInput
from ..given.inputs import Push, couple_of, covector_terms, entries_of, pushes

Trees = list[Tree]


def from_outside(problem: Problem, group: Group) -> list[tuple[Tree, ...]]:
    """What acts along each element of the basis from outside dϖ, term by term: covectors, and the
    work of forces and torques at places."""
    covectors = covector_terms(problem, group)
    acting = pushes(problem)
    if not acting:
        return covectors
    places = Places(problem, group)
    works = [places.works(e, x) for e, x in acting]
    return [
        (*terms, *(work[a] for work in works if work[a] != 0)) for a, terms in enumerate(covectors)
    ]


class Places:
    """The places at which forces act, moved by A, a matrix that acts on (r, 1): with an element of
    the basis a force f at r has the work ⟨f, A E_a r⟩, on the right ⟨f, E_a A r⟩."""

    def __init__(self, problem: Problem, group: Group) -> None:
        assert problem.lagrangian is not None
        self.problem, self.group = problem, group
        self.left = problem.lagrangian.trivialisation == "left"
        span = range(1, group.n + 1)
        self.A: list[Trees] = [[("entry", "A", i, j) for j in span] for i in span]
        self.body: list[Trees] = [[*group.in_block(x.block, x.at, 1)] for x in problem.places]
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
        return [_times(_trees(e), place) for e in self.group.basis]

    def _seen(self, f: Sequence[Tree], frame: str, factor: Group) -> Trees:
        """A force by what its work is a product with: Āf in the body, on the right f in space."""
        if self.left and frame == "body" and "orthogonal" in factor.relations:
            return [*f]
        in_space = _times(self.A, f) if frame == "body" else [*f]
        return _times(_transposed(self.A), in_space) if self.left else in_space

    def _seen_in_block(self, torque: Sequence[Tree], frame: str, block: int) -> Trees:
        """A torque by its components in the body, on the right in space; in the plane they are
        one."""
        if len(torque) == 1 or frame == ("body" if self.left else "space"):
            return [*torque]
        at = self.group.of_block(block)
        R = [row[at] for row in self.A[at]]
        return _times(_transposed(R) if self.left else R, torque)

    def _moving(self) -> Iterable[tuple[Tree, Tree]]:
        """The coordinates of the places in space, and of their velocities, by A and ζ."""
        zeta = coordinates(self.group)
        for i, r in enumerate(self.body, 1):
            place = _times(self.A, r)
            along = _transposed(self._displacements(r))
            rates = [_dot(row, zeta) for row in along]
            v = _times(self.A, rates) if self.left else rates
            for k in range(1, self.group.n + 1):
                yield ("entry", ("call", ("at", "r", i), "t"), k), place[k - 1]
                yield ("entry", ("at", "v", i), k), v[k - 1]
            first, factor = self.group.places[self.problem.places[i - 1].block - 1]
            if self.left and "orthogonal" in factor.relations:  # Āv is Zr without A
                still = (0,) * factor.n
                turned = velocity_at_place(factor.n, first, i, still, turned=True).values()
                yield from zip(turned, rates[first : first + factor.n], strict=True)


def _trees(e: Matrix) -> list[Trees]:
    return [[plain(x) for x in row] for row in e]


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


def _transposed(a: Sequence[Sequence[Tree]]) -> list[Trees]:
    return [[*column] for column in zip(*a, strict=True)]


def _with(t: Tree, known: Mapping[Tree, Tree]) -> Tree:
    """A tree with the values of entries in their places."""
    if t in known or not isinstance(t, tuple):
        return known.get(t, t)
    return (t[0], *(_with(x, known) for x in t[1:]))
